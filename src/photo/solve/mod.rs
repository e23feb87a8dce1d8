//! From marks in a photograph to r and h.
//!
//! A pixel of a ball is L · (A r + B h + C) with weights that depend on the angle alone, so r and h
//! are a linear least squares fit once the light L is known.
//!
//! | file | what it holds |
//! |---|---|
//! | `view`, `light`, `reference`, `solved_light` | the photograph through its grey scale, and what L is |
//! | `regions`, `region`, `stretch`, `facing` | which pixels are read, in which cells, and which way they face |
//! | `pixels`, `spots`, `readings` | what is read of them, once, and the passes over it |
//! | `radial`, `sums`, `cells` | functions of the angle, sums over the pixels of a cell, their means |
//! | `fit`, `shape`, `measured` | the robust fit, and what a conductor has beyond the two colours |
//! | `uncertainty`, `guard`, `sharpness` | how well it is known, and what to beware of |
//! | `mirror` | the ratio of a card in a flat mirror, without a fit |
//! | `outcome`, `rendition` | the result, and the metal rendered from it |

mod cells;
mod facing;
mod fit;
mod guard;
mod light;
mod measured;
mod mirror;
mod outcome;
mod pixels;
mod radial;
mod readings;
mod reference;
mod region;
mod regions;
mod rendition;
mod shape;
mod sharpness;
mod solved_light;
mod spots;
mod stretch;
mod sums;
mod uncertainty;
mod view;

pub use outcome::{CardReading, Match, MatchError, UncertaintyBudget};
pub use pixels::MatchPixels;
pub use rendition::{Rendition, RenditionError};

use super::{LightMode, MatchRequest, Photo, Recipe};
use crate::color::RgbSpace;
use fit::{BallFit, Unknowns};
use light::Light;
use measured::Measured;
use view::View;

/// r and h of the metal marked in a photograph, in `space`, with uncertainties and the warnings of both.
pub fn solve(photo: &Photo, request: &MatchRequest, space: RgbSpace) -> Result<Match, MatchError> {
    let mut outcome = solve_marks(photo, request, space)?;
    outcome.warnings.splice(0..0, photo.warnings.iter().cloned());
    Ok(outcome)
}

fn solve_marks(photo: &Photo, request: &MatchRequest, space: RgbSpace) -> Result<Match, MatchError> {
    let view = View::of(photo, request)?;
    if request.mode == LightMode::FlatMirror {
        return mirror::solve_mirrors(&view, request, space);
    }
    let light = Light::of(&view, request)?;
    let pixels = MatchPixels::under(&view, request, &light)?;
    let measured = Measured::of(&pixels);
    let uncertainty = uncertainty::of(&view, request, &pixels.regions, &light, &measured);
    let mut outcome = Match::new(request, space, &light, &measured, &uncertainty);
    outcome.warnings = guard::warnings(&view, request, &pixels.regions, &light, &measured, &outcome);
    Ok(outcome)
}

impl Recipe {
    /// Solves again from the photograph the recipe was made from.
    pub fn solve_again(&self, photo: &Photo, space: RgbSpace) -> Result<Match, MatchError> {
        solve(photo, &self.request, space)
    }
}
