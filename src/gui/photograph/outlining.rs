//! Looking for the edge of a ball, on a job.

use std::sync::Arc;

use eframe::egui::Context;

use super::Mark;
use crate::gui::job::{Job, Poll};
use crate::photo::{Circle, Outline, OutlineError, Photo, find_ball, snap_circle};

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Search {
    /// The mark that will have the outline.
    pub mark: Mark,
    /// Where to look; everywhere when `None`.
    pub near: Option<Circle>,
}

/// What was found.
pub(crate) type Found = Result<Outline, OutlineError>;

/// The search under way, and what the last one of each mark came to.
#[derive(Default)]
pub(crate) struct Outlining {
    job: Option<Job<Search, Found>>,
    last: Option<(Search, Found)>,
}

impl Outlining {
    /// Starts a search; one that is under way is given up.
    pub(crate) fn start(&mut self, ctx: &Context, photo: &Arc<Photo>, search: Search) -> std::io::Result<()> {
        let photo = photo.clone();
        let work = move |search: Search, _: &_| match search.near {
            Some(rough) => snap_circle(&photo, rough),
            None => find_ball(&photo),
        };
        self.job = Some(Job::start(ctx, "outline", search, work)?);
        Ok(())
    }

    /// True while a search is under way.
    pub(crate) fn is_busy(&self) -> bool {
        self.job.is_some()
    }

    /// What has just been found.
    pub(crate) fn poll(&mut self) -> Option<(Search, Found)> {
        let job = self.job.take()?;
        match job.poll() {
            Poll::Working => self.job = Some(job),
            Poll::Done(found) => {
                self.last = Some((job.input, found.clone()));
                return Some((job.input, found));
            }
            Poll::Lost => log::error!("the search for an outline ended unexpectedly"),
        }
        None
    }

    /// What the last search for a mark came to, as long as the mark is where that search left it.
    pub(crate) fn last(&self, mark: Mark, circle: Option<Circle>) -> Option<&Found> {
        let (search, found) = self.last.as_ref().filter(|(search, _)| search.mark == mark)?;
        let left = found.as_ref().map_or(search.near, |outline| Some(outline.circle));
        (left == circle).then_some(found)
    }
}
