//! L*a*b* and CIEDE2000 in high precision: what rounding of colours is measured against.
//!
//! Written from the standards, with angles in degrees; the matrix is that of the primaries, not of its rounding.

use super::exact::Exact;
use crate::color::{Chromaticity, RgbSpace};

/// From linear RGB of one space to L*a*b* relative to its white.
#[derive(Clone, Debug)]
pub(super) struct ExactLab {
    /// Rows of X, Y and Z over the white's.
    rows: [[Exact; 3]; 3],
}

impl ExactLab {
    /// SMPTE RP 177-1993, section 3.3: the primaries in those amounts that together are the white.
    pub(super) fn new(space: RgbSpace) -> Self {
        let primaries = space.primaries().map(xyz);
        let white = xyz(space.white());
        let whole = determinant([&primaries[0], &primaries[1], &primaries[2]]);
        let amount = |channel: usize| {
            let mut columns = primaries.each_ref();
            columns[channel] = &white;
            &determinant(columns) / &whole
        };
        let amounts = [0, 1, 2].map(amount);
        let element = |row: usize, column: usize| &(&primaries[column][row] * &amounts[column]) / &white[row];
        Self { rows: [0, 1, 2].map(|row| [0, 1, 2].map(|column| element(row, column))) }
    }

    /// L* (CIE 15:2018, eqs. 8.3–8.7); the toe continues below 0.
    pub(super) fn lightness(&self, rgb: &[f64]) -> Exact {
        Exact::whole(116) * self.root(1, rgb) - Exact::whole(16)
    }

    /// a*.
    pub(super) fn a(&self, rgb: &[f64]) -> Exact {
        Exact::whole(500) * (self.root(0, rgb) - self.root(1, rgb))
    }

    /// b*.
    pub(super) fn b(&self, rgb: &[f64]) -> Exact {
        Exact::whole(200) * (self.root(1, rgb) - self.root(2, rgb))
    }

    /// Of X, Y or Z.
    fn root(&self, row: usize, rgb: &[f64]) -> Exact {
        cube_root_with_toe(&self.rows[row].iter().zip(rgb).map(|(factor, x)| factor * &Exact::of(*x)).sum::<Exact>())
    }

    #[cfg(test)]
    fn lab(&self, rgb: &[f64]) -> [Exact; 3] {
        [self.lightness(rgb), self.a(rgb), self.b(rgb)]
    }
}

/// Chromaticities are defined by at most five decimals, which no binary number is.
fn xyz(Chromaticity { x, y }: Chromaticity) -> [Exact; 3] {
    let [x, y] = [x, y].map(|value| Exact::hundred_thousandths((value * 1e5).round() as i32));
    let z = Exact::whole(1) - x.clone() - y.clone();
    [&x / &y, Exact::whole(1), &z / &y]
}

fn determinant([a, b, c]: [&[Exact; 3]; 3]) -> Exact {
    let minor = |i: usize, j: usize| &b[i] * &c[j] - &b[j] * &c[i];
    &a[0] * &minor(1, 2) + &a[1] * &minor(2, 0) + &a[2] * &minor(0, 1)
}

fn cube_root_with_toe(ratio: &Exact) -> Exact {
    let delta = Exact::whole(6) / Exact::whole(29);
    if ratio.is_above(&delta.whole_power(3)) {
        return ratio.cube_root();
    }
    ratio / &(Exact::whole(3) * delta.whole_power(2)) + Exact::whole(4) / Exact::whole(29)
}

