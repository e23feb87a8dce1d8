//! Baking a metal: the coefficients that its curve needs on top of Schlick.

use nalgebra::{DMatrix, DVector};

use crate::color::Rgb;
use crate::fresnel::{CosTheta, schlick, whole_degrees};
use crate::kernel::COEFFICIENTS;
use crate::metal::TruthCurve;

/// P of F = S(r, c) + c x P(x), x = 1 − c, nearest to a metal's truth at 0°, 1°, …, 90°, the constant one first.
///
/// Linear least squares for each channel, by singular values: powers of x are nearly dependent.
pub fn polynomial_by_least_squares(truth: &TruthCurve) -> [Rgb; COEFFICIENTS] {
    let angles: Vec<f64> = whole_degrees().map(CosTheta::get).collect();
    let term = |row: usize, power: usize| {
        let c = angles[row];
        c * (1.0 - c).powi(power as i32 + 1)
    };
    let system = DMatrix::from_fn(angles.len(), COEFFICIENTS, term).svd(true, true);
    let channels = [0, 1, 2].map(|channel| {
        let rest = truth.channel(channel).map(|(c, f)| f - schlick(truth.r()[channel], c));
        let rest = DVector::from_iterator(angles.len(), rest);
        system.solve(&rest, 1e-13).expect("both sides of the singular vectors were asked for")
    });
    std::array::from_fn(|i| Rgb(std::array::from_fn(|channel| channels[channel][i])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{RgbSpace, delta_e_rgb};
    use crate::kernel::Polynomial;
    use crate::metal::preferred_metals;

    /// In 32 bits, as a shader has it, every metal of the library.
    #[test]
    fn ten_coefficients_are_the_metal() {
        let space = RgbSpace::LinRec709;
        let mut worst = (0.0, String::new());
        for metal in preferred_metals() {
            let truth = TruthCurve::of(metal, space);
            let baked = Polynomial::material(truth.r(), polynomial_by_least_squares(&truth));
            for (c, exact) in whole_degrees().zip(truth.rgb()) {
                let shown = Rgb(baked.at(c.get() as f32)[0].map(f64::from));
                let off = delta_e_rgb(shown, *exact, space);
                if off > worst.0 {
                    worst = (off, format!("{} at {}°", metal.id, c.deg()));
                }
            }
        }
        assert!(worst.0 <= 0.03, "{worst:?}");
    }
}
