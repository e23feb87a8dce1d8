//! The measured curve beneath the preset, computed once for each metal and space.

use std::sync::OnceLock;

use crate::color::{Rgb, RgbSpace};
use crate::fresnel::CosTheta;
use crate::metal::{Metal, metals};

/// Degrees between two points of a curve.
const STEP_DEG: f64 = 0.5;

/// The angles every curve is drawn at, 0° to 90°.
pub(crate) fn curve_angles_deg() -> impl ExactSizeIterator<Item = f64> + Clone {
    (0..=180u8).map(|step| f64::from(step) * STEP_DEG)
}

/// Reflectance at each of [`curve_angles_deg`].
pub(crate) type Curve = Vec<Rgb>;

/// The colour of a curve at any angle, linear between its points.
pub(crate) fn at_angle(curve: &[Rgb], angle_deg: f64) -> Rgb {
    let position = (angle_deg / STEP_DEG).clamp(0.0, (curve.len() - 1) as f64);
    let index = (position as usize).min(curve.len() - 2);
    curve[index].lerp(curve[index + 1], position - index as f64)
}

/// Curves by the spectral route; each costs 401 wavelengths at 181 angles, so the last one is kept.
#[derive(Debug, Default)]
pub(crate) struct TruthCurves {
    last: Option<(String, RgbSpace, Curve)>,
}

impl TruthCurves {
    /// The curve of a metal in a space.
    pub(crate) fn curve(&mut self, metal: &Metal, space: RgbSpace) -> &Curve {
        let is_known = self.last.as_ref().is_some_and(|(id, known, _)| *id == metal.id && *known == space);
        if !is_known {
            let curve = curve_angles_deg().map(|deg| metal.reflectance(CosTheta::from_deg(deg), space)).collect();
            self.last = Some((metal.id.clone(), space, curve));
        }
        &self.last.as_ref().expect("just stored").2
    }
}

/// r and h of every built-in metal in a space, in the order of [`metals`]; computed when first asked for.
pub(crate) fn library_colours(space: RgbSpace) -> &'static [(Rgb, Rgb)] {
    static COLOURS: [OnceLock<Vec<(Rgb, Rgb)>>; RgbSpace::ALL.len()] = [const { OnceLock::new() }; RgbSpace::ALL.len()];
    COLOURS[space as usize].get_or_init(|| metals().iter().map(|metal| (metal.r(space), metal.h(space))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_reach_grazing_and_interpolation_meets_them() {
        let angles: Vec<f64> = curve_angles_deg().collect();
        assert_eq!((angles[0], angles[angles.len() - 1]), (0.0, 90.0));
        let curve: Curve = angles.iter().map(|&deg| Rgb::splat(deg)).collect();
        for deg in [0.0, 0.3, 45.0, 81.787, 90.0] {
            assert!((at_angle(&curve, deg)[0] - deg).abs() < 1e-12);
        }
    }
}
