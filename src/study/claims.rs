//! The paper's claims, each with what was measured.

use super::{Candidate, Evidence, Summary};
use crate::color::RgbSpace;
use crate::fit::{Method, Triple};
use crate::fresnel::{ModelKind, THETA_MAX_DEG};

/// How a claim fares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It holds as stated.
    Holds,
    /// It holds in some spaces, for some metals or for some methods.
    Depends,
    /// The measurements contradict it.
    Fails,
}

impl Verdict {
    /// The word people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Depends => "depends",
            Self::Fails => "does not hold",
        }
    }

    /// Holds, or with conditions, or not.
    const fn of(always: bool, sometimes: bool) -> Self {
        match (always, sometimes) {
            (true, _) => Self::Holds,
            (false, true) => Self::Depends,
            (false, false) => Self::Fails,
        }
    }
}

/// One claim of the paper and the outcome of measuring it.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Section of the paper.
    pub section: &'static str,
    /// What the paper says, in short.
    pub says: &'static str,
    /// Whether it holds.
    pub verdict: Verdict,
    /// The measurement, as a sentence with its numbers.
    pub found: String,
}

const SRGB: RgbSpace = RgbSpace::LinRec709;
const ACESCG: RgbSpace = RgbSpace::AcesCg;
const ROUND: Candidate = Candidate::Model(ModelKind::Conductor, Method::Points(Triple::ROUND));
const PRIMARIES: Candidate = Candidate::Model(ModelKind::Conductor, Method::Points(Triple::PRIMARIES));
const DEFAULT_G: Candidate = Candidate::Model(ModelKind::Gulbrandsen, Method::DefaultTint);

impl Evidence {
    /// Every claim of the paper that can be measured without people, in the paper's order.
    pub fn claims(&self) -> Vec<Claim> {
        let claims = [
            self.schlick_is_accurate(),
            self.robust_under_conversion(),
            self.robust_under_blending(),
            self.point_sampling_is_no_better(),
            self.black_box_is_the_most_accurate(),
            self.g_has_no_default(),
            self.peak_is_near_theta_max(),
            self.h_beats_schlick(),
        ];
        claims.into_iter().flatten().collect()
    }

    fn schlick_is_accurate(&self) -> Option<Claim> {
        let [srgb, acescg] = self.both(Candidate::SCHLICK)?;
        Some(Claim {
            section: "2",
            says: "for the majority of metals Schlick's mean error is under 2 ΔE",
            verdict: Verdict::of(2 * srgb.below_two > srgb.metals && 2 * acescg.below_two > acescg.metals, false),
            found: format!(
                "under 2 for {} of {} metals in linear sRGB and {} in ACEScg, {:.2} and {:.2} on average; \
                 but the largest error of a metal is {:.1} on average and reaches {:.1}, near grazing ({}°)",
                srgb.below_two,
                srgb.metals,
                acescg.below_two,
                srgb.mean_delta_e,
                acescg.mean_delta_e,
                srgb.mean_max_delta_e,
                srgb.largest_delta_e,
                srgb.angle_of_largest_deg
            ),
        })
    }

    fn robust_under_conversion(&self) -> Option<Claim> {
        let [h, t, g, nk] = &self.conversion;
        Some(Claim {
            section: "4",
            says: "converting n, k or g to another space as colours introduces significant errors; r does not",
            verdict: Verdict::of(h.max < 1e-9 && g.max > 1.0 && nk.max > 1.0, h.max < 1e-9),
            found: format!(
                "from ACEScg to linear sRGB, mean ΔE over the angles: r, h exactly 0; r, g {:.2} on average, {:.1} at \
                 worst ({}); n, k {:.2} and {:.1} ({}); r, t {:.2} and {:.1}",
                g.mean, g.max, g.worst, nk.mean, nk.max, nk.worst, t.mean, t.max
            ),
        })
    }

    fn robust_under_blending(&self) -> Option<Claim> {
        let [h, t, g, nk] = &self.blending;
        Some(Claim {
            section: "4",
            says: "blending n, k or g introduces significant errors; blending r does not, or far less",
            verdict: Verdict::of(h.max < 1e-9 && nk.mean > 1.0 && g.mean > 1.0, h.max < 1e-9 && nk.mean > 1.0),
            found: format!(
                "half and half over {} pairs in ACEScg, mean ΔE over the angles: r, h exactly 0; n, k {:.2} on average \
                 and {:.1} at worst ({}); r, g only {:.2} and {:.1}; r, t {:.2} and {:.1}",
                h.count, nk.mean, nk.max, nk.worst, g.mean, g.max, t.mean, t.max
            ),
        })
    }

