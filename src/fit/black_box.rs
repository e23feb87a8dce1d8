//! The most accurate parameters: smallest mean CIEDE2000, by numerical search (paper section 5).

use std::ops::ControlFlow;

use super::Stopped;
use super::curve_error::delta_e_over_degrees;
use super::search::{Effort, minimum_near};
use crate::color::Rgb;
use crate::fresnel::{FresnelModel, whole_degrees};
use crate::metal::TruthCurve;

/// Enough: the test of convergence works harder and finds nothing better to see.
const EFFORT: Effort =
    Effort { restarts: 3, iterations: 600, first_step: 0.05, position_tolerance: 1e-4, cost_tolerance: 1e-5 };

/// The model of the same kind as `starts` with the smallest mean ΔE to the truth that the search finds.
///
/// Nelder–Mead, restarted, from each of `starts`, of which there must be one; deterministic. The coordinates have no
/// bounds: positive parameters go by their logarithm, those of `[0, 1]` by an angle. `keep_going` is asked at every evaluation.
pub(super) fn smallest_mean_delta_e(
    starts: &[FresnelModel],
    truth: &TruthCurve,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<FresnelModel, Stopped> {
    let mut best: Option<(FresnelModel, f64)> = None;
    for start in starts {
        let found = search(start, truth, EFFORT, keep_going)?;
        if best.is_none_or(|(_, smallest)| found.1 < smallest) {
            best = Some(found);
        }
    }
    Ok(best.expect("a search has a start").0)
}

fn search(
    start: &FresnelModel,
    truth: &TruthCurve,
    effort: Effort,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<(FresnelModel, f64), Stopped> {
    let cost = |x: &[f64]| mean_delta_e(&with_coordinates(start, x), truth);
    let (x, value) = minimum_near(&coordinates(start), effort, cost, keep_going)?;
    Ok((with_coordinates(start, &x), value))
}

fn mean_delta_e(model: &FresnelModel, truth: &TruthCurve) -> f64 {
    let curve = whole_degrees().map(|cos_theta| model.reflectance(cos_theta));
    delta_e_over_degrees(curve, truth).sum::<f64>() / truth.rgb().len() as f64
}

/// The parameters of a model as free coordinates.
fn coordinates(model: &FresnelModel) -> Vec<f64> {
    let join = |parts: &[Rgb]| parts.iter().flat_map(|rgb| rgb.0).collect::<Vec<f64>>();
    let with = |mut list: Vec<f64>, last: f64| {
        list.push(last);
        list
    };
    match *model {
        FresnelModel::Constant { r } | FresnelModel::Schlick { r } => join(&[r]),
        FresnelModel::Lazanyi { r, a, alpha } => with(join(&[r, a]), alpha.ln()),
        FresnelModel::Hoffman { r, h } => join(&[r, h]),
        FresnelModel::F82Tint { r, t } => join(&[r, t]),
        FresnelModel::GeneralizedSchlick { r0, t, p, .. } => with(join(&[r0, t]), p.ln()),
        FresnelModel::Gulbrandsen { r, g } => join(&[r.map(angle_of_share), g.map(angle_of_share)]),
        FresnelModel::Conductor { n, k } => join(&[n.map(f64::ln), k.map(f64::ln)]),
    }
}

/// The model that coordinates stand for; what `model` has beyond them (white at grazing) stays.
fn with_coordinates(model: &FresnelModel, x: &[f64]) -> FresnelModel {
    let triple = |part: usize| Rgb([x[3 * part], x[3 * part + 1], x[3 * part + 2]]);
    match *model {
        FresnelModel::Constant { .. } => FresnelModel::Constant { r: triple(0) },
        FresnelModel::Schlick { .. } => FresnelModel::Schlick { r: triple(0) },
        FresnelModel::Lazanyi { .. } => FresnelModel::Lazanyi { r: triple(0), a: triple(1), alpha: x[6].exp() },
        FresnelModel::Hoffman { .. } => FresnelModel::Hoffman { r: triple(0), h: triple(1) },
        FresnelModel::F82Tint { .. } => FresnelModel::F82Tint { r: triple(0), t: triple(1) },
        FresnelModel::GeneralizedSchlick { r90, .. } => {
            FresnelModel::GeneralizedSchlick { r0: triple(0), t: triple(1), r90, p: x[6].exp() }
        }
        FresnelModel::Gulbrandsen { .. } => {
            FresnelModel::Gulbrandsen { r: triple(0).map(share_of_angle), g: triple(1).map(share_of_angle) }
        }
        FresnelModel::Conductor { .. } => {
            FresnelModel::Conductor { n: triple(0).map(f64::exp), k: triple(1).map(f64::exp) }
        }
    }
}

/// A free coordinate for a value of `[0, 1]`: share = (1 − cos angle)/2, which no angle leaves.
fn share_of_angle(angle: f64) -> f64 {
    0.5 * (1.0 - angle.cos())
}

/// Inverse of [`share_of_angle`].
fn angle_of_share(share: f64) -> f64 {
    (1.0 - 2.0 * share).acos()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::fit::{Method, fit};
    use crate::fresnel::ModelKind;
    use crate::metal::metal_by_name;

    /// Four times the work from two other starts improves no fit by what anyone could see.
    #[test]
    fn more_work_finds_nothing_better() {
        let harder = Effort { restarts: 8, iterations: 1500, first_step: 0.2, ..EFFORT };
        for (name, kind) in
            [("copper", ModelKind::Conductor), ("caesium", ModelKind::Hoffman), ("gold", ModelKind::Lazanyi)]
        {
            let metal = metal_by_name(name).unwrap();
            let truth = TruthCurve::of(metal, RgbSpace::LinRec709);
            let found = fit(metal, kind, Method::BlackBox, truth.space).unwrap();
            for factor in [0.8, 1.2] {
                let start: Vec<f64> = coordinates(&found.model).into_iter().map(|x| x * factor).collect();
                let start = with_coordinates(&found.model, &start);
                let better = search(&start, &truth, harder, &mut || ControlFlow::Continue(())).unwrap();
                let gain = found.error.mean_delta_e - better.1;
                assert!(gain < 0.02, "{name} {kind}: {gain}");
            }
        }
    }

    #[test]
    fn coordinates_stand_for_the_model() {
        let (x, y) = (Rgb([0.9, 0.7, 0.4]), Rgb([0.95, 0.8, 0.6]));
        let models = [
            FresnelModel::Constant { r: x },
            FresnelModel::Schlick { r: x },
            FresnelModel::Lazanyi { r: x, a: y, alpha: 5.5 },
            FresnelModel::Hoffman { r: x, h: y },
            FresnelModel::F82Tint { r: x, t: y },
            FresnelModel::GeneralizedSchlick { r0: x, t: y, r90: Rgb::WHITE, p: 5.0 },
            FresnelModel::Gulbrandsen { r: x, g: y },
            FresnelModel::Conductor { n: x, k: y },
        ];
        for model in models {
            let back = with_coordinates(&model, &coordinates(&model));
            for cos_theta in whole_degrees() {
                assert!(back.reflectance(cos_theta).max_abs_difference(model.reflectance(cos_theta)) < 1e-14);
            }
        }
    }
}
