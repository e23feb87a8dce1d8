//! Do equal steps of a slider look equal? (paper section 6)

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use crate::color::{
    Rgb, RgbSpace, delta_e_rgb, lightness_from_luminance, luminance_from_lightness, srgb_decode, srgb_encode,
};
use crate::fresnel::{CosTheta, feasible_h, gulbrandsen, hoffman, reachable_h};

/// A slider that controls the edge of a grey metal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Slider {
    /// h as it is.
    HLinear,
    /// h through the sRGB curve: the slider of this program's window.
    HSrgb,
    /// h as CIE L*.
    HLightness,
    /// Gulbrandsen's g.
    G,
}

impl Slider {
    /// Every slider.
    pub const ALL: [Self; 4] = [Self::HLinear, Self::HSrgb, Self::HLightness, Self::G];

    /// What the window's own h slider moves.
    pub const OURS: Self = Self::HSrgb;

    /// The stable identifier used in files.
    pub const fn id(self) -> &'static str {
        match self {
            Self::HLinear => "h-linear",
            Self::HSrgb => "h-srgb",
            Self::HLightness => "h-lightness",
            Self::G => "g",
        }
    }

    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::HLinear => "h, linear",
            Self::HSrgb => "h, sRGB-encoded",
            Self::HLightness => "h, as L*",
            Self::G => "g",
        }
    }

    /// The slider's position of an h.
    fn position(self, h: f64) -> f64 {
        match self {
            Self::HSrgb => srgb_encode(h),
            Self::HLightness => lightness_from_luminance(h),
            _ => h,
        }
    }

    /// The reflectance at θ_max that a position gives beside r.
    fn edge(self, position: f64, r: f64) -> f64 {
        match self {
            Self::HLinear => hoffman(r, position, CosTheta::MAX),
            Self::HSrgb => hoffman(r, srgb_decode(position), CosTheta::MAX),
            Self::HLightness => hoffman(r, luminance_from_lightness(position), CosTheta::MAX),
            Self::G => gulbrandsen(r, position, CosTheta::MAX),
        }
    }
}

/// How much of the slider is swept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reach {
    /// The h that some g gives at this r.
    Reachable,
    /// The h with 0 ≤ F ≤ 1 at every angle.
    Feasible,
    /// 0 to 1.
    Full,
}

impl Reach {
    /// Every range, narrow to wide.
    pub const ALL: [Self; 3] = [Self::Reachable, Self::Feasible, Self::Full];

    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Reachable => "the h that g can reach",
            Self::Feasible => "every h that is a reflectance",
            Self::Full => "0 to 1",
        }
    }
}

/// What is swept, in how many steps.
#[derive(Clone, Debug, PartialEq)]
pub struct UniformityOptions {
    /// Reflectances facing the surface, grey, above 0 and below 1.
    pub r: Vec<f64>,
    /// Equal steps of the slider.
    pub steps: usize,
}

impl Default for UniformityOptions {
    fn default() -> Self {
        Self { r: vec![0.02, 0.1, 0.3, 0.5, 0.8, 0.95, 0.98], steps: 20 }
    }
}

/// One slider, swept at one r.
#[derive(Clone, Debug, PartialEq)]
pub struct SliderSweep {
    /// Reflectance facing the surface.
    pub r: f64,
    /// What is moved.
    pub slider: Slider,
    /// How far.
    pub reach: Reach,
    /// Positions of the slider, one more than steps.
    pub positions: Vec<f64>,
    /// The reflectance at θ_max at each position.
    pub edges: Vec<f64>,
    /// CIEDE2000 of each step.
    pub delta_e: Vec<f64>,
}

