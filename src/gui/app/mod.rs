//! The frame: poll jobs, show panels, apply what was asked, feed the history.

mod actions;
mod exporting;
mod files;
mod layout;
mod planning;
mod questions;
mod settings;
mod unsaved;

use std::path::PathBuf;

use eframe::egui::{Context, Ui};

use super::command::{Action, Command};
use super::export::{Asked, ExportDialog, Failure, Writing};
use super::file_dialog::FileDialog;
use super::history::STABLE_SECONDS;
use super::job::Job;
use super::photograph::{Reading, Session, Source};
use super::prompt::Prompt;
use super::recovery::{LeftBehind, Recovery};
use super::settings::SettingsFile;
use super::state::{NoticeKind, Page, State};
use super::theme;
use crate::import::Imported;
use crate::metal::{Metal, metal_by_name};
use crate::preset::Preset;
use crate::sample::Sample;
use files::{LoadedPreset, Saving, SavingSheet, SheetSaved};

/// The window.
pub struct App {
    state: State,
    prompt: Option<Prompt>,
    dialog: Option<FileDialog>,
    loading: Option<Job<PathBuf, Result<LoadedPreset, String>>>,
    adding: Option<Job<PathBuf, Result<Metal, String>>>,
    reading: Option<Reading>,
    saving: Option<Job<Saving, Result<(), String>>>,
    importing: Option<Job<PathBuf, Result<Imported, String>>>,
    export: Option<ExportDialog>,
    /// What the system's dialog is asked to find a place for.
    choosing: Option<Asked>,
    writing: Option<Job<Writing, Result<String, Failure>>>,
    saving_sheet: Option<Job<SavingSheet, SheetSaved>>,
    /// What was asked before the preset had to be saved.
    after_saving: Option<Action>,
    may_close: bool,
    recovery: Option<Recovery>,
    settings: Option<SettingsFile>,
    left_behind: Vec<LeftBehind>,
}

impl App {
    /// A window on a new preset, or on the file at `path`.
    pub fn new(ctx: &Context, path: Option<PathBuf>) -> Self {
        theme::install(ctx);
        let mut app = Self {
            state: State::new(Preset::new_authored()),
            prompt: None,
            dialog: None,
            loading: None,
            adding: None,
            reading: None,
            saving: None,
            importing: None,
            export: None,
            choosing: None,
            writing: None,
            saving_sheet: None,
            after_saving: None,
            may_close: false,
            recovery: None,
            settings: None,
            left_behind: Vec::new(),
        };
        app.state.view.metal = metal_by_name("gold").ok();
        if let Some(path) = path {
            app.load(ctx, path);
        }
        app
    }

    /// Opens a photograph that ships with the program, with its marks.
    pub fn open_sample(&mut self, ctx: &Context, sample: &'static Sample) {
        self.read(ctx, Source::Sample(sample));
    }

    /// What the window shows.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// True while a job is at work.
    pub fn is_busy(&self) -> bool {
        let state = &self.state;
        [
            self.loading.is_some(),
            self.reading.is_some(),
            self.adding.is_some(),
            self.saving.is_some(),
            self.saving_sheet.is_some(),
            self.importing.is_some(),
            self.writing.is_some(),
            self.dialog.is_some(),
            self.recovery.as_ref().is_some_and(Recovery::is_busy),
            self.settings.as_ref().is_some_and(SettingsFile::is_busy),
            self.export.as_ref().is_some_and(ExportDialog::is_busy),
            state.photograph.as_ref().is_some_and(Session::is_busy),
            state.spheres.is_busy(),
            state.comparisons.is_busy(),
            state.metals.is_busy(),
            state.demonstrations.is_writing(),
            state.page == Page::Demonstrations && state.demonstrations.is_computing(),
            state.page == Page::Library && state.library.is_busy(),
            state.planner.is_at_files(),
            state.page == Page::Planner && state.planner.is_computing(),
            state.is_refining(),
        ]
        .contains(&true)
    }

    /// The job, or a notice that the system gives no thread.
    fn started<T>(&mut self, job: std::io::Result<T>) -> Option<T> {
        job.inspect_err(|error| self.state.notify(NoticeKind::Error, format!("no thread could be started: {error}")))
            .ok()
    }

    fn poll(&mut self, ctx: &Context) {
        self.poll_dialog(ctx);
        self.poll_loading();
        self.poll_reading(ctx);
        self.poll_adding();
        self.state.planner.poll();
        for failure in self.state.demonstrations.poll_exports() {
            self.state.notify(NoticeKind::Error, failure);
        }
        self.poll_importing(ctx);
        self.poll_writing();
        self.poll_sheet();
        self.poll_saving(ctx);
    }

    /// Solves the photograph when its marks have moved, and lets the preset follow.
    fn follow_photograph(&mut self, ctx: &Context) {
        let Some(session) = &mut self.state.photograph else { return };
        let preset = &mut self.state.document.preset;
        session.outline(ctx);
        if let Some(found) = session.solve(ctx, preset.space).filter(|_| session.is_followed) {
            session.apply(&found, preset);
        }
        session.compare(ctx);
    }

    fn feed_history(&mut self, ctx: &Context) {
        let (time, is_pointer_down) = ctx.input(|input| (input.time, input.pointer.any_down()));
        // A match on its way still belongs to the step that asked for it.
        let is_solving =
            self.state.photograph.as_ref().is_some_and(|session| session.is_followed && session.is_settling());
        let document = &mut self.state.document;
        document.history.feed(time, is_pointer_down || is_solving, &document.preset);
        if document.history.is_waiting() {
            ctx.request_repaint_after_secs(STABLE_SECONDS);
        } else if !is_pointer_down {
            self.keep_unsaved_work(ctx);
        }
        if !is_pointer_down {
            self.keep_settings(ctx);
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        self.poll(&ctx);
        self.follow_photograph(&ctx);
        let mut actions = Vec::new();
        self.open_dropped_files(&ctx, &mut actions);
        if self.prompt.is_none() && self.export.is_none() {
            actions.extend(Command::pressed(&ctx).map(Action::from));
        }
        self.panels(ui, &mut actions);
        self.export_dialog(ui);
        self.answer_prompt(ui);
        self.guard_closing(&ctx);
        let page = self.state.page;
        for action in actions {
            self.perform(&ctx, action);
        }
        if self.state.page != page {
            self.state.planner.said = None;
        }
        self.feed_history(&ctx);
    }

    fn on_exit(&mut self, _gl: Option<&eframe::glow::Context>) {
        if let Some(recovery) = &self.recovery {
            recovery.finish();
        }
        if let Some(settings) = &self.settings {
            settings.finish();
        }
    }
}

impl std::fmt::Debug for App {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("App").field("state", &self.state).finish_non_exhaustive()
    }
}
