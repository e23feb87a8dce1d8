//! Work that would hold up a frame, on a thread of its own.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, mpsc};
use std::thread;

use eframe::egui::Context;

/// A running piece of work and what it was asked.
///
/// Dropping it cancels the work: the thread sees it at its next progress report, and whatever it
/// still sends has no receiver. So replacing a job is enough to never see a stale result.
pub(crate) struct Job<Input, Output> {
    /// What the work was asked.
    pub input: Input,
    shared: Arc<Shared>,
    results: mpsc::Receiver<Output>,
}

#[derive(Default)]
struct Shared {
    is_cancelled: AtomicBool,
    /// Bits of an `f32` between 0 and 1.
    progress: AtomicU32,
}

/// How a job reports how far it is, and learns that nobody waits any more.
#[derive(Clone)]
pub(crate) struct Progress {
    shared: Arc<Shared>,
    ctx: Context,
}

impl Progress {
    /// Says how much is done, 0 to 1; breaks when the job was dropped.
    pub(crate) fn report(&self, fraction: f32) -> ControlFlow<()> {
        let before = f32::from_bits(self.shared.progress.swap(fraction.to_bits(), Ordering::Relaxed));
        if (fraction * PROGRESS_STEPS) as u32 != (before * PROGRESS_STEPS) as u32 {
            self.ctx.request_repaint();
        }
        if self.shared.is_cancelled.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// The window is repainted this often while a job reports.
const PROGRESS_STEPS: f32 = 100.0;

/// What a job has come to.
pub(crate) enum Poll<Output> {
    /// Still working.
    Working,
    /// Finished.
    Done(Output),
    /// The thread ended without a result: a defect, which must be said rather than waited for.
    Lost,
}

impl<Input: Clone + Send + 'static, Output: Send + 'static> Job<Input, Output> {
    /// Starts `work` on a thread called `name`; the window is repainted when it ends.
    pub(crate) fn start(
        ctx: &Context,
        name: &str,
        input: Input,
        work: impl FnOnce(Input, &Progress) -> Output + Send + 'static,
    ) -> std::io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let progress = Progress { shared: shared.clone(), ctx: ctx.clone() };
        let (sender, results) = mpsc::channel();
        let asked = input.clone();
        thread::Builder::new().name(name.to_owned()).spawn(move || {
            let _repaint = RepaintWhenDropped(progress.ctx.clone());
            // The receiver is gone when the job was dropped, and then nobody wants the result.
            let _ = sender.send(work(asked, &progress));
        })?;
        Ok(Self { input, shared, results })
    }

    /// What the job has come to; after `Done` or `Lost` it is of no more use.
    pub(crate) fn poll(&self) -> Poll<Output> {
        match self.results.try_recv() {
            Ok(output) => Poll::Done(output),
            Err(mpsc::TryRecvError::Empty) => Poll::Working,
            Err(mpsc::TryRecvError::Disconnected) => Poll::Lost,
        }
    }

    /// How much is done, 0 to 1.
    pub(crate) fn progress(&self) -> f32 {
        f32::from_bits(self.shared.progress.load(Ordering::Relaxed))
    }
}

impl<Input, Output> Drop for Job<Input, Output> {
    fn drop(&mut self) {
        self.shared.is_cancelled.store(true, Ordering::Relaxed);
    }
}

struct RepaintWhenDropped(Context);

impl Drop for RepaintWhenDropped {
    fn drop(&mut self) {
        self.0.request_repaint();
    }
}

/// Work that follows its input: while a job runs the input may change, and the next one starts with the newest.
///
/// A running job is never replaced, so that during a long drag results still appear.
pub(crate) struct Follower<Input, Output> {
    job: Option<Job<Input, Output>>,
    finished: Option<Input>,
}

impl<Input, Output> Default for Follower<Input, Output> {
    fn default() -> Self {
        Self { job: None, finished: None }
    }
}

impl<Input: Clone + PartialEq + Send + 'static, Output: Send + 'static> Follower<Input, Output> {
    /// True while a job is at work.
    pub(crate) fn is_busy(&self) -> bool {
        self.job.is_some()
    }

    /// How much of the running job is done, 0 to 1.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.job.as_ref().map(Job::progress)
    }

    /// Sees to it that `work` is done for `input`; gives a result when one has come, with the input it is of.
    pub(crate) fn follow(
        &mut self,
        ctx: &Context,
        name: &str,
        input: Input,
        work: impl FnOnce(Input, &Progress) -> Output + Send + 'static,
    ) -> Option<(Input, Output)> {
        let finished = self.poll(name);
        if self.job.is_none() && self.finished.as_ref() != Some(&input) {
            match Job::start(ctx, name, input, work) {
                Ok(job) => self.job = Some(job),
                Err(error) => log::error!("{name}: no thread could be started: {error}"),
            }
        }
        finished
    }

    fn poll(&mut self, name: &str) -> Option<(Input, Output)> {
        let job = self.job.take()?;
        match job.poll() {
            Poll::Working => self.job = Some(job),
            Poll::Done(output) => {
                self.finished = Some(job.input.clone());
                return Some((job.input.clone(), output));
            }
            Poll::Lost => {
                log::error!("{name} ended unexpectedly");
                // Not tried again with the same input: it would end the same way.
                self.finished = Some(job.input.clone());
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wait<I: Clone + Send + 'static, O: Send + 'static>(job: &Job<I, O>) -> Poll<O> {
        loop {
            match job.poll() {
                Poll::Working => thread::yield_now(),
                end => return end,
            }
        }
    }

    #[test]
    fn gives_its_result_and_progress() {
        let job = Job::start(&Context::default(), "test", 20, |n, progress| {
            let _ = progress.report(0.5);
            n + 1
        })
        .unwrap();
        assert!(matches!(wait(&job), Poll::Done(21)));
        assert_eq!((job.input, job.progress()), (20, 0.5));
    }

    #[test]
    fn dropping_it_cancels_the_work() {
        let (sender, stopped) = mpsc::channel();
        let job = Job::start(&Context::default(), "test", (), move |(), progress| {
            while progress.report(0.0).is_continue() {
                thread::yield_now();
            }
            sender.send(()).unwrap();
        })
        .unwrap();
        drop(job);
        stopped.recv().expect("the thread saw the cancellation");
    }

    #[test]
    fn a_follower_ends_at_the_newest_input() {
        let mut follower = Follower::default();
        let ctx = Context::default();
        let mut results = Vec::new();
        for input in [1, 2, 3, 3, 3] {
            results.extend(follower.follow(&ctx, "test", input, |n, _| n * 10));
        }
        while results.last() != Some(&(3, 30)) {
            results.extend(follower.follow(&ctx, "test", 3, |n, _| n * 10));
            thread::yield_now();
        }
        assert_eq!(results[0], (1, 10), "a running job is not replaced");
        assert!(follower.follow(&ctx, "test", 3, |n, _| n).is_none() && !follower.is_busy());
    }

    #[test]
    fn a_thread_that_dies_is_lost_not_awaited() {
        let job: Job<(), ()> = Job::start(&Context::default(), "dies for a test", (), |(), _| {
            std::panic::resume_unwind(Box::new("quietly"))
        })
        .unwrap();
        assert!(matches!(wait(&job), Poll::Lost));
    }
}
