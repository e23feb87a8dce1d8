//! From a spectral reflectance to the RGB reflectance of a space (paper figure 1, below the line).

use std::sync::LazyLock;

use nalgebra::Vector3;

use super::{Illuminant, grid::SAMPLES, observer};
use crate::color::{Rgb, RgbSpace, bradford};

/// One RGB weight for each wavelength: the RGB of a reflectance is the plain sum of weight × reflectance.
pub type RgbWeights = [Rgb; SAMPLES];

static WEIGHTS: LazyLock<[Box<RgbWeights>; 4]> = LazyLock::new(|| RgbSpace::ALL.map(weights_of));

/// The weights of a space.
///
/// Illuminant × observer, relative to the illuminant's Y, Bradford-adapted from the illuminant as
/// computed to the nominal white, then the inverse primaries matrix. They sum to (1, 1, 1): a perfect
/// reflector is white.
pub fn rgb_weights(space: RgbSpace) -> &'static RgbWeights {
    &WEIGHTS[space as usize]
}

/// The RGB of a spectral reflectance given at each wavelength of the grid. Nothing is clipped.
pub fn rgb_from_reflectance(reflectance: impl IntoIterator<Item = f64>, space: RgbSpace) -> Rgb {
    rgb_weights(space).iter().zip(reflectance).fold(Rgb::BLACK, |sum, (weight, value)| sum + *weight * value)
}

fn weights_of(space: RgbSpace) -> Box<RgbWeights> {
    let illuminant = Illuminant::of(space);
    let (white, scale) = illuminant.xyz_and_scale();
    let rgb_from_xyz = space.rgb_from_xyz() * bradford(white, space.white().xyz());
    let (cmf, power) = (observer(), illuminant.power());
    Box::new(std::array::from_fn(|i| {
        let xyz = Vector3::from(cmf[i]) * (power[i] * scale);
        Rgb::from(rgb_from_xyz * xyz)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_perfect_reflector_is_white() {
        for space in RgbSpace::ALL {
            let white = rgb_from_reflectance([1.0; SAMPLES], space);
            assert!(white.max_abs_difference(Rgb::WHITE) < 1e-12, "{space}: {white:?}");
        }
    }
}
