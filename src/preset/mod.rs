//! The document: what a person authors, saves and exports.

mod document;

pub use document::{Origin, Preset};
