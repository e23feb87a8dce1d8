//! Reference illuminants.

use std::sync::LazyLock;

use super::{observer, table};
use crate::color::{RgbSpace, Xyz};

/// The light whose reflection defines a reflectance colour (paper section 2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Illuminant {
    /// CIE standard illuminant D65.
    D65,
    /// CIE D60, the reference of ACEScg.
    D60,
}

static POWERS: LazyLock<[Vec<f64>; 2]> =
    LazyLock::new(|| table::columns(include_str!("../../assets/cie/illuminants.csv"), ["d65", "d60"]));

impl Illuminant {
    /// The reference illuminant of a space.
    pub const fn of(space: RgbSpace) -> Self {
        match space {
            RgbSpace::LinRec709 | RgbSpace::LinDisplayP3 | RgbSpace::LinRec2020 => Self::D65,
            RgbSpace::AcesCg => Self::D60,
        }
    }

    /// Relative spectral power at each wavelength of the grid.
    pub fn power(self) -> &'static [f64] {
        match self {
            Self::D65 => &POWERS[0],
            Self::D60 => &POWERS[1],
        }
    }

    /// Tristimulus values of the light itself, scaled to Y = 1, and the scale that did it.
    pub(super) fn xyz_and_scale(self) -> (Xyz, f64) {
        let mut sum = [0.0; 3];
        for (cmf, power) in observer().iter().zip(self.power()) {
            for (total, value) in sum.iter_mut().zip(cmf.0) {
                *total += value * power;
            }
        }
        (Xyz(sum.map(|v| v / sum[1])), 1.0 / sum[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The nominal whites of the spaces are four-digit roundings of these.
    #[test]
    fn whites_are_the_nominal_ones() {
        for space in RgbSpace::ALL {
            let (Xyz([x, y, z]), _) = Illuminant::of(space).xyz_and_scale();
            let nominal = space.white();
            assert!((x / (x + y + z) - nominal.x).abs() < 1e-3 && (y / (x + y + z) - nominal.y).abs() < 1e-3);
        }
    }
}
