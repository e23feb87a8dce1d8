//! The numerical searches behind the fits: one variable in an interval, and several without bounds.

use std::cell::RefCell;
use std::convert::Infallible;
use std::ops::{ControlFlow, RangeInclusive};

use basin::{
    BoxBounds, Brent, ConstraintDescription, ConstraintSet, Constraints, CostFunction, Executor, NelderMead, Newuoa,
    PointState, SimplexProgress,
};
use thiserror::Error;

/// A search was stopped by whoever asked for it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Error)]
#[error("stopped before it was finished")]
pub struct Stopped;

/// Where `f` is smallest in an interval: the best of `panels + 1` even steps, then Brent's method (Brent 1973,
/// chapter 5) between its neighbours.
///
/// Finds the smallest of several minima if they are farther apart than a panel. An empty interval answers its end.
pub(super) fn minimum_within(interval: RangeInclusive<f64>, panels: u32, f: impl Fn(f64) -> f64) -> f64 {
    let (low, high) = interval.into_inner();
    if low >= high {
        return high;
    }
    let width = (high - low) / f64::from(panels);
    let steps = (0..=panels).map(|panel| low + width * f64::from(panel));
    let smaller = |best: (f64, f64), (x, value): (f64, f64)| if value <= best.1 { (x, value) } else { best };
    let (nearest, value) = steps.map(|x| (x, f(x))).fold((high, f64::INFINITY), smaller);
    let inside = brent((nearest - width).max(low), (nearest + width).min(high), &f);
    if f(inside) < value { inside } else { nearest }
}

fn brent<F: Fn(f64) -> f64>(low: f64, high: f64, f: &F) -> f64 {
    let solver = Brent::new().with_absolute_position_tolerance(1e-9).with_relative_position_tolerance(1e-9);
    let start = PointState::new(0.5 * (low + high));
    let result = Executor::new(OneVariable { low, high, f }, solver, start).max_iter(100).run();
    result.map_or(high, |result| *result.best_param())
}

struct OneVariable<'a, F> {
    low: f64,
    high: f64,
    f: &'a F,
}

impl<F> Constraints for OneVariable<'_, F> {
    type Set = ConstraintSet<BoxBounds<f64>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new().with_bounds(BoxBounds::new(Some(&self.low), Some(&self.high)))
    }
}

impl<F: Fn(f64) -> f64> CostFunction for OneVariable<'_, F> {
    type Param = f64;
    type Output = f64;
    type Error = Infallible;

    fn cost(&self, x: &f64) -> Result<f64, Infallible> {
        Ok((self.f)(*x))
    }
}

/// How hard [`minimum_near`] looks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// Nelder–Mead is started again from its own result this many times: a fresh simplex leaves false minima.
    pub restarts: usize,
    /// Iterations of one start.
    pub iterations: u64,
    /// Edge length of the first simplex; each restart halves it.
    pub first_step: f64,
    /// A start ends when its simplex is smaller than this…
    pub position_tolerance: f64,
    /// …and the values at its corners are nearer to each other than this.
    pub cost_tolerance: f64,
}

