//! Numbers as text that every reader takes: a point, no exponent, no more digits than a float holds.

use crate::color::Rgb;

/// At most nine significant digits, which is what an `f32` needs to survive; always with a point.
///
/// `-0` is written as `0.0`. Callers have refused what is not finite.
pub(super) fn number(value: f64) -> String {
    let text = rounded(value).to_string();
    if text.contains('.') { text } else { text + ".0" }
}

/// The nearest number with nine significant digits; `-0` becomes 0.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.8e}").parse::<f64>().unwrap_or(value) + 0.0
}

/// Three [`number`]s with a separator.
pub(super) fn triple(rgb: Rgb, separator: &str) -> String {
    rgb.0.map(number).join(separator)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn survives_as_single_precision(value in -1e6_f32..1e6) {
            prop_assert_eq!(number(f64::from(value)).parse::<f32>().unwrap(), value);
        }

        #[test]
        fn has_a_point_and_no_exponent(value in -1e-12_f64..1e12) {
            let text = number(value);
            prop_assert!(text.contains('.') && !text.contains(['e', 'E']), "{}", text);
        }
    }

    #[test]
    fn is_short() {
        assert_eq!(number(0.1 + 0.2), "0.3");
        assert_eq!(number(1.0), "1.0");
        assert_eq!(number(-0.0), "0.0");
        assert_eq!(triple(Rgb([1.0, 0.5, 1.0 / 3.0]), ", "), "1.0, 0.5, 0.333333333");
    }
}
