//! Schlick's approximation.

use super::CosTheta;

/// x⁵ with x = 1 − c, by multiplication: `pow` of a slightly negative x is NaN in shipped shaders.
pub(super) fn fifth_power(x: f64) -> f64 {
    let x2 = x * x;
    x2 * x2 * x
}

/// F(θ) ≈ r + (1 − r)(1 − cos θ)⁵ (Schlick 1994; paper eq. 1). Any finite r.
pub fn schlick(r: f64, cos_theta: CosTheta) -> f64 {
    r + (1.0 - r) * fifth_power(1.0 - cos_theta.get())
}

/// S(r, 1/7), Schlick's value at θ_max: q + (1 − q) r with q = (6/7)⁵.
pub fn schlick_at_theta_max(r: f64) -> f64 {
    SCHLICK_WEIGHT_AT_MAX + (1.0 - SCHLICK_WEIGHT_AT_MAX) * r
}

/// q = (6/7)⁵, the weight of white in Schlick's curve at θ_max.
pub const SCHLICK_WEIGHT_AT_MAX: f64 = 7776.0 / 16807.0;
