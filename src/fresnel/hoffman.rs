//! Hoffman's model: r facing the surface, h at θ_max.

use super::schlick::{fifth_power, schlick_at_theta_max};
use super::{CosTheta, schlick};

/// 7⁷ / 6⁶ = 1 / (c x⁶) at c = 1/7: what turns a reflectance difference at θ_max into `a`.
pub const PEAK_GAIN: f64 = 823_543.0 / 46_656.0;

/// 49/6, the weight of 1 − r in eq. 4.
pub const SCHLICK_GAIN: f64 = 49.0 / 6.0;

/// F(θ) ≈ S(r, c) − a c (1 − c)⁶ with `a` from [`a_from_r_h`] (paper eqs. 2 and 4). Any finite r, h.
pub fn hoffman(r: f64, h: f64, cos_theta: CosTheta) -> f64 {
    let c = cos_theta.get();
    let x = 1.0 - c;
    r + fifth_power(x) * ((1.0 - r) - a_from_r_h(r, h) * c * x)
}

/// a = (823543/46656)(r − h) + (49/6)(1 − r) (paper eq. 4).
pub fn a_from_r_h(r: f64, h: f64) -> f64 {
    PEAK_GAIN * (r - h) + SCHLICK_GAIN * (1.0 - r)
}

/// The h that a given `a` stands for; inverse of [`a_from_r_h`] in h.
pub fn h_from_r_a(r: f64, a: f64) -> f64 {
    schlick(r, CosTheta::MAX) - a / PEAK_GAIN
}

/// The h with which the model is exactly Schlick's.
pub fn h_of_schlick(r: f64) -> f64 {
    schlick_at_theta_max(r)
}

/// The weights of r, h and white at an angle: F = A r + B h + C, with A + B + C = 1.
///
/// The model is linear in both colours (by eqs. 2 and 4 of the paper), which is
/// why it converts between spaces, blends and fits exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// A(c), the weight of r.
    pub of_r: f64,
    /// B(c), the weight of h; 1 at θ_max.
    pub of_h: f64,
    /// C(c), the weight of white.
    pub of_white: f64,
}

impl Weights {
    /// A, B and C at an angle.
    pub fn at(cos_theta: CosTheta) -> Self {
        let c = cos_theta.get();
        let x = 1.0 - c;
        let x5 = fifth_power(x);
        let peak = c * x * x5;
        let of_h = PEAK_GAIN * peak;
        let of_white = x5 - SCHLICK_GAIN * peak;
        Self { of_r: 1.0 - of_h - of_white, of_h, of_white }
    }

    /// F from r and h.
    pub fn apply(self, r: f64, h: f64) -> f64 {
        self.of_r * r + self.of_h * h + self.of_white
    }
}

/// Mean over the cosine-weighted hemisphere, 2∫F c dc = r + (1 − r)/21 − a/126.
pub fn hemispherical_mean(r: f64, h: f64) -> f64 {
    r + (1.0 - r) / 21.0 - a_from_r_h(r, h) / 126.0
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::COS_THETA_MAX;

    /// Paper eq. 3, as printed.
    fn a_by_equation_3(r: f64, h: f64) -> f64 {
        let c = COS_THETA_MAX;
        (r + (1.0 - r) * (1.0 - c).powi(5) - h) / (c * (1.0 - c).powi(6))
    }

    proptest! {
        #[test]
        fn passes_through_r_h_and_white(r in -0.2..1.2, h in -0.2..1.2) {
            prop_assert_eq!(hoffman(r, h, CosTheta::FACING), r);
            prop_assert!((hoffman(r, h, CosTheta::MAX) - h).abs() < 1e-14);
            prop_assert!((hoffman(r, h, CosTheta::GRAZING) - 1.0).abs() < 1e-15);
        }

        #[test]
        fn equation_4_is_equation_3(r in 0.0..1.0, h in 0.0..1.0) {
            prop_assert!((a_from_r_h(r, h) - a_by_equation_3(r, h)).abs() < 1e-12);
        }

        #[test]
        fn schlicks_h_gives_schlick(r in 0.0..1.0, c in 0.0..1.0) {
            let c = CosTheta::new(c);
            prop_assert!((hoffman(r, h_of_schlick(r), c) - schlick(r, c)).abs() < 1e-14);
        }

        #[test]
        fn a_and_h_invert(r in 0.0..1.0, a in -10.0..20.0) {
            prop_assert!((a_from_r_h(r, h_from_r_a(r, a)) - a).abs() < 1e-12);
        }

        #[test]
        fn linear_form_is_the_model(r in -0.2..1.2, h in -0.2..1.2, c in 0.0..1.0) {
            let c = CosTheta::new(c);
            let weights = Weights::at(c);
            prop_assert!((weights.of_r + weights.of_h + weights.of_white - 1.0).abs() < 1e-15);
            prop_assert!((weights.apply(r, h) - hoffman(r, h, c)).abs() < 1e-14);
        }

        #[test]
        fn hemispherical_mean_is_the_integral(r in 0.0..1.0, h in 0.0..1.0) {
            // Simpson's rule with n panels converges as n⁻⁴.
            let n = 512;
            let f = |i: i32| { let c = f64::from(i) / f64::from(n); 2.0 * c * hoffman(r, h, CosTheta::new(c)) };
            let simpson: f64 = (0..=n).map(|i| f(i) * if i == 0 || i == n { 1.0 } else if i % 2 == 1 { 4.0 } else { 2.0 }).sum();
            prop_assert!((simpson / (3.0 * f64::from(n)) - hemispherical_mean(r, h)).abs() < 1e-9);
        }
    }
}