/// One slider at one r: how equal its steps look. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UniformityRow {
    /// Reflectance facing the surface.
    pub r: f64,
    /// `h-linear`, `h-srgb`, `h-lightness` or `g`.
    pub slider: Slider,
    /// `reachable`, `feasible` or `full`.
    pub reach: Reach,
    /// Number of equal steps.
    pub steps: usize,
    /// The slider's position at the first end.
    pub first: f64,
    /// The slider's position at the last end.
    pub last: f64,
    /// CIEDE2000 of all steps together.
    pub total_delta_e: f64,
    /// Standard deviation of the steps over their mean: 0 is uniform.
    pub variation: f64,
    /// Largest step over smallest; infinite where a step does nothing.
    pub max_over_min: f64,
    /// Largest step.
    pub max_delta_e: f64,
    /// The smallest share of the slider that carries half of the whole change: 0.5 is uniform.
    pub share_of_half: f64,
    /// Where the largest step begins, 0–1 along the slider.
    pub place_of_max: f64,
}

/// One step. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StepRow {
    /// Reflectance facing the surface.
    pub r: f64,
    /// `h-linear`, `h-srgb`, `h-lightness` or `g`.
    pub slider: Slider,
    /// `reachable`, `feasible` or `full`.
    pub reach: Reach,
    /// Number of the step, from 1.
    pub step: usize,
    /// Position before.
    pub from: f64,
    /// Position after.
    pub to: f64,
    /// Reflectance at 81.8° before.
    pub edge_from: f64,
    /// Reflectance at 81.8° after.
    pub edge_to: f64,
    /// CIEDE2000 between the two.
    pub delta_e: f64,
}

/// Sweeps every slider over every range at each r. Where a range does not exist, as for r above 1, it gives no rows.
pub fn uniformity(options: &UniformityOptions) -> Vec<SliderSweep> {
    let sweeps_at = |r: &f64| {
        let of_reach = |reach| Slider::ALL.map(|slider| SliderSweep::new(*r, slider, reach, options.steps));
        Reach::ALL.into_iter().flat_map(of_reach).flatten().collect::<Vec<_>>()
    };
    options.r.iter().flat_map(sweeps_at).collect()
}

impl SliderSweep {
    /// Sweeps one slider in equal steps (at least one); `None` where the range does not exist.
    pub fn new(r: f64, slider: Slider, reach: Reach, steps: usize) -> Option<Self> {
        let steps = steps.max(1);
        let (first, last) = ends(r, slider, reach)?;
        let positions: Vec<f64> = (0..=steps).map(|step| first + (last - first) * step as f64 / steps as f64).collect();
        let edges: Vec<f64> = positions.iter().map(|position| slider.edge(*position, r)).collect();
        // A grey has one lightness in every space.
        let delta_e_of = |two: &[f64]| delta_e_rgb(Rgb::splat(two[0]), Rgb::splat(two[1]), RgbSpace::LinRec709);
        let delta_e = edges.windows(2).map(delta_e_of).collect();
        Some(Self { r, slider, reach, positions, edges, delta_e })
    }

    /// How equal the steps look.
    pub fn row(&self) -> UniformityRow {
        let steps = self.delta_e.len();
        let total: f64 = self.delta_e.iter().sum();
        let mean = total / steps as f64;
        let variance = self.delta_e.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / steps as f64;
        let (mut max, mut place, mut min) = (f64::NEG_INFINITY, 0, f64::INFINITY);
        for (index, &step) in self.delta_e.iter().enumerate() {
            min = min.min(step);
            if step > max {
                (max, place) = (step, index);
            }
        }
        UniformityRow {
            r: self.r,
            slider: self.slider,
            reach: self.reach,
            steps,
            first: self.positions[0],
            last: self.positions[steps],
            total_delta_e: total,
            variation: variance.sqrt() / mean,
            max_over_min: max / min,
            max_delta_e: max,
            share_of_half: share_of_half(&self.delta_e),
            place_of_max: place as f64 / steps as f64,
        }
    }

    /// One row for each step.
    pub fn step_rows(&self) -> impl Iterator<Item = StepRow> + '_ {
        self.delta_e.iter().enumerate().map(|(index, delta_e)| StepRow {
            r: self.r,
            slider: self.slider,
            reach: self.reach,
            step: index + 1,
            from: self.positions[index],
            to: self.positions[index + 1],
            edge_from: self.edges[index],
            edge_to: self.edges[index + 1],
            delta_e: *delta_e,
        })
    }
}

