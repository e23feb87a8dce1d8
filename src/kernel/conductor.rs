//! The exact Fresnel reflectance of a conductor, with one division and no cancellation.
//!
//! With ε − sin²θ = e + 2 i n k of modulus z, whose root a + i b has the larger part q, and t1 = (z + c²) q,
//! t3 = (z c² + s⁴) q, T = 2 c a q: F = (t1 − T) t3 / ((t1 + T)(t3 + T s²)), and 1 − F = T (2 t3 + s² (t1 + T)) over
//! the same, a sum of what is positive. It rests on 1 + (t3 − t4)/(t3 + t4) = 2 t3/(t3 + t4), which saves a division,
//! and on everything being multiplied by q, so that a = n k/b needs none either: a q is the larger of a b = n k and
//! a² = (z + e)/2. Where e is negative and a² cancels, it is taken a little too small, so that n k is the larger.
//!
//! z, e, c² and s⁴ are halved, which is exact and saves two products; c3 = 1/max(1, n, k) keeps all in 32 bits. For
//! n² − k² < 1/2, e is taken as (n² − k²) − sin²θ: next to n = k = 0 the other sum, (n² − k² − 1) + c², cancels.

use super::{Form, Material, Real};
use crate::color::Rgb;
use crate::fresnel::{Nk, nk_from_r_g};

/// The largest n or k: beyond it the fourth power leaves 32 bits. F is 1 there but for a hair's breadth of grazing.
const LARGEST: f64 = 1e9;

/// F of one material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor;

/// F and 1 − F of one material: what fifty bounces or a plot near 90° need, where a difference is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConductorAndAbsorption;

impl Conductor {
    /// n and k of each channel; negative ones are held at 0, those beyond 1e9 there.
    pub fn material(n: Rgb, k: Rgb) -> Material<Self, 6> {
        Material::new(Self, std::array::from_fn(|i| constants(n[i], k[i])))
    }

    /// The conductor that r and g stand for: r is held in 0 to 1 and g in 0 to 1, and r = 1 is a mirror.
    pub fn gulbrandsen(r: Rgb, g: Rgb) -> Material<Self, 6> {
        Material::new(Self, std::array::from_fn(|i| constants_of_r_g(r[i], g[i])))
    }
}

impl ConductorAndAbsorption {
    /// n and k of each channel; negative ones are held at 0, those beyond 1e9 there.
    pub fn material(n: Rgb, k: Rgb) -> Material<Self, 6, 2> {
        Material::new(Self, std::array::from_fn(|i| constants(n[i], k[i])))
    }
}

/// Half of n² − k² or of n² − k² − 1, how often c² and sin² are to be added to that, (n k)², n k and c3 of an index; no
/// index at all, n = k = 0, is a mirror as in [`crate::fresnel::conductor`].
pub(super) fn constants(n: f64, k: f64) -> [f64; 6] {
    let (n, k) = (n.clamp(0.0, LARGEST), k.clamp(0.0, LARGEST));
    if n == 0.0 && k == 0.0 {
        return MIRROR;
    }
    let c3 = 1.0 / n.max(k).max(1.0);
    let real = (n - k) * (n + k);
    let (base, of_c2, of_s2) = if real < 0.5 { (real, 0.0, -1.0) } else { ((n - 1.0) * (n + 1.0) - k * k, 1.0, 0.0) };
    [0.5 * base, of_c2, of_s2, (n * k).powi(2).max(NO_ZERO), n * k, c3]
}

/// The least (n k)². It keeps z from 0, so that air in air at 90° and the critical angle are no 0/0, and is too small
/// to be seen in any sum of 32 bits.
const NO_ZERO: f64 = 1e-36;

/// n = 0 and k = 1: F is 1 at every angle.
const MIRROR: [f64; 6] = [-0.5, 0.0, -1.0, NO_ZERO, 0.0, 1.0];

fn constants_of_r_g(r: f64, g: f64) -> [f64; 6] {
    if r.is_nan() || g.is_nan() {
        return [f64::NAN; 6];
    }
    nk_from_r_g(r.max(0.0), g.clamp(0.0, 1.0)).map_or(MIRROR, |Nk { n, k }| constants(n, k))
}

/// c, c² and sin², and halves of them and of sin⁴.
#[derive(Clone, Copy, Debug)]
pub struct Angle<T> {
    c: T,
    c2: T,
    s2: T,
    half_c2: T,
    half_s2: T,
    half_s4: T,
}

