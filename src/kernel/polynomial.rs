//! One metal baked into a few coefficients per channel on top of Schlick.

use super::operations::Counted;
use super::{Form, Material, Operations, Real, held};
use crate::fresnel::SchlickSeries;

/// r + x⁵ (1 − r) + c xᵖ (b₀ + b₁ t + …), see [`SchlickSeries`]: exact facing and grazing for any coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polynomial {
    first_power: u32,
    bend: f64,
}

impl Polynomial {
    /// The curve of a series of P − 2 coefficients, at least 1; `None` for another number. Values beyond ±1e30 are held
    /// there, and β in 0 to 1e6.
    pub fn material<const P: usize>(series: &SchlickSeries) -> Option<Material<Self, P>> {
        let form = Self { first_power: series.first_power, bend: series.bend.clamp(0.0, 1e6) };
        let is_of_this_length = P > 2 && series.coefficients.len() == P - 2;
        let channel = |i: usize| {
            let r = held(series.r[i]);
            let mut constants = [r; P];
            constants[1] = 1.0 - r;
            for (constant, coefficient) in constants[2..].iter_mut().zip(&series.coefficients) {
                *constant = held(coefficient[i]);
            }
            constants
        };
        is_of_this_length.then(|| Material::new(form, std::array::from_fn(channel)))
    }

    /// Operations for one RGB value with so many coefficients, at least 1.
    pub fn operations_of(first_power: u32, bend: f64, count: usize) -> Operations {
        let constants = vec![Counted; count + 2];
        Operations::while_running(|| {
            let powers = Self { first_power, bend }.powers(Counted.limited(0.0, 1.0));
            for _ in 0..3 {
                powers.curve(&constants);
            }
        })
    }

    #[inline(always)]
    fn powers<T: Real>(self, c: T) -> Powers<T> {
        let x = c.of(1.0) - c;
        let x5 = x.fifth_power();
        let (mut bump, mut power) = (c * x, 1);
        if self.first_power >= 6 {
            (bump, power) = (bump * x5, 6);
        }
        while power < self.first_power {
            bump = bump * x;
            power += 1;
        }
        Powers { t: self.variable(c, x), x5, bump }
    }

    #[inline(always)]
    fn variable<T: Real>(self, c: T, x: T) -> T {
        if self.bend == 0.0 {
            return x - c;
        }
        let one = c.of(1.0);
        c.mul_add(c.of(-(2.0 + self.bend)), one) / c.mul_add(c.of(self.bend), one)
    }
}

/// t, x⁵ and c xᵖ.
#[derive(Clone, Copy, Debug)]
pub struct Powers<T> {
    t: T,
    x5: T,
    bump: T,
}

impl<T: Real> Powers<T> {
    /// One channel, of r, 1 − r and at least one coefficient.
    #[inline(always)]
    fn curve(self, constants: &[T]) -> T {
        let [r, white_minus_r, lower @ .., last] = constants else { return self.t };
        let mut sum = *last;
        for coefficient in lower.iter().rev() {
            sum = sum.mul_add(self.t, *coefficient);
        }
        self.bump.mul_add(sum, self.x5.mul_add(*white_minus_r, *r))
    }
}

impl<const P: usize> Form<P> for Polynomial {
    type Shared<T: Real> = Powers<T>;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> Powers<T> {
        self.powers(c)
    }

    #[inline(always)]
    fn channel<T: Real>(self, powers: Powers<T>, constants: [T; P]) -> [T; 1] {
        [powers.curve(&constants)]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::color::Rgb;
    use crate::kernel::test_support::{distance, finite};

    fn series(r: f64, (first_power, bend): (u32, f64), coefficients: &[f64]) -> SchlickSeries {
        let coefficients = coefficients.iter().map(|b| Rgb::splat(*b)).collect();
        SchlickSeries { r: Rgb::splat(r), first_power, bend, coefficients }
    }

    proptest! {
        #[test]
        fn is_the_core(
            r in 0.0..=1.0, b in prop::array::uniform10(-1.0..1.0), first_power in 1..9_u32,
            bend in prop_oneof![Just(0.0), 0.1..6.0],
        ) {
            let core = series(r, (first_power, bend), &b);
            let curve = Polynomial::material::<12>(&core).unwrap();
            let off = distance(&curve, |_, c| core.reflectance(crate::fresnel::CosTheta::new(c))[0]);
            prop_assert!(off <= 2e-6, "{off}");
        }

        #[test]
        fn is_total(r in finite(), b in finite(), c in finite(), bend in finite()) {
            let curve = series(f64::from(r), (1, f64::from(bend)), &[f64::from(b); 10]);
            let curve = Polynomial::material::<12>(&curve).unwrap();
            prop_assert!(curve.at(c)[0].iter().all(|f| f.is_finite()));
        }
    }

    #[test]
    fn another_number_of_coefficients_is_another_kernel() {
        let three = series(0.5, (6, 0.0), &[1.0, 2.0, 3.0]);
        assert!(Polynomial::material::<5>(&three).is_some() && Polynomial::material::<12>(&three).is_none());
        assert!(Polynomial::material::<2>(&series(0.5, (1, 0.0), &[])).is_none());
    }

    /// By hand: x, t, x⁵ in three products, c x⁶ in two; two products with sums, a bump and Schlick's sum per channel.
    #[test]
    fn operations_are_those_of_horners_scheme() {
        let curve = Polynomial::material::<5>(&series(0.5, (6, 0.0), &[1.0, 2.0, 3.0])).unwrap();
        let limit = 2;
        let expected = Operations {
            sums: 2 + 3 * 4,
            products: 3 + 2 + 3 * 4,
            fused: 3 * 4,
            choices: limit,
            ..Operations::default()
        };
        assert_eq!((curve.operations(), Polynomial::operations_of(6, 0.0, 3)), (expected, expected));
        assert_eq!(Polynomial::operations_of(1, 2.5, 10).quotients, 1);
    }
}
