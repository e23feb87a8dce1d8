//! Presets on disk: what is refused unread, and how the old file survives a failing save.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use atomic_write_file::AtomicWriteFile;
use thiserror::Error;

use super::{FormatError, Loaded, Preset};

/// A preset with a long recipe takes some tens of kilobytes, a long table of n and k some hundreds.
const LARGEST_FILE_MIB: u64 = 4;

/// Why a file was not read or written; the sentence names it.
#[derive(Debug, Error)]
#[error("{}: {problem}", path.display())]
pub struct TextFileError {
    /// The file as it was named.
    pub path: PathBuf,
    /// What is wrong with it.
    pub problem: FileProblem,
}

/// What is wrong with a file.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum FileProblem {
    #[error(transparent)]
    Io(#[from] io::Error),
    #[error("it is no regular file")]
    NotRegular,
    #[error("it is read-only")]
    ReadOnly,
    #[error("it is larger than {LARGEST_FILE_MIB} MiB, the limit for a text")]
    TooLarge,
    #[error("it is not UTF-8 text")]
    NotUtf8,
    #[error(transparent)]
    Format(#[from] FormatError),
}

impl Preset {
    /// Reads a preset file.
    pub fn load(path: &Path) -> Result<Loaded, TextFileError> {
        Self::from_json(&read_text(path)?).map_err(|problem| at(path, problem.into()))
    }

    /// Writes the preset; whatever fails, an older file stays as it was.
    pub fn save(&self, path: &Path) -> Result<(), TextFileError> {
        let text = self.to_json().map_err(|problem| at(path, problem.into()))?;
        replace_file(path, text.as_bytes())
    }
}

/// Writes a whole file or nothing: a new file takes the old one's place, with its mode, once it is on disk.
///
/// A symbolic link stays and the file it leads to is replaced. A read-only file and whatever is no
/// regular file (a folder, a device) is refused.
pub fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), TextFileError> {
    replace(path, bytes).map_err(|problem| at(path, problem))
}

fn at(path: &Path, problem: FileProblem) -> TextFileError {
    TextFileError { path: path.to_owned(), problem }
}

/// The text of a regular file of modest size: a preset, or measured data.
pub fn read_text(path: &Path) -> Result<String, TextFileError> {
    text_of(path).map_err(|problem| at(path, problem))
}

/// The kind of the file is looked at first: opening a pipe would wait for ever.
fn text_of(path: &Path) -> Result<String, FileProblem> {
    if !fs::metadata(path)?.is_file() {
        return Err(FileProblem::NotRegular);
    }
    let limit = LARGEST_FILE_MIB << 20;
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
