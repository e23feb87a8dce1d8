//! Looking for the edge of a ball or of a cylinder, on a job.

use std::sync::Arc;

use eframe::egui::Context;

use super::{Mark, MarkShape};
use crate::gui::job::{Job, Poll};
use crate::photo::{
    Circle, CylinderOutline, Outline, OutlineError, Photo, Warning, find_ball_beside, snap_circle, snap_cylinder,
};

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Search {
    /// The mark that will have the outline.
    pub mark: Mark,
    /// Where to look.
    pub place: Place,
}

/// Where an outline is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    /// Around a shape.
    Near(MarkShape),
    /// Everywhere but where the reference ball is.
    Everywhere {
        /// The reference ball, if there is one.
        but: Option<Circle>,
    },
}

/// The outline of a mark.
#[derive(Clone, Copy, Debug)]
pub(crate) enum FoundOutline {
    /// Of a ball.
    Ball(Outline),
    /// Of a cylinder.
    Cylinder(CylinderOutline),
}

impl FoundOutline {
    /// The shape of the mark.
    pub(crate) fn shape(&self) -> MarkShape {
        match self {
            Self::Ball(outline) => MarkShape::Round(outline.circle),
            Self::Cylinder(outline) => MarkShape::Rod(outline.cylinder),
        }
    }

    /// Standard uncertainty of the radius in pixels.
    pub(crate) const fn uncertainty_px(&self) -> f64 {
        match self {
            Self::Ball(outline) => outline.uncertainty_px,
            Self::Cylinder(outline) => outline.uncertainty_px,
        }
    }

    /// Share of the edge that lies on it.
    pub(crate) const fn support(&self) -> f64 {
        match self {
            Self::Ball(outline) => outline.support,
            Self::Cylinder(outline) => outline.support,
        }
    }

    /// Why it may be no ball or no cylinder.
    pub(crate) fn warning(&self) -> Option<Warning> {
        match self {
            Self::Ball(outline) => outline.warning(),
            Self::Cylinder(outline) => outline.warning(),
        }
    }
}

/// What was found.
pub(crate) type Found = Result<FoundOutline, OutlineError>;

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
        let work = move |search: Search, _: &_| look(&photo, search.place);
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
    pub(crate) fn last(&self, mark: Mark, shape: Option<MarkShape>) -> Option<&Found> {
        let (search, found) = self.last.as_ref().filter(|(search, _)| search.mark == mark)?;
        let left = match (found, search.place) {
            (Ok(outline), _) => Some(outline.shape()),
            (Err(_), Place::Near(shape)) => Some(shape),
            (Err(_), Place::Everywhere { .. }) => None,
        };
        (left == shape).then_some(found)
    }

    /// Why the last search, which was everywhere, found nothing.
    pub(crate) fn found_nowhere(&self) -> Option<&OutlineError> {
        match self.last.as_ref()? {
            (Search { place: Place::Everywhere { .. }, .. }, Err(error)) => Some(error),
            _ => None,
        }
    }
}

fn look(photo: &Photo, place: Place) -> Found {
    match place {
        Place::Near(MarkShape::Round(rough)) => snap_circle(photo, rough).map(FoundOutline::Ball),
        Place::Near(MarkShape::Rod(rough)) => snap_cylinder(photo, rough).map(FoundOutline::Cylinder),
        // No other shape is an outline.
        Place::Near(MarkShape::Square(_) | MarkShape::Quad(_)) => Err(OutlineError::NoCircle),
        Place::Everywhere { but } => find_ball_beside(photo, but.as_slice()).map(FoundOutline::Ball),
    }
}
