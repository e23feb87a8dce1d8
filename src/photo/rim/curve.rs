//! How bright a picture is across the edge of a polished body, as a sum of known curves.

use std::f64::consts::SQRT_2;

use crate::fresnel::{CosTheta, Weights};

/// How many curves the sum has.
pub(super) const CURVES: usize = 6;
/// The last of them: a step right at the edge. A backdrop far behind a body has none, since close to 90° every metal
/// is a perfect mirror of what stands behind it.
pub(super) const STEP: usize = CURVES - 1;

/// One value of each curve.
pub(super) type Row = [f64; CURVES];

/// The curves over the depth inside the edge, seen through a lens and by square pixels.
pub(super) struct EdgeCurves {
    start_px: f64,
    values: Vec<Row>,
}

/// Depth between two tabulated values, in pixels.
const GRID_PX: f64 = 0.1;
/// What the table reaches beyond the depths that are asked for.
const MARGIN_PX: f64 = 2.0;

impl EdgeCurves {
    /// For a body of a radius and a lens whose blur has a standard deviation, over `depth_px` inside the edge.
    pub fn of(radius_px: f64, blur_px: f64, depth_px: [f64; 2]) -> Self {
        let start_px = depth_px[0] - MARGIN_PX;
        let count = ((depth_px[1] + MARGIN_PX - start_px) / GRID_PX).ceil() as usize;
        let reach = ((3.0 * blur_px + 0.75) / GRID_PX).ceil() as usize;
        let kernel: Vec<f64> =
            (0..=2 * reach).map(|index| point_spread((index as f64 - reach as f64) * GRID_PX, blur_px)).collect();
        let total: f64 = kernel.iter().sum();
        let depth = |index: usize| start_px + (index as f64 + 0.5 - reach as f64) * GRID_PX;
        let sharp: Vec<Row> = (0..count + 2 * reach).map(|index| sharp(depth(index), radius_px)).collect();
        let blurred = |index: usize| {
            let mut sum = [0.0; CURVES];
            for (weight, row) in kernel.iter().zip(&sharp[index..]) {
                add(&mut sum, row, weight / total);
            }
            sum
        };
        Self { start_px: start_px + 0.5 * GRID_PX, values: (0..count).map(blurred).collect() }
    }

    /// The curves at a depth, their slopes and their curvatures, by the cubic through four tabulated values.
    pub fn at(&self, depth_px: f64) -> [Row; 3] {
        let last = self.values.len().saturating_sub(3) as f64;
        let position = ((depth_px - self.start_px) / GRID_PX).clamp(1.0, last.max(1.0));
        let index = position as usize;
        let s = position - index as f64;
        let value = [
            -s * (s - 1.0) * (s - 2.0) / 6.0,
            (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0,
            -(s + 1.0) * s * (s - 2.0) / 2.0,
            (s + 1.0) * s * (s - 1.0) / 6.0,
        ];
        let slope = [
            -(3.0 * s * s - 6.0 * s + 2.0) / 6.0,
            (3.0 * s * s - 4.0 * s - 1.0) / 2.0,
            -(3.0 * s * s - 2.0 * s - 2.0) / 2.0,
            (3.0 * s * s - 1.0) / 6.0,
        ];
        let curvature = [1.0 - s, 3.0 * s - 2.0, 1.0 - 3.0 * s, s];
        let mix = |weights: [f64; 4], scale: f64| {
            let mut sum = [0.0; CURVES];
            for (weight, row) in weights.iter().zip(&self.values[index - 1..]) {
                add(&mut sum, row, weight * scale);
            }
            sum
        };
        [mix(value, 1.0), mix(slope, 1.0 / GRID_PX), mix(curvature, 1.0 / (GRID_PX * GRID_PX))]
    }
}

/// Adds a multiple of one row to another.
pub(super) fn add(sum: &mut Row, row: &Row, weight: f64) {
    sum.iter_mut().zip(row).for_each(|(sum, value)| *sum += weight * value);
}

/// Without blur: a backdrop and its slope beside the body; on it what r and h make of the light, the change of the
/// light towards the middle, and a step.
fn sharp(depth_px: f64, radius_px: f64) -> Row {
    if depth_px <= 0.0 {
        return [1.0, -depth_px, 0.0, 0.0, 0.0, 0.0];
    }
    let sine = (1.0 - depth_px / radius_px).max(0.0);
    let cosine = (1.0 - sine * sine).sqrt();
    let Weights { of_r, of_h, .. } = Weights::at(CosTheta::new(cosine));
    [1.0, 0.0, of_r, of_h, cosine, 1.0]
}

/// A Gaussian lens and the square of a pixel as the edge sees it, turned by every angle: the mean of three.
fn point_spread(offset_px: f64, blur_px: f64) -> f64 {
    const ANGLES_DEG: [f64; 3] = [7.5, 22.5, 37.5];
    const ACROSS: [f64; 5] = [-0.4, -0.2, 0.0, 0.2, 0.4];
    let side = |offset: f64, width: f64| {
        let end = |sign: f64| erf((offset + sign * width / 2.0) / (blur_px * SQRT_2));
        (end(1.0) - end(-1.0)) / width
    };
    let turned = |angle_deg: f64| {
        let (sin, cos) = angle_deg.to_radians().sin_cos();
        ACROSS.iter().map(|across| side(offset_px + across * sin, cos)).sum::<f64>()
    };
    ANGLES_DEG.into_iter().map(turned).sum()
}

/// The error function to 1.5e-7 (Abramowitz & Stegun 1964, 7.1.26).
fn erf(x: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.327_591_1 * x.abs());
    let terms = [1.061_405_429, -1.453_152_027, 1.421_413_741, -0.284_496_736, 0.254_829_592];
    let series = terms.iter().fold(0.0, |sum, term| (sum + term) * t);
    (1.0 - series * (-x * x).exp()).copysign(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Far from the edge blur changes nothing; the step is half way up at the edge and integrates to its depth.
    #[test]
    fn blur_leaves_the_step_where_it_is() {
        for blur_px in [0.2, 0.5, 1.5] {
            let curves = EdgeCurves::of(100.0, blur_px, [-4.0, 8.0]);
            assert!((curves.at(0.0)[0][STEP] - 0.5).abs() < 1e-3, "{blur_px}");
            assert!(curves.at(-5.4)[0][STEP] < 1e-3 && curves.at(7.0)[0][STEP] > 0.999, "{blur_px}");
            assert!((curves.at(-3.5)[0][1] - 3.5).abs() < 0.02, "{blur_px}");
        }
    }

    #[test]
    fn slopes_and_curvatures_are_those_of_the_curves() {
        let curves = EdgeCurves::of(100.0, 0.6, [-4.0, 8.0]);
        let h = 1e-4;
        for depth in [-1.03, -0.31, 0.27, 1.44] {
            let [before, at, after] = [depth - h, depth, depth + h].map(|depth| curves.at(depth));
            for curve in 0..CURVES {
                let slope = (after[0][curve] - before[0][curve]) / (2.0 * h);
                let curvature = (after[1][curve] - before[1][curve]) / (2.0 * h);
                assert!((slope - at[1][curve]).abs() < 1e-4, "{depth} {curve}");
                assert!((curvature - at[2][curve]).abs() < 1e-3, "{depth} {curve}");
            }
        }
    }

    #[test]
    fn the_error_function_meets_its_table() {
        for (x, value) in [(0.0, 0.0), (0.5, 0.520_499_878), (1.0, 0.842_700_793), (-2.0, -0.995_322_265)] {
            assert!((erf(x) - value).abs() < 2e-7, "{x}");
        }
    }
}
