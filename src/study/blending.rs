//! Parameters blended between two materials against blended reflectance (paper section 4).

use std::ops::ControlFlow;

use rayon::prelude::*;
use serde::Serialize;

use super::accuracy::Meter;
use super::conversion::delta_e_of_curves;
use super::distribution::told;
use super::parameters::Parameters;
use super::{Contestants, Distribution, StudyError, Subject};
use crate::color::{Rgb, RgbSpace};
use crate::fit::{CurveError, FitError, Method};
use crate::metal::Metal;

/// Steps of the slider that the study looks at.
pub const BLEND_STEPS: usize = 20;

/// A slider from one material to another.
#[derive(Clone, Debug)]
pub struct Blend {
    /// Name of the material at 0.
    pub a: String,
    /// Name of the material at 1.
    pub b: String,
    /// The space in which everything is blended.
    pub space: RgbSpace,
    /// One for each of [`Parameters::ALL`].
    pub results: Vec<BlendedParameters>,
}

/// What becomes of one description along the slider.
#[derive(Clone, Debug)]
pub struct BlendedParameters {
    /// Which parameters are blended.
    pub parameters: Parameters,
    /// At each step of the slider: blended parameters against the blend of their own two appearances.
    pub own: Vec<CurveError>,
    /// At each step: against the blend of the two truths.
    pub truth: Vec<CurveError>,
    /// The worst place of `own`.
    pub worst: WorstBlend,
}

/// The worst place of a slider.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WorstBlend {
    /// Share of the second material, 0–1.
    pub weight: f64,
    /// Angle of incidence in degrees.
    pub theta_deg: f64,
    /// CIEDE2000 there.
    pub delta_e: f64,
}

/// Share of the second material at each step.
pub fn blend_weights() -> impl Iterator<Item = f64> + Clone {
    (0..=BLEND_STEPS).map(|step| step as f64 / BLEND_STEPS as f64)
}

/// Blends two materials, both in the space of the first; `b` must be in it too.
pub fn blending(a: &Contestants, b: &Contestants) -> Blend {
    let results = Parameters::ALL.into_par_iter().map(|parameters| BlendedParameters::new(a, b, parameters));
    Blend { a: a.name.clone(), b: b.name.clone(), space: a.space, results: results.collect() }
}

impl BlendedParameters {
    fn new(a: &Contestants, b: &Contestants, parameters: Parameters) -> Self {
        let ends = Ends::new(a, b, parameters);
        let errors: Vec<(CurveError, CurveError)> = blend_weights().map(|weight| ends.errors(weight)).collect();
        let (own, truth): (Vec<_>, Vec<_>) = errors.into_iter().unzip();
        let worst = worst_of(&own);
        Self { parameters, own, truth, worst }
    }

    /// Against blended reflectance, halfway.
    pub fn halfway(&self) -> CurveError {
        self.own[BLEND_STEPS / 2]
    }
}

/// Both ends of a slider, described by the same parameters.
struct Ends<'a> {
    a: &'a Contestants,
    b: &'a Contestants,
    parameters: Parameters,
    curves: [Vec<Rgb>; 2],
}

impl<'a> Ends<'a> {
    fn new(a: &'a Contestants, b: &'a Contestants, parameters: Parameters) -> Self {
        assert_eq!(a.space, b.space, "blending mixes numbers of one space");
        Self { curves: [a.pair(parameters).curve(), b.pair(parameters).curve()], a, b, parameters }
    }

    /// Against the blend of the own appearances, and against the blend of the truths.
    fn errors(&self, weight: f64) -> (CurveError, CurveError) {
        let blended = self.a.pair(self.parameters).lerp(self.b.pair(self.parameters), weight).curve();
        let error = |x: &[Rgb], y: &[Rgb]| {
            let wanted: Vec<Rgb> = x.iter().zip(y).map(|(x, y)| x.lerp(*y, weight)).collect();
            CurveError::over_degrees(delta_e_of_curves(&blended, &wanted, self.a.space))
        };
        (error(&self.curves[0], &self.curves[1]), error(&self.a.truth, &self.b.truth))
    }
}

fn worst_of(errors: &[CurveError]) -> WorstBlend {
    let mut worst = WorstBlend { weight: 0.0, theta_deg: 0.0, delta_e: 0.0 };
    for (weight, error) in blend_weights().zip(errors) {
        if error.max_delta_e > worst.delta_e {
            worst = WorstBlend { weight, theta_deg: error.angle_of_max_deg, delta_e: error.max_delta_e };
        }
    }
    worst
}

