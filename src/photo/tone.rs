//! The grey scale: neutral patches of known reflectance undo a camera's tone curve.

use super::{AreaStatistics, Card, Photo};
use crate::color::{srgb_decode, srgb_encode};

/// Curves from a photograph's values to reflectance under its light, one for each channel.
#[derive(Clone, Debug)]
pub(super) struct ToneCurve {
    channels: [Tabulated; 3],
    /// How far the curve is off, relative: half the mean error at a patch when it is left out.
    pub relative_uncertainty: f64,
    /// Reflectance of the brightest patch; above it the curve is extended.
    brightest: f64,
    /// Relative error at the brightest patch of each channel when the curve through the others is extended to it,
    /// for each step of the sRGB curve that it is beyond them.
    extension_error: [f64; 3],
}

/// A curve needs this many patches.
pub(super) const LEAST_GREYS: usize = 3;

impl ToneCurve {
    /// The curve through the patches and black; `None` when they are too few or do not grow in every channel.
    pub fn through(photo: &Photo, greys: &[Card]) -> Option<Self> {
        if greys.len() < LEAST_GREYS {
            return None;
        }
        let read = |grey: &Card| (AreaStatistics::of(photo, grey.area), grey.reflectance);
        let mut patches: Vec<(AreaStatistics, f64)> = greys.iter().map(read).collect();
        patches.sort_by(|a, b| a.1.total_cmp(&b.1));
        let points = [0, 1, 2].map(|channel| knots(&patches, channel));
        let [red, green, blue] = points.each_ref().map(|points| MonotoneCubic::through(points));
        let error = points.iter().map(|points| leave_one_out_error(points)).sum::<f64>() / 3.0;
        Some(Self {
            channels: [red?, green?, blue?].map(Tabulated::of),
            relative_uncertainty: 0.5 * error,
            brightest: patches.last()?.1,
            extension_error: points.each_ref().map(|points| extension_error(points)),
        })
    }

    /// True when the curve has to be extended to give this reflectance.
    pub fn is_extended_to(&self, reflectance: f64) -> bool {
        /// A patch is known to a percent or two itself.
        const MARGIN: f64 = 1.01;
        reflectance > MARGIN * self.brightest
    }

    /// Relative standard uncertainty of a reflectance: that of the curve, and beyond the brightest patch what
    /// extending it adds, in proportion to how far.
    pub fn uncertainty(&self, channel: usize, reflectance: f64) -> f64 {
        let beyond = (srgb_encode(reflectance) - srgb_encode(self.brightest)).max(0.0);
        self.relative_uncertainty.hypot(self.extension_error[channel] * beyond)
    }

    /// The reflectance of a value of a channel.
    pub fn reflectance(&self, channel: usize, value: f64) -> f64 {
        self.channels[channel].reflectance(value)
    }
}

/// A curve and its values at equal steps of the root of a linear value, since every pixel asks for three.
#[derive(Clone, Debug)]
struct Tabulated {
    curve: MonotoneCubic,
    values: Vec<f64>,
}

impl Tabulated {
    /// What a curve bends between two steps is below 1e-6 for one like a camera's, and below 4e-5 for one so steep that
    /// a code of 0.02 stands for one of 0.3.
    const STEPS: usize = 2048;

    fn of(curve: MonotoneCubic) -> Self {
        let value = |step: usize| exact_reflectance(&curve, (step as f64 / Self::STEPS as f64).powi(2));
        Self { values: (0..=Self::STEPS).map(value).collect(), curve }
    }

    fn reflectance(&self, value: f64) -> f64 {
        let position = value.sqrt() * Self::STEPS as f64;
        if !(0.0..Self::STEPS as f64).contains(&position) {
            return exact_reflectance(&self.curve, value);
        }
        let step = position as usize;
        let (before, after) = (self.values[step], self.values[step + 1]);
        before + (after - before) * (position - step as f64)
    }
}

fn exact_reflectance(curve: &MonotoneCubic, value: f64) -> f64 {
    srgb_decode(curve.at(srgb_encode(value)))
}

/// Both axes sRGB-encoded, so that dark patches count as much as bright ones.
fn knots(patches: &[(AreaStatistics, f64)], channel: usize) -> Vec<(f64, f64)> {
    let patch = |(statistics, reflectance): &(AreaStatistics, f64)| {
        (srgb_encode(statistics.trimmed_mean[channel]), srgb_encode(*reflectance))
    };
    std::iter::once((0.0, 0.0)).chain(patches.iter().map(patch)).collect()
}

/// The relative error at the last knot of the curve through the others, over its distance from them.
fn extension_error(points: &[(f64, f64)]) -> f64 {
    let Some(((value, code), rest)) = points.split_last() else { return 0.0 };
    let distance = code - rest.last().map_or(0.0, |point| point.1);
    let extended = MonotoneCubic::through(rest).map_or(0.0, |curve| srgb_decode(curve.at(*value)));
    (extended / srgb_decode(*code) - 1.0).abs() / distance
}

/// Mean relative error of the reflectance of each inner patch by the curve through the others.
fn leave_one_out_error(points: &[(f64, f64)]) -> f64 {
    let error = |left_out: usize| {
        let rest: Vec<_> = points.iter().enumerate().filter(|(i, _)| *i != left_out).map(|(_, p)| *p).collect();
        let (value, reflectance) = (points[left_out].0, srgb_decode(points[left_out].1));
        MonotoneCubic::through(&rest).map_or(1.0, |curve| (srgb_decode(curve.at(value)) / reflectance - 1.0).abs())
    };
    // The brightest patches matter: a metal's r and h lie there.
    let inner = points.len() - 3..points.len() - 1;
    inner.clone().map(error).sum::<f64>() / inner.len() as f64
}

