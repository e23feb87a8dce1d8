//! One metal baked into ten coefficients per channel on top of Schlick.

use super::{Form, Material, Real, held};
use crate::color::Rgb;

/// How many coefficients each channel has.
pub const COEFFICIENTS: usize = 10;

/// r + x⁵ (1 − r) + c x P(x) with P of degree 9: exact facing and grazing for any coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polynomial;

impl Polynomial {
    /// r and the coefficients of P of each channel, the constant one first. Values beyond ±1e30 are held there.
    pub fn material(r: Rgb, coefficients: [Rgb; COEFFICIENTS]) -> Material<Self, 12> {
        let channel = |i: usize| {
            let mut constants = [held(r[i]); 12];
            constants[1] = 1.0 - held(r[i]);
            for (constant, coefficient) in constants[2..].iter_mut().zip(coefficients) {
                *constant = held(coefficient[i]);
            }
            constants
        };
        Material::new(Self, std::array::from_fn(channel))
    }
}

/// x, x⁵ and c x.
#[derive(Clone, Copy, Debug)]
pub struct Powers<T> {
    x: T,
    x5: T,
    cx: T,
}

impl Form<12> for Polynomial {
    type Shared<T: Real> = Powers<T>;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> Powers<T> {
        let x = c.of(1.0) - c;
        Powers { x, x5: x.fifth_power(), cx: c * x }
    }

    #[inline(always)]
    fn channel<T: Real>(self, Powers { x, x5, cx }: Powers<T>, constants: [T; 12]) -> [T; 1] {
        let [r, white_minus_r, p0, p1, p2, p3, p4, p5, p6, p7, p8, p9] = constants;
        let inner = p9.mul_add(x, p8).mul_add(x, p7).mul_add(x, p6).mul_add(x, p5);
        let outer = inner.mul_add(x, p4).mul_add(x, p3).mul_add(x, p2).mul_add(x, p1).mul_add(x, p0);
        [cx.mul_add(outer, x5.mul_add(white_minus_r, r))]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::{CosTheta, schlick};
    use crate::kernel::test_support::{distance, finite};

    proptest! {
        #[test]
        fn is_its_sum(r in 0.0..=1.0, p in prop::array::uniform10(-1.0..1.0)) {
            let curve = Polynomial::material(Rgb::splat(r), p.map(Rgb::splat));
            let off = distance(&curve, |_, c| {
                let x = 1.0 - c;
                let sum: f64 = (0..).zip(p).map(|(power, p)| p * x.powi(power)).sum();
                schlick(r, CosTheta::new(c)) + c * x * sum
            });
            prop_assert!(off <= 2e-6, "{off}");
        }

        #[test]
        fn is_total(r in finite(), p in finite(), c in finite()) {
            let (r, p) = (Rgb::splat(f64::from(r)), Rgb::splat(f64::from(p)));
            prop_assert!(Polynomial::material(r, [p; 10]).at(c)[0].iter().all(|f| f.is_finite()));
        }
    }
}
