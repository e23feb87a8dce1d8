//! n and k of one channel: by weighting the spectral values, and by least squares of the curve.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{Complex, Dyn, Matrix, OMatrix, OVector, U2, Vector2};

use super::method::Triple;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{CosTheta, FresnelModel, Nk, Root, conductor_over_angles};
use crate::metal::Metal;
use crate::spectrum::{FIRST_NM, rgb_weights};

/// n and k of a metal at one wavelength per channel.
pub(super) fn nk_at(metal: &Metal, triple: Triple) -> [Nk; 3] {
    triple.nm().map(|nm| metal.table().at(f64::from(nm)))
}

/// The thirds of 400–700 nm that stand for red, green and blue.
const BANDS_NM: [(usize, usize); 3] = [(600, 700), (500, 600), (400, 500)];

/// n and k of a metal averaged over a band per channel.
pub(super) fn nk_of_bands(metal: &Metal) -> [Nk; 3] {
    BANDS_NM.map(|(first, last)| {
        let rows = &metal.nk()[first - FIRST_NM..=last - FIRST_NM];
        let mean = |value: fn(&Nk) -> f64| rows.iter().map(value).sum::<f64>() / rows.len() as f64;
        Nk { n: mean(|nk| nk.n), k: mean(|nk| nk.k) }
    })
}

/// n and k as if they were reflectances: weighted by illuminant and observer, through the matrix of the space.
///
/// In a narrow space the weights have negative parts, and n or k may come out negative; nothing is clipped here.
pub(super) fn nk_by_colour_matching(metal: &Metal, space: RgbSpace) -> [Nk; 3] {
    let weights = rgb_weights(space).iter().zip(metal.nk());
    let (n, k) = weights.fold((Rgb::BLACK, Rgb::BLACK), |(n, k), (w, nk)| (n + *w * nk.n, k + *w * nk.k));
    std::array::from_fn(|i| Nk { n: n[i], k: k[i] })
}

/// Three channels as a model.
pub(super) fn conductor_of(channels: [Nk; 3]) -> FresnelModel {
    FresnelModel::Conductor { n: Rgb(channels.map(|nk| nk.n)), k: Rgb(channels.map(|nk| nk.k)) }
}

/// The n and k whose curve is nearest to samples (angle, F), from a start with n, k > 0.
///
/// Levenberg–Marquardt (Moré 1978) in ln n and ln k, which keeps both positive.
pub fn nk_by_least_squares(samples: &[(CosTheta, f64)], start: Nk) -> Nk {
    let logarithms = Vector2::new(start.n.ln(), start.k.ln());
    let (cosines, f): (Vec<CosTheta>, Vec<f64>) = samples.iter().copied().unzip();
    let problem = IndexProblem { cosines: &cosines, f: &f, logarithms };
    // 1e-10: far below what eight bits or a measurement tell apart, and a third of the default's iterations.
    let solver = LevenbergMarquardt::new().with_ftol(1e-10).with_xtol(1e-10).with_gtol(1e-10);
    solver.minimize(problem).0.nk()
}

/// Smallest n or k a start may have: its logarithm must be finite.
pub(super) const SMALLEST_START: f64 = 1e-3;

struct IndexProblem<'a> {
    cosines: &'a [CosTheta],
    /// The reflectance at each of them.
    f: &'a [f64],
    logarithms: Vector2<f64>,
}

impl IndexProblem<'_> {
    fn nk(&self) -> Nk {
        Nk { n: self.logarithms.x.exp(), k: self.logarithms.y.exp() }
    }
}

impl LeastSquaresProblem<f64, Dyn, U2> for IndexProblem<'_> {
    type ParameterStorage = Owned<f64, U2>;
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, U2>;

    fn set_params(&mut self, logarithms: &Vector2<f64>) {
        self.logarithms = *logarithms;
    }

    fn params(&self) -> Vector2<f64> {
        self.logarithms
    }

    fn residuals(&self) -> Option<OVector<f64, Dyn>> {
        let mut residuals = OVector::<f64, Dyn>::zeros(self.cosines.len());
        conductor_over_angles(self.nk(), self.cosines, residuals.as_mut_slice());
        residuals.iter_mut().zip(self.f).for_each(|(residual, f)| *residual -= f);
        Some(residuals)
    }

    fn jacobian(&self) -> Option<OMatrix<f64, Dyn, U2>> {
        let nk = self.nk();
        let slopes: Vec<[f64; 2]> = self.cosines.iter().map(|&cos_theta| slope(nk, cos_theta)).collect();
        Some(Matrix::<f64, Dyn, U2, _>::from_fn(slopes.len(), |row, column| slopes[row][column]))
    }
}

/// ∂F/∂ln n and ∂F/∂ln k, by differentiating both amplitudes in the complex index η (Born & Wolf 1999, eqs. 1.5.20–21).
///
/// With w = √(η² − sin²θ): r_s = (c − w)/(c + w) and r_p = (η² c − w)/(η² c + w); ∂|r|²/∂n = 2 Re(r̄ r′), ∂|r|²/∂k = −2 Im(r̄ r′).
fn slope(Nk { n, k }: Nk, cos_theta: CosTheta) -> [f64; 2] {
    let c = cos_theta.get();
    if c == 0.0 {
        return [0.0; 2];
    }
    let eta = Complex::new(n, k);
    let eps = eta * eta;
    let Root { a, b } = Root::of(eps.re - (1.0 - c) * (1.0 + c), n * k);
    let w = Complex::new(a, b);
    let w_slope = eta / w;
    let (s_sum, p_sum) = (w + c, eps * c + w);
    let (r_s, r_p) = ((-w + c) / s_sum, (eps * c - w) / p_sum);
    let s_slope = w_slope * (-2.0 * c) / (s_sum * s_sum);
    let p_slope = (eta * w * 2.0 - eps * w_slope) * (2.0 * c) / (p_sum * p_sum);
    let product = r_s.conj() * s_slope + r_p.conj() * p_slope;
    [product.re * n, -product.im * k]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::{conductor, whole_degrees};
    use crate::number::larger;

    proptest! {
        /// Central differences converge to the slope as the square of the step.
        #[test]
        fn slope_is_the_derivative(n in 0.05..5.0, k in 0.05..8.0, c in 0.02..1.0) {
            let cos_theta = CosTheta::new(c);
            let step: f64 = 1e-5;
            let (up, down) = (step.exp(), (-step).exp());
            let by_n = (conductor(n * up, k, cos_theta) - conductor(n * down, k, cos_theta)) / (2.0 * step);
            let by_k = (conductor(n, k * up, cos_theta) - conductor(n, k * down, cos_theta)) / (2.0 * step);
            let [slope_n, slope_k] = slope(Nk { n, k }, cos_theta);
            prop_assert!((slope_n - by_n).abs() < 1e-7 && (slope_k - by_k).abs() < 1e-7, "{slope_n} {by_n}");
        }

        #[test]
        fn a_conductor_gives_its_index_back(n in 0.05..4.0, k in 0.3..8.0) {
            let samples: Vec<_> = whole_degrees().map(|c| (c, conductor(n, k, c))).collect();
            let start = Nk { n: n * 1.3, k: k * 0.8 };
            let back = nk_by_least_squares(&samples, start);
            let worst = samples.iter().map(|&(c, f)| (conductor(back.n, back.k, c) - f).abs()).fold(0.0, larger);
            prop_assert!(worst < 1e-7, "{back:?} {worst}");
        }
    }
}
