//! Files, whole or not at all: what is refused unread, and how the old file survives a failing save.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

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
    #[error("this is {0}, not a file")]
    NotRegular(&'static str),
    #[error("it is there already")]
    Exists,
    #[error("it is read-only")]
    ReadOnly,
    #[error("it is larger than {0} MiB, the limit for a text")]
    TooLarge(u64),
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
    read_text_within(path, LARGEST_TEXT_MIB)
}

/// The text of a regular file of at most so many MiB.
pub fn read_text_within(path: &Path, limit_mib: u64) -> Result<String, FileError> {
    text_of(path, limit_mib).map_err(|problem| FileError { path: path.to_owned(), problem })
}

/// Writes a whole file or nothing: a new file takes the old one's place, with its mode, once it is on disk.
///
/// A symbolic link stays and the file it leads to is replaced. A read-only file and whatever is no
/// regular file (a folder, a device) is refused.
pub fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    replace(path, bytes).map_err(|problem| FileError { path: path.to_owned(), problem })
}

/// What became of a file that can be made again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placed {
    /// There was none.
    New,
    /// It said the same already, and was not touched.
    Same,
    /// Another one was in its place.
    Replaced,
}

/// Writes a file that can be made again: whole or not at all, yet without waiting for the disk, which for ten
/// thousand files takes minutes. One that says the same already keeps its date.
///
/// Another one is refused unless `may_replace`. Links and modes are kept as by [`replace_file`].
pub fn place_file(path: &Path, bytes: &[u8], may_replace: bool) -> Result<Placed, FileError> {
    place(path, bytes, may_replace).map_err(|problem| FileError { path: path.to_owned(), problem })
}

/// The kind of the file is looked at first: opening a pipe would wait for ever.
fn text_of(path: &Path, limit_mib: u64) -> Result<String, FileProblem> {
    let kind = fs::metadata(path)?.file_type();
    if !kind.is_file() {
        return Err(FileProblem::NotRegular(other_kind(kind)));
    }
    let limit = limit_mib << 20;
    let mut bytes = Vec::new();
    File::open(path)?.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        return Err(FileProblem::TooLarge(limit_mib));
    }
    String::from_utf8(bytes).map_err(|_| FileProblem::NotUtf8)
}

/// What stands where a regular file should.
pub fn other_kind(kind: fs::FileType) -> &'static str {
    if kind.is_dir() { "a folder" } else { "a pipe or a device" }
}

/// The metadata of the regular file that stands at a path, if one does.
fn standing_file(path: &Path) -> Result<Option<fs::Metadata>, FileProblem> {
    match fs::metadata(path) {
        Ok(old) if !old.is_file() => Err(FileProblem::NotRegular(other_kind(old.file_type()))),
        Ok(old) => Ok(Some(old)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error.into()),
    }
}

fn place(path: &Path, bytes: &[u8], may_replace: bool) -> Result<Placed, FileProblem> {
    let target = end_of_links(path)?;
    let Some(old) = standing_file(&target)? else {
        let temporary = Temporary::write(&target, bytes)?;
        return temporary.become_new(&target).map(|()| Placed::New);
    };
    if old.len() == bytes.len() as u64 && fs::read(&target)? == bytes {
        return Ok(Placed::Same);
    }
    if !may_replace {
        return Err(FileProblem::Exists);
    }
    if old.permissions().readonly() {
        return Err(FileProblem::ReadOnly);
    }
    let temporary = Temporary::write(&target, bytes)?;
    fs::set_permissions(&temporary.0, old.permissions())?;
    fs::rename(&temporary.0, &target)?;
    Ok(Placed::Replaced)
}

/// A file beside its place, not yet in it; gone when dropped.
struct Temporary(PathBuf);

impl Temporary {
    fn write(target: &Path, bytes: &[u8]) -> io::Result<Self> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let name = format!(".edgewise-{}-{}.tmp", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let temporary = Self(target.with_file_name(name));
        File::create(&temporary.0)?.write_all(bytes)?;
        Ok(temporary)
    }

    /// A link fails where a file has come meanwhile; a rename would replace it, and serves where there are no links.
    fn become_new(&self, target: &Path) -> Result<(), FileProblem> {
        match fs::hard_link(&self.0, target) {
            Ok(()) => Ok(()),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Err(FileProblem::Exists),
            Err(_) => Ok(fs::rename(&self.0, target)?),
        }
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // After a rename there is nothing left to remove.
        let _ = fs::remove_file(&self.0);
    }
}

fn replace(path: &Path, bytes: &[u8]) -> Result<(), FileProblem> {
    let target = end_of_links(path)?;
    if standing_file(&target)?.is_some_and(|old| old.permissions().readonly()) {
        return Err(FileProblem::ReadOnly);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_made_again_is_new_the_same_refused_or_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.glsl");
        assert_eq!(place_file(&path, b"one", false).unwrap(), Placed::New);
        let written = fs::metadata(&path).unwrap().modified().unwrap();
        assert_eq!(place_file(&path, b"one", true).unwrap(), Placed::Same);
        assert_eq!(fs::metadata(&path).unwrap().modified().unwrap(), written);
        assert!(place_file(&path, b"two", false).unwrap_err().to_string().ends_with("it is there already"));
        assert_eq!(fs::read(&path).unwrap(), b"one");
        assert_eq!(place_file(&path, b"two", true).unwrap(), Placed::Replaced);
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing else is left");
        assert!(place_file(folder.path(), b"two", true).is_err());
        assert!(place_file(&folder.path().join("no/a"), b"one", true).is_err());
    }
}
