//! r and g, and n and k: what readers take that know metals by Gulbrandsen's edge tint or an index.

use super::loss::{Cause, Clip, Parameter, clip};
use crate::color::Rgb;
use crate::fit::{Nearness, g_nearest};
use crate::fresnel::{FresnelModel, Nk, hoffman, nk_from_r_g, whole_degrees};

/// r and g, given or closest to a curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct EdgeTint {
    pub r: Rgb,
    pub g: Rgb,
    clips: Vec<Clip>,
    is_fitted: bool,
}

impl EdgeTint {
    /// r up to `max_r`, where the reader clips it (r = 1 has no index), and the g nearest to the curve of r and h.
    pub(super) fn fitted(r: Rgb, h: Rgb, max_r: f64) -> Self {
        let mut clips = Vec::new();
        let clipped = clip(Parameter::R, r, max_r, &mut clips);
        let g = Rgb(std::array::from_fn(|i| nearest_edge_tint(clipped[i], r[i], h[i])));
        Self { r: clipped, g, clips, is_fitted: true }
    }

    /// r and g as they are, but for what the reader clips.
    pub(super) fn given(r: Rgb, g: Rgb, max_r: f64) -> Self {
        let mut clips = Vec::new();
        let r = clip(Parameter::R, r, max_r, &mut clips);
        let g = clip(Parameter::G, g, 1.0, &mut clips);
        Self { r, g, clips, is_fitted: false }
    }

    /// The curve a reader shows.
    pub(super) fn model(&self) -> FresnelModel {
        FresnelModel::Gulbrandsen { r: self.r, g: self.g }
    }

    /// What was lost to get there; `what` names the parameters of the reader.
    pub(super) fn causes(&self, what: &'static str) -> Vec<Cause> {
        let clipped = (!self.clips.is_empty()).then(|| Cause::Clipped(self.clips.clone()));
        clipped.into_iter().chain(self.is_fitted.then_some(Cause::Fitted(what))).collect()
    }

    /// The index triple (n, k) it stands for.
    pub(super) fn index(&self) -> (Rgb, Rgb) {
        let nk = |i: usize| nk_from_r_g(self.r[i], self.g[i]).expect("r is below 1 and g in [0, 1]");
        let nk: [Nk; 3] = std::array::from_fn(nk);
        (Rgb(nk.map(|nk| nk.n)), Rgb(nk.map(|nk| nk.k)))
    }
}

/// The g whose curve stays nearest to that of (r, h) where it is farthest, to seven decimals: what the search
/// finds beyond these depends on the machine.
fn nearest_edge_tint(shown_r: f64, r: f64, h: f64) -> f64 {
    let curve: Vec<_> = whole_degrees().map(|c| (c, hoffman(r, h, c))).collect();
    (g_nearest(&curve, shown_r, Nearness::MinMax) * 1e7).round() / 1e7
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::color::RgbSpace;
    use crate::export::loss::Difference;
    use crate::fresnel::{gulbrandsen, reachable_h};
    use crate::number::larger;

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

        #[test]
        fn no_other_edge_tint_is_nearer(r in 0.3..0.98_f64, share in 0.0..1.0_f64) {
            let band = reachable_h(r).unwrap();
            let h = band.start() + share * (band.end() - band.start());
            let off = |g: f64| whole_degrees().map(|c| (gulbrandsen(r, g, c) - hoffman(r, h, c)).abs()).fold(0.0, larger);
            let by_brute_force = (0..=2000).map(|i| off(f64::from(i) / 2000.0)).fold(f64::INFINITY, f64::min);
            prop_assert!(off(nearest_edge_tint(r, r, h)) <= by_brute_force + 1e-5);
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
