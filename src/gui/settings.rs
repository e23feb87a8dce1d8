//! What a person chose about the window itself, kept from one window to the next.

use std::path::{Path, PathBuf};

use eframe::egui::{Context, ThemePreference};
use serde::{Deserialize, Serialize};

use super::job::Follower;
use crate::file::{FileError, FileProblem, read_text, replace_file};

/// The choices that outlive a window.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Settings {
    /// Format of the file.
    edgewise_settings: u32,
    /// Milliseconds that a preview may take while something moves.
    pub preview_ms: f64,
    /// Dark, light, or as the system says.
    pub theme: ThemePreference,
    /// How large everything is; 1 as designed.
    pub zoom: f32,
}

/// The format that this program reads and writes.
const FORMAT: u32 = 1;

/// Budgets of a preview that can be chosen, in milliseconds.
pub(crate) const BUDGETS_MS: std::ops::RangeInclusive<f64> = 1.0..=200.0;

impl Settings {
    /// What the window has now.
    pub(crate) fn of(ctx: &Context, preview_ms: f64) -> Self {
        let theme = ctx.options(|options| options.theme_preference);
        Self { edgewise_settings: FORMAT, preview_ms, theme, zoom: ctx.zoom_factor() }
    }

    /// Reads a file; `None` where there is none yet, a sentence where it cannot be used.
    fn read(path: &Path) -> Result<Option<Self>, String> {
        let text = match read_text(path) {
            Ok(text) => text,
            Err(FileError { problem: FileProblem::NotFound, .. }) => return Ok(None),
            Err(error) => return Err(error.to_string()),
        };
        let settings: Self = serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))?;
        let is_usable = settings.edgewise_settings == FORMAT
            && BUDGETS_MS.contains(&settings.preview_ms)
            && (0.2..=5.0).contains(&settings.zoom);
        let unusable = || format!("{}: not settings that this version can use", path.display());
        if is_usable { Ok(Some(settings)) } else { Err(unusable()) }
    }
}

/// The file of the settings, written as they change.
pub(crate) struct SettingsFile {
    path: PathBuf,
    /// What the file holds, or what the window started with.
    written: Option<Settings>,
    /// What the window had last.
    newest: Option<Settings>,
    writing: Follower<Settings, Result<(), String>>,
}

impl SettingsFile {
    /// The file at `path` and what it holds. A file that cannot be used is left as it is, and nothing is kept.
    pub(crate) fn open(path: PathBuf) -> Result<(Self, Option<Settings>), String> {
        let settings = Settings::read(&path)?;
        Ok((Self { path, written: settings, newest: settings, writing: Follower::default() }, settings))
    }

    /// Writes the settings where they have changed; gives a sentence when that failed.
    pub(crate) fn keep(&mut self, ctx: &Context, settings: Settings) -> Option<String> {
        // What a window starts with needs no file.
        let known = *self.written.get_or_insert(settings);
        self.newest = Some(settings);
        if known == settings && !self.writing.is_busy() {
            return None;
        }
        let path = self.path.clone();
        let write = move |settings: Settings, _: &_| write(&path, &settings);
        let (settings, outcome) = self.writing.follow(ctx, "keep settings", settings, write)?;
        self.written = Some(settings);
        outcome.err()
    }

    /// Writes what has not been written, before the window is gone.
    pub(crate) fn finish(&self) {
        if let Some(settings) = self.newest.filter(|newest| self.written != Some(*newest))
            && let Err(error) = write(&self.path, &settings)
        {
            log::warn!("settings could not be kept: {error}");
        }
    }

    /// True while the file is being written.
    pub(crate) fn is_busy(&self) -> bool {
        self.writing.is_busy()
    }
}

fn write(path: &Path, settings: &Settings) -> Result<(), String> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    let text = serde_json::to_string_pretty(settings).map_err(|error| error.to_string())?;
    replace_file(path, text.as_bytes()).map_err(|error| error.to_string())
}

/// Where this system keeps what a person has chosen, if it says so.
pub(crate) fn path() -> Option<PathBuf> {
    Some(dirs::config_dir()?.join("edgewise").join("settings.json"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_change_is_there_even_where_nobody_waited_for_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("settings.json");
        let (mut file, before) = SettingsFile::open(path.clone()).unwrap();
        assert_eq!(before, None);
        let ctx = Context::default();
        let settings = |preview_ms| Settings { preview_ms, ..Settings::of(&ctx, 16.0) };
        assert_eq!(file.keep(&ctx, settings(16.0)), None);
        file.finish();
        assert!(!path.exists(), "what a window starts with needs no file");
        for preview_ms in [17.0, 18.0, 19.0] {
            assert_eq!(file.keep(&ctx, settings(preview_ms)), None);
        }
        while file.is_busy() {
            let _ = file.keep(&ctx, settings(19.0));
        }
        let _ = file.keep(&ctx, settings(20.0));
        file.finish();
        assert_eq!(Settings::read(&path), Ok(Some(settings(20.0))));
    }
}