/// CIEDE2000 with kL = kC = kH = 1 of two L*a*b* colours (Sharma, Wu & Dalal 2005, eqs. 2–22).
pub(super) fn delta_e_2000(x: &[f64], y: &[f64]) -> Exact {
    let (one, two) = (Exact::whole(1), Exact::whole(2));
    let [(l1, a1, b1), (l2, a2, b2)] = [x, y].map(|lab| (Exact::of(lab[0]), Exact::of(lab[1]), Exact::of(lab[2])));
    let mean_chroma = (length(&a1, &b1) + length(&a2, &b2)) / two.clone();
    let stretch = &one + &((&one - &saturation(&mean_chroma)) / two.clone());
    let (x, y) = ([&a1 * &stretch, b1], [&a2 * &stretch, b2]);
    let (c1, c2) = (length(&x[0], &x[1]), length(&y[0], &y[1]));
    let Hues { difference_deg, mean_deg } = Hues::of(&x, &y);

    let dl = &l2 - &l1;
    let dc = &c2 - &c1;
    let dh = &two * &(&c1 * &c2).sqrt() * (difference_deg / two.clone()).sin_deg();
    let from_50 = (l1 + l2) / two.clone() - Exact::whole(50);
    let square = &from_50 * &from_50;
    let c_mean = (c1 + c2) / two.clone();
    let sl = &one + &(&(decimal(1500) * square.clone()) / &(square + Exact::whole(20)).sqrt());
    let sc = &one + &(decimal(4500) * c_mean.clone());
    let sh = &one + &(decimal(1500) * c_mean.clone() * hue_weight(&mean_deg));
    let rt = saturation(&c_mean) * two * rotation(&mean_deg).sin_deg();

    let (l, c, h) = (dl / sl, dc / sc, dh / sh);
    (&l * &l + &c * &c + &h * &h - rt * c * h).sqrt()
}

/// A constant of the formula, in units of the fifth decimal.
fn decimal(hundred_thousandths: i32) -> Exact {
    Exact::hundred_thousandths(hundred_thousandths)
}

fn length(x: &Exact, y: &Exact) -> Exact {
    (x * x + y * y).sqrt()
}

/// √(C⁷ / (C⁷ + 25⁷)).
fn saturation(chroma: &Exact) -> Exact {
    let c7 = chroma.whole_power(7);
    (&c7 / &(c7.clone() + Exact::whole(25).whole_power(7))).sqrt()
}

/// Eq. 15: T.
fn hue_weight(mean_deg: &Exact) -> Exact {
    let cosine = |times: i32, turned: i32| (Exact::whole(times) * mean_deg.clone() + Exact::whole(turned)).cos_deg();
    let terms = [(-17_000, 1, -30), (24_000, 2, 0), (32_000, 3, 6), (-20_000, 4, -63)];
    Exact::whole(1)
        + terms.into_iter().map(|(weight, times, turned)| decimal(weight) * cosine(times, turned)).sum::<Exact>()
}

/// Eq. 16: twice Δθ, in degrees.
fn rotation(mean_deg: &Exact) -> Exact {
    let in_25_deg = (mean_deg.clone() - Exact::whole(275)) / Exact::whole(25);
    Exact::whole(60) * (Exact::whole(0) - &in_25_deg * &in_25_deg).exp()
}

/// Eqs. 7, 10 and 14.
struct Hues {
    difference_deg: Exact,
    mean_deg: Exact,
}

impl Hues {
    /// Of the two directions (a′, b). A grey has no hue: the difference is 0 and the mean is the other's.
    ///
    /// Exactly opposite ones take the mean that is half the sum. On one side of there the mean lies there too, on the
    /// other it is half a turn away and ΔE another: the definition has a jump.
    fn of(x: &[Exact; 2], y: &[Exact; 2]) -> Self {
        let (zero, half_turn, turn) = (Exact::whole(0), Exact::whole(180), Exact::whole(360));
        let [h1, h2] = [x, y].map(|[a, b]| if is_grey(a, b) { zero.clone() } else { Exact::direction_deg(a, b) });
        let (apart, sum) = (&h2 - &h1, &h1 + &h2);
        if is_grey(&x[0], &x[1]) || is_grey(&y[0], &y[1]) {
            return Self { difference_deg: zero, mean_deg: sum };
        }
        // A difference of rounded angles would not tell exactly opposite hues.
        let is_along_one_line = is_hair(&(&x[0] * &y[1]), &(&x[1] * &y[0]));
        let half_sum = &sum / &Exact::whole(2);
        let is_wide = !is_along_one_line && (apart.is_above(&half_turn) || (&zero - &half_turn).is_above(&apart));
        if !is_wide {
            return Self { difference_deg: apart, mean_deg: half_sum };
        }
        let difference_deg = if apart.is_above(&zero) { apart - turn.clone() } else { apart + turn.clone() };
        let mean_deg = if turn.is_above(&sum) { half_sum + half_turn } else { half_sum - half_turn };
        Self { difference_deg, mean_deg }
    }
}

