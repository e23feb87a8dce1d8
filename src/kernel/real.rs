//! What a formula needs of its numbers, so that one text serves a shader's scalar, vector lanes and 64 bits.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number, or a vector of numbers: 32 or 64 bits, alone or in lanes.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// This constant in the kind of `self`; only the kind is used.
    fn of(self, constant: f64) -> Self;

    /// `self · factor + term`: rounded once where the processor does that at no cost, twice elsewhere.
    ///
    /// A scalar rounds twice: without the instruction the fused form is a call of the C library, 15 times slower.
    fn mul_add(self, factor: Self, term: Self) -> Self;

    /// `self · factor − term`, rounded as [`Real::mul_add`].
    fn mul_sub(self, factor: Self, term: Self) -> Self;

    /// self / divisor within 5e-7 of it, for divisors of 1e-37 to 1e37: vectors multiply by an estimate that is improved
    /// once, where a division would have to wait for the roots of others.
    fn nearly_over(self, divisor: Self) -> Self;

    /// √self; NaN below 0.
    fn sqrt(self) -> Self;

    /// |self|.
    fn abs(self) -> Self;

    /// `then` where `self < bound`, else `otherwise`; NaN is below nothing.
    fn if_below(self, bound: Self, then: Self, otherwise: Self) -> Self;

    /// The larger of two numbers; either of them where one is NaN.
    fn larger(self, other: Self) -> Self;

    /// The next number above 1.
    fn above_one(self) -> Self;

    /// Limited to `low..=high`; NaN stays NaN.
    fn limited(self, low: f64, high: f64) -> Self;

    /// ∛self of a positive normal number.
    fn cube_root(self) -> Self;

    /// 2 to the power of self; 0 far below, for numbers up to 126.
    fn exp2(self) -> Self;

    /// self to a positive power as shaders have it, by the logarithm, for self ≥ 0; 0 of 0.
    fn power(self, exponent: f64) -> Self;

    /// x⁵, by multiplication: a power of a slightly negative number is NaN in shipped shaders.
    #[inline(always)]
    fn fifth_power(self) -> Self {
        let square = self * self;
        square * square * self
    }
}

macro_rules! scalar {
    ($number:ty) => {
        impl Real for $number {
            #[inline(always)]
            fn of(self, constant: f64) -> Self {
                constant as $number
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                self * factor + term
            }

            #[inline(always)]
            fn mul_sub(self, factor: Self, term: Self) -> Self {
                self * factor - term
            }

            #[inline(always)]
            fn nearly_over(self, divisor: Self) -> Self {
                self / divisor
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                <$number>::sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                <$number>::abs(self)
            }

            #[inline(always)]
            fn if_below(self, bound: Self, then: Self, otherwise: Self) -> Self {
                if self < bound { then } else { otherwise }
            }

            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                self.max(other)
            }

            #[inline(always)]
            fn above_one(self) -> Self {
                1.0 + <$number>::EPSILON
            }

            #[inline(always)]
            fn limited(self, low: f64, high: f64) -> Self {
                self.clamp(low as $number, high as $number)
            }

            #[inline(always)]
            fn cube_root(self) -> Self {
                self.cbrt()
            }

            #[inline(always)]
            fn exp2(self) -> Self {
                <$number>::exp2(self)
            }

            #[inline(always)]
            fn power(self, exponent: f64) -> Self {
                (self.log2() * exponent as $number).exp2()
            }
        }
    };
}

scalar!(f32);
scalar!(f64);