/// One step of one description. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BlendRow {
    /// The material at weight 0.
    pub a: String,
    /// The material at weight 1.
    pub b: String,
    /// The space in which everything is blended.
    pub space: RgbSpace,
    /// `h`, `t`, `g` or `nk`.
    pub parameters: Parameters,
    /// Share of `b`.
    pub weight: f64,
    /// Mean CIEDE2000 over the angles: blended parameters against the blend of their own appearances.
    pub mean_delta_e: f64,
    /// Largest of the same.
    pub max_delta_e: f64,
    /// The angle of the largest, in degrees.
    pub angle_of_max_deg: f64,
    /// Mean CIEDE2000 to the blended truth: blending and model together.
    pub truth_mean_delta_e: f64,
    /// Largest of the same.
    pub truth_max_delta_e: f64,
}

/// One description along the whole slider. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BlendSummary {
    /// The material at weight 0.
    pub a: String,
    /// The material at weight 1.
    pub b: String,
    /// The space in which everything is blended.
    pub space: RgbSpace,
    /// `h`, `t`, `g` or `nk`.
    pub parameters: Parameters,
    /// Mean CIEDE2000 over the angles, halfway: blended parameters against the blend of their own appearances.
    pub halfway_mean_delta_e: f64,
    /// Mean CIEDE2000 to the blended truth, halfway.
    pub halfway_truth_mean_delta_e: f64,
    /// Largest CIEDE2000 at any step and angle.
    pub worst_delta_e: f64,
    /// The share of `b` there.
    pub worst_weight: f64,
    /// The angle there, in degrees.
    pub worst_theta_deg: f64,
}

impl Blend {
    /// One row for each description.
    pub fn summaries(&self) -> Vec<BlendSummary> {
        let of = |result: &BlendedParameters| BlendSummary {
            a: self.a.clone(),
            b: self.b.clone(),
            space: self.space,
            parameters: result.parameters,
            halfway_mean_delta_e: result.halfway().mean_delta_e,
            halfway_truth_mean_delta_e: result.truth[BLEND_STEPS / 2].mean_delta_e,
            worst_delta_e: result.worst.delta_e,
            worst_weight: result.worst.weight,
            worst_theta_deg: result.worst.theta_deg,
        };
        self.results.iter().map(of).collect()
    }

    /// Every step of every description.
    pub fn rows(&self) -> Vec<BlendRow> {
        self.results.iter().flat_map(|result| (0..=BLEND_STEPS).map(|step| self.row(result, step))).collect()
    }

    fn row(&self, result: &BlendedParameters, step: usize) -> BlendRow {
        let (own, truth) = (result.own[step], result.truth[step]);
        BlendRow {
            a: self.a.clone(),
            b: self.b.clone(),
            space: self.space,
            parameters: result.parameters,
            weight: step as f64 / BLEND_STEPS as f64,
            mean_delta_e: own.mean_delta_e,
            max_delta_e: own.max_delta_e,
            angle_of_max_deg: own.angle_of_max_deg,
            truth_mean_delta_e: truth.mean_delta_e,
            truth_max_delta_e: truth.max_delta_e,
        }
    }

    /// What is seen, with the numbers in it.
    pub fn summary(&self) -> String {
        let [h, t, g, nk] = Parameters::ALL.map(|parameters| self.results[parameters as usize].worst);
        format!(
            "From {} to {}: blending r and h blends the reflectance ({:.2} ΔE at worst); blended t is off by up to \
             {:.2} ΔE, g by {:.2} and n, k by {:.2}, which is at {:.0} % and {:.0}°.",
            self.a,
            self.b,
            h.delta_e,
            t.delta_e,
            g.delta_e,
            nk.delta_e,
            100.0 * nk.weight,
            nk.theta_deg
        )
    }
}

/// Two materials half and half, in one description. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BlendPair {
    /// The one material.
    pub a: String,
    /// The other.
    pub b: String,
    /// Place of `a` in the list that was blended.
    pub index_of_a: usize,
    /// Place of `b`.
    pub index_of_b: usize,
    /// The space in which everything is blended.
    pub space: RgbSpace,
    /// `h`, `t`, `g` or `nk`.
    pub parameters: Parameters,
    /// Mean CIEDE2000 over the angles: blended parameters against the blend of their own appearances.
    pub mean_delta_e: f64,
    /// Largest of the same.
    pub max_delta_e: f64,
    /// Mean CIEDE2000 to the blended truth: blending and model together.
    pub truth_mean_delta_e: f64,
    /// Largest of the same.
    pub truth_max_delta_e: f64,
}

