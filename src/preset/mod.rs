//! The document: what a person authors, saves and exports.

mod check;
mod document;
mod file;
mod file_stem;
mod folder;
mod format;
mod json;
mod library;
mod shelf;
mod unknown;

pub use check::{Checked, Finding, NO_PRESET, Severity, check_preset};
pub use document::{Origin, Preset};
pub use file::PresetFileError;
pub use file_stem::file_stem;
pub use folder::preset_files;
pub use format::{FormatError, Loaded, PRESET_FORMAT};
pub use json::pretty_json;
pub(crate) use json::read as read_strict_json;
pub use library::{built_in_presets, presets_from_metals};
pub use shelf::{Item, Shelf, Shelved};
