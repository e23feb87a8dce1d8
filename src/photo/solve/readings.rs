//! The pixels of the regions, read once: after that a fit is a pass over memory.

use rayon::prelude::*;

use super::cells::{Cell, Counts, Outliers};
use super::light::Light;
use super::region::{RINGS, Region, Regions};
use super::shape::MetalCurve;
use super::view::View;
use crate::fresnel::Weights;
use crate::number::median;
use crate::photo::statistics::usable_channels;

/// What was read of both regions.
pub(super) struct Readings {
    /// Facing and grazing.
    strata: [Option<Stratum>; 2],
    pub counts: Counts,
}

struct Stratum {
    /// Blocks times rings.
    cells: usize,
    spots: Vec<Spot>,
}

/// One pixel: 28 bytes, so that a million of them fit where the solver is to stay.
#[derive(Clone, Copy)]
struct Spot {
    /// Pixel over light; not finite where the light is not known.
    reflectance: [f32; 3],
    of_r: f32,
    of_h: f32,
    cosine: f32,
    /// Block times [`RINGS`] plus ring.
    cell: u16,
    /// A bit for each channel that is neither clipped nor without a light.
    usable: u8,
}

const ALL_CHANNELS: u8 = 0b111;

impl Spot {
    fn is_usable(&self, channel: usize) -> bool {
        self.usable & (1 << channel) != 0
    }

    fn weights(&self) -> Weights {
        let (of_r, of_h) = (f64::from(self.of_r), f64::from(self.of_h));
        Weights { of_r, of_h, of_white: 1.0 - of_r - of_h }
    }
}

/// Spots in one piece of work; the same pieces whatever the number of threads, so that sums round alike.
const PIECE: usize = 1 << 14;

impl Readings {
    /// Reads both regions under a light.
    pub fn of(view: &View, regions: &Regions, light: &Light) -> Self {
        let mut counts = Counts::default();
        let mut read = |stratum: usize, region: &Option<Region>| {
            region.as_ref().map(|region| {
                let (spots, of_region) = spots(view, region, light);
                counts.set(stratum, of_region);
                Stratum { cells: region.blocks() * RINGS, spots }
            })
        };
        let strata = [read(0, &regions.inner), read(1, &regions.outer)];
        Self { strata, counts }
    }

    /// The cells of each channel, without outliers where these are known.
    pub fn cells(&self, outliers: Option<&Outliers>) -> [Vec<Cell>; 3] {
        let mut cells: [Vec<Cell>; 3] = Default::default();
        for (stratum, of) in self.strata() {
            let sums = of.sums(|sums: &mut Vec<Sum>, spot| {
                if outliers.is_none_or(|outliers| outliers.keep(spot.reflectance, spot.weights(), spot.cosine.into())) {
                    sums[usize::from(spot.cell)].add(spot);
                }
            });
            for (index, sum) in sums.iter().enumerate() {
                for (channel, cells) in cells.iter_mut().enumerate() {
                    cells.extend(sum.cell(stratum, index, channel));
                }
            }
        }
        cells
    }

    /// The standard deviation of a pixel around a curve: the median over cells of what is left within each.
    pub fn noise(&self, curve: &MetalCurve) -> [f64; 3] {
        let mut variances: [Vec<f64>; 3] = Default::default();
        for (_, of) in self.strata() {
            let sums = of.sums(|sums: &mut Vec<[Scatter; 3]>, spot| {
                let expected = curve.at(spot.weights(), spot.cosine.into());
                for channel in (0..3).filter(|channel| spot.is_usable(*channel)) {
                    let residual = f64::from(spot.reflectance[channel]) - expected[channel];
                    sums[usize::from(spot.cell)][channel].add(residual);
                }
            });
            for of_cell in &sums {
                for (variances, scatter) in variances.iter_mut().zip(of_cell) {
                    variances.extend(scatter.variance());
                }
            }
        }
        variances.map(|mut values| median(&mut values).sqrt())
    }

    fn strata(&self) -> impl Iterator<Item = (usize, &Stratum)> {
        self.strata.iter().enumerate().filter_map(|(index, stratum)| Some((index, stratum.as_ref()?)))
    }
}

impl Stratum {
    /// One sum for each cell, over all spots.
    fn sums<T: Plus + Default + Clone + Send>(&self, add: impl Fn(&mut Vec<T>, &Spot) + Sync) -> Vec<T> {
        let of_piece = |piece: &[Spot]| {
            let mut sums = vec![T::default(); self.cells];
            piece.iter().for_each(|spot| add(&mut sums, spot));
            sums
        };
        let pieces: Vec<Vec<T>> = self.spots.par_chunks(PIECE).map(of_piece).collect();
        let plus = |mut all: Vec<T>, piece: &Vec<T>| {
            all.iter_mut().zip(piece).for_each(|(all, piece)| all.plus(piece));
            all
        };
        pieces.iter().fold(vec![T::default(); self.cells], plus)
    }
}

