//! Generalized Schlick with an F82 tint, as in MaterialX.

use super::hoffman::PEAK_GAIN;
use super::{COS_THETA_MAX, CosTheta};

/// F = G − a c x⁶, G = r0 + (r90 − r0) xᵖ, a = G(1/7)(1 − t) · 7⁷/6⁶ (Hoffman 2023; MaterialX `generalized_schlick_bsdf`).
///
/// Any finite r0, r90, t; p > 0. With r90 = 1 and p = 5 this is [`f82_tint`](super::f82_tint).
pub fn generalized_schlick(r0: f64, t: f64, r90: f64, p: f64, cos_theta: CosTheta) -> f64 {
    let g = |c: f64| r0 + (r90 - r0) * (1.0 - c).powf(p);
    let c = cos_theta.get();
    let a = g(COS_THETA_MAX) * (1.0 - t) * PEAK_GAIN;
    g(c) - a * c * (1.0 - c).powi(6)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::f82_tint;

    #[test]
    fn standard_exponent_is_f82_tint() {
        for step in 0..=90 {
            let c = CosTheta::from_deg(f64::from(step));
            assert!((generalized_schlick(0.6, 0.8, 1.0, 5.0, c) - f82_tint(0.6, 0.8, c)).abs() < 1e-14);
        }
    }
}
