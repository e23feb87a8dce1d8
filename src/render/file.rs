//! Writing a file whole or not at all.

use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use atomic_write_file::AtomicWriteFile;
use thiserror::Error;

/// A picture or figure that could not be saved; what was there before is untouched.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum SaveError {
    #[error("cannot write {}: {source}", path.display())]
    Write { path: PathBuf, source: io::Error },
    #[error("cannot write {}: {reason}", path.display())]
    Encode { path: PathBuf, reason: String },
    #[error("cannot tell the format of {}; end the name in {known}", path.display())]
    UnknownFormat { path: PathBuf, known: &'static str },
}

/// Replaces a file's contents at once: a reader sees the old bytes or the new ones, also after a failure.
///
/// A symbolic link keeps pointing to the file it names.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), SaveError> {
    let write = || -> io::Result<()> {
        let target = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let mut file = AtomicWriteFile::open(target)?;
        file.write_all(bytes)?;
        file.commit()
    };
    write().map_err(|source| SaveError::Write { path: path.to_owned(), source })
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
