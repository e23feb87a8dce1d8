//! Many errors in one line: quartiles, mean and the worst.

use serde::Serialize;

use super::parameters::Parameters;

/// How a measure is spread over materials. The field names are stable.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Distribution {
    /// Number of values.
    pub count: usize,
    /// Arithmetic mean.
    pub mean: f64,
    /// Smallest value.
    pub min: f64,
    /// A quarter of the values is at or below.
    pub lower_quartile: f64,
    /// Half of the values are at or below.
    pub median: f64,
    /// Three quarters of the values are at or below.
    pub upper_quartile: f64,
    /// Largest value.
    pub max: f64,
    /// What has the largest value.
    pub worst: String,
}

impl Distribution {
    /// The spread of named values; all numbers are NaN of nothing.
    pub fn of<'a>(values: impl IntoIterator<Item = (&'a str, f64)>) -> Self {
        let mut named: Vec<(&str, f64)> = values.into_iter().collect();
        named.sort_by(|a, b| a.1.total_cmp(&b.1));
        let sorted: Vec<f64> = named.iter().map(|(_, value)| *value).collect();
        Self {
            count: sorted.len(),
            mean: sorted.iter().sum::<f64>() / sorted.len() as f64,
            min: quantile(&sorted, 0.0),
            lower_quartile: quantile(&sorted, 0.25),
            median: quantile(&sorted, 0.5),
            upper_quartile: quantile(&sorted, 0.75),
            max: quantile(&sorted, 1.0),
            worst: named.last().map(|(name, _)| (*name).to_owned()).unwrap_or_default(),
        }
    }
}

/// The spreads of the four descriptions in words, in the order of [`Parameters::ALL`]; what is exact has no worst.
pub(super) fn told(spreads: &[Distribution; 4]) -> String {
    let of = |parameters: Parameters| {
        let spread = &spreads[parameters as usize];
        if spread.max < EXACT {
            return format!("{} exact", parameters.label());
        }
        format!("{} {:.2} (worst {:.1}, {})", parameters.label(), spread.mean, spread.max, spread.worst)
    };
    Parameters::ALL.map(of).join("; ")
}

/// ΔE far below anything visible and far above rounding.
const EXACT: f64 = 1e-6;

/// Linear between order statistics (Hyndman & Fan 1996, definition 7); NaN of nothing.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let place = share * last as f64;
    let (below, above) = (place.floor() as usize, place.ceil() as usize);
    sorted[below] + (sorted[above] - sorted[below]) * (place - place.floor())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_exact_has_no_worst() {
        let inexact = Distribution::of([("a", 0.1), ("b", 0.3)]);
        let spreads = [Distribution::of([("a", 1e-12)]), inexact.clone(), inexact.clone(), inexact];
        assert!(told(&spreads).starts_with("r, h exact; r, t 0.20 (worst 0.3, b); r, g"), "{}", told(&spreads));
    }

    #[test]
    fn quartiles_of_five_are_its_members() {
        let spread = Distribution::of([("e", 5.0), ("a", 1.0), ("d", 4.0), ("b", 2.0), ("c", 3.0)]);
        assert_eq!((spread.min, spread.lower_quartile, spread.median), (1.0, 2.0, 3.0));
        assert_eq!((spread.upper_quartile, spread.max, spread.mean), (4.0, 5.0, 3.0));
        assert_eq!((spread.count, spread.worst.as_str()), (5, "e"));
        assert!(Distribution::of([]).median.is_nan());
    }
}
