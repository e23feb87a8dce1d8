//! The middle value.

/// The middle of sorted items by their value, halfway between the two of an even number; NaN of nothing.
pub fn median_of_sorted<T>(sorted: &[T], value: impl Fn(&T) -> f64) -> f64 {
    match sorted.len() {
        0 => f64::NAN,
        count if count % 2 == 1 => value(&sorted[count / 2]),
        count => 0.5 * (value(&sorted[count / 2 - 1]) + value(&sorted[count / 2])),
    }
}

/// The middle of values in any order, which it reorders; NaN of nothing.
pub fn median(values: &mut [f64]) -> f64 {
    if values.is_empty() {
        return f64::NAN;
    }
    let middle = values.len() / 2;
    let is_odd = values.len() % 2 == 1;
    let (below, upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    let lower = below.iter().copied().max_by(f64::total_cmp).filter(|_| !is_odd);
    lower.map_or(*upper, |lower| 0.5 * (lower + *upper))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_order_gives_the_same_middle() {
        assert_eq!(median(&mut [4.0, 1.0, 3.0, 2.0]), 2.5);
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), 2.0);
        assert!(median(&mut []).is_nan());
    }

    #[test]
    fn the_middle_of_an_even_number_is_between() {
        let of = |sorted: &[f64]| median_of_sorted(sorted, |value| *value);
        assert_eq!(of(&[1.0, 2.0, 3.0, 4.0]), 2.5);
        assert_eq!(of(&[1.0, 2.0, 3.0]), 2.0);
        assert!(of(&[]).is_nan());
    }
}
