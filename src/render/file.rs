//! Writing a file whole or not at all.

use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::file::{FileError, replace_file};

/// A picture or figure that could not be saved; what was there before is untouched.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum SaveError {
    #[error(transparent)]
    File(#[from] FileError),
    #[error("cannot write {}: {reason}", path.display())]
    Encode { path: PathBuf, reason: String },
    #[error("cannot tell the format of {}; end the name in {known}", path.display())]
    UnknownFormat { path: PathBuf, known: &'static str },
}

/// Replaces a file's contents at once; see [`replace_file`].
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), SaveError> {
    Ok(replace_file(path, bytes)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_names_the_file() {
        let missing = tempfile::tempdir().unwrap().path().join("no such folder").join("a.png");
        assert!(write_atomically(&missing, b"x").unwrap_err().to_string().contains("no such folder"));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_keeps_its_target() {
        let folder = tempfile::tempdir().unwrap();
        let (target, link) = (folder.path().join("target"), folder.path().join("link"));
        std::fs::write(&target, "old").unwrap();
        std::os::unix::fs::symlink(&target, &link).unwrap();
        write_atomically(&link, b"new").unwrap();
        assert_eq!(std::fs::read_to_string(&target).unwrap(), "new");
        assert!(link.is_symlink());
    }
}
