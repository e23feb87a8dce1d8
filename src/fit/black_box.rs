//! The most accurate parameters: smallest mean CIEDE2000, by numerical search (paper section 5).

use std::ops::ControlFlow;

use super::Stopped;
use super::curve_error::delta_e_over_degrees;
use super::search::{Effort, minimum_near, minimum_of_smooth};
use crate::color::Rgb;
use crate::fresnel::{FresnelModel, whole_degrees};
use crate::metal::TruthCurve;

/// Enough to find which valley a start leads to, and nearly all of its depth.
const SCOUTING: Scouting = Scouting { first_radius: 0.1, last_radius: 2e-3, evaluations: 160 };

/// Enough: the test of convergence works harder and finds nothing better to see.
const EFFORT: Effort =
    Effort { restarts: 1, iterations: 600, first_step: 0.03, position_tolerance: 1e-4, cost_tolerance: 1e-5 };

/// How many of the places the scouts found are searched to the end.
const FINALISTS: usize = 3;

/// How many starts are spread around each person's favourite, the first of the starts.
const SPREAD_STARTS: usize = 8;

/// How far these are, in free coordinates: about a quarter of n and k, a quarter of the range of a reflectance.
const SPREAD: f64 = 0.25;

/// How far a scout goes.
#[derive(Clone, Copy, Debug)]
struct Scouting {
    first_radius: f64,
    last_radius: f64,
    evaluations: u64,
}

/// The model of the same kind as `starts` with the smallest mean ΔE to the truth that the search finds.
///
/// Multi-start: scouts (NEWUOA, Powell 2006) leave from each of `starts`, of which there must be one, and from points
/// spread evenly around the first; the best few are searched to the end (Nelder–Mead, restarted). Never worse than any
/// of `starts`; deterministic. The coordinates have no bounds: positive parameters go by their logarithm, those of
/// `[0, 1]` by an angle. `keep_going` is asked at every evaluation.
pub(super) fn smallest_mean_delta_e(
    starts: &[FresnelModel],
    truth: &TruthCurve,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<FresnelModel, Stopped> {
    let kind = starts.first().expect("a search has a start");
    let cost = |x: &[f64]| mean_delta_e(&with_coordinates(kind, x), truth);
    let mut places = starts.iter().map(coordinates).collect::<Vec<_>>();
    let spread: Vec<Vec<f64>> = spread_around(&places[0]).collect();
    places.extend(spread);
    let mut found = Vec::with_capacity(places.len());
    for place in places {
        let Scouting { first_radius, last_radius, evaluations } = SCOUTING;
        found.push(minimum_of_smooth(&place, (first_radius, last_radius), evaluations, cost, keep_going)?);
    }
    found.sort_by(|a, b| a.1.total_cmp(&b.1));
    found.dedup_by(|later, kept| is_same_place(&later.0, &kept.0));
    found.truncate(FINALISTS);
    let mut best = found[0].clone();
    for (place, _) in found {
        let end = minimum_near(&place, EFFORT, cost, keep_going)?;
        if end.1 < best.1 {
            best = end;
        }
    }
    Ok(with_coordinates(kind, &best.0))
}

/// Whether two scouts came to the same valley.
fn is_same_place(x: &[f64], y: &[f64]) -> bool {
    x.iter().zip(y).all(|(x, y)| (x - y).abs() < 5.0 * SCOUTING.last_radius)
}

/// Points around one: the additive recurrence of Roberts 2018 ("The unreasonable effectiveness of quasirandom
/// sequences"), whose steps are powers of the generalised golden ratio of this many dimensions.
fn spread_around(centre: &[f64]) -> impl Iterator<Item = Vec<f64>> + '_ {
    let dimensions = centre.len() as i32;
    // φ is the root of φ^(d + 1) = φ + 1.
    let golden = (0..40).fold(2.0_f64, |phi, _| (1.0 + phi).powf(1.0 / f64::from(dimensions + 1)));
    (1..=SPREAD_STARTS).map(move |index| {
        let shift = |axis: usize| (0.5 + index as f64 * golden.powi(-(axis as i32) - 1)).fract() - 0.5;
        centre.iter().enumerate().map(|(axis, x)| x + 2.0 * SPREAD * shift(axis)).collect()
    })
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

    const HARD: [(&str, ModelKind); 4] = [
        ("copper", ModelKind::Conductor),
        ("caesium", ModelKind::Gulbrandsen),
        ("zinc", ModelKind::Hoffman),
        ("gold", ModelKind::Lazanyi),
    ];

    /// A search from one start, with far more work than a finalist gets.
    fn alone(start: &FresnelModel, truth: &TruthCurve, first_step: f64) -> f64 {
        let harder = Effort { restarts: 4, iterations: 1500, first_step, ..EFFORT };
        let cost = |x: &[f64]| mean_delta_e(&with_coordinates(start, x), truth);
        minimum_near(&coordinates(start), harder, cost, &mut || ControlFlow::Continue(())).unwrap().1
    }

    /// The starts of every other method, each searched to its end alone, end nowhere lower by what anyone could see.
    #[test]
    fn no_single_start_does_better() {
        for (name, kind) in HARD {
            let metal = metal_by_name(name).unwrap();
            let truth = TruthCurve::of(metal, RgbSpace::LinRec709);
            let found = fit(metal, kind, Method::BlackBox, truth.space).unwrap().error.mean_delta_e;
            for method in Method::of(kind).filter(|method| *method != Method::BlackBox) {
                let start = fit(metal, kind, method, truth.space).unwrap();
                assert!(found <= start.error.mean_delta_e, "{name} {kind} {method}");
                let end = alone(&start.model, &truth, 0.05);
                assert!(found <= end + 0.005, "{name} {kind} {method}: {found} {end}");
            }
        }
    }

    /// Far more work from two other starts improves no fit by what anyone could see.
    #[test]
    fn more_work_finds_nothing_better() {
        for (name, kind) in HARD {
            let metal = metal_by_name(name).unwrap();
            let truth = TruthCurve::of(metal, RgbSpace::LinRec709);
            let found = fit(metal, kind, Method::BlackBox, truth.space).unwrap();
            for factor in [0.8, 1.2] {
                let start: Vec<f64> = coordinates(&found.model).into_iter().map(|x| x * factor).collect();
                let end = alone(&with_coordinates(&found.model, &start), &truth, 0.2);
                assert!(found.error.mean_delta_e < end + 0.01, "{name} {kind}: {} {end}", found.error.mean_delta_e);
            }
        }
    }

    #[test]
    fn the_same_search_gives_the_same_parameters() {
        let metal = metal_by_name("copper").unwrap();
        let once = || fit(metal, ModelKind::Conductor, Method::BlackBox, RgbSpace::AcesCg).unwrap().model;
        assert_eq!(once(), once());
    }

    #[test]
    fn starts_are_spread_evenly() {
        let points: Vec<Vec<f64>> = spread_around(&[0.0; 6]).collect();
        assert_eq!(points.len(), SPREAD_STARTS);
        for axis in 0..6 {
            let on_axis = || points.iter().map(|point| point[axis]);
            assert!(on_axis().all(|x| x.abs() <= SPREAD));
            let mean = on_axis().sum::<f64>() / SPREAD_STARTS as f64;
            assert!(mean.abs() < 0.3 * SPREAD, "{axis}: {mean}");
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
