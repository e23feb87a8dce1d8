//! Exact reflectance of a conductor and of a dielectric, and what a conductor absorbs.

use super::index::{
    Angle, AnyIndex, Constants, Index as _, LARGEST, MIRROR, Metal, Modulus, NO_ZERO, are_of_metal, constants,
    constants_of_metal, sine_squared,
};
use super::{Form, Material, Real};
use crate::color::Rgb;
use crate::fresnel::{Nk, nk_from_r_g};

/// F of one material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    is_metal: bool,
}

/// F and 1 − F of one material: what fifty bounces or a plot near 90° need, where a difference is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConductorAndAbsorption {
    is_metal: bool,
}

impl Conductor {
    /// For any index: what a shader that does not know its n and k computes.
    pub const OF_ANY_INDEX: Self = Self { is_metal: false };

    /// n and k of each channel; negative ones are held at 0, those beyond 1e9 there.
    pub fn material(n: Rgb, k: Rgb) -> Material<Self, 6> {
        Self::with(std::array::from_fn(|i| constants(n[i], k[i])))
    }

    /// The conductor that r and g stand for: r is held in 0 to 1 and g in 0 to 1, and r = 1 is a mirror.
    pub fn gulbrandsen(r: Rgb, g: Rgb) -> Material<Self, 6> {
        Self::with(std::array::from_fn(|i| constants_of_r_g(r[i], g[i])))
    }

    fn with(channels: [Constants<f64>; 3]) -> Material<Self, 6> {
        Material::new(Self { is_metal: channels.iter().all(are_of_metal) }, channels)
    }
}

impl ConductorAndAbsorption {
    /// n and k of each channel; negative ones are held at 0, those beyond 1e9 there.
    pub fn material(n: Rgb, k: Rgb) -> Material<Self, 6, 2> {
        let channels = std::array::from_fn(|i| constants(n[i], k[i]));
        Material::new(Self { is_metal: channels.iter().all(are_of_metal) }, channels)
    }
}

fn constants_of_r_g(r: f64, g: f64) -> [f64; 6] {
    if r.is_nan() || g.is_nan() {
        return [f64::NAN; 6];
    }
    nk_from_r_g(r.max(0.0), g.clamp(0.0, 1.0)).map_or(MIRROR, |Nk { n, k }| constants(n, k))
}

impl Form<6> for Conductor {
    type Shared<T: Real> = Angle<T>;

    #[inline(always)]
    fn decided<R>(self, run: impl FnOnce(Self) -> R) -> R {
        if self.is_metal { run(Self { is_metal: true }) } else { run(Self { is_metal: false }) }
    }

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> Angle<T> {
        Angle::of(c)
    }

    #[inline(always)]
    fn channel<T: Real>(self, angle: Angle<T>, constants: Constants<T>) -> [T; 1] {
        let parts = if self.is_metal {
            Metal::of(constants_of_metal(constants)).parts_at(angle)
        } else {
            AnyIndex::of(constants).parts_at(angle)
        };
        [parts.reflectance()]
    }
}

impl Form<6, 2> for ConductorAndAbsorption {
    /// The angle, and for metals c² sin².
    type Shared<T: Real> = (Angle<T>, Option<T>);

    #[inline(always)]
    fn decided<R>(self, run: impl FnOnce(Self) -> R) -> R {
        if self.is_metal { run(Self { is_metal: true }) } else { run(Self { is_metal: false }) }
    }

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> (Angle<T>, Option<T>) {
        let angle = Angle::of(c);
        (angle, if self.is_metal { Some(angle.c2_s2()) } else { None })
    }

    #[inline(always)]
    fn channel<T: Real>(self, (angle, of_metal): (Angle<T>, Option<T>), constants: Constants<T>) -> [T; 2] {
        match of_metal {
            Some(c2_s2) => Metal::of(constants_of_metal(constants)).reflectance_and_absorption(angle, c2_s2),
            None => AnyIndex::of(constants).parts_at(angle).reflectance_and_absorption(),
        }
    }
}

/// F of n and k from a texture. Negative ones are held at 0, those beyond 1e6 there, where c3 = 1 still does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConductorOfPixels;

impl Form<2> for ConductorOfPixels {
    type Shared<T: Real> = Angle<T>;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> Angle<T> {
        Angle::of(c)
    }

    #[inline(always)]
    fn channel<T: Real>(self, angle: Angle<T>, parameters: [T; 2]) -> [T; 1] {
        let [n, k] = parameters.map(
            #[inline(always)]
            |value| value.limited(0.0, 1e6),
        );
        let one = n.of(1.0);
        [of_pixel(angle, (n - one) * (n + one) - k * k, n * k, one)]
    }
}

