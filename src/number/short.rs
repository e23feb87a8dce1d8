//! Numbers in sentences.

/// A number as it is usually written; with a power of ten where that would be a row of zeros.
pub fn short(value: f64) -> String {
    let is_usual = value == 0.0 || !value.is_finite() || (1e-6..1e9).contains(&value.abs());
    if is_usual { value.to_string() } else { format!("{value:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_is_a_row_of_zeros() {
        let all = [0.0, 1.7, -60.0, 1e300, 2.5e-12, f64::INFINITY];
        assert_eq!(all.map(short), ["0", "1.7", "-60", "1e300", "2.5e-12", "inf"]);
    }
}
