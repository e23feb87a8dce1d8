//! Parameters of any model for a measured metal, by any method.

use std::ops::ControlFlow;

use serde::Serialize;
use thiserror::Error;

use super::edge_tint::{Nearness, g_nearest};
use super::index::{SMALLEST_START, conductor_of, nk_at, nk_by_colour_matching, nk_by_least_squares, nk_of_bands};
use super::least_squares::{
    a_alpha_by_least_squares, r_h_by_least_squares, schlick_r_by_least_squares, t_exponent_by_least_squares,
};
use super::{CurveError, Loss, Method, Stopped, black_box};
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{CosTheta, FresnelModel, ModelKind, Nk, nk_from_r_g, r_g_from_nk, t_from_r_h};
use crate::metal::{Metal, TruthCurve};

/// A model with the parameters that a method gives for a metal, and how far it is from the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fit {
    /// The model; its triples are in `space`.
    pub model: FresnelModel,
    /// How its parameters were derived.
    pub method: Method,
    /// The space of the parameters and of the error.
    pub space: RgbSpace,
    /// CIEDE2000 to the spectral truth.
    pub error: CurveError,
    /// What the parameters could not express.
    pub losses: Vec<Loss>,
}

/// Why there is no fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum FitError {
    /// The method makes no sense for the model.
    #[error("{kind} has no parameters by “{method}”; it takes: {}", Method::of(*kind).map(Method::id).collect::<Vec<_>>().join(", "))]
    NotForThisModel {
        /// The model asked for.
        kind: ModelKind,
        /// The method asked for.
        method: Method,
    },
    /// The search was stopped.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// Fits a model to a metal. For several fits of one metal, compute the truth once and use [`fit_to_truth`].
pub fn fit(metal: &Metal, kind: ModelKind, method: Method, space: RgbSpace) -> Result<Fit, FitError> {
    fit_to_truth(metal, &TruthCurve::of(metal, space), kind, method, &mut || ControlFlow::Continue(()))
}

