//! The square of r and h: where it holds reflectances, and where materials lie in it.

use serde::Serialize;

use crate::color::RgbSpace;
use crate::fresnel::{feasible_h, reachable_h};
use crate::metal::Metal;
use crate::preset::Preset;

/// Both regions over r. The field names are stable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BoundaryRow {
    /// Reflectance facing the surface.
    pub r: f64,
    /// Smallest h with 0 ≤ F at every angle.
    pub feasible_low: f64,
    /// Largest h with F ≤ 1 at every angle.
    pub feasible_high: f64,
    /// Smallest h of any real n and k; NaN at r = 1, where there are none.
    pub reachable_low: f64,
    /// Largest h of any real n and k.
    pub reachable_high: f64,
}

/// One channel of one metal. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MetalPoint {
    /// Identifier of the data set; empty for a preset.
    pub metal: String,
    /// The name of the metal or the preset.
    pub name: String,
    /// The space of r and h.
    pub space: RgbSpace,
    /// `red`, `green` or `blue`.
    pub channel: &'static str,
    /// Reflectance facing the surface.
    pub r: f64,
    /// Reflectance at 81.8°.
    pub h: f64,
    /// Whether the curve stays within 0–1.
    pub is_feasible: bool,
}

/// Names of the channels, in order.
const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// The boundaries at `steps` + 1 even r from 0 to 1, denser towards both ends where they bend.
pub fn feasibility_boundary(steps: usize) -> Vec<BoundaryRow> {
    let steps = steps.max(1);
    // Equal steps of an angle: cosine spacing.
    let r_at = |step: usize| 0.5 - 0.5 * (std::f64::consts::PI * step as f64 / steps as f64).cos();
    (0..=steps).filter_map(|step| boundary_at(r_at(step))).collect()
}

fn boundary_at(r: f64) -> Option<BoundaryRow> {
    let feasible = feasible_h(r)?;
    let reachable = reachable_h(r).unwrap_or(f64::NAN..=f64::NAN);
    Some(BoundaryRow {
        r,
        feasible_low: *feasible.start(),
        feasible_high: *feasible.end(),
        reachable_low: *reachable.start(),
        reachable_high: *reachable.end(),
    })
}

/// Each channel of each metal as a point of the square.
pub fn metal_points(metals: &[&Metal], space: RgbSpace) -> Vec<MetalPoint> {
    let of_metal = |metal: &&Metal| {
        let (r, h) = (metal.r(space), metal.h(space));
        let point = |channel: usize| MetalPoint {
            metal: metal.id.clone(),
            name: metal.name.clone(),
            space,
            channel: CHANNELS[channel],
            r: r[channel],
            h: h[channel],
            is_feasible: is_feasible(r[channel], h[channel]),
        };
        [0, 1, 2].map(point)
    };
    metals.iter().flat_map(of_metal).collect()
}

/// Each channel of a preset as a point of the square, in the preset's own space.
pub fn preset_points(preset: &Preset) -> [MetalPoint; 3] {
    [0, 1, 2].map(|channel| MetalPoint {
        metal: String::new(),
        name: preset.name.clone(),
        space: preset.space,
        channel: CHANNELS[channel],
        r: preset.r[channel],
        h: preset.h[channel],
        is_feasible: is_feasible(preset.r[channel], preset.h[channel]),
    })
}

fn is_feasible(r: f64, h: f64) -> bool {
    feasible_h(r).is_some_and(|range| range.contains(&h))
}

/// What is seen, with the numbers in it.
pub fn feasibility_summary(points: &[MetalPoint]) -> String {
    let outside: Vec<&MetalPoint> = points.iter().filter(|point| !point.is_feasible).collect();
    let names = outside.iter().map(|point| format!("{} {}", point.name.to_lowercase(), point.channel));
    let listed = match outside.len() {
        0 => "all of them lie inside".to_owned(),
        count @ 1..=9 => format!("{count} lie outside: {}", names.collect::<Vec<_>>().join(", ")),
        count => format!("{count} lie outside"),
    };
    format!(
        "Inside the outlined region the curve stays within 0–1 at every angle; the shaded band is what real n and k reach. \
         Of {} measured channels {listed}.",
        points.len()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::{CosTheta, hoffman, reflectance_range};
    use crate::metal::preferred_metals;

    /// On the outline the curve touches 0 or 1; outside it crosses. By looking at 2001 angles.
    #[test]
    fn the_outline_is_where_brute_force_finds_it() {
        let extremes = |r: f64, h: f64| {
            (0..=2000)
                .map(|step| hoffman(r, h, CosTheta::new(f64::from(step) / 2000.0)))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), f| (low.min(f), high.max(f)))
        };
        for row in feasibility_boundary(40) {
            assert!(extremes(row.r, row.feasible_low).0.abs() < 1e-4, "{row:?}");
            assert!((extremes(row.r, row.feasible_high).1 - 1.0).abs() < 1e-4, "{row:?}");
            assert!(extremes(row.r, row.feasible_low - 0.01).0 < 0.0, "{row:?}");
        }
    }

    #[test]
    fn a_preset_is_three_points_of_its_own_space() {
        let preset = Preset { h: crate::color::Rgb([0.8, 1.0, 0.7]), ..Preset::new_authored() };
        let points = preset_points(&preset);
        assert_eq!(
            points.each_ref().map(|point| (point.channel, point.h)),
            [("red", 0.8), ("green", 1.0), ("blue", 0.7)]
        );
        assert_eq!(points.map(|point| point.is_feasible), [true, false, true]);
    }

    #[test]
    fn boundary_runs_from_0_to_1_and_points_know_their_side() {
        let rows = feasibility_boundary(50);
        assert_eq!((rows.len(), rows[0].r, rows[50].r), (51, 0.0, 1.0));
        let metals: Vec<&Metal> = preferred_metals().collect();
        let points = metal_points(&metals, RgbSpace::LinRec709);
        assert_eq!(points.len(), 3 * metals.len());
        for point in &points {
            let range = reflectance_range(point.r, point.h);
            let is_inside = *range.start() >= -1e-12 && *range.end() <= 1.0 + 1e-12;
            assert_eq!(point.is_feasible, is_inside, "{point:?}");
        }
    }
}
