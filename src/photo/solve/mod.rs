//! From marks in a photograph to r and h.
//!
//! A pixel of a ball is L · (A r + B h + C) with weights that depend on the angle alone, so r and h
//! are a linear least squares fit once the light L is known. [`light`] says what L is, [`readings`] reads
//! the pixels into [`cells`], [`fit`] solves, [`shape`] takes off what real metals have beyond, [`uncertainty`] says how well, [`guard`] what to beware of.

mod cells;
mod facing;
mod fit;
mod guard;
mod light;
mod mirror;
mod outcome;
mod radial;
mod readings;
mod reference;
mod region;
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
pub use rendition::{Rendition, RenditionError};

use super::{LightMode, MatchRequest, Photo, Recipe};
use crate::color::{Rgb, RgbSpace};
use cells::{Cell, Outliers};
use fit::{BallFit, Unknowns, fit};
use light::Light;
use readings::Readings;
use region::Regions;
use shape::{ConductorShape, MetalCurve};
use view::View;

/// r and h of the metal marked in a photograph, in `space`, with uncertainties and the warnings of both.
pub fn solve(photo: &Photo, request: &MatchRequest, space: RgbSpace) -> Result<Match, MatchError> {
    let mut outcome = solve_marks(photo, request, space)?;
    outcome.warnings.splice(0..0, photo.warnings.iter().cloned());
    Ok(outcome)
}

fn solve_marks(photo: &Photo, request: &MatchRequest, space: RgbSpace) -> Result<Match, MatchError> {
    if request.circle.is_some() && request.cylinder.is_some() {
        return Err(MatchError::TwoBodies);
    }
    let view = View::of(photo, request)?;
    if request.mode == LightMode::FlatMirror {
        return mirror::solve_mirrors(&view, request, space);
    }
    let light = Light::of(&view, request)?;
    let regions = Regions::of(&view, request)?;
    let readings = Readings::of(&view, &regions, &light);
    let measured = measure(&readings, &regions);
    let noise = readings.noise(&measured.curve);
    let uncertainty = uncertainty::of(&view, request, &regions, &light, &measured, noise);
    let mut outcome = Match::new(request, space, &light, &measured, &uncertainty);
    outcome.warnings = guard::warnings(&view, request, &regions, &light, &measured, &outcome);
    Ok(outcome)
}

impl Recipe {
    /// Solves again from the photograph the recipe was made from.
    pub fn solve_again(&self, photo: &Photo, space: RgbSpace) -> Result<Match, MatchError> {
        solve(photo, &self.request, space)
    }
}

/// A fit with the cells it rests on.
struct Measured {
    /// All usable pixels, before outliers were left out, as read.
    all: [Vec<Cell>; 3],
    /// The cells of the fit: outliers left out, what a conductor has beyond the two colours taken off.
    kept: [Vec<Cell>; 3],
    curve: MetalCurve,
    /// What the regions hold, facing and grazing.
    counts: [cells::Counts; 2],
}

/// Goes over what was read three times: for a first fit, for the scatter around it, and without outliers.
fn measure(readings: &Readings, regions: &Regions) -> Measured {
    let sums = readings.sums();
    let all = sums.cells();
    let (first, _) = fit_metal(&all, regions);
    let outliers = Outliers::around(&first, readings.noise(&first));
    let (curve, kept) = fit_metal(&readings.sums_without(&outliers, &sums).cells(), regions);
    Measured { all, kept, curve, counts: readings.counts() }
}

/// Fits every channel, then again with what a conductor has beyond the two colours taken off the cells.
///
/// The correction depends weakly on r and h: two rounds settle it to 1e-4. Also returns the corrected cells.
fn fit_metal(cells: &[Vec<Cell>; 3], regions: &Regions) -> (MetalCurve, [Vec<Cell>; 3]) {
    const ROUNDS: usize = 2;
    let fit_all = |cells: &[Vec<Cell>; 3]| std::array::from_fn(|i| fit(&cells[i], regions));
    let mut curve = MetalCurve { fits: fit_all(cells), shape: None };
    let mut corrected = cells.clone();
    for _ in 0..ROUNDS {
        let Some(shape) = shape_of(&curve.fits) else { break };
        let corrected_cell =
            |cell: &Cell, i| Cell { reflectance: cell.reflectance - shape.at(cell.cosine)[i], ..*cell };
        corrected = std::array::from_fn(|i| cells[i].iter().map(|cell| corrected_cell(cell, i)).collect());
        curve = MetalCurve { fits: fit_all(&corrected), shape: Some(shape) };
    }
    (curve, corrected)
}

/// The conductor shape of three complete fits.
fn shape_of(fits: &[BallFit; 3]) -> Option<ConductorShape> {
    let complete = |of: fn(&BallFit) -> Option<f64>| Some(Rgb([of(&fits[0])?, of(&fits[1])?, of(&fits[2])?]));
    ConductorShape::of(complete(|fit| fit.r)?, complete(|fit| fit.h)?)
}
