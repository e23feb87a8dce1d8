//! The models in 512 bits: what rounding is measured against.
//!
//! Written from the definitions, not from the forms that the kernels use; what these cancel costs less than 512 bits
//! hold over the grids of the study.

use std::ops::{Add, Div, Mul, Sub};

use dashu_float::{FBig, round::mode::HalfEven};

/// A number of 512 bits.
#[derive(Clone, Debug)]
pub(super) struct Exact(FBig<HalfEven, 2>);

const BITS: usize = 512;

/// Powers have no cancellation to outlast, and are dear.
const BITS_OF_POWERS: usize = 160;

impl Exact {
    /// Exactly this number, which must be finite.
    pub(super) fn of(value: f64) -> Self {
        let number = FBig::try_from(value).expect("grids and results that are measured are finite");
        Self(number.with_precision(BITS).value())
    }

    fn whole(value: i32) -> Self {
        Self::of(f64::from(value))
    }

    pub(super) fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }

    fn sqrt(&self) -> Self {
        if self.to_f64() == 0.0 { Self::whole(0) } else { Self(self.0.sqrt()) }
    }

    fn power(&self, exponent: f64) -> Self {
        if self.to_f64() == 0.0 {
            return Self::whole(0);
        }
        let [base, exponent] = [self.clone(), Self::of(exponent)].map(|x| x.0.with_precision(BITS_OF_POWERS).value());
        Self(base.powf(&exponent).with_precision(BITS).value())
    }

    fn whole_power(&self, exponent: u32) -> Self {
        (0..exponent).fold(Self::whole(1), |product, _| &product * self)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl $trait for &Exact {
            type Output = Exact;
            fn $method(self, other: Self) -> Exact {
                Exact($trait::$method(&self.0, &other.0))
            }
        }

        impl $trait for Exact {
            type Output = Exact;
            fn $method(self, other: Self) -> Exact {
                $trait::$method(&self, &other)
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

/// Schlick 1994.
pub(super) fn schlick(r: f64, c: f64) -> Exact {
    let x = Exact::whole(1) - Exact::of(c);
    Exact::of(r) + (Exact::whole(1) - Exact::of(r)) * x.whole_power(5)
}

/// Hoffman's eqs. 2 and 3: r, and what h is given as.
fn hoffman_of(r: f64, h: &Exact, c: f64) -> Exact {
    let (cm, xm) = (Exact::whole(1) / Exact::whole(7), Exact::whole(6) / Exact::whole(7));
    let a = (schlick_at_max(r) - h.clone()) / (cm * xm.whole_power(6));
    let (c_exact, x) = (Exact::of(c), Exact::whole(1) - Exact::of(c));
    schlick(r, c) - a * c_exact * x.whole_power(6)
}

fn schlick_at_max(r: f64) -> Exact {
    let x5 = (Exact::whole(6) / Exact::whole(7)).whole_power(5);
    Exact::of(r) + (Exact::whole(1) - Exact::of(r)) * x5
}

pub(super) fn hoffman(r: f64, h: f64, c: f64) -> Exact {
    hoffman_of(r, &Exact::of(h), c)
}

pub(super) fn edge_of_tint(r: f64, t: f64) -> Exact {
    Exact::of(t) * schlick_at_max(r)
}

pub(super) fn tint_of_edge(r: f64, h: f64) -> Exact {
    Exact::of(h) / schlick_at_max(r)
}

pub(super) fn f82_tint(r: f64, t: f64, c: f64) -> Exact {
    hoffman_of(r, &edge_of_tint(r, t), c)
}

/// Lazányi & Szirmay-Kalos 2005.
pub(super) fn lazanyi(r: f64, a: f64, alpha: f64, c: f64) -> Exact {
    let x = Exact::whole(1) - Exact::of(c);
    schlick(r, c) - Exact::of(a) * Exact::of(c) * x.power(alpha)
}

/// The exact conductor or dielectric (Born & Wolf 1999, section 14.2) as (F, 1 − F); 1 at grazing and without index.
pub(super) fn conductor(n: &Exact, k: &Exact, c: f64) -> (Exact, Exact) {
    let (zero, one, two) = (Exact::whole(0), Exact::whole(1), Exact::whole(2));
    if c == 0.0 || (n.to_f64() == 0.0 && k.to_f64() == 0.0) {
        return (one, zero);
    }
    let c = Exact::of(c);
    let (n2, k2, c2) = (n * n, k * k, &c * &c);
    let s2 = &one - &c2;
    let t0 = &(&n2 - &k2) - &s2;
    let modulus = (&(&t0 * &t0) + &(&Exact::whole(4) * &(&n2 * &k2))).sqrt();
    let a2 = &(&modulus + &t0) / &two;
    // Rounding of an exact 0.
    let a = if a2.to_f64() > 0.0 { a2.sqrt() } else { zero };
    let (t1, t2) = (&modulus + &c2, &(&two * &c) * &a);
    let s = &(&t1 - &t2) / &(&t1 + &t2);
    let (t3, t4) = (&(&c2 * &modulus) + &(&s2 * &s2), &t2 * &s2);
    let (above, below) = (&t3 - &t4, &t3 + &t4);
    // Both vanish only where the index is n = 0 and the cosine 1: a mirror.
    let p = if below.to_f64() == 0.0 { one.clone() } else { &above / &below };
    let f = &(&s * &(&one + &p)) / &two;
    let absorbed = &one - &f;
    (f, absorbed)
}

/// Gulbrandsen 2014, eqs. 6 and 8, for 0 ≤ r < 1 and 0 ≤ g ≤ 1.
pub(super) fn index_of_tint(r: f64, g: f64) -> (Exact, Exact) {
    let (one, r, g) = (Exact::whole(1), Exact::of(r), Exact::of(g));
    let s = r.sqrt();
    let (least, most) = (&(&one - &r) / &(&one + &r), &(&one + &s) / &(&one - &s));
    let n = &(&g * &least) + &(&(&one - &g) * &most);
    let (above, below) = (&n + &one, &n - &one);
    let k2 = &(&(&r * &(&above * &above)) - &(&below * &below)) / &(&one - &r);
    let k = if k2.to_f64() > 0.0 { k2.sqrt() } else { Exact::whole(0) };
    (n, k)
}

/// Gulbrandsen 2014, eqs. 5 and 7; g of air is 0, and of n = 0, where r = 1, it is 1.
pub(super) fn tint_of_index(n: f64, k: f64) -> (Exact, Exact) {
    let one = Exact::whole(1);
    let (n, k2) = (Exact::of(n), &Exact::of(k) * &Exact::of(k));
    let (above, below) = (&n + &one, &n - &one);
    let r = &(&(&below * &below) + &k2) / &(&(&above * &above) + &k2);
    if n.to_f64() == 0.0 {
        return (one.clone(), one);
    }
    let s = r.sqrt();
    let (least, most) = (&(&one - &r) / &(&one + &r), &(&one + &s) / &(&one - &s));
    let range = &most - &least;
    let g = if range.to_f64() == 0.0 { Exact::whole(0) } else { &(&most - &n) / &range };
    (r, g)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::{self, CosTheta, Nk};

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        /// Two texts of one definition, rounded to 64 bits.
        #[test]
        fn is_the_core(x in 0.01..0.99, y in 0.01..0.99, c in 0.01..1.0) {
            let cos = CosTheta::new(c);
            let (n, k) = (3.0 * x, 5.0 * y);
            let (exact_n, exact_k) = index_of_tint(x, y);
            let (r, g) = tint_of_index(n, k);
            let Nk { n: core_n, k: core_k } = fresnel::nk_from_r_g(x, y).unwrap();
            let (core_r, core_g) = fresnel::r_g_from_nk(Nk { n, k });
            for (exact, core) in [
                (schlick(x, c), fresnel::schlick(x, cos)),
                (hoffman(x, y, c), fresnel::hoffman(x, y, cos)),
                (f82_tint(x, y, c), fresnel::f82_tint(x, y, cos)),
                (lazanyi(x, y, 6.3, c), fresnel::lazanyi(x, y, 6.3, cos)),
                (conductor(&Exact::of(n), &Exact::of(k), c).0, fresnel::conductor(n, k, cos)),
                (exact_n, core_n),
                (exact_k, core_k),
                (r, core_r),
                (g, core_g),
                (tint_of_edge(x, y), fresnel::t_from_r_h(x, y)),
                (edge_of_tint(x, y), fresnel::h_from_r_t(x, y)),
            ] {
                prop_assert!((exact.to_f64() - core).abs() < 1e-12 * core.abs().max(1.0), "{} {core}", exact.to_f64());
            }
        }
    }
}
