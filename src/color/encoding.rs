//! How people write colours down: the sRGB curve, hex codes and OKLCH.

use palette::convert::IntoColorUnclamped;
use palette::{LinSrgb, Oklch};
use thiserror::Error;

use super::{Rgb, RgbSpace};

/// The sRGB transfer curve (IEC 61966-2-1:1999), mirrored below zero so that it stays invertible.
pub fn srgb_encode(linear: f64) -> f64 {
    let magnitude = linear.abs();
    let encoded = if magnitude <= 0.003_130_8 { 12.92 * magnitude } else { 1.055 * magnitude.powf(1.0 / 2.4) - 0.055 };
    encoded.copysign(linear)
}

/// Inverse of [`srgb_encode`].
pub fn srgb_decode(encoded: f64) -> f64 {
    let magnitude = encoded.abs();
    let linear = if magnitude <= 0.040_45 { magnitude / 12.92 } else { ((magnitude + 0.055) / 1.055).powf(2.4) };
    linear.copysign(encoded)
}

/// The 8-bit sRGB code of a colour of `space`, and whether a channel had to be clipped to get there.
pub fn srgb8(rgb: Rgb, space: RgbSpace) -> ([u8; 3], bool) {
    let linear = space.convert(rgb, RgbSpace::LinRec709);
    let clipped = linear.0.iter().any(|&v| !(-5e-4..=1.0 + 5e-4).contains(&v));
    (linear.clipped().0.map(|v| (srgb_encode(v) * 255.0).round() as u8), clipped)
}

/// A `#rrggbb` code, read as sRGB.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("“{0}” is no hex colour; write six hexadecimal digits like #c89b6e")]
pub struct HexError(String);

/// Formats an 8-bit sRGB triple as `#rrggbb`.
pub fn hex_from_srgb8([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Reads `#rrggbb` or `rrggbb` as an 8-bit sRGB triple.
pub fn srgb8_from_hex(text: &str) -> Result<[u8; 3], HexError> {
    let digits = text.trim().trim_start_matches('#');
    let error = || HexError(text.trim().to_owned());
    if digits.len() != 6 || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return Err(error());
    }
    let code = u32::from_str_radix(digits, 16).map_err(|_| error())?;
    Ok([(code >> 16) as u8, (code >> 8) as u8, code as u8])
}

/// The linear Rec.709 colour of an 8-bit sRGB triple.
pub fn linear_from_srgb8(code: [u8; 3]) -> Rgb {
    Rgb(code.map(|v| srgb_decode(f64::from(v) / 255.0)))
}

/// OKLCH of a linear colour: `[lightness 0–1, chroma, hue in degrees]` (Ottosson 2020).
pub fn oklch_from_rgb(rgb: Rgb, space: RgbSpace) -> [f64; 3] {
    let [red, green, blue] = space.convert(rgb, RgbSpace::LinRec709).0;
    let oklch: Oklch<f64> = LinSrgb::new(red, green, blue).into_color_unclamped();
    [oklch.l, oklch.chroma, oklch.hue.into_positive_degrees()]
}

/// The linear colour of `space` at an OKLCH; inverse of [`oklch_from_rgb`].
pub fn rgb_from_oklch([lightness, chroma, hue_deg]: [f64; 3], space: RgbSpace) -> Rgb {
    let linear: LinSrgb<f64> = Oklch::new(lightness, chroma, hue_deg).into_color_unclamped();
    RgbSpace::LinRec709.convert(Rgb([linear.red, linear.green, linear.blue]), space)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_inverts_and_mirrors() {
        for step in -200..=200 {
            let linear = f64::from(step) / 100.0;
            // The standard's two pieces meet within 2e-8, which bounds the round trip.
            assert!((srgb_decode(srgb_encode(linear)) - linear).abs() < 1e-7);
            assert_eq!(srgb_encode(-linear), -srgb_encode(linear));
        }
        assert!((srgb_encode(1.0) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn every_code_survives_hex_and_linear() {
        for value in 0..=255u8 {
            let code = [value, 255 - value, value / 2];
            assert_eq!(srgb8_from_hex(&hex_from_srgb8(code)), Ok(code));
            assert_eq!(srgb8(linear_from_srgb8(code), RgbSpace::LinRec709), (code, false));
        }
    }

    #[test]
    fn bad_hex_is_refused() {
        for text in ["", "#12345", "1234567", "#12g456", "#é1234"] {
            assert!(srgb8_from_hex(text).is_err(), "{text}");
        }
    }

    #[test]
    fn clipping_is_reported() {
        assert!(srgb8(Rgb([1.02, 0.5, 0.5]), RgbSpace::LinRec709).1);
        assert!(srgb8(Rgb([1.0, 0.0, 0.0]), RgbSpace::AcesCg).1);
    }

    #[test]
    fn oklch_inverts_in_every_space() {
        let colour = Rgb([0.8, 0.5, 0.2]);
        for space in RgbSpace::ALL {
            let back = rgb_from_oklch(oklch_from_rgb(colour, space), space);
            assert!(back.max_abs_difference(colour) < 1e-5, "{space} {back:?}");
        }
    }

    /// Ottosson's definition: white is L = 1, no chroma.
    #[test]
    fn oklch_of_white() {
        let [lightness, chroma, _] = oklch_from_rgb(Rgb::WHITE, RgbSpace::AcesCg);
        assert!((lightness - 1.0).abs() < 1e-5 && chroma < 1e-5, "{lightness} {chroma}");
    }
}
