//! The clock: many short rounds in which each kernel has its turn, so that what disturbs the machine disturbs all alike.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::kernels::Kernel;
use crate::fit::Stopped;
use crate::number::{median, smallest};

/// A turn is long against the clock's own time, and short against what interrupts it.
const TURN: Duration = Duration::from_micros(30);

/// What takes longer in one piece has its turn in as many rounds fewer.
const LONG_TURN: Duration = Duration::from_micros(240);

/// Nanoseconds of one evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Times {
    /// The shortest turn's.
    pub(super) min_ns: f64,
    /// That of the middle turn.
    pub(super) median_ns: f64,
}

/// How a kernel has its turns.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Turn {
    /// So many times in a row.
    repeats: u32,
    /// In one round of so many.
    every: usize,
}

/// Measures all kernels in each round, each round beginning with another one.
pub(super) fn measure(
    kernels: &mut [Kernel],
    rounds: usize,
    progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Result<Vec<Times>, Stopped> {
    let mut turns = Vec::with_capacity(kernels.len());
    for kernel in &mut *kernels {
        go_on(progress, 0.0)?;
        turns.push(Turn::of(&mut *kernel.run));
    }
    let mut taken = vec![Vec::new(); kernels.len()];
    for round in 0..rounds.max(1) {
        go_on(progress, round as f32 / rounds as f32)?;
        for place in 0..kernels.len() {
            let index = (place + round) % kernels.len();
            let (kernel, turn) = (&mut kernels[index], turns[index]);
            if round % turn.every == 0 {
                let time = timed(turn.repeats, &mut *kernel.run);
                let evaluations = f64::from(turn.repeats) * kernel.evaluations as f64;
                taken[index].push(time.as_secs_f64() * 1e9 / evaluations);
            }
        }
    }
    let times = |taken: &mut Vec<f64>| Times { min_ns: smallest(taken.iter().copied()), median_ns: median(taken) };
    Ok(taken.iter_mut().map(times).collect())
}

fn go_on(progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync), share: f32) -> Result<(), Stopped> {
    if progress(share).is_break() { Err(Stopped) } else { Ok(()) }
}

impl Turn {
    /// Tries it out, which also brings its data into the cache.
    fn of(run: &mut dyn FnMut()) -> Self {
        run();
        let (mut repeats, mut time) = (1, timed(1, run));
        while time < TURN && repeats < 1 << 20 {
            repeats *= 2;
            time = timed(repeats, run);
        }
        let every = (time.as_nanos() / LONG_TURN.as_nanos()).max(1) as usize;
        Self { repeats, every }
    }
}

fn timed(repeats: u32, run: &mut dyn FnMut()) -> Duration {
    let start = Instant::now();
    for _ in 0..repeats {
        run();
    }
    start.elapsed()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_work_sits_out_and_short_work_is_repeated() {
        let long = Turn::of(&mut || std::thread::sleep(Duration::from_millis(3)));
        assert!(long.repeats == 1 && long.every >= 12, "{long:?}");
        let mut sum = 0_u64;
        let short = Turn::of(&mut || sum = std::hint::black_box(sum + 1));
        assert!(short.repeats > 100, "{short:?}");
    }
}
