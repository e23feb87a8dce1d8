//! The reflectance of a metal over the angle, tabulated from its spectral truth.

use super::Metal;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::CosTheta;

/// F over cos θ in linear Rec.709: exact spectral reflectance (never the r, h model) at equal steps of cos θ.
///
/// Fresnel's curve is smooth in cos θ, so that straight lines between the steps are within 1e-4 of it.
#[derive(Clone, Debug)]
pub struct ReflectanceTable(Vec<Rgb>);

impl ReflectanceTable {
    const STEPS: usize = 512;

    /// Tabulates a metal.
    pub fn of(metal: &Metal) -> Self {
        let at = |step: usize| metal.reflectance(CosTheta::new(step as f64 / Self::STEPS as f64), RgbSpace::LinRec709);
        Self((0..=Self::STEPS).map(at).collect())
    }

    /// F at a cosine, limited to `[0, 1]`.
    pub fn at(&self, cosine: f64) -> Rgb {
        let position = cosine.clamp(0.0, 1.0) * Self::STEPS as f64;
        let step = (position as usize).min(Self::STEPS - 1);
        self.0[step].lerp(self.0[step + 1], position - step as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;

    #[test]
    fn lies_on_the_curve() {
        let metal = metal_by_name("gold").unwrap();
        let table = ReflectanceTable::of(metal);
        for angle_deg in [0.0, 31.0, 60.5, 75.3, 81.8, 88.0] {
            let cos = CosTheta::from_deg(angle_deg);
            let truth = metal.reflectance(cos, RgbSpace::LinRec709);
            assert!(table.at(cos.get()).max_abs_difference(truth) < 1e-4, "{angle_deg}");
        }
    }
}
