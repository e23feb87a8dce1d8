//! Files, whole or not at all: what is refused unread, and how the old file survives a failing save.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use atomic_write_file::AtomicWriteFile;
use thiserror::Error;

/// A preset with a long recipe takes some tens of kilobytes, a long table of n and k some hundreds.
const LARGEST_TEXT_MIB: u64 = 4;

/// Why a file was not read or written; the sentence names it.
#[derive(Debug, Error)]
#[error("{}: {problem}", path.display())]
pub struct FileError {
    /// The file as it was named.
    pub path: PathBuf,
    /// What is wrong with it.
    pub problem: FileProblem,
}

/// What is wrong with a file.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum FileProblem {
    #[error("there is no such file or folder")]
    NotFound,
    #[error("it is no regular file")]
    NotRegular,
    #[error("it is read-only")]
    ReadOnly,
    #[error("it is larger than {LARGEST_TEXT_MIB} MiB, the limit for a text")]
    TooLarge,
    #[error("it is not UTF-8 text")]
    NotUtf8,
    #[error(transparent)]
    Io(io::Error),
}

impl From<io::Error> for FileProblem {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::NotFound { Self::NotFound } else { Self::Io(error) }
    }
}

/// The text of a regular file of modest size: a preset, or measured data.
pub fn read_text(path: &Path) -> Result<String, FileError> {
    text_of(path).map_err(|problem| FileError { path: path.to_owned(), problem })
}

/// Writes a whole file or nothing: a new file takes the old one's place, with its mode, once it is on disk.
///
/// A symbolic link stays and the file it leads to is replaced. A read-only file and whatever is no
/// regular file (a folder, a device) is refused.
pub fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    replace(path, bytes).map_err(|problem| FileError { path: path.to_owned(), problem })
}

/// The kind of the file is looked at first: opening a pipe would wait for ever.
fn text_of(path: &Path) -> Result<String, FileProblem> {
    if !fs::metadata(path)?.is_file() {
        return Err(FileProblem::NotRegular);
    }
    let limit = LARGEST_TEXT_MIB << 20;
    let mut bytes = Vec::new();
    File::open(path)?.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        return Err(FileProblem::TooLarge);
    }
    String::from_utf8(bytes).map_err(|_| FileProblem::NotUtf8)
}

fn replace(path: &Path, bytes: &[u8]) -> Result<(), FileProblem> {
    let target = end_of_links(path)?;
    match fs::metadata(&target) {
        Ok(old) if !old.is_file() => return Err(FileProblem::NotRegular),
        Ok(old) if old.permissions().readonly() => return Err(FileProblem::ReadOnly),
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error.into()),
        _ => {}
    }
    let mut file = AtomicWriteFile::open(&target)?;
    file.write_all(bytes)?;
    Ok(file.commit()?)
}

/// The file that a path leads to over symbolic links, which need not exist yet.
fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    const MOST_LINKS: usize = 40;
    let mut target = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&target) {
            Ok(next) => target = target.parent().unwrap_or(Path::new("")).join(next),
            Err(_) => return Ok(target),
        }
    }
    Err(io::Error::other(format!("more than {MOST_LINKS} symbolic links lead on from here")))
}
