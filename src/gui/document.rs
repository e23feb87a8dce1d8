//! The preset that is being authored, its file, and its history.

use std::path::{Path, PathBuf};

use super::history::History;
use crate::color::RgbSpace;
use crate::preset::Preset;

/// The open preset.
#[derive(Debug)]
pub struct Document {
    /// What is being authored.
    pub preset: Preset,
    file: Option<PathBuf>,
    /// The preset that there would be nothing to lose of.
    unchanged: Option<Preset>,
    pub(crate) history: History,
}

impl Document {
    /// A document that has just been made or read; `file` is where it came from.
    pub(crate) fn new(preset: Preset, file: Option<PathBuf>) -> Self {
        let mut history = History::default();
        history.restart(&preset);
        Self { unchanged: Some(preset.clone()), preset, file, history }
    }

    /// Work that was never saved: there is something to lose from the start.
    pub(crate) fn unsaved(preset: Preset) -> Self {
        Self { unchanged: None, ..Self::new(preset, None) }
    }

    /// The file it was read from or last saved to.
    pub fn file(&self) -> Option<&Path> {
        self.file.as_deref()
    }

    /// True when there is something to lose.
    pub fn is_changed(&self) -> bool {
        self.unchanged.as_ref() != Some(&self.preset)
    }

    /// Remembers that `saved` now stands in `file`; the preset may have moved on meanwhile.
    pub(crate) fn was_saved(&mut self, saved: Preset, file: PathBuf) {
        self.unchanged = Some(saved);
        self.file = Some(file);
    }

    pub(crate) fn can_undo(&self) -> bool {
        self.history.can_undo(&self.preset)
    }

    pub(crate) fn can_redo(&self) -> bool {
        self.history.can_redo(&self.preset)
    }

    pub(crate) fn undo(&mut self) {
        self.history.undo(&mut self.preset);
    }

    pub(crate) fn redo(&mut self) {
        self.history.redo(&mut self.preset);
    }

    /// The space all its numbers are in.
    pub fn space(&self) -> RgbSpace {
        self.preset.space
    }

    /// What the title bar and the status bar call it.
    pub(crate) fn title(&self) -> String {
        match self.file.as_deref().and_then(Path::file_name) {
            Some(name) => name.to_string_lossy().into_owned(),
            None => format!("{} (not saved yet)", self.preset.name),
        }
    }
}
