//! What the window asks a person: places for files, by the system's dialog or a typed path, and prompts.

use eframe::egui::{Context, Ui, ViewportCommand};

use super::App;
use super::files::figure_theme;
use crate::gui::command::{Action, Command};
use crate::gui::file_dialog::{FileDialog, Outcome, Purpose};
use crate::gui::prompt::{Answer, Prompt};
use crate::gui::sheet::Sheet;

impl App {
    pub(super) fn ask_system(&mut self, ctx: &Context, purpose: Purpose) {
        match FileDialog::open(ctx, purpose, &self.file_name(ctx, purpose)) {
            Ok(dialog) => self.dialog = Some(dialog),
            Err(_) => self.ask_path(ctx, purpose, Some(NO_DIALOG)),
        }
    }

    /// A name for a file that is saved for the first time.
    pub(super) fn file_name(&self, ctx: &Context, purpose: Purpose) -> String {
        match purpose {
            Purpose::SavePiece(piece) => self.state.demonstrations.exhibit(self.state.open()).file_name(piece),
            Purpose::Plan(file) => file.file_name().unwrap_or_default().to_owned(),
            Purpose::SaveSheet(kind) => Sheet::of(&self.state.metals, kind, figure_theme(ctx)).file_name(),
            _ => format!("{}.json", self.state.document.preset.file_stem()),
        }
    }

    pub(super) fn ask_path(&mut self, ctx: &Context, purpose: Purpose, reason: Option<&'static str>) {
        let text = match (purpose, self.state.document.file()) {
            (Purpose::Save, Some(path)) => path.display().to_string(),
            (Purpose::Save | Purpose::SavePiece(_) | Purpose::Plan(_) | Purpose::SaveSheet(_), _) => {
                self.file_name(ctx, purpose)
            }
            (Purpose::Open | Purpose::Import | Purpose::Library | Purpose::Export(_), _) => String::new(),
        };
        self.prompt = Some(Prompt::Path { purpose, text, reason });
    }

    pub(super) fn poll_dialog(&mut self, ctx: &Context) {
        let Some((purpose, outcome)) = self.dialog.as_ref().and_then(|d| Some((d.purpose(), d.poll()?))) else {
            return;
        };
        self.dialog = None;
        if matches!(purpose, Purpose::Export(_)) {
            return self.chosen_for_export(ctx, outcome);
        }
        match outcome {
            Outcome::Picked(path) => match purpose {
                Purpose::Open => self.perform(ctx, Action::Load(path)),
                Purpose::Save => self.save(ctx, path),
                Purpose::SavePiece(piece) => self.save_piece(ctx, piece, path),
                Purpose::Plan(file) => self.state.planner.take(ctx, file, path),
                Purpose::Library => self.apply(ctx, Action::OpenLibrary(path)),
                Purpose::Import => self.import(ctx, path),
                Purpose::Export(_) => {}
                Purpose::SaveSheet(kind) => self.save_sheet(ctx, kind, path),
            },
            Outcome::Cancelled => self.after_saving = None,
            Outcome::NoService => self.ask_path(ctx, purpose, Some(NO_DIALOG)),
        }
    }

    pub(super) fn waiting_for_dialog(&mut self, ui: &mut Ui) {
        let Some(purpose) = self.dialog.as_ref().map(FileDialog::purpose) else { return };
        ui.horizontal(|ui| {
            ui.label("Waiting for the system's file dialog");
            if ui.button("Type a path instead").clicked() {
                self.dialog = None;
                self.ask_path(ui.ctx(), purpose, None);
            }
            if ui.button("Stop waiting").clicked() {
                self.dialog = None;
                self.after_saving = None;
            }
        });
    }

    /// Asks about one thing left behind at a time.
    pub(super) fn ask_about_left_behind(&mut self) {
        if self.prompt.is_none() {
            self.prompt = self.left_behind.pop().map(|left| Prompt::LeftBehind(Box::new(left)));
        }
    }

    pub(super) fn answer_prompt(&mut self, ui: &Ui) {
        self.ask_about_left_behind();
        let Some(prompt) = &mut self.prompt else { return };
        let answer = prompt.show(ui, &self.state);
        if !matches!(answer, Answer::None) {
            self.prompt = None;
        }
        match answer {
            Answer::None => {}
            Answer::Cancel => self.after_saving = None,
            Answer::Ask(prompt) => self.prompt = Some(prompt),
            Answer::Do(action) => self.perform(ui.ctx(), action),
            Answer::Discard(action) => self.apply(ui.ctx(), action),
            Answer::SaveThen(action) => {
                self.after_saving = Some(action);
                self.run(ui.ctx(), Command::Save);
            }
        }
    }

    /// A window that is closed with unsaved changes asks first.
    pub(super) fn guard_closing(&mut self, ctx: &Context) {
        let is_closing = ctx.input(|input| input.viewport().close_requested());
        if is_closing && !self.may_close && self.state.document.is_changed() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.prompt = Some(Prompt::Unsaved(Command::Quit.into()));
        }
    }
}

pub(super) const NO_DIALOG: &str = "There is no file dialog service on this system. Type the path instead.";
