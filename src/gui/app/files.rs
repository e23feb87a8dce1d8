//! Files that are opened, read, imported and saved, each on a job.

use std::path::{Path, PathBuf};

use eframe::egui::{Context, Theme};

use super::App;
use crate::figure::FigureTheme;
use crate::gui::command::Action;
use crate::gui::demonstrations::Piece;
use crate::gui::document::Document;
use crate::gui::job::{Job, Poll};
use crate::gui::photograph::{Reading, Session, Source};
use crate::gui::prompt::Prompt;
use crate::gui::sheet::{Sheet, SheetKind};
use crate::gui::state::{NoticeKind, Page};
use crate::import::{Imported, import_file};
use crate::metal::{Metal, metal_by_name};
use crate::preset::{Origin, Preset};

pub(super) type LoadedPreset = (Preset, Vec<String>);

#[derive(Clone)]
pub(super) struct Saving {
    preset: Preset,
    path: PathBuf,
}

#[derive(Clone)]
pub(super) struct SavingSheet {
    sheet: Sheet,
    path: PathBuf,
}

/// What a person should know about a file that was written, or why there is none.
pub(super) type SheetSaved = Result<Option<String>, String>;

impl App {
    /// Opens a preset, or a photograph where the name is not a preset's.
    pub(super) fn load(&mut self, ctx: &Context, path: PathBuf) {
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

    pub(super) fn poll_loading(&mut self) {
        let Some(job) = self.loading.take() else { return };
        match job.poll() {
            Poll::Working => self.loading = Some(job),
            Poll::Done(Ok((preset, warnings))) => self.loaded(preset, job.input.clone(), warnings),
            Poll::Done(Err(error)) => self.state.notify(NoticeKind::Error, error),
            Poll::Lost => self.state.notify(NoticeKind::Error, lost("opening", &job.input)),
        }
    }

    pub(super) fn loaded(&mut self, preset: Preset, path: PathBuf, warnings: Vec<String>) {
        self.compare_with_origin(&preset);
        self.state.document = Document::new(preset, Some(path));
        self.meet_photograph();
        if self.state.page == Page::Library {
            self.state.page = Page::Author;
        }
        for warning in warnings {
            self.state.notify(NoticeKind::Warning, warning);
        }
    }

    /// A preset made from a measured metal is looked at beside that metal.
    fn compare_with_origin(&mut self, preset: &Preset) {
        if let Origin::Measured { metal, .. } = &preset.origin
            && let Ok(metal) = metal_by_name(metal)
        {
            self.state.view.metal = Some(metal);
        }
    }

    pub(super) fn import(&mut self, ctx: &Context, path: PathBuf) {
        let job = Job::start(ctx, "import", path, |path, _| {
            import_file(&path, None).map_err(|error| format!("{}: {error}", path.display()))
        });
        self.importing = self.started(job);
    }

    pub(super) fn poll_importing(&mut self, ctx: &Context) {
        let Some(job) = self.importing.take() else { return };
        match job.poll() {
            Poll::Working => self.importing = Some(job),
            Poll::Done(Ok(imported)) => self.imported(ctx, imported),
            Poll::Done(Err(error)) => self.state.notify(NoticeKind::Error, error),
            Poll::Lost => self.state.notify(NoticeKind::Error, lost("importing", &job.input)),
        }
    }

    /// One metal becomes the preset; of several a person chooses.
    pub(super) fn imported(&mut self, ctx: &Context, Imported { mut presets, notes }: Imported) {
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

    pub(super) fn add_metal(&mut self, ctx: &Context, path: PathBuf) {
        let job = Job::start(ctx, "read metal", path, |path, _| Metal::open(&path).map_err(|error| error.to_string()));
        self.adding = self.started(job);
    }

    pub(super) fn poll_adding(&mut self) {
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

    pub(super) fn read(&mut self, ctx: &Context, source: Source) {
        let reading = Reading::start(ctx, source);
        self.reading = self.started(reading);
    }

    pub(super) fn poll_reading(&mut self, ctx: &Context) {
        let Some(mut reading) = self.reading.take() else { return };
        match reading.poll(ctx) {
            Poll::Working => self.reading = Some(reading),
            Poll::Done(Ok(loaded)) => {
                let session = Session::new(reading.source().clone(), loaded, &self.state.document.preset);
                self.state.photograph = Some(session);
                if self.state.page == Page::Metals {
                    self.state.page = Page::Photograph;
                }
            }
            Poll::Done(Err(error)) => self.state.notify(NoticeKind::Error, error),
            Poll::Lost => self.state.notify(NoticeKind::Error, lost("opening", Path::new(&reading.source().name()))),
        }
    }

    pub(super) fn save(&mut self, ctx: &Context, path: PathBuf) {
        let saving = Saving { preset: self.state.document.preset.clone(), path };
        let job = Job::start(ctx, "save", saving, |saving, _| {
            saving.preset.save(&saving.path).map_err(|error| error.to_string())
        });
        self.saving = self.started(job);
    }

    pub(super) fn poll_saving(&mut self, ctx: &Context) {
        let Some(job) = self.saving.take() else { return };
        match job.poll() {
            Poll::Working => self.saving = Some(job),
            Poll::Done(Ok(())) => self.saved(ctx, job.input.clone()),
            Poll::Done(Err(error)) => self.failed_to_save(error),
            Poll::Lost => self.failed_to_save(lost("saving", &job.input.path)),
        }
    }

    pub(super) fn saved(&mut self, ctx: &Context, saving: Saving) {
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

    pub(super) fn failed_to_save(&mut self, error: String) {
        self.after_saving = None;
        self.state.notify(NoticeKind::Error, error);
    }

    pub(super) fn save_sheet(&mut self, ctx: &Context, kind: SheetKind, path: PathBuf) {
        let saving = SavingSheet { sheet: Sheet::of(&self.state.metals, kind, figure_theme(ctx)), path };
        let job = Job::start(ctx, "save sheet", saving, |saving, progress| saving.sheet.write(&saving.path, progress));
        self.saving_sheet = self.started(job);
    }

    pub(super) fn poll_sheet(&mut self) {
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

    pub(super) fn save_piece(&mut self, ctx: &Context, piece: Piece, path: PathBuf) {
        let exhibit = self.state.demonstrations.exhibit(self.state.open());
        if let Err(error) = self.state.demonstrations.export(ctx, exhibit, piece, path) {
            self.state.notify(NoticeKind::Error, format!("no thread could be started: {error}"));
        }
    }

    pub(super) fn open_dropped_files(&self, ctx: &Context, actions: &mut Vec<Action>) {
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        actions.extend(dropped.iter().map(|file| Action::Load(file.path().to_owned())));
    }
}

/// More notes of one import would push everything else off the window.
const MOST_NOTES: usize = 4;

/// Presets are JSON files; everything else is for the reader of photographs to recognise.
pub(super) fn is_preset(path: &Path) -> bool {
    has_extension(path, &["json"])
}

fn has_extension(path: &Path, known: &[&str]) -> bool {
    let is_known = |extension: &std::ffi::OsStr| known.iter().any(|known| extension.eq_ignore_ascii_case(known));
    path.extension().is_some_and(is_known)
}

pub(super) fn lost(doing: &str, path: &Path) -> String {
    format!("{}: {doing} it ended unexpectedly; the terminal may say more", path.display())
}

/// Figures are saved as they are looked at.
pub(super) fn figure_theme(ctx: &Context) -> FigureTheme {
    if ctx.theme() == Theme::Dark { FigureTheme::Dark } else { FigureTheme::Light }
}
