//! CIEDE2000 over slices, for tables of colour differences; see [`crate::color::delta_e_2000`].
//!
//! The same formula without an angle and without a branch: hues are directions in the plane of a′ and b′, ΔH comes
//! from their cross product, and the mean hue is the direction of their sum, or for obtuse angles at right angles to
//! their difference. Cosines of multiples of the mean hue are polynomials of its own.

use fearless_simd::{Level, dispatch};

use super::Real;
use super::form::{Planes, each_chunk};
use super::operations::{Counted, Operations};

/// Keeps lengths from 0 where a colour is grey, and with it ΔH.
const NO_ZERO: f64 = 1e-30;

/// CIEDE2000 with kL = kC = kH = 1 of two L*a*b* colours.
///
/// At a hue difference of exactly 180° it takes the branch of Sharma's eq. 14, as in 64 bits; in 32 bits rounding
/// decides within 1e-7 of there, where ΔE itself jumps.
#[inline(always)]
pub fn delta_e<T: Real>([l1, a1, b1]: [T; 3], [l2, a2, b2]: [T; 3]) -> T {
    let (zero, half, one, two) = (l1.of(0.0), l1.of(0.5), l1.of(1.0), l1.of(2.0));
    let stretch = (one - saturation(half * (length(a1, b1) + length(a2, b2)))).mul_add(half, one);
    let (a1, a2) = (a1 * stretch, a2 * stretch);
    let (c1, c2) = (length(a1, b1), length(a2, b2));

    // Not fused, so that opposite hues cancel exactly.
    let cross = a1 * b2 - b1 * a2;
    let (product, dot) = (c1 * c2, a1 * a2 + b1 * b2);
    let opposite = (b1 + a1 * l1.of(1e-10)) * l1.of(1e-20);
    let side = (cross + opposite).if_below(zero, -one, one);
    let chord = (two * (product + dot.abs()) + l1.of(NO_ZERO)).sqrt();
    let dh = dot.if_below(zero, side * chord, two * cross / chord);

    let (x1, x2, y1, y2) = (a1 * c2, a2 * c1, b1 * c2, b2 * c1);
    let x = dot.if_below(zero, side * (y2 - y1), x1 + x2);
    let y = dot.if_below(zero, side * (x1 - x2), y1 + y2);
    let norm = one / x.mul_add(x, y.mul_add(y, l1.of(NO_ZERO))).sqrt();
    let (cos, sin) = (x * norm, y * norm);

    let from_50 = half * (l1 + l2) - l1.of(50.0);
    let square = from_50 * from_50;
    let sl = one + square * l1.of(0.015) / (square + l1.of(20.0)).sqrt();
    let c_mean = half * (c1 + c2);
    let sc = c_mean.mul_add(l1.of(0.045), one);
    let sh = c_mean.mul_add(hue_weight(cos, sin) * l1.of(0.015), one);
    let rt = -two * saturation(c_mean) * sine_of_rotation(cos, sin);

    let (l, c, h) = ((l2 - l1) / sl, (c2 - c1) / sc, dh / sh);
    let square = l.mul_add(l, c.mul_add(c, h * h)) + rt * c * h;
    // Rounding can make it slightly negative; NaN stays NaN.
    square.if_below(zero, zero, square).sqrt()
}

