//! Schlick's curve with a polynomial correction: what a known metal is baked to.

use serde::{Deserialize, Serialize};

use super::{CosTheta, schlick};
use crate::color::Rgb;

/// F(θ) ≈ S(r, c) + c xᵖ (b₀ + b₁ t + b₂ t² + …) with x = 1 − c and t = (1 − (2 + β) c)/(1 + β c), channel by channel.
///
/// t runs from 1 at 90° to −1 at 0°: in powers of it coefficients stay small, of which ten in powers of x reach 1e5 and
/// cancel. β > 0 spends more of them on the angles near 90°, where metals turn most.
/// The correction vanishes at 0° and 90°, like the term of Lazányi & Szirmay-Kalos 2005 that it continues: with
/// p = 6 and one coefficient, b₀ = −a, it is Hoffman's model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SchlickSeries {
    /// Reflectance facing the surface.
    pub r: Rgb,
    /// p, at least 1.
    pub first_power: u32,
    /// β, at least 0.
    pub bend: f64,
    /// b₀, b₁, …
    pub coefficients: Vec<Rgb>,
}

impl SchlickSeries {
    /// β for measured metals: with ten coefficients zinc and caesium, the farthest off of the library, are about equally
    /// far from their spectra, .0125 ΔE.
    pub const BEND_OF_METALS: f64 = 2.5;

    /// The reflectance at an angle, unclamped.
    pub fn reflectance(&self, cos_theta: CosTheta) -> Rgb {
        let (x, t) = (1.0 - cos_theta.get(), Self::variable(self.bend, cos_theta));
        let sum = self.coefficients.iter().rev().fold(Rgb::BLACK, |sum, b| sum * t + *b);
        self.r.map(|r| schlick(r, cos_theta)) + sum * (cos_theta.get() * x.powi(self.first_power.cast_signed()))
    }

    /// t, with this β.
    pub fn variable(bend: f64, cos_theta: CosTheta) -> f64 {
        let c = cos_theta.get();
        (1.0 - (2.0 + bend) * c) / (1.0 + bend * c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::{a_from_r_h, hoffman, whole_degrees};

    #[test]
    fn one_coefficient_on_the_sixth_power_is_hoffman() {
        let (r, h) = (0.8, 0.7);
        let series = SchlickSeries {
            r: Rgb::splat(r),
            first_power: 6,
            bend: 1.5,
            coefficients: vec![Rgb::splat(-a_from_r_h(r, h)), Rgb::BLACK],
        };
        for c in whole_degrees() {
            assert!((series.reflectance(c)[1] - hoffman(r, h, c)).abs() < 1e-14);
        }
    }
}
