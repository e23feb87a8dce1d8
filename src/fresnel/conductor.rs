//! The exact Fresnel reflectance of a conductor in air.

use super::CosTheta;

/// Unpolarised reflectance for the complex index n + i k, air outside (Born & Wolf 1999, section 14.2).
///
/// n ≥ 0 and k ≥ 0 with n + k > 0. For k = 0 it is the dielectric, including total reflection for n < 1.
/// Written without the cancellations of the usual form: the small part of the root comes from `n k`
/// instead of a difference of near-equals, and both polarisations are quotients of sums of squares.
pub fn conductor(n: f64, k: f64, cos_theta: CosTheta) -> f64 {
    let c = cos_theta.get();
    if c == 0.0 {
        return 1.0;
    }
    let c2 = c * c;
    let sin2 = 1.0 - c2;
    let Root { a, b } = Root::of(n * n - k * k - sin2, n * k);
    let s = squared(a - c, b) / squared(a + c, b);
    // ε c with ε = (a + i b)² + sin²θ; r_p = (ε c − (a + i b)) / (ε c + (a + i b)).
    let (re, im) = (((n - k) * (n + k)) * c, 2.0 * n * k * c);
    let p = squared(re - a, im - b) / squared(re + a, im + b);
    0.5 * (s + p)
}

/// √(ε − sin²θ) = a + i b.
struct Root {
    a: f64,
    b: f64,
}

impl Root {
    /// The root of t0 + 2 i nk, each part from the sum that does not cancel.
    fn of(t0: f64, nk: f64) -> Self {
        let modulus = t0.hypot(2.0 * nk);
        let large = ((modulus + t0.abs()) / 2.0).sqrt();
        let small = if large > 0.0 { nk / large } else { 0.0 };
        if t0 < 0.0 { Self { a: small, b: large } } else { Self { a: large, b: small } }
    }
}

fn squared(re: f64, im: f64) -> f64 {
    re * re + im * im
}

/// r at normal incidence, ((n − 1)² + k²) / ((n + 1)² + k²).
pub fn normal_reflectance(n: f64, k: f64) -> f64 {
    squared(n - 1.0, k) / squared(n + 1.0, k)
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

        #[test]
        fn faces_at_the_normal_reflectance(n in 0.01..10.0, k in 0.0..20.0) {
            prop_assert!((conductor(n, k, CosTheta::FACING) - normal_reflectance(n, k)).abs() < 1e-13);
        }
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
