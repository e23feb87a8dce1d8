//! The frame: poll jobs, show panels, apply what was asked, feed the history.

use std::path::{Path, PathBuf};

use eframe::egui::{
    CentralPanel, Context, Frame, Margin, Panel, Theme, ThemePreference, Ui, ViewportCommand, gui_zoom,
};

use super::command::{Action, Command};
use super::copying::CopyForm;
use super::demonstrations::Piece;
use super::document::Document;
use super::export::{Answer as ExportAnswer, Asked, ExportDialog, Failure, Writing, write};
use super::file_dialog::{FileDialog, Outcome, Purpose};
use super::history::STABLE_SECONDS;
use super::job::{Job, Poll};
use super::photograph::{Loaded, Session, Source};
use super::prompt::{Among, Answer, Prompt};
use super::recovery::{LeftBehind, Recovery};
use super::sheet::{Sheet, SheetKind};
use super::state::{NoticeKind, Page, State};
use super::{panels, theme};
use crate::figure::FigureTheme;
use crate::import::{Imported, import_file};
use crate::metal::{Metal, metal_by_name};
use crate::preset::Preset;
use crate::sample::Sample;

/// The window.
pub struct App {
    state: State,
    prompt: Option<Prompt>,
    dialog: Option<FileDialog>,
    loading: Option<Job<PathBuf, Result<LoadedPreset, String>>>,
    adding: Option<Job<PathBuf, Result<Metal, String>>>,
    reading: Option<Job<Source, Result<Loaded, String>>>,
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
    left_behind: Vec<LeftBehind>,
}

type LoadedPreset = (Preset, Vec<String>);

#[derive(Clone)]
struct Saving {
    preset: Preset,
    path: PathBuf,
}

#[derive(Clone)]
struct SavingSheet {
    sheet: Sheet,
    path: PathBuf,
}

