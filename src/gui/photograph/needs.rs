//! What a mode still needs before anything can be solved.

use super::Mark;
use crate::photo::{LightMode, MatchRequest};

/// Something that is missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Need {
    /// A mark in the photograph.
    Mark(Mark),
    /// The light that a person sets.
    Light,
}

impl Need {
    /// The word for it in a list.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Mark(mark) => mark.kind(),
            Self::Light => "Light",
        }
    }

    /// What it is for.
    pub(crate) fn purpose(self) -> &'static str {
        match self {
            Self::Mark(mark) => mark.purpose(),
            Self::Light => "The pixel that a perfect mirror would have in the metal's place, set by eye",
        }
    }
}

/// What a mode needs and a request lacks, in the order in which it is marked; a cylinder serves as a ball does.
pub(crate) fn missing(mode: LightMode, request: &MatchRequest) -> Vec<Need> {
    let has_body = request.body().is_some();
    let has_metal = has_body || request.facing.is_some() || request.edge.is_some();
    let ball = (has_body, Need::Mark(Mark::Ball));
    let metal = (has_metal, Need::Mark(Mark::Ball));
    let needs = match mode {
        LightMode::FlatMirror => vec![(!request.mirrors.is_empty(), Need::Mark(Mark::Direct(0)))],
        LightMode::ReferenceBall => vec![ball, (request.reference_ball.is_some(), Need::Mark(Mark::Reference))],
        LightMode::Card => {
            let has_white = !request.cards.is_empty() || !request.greys.is_empty();
            vec![metal, (has_white, Need::Mark(Mark::Card(0)))]
        }
        LightMode::Backdrop => {
            let has_rim = has_body || request.edge.is_some();
            vec![(has_rim, Need::Mark(Mark::Ball)), (request.backdrop.is_some(), Need::Mark(Mark::Backdrop))]
        }
        LightMode::SolvedLight => vec![ball],
        LightMode::ByEye => vec![metal, (request.light.is_some(), Need::Light)],
    };
    needs.into_iter().filter_map(|(is_there, need)| (!is_there).then_some(need)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Rgb, RgbSpace};
    use crate::photo::{MatchError, Photo, solve};

    fn place(request: &mut MatchRequest, need: Need) {
        match need {
            Need::Mark(mark) => mark.set(request, mark.first_shape(100, 100)),
            Need::Light => request.light = Some(Rgb::WHITE),
        }
    }

    /// The list is what the solver asks for: with any of it missing it refuses, with all of it it does not.
    #[test]
    fn the_solver_asks_for_what_is_missing() {
        let photo = Photo::from_linear("grey", 100, 100, vec![[0.5; 3]; 10_000]);
        for mode in LightMode::ALL {
            let mut request = MatchRequest { mode, ..MatchRequest::default() };
            while let Some(need) = missing(mode, &request).into_iter().next() {
                let refused = solve(&photo, &request, RgbSpace::LinRec709).unwrap_err();
                assert!(
                    matches!(refused, MatchError::ModeNotMarked { .. } | MatchError::NothingMarked),
                    "{mode}: {refused}"
                );
                place(&mut request, need);
            }
            let solved = solve(&photo, &request, RgbSpace::LinRec709);
            let is_asking = matches!(solved, Err(MatchError::ModeNotMarked { .. } | MatchError::NothingMarked));
            assert!(!is_asking || mode == LightMode::SolvedLight, "{mode}: {solved:?}");
        }
    }

    #[test]
    fn the_suggested_mode_lacks_no_light() {
        let mut request = MatchRequest::default();
        for mark in [Mark::Ball, Mark::Backdrop, Mark::Card(0), Mark::Reference, Mark::Direct(0)] {
            mark.set(&mut request, mark.first_shape(100, 100));
            let mode = request.suggested_mode().unwrap();
            assert!(missing(mode, &request).is_empty(), "{mode}");
        }
    }
}
