//! Opening the window, and saying in one sentence why it does not open.

use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use eframe::egui::{Ui, ViewportBuilder};
use thiserror::Error;

use super::app::App;
use super::recovery;
use super::renderer::Renderer;
use super::settings;
use super::theme;
use crate::sample::Sample;

/// How the window is opened.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// A preset or a photograph to open.
    pub path: Option<PathBuf>,
    /// A photograph that ships with the program, to open instead.
    pub sample: Option<&'static Sample>,
    /// What draws the window.
    pub renderer: Renderer,
}

/// Why there is no window.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum WindowError {
    #[error("there is no display to open a window on ({0}); `edgewise --help` lists what works without one")]
    NoDisplay(String),
    #[error("no renderer could draw the window ({0}); `--renderer` chooses another")]
    NoRenderer(String),
    #[error(
        "the window could not be opened ({0}); on Debian, `apt install libxkbcommon-x11-0 libxcursor1 libxi6` adds what it needs"
    )]
    MissingLibrary(String),
    #[error("the window ended unexpectedly ({0})")]
    Ended(String),
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// When there is no display, or nothing can draw on it.
pub fn run(options: Options) -> Result<(), WindowError> {
    let mut problems = Vec::new();
    for &renderer in options.renderer.attempts() {
        match attempt(&options, renderer) {
            Ok(()) => return Ok(()),
            Err(Failure::Final(error)) => return Err(error),
            Err(Failure::OfRenderer(error)) => {
                log::warn!("{renderer} cannot draw the window: {error}");
                problems.push(format!("{renderer}: {error}"));
            }
        }
    }
    Err(WindowError::NoRenderer(problems.join("; ")))
}

/// Runs the window with one renderer. An error after the window has appeared is no reason to try another.
fn attempt(options: &Options, renderer: eframe::Renderer) -> Result<(), Failure> {
    let asked = Instant::now();
    let has_started = Arc::new(AtomicBool::new(false));
    let outcome = catch_quietly(&has_started, || {
        let started = has_started.clone();
        let (path, sample) = (options.path.clone(), options.sample);
        let create: eframe::AppCreator = Box::new(move |cc| {
            started.store(true, Ordering::Relaxed);
            let mut app = App::new(&cc.egui_ctx, path);
            if let Some(folder) = recovery::folder() {
                app.keep_unsaved_work_in(&folder);
            }
            if let Some(path) = settings::path() {
                app.keep_settings_in(&cc.egui_ctx, path);
            }
            if let Some(sample) = sample {
                app.open_sample(&cc.egui_ctx, sample);
            }
            Ok(Box::new(Timed { app, asked, frames: 0 }))
        });
        eframe::run_native("Edgewise", native_options(renderer), create)
    });
    let has_started = has_started.load(Ordering::Relaxed);
    match outcome {
        Ok(Ok(())) => Ok(()),
        Ok(Err(error)) if has_started => Err(Failure::Final(WindowError::Ended(error.to_string()))),
        Ok(Err(eframe::Error::Winit(error))) => Err(Failure::Final(WindowError::NoDisplay(error.to_string()))),
        Ok(Err(eframe::Error::WinitEventLoop(error))) => Err(Failure::Final(WindowError::NoDisplay(error.to_string()))),
        Ok(Err(error)) => Err(Failure::OfRenderer(error.to_string())),
        Err(panic) if has_started => Err(Failure::Final(WindowError::Ended(panic))),
        Err(panic) => Err(Failure::Final(WindowError::MissingLibrary(panic))),
    }
}

/// The window, with a line in the log of how long it took to appear.
struct Timed {
    app: App,
    asked: Instant,
    frames: u32,
}

impl eframe::App for Timed {
    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        // The second frame begins when the first is on the screen.
        if self.frames == 1 {
            log::info!("the first frame was on the screen after {} ms", self.asked.elapsed().as_millis());
        }
        self.frames = self.frames.saturating_add(1);
        self.app.ui(ui, frame);
    }

    fn on_exit(&mut self, gl: Option<&eframe::glow::Context>) {
        self.app.on_exit(gl);
    }
}

enum Failure {
    /// Another renderer may succeed.
    OfRenderer(String),
    /// Nothing else will help.
    Final(WindowError),
}

fn native_options(renderer: eframe::Renderer) -> eframe::NativeOptions {
    eframe::NativeOptions {
        renderer,
        viewport: ViewportBuilder::default()
            .with_title("Edgewise")
            .with_app_id("edgewise")
            .with_inner_size(theme::WINDOW_SIZE)
            .with_min_inner_size(theme::SMALLEST_WINDOW),
        // The same letters on every machine; the fonts are in the program.
        system_font_fallback: false,
        ..Default::default()
    }
}

/// Turns a panic into its message, unprinted while the window has not appeared: the windowing library panics
/// where a shared library is missing, and a sentence says more than a backtrace.
fn catch_quietly<T>(has_started: &Arc<AtomicBool>, work: impl FnOnce() -> T) -> Result<T, String> {
    let earlier: Arc<dyn Fn(&std::panic::PanicHookInfo) + Send + Sync> = take_hook().into();
    let (shown, is_loud) = (earlier.clone(), has_started.clone());
    set_hook(Box::new(move |info| {
        if is_loud.load(Ordering::Relaxed) {
            shown(info);
        }
    }));
    let outcome = catch_unwind(AssertUnwindSafe(work));
    set_hook(Box::new(move |info| earlier(info)));
    outcome.map_err(|payload| {
        let message = payload.downcast_ref::<String>().map(String::as_str).or(payload.downcast_ref::<&str>().copied());
        message.unwrap_or("without a reason").lines().next().unwrap_or_default().to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_its_first_line() {
        let quiet = Arc::new(AtomicBool::new(false));
        let caught: Result<(), String> = catch_quietly(&quiet, || panic!("a library is missing\nmore"));
        assert_eq!(caught, Err("a library is missing".to_owned()));
        assert_eq!(catch_quietly(&quiet, || 3), Ok(3));
    }
}
