//! The pixels of a region in memory, in runs that belong to one cell.

use std::ops::Range;

use rayon::prelude::*;

use super::cells::Counts;
use super::facing::Facings;
use super::light::Light;
use super::radial;
use super::region::Region;
use super::stretch::Stretch;
use super::view::View;
use crate::photo::statistics::usable_channels;
use crate::photo::{Pixel, PixelFlags};

/// A pixel that every channel can use: pixel over light of red, green and blue, then the [`radial::place`] of its
/// angle. 16 bytes that add up as one.
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
pub(super) struct Spot(pub [f32; 4]);

impl Spot {
    /// Where functions of its angle are found.
    #[inline]
    pub fn place(self) -> f32 {
        self.0[3]
    }

    /// True where its square would leave 32 bits no room for others, and where it is no number.
    fn is_bright(self) -> bool {
        const BRIGHTEST: f32 = 1e6;
        !self.0.iter().fold(true, |is_dimmer, value| is_dimmer & (value.abs() < BRIGHTEST))
    }
}

/// A pixel that some channel cannot use, or that is too bright to add up with others in 32 bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct OddSpot {
    pub cell: usize,
    pub spot: Spot,
    pub is_usable: [bool; 3],
}

/// How many spots, one after the other, belong to a cell.
#[derive(Clone, Copy, Debug)]
struct Run {
    cell: u32,
    length: u32,
}

/// What was read of some rows.
#[derive(Debug, Default)]
pub(super) struct Piece {
    spots: Vec<Spot>,
    runs: Vec<Run>,
    /// What is in no run.
    pub odd: Vec<OddSpot>,
    pub counts: Counts,
}

/// Reads a region under a light, in the same pieces whatever the number of threads, so that sums round alike.
pub(super) fn read(view: &View, region: &Region, light: &Light) -> Vec<Piece> {
    const ROWS: usize = 32;
    let rows: Vec<u32> = region.rows(view.size()).collect();
    rows.par_chunks(ROWS).map(|rows| Piece::read(view, region, light, rows)).collect()
}

impl Piece {
    /// Spots of one cell at a time, never more than 32 bits can add up.
    pub fn runs(&self) -> impl Iterator<Item = (usize, &[Spot])> {
        let mut start = 0;
        self.runs.iter().map(move |run| {
            let end = start + run.length as usize;
            let spots = &self.spots[start..end];
            start = end;
            (run.cell as usize, spots)
        })
    }

    /// Reads some rows of a region.
    fn read(view: &View, region: &Region, light: &Light, rows: &[u32]) -> Self {
        let rows: Vec<(u32, Vec<Stretch>)> =
            rows.iter().map(|row| (*row, region.stretches(*row, view.photo.width))).collect();
        let (mut piece, mut pixels) = (Self::default(), Vec::new());
        piece.spots.reserve(rows.iter().flat_map(|row| &row.1).map(|stretch| stretch.columns.len()).sum());
        for (row, stretches) in &rows {
            let facings = region.facings(*row);
            for beside in stretches.chunk_by(|left, right| left.columns.end == right.columns.start) {
                let columns = beside[0].columns.start..beside[beside.len() - 1].columns.end;
                pixels.clear();
                view.for_each_of_row(*row, columns, |pixel| pixels.push(pixel));
                let mut rest = pixels.as_slice();
                for Stretch { columns, cell } in beside {
                    let (pixels, after) = rest.split_at(columns.len());
                    piece.add(*cell, pixels, spots(view, light, &facings, columns.clone(), pixels));
                    rest = after;
                }
            }
        }
        piece
    }

    /// Adds the pixels of a cell, which are these spots.
    fn add(&mut self, cell: usize, pixels: &[Pixel], spots: impl Iterator<Item = Spot>) {
        let start = self.spots.len();
        self.spots.extend(spots);
        let is_plain = |is_plain, pixel: &Pixel| is_plain & (pixel.flags == PixelFlags::default());
        if !pixels.iter().fold(true, is_plain) || self.spots[start..].iter().any(|spot| spot.is_bright()) {
            let mixed = self.spots.split_off(start);
            pixels.iter().zip(mixed).for_each(|(pixel, spot)| self.add_mixed(cell, spot, pixel));
        }
        self.counts.add_pixels(pixels.len());
        self.end_run(cell, start);
    }

    fn add_mixed(&mut self, cell: usize, spot: Spot, pixel: &Pixel) {
        self.counts.add_flags(pixel.flags);
        let usable = usable_channels(pixel);
        let is_usable = std::array::from_fn(|i| usable[i] && spot.0[i].is_finite());
        match is_usable {
            [true, true, true] if !spot.is_bright() => self.spots.push(spot),
            [false, false, false] => {}
            _ => self.odd.push(OddSpot { cell, spot, is_usable }),
        }
    }

    /// Makes runs of the spots from `start` on.
    fn end_run(&mut self, cell: usize, start: usize) {
        const LONGEST: usize = 64;
        let runs = self.spots[start..].chunks(LONGEST);
        self.runs.extend(runs.map(|spots| Run { cell: cell as u32, length: spots.len() as u32 }));
    }
}

/// The spots of some pixels of a row.
fn spots(
    view: &View,
    light: &Light,
    facings: &Facings,
    columns: Range<u32>,
    pixels: &[Pixel],
) -> impl Iterator<Item = Spot> {
    columns.zip(pixels).map(|(column, pixel)| {
        let facing = facings.at(column);
        let [red, green, blue] = light.reflectance(view, pixel, &facing).map(|value| value as f32);
        Spot([red, green, blue, radial::place(facing.cosine as f32)])
    })
}
