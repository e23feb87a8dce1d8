//! The ground truth over the angles, computed once for all who compare with it.

use super::Metal;
use crate::color::{Lab, Rgb, RgbSpace};
use crate::fresnel::{CosTheta, whole_degrees};
use crate::spectrum::{SAMPLES, rgb_from_reflectance};

/// Spectral reflectance of a metal at 0°, 1°, …, 90° and at θ_max: what every space's truth is summed from.
#[derive(Clone, Debug)]
pub struct SpectralCurve {
    at_degrees: Vec<[f64; SAMPLES]>,
    at_theta_max: Box<[f64; SAMPLES]>,
}

impl SpectralCurve {
    /// Evaluates the Fresnel equations at each angle and wavelength.
    pub fn of(metal: &Metal) -> Self {
        Self {
            at_degrees: whole_degrees().map(|cos_theta| metal.spectral_reflectance(cos_theta)).collect(),
            at_theta_max: Box::new(metal.spectral_reflectance(CosTheta::MAX)),
        }
    }

    /// The truth in one space.
    pub fn truth(&self, space: RgbSpace) -> TruthCurve {
        let rgb = |row: &[f64; SAMPLES]| rgb_from_reflectance(row.iter().copied(), space);
        TruthCurve::new(space, self.at_degrees.iter().map(rgb).collect(), rgb(&self.at_theta_max))
    }
}

/// The ground truth of a metal in one space at 0°, 1°, …, 90°, with its Lab values for differences.
#[derive(Clone, Debug)]
pub struct TruthCurve {
    /// The space of every triple.
    pub space: RgbSpace,
    /// h: the reflectance at θ_max.
    pub h: Rgb,
    rgb: Vec<Rgb>,
    lab: Vec<Lab>,
}

impl TruthCurve {
    fn new(space: RgbSpace, rgb: Vec<Rgb>, h: Rgb) -> Self {
        let lab = rgb.iter().map(|rgb| Lab::from_rgb(*rgb, space)).collect();
        Self { space, h, rgb, lab }
    }

    /// The truth of one metal in one space; for several spaces go through [`SpectralCurve`].
    pub fn of(metal: &Metal, space: RgbSpace) -> Self {
        SpectralCurve::of(metal).truth(space)
    }

    /// r: the reflectance facing the surface.
    pub fn r(&self) -> Rgb {
        self.rgb[0]
    }

    /// The reflectance at each whole degree.
    pub fn rgb(&self) -> &[Rgb] {
        &self.rgb
    }

    /// The same as L*a*b*, relative to the space's white.
    pub fn lab(&self) -> &[Lab] {
        &self.lab
    }

    /// The reflectance at each whole degree, with its angle.
    pub fn samples(&self) -> impl ExactSizeIterator<Item = (CosTheta, Rgb)> + Clone + '_ {
        whole_degrees().zip(self.rgb.iter().copied())
    }

    /// One channel of the curve, with its angles.
    pub fn channel(&self, channel: usize) -> impl ExactSizeIterator<Item = (CosTheta, f64)> + Clone + '_ {
        whole_degrees().zip(self.rgb.iter().map(move |rgb| rgb[channel]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;

    #[test]
    fn is_the_metals_own_reflectance() {
        let gold = metal_by_name("gold").unwrap();
        let spectral = SpectralCurve::of(gold);
        for space in RgbSpace::ALL {
            let truth = spectral.truth(space);
            assert_eq!((truth.r(), truth.h), (gold.r(space), gold.h(space)));
            assert_eq!(truth.rgb()[60], gold.reflectance(CosTheta::from_deg(60.0), space));
            assert_eq!(truth.channel(2).len(), 91);
        }
    }
}
