//! One open photograph.

use std::sync::Arc;

use eframe::egui::{Context, Vec2};

use super::{Developer, Development, Loaded, Mark, Source};
use crate::color::RgbSpace;
use crate::gui::job::Follower;
use crate::photo::{Match, MatchRequest, Photo, Preview, solve};
use crate::preset::{Origin, Preset};

/// An open photograph with its marks and what they gave.
pub(crate) struct Session {
    /// Where it was read from.
    pub source: Source,
    /// The full data.
    pub photo: Arc<Photo>,
    /// What is shown.
    pub preview: Arc<Preview>,
    /// Its texture.
    pub developer: Developer,
    /// How it is shown.
    pub development: Development,
    /// The marks.
    pub request: MatchRequest,
    /// The mark that arrow keys move.
    pub selected: Option<Mark>,
    /// The marks before the drag under way, for Esc.
    pub before_drag: Option<MatchRequest>,
    /// Points of the screen for each pixel, over the one that fits; 1 shows all.
    pub zoom: f32,
    /// What is in the middle, as a share of the size off the centre.
    pub pan: Vec2,
    /// Whether the preset follows the match.
    pub is_followed: bool,
    solving: Follower<Asked, Result<Match, String>>,
    result: Option<Result<Match, String>>,
}

/// What a match depends on besides the photograph.
#[derive(Clone, PartialEq)]
struct Asked {
    request: MatchRequest,
    space: RgbSpace,
}

/// How a match stands.
pub(crate) enum Matching<'a> {
    /// Nothing to solve from yet.
    NotMarked,
    /// It failed, in a sentence.
    Failed(&'a str),
    /// It has numbers.
    Solved(&'a Match),
    /// The first one is on its way.
    Working,
}

impl Session {
    /// A photograph that has just been read. Marks come from the preset if it was matched from this very file,
    /// otherwise from the sample.
    pub(crate) fn new(source: Source, loaded: Loaded, preset: &Preset) -> Self {
        let request = match (&preset.origin, &source) {
            (Origin::Matched(recipe), _) if recipe.photo_sha256 == loaded.photo.sha256 => recipe.request.clone(),
            (_, Source::Sample(sample)) => sample.facts.request.clone(),
            _ => MatchRequest::default(),
        };
        Self {
            source,
            photo: Arc::new(loaded.photo),
            preview: Arc::new(loaded.preview),
            developer: Developer::default(),
            development: Development::default(),
            request,
            selected: None,
            before_drag: None,
            zoom: 1.0,
            pan: Vec2::ZERO,
            is_followed: true,
            solving: Follower::default(),
            result: None,
        }
    }

    /// True while something is computed.
    pub(crate) fn is_busy(&self) -> bool {
        self.solving.is_busy() || self.developer.is_busy()
    }

    /// How the match stands.
    pub(crate) fn matching(&self) -> Matching<'_> {
        match &self.result {
            _ if self.request.suggested_mode().is_none() => Matching::NotMarked,
            Some(Ok(found)) => Matching::Solved(found),
            Some(Err(sentence)) => Matching::Failed(sentence),
            None => Matching::Working,
        }
    }

    /// Solves again when marks or space have changed; gives a match that has just been found.
    pub(crate) fn solve(&mut self, ctx: &Context, space: RgbSpace) -> Option<Match> {
        self.request.suggested_mode()?;
        let asked = Asked { request: self.request.clone(), space };
        let photo = self.photo.clone();
        let work =
            move |asked: Asked, _: &_| solve(&photo, &asked.request, asked.space).map_err(|error| error.to_string());
        let (_, result) = self.solving.follow(ctx, "match", asked, work)?;
        let found = result.as_ref().ok().cloned();
        self.result = Some(result);
        found
    }

    /// True while a match is on its way.
    pub(crate) fn is_solving(&self) -> bool {
        self.solving.is_busy()
    }

    /// Writes what was found into the preset, with how. A colour with a channel that was not measured stays.
    pub(crate) fn apply(&self, found: &Match, preset: &mut Preset) {
        let (r, h) = (found.complete_r(), found.complete_h());
        if r.is_none() && h.is_none() {
            return;
        }
        if *preset == Preset::new_authored() {
            preset.name = self.source.name();
        }
        (preset.r, preset.h) = (r.unwrap_or(preset.r), h.unwrap_or(preset.h));
        preset.origin = Origin::Matched(Box::new(found.recipe(&self.photo)));
    }

    /// Takes the marks that the preset was matched with, if it was matched from this photograph.
    pub(crate) fn take_marks_of(&mut self, preset: &Preset) {
        if let Origin::Matched(recipe) = &preset.origin
            && recipe.photo_sha256 == self.photo.sha256
        {
            self.request = recipe.request.clone();
        }
    }

    /// Makes a mark, or selects the one there is.
    pub(crate) fn add(&mut self, mark: Mark) {
        if mark.shape(&self.request).is_none() {
            mark.set(&mut self.request, mark.first_shape(self.photo.width, self.photo.height));
            self.choose_mode();
        }
        self.selected = Some(mark);
    }

    /// Takes a mark away.
    pub(crate) fn remove(&mut self, mark: Mark) {
        mark.remove(&mut self.request);
        self.selected = None;
        self.choose_mode();
    }

    /// The best mode that the marks allow.
    pub(crate) fn choose_mode(&mut self) {
        if let Some(mode) = self.request.suggested_mode() {
            self.request.mode = mode;
        }
    }
}

impl std::fmt::Debug for Session {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Session").field("photo", &self.photo).field("request", &self.request).finish_non_exhaustive()
    }
}