/// What a person should know about a file that was written, or why there is none.
type SheetSaved = Result<Option<String>, String>;

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

    /// What the window shows.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// True while a job is at work.
    pub fn is_busy(&self) -> bool {
        let is_photograph_busy = self.state.photograph.as_ref().is_some_and(Session::is_busy);
        let has_jobs =
            self.loading.is_some() || self.reading.is_some() || self.adding.is_some() || self.saving.is_some();
        let has_jobs = has_jobs || self.saving_sheet.is_some();
        has_jobs
            || self.recovery.as_ref().is_some_and(Recovery::is_busy)
            || self.importing.is_some()
            || self.writing.is_some()
            || self.export.as_ref().is_some_and(ExportDialog::is_busy)
            || self.dialog.is_some()
            || is_photograph_busy
            || self.state.spheres.is_busy()
            || self.state.comparisons.is_busy()
            || self.state.metals.is_busy()
            || self.state.demonstrations.is_busy()
            || (self.state.page == Page::Library && self.state.library.is_busy())
    }

    fn perform(&mut self, ctx: &Context, action: Action) {
        if self.state.document.is_changed() && loses_changes(&action) {
            self.prompt = Some(Prompt::Unsaved(action));
        } else {
            self.apply(ctx, action);
        }
    }

    /// Does what was asked, whatever is lost.
    fn apply(&mut self, ctx: &Context, action: Action) {
        match action {
            Action::Run(command) => self.run(ctx, command),
            Action::Load(path) => self.load(ctx, path),
            Action::OpenSample(sample) => self.read(ctx, Source::Sample(sample)),
            Action::StopReading => self.reading = None,
            Action::ClosePhotograph => self.state.photograph = None,
            Action::SaveTo(path) => self.save(ctx, path),
            Action::OpenLibrary(folder) => {
                self.state.library.open(folder);
                self.state.page = Page::Library;
            }
            Action::Import(path) => self.import(ctx, path),
            Action::Write(writing) => self.write(ctx, *writing),
            Action::StartWith(preset) => self.start_with(*preset),
            Action::StartFrom(metal) => {
                self.start_with(Preset::from_metal(metal, self.state.document.space()));
                self.state.view.metal = Some(metal);
            }
            Action::AddMetal(path) => self.add_metal(ctx, path),
            Action::ChooseReferenceMetal => self.prompt = Some(Prompt::find(Among::ReferenceMetals)),
            Action::SetReferenceMetal(metal) => {
                if let Some(session) = &mut self.state.photograph {
                    session.set_reference_metal(metal);
                }
            }
            Action::SaveSheet(kind) => self.ask_system(ctx, Purpose::SaveSheet(kind)),
            Action::SaveSheetTo(kind, path) => self.save_sheet(ctx, kind, path),
            Action::CompareWith(metal) => {
                self.state.view.metal = Some(metal);
                self.state.page = Page::Author;
            }
            Action::Recover(left) => {
                self.state.document = Document::unsaved(left.preset.clone());
                let outcome = self.recovery.as_mut().map_or(Ok(()), |recovery| recovery.adopt(&left));
                self.warn_of(&left.copy, outcome);
            }
            Action::Forget(left) => self.warn_of(&left.copy, left.forget()),
            Action::FindMaterial(slot) => self.prompt = Some(Prompt::find(Among::Materials(slot))),
            Action::Demonstrate(slot, choice) => self.state.demonstrations.choose(slot, choice),
            Action::SavePiece(piece) => self.ask_system(ctx, Purpose::SavePiece(piece)),
            Action::SavePieceTo(piece, path) => self.save_piece(ctx, piece, path),
        }
    }

    fn save_piece(&mut self, ctx: &Context, piece: Piece, path: PathBuf) {
        let exhibit = self.state.demonstrations.exhibit(self.state.open());
        if let Err(error) = self.state.demonstrations.export(ctx, exhibit, piece, path) {
            self.state.notify(NoticeKind::Error, format!("no thread could be started: {error}"));
        }
    }

    /// Another preset, not in a file yet: the photograph that is open says nothing about it.
    fn start_with(&mut self, preset: Preset) {
        self.state.document = Document::new(preset, None);
        self.state.page = Page::Author;
        if let Some(session) = &mut self.state.photograph {
            session.is_followed = false;
        }
    }

    fn run(&mut self, ctx: &Context, command: Command) {
        match command {
            Command::New => self.state.document = Document::new(Preset::new_authored(), None),
            Command::Open => self.ask_system(ctx, Purpose::Open),
            Command::OpenPath => self.ask_path(ctx, Purpose::Open, None),
            Command::OpenSample => self.prompt = Some(Prompt::find(Among::Samples)),
            Command::OpenLibrary => self.ask_system(ctx, Purpose::Library),
            Command::NewFromMetal => self.prompt = Some(Prompt::find(Among::MetalsToStartFrom)),
            Command::Save => match self.state.document.file().map(Path::to_owned) {
                Some(path) => self.save(ctx, path),
                None => self.ask_system(ctx, Purpose::Save),
            },
            Command::SaveAs => self.ask_system(ctx, Purpose::Save),
            Command::SavePath => self.ask_path(ctx, Purpose::Save, None),
            Command::Import => self.ask_system(ctx, Purpose::Import),
            Command::Export => {
                let folder = self.state.document.file().and_then(Path::parent).map(Path::to_owned);
                self.export = Some(ExportDialog::new(self.state.document.space(), folder));
            }
            Command::Quit => {
                self.may_close = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
            Command::Undo => {
                self.state.document.undo();
                self.marks_from_preset();
            }
            Command::Redo => {
                self.state.document.redo();
                self.marks_from_preset();
            }
            Command::CopyR => self.copy(ctx, "r", CopyForm::Linear),
            Command::CopyRSrgb => self.copy(ctx, "r", CopyForm::Srgb),
            Command::CopyRHex => self.copy(ctx, "r", CopyForm::Hex),
            Command::CopyH => self.copy(ctx, "h", CopyForm::Linear),
            Command::CopyHSrgb => self.copy(ctx, "h", CopyForm::Srgb),
            Command::CopyHHex => self.copy(ctx, "h", CopyForm::Hex),
            Command::ShowPhotograph => self.state.page = Page::Photograph,
            Command::ShowAuthor => self.state.page = Page::Author,
            Command::ShowMetals => self.state.page = Page::Metals,
            Command::ShowDemonstrations => self.state.page = Page::Demonstrations,
            Command::ShowLibrary => self.state.page = Page::Library,
            Command::Compare => self.prompt = Some(Prompt::find(Among::MetalsToCompare)),
            Command::CompareNone => self.state.view.metal = None,
            Command::ToggleGrazing => self.state.view.is_grazing_only ^= true,
            Command::ToggleTheme => {
                let is_dark = ctx.theme() == Theme::Dark;
                ctx.set_theme(if is_dark { ThemePreference::Light } else { ThemePreference::Dark });
            }
            Command::ZoomIn => gui_zoom::zoom_in(ctx),
            Command::ZoomOut => gui_zoom::zoom_out(ctx),
            Command::ZoomReset => ctx.set_zoom_factor(1.0),
            Command::Find => self.prompt = Some(Prompt::find(Among::Commands)),
        }
    }

    /// Copies a colour of the preset; says so when the copy holds less than the colour.
    fn copy(&mut self, ctx: &Context, symbol: &str, form: CopyForm) {
        let Preset { r, h, space, .. } = self.state.document.preset;
        let colour = if symbol == "r" { r } else { h };
        ctx.copy_text(form.words(colour, space));
        if form.is_clipped(colour, space) {
            let sentence = format!("{symbol} lies outside sRGB: the nearest colour that sRGB has was copied.");
            self.state.notify(NoticeKind::Warning, sentence);
        }
    }

    /// The marks are part of what a preset was matched from, so undoing that moves them back.
    fn marks_from_preset(&mut self) {
        if let Some(session) = &mut self.state.photograph {
            session.take_marks_of(&self.state.document.preset);
        }
    }

    /// A preset that has just been opened is not solved over by a photograph it was not matched from.
    fn meet_photograph(&mut self) {
        if let Some(session) = &mut self.state.photograph
            && !session.take_marks_of(&self.state.document.preset)
        {
            session.is_followed = false;
        }
    }

    fn ask_system(&mut self, ctx: &Context, purpose: Purpose) {
        match FileDialog::open(ctx, purpose, &self.file_name(ctx, purpose)) {
            Ok(dialog) => self.dialog = Some(dialog),
            Err(_) => self.ask_path(ctx, purpose, Some(NO_DIALOG)),
        }
    }

    /// A name for a file that is saved for the first time.
    fn file_name(&self, ctx: &Context, purpose: Purpose) -> String {
        match purpose {
            Purpose::SavePiece(piece) => self.state.demonstrations.exhibit(self.state.open()).file_name(piece),
            Purpose::SaveSheet(kind) => Sheet::of(&self.state.metals, kind, figure_theme(ctx)).file_name(),
            _ => format!("{}.json", self.state.document.preset.file_stem()),
        }
    }

    fn ask_path(&mut self, ctx: &Context, purpose: Purpose, reason: Option<&'static str>) {
        let text = match (purpose, self.state.document.file()) {
            (Purpose::Save, Some(path)) => path.display().to_string(),
            (Purpose::Save | Purpose::SavePiece(_) | Purpose::SaveSheet(_), _) => self.file_name(ctx, purpose),
            (Purpose::Open | Purpose::Import | Purpose::Library | Purpose::Export(_), _) => String::new(),
        };
        self.prompt = Some(Prompt::Path { purpose, text, reason });
    }

    /// Opens a preset, or a photograph where the name is not a preset's.
    fn load(&mut self, ctx: &Context, path: PathBuf) {
        if has_extension(&path, &["csv", "yml", "yaml"]) {
            return self.add_metal(ctx, path);
        }
        if has_extension(&path, &["mtlx", "glb", "gltf", "txt", "ase", "gpl"]) {
            return self.import(ctx, path);
        }
        if !is_preset(&path) {
            return self.read(ctx, Source::File(path));
        }
        let job = Job::start(ctx, "open", path, |path, _| match Preset::load(&path) {
            Ok(loaded) => Ok((loaded.preset, loaded.warnings)),
            Err(error) => Err(error.to_string()),
        });
        self.loading = self.started(job);
    }

    fn import(&mut self, ctx: &Context, path: PathBuf) {
        let job = Job::start(ctx, "import", path, |path, _| {
            import_file(&path, None).map_err(|error| format!("{}: {error}", path.display()))
        });
        self.importing = self.started(job);
    }

    fn poll_importing(&mut self, ctx: &Context) {
        let Some(job) = self.importing.take() else { return };
        match job.poll() {
            Poll::Working => self.importing = Some(job),
            Poll::Done(Ok(imported)) => self.imported(ctx, imported),
            Poll::Done(Err(error)) => self.state.notify(NoticeKind::Error, error),
            Poll::Lost => self.state.notify(NoticeKind::Error, lost("importing", &job.input)),
        }
    }

    /// One metal becomes the preset; of several a person chooses.
    fn imported(&mut self, ctx: &Context, Imported { mut presets, notes }: Imported) {
        for note in notes.iter().take(MOST_NOTES) {
            self.state.notify(NoticeKind::Warning, note);
        }
        if notes.len() > MOST_NOTES {
            let more = notes.len() - MOST_NOTES;
            self.state.notify(NoticeKind::Warning, format!("{more} more notes; `edgewise import` prints them all"));
        }
        match presets.pop() {
            Some(only) if presets.is_empty() => self.perform(ctx, Action::StartWith(Box::new(only))),
            Some(last) => {
                presets.push(last);
                self.prompt = Some(Prompt::Imported { presets, text: String::new() });
            }
            None => {}
        }
    }

    fn write(&mut self, ctx: &Context, writing: Writing) {
        let job = Job::start(ctx, "export", writing, |writing, _| write(&writing));
        self.writing = self.started(job);
    }

    fn poll_writing(&mut self) {
        let Some(job) = self.writing.take() else { return };
        let status = match job.poll() {
            Poll::Working => {
                self.writing = Some(job);
                return;
            }
            Poll::Done(Ok(done)) => Ok(done),
            Poll::Done(Err(Failure::Exists(path))) => {
                self.prompt = Some(Prompt::Replace(Box::new(Writing { path, ..job.input.clone() })));
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
    fn export_dialog(&mut self, ui: &Ui) {
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
    fn chosen_for_export(&mut self, ctx: &Context, outcome: Outcome) {
        let asked = self.choosing.take();
        match (outcome, asked, &mut self.export) {
            (Outcome::Picked(path), Some(asked), _) => {
                self.write(ctx, Writing { asked, path, may_replace: false });
            }
            (Outcome::NoService, _, Some(dialog)) => dialog.say(Err(NO_DIALOG.to_owned())),
            _ => {}
        }
    }

    fn add_metal(&mut self, ctx: &Context, path: PathBuf) {
        let job = Job::start(ctx, "read metal", path, |path, _| Metal::open(&path).map_err(|error| error.to_string()));
        self.adding = self.started(job);
    }

    fn poll_adding(&mut self) {
        let Some(job) = self.adding.take() else { return };
        match job.poll() {
            Poll::Working => self.adding = Some(job),
            Poll::Done(Ok(metal)) => {
                self.state.metals.add(metal);
                self.state.page = Page::Metals;
            }
            Poll::Done(Err(error)) => self.state.notify(NoticeKind::Error, error),
            Poll::Lost => self.state.notify(NoticeKind::Error, lost("reading", &job.input)),
        }
    }

    fn read(&mut self, ctx: &Context, source: Source) {
        let job = Job::start(ctx, "read photograph", source, |source, progress| source.load(progress));
        self.reading = self.started(job);
    }

    fn save(&mut self, ctx: &Context, path: PathBuf) {
        let saving = Saving { preset: self.state.document.preset.clone(), path };
        let job = Job::start(ctx, "save", saving, |saving, _| {
            saving.preset.save(&saving.path).map_err(|error| error.to_string())
        });
        self.saving = self.started(job);
    }

    fn save_sheet(&mut self, ctx: &Context, kind: SheetKind, path: PathBuf) {
        let saving = SavingSheet { sheet: Sheet::of(&self.state.metals, kind, figure_theme(ctx)), path };
        let job = Job::start(ctx, "save sheet", saving, |saving, progress| saving.sheet.write(&saving.path, progress));
        self.saving_sheet = self.started(job);
    }

    fn poll_sheet(&mut self) {
        let Some(job) = self.saving_sheet.take() else { return };
        let path = &job.input.path;
        match job.poll() {
            Poll::Working => self.saving_sheet = Some(job),
            Poll::Done(Ok(remark)) => {
                let remark = remark.map_or_else(String::new, |remark| format!("; {remark}"));
                self.state.notify(NoticeKind::Done, format!("Saved {}{remark}", path.display()));
            }
            Poll::Done(Err(error)) => self.state.notify(NoticeKind::Error, error),
            Poll::Lost => self.state.notify(NoticeKind::Error, lost("saving", path)),
        }
    }

    /// The job, or a notice that the system gives no thread.
    fn started<I, O>(&mut self, job: std::io::Result<Job<I, O>>) -> Option<Job<I, O>> {
        job.inspect_err(|error| self.state.notify(NoticeKind::Error, format!("no thread could be started: {error}")))
            .ok()
    }

    fn poll(&mut self, ctx: &Context) {
        self.poll_dialog(ctx);
        if let Some(job) = self.loading.take() {
            match job.poll() {
                Poll::Working => self.loading = Some(job),
                Poll::Done(Ok((preset, warnings))) => {
                    self.state.document = Document::new(preset, Some(job.input.clone()));
                    self.meet_photograph();
                    if self.state.page == Page::Library {
                        self.state.page = Page::Author;
                    }
                    for warning in warnings {
                        self.state.notify(NoticeKind::Warning, warning);
                    }
                }
                Poll::Done(Err(error)) => self.state.notify(NoticeKind::Error, error),
                Poll::Lost => self.state.notify(NoticeKind::Error, lost("opening", &job.input)),
            }
        }
        self.poll_reading();
        self.poll_adding();
        for failure in self.state.demonstrations.poll_exports() {
            self.state.notify(NoticeKind::Error, failure);
        }
        self.poll_importing(ctx);
        self.poll_writing();
        self.poll_sheet();
        if let Some(job) = self.saving.take() {
            match job.poll() {
                Poll::Working => self.saving = Some(job),
                Poll::Done(Ok(())) => self.saved(ctx, job.input.clone()),
                Poll::Done(Err(error)) => self.failed_to_save(error),
                Poll::Lost => self.failed_to_save(lost("saving", &job.input.path)),
            }
        }
    }

    fn poll_reading(&mut self) {
        let Some(job) = self.reading.take() else { return };
        match job.poll() {
            Poll::Working => self.reading = Some(job),
            Poll::Done(Ok(loaded)) => {
                let session = Session::new(job.input.clone(), loaded, &self.state.document.preset);
                self.state.photograph = Some(session);
                if self.state.page == Page::Metals {
                    self.state.page = Page::Photograph;
                }
            }
            Poll::Done(Err(error)) => self.state.notify(NoticeKind::Error, error),
            Poll::Lost => self.state.notify(NoticeKind::Error, lost("opening", Path::new(&job.input.name()))),
        }
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

    fn saved(&mut self, ctx: &Context, saving: Saving) {
        let lost = saving.preset.lost_fields();
        if !lost.is_empty() {
            let sentence = format!(
                "{}: fields that this version does not know have lost their place and were left out: {}",
                saving.path.display(),
                lost.join(", ")
            );
            self.state.notify(NoticeKind::Warning, sentence);
        }
        self.state.document.was_saved(saving.preset, saving.path);
        if let Some(action) = self.after_saving.take() {
            self.perform(ctx, action);
        }
    }

    fn failed_to_save(&mut self, error: String) {
        self.after_saving = None;
        self.state.notify(NoticeKind::Error, error);
    }

    fn poll_dialog(&mut self, ctx: &Context) {
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
                Purpose::Library => self.apply(ctx, Action::OpenLibrary(path)),
                Purpose::Import => self.import(ctx, path),
                Purpose::Export(_) => {}
                Purpose::SaveSheet(kind) => self.save_sheet(ctx, kind, path),
            },
            Outcome::Cancelled => self.after_saving = None,
            Outcome::NoService => self.ask_path(ctx, purpose, Some(NO_DIALOG)),
        }
    }

    fn panels(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        let margin = |x, y| Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(x, y));
        let (bar, side) = (margin(8, 4), margin(theme::MARGIN, 10));
        Panel::top("menu").frame(bar).show(ui, |ui| panels::menu_bar::show(ui, &self.state, actions));
        if !self.state.notices.is_empty() {
            Panel::top("notices").frame(bar).show(ui, |ui| panels::notices::show(ui, &mut self.state));
        }
        if self.dialog.is_some() {
            Panel::top("waiting").frame(bar).show(ui, |ui| self.waiting_for_dialog(ui));
        }
        Panel::bottom("status").frame(bar).show(ui, |ui| panels::status_bar::show(ui, &self.state));
        match self.state.page {
            Page::Author => self.author_page(ui, side, actions),
            Page::Photograph => {
                let reading = self.reading.as_ref().map(|job| (job.input.name(), job.progress()));
                let reading = reading.as_ref().map(|(name, progress)| (name.as_str(), *progress));
                panels::photograph::page(ui, &mut self.state, reading, side, actions);
            }
            Page::Metals => panels::metals::show(ui, &mut self.state, actions),
            Page::Demonstrations => panels::demonstrations::show(ui, &mut self.state, actions),
            Page::Library => panels::library::show(ui, &mut self.state, actions),
        }
    }

    fn author_page(&mut self, ui: &mut Ui, side: Frame, actions: &mut Vec<Action>) {
        Panel::right("inspector").frame(side).resizable(false).exact_size(theme::INSPECTOR_WIDTH).show(ui, |ui| {
            panels::inspector::show(ui, &mut self.state, actions);
        });
        let reading = self.reading.as_ref().map(|job| (job.input.name(), job.progress()));
        let photograph = Panel::left("photograph").frame(side).resizable(true).default_size(theme::PHOTO_WIDTH);
        photograph.size_range(theme::PHOTO_WIDTHS).show(ui, |ui| {
            let reading = reading.as_ref().map(|(name, progress)| (name.as_str(), *progress));
            panels::photograph::show(ui, &mut self.state, reading, actions);
        });
        CentralPanel::no_frame().frame(side).show(ui, |ui| panels::curves::show(ui, &mut self.state, actions));
    }

    fn waiting_for_dialog(&mut self, ui: &mut Ui) {
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

    fn warn_of(&mut self, path: &Path, outcome: std::io::Result<()>) {
        if let Err(error) = outcome {
            self.state.notify(NoticeKind::Warning, format!("{}: {error}", path.display()));
        }
    }

    /// Asks about one thing left behind at a time.
    fn ask_about_left_behind(&mut self) {
        if self.prompt.is_none() {
            self.prompt = self.left_behind.pop().map(|left| Prompt::LeftBehind(Box::new(left)));
        }
    }

    fn answer_prompt(&mut self, ui: &Ui) {
        self.ask_about_left_behind();
        let Some(prompt) = &mut self.prompt else { return };
        let answer = prompt.show(ui, &self.state);
        if !matches!(answer, Answer::None) {
            self.prompt = None;
        }
        match answer {
            Answer::None => {}
            Answer::Cancel => self.after_saving = None,
            Answer::Do(action) => self.perform(ui.ctx(), action),
            Answer::Discard(action) => self.apply(ui.ctx(), action),
            Answer::SaveThen(action) => {
                self.after_saving = Some(action);
                self.run(ui.ctx(), Command::Save);
            }
        }
    }

    /// A window that is closed with unsaved changes asks first.
    fn guard_closing(&mut self, ctx: &Context) {
        let is_closing = ctx.input(|input| input.viewport().close_requested());
        if is_closing && !self.may_close && self.state.document.is_changed() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.prompt = Some(Prompt::Unsaved(Command::Quit.into()));
        }
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
    }

    fn keep_unsaved_work(&mut self, ctx: &Context) {
        let failure = self.recovery.as_mut().and_then(|recovery| recovery.keep(ctx, &self.state.document));
        if let Some(sentence) = failure {
            self.state.notify(NoticeKind::Warning, format!("unsaved work could not be kept: {sentence}"));
        }
    }

    fn open_dropped_files(&self, ctx: &Context, actions: &mut Vec<Action>) {
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        actions.extend(dropped.iter().map(|file| Action::Load(file.path().to_owned())));
    }
}

/// Figures are saved as they are looked at.
fn figure_theme(ctx: &Context) -> FigureTheme {
    if ctx.theme() == Theme::Dark { FigureTheme::Dark } else { FigureTheme::Light }
}

/// More notes of one import would push everything else off the window.
const MOST_NOTES: usize = 4;

const NO_DIALOG: &str = "There is no file dialog service on this system. Type the path instead.";

/// Whether an action replaces the document or ends the program.
fn loses_changes(action: &Action) -> bool {
    match action {
        Action::Load(path) => is_preset(path),
        Action::Run(Command::New | Command::Quit)
        | Action::StartFrom(_)
        | Action::StartWith(_)
        | Action::Recover(_) => true,
        _ => false,
    }
}

/// Presets are JSON files; everything else is for the reader of photographs to recognise.
fn is_preset(path: &Path) -> bool {
    has_extension(path, &["json"])
}

fn has_extension(path: &Path, known: &[&str]) -> bool {
    let is_known = |extension: &std::ffi::OsStr| known.iter().any(|known| extension.eq_ignore_ascii_case(known));
    path.extension().is_some_and(is_known)
}

fn lost(doing: &str, path: &Path) -> String {
    format!("{}: {doing} it ended unexpectedly; the terminal may say more", path.display())
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
        for action in actions {
            self.perform(&ctx, action);
        }
        self.feed_history(&ctx);
    }

    fn on_exit(&mut self, _gl: Option<&eframe::glow::Context>) {
        if let Some(recovery) = &self.recovery {
            recovery.finish();
        }
    }
}

impl std::fmt::Debug for App {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("App").field("state", &self.state).finish_non_exhaustive()
    }
}
