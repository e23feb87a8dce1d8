//! What an area of a photograph holds: means, spread, and how well the mean is known.

use std::ops::Range;

use serde::Serialize;

use super::area::pixel_range;
use super::channel::{ChannelStatistics, ChannelValues};
use super::picture::RowPart;
use super::{Area, Photo, Pixel, PixelFlags};
use crate::color::Rgb;

/// The area is cut into this many tiles each way for the jackknife: neighbouring pixels correlate.
pub(super) const TILES: usize = 8;

/// Statistics of one area for each channel, linear Rec.709.
///
/// A channel leaves out pixels that are clipped in it or not finite. Values are NaN (`null` in JSON)
/// where no pixel is left. Dark pixels stay in: leaving them out would bias a noisy dark area.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AreaStatistics {
    /// Arithmetic mean.
    pub mean: [f64; 3],
    /// Mean of the middle 60 %: 20 % trimmed at each end (Tukey & McLaughlin 1963).
    pub trimmed_mean: [f64; 3],
    /// Median.
    pub median: [f64; 3],
    /// Standard deviation of one pixel.
    pub standard_deviation: [f64; 3],
    /// Standard error of the trimmed mean, by block jackknife over 8×8 tiles.
    pub standard_error: [f64; 3],
    /// Pixels of the area that lie in the picture.
    pub pixels: usize,
    /// Of these, how many are clipped in a channel.
    pub clipped: [usize; 3],
    /// Of these, how many are black.
    pub black: usize,
    /// Of these, how many are not finite.
    pub non_finite: usize,
    /// Share of the variance between the halves below and above the mean: 0.64 for noise, 0.75 for an even
    /// gradient, near 1 for two colours.
    pub bimodality: [f64; 3],
}

impl AreaStatistics {
    /// Measures an area. Parts outside the picture are left out.
    pub fn of(photo: &Photo, area: Area) -> Self {
        Self::of_pixels(photo, area, |pixel| pixel)
    }

    /// Measures an area after `read` has seen each pixel. It may change colours, not flags.
    pub(super) fn of_pixels(photo: &Photo, area: Area, read: impl Fn(Pixel) -> Pixel) -> Self {
        let mut samples = Samples::with_capacity(area.most_pixels(photo.width, photo.height));
        let (tiles, mut part) = (Tiles::of(area, photo), RowPart::default());
        for (row, columns) in area.rows(photo.width, photo.height) {
            for (tile, columns) in tiles.of_row(row, columns) {
                part.read(photo, row, columns);
                samples.extend(&mut part, &read);
                samples.end_stretch(tile);
            }
        }
        samples.statistics()
    }

    /// True when more than half a percent of the pixels are clipped in a channel: no value can be trusted.
    pub fn is_clipped(&self, channel: usize) -> bool {
        exceeds_clipping_limit(self.clipped[channel], self.pixels)
    }
}

/// More than this share of clipped pixels makes a channel unusable.
const CLIPPED_LIMIT: f64 = 0.005;

/// True when `clipped` of `pixels` is more than half a percent.
pub(super) fn exceeds_clipping_limit(clipped: usize, pixels: usize) -> bool {
    clipped as f64 > CLIPPED_LIMIT * pixels as f64
}

/// True where a pixel's channel may be averaged.
pub(super) fn usable_channels(pixel: &Pixel) -> [bool; 3] {
    pixel.flags.clipped.map(|is_clipped| !is_clipped && !pixel.flags.non_finite)
}

/// Which tile of an area a pixel lies in: row by row.
struct Tiles {
    top: f64,
    rows_per_pixel: f64,
    /// The first column that lies in each column of tiles, and where the last one ends.
    edges: [u32; TILES + 1],
}

impl Tiles {
    fn of(area: Area, photo: &Photo) -> Self {
        let [left, top, width, height] = area.bounds();
        let columns = pixel_range(left, width, photo.width);
        let lies_before = |column: u32, tile| index(column, left, TILES as f64 / width) < tile;
        let edges = std::array::from_fn(|tile| {
            let before = columns.clone().take_while(|column| tile == TILES || lies_before(*column, tile));
            columns.start + before.count() as u32
        });
        Self { top, rows_per_pixel: TILES as f64 / height, edges }
    }

    /// The columns of a row that lie in each tile, where there are any.
    fn of_row(&self, row: u32, columns: Range<u32>) -> impl Iterator<Item = (usize, Range<u32>)> {
        let first = TILES * index(row, self.top, self.rows_per_pixel);
        let within = move |edges: &[u32]| edges[0].max(columns.start)..edges[1].min(columns.end);
        let tiles = self.edges.windows(2).map(within).enumerate();
        tiles.filter(|(_, columns)| !columns.is_empty()).map(move |(tile, columns)| (first + tile, columns))
    }
}

/// Which of the tiles in one direction a row or a column lies in.
fn index(pixel: u32, start: f64, per_pixel: f64) -> usize {
    (((f64::from(pixel) + 0.5 - start) * per_pixel) as usize).min(TILES - 1)
}

/// The pixels of an area, and the usable values of each channel.
struct Samples {
    pixels: usize,
    channels: [ChannelValues; 3],
    clipped: [usize; 3],
    black: usize,
    non_finite: usize,
}

impl Samples {
    fn with_capacity(pixels: usize) -> Self {
        let channels = std::array::from_fn(|_| ChannelValues::with_capacity(pixels));
        Self { pixels: 0, channels, clipped: [0; 3], black: 0, non_finite: 0 }
    }

