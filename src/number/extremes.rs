//! Extremes in which NaN counts.
//!
//! `f64::max` returns the other value where one is NaN, so `fold(0.0, f64::max)` of a broken computation is a
//! perfect score. Here NaN wins: what was measured is then not a number, and every bound on it fails.

/// The larger of two values; NaN if either is.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// The largest value: NaN if any is, −∞ of nothing.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(f64::NEG_INFINITY, larger)
}

/// The smallest value: NaN if any is, ∞ of nothing.
pub fn smallest(values: impl IntoIterator<Item = f64>) -> f64 {
    -largest(values.into_iter().map(|value| -value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_wins_wherever_it_stands() {
        for values in [[f64::NAN, 1.0, 2.0], [1.0, f64::NAN, 2.0], [1.0, 2.0, f64::NAN], [f64::NAN; 3]] {
            assert!(largest(values).is_nan() && smallest(values).is_nan(), "{values:?}");
        }
    }

    #[test]
    fn without_nan_they_are_the_usual_ones() {
        assert_eq!((largest([1.0, 3.0, -2.0]), smallest([1.0, 3.0, -2.0])), (3.0, -2.0));
        assert_eq!((largest([]), smallest([])), (f64::NEG_INFINITY, f64::INFINITY));
        assert_eq!(largest([f64::INFINITY, 1.0]), f64::INFINITY);
    }
}
