//! CIE 1976 L*a*b* relative to the white of an RGB space.

use super::{Rgb, RgbSpace};

/// CIE L*a*b*: L* of the space's white is 100; nothing is clipped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lab {
    /// Lightness L*, 0 for black and 100 for the white.
    pub lightness: f64,
    /// a*, green (−) to red (+).
    pub a: f64,
    /// b*, blue (−) to yellow (+).
    pub b: f64,
}

impl Lab {
    /// L*a*b* of a linear colour of `space`, relative to that space's own white (CIE 15:2018, eq. 8.3–8.7).
    pub fn from_rgb(rgb: Rgb, space: RgbSpace) -> Self {
        let xyz = space.xyz(rgb);
        let white = space.white().xyz();
        let [fx, fy, fz] = std::array::from_fn(|i| cube_root_with_toe(xyz.0[i] / white.0[i]));
        Self { lightness: 116.0 * fy - 16.0, a: 500.0 * (fx - fy), b: 200.0 * (fy - fz) }
    }
}

/// L* of a relative luminance Y/Yn (CIE 15:2018, eq. 8.3); the toe continues below zero.
pub fn lightness_from_luminance(luminance: f64) -> f64 {
    116.0 * cube_root_with_toe(luminance) - 16.0
}

/// The relative luminance of an L*; inverse of [`lightness_from_luminance`].
pub fn luminance_from_lightness(lightness: f64) -> f64 {
    let f = (lightness + 16.0) / 116.0;
    if f > DELTA { f.powi(3) } else { 3.0 * DELTA * DELTA * (f - 4.0 / 29.0) }
}

const DELTA: f64 = 6.0 / 29.0;

fn cube_root_with_toe(ratio: f64) -> f64 {
    if ratio > DELTA.powi(3) { ratio.cbrt() } else { ratio / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_100_and_black_is_0() {
        for space in RgbSpace::ALL {
            let white = Lab::from_rgb(Rgb::WHITE, space);
            assert!((white.lightness - 100.0).abs() < 1e-9 && white.a.abs() < 1e-9 && white.b.abs() < 1e-9);
            assert!(Lab::from_rgb(Rgb::BLACK, space).lightness.abs() < 1e-9);
        }
    }

    #[test]
    fn lightness_inverts() {
        for step in -10..=120 {
            let luminance = f64::from(step) / 100.0;
            assert!((luminance_from_lightness(lightness_from_luminance(luminance)) - luminance).abs() < 1e-12);
        }
    }
}
