//! Pixels gathered into cells: one mean for each block and ring of a region.

use super::shape::MetalCurve;
use crate::fresnel::Weights;
use crate::photo::PixelFlags;
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

/// What a region holds.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    /// Pixels in the picture.
    pub pixels: usize,
    /// Of these, clipped in each channel.
    pub clipped: [usize; 3],
    /// Of these, black.
    pub black: usize,
}

impl Counts {
    /// True when more than half a percent is clipped in a channel.
    pub fn is_clipped(&self, channel: usize) -> bool {
        exceeds_clipping_limit(self.clipped[channel], self.pixels)
    }

    /// Counts pixels.
    pub fn add_pixels(&mut self, count: usize) {
        self.pixels += count;
    }

    /// Counts what is wrong with one of them.
    pub fn add_flags(&mut self, flags: PixelFlags) {
        self.black += usize::from(flags.black);
        for channel in 0..3 {
            self.clipped[channel] += usize::from(flags.clipped[channel]);
        }
    }

    /// With what was counted elsewhere.
    pub fn plus(self, other: &Self) -> Self {
        Self {
            pixels: self.pixels + other.pixels,
            clipped: std::array::from_fn(|channel| self.clipped[channel] + other.clipped[channel]),
            black: self.black + other.black,
        }
    }
}

/// Pixels too far from a fit to belong to the metal: lamps, the camera, dust.
pub(super) struct Outliers<'a> {
    pub curve: &'a MetalCurve,
    /// How far a pixel of each channel may lie from it.
    pub limits: [f64; 3],
}

/// Pixels beyond this many times their scatter are left out.
const REJECTION: f64 = 4.0;
/// But none within this of the curve: a noise-free picture still rounds.
const LEAST_LIMIT: f64 = 0.01;

impl<'a> Outliers<'a> {
    /// The limits around a fit: its pixel noise and what its cells scatter, together.
    pub fn around(curve: &'a MetalCurve, noise: [f64; 3]) -> Self {
        let limit = |i: usize| REJECTION * noise[i].hypot(curve.fits[i].scatter);
        Self { limits: std::array::from_fn(|i| limit(i).max(LEAST_LIMIT)), curve }
    }
}