/// [`delta_e`] at every pair; the shortest slice ends it.
pub fn delta_e_over(level: Level, x: [&[f32]; 3], y: [&[f32]; 3], out: &mut [f32]) {
    let pairs: Planes<'_, 2> = [x, y];
    dispatch!(level, simd => each_chunk(simd, 1, (x[0], pairs), [[out]],
        #[inline(always)] |_, [l, a, b]| [[delta_e([l[0], a[0], b[0]], [l[1], a[1], b[1]])]]));
}

/// Operations for one pair.
pub fn operations_of_delta_e() -> Operations {
    Operations::while_running(|| {
        delta_e([Counted; 3], [Counted; 3]);
    })
}

/// √(C⁷ / (C⁷ + 25⁷)); 1 from C = 2.5e6 on.
#[inline(always)]
fn saturation<T: Real>(chroma: T) -> T {
    let x = (chroma * chroma.of(1.0 / 25.0)).limited(0.0, 1e5);
    let x2 = x * x;
    let x7 = x2 * x2 * x2 * x;
    (x7 / (x7 + x.of(1.0))).sqrt()
}

/// Sharma's eq. 15: T of the mean hue.
#[inline(always)]
fn hue_weight<T: Real>(cos: T, sin: T) -> T {
    let two = cos.of(2.0);
    let (cos2, sin2) = (cos * cos - sin * sin, two * sin * cos);
    let (cos3, sin3) = (cos * cos2 - sin * sin2, sin * cos2 + cos * sin2);
    let (cos4, sin4) = (cos2 * cos2 - sin2 * sin2, two * sin2 * cos2);
    let odd = turned(-30.0, cos, sin) * cos.of(-0.17) + turned(6.0, cos3, sin3) * cos.of(0.32);
    let even = cos2 * cos.of(0.24) + turned(-63.0, cos4, sin4) * cos.of(-0.20);
    odd + even + cos.of(1.0)
}

/// The cosine of an angle turned by a constant.
#[inline(always)]
fn turned<T: Real>(by_deg: f64, cos: T, sin: T) -> T {
    let (s, c) = by_deg.to_radians().sin_cos();
    cos.mul_add(cos.of(c), sin * cos.of(-s))
}

#[inline(always)]
fn length<T: Real>(x: T, y: T) -> T {
    x.mul_add(x, y * y).sqrt()
}

/// sin(2Δθ) with Δθ = 30° exp(−((h − 275°)/25°)²) (Sharma's eqs. 16 and 22); 0 beyond 90° from there.
#[inline(always)]
fn sine_of_rotation<T: Real>(cos: T, sin: T) -> T {
    let (zero, one) = (cos.of(0.0), cos.of(1.0));
    let (s, c) = 275_f64.to_radians().sin_cos();
    let (along, across) = (cos.mul_add(cos.of(c), sin * cos.of(s)), sin.mul_add(cos.of(c), cos * cos.of(-s)));
    // The tangent of half the angle from 275°.
    let half_angle = arc_tangent(across / (one + along.abs()));
    let in_25_deg = half_angle * cos.of(2.0_f64.to_degrees() / 25.0);
    let rotation = (in_25_deg * in_25_deg * cos.of(-std::f64::consts::LOG2_E)).exp2();
    along.if_below(zero, zero, sine(rotation * cos.of(60_f64.to_radians())))
}

/// arctan of −1 to 1, within 2e-8 (Abramowitz & Stegun 1964, eq. 4.4.49).
#[inline(always)]
fn arc_tangent<T: Real>(x: T) -> T {
    const SERIES: [f64; 9] = [
        0.002_866_225_7,
        -0.016_165_736_7,
        0.042_909_613_8,
        -0.075_289_640_0,
        0.106_562_639_3,
        -0.142_088_994_4,
        0.199_935_508_5,
        -0.333_331_452_8,
        1.0,
    ];
    x * series(x * x, SERIES)
}

/// sin of 0 to 60°, by its series: the first term left out is 4e-8.
#[inline(always)]
fn sine<T: Real>(x: T) -> T {
    x * series(x * x, [1.0 / 362_880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0, 1.0])
}

/// A polynomial, its highest power first.
#[inline(always)]
pub(super) fn series<T: Real, const N: usize>(x: T, terms: [f64; N]) -> T {
    let mut sum = x.of(terms[0]);
    for term in &terms[1..] {
        sum = sum.mul_add(x, x.of(*term));
    }
    sum
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::color::{Lab, delta_e_2000};
    use crate::kernel::levels;

    fn core([l1, a1, b1]: [f32; 3], [l2, a2, b2]: [f32; 3]) -> f64 {
        let lab = |l: f32, a: f32, b: f32| Lab { lightness: f64::from(l), a: f64::from(a), b: f64::from(b) };
        delta_e_2000(lab(l1, a1, b1), lab(l2, a2, b2))
    }

    fn lab() -> impl Strategy<Value = [f32; 3]> {
        (0.0..110.0_f32, -90.0..90.0_f32, -90.0..90.0_f32).prop_map(|(l, a, b)| [l, a, b])
    }

    /// How far the hues are from opposite, as a share: below 1e-5 the mean hue may be either of two.
    fn hue_gap([_, a1, b1]: [f32; 3], [_, a2, b2]: [f32; 3]) -> f32 {
        let size = a1.hypot(b1) * a2.hypot(b2);
        (a1 * b2 - b1 * a2).abs() / size.max(1e-6) + f32::from(u8::from(a1 * a2 + b1 * b2 > 0.0))
    }

    fn off(x: [f32; 3], y: [f32; 3]) -> f64 {
        let exact = core(x, y);
        let mut largest = (f64::from(delta_e(x, y)) - exact).abs();
        for level in levels() {
            let mut out = [f32::NAN];
            let [x, y] = [&x, &y].map(|lab| lab.each_ref().map(std::slice::from_ref));
            delta_e_over(level, x, y, &mut out);
            largest = crate::number::larger(largest, (f64::from(out[0]) - exact).abs());
        }
        largest
    }

    proptest! {
        #[test]
        fn is_the_core(x in lab(), y in lab()) {
            prop_assume!(hue_gap(x, y) > 1e-4);
            prop_assert!(off(x, y) < 2e-4, "{}", off(x, y));
        }

        /// The small differences that tables are made of.
        #[test]
        fn is_the_core_nearby(x in lab(), d in prop::array::uniform3(-3.0..3.0_f32)) {
            let y = std::array::from_fn(|i| x[i] + d[i]);
            prop_assume!(hue_gap(x, y) > 1e-4);
            prop_assert!(off(x, y) < 1e-4, "{}", off(x, y));
        }
    }

    #[test]
    fn greys_and_what_is_no_colour() {
        for (x, y) in [
            ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0]),
            ([50.0, -1.0, 2.0], [50.0, 0.0, 0.0]),
            ([20.0, 0.0, 0.0], [70.0, 0.0, 0.0]),
        ] {
            assert!(off(x, y) < 1e-5, "{x:?} {y:?}: {}", off(x, y));
        }
        assert_eq!(delta_e([40.0_f32, 12.0, -30.0], [40.0, 12.0, -30.0]), 0.0);
        assert!(delta_e([f32::NAN, 0.0, 0.0], [50.0, 0.0, 0.0]).is_nan());
        assert!(delta_e([50.0, 1.0, 0.0], [50.0, f32::NAN, 0.0]).is_nan());
    }

    /// Opposite hues, pairs 7, 9–16 of Sharma, Wu & Dalal 2005, table 1, as printed.
    #[test]
    fn opposite_hues_are_on_the_right_side() {
        let pairs = [
            ([2.4900, -0.0010], [-2.4900, 0.0009], 7.1792),
            ([2.4900, -0.0010], [-2.4900, 0.0010], 7.1792),
            ([2.4900, -0.0010], [-2.4900, 0.0011], 7.2195),
            ([2.4900, -0.0010], [-2.4900, 0.0012], 7.2195),
            ([-0.0010, 2.4900], [0.0009, -2.4900], 4.8045),
            ([-0.0010, 2.4900], [0.0010, -2.4900], 4.8045),
            ([-0.0010, 2.4900], [0.0011, -2.4900], 4.7461),
            ([2.5000, 0.0], [0.0, -2.5000], 4.3065),
        ];
        for (index, ([a1, b1], [a2, b2], printed)) in pairs.into_iter().enumerate() {
            let got = delta_e([50.0_f32, a1, b1], [50.0, a2, b2]);
            assert!((f64::from(got) - printed).abs() < 1.5e-4, "{index}: {got} instead of {printed}");
        }
    }
}
