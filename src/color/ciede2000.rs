//! The CIEDE2000 colour difference.
//!
//! Written out rather than taken from a crate: in 64 bits the published crates are either
//! off by 8e-5 on Sharma's table or carry a colorimetry framework this project does not need.
//!
//! Hues are directions in the plane of a′ and b′, not angles, which would be taken apart by sines and cosines again:
//! ΔH comes from their cross product, and the mean hue is the direction of their sum, or for obtuse angles at right
//! angles to their difference.

use super::{Lab, Rgb, RgbSpace};

/// CIEDE2000 with kL = kC = kH = 1 (CIE 142-2001; Sharma, Wu & Dalal 2005, eqs. 2–22).
///
/// At a hue difference of exactly 180° the mean hue is ambiguous; this takes the branch of Sharma's eq. 14.
pub fn delta_e_2000(x: Lab, y: Lab) -> f64 {
    let mean_chroma = (length(x.a, x.b) + length(y.a, y.b)) / 2.0;
    let stretch = 1.0 + 0.5 * (1.0 - saturation_of_chroma(mean_chroma));
    let (first, second) = ([x.a * stretch, x.b], [y.a * stretch, y.b]);
    let (c1, c2) = (length(first[0], first[1]), length(second[0], second[1]));
    let Hues { dh, mean } = Hues::of(first, c1, second, c2);

    let dl = y.lightness - x.lightness;
    let dc = c2 - c1;
    let l_mean = (x.lightness + y.lightness) / 2.0;
    let c_mean = (c1 + c2) / 2.0;

    let sl = 1.0 + 0.015 * (l_mean - 50.0).powi(2) / (20.0 + (l_mean - 50.0).powi(2)).sqrt();
    let sc = 1.0 + 0.045 * c_mean;
    let sh = 1.0 + 0.015 * c_mean * hue_weight(mean);
    let rt = -sine_of_rotation(mean) * 2.0 * saturation_of_chroma(c_mean);

    let (l, c, h) = (dl / sl, dc / sc, dh / sh);
    let square = l * l + c * c + h * h + rt * c * h;
    // Rounding can make it slightly negative; NaN stays NaN.
    if square < 0.0 { 0.0 } else { square.sqrt() }
}

/// What two hues say.
struct Hues {
    /// ΔH′ (Sharma's eq. 11).
    dh: f64,
    /// Cosine and sine of the mean hue (eq. 14).
    mean: [f64; 2],
}

impl Hues {
    /// A product of chromas below this is a grey's: its hue is noise, and its square would not be a number.
    const GREY: f64 = 1e-140;

    /// From (a′, b′) of two colours and their chromas. A grey takes the hue of the other.
    fn of([a1, b1]: [f64; 2], c1: f64, [a2, b2]: [f64; 2], c2: f64) -> Self {
        let product = c1 * c2;
        if product < Self::GREY {
            return Self { dh: 0.0, mean: direction(a1 + a2, b1 + b2) };
        }
        let (cross, dot) = (a1 * b2 - b1 * a2, a1 * a2 + b1 * b2);
        let chord = (2.0 * (product + dot.abs())).sqrt();
        let (x1, x2, y1, y2) = (a1 * c2, a2 * c1, b1 * c2, b2 * c1);
        if dot < 0.0 {
            // At exactly 180° the second hue is the larger where the first is of the upper half.
            let is_first_above = b1 > 0.0 || (b1 == 0.0 && a1 > 0.0);
            let side = if cross > 0.0 || (cross == 0.0 && is_first_above) { 1.0 } else { -1.0 };
            Self { dh: side * chord, mean: direction(side * (y2 - y1), side * (x1 - x2)) }
        } else {
            Self { dh: 2.0 * cross / chord, mean: direction(x1 + x2, y1 + y2) }
        }
    }
}

/// Cosine and sine of the direction of a vector; of none, those of 0°.
fn direction(x: f64, y: f64) -> [f64; 2] {
    let length = length(x, y);
    if length == 0.0 { [1.0, 0.0] } else { [x / length, y / length] }
}

fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// CIEDE2000 between two linear colours of one space, each relative to that space's white.
pub fn delta_e_rgb(x: Rgb, y: Rgb, space: RgbSpace) -> f64 {
    delta_e_2000(Lab::from_rgb(x, space), Lab::from_rgb(y, space))
}

/// √(C⁷ / (C⁷ + 25⁷)), the factor that appears in eqs. 4 and 17.
fn saturation_of_chroma(chroma: f64) -> f64 {
    let c7 = chroma.powi(7);
    (c7 / (c7 + 25.0_f64.powi(7))).sqrt()
}

/// T of the mean hue (eq. 15); cosines of its multiples are polynomials of its own.
fn hue_weight([cos, sin]: [f64; 2]) -> f64 {
    let (cos2, sin2) = (cos * cos - sin * sin, 2.0 * sin * cos);
    let (cos3, sin3) = (cos * cos2 - sin * sin2, sin * cos2 + cos * sin2);
    let (cos4, sin4) = (cos2 * cos2 - sin2 * sin2, 2.0 * sin2 * cos2);
    let turned = |[c, s]: [f64; 2], cos: f64, sin: f64| cos * c + sin * s;
    1.0 - 0.17 * turned(AT_30, cos, sin) + 0.24 * cos2 + 0.32 * turned(AT_MINUS_6, cos3, sin3)
        - 0.20 * turned(AT_63, cos4, sin4)
}

/// Cosine and sine of 30°, −6° and 63°.
const AT_30: [f64; 2] = [0.866_025_403_784_438_6, 0.5];
const AT_MINUS_6: [f64; 2] = [0.994_521_895_368_273_3, -0.104_528_463_267_653_47];
const AT_63: [f64; 2] = [0.453_990_499_739_546_8, 0.891_006_524_188_367_9];

