//! From the parameters of one model to those of another, and what is lost.

use serde::Serialize;
use thiserror::Error;

use super::Loss;
use super::edge_tint::{Nearness, g_nearest};
use super::metal_fit::{r_g_of, r_with_index};
use crate::color::{Rgb, RgbSpace, delta_e_rgb};
use crate::fresnel::{
    CosTheta, FresnelModel, ModelKind, Nk, a_from_r_h, nk_from_r_g, reachable_h, t_from_r_h, whole_degrees,
};
use crate::number::larger;

/// Parameters of another model for the same material, and how far its curve is from the original.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Conversion {
    /// The new parameters, in the space of the old ones.
    pub model: FresnelModel,
    /// What the new parameters could not express.
    pub losses: Vec<Loss>,
    /// Largest difference of the linear reflectance over the angles and channels.
    pub max_difference: f64,
    /// Largest CIEDE2000 over the angles.
    pub max_delta_e: f64,
}

impl Conversion {
    /// True when the new curve is the old one to rounding.
    pub fn is_exact(&self) -> bool {
        self.max_difference <= ROUNDING
    }
}

/// What counts as the same curve: far above rounding, far below anything visible.
const ROUNDING: f64 = 1e-9;

/// The parameters stand for no material, so there is no curve to convert.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("these {0} parameters stand for no material: its reflectance is not a number at some angle")]
pub struct NotAMaterial(ModelKind);

/// Converts a model of `space` to another kind.
///
/// (r, h), (r, t) and Lazányi's (r, a, α = 6) are one curve in other words, and so are (r, g) and (n, k): exact.
/// To (r, h) from anything else, r and h are read off the curve at 0° and 81.8°. To (r, g) and (n, k) from anything
/// else, r is kept and g is fitted to each channel's curve by least squares over 0°, 1°, …, 90°.
pub fn convert(from: &FresnelModel, to: ModelKind, space: RgbSpace) -> Result<Conversion, NotAMaterial> {
    let curve: Vec<Rgb> = whole_degrees().map(|cos_theta| from.reflectance(cos_theta)).collect();
    let h = from.reflectance(CosTheta::MAX);
    if !(h.is_finite() && curve.iter().all(|rgb| rgb.is_finite())) {
        return Err(NotAMaterial(from.kind()));
    }
    let original = Original { from, r: curve[0], h, curve };
    let mut losses = Vec::new();
    let model = original.parameters_of(to, &mut losses);
    let (max_difference, max_delta_e) = original.distance(&model, space);
    losses.extend(original.loss_of_shape(&model, max_difference));
    Ok(Conversion { model, losses, max_difference, max_delta_e })
}

/// The material as it was, with its curve.
struct Original<'a> {
    from: &'a FresnelModel,
    r: Rgb,
    h: Rgb,
    curve: Vec<Rgb>,
}

