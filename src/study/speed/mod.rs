//! How long every kernel takes on this machine, measured in one run.
//!
//! | file | what it holds |
//! |---|---|
//! | `rounds` | the clock: many short rounds in which each kernel has its turn |
//! | `kernels` | what has a turn: our kernels, textbook forms, bounds, others' programs |
//! | `curve` | a variant of a material as its kernel |
//! | `buffers` | what they compute from and into |
//! | `error_table` | ΔE of ten models of many metals at 91 angles, as a slider moves it |
//! | `digits` | how many digits the exact kernels keep on real metals |
//! | `bars` | what is aimed at, and whether it is reached |
//! | `evidence`, `markdown` | everything that `docs/performance.md` states |

mod bars;
mod buffers;
mod curve;
mod digits;
mod error_table;
mod evidence;
mod kernels;
mod markdown;
mod rounds;

pub use bars::{Bar, BarVerdict};
pub use error_table::{ErrorTable, ErrorTableInput, ErrorTableMetal, ErrorTableModel, Errors};
pub use evidence::{BuildTimes, Elsewhere, Instructions, PythonTimes, SpeedEvidence};

use std::ops::ControlFlow;

use serde::Serialize;

use super::{Costs, StudyError, Variant};
use crate::color::RgbSpace;
use crate::fit::{FitError, Stopped};
use crate::kernel::{Level, Operations};

/// What is measured, and how patiently.
#[derive(Clone, Debug)]
pub struct SpeedOptions {
    /// The instruction set of our vectors.
    pub level: Level,
    /// How many rounds.
    pub rounds: usize,
    /// The names of the kernels to measure, beside Schlick's, which all are held against; all of them where it is empty.
    pub kernels: Vec<String>,
}

impl SpeedOptions {
    /// Rounds for numbers that are kept: seconds.
    pub const ROUNDS: usize = 1000;
    /// Rounds for a first look.
    pub const QUICK_ROUNDS: usize = 40;
    /// Rounds for the times of variants: a moment, while somebody waits for something else.
    pub const ROUNDS_OF_COSTS: usize = 200;
}

impl Default for SpeedOptions {
    fn default() -> Self {
        Self { level: Level::new(), rounds: Self::ROUNDS, kernels: Vec::new() }
    }
}

/// One kernel, as it was measured. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpeedRow {
    /// What is computed, e.g. `schlick` or `spectral-20`.
    pub kernel: String,
    /// `ours` is in vectors of 32 bits, `scalar` the same text one by one, `64-bits` the core; `textbook`, or `textbook,
    /// complex` for pbrt's arithmetic; `bound` only what a kernel cannot do without; or the name of another program.
    pub kind: &'static str,
    /// What one evaluation is: `material` and `pixel` are three channels, the parameters the same for all evaluations or
    /// different for each; `pair` and `color` are colours; `table` and `picture` a whole one.
    pub per: &'static str,
    /// The shortest time of one evaluation in nanoseconds.
    pub min_ns: f64,
    /// The time that half of the rounds stayed within.
    pub median_ns: f64,
    /// The shortest time as a multiple of Schlick's; `None` of tables and pictures.
    pub times_schlick: Option<f64>,
    /// Bytes of the parameters of one material, or of one pixel, in 32 bits.
    pub parameter_bytes: Option<u64>,
    /// Issue slots of one evaluation in a shader, see [`Operations::slots`].
    pub shader_operations: Option<u32>,
    /// Sums and differences, those of products with a sum included.
    pub sums: Option<u32>,
    /// Products, those with a sum included.
    pub products: Option<u32>,
    /// Products that are one instruction with the sum that follows.
    pub fused: Option<u32>,
    /// Quotients.
    pub quotients: Option<u32>,
    /// Square roots.
    pub roots: Option<u32>,
    /// Logarithms, exponentials and cube roots.
    pub powers: Option<u32>,
    /// Comparisons, choices, limits, absolute values and changes of sign.
    pub choices: Option<u32>,
    /// Reads from a table.
    pub loads: Option<u32>,
}

impl SpeedRow {
    fn new(kernel: &kernels::Kernel, times: rounds::Times, schlick_ns: f64) -> Self {
        let count = |of: fn(Operations) -> u32| kernel.operations.map(of);
        Self {
            kernel: kernel.name.clone(),
            kind: kernel.kind,
            per: kernel.per,
            min_ns: times.min_ns,
            median_ns: times.median_ns,
            times_schlick: kernel.is_one_colour().then_some(times.min_ns / schlick_ns),
            parameter_bytes: kernel.parameter_bytes,
            shader_operations: count(Operations::slots),
            sums: count(|of| of.sums),
            products: count(|of| of.products),
            fused: count(|of| of.fused),
            quotients: count(|of| of.quotients),
            roots: count(|of| of.roots),
            powers: count(|of| of.powers),
            choices: count(|of| of.choices),
            loads: count(|of| of.loads),
        }
    }

    /// Whether this is the row of that name; the names are those of the fields.
    fn is(&self, (kernel, kind, per): (&str, &str, &str)) -> bool {
        (self.kernel.as_str(), self.kind, self.per) == (kernel, kind, per)
    }
}

