//! Which (r, h) are reflectances: the region 0 ≤ F ≤ 1, and the band a real n + i k can reach.

use std::ops::RangeInclusive;

use super::schlick::fifth_power;
use super::{CosTheta, a_from_r_h, gulbrandsen, h_from_r_a, hoffman};

/// 614304/823543: the slope of F at grazing vanishes at h = r + this · (1 − r).
const UPPER_SLOPE: f64 = 614_304.0 / 823_543.0;

/// All h for which 0 ≤ F(θ) ≤ 1 at every angle; `None` where r itself is outside `[0, 1]`.
///
/// Above the upper end F overshoots 1 near grazing; below the lower end it dips under 0.
pub fn feasible_h(r: f64) -> Option<RangeInclusive<f64>> {
    (0.0..=1.0).contains(&r).then(|| lowest_feasible_h(r)..=r + (1.0 - r) * UPPER_SLOPE)
}

/// The lower boundary, where the minimum of F over the angles is exactly 0.
///
/// Closed form with parameter x = 1 − c of that minimum, x ∈ [1/2, 6/7]:
/// r/(1 − r) = x⁵(2x − 1)/(6 − 7x) and a = 5/(x[(6 − 7x) + x⁵(2x − 1)]).
fn lowest_feasible_h(r: f64) -> f64 {
    let x = location_of_zero_minimum(r);
    let a = 5.0 / (x * ((6.0 - 7.0 * x) + fifth_power(x) * (2.0 * x - 1.0)));
    h_from_r_a(r, a)
}

/// x of the minimum on the boundary: the r of the closed form grows with x, so bisection finds it.
fn location_of_zero_minimum(r: f64) -> f64 {
    let (mut low, mut high) = (0.5, 6.0 / 7.0);
    while high - low > f64::EPSILON {
        let x = 0.5 * (low + high);
        if x <= low || x >= high {
            break;
        }
        let (weight_of_r, weight_of_white) = (6.0 - 7.0 * x, fifth_power(x) * (2.0 * x - 1.0));
        if weight_of_white < r * (weight_of_r + weight_of_white) { low = x } else { high = x }
    }
    0.5 * (low + high)
}

/// The smallest and largest value of F over all angles, for any finite r and h.
pub fn reflectance_range(r: f64, h: f64) -> RangeInclusive<f64> {
    let values = extreme_angles(r, h).into_iter().map(|c| hoffman(r, h, c));
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), f| (low.min(f), high.max(f)));
    low..=high
}

/// The ends of the curve and the interior points where dF/dx = 0.
///
/// dF/dx = x⁴ [5(1 − r) − a x (6 − 7x)] for F = r + x⁵((1 − r) − a (1 − x) x).
fn extreme_angles(r: f64, h: f64) -> Vec<CosTheta> {
    let a = a_from_r_h(r, h);
    let mut angles = vec![CosTheta::FACING, CosTheta::GRAZING];
    let discriminant = 36.0 * a * a - 140.0 * a * (1.0 - r);
    if a != 0.0 && discriminant >= 0.0 {
        let root = discriminant.sqrt();
        angles.extend([6.0 * a - root, 6.0 * a + root].map(|v| CosTheta::new(1.0 - v / (14.0 * a))));
    }
    angles
}

/// The h that real n and k give at this r, from the dielectric end (g = 0) to g = 1; `None` outside 0 ≤ r < 1.
///
/// Its upper end can lie a little above [`feasible_h`]: there the model, not the material, would overshoot 1.
pub fn reachable_h(r: f64) -> Option<RangeInclusive<f64>> {
    if !(0.0..1.0).contains(&r) {
        return None;
    }
    const STEPS: u32 = 64;
    let values = (0..=STEPS).map(|step| gulbrandsen(r, f64::from(step) / f64::from(STEPS), CosTheta::MAX));
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), f| (low.min(f), high.max(f)));
    Some(low..=high)
}

