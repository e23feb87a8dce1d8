//! What a person chose about the window, from the last window and for the next.

use std::path::PathBuf;

use eframe::egui::Context;

use super::App;
use crate::gui::settings::{Settings, SettingsFile};
use crate::gui::state::NoticeKind;

impl App {
    /// Takes the settings of a file, and keeps them there from now on.
    pub fn keep_settings_in(&mut self, ctx: &Context, path: PathBuf) {
        match SettingsFile::open(path) {
            Ok((file, settings)) => {
                self.settings = Some(file);
                if let Some(settings) = settings {
                    ctx.set_theme(settings.theme);
                    ctx.set_zoom_factor(settings.zoom);
                    self.state.view.preview_ms = settings.preview_ms;
                }
            }
            Err(sentence) => {
                let sentence = format!("{sentence}; the file is left as it is, and what is chosen now is not kept");
                self.state.notify(NoticeKind::Warning, sentence);
            }
        }
    }

    pub(super) fn keep_settings(&mut self, ctx: &Context) {
        let settings = Settings::of(ctx, self.state.view.preview_ms);
        let failure = self.settings.as_mut().and_then(|file| file.keep(ctx, settings));
        if let Some(sentence) = failure {
            self.state.notify(NoticeKind::Warning, format!("settings could not be kept: {sentence}"));
        }
    }
}
