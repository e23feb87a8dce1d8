//! A metal evaluated at a few wavelengths: the spectral model a renderer could afford.

use super::Metal;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{CosTheta, Nk, conductor};
use crate::spectrum::{FewWavelengths, Quadrature};

/// The spectral model with N wavelengths: exact Fresnel equations at each, and N RGB weights.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectralModel {
    wavelengths: FewWavelengths,
    nk: Vec<Nk>,
}

impl SpectralModel {
    /// A metal at `count` wavelengths (at least 2), for a space.
    pub fn new(metal: &Metal, count: usize, quadrature: Quadrature, space: RgbSpace) -> Self {
        Self::with_wavelengths(metal, FewWavelengths::new(count, quadrature, space))
    }

    /// A metal at given wavelengths; saves computing the weights again for the next metal.
    pub fn with_wavelengths(metal: &Metal, wavelengths: FewWavelengths) -> Self {
        let nk = wavelengths.wavelengths_nm.iter().map(|nm| metal.table().at(*nm)).collect();
        Self { wavelengths, nk }
    }

    /// The reflectance at an angle, in the space the weights are for.
    pub fn reflectance(&self, cos_theta: CosTheta) -> Rgb {
        self.wavelengths.rgb(self.nk.iter().map(|nk| conductor(nk.n, nk.k, cos_theta)))
    }
}
