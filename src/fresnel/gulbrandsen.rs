//! Gulbrandsen's (r, g): edge tint as a user interface over n and k.

use super::CosTheta;
use super::conductor::{conductor, normal_reflectance};
use super::conductor_over::conductor_over_angles;

/// Complex index n + i k of one channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nk {
    /// Refractive index.
    pub n: f64,
    /// Extinction coefficient.
    pub k: f64,
}

/// The largest r of MaterialX's `artistic_ior` node, on which standard_surface builds: whatever is above is clipped.
pub const ARTISTIC_IOR_MAX_R: f64 = 0.99;

/// n and k of a reflectance r and edge tint g (Gulbrandsen 2014, eqs. 6 and 8, in a form that does not cancel).
///
/// 0 ≤ r < 1 and 0 ≤ g ≤ 1; `None` outside: r = 1 is a true singularity, and g outside makes k imaginary.
/// With s = √r, u = (1 − r)/(1 + s) and w = g/(1 + r): n = g (1 − r)/(1 + r) + (1 − g)(1 + s)/u and
/// k = (2 s/u) √(w (2 (1 − g) + w u²)), from k² = (n_max − n)(n − 1/n_max).
pub fn nk_from_r_g(r: f64, g: f64) -> Option<Nk> {
    if !((0.0..1.0).contains(&r) && (0.0..=1.0).contains(&g)) {
        return None;
    }
    let s = r.sqrt();
    let u = (1.0 - r) / (1.0 + s);
    let w = g / (1.0 + r);
    let n = g * (1.0 - r) / (1.0 + r) + (1.0 - g) * (1.0 + s) / u;
    let k = 2.0 * s / u * (w * (2.0 * (1.0 - g) + w * u * u)).sqrt();
    Some(Nk { n, k })
}

/// r and g of a complex index: g = (n_max − n)/(n_max − n_min) (Gulbrandsen 2014, eqs. 5 and 7).
///
/// Finite n ≥ 0, k ≥ 0. g is not clamped: it leaves `[0, 1]` by rounding at k = 0, and exceeds 1 for |n + i k| < 1, as
/// in the alkali metals, because (1 − r)/(1 + r) is not the smallest n there is. r = 0 (n = 1, k = 0) has g = 0.
/// With d = |n + 1 + i k|, 1 − r = 4 n/d², so n/n_max = m² with m = 2 n/((1 + √r) d), and
/// n_min/n_max = 4 m²/((1 + r) d²): g = (1 − m²)/(1 − n_min/n_max) is a number where r rounds to 1 as well, where
/// n_max has none. There (r, g) no longer tells n and k, and stands for a mirror; n = 0 has g = 1.
pub fn r_g_from_nk(Nk { n, k }: Nk) -> (f64, f64) {
    let r = normal_reflectance(n, k);
    // Halves, so that d is a number for the largest n and k too.
    let half_d = (0.5 * n + 0.5).hypot(0.5 * k);
    let m = n / half_d / (1.0 + r.sqrt());
    let range = 1.0 - (m / half_d).powi(2) / (1.0 + r);
    (r, if range > 0.0 { (1.0 - m) * (1.0 + m) / range } else { 0.0 })
}

/// The conductor that (r, g) stands for; NaN where it stands for none.
///
/// For r = 1 every g means a perfect mirror, so F = 1.
pub fn gulbrandsen(r: f64, g: f64, cos_theta: CosTheta) -> f64 {
    if r == 1.0 && (0.0..=1.0).contains(&g) {
        return 1.0;
    }
    nk_from_r_g(r, g).map_or(f64::NAN, |Nk { n, k }| conductor(n, k, cos_theta))
}

