//! Unsaved work, kept while a person edits.

use std::path::Path;

use eframe::egui::Context;

use super::App;
use crate::gui::recovery::Recovery;
use crate::gui::state::NoticeKind;

impl App {
    /// Keeps unsaved work in a folder from now on, and asks about what an earlier window left there.
    pub fn keep_unsaved_work_in(&mut self, folder: &Path) {
        match Recovery::start(folder) {
            Ok(recovery) => {
                self.left_behind = recovery.left_behind();
                self.recovery = Some(recovery);
            }
            Err(error) => {
                let sentence = format!("{}: unsaved work cannot be kept there: {error}", folder.display());
                self.state.notify(NoticeKind::Warning, sentence);
            }
        }
    }

    pub(super) fn keep_unsaved_work(&mut self, ctx: &Context) {
        let failure = self.recovery.as_mut().and_then(|recovery| recovery.keep(ctx, &self.state.document));
        if let Some(sentence) = failure {
            self.state.notify(NoticeKind::Warning, format!("unsaved work could not be kept: {sentence}"));
        }
    }

    pub(super) fn warn_of(&mut self, path: &Path, outcome: std::io::Result<()>) {
        if let Err(error) = outcome {
            self.state.notify(NoticeKind::Warning, format!("{}: {error}", path.display()));
        }
    }
}