impl<T: Real> Angle<T> {
    #[inline(always)]
    pub(super) fn of(c: T) -> Self {
        let (one, half) = (c.of(1.0), c.of(0.5));
        let (c2, s2) = (c * c, sine_squared(c, one));
        let half_s2 = s2 * half;
        Self { c, c2, s2, half_c2: c2 * half, half_s2, half_s4: s2 * half_s2 }
    }

    /// The parts that F and 1 − F are made of, from the constants of an index.
    #[inline(always)]
    pub(super) fn parts(self, [base, of_c2, of_s2, nk2, nk, c3]: [T; 6]) -> Parts<T> {
        let real = of_c2.mul_add(self.half_c2, of_s2.mul_add(self.half_s2, base));
        self.parts_of(real, nk2, nk, c3)
    }

    /// The same from half of e and the rest of the constants.
    #[inline(always)]
    fn parts_of(self, real: T, nk2: T, nk: T, c3: T) -> Parts<T> {
        let z = real.mul_add(real, nk2).sqrt();
        let q = (z + real.abs()).sqrt() * c3;
        // A unit in the last place more of a negative part than rounding can have put into z.
        let aq = real.mul_add(real.above_one(), z).larger(nk);
        let t = self.c * c3 * aq;
        let t1 = (z + self.half_c2) * q;
        let t3 = z.mul_add(self.c2, self.half_s4) * q;
        Parts { t, t1, t3, s2: self.s2 }
    }
}

/// sin² of the angle with cosine c, without cancellation at 0°.
#[inline(always)]
fn sine_squared<T: Real>(c: T, one: T) -> T {
    (one - c) * (one + c)
}

/// See the head of this file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts<T> {
    t: T,
    t1: T,
    t3: T,
    s2: T,
}

impl<T: Real> Parts<T> {
    #[inline(always)]
    pub(super) fn reflectance(self) -> T {
        (self.t1 - self.t) * self.t3 / ((self.t1 + self.t) * self.t.mul_add(self.s2, self.t3))
    }

    #[inline(always)]
    fn reflectance_and_absorption(self) -> [T; 2] {
        let sum = self.t1 + self.t;
        let share = self.t.of(1.0) / (sum * self.t.mul_add(self.s2, self.t3));
        [(self.t1 - self.t) * self.t3 * share, self.t * (self.s2.mul_add(sum, self.t3 + self.t3)) * share]
    }
}

impl Form<6> for Conductor {
    type Shared<T: Real> = Angle<T>;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> Angle<T> {
        Angle::of(c)
    }

    #[inline(always)]
    fn channel<T: Real>(self, angle: Angle<T>, constants: [T; 6]) -> [T; 1] {
        [angle.parts(constants).reflectance()]
    }
}

impl Form<6, 2> for ConductorAndAbsorption {
    type Shared<T: Real> = Angle<T>;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> Angle<T> {
        Angle::of(c)
    }

    #[inline(always)]
    fn channel<T: Real>(self, angle: Angle<T>, constants: [T; 6]) -> [T; 2] {
        angle.parts(constants).reflectance_and_absorption()
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
        [angle.of_pixel((n - one) * (n + one) - k * k, n * k, one)]
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
        [angle.of_pixel(c0, n * k, u)]
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

impl<T: Real> Angle<T> {
    /// F of an index, by any c3 with which n c3 and k c3 are about 1 where n or k is large: no division for it.
    #[inline(always)]
    fn of_pixel(self, c0: T, nk: T, c3: T) -> T {
        let real = c0.mul_add(c0.of(0.5), self.half_c2);
        self.parts_of(real, nk.mul_add(nk, nk.of(NO_ZERO)), nk, c3).reflectance()
    }
}

/// F of one dielectric, k = 0, where the conductor's form keeps only an absolute error: from n² − 1.
///
/// Total reflection for n < 1 beyond the critical angle, F = 1; air in air, n = 1, has F = 0 also at 90°.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric;

impl Dielectric {
    /// n of each channel; negative ones are held at 0, those beyond 1e9 there.
    pub fn material(n: Rgb) -> Material<Self, 1> {
        Material::new(
            Self,
            n.0.map(|n| {
                let n = n.clamp(0.0, LARGEST);
                [(n - 1.0) * (n + 1.0)]
            }),
        )
    }
}

impl Form<1> for Dielectric {
    type Shared<T: Real> = (T, T);

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> (T, T) {
        (c, sine_squared(c, c.of(1.0)))
    }

    #[inline(always)]
    fn channel<T: Real>(self, (c, s2): (T, T), [e]: [T; 1]) -> [T; 1] {
        let (one, no_zero) = (c.of(1.0), c.of(NO_ZERO));
        let square = c.mul_add(c, e);
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
