//! The robust least squares fit of r and h to cells.

use super::cells::Cell;
use super::regions::Regions;
use crate::fresnel::{SCHLICK_WEIGHT_AT_MAX, Weights};
use crate::number::median;

/// r and h of one channel, with the weight each cell had in the end.
#[derive(Clone, Debug, Default)]
pub(super) struct BallFit {
    /// Reflectance facing the surface; `None` where nothing shows it.
    pub r: Option<f64>,
    /// Reflectance at θ_max; `None` where nothing shows it.
    pub h: Option<f64>,
    /// Robust weight of each cell.
    pub cell_weights: Vec<f64>,
    /// Robust standard deviation of the cells around the fit.
    pub scatter: f64,
}

impl BallFit {
    /// F at the weights of an angle. Where h is unknown Schlick's curve stands in, where r is, h does.
    pub fn predict(&self, weights: Weights) -> f64 {
        match (self.r, self.h) {
            (Some(r), Some(h)) => weights.apply(r, h),
            (Some(r), None) => weights.apply(r, SCHLICK_WEIGHT_AT_MAX + (1.0 - SCHLICK_WEIGHT_AT_MAX) * r),
            (None, Some(h)) => weights.apply(h, h),
            (None, None) => f64::NAN,
        }
    }

    /// Observed minus predicted for each cell.
    pub fn residuals(&self, cells: &[Cell]) -> Vec<f64> {
        cells.iter().map(|cell| cell.reflectance - self.predict(cell.weights)).collect()
    }
}

/// Huber's k: 95 % efficient for normal errors (Huber 1964).
const HUBER: f64 = 1.345;
/// Tukey's c, likewise (Beaton & Tukey 1974).
const BIWEIGHT: f64 = 4.685;
/// From the median absolute deviation to the standard deviation of a normal distribution.
const MAD_TO_SIGMA: f64 = 1.4826;
/// Steps of Huber's convex loss first, then of Tukey's, which drops outliers altogether.
const HUBER_STEPS: usize = 3;
const BIWEIGHT_STEPS: usize = 5;

/// Fits one channel by iteratively re-weighted least squares (Holland & Welsch 1977).
pub(super) fn fit(cells: &[Cell], regions: &Regions) -> BallFit {
    let unknowns = Unknowns::of(cells, regions);
    let base: Vec<f64> = cells.iter().map(base_weight).collect();
    let mut current = BallFit { cell_weights: base.clone(), ..BallFit::default() };
    for step in 0..=HUBER_STEPS + BIWEIGHT_STEPS {
        (current.r, current.h) = least_squares(cells, &current.cell_weights, unknowns);
        let residuals = current.residuals(cells);
        current.scatter = MAD_TO_SIGMA * median(&mut residuals.iter().map(|v| v.abs()).collect::<Vec<_>>());
        if step == HUBER_STEPS + BIWEIGHT_STEPS || current.scatter == 0.0 {
            break;
        }
        let loss = if step < HUBER_STEPS { huber_weight } else { biweight };
        current.cell_weights = base.iter().zip(&residuals).map(|(w, v)| w * loss(v / current.scatter)).collect();
    }
    current
}

/// A cell of many pixels is limited by the surroundings, not by noise: its weight levels off.
fn base_weight(cell: &Cell) -> f64 {
    const HALF_WEIGHT_PIXELS: f64 = 4.0;
    let count = cell.count as f64;
    count / (count + HALF_WEIGHT_PIXELS)
}

fn huber_weight(standardised: f64) -> f64 {
    (HUBER / standardised.abs()).min(1.0)
}

fn biweight(standardised: f64) -> f64 {
    let t = (standardised / BIWEIGHT).powi(2);
    if t < 1.0 { (1.0 - t).powi(2) } else { 0.0 }
}

/// What the cells can tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unknowns {
    /// r and h.
    Both,
    /// Only facing cells.
    R,
    /// Only grazing cells.
    H,
    /// No cells.
    Neither,
}

impl Unknowns {
    /// Facing cells show r, grazing cells h; a band of grazing angles alone shows both.
    pub fn of(cells: &[Cell], regions: &Regions) -> Self {
        let has = |stratum: usize| cells.iter().any(|cell| cell.stratum == stratum);
        let has_outer_band = has(1) && regions.outer.as_ref().is_some_and(super::region::Region::is_band);
        match (has(0), has(1)) {
            (true, true) => Self::Both,
            (false, true) if has_outer_band => Self::Both,
            (true, false) => Self::R,
            (false, true) => Self::H,
            (false, false) => Self::Neither,
        }
    }
}

/// Weighted least squares in closed form: F − C = A r + B h.
pub(super) fn least_squares(cells: &[Cell], weights: &[f64], unknowns: Unknowns) -> (Option<f64>, Option<f64>) {
    let q = SCHLICK_WEIGHT_AT_MAX;
    let mut sums = NormalEquations::default();
    for (cell, &weight) in cells.iter().zip(weights) {
        let Weights { of_r, of_h, of_white } = cell.weights;
        let row = match unknowns {
            // h follows Schlick: below 40° it weighs less than 0.003.
            Unknowns::R => [of_r + of_h * (1.0 - q), 0.0, of_white + of_h * q],
            // r follows h: at θ_max it weighs nothing.
            Unknowns::H => [0.0, of_r + of_h, of_white],
            Unknowns::Both | Unknowns::Neither => [of_r, of_h, of_white],
        };
        sums.add(row[0], row[1], cell.reflectance - row[2], weight);
    }
    sums.solution(unknowns)
}

/// Plain least squares for r and h over (weights, reflectance).
pub(super) fn solve_rows(rows: impl Iterator<Item = (Weights, f64)>) -> (Option<f64>, Option<f64>) {
    let mut sums = NormalEquations::default();
    rows.for_each(|(weights, f)| sums.add(weights.of_r, weights.of_h, f - weights.of_white, 1.0));
    sums.solution(Unknowns::Both)
}

#[derive(Default)]
struct NormalEquations {
    aa: f64,
    ab: f64,
    bb: f64,
    ay: f64,
    by: f64,
}

impl NormalEquations {
    fn add(&mut self, a: f64, b: f64, y: f64, weight: f64) {
        self.aa += weight * a * a;
        self.ab += weight * a * b;
        self.bb += weight * b * b;
        self.ay += weight * a * y;
        self.by += weight * b * y;
    }

    fn solution(&self, unknowns: Unknowns) -> (Option<f64>, Option<f64>) {
        let ratio = |numerator: f64, denominator: f64| (denominator > 0.0).then(|| numerator / denominator);
        match unknowns {
            Unknowns::Both => {
                let determinant = self.aa * self.bb - self.ab * self.ab;
                let r = ratio(self.ay * self.bb - self.by * self.ab, determinant);
                (r, ratio(self.by * self.aa - self.ay * self.ab, determinant))
            }
            Unknowns::R => (ratio(self.ay, self.aa), None),
            Unknowns::H => (None, ratio(self.by, self.bb)),
            Unknowns::Neither => (None, None),
        }
    }
}
