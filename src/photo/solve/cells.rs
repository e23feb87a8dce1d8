//! Pixels gathered into cells: one mean for each block and ring of a region.

use super::shape::MetalCurve;
use crate::fresnel::Weights;
use crate::photo::Pixel;
use crate::photo::statistics::exceeds_clipping_limit;

/// The mean of one channel over the pixels of one block and ring.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    /// Which region: 0 facing, 1 grazing.
    pub stratum: usize,
    /// Which block of the region.
    pub block: usize,
    /// Which ring.
    pub ring: usize,
    /// Pixels in it.
    pub count: usize,
    /// Mean of pixel over light: the reflectance F.
    pub reflectance: f64,
    /// Mean weights of r, h and white.
    pub weights: Weights,
    /// Mean cosine of the angle of incidence.
    pub cosine: f64,
}

/// What the regions hold.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    /// Pixels in the picture, for facing and grazing.
    pub pixels: [usize; 2],
    /// Of these, clipped in each channel.
    pub clipped: [[usize; 3]; 2],
    /// Of these, black.
    pub black: [usize; 2],
}

impl Counts {
    /// True when more than half a percent of a region is clipped in a channel.
    pub fn is_clipped(&self, stratum: usize, channel: usize) -> bool {
        exceeds_clipping_limit(self.clipped[stratum][channel], self.pixels[stratum])
    }

    /// Counts a pixel.
    pub fn add(&mut self, stratum: usize, pixel: &Pixel) {
        self.pixels[stratum] += 1;
        self.black[stratum] += usize::from(pixel.flags.black);
        for channel in 0..3 {
            self.clipped[stratum][channel] += usize::from(pixel.flags.clipped[channel]);
        }
    }

    /// Adds what was counted elsewhere.
    pub fn plus(&mut self, other: &Self) {
        for stratum in 0..2 {
            self.pixels[stratum] += other.pixels[stratum];
            self.black[stratum] += other.black[stratum];
            for channel in 0..3 {
                self.clipped[stratum][channel] += other.clipped[stratum][channel];
            }
        }
    }

    /// Takes the counts of one region, counted as the first, for a stratum.
    pub fn set(&mut self, stratum: usize, of_region: Self) {
        self.pixels[stratum] = of_region.pixels[0];
        self.clipped[stratum] = of_region.clipped[0];
        self.black[stratum] = of_region.black[0];
    }
}

/// Pixels too far from a fit to belong to the metal: lamps, the camera, dust.
pub(super) struct Outliers {
    curve: MetalCurve,
    limits: [f64; 3],
}

/// Pixels beyond this many times their scatter are left out.
const REJECTION: f64 = 4.0;
/// But none within this of the curve: a noise-free picture still rounds.
const LEAST_LIMIT: f64 = 0.01;

impl Outliers {
    /// The limits around a fit: its pixel noise and what its cells scatter, together.
    pub fn around(curve: MetalCurve, noise: [f64; 3]) -> Self {
        let limit = |i: usize| REJECTION * noise[i].hypot(curve.fits[i].scatter);
        Self { limits: std::array::from_fn(|i| limit(i).max(LEAST_LIMIT)), curve }
    }

    /// True where no channel is beyond its limit.
    pub fn keep(&self, reflectance: [f32; 3], weights: Weights, cosine: f64) -> bool {
        let expected = self.curve.at(weights, cosine);
        !(0..3).any(|i| (f64::from(reflectance[i]) - expected[i]).abs() > self.limits[i])
    }
}
