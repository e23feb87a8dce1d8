//! The newest result of work that follows its input: what is shown while the next one is on its way.

use eframe::egui::Context;

use crate::gui::job::{Follower, Progress};

/// A follower and what it last came to.
pub(crate) struct Latest<Input, Output> {
    follower: Follower<Input, Output>,
    output: Option<Output>,
}

impl<Input, Output> Default for Latest<Input, Output> {
    fn default() -> Self {
        Self { follower: Follower::default(), output: None }
    }
}

impl<Input: Clone + PartialEq + Send + 'static, Output: Send + 'static> Latest<Input, Output> {
    /// True while a job is at work.
    pub(crate) fn is_busy(&self) -> bool {
        self.follower.is_busy()
    }

    /// How much of a running job is done, 0 to 1.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.follower.progress()
    }

    /// Sees to it that `work` is done for `input`; gives the newest result there is, which may be of an older one.
    pub(crate) fn of(
        &mut self,
        ctx: &Context,
        name: &str,
        input: Input,
        work: impl FnOnce(Input, &Progress) -> Output + Send + 'static,
    ) -> Option<&Output> {
        if let Some(output) = self.take_new(ctx, name, input, work) {
            self.output = Some(output);
        }
        self.output.as_ref()
    }

    /// The same where a result is used up at once.
    pub(crate) fn take_new(
        &mut self,
        ctx: &Context,
        name: &str,
        input: Input,
        work: impl FnOnce(Input, &Progress) -> Output + Send + 'static,
    ) -> Option<Output> {
        self.follower.follow(ctx, name, input, work).map(|(_, output)| output)
    }
}
