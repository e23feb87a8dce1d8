//! Why there is no preset in a file.

use thiserror::Error;

use crate::fit::NotAMaterial;
use crate::preset::FormatError;

/// One sentence about what is wrong with the contents; callers put the file name before it.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum ImportError {
    #[error(transparent)]
    Io(#[from] std::io::Error),
    #[error("this is {0}, not a file")]
    NotRegular(&'static str),
    #[error("it is larger than {0} MiB, the limit for a file of this kind")]
    TooLarge(usize),
    #[error("it has more than {0} metals")]
    TooMany(usize),
    #[error("it is not UTF-8 text")]
    NotUtf8,
    #[error("it is no file that Edgewise imports; those are .json, .mtlx, .glb, .gltf, .csv, .txt, .ase and .gpl")]
    UnknownFormat,
    #[error(transparent)]
    Preset(#[from] FormatError),
    #[error("it cannot be read as XML: {0}")]
    Xml(String),
    #[error("it cannot be read as glTF: {0}")]
    Gltf(String),
    #[error("it cannot be read as a table: {0}")]
    Table(String),
    #[error("it cannot be read as {format}: {reason}")]
    Broken { format: &'static str, reason: String },
    #[error("{0} holds no metal that Edgewise can read")]
    NoMetal(&'static str),
    #[error("“{name}”: {reason}")]
    Metal { name: String, reason: String },
    #[error("“{text}” is no {expected}")]
    Number { text: String, expected: &'static str },
}

impl ImportError {
    /// About one metal of a file.
    pub(super) fn metal(name: &str, reason: impl Into<String>) -> Self {
        Self::Metal { name: name.chars().take(60).collect(), reason: reason.into() }
    }

    /// About a parameterisation that stands for nothing.
    pub(super) fn no_material(name: &str) -> impl FnOnce(NotAMaterial) -> Self {
        move |error| Self::metal(name, error.to_string())
    }
}
