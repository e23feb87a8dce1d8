//! The exact Fresnel reflectance of a conductor in air.

use super::CosTheta;

/// Unpolarised reflectance for the complex index n + i k, air outside (Born & Wolf 1999, section 14.2).
///
/// A number of `[0, 1]` (to rounding) for every finite n ≥ 0 and k ≥ 0. For k = 0 it is the dielectric, including
/// total reflection for n < 1; for n = k = 0, which is no material, it is 1, the limit of a vanishing index.
/// Written without the cancellations of the usual form: the small part of the root comes from `n k`
/// instead of a difference of near-equals, and both polarisations are quotients of sums of squares.
/// An index whose fourth power would overflow is counted in units of its larger part.
pub fn conductor(n: f64, k: f64, cos_theta: CosTheta) -> f64 {
    let c = cos_theta.get();
    if c == 0.0 {
        1.0
    } else if has_room(n, k, c) {
        with_room(n, k, c)
    } else {
        without_room(n, k, c)
    }
}

/// How far from 1 the larger of n and k and the cosine may be for [`with_room`].
const ROOM: std::ops::RangeInclusive<f64> = 1e-30..=1e30;

/// True where every product of [`with_room`] is a number and both polarisations divide by more than 0; not for NaN.
#[inline(always)]
pub(super) fn has_room(n: f64, k: f64, c: f64) -> bool {
    let larger = if n > k { n } else { k };
    // No branch, so that many are asked at once.
    (larger >= *ROOM.start()) & (larger <= *ROOM.end()) & (c >= *ROOM.start())
}

/// The reflectance where [`has_room`], which metals have at all angles but 90°. Without a branch, so that several are
/// computed at once; both quotients have one division.
#[inline(always)]
pub(super) fn with_room(n: f64, k: f64, c: f64) -> f64 {
    let (real, nk) = ((n - k) * (n + k), n * k);
    let t0 = real - (1.0 - c) * (1.0 + c);
    let Root { a, b } = Root::of_modulus((t0 * t0 + 4.0 * nk * nk).sqrt(), t0, nk);
    // ε c with ε = (a + i b)² + sin²θ; r_p = (ε c − (a + i b)) / (ε c + (a + i b)).
    let (re, im) = (real * c, 2.0 * nk * c);
    let (s_above, s_below) = (squared((a - c, b)), squared((a + c, b)));
    let (p_above, p_below) = (squared((re - a, im - b)), squared((re + a, im + b)));
    0.5 * (s_above * p_below + p_above * s_below) / (s_below * p_below)
}

/// The same for every other n and k, down to 0 and up to the largest number.
#[cold]
fn without_room(n: f64, k: f64, c: f64) -> f64 {
    let sin2 = (1.0 - c) * (1.0 + c);
    let unit = unit_of(n, k);
    let (n, k) = (n * unit, k * unit);
    let Root { a, b } = Root::of(n * n - k * k - sin2 * unit * unit, n * k);
    let s = quotient((a - c * unit, b), (a + c * unit, b));
    let (re, im) = (((n - k) * (n + k)) * c, 2.0 * n * k * c);
    let (a, b) = (a * unit, b * unit);
    let p = quotient((re - a, im - b), (re + a, im + b));
    0.5 * (s + p)
}

/// √(ε − sin²θ) = a + i b.
pub(crate) struct Root {
    pub(crate) a: f64,
    pub(crate) b: f64,
}

impl Root {
    /// The root of t0 + 2 i nk.
    pub(crate) fn of(t0: f64, nk: f64) -> Self {
        Self::of_modulus(t0.hypot(2.0 * nk), t0, nk)
    }

    /// The same where the modulus is known, each part from the sum that does not cancel.
    #[inline(always)]
    fn of_modulus(modulus: f64, t0: f64, nk: f64) -> Self {
        let large = ((modulus + t0.abs()) / 2.0).sqrt();
        let small = if large > 0.0 { nk / large } else { 0.0 };
        if t0 < 0.0 { Self { a: small, b: large } } else { Self { a: large, b: small } }
    }
}

/// n and k beyond which they are scaled: their fourth power is still a number, with room.
const LARGEST_UNSCALED: f64 = 1e60;

/// What n and k are multiplied with: 1 where their powers are numbers, else their larger part becomes 1.
fn unit_of(n: f64, k: f64) -> f64 {
    let larger = n.max(k);
    if larger > LARGEST_UNSCALED { 1.0 / larger } else { 1.0 }
}

/// |x|² / |y|² of complex x and y with |x| ≤ |y|; 1 where both vanish, as they do only together with the index.
fn quotient(x: (f64, f64), y: (f64, f64)) -> f64 {
    let below = squared(y);
    if below >= f64::MIN_POSITIVE || below.is_nan() {
        return squared(x) / below;
    }
    // The squares are too small for numbers, not the parts themselves.
    let scale = y.0.abs().max(y.1.abs());
    if scale == 0.0 { 1.0 } else { squared((x.0 / scale, x.1 / scale)) / squared((y.0 / scale, y.1 / scale)) }
}

#[inline(always)]
fn squared((re, im): (f64, f64)) -> f64 {
    re * re + im * im
}