    fn point_sampling_is_no_better(&self) -> Option<Claim> {
        let [round_srgb, round_acescg] = self.both(ROUND)?;
        let [primaries_srgb, primaries_acescg] = self.both(PRIMARIES)?;
        let [schlick_srgb, schlick_acescg] = self.both(Candidate::SCHLICK)?;
        let is_worse = |summary: &Summary, schlick: &Summary| summary.mean_delta_e >= schlick.mean_delta_e;
        let cells = [
            is_worse(round_srgb, schlick_srgb),
            is_worse(round_acescg, schlick_acescg),
            is_worse(primaries_srgb, schlick_srgb),
            is_worse(primaries_acescg, schlick_acescg),
        ];
        let cell = |summary: &Summary| {
            format!("{:.2} (worse for {})", summary.mean_delta_e, summary.worse_than_schlick_text())
        };
        Some(Claim {
            section: "5",
            says: "RGB n, k by common methods such as point sampling are as wrong as Schlick or more",
            verdict: Verdict::of(cells == [true; 4], cells != [false; 4]),
            found: format!(
                "mean ΔE at 650/550/450 nm: {} in linear sRGB, {} in ACEScg; at 630/532/465 nm: {} and {}; \
                 Schlick: {:.2} and {:.2}, of {} metals: it depends on the space, the wavelengths and the metal",
                cell(round_srgb),
                cell(round_acescg),
                cell(primaries_srgb),
                cell(primaries_acescg),
                schlick_srgb.mean_delta_e,
                schlick_acescg.mean_delta_e,
                schlick_srgb.metals
            ),
        })
    }

    fn black_box_is_the_most_accurate(&self) -> Option<Claim> {
        let [srgb, acescg] = self.both(Self::FITTED_NK)?;
        let rgb_models = |space: RgbSpace| {
            self.summaries.iter().filter(move |s| s.space == space && matches!(s.candidate, Candidate::Model(..)))
        };
        let best = |space: RgbSpace, own: f64| rgb_models(space).all(|summary| summary.mean_delta_e >= own);
        let all = best(SRGB, srgb.mean_delta_e) && best(ACESCG, acescg.mean_delta_e);
        Some(Claim {
            section: "5",
            says: "the most accurate results are achieved by black-box fitting of n and k",
            verdict: Verdict::of(all, best(ACESCG, acescg.mean_delta_e)),
            found: format!(
                "mean ΔE {:.3} in linear sRGB and {:.3} in ACEScg, below every other RGB model and method; more accurate \
                 than r and h for {} and {} of {} metals: the case for h is not accuracy",
                srgb.mean_delta_e,
                acescg.mean_delta_e,
                self.wins(SRGB, Self::FITTED_NK, Candidate::HOFFMAN),
                self.wins(ACESCG, Self::FITTED_NK, Candidate::HOFFMAN),
                srgb.metals
            ),
        })
    }

    fn g_has_no_default(&self) -> Option<Claim> {
        let [_, half] = self.both(DEFAULT_G)?;
        let [_, schlick] = self.both(Candidate::SCHLICK)?;
        let (g, error) = self.best_constant_g;
        Some(Claim {
            section: "5",
            says: "g has no reasonable default value",
            verdict: Verdict::of(
                half.mean_delta_e > schlick.mean_delta_e && error > schlick.mean_delta_e,
                half.mean_delta_e > schlick.mean_delta_e,
            ),
            found: format!(
                "g = 0.5 has a mean ΔE of {:.2} in ACEScg, worse than Schlick for {} of {} metals; of all constants \
                 g = {g:.2} is best with {error:.2}, against {:.2} of Schlick",
                half.mean_delta_e,
                half.worse_than_schlick_text(),
                half.metals,
                schlick.mean_delta_e
            ),
        })
    }

    fn peak_is_near_theta_max(&self) -> Option<Claim> {
        let peak = &self.schlick_peak_deg;
        Some(Claim {
            section: "8",
            says: "81.8° is close to the peak of Schlick's error for the metals investigated",
            verdict: Verdict::of((peak.median - THETA_MAX_DEG).abs() < 3.0, peak.lower_quartile < THETA_MAX_DEG),
            found: format!(
                "the largest linear error is at {:.0}° in the median, between {:.0}° and {:.0}° for half of the metals, \
                 {:.0}° to {:.0}° over all",
                peak.median, peak.lower_quartile, peak.upper_quartile, peak.min, peak.max
            ),
        })
    }

    fn h_beats_schlick(&self) -> Option<Claim> {
        let [srgb, acescg] = self.both(Candidate::HOFFMAN)?;
        let wins = RgbSpace::ALL.map(|space| self.wins(space, Candidate::HOFFMAN, Candidate::SCHLICK));
        let fewest = *wins.iter().min()?;
        let hard: Vec<String> = self
            .hard_cases(ACESCG)
            .into_iter()
            .take(3)
            .map(|row| format!("{} {:.2}", row.name.to_lowercase(), row.mean_delta_e))
            .collect();
        Some(Claim {
            section: "8",
            says: "the model with h has lower error than Schlick",
            verdict: Verdict::of(fewest == srgb.metals, 2 * fewest > srgb.metals),
            found: format!(
                "lower for at least {fewest} of {} metals in each of four spaces; mean ΔE {:.2} in linear sRGB and {:.2} in \
                 ACEScg, median {:.2} and {:.2}; its hard cases are {}",
                srgb.metals,
                srgb.mean_delta_e,
                acescg.mean_delta_e,
                srgb.median_delta_e,
                acescg.median_delta_e,
                hard.join(", ")
            ),
        })
    }

    /// A contestant in linear sRGB and in ACEScg.
    fn both(&self, candidate: Candidate) -> Option<[&Summary; 2]> {
        Some([self.summary(SRGB, candidate)?, self.summary(ACESCG, candidate)?])
    }
}