/// sin(2Δθ) with Δθ = 30° exp(−((h − 275°)/25°)²) (eqs. 16 and 22).
fn sine_of_rotation([cos, sin]: [f64; 2]) -> f64 {
    /// Cosine of 125°: from 0° to there, more than 150° from 275°, the rotation is less than the rounding of ΔE.
    const FAR: f64 = -0.573_576_436_351_046_1;
    if sin >= 0.0 && cos > FAR {
        return 0.0;
    }
    let hue_deg = sin.atan2(cos).to_degrees().rem_euclid(360.0);
    (60.0_f64.to_radians() * (-((hue_deg - 275.0) / 25.0).powi(2)).exp()).sin()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const fn lab(lightness: f64, a: f64, b: f64) -> Lab {
        Lab { lightness, a, b }
    }

    #[test]
    fn agrees_with_sharmas_table() {
        for (index, (x, y, printed)) in crate::color::SHARMA.into_iter().enumerate() {
            let got = delta_e_2000(x, y);
            assert!((got - printed).abs() <= 5.1e-5, "pair {}: {got} instead of {printed}", index + 1);
        }
    }

    /// Sharma's equations with hues as angles, as they are printed.
    fn by_angles(x: Lab, y: Lab) -> f64 {
        let hue = |a: f64, b: f64| if a == 0.0 && b == 0.0 { 0.0 } else { b.atan2(a).to_degrees().rem_euclid(360.0) };
        let cos = |deg: f64| deg.to_radians().cos();
        let stretch = 1.5 - 0.5 * saturation_of_chroma((x.a.hypot(x.b) + y.a.hypot(y.b)) / 2.0);
        let (a1, a2) = (stretch * x.a, stretch * y.a);
        let (c1, c2) = (a1.hypot(x.b), a2.hypot(y.b));
        let (h1, h2) = (hue(a1, x.b), hue(a2, y.b));
        let (dh, h) = match (h2 - h1, h1 + h2) {
            (_, sum) if c1 * c2 == 0.0 => (0.0, sum),
            (d, sum) if d.abs() <= 180.0 => (d, sum / 2.0),
            (d, sum) => (d - 360.0 * d.signum(), if sum < 360.0 { (sum + 360.0) / 2.0 } else { (sum - 360.0) / 2.0 }),
        };
        let (l, c) = ((x.lightness + y.lightness) / 2.0, (c1 + c2) / 2.0);
        let t =
            1.0 - 0.17 * cos(h - 30.0) + 0.24 * cos(2.0 * h) + 0.32 * cos(3.0 * h + 6.0) - 0.20 * cos(4.0 * h - 63.0);
        let rotation = 60.0_f64.to_radians() * (-((h - 275.0) / 25.0).powi(2)).exp();
        let dl = (y.lightness - x.lightness) / (1.0 + 0.015 * (l - 50.0).powi(2) / (20.0 + (l - 50.0).powi(2)).sqrt());
        let dc = (c2 - c1) / (1.0 + 0.045 * c);
        let dh = 2.0 * (c1 * c2).sqrt() * (dh / 2.0).to_radians().sin() / (1.0 + 0.015 * c * t);
        (dl * dl + dc * dc + dh * dh - rotation.sin() * 2.0 * saturation_of_chroma(c) * dc * dh).max(0.0).sqrt()
    }

    fn any_lab() -> impl Strategy<Value = Lab> {
        (0.0..110.0, -100.0..100.0, -100.0..100.0).prop_map(|(l, a, b)| lab(l, a, b))
    }

    proptest! {
        #[test]
        fn is_the_formula_with_angles(x in any_lab(), y in any_lab(), near in 0.0..1.0_f64) {
            let between = |x: f64, y: f64| x + (y - x) * near * near * near;
            let nearby = lab(between(x.lightness, y.lightness), between(x.a, y.a), between(x.b, y.b));
            for (x, y) in [(x, y), (x, nearby), (x, lab(50.0, 0.0, 0.0)), (lab(50.0, 0.0, 0.0), y)] {
                // Next to opposite hues rounding decides between two.
                let dot = x.a * y.a + x.b * y.b;
                if dot >= 0.0 || (x.a * y.b - x.b * y.a).abs() > -1e-6 * dot {
                    let (got, expected) = (delta_e_2000(x, y), by_angles(x, y));
                    prop_assert!((got - expected).abs() < 1e-9, "{x:?} {y:?}: {got} {expected}");
                }
            }
        }
    }

    #[test]
    fn the_same_colour_has_no_difference() {
        for colour in [lab(50.0, 0.0, 0.0), lab(80.0, 3.0, 40.0), lab(20.0, -1e-9, 1e-9), lab(60.0, 1e-160, 0.0)] {
            assert_eq!(delta_e_2000(colour, colour), 0.0, "{colour:?}");
        }
    }

    #[test]
    fn what_is_no_colour_has_no_difference() {
        assert!(delta_e_2000(lab(f64::NAN, 0.0, 0.0), lab(50.0, 0.0, 0.0)).is_nan());
        assert!(delta_e_rgb(Rgb::splat(f64::NAN), Rgb::WHITE, RgbSpace::AcesCg).is_nan());
    }

    #[test]
    fn agrees_with_an_independent_implementation() {
        use palette::color_difference::Ciede2000;
        let palette = |l: Lab| palette::Lab::<palette::white_point::D65, f64>::new(l.lightness, l.a, l.b);
        for (x, y, _) in crate::color::SHARMA {
            assert!((delta_e_2000(x, y) - palette(x).difference(palette(y))).abs() < 1e-4);
        }
    }
}
