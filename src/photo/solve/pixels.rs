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

    /// r, then h, of each channel (linear Rec.709) by least squares in closed form. It fits the means of cells, each
    /// weighted by its number of pixels, which comes close to a fit of every pixel alike: within a cell the weights of
    /// r and h hardly differ. Highlights and the mirrored camera pull them. `None` where nothing shows them.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Rgb, RgbSpace};
    use crate::fresnel::{CosTheta, Weights};
    use crate::number::largest;
    use crate::photo::solve::fit::solve_rows;
    use crate::photo::{Circle, Cylinder, LightMode, solve};

    const BALL: Circle = Circle::new(100.2, 99.4, 92.7);
    const METAL: [[f64; 3]; 2] = [[0.6, 0.5, 0.4], [0.8, 0.75, 0.7]];

    /// The weights of r and h where the middle of a pixel shows the ball, and its angle in degrees.
    fn weights(column: u32, row: u32) -> Option<(Weights, f64)> {
        let angle_deg = BALL.angle_deg(f64::from(column) + 0.5, f64::from(row) + 0.5)?;
        Some((Weights::at(CosTheta::from_deg(angle_deg)), angle_deg))
    }

    /// A ball of two colours under a light of 1, with a lamp.
    fn photo() -> Photo {
        let pixel = |i: u32| {
            let (column, row) = (i % 200, i / 200);
            let is_lamp = (60..75).contains(&column) && (70..80).contains(&row);
            let metal = |(weights, _): (Weights, f64)| {
                [0, 1, 2].map(|i| weights.apply(METAL[0][i], METAL[1][i]) as f32 + if is_lamp { 2.0 } else { 0.0 })
            };
            weights(column, row).map_or([0.1; 3], metal)
        };
        Photo::from_linear("ball", 200, 200, (0..200 * 200).map(pixel).collect())
    }

    fn request() -> MatchRequest {
        MatchRequest { mode: LightMode::ByEye, circle: Some(BALL), light: Some(Rgb::WHITE), ..MatchRequest::default() }
    }

    fn off(found: [[Option<f64>; 3]; 2], expected: [[f64; 3]; 2]) -> f64 {
        let pairs = found.into_iter().flatten().zip(expected.into_iter().flatten());
        largest(pairs.map(|(found, expected)| (found.unwrap() - expected).abs()))
    }

    #[test]
    fn the_robust_fit_is_that_of_a_match() {
        let (photo, request) = (photo(), request());
        let fit = MatchPixels::read(&photo, &request).unwrap().robust_fit();
        let found = solve(&photo, &request, RgbSpace::LinRec709).unwrap();
        assert!(off(fit, [found.r, found.h].map(|channels| channels.map(Option::unwrap))) < 1e-12, "{fit:?} {found:?}");
    }

    /// A lamp pulls both alike.
    #[test]
    fn least_squares_of_cells_come_close_to_those_of_pixels() {
        let photo = photo();
        let farthest = 1.0 - Regions::RIM_MARGIN_PX / BALL.radius;
        let is_read = |angle_deg: f64| {
            (0.0..40.0).contains(&angle_deg) || (55.0..83.0_f64.min(farthest.asin().to_degrees())).contains(&angle_deg)
        };
        let places = || (0..200 * 200_u32).map(|i| (i % 200, i / 200));
        let plain = [0, 1, 2].map(|channel| {
            let row = |(column, row)| {
                let (weights, angle_deg) = weights(column, row)?;
                is_read(angle_deg).then(|| (weights, photo.pixel(column, row).unwrap().rgb[channel]))
            };
            solve_rows(places().filter_map(row))
        });
        let plain = [plain.map(|(r, _)| r.unwrap()), plain.map(|(_, h)| h.unwrap())];
        let fit = MatchPixels::read(&photo, &request()).unwrap().least_squares();
        assert!(off(fit, plain) < 0.002, "{fit:?} {plain:?}");
        assert!(off(fit, METAL) > 0.01, "{fit:?}");
    }

    #[test]
    fn two_outlines_are_refused() {
        let cylinder = Some(Cylinder::new([10.0, 20.0], [90.0, 20.0], 15.0));
        let read = MatchPixels::read(&photo(), &MatchRequest { cylinder, ..request() });
        assert_eq!(read.map(|pixels| pixels.count()), Err(MatchError::TwoBodies));
    }
}
