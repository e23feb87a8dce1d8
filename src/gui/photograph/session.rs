//! One open photograph.

use std::sync::Arc;

use eframe::egui::{Context, Vec2};

use super::comparison::Comparison;
use super::outlining::{Found, Outlining, Place, Search};
use super::{Developer, Development, Loaded, Looking, Mark, Need, Source, missing};
use crate::color::{Rgb, RgbSpace};
use crate::gui::job::Follower;
use crate::metal::Metal;
use crate::photo::{LightMode, Match, MatchRequest, OutlineError, Photo, Preview, solve};
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
    /// The mark that the next drag draws anew.
    pub placing: Option<Mark>,
    /// The marks before the drag under way, for Esc.
    pub before_drag: Option<MatchRequest>,
    /// Points of the screen for each pixel, over the one that fits; 1 shows all.
    pub zoom: f32,
    /// What is in the middle, as a share of the size off the centre.
    pub pan: Vec2,
    /// Whether the preset follows the match.
    pub is_followed: bool,
    /// The photograph against the rendered match.
    pub comparison: Comparison,
    /// Whether a person chose the mode; else the best that is marked is taken.
    is_mode_chosen: bool,
    /// The outline to look for in the next frame.
    wanted_outline: Option<Search>,
    outlining: Outlining,
    solving: Follower<Asked, Result<Match, String>>,
    result: Option<Result<Arc<Match>, String>>,
    /// Counts the results.
    generation: u64,
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
        let mut session = Self::unmarked(source, loaded);
        if !session.take_marks_of(preset)
            && let Source::Sample(sample) = &session.source
        {
            session.take(sample.facts.request.clone());
        }
        session
    }

    fn unmarked(source: Source, loaded: Loaded) -> Self {
        Self {
            source,
            photo: Arc::new(loaded.photo),
            preview: Arc::new(loaded.preview),
            developer: Developer::default(),
            development: Development::default(),
            request: MatchRequest::default(),
            selected: None,
            placing: None,
            before_drag: None,
            zoom: 1.0,
            pan: Vec2::ZERO,
            is_followed: true,
            comparison: Comparison::default(),
            is_mode_chosen: false,
            wanted_outline: None,
            outlining: Outlining::default(),
            solving: Follower::default(),
            result: None,
            generation: 0,
        }
    }

    /// True while something is computed.
    pub(crate) fn is_busy(&self) -> bool {
        self.is_settling() || self.developer.is_busy() || self.comparison.is_busy()
    }

    /// True while marks or numbers are on their way.
    pub(crate) fn is_settling(&self) -> bool {
        self.solving.is_busy() || self.outlining.is_busy() || self.wanted_outline.is_some()
    }

    /// What the mode still needs.
    pub(crate) fn missing(&self) -> Vec<Need> {
        missing(self.request.mode, &self.request)
    }

    /// How the match stands.
    pub(crate) fn matching(&self) -> Matching<'_> {
        match &self.result {
            _ if !self.missing().is_empty() => Matching::NotMarked,
            Some(Ok(found)) => Matching::Solved(found),
            Some(Err(sentence)) => Matching::Failed(sentence),
            None => Matching::Working,
        }
    }

    /// Solves again when marks or space have changed; gives a match that has just been found.
    pub(crate) fn solve(&mut self, ctx: &Context, space: RgbSpace) -> Option<Arc<Match>> {
        if !self.missing().is_empty() {
            return None;
        }
        let asked = Asked { request: self.request.clone(), space };
        let photo = self.photo.clone();
        let work =
            move |asked: Asked, _: &_| solve(&photo, &asked.request, asked.space).map_err(|error| error.to_string());
        let (_, result) = self.solving.follow(ctx, "match", asked, work)?;
        let result = result.map(Arc::new);
        self.generation += 1;
        self.result = Some(result.clone());
        result.ok()
    }

    /// Sees to it that the comparison follows the match, where one is looked at.
    pub(crate) fn compare(&mut self, ctx: &Context) {
        if let Some(Ok(found)) = self.result.as_ref().filter(|_| self.comparison.looking != Looking::Photograph) {
            let exposure_ev = self.development.exposure_ev;
            self.comparison.follow(ctx, &self.photo, self.generation, found, exposure_ev);
        }
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

    /// Takes the marks that the preset was matched with; false if it was not matched from this photograph.
    /// Numbers that were changed by hand since are not solved over.
    pub(crate) fn take_marks_of(&mut self, preset: &Preset) -> bool {
        let (recipe, is_untouched) = match &preset.origin {
            Origin::Matched(recipe) => (recipe, true),
            Origin::Edited { from } => match &**from {
                Origin::Matched(recipe) => (recipe, false),
                _ => return false,
            },
            _ => return false,
        };
        let is_of_this = recipe.photo_sha256 == self.photo.sha256;
        if is_of_this {
            self.take(recipe.request.clone());
            self.is_followed &= is_untouched;
        }
        is_of_this
    }

    /// Takes marks that were saved, with their mode.
    fn take(&mut self, request: MatchRequest) {
        self.is_mode_chosen = request.suggested_mode() != Some(request.mode);
        self.request = request;
        self.placing = None;
        self.selected = self.selected.filter(|mark| mark.shape(&self.request).is_some());
    }

    /// Makes a mark that the next drag draws anew, or selects the one there is.
    pub(crate) fn add(&mut self, mark: Mark) {
        if mark.shape(&self.request).is_none() {
            mark.set(&mut self.request, mark.first_shape(self.photo.width, self.photo.height));
            self.placing = Some(mark).filter(|mark| !self.take_known_greys(*mark));
            self.choose_mode();
            if mark.is_outline() {
                self.snap(mark);
            }
        }
        self.comparison.looking = Looking::Photograph;
        self.selected = Some(mark);
    }

    /// A sample says where its neutral patches are; true if it did.
    fn take_known_greys(&mut self, mark: Mark) -> bool {
        let Source::Sample(sample) = &self.source else { return false };
        let is_known = mark == Mark::GreyScale && !sample.facts.greys.is_empty();
        if is_known {
            (self.request.greys, self.request.grey_corners) = (sample.facts.greys.clone(), None);
        }
        is_known
    }

    /// Takes a mark away.
    pub(crate) fn remove(&mut self, mark: Mark) {
        mark.remove(&mut self.request);
        (self.selected, self.placing) = (None, None);
        self.choose_mode();
    }

    /// Sets the light by eye to that of a white file, or takes it away.
    pub(crate) fn set_light(&mut self, light: Option<Rgb>) {
        self.request.light = light;
        self.choose_mode();
    }

    /// The best mode that the marks allow, unless a person has chosen one. A ball alone allows solving for its
    /// light, but that is rarely what it was marked for: this mode is suggested, not taken.
    fn choose_mode(&mut self) {
        let suggested = self.request.suggested_mode().filter(|mode| *mode != LightMode::SolvedLight);
        if let Some(mode) = suggested.filter(|_| !self.is_mode_chosen) {
            self.request.mode = mode;
        }
    }

    /// Takes the mode that a person has chosen.
    pub(crate) fn set_mode(&mut self, mode: LightMode) {
        self.is_mode_chosen = self.request.suggested_mode() != Some(mode);
        self.request.mode = mode;
    }

    /// The metal of the reference ball.
    pub(crate) fn set_reference_metal(&mut self, metal: &Metal) {
        if let Some(ball) = &mut self.request.reference_ball {
            ball.metal = metal.id.clone();
        }
    }

    /// Looks for the edge nearest to an outline.
    pub(crate) fn snap(&mut self, mark: Mark) {
        if let Some(shape) = mark.shape(&self.request).filter(|_| mark.is_outline()) {
            self.wanted_outline = Some(Search { mark, place: Place::Near(shape) });
        }
    }

    /// Looks for the ball everywhere but where the reference ball is marked.
    pub(crate) fn find_ball(&mut self) {
        self.comparison.looking = Looking::Photograph;
        let but = self.request.reference_ball.as_ref().map(|ball| ball.circle);
        self.wanted_outline = Some(Search { mark: Mark::Ball, place: Place::Everywhere { but } });
    }

    /// Starts the search that is wanted and takes over what one has found.
    pub(crate) fn outline(&mut self, ctx: &Context) {
        if let Some(search) = self.wanted_outline.take()
            && let Err(error) = self.outlining.start(ctx, &self.photo, search)
        {
            log::error!("outline: no thread could be started: {error}");
        }
        let Some((search, Ok(outline))) = self.outlining.poll() else { return };
        let is_where_it_was = match search.place {
            Place::Near(shape) => search.mark.shape(&self.request) == Some(shape),
            Place::Everywhere { .. } => true,
        };
        if is_where_it_was {
            search.mark.set(&mut self.request, outline.shape());
            if search.mark.is_body() {
                self.request.circle_uncertainty_px = Some(outline.uncertainty_px());
                self.selected = Some(search.mark);
            }
            self.choose_mode();
        }
    }

    /// What the last search for the outline of a mark came to, if the mark is still there.
    pub(crate) fn found_outline(&self, mark: Mark) -> Option<&Found> {
        self.outlining.last(mark, mark.shape(&self.request))
    }

    /// Why the ball was not found anywhere, if it was looked for last.
    pub(crate) fn found_nowhere(&self) -> Option<&OutlineError> {
        self.outlining.found_nowhere()
    }

    /// True while an edge is being looked for.
    pub(crate) fn is_outlining(&self) -> bool {
        self.outlining.is_busy() || self.wanted_outline.is_some()
    }
}

impl std::fmt::Debug for Session {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Session").field("photo", &self.photo).field("request", &self.request).finish_non_exhaustive()
    }
}
