//! The middle value.

/// The middle of sorted items by their value, halfway between the two of an even number; NaN of nothing.
pub fn median_of_sorted<T>(sorted: &[T], value: impl Fn(&T) -> f64) -> f64 {
    match sorted.len() {
        0 => f64::NAN,
        count if count % 2 == 1 => value(&sorted[count / 2]),
        count => 0.5 * (value(&sorted[count / 2 - 1]) + value(&sorted[count / 2])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_an_even_number_is_between() {
        let of = |sorted: &[f64]| median_of_sorted(sorted, |value| *value);
        assert_eq!(of(&[1.0, 2.0, 3.0, 4.0]), 2.5);
        assert_eq!(of(&[1.0, 2.0, 3.0]), 2.0);
        assert!(of(&[]).is_nan());
    }
}
