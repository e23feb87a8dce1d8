//! Lazányi's error term on top of Schlick.

use super::{CosTheta, schlick};

/// F(θ) ≈ S(r, c) − a c (1 − c)^α (Lazányi & Szirmay-Kalos 2005; paper eq. 2).
///
/// Any finite r and a; α > 0. The correction peaks at c = 1 / (1 + α).
pub fn lazanyi(r: f64, a: f64, alpha: f64, cos_theta: CosTheta) -> f64 {
    let c = cos_theta.get();
    schlick(r, cos_theta) - a * c * (1.0 - c).powf(alpha)
}
