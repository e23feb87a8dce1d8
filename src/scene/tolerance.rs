//! The error over the angles that are seen, and the bound on it.

use serde::{Deserialize, Serialize};

use super::{Angles, NODES, node_cosines};
use crate::study::Measure;

/// A bound on CIEDE2000.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tolerance {
    /// The largest value that is allowed, at least 0.
    pub delta_e: f64,
    /// Of which number.
    pub on: Measure,
}

impl Default for Tolerance {
    /// At no angle more than 2, the error within which Hoffman ("Fresnel equations considered harmful", 2019, section 2)
    /// calls Schlick's curve quite accurate; there it bounds the mean, here the worst angle that is seen.
    fn default() -> Self {
        Self { delta_e: 2.0, on: Measure::Max }
    }
}

/// CIEDE2000 over the angles that are seen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeenError {
    /// Mean over what is seen.
    #[serde(deserialize_with = "null_is_no_number")]
    pub mean_delta_e: f64,
    /// What 95 % of what is seen stay within.
    #[serde(deserialize_with = "null_is_no_number")]
    pub p95_delta_e: f64,
    /// The largest.
    #[serde(deserialize_with = "null_is_no_number")]
    pub max_delta_e: f64,
    /// The angle of the largest, in degrees.
    #[serde(deserialize_with = "null_is_no_number")]
    pub angle_of_max_deg: f64,
}

/// JSON has no NaN, so that null is written for it.
fn null_is_no_number<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::<f64>::deserialize(deserializer)?.unwrap_or(f64::NAN))
}

impl SeenError {
    /// Of what is not seen.
    pub const NONE: Self = Self { mean_delta_e: 0.0, p95_delta_e: 0.0, max_delta_e: 0.0, angle_of_max_deg: 0.0 };

    /// The error of values at each node over what is seen; all NaN where nothing is. NaN at one angle is the largest.
    pub fn over(delta_e: &[f64; NODES], angles: &Angles) -> Self {
        let mut seen: Vec<(f64, f64)> = angles.seen().map(|(node, weight)| (delta_e[node], weight)).collect();
        let total: f64 = seen.iter().map(|(_, weight)| weight).sum();
        let mean = seen.iter().map(|(value, weight)| value * weight).sum::<f64>() / total;
        let largest = angles.seen().max_by(|(a, _), (b, _)| delta_e[*a].total_cmp(&delta_e[*b])).map(|(node, _)| node);
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self {
            mean_delta_e: mean,
            p95_delta_e: within(&seen, 0.95 * total),
            max_delta_e: largest.map_or(f64::NAN, |node| delta_e[node]),
            angle_of_max_deg: largest.map_or(f64::NAN, |node| node_cosines()[node].deg()),
        }
    }

    /// One of the numbers.
    pub const fn of(self, measure: Measure) -> f64 {
        match measure {
            Measure::Mean => self.mean_delta_e,
            Measure::P95 => self.p95_delta_e,
            Measure::Max => self.max_delta_e,
        }
    }

    /// True within the bound; NaN is within none.
    pub fn is_within(self, tolerance: Tolerance) -> bool {
        self.of(tolerance.on) <= tolerance.delta_e
    }
}

/// The smallest of the sorted values that so much weight does not exceed; NaN of nothing.
fn within(sorted: &[(f64, f64)], weight: f64) -> f64 {
    let mut sum = 0.0;
    let reached = sorted.iter().find(|(_, own)| {
        sum += own;
        sum >= weight
    });
    reached.or(sorted.last()).map_or(f64::NAN, |(value, _)| *value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::CosTheta;

    #[test]
    fn a_constant_error_is_every_number() {
        let mut angles = Angles::default();
        (0..=90).for_each(|deg| angles.add(CosTheta::from_deg(f64::from(deg)), 1.0));
        let error = SeenError::over(&[2.0; NODES], &angles);
        for measure in Measure::ALL {
            assert!((error.of(measure) - 2.0).abs() < 1e-12);
        }
        assert!(error.is_within(Tolerance { delta_e: 2.0 + 1e-9, on: Measure::Mean }));
    }

    #[test]
    fn a_rare_angle_counts_only_for_the_largest() {
        let mut angles = Angles::default();
        angles.add(node_cosines()[200], 99.0);
        angles.add(node_cosines()[10], 1.0);
        let mut delta_e = [0.1; NODES];
        delta_e[10] = 8.0;
        let error = SeenError::over(&delta_e, &angles);
        assert_eq!((error.p95_delta_e, error.max_delta_e), (0.1, 8.0));
        assert!((error.angle_of_max_deg - node_cosines()[10].deg()).abs() < 1e-12);
        delta_e[10] = f64::NAN;
        assert!(!SeenError::over(&delta_e, &angles).is_within(Tolerance { delta_e: 1e9, on: Measure::Max }));
    }

    #[test]
    fn of_nothing_there_is_no_error() {
        let error = SeenError::over(&[0.0; NODES], &Angles::default());
        assert!(Measure::ALL.into_iter().all(|measure| error.of(measure).is_nan()));
    }
}
