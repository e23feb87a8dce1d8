//! The state of the library page: a folder of presets, what is searched in it, and its thumbnails.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::egui::Context;

use super::job::Follower;
use super::thumbnails::Thumbnails;
use crate::preset::{Item, Shelf};

/// Seconds after which the folder is looked at again, for what others did to its files.
pub(crate) const LOOK_AGAIN_SECONDS: f64 = 2.0;

/// A look at a folder; the count makes each one new.
#[derive(Clone, Debug, PartialEq)]
struct Look {
    folder: PathBuf,
    count: u64,
}

/// Each tag with how many presets have it.
type Tags = Vec<(String, usize)>;

/// The page of the library.
#[derive(Default)]
pub(crate) struct LibraryPage {
    /// What is typed in the field for the path of a folder.
    pub path: String,
    /// What is searched.
    pub search: String,
    /// A tag that presets must have.
    pub chosen_tag: Option<String>,
    /// The spheres of the presets in sight.
    pub thumbnails: Thumbnails,
    folder: Option<PathBuf>,
    looks: Follower<Look, Result<(Shelf, Tags), String>>,
    count: u64,
    looked_at: f64,
    /// Whether the folder has been read since it was opened.
    is_read: bool,
    shelf: Arc<Shelf>,
    tags: Tags,
    error: Option<String>,
    found: Option<Found>,
}

/// The result of a search, kept while neither the words nor the folder change.
struct Found {
    search: String,
    chosen_tag: Option<String>,
    shelf: Arc<Shelf>,
    indices: Vec<usize>,
}

impl LibraryPage {
    /// Shows another folder.
    pub(crate) fn open(&mut self, folder: PathBuf) {
        self.path = folder.display().to_string();
        self.folder = Some(folder);
        (self.shelf, self.tags) = (Arc::default(), Vec::new());
        (self.error, self.chosen_tag) = (None, None);
        self.is_read = false;
        self.count += 1;
    }

    /// The folder on show.
    pub(crate) fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// True until the folder has been read for the first time.
    pub(crate) fn is_reading(&self) -> bool {
        self.folder.is_some() && !self.is_read
    }

    /// True while a job is at work.
    pub(crate) fn is_busy(&self) -> bool {
        self.is_reading() || self.looks.is_busy() || self.thumbnails.is_busy()
    }

    /// Why the folder cannot be read.
    pub(crate) fn error(&self) -> Option<&str> {
        self.error.as_deref()
    }

    /// The presets of the folder.
    pub(crate) fn shelf(&self) -> &Arc<Shelf> {
        &self.shelf
    }

    /// The tags of the folder, each with how many presets have it.
    pub(crate) fn tags(&self) -> &[(String, usize)] {
        &self.tags
    }

    /// Sees to it that the list follows the folder; a read that is under way is waited for.
    pub(crate) fn follow(&mut self, ctx: &Context) {
        let Some(folder) = self.folder.clone() else { return };
        let time = ctx.input(|input| input.time);
        if self.is_read && !self.looks.is_busy() && time - self.looked_at >= LOOK_AGAIN_SECONDS {
            self.count += 1;
        }
        let (known, look) = (self.shelf.clone(), Look { folder, count: self.count });
        let done = self.looks.follow(ctx, "read the library", look, move |look, progress| {
            let shelf = known.refreshed(&look.folder, &|share| progress.report(share));
            let shelf = shelf.map_err(|error| error.to_string())?;
            let tags = shelf.tags().into_iter().collect();
            Ok((shelf, tags))
        });
        if let Some((_, result)) = done.filter(|(look, _)| Some(&look.folder) == self.folder.as_ref()) {
            self.looked_at = time;
            self.is_read = true;
            match result {
                Ok((shelf, tags)) if !shelf.is_as(&self.shelf) => {
                    (self.shelf, self.tags, self.error) = (Arc::new(shelf), tags, None);
                }
                Ok(_) => self.error = None,
                Err(error) => self.error = Some(error),
            }
        }
        ctx.request_repaint_after_secs(LOOK_AGAIN_SECONDS as f32);
    }

    /// The items that match the search, by path.
    pub(crate) fn found(&mut self) -> Vec<Arc<Item>> {
        let is_known = |found: &Found| {
            (&found.search, &found.chosen_tag) == (&self.search, &self.chosen_tag)
                && Arc::ptr_eq(&found.shelf, &self.shelf)
        };
        if !self.found.as_ref().is_some_and(is_known) {
            let matches = |item: &Item| match &item.preset {
                Ok(preset) => {
                    preset.matches(&self.search) && self.chosen_tag.as_ref().is_none_or(|tag| preset.tags.contains(tag))
                }
                Err(_) => self.search.trim().is_empty() && self.chosen_tag.is_none(),
            };
            let all = self.shelf.items().iter().enumerate();
            let indices = all.filter(|(_, item)| matches(item)).map(|(index, _)| index).collect();
            let (search, chosen_tag) = (self.search.clone(), self.chosen_tag.clone());
            self.found = Some(Found { search, chosen_tag, shelf: self.shelf.clone(), indices });
        }
        let indices = self.found.as_ref().map(|found| found.indices.as_slice()).unwrap_or_default();
        indices.iter().map(|&index| self.shelf.items()[index].clone()).collect()
    }
}

impl std::fmt::Debug for LibraryPage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("LibraryPage").field("folder", &self.folder).finish_non_exhaustive()
    }
}
