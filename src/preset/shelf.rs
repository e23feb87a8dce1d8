//! A folder of presets as a list one can look through; it follows what others do to the files.

use std::collections::BTreeMap;
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use rayon::prelude::*;

use super::{Origin, Preset, preset_files};
use crate::color::{Rgb, RgbSpace};
use crate::file::FileError;

/// What a list shows of a preset; the file has the rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Shelved {
    /// Its name.
    pub name: String,
    /// Its tags.
    pub tags: Vec<String>,
    /// The space of r and h.
    pub space: RgbSpace,
    /// Reflectance facing the surface.
    pub r: Rgb,
    /// Reflectance at 81.8°.
    pub h: Rgb,
    /// Perceptual roughness.
    pub roughness: f64,
    /// One word for where r and h come from.
    pub origin: &'static str,
    /// What is searched, in lower case.
    words: String,
}

impl Shelved {
    fn of(preset: Preset) -> Self {
        let origin = match preset.origin {
            Origin::Authored => "authored",
            Origin::Measured { .. } => "measured",
            Origin::Matched(_) => "matched",
            Origin::Edited { .. } => "edited",
        };
        let words = format!("{}\n{}\n{origin}\n{}", preset.name, preset.tags.join("\n"), preset.notes).to_lowercase();
        let Preset { name, tags, space, r, h, roughness, .. } = preset;
        Self { name, tags, space, r, h, roughness, origin, words }
    }

    /// Whether every word of a search is in the name, the tags, the notes or the origin. `tag:steel` looks for a whole
    /// tag. Case does not matter.
    pub fn matches(&self, search: &str) -> bool {
        search.split_whitespace().all(|word| match word.strip_prefix("tag:") {
            Some(tag) => self.tags.iter().any(|own| own.to_lowercase() == tag.to_lowercase()),
            None => self.words.contains(&word.to_lowercase()),
        })
    }
}

/// A file of the folder: a preset, or why it is none.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Where it is.
    pub path: PathBuf,
    /// The preset, or a sentence.
    pub preset: Result<Shelved, String>,
    stamp: Stamp,
}

/// A file that has the same has not been written since.
type Stamp = (Option<SystemTime>, u64);

/// The presets of a folder and of the folders in it, by path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shelf {
    items: Vec<Arc<Item>>,
}

impl Shelf {
    /// The files, by path.
    pub fn items(&self) -> &[Arc<Item>] {
        &self.items
    }

    /// The tags there are, with the number of presets that have each, by name.
    pub fn tags(&self) -> BTreeMap<String, usize> {
        let mut tags = BTreeMap::new();
        let of = |item: &Arc<Item>| item.preset.as_ref().map(|preset| preset.tags.clone()).unwrap_or_default();
        self.items.iter().flat_map(of).for_each(|tag| *tags.entry(tag).or_default() += 1);
        tags
    }

    /// True where no file was read anew, left or came since `earlier`, of which this was refreshed.
    pub fn is_as(&self, earlier: &Self) -> bool {
        self.items.len() == earlier.items.len()
            && self.items.iter().zip(&earlier.items).all(|(ours, theirs)| Arc::ptr_eq(ours, theirs))
    }

    /// The folder as it is now. Files that have not been written since `self` was read are not read again.
    ///
    /// `progress` is told the share that is done; where it breaks, the result is as it was before.
    pub fn refreshed(
        &self,
        folder: &Path,
        progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
    ) -> Result<Self, FileError> {
        let paths = preset_files(folder)?;
        let known: BTreeMap<&Path, &Arc<Item>> = self.items.iter().map(|item| (item.path.as_path(), item)).collect();
        let mut items = Vec::with_capacity(paths.len());
        for some in paths.chunks(CHUNK) {
            if progress(items.len() as f32 / paths.len() as f32).is_break() {
                return Ok(self.clone());
            }
            let read: Vec<Arc<Item>> = some.par_iter().map(|path| item(path, known.get(path.as_path()))).collect();
            items.extend(read);
        }
        Ok(Self { items })
    }
}

/// Files between two reports.
const CHUNK: usize = 256;

fn item(path: &Path, known: Option<&&Arc<Item>>) -> Arc<Item> {
    let stamp = fs::metadata(path).map(|data| (data.modified().ok(), data.len())).unwrap_or_default();
    if let Some(known) = known.filter(|known| known.stamp == stamp && stamp.0.is_some()) {
        return Arc::clone(known);
    }
    let preset = Preset::load(path).map(|loaded| Shelved::of(loaded.preset)).map_err(|error| error.to_string());
    Arc::new(Item { path: path.to_owned(), preset, stamp })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn save(folder: &Path, file: &str, name: &str, tags: &[&str]) {
        let tags = tags.iter().map(|tag| (*tag).to_owned()).collect();
        Preset { name: name.to_owned(), tags, ..Preset::new_authored() }.save(&folder.join(file)).unwrap();
    }

    fn refreshed(shelf: &Shelf, folder: &Path) -> Shelf {
        shelf.refreshed(folder, &|_| ControlFlow::Continue(())).unwrap()
    }

    #[test]
    fn follows_what_others_do_to_the_files() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        save(folder, "a.json", "Steel", &["Hull"]);
        save(folder, "b.json", "Brass", &[]);
        fs::write(folder.join("c.json"), "{}").unwrap();
        let first = refreshed(&Shelf::default(), folder);
        let names = |shelf: &Shelf| -> Vec<String> {
            shelf.items().iter().map(|item| item.preset.as_ref().map_or("?".into(), |p| p.name.clone())).collect()
        };
        assert_eq!(names(&first), ["Steel", "Brass", "?"]);
        assert!(first.items()[2].preset.as_ref().unwrap_err().contains("c.json"));
        assert!(refreshed(&first, folder).is_as(&first), "nothing was read again");
        save(folder, "b.json", "Red brass", &["hull", "Pipe"]);
        fs::remove_file(folder.join("a.json")).unwrap();
        fs::create_dir(folder.join("new")).unwrap();
        save(folder, "new/d.json", "Tin", &["Pipe"]);
        let second = refreshed(&first, folder);
        assert_eq!(names(&second), ["Red brass", "?", "Tin"]);
        assert!(!second.is_as(&first));
        assert_eq!(second.tags().into_iter().collect::<Vec<_>>(), [("Pipe".to_owned(), 2), ("hull".to_owned(), 1)]);
        let stopped = second.refreshed(folder, &|_| ControlFlow::Break(())).unwrap();
        assert_eq!(stopped, second);
        assert!(second.refreshed(&folder.join("gone"), &|_| ControlFlow::Continue(())).is_err());
    }

    #[test]
    fn a_search_is_words_and_whole_tags() {
        let tags = vec!["Ship hull".to_owned(), "Steel".to_owned()];
        let preset =
            Preset { name: "Rusty Plate".to_owned(), tags, notes: "from Kiel".to_owned(), ..Preset::new_authored() };
        let shelved = Shelved::of(preset);
        for search in
            ["", "  ", "rust", "PLATE rusty", "hull plate", "tag:steel", "tag:STEEL plate", "kiel", "authored"]
        {
            assert!(shelved.matches(search), "{search}");
        }
        for search in ["gold", "rust gold", "tag:stee", "tag:hull", "measured"] {
            assert!(!shelved.matches(search), "{search}");
        }
    }
}
