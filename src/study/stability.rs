//! How many digits each model and conversion keeps, also where its parameters are no reflectances.

use std::ops::ControlFlow;

use rayon::prelude::*;
use serde::Serialize;

use super::exact::Exact;
use super::stability_cases::{Case, Evaluations, cases};
use crate::fit::Stopped;

/// One model or conversion, one way to write it, one arithmetic, one domain. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StabilityRow {
    /// What is computed, e.g. `conductor` or `n-of-r-g`.
    pub quantity: &'static str,
    /// `ours`, `textbook`, or `textbook, complex` for pbrt's arithmetic.
    pub kind: &'static str,
    /// `vectors` and `scalar` are 32 bits; `64-bits`; `16-bit-parameters` are stored in half, computed in vectors.
    pub arithmetic: &'static str,
    /// `inside` where the parameters are a material's and 0 ≤ c ≤ 1, `outside` elsewhere.
    pub domain: &'static str,
    /// Values computed.
    pub points: usize,
    /// The largest distance from the exact value, of finite results; the exact value is that of c held in 0–1.
    pub max_absolute: Option<f64>,
    /// Where that is.
    pub max_absolute_at: String,
    /// The same in units of the last place of the larger of the two.
    pub max_ulp: Option<f64>,
    /// Where that is.
    pub max_ulp_at: String,
    /// Results that are no number.
    pub nan: usize,
    /// Results that are infinite.
    pub infinite: usize,
    /// Results below 0 where the exact value is not.
    pub negative: usize,
    /// Results above 1 where the exact value is not.
    pub above_one: usize,
}

/// How fine the grids are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fineness {
    /// Every edge and a little between: seconds.
    #[default]
    Default,
    /// Every decade and tenth: minutes without optimisation.
    Fine,
}

/// The arithmetics, in the order of the rows.
const ARITHMETICS: [&str; 4] = ["vectors", "scalar", "64-bits", "16-bit-parameters"];