/// Fits a model to a metal whose truth is known. `keep_going` is asked at every step of a numerical search.
pub fn fit_to_truth(
    metal: &Metal,
    truth: &TruthCurve,
    kind: ModelKind,
    method: Method,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Fit, FitError> {
    let (model, losses) = model_of_truth(metal, truth, kind, method, keep_going)?;
    Ok(Fit { model, method, space: truth.space, error: CurveError::of(&model, truth), losses })
}

/// The model of [`fit_to_truth`] and what its parameters could not express, for who measures its error otherwise.
pub fn model_of_truth(
    metal: &Metal,
    truth: &TruthCurve,
    kind: ModelKind,
    method: Method,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<(FresnelModel, Vec<Loss>), FitError> {
    let mut losses = Vec::new();
    let model = match method {
        _ if !method.applies_to(kind) => return Err(FitError::NotForThisModel { kind, method }),
        Method::BlackBox => by_black_box(metal, truth, kind, &mut losses, keep_going)?,
        Method::LeastSquares => by_least_squares(truth, kind, &mut losses),
        _ => closed_form(metal, truth, kind, method, &mut losses),
    };
    Ok((model, losses))
}

/// The methods that only read values off the metal.
fn closed_form(
    metal: &Metal,
    truth: &TruthCurve,
    kind: ModelKind,
    method: Method,
    losses: &mut Vec<Loss>,
) -> FresnelModel {
    let (r, h) = (truth.r(), truth.h);
    match (kind, method) {
        (ModelKind::Gulbrandsen, Method::DefaultTint) => gulbrandsen_with(r, losses, |_, _| 0.5),
        (ModelKind::Gulbrandsen, Method::MinMax) => gulbrandsen_nearest(truth, Nearness::MinMax, losses),
        (ModelKind::Gulbrandsen, _) => {
            let channels = spectral_nk(metal, truth.space, method, losses);
            let (_, g) = r_g_of(channels, losses);
            gulbrandsen_with(r, losses, |channel, _| g[channel])
        }
        (ModelKind::Conductor, _) => conductor_of(spectral_nk(metal, truth.space, method, losses)),
        _ => exact(kind, r, h),
    }
}

/// The models whose parameters are r and h, or follow from them.
fn exact(kind: ModelKind, r: Rgb, h: Rgb) -> FresnelModel {
    let t = r.zip(h, t_from_r_h);
    match kind {
        ModelKind::Constant => FresnelModel::Constant { r },
        ModelKind::Schlick => FresnelModel::Schlick { r },
        ModelKind::F82Tint => FresnelModel::F82Tint { r, t },
        ModelKind::GeneralizedSchlick => FresnelModel::GeneralizedSchlick { r0: r, t, r90: Rgb::WHITE, p: 5.0 },
        _ => FresnelModel::Hoffman { r, h },
    }
}

/// n and k of three channels by one of the ways to reduce the spectral values.
fn spectral_nk(metal: &Metal, space: RgbSpace, method: Method, losses: &mut Vec<Loss>) -> [Nk; 3] {
    let mut channels = match method {
        Method::Points(triple) => nk_at(metal, triple),
        Method::BandAverage => nk_of_bands(metal),
        _ => nk_by_colour_matching(metal, space),
    };
    for (channel, nk) in channels.iter_mut().enumerate() {
        if nk.n < 0.0 || nk.k < 0.0 {
            losses.push(Loss::NegativeIndex { channel, n: nk.n, k: nk.k });
            *nk = Nk { n: nk.n.max(0.0), k: nk.k.max(0.0) };
        }
    }
    channels
}

/// (r, g) with r limited to what has a g, and g by channel and limited r.
fn gulbrandsen_with(r: Rgb, losses: &mut Vec<Loss>, mut g: impl FnMut(usize, f64) -> f64) -> FresnelModel {
    let r = r_with_index(r, 1.0, losses);
    FresnelModel::Gulbrandsen { r, g: Rgb(std::array::from_fn(|channel| g(channel, r[channel]))) }
}

fn gulbrandsen_nearest(truth: &TruthCurve, nearness: Nearness, losses: &mut Vec<Loss>) -> FresnelModel {
    gulbrandsen_with(truth.r(), losses, |channel, r| {
        g_nearest(&truth.channel(channel).collect::<Vec<_>>(), r, nearness)
    })
}

/// r limited to `0..=largest`, each channel that had to be is reported.
pub(super) fn r_with_index(r: Rgb, largest: f64, losses: &mut Vec<Loss>) -> Rgb {
    Rgb(std::array::from_fn(|channel| {
        let used = r[channel].clamp(0.0, largest);
        if used != r[channel] {
            losses.push(Loss::RWithoutIndex { channel, r: r[channel], used });
        }
        used
    }))
}

fn by_least_squares(truth: &TruthCurve, kind: ModelKind, losses: &mut Vec<Loss>) -> FresnelModel {
    let of_channels = |f: &dyn Fn(usize) -> f64| Rgb(std::array::from_fn(f));
    let samples = || truth.samples().collect::<Vec<(CosTheta, Rgb)>>();
    let r = truth.r();
    match kind {
        ModelKind::Constant => {
            let mean = truth.rgb().iter().fold(Rgb::BLACK, |sum, rgb| sum + *rgb) / truth.rgb().len() as f64;
            FresnelModel::Constant { r: mean }
        }
        ModelKind::Schlick => {
            FresnelModel::Schlick { r: of_channels(&|i| schlick_r_by_least_squares(truth.channel(i)).unwrap_or(r[i])) }
        }
        ModelKind::Lazanyi => {
            let (a, alpha) = a_alpha_by_least_squares(&samples(), r);
            FresnelModel::Lazanyi { r, a, alpha }
        }
        ModelKind::Hoffman | ModelKind::F82Tint => {
            let channels: [(f64, f64); 3] =
                std::array::from_fn(|i| r_h_by_least_squares(truth.channel(i)).unwrap_or((r[i], truth.h[i])));
            exact(kind, Rgb(channels.map(|(r, _)| r)), Rgb(channels.map(|(_, h)| h)))
        }
        ModelKind::GeneralizedSchlick => {
            let (t, p) = t_exponent_by_least_squares(&samples(), r);
            FresnelModel::GeneralizedSchlick { r0: r, t, r90: Rgb::WHITE, p }
        }
        ModelKind::Gulbrandsen => gulbrandsen_nearest(truth, Nearness::LeastSquares, losses),
        ModelKind::Conductor => conductor_of(nearest_nk(truth)),
    }
}

/// n and k of each channel by least squares, started from the (r, g) nearest to the channel.
fn nearest_nk(truth: &TruthCurve) -> [Nk; 3] {
    std::array::from_fn(|channel| {
        let samples: Vec<_> = truth.channel(channel).collect();
        let r = truth.r()[channel].clamp(1e-4, 0.9999);
        let g = g_nearest(&samples, r, Nearness::LeastSquares);
        let Nk { n, k } = nk_from_r_g(r, g).unwrap_or(Nk { n: 1.0, k: 1.0 });
        nk_by_least_squares(&samples, Nk { n: n.max(SMALLEST_START), k: k.max(SMALLEST_START) })
    })
}

/// The (r, g) that a conductor's n and k stand for; a g outside its range is reported.
pub(super) fn r_g_of(channels: [Nk; 3], losses: &mut Vec<Loss>) -> (Rgb, Rgb) {
    let r_g = channels.map(r_g_from_nk);
    let g = std::array::from_fn(|channel| {
        let g = r_g[channel].1;
        let used = g.clamp(0.0, 1.0);
        if (used - g).abs() > ROUNDING_OF_G {
            losses.push(Loss::GOutsideUnit { channel, g });
        }
        used
    });
    (Rgb(r_g.map(|(r, _)| r)), Rgb(g))
}

/// How far g leaves its range by rounding alone.
const ROUNDING_OF_G: f64 = 1e-9;

/// Searches from the parameters that every other method gives, those by least squares first.
fn by_black_box(
    metal: &Metal,
    truth: &TruthCurve,
    kind: ModelKind,
    losses: &mut Vec<Loss>,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<FresnelModel, Stopped> {
    if kind == ModelKind::F82Tint {
        // The same curves: t follows from the best r and h.
        return Ok(match by_black_box(metal, truth, ModelKind::Hoffman, losses, keep_going)? {
            FresnelModel::Hoffman { r, h } => exact(kind, r, h),
            other => other,
        });
    }
    let mut starts = vec![by_least_squares(truth, kind, losses)];
    let others = Method::of(kind).filter(|method| !matches!(method, Method::LeastSquares | Method::BlackBox));
    starts.extend(others.map(|method| closed_form(metal, truth, kind, method, &mut Vec::new())));
    let starts: Vec<FresnelModel> = starts.into_iter().map(inside).collect();
    black_box::smallest_mean_delta_e(&starts, truth, keep_going)
}

/// A start whose logarithms are finite.
fn inside(start: FresnelModel) -> FresnelModel {
    let positive = |v: f64| v.max(SMALLEST_START);
    match start {
        FresnelModel::Conductor { n, k } => FresnelModel::Conductor { n: n.map(positive), k: k.map(positive) },
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;

    const SPACE: RgbSpace = RgbSpace::AcesCg;

    fn mean(name: &str, kind: ModelKind, method: Method) -> f64 {
        fit(metal_by_name(name).unwrap(), kind, method, SPACE).unwrap().error.mean_delta_e
    }

    #[test]
    fn every_method_gives_a_finite_curve() {
        for name in ["gold", "copper", "zinc", "caesium"] {
            let metal = metal_by_name(name).unwrap();
            for space in RgbSpace::ALL {
                for kind in ModelKind::ALL {
                    for method in Method::of(kind).filter(|method| *method != Method::BlackBox) {
                        let fit = fit(metal, kind, method, space).unwrap();
                        assert!(fit.error.mean_delta_e.is_finite(), "{name} {kind} {method} {space}");
                    }
                }
            }
        }
    }

    /// What each criterion minimises is not worse than what it started from.
    #[test]
    fn searching_helps() {
        for name in ["gold", "iron", "caesium"] {
            for kind in [ModelKind::Schlick, ModelKind::Hoffman, ModelKind::Gulbrandsen] {
                let fitted = mean(name, kind, Method::BlackBox);
                for method in Method::of(kind) {
                    assert!(fitted <= mean(name, kind, method) + 1e-9, "{name} {kind} {method}");
                }
            }
        }
    }

    /// Real gold reflects more than the red primary of linear sRGB can say, so no n and k exist for it.
    #[test]
    fn reports_what_has_no_edge_tint() {
        let gold = metal_by_name("gold").unwrap();
        let fit = fit(gold, ModelKind::Gulbrandsen, Method::LeastSquares, RgbSpace::LinRec709).unwrap();
        assert!(matches!(fit.losses[..], [Loss::RWithoutIndex { channel: 0, .. }]), "{:?}", fit.losses);
    }

    #[test]
    fn refuses_what_makes_no_sense() {
        let gold = metal_by_name("gold").unwrap();
        let error = fit(gold, ModelKind::Schlick, Method::ColourMatching, SPACE).unwrap_err();
        assert!(error.to_string().contains("it takes: exact, least-squares, black-box"), "{error}");
    }

    #[test]
    fn a_search_stops_when_told() {
        let gold = metal_by_name("gold").unwrap();
        let truth = TruthCurve::of(gold, SPACE);
        let stopped = fit_to_truth(gold, &truth, ModelKind::Hoffman, Method::BlackBox, &mut || ControlFlow::Break(()));
        assert_eq!(stopped, Err(FitError::Stopped(Stopped)));
    }
}
