//! Unsaved work, kept where the end of the process does not reach it, and found again by the next window.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use eframe::egui::Context;

use super::document::Document;
use super::job::Follower;
use crate::preset::Preset;

/// A copy of the unsaved preset beside a lock that lives as long as this process.
///
/// The window can end without being asked: the display goes away, the system's file dialog takes the session bus
/// with it, the power fails.
pub(crate) struct Recovery {
    copy: PathBuf,
    /// Held open: whoever can lock it knows that its process is gone.
    _lock: File,
    is_used: bool,
    keeping: Follower<Option<Preset>, Result<(), String>>,
}

/// What an earlier window left behind.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LeftBehind {
    /// Its copy of the preset.
    pub copy: PathBuf,
    /// The preset.
    pub preset: Preset,
}

impl Recovery {
    /// Keeps unsaved work in `folder`, which is made where it is missing.
    pub(crate) fn start(folder: &Path) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        let copy = folder.join(format!("{}.json", std::process::id()));
        let lock = File::create(lock_of(&copy))?;
        lock.try_lock()?;
        Ok(Self { copy, _lock: lock, is_used: false, keeping: Follower::default() })
    }

    /// What windows that are gone have left in the folder, in the order of their files' names.
    pub(crate) fn left_behind(&self) -> Vec<LeftBehind> {
        let entries = self.copy.parent().and_then(|folder| fs::read_dir(folder).ok()).into_iter().flatten().flatten();
        let mut copies: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(|path| is_left_behind(path)).collect();
        copies.sort();
        let load = |copy: PathBuf| match Preset::load(&copy) {
            Ok(loaded) => Some(LeftBehind { copy, preset: loaded.preset }),
            Err(error) => {
                log::warn!("unsaved work was not recovered: {error}");
                None
            }
        };
        copies.into_iter().filter_map(load).collect()
    }

    /// Keeps the document as it is now; gives a sentence when that failed.
    pub(crate) fn keep(&mut self, ctx: &Context, document: &Document) -> Option<String> {
        let unsaved = document.is_changed().then(|| document.preset.clone());
        self.is_used |= unsaved.is_some();
        if !self.is_used {
            return None;
        }
        let copy = self.copy.clone();
        let keep = move |unsaved: Option<Preset>, _: &_| match unsaved {
            Some(preset) => preset.save(&copy).map_err(|error| error.to_string()),
            None => remove(&copy).map_err(|error| error.to_string()),
        };
        let (_, outcome) = self.keeping.follow(ctx, "keep unsaved work", unsaved, keep)?;
        outcome.err()
    }

    /// Takes over what was left behind, as the copy of this window.
    pub(crate) fn adopt(&mut self, left: &LeftBehind) -> io::Result<()> {
        fs::rename(&left.copy, &self.copy)?;
        self.is_used = true;
        remove(&lock_of(&left.copy))
    }

    /// True while the copy is being written.
    pub(crate) fn is_busy(&self) -> bool {
        self.keeping.is_busy()
    }

    /// Forgets the copy: its work was saved, or given up by a person.
    pub(crate) fn finish(&self) {
        for path in [self.copy.clone(), lock_of(&self.copy)] {
            if let Err(error) = remove(&path) {
                log::warn!("{}: {error}", path.display());
            }
        }
    }
}

impl LeftBehind {
    /// Deletes the copy.
    pub(crate) fn forget(&self) -> io::Result<()> {
        remove(&self.copy)?;
        remove(&lock_of(&self.copy))
    }
}

/// Where this system keeps what programs remember, if it says so.
pub(crate) fn folder() -> Option<PathBuf> {
    Some(dirs::state_dir().or_else(dirs::data_local_dir)?.join("edgewise").join("unsaved"))
}

fn lock_of(copy: &Path) -> PathBuf {
    copy.with_extension("lock")
}

/// True for a copy whose window is gone.
fn is_left_behind(path: &Path) -> bool {
    let is_copy = path.extension().is_some_and(|extension| extension == "json");
    is_copy && File::open(lock_of(path)).is_ok_and(|lock| lock.try_lock().is_ok())
}

fn remove(path: &Path) -> io::Result<()> {
    fs::remove_file(path).or_else(|error| if error.kind() == io::ErrorKind::NotFound { Ok(()) } else { Err(error) })
}
