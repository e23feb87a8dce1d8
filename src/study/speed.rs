//! What each model costs on this machine, next to its parameters and operations.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use serde::Serialize;

use super::speed_kernels::{Timed, kernels};
use crate::fit::Stopped;
use crate::kernel::{Level, level_id};
use crate::metal::Metal;
use crate::number::median_of_sorted;

/// What is measured, and how long.
#[derive(Clone, Copy, Debug)]
pub struct SpeedOptions {
    /// The metal whose parameters are evaluated; the time hardly depends on it.
    pub metal: &'static Metal,
    /// The instruction set.
    pub level: Level,
    /// Values in one pass: 1024 stay in the first-level cache, millions come from memory.
    pub size: usize,
    /// How often every kernel takes its turn.
    pub rounds: usize,
}

/// The cost of one kernel. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpeedRow {
    /// Identifier, e.g. `hoffman`.
    pub kernel: &'static str,
    /// What it computes, for people.
    pub name: &'static str,
    /// `ours`, `textbook`, or `bound` for what computes no model.
    pub kind: &'static str,
    /// What it takes: `material` for constants, `pixels` for a texture, `pairs` for differences, `colours`.
    pub over: &'static str,
    /// Nanoseconds for one RGB value, or one pair: the smallest of all rounds.
    pub min_ns: f64,
    /// The median of all rounds.
    pub median_ns: f64,
    /// `min_ns` over that of Schlick's kernel.
    pub ratio_to_schlick: f64,
    /// `min_ns` over that of two square roots and a division per channel, the least an exact conductor needs.
    pub ratio_to_bound: f64,
    /// Bytes of parameters in 32 bits.
    pub parameter_bytes: usize,
    /// Operations in the source of a shader for one RGB value; 0 where a shader has none of it.
    pub operations: u32,
    /// Of these, quotients.
    pub divisions: u32,
    /// Of these, square roots.
    pub square_roots: u32,
    /// Of these, logarithms, exponentials and cube roots.
    pub powers: u32,
    /// The instruction set, e.g. `avx2`.
    pub instruction_set: &'static str,
}

/// A turn is repeated until it takes about this long, so that the clock is fine enough.
const TURN: Duration = Duration::from_micros(25);

/// Measures every kernel: in each round each takes one turn, so that a change of the clock or of the load meets all.
///
/// `progress` is told the share done and stops the study by breaking.
pub fn speed(
    options: &SpeedOptions,
    progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Result<Vec<SpeedRow>, Stopped> {
    let mut kernels = kernels(options);
    let repeats: Vec<usize> = kernels.iter_mut().map(repeats_of_a_turn).collect();
    let mut times = vec![Vec::with_capacity(options.rounds); kernels.len()];
    for round in 0..options.rounds.max(1) {
        for ((kernel, repeats), times) in kernels.iter_mut().zip(&repeats).zip(&mut times) {
            times.push(turn(kernel, *repeats).as_secs_f64() * 1e9 / (*repeats * options.size) as f64);
        }
        if progress((round + 1) as f32 / options.rounds.max(1) as f32).is_break() {
            return Err(Stopped);
        }
    }
    Ok(rows(&kernels, times, options.level))
}

fn turn(kernel: &mut Timed, repeats: usize) -> Duration {
    let start = Instant::now();
    for _ in 0..repeats {
        black_box(&mut kernel.run)();
    }
    start.elapsed()
}

/// The first turn also brings everything into the cache.
fn repeats_of_a_turn(kernel: &mut Timed) -> usize {
    let once = turn(kernel, 1).min(turn(kernel, 1)).as_secs_f64().max(1e-9);
    ((TURN.as_secs_f64() / once) as usize).clamp(1, 10_000)
}

fn rows(kernels: &[Timed], times: Vec<Vec<f64>>, level: Level) -> Vec<SpeedRow> {
    let sorted = times.into_iter().map(|mut times| {
        times.sort_by(f64::total_cmp);
        times
    });
    let sorted: Vec<Vec<f64>> = sorted.collect();
    let least = |id: &str| kernels.iter().position(|kernel| kernel.id == id).map_or(f64::NAN, |at| sorted[at][0]);
    let (schlick, bound) = (least("schlick"), least("two-roots-one-division"));
    let row = |(kernel, times): (&Timed, &Vec<f64>)| SpeedRow {
        kernel: kernel.id,
        name: kernel.name,
        kind: kernel.kind,
        over: kernel.over,
        min_ns: times[0],
        median_ns: median_of_sorted(times, |time| *time),
        ratio_to_schlick: times[0] / schlick,
        ratio_to_bound: times[0] / bound,
        parameter_bytes: kernel.bytes,
        operations: kernel.operations.total(),
        divisions: kernel.operations.quotients,
        square_roots: kernel.operations.roots,
        powers: kernel.operations.powers,
        instruction_set: level_id(level),
    };
    kernels.iter().zip(&sorted).map(row).collect()
}

/// What is seen in the rows, in one sentence.
pub fn speed_summary(rows: &[SpeedRow]) -> String {
    let of = |id: &str| rows.iter().find(|row| row.kernel == id);
    let ratio = |id: &str| of(id).map_or(f64::NAN, |row| row.ratio_to_schlick);
    let bound = of("conductor-and-absorption").map_or(f64::NAN, |row| row.ratio_to_bound);
    format!(
        "h costs {:.2} times Schlick, F82-tint {:.2}, exact n and k {:.1}, 81 wavelengths {:.0}; n and k with 1 − F \
         {bound:.2} times two square roots and a division per channel.",
        ratio("hoffman"),
        ratio("f82-tint"),
        ratio("conductor"),
        ratio("spectral-81")
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;
    use crate::study::no_progress;

    fn options(rounds: usize) -> SpeedOptions {
        SpeedOptions { metal: metal_by_name("gold").unwrap(), level: Level::new(), size: 64, rounds }
    }

    #[test]
    fn every_kernel_is_timed_and_counted() {
        let rows = speed(&options(2), &no_progress).unwrap();
        for row in &rows {
            assert!(row.min_ns > 0.0 && row.min_ns <= row.median_ns && row.median_ns.is_finite(), "{row:?}");
            assert!(row.ratio_to_schlick > 0.0 && row.ratio_to_bound > 0.0, "{row:?}");
            assert!(row.operations > 0, "{row:?}");
        }
        let mut ids: Vec<&str> = rows.iter().map(|row| row.kernel).collect();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), rows.len(), "each identifier once");
        assert!(rows.iter().find(|row| row.kernel == "schlick").unwrap().ratio_to_schlick == 1.0);
        assert!(!speed_summary(&rows).contains("NaN"), "{}", speed_summary(&rows));
    }

    /// Costs that do not depend on a clock.
    #[test]
    fn more_wavelengths_take_more_bytes_and_operations() {
        let rows = speed(&options(1), &no_progress).unwrap();
        let of = |id: &str| rows.iter().find(|row| row.kernel == id).unwrap();
        assert!(of("schlick").operations < of("hoffman").operations);
        assert!(of("hoffman").operations < of("polynomial").operations);
        assert!(of("conductor").operations < of("spectral-20").operations);
        assert_eq!(of("spectral-81").square_roots, 2 * 81);
        assert_eq!(of("spectral-81").parameter_bytes, 81 * 8 * 4);
        assert_eq!((of("conductor").divisions, of("conductor-popular").divisions), (3, 6));
    }

    #[test]
    fn stops_when_told() {
        assert_eq!(speed(&options(9), &|_| ControlFlow::Break(())), Err(Stopped));
    }
}
