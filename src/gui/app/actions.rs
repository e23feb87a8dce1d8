//! What was asked: each action and command, done.

use std::path::Path;

use eframe::egui::{Context, Theme, ThemePreference, ViewportCommand, gui_zoom};

use super::App;
use super::files::is_preset;
use crate::gui::command::{Action, Command};
use crate::gui::copying::CopyForm;
use crate::gui::document::Document;
use crate::gui::export::ExportDialog;
use crate::gui::file_dialog::Purpose;
use crate::gui::photograph::Source;
use crate::gui::prompt::{Among, Prompt};
use crate::gui::state::{NoticeKind, Page};
use crate::preset::Preset;

impl App {
    pub(super) fn perform(&mut self, ctx: &Context, action: Action) {
        if self.state.document.is_changed() && loses_changes(&action) {
            self.prompt = Some(Prompt::Unsaved(action));
        } else {
            self.apply(ctx, action);
        }
    }

    /// Does what was asked, whatever is lost.
    pub(super) fn apply(&mut self, ctx: &Context, action: Action) {
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
            Action::Plan(action) => self.plan(ctx, action),
        }
    }

    pub(super) fn run(&mut self, ctx: &Context, command: Command) {
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
            Command::ShowPlanner => self.state.page = Page::Planner,
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

    /// Another preset, not in a file yet: the photograph that is open says nothing about it.
    pub(super) fn start_with(&mut self, preset: Preset) {
        self.state.document = Document::new(preset, None);
        self.state.page = Page::Author;
        if let Some(session) = &mut self.state.photograph {
            session.is_followed = false;
        }
    }

    /// Copies a colour of the preset; says so when the copy holds less than the colour.
    pub(super) fn copy(&mut self, ctx: &Context, symbol: &str, form: CopyForm) {
        let Preset { r, h, space, .. } = self.state.document.preset;
        let colour = if symbol == "r" { r } else { h };
        ctx.copy_text(form.words(colour, space));
        if form.is_clipped(colour, space) {
            let sentence = format!("{symbol} lies outside sRGB: the nearest colour that sRGB has was copied.");
            self.state.notify(NoticeKind::Warning, sentence);
        }
    }

    /// The marks are part of what a preset was matched from, so undoing that moves them back.
    pub(super) fn marks_from_preset(&mut self) {
        if let Some(session) = &mut self.state.photograph {
            session.take_marks_of(&self.state.document.preset);
        }
    }

    /// A preset that has just been opened is not solved over by a photograph it was not matched from.
    pub(super) fn meet_photograph(&mut self) {
        if let Some(session) = &mut self.state.photograph
            && !session.take_marks_of(&self.state.document.preset)
        {
            session.is_followed = false;
        }
    }
}

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
