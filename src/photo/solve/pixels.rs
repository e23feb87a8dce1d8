//! The pixels of a match, read once, and the fits to them alone.

use super::fit::{Unknowns, least_squares};
use super::light::Light;
use super::measured::Measured;
use super::outcome::MatchError;
use super::readings::Readings;
use super::regions::Regions;
use super::view::View;
use crate::photo::{MatchRequest, Photo};

/// The pixels that a match rests on, over their light: what [`solve`](crate::photo::solve) reads before it fits.
#[derive(Debug)]
pub struct MatchPixels {
    pub(super) readings: Readings,
    pub(super) regions: Regions,
}

impl MatchPixels {
    /// Reads what is marked in a photograph. Cards in a flat mirror are areas alone, which are an error here.
    pub fn read(photo: &Photo, request: &MatchRequest) -> Result<Self, MatchError> {
        let view = View::of(photo, request)?;
        let light = Light::of(&view, request)?;
        Self::under(&view, request, &light)
    }

    /// Reads them under a light.
    pub(super) fn under(view: &View, request: &MatchRequest, light: &Light) -> Result<Self, MatchError> {
        let regions = Regions::of(view, request)?;
        Ok(Self { readings: Readings::of(view, &regions, light), regions })
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.readings.counts().iter().map(|counts| counts.pixels).sum()
    }

    /// r, then h, of each channel (linear Rec.709) by least squares in closed form, in which every pixel counts alike:
    /// highlights and the mirrored camera pull them. `None` where nothing shows them.
    pub fn least_squares(&self) -> [[Option<f64>; 3]; 2] {
        let fits = self.readings.sums().cells().map(|cells| {
            let counts: Vec<f64> = cells.iter().map(|cell| cell.count as f64).collect();
            least_squares(&cells, &counts, Unknowns::of(&cells, &self.regions))
        });
        [fits.map(|fit| fit.0), fits.map(|fit| fit.1)]
    }

    /// The same by the fit of a match: robust, without outliers, and with what a conductor has beyond the two colours.
    pub fn robust_fit(&self) -> [[Option<f64>; 3]; 2] {
        let fits = Measured::of(self).curve.fits;
        [fits.each_ref().map(|fit| fit.r), fits.each_ref().map(|fit| fit.h)]
    }
}
