//! What a real metal's curve has beyond the two colours.
//!
//! Between 55° and 80° measured metals leave Hoffman's curve by up to 0.03 (gold's blue), which a fit
//! there would carry into h. A conductor of the same r and h in a wide space follows them closely, so
//! its difference from Hoffman's curve is taken off the pixels before they are fitted.

use nalgebra::Vector3;

use super::fit::BallFit;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{CosTheta, FresnelModel, Weights, gulbrandsen, hoffman};

/// Real metals are reflectances in this space; in linear Rec.709 gold's red exceeds 1.
const WIDE: RgbSpace = RgbSpace::AcesCg;

/// A conductor minus Hoffman's curve of the same r and h, linear Rec.709, at equal steps of cos θ.
pub(super) struct ConductorShape(Vec<Rgb>);

impl ConductorShape {
    const STEPS: usize = 512;

    /// Of the conductor nearest to r and h (linear Rec.709); `None` where none exists.
    pub fn of(r: Rgb, h: Rgb) -> Option<Self> {
        let [r, h] = [r, h].map(|rgb| RgbSpace::LinRec709.convert(rgb, WIDE));
        let r = r.map(|r| r.clamp(0.0, 0.9999));
        let g = r.zip(h, edge_tint);
        let h = r.zip(g, |r, g| gulbrandsen(r, g, CosTheta::MAX));
        let conductor = FresnelModel::conductor_from_r_g(r, g)?;
        let rec709_from_wide = WIDE.matrix_to(RgbSpace::LinRec709);
        let difference = |step: usize| {
            let cos_theta = CosTheta::new(step as f64 / Self::STEPS as f64);
            // A difference of reflectances: white cancels, the matrix alone converts it.
            let wide = conductor.reflectance(cos_theta) - r.zip(h, |r, h| hoffman(r, h, cos_theta));
            Rgb::from(rec709_from_wide * Vector3::from(wide))
        };
        Some(Self((0..=Self::STEPS).map(difference).collect()))
    }

    /// The difference at a cosine; zero facing, at θ_max and grazing.
    pub fn at(&self, cosine: f64) -> Rgb {
        let position = cosine.clamp(0.0, 1.0) * Self::STEPS as f64;
        let step = (position as usize).min(Self::STEPS - 1);
        self.0[step].lerp(self.0[step + 1], position - step as f64)
    }
}

/// The fitted reflectance of the three channels over the angle.
pub(super) struct MetalCurve {
    pub fits: [BallFit; 3],
    pub shape: Option<ConductorShape>,
}

impl MetalCurve {
    /// F where a pixel has these weights and this cosine.
    pub fn at(&self, weights: Weights, cosine: f64) -> [f64; 3] {
        let beyond = self.shape.as_ref().map_or(Rgb::BLACK, |shape| shape.at(cosine));
        std::array::from_fn(|i| self.fits[i].predict(weights) + beyond[i])
    }
}

/// The edge tint at which a conductor of this r has h, by bisection; the nearest end where none does.
fn edge_tint(r: f64, h: f64) -> f64 {
    const STEPS: u32 = 40;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..STEPS {
        let g = 0.5 * (low + high);
        if gulbrandsen(r, g, CosTheta::MAX) < h { low = g } else { high = g }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::preferred_metals;

    #[test]
    fn vanishes_where_the_curves_meet() {
        let shape = ConductorShape::of(Rgb([0.9, 0.7, 0.4]), Rgb([0.95, 0.85, 0.65])).unwrap();
        for cos in [CosTheta::FACING, CosTheta::MAX, CosTheta::GRAZING] {
            assert!(shape.at(cos.get()).max_abs_difference(Rgb::BLACK) < 1e-3, "{cos:?}");
        }
    }

    /// The claim of this file, on every measured metal of the library, mean over 55–80°.
    #[test]
    fn a_conductor_follows_measured_metals_closer_than_two_colours() {
        let space = RgbSpace::LinRec709;
        let (mut plain, mut shaped) = (0.0, 0.0);
        for metal in preferred_metals() {
            let (r, h) = (metal.r(space), metal.h(space));
            let Some(shape) = ConductorShape::of(r, h) else { continue };
            for angle_deg in [55.0, 60.0, 65.0, 70.0, 75.0, 80.0] {
                let cos = CosTheta::from_deg(angle_deg);
                let left = metal.reflectance(cos, space) - r.zip(h, |r, h| hoffman(r, h, cos));
                plain += left.max_abs_difference(Rgb::BLACK);
                shaped += left.max_abs_difference(shape.at(cos.get()));
            }
        }
        assert!(shaped < 0.35 * plain, "{shaped} of {plain}");
    }
}