/// F of r and g from a texture: r is held in 0 to 1 − 2⁻²⁴, g in 0 to 1.
///
/// k² = (n_max − n)(n − 1/n_max), so that with s = √r, u = (1 − r)/(1 + s) and w = g/(1 + r) neither n, k nor
/// c0 = 2 n (n − (1 + r)/(1 − r)) is a difference of near-equals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GulbrandsenOfPixels;

impl Form<2> for GulbrandsenOfPixels {
    type Shared<T: Real> = Angle<T>;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> Angle<T> {
        Angle::of(c)
    }

    #[inline(always)]
    fn channel<T: Real>(self, angle: Angle<T>, [r, g]: [T; 2]) -> [T; 1] {
        let Index { n, k, c0, u } = Index::of_r_g(r, g);
        [of_pixel(angle, c0, n * k, u)]
    }
}

/// An index of r and g, with c0 = n² − k² − 1 and u = (1 − r)/(1 + √r), of which n and k are at most 4/u.
#[derive(Clone, Copy, Debug)]
pub(super) struct Index<T> {
    pub(super) n: T,
    pub(super) k: T,
    c0: T,
    u: T,
}

impl<T: Real> Index<T> {
    /// r and g are held as [`GulbrandsenOfPixels`] says.
    #[inline(always)]
    pub(super) fn of_r_g(r: T, g: T) -> Self {
        let (r, g) = (r.limited(0.0, 1.0 - 1.0 / f64::from(1 << 24)), g.limited(0.0, 1.0));
        let (one, two) = (r.of(1.0), r.of(2.0));
        let s = r.sqrt();
        let (below, above) = (one - r, one + r);
        let (u, of_u) = (below / (one + s), (one + s) / below);
        let w = g / above;
        let n = w.mul_add(below, (one - g) * (one + s) * of_u);
        let k = two * s * of_u * (w * w.mul_add(u * u, two * (one - g))).sqrt();
        Self { n, k, c0: two * n * (n - above / below), u }
    }
}

/// F of n² − k² − 1 and n k, by any c3 with which n c3 and k c3 are about 1 where n or k is large: no division for it.
#[inline(always)]
fn of_pixel<T: Real>(angle: Angle<T>, c0: T, nk: T, c3: T) -> T {
    let e = c0.mul_add(c0.of(0.5), angle.half_c2);
    Modulus::of(e, nk.mul_add(nk, nk.of(NO_ZERO))).root(nk, c3).parts(angle, c3).reflectance()
}

/// F of one dielectric, k = 0, where the conductor's form keeps only an absolute error: from n² − 1. The square of what
/// Snell's law makes of c is n² − sin² for n² < 1/2 and (n² − 1) + c² else, so that neither cancels at the critical angle.
///
/// Total reflection for n < 1 beyond the critical angle, F = 1; air in air, n = 1, has F = 0 also at 90°.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric;

impl Dielectric {
    /// n of each channel; negative ones are held at 0, those beyond 1e9 there.
    pub fn material(n: Rgb) -> Material<Self, 4> {
        Material::new(Self, n.0.map(constants_of_dielectric))
    }
}

/// n² − 1, what the square begins with, and how often c and sin² are in it.
fn constants_of_dielectric(n: f64) -> [f64; 4] {
    let n = n.clamp(0.0, LARGEST);
    let e = (n - 1.0) * (n + 1.0);
    if n * n < 0.5 { [e, n * n, 0.0, -1.0] } else { [e, e, 1.0, 0.0] }
}

impl Form<4> for Dielectric {
    type Shared<T: Real> = (T, T);

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> (T, T) {
        (c, sine_squared(c, c.of(1.0)))
    }

