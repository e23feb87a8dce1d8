//! What was read of the regions, gone over again and again: a fit is a pass over memory.

use rayon::prelude::*;

use super::cells::{Cell, Counts, Outliers};
use super::light::Light;
use super::radial::Radial;
use super::region::{RINGS, Region, Regions};
use super::shape::MetalCurve;
use super::spots::{Piece, Spot, read};
use super::sums::{Plus, Scatters, Sum};
use super::view::View;
use crate::fresnel::Weights;
use crate::number::median;

/// What was read of both regions.
pub(super) struct Readings<'a> {
    /// Facing and grazing.
    strata: [Option<Stratum<'a>>; 2],
}

struct Stratum<'a> {
    region: &'a Region,
    pieces: Vec<Piece>,
    /// The weights of r and h.
    weights: Radial<2>,
}

/// The sums of every cell of both regions.
pub(super) struct Sums([Vec<Sum>; 2]);

impl<'a> Readings<'a> {
    /// Reads both regions under a light.
    pub fn of(view: &View, regions: &'a Regions, light: &Light) -> Self {
        let read = |region: &'a Region| Stratum::of(region, read(view, region, light));
        Self { strata: [&regions.inner, &regions.outer].map(|region| region.as_ref().map(read)) }
    }

    /// What both hold.
    pub fn counts(&self) -> [Counts; 2] {
        self.strata.each_ref().map(|stratum| {
            let pieces = stratum.iter().flat_map(|stratum| &stratum.pieces);
            pieces.fold(Counts::default(), |all, piece| all.plus(&piece.counts))
        })
    }

    /// The sums over all pixels that can be used.
    pub fn sums(&self) -> Sums {
        Sums(self.of_strata(|stratum, _| stratum.sums()))
    }

    /// The same without outliers.
    pub fn sums_without(&self, outliers: &Outliers, all: &Sums) -> Sums {
        Sums(self.of_strata(|stratum, index| stratum.sums_without(outliers, &all.0[index])))
    }

    /// The standard deviation of a pixel around a curve: the median over cells of what is left within each.
    pub fn noise(&self, curve: &MetalCurve) -> [f64; 3] {
        let scatters = self.of_strata(|stratum, _| stratum.scatters(curve));
        [0, 1, 2].map(|channel| {
            let variances = scatters.iter().flatten().filter_map(|scatters| scatters.variance(channel));
            median(&mut variances.collect::<Vec<_>>()).sqrt()
        })
    }

    fn of_strata<T>(&self, of: impl Fn(&Stratum, usize) -> Vec<T>) -> [Vec<T>; 2] {
        [0, 1].map(|index| self.strata[index].as_ref().map_or_else(Vec::new, |stratum| of(stratum, index)))
    }
}

impl Sums {
    /// The cells of each channel.
    pub fn cells(&self) -> [Vec<Cell>; 3] {
        let of_stratum = |stratum: usize, channel: usize| {
            let cell = move |(index, sum): (usize, &Sum)| {
                let (block, ring) = (index / RINGS, index % RINGS);
                sum.mean(channel).map(|mean| Cell { stratum, block, ring, ..mean })
            };
            self.0[stratum].iter().enumerate().filter_map(cell)
        };
        [0, 1, 2].map(|channel| of_stratum(0, channel).chain(of_stratum(1, channel)).collect())
    }
}

impl<'a> Stratum<'a> {
    fn of(region: &'a Region, pieces: Vec<Piece>) -> Self {
        let weights = Radial::of(|cosine| {
            let Weights { of_r, of_h, .. } = region.weights(cosine);
            [of_r, of_h]
        });
        Self { region, pieces, weights }
    }

    /// The curve where a pixel shows a cosine; 0 in place of a fourth channel.
    fn expected(&self, curve: &MetalCurve) -> Radial<4> {
        Radial::of(|cosine| {
            let [red, green, blue] = curve.at(self.region.weights(cosine), cosine);
            [red, green, blue, 0.0]
        })
    }

    fn sums(&self) -> Vec<Sum> {
        self.added(|piece, sums: &mut [Sum]| {
            for (cell, spots) in piece.runs() {
                sums[cell].add_run(1.0, spots, &self.weights);
            }
            for odd in &piece.odd {
                sums[odd.cell].add_odd(1.0, odd, &self.weights);
            }
        })
    }

    /// Takes the runs that hold outliers off the sums of all, and puts back what is left of them.
    fn sums_without(&self, outliers: &Outliers, all: &[Sum]) -> Vec<Sum> {
        let expected = self.expected(outliers.curve);
        let limits = Limits::of(outliers.limits);
        let mut sums = self.added(|piece, changes: &mut [Sum]| {
            let mut kept = Vec::new();
            for (cell, spots) in piece.runs() {
                if spots.iter().any(|spot| limits.are_exceeded(*spot, &expected)) {
                    kept.clear();
                    kept.extend(spots.iter().filter(|spot| !limits.are_exceeded(**spot, &expected)).copied());
                    changes[cell].add_run(-1.0, spots, &self.weights);
                    changes[cell].add_run(1.0, &kept, &self.weights);
                }
            }
            for odd in piece.odd.iter().filter(|odd| limits.are_exceeded(odd.spot, &expected)) {
                changes[odd.cell].add_odd(-1.0, odd, &self.weights);
            }
        });
        sums.iter_mut().zip(all).for_each(|(sum, all)| sum.plus(all));
        sums
    }

    fn scatters(&self, curve: &MetalCurve) -> Vec<Scatters> {
        let expected = self.expected(curve);
        self.added(|piece, scatters: &mut [Scatters]| {
            for (cell, spots) in piece.runs() {
                scatters[cell].add_run(spots, &expected);
            }
            for odd in &piece.odd {
                scatters[odd.cell].add_odd(odd, &expected);
            }
        })
    }

    /// One `T` for each cell, added up over the pieces in their order.
    fn added<T: Plus + Default + Clone + Send>(&self, add: impl Fn(&Piece, &mut [T]) + Sync) -> Vec<T> {
        let none = || vec![T::default(); self.region.blocks() * RINGS];
        let of_piece = |piece: &Piece| {
            let mut of_cells = none();
            add(piece, &mut of_cells);
            of_cells
        };
        let pieces: Vec<Vec<T>> = self.pieces.par_iter().map(of_piece).collect();
        pieces.iter().fold(none(), |mut all, piece| {
            all.iter_mut().zip(piece).for_each(|(all, piece)| all.plus(piece));
            all
        })
    }
}

/// How far a pixel may lie from a curve, as it is compared: without bound in place of a fourth channel.
struct Limits([f32; 4]);

impl Limits {
    fn of([red, green, blue]: [f64; 3]) -> Self {
        Self([red as f32, green as f32, blue as f32, f32::INFINITY])
    }

    /// True where a channel is beyond its limit; no number is beyond none.
    #[inline]
    fn are_exceeded(&self, spot: Spot, expected: &Radial<4>) -> bool {
        let expected = expected.at(spot.place());
        // Every channel is compared, so that one comparison of whole registers serves.
        (0..4).fold(false, |beyond, i| beyond | ((spot.0[i] - expected[i]).abs() > self.0[i]))
    }
}
