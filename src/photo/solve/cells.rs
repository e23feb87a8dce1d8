//! Pixels gathered into cells: one mean for each block and ring of a region.

use super::light::Light;
use super::region::{Place, RINGS, Region, Regions};
use super::shape::MetalCurve;
use super::view::View;
use crate::fresnel::Weights;
use crate::photo::Pixel;
use crate::photo::statistics::{exceeds_clipping_limit, usable_channels};

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

/// Sums over the pixels of a cell.
#[derive(Clone, Copy, Default)]
struct Sum {
    count: usize,
    reflectance: f64,
    weights: [f64; 3],
    cosine: f64,
}

impl Sum {
    fn add(&mut self, reflectance: f64, Place { weights, cosine, .. }: Place) {
        self.count += 1;
        self.cosine += cosine;
        self.reflectance += reflectance;
        for (sum, weight) in self.weights.iter_mut().zip([weights.of_r, weights.of_h, weights.of_white]) {
            *sum += weight;
        }
    }

    fn cell(&self, stratum: usize, index: usize) -> Cell {
        let count = self.count as f64;
        let [of_r, of_h, of_white] = self.weights.map(|sum| sum / count);
        Cell {
            stratum,
            block: index / RINGS,
            ring: index % RINGS,
            count: self.count,
            reflectance: self.reflectance / count,
            weights: Weights { of_r, of_h, of_white },
            cosine: self.cosine / count,
        }
    }
}

/// The cells of each channel, and what was counted on the way.
pub(super) fn gather(
    view: &View,
    regions: &Regions,
    light: &Light,
    outliers: Option<&Outliers>,
) -> ([Vec<Cell>; 3], Counts) {
    let mut cells: [Vec<Cell>; 3] = Default::default();
    let mut counts = Counts::default();
    for (stratum, region) in strata(regions) {
        let mut sums = vec![[Sum::default(); 3]; region.blocks() * RINGS];
        for (column, row, place) in region.pixels(view.photo) {
            let Some(pixel) = view.pixel(column, row) else { continue };
            counts.add(stratum, &pixel);
            let reflectance = light.reflectance(view, &pixel, &place);
            if outliers.is_some_and(|outliers| outliers.include(reflectance, place)) {
                continue;
            }
            let sum = &mut sums[place.block * RINGS + place.ring];
            for channel in usable(&pixel, reflectance) {
                sum[channel].add(reflectance[channel], place);
            }
        }
        for (index, sum) in sums.iter().enumerate() {
            for channel in 0..3 {
                if sum[channel].count > 0 {
                    cells[channel].push(sum[channel].cell(stratum, index));
                }
            }
        }
    }
    (cells, counts)
}

/// The regions that exist with the number of their stratum.
fn strata(regions: &Regions) -> impl Iterator<Item = (usize, &Region)> {
    let inner = regions.inner.iter().map(|region| (0, region));
    inner.chain(regions.outer.iter().map(|region| (1, region)))
}

/// The channels that are neither clipped nor without a light.
fn usable(pixel: &Pixel, reflectance: [f64; 3]) -> impl Iterator<Item = usize> + use<> {
    let is_usable = usable_channels(pixel);
    (0..3).filter(move |&channel| is_usable[channel] && reflectance[channel].is_finite())
}

impl Counts {
    /// True when more than half a percent of a region is clipped in a channel.
    pub fn is_clipped(&self, stratum: usize, channel: usize) -> bool {
        exceeds_clipping_limit(self.clipped[stratum][channel], self.pixels[stratum])
    }

    fn add(&mut self, stratum: usize, pixel: &Pixel) {
        self.pixels[stratum] += 1;
        self.black[stratum] += usize::from(pixel.flags.black);
        for channel in 0..3 {
            self.clipped[stratum][channel] += usize::from(pixel.flags.clipped[channel]);
        }
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
    pub fn around(view: &View, regions: &Regions, light: &Light, curve: MetalCurve) -> Self {
        let noise = noise(view, regions, light, &curve);
        let limit = |i: usize| REJECTION * noise[i].hypot(curve.fits[i].scatter);
        Self { limits: std::array::from_fn(|i| limit(i).max(LEAST_LIMIT)), curve }
    }

    fn include(&self, reflectance: [f64; 3], place: Place) -> bool {
        let expected = self.curve.at(place.weights, place.cosine);
        (0..3).any(|i| (reflectance[i] - expected[i]).abs() > self.limits[i])
    }
}

/// The standard deviation of a pixel around a fit: the median over cells of what is left within each.
pub(super) fn noise(view: &View, regions: &Regions, light: &Light, curve: &MetalCurve) -> [f64; 3] {
    let mut variances: [Vec<f64>; 3] = Default::default();
    for (_, region) in strata(regions) {
        let mut sums = vec![[(0.0, 0.0, 0.0); 3]; region.blocks() * RINGS];
        for (column, row, place) in region.pixels(view.photo) {
            let Some(pixel) = view.pixel(column, row) else { continue };
            let (reflectance, expected) =
                (light.reflectance(view, &pixel, &place), curve.at(place.weights, place.cosine));
            for channel in usable(&pixel, reflectance) {
                let residual = reflectance[channel] - expected[channel];
                let (count, sum, squares) = &mut sums[place.block * RINGS + place.ring][channel];
                *count += 1.0;
                *sum += residual;
                *squares += residual * residual;
            }
        }
        for cell in &sums {
            for channel in 0..3 {
                let (count, sum, squares) = cell[channel];
                if count > 1.0 {
                    variances[channel].push((squares - sum * sum / count).max(0.0) / (count - 1.0));
                }
            }
        }
    }
    variances.map(|mut values| median(&mut values).sqrt())
}

/// The median; 0 of nothing.
pub(super) fn median(values: &mut [f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}