/// Every pair of metals half and half; rows in the order pair, parameters. Pairs run in parallel.
///
/// `progress` is told the share of metals whose pairs are done, from any thread, and stops the study by breaking.
pub fn blend_matrix(
    metals: &[&Metal],
    space: RgbSpace,
    method: Method,
    progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Result<Vec<BlendPair>, StudyError> {
    let prepare = |metal: &&Metal| Contestants::of(&Subject::Metal(metal), space, method);
    let contestants = metals.par_iter().map(prepare).collect::<Result<Vec<Contestants>, StudyError>>()?;
    let meter = Meter::new(metals.len(), progress);
    let with_later = |index: usize| {
        let pairs: Vec<BlendPair> =
            (index + 1..contestants.len()).flat_map(|other| pair_rows(&contestants, index, other)).collect();
        meter.one_more().map_err(FitError::Stopped)?;
        Ok(pairs)
    };
    let rows: Result<Vec<Vec<BlendPair>>, StudyError> = (0..metals.len()).into_par_iter().map(with_later).collect();
    Ok(rows?.into_iter().flatten().collect())
}

fn pair_rows(contestants: &[Contestants], index_of_a: usize, index_of_b: usize) -> [BlendPair; 4] {
    let (a, b) = (&contestants[index_of_a], &contestants[index_of_b]);
    Parameters::ALL.map(|parameters| {
        let (own, truth) = Ends::new(a, b, parameters).errors(0.5);
        BlendPair {
            a: a.name.clone(),
            b: b.name.clone(),
            index_of_a,
            index_of_b,
            space: a.space,
            parameters,
            mean_delta_e: own.mean_delta_e,
            max_delta_e: own.max_delta_e,
            truth_mean_delta_e: truth.mean_delta_e,
            truth_max_delta_e: truth.max_delta_e,
        }
    })
}

/// How the mean error over the angles is spread over pairs, for each of [`Parameters::ALL`].
pub fn blend_spread(rows: &[BlendPair]) -> [Distribution; 4] {
    Parameters::ALL.map(|parameters| {
        let own: Vec<(String, f64)> = rows
            .iter()
            .filter(|row| row.parameters == parameters)
            .map(|row| (format!("{} and {}", row.a, row.b), row.mean_delta_e))
            .collect();
        Distribution::of(own.iter().map(|(name, value)| (name.as_str(), *value)))
    })
}

/// What is seen over all pairs, with the numbers in it.
pub fn blend_pairs_summary(rows: &[BlendPair]) -> String {
    let spread = blend_spread(rows);
    format!("Mean ΔE over {} pairs, half and half: {}.", spread[0].count, told(&spread))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::whole_degrees;
    use crate::metal::metal_by_name;
    use crate::number::larger;
    use crate::study::{Pair, no_progress};

    fn metal(name: &str) -> Contestants {
        Contestants::of(&Subject::Metal(metal_by_name(name).unwrap()), RgbSpace::AcesCg, Method::LeastSquares).unwrap()
    }

    proptest! {
        #[test]
        fn r_and_h_blend_without_error(
            a in prop::array::uniform2(prop::array::uniform3(-0.1..1.1)),
            b in prop::array::uniform2(prop::array::uniform3(-0.1..1.1)), weight in 0.0..1.0_f64,
        ) {
            let pair = |[r, h]: [[f64; 3]; 2]| Pair::new(Parameters::H, Rgb(r), Rgb(h));
            let blended = pair(a).lerp(pair(b), weight);
            for cos_theta in whole_degrees() {
                let wanted = pair(a).reflectance(cos_theta).lerp(pair(b).reflectance(cos_theta), weight);
                prop_assert!(blended.reflectance(cos_theta).max_abs_difference(wanted) < 1e-12);
            }
        }
    }

    #[test]
    fn the_ends_of_the_slider_are_the_materials() {
        let blend = blending(&metal("gold"), &metal("silver"));
        for result in &blend.results {
            for error in [result.own[0], result.own[BLEND_STEPS]] {
                assert!(error.max_delta_e < 1e-9, "{:?}", result.parameters);
            }
            let largest = result.own.iter().map(|error| error.max_delta_e).fold(0.0, larger);
            assert_eq!(result.worst.delta_e, largest);
        }
        assert_eq!(blend.rows().len(), 4 * (BLEND_STEPS + 1));
    }

    #[test]
    fn the_matrix_holds_each_pair_once() {
        let metals = ["gold", "silver", "iron"].map(|name| metal_by_name(name).unwrap());
        let rows = blend_matrix(&metals, RgbSpace::AcesCg, Method::LeastSquares, &no_progress).unwrap();
        let pairs: Vec<(usize, usize)> = rows.iter().step_by(4).map(|row| (row.index_of_a, row.index_of_b)).collect();
        assert_eq!(pairs, [(0, 1), (0, 2), (1, 2)]);
        let halfway = blending(&metal("gold"), &metal("silver"));
        for (row, result) in rows.iter().zip(&halfway.results) {
            assert_eq!(row.mean_delta_e, result.halfway().mean_delta_e);
        }
        assert!(blend_spread(&rows)[0].max < 1e-9);
    }
}
