//! How far a curve is from the truth, over the angles.

use serde::{Deserialize, Serialize};

use crate::color::{Lab, Rgb, delta_e_2000};
use crate::fresnel::{CosTheta, FresnelModel, whole_degrees};
use crate::metal::TruthCurve;

/// CIEDE2000 between a model and the truth over 0°, 1°, …, 90°.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurveError {
    /// Arithmetic mean over the angles.
    pub mean_delta_e: f64,
    /// Largest value.
    pub max_delta_e: f64,
    /// The angle of the largest value, in degrees.
    pub angle_of_max_deg: f64,
    /// Mean over the picture of a sphere: weight sin θ · cos θ.
    pub sphere_delta_e: f64,
}

impl CurveError {
    /// The error of a model whose parameters are in the truth's space. NaN where the model is NaN.
    pub fn of(model: &FresnelModel, truth: &TruthCurve) -> Self {
        Self::over_degrees(delta_e_over_degrees(whole_degrees().map(|c| model.reflectance(c)), truth))
    }

    /// Collects the values of 0°, 1°, …, 90°.
    pub fn over_degrees(delta_e: impl IntoIterator<Item = f64>) -> Self {
        let mut max = (f64::NEG_INFINITY, 0.0);
        let (mut sum, mut sphere, mut count, mut sphere_weight) = (0.0, 0.0, 0.0, 0.0);
        for (deg, value) in delta_e.into_iter().enumerate() {
            let deg = deg as f64;
            if value > max.0 || value.is_nan() {
                max = (value, deg);
            }
            let weight = weight_on_sphere(deg);
            sum += value;
            count += 1.0;
            sphere += weight * value;
            sphere_weight += weight;
        }
        Self {
            mean_delta_e: sum / count,
            max_delta_e: max.0,
            angle_of_max_deg: max.1,
            sphere_delta_e: sphere / sphere_weight,
        }
    }
}

/// sin θ · cos θ: the share of a sphere's picture whose normals meet the eye at θ (exact for a distant eye).
fn weight_on_sphere(angle_deg: f64) -> f64 {
    let cosine = CosTheta::from_deg(angle_deg).get();
    cosine * (1.0 - cosine * cosine).sqrt()
}

/// CIEDE2000 at each whole degree, of a curve given at each whole degree.
pub fn delta_e_over_degrees<'a>(
    curve: impl IntoIterator<Item = Rgb> + 'a,
    truth: &'a TruthCurve,
) -> impl Iterator<Item = f64> + 'a {
    let labs = curve.into_iter().map(|rgb| Lab::from_rgb(rgb, truth.space));
    labs.zip(truth.lab()).map(|(lab, truth)| delta_e_2000(lab, *truth))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_difference_is_every_mean() {
        let error = CurveError::over_degrees([2.5; 91]);
        for value in [error.mean_delta_e, error.max_delta_e, error.sphere_delta_e] {
            assert!((value - 2.5).abs() < 1e-12);
        }
    }

    #[test]
    fn the_maximum_keeps_its_angle_and_grazing_weighs_nothing_on_a_sphere() {
        let error = CurveError::over_degrees((0..=90).map(|deg| if deg == 90 { 9.1 } else { 0.0 }));
        assert_eq!((error.max_delta_e, error.angle_of_max_deg), (9.1, 90.0));
        assert!((error.mean_delta_e - 0.1).abs() < 1e-12 && error.sphere_delta_e < 1e-12);
    }

    #[test]
    fn a_value_that_is_no_number_is_not_hidden() {
        let error = CurveError::over_degrees((0..=90).map(|deg| if deg == 40 { f64::NAN } else { 1.0 }));
        assert!(error.mean_delta_e.is_nan() && error.sphere_delta_e.is_nan());
    }
}
