//! The least squares fit of an edge: brightness is linear in the curves, the outline and the blur are not.

use nalgebra::{Cholesky, Const, Matrix3, SMatrix, SVector, Vector3};

use super::curve::{CURVES, EdgeCurves, Row, STEP, add};
use super::profile::{Bin, Part, Profile};
use crate::number::median;

/// An outline fitted to the edge, and how well it is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeFit {
    /// Change of the outline's three unknowns.
    pub change: [f64; 3],
    /// Variance of the first, the radius, from what scatters.
    pub variance: f64,
    /// Change of the radius if there is no tone curve.
    pub by_tone: f64,
    /// What the curves leave over beyond noise, as if it all pushed the same way, in pixels of the radius.
    pub by_misfit: f64,
    /// Standard deviation of the blur in pixels.
    pub blur_px: f64,
}

/// Fewer parts with an edge than this are no outline.
const LEAST_PARTS: usize = 6;
/// No picture is sharper or, where a rim can still be told from the backdrop, more blurred than this, in pixels.
const BLUR_PX: [f64; 2] = [0.15, 2.5];

impl EdgeFit {
    /// Gauss–Newton over the outline and the blur, with the curves eliminated part by part (Golub & Pereyra 1973).
    pub fn of(profile: &Profile, radius_px: f64, has_step: bool, blur_px: f64) -> Option<Self> {
        const ROUNDS: usize = 10;
        const SETTLED_PX: f64 = 0.004;
        let (mut change, mut blur_px) = ([0.0; 3], blur_px);
        let mut fit: Option<Self> = None;
        for _ in 0..ROUNDS {
            let curves = EdgeCurves::of(radius_px, blur_px, profile.depth_px);
            let edges: Vec<Edge> = profile
                .parts
                .iter()
                .filter_map(|part| Edge::of(part, &curves, change, blur_px, has_step, profile.noise))
                .collect();
            let next = Self::through(&edges, blur_px)?;
            let moved =
                (0..3).map(|i| (next.change[i] - change[i]).abs()).fold((next.blur_px - blur_px).abs(), f64::max);
            (change, blur_px) = (next.change, next.blur_px);
            fit = Some(next);
            if moved < SETTLED_PX {
                break;
            }
        }
        fit.filter(|fit| fit.change.iter().all(|value| value.is_finite()))
    }

    fn through(edges: &[Edge], blur_px: f64) -> Option<Self> {
        const LARGEST_STEP_PX: f64 = 0.2;
        if edges.len() < LEAST_PARTS {
            return None;
        }
        let Outline { change, variance, weights } = Outline::through(edges)?;
        let sum = |of: &dyn Fn(&Edge) -> f64| edges.iter().map(of).sum::<f64>();
        let (pull, hold) = (sum(&|edge| edge.blur_pull), sum(&|edge| edge.blur_hold));
        let step = if hold > 0.0 { (pull / hold).clamp(-LARGEST_STEP_PX, LARGEST_STEP_PX) } else { 0.0 };
        let tones = edges.iter().zip(&weights).map(|(edge, weight)| edge.by_tone * weight);
        let misfit = (sum(&|edge| edge.misfit).max(0.0) / sum(&|edge| edge.pixels)).sqrt();
        let steepness = (sum(&|edge| edge.steepness) / sum(&|edge| edge.pixels)).sqrt();
        Some(Self {
            change,
            variance,
            by_tone: tones.sum::<f64>() / weights.iter().sum::<f64>(),
            by_misfit: misfit / steepness,
            blur_px: (blur_px + step).clamp(BLUR_PX[0], BLUR_PX[1]),
        })
    }
}

/// What one part says of the edge.
struct Edge {
    leads: [f64; 2],
    /// How far outwards the edge is, in pixels from the outline as it was read.
    shift: f64,
    /// Variance of that.
    variance: f64,
    /// Change of it if there is no tone curve.
    by_tone: f64,
    /// Gradient and curvature of the misfit over the blur.
    blur_pull: f64,
    blur_hold: f64,
    /// Squares that are left beyond those of noise, summed over pixels; negative where noise came out small.
    misfit: f64,
    /// Squared slope over the shift, as far as no other unknown explains it, summed over pixels.
    steepness: f64,
    pixels: f64,
}

impl Edge {
    /// One step of Gauss–Newton from an outline that has changed so far and a blur.
    fn of(
        part: &Part,
        curves: &EdgeCurves,
        change: [f64; 3],
        blur_px: f64,
        has_step: bool,
        noise: f64,
    ) -> Option<Self> {
        /// Farther than this the slope of a curve says nothing.
        const LARGEST_STEP_PX: f64 = 0.7;
        let unknowns = CURVES - 1 + usize::from(has_step);
        if part.bins.len() < unknowns + 6 {
            return None;
        }
        let shift = part.shift(change);
        let rows: Vec<[Row; 3]> = part.bins.iter().map(|bin| curves.at(bin.depth_px + shift)).collect();
        let design = Design::of(&part.bins, rows.iter().map(|row| row[0]).collect(), |bin| bin.count, has_step)?;
        let (amounts, residual) = design.solve(|index| part.bins[index].value);
        let (_, by_shift) = design.solve(|index| dot(&amounts, &rows[index][1]));
        // Blurring is diffusion: the change with σ is σ times the curvature.
        let (_, by_blur) = design.solve(|index| blur_px * dot(&amounts, &rows[index][2]));
        let steepness = design.product(&by_shift, &by_shift);
        if steepness <= 1e-12 * design.product(&residual, &residual) || steepness <= 0.0 {
            return None;
        }
        let step = design.product(&by_shift, &residual) / steepness;
        let shared = design.product(&by_blur, &by_shift) / steepness;
        let by_blur: Vec<f64> = by_blur.iter().zip(&by_shift).map(|(blur, shift)| blur - shared * shift).collect();
        let freedom = (part.bins.len() - unknowns - 1) as f64;
        let left = (design.product(&residual, &residual) - step * step * steepness).max(0.0);
        let spread = (left / freedom).max(noise).max(LEAST_NOISE * LEAST_NOISE);
        let tones: Vec<f64> = part.bins.iter().map(|bin| bin.tone).collect();
        Some(Self {
            leads: part.leads,
            shift: shift + step.clamp(-LARGEST_STEP_PX, LARGEST_STEP_PX),
            variance: spread / steepness,
            by_tone: design.product(&by_shift, &tones) / steepness,
            blur_pull: design.product(&by_blur, &residual) / spread,
            blur_hold: design.product(&by_blur, &by_blur) / spread,
            misfit: left - freedom * noise,
            steepness,
            pixels: part.bins.iter().map(|bin| bin.count).sum(),
        })
    }
}

