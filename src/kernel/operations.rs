//! How many operations a formula is made of, counted by running it.

use std::cell::Cell;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use super::{Form, Real, form::at};

/// Operations on single numbers, as they stand in a shader's source; constants are counted nowhere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Sums and differences.
    pub sums: u32,
    /// Products.
    pub products: u32,
    /// How many of the products are written with the sum that follows, and so are one instruction with it.
    pub fused: u32,
    /// Quotients.
    pub quotients: u32,
    /// Square roots.
    pub roots: u32,
    /// Logarithms, exponentials and cube roots.
    pub powers: u32,
    /// Comparisons, choices, limits, absolute values and changes of sign.
    pub choices: u32,
    /// Reads from a table.
    pub loads: u32,
}

impl Operations {
    /// Of a formula for one RGB value.
    pub fn of<F: Form<P, N>, const P: usize, const N: usize>(form: F) -> Self {
        Self::while_running(|| {
            at(form, [[Counted; P]; 3], Counted);
        })
    }

    /// Of what `work` does with [`Counted`] numbers.
    pub(super) fn while_running(work: impl FnOnce()) -> Self {
        let before = COUNTS.replace(Self::default());
        work();
        COUNTS.replace(before)
    }

    /// All of them, a product and its sum being two.
    pub const fn total(self) -> u32 {
        self.sums + self.products + self.quotients + self.roots + self.powers + self.choices + self.loads
    }

    /// Issue slots, a product and its sum being one: graphics processors take one simple operation in each, and a
    /// division, a root, a power or a read in every fourth (AMD, RDNA 2 instruction set architecture, 2020).
    pub const fn slots(self) -> u32 {
        let special = self.quotients + self.roots + self.powers + self.loads;
        self.sums + self.products - self.fused + self.choices + 4 * special
    }
}

impl AddAssign for Operations {
    fn add_assign(&mut self, other: Self) {
        self.sums += other.sums;
        self.products += other.products;
        self.fused += other.fused;
        self.quotients += other.quotients;
        self.roots += other.roots;
        self.powers += other.powers;
        self.choices += other.choices;
        self.loads += other.loads;
    }
}

thread_local! {
    static COUNTS: Cell<Operations> = const { Cell::new(Operations {
        sums: 0, products: 0, fused: 0, quotients: 0, roots: 0, powers: 0, choices: 0, loads: 0,
    }) };
}

/// A number without a value, whose operations are counted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counted;

impl Counted {
    fn count(self, count: impl FnOnce(&mut Operations)) -> Self {
        let mut counts = COUNTS.get();
        count(&mut counts);
        COUNTS.set(counts);
        self
    }
}

impl Real for Counted {
    fn of(self, _: f64) -> Self {
        self
    }

    fn mul_add(self, _: Self, _: Self) -> Self {
        self.count(|counts| {
            counts.products += 1;
            counts.sums += 1;
            counts.fused += 1;
        })
    }

    fn mul_sub(self, factor: Self, term: Self) -> Self {
        self.mul_add(factor, term)
    }

    fn nearly_over(self, divisor: Self) -> Self {
        self / divisor
    }

    fn sqrt(self) -> Self {
        self.count(|counts| counts.roots += 1)
    }

    fn abs(self) -> Self {
        self.count(|counts| counts.choices += 1)
    }

    fn if_below(self, _: Self, _: Self, _: Self) -> Self {
        self.count(|counts| counts.choices += 2)
    }

    fn larger(self, _: Self) -> Self {
        self.count(|counts| counts.choices += 1)
    }

    fn above_one(self) -> Self {
        self
    }

    fn limited(self, _: f64, _: f64) -> Self {
        self.count(|counts| counts.choices += 2)
    }

    fn cube_root(self) -> Self {
        self.count(|counts| counts.powers += 1)
    }

    fn exp2(self) -> Self {
        self.count(|counts| counts.powers += 1)
    }

    /// A logarithm, a product and an exponential.
    fn power(self, _: f64) -> Self {
        self.count(|counts| {
            counts.powers += 2;
            counts.products += 1;
        })
    }
}

impl Add for Counted {
    type Output = Self;
    fn add(self, _: Self) -> Self {
        self.count(|counts| counts.sums += 1)
    }
}

impl Sub for Counted {
    type Output = Self;
    fn sub(self, _: Self) -> Self {
        self.count(|counts| counts.sums += 1)
    }
}

impl Mul for Counted {
    type Output = Self;
    fn mul(self, _: Self) -> Self {
        self.count(|counts| counts.products += 1)
    }
}

impl Div for Counted {
    type Output = Self;
    fn div(self, _: Self) -> Self {
        self.count(|counts| counts.quotients += 1)
    }
}

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        self.count(|counts| counts.choices += 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{Conductor, Factored, Schlick, textbook::PopularConductor};

    /// By hand from the formulas: x = 1 − c, x⁵ in three products, then a product and a sum per channel.
    #[test]
    fn schlick_and_h_have_what_stands_in_them() {
        let limit = 2;
        let schlick = Operations { sums: 1 + 3, products: 3 + 3, fused: 3, choices: limit, ..Operations::default() };
        assert_eq!((Operations::of(Schlick), schlick.slots()), (schlick, 9));
        let hoffman = Operations { sums: 1 + 6, products: 4 + 6, fused: 6, choices: limit, ..Operations::default() };
        assert_eq!((Operations::of(Factored), hoffman.total(), hoffman.slots()), (hoffman, 19, 13));
    }

    #[test]
    fn the_conductor_divides_once_per_channel_and_the_popular_one_twice() {
        let (ours, popular) = (Operations::of(Conductor::OF_ANY_INDEX), Operations::of(PopularConductor));
        assert_eq!((ours.quotients, ours.roots), (3, 6));
        assert_eq!((popular.quotients, popular.roots), (6, 6));
    }
}
