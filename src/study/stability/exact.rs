//! The models in 512 bits: what rounding is measured against.
//!
//! Written from the definitions, not from the forms that the kernels use; what these cancel costs less than 512 bits
//! hold over the grids of the study.

use std::iter::Sum;
use std::ops::{Add, Div, Mul, Sub};

use dashu_float::{FBig, round::mode::HalfEven};

/// A number of 512 bits.
#[derive(Clone, Debug)]
pub(super) struct Exact(FBig<HalfEven, 2>);

const BITS: usize = 512;

/// Powers, angles and exponentials have little cancellation to outlast, and are dear.
const BITS_OF_FUNCTIONS: usize = 192;

impl Exact {
    /// Exactly this number, which must be finite.
    pub(super) fn of(value: f64) -> Self {
        let number = FBig::try_from(value).expect("grids and results that are measured are finite");
        Self(number.with_precision(BITS).value())
    }

    pub(super) fn whole(value: i32) -> Self {
        Self::of(f64::from(value))
    }

    /// A decimal constant: so many units of the fifth decimal.
    pub(super) fn hundred_thousandths(count: i32) -> Self {
        Self::whole(count) / Self::whole(100_000)
    }

    pub(super) fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }

    pub(super) fn is_zero(&self) -> bool {
        self.to_f64() == 0.0
    }

    pub(super) fn is_above(&self, other: &Self) -> bool {
        self.0 > other.0
    }

    pub(super) fn sqrt(&self) -> Self {
        if self.is_zero() { Self::whole(0) } else { Self(self.0.sqrt()) }
    }

    /// ∛self of a positive number.
    pub(super) fn cube_root(&self) -> Self {
        self.by(|x| x.nth_root(3))
    }

    /// 0 of 0, for a positive exponent.
    fn power(&self, exponent: f64) -> Self {
        if self.is_zero() {
            return Self::whole(0);
        }
        if exponent.fract() == 0.0 && exponent > 0.0 {
            return self.whole_power(exponent as u32);
        }
        let exponent = Self::of(exponent);
        self.by(|base| base.powf(&exponent.0.with_precision(BITS_OF_FUNCTIONS).value()))
    }

    pub(super) fn exp(&self) -> Self {
        self.by(FBig::exp)
    }

    /// The sine of an angle in degrees.
    pub(super) fn sin_deg(&self) -> Self {
        self.by(|angle| angle.sin_unit(360))
    }

    /// The cosine of an angle in degrees.
    pub(super) fn cos_deg(&self) -> Self {
        self.by(|angle| angle.cos_unit(360))
    }

    /// The direction of (x, y), which are not both 0, in degrees from 0 up to 360.
    ///
    /// By arc tangents of −1 to 1: `atan2_unit` of dashu-float 0.6.2 takes one lower diagonal for the other.
    pub(super) fn direction_deg(x: &Self, y: &Self) -> Self {
        let zero = Self::whole(0);
        let quarter_turns = |count: i32| Self::whole(90 * count);
        let is_steep = (y * y).is_above(&(x * x));
        let (from, ratio) = match (is_steep, y.is_above(&zero), x.is_above(&zero)) {
            (true, is_up, _) => (quarter_turns(if is_up { 1 } else { 3 }), &zero - &(x / y)),
            (false, is_up, true) => (quarter_turns(if is_up || y.is_zero() { 0 } else { 4 }), y / x),
            (false, _, false) => (quarter_turns(2), y / x),
        };
        from + ratio.by(|ratio| ratio.atan_unit(360))
    }

    fn by(&self, function: impl FnOnce(&FBig<HalfEven, 2>) -> FBig<HalfEven, 2>) -> Self {
        let rounded = self.0.clone().with_precision(BITS_OF_FUNCTIONS).value();
        Self(function(&rounded).with_precision(BITS).value())
    }

    pub(super) fn whole_power(&self, exponent: u32) -> Self {
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

impl Sum for Exact {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::whole(0), |sum, term| sum + term)
    }
}

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

/// r0, the tint, r90 and the exponent (Hoffman 2023; MaterialX `generalized_schlick_bsdf`).
pub(super) fn generalized_schlick([r0, t, r90, p]: [f64; 4], c: f64) -> Exact {
    let rise = Exact::of(r90) - Exact::of(r0);
    let (cm, xm) = (Exact::whole(1) / Exact::whole(7), Exact::whole(6) / Exact::whole(7));
    let at_max = Exact::of(r0) + &rise * &xm.power(p);
    let a = at_max * (Exact::whole(1) - Exact::of(t)) / (cm * xm.whole_power(6));
    let (c, x) = (Exact::of(c), Exact::whole(1) - Exact::of(c));
    Exact::of(r0) + rise * x.power(p) - a * c * x.whole_power(6)
}

/// Schlick's curve of r and a polynomial of its coefficients, as [`crate::fresnel::SchlickSeries`] defines it.
pub(super) fn series(r: f64, coefficients: &[f64], (first_power, bend): (u32, f64), c: f64) -> Exact {
    let (one, exact_c, bend) = (Exact::whole(1), Exact::of(c), Exact::of(bend));
    let t = (&one - &(&(Exact::whole(2) + bend.clone()) * &exact_c)) / (&one + &(&bend * &exact_c));
    let (mut sum, mut power) = (Exact::whole(0), one.clone());
    for coefficient in coefficients {
        sum = sum + &Exact::of(*coefficient) * &power;
        power = power * t.clone();
    }
    schlick(r, c) + &exact_c * &(one - exact_c.clone()).whole_power(first_power) * sum
}