/// Measures every kernel that is wanted. `progress` hears the share done and stops the work by breaking.
pub fn speed(
    options: &SpeedOptions,
    progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Result<Vec<SpeedRow>, StudyError> {
    let mut kernels = kernels::kernels(options, progress)?;
    let times = rounds::measure(&mut kernels, options.rounds, progress)
        .map_err(|Stopped| StudyError::Fit(FitError::Stopped(Stopped)))?;
    let measured = || kernels.iter().zip(&times);
    let schlick = measured().find(|(kernel, _)| kernel.is_reference()).map_or(f64::NAN, |(_, times)| times.min_ns);
    Ok(measured().map(|(kernel, times)| SpeedRow::new(kernel, *times, schlick)).collect())
}

/// Runs one of our kernels so many times and nothing else, for a simulator that counts instructions; gives the number of
/// evaluations made, or `None` where there is no such kernel. `per` is what [`SpeedRow::per`] says.
///
/// Two runs of different length tell what an evaluation takes: what they have in common is the start of the program.
pub fn repeat(kernel: &str, per: &str, turns: usize, level: Level) -> Result<Option<usize>, StudyError> {
    let options = SpeedOptions { level, rounds: 1, kernels: vec![kernel.to_owned()] };
    let mut kernels = kernels::kernels(&options, &super::no_progress)?;
    let own = kernels.iter_mut().find(|own| (own.name.as_str(), own.kind, own.per) == (kernel, kernels::OURS, per));
    Ok(own.map(|own| {
        (0..turns).for_each(|_| (own.run)());
        turns * own.evaluations
    }))
}

/// The names that [`SpeedOptions::kernels`] takes.
pub fn speed_kernels() -> Vec<String> {
    kernels::names()
}

/// What the table of errors is computed from: the metals, models and truth whose time [`speed`] measures.
pub fn error_table_input(progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync)) -> Result<ErrorTableInput, StudyError> {
    let metals: Vec<_> = crate::metal::preferred_metals().take(kernels::TABLE_METALS).collect();
    let table = ErrorTable::new(&metals, kernels::TABLE_WAVELENGTHS, RgbSpace::LinRec709, &mut || progress(0.0))?;
    Ok(table.input().clone())
}

/// The costs of all variants, with their times on this machine; they take a moment to measure.
pub fn measured_costs(progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync)) -> Result<Costs, StudyError> {
    let kernels = Variant::ALL.map(curve::kernel_of).to_vec();
    let rows =
        speed(&SpeedOptions { rounds: SpeedOptions::ROUNDS_OF_COSTS, kernels, ..SpeedOptions::default() }, progress)?;
    let of = |variant: Variant| {
        let kernel = curve::kernel_of(variant);
        let row = rows.iter().find(|row| row.is((kernel.as_str(), kernels::OURS, kernels::MATERIAL)));
        row.map(|row| (variant, row.min_ns))
    };
    Ok(Costs::with_measured(Variant::ALL.into_iter().filter_map(of).collect()))
}

/// What is seen in the rows, in one sentence; empty where nothing is that could be compared.
pub fn speed_summary(rows: &[SpeedRow]) -> String {
    let ratio = |over, under| bars::ratio(rows, over, under);
    let told = [
        bars::hoffman(rows).map(|times| format!("h takes {times:.2} × Schlick's time")),
        bars::f82_tint(rows).map(|times| format!("F82-tint {times:.2} ×")),
        bars::conductor(rows).map(|times| format!("n, k with F and 1 − F {times:.2} × two roots and a division")),
        bars::spectral(rows).map(|times| format!("81 wavelengths {times:.2} × theirs")),
        ratio(("delta-e", "palette", kernels::PAIR), ("delta-e", kernels::OURS, kernels::PAIR))
            .map(|times| format!("a ΔE 1/{times:.0} of palette's")),
    ];
    let told: Vec<String> = told.into_iter().flatten().collect();
    if told.is_empty() { String::new() } else { format!("{}.", told.join(", ")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::no_progress;

    fn quick(kernels: &[&str]) -> SpeedOptions {
        SpeedOptions {
            rounds: 2,
            kernels: kernels.iter().map(|name| (*name).to_owned()).collect(),
            ..SpeedOptions::default()
        }
    }

    #[test]
    fn a_kernel_is_repeated_as_often_as_asked() {
        let evaluations = |name, per, turns| repeat(name, per, turns, Level::new()).unwrap();
        assert_eq!(evaluations("hoffman", "material", 3), Some(3 * 1024));
        assert_eq!(evaluations("hoffman", "pixel", 1), Some(1024));
        assert_eq!(evaluations("hoffman", "pair", 1), None);
    }

    #[test]
    fn schlick_is_always_there_and_is_once_itself() {
        let rows = speed(&quick(&["hoffman"]), &no_progress).unwrap();
        let schlick = rows.iter().find(|row| row.is(("schlick", "ours", "material"))).unwrap();
        assert_eq!(schlick.times_schlick, Some(1.0));
        assert_eq!((schlick.parameter_bytes, schlick.shader_operations), (Some(12), Some(9)));
        assert!(rows.iter().any(|row| row.is(("hoffman", "textbook", "material"))));
        assert!(rows.iter().all(|row| row.min_ns > 0.0 && row.min_ns <= row.median_ns), "{rows:?}");
        assert!(speed_summary(&rows).contains("h takes"), "{}", speed_summary(&rows));
    }

    #[test]
    fn every_variant_has_a_kernel_that_is_measured() {
        let names = speed_kernels();
        for variant in Variant::ALL {
            assert!(names.contains(&curve::kernel_of(variant)), "{variant}");
        }
    }

    #[test]
    fn stops_when_told() {
        let stopped = speed(&quick(&["schlick"]), &|_| ControlFlow::Break(()));
        assert!(matches!(stopped, Err(StudyError::Fit(FitError::Stopped(_)))));
    }
}
