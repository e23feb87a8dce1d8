//! Lazányi's error term and the generalized Schlick curve, as in [`crate::fresnel`].

use super::{Form, Material, Real, held};
use crate::color::Rgb;
use crate::fresnel::{COS_THETA_MAX, PEAK_GAIN};

/// r + x⁵ (1 − r) − a c x^α; α > 0 is shared by the channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lazanyi {
    alpha: f64,
}

impl Lazanyi {
    /// The curve of one material. Values beyond ±1e30 are held there.
    pub fn material(r: Rgb, a: Rgb, alpha: f64) -> Material<Self, 3> {
        Material::new(Self { alpha }, std::array::from_fn(|i| [held(r[i]), 1.0 - held(r[i]), -held(a[i])]))
    }
}

impl Form<3> for Lazanyi {
    type Shared<T: Real> = (T, T);

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> (T, T) {
        let x = c.of(1.0) - c;
        (x.fifth_power(), c * x.power(self.alpha))
    }

    #[inline(always)]
    fn channel<T: Real>(self, (x5, bump): (T, T), [r, white_minus_r, minus_a]: [T; 3]) -> [T; 1] {
        [bump.mul_add(minus_a, x5.mul_add(white_minus_r, r))]
    }
}

/// r0 + (r90 − r0) x^p − a c x⁶; p > 0 is shared by the channels. p = 5 is multiplied out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneralizedSchlick {
    exponent: f64,
}

impl GeneralizedSchlick {
    /// The curve of one material. Values beyond ±1e15 are held there.
    pub fn material(r0: Rgb, t: Rgb, r90: Rgb, p: f64) -> Material<Self, 3> {
        let channel = |i: usize| {
            let [r0, t, r90] = [r0[i], t[i], r90[i]].map(|value| value.clamp(-1e15, 1e15));
            let at_max = r0 + (r90 - r0) * (1.0 - COS_THETA_MAX).powf(p);
            [r0, r90 - r0, -at_max * (1.0 - t) * PEAK_GAIN]
        };
        Material::new(Self { exponent: p }, std::array::from_fn(channel))
    }
}

impl Form<3> for GeneralizedSchlick {
    type Shared<T: Real> = (T, T);

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> (T, T) {
        let x = c.of(1.0) - c;
        let x5 = x.fifth_power();
        let power = if self.exponent == 5.0 { x5 } else { x.power(self.exponent) };
        (power, c * x * x5)
    }

    #[inline(always)]
    fn channel<T: Real>(self, (power, bump): (T, T), [r0, rise, minus_a]: [T; 3]) -> [T; 1] {
        [bump.mul_add(minus_a, power.mul_add(rise, r0))]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::{CosTheta, generalized_schlick, lazanyi};
    use crate::kernel::test_support::{distance, finite};

    proptest! {
        #[test]
        fn is_the_core(r in 0.0..=1.0, a in -2.0..4.0, alpha in 0.5..12.0) {
            let curve = Lazanyi::material(Rgb::splat(r), Rgb::splat(a), alpha);
            let off = distance(&curve, |_, c| lazanyi(r, a, alpha, CosTheta::new(c)));
            prop_assert!(off <= 2e-6, "{off}");
        }

        #[test]
        fn the_generalized_one_is_the_core(
            r0 in 0.0..=1.0, t in 0.0..=1.0, r90 in 0.0..=1.0, p in prop_oneof![Just(5.0), 0.5..12.0],
        ) {
            let curve = GeneralizedSchlick::material(Rgb::splat(r0), Rgb::splat(t), Rgb::splat(r90), p);
            let off = distance(&curve, |_, c| generalized_schlick(r0, t, r90, p, CosTheta::new(c)));
            prop_assert!(off <= 2e-6, "{off}");
        }

        #[test]
        fn both_are_total(x in finite(), y in finite(), c in finite(), p in 0.1..60.0) {
            let (x, y) = (Rgb::splat(f64::from(x)), Rgb::splat(f64::from(y)));
            let one = Rgb::WHITE;
            for curve in [Lazanyi::material(x, y, p).at(c), GeneralizedSchlick::material(x, y, one, p).at(c)] {
                prop_assert!(curve[0].iter().all(|f| f.is_finite()), "{curve:?}");
            }
        }
    }
}