    fn extend(&mut self, part: &mut RowPart, read: impl Fn(Pixel) -> Pixel) {
        let RowPart { rgb, flags } = part;
        if flags.is_empty() {
            let plain = |rgb| read(Pixel { rgb: Rgb(rgb), flags: PixelFlags::default() }).rgb.0;
            rgb.iter_mut().for_each(|rgb| *rgb = plain(*rgb));
            self.extend_plainly(rgb);
        } else {
            let pixels = rgb.iter().zip(flags).map(|(rgb, flags)| Pixel { rgb: Rgb(*rgb), flags: *flags });
            pixels.for_each(|pixel| self.push(read(pixel)));
        }
    }

    /// Takes pixels without flags.
    fn extend_plainly(&mut self, pixels: &[[f64; 3]]) {
        self.pixels += pixels.len();
        for (channel, usable) in self.channels.iter_mut().enumerate() {
            usable.values.extend(pixels.iter().map(|rgb| rgb[channel] as f32));
        }
    }

    #[inline]
    fn push(&mut self, pixel: Pixel) {
        self.pixels += 1;
        self.black += usize::from(pixel.flags.black);
        self.non_finite += usize::from(pixel.flags.non_finite);
        let is_usable = usable_channels(&pixel);
        for (channel, usable) in self.channels.iter_mut().enumerate() {
            self.clipped[channel] += usize::from(pixel.flags.clipped[channel]);
            if is_usable[channel] {
                usable.values.push(pixel.rgb[channel] as f32);
            }
        }
    }

    /// What was pushed since the last end lies in a tile.
    fn end_stretch(&mut self, tile: usize) {
        self.channels.iter_mut().for_each(|channel| channel.end_stretch(tile));
    }

    fn statistics(self) -> AreaStatistics {
        let channels = self.channels.each_ref().map(ChannelStatistics::of);
        let of = |f: fn(&ChannelStatistics) -> f64| channels.each_ref().map(f);
        AreaStatistics {
            mean: of(|s| s.mean),
            trimmed_mean: of(|s| s.trimmed_mean),
            median: of(|s| s.median),
            standard_deviation: of(|s| s.standard_deviation),
            standard_error: of(|s| s.standard_error),
            bimodality: of(|s| s.bimodality),
            pixels: self.pixels,
            clipped: self.clipped,
            black: self.black,
            non_finite: self.non_finite,
        }
    }
}

/// The jackknife's standard error from the estimates with one block left out each; NaN for fewer than two.
pub(super) fn jackknife_error(estimates: &[f64]) -> f64 {
    let blocks = estimates.len() as f64;
    let centre = estimates.iter().sum::<f64>() / blocks;
    let spread: f64 = estimates.iter().map(|estimate| (estimate - centre).powi(2)).sum();
    if estimates.len() < 2 { f64::NAN } else { ((blocks - 1.0) / blocks * spread).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn photo(size: u32, value: impl Fn(u32, u32) -> f32) -> Photo {
        let pixels = (0..size * size).map(|i| [value(i % size, i / size); 3]).collect();
        Photo::from_linear("test", size, size, pixels)
    }

    fn whole(photo: &Photo) -> AreaStatistics {
        AreaStatistics::of(photo, Area::rectangle(0.0, 0.0, f64::from(photo.width), f64::from(photo.height)))
    }

    /// Values 0…63 once each: mean 31.5, variance (n² − 1)/12 · n/(n − 1) = n(n + 1)/12.
    #[test]
    fn of_the_first_integers() {
        let s = whole(&photo(8, |x, y| (y * 8 + x) as f32));
        for value in [s.mean[0], s.trimmed_mean[0], s.median[0]] {
            assert!((value - 31.5).abs() < 1e-12);
        }
        assert!((s.standard_deviation[0] - (64.0_f64 * 65.0 / 12.0).sqrt()).abs() < 1e-12);
        assert_eq!(s.pixels, 64);
    }

    #[test]
    fn the_error_shrinks_with_the_number_of_tiles_not_of_pixels() {
        let noise = |x: u32, y: u32| ((x.wrapping_mul(2_654_435_761) ^ y.wrapping_mul(2_246_822_519)) >> 8) % 1000;
        let fine = whole(&photo(64, |x, y| noise(x, y) as f32));
        let blocks = whole(&photo(64, |x, y| noise(x / 8, y / 8) as f32));
        assert!(blocks.standard_error[0] > 4.0 * fine.standard_error[0], "{blocks:?} {fine:?}");
    }

    #[test]
    fn a_highlight_moves_the_mean_but_not_the_trimmed_mean() {
        let s = whole(&photo(32, |x, _| if x < 4 { 50.0 } else { 1.0 }));
        assert!(s.mean[0] > 7.0 && s.trimmed_mean[0] == 1.0 && s.median[0] == 1.0);
    }

    #[test]
    fn two_colours_are_seen() {
        let s = whole(&photo(32, |x, _| if x < 16 { 0.5 } else { 0.6 }));
        assert!((s.bimodality[0] - 1.0).abs() < 1e-6);
        let gradient = whole(&photo(64, |x, _| x as f32));
        assert!((gradient.bimodality[0] - 0.75).abs() < 0.01, "a uniform distribution: {}", gradient.bimodality[0]);
    }

    #[test]
    fn nothing_in_the_picture_is_no_number() {
        let s = AreaStatistics::of(&photo(8, |_, _| 1.0), Area::rectangle(20.0, 20.0, 5.0, 5.0));
        assert_eq!(s.pixels, 0);
        assert!(s.mean[0].is_nan() && s.trimmed_mean[0].is_nan());
        assert!(serde_json::to_string(&s).unwrap().contains("\"mean\":[null,null,null]"));
    }
}
