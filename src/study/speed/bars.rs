//! What is aimed at, and whether it is reached.

use super::SpeedRow;
use super::evidence::SpeedEvidence;
use super::kernels::{BOUND, MATERIAL, OURS, PAIR, PICTURE, TABLE};

/// One aim.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// What is bounded.
    pub what: &'static str,
    /// The bound, with its unit.
    pub limit: String,
    /// What was measured, with its unit; empty where nothing was.
    pub measured: String,
    /// What follows.
    pub verdict: BarVerdict,
}

/// Whether an aim is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BarVerdict {
    /// What was measured lies within the bound.
    Met,
    /// It does not.
    Missed,
    /// Nothing was measured.
    NotMeasured,
}

impl BarVerdict {
    /// The word people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Met => "met",
            Self::Missed => "**missed**",
            Self::NotMeasured => "not measured",
        }
    }
}

/// A row's name: kernel, kind and per.
type Name<'a> = (&'a str, &'a str, &'a str);

/// The shortest time of a row in nanoseconds.
fn ns(rows: &[SpeedRow], name: Name<'_>) -> Option<f64> {
    rows.iter().find(|row| row.is(name)).map(|row| row.min_ns)
}

/// The shortest time of a row as a multiple of another's.
pub(super) fn ratio(rows: &[SpeedRow], over: Name<'_>, under: Name<'_>) -> Option<f64> {
    Some(ns(rows, over)? / ns(rows, under)?)
}

/// h against Schlick.
pub(super) fn hoffman(rows: &[SpeedRow]) -> Option<f64> {
    ratio(rows, ("hoffman", OURS, MATERIAL), ("schlick", OURS, MATERIAL))
}

/// F82-tint against Schlick.
pub(super) fn f82_tint(rows: &[SpeedRow]) -> Option<f64> {
    ratio(rows, ("f82-tint", OURS, MATERIAL), ("schlick", OURS, MATERIAL))
}

/// F and 1 − F of n and k against two roots and a division.
pub(super) fn conductor(rows: &[SpeedRow]) -> Option<f64> {
    against_bound(rows, "conductor-and-absorption")
}

/// 81 wavelengths against their roots and divisions.
pub(super) fn spectral(rows: &[SpeedRow]) -> Option<f64> {
    against_bound(rows, "spectral-81")
}

fn against_bound(rows: &[SpeedRow], kernel: &str) -> Option<f64> {
    ratio(rows, (kernel, OURS, MATERIAL), (kernel, BOUND, MATERIAL))
}

/// Every aim, with what was measured for it.
pub(super) fn bars(evidence: &SpeedEvidence) -> Vec<Bar> {
    let rows = &evidence.rows;
    let row_ns = |name| ns(rows, name);
    let row_ms = |name| ns(rows, name).map(|ns| ns / 1e6);
    let times = |what, limit, measured| Bar::new(what, limit, measured, " ×", 2);
    let mut bars = vec![
        times("h ÷ Schlick, in cache", 1.6, hoffman(rows)),
        times("F82-tint ÷ Schlick, in cache", 1.6, f82_tint(rows)),
        Bar::new("h and F82-tint: instructions of one RGB value on AVX2", 3.8, evidence.most_instructions(), "", 2),
        times("n, k: F and 1 − F ÷ (2 roots + 1 division)", 1.15, conductor(rows)),
        Bar::new("n, k of the library: F", 17.0, Some(evidence.digits.reflectance_ulp), " ULP", 1),
        Bar::in_powers("n, k of the library: 1 − F, relative, to 90°", 6e-7, Some(evidence.digits.absorbed_relative)),
        Bar::in_powers("(r, g) → (n, k), relative, to r = 1 − 1e-7", 4e-7, Some(evidence.index_relative)),
        Bar::new("dielectrics of n = 1.0001 to 4: F, to 90°", 10.0, Some(evidence.dielectric_ulp), " ULP", 1),
        times("a binary for any processor ÷ one for this, middle of the kernels", 1.05, evidence.builds_median()),
        times("81 wavelengths ÷ their roots and divisions", 1.05, spectral(rows)),
        Bar::new("20 wavelengths with spline weights: largest ΔE", 0.07, Some(evidence.spectral_20.max_delta_e), "", 3),
        Bar::new("10 coefficients for one metal: largest ΔE", 0.03, Some(evidence.polynomial_10.max_delta_e), "", 3),
        Bar::new("ΔE2000 of a pair", 15.0, row_ns(("delta-e", OURS, PAIR)), " ns", 1),
        Bar::in_powers("the table of errors: a ΔE in 32 bits against 64", 3e-4, Some(evidence.table_difference)),
        Bar::new(
            "the table of errors: 33 metals × 10 models × 91 angles",
            1.0,
            row_ms(("error-table", OURS, TABLE)),
            " ms",
            2,
        ),
        Bar::new(
            "a sphere of 1024 × 1024 by h, under soft boxes",
            3.0,
            row_ms(("preview-soft-boxes", OURS, PICTURE)),
            " ms",
            2,
        ),
        Bar::new(
            "a sphere of 1024 × 1024, under constant light",
            1.5,
            row_ms(("preview-white", OURS, PICTURE)),
            " ms",
            2,
        ),
    ];
    let plan = |what, measured| Bar::new(what, 2.0, measured, " s", 2);
    bars.push(plan("a plan of 1000 materials of the library on a pass of 4 megapixels", evidence.elsewhere.plan_s));
    let different = evidence.elsewhere.plan_of_different_s;
    bars.push(plan("the same of 1000 metals that all differ, each fitted anew", different));
    bars
}

impl Bar {
    fn new(what: &'static str, limit: f64, measured: Option<f64>, unit: &str, decimals: usize) -> Self {
        let text = |value: f64| format!("{value:.decimals$}{unit}");
        Self::of(what, limit, measured, format!("≤ {limit}{unit}"), text)
    }

    fn in_powers(what: &'static str, limit: f64, measured: Option<f64>) -> Self {
        Self::of(what, limit, measured, format!("≤ {limit:.0e}"), |value| format!("{value:.1e}"))
    }

    fn of(what: &'static str, bound: f64, measured: Option<f64>, limit: String, text: impl Fn(f64) -> String) -> Self {
        let verdict = match measured {
            None => BarVerdict::NotMeasured,
            Some(value) if value <= bound => BarVerdict::Met,
            Some(_) => BarVerdict::Missed,
        };
        Self { what, limit, measured: measured.map(text).unwrap_or_default(), verdict }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_measured_is_not_met() {
        let verdict = |measured| Bar::new("x", 1.5, measured, " ms", 2).verdict;
        assert_eq!(verdict(Some(1.5)), BarVerdict::Met);
        assert_eq!(verdict(Some(1.6)), BarVerdict::Missed);
        assert_eq!(verdict(Some(f64::NAN)), BarVerdict::Missed);
        assert_eq!(verdict(None), BarVerdict::NotMeasured);
        let bar = Bar::new("x", 1.5, Some(1.234), " ms", 2);
        assert_eq!((bar.limit.as_str(), bar.measured.as_str()), ("≤ 1.5 ms", "1.23 ms"));
        assert_eq!(Bar::in_powers("x", 3e-4, Some(2.1e-4)).limit, "≤ 3e-4");
    }
}
