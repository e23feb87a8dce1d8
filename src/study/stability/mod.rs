//! How many digits each model and conversion keeps, also where its parameters are no reflectances.
//!
//! | file | what it holds |
//! |---|---|
//! | `grid` | what a case is: its grid, its exact value, the ways to compute it |
//! | `curves`, `baked`, `colors` | the cases: models and conversions of a few parameters; of many; L*a*b* and CIEDE2000 |
//! | `exact`, `exact_color` | the same in 512 bits; powers, cube roots and angles in 192 |
//! | `tally` | how far off results are, and where |
//! | `printed` | textbook forms beside those of [`crate::kernel::textbook`] |

mod baked;
mod colors;
mod curves;
mod exact;
mod exact_color;
mod grid;
mod printed;
mod tally;

use std::ops::ControlFlow;

use rayon::prelude::*;
use serde::Serialize;

use self::grid::Case;
use self::tally::Tallies;
pub(super) use self::tally::unit_of_single;
use super::accuracy::Meter;
use crate::fit::Stopped;

/// One model or conversion, one way to write it, one arithmetic, one domain. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StabilityRow {
    /// What is computed, e.g. `conductor` or `n-of-r-g`.
    pub quantity: &'static str,
    /// `ours`, `textbook`, `textbook, complex` for pbrt's arithmetic, or `palette` for the crate of that name.
    pub kind: &'static str,
    /// `vectors` and `scalar` are 32 bits; `64-bits`; `16-bit-parameters` are stored in half, computed in vectors.
    pub arithmetic: &'static str,
    /// `inside` where the parameters are a material's or colours that are seen and 0 ≤ c ≤ 1, `outside` elsewhere, and
    /// `jump` within 1e-6 of opposite hues, where CIEDE2000 itself jumps and rounding decides for either side.
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

/// Every case, in the order of the rows.
fn cases() -> Vec<Case> {
    [curves::models(), baked::baked(), curves::exact_indices(), curves::conversions(), colors::colors()]
        .into_iter()
        .flatten()
        .collect()
}

/// Points between two words of progress.
const POINTS_AT_ONCE: usize = 256;