fn is_grey(a: &Exact, b: &Exact) -> bool {
    a.is_zero() && b.is_zero()
}

/// Equal but for the rounding of 512 bits. Numbers of 64 bits that differ, or their products, do so by more than 1e-40.
fn is_hair(x: &Exact, y: &Exact) -> bool {
    (x - y).to_f64().abs() <= 1e-100 * (x.to_f64().abs() + y.to_f64().abs())
}

/// Whether two hues are within 1e-6 of opposite, in radians of the plane of a* and b*: what 32 bits may take for either
/// side of where CIEDE2000 jumps.
pub(super) fn are_nearly_opposite(x: &[f64], y: &[f64]) -> bool {
    let ([a1, b1], [a2, b2]) = ([x[1], x[2]], [y[1], y[2]]);
    let (cross, dot) = (a1 * b2 - b1 * a2, a1 * a2 + b1 * b2);
    dot < 0.0 && cross.abs() <= 1e-6 * a1.hypot(b1) * a2.hypot(b2)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::color::{Lab, Rgb, SHARMA, delta_e_2000 as core};

    fn numbers(Lab { lightness, a, b }: Lab) -> [f64; 3] {
        [lightness, a, b]
    }

    #[test]
    fn agrees_with_sharmas_table() {
        for (index, (x, y, printed)) in SHARMA.into_iter().enumerate() {
            let (x, y) = (numbers(x), numbers(y));
            for got in [delta_e_2000(&x, &y), delta_e_2000(&y, &x)] {
                let off = got.to_f64() - printed;
                assert!(off.abs() <= 5e-5, "pair {}: {} instead of {printed}", index + 1, got.to_f64());
            }
        }
    }

    /// Sharma's pairs 10 and 11: the second hue passes the opposite of the first, and ΔE jumps by .04.
    #[test]
    fn opposite_hues_are_where_the_definition_jumps() {
        let x = [50.0, 2.49, -0.001];
        let of = |b: f64| delta_e_2000(&x, &[50.0, -2.49, b]).to_f64();
        let (before, at, after) = (of(0.001_f64.next_down()), of(0.001), of(0.001_f64.next_up()));
        assert!((before - at).abs() < 1e-12 && (after - at - 0.0403).abs() < 1e-4, "{before} {at} {after}");
        assert!(are_nearly_opposite(&x, &[50.0, -2.49, 0.001_001]) && !are_nearly_opposite(&x, &[50.0, -2.49, 0.0011]));
        assert!(!are_nearly_opposite(&x, &x) && !are_nearly_opposite(&x, &[50.0, 0.0, 0.0]));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn differences_are_the_cores(x in prop::array::uniform3(-90.0..100.0), y in prop::array::uniform3(-90.0..100.0)) {
            let lab = |[lightness, a, b]: [f64; 3]| Lab { lightness, a, b };
            prop_assume!(!are_nearly_opposite(&x, &y));
            let (exact, core) = (delta_e_2000(&x, &y).to_f64(), core(lab(x), lab(y)));
            prop_assert!((exact - core).abs() < 1e-10, "{exact} {core}");
        }

        #[test]
        fn colours_are_the_cores(rgb in prop::array::uniform3(prop_oneof![-0.5..4.0, -0.01..0.02])) {
            for space in RgbSpace::ALL {
                let exact = ExactLab::new(space).lab(&rgb).map(|value| value.to_f64());
                let core = numbers(Lab::from_rgb(Rgb(rgb), space));
                for (exact, core) in exact.into_iter().zip(core) {
                    prop_assert!((exact - core).abs() < 1e-10, "{space}: {exact} {core}");
                }
            }
        }
    }

    /// To more digits than 64 bits have.
    #[test]
    fn white_is_exactly_white() {
        for space in RgbSpace::ALL {
            let [lightness, a, b] = ExactLab::new(space).lab(&[1.0; 3]);
            let off = [lightness - Exact::whole(100), a, b].map(|value| value.to_f64().abs());
            assert!(off.iter().all(|off| *off < 1e-50), "{space}: {off:?}");
        }
    }
}
