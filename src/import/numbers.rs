//! Numbers as people and programs write them.

use super::ImportError;
use crate::color::{Rgb, linear_from_srgb8, srgb8_from_hex};

/// Beyond this no field of a material means anything; it keeps squares and products finite.
const LARGEST: f64 = 1e6;

/// One finite number of reasonable size.
pub(super) fn number(text: &str) -> Result<f64, ImportError> {
    let value = text.trim().parse::<f64>().ok().filter(|value| value.abs() <= LARGEST);
    value.ok_or_else(|| ImportError::Number { text: shortened(text), expected: "number between -1e6 and 1e6" })
}

/// Numbers between commas, blanks and brackets of any kind.
pub(super) fn numbers(text: &str) -> Result<Vec<f64>, ImportError> {
    let words = text.split(|c: char| c.is_whitespace() || ",;()[]{}".contains(c)).filter(|word| !word.is_empty());
    words.take(64).map(number).collect()
}

/// `#rrggbb` of sRGB as linear Rec.709, whatever the space of the numbers around it; `None` for another text.
pub(super) fn hex_colour(text: &str) -> Result<Option<Rgb>, ImportError> {
    if !text.trim().starts_with('#') {
        return Ok(None);
    }
    let code = srgb8_from_hex(text).map_err(|_| not_a_colour(text))?;
    Ok(Some(linear_from_srgb8(code)))
}

/// Three numbers, or four with an opacity of 1.
pub(super) fn colour(text: &str) -> Result<Rgb, ImportError> {
    match *numbers(text)? {
        [red, green, blue] | [red, green, blue, 1.0] => Ok(Rgb([red, green, blue])),
        _ => Err(not_a_colour(text)),
    }
}

fn not_a_colour(text: &str) -> ImportError {
    ImportError::Number { text: shortened(text), expected: "colour of three numbers" }
}

/// The start of a text, for a message.
pub(super) fn shortened(text: &str) -> String {
    let text = text.trim();
    let short: String = text.chars().take(40).collect();
    if short.len() < text.len() { short + "…" } else { short }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_people_paste() {
        let colour_of = |text| colour(text).unwrap();
        for text in ["0.9, 0.7 0.3", "[0.9, 0.7, 0.3, 1.0]", "(0.9; 0.7; 0.3)"] {
            assert_eq!(colour_of(text), Rgb([0.9, 0.7, 0.3]), "{text}");
        }
        assert_eq!(hex_colour("#ffffff").unwrap(), Some(Rgb::WHITE));
        assert_eq!(hex_colour("1 1 1").unwrap(), None);
        assert!(hex_colour("#12").is_err());
    }

    #[test]
    fn refuses_what_is_no_number() {
        for text in ["NaN 0 0", "inf 0 0", "1e999 0 0", "0.9 0.7", "0 0 0 0.5", "1 2 3 4 5", "", "#12", "0x1 0 0"] {
            assert!(colour(text).is_err(), "{text}");
        }
    }
}