/// Even a picture without noise rounds its values.
const LEAST_NOISE: f64 = 0.001;

/// The least squares of one part, factored once for every right side.
struct Design {
    rows: Vec<Row>,
    weights: Vec<f64>,
    factor: Cholesky<f64, Const<CURVES>>,
}

impl Design {
    fn of(bins: &[Bin], mut rows: Vec<Row>, weight: impl Fn(&Bin) -> f64, has_step: bool) -> Option<Self> {
        /// Curves that a few pixels cannot tell apart share what they explain.
        const RIDGE: f64 = 1e-9;
        if !has_step {
            rows.iter_mut().for_each(|row| row[STEP] = 0.0);
        }
        let weights: Vec<f64> = bins.iter().map(weight).collect();
        let mut normal = [[0.0; CURVES]; CURVES];
        for (row, weight) in rows.iter().zip(&weights) {
            for (sums, left) in normal.iter_mut().zip(row) {
                add(sums, row, weight * left);
            }
        }
        let ridge = RIDGE * (0..CURVES).map(|i| normal[i][i]).sum::<f64>();
        (0..CURVES).for_each(|i| normal[i][i] += ridge);
        let factor = SMatrix::<f64, CURVES, CURVES>::from(normal).cholesky()?;
        Some(Self { rows, weights, factor })
    }

    /// How much of each curve is in a target, and what of it is in none.
    fn solve(&self, target: impl Fn(usize) -> f64) -> (Row, Vec<f64>) {
        let mut right = [0.0; CURVES];
        for (index, (row, weight)) in self.rows.iter().zip(&self.weights).enumerate() {
            add(&mut right, row, weight * target(index));
        }
        let amounts: Row = self.factor.solve(&SVector::from(right)).into();
        let left = self.rows.iter().enumerate().map(|(index, row)| target(index) - dot(&amounts, row)).collect();
        (amounts, left)
    }

    fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.weights).map(|((a, b), weight)| a * b * weight).sum()
    }
}

fn dot(a: &Row, b: &Row) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The three unknowns of an outline through the edges of its parts.
struct Outline {
    change: [f64; 3],
    variance: f64,
    weights: Vec<f64>,
}

impl Outline {
    /// Weighted least squares with Tukey's biweight; parts scatter by more than their pixels say.
    fn through(edges: &[Edge]) -> Option<Self> {
        const ROUNDS: usize = 6;
        const BIWEIGHT: f64 = 4.685;
        /// The median of the square of a normal deviate.
        const MEDIAN_SQUARE: f64 = 0.455;
        let row = |edge: &Edge| Vector3::new(1.0, edge.leads[0], edge.leads[1]);
        let (mut change, mut variance, mut between) = (Vector3::zeros(), 0.0, 0.0);
        let mut weights = vec![0.0; edges.len()];
        for round in 0..ROUNDS {
            let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
            for (edge, kept) in edges.iter().zip(&mut weights) {
                let row = row(edge);
                let expected = edge.variance + between;
                let share = (edge.shift - row.dot(&change)).powi(2) / (expected * BIWEIGHT * BIWEIGHT);
                let loss = if round == 0 { 1.0 } else { (1.0 - share).max(0.0).powi(2) };
                *kept = loss / expected;
                normal += row * row.transpose() * *kept;
                right += row * (edge.shift * *kept);
            }
            let inverse = normal.try_inverse()?;
            (change, variance) = (inverse * right, inverse[(0, 0)]);
            let beyond =
                |edge: &Edge| ((edge.shift - row(edge).dot(&change)).powi(2) - MEDIAN_SQUARE * edge.variance).max(0.0);
            between = median(&mut edges.iter().map(beyond).collect::<Vec<_>>()) / MEDIAN_SQUARE;
        }
        Some(Self { change: change.into(), variance, weights })
    }
}

/// What the curves leave over of a mean profile, in squares over their variance: noise, and a lens that is no Gaussian.
pub(super) fn misfit(bins: &[Bin], curves: &EdgeCurves, has_step: bool, noise: f64) -> f64 {
    /// Over the contrast.
    const LENS_SHAPE: f64 = 0.002;
    let (low, high) = bins
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), bin| (low.min(bin.value), high.max(bin.value)));
    let shape = (LENS_SHAPE * (high - low)).powi(2);
    let noise = noise.max(LEAST_NOISE * LEAST_NOISE);
    let rows = bins.iter().map(|bin| curves.at(bin.depth_px)[0]).collect();
    let Some(design) = Design::of(bins, rows, |bin| 1.0 / (noise / bin.count + shape), has_step) else {
        return f64::INFINITY;
    };
    let (_, left) = design.solve(|index| bins[index].value);
    design.product(&left, &left)
}