impl Original<'_> {
    fn parameters_of(&self, to: ModelKind, losses: &mut Vec<Loss>) -> FresnelModel {
        let (r, h) = (self.r, self.h);
        if self.from.kind() == to {
            return *self.from;
        }
        match to {
            ModelKind::Constant => FresnelModel::Constant { r },
            ModelKind::Schlick => FresnelModel::Schlick { r },
            ModelKind::Lazanyi => FresnelModel::Lazanyi { r, a: r.zip(h, a_from_r_h), alpha: 6.0 },
            ModelKind::Hoffman => FresnelModel::Hoffman { r, h },
            ModelKind::F82Tint => FresnelModel::F82Tint { r, t: self.tint(losses) },
            ModelKind::GeneralizedSchlick => {
                FresnelModel::GeneralizedSchlick { r0: r, t: self.tint(losses), r90: Rgb::WHITE, p: 5.0 }
            }
            ModelKind::Gulbrandsen => self.gulbrandsen(losses),
            ModelKind::Conductor => self.conductor(losses),
        }
    }

    fn tint(&self, losses: &mut Vec<Loss>) -> Rgb {
        let t = self.r.zip(self.h, t_from_r_h);
        let outside = t.0.into_iter().enumerate().filter(|(_, t)| !(0.0..=1.0).contains(t));
        losses.extend(outside.map(|(channel, t)| Loss::TintOutsideUnit { channel, t }));
        t
    }

    fn gulbrandsen(&self, losses: &mut Vec<Loss>) -> FresnelModel {
        match *self.from {
            FresnelModel::Conductor { n, k } => {
                let (r, g) = r_g_of(std::array::from_fn(|i| Nk { n: n[i], k: k[i] }), losses);
                FresnelModel::Gulbrandsen { r, g }
            }
            _ => {
                let r = r_with_index(self.r, 1.0, losses);
                FresnelModel::Gulbrandsen { r, g: self.nearest_g(r, losses) }
            }
        }
    }

    fn conductor(&self, losses: &mut Vec<Loss>) -> FresnelModel {
        // r = 1 has a g but no finite n and k.
        let r = r_with_index(self.r, LARGEST_R_WITH_INDEX, losses);
        let g = match *self.from {
            FresnelModel::Gulbrandsen { g, .. } => g,
            _ => self.nearest_g(r, losses),
        };
        let nk = |i: usize| nk_from_r_g(r[i], g[i]).expect("0 ≤ r < 1 and 0 ≤ g ≤ 1 have n and k");
        let channels: [Nk; 3] = std::array::from_fn(nk);
        FresnelModel::Conductor { n: Rgb(channels.map(|nk| nk.n)), k: Rgb(channels.map(|nk| nk.k)) }
    }

    fn nearest_g(&self, r: Rgb, losses: &mut Vec<Loss>) -> Rgb {
        losses.extend((0..3).filter_map(|channel| self.loss_of_reach(channel)));
        Rgb(std::array::from_fn(|channel| {
            let samples: Vec<_> = whole_degrees().zip(self.curve.iter().map(|rgb| rgb[channel])).collect();
            g_nearest(&samples, r[channel], Nearness::LeastSquares)
        }))
    }

    /// The h of a channel, where no n and k reach it at the channel's r.
    fn loss_of_reach(&self, channel: usize) -> Option<Loss> {
        let h = self.h[channel];
        let reachable = reachable_h(self.r[channel])?;
        let nearest_h = h.clamp(*reachable.start(), *reachable.end());
        ((nearest_h - h).abs() > VISIBLE).then_some(Loss::HOutOfReach { channel, h, nearest_h })
    }

    fn distance(&self, model: &FresnelModel, space: RgbSpace) -> (f64, f64) {
        whole_degrees().zip(&self.curve).fold((0.0_f64, 0.0_f64), |(difference, delta_e), (cos_theta, original)| {
            let new = model.reflectance(cos_theta);
            let difference = larger(difference, new.max_abs_difference(*original));
            (difference, larger(delta_e, delta_e_rgb(new, *original, space)))
        })
    }

    /// What to call the difference between the curves.
    fn loss_of_shape(&self, model: &FresnelModel, largest_difference: f64) -> Option<Loss> {
        let grazing = self.from.reflectance(CosTheta::GRAZING);
        let changed_grazing = grazing.max_abs_difference(model.reflectance(CosTheta::GRAZING));
        match model.kind() {
            _ if largest_difference <= ROUNDING => None,
            ModelKind::Constant | ModelKind::Schlick => Some(Loss::EdgeDropped { largest_difference }),
            _ if changed_grazing > ROUNDING => Some(Loss::GrazingColourDropped { largest_difference: changed_grazing }),
            ModelKind::Gulbrandsen | ModelKind::Conductor => Some(Loss::NearestCurve { largest_difference }),
            _ => Some(Loss::ShapeReplaced { largest_difference }),
        }
    }
}

/// The largest r that is turned into n and k: beyond it n/k is below what single precision holds.
const LARGEST_R_WITH_INDEX: f64 = 0.999_999;