/// The point with the smallest `f` that Nelder–Mead finds (Gao & Han 2012, with their adaptive coefficients).
///
/// Deterministic. `f` that is NaN counts as infinitely bad. `keep_going` is asked once per evaluation.
pub(super) fn minimum_near(
    start: &[f64],
    effort: Effort,
    f: impl Fn(&[f64]) -> f64,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<(Vec<f64>, f64), Stopped> {
    let keep_going = RefCell::new(keep_going);
    let mut best = (start.to_vec(), f(start));
    let mut step = effort.first_step;
    for _ in 0..=effort.restarts {
        let problem = SeveralVariables { f: &f, keep_going: &keep_going };
        let solver = NelderMead::adaptive()
            .with_absolute_simplex_size_tolerance(effort.position_tolerance)
            .with_absolute_simplex_cost_tolerance(effort.cost_tolerance);
        let run = Executor::new(problem, solver, SimplexProgress::from_simplex(simplex(&best.0, step)))
            .max_iter(effort.iterations)
            .run()?;
        if run.best_cost() < best.1 {
            best = (run.best_param().clone(), run.best_cost());
        }
        step *= 0.5;
    }
    Ok(best)
}

/// The point with the smallest `f` that NEWUOA finds (Powell 2006: a quadratic model in a region of trust), whose radius
/// shrinks from the first to the last; at most so many evaluations.
///
/// Fast where `f` is smooth, and near the minimum of a mean of distances it is not. Deterministic; as for
/// [`minimum_near`], NaN is infinitely bad and `keep_going` is asked once per evaluation.
pub(super) fn minimum_of_smooth(
    start: &[f64],
    (first_radius, last_radius): (f64, f64),
    evaluations: u64,
    f: impl Fn(&[f64]) -> f64,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<(Vec<f64>, f64), Stopped> {
    let keep_going = RefCell::new(keep_going);
    let at_start = (start.to_vec(), f(start));
    // Infinity would spoil the quadratic model for good.
    let finite = |x: &[f64]| f(x).min(UNACCEPTABLE);
    let problem = SeveralVariables { f: &finite, keep_going: &keep_going };
    let solver = Newuoa::new().with_initial_radius(first_radius).with_final_radius(last_radius);
    let executor = Executor::new(problem, solver, PointState::new(start.to_vec())).max_cost_evals(evaluations);
    let run = executor.run()?;
    let found = (run.best_param().clone(), run.best_cost());
    Ok(if found.1 < at_start.1 { found } else { at_start })
}

/// Worse than any value that matters.
const UNACCEPTABLE: f64 = 1e4;

/// `corner` and one more point along each axis.
fn simplex(corner: &[f64], step: f64) -> Vec<Vec<f64>> {
    let along = |axis: usize| {
        let mut point = corner.to_vec();
        point[axis] += step;
        point
    };
    std::iter::once(corner.to_vec()).chain((0..corner.len()).map(along)).collect()
}

struct SeveralVariables<'a, 'b, F> {
    f: &'a F,
    keep_going: &'a RefCell<&'b mut dyn FnMut() -> ControlFlow<()>>,
}

impl<F: Fn(&[f64]) -> f64> CostFunction for SeveralVariables<'_, '_, F> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Stopped;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Stopped> {
        if (self.keep_going.borrow_mut())().is_break() {
            return Err(Stopped);
        }
        let value = (self.f)(x);
        Ok(if value.is_nan() { f64::INFINITY } else { value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EFFORT: Effort =
        Effort { restarts: 3, iterations: 2000, first_step: 0.5, position_tolerance: 1e-8, cost_tolerance: 1e-12 };

    #[test]
    fn finds_a_minimum_inside_and_at_an_end() {
        assert!((minimum_within(0.0..=1.0, 4, |x| (x - 0.3_f64).powi(2)) - 0.3).abs() < 1e-8);
        assert_eq!(minimum_within(0.0..=1.0, 4, |x| x), 0.0);
        assert_eq!(minimum_within(0.0..=1.0, 4, |x| -x), 1.0);
        let two_valleys = |x: f64| ((x - 0.2).powi(2) + 0.01).min((x - 0.8).powi(2));
        assert!((minimum_within(0.0..=1.0, 4, two_valleys) - 0.8).abs() < 1e-8);
    }

    /// Rosenbrock 1960: the minimum is at (1, 1).
    #[test]
    fn finds_the_end_of_rosenbrocks_valley() {
        let f = |x: &[f64]| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2);
        let (at, value) = minimum_near(&[-1.2, 1.0], EFFORT, f, &mut || ControlFlow::Continue(())).unwrap();
        assert!(value < 1e-12 && (at[0] - 1.0).abs() < 1e-5, "{at:?}");
    }

    #[test]
    fn a_quadratic_model_finds_the_bottom_of_a_bowl() {
        let f = |x: &[f64]| (x[0] - 1.0).powi(2) + 3.0 * (x[1] + 0.5 * x[0]).powi(2);
        let mut asked = 0;
        let mut count = || {
            asked += 1;
            ControlFlow::Continue(())
        };
        let (at, value) = minimum_of_smooth(&[3.0, 3.0], (0.5, 1e-6), 200, f, &mut count).unwrap();
        assert!(value < 1e-9 && (at[0] - 1.0).abs() < 1e-4, "{at:?} {value}");
        assert!(asked <= 200);
        let nowhere = minimum_of_smooth(&[3.0, 3.0], (0.5, 1e-6), 200, |_| f64::NAN, &mut || ControlFlow::Continue(()));
        assert_eq!(nowhere.unwrap().0, [3.0, 3.0]);
        let stopped = minimum_of_smooth(&[3.0, 3.0], (0.5, 1e-6), 200, f, &mut || ControlFlow::Break(()));
        assert_eq!(stopped, Err(Stopped));
    }

    #[test]
    fn stops_when_told_and_survives_nan() {
        let mut left = 10;
        let mut impatient = || {
            left -= 1;
            if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        assert_eq!(minimum_near(&[3.0], EFFORT, |x| x[0] * x[0], &mut impatient), Err(Stopped));
        let hole = |x: &[f64]| if x[0] < 0.0 { f64::NAN } else { (x[0] - 0.25).abs() };
        let (at, _) = minimum_near(&[3.0], EFFORT, hole, &mut || ControlFlow::Continue(())).unwrap();
        assert!((at[0] - 0.25).abs() < 1e-6);
    }
}