/// Measures every case over its grid. `progress` is told the share done, from any thread, and stops it by breaking.
pub fn stability(
    fineness: Fineness,
    progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Result<Vec<StabilityRow>, Stopped> {
    let cases: Vec<(Case, Vec<Vec<f64>>)> = cases()
        .into_iter()
        .map(|case| {
            let grid = case.grid(fineness);
            (case, grid)
        })
        .collect();
    let parts = cases.iter().map(|(_, grid)| grid.len().div_ceil(POINTS_AT_ONCE)).sum();
    let meter = Meter::new(parts, progress);
    let rows: Result<Vec<Vec<StabilityRow>>, Stopped> =
        cases.par_iter().map(|(case, grid)| rows_of(case, grid, &meter)).collect();
    Ok(rows?.into_iter().flatten().collect())
}

fn rows_of(case: &Case, grid: &[Vec<f64>], meter: &Meter<'_>) -> Result<Vec<StabilityRow>, Stopped> {
    let part = |points: &[Vec<f64>]| {
        let tallies = Tallies::of(case, points);
        meter.one_more().map(|()| tallies)
    };
    let parts: Result<Vec<Tallies>, Stopped> = grid.par_chunks(POINTS_AT_ONCE).map(part).collect();
    Ok(parts?.into_iter().fold(Tallies::none(case), Tallies::and).rows(case))
}

/// What is seen in the rows, in one sentence.
pub fn stability_summary(rows: &[StabilityRow]) -> String {
    let broken =
        |kind: &str| -> usize { rows.iter().filter(|row| row.kind == kind).map(|row| row.nan + row.infinite).sum() };
    let worst_in = |kind: &str, quantity: &str, domain: &str| {
        let of = |row: &&StabilityRow| {
            (row.kind, row.quantity, row.arithmetic, row.domain) == (kind, quantity, "vectors", domain)
        };
        rows.iter().find(of).and_then(|row| row.max_absolute).unwrap_or(f64::NAN)
    };
    let worst = |kind, quantity| worst_in(kind, quantity, "inside");
    format!(
        "NaN or infinite: {} of ours, {} of the textbooks. In 32 bits inside, h is off by at most {:.1e} (as printed \
         {:.1e}), n and k by {:.1e} (popular form {:.1e}), L* by {:.1e}, ΔE2000 by {:.1e}, and by {:.1e} where hues are \
         opposite and it jumps itself.",
        broken("ours"),
        broken("textbook"),
        worst("ours", "hoffman"),
        worst("textbook", "hoffman"),
        worst("ours", "conductor"),
        worst("textbook", "conductor"),
        worst("ours", "lab-lightness"),
        worst("ours", "delta-e"),
        worst_in("ours", "delta-e", "jump"),
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
        let limits = limits.chain([("generalized-schlick", 1e-6), ("series-3", 1e-6), ("polynomial-10", 1e-6)]);
        // A table of ±1 in turn rises by 62 a unit of √c.
        let limits = limits.chain([("table-32", 4e-6), ("spectral-20", 2e-6)]);
        for (quantity, limit) in limits {
            for row in of("ours", quantity, "inside").filter(|row| row.arithmetic != "16-bit-parameters") {
                let off = row.max_absolute.expect("finite results");
                assert!(off <= limit, "{row:?}");
            }
            assert_eq!(of("ours", quantity, "inside").count(), 4, "{quantity}");
        }
    }

    /// L*, a* and b* in the units they have: 4e-6 of L* is a unit in the last place of 50.
    #[test]
    fn ours_keep_a_ten_thousandth_of_colours() {
        for (quantity, limit) in [("lab-lightness", 4e-5), ("lab-a", 1e-4), ("lab-b", 1e-4), ("delta-e", 3e-4)] {
            for row in of("ours", quantity, "inside").filter(|row| row.arithmetic != "16-bit-parameters") {
                let off = row.max_absolute.expect("finite results");
                assert!(off <= if row.arithmetic == "64-bits" { 1e-12 } else { limit }, "{row:?}");
            }
            assert_eq!(of("ours", quantity, "inside").count(), 4, "{quantity}");
        }
    }

    /// In 64 bits nothing is wrong but rounding: a formula that is another shows. What keeps n and k from 0/0 is seen at
    /// n = 1 and k = 0, and n and k of r next to 1 are large.
    #[test]
    fn ours_are_the_definitions_in_64_bits() {
        const OF_INDICES: [&str; 6] = ["conductor", "absorption", "gulbrandsen", "n-of-r-g", "k-of-r-g", "g-of-n-k"];
        for row in ROWS.iter().filter(|row| (row.kind, row.arithmetic, row.domain) == ("ours", "64-bits", "inside")) {
            let limit = if OF_INDICES.contains(&row.quantity) { 1e-8 } else { 1e-12 };
            assert!(row.max_absolute.unwrap() <= limit, "{row:?}");
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
        // The printed constants of L* miss the toe by 4e-5, and a seventh power leaves 32 bits.
        assert!(of("textbook", "lab-lightness", "inside").all(|row| row.max_absolute > Some(1e-5)));
        assert!(of("palette", "delta-e", "outside").any(|row| row.arithmetic == "scalar" && row.nan > 0));
        // By arc tangents of 32 bits opposite hues fall on the wrong side, and only they.
        let of_palette = |domain| of("palette", "delta-e", domain).find(|row| row.arithmetic == "scalar").unwrap();
        let [jump, inside] = ["jump", "inside"].map(|domain| of_palette(domain).max_absolute);
        assert!(jump > Some(0.01) && inside < Some(1e-3), "{jump:?} {inside:?}");
    }

    /// Also where n < 1 and next to the critical angle, where n² − 1 of 32 bits would be wrong by nearly everything.
    #[test]
    fn thin_dielectrics_keep_their_digits_too() {
        let rows: Vec<_> =
            of("ours", "dielectric", "outside").filter(|row| row.arithmetic != "16-bit-parameters").collect();
        assert!(rows.len() > 1 && rows.iter().all(|row| row.max_absolute < Some(1e-6)), "{rows:?}");
    }

    #[test]
    fn stops_when_told() {
        assert_eq!(stability(Fineness::Default, &|_| ControlFlow::Break(())), Err(Stopped));
    }
}
