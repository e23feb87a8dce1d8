//! The processor's vectors as a [`Real`], on whatever instruction set it has.

use std::ops::{Add, Div, Mul, Neg, Sub};

use fearless_simd::{Simd, SimdBase, prelude::*};

use super::Real;
use super::delta_e::series;

/// As many 32-bit numbers as the instruction set holds in one register: 4, 8 or 16.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S: Simd> {
    simd: S,
    values: S::f32s,
}

impl<S: Simd> Lanes<S> {
    /// How many numbers.
    pub(super) const COUNT: usize = S::f32s::LEN;

    #[inline(always)]
    pub(super) fn splat(simd: S, value: f32) -> Self {
        Self { simd, values: value.simd_into(simd) }
    }

    /// The numbers of a slice that holds exactly as many.
    #[inline(always)]
    pub(super) fn load(simd: S, from: &[f32]) -> Self {
        Self { simd, values: S::f32s::from_slice(simd, from) }
    }

    /// Into a slice that holds exactly as many.
    #[inline(always)]
    pub(super) fn store(self, into: &mut [f32]) {
        self.values.store_slice(into);
    }

    /// The numbers of a slice that holds fewer; 0 in the lanes it does not reach.
    #[inline(always)]
    pub(super) fn load_some(simd: S, from: &[f32]) -> Self {
        let mut lanes = Self::splat(simd, 0.0);
        lanes.values.as_mut_slice()[..from.len()].copy_from_slice(from);
        lanes
    }

    /// Into a slice that holds fewer.
    #[inline(always)]
    pub(super) fn store_some(self, into: &mut [f32]) {
        into.copy_from_slice(&self.values.as_slice()[..into.len()]);
    }

    /// The whole part of numbers of 0 to `last`, at most `last`, and the rest; NaN is its own rest.
    #[inline(always)]
    pub(super) fn whole_and_rest(self, last: usize) -> (S::i32s, Self) {
        let (zero, last) = (self.of(0.0), self.of(last as f64));
        let inside = zero.if_below(self, self.if_below(last, self, last), zero);
        let whole = inside.values.to_int::<S::i32s>();
        (whole, self - self.with(whole.to_float()))
    }

    /// The numbers themselves.
    #[inline(always)]
    pub(super) fn as_slice(&self) -> &[f32] {
        self.values.as_slice()
    }

    #[inline(always)]
    fn with(self, values: S::f32s) -> Self {
        Self { simd: self.simd, values }
    }

    #[inline(always)]
    fn bits(self) -> S::i32s {
        self.values.bitcast()
    }

    #[inline(always)]
    fn int(self, value: i32) -> S::i32s {
        value.simd_into(self.simd)
    }

    /// One step of Halley's method towards the cube root of self.
    #[inline(always)]
    fn better_cube_root(self, root: Self) -> Self {
        let cube = root * root * root;
        root.mul_add((self - cube) / (cube + cube + self), root)
    }

    /// The base-2 logarithm of positive normal numbers, to 1e-7 of its size.
    ///
    /// log2 m = (2 / ln 2) artanh((m − 1)/(m + 1)) for the significand m of [1/√2, √2).
    #[inline(always)]
    fn log2(self) -> Self {
        let one = self.of(1.0);
        // The bits of 1/√2: subtracting them moves the carry of the exponent to there.
        let shifted = self.bits() - self.int(0x3f35_04f3);
        let exponent = shifted >> 23;
        let significand = self.with((self.bits() - (exponent << 23)).bitcast());
        let s = (significand - one) / (significand + one);
        let s2 = s * s;
        let artanh = s * series(s2, [1.0 / 9.0, 1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0, 1.0]);
        artanh.mul_add(self.of(2.0 / std::f64::consts::LN_2), self.with(exponent.to_float()))
    }
}

/// Newton's steps from an estimate of 1/x to 24 bits: ARM estimates 8 of them, others 11 or more.
const IMPROVEMENTS: usize = if cfg!(target_arch = "aarch64") { 2 } else { 1 };

impl<S: Simd> Real for Lanes<S> {
    #[inline(always)]
    fn of(self, constant: f64) -> Self {
        Self::splat(self.simd, constant as f32)
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self.with(self.values.mul_add(factor.values, term.values))
    }

    #[inline(always)]
    fn mul_sub(self, factor: Self, term: Self) -> Self {
        self.with(self.values.mul_sub(factor.values, term.values))
    }

    #[inline(always)]
    fn nearly_over(self, divisor: Self) -> Self {
        let one = self.of(1.0);
        let mut reciprocal = self.with(divisor.values.approximate_recip());
        for _ in 0..IMPROVEMENTS {
            reciprocal = (-divisor).mul_add(reciprocal, one).mul_add(reciprocal, reciprocal);
        }
        self * reciprocal
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.with(self.values.sqrt())
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.with(self.values.abs())
    }

    #[inline(always)]
    fn if_below(self, bound: Self, then: Self, otherwise: Self) -> Self {
        self.with(self.values.simd_lt(bound.values).select(then.values, otherwise.values))
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.with(self.values.max(other.values))
    }

