//! Numbers as text that every reader takes: a point, no exponent, no more digits than a float holds.

use std::io::Write as _;

use crate::color::Rgb;

/// At most nine significant digits, which is what an `f32` needs to survive; always with a point.
///
/// `-0` is written as `0.0`. Callers have refused what is not finite.
pub(super) fn number(value: f64) -> String {
    let scientific = Scientific::of(value);
    let digits = scientific.digits();
    let (before, zeros) = match scientific.exponent {
        exponent @ 0.. => (exponent as usize + 1, 0),
        exponent => (0, exponent.unsigned_abs() as usize - 1),
    };
    let (whole, fraction) = digits.split_at(before.min(digits.len()));
    let mut text = String::from(if scientific.is_negative { "-" } else { "" });
    text.push_str(if whole.is_empty() { "0" } else { whole });
    text.extend(std::iter::repeat_n('0', before - whole.len()));
    text.push('.');
    text.extend(std::iter::repeat_n('0', zeros));
    text.push_str(if fraction.is_empty() { "0" } else { fraction });
    text
}

/// Nine significant digits and where their point is, rounded as the standard library does it: exactly.
struct Scientific {
    is_negative: bool,
    digits: [u8; DIGITS],
    exponent: i32,
}

const DIGITS: usize = 9;

impl Scientific {
    fn of(value: f64) -> Self {
        let mut buffer = [b' '; 32];
        write!(&mut buffer[..], "{:.*e}", DIGITS - 1, value.abs()).expect("a number of nine digits is shorter");
        let mut digits = [buffer[0]; DIGITS];
        digits[1..].copy_from_slice(&buffer[2..=DIGITS]);
        let exponent = std::str::from_utf8(&buffer[DIGITS + 2..]).ok().and_then(|text| text.trim_end().parse().ok());
        Self { is_negative: value < 0.0, digits, exponent: exponent.unwrap_or_default() }
    }

    /// The digits up to the last that is not zero; one at least.
    fn digits(&self) -> &str {
        let last = self.digits.iter().rposition(|digit| *digit != b'0').unwrap_or_default();
        std::str::from_utf8(&self.digits[..=last]).unwrap_or_default()
    }
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

    proptest! {
        #[test]
        fn reads_as_the_rounded_number(value in prop_oneof![-10.0..10.0, -1e13..1e13, -1e-9..1e-9]) {
            prop_assert_eq!(number(value).parse::<f64>().unwrap(), rounded(value));
        }
    }

    #[test]
    fn is_short() {
        assert_eq!(number(123.0), "123.0");
        assert_eq!(number(-1234567890.0), "-1234567890.0");
        assert_eq!(number(0.999_999_999_9), "1.0");
        assert_eq!(number(-0.000_123), "-0.000123");
        assert_eq!(number(0.1 + 0.2), "0.3");
        assert_eq!(number(1.0), "1.0");
        assert_eq!(number(-0.0), "0.0");
        assert_eq!(triple(Rgb([1.0, 0.5, 1.0 / 3.0]), ", "), "1.0, 0.5, 0.333333333");
    }
}
