//! Schlick's curve with a polynomial correction: what a known metal is baked to.

use serde::{Deserialize, Serialize};

use super::{CosTheta, schlick};
use crate::color::Rgb;

/// F(θ) ≈ S(r, c) + c xᵖ (b₀ + b₁ t + b₂ t² + …) with x = 1 − c and t = x − c, channel by channel.
///
/// t runs from −1 to 1: in powers of it coefficients stay small, of which ten in powers of x reach 1e5 and cancel.
/// The correction vanishes at 0° and 90°, like the term of Lazányi & Szirmay-Kalos 2005 that it continues: with
/// p = 6 and one coefficient, b₀ = −a, it is Hoffman's model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SchlickSeries {
    /// Reflectance facing the surface.
    pub r: Rgb,
    /// p, at least 1.
    pub first_power: u32,
    /// b₀, b₁, …
    pub coefficients: Vec<Rgb>,
}

impl SchlickSeries {
    /// The reflectance at an angle, unclamped.
    pub fn reflectance(&self, cos_theta: CosTheta) -> Rgb {
        let x = 1.0 - cos_theta.get();
        let t = x - cos_theta.get();
        let sum = self.coefficients.iter().rev().fold(Rgb::BLACK, |sum, b| sum * t + *b);
        self.r.map(|r| schlick(r, cos_theta)) + sum * (cos_theta.get() * x.powi(self.first_power.cast_signed()))
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
            coefficients: vec![Rgb::splat(-a_from_r_h(r, h)), Rgb::BLACK],
        };
        for c in whole_degrees() {
            assert!((series.reflectance(c)[1] - hoffman(r, h, c)).abs() < 1e-14);
        }
    }
}