/// The angle at which F is smallest, in degrees; not in general θ_max.
pub fn angle_of_minimum_deg(r: f64, h: f64) -> f64 {
    let by_value = |a: &CosTheta, b: &CosTheta| hoffman(r, h, *a).total_cmp(&hoffman(r, h, *b));
    extreme_angles(r, h).into_iter().min_by(by_value).unwrap_or(CosTheta::FACING).deg()
}

/// The h nearest to `h` that is feasible at this r; unchanged where r has no feasible h.
pub fn nearest_feasible_h(r: f64, h: f64) -> f64 {
    feasible_h(r).map_or(h, |range| h.clamp(*range.start(), *range.end()))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::Weights;

    /// Extremes of F by looking at 20 001 angles.
    fn brute_force_range(r: f64, h: f64) -> (f64, f64) {
        (0..=20_000).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), step| {
            let f = Weights::at(CosTheta::new(f64::from(step) / 20_000.0)).apply(r, h);
            (low.min(f), high.max(f))
        })
    }

    proptest! {
        #[test]
        fn range_is_what_brute_force_finds(r in -0.1..1.1, h in -0.1..1.1) {
            let (low, high) = brute_force_range(r, h);
            let range = reflectance_range(r, h);
            prop_assert!((range.start() - low).abs() < 1e-6 && *range.start() <= low + 1e-12);
            prop_assert!((range.end() - high).abs() < 1e-6 && *range.end() >= high - 1e-12);
        }

        #[test]
        fn boundary_is_where_the_range_touches_the_unit_interval(r in 0.0..1.0) {
            let feasible = feasible_h(r).unwrap();
            prop_assert!(reflectance_range(r, *feasible.start()).start().abs() < 1e-12);
            prop_assert!((reflectance_range(r, *feasible.end()).end() - 1.0).abs() < 1e-12);
            prop_assert!(*reflectance_range(r, feasible.start() - 1e-3).start() < 0.0);
            prop_assert!(*reflectance_range(r, feasible.end() + 1e-3).end() > 1.0);
        }
    }

    /// The h at which the smallest F over the angles is 0, computed independently, to five digits.
    #[test]
    fn lower_boundary_at_round_r() {
        let printed = [
            (0.0, 0.23605),
            (0.02, 0.18665),
            (0.1, 0.11908),
            (0.3, 0.05215),
            (0.5, 0.02187),
            (0.7, 0.00680),
            (0.9, 0.00067),
        ];
        for (r, h) in printed {
            assert!((feasible_h(r).unwrap().start() - h).abs() < 6e-6, "{r}");
        }
    }

    /// Computed independently by a search over n and k instead of g, to two digits.
    #[test]
    fn band_of_real_indices_at_round_r() {
        let printed = [
            (0.4, 0.46, 0.84),
            (0.5, 0.46, 0.87),
            (0.6, 0.47, 0.91),
            (0.7, 0.50, 0.93),
            (0.8, 0.58, 0.96),
            (0.9, 0.73, 0.98),
            (0.95, 0.85, 0.99),
        ];
        for (r, low, high) in printed {
            let band = reachable_h(r).unwrap();
            assert!((band.start() - low).abs() < 0.0075 && (band.end() - high).abs() < 0.0075, "{r}: {band:?}");
        }
    }

    /// 83 % of the unit square is feasible: the area between the boundaries, computed independently.
    #[test]
    fn most_of_the_square_is_feasible() {
        let n = 400;
        let mean: f64 = (0..n)
            .map(|i| feasible_h((f64::from(i) + 0.5) / f64::from(n)).map_or(0.0, |f| f.end() - f.start()))
            .sum::<f64>()
            / f64::from(n);
        assert!((mean - 0.83).abs() < 0.005, "{mean}");
    }

    /// r = h = 0.5 has its minimum at 74.9°: h is no "dip".
    #[test]
    fn minimum_is_not_at_theta_max() {
        assert!((angle_of_minimum_deg(0.5, 0.5) - 74.9).abs() < 0.05);
    }

    #[test]
    fn white_edge_overshoots() {
        assert!(*reflectance_range(0.5, 1.0).end() > 1.0);
        assert_eq!(feasible_h(1.02), None);
        assert_eq!(feasible_h(f64::NAN), None);
    }
}