/// Reads a region row by row.
fn spots(view: &View, region: &Region, light: &Light) -> (Vec<Spot>, Counts) {
    const ROWS: usize = 16;
    let rows: Vec<u32> = region.rows(view.photo).collect();
    let of_rows = |rows: &[u32]| {
        let (mut spots, mut counts) = (Vec::new(), Counts::default());
        for (column, row, place) in rows.iter().flat_map(|row| region.pixels_of_row(view.photo, *row)) {
            let Some(pixel) = view.pixel(column, row) else { continue };
            counts.add(0, &pixel);
            let reflectance = light.reflectance(view, &pixel, &place);
            let is_usable = usable_channels(&pixel);
            let bit = |i: usize| u8::from(is_usable[i] && reflectance[i].is_finite()) << i;
            spots.push(Spot {
                reflectance: reflectance.map(|value| value as f32),
                of_r: place.weights.of_r as f32,
                of_h: place.weights.of_h as f32,
                cosine: place.cosine as f32,
                cell: (place.block * RINGS + place.ring) as u16,
                usable: bit(0) | bit(1) | bit(2),
            });
        }
        (spots, counts)
    };
    let pieces: Vec<(Vec<Spot>, Counts)> = rows.par_chunks(ROWS).map(of_rows).collect();
    let mut all = (Vec::with_capacity(pieces.iter().map(|piece| piece.0.len()).sum()), Counts::default());
    for (spots, counts) in pieces {
        all.0.extend(spots);
        all.1.plus(&counts);
    }
    all
}

/// A sum that can be added to.
trait Plus {
    fn plus(&mut self, other: &Self);
}

/// Sums over the spots of a cell: of those that every channel may use together, of others for each channel.
#[derive(Clone, Copy, Default)]
struct Sum {
    whole: Angles,
    reflectance: [f64; 3],
    partial: [Angles; 3],
}

/// How many spots, and the sums of what their angles give.
#[derive(Clone, Copy, Default)]
struct Angles {
    count: f64,
    of_r: f64,
    of_h: f64,
    cosine: f64,
}

impl Angles {
    fn add(&mut self, spot: &Spot) {
        self.count += 1.0;
        self.of_r += f64::from(spot.of_r);
        self.of_h += f64::from(spot.of_h);
        self.cosine += f64::from(spot.cosine);
    }
}

impl Plus for Angles {
    fn plus(&mut self, other: &Self) {
        self.count += other.count;
        self.of_r += other.of_r;
        self.of_h += other.of_h;
        self.cosine += other.cosine;
    }
}

impl Sum {
    fn add(&mut self, spot: &Spot) {
        if spot.usable == ALL_CHANNELS {
            self.whole.add(spot);
            self.reflectance.iter_mut().zip(spot.reflectance).for_each(|(sum, value)| *sum += f64::from(value));
            return;
        }
        for channel in (0..3).filter(|channel| spot.is_usable(*channel)) {
            self.partial[channel].add(spot);
            self.reflectance[channel] += f64::from(spot.reflectance[channel]);
        }
    }

    fn cell(&self, stratum: usize, index: usize, channel: usize) -> Option<Cell> {
        let mut angles = self.whole;
        angles.plus(&self.partial[channel]);
        let Angles { count, of_r, of_h, cosine } = angles;
        (count > 0.0).then(|| Cell {
            stratum,
            block: index / RINGS,
            ring: index % RINGS,
            count: count as usize,
            reflectance: self.reflectance[channel] / count,
            weights: Weights { of_r: of_r / count, of_h: of_h / count, of_white: (count - of_r - of_h) / count },
            cosine: cosine / count,
        })
    }
}

impl Plus for Sum {
    fn plus(&mut self, other: &Self) {
        self.whole.plus(&other.whole);
        self.reflectance.iter_mut().zip(other.reflectance).for_each(|(sum, value)| *sum += value);
        self.partial.iter_mut().zip(&other.partial).for_each(|(sum, other)| sum.plus(other));
    }
}

/// Count, sum and sum of squares of what is left around a curve.
#[derive(Clone, Copy, Default)]
struct Scatter {
    count: f64,
    sum: f64,
    squares: f64,
}

impl Scatter {
    fn add(&mut self, residual: f64) {
        self.count += 1.0;
        self.sum += residual;
        self.squares += residual * residual;
    }

    fn variance(&self) -> Option<f64> {
        let left = (self.squares - self.sum * self.sum / self.count).max(0.0);
        (self.count > 1.0).then(|| left / (self.count - 1.0))
    }
}

impl Plus for [Scatter; 3] {
    fn plus(&mut self, other: &Self) {
        for (sum, other) in self.iter_mut().zip(other) {
            sum.count += other.count;
            sum.sum += other.sum;
            sum.squares += other.squares;
        }
    }
}
