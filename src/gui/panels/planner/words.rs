//! Parameters and verdicts in words.

use crate::color::Rgb;
use crate::fresnel::FresnelModel;
use crate::scene::Verdict;
use crate::study::Form;

/// `r 0.944 0.776 0.373`, or how many numbers there are.
pub(super) fn parameters(form: Option<&Form>) -> String {
    let Some(form) = form else { return "the measured n and k themselves".to_owned() };
    match form {
        Form::Model { model } => of_model(model),
        Form::Series(_) => "a polynomial for each channel".to_owned(),
        Form::Table { rows } => format!("{} colours over the angle", rows.len()),
        Form::Spectral { wavelengths_nm, .. } => format!("n and k at {} wavelengths", wavelengths_nm.len()),
    }
}

fn of_model(model: &FresnelModel) -> String {
    let pair = |symbols: [&str; 2], values: [Rgb; 2]| {
        format!("{} {}, {} {}", symbols[0], triple(values[0]), symbols[1], triple(values[1]))
    };
    match *model {
        FresnelModel::Constant { r } | FresnelModel::Schlick { r } => format!("r {}", triple(r)),
        FresnelModel::Hoffman { r, h } => pair(["r", "h"], [r, h]),
        FresnelModel::F82Tint { r, t } => pair(["r", "t"], [r, t]),
        FresnelModel::Gulbrandsen { r, g } => pair(["r", "g"], [r, g]),
        FresnelModel::Conductor { n, k } => pair(["n", "k"], [n, k]),
        FresnelModel::Lazanyi { r, a, alpha } => format!("{}, α {alpha:.2}", pair(["r", "a"], [r, a])),
        FresnelModel::GeneralizedSchlick { r0, t, p, .. } => format!("{}, p {p:.2}", pair(["r", "t"], [r0, t])),
    }
}

fn triple(values: Rgb) -> String {
    values.0.map(|value| format!("{value:.3}")).join(" ")
}

/// What became of a variant, in a word or two.
pub(super) const fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Chosen => "chosen",
        Verdict::TooFar => "too far",
        Verdict::Farther => "farther",
        Verdict::Dearer => "dearer",
    }
}

/// A ΔE with as many digits as say something.
pub(super) fn delta_e(value: f64) -> String {
    match value {
        v if v.is_nan() => "–".to_owned(),
        v if v > 0.0 && v < 0.005 => "< 0.01".to_owned(),
        v => format!("{v:.2}"),
    }
}

/// A count with thin spaces between thousands.
pub(super) fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_apart() {
        assert_eq!([0, 999, 1_000, 12_431_000].map(count), ["0", "999", "1\u{2009}000", "12\u{2009}431\u{2009}000"]);
    }

    #[test]
    fn a_small_error_is_not_called_none() {
        assert_eq!([0.0, 0.002, 0.005, 1.0].map(delta_e), ["0.00", "< 0.01", "0.01", "1.00"]);
    }
}