/// Positions at the two ends.
fn ends(r: f64, slider: Slider, reach: Reach) -> Option<(f64, f64)> {
    let h: RangeInclusive<f64> = match (slider, reach) {
        (Slider::G, _) => return (0.0..1.0).contains(&r).then_some((0.0, 1.0)),
        (_, Reach::Full) => 0.0..=1.0,
        (_, Reach::Reachable) => reachable_h(r)?,
        (_, Reach::Feasible) => feasible_h(r)?,
    };
    Some((slider.position(*h.start()), slider.position(*h.end())))
}

/// The smallest share of equal steps that together carry half of the change; a step counts in part.
fn share_of_half(delta_e: &[f64]) -> f64 {
    let mut sorted = delta_e.to_vec();
    sorted.sort_by(|a, b| b.total_cmp(a));
    let mut left = sorted.iter().sum::<f64>() / 2.0;
    let mut steps = 0.0;
    for step in sorted {
        if step >= left {
            return (steps + left / step) / delta_e.len() as f64;
        }
        left -= step;
        steps += 1.0;
    }
    f64::NAN
}

/// What is seen at one r, with the numbers in it.
pub fn uniformity_summary(sweeps: &[SliderSweep], r: f64) -> String {
    let variation = |slider, reach| {
        let found = sweeps.iter().find(|sweep| sweep.r == r && sweep.slider == slider && sweep.reach == reach);
        found.map_or(f64::NAN, |sweep| sweep.row().variation)
    };
    let (within, full) = (Reach::Reachable, Reach::Full);
    format!(
        "At r = {}, equal steps of g vary by {:.2} (standard deviation over mean) and those of h by {:.2} over the same \
         appearances. Over its full range linear h is not uniform either ({:.2}); our slider moves h sRGB-encoded ({:.2}).",
        (r * 1000.0).round() / 1000.0,
        variation(Slider::G, within),
        variation(Slider::HLinear, within),
        variation(Slider::HLinear, full),
        variation(Slider::OURS, full)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_steps_have_no_variation() {
        assert_eq!(share_of_half(&[1.0; 20]), 0.5);
        assert!((share_of_half(&[3.0, 1.0, 1.0, 1.0]) - 0.25).abs() < 1e-15);
    }

    /// L* is made to be uniform; CIEDE2000 weighs it by S_L, which grows away from mid-grey (Sharma 2005, eq. 15).
    #[test]
    fn lightness_is_the_most_uniform_of_the_full_range() {
        for r in UniformityOptions::default().r {
            let variation = |slider| SliderSweep::new(r, slider, Reach::Full, 20).unwrap().row().variation;
            assert!(variation(Slider::HLightness) <= variation(Slider::HSrgb) + 0.02, "{r}");
            assert!(variation(Slider::HSrgb) < variation(Slider::HLinear), "{r}");
        }
    }

    #[test]
    fn h_and_g_sweep_the_same_appearances() {
        for r in [0.3, 0.8, 0.95] {
            let edges = |slider| SliderSweep::new(r, slider, Reach::Reachable, 20).unwrap().edges;
            let span = |edges: Vec<f64>| {
                edges.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), e| (low.min(*e), high.max(*e)))
            };
            let ((h_low, h_high), (g_low, g_high)) = (span(edges(Slider::HLinear)), span(edges(Slider::G)));
            // Both samplings of g miss the extremes by a part of their step.
            assert!((h_low - g_low).abs() < 0.005 && (h_high - g_high).abs() < 0.005, "{r}");
        }
    }

    #[test]
    fn what_has_no_range_is_left_out() {
        assert!(SliderSweep::new(1.0, Slider::G, Reach::Full, 20).is_none());
        let options = UniformityOptions { r: vec![0.5, 1.2], steps: 4 };
        let sweeps = uniformity(&options);
        assert_eq!(sweeps.iter().filter(|sweep| sweep.r == 0.5).count(), 12);
        assert_eq!(sweeps.iter().filter(|sweep| sweep.r == 1.2).count(), 3);
    }
}
