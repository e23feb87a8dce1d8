//! The CIEDE2000 colour difference.
//!
//! Written out rather than taken from a crate: in 64 bits the published crates are either
//! off by 8e-5 on Sharma's table or carry a colorimetry framework this project does not need.

use super::{Lab, Rgb, RgbSpace};

/// CIEDE2000 with kL = kC = kH = 1 (CIE 142-2001; Sharma, Wu & Dalal 2005, eqs. 2–22).
///
/// At a hue difference of exactly 180° the mean hue is ambiguous; this takes the branch of Sharma's eq. 14.
pub fn delta_e_2000(x: Lab, y: Lab) -> f64 {
    let mean_chroma = (x.a.hypot(x.b) + y.a.hypot(y.b)) / 2.0;
    let g = 0.5 * (1.0 - saturation_of_chroma(mean_chroma));
    let (a1, a2) = ((1.0 + g) * x.a, (1.0 + g) * y.a);
    let (c1, c2) = (a1.hypot(x.b), a2.hypot(y.b));
    let (h1, h2) = (hue_deg(a1, x.b), hue_deg(a2, y.b));
    let is_grey = c1 * c2 == 0.0;

    let dl = y.lightness - x.lightness;
    let dc = c2 - c1;
    let dh = if is_grey { 0.0 } else { 2.0 * (c1 * c2).sqrt() * (hue_difference_deg(h1, h2) / 2.0).to_radians().sin() };

    let l_mean = (x.lightness + y.lightness) / 2.0;
    let c_mean = (c1 + c2) / 2.0;
    let h_mean = if is_grey { h1 + h2 } else { mean_hue_deg(h1, h2) };

    let sl = 1.0 + 0.015 * (l_mean - 50.0).powi(2) / (20.0 + (l_mean - 50.0).powi(2)).sqrt();
    let sc = 1.0 + 0.045 * c_mean;
    let sh = 1.0 + 0.015 * c_mean * hue_weight(h_mean);
    let rotation = 60.0_f64.to_radians() * (-((h_mean - 275.0) / 25.0).powi(2)).exp();
    let rt = -rotation.sin() * 2.0 * saturation_of_chroma(c_mean);

    let (l, c, h) = (dl / sl, dc / sc, dh / sh);
    let square = l * l + c * c + h * h + rt * c * h;
    // Rounding can make it slightly negative; NaN stays NaN.
    if square < 0.0 { 0.0 } else { square.sqrt() }
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

fn hue_deg(a: f64, b: f64) -> f64 {
    if a == 0.0 && b == 0.0 { 0.0 } else { b.atan2(a).to_degrees().rem_euclid(360.0) }
}

fn hue_difference_deg(h1: f64, h2: f64) -> f64 {
    match h2 - h1 {
        d if d > 180.0 => d - 360.0,
        d if d < -180.0 => d + 360.0,
        d => d,
    }
}

fn mean_hue_deg(h1: f64, h2: f64) -> f64 {
    let sum = h1 + h2;
    if (h1 - h2).abs() <= 180.0 {
        sum / 2.0
    } else if sum < 360.0 {
        (sum + 360.0) / 2.0
    } else {
        (sum - 360.0) / 2.0
    }
}

fn hue_weight(h_mean: f64) -> f64 {
    let cos = |deg: f64| deg.to_radians().cos();
    1.0 - 0.17 * cos(h_mean - 30.0) + 0.24 * cos(2.0 * h_mean) + 0.32 * cos(3.0 * h_mean + 6.0)
        - 0.20 * cos(4.0 * h_mean - 63.0)
}

#[cfg(test)]
mod tests {
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
