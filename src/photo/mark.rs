//! How marks are written on the command line: numbers with commas, and what is wrong with them.

use thiserror::Error;

/// Why a text is no mark.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MarkError {
    /// Not the expected count of numbers.
    #[error("“{text}” is no {what}; write it as {form}")]
    Form {
        /// The text as given.
        text: String,
        /// The noun of the mark.
        what: &'static str,
        /// How it is written.
        form: &'static str,
    },
    /// A size that is zero, negative or not finite.
    #[error("“{text}”: the {size} must be above 0")]
    NoSize {
        /// The text as given.
        text: String,
        /// Which size.
        size: &'static str,
    },
    /// A reflectance outside (0, 1].
    #[error("“{text}”: the reflectance must be above 0 and at most 1, like 0.18 or 0.9")]
    Reflectance {
        /// The text as given.
        text: String,
    },
    /// An angle of incidence outside [0°, 90°).
    #[error("the angle of incidence is {angle_deg}°; it must be at least 0° and below 90°")]
    Angle {
        /// The angle as given, in degrees.
        angle_deg: f64,
    },
    /// A metal the library does not hold.
    #[error(transparent)]
    Metal(#[from] crate::metal::UnknownMetal),
}

impl MarkError {
    pub(super) fn form(text: &str, what: &'static str, form: &'static str) -> Self {
        Self::Form { text: text.to_owned(), what, form }
    }
}

/// Finite numbers separated by commas; `None` when one is not a finite number.
pub(super) fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',').map(|part| part.trim().parse().ok().filter(|number: &f64| number.is_finite())).collect()
}

/// Checks that a size is above zero.
pub(super) fn positive(text: &str, size: &'static str, value: f64) -> Result<f64, MarkError> {
    if value > 0.0 { Ok(value) } else { Err(MarkError::NoSize { text: text.to_owned(), size }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_finite_numbers_only() {
        assert_eq!(numbers("1, 2.5,-3"), Some(vec![1.0, 2.5, -3.0]));
        for text in ["", "1,,2", "1;2", "nan,1", "inf"] {
            assert_eq!(numbers(text), None, "{text}");
        }
    }
}
