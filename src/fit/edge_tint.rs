//! Gulbrandsen's g for a curve: it has no closed form.

use super::search::minimum_within;
use crate::fresnel::{CosTheta, gulbrandsen_over_angles};
use crate::number::larger;

/// What "nearest" means when g is fitted to a channel's curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Nearness {
    /// Smallest sum of squared differences over the samples.
    #[default]
    LeastSquares,
    /// Smallest largest difference over the samples.
    MinMax,
}

/// The g in `[0, 1]` whose curve is nearest to samples (angle, F) at this r, 0 ≤ r ≤ 1.
///
/// The best of nine even steps of g, then Brent's method between its neighbours: no derivative is needed.
pub fn g_nearest(samples: &[(CosTheta, f64)], r: f64, nearness: Nearness) -> f64 {
    let cosines: Vec<CosTheta> = samples.iter().map(|(cos_theta, _)| *cos_theta).collect();
    minimum_within(0.0..=1.0, 8, |g| {
        let mut curve = vec![f64::NAN; cosines.len()];
        gulbrandsen_over_angles(r, g, &cosines, &mut curve);
        let differences = curve.iter().zip(samples).map(|(shown, (_, f))| shown - f);
        match nearness {
            Nearness::LeastSquares => differences.map(|difference| difference.powi(2)).sum(),
            Nearness::MinMax => differences.map(f64::abs).fold(0.0, larger),
        }
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::{gulbrandsen, whole_degrees};

    proptest! {
        #[test]
        fn a_conductor_gives_its_g_back(r in 0.05..0.99, g in 0.0..1.0) {
            let samples: Vec<_> = whole_degrees().map(|c| (c, gulbrandsen(r, g, c))).collect();
            for nearness in [Nearness::LeastSquares, Nearness::MinMax] {
                let back = g_nearest(&samples, r, nearness);
                prop_assert!((back - g).abs() < 1e-5, "{nearness:?} {back}");
            }
        }
    }
}
