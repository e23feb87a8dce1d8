//! Hoffman's model, as in [`crate::fresnel::hoffman`], and F82-tint, which is the same curve.

use super::{Form, Material, Real, held};
use crate::color::Rgb;
use crate::fresnel::{PEAK_GAIN, SCHLICK_GAIN, SCHLICK_WEIGHT_AT_MAX, a_from_r_h, h_from_r_t};

/// r + x⁵ ((1 − r) − a c x) with a computed once: for one material of (r, h) or (r, t).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factored;

impl Factored {
    /// The curve of r and h. Values beyond ±1e30 are held there.
    pub fn hoffman(r: Rgb, h: Rgb) -> Material<Self, 3> {
        Self::material(r.map(held), r.zip(h, |r, h| a_from_r_h(held(r), held(h))))
    }

    /// The curve of r and t, with h = t · S(r, 1/7). Values beyond ±1e15 are held there.
    pub fn f82_tint(r: Rgb, t: Rgb) -> Material<Self, 3> {
        let held = |value: f64| value.clamp(-1e15, 1e15);
        let a = r.zip(t, |r, t| a_from_r_h(held(r), h_from_r_t(held(r), held(t))));
        Self::material(r.map(held), a)
    }

    fn material(r: Rgb, a: Rgb) -> Material<Self, 3> {
        Material::new(Self, std::array::from_fn(|i| [r[i], 1.0 - r[i], -a[i]]))
    }
}

impl Form<3> for Factored {
    const STEPS: usize = 4;

    type Shared<T: Real> = (T, T);

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> (T, T) {
        let x = c.of(1.0) - c;
        (x.fifth_power(), c * x)
    }

    #[inline(always)]
    fn channel<T: Real>(self, (x5, cx): (T, T), [r, white_minus_r, minus_a]: [T; 3]) -> [T; 1] {
        [x5.mul_add(cx.mul_add(minus_a, white_minus_r), r)]
    }
}

/// A r + B h + C: no `a` at any pixel, and the weights are shared by the channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Basis;

impl Basis {
    /// The curve of r and h. Values beyond ±1e30 are held there.
    pub fn material(r: Rgb, h: Rgb) -> Material<Self, 2> {
        Material::new(Self, std::array::from_fn(|i| [held(r[i]), held(h[i])]))
    }
}

impl Form<2> for Basis {
    const STEPS: usize = 4;

    const HOLDS_PIXELS: Option<f64> = Some(1e30);

    type Shared<T: Real> = [T; 3];

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> [T; 3] {
        let one = c.of(1.0);
        let x = one - c;
        let x5 = x.fifth_power();
        let peak = c * x * x5;
        let of_h = c.of(PEAK_GAIN) * peak;
        let of_white = peak.mul_add(c.of(-SCHLICK_GAIN), x5);
        [one - of_h - of_white, of_h, of_white]
    }

    #[inline(always)]
    fn channel<T: Real>(self, [of_r, of_h, of_white]: [T; 3], [r, h]: [T; 2]) -> [T; 1] {
        [of_r.mul_add(r, of_h.mul_add(h, of_white))]
    }
}

/// r + x⁵ ((1 − r) − a c x) with `a` from r and h at every evaluation: the function that is exported to shaders.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exported;

impl Form<2> for Exported {
    const HOLDS_PIXELS: Option<f64> = Some(1e30);

    type Shared<T: Real> = (T, T);

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> (T, T) {
        Factored.shared(c)
    }

    #[inline(always)]
    fn channel<T: Real>(self, (x5, cx): (T, T), [r, h]: [T; 2]) -> [T; 1] {
        let white_minus_r = r.of(1.0) - r;
        let a = r.of(PEAK_GAIN) * (r - h) + r.of(SCHLICK_GAIN) * white_minus_r;
        [r + x5 * (white_minus_r - cx * a)]
    }
}

/// F82-tint from r and t: `a` is 823543/46656 · S(r, 1/7) (1 − t) at every pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct F82OfPixels;

impl Form<2> for F82OfPixels {
    const HOLDS_PIXELS: Option<f64> = Some(1e15);

    type Shared<T: Real> = (T, T);

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> (T, T) {
        Factored.shared(c)
    }

    #[inline(always)]
    fn channel<T: Real>(self, (x5, cx): (T, T), [r, t]: [T; 2]) -> [T; 1] {
        let one = x5.of(1.0);
        let q = SCHLICK_WEIGHT_AT_MAX * PEAK_GAIN;
        let schlick = r.mul_add(x5.of(PEAK_GAIN - q), x5.of(q));
        let a = schlick * (one - t);
        [x5.mul_add((one - r) - a * cx, r)]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::{CosTheta, f82_tint, hoffman};
    use crate::kernel::test_support::{distance, finite};
    use crate::kernel::{Level, over_pixels};

    proptest! {
        #[test]
        fn is_the_core_within_a_millionth(
            r in prop::array::uniform3(0.0..=1.0), h in prop::array::uniform3(0.0..=1.0),
        ) {
            let core = |channel: usize, c| hoffman(r[channel], h[channel], CosTheta::new(c));
            for off in [
                distance(&Factored::hoffman(Rgb(r), Rgb(h)), core),
                distance(&Basis::material(Rgb(r), Rgb(h)), core),
                distance(&Factored::f82_tint(Rgb(r), Rgb(h)), |i, c| f82_tint(r[i], h[i], CosTheta::new(c))),
            ] {
                prop_assert!(off <= 1e-6, "{off}");
            }
        }

        #[test]
        fn is_total(r in finite(), h in finite(), c in finite()) {
            let (r, h) = (Rgb::splat(f64::from(r)), Rgb::splat(f64::from(h)));
            for curve in [Factored::hoffman(r, h).at(c), Factored::f82_tint(r, h).at(c), Basis::material(r, h).at(c)] {
                prop_assert!(curve[0].iter().all(|f| f.is_finite()), "{curve:?}");
            }
        }

        #[test]
        fn f82_of_pixels_is_the_core(r in 0.0..=1.0_f32, t in 0.0..=1.0_f32, c in 0.0..=1.0_f32) {
            let (r_row, t_row) = ([r; 3], [t; 3]);
            let mut out = [[0.0_f32; 3]; 3];
            let planes = [[&r_row[..]; 3], [&t_row[..]; 3]];
            over_pixels(F82OfPixels, Level::new(), (&[c; 3], planes), [out.each_mut().map(|plane| &mut plane[..])]);
            let exact = f82_tint(f64::from(r), f64::from(t), CosTheta::new(f64::from(c)));
            prop_assert!(out.iter().flatten().all(|f| (f64::from(*f) - exact).abs() <= 1e-6), "{out:?} {exact}");
        }
    }
}
