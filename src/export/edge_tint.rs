//! r and g, and n and k: what readers take that know metals by Gulbrandsen's edge tint or an index.

use super::loss::{Cause, Clip, Parameter, clip};
use crate::color::Rgb;
use crate::fresnel::{CosTheta, FresnelModel, Nk, gulbrandsen, hoffman, nk_from_r_g};

/// r and g closest to a curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct EdgeTint {
    pub r: Rgb,
    pub g: Rgb,
    clips: Vec<Clip>,
}

impl EdgeTint {
    /// r up to `max_r`, where the reader clips it (r = 1 has no index), and the g nearest to the curve of r and h.
    pub(super) fn fitted(r: Rgb, h: Rgb, max_r: f64) -> Self {
        let mut clips = Vec::new();
        let clipped = clip(Parameter::R, r, max_r, &mut clips);
        let g = Rgb(std::array::from_fn(|i| nearest_edge_tint(clipped[i], r[i], h[i])));
        Self { r: clipped, g, clips }
    }

    /// The curve a reader shows.
    pub(super) fn model(&self) -> FresnelModel {
        FresnelModel::Gulbrandsen { r: self.r, g: self.g }
    }

    /// What was lost to get there; `what` names the parameters of the reader.
    pub(super) fn causes(&self, what: &'static str) -> Vec<Cause> {
        let clipped = (!self.clips.is_empty()).then(|| Cause::Clipped(self.clips.clone()));
        clipped.into_iter().chain([Cause::Fitted(what)]).collect()
    }

    /// The index triple (n, k) it stands for.
    pub(super) fn index(&self) -> (Rgb, Rgb) {
        let nk = |i: usize| nk_from_r_g(self.r[i], self.g[i]).expect("r is below 1 and g in [0, 1]");
        let nk: [Nk; 3] = std::array::from_fn(nk);
        (Rgb(nk.map(|nk| nk.n)), Rgb(nk.map(|nk| nk.k)))
    }
}

/// The g that minimises the largest difference from Hoffman's curve of (r, h) over the angles.
///
/// The difference has one valley in g in practice; a coarse look over g = 1 − u², which is finer where a
/// bright metal's curve moves, finds it, and golden sections (Kiefer 1953) narrow it to 1e-9.
fn nearest_edge_tint(shown_r: f64, r: f64, h: f64) -> f64 {
    const STEPS: u32 = 48;
    let g_of = |u: f64| 1.0 - u * u;
    let error = |u: f64| largest_difference(shown_r, g_of(u), r, h);
    let at = |step: u32| f64::from(step) / f64::from(STEPS);
    let by_error = |a: &u32, b: &u32| error(at(*a)).total_cmp(&error(at(*b)));
    let best = (0..=STEPS).min_by(by_error).unwrap_or_default();
    let (mut low, mut high) = (at(best.saturating_sub(1)), at((best + 1).min(STEPS)));
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    while high - low > 1e-9 {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if error(a) <= error(b) { high = b } else { low = a }
    }
    g_of(0.5 * (low + high))
}

fn largest_difference(shown_r: f64, g: f64, r: f64, h: f64) -> f64 {
    let angles = (0..=45u8).map(|step| CosTheta::from_deg(2.0 * f64::from(step)));
    angles.map(|c| (gulbrandsen(shown_r, g, c) - hoffman(r, h, c)).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::color::RgbSpace;
    use crate::export::loss::Difference;
    use crate::fresnel::reachable_h;

    /// Errors of the fitted targets as `docs/exports.md` states them, found with another optimiser.
    #[test]
    fn gold_and_chromium_fit_as_well_as_stated() {
        let gold = (Rgb([1.0, 0.782, 0.344]), Rgb([0.986, 0.882, 0.630]));
        let chromium = (Rgb([0.635, 0.662, 0.705]), Rgb([0.576, 0.612, 0.697]));
        for ((r, h), stated) in [(gold, 0.017), (chromium, 0.025)] {
            let fit = EdgeTint::fitted(r, h, 0.99);
            let wanted = FresnelModel::Hoffman { r, h };
            let difference = Difference::between(&wanted, &fit.model(), RgbSpace::LinRec709);
            assert!((difference.max_delta_f - stated).abs() < 1.5e-3, "{difference:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        /// The valley that the coarse look finds is the deepest one.
        #[test]
        fn no_other_edge_tint_is_nearer(r in 0.3..0.98_f64, share in 0.0..1.0_f64) {
            let band = reachable_h(r).unwrap();
            let h = band.start() + share * (band.end() - band.start());
            let found = largest_difference(r, nearest_edge_tint(r, r, h), r, h);
            let by_brute_force = (0..=2000).map(|i| largest_difference(r, f64::from(i) / 2000.0, r, h));
            prop_assert!(found <= by_brute_force.fold(f64::INFINITY, f64::min) + 1e-9);
        }
    }

    #[test]
    fn index_and_edge_tint_are_one_curve() {
        let fit = EdgeTint::fitted(Rgb([1.02, 0.8, 0.3]), Rgb([0.99, 0.9, 0.6]), 0.9999);
        let (n, k) = fit.index();
        let difference = Difference::between(&fit.model(), &FresnelModel::Conductor { n, k }, RgbSpace::LinRec709);
        assert!(difference.max_delta_f < 1e-12);
        assert_eq!(fit.causes("n and k").len(), 2);
    }
}