/// Measures every case over its grid. `progress` is told the share done, from any thread, and stops it by breaking.
pub fn stability(
    fineness: Fineness,
    progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Result<Vec<StabilityRow>, Stopped> {
    let cases = cases();
    let meter = super::accuracy::Meter::new(cases.len(), progress);
    let rows: Result<Vec<Vec<StabilityRow>>, Stopped> = cases
        .par_iter()
        .map(|case| {
            let rows = rows_of(case, fineness);
            meter.one_more()?;
            Ok(rows)
        })
        .collect();
    Ok(rows?.into_iter().flatten().collect())
}

fn rows_of(case: &Case, fineness: Fineness) -> Vec<StabilityRow> {
    let mut tallies = [[(); 2]; 4].map(|domains| domains.map(|()| Tally::default()));
    for point in case.grid(fineness) {
        let domain = usize::from(!(case.is_inside)(&point));
        let exact = (case.exact)(&point);
        let (Evaluations { vectors, scalar, double }, half) =
            ((case.evaluate)(&point), (case.evaluate)(&case.halved(&point)));
        let results: [(f64, Unit); 4] = [
            (f64::from(vectors), unit_of_single),
            (f64::from(scalar), unit_of_single),
            (double, unit_of_double),
            (f64::from(half.vectors), unit_of_single),
        ];
        for (tally, (result, unit)) in tallies.iter_mut().zip(results) {
            tally[domain].add(exact.as_ref(), result, unit, &|| case.told(&point));
        }
    }
    let row = |(arithmetic, domains): (usize, [Tally; 2])| {
        let [inside, outside] = domains;
        [("inside", inside), ("outside", outside)]
            .into_iter()
            .filter(|(_, tally)| tally.points > 0)
            .map(move |(domain, tally)| tally.row(case, ARITHMETICS[arithmetic], domain))
    };
    tallies.into_iter().enumerate().flat_map(row).collect()
}

/// Distance from a number to the next.
type Unit = fn(f64) -> f64;

/// Of 32 bits.
pub(super) fn unit_of_single(value: f64) -> f64 {
    let size = (value as f32).abs().clamp(f32::MIN_POSITIVE, f32::MAX / 2.0);
    f64::from(size.next_up()) - f64::from(size)
}

/// Of 64 bits.
fn unit_of_double(value: f64) -> f64 {
    let size = value.abs().clamp(f64::MIN_POSITIVE, f64::MAX / 2.0);
    size.next_up() - size
}

/// What is seen of one arithmetic in one domain.
#[derive(Clone, Debug, Default)]
struct Tally {
    points: usize,
    absolute: Option<(f64, String)>,
    ulp: Option<(f64, String)>,
    nan: usize,
    infinite: usize,
    negative: usize,
    above_one: usize,
}

impl Tally {
    fn add(&mut self, exact: Option<&Exact>, result: f64, unit: Unit, told: &dyn Fn() -> String) {
        self.points += 1;
        self.nan += usize::from(result.is_nan());
        self.infinite += usize::from(result.is_infinite());
        let Some(exact) = exact.filter(|_| result.is_finite()) else { return };
        let off = (Exact::of(result) - exact.clone()).to_f64().abs();
        let exact = exact.to_f64();
        self.negative += usize::from(result < 0.0 && exact >= 0.0);
        self.above_one += usize::from(result > 1.0 && exact <= 1.0);
        keep_larger(&mut self.absolute, off, told);
        keep_larger(&mut self.ulp, off / unit(result.abs().max(exact.abs())), told);
    }

    fn row(self, case: &Case, arithmetic: &'static str, domain: &'static str) -> StabilityRow {
        let (max_absolute, max_absolute_at) = self.absolute.unzip();
        let (max_ulp, max_ulp_at) = self.ulp.unzip();
        StabilityRow {
            quantity: case.quantity,
            kind: case.kind,
            arithmetic,
            domain,
            points: self.points,
            max_absolute,
            max_absolute_at: max_absolute_at.unwrap_or_default(),
            max_ulp,
            max_ulp_at: max_ulp_at.unwrap_or_default(),
            nan: self.nan,
            infinite: self.infinite,
            negative: self.negative,
            above_one: self.above_one,
        }
    }
}

fn keep_larger(kept: &mut Option<(f64, String)>, value: f64, told: &dyn Fn() -> String) {
    if kept.as_ref().is_none_or(|(largest, _)| value > *largest) {
        *kept = Some((value, told()));
    }
}

/// What is seen in the rows, in one sentence.
pub fn stability_summary(rows: &[StabilityRow]) -> String {
    let broken =
        |kind: &str| -> usize { rows.iter().filter(|row| row.kind == kind).map(|row| row.nan + row.infinite).sum() };
    let worst = |kind: &str, quantity: &str| {
        let of = |row: &&StabilityRow| {
            (row.kind, row.quantity, row.arithmetic, row.domain) == (kind, quantity, "vectors", "inside")
        };
        rows.iter().find(of).and_then(|row| row.max_absolute).unwrap_or(f64::NAN)
    };
    format!(
        "NaN or infinite: {} of ours, {} of the textbooks. In 32 bits inside, h is off by at most {:.1e} (as printed \
         {:.1e}), n and k by {:.1e} (popular form {:.1e}).",
        broken("ours"),
        broken("textbook"),
        worst("ours", "hoffman"),
        worst("textbook", "hoffman"),
        worst("ours", "conductor"),
        worst("textbook", "conductor"),
    )
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use super::*;
    use crate::study::no_progress;

    static ROWS: LazyLock<Vec<StabilityRow>> =
        LazyLock::new(|| stability(Fineness::Default, &no_progress).expect("nobody stops it"));

    fn of<'a>(
        kind: &'a str,
        quantity: &'a str,
        domain: &'a str,
    ) -> impl Iterator<Item = &'static StabilityRow> + use<'a> {
        ROWS.iter().filter(move |row| (row.kind, row.quantity, row.domain) == (kind, quantity, domain))
    }

    #[test]
    fn ours_are_always_numbers() {
        for row in ROWS.iter().filter(|row| row.kind == "ours") {
            assert_eq!((row.nan, row.infinite), (0, 0), "{row:?}");
        }
    }

    #[test]
    fn ours_keep_a_millionth_on_the_unit_box_and_two_for_n_and_k() {
        let limits =
            [("schlick", 1e-6), ("hoffman", 1e-6), ("hoffman-basis", 1e-6), ("f82-tint", 1e-6), ("h-of-r-t", 1e-6)];
        let limits = limits.into_iter().chain([("t-of-r-h", 1e-6), ("conductor", 2e-6), ("gulbrandsen", 2e-6)]);
        for (quantity, limit) in limits {
            for row in of("ours", quantity, "inside").filter(|row| row.arithmetic != "16-bit-parameters") {
                let off = row.max_absolute.expect("finite results");
                assert!(off <= limit, "{row:?}");
            }
            assert_eq!(of("ours", quantity, "inside").count(), 4, "{quantity}");
        }
    }

    /// What the textbook forms lose is seen: otherwise the grids miss it.
    #[test]
    fn the_grids_find_what_textbook_forms_lose() {
        let single =
            |kind, quantity, domain| of(kind, quantity, domain).find(|row| row.arithmetic == "vectors").unwrap();
        let [ours, popular] = ["ours", "textbook"].map(|kind| single(kind, "absorption", "inside"));
        assert!(popular.max_ulp > Some(1000.0 * ours.max_ulp.unwrap()), "{ours:?} {popular:?}");
        assert!(of("textbook", "schlick", "outside").any(|row| row.arithmetic == "scalar" && row.nan > 0));
        let [ours, printed] = ["ours", "textbook"].map(|kind| single(kind, "k-of-r-g", "inside"));
        assert!(printed.nan > 0 && ours.max_ulp < Some(10.0), "{ours:?} {printed:?}");
    }

    #[test]
    fn stops_when_told() {
        assert_eq!(stability(Fineness::Default, &|_| ControlFlow::Break(())), Err(Stopped));
    }
}