/// Linear between rows, which are even in √c from grazing to facing: what a table says, not what it was made from.
pub(super) fn table(rows: &[f64], c: f64) -> Exact {
    let place = Exact::whole(rows.len() as i32 - 1) * Exact::of(c).sqrt();
    let nearest = (place.to_f64() as usize).min(rows.len() - 2);
    // To 64 bits a place just below a row is on it.
    let is_below = Exact::of(nearest as f64).is_above(&place);
    let row = nearest - usize::from(is_below);
    let rest = place - Exact::of(row as f64);
    Exact::of(rows[row]) + rest * (Exact::of(rows[row + 1]) - Exact::of(rows[row]))
}

/// The sum of conductors, each with its weight: [n, k, weight] after [n, k, weight].
pub(super) fn spectral(wavelengths: &[f64], c: f64) -> Exact {
    let weighted = |wavelength: &[f64]| {
        let [n, k] = [wavelength[0], wavelength[1]].map(|x| Exact::of(x.clamp(0.0, 1e9)));
        conductor(&n, &k, c).0 * Exact::of(wavelength[2])
    };
    wavelengths.chunks_exact(3).map(weighted).sum()
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
    use crate::color::Rgb;
    use crate::fresnel::{self, CosTheta, Nk, SchlickSeries};
    use crate::study::Form;

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
                (generalized_schlick([x, y, 0.9, 3.7], c), fresnel::generalized_schlick(x, y, 0.9, 3.7, cos)),
                (tint_of_edge(x, y), fresnel::t_from_r_h(x, y)),
                (edge_of_tint(x, y), fresnel::h_from_r_t(x, y)),
            ] {
                prop_assert!((exact.to_f64() - core).abs() < 1e-12 * core.abs().max(1.0), "{} {core}", exact.to_f64());
            }
        }

        #[test]
        fn what_is_baked_is_the_core(
            r in 0.0..1.0, b in prop::array::uniform6(-1.0..1.0), nk in prop::array::uniform6(0.1..3.0), c in 0.01..1.0,
        ) {
            let cos = CosTheta::new(c);
            let coefficients = b.map(Rgb::splat).to_vec();
            let core = SchlickSeries { r: Rgb::splat(r), first_power: 4, bend: 2.5, coefficients };
            let rows = b.map(Rgb::splat).to_vec();
            let (n, k, weights) = (nk[..3].to_vec(), nk[3..].to_vec(), [0.5, -0.1, 0.6]);
            let wavelengths: Vec<f64> = (0..3).flat_map(|i| [n[i], k[i], weights[i]]).collect();
            let weights = weights.map(Rgb::splat).to_vec();
            for (exact, core) in [
                (series(r, &b, (4, 2.5), c), core.reflectance(cos)),
                (table(&b, c), Form::Table { rows }.reflectance(cos)),
                (spectral(&wavelengths, c), Form::Spectral { wavelengths_nm: Vec::new(), n, k, weights }.reflectance(cos)),
            ] {
                prop_assert!((exact.to_f64() - core[0]).abs() < 1e-12, "{} {}", exact.to_f64(), core[0]);
            }
        }
    }

    /// √c · 4 is 1 at c = 1/16, and a hair below it next to that, where 64 bits see no difference.
    #[test]
    fn a_table_is_continuous_at_its_rows() {
        let rows = [0.0, 1.0, 0.0, 3.0, 0.0];
        let at = |c: f64| table(&rows, c);
        assert_eq!([0.0, 1.0 / 16.0, 9.0 / 16.0, 1.0].map(|c| at(c).to_f64()), [0.0, 1.0, 3.0, 0.0]);
        let below = at((1.0_f64 / 16.0).next_down());
        assert!(Exact::whole(1).is_above(&below) && (Exact::whole(1) - below).to_f64() < 1e-15);
    }

    #[test]
    fn angles_are_those_of_the_circle() {
        let [one, minus_one, zero] = [1, -1, 0].map(Exact::whole);
        let upper = [(&one, &zero), (&one, &one), (&zero, &one), (&minus_one, &one), (&minus_one, &zero)];
        let lower = [(&minus_one, &minus_one), (&zero, &minus_one), (&one, &minus_one)];
        let degrees = |(x, y): (&Exact, &Exact)| Exact::direction_deg(x, y).to_f64();
        assert_eq!(upper.map(degrees), [0.0, 45.0, 90.0, 135.0, 180.0]);
        assert_eq!(lower.map(degrees), [225.0, 270.0, 315.0]);
        for angle in (0..360).step_by(7) {
            let (x, y) = (Exact::whole(angle).cos_deg(), Exact::whole(angle).sin_deg());
            let off = Exact::direction_deg(&x, &y) - Exact::whole(angle);
            assert!(off.to_f64().abs() < 1e-50, "{angle}: {}", off.to_f64());
        }
        let half_angle = Exact::whole(30);
        let (sine, cosine) = (half_angle.sin_deg(), half_angle.cos_deg());
        let off = &sine * &sine + &cosine * &cosine - one;
        assert!(sine.to_f64() == 0.5 && off.to_f64().abs() < 1e-50, "{}", off.to_f64());
        assert!((Exact::whole(2).exp() - Exact::whole(1).exp().whole_power(2)).to_f64().abs() < 1e-50);
        assert!((Exact::whole(27).cube_root() - Exact::whole(3)).is_zero());
    }
}
