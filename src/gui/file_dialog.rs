//! The system's file dialog, off the thread of the window.
//!
//! A missing dialog service answers like a person who cancels, and a broken one never answers. So nothing
//! waits for it: it can be given up, and a path can always be typed instead.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use eframe::egui::Context;

use super::demonstrations::Piece;
use super::job::{Job, Poll};
use super::planner::PlanFile;
use super::sheet::SheetKind;
use crate::export::Target;

/// What the file is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// A preset or a photograph to open.
    Open,
    /// Where to write the preset.
    Save,
    /// Where to write a piece of a demonstration.
    SavePiece(Piece),
    /// A file of the page of plans.
    Plan(PlanFile),
    /// A folder of presets.
    Library,
    /// What another program wrote.
    Import,
    /// Where to write for a renderer.
    Export(Target),
    /// Where to write what the page of metals shows.
    SaveSheet(SheetKind),
}

impl Purpose {
    /// True where one file is written, in whose place another may stand.
    pub(crate) const fn writes_a_file(self) -> bool {
        match self {
            Self::Save | Self::SavePiece(_) | Self::Export(_) | Self::SaveSheet(_) => true,
            Self::Plan(file) => file.file_name().is_some(),
            Self::Open | Self::Library | Self::Import => false,
        }
    }
}

/// What came of a dialog.
pub(crate) enum Outcome {
    /// A file was chosen.
    Picked(PathBuf),
    /// The person cancelled.
    Cancelled,
    /// There is no dialog service: it answered before a person could.
    NoService,
}

/// The extensions that can be imported.
const IMPORTED: [&str; 8] = ["mtlx", "glb", "gltf", "csv", "txt", "ase", "gpl", "json"];

/// No person cancels a dialog faster than this.
const FASTEST_PERSON: Duration = Duration::from_millis(150);

/// A dialog that may be open on the screen.
pub(crate) struct FileDialog {
    job: Job<Purpose, Outcome>,
}

impl FileDialog {
    /// Asks the system for a dialog.
    pub(crate) fn open(ctx: &Context, purpose: Purpose, file_name: &str) -> std::io::Result<Self> {
        // Built here: macOS wants the dialog made on the main thread and awaited elsewhere.
        let choice: Choice = match purpose {
            Purpose::Open => Box::pin(dialog().pick_file()),
            Purpose::Library => Box::pin(rfd::AsyncFileDialog::new().pick_folder()),
            Purpose::Import => Box::pin(
                rfd::AsyncFileDialog::new()
                    .add_filter("Files of other programs", &IMPORTED)
                    .add_filter("All files", &["*"])
                    .pick_file(),
            ),
            Purpose::Export(target) => save_dialog(target.label(), target.extension(), file_name),
            Purpose::Save => save_dialog("Edgewise preset", "json", file_name),
            Purpose::Plan(file) => plan_dialog(file, file_name),
            Purpose::SavePiece(piece) => save_dialog("Demonstration", piece.extension(), file_name),
            Purpose::SaveSheet(kind) => {
                let dialog = rfd::AsyncFileDialog::new().set_file_name(file_name);
                let by_ending = |dialog: rfd::AsyncFileDialog, ending: &&str| dialog.add_filter(*ending, &[*ending]);
                Box::pin(kind.endings().iter().fold(dialog, by_ending).save_file())
            }
        };
        let job = Job::start(ctx, "file dialog", purpose, move |_, _| {
            let start = Instant::now();
            match pollster::block_on(choice) {
                Some(file) => Outcome::Picked(file.path().to_owned()),
                None if start.elapsed() < FASTEST_PERSON => Outcome::NoService,
                None => Outcome::Cancelled,
            }
        })?;
        Ok(Self { job })
    }

    /// What the dialog is for.
    pub(crate) fn purpose(&self) -> Purpose {
        self.job.input
    }

    /// The answer, once there is one.
    pub(crate) fn poll(&self) -> Option<Outcome> {
        match self.job.poll() {
            Poll::Working => None,
            Poll::Done(outcome) => Some(outcome),
            Poll::Lost => Some(Outcome::NoService),
        }
    }
}

type Choice = std::pin::Pin<Box<dyn Future<Output = Option<rfd::FileHandle>> + Send>>;

fn save_dialog(what: &str, extension: &str, file_name: &str) -> Choice {
    let dialog = rfd::AsyncFileDialog::new().add_filter(what, &[extension]).set_file_name(file_name);
    Box::pin(dialog.save_file())
}

fn plan_dialog(file: PlanFile, file_name: &str) -> Choice {
    let (what, endings) = file.kind();
    let dialog = rfd::AsyncFileDialog::new().add_filter(what, endings);
    match file.file_name() {
        _ if matches!(file, PlanFile::Export(_)) => Box::pin(rfd::AsyncFileDialog::new().pick_folder()),
        Some(_) => Box::pin(dialog.set_file_name(file_name).save_file()),
        None => Box::pin(dialog.add_filter("All files", &["*"]).pick_file()),
    }
}

fn dialog() -> rfd::AsyncFileDialog {
    rfd::AsyncFileDialog::new()
        .add_filter("Presets and photographs", &["json", "png", "jpg", "jpeg", "tif", "tiff", "exr", "hdr", "webp"])
        .add_filter("All files", &["*"])
}