/// A monotone piecewise cubic (Fritsch & Carlson 1980), straight beyond its last knot.
#[derive(Clone, Debug)]
struct MonotoneCubic {
    points: Vec<(f64, f64)>,
    slopes: Vec<f64>,
}

impl MonotoneCubic {
    /// Through knots that grow strictly in both; `None` otherwise.
    fn through(points: &[(f64, f64)]) -> Option<Self> {
        let grows = |pair: &[(f64, f64)]| pair[1].0 > pair[0].0 && pair[1].1 > pair[0].1;
        if points.len() < 2 || !points.windows(2).all(grows) {
            return None;
        }
        let secants: Vec<f64> = points.windows(2).map(|p| (p[1].1 - p[0].1) / (p[1].0 - p[0].0)).collect();
        // Inner slopes are harmonic means of the secants beside them, which keeps every piece monotone.
        let inner = secants.windows(2).map(|s| 2.0 * s[0] * s[1] / (s[0] + s[1]));
        let first =
            end_slope(points[1].0 - points[0].0, secants[0], points.get(2).map(|p| p.0 - points[1].0), secants.get(1));
        let end = points.len() - 1;
        let before = end.checked_sub(2).map(|i| points[i + 1].0 - points[i].0);
        let last_but_one = secants.len().checked_sub(2).map(|i| &secants[i]);
        let last = end_slope(points[end].0 - points[end - 1].0, secants[end - 1], before, last_but_one);
        let slopes = std::iter::once(first).chain(inner).chain(std::iter::once(last)).collect();
        Some(Self { points: points.to_vec(), slopes })
    }

    fn at(&self, x: f64) -> f64 {
        let last = self.points.len() - 1;
        let piece = self.points.partition_point(|point| point.0 <= x);
        if piece == 0 || piece > last {
            let end = if piece == 0 { 0 } else { last };
            return self.points[end].1 + self.slopes[end] * (x - self.points[end].0);
        }
        let ((x0, y0), (x1, y1)) = (self.points[piece - 1], self.points[piece]);
        let (width, t) = (x1 - x0, (x - x0) / (x1 - x0));
        let (m0, m1) = (self.slopes[piece - 1] * width, self.slopes[piece] * width);
        let (t2, t3) = (t * t, t * t * t);
        y0 * (2.0 * t3 - 3.0 * t2 + 1.0) + m0 * (t3 - 2.0 * t2 + t) + y1 * (3.0 * t2 - 2.0 * t3) + m1 * (t3 - t2)
    }
}

/// The slope of the parabola through the last three knots, kept monotone (Moler 2004, section 3.6, pchip).
fn end_slope(width: f64, secant: f64, next_width: Option<f64>, next_secant: Option<&f64>) -> f64 {
    let (Some(next_width), Some(next_secant)) = (next_width, next_secant) else { return secant };
    let slope = ((2.0 * width + next_width) * secant - width * next_secant) / (width + next_width);
    slope.clamp(0.0, 3.0 * secant)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::largest;

    #[test]
    fn passes_through_its_knots_and_never_falls() {
        let points = [(0.0, 0.0), (0.1, 0.3), (0.5, 0.35), (0.9, 0.9)];
        let curve = MonotoneCubic::through(&points).unwrap();
        for (x, y) in points {
            assert!((curve.at(x) - y).abs() < 1e-12);
        }
        let values: Vec<f64> = (0..=120).map(|i| curve.at(f64::from(i) / 100.0)).collect();
        assert!(values.windows(2).all(|pair| pair[1] >= pair[0]));
    }

    /// Through a straight curve nothing is wrong beyond the patches either; through a bent one what is grows with how far.
    #[test]
    fn extending_a_curve_costs_what_it_bends() {
        let straight = [(0.0, 0.0), (0.2, 0.25), (0.4, 0.5), (0.6, 0.75)];
        assert!(extension_error(&straight) < 1e-12);
        let bent = [(0.0, 0.0), (0.3, 0.25), (0.5, 0.5), (0.6, 0.75)];
        assert!(extension_error(&bent) > 0.1);
    }

    /// How far a table lies from its curve at most; beyond 0 to 1 no table is asked.
    fn table_error(points: &[(f64, f64)]) -> f64 {
        let curve = MonotoneCubic::through(points).unwrap();
        let tabulated = Tabulated::of(curve.clone());
        assert!(tabulated.reflectance(f64::NAN).is_nan());
        let near = (-1_000..=120_000).map(|i| f64::from(i) / 1e5);
        let beyond = [-1.0, 1e-9, 1e9, 1e38, f64::INFINITY];
        largest(near.chain(beyond).map(|value| {
            let (found, exact) = (tabulated.reflectance(value), exact_reflectance(&curve, value));
            if found == exact { 0.0 } else { (found - exact).abs() }
        }))
    }

    #[test]
    fn the_table_is_the_curve() {
        let as_a_camera =
            [0.0, 0.20, 0.36, 0.54, 0.72, 0.87, 0.96].into_iter().zip([0.0, 0.19, 0.33, 0.47, 0.63, 0.79, 0.95]);
        let error = table_error(&as_a_camera.collect::<Vec<_>>());
        assert!(error < 1e-6, "{error}");
        let steep = table_error(&[(0.0, 0.0), (0.02, 0.3), (0.5, 0.6), (0.96, 0.95)]);
        assert!(steep < 4e-5, "{steep}");
    }

    #[test]
    fn refuses_knots_that_do_not_grow() {
        assert!(MonotoneCubic::through(&[(0.0, 0.0), (0.5, 0.5), (0.5, 0.6)]).is_none());
        assert!(MonotoneCubic::through(&[(0.0, 0.0), (0.5, 0.5), (0.6, 0.4)]).is_none());
    }
}
