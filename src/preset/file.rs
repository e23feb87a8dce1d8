//! Presets on disk.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::{FormatError, Loaded, Preset};
use crate::file::{FileError, read_text, replace_file};

/// Why a preset was not loaded or saved; the sentence names the file.
#[derive(Debug, Error)]
pub enum PresetFileError {
    /// The file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// It holds no preset, or the preset is none that a file can hold.
    #[error("{}: {reason}", path.display())]
    Format {
        /// The file as it was named.
        path: PathBuf,
        /// What is wrong with the document.
        reason: FormatError,
    },
}

impl Preset {
    /// Reads a preset file.
    pub fn load(path: &Path) -> Result<Loaded, PresetFileError> {
        let text = read_text(path)?;
        Self::from_json(&text).map_err(|reason| PresetFileError::Format { path: path.to_owned(), reason })
    }

    /// Writes the preset; whatever fails, an older file stays as it was. See [`replace_file`].
    pub fn save(&self, path: &Path) -> Result<(), PresetFileError> {
        let text = self.to_json().map_err(|reason| PresetFileError::Format { path: path.to_owned(), reason })?;
        Ok(replace_file(path, text.as_bytes())?)
    }
}
