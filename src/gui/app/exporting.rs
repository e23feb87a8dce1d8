//! The export dialog and the files it writes.

use eframe::egui::{Context, Ui};

use super::App;
use super::files::lost;
use super::questions::NO_DIALOG;
use crate::gui::command::Action;
use crate::gui::export::{Answer as ExportAnswer, Failure, Writing, write};
use crate::gui::file_dialog::{FileDialog, Outcome, Purpose};
use crate::gui::job::{Job, Poll};
use crate::gui::prompt::Prompt;
use crate::gui::state::NoticeKind;

impl App {
    pub(super) fn write(&mut self, ctx: &Context, writing: Writing) {
        let job = Job::start(ctx, "export", writing, |writing, _| write(&writing));
        self.writing = self.started(job);
    }

    pub(super) fn poll_writing(&mut self) {
        let Some(job) = self.writing.take() else { return };
        let status = match job.poll() {
            Poll::Working => {
                self.writing = Some(job);
                return;
            }
            Poll::Done(Ok(done)) => Ok(done),
            Poll::Done(Err(Failure::Exists(path))) => {
                let writing = Writing { path: path.clone(), may_replace: true, ..job.input.clone() };
                self.prompt = Some(Prompt::Replace { path, then: Box::new(Action::Write(Box::new(writing))) });
                return;
            }
            Poll::Done(Err(Failure::Other(error))) => Err(error),
            Poll::Lost => Err(lost("exporting", &job.input.path)),
        };
        match (&mut self.export, status) {
            (Some(dialog), status) => dialog.say(status),
            (None, Err(error)) => self.state.notify(NoticeKind::Error, error),
            (None, Ok(_)) => {}
        }
    }

    /// Shows the dialog of an export, if it is open.
    pub(super) fn export_dialog(&mut self, ui: &Ui) {
        let is_waiting = self.dialog.is_some();
        let Some(dialog) = &mut self.export else { return };
        match dialog.show(ui, &self.state.document.preset, is_waiting) {
            ExportAnswer::None => {}
            ExportAnswer::Close => {
                (self.export, self.choosing) = (None, None);
                self.dialog.take_if(|dialog| matches!(dialog.purpose(), Purpose::Export(_)));
            }
            ExportAnswer::Copy(text) => {
                ui.ctx().copy_text(text);
                dialog.say(Ok("Copied".to_owned()));
            }
            ExportAnswer::StopWaiting => self.dialog = None,
            ExportAnswer::Write(asked, path) => {
                self.write(ui.ctx(), Writing { asked, path, may_replace: false });
            }
            ExportAnswer::Choose(asked, file_name) => {
                match FileDialog::open(ui.ctx(), Purpose::Export(asked.target), &file_name) {
                    Ok(system) => (self.dialog, self.choosing) = (Some(system), Some(asked)),
                    Err(_) => dialog.say(Err(NO_DIALOG.to_owned())),
                }
            }
        }
    }

    /// The system's dialog has found a place for an export, or none.
    pub(super) fn chosen_for_export(&mut self, ctx: &Context, outcome: Outcome) {
        let asked = self.choosing.take();
        match (outcome, asked, &mut self.export) {
            (Outcome::Picked(path), Some(asked), _) => {
                self.write(ctx, Writing { asked, path, may_replace: false });
            }
            (Outcome::NoService, _, Some(dialog)) => dialog.say(Err(NO_DIALOG.to_owned())),
            _ => {}
        }
    }
}