/// Half of a step of eight bits: a difference of h below it is not worth a report.
const VISIBLE: f64 = 0.5 / 255.0;

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const SPACE: RgbSpace = RgbSpace::AcesCg;

    prop_compose! {
        fn rgb(range: std::ops::Range<f64>)(channels in prop::array::uniform3(range)) -> Rgb { Rgb(channels) }
    }

    fn back_and_forth(model: FresnelModel, through: ModelKind) -> f64 {
        let there = convert(&model, through, SPACE).unwrap();
        let back = convert(&there.model, model.kind(), SPACE).unwrap();
        whole_degrees().map(|c| back.model.reflectance(c).max_abs_difference(model.reflectance(c))).fold(0.0, larger)
    }

    /// Root of the sum of squared differences of one channel over the whole degrees.
    fn distance(x: &FresnelModel, y: &FresnelModel, channel: usize) -> f64 {
        let square = |c| (x.reflectance(c)[channel] - y.reflectance(c)[channel]).powi(2);
        whole_degrees().map(square).sum::<f64>().sqrt()
    }

    proptest! {
        #[test]
        fn r_h_r_t_and_lazanyi_are_one_curve(r in rgb(-0.1..1.1), h in rgb(-0.1..1.1)) {
            let hoffman = FresnelModel::Hoffman { r, h };
            for kind in [ModelKind::F82Tint, ModelKind::GeneralizedSchlick, ModelKind::Lazanyi] {
                prop_assert!(convert(&hoffman, kind, SPACE).unwrap().is_exact());
                prop_assert!(back_and_forth(hoffman, kind) < 1e-12);
            }
        }

        #[test]
        fn r_g_and_n_k_are_one_curve(r in rgb(0.01..0.99), g in rgb(0.01..0.99)) {
            let gulbrandsen = FresnelModel::Gulbrandsen { r, g };
            let there = convert(&gulbrandsen, ModelKind::Conductor, SPACE).unwrap();
            prop_assert!(there.is_exact() && there.losses.is_empty());
            prop_assert!(back_and_forth(gulbrandsen, ModelKind::Conductor) < 1e-9);
        }

        /// The g found for the (r, h) curve is at least as near to it as the g it came from, so by the triangle
        /// inequality the way back ends within twice the distance of the way there.
        #[test]
        fn from_g_to_h_and_back_is_bounded_by_the_shapes(r in rgb(0.3..0.95), g in rgb(0.05..0.95)) {
            let original = FresnelModel::Gulbrandsen { r, g };
            let there = convert(&original, ModelKind::Hoffman, SPACE).unwrap().model;
            prop_assert!(there.reflectance(CosTheta::MAX).max_abs_difference(original.reflectance(CosTheta::MAX)) < 1e-14);
            let back = convert(&there, ModelKind::Gulbrandsen, SPACE).unwrap().model;
            for channel in 0..3 {
                prop_assert!(distance(&back, &original, channel) <= 2.0 * distance(&there, &original, channel) + 1e-6);
            }
        }

        #[test]
        fn from_n_k_a_lost_g_is_said(n in rgb(0.05..2.0), k in rgb(0.0..3.0)) {
            let there = convert(&FresnelModel::Conductor { n, k }, ModelKind::Gulbrandsen, SPACE).unwrap();
            prop_assert_eq!(there.max_difference < 1e-7, there.losses.is_empty(), "{:?}", there);
        }

        #[test]
        fn every_conversion_is_finite_and_says_what_it_lost(r in rgb(-0.1..1.2), h in rgb(-0.1..1.2)) {
            for to in ModelKind::ALL {
                let conversion = convert(&FresnelModel::Hoffman { r, h }, to, SPACE).unwrap();
                prop_assert!(conversion.max_difference.is_finite());
                prop_assert!(conversion.is_exact() || !conversion.losses.is_empty(), "{to}");
            }
        }
    }

    #[test]
    fn reports_r_that_has_no_g_and_h_out_of_reach() {
        let r = Rgb([1.03, 0.7, 0.4]);
        let low = reachable_h(0.7).unwrap().start() - 0.1;
        let conversion =
            convert(&FresnelModel::Hoffman { r, h: Rgb([1.0, low, 0.6]) }, ModelKind::Gulbrandsen, SPACE).unwrap();
        let has = |wanted: fn(&Loss) -> bool| conversion.losses.iter().any(wanted);
        assert!(has(|loss| matches!(loss, Loss::RWithoutIndex { channel: 0, used, .. } if *used == 1.0)));
        assert!(has(|loss| matches!(loss, Loss::HOutOfReach { channel: 1, .. })), "{:?}", conversion.losses);
        assert!(has(|loss| matches!(loss, Loss::NearestCurve { .. })));
    }

    #[test]
    fn refuses_what_is_no_material() {
        let nothing = FresnelModel::Gulbrandsen { r: Rgb([1.2, 0.5, 0.5]), g: Rgb::splat(0.5) };
        assert!(convert(&nothing, ModelKind::Hoffman, SPACE).unwrap_err().to_string().contains("no material"));
    }

    /// r rounds to 1 in the first three; the fourth is near air, the last an alkali metal's.
    #[test]
    fn an_extreme_index_is_converted_exactly_or_with_a_loss() {
        for (n, k) in [(1e-17, 3.0), (1.0, 1e9), (1e200, 1e200), (1.0, 1e-9), (0.0, 0.0), (0.327, 0.608)] {
            let from = FresnelModel::Conductor { n: Rgb::splat(n), k: Rgb::splat(k) };
            for to in ModelKind::ALL {
                let Conversion { model, losses, max_difference, max_delta_e } = convert(&from, to, SPACE).unwrap();
                assert!(max_difference.is_finite() && max_delta_e.is_finite(), "{n} {k} {model:?}");
                assert!(max_difference <= ROUNDING || !losses.is_empty(), "{n} {k} {model:?}");
                assert!(whole_degrees().all(|c| model.reflectance(c).is_finite()), "{n} {k} {model:?}");
            }
        }
    }
}
