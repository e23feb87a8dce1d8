//! F82-tint: the same curve, with h given as a multiple of Schlick's value.

use super::schlick::schlick_at_theta_max;
use super::{CosTheta, hoffman};

/// Hoffman's curve with h = t · S(r, 1/7) (Kutz, Hašan & Edmondson 2021; OpenPBR `specular_color`).
///
/// t = 1 is Schlick. t is no colour: convert r and h between spaces, then derive it.
pub fn f82_tint(r: f64, t: f64, cos_theta: CosTheta) -> f64 {
    hoffman(r, h_from_r_t(r, t), cos_theta)
}

/// h = t (q + (1 − q) r).
pub fn h_from_r_t(r: f64, t: f64) -> f64 {
    t * schlick_at_theta_max(r)
}

/// t = h / (q + (1 − q) r). Finite for every r > −0.861; unclamped, so measured metals may exceed 1.
pub fn t_from_r_h(r: f64, h: f64) -> f64 {
    h / schlick_at_theta_max(r)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::schlick::{SCHLICK_WEIGHT_AT_MAX, fifth_power, schlick};

    #[test]
    fn white_tint_is_schlick() {
        for step in 0..=20 {
            let c = CosTheta::new(f64::from(step) / 20.0);
            assert!((f82_tint(0.4, 1.0, c) - schlick(0.4, c)).abs() < 1e-14);
        }
    }

    #[test]
    fn schlick_weight_is_the_fifth_power() {
        assert!((SCHLICK_WEIGHT_AT_MAX - fifth_power(6.0 / 7.0)).abs() < 1e-15);
    }

    /// MaterialX documents its default gold; converted by the identity of this file.
    #[test]
    fn tint_of_materialx_gold() {
        let t = [t_from_r_h(0.9442, 0.9537), t_from_r_h(0.7762, 0.8796), t_from_r_h(0.3733, 0.6596)];
        for (got, want) in t.iter().zip([0.9831, 0.9999, 0.9945]) {
            assert!((got - want).abs() < 2e-4, "{got} {want}");
        }
    }
}
