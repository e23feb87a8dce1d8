//! A card seen directly and in a flat mirror: their ratio is the reflectance at that angle (mode A).

use super::light::relative_error;
use super::outcome::{Match, MatchError, UncertaintyBudget};
use super::view::View;
use super::{BallFit, Unknowns, guard};
use crate::color::RgbSpace;
use crate::fresnel::{CosTheta, Weights, h_of_schlick};
use crate::photo::{AreaStatistics, MatchRequest, MirrorPair};

/// How evenly a card is lit, seen from two sides, relative.
const CARD_EVENNESS: f64 = 0.005;
/// How well a person knows the angle, in degrees.
const ANGLE_UNCERTAINTY_DEG: f64 = 0.5;
/// Up to here one ratio gives r, whatever h is.
const FACING_UP_TO_DEG: f64 = 40.0;
/// From here one ratio gives h, whatever r is.
const GRAZING_FROM_DEG: f64 = 78.0;

/// One measured ratio.
struct Ratio {
    weights: Weights,
    angle_deg: f64,
    direct: AreaStatistics,
    mirrored: AreaStatistics,
}

/// r and h from the pairs of a request.
pub(super) fn solve_mirrors(view: &View, request: &MatchRequest, space: RgbSpace) -> Result<Match, MatchError> {
    let ratios = request.mirrors.iter().map(|pair| Ratio::of(view, pair)).collect::<Result<Vec<_>, _>>()?;
    if ratios.is_empty() {
        return Err(MatchError::needs(request.mode, "a card seen directly and in the mirror"));
    }
    let unknowns = unknowns(&ratios)?;
    let mut budget = UncertaintyBudget::default();
    let fits: [BallFit; 3] = std::array::from_fn(|channel| {
        let (r, h) = solve_channel(&ratios, channel, unknowns, 0.0);
        let (turned_r, turned_h) = solve_channel(&ratios, channel, unknowns, ANGLE_UNCERTAINTY_DEG);
        let change = |old: Option<f64>, new: Option<f64>| (new.unwrap_or(0.0) - old.unwrap_or(0.0)).abs();
        let (sample, light) = (ratios.iter().map(|ratio| ratio.error(channel)).fold(0.0, f64::max), CARD_EVENNESS);
        let of = |relative: f64| [r, h].map(|value| value.unwrap_or(0.0).abs() * relative);
        budget.angle[channel] = [change(r, turned_r), change(h, turned_h)];
        budget.sample[channel] = of(sample);
        budget.light[channel] = of(light);
        let brightest = ratios.iter().map(|ratio| ratio.direct.trimmed_mean[channel]).fold(0.0, f64::max);
        budget.transfer[channel] = of(view.tone_uncertainty(channel, brightest));
        BallFit { r, h, ..BallFit::default() }
    });
    let is_usable = |channel: usize| ratios.iter().all(|ratio| ratio.is_usable(channel));
    let light = std::array::from_fn(|i| is_usable(i).then(|| ratios[0].direct.trimmed_mean[i]));
    let pixels = ratios.iter().map(|ratio| ratio.mirrored.pixels).sum();
    let mut outcome = Match::of_ratios(request, space, light, &fits, budget, pixels, view.is_estimate());
    let areas: Vec<_> = ratios
        .iter()
        .flat_map(|ratio| [("card", ratio.direct.clone()), ("card in the mirror", ratio.mirrored.clone())])
        .collect();
    outcome.warnings = guard::area_warnings(view, request, &areas, &outcome);
    Ok(outcome)
}

impl Ratio {
    fn of(view: &View, pair: &MirrorPair) -> Result<Self, MatchError> {
        let (direct, mirrored) = (view.statistics(pair.direct), view.statistics(pair.mirrored));
        for (statistics, what) in [(&direct, "card"), (&mirrored, "card in the mirror")] {
            if statistics.pixels == 0 {
                return Err(MatchError::NoPixels { what });
            }
            if statistics.trimmed_mean.iter().all(|value| *value <= 0.0) {
                return Err(MatchError::DarkReference { what });
            }
        }
        let weights = Weights::at(CosTheta::from_deg(pair.angle_deg));
        Ok(Self { weights, angle_deg: pair.angle_deg, direct, mirrored })
    }

    fn reflectance(&self, channel: usize) -> f64 {
        self.mirrored.trimmed_mean[channel] / self.direct.trimmed_mean[channel]
    }

    fn error(&self, channel: usize) -> f64 {
        relative_error(&self.direct, channel).hypot(relative_error(&self.mirrored, channel))
    }

    fn is_usable(&self, channel: usize) -> bool {
        !self.direct.is_clipped(channel) && !self.mirrored.is_clipped(channel) && self.reflectance(channel).is_finite()
    }
}

/// What angles like these can tell.
fn unknowns(ratios: &[Ratio]) -> Result<Unknowns, MatchError> {
    let has_facing = ratios.iter().any(|ratio| ratio.angle_deg <= FACING_UP_TO_DEG);
    let has_grazing = ratios.iter().any(|ratio| ratio.angle_deg >= GRAZING_FROM_DEG);
    match (has_facing, has_grazing) {
        (true, true) => Ok(Unknowns::Both),
        (true, false) => Ok(Unknowns::R),
        (false, true) => Ok(Unknowns::H),
        (false, false) => Err(MatchError::MirrorAngle { up_to_deg: FACING_UP_TO_DEG, from_deg: GRAZING_FROM_DEG }),
    }
}

/// Least squares over the ratios of a channel, with every angle turned by `turned_deg`.
fn solve_channel(ratios: &[Ratio], channel: usize, unknowns: Unknowns, turned_deg: f64) -> (Option<f64>, Option<f64>) {
    let facing = ratios.iter().find(|ratio| ratio.angle_deg <= FACING_UP_TO_DEG);
    let rows = ratios.iter().map(|ratio| {
        let weights = if turned_deg == 0.0 {
            ratio.weights
        } else {
            Weights::at(CosTheta::from_deg((ratio.angle_deg - turned_deg).max(0.0)))
        };
        (weights, ratio.reflectance(channel))
    });
    match unknowns {
        Unknowns::Both => super::fit::solve_rows(rows),
        Unknowns::R => {
            let r = facing.map_or(f64::NAN, |ratio| ratio.reflectance(channel));
            // h weighs below 0.003 here; Schlick's stands in.
            let mean = mean(rows.map(|(w, f)| (f - w.of_white - w.of_h * h_of_schlick(r)) / w.of_r));
            (Some(mean), None)
        }
        Unknowns::H => {
            // At θ_max r weighs nothing; a few degrees off, h itself stands in.
            (None, Some(mean(rows.map(|(w, f)| (f - w.of_white) / (w.of_r + w.of_h)))))
        }
        Unknowns::Neither => (None, None),
    }
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / count
}
