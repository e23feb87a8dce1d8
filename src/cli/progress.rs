//! Long work on the command line: a bar on standard error, and an ear for Ctrl-C.

use std::ops::ControlFlow;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

use indicatif::{ProgressBar, ProgressStyle};

/// A person pressed Ctrl-C.
static IS_STOPPED: AtomicBool = AtomicBool::new(false);

/// Work that shows how far it is and ends at its next step when a person presses Ctrl-C; pressing it again ends the
/// program at once.
///
/// Nothing is half printed or half written: results come after the work, and files are replaced whole.
pub struct Progress(ProgressBar);

impl Progress {
    /// Begins; the bar goes when this is dropped.
    pub fn new(what: &'static str) -> Self {
        listen();
        Self(progress_bar(what))
    }

    /// Says how much is done, 0–1; breaks when the person wants no more.
    pub fn report(&self, share: f32) -> ControlFlow<()> {
        self.0.set_position((share * BAR_STEPS as f32) as u64);
        self.keep_going()
    }

    /// Breaks when the person wants no more.
    pub fn keep_going(&self) -> ControlFlow<()> {
        if was_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// Whether a person pressed Ctrl-C during such work.
pub fn was_stopped() -> bool {
    IS_STOPPED.load(Ordering::Relaxed)
}

/// Exit code of a program that a person stopped: 128 and the number of the signal.
pub const STOPPED: u8 = 130;

fn listen() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let heard = ctrlc::set_handler(|| {
            if IS_STOPPED.swap(true, Ordering::Relaxed) {
                std::process::exit(STOPPED.into());
            }
        });
        if let Err(error) = heard {
            // Ctrl-C then ends the program at once, as everywhere else.
            log::warn!("Ctrl-C is not listened for: {error}");
        }
    });
}

/// Steps of a [`progress_bar`].
const BAR_STEPS: u64 = 1000;

/// A bar on standard error, only where that is a terminal.
pub fn progress_bar(what: &'static str) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg} {wide_bar} {percent} % {eta}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(BAR_STEPS).with_style(style).with_message(what)
}