/// r at normal incidence, ((n − 1)² + k²) / ((n + 1)² + k²), for every finite n ≥ 0 and k ≥ 0.
pub fn normal_reflectance(n: f64, k: f64) -> f64 {
    let unit = unit_of(n, k);
    quotient(((n - 1.0) * unit, k * unit), ((n + 1.0) * unit, k * unit))
}

#[cfg(test)]
mod tests {
    use nalgebra::Complex;
    use proptest::prelude::*;

    use super::*;

    /// The textbook complex arithmetic (Born & Wolf 1999, eqs. 1.5.20–21).
    fn by_complex_arithmetic(n: f64, k: f64, c: f64) -> f64 {
        let eps = Complex::new(n, k).powi(2);
        let root = (eps - Complex::from(1.0 - c * c)).sqrt();
        let s = (Complex::from(c) - root) / (Complex::from(c) + root);
        let p = (eps * c - root) / (eps * c + root);
        0.5 * (s.norm_sqr() + p.norm_sqr())
    }

    fn dielectric(n: f64, c: f64) -> f64 {
        let ct = (1.0 - (1.0 - c * c) / (n * n)).sqrt();
        let s = (c - n * ct) / (c + n * ct);
        let p = (n * c - ct) / (n * c + ct);
        0.5 * (s * s + p * p)
    }

    proptest! {
        #[test]
        fn is_the_complex_formula(n in 0.01..10.0, k in 0.0..20.0, c in 0.001..1.0) {
            prop_assert!((conductor(n, k, CosTheta::new(c)) - by_complex_arithmetic(n, k, c)).abs() < 1e-11);
        }

        #[test]
        fn without_absorption_is_the_dielectric(n in 1.001..4.0, c in 0.0..1.0) {
            prop_assert!((conductor(n, 0.0, CosTheta::new(c)) - dielectric(n, c)).abs() < 1e-12);
        }

        #[test]
        fn stays_in_the_unit_interval(n in 0.0..20.0, k in 0.0..1e4, c in 0.0..1.0) {
            let f = conductor(n, k, CosTheta::new(c));
            prop_assert!((0.0..=1.0 + 1e-14).contains(&f), "{f}");
        }

        /// Magnitudes from the smallest to the largest number there is, and 0.
        #[test]
        fn is_total(n in magnitude(), k in magnitude(), c in magnitude()) {
            let f = conductor(n, k, CosTheta::new(c.min(1.0)));
            prop_assert!((0.0..=1.0 + 1e-14).contains(&f), "{f}");
            prop_assert!((0.0..=1.0).contains(&normal_reflectance(n, k)));
        }

        /// Scaling is no seam: the scaled and the unscaled form agree where both have numbers.
        #[test]
        fn does_not_depend_on_the_unit(part in 0.0..1.0, c in 0.0..10.0) {
            for (n, k) in [(part, 1.0), (1.0, part)] {
                let [below, above] = [1.0 - 1e-9, 1.0 + 1e-9].map(|factor| {
                    let size = factor * LARGEST_UNSCALED;
                    conductor(n * size, k * size, CosTheta::new(c / LARGEST_UNSCALED))
                });
                prop_assert!((below - above).abs() < 1e-8, "{below} {above}");
            }
        }

        /// Nor is there a seam where there is room for the form without branches.
        #[test]
        fn both_forms_agree(n in 0.001..20.0, k in 0.001..20.0, c in 1e-6..1.0) {
            let (with, without) = (with_room(n, k, c), without_room(n, k, c));
            prop_assert!((with - without).abs() < 1e-12, "{with} {without}");
        }

        #[test]
        fn faces_at_the_normal_reflectance(n in 0.01..10.0, k in 0.0..20.0) {
            prop_assert!((conductor(n, k, CosTheta::FACING) - normal_reflectance(n, k)).abs() < 1e-13);
        }
    }

    fn magnitude() -> impl Strategy<Value = f64> {
        prop_oneof![Just(0.0), Just(1.0), Just(f64::MAX), (-320.0..308.2).prop_map(|exponent| 10f64.powf(exponent))]
    }

    #[test]
    fn no_index_at_all_reflects_everything() {
        for c in [0.0, 1e-200, 0.3, 1.0] {
            assert_eq!(conductor(0.0, 0.0, CosTheta::new(c)), 1.0, "{c}");
        }
        assert_eq!(conductor(1e200, 1e200, CosTheta::new(0.5)), 1.0);
        assert!(
            conductor(f64::NAN, 1.0, CosTheta::FACING).is_nan() && conductor(1.0, f64::NAN, CosTheta::MAX).is_nan()
        );
    }

    #[test]
    fn grazing_is_total() {
        for (n, k) in [(1.0, 0.0), (0.2, 3.0), (0.0, 5.0), (1.5, 0.0)] {
            assert_eq!(conductor(n, k, CosTheta::GRAZING), 1.0);
        }
    }

    #[test]
    fn air_in_air_is_invisible() {
        assert!(conductor(1.0, 0.0, CosTheta::new(0.3)) < 1e-30);
    }
}
