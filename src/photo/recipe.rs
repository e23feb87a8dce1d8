//! How r and h were taken from a photograph, so that it can be done again.

use serde::{Deserialize, Serialize};

/// The record a preset keeps of a match.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Recipe {
    /// File name of the photograph.
    pub photo: String,
    /// SHA-256 of the file, hexadecimal.
    pub photo_sha256: String,
}
