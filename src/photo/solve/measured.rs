//! The fit of a match to its pixels, without outliers.

use super::cells::{Cell, Counts, Outliers};
use super::fit::{BallFit, fit};
use super::pixels::MatchPixels;
use super::regions::Regions;
use super::shape::{ConductorShape, MetalCurve};
use crate::color::Rgb;

/// A fit with the cells it rests on.
pub(super) struct Measured {
    /// All usable pixels, before outliers were left out, as read.
    pub all: [Vec<Cell>; 3],
    /// The cells of the fit: outliers left out, what a conductor has beyond the two colours taken off.
    pub kept: [Vec<Cell>; 3],
    pub curve: MetalCurve,
    /// Standard deviation of a pixel around the curve.
    pub noise: [f64; 3],
    /// What the regions hold, facing and grazing.
    pub counts: [Counts; 2],
}

impl Measured {
    /// Goes over what was read for a first fit, for the scatter around it, without outliers, and for what scatters
    /// around the last.
    pub fn of(pixels: &MatchPixels) -> Self {
        let MatchPixels { readings, regions } = pixels;
        let sums = readings.sums();
        let all = sums.cells();
        let (first, _) = fit_metal(&all, regions);
        let outliers = Outliers::around(&first, readings.noise(&first));
        let (curve, kept) = fit_metal(&readings.sums_without(&outliers, &sums).cells(), regions);
        Self { all, kept, noise: readings.noise(&curve), curve, counts: readings.counts() }
    }
}

/// Fits every channel, then again with what a conductor has beyond the two colours taken off the cells.
///
/// The correction depends weakly on r and h: two rounds settle it to 1e-4. Also returns the corrected cells.
pub(super) fn fit_metal(cells: &[Vec<Cell>; 3], regions: &Regions) -> (MetalCurve, [Vec<Cell>; 3]) {
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