    #[inline(always)]
    fn above_one(self) -> Self {
        self.of(1.0 + f64::from(f32::EPSILON))
    }

    #[inline(always)]
    fn limited(self, low: f64, high: f64) -> Self {
        self.with(self.values.clamp(self.of(low).values, self.of(high).values))
    }

    /// A guess within 4 % by dividing the exponent by 3 (Kahan), then two steps of Halley's method.
    #[inline(always)]
    fn cube_root(self) -> Self {
        let third: S::f32s = self.bits().to_float::<S::f32s>() * (1.0 / 3.0);
        let guess = self.with((third.to_int::<S::i32s>() + self.int(0x2a51_37a0)).bitcast());
        self.better_cube_root(self.better_cube_root(guess))
    }

    #[inline(always)]
    fn exp2(self) -> Self {
        let x = self.limited(-126.0, 126.0);
        let whole = x.with(x.values.round_ties_even());
        let part = (x - whole) * self.of(std::f64::consts::LN_2);
        // The series of eˣ for |x| ≤ ln 2 / 2; the first term left out is 5e-9.
        let power = series(part, [1.0 / 5040.0, 1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0]);
        let scale = self.with(((whole.values.to_int::<S::i32s>() + self.int(127)) << 23).bitcast());
        self.if_below(self.of(-126.0), self.of(0.0), power * scale)
    }

    #[inline(always)]
    fn power(self, exponent: f64) -> Self {
        let smallest = self.of(f64::from(f32::MIN_POSITIVE));
        // Below the smallest normal number there is no logarithm: there it is 0.
        let power = (self.log2() * self.of(exponent)).exp2();
        // What is added is 0, but for NaN, which the logarithm takes for a number.
        self.if_below(smallest, self.of(0.0), self.mul_add(self.of(0.0), power))
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(self.values + other.values)
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(self.values - other.values)
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(self.values * other.values)
    }
}

impl<S: Simd> Div for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.with(self.values / other.values)
    }
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.with(-self.values)
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;

    use super::*;
    use crate::kernel::levels;

    /// The largest relative error of a function of lanes at numbers `from · 2^(i/8)`.
    macro_rules! largest_relative_error {
        ($count:expr, $from:expr, |$lanes:ident| $value:expr, $exact:expr) => {
            levels().into_iter().fold(0.0_f64, |largest, level| {
                (0..$count).fold(largest, |largest, i| {
                    let x = ($from * 2_f64.powf(f64::from(i) / 8.0)) as f32;
                    let got = dispatch!(level, simd => {
                        let $lanes = Lanes::splat(simd, x);
                        $value.as_slice()[0]
                    });
                    let exact: f64 = $exact(f64::from(x));
                    crate::number::larger(largest, ((f64::from(got) - exact) / exact).abs())
                })
            })
        };
    }

    #[test]
    fn roots_and_powers_are_near_the_c_librarys() {
        let cube_root = largest_relative_error!(1000, 1e-30, |x| x.cube_root(), |x: f64| x.cbrt());
        assert!(cube_root < 3e-7, "{cube_root}");
        let exp2 = largest_relative_error!(160, 1e-4, |x| (-x).exp2(), |x: f64| (-x).exp2());
        assert!(exp2 < 1e-6, "{exp2}");
        let power = largest_relative_error!(160, 1e-6, |x| x.power(5.5), |x: f64| x.powf(5.5));
        assert!(power < 1e-5, "{power}");
    }

    /// Over all significands, near and at the ends of what is promised.
    #[test]
    fn quotients_by_an_estimate_are_near() {
        for level in levels() {
            let quotient = |x: f32| dispatch!(level, simd => Lanes::splat(simd, 0.7 * x).nearly_over(Lanes::splat(simd, x)).as_slice()[0]);
            let off = |x: f32| (f64::from(quotient(x)) / (f64::from(0.7 * x) / f64::from(x)) - 1.0).abs();
            let significands = (0..8192_u16).map(|i| 1.0 + f32::from(i) / 8192.0);
            let largest = significands
                .flat_map(|x| [1e-37, 1.0, 4e36].map(|size| off(size * x)))
                .fold(0.0, crate::number::larger);
            assert!((1e-9..5e-7).contains(&largest), "{level:?}: {largest}");
            assert!(quotient(f32::NAN).is_nan());
        }
    }

    #[test]
    fn far_powers_are_0_and_a_nan_stays_one() {
        for level in levels() {
            let of = |x: f32| {
                dispatch!(level, simd => [
                    Lanes::splat(simd, x).power(6.0).as_slice()[0],
                    Lanes::splat(simd, x).exp2().as_slice()[0],
                ])
            };
            assert_eq!(of(0.0), [0.0, 1.0]);
            assert_eq!(of(1e-39)[0], 0.0);
            assert_eq!(of(-1e30)[1], 0.0);
            assert!(of(f32::NAN).iter().all(|x| x.is_nan()), "{level:?}");
        }
    }
}