    #[inline(always)]
    fn channel<T: Real>(self, (c, s2): (T, T), [e, base, of_c, of_s2]: [T; 4]) -> [T; 1] {
        let (one, no_zero) = (c.of(1.0), c.of(NO_ZERO));
        let square = (of_c * c).mul_add(c, of_s2.mul_add(s2, base));
        let g = square.abs().sqrt();
        let (sum, gc) = (g + c, g * c);
        let s = e / sum.mul_add(sum, no_zero);
        let p = (gc - s2) / (gc + s2 + no_zero);
        let reflectance = c.of(0.5) * s * s * p.mul_add(p, one);
        [square.if_below(no_zero, one, reflectance)]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::{CosTheta, conductor};
    use crate::kernel::test_support::{distance, finite, results, ulps};
    use crate::kernel::{Level, Planes, over_pixels};

    /// One pixel of one material of two parameters.
    fn pixel<F: Form<2>>(form: F, x: f32, y: f32, c: f32) -> f32 {
        let (x, y) = ([x], [y]);
        let planes: Planes<'_, 2> = [[&x; 3], [&y; 3]];
        let mut out = [[f32::NAN; 1]; 3];
        over_pixels(form, Level::new(), (&[c], planes), [out.each_mut().map(|plane| &mut plane[..])]);
        out[0][0]
    }

    proptest! {
        #[test]
        fn is_the_core_within_two_millionths(n in 0.001..20.0, k in 0.0..20.0) {
            let off = distance(&Conductor::material(Rgb::splat(n), Rgb::splat(k)), |_, c| conductor(n, k, CosTheta::new(c)));
            prop_assert!(off <= 2e-6, "{off}");
        }

        #[test]
        fn pixels_are_the_core_within_two_millionths(n in 0.001..20.0_f32, k in 0.0..20.0_f32, c in 0.0..=1.0_f32) {
            let exact = conductor(f64::from(n), f64::from(k), CosTheta::new(f64::from(c)));
            let got = pixel(ConductorOfPixels, n, k, c);
            prop_assert!((f64::from(got) - exact).abs() <= 2e-6, "{got} {exact}");
        }

        #[test]
        fn pixels_of_r_and_g_are_the_core(r in 0.0..1.0_f32, g in 0.0..=1.0_f32, c in 0.0..=1.0_f32) {
            let exact = crate::fresnel::gulbrandsen(f64::from(r), f64::from(g), CosTheta::new(f64::from(c)));
            let got = pixel(GulbrandsenOfPixels, r, g, c);
            prop_assert!((f64::from(got) - exact).abs() <= 2e-6, "{got} {exact}");
        }

        #[test]
        fn f_and_what_is_absorbed_are_one(n in 0.001..20.0, k in 0.0..20.0, c in 0.0..=1.0_f32) {
            let [f, absorbed] = ConductorAndAbsorption::material(Rgb::splat(n), Rgb::splat(k)).at(c).map(|rgb| rgb[0]);
            prop_assert!((f + absorbed - 1.0).abs() <= 5e-7 && absorbed >= 0.0, "{f} {absorbed}");
        }

        /// The shorter form where k ≥ n in every channel, and the one for any index.
        #[test]
        fn both_forms_are_the_core(n in 0.001..20.0, k in 0.001..20.0, c in 0.0..=1.0_f32) {
            let exact = conductor(n, k, CosTheta::new(f64::from(c)));
            let metal = k >= n;
            // A channel of k < n makes the whole material one of any index.
            for other in [Rgb([n, n, n]), Rgb([n, n, 30.0])] {
                let of_one = Conductor::material(other, Rgb::splat(k));
                let of_both = ConductorAndAbsorption::material(other, Rgb::splat(k));
                prop_assert_eq!(of_one.form().is_metal, metal && other[2] == n);
                let [f, [also, ..], [absorbed, ..]] = [of_one.at(c)[0], of_both.at(c)[0], of_both.at(c)[1]];
                prop_assert!((f64::from(f[0]) - exact).abs() <= 2e-6 && (f64::from(also) - exact).abs() <= 2e-6);
                prop_assert!((f64::from(absorbed) - (1.0 - exact)).abs() <= 2e-6);
            }
        }

        /// Vectors of every instruction set, at every length of the loop.
        #[test]
        fn what_is_absorbed_keeps_its_digits(n in 0.05..5.0, k in 0.1..9.0, c in prop_oneof![0.0..=1.0_f32, 1e-7..1e-2_f32]) {
            let material = ConductorAndAbsorption::material(Rgb::splat(n), Rgb::splat(k));
            let exact = material.at(f64::from(c))[1][0];
            for level in crate::kernel::levels() {
                let got = f64::from(results(&material, level, &[c; 17])[1][0][16]);
                prop_assert!((got - exact).abs() <= 6e-7 * exact, "{level:?}: {got} {exact}");
            }
        }

        #[test]
        fn every_form_is_total(x in finite(), y in finite(), c in finite()) {
            let [n, k] = [x, y].map(|value| Rgb::splat(f64::from(value)));
            let [pair, absorbed] = ConductorAndAbsorption::material(n, k).at(c);
            let material = [Conductor::material(n, k).at(c), Conductor::gulbrandsen(n, k).at(c), Dielectric::material(n).at(c)];
            for f in [pair[0], absorbed[0], material[0][0][0], material[1][0][0], material[2][0][0]] {
                prop_assert!((-1e-6..=1.0 + 1e-6).contains(&f), "{f}");
            }
            for f in [pixel(ConductorOfPixels, x, y, c), pixel(GulbrandsenOfPixels, x, y, c)] {
                prop_assert!((-1e-6..=1.0 + 1e-6).contains(&f), "{f}");
            }
        }

        /// r from 0.04 to 1 − 1e-7, g from end to end.
        #[test]
        fn n_and_k_of_r_and_g_keep_their_digits(
            r in prop_oneof![0.04..0.99_f32, (-7.0..-2.0_f64).prop_map(|e| (1.0 - 10_f64.powf(e)) as f32)],
            g in prop_oneof![0.0..=1.0_f32, (-7.0..-2.0_f64).prop_map(|e| 10_f64.powf(e) as f32)],
        ) {
            let Nk { n, k } = nk_from_r_g(f64::from(r), f64::from(g)).unwrap();
            let Index { n: got_n, k: got_k, .. } = Index::of_r_g(r, g);
            prop_assert!((f64::from(got_n) / n - 1.0).abs() <= 4e-7, "{got_n} {n}");
            prop_assert!((f64::from(got_k) - k).abs() <= 4e-7 * k, "{got_k} {k}");
        }

        #[test]
        fn dielectrics_keep_ten_ulps(n in 1.0001..4.0, c in prop_oneof![1e-4..=1.0_f32, Just(1.0)]) {
            let exact = Dielectric::material(Rgb::splat(n)).at(f64::from(c))[0][0];
            prop_assert!((exact - conductor(n, 0.0, CosTheta::new(f64::from(c)))).abs() < 1e-12);
            let [[got, ..]] = Dielectric::material(Rgb::splat(n)).at(c);
            let [lanes] = &results(&Dielectric::material(Rgb::splat(n)), Level::new(), &[c])[..] else { panic!() };
            prop_assert!(ulps(got, exact) <= 10.0 && ulps(lanes[0][0], exact) <= 10.0, "{got} {exact}");
        }
    }

    #[test]
    fn where_an_index_or_r_is_no_number_neither_is_f() {
        let (one, nan) = (Rgb::WHITE, Rgb::splat(f64::NAN));
        for (x, y) in [(one, nan), (nan, one)] {
            let curves = [Conductor::material(x, y).at(0.5_f32), Conductor::gulbrandsen(x, y).at(0.5)];
            assert!(curves.as_flattened().as_flattened().iter().all(|f| f.is_nan()), "{curves:?}");
        }
        assert!(pixel(ConductorOfPixels, f32::NAN, 1.0, 0.5).is_nan());
        assert!(pixel(GulbrandsenOfPixels, 0.5, f32::NAN, 0.5).is_nan());
    }

    /// Both are rounded to 32 bits first; n² − 1 would be rounded to more than the square is.
    #[test]
    fn thin_dielectrics_reflect_all_beyond_their_critical_angle() {
        for n in [1e-4_f32, 3.16e-4, 0.01, 0.3, 0.7] {
            let critical = (1.0 - n * n).sqrt();
            for c in [critical - 4e-7, critical * 0.5, 0.0] {
                assert_eq!(Dielectric::material(Rgb::splat(n.into())).at(c)[0][0], 1.0, "{n} {c}");
            }
        }
    }

    #[test]
    fn a_mirror_and_air_are_what_they_are() {
        for c in [0.0_f32, 1e-7, 0.3, 1.0] {
            let [mirror, no_index, r_of_one] = [
                Conductor::material(Rgb::BLACK, Rgb::splat(3.0)),
                Conductor::material(Rgb::BLACK, Rgb::BLACK),
                Conductor::gulbrandsen(Rgb::WHITE, Rgb::splat(0.5)),
            ]
            .map(|material| material.at(c)[0][0]);
            assert!([mirror, no_index, r_of_one].iter().all(|f| (f - 1.0).abs() < 1e-6), "{c}");
            let dense = Conductor::material(Rgb::splat(1e30), Rgb::splat(1e30)).at(c)[0][0];
            assert!(c == 1e-7 || (dense - 1.0).abs() < 1e-6, "{c}: {dense}");
            let air = Conductor::material(Rgb::WHITE, Rgb::BLACK).at(c)[0][0];
            assert!(if c == 0.0 { air == 1.0 } else { air.abs() < 1e-6 }, "{c}: {air}");
        }
    }
}
