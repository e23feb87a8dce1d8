//! Everything that `docs/performance.md` states, measured at once, and what other programs measured beside it.

use std::ops::ControlFlow;

use rayon::prelude::*;
use serde::Deserialize;

use super::digits::{Digits, dielectric_ulp, digits, index_relative};
use super::error_table::ErrorTable;
use super::kernels::{MATERIAL, TABLE_METALS, TABLE_WAVELENGTHS};
use super::{Bar, SpeedOptions, SpeedRow, speed};
use crate::color::{RgbSpace, delta_e_rgb};
use crate::fresnel::CosTheta;
use crate::kernel::level_id;
use crate::metal::{Metal, preferred_metals};
use crate::number::median;
use crate::study::{StudyError, Subject, Variant, forms};

/// The measurements, and where they were taken.
#[derive(Clone, Debug)]
pub struct SpeedEvidence {
    /// Every kernel.
    pub rows: Vec<SpeedRow>,
    /// What other programs measured.
    pub elsewhere: Elsewhere,
    pub(super) machine: Machine,
    pub(super) rounds: usize,
    pub(super) digits: Digits,
    pub(super) dielectric_ulp: f64,
    pub(super) index_relative: f64,
    pub(super) spectral_20: StandIn,
    pub(super) polynomial_10: StandIn,
    pub(super) table_difference: f64,
}

/// What kind of machine it is; not which.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Machine {
    pub(super) architecture: &'static str,
    pub(super) instruction_set: &'static str,
    /// Threads that run at once.
    pub(super) threads: usize,
    pub(super) is_optimised: bool,
}

/// What takes the place of the spectrum, against it at every half degree of every metal.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StandIn {
    pub(super) max_delta_e: f64,
    /// Metals with their largest ΔE, the largest first.
    pub(super) metals: Vec<(String, f64)>,
}

/// What was measured by other programs, on the same machine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Elsewhere {
    /// The table of errors in Python.
    pub python: Option<PythonTimes>,
    /// This program built for any processor and for the machine's own.
    pub builds: Vec<BuildTimes>,
    /// Instructions of our kernels on AVX2.
    pub instructions: Vec<Instructions>,
    /// Seconds that a plan of 1000 materials of the library on a pass of 4 megapixels took.
    pub plan_s: Option<f64>,
    /// Seconds that the same took of 1000 metals that all differ, none of them of the library.
    pub plan_of_different_s: Option<f64>,
}

/// What `scripts/compare_accuracy.py` prints.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct PythonTimes {
    /// Version of Python.
    pub python: String,
    /// Version of numpy.
    pub numpy: String,
    /// Version of colour-science.
    pub colour: String,
    /// Milliseconds with one call for each curve, as programs are written.
    pub curve_by_curve_ms: f64,
    /// Milliseconds with all curves in one array.
    pub batched_ms: f64,
    /// How far the mean of a curve's ΔE is from ours, at most.
    pub largest_difference: f64,
}

/// One row of what `scripts/compare_builds.sh` writes.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct BuildTimes {
    /// See [`SpeedRow`].
    pub kernel: String,
    /// See [`SpeedRow`].
    pub kind: String,
    /// See [`SpeedRow`].
    pub per: String,
    /// Nanoseconds of the binary for any processor.
    pub stock_ns: f64,
    /// Nanoseconds of the one for this machine's.
    pub native_ns: f64,
}

/// One row of what `scripts/count_instructions.sh` writes.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Instructions {
    /// See [`SpeedRow`].
    pub kernel: String,
    /// See [`SpeedRow`].
    pub per: String,
    /// Instructions of one evaluation, loads, stores and the loop among them.
    pub instructions: f64,
}

impl BuildTimes {
    /// How much longer the binary for any processor takes.
    pub fn ratio(&self) -> f64 {
        self.stock_ns / self.native_ns
    }
}

impl SpeedEvidence {
    /// Takes all measurements; seconds. `progress` breaks to stop.
    pub fn measure(
        options: &SpeedOptions,
        elsewhere: Elsewhere,
        progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
    ) -> Result<Self, StudyError> {
        let keep_going = &|| progress(0.0);
        let spectral_20 = StandIn::measure(Variant::Spectral(20), keep_going)?;
        let polynomial_10 = StandIn::measure(Variant::Polynomial(10), keep_going)?;
        let metals: Vec<&Metal> = preferred_metals().take(TABLE_METALS).collect();
        let table = ErrorTable::new(&metals, TABLE_WAVELENGTHS, SPACE, &mut || keep_going())?;
        Ok(Self {
            rows: speed(options, progress)?,
            elsewhere,
            machine: Machine::of(options),
            rounds: options.rounds,
            digits: digits(options.level),
            dielectric_ulp: dielectric_ulp(options.level),
            index_relative: index_relative(options.level),
            spectral_20,
            polynomial_10,
            table_difference: table.largest_difference(options.level),
        })
    }

    /// What is aimed at, and whether it is reached.
    pub fn bars(&self) -> Vec<Bar> {
        super::bars::bars(self)
    }

    /// The most instructions that one RGB value of h and of the F82-tint takes on AVX2.
    pub(super) fn most_instructions(&self) -> Option<f64> {
        let of = |kernel: &str| {
            let rows = &self.elsewhere.instructions;
            let row = rows.iter().find(|row| (row.kernel.as_str(), row.per.as_str()) == (kernel, MATERIAL));
            row.map(|row| row.instructions)
        };
        Some(of("hoffman")?.max(of("f82-tint")?))
    }

    /// The middle of how much longer the binary for any processor takes, over our vectors.
    pub(super) fn builds_median(&self) -> Option<f64> {
        let mut ratios: Vec<f64> =
            self.elsewhere.builds.iter().filter(|row| row.kind == "ours").map(BuildTimes::ratio).collect();
        (!ratios.is_empty()).then(|| median(&mut ratios))
    }
}

const SPACE: RgbSpace = RgbSpace::LinRec709;

impl Machine {
    fn of(options: &SpeedOptions) -> Self {
        Self {
            architecture: std::env::consts::ARCH,
            instruction_set: level_id(options.level),
            threads: std::thread::available_parallelism().map_or(1, usize::from),
            is_optimised: !cfg!(debug_assertions),
        }
    }
}

impl StandIn {
    fn measure(variant: Variant, keep_going: &(dyn Fn() -> ControlFlow<()> + Sync)) -> Result<Self, StudyError> {
        let library: Vec<&Metal> = preferred_metals().collect();
        let of_metal = |metal: &&Metal| -> Result<(String, f64), StudyError> {
            let form = forms(&Subject::Metal(metal), &[variant], SPACE, &mut || keep_going())?.remove(0).form;
            let off = |half: u16| {
                let c = CosTheta::from_deg(f64::from(half) / 2.0);
                delta_e_rgb(form.reflectance(c), metal.reflectance(c, SPACE), SPACE)
            };
            Ok((metal.name.clone(), crate::number::largest((0..=180).map(off))))
        };
        let metals: Result<Vec<(String, f64)>, StudyError> = library.par_iter().map(of_metal).collect();
        let mut metals = metals?;
        metals.sort_by(|a, b| b.1.total_cmp(&a.1));
        Ok(Self { max_delta_e: metals.first().map_or(f64::NAN, |(_, worst)| *worst), metals })
    }
}