/// [`gulbrandsen`] at each angle; the shorter slice ends it.
pub fn gulbrandsen_over_angles(r: f64, g: f64, cosines: &[CosTheta], out: &mut [f64]) {
    match nk_from_r_g(r, g) {
        Some(nk) => conductor_over_angles(nk, cosines, out),
        None => out.iter_mut().zip(cosines).for_each(|(f, c)| *f = gulbrandsen(r, g, *c)),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn inverts(r in 0.001..0.999, g in 0.001..0.999) {
            let (r_back, g_back) = r_g_from_nk(nk_from_r_g(r, g).unwrap());
            prop_assert!((r_back - r).abs() < 1e-11, "{r_back}");
            prop_assert!((g_back - g).abs() < 1e-8, "{g_back}");
        }

        #[test]
        fn every_index_has_a_g(n in magnitude(), k in magnitude()) {
            let (r, g) = r_g_from_nk(Nk { n, k });
            prop_assert!((0.0..=1.0).contains(&r) && g.is_finite(), "{r} {g}");
        }

        #[test]
        fn faces_at_r(r in 0.0..0.9999, g in 0.0..=1.0) {
            prop_assert!((gulbrandsen(r, g, CosTheta::FACING) - r).abs() < 1e-12);
        }

        #[test]
        fn no_tint_is_a_dielectric(r in 0.0..0.999) {
            prop_assert_eq!(nk_from_r_g(r, 0.0).unwrap().k, 0.0);
        }
    }

    /// Gold as MaterialX ships it; r and g by Gulbrandsen's eqs. 5 and 7, computed independently.
    #[test]
    fn materialx_gold() {
        let gold = [(0.183, 3.424, 0.9442, 0.9978), (0.421, 2.346, 0.7762, 0.9812), (1.373, 1.770, 0.3733, 0.7513)];
        for (n, k, r_want, g_want) in gold {
            let (r, g) = r_g_from_nk(Nk { n, k });
            assert!((r - r_want).abs() < 1e-4 && (g - g_want).abs() < 1e-4, "{r} {g}");
        }
    }

    /// Caesium near 450 nm (Smith 1970): |n + i k| < 1.
    #[test]
    fn alkali_metals_exceed_the_range_of_g() {
        let (r, g) = r_g_from_nk(Nk { n: 0.327, k: 0.608 });
        assert!(g > 1.0 && g < 1.2, "{g}");
        assert_eq!(nk_from_r_g(r, g), None);
    }

    fn magnitude() -> impl Strategy<Value = f64> {
        prop_oneof![Just(0.0), Just(1.0), Just(f64::MAX), (-320.0..308.2).prop_map(|exponent| 10f64.powf(exponent))]
    }

    /// The limits of g = 1 − n²/((n + 1)² + k²) where r rounds to 1.
    #[test]
    fn a_mirror_to_rounding_has_a_g() {
        for (n, k, g_want) in [(1e-17, 3.0, 1.0), (1.0, 1e9, 1.0), (1e18, 1e18, 0.5), (1e300, 3e300, 0.9)] {
            let (r, g) = r_g_from_nk(Nk { n, k });
            assert!(r == 1.0 && (g - g_want).abs() < 1e-12, "{n} {k}: {r} {g}");
        }
    }

    #[test]
    fn no_index_is_a_mirror_without_dip() {
        assert_eq!(r_g_from_nk(Nk { n: 0.0, k: 1.3 }), (1.0, 1.0));
    }

    #[test]
    fn says_where_it_has_no_answer() {
        for (r, g) in [(1.0, 0.5), (1.02, 0.5), (-0.1, 0.5), (0.5, 1.1), (0.5, -0.1), (f64::NAN, 0.5), (0.5, f64::NAN)]
        {
            assert_eq!(nk_from_r_g(r, g), None, "{r} {g}");
        }
        assert!(gulbrandsen(1.02, 0.5, CosTheta::MAX).is_nan());
        assert_eq!(gulbrandsen(1.0, 0.5, CosTheta::MAX), 1.0);
    }

    #[test]
    fn a_curve_is_its_values() {
        let cosines = [CosTheta::FACING, CosTheta::MAX, CosTheta::GRAZING];
        for (r, g) in [(0.0, 0.5), (0.7, 0.3), (0.9, 1.0), (1.0, 0.2), (1.02, 0.5), (0.5, f64::NAN)] {
            let mut curve = [0.0; 3];
            gulbrandsen_over_angles(r, g, &cosines, &mut curve);
            let alone = cosines.map(|c| gulbrandsen(r, g, c));
            assert_eq!(curve.map(f64::to_bits), alone.map(f64::to_bits), "{r} {g}");
        }
    }
}
