//! Putting an export into its place.

use std::path::PathBuf;

use super::Asked;
use crate::export::export;
use crate::file::{FileError, FileProblem, Placed, place_file};

/// An export on its way to a file.
#[derive(Clone, Debug)]
pub(crate) struct Writing {
    /// What is exported.
    pub asked: Asked,
    /// Where to; a folder stands for the usual name in it.
    pub path: PathBuf,
    /// True once a person has said that the file that is there may go.
    pub may_replace: bool,
}

/// Why there is no file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Failure {
    /// Another file is there, at this path, and nobody has said that it may go.
    Exists(PathBuf),
    /// A sentence.
    Other(String),
}

/// Writes the file whole or not at all; returns what was done as a sentence.
pub(crate) fn write(writing: &Writing) -> Result<String, Failure> {
    let asked = &writing.asked;
    let exported = export(&asked.preset, asked.target, &asked.options());
    let file = exported.map_err(|error| Failure::Other(error.to_string()))?.files.into_iter().next();
    let file = file.ok_or_else(|| Failure::Other("there is nothing to write".to_owned()))?;
    let path = if writing.path.is_dir() { writing.path.join(&file.name) } else { writing.path.clone() };
    match place_file(&path, &file.bytes, writing.may_replace) {
        Ok(Placed::New | Placed::Replaced) => Ok(format!("Written: {}", path.display())),
        Ok(Placed::Same) => Ok(format!("{} says the same already", path.display())),
        Err(FileError { problem: FileProblem::Exists, path }) => Err(Failure::Exists(path)),
        Err(error) => Err(Failure::Other(error.to_string())),
    }
}
