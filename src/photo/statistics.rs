//! What an area of a photograph holds: means, spread, and how well the mean is known.

use serde::Serialize;

use super::{Area, Photo, Pixel};
use crate::number::at_ranks;

/// The area is cut into this many tiles each way for the jackknife: neighbouring pixels correlate.
const TILES: usize = 8;

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

    /// Measures an area after `read` has seen each pixel.
    pub(super) fn of_pixels(photo: &Photo, area: Area, read: impl Fn(Pixel) -> Pixel) -> Self {
        let mut samples = Samples::with_capacity(area.most_pixels(photo.width, photo.height));
        let tiles = Tiles::of(area);
        for (row, columns) in area.rows(photo.width, photo.height) {
            let (tile_row, mut column) = (tiles.row(row), columns.start);
            photo.for_each_of_row(row, columns, |pixel| {
                samples.push(read(pixel), tile_row + tiles.column(column));
                column += 1;
            });
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
    left: f64,
    top: f64,
    columns_per_pixel: f64,
    rows_per_pixel: f64,
}

impl Tiles {
    fn of(area: Area) -> Self {
        let [left, top, width, height] = area.bounds();
        Self { left, top, columns_per_pixel: TILES as f64 / width, rows_per_pixel: TILES as f64 / height }
    }

    fn column(&self, column: u32) -> u8 {
        Self::index((f64::from(column) + 0.5 - self.left) * self.columns_per_pixel)
    }

    /// The first tile of the row.
    fn row(&self, row: u32) -> u8 {
        TILES as u8 * Self::index((f64::from(row) + 0.5 - self.top) * self.rows_per_pixel)
    }

    fn index(place: f64) -> u8 {
        (place as u8).min(TILES as u8 - 1)
    }
}

/// The pixels of an area, and the usable values of each channel. Floats keep a large area small: 15 bytes for each
/// pixel.
struct Samples {
    pixels: usize,
    channels: [Usable; 3],
    clipped: [usize; 3],
    black: usize,
    non_finite: usize,
}

/// The linear values of a channel that is neither clipped nor not finite, and their tiles.
struct Usable {
    values: Vec<f32>,
    tiles: Vec<u8>,
}

impl Samples {
    fn with_capacity(pixels: usize) -> Self {
        let usable = || Usable { values: Vec::with_capacity(pixels), tiles: Vec::with_capacity(pixels) };
        Self { pixels: 0, channels: [usable(), usable(), usable()], clipped: [0; 3], black: 0, non_finite: 0 }
    }

    fn push(&mut self, pixel: Pixel, tile: u8) {
        self.pixels += 1;
        self.black += usize::from(pixel.flags.black);
        self.non_finite += usize::from(pixel.flags.non_finite);
        let is_usable = usable_channels(&pixel);
        for (channel, usable) in self.channels.iter_mut().enumerate() {
            self.clipped[channel] += usize::from(pixel.flags.clipped[channel]);
            if is_usable[channel] {
                usable.values.push(pixel.rgb[channel] as f32);
                usable.tiles.push(tile);
            }
        }
    }

    fn statistics(self) -> AreaStatistics {
        let channels = self.channels.each_ref().map(|usable| ChannelStatistics::of(&usable.values, &usable.tiles));
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

/// What one channel of an area holds.
struct ChannelStatistics {
    mean: f64,
    trimmed_mean: f64,
    median: f64,
    standard_deviation: f64,
    standard_error: f64,
    bimodality: f64,
}

impl ChannelStatistics {
    /// Of values in any order, and the tile of each.
    fn of(values: &[f32], tiles: &[u8]) -> Self {
        let count = values.len();
        let mean = sum(values, f64::from) / count as f64;
        let squares = sum(values, |value| (f64::from(value) - mean).powi(2));
        let standard_deviation = (squares / (count as f64 - 1.0)).sqrt();
        let bimodality = bimodality(values, mean, squares);
        if values.is_empty() {
            return Self {
                mean,
                trimmed_mean: mean,
                median: mean,
                standard_deviation,
                standard_error: mean,
                bimodality,
            };
        }
        let cut = count / 5;
        let [low, lower, upper, high] = at_ranks(values, [cut, (count - 1) / 2, count / 2, count - cut - 1]);
        let trimmed_mean = trimmed_mean(values, cut, [low, high]);
        let median = 0.5 * (f64::from(lower) + f64::from(upper));
        let standard_error = standard_error(values, tiles, [low, high]);
        Self { mean, trimmed_mean, median, standard_deviation, standard_error, bimodality }
    }
}

/// The sum of a function of the values, in eight lanes: one sum would wait for each addition.
fn sum(values: &[f32], of: impl Fn(f32) -> f64) -> f64 {
    let (chunks, rest) = values.as_chunks::<8>();
    let mut lanes = [0.0; 8];
    for chunk in chunks {
        lanes.iter_mut().zip(chunk).for_each(|(lane, value)| *lane += of(*value));
    }
    lanes.iter().sum::<f64>() + rest.iter().map(|value| of(*value)).sum::<f64>()
}

/// Mean of the values from the `cut`th smallest to the `cut`th largest, which are `low` and `high`: the sum of all held
/// between them, less what the `cut` held at each end add.
fn trimmed_mean(values: &[f32], cut: usize, [low, high]: [f32; 2]) -> f64 {
    let held = sum(values, |value| f64::from(value.clamp(low, high)));
    let ends = cut as f64 * (f64::from(low) + f64::from(high));
    (held - ends) / (values.len() - 2 * cut) as f64
}

/// Delete-a-block jackknife of the trimmed mean (Künsch 1989) over tiles.
///
/// A tile's pull on the trimmed mean is the sum of its winsorised deviations over 0.6 n, the trimmed
/// mean's influence function (Huber 1981, section 3.3), so that one pass serves every tile.
fn standard_error(values: &[f32], tiles: &[u8], [low, high]: [f32; 2]) -> f64 {
    let mut sums = [(0.0, 0.0); TILES * TILES];
    for (value, tile) in values.iter().zip(tiles) {
        sums[usize::from(*tile)].0 += f64::from(value.clamp(low, high));
        sums[usize::from(*tile)].1 += 1.0;
    }
    let count = values.len() as f64;
    let centre = sums.iter().map(|(sum, _)| sum).sum::<f64>() / count;
    let pull = |(sum, size): &(f64, f64)| (centre * size - sum) / (0.6 * (count - size));
    let estimates: Vec<f64> = sums.iter().filter(|(_, size)| *size > 0.0).map(pull).collect();
    jackknife_error(&estimates)
}

/// The jackknife's standard error from the estimates with one block left out each; NaN for fewer than two.
pub(super) fn jackknife_error(estimates: &[f64]) -> f64 {
    let blocks = estimates.len() as f64;
    let centre = estimates.iter().sum::<f64>() / blocks;
    let spread: f64 = estimates.iter().map(|estimate| (estimate - centre).powi(2)).sum();
    if estimates.len() < 2 { f64::NAN } else { ((blocks - 1.0) / blocks * spread).sqrt() }
}

/// Between-class share of the variance when the values are split at their mean (Otsu 1979, eq. 12). `squares` is the
/// sum of squared differences from that mean.
fn bimodality(values: &[f32], mean: f64, squares: f64) -> f64 {
    let is_below = |value: f32| f64::from(value) < mean;
    let below = sum(values, |value| f64::from(u8::from(is_below(value))));
    let sum_below = sum(values, |value| if is_below(value) { f64::from(value) } else { 0.0 });
    let count = values.len() as f64;
    let (low, high) = (sum_below / below, (mean * count - sum_below) / (count - below));
    let between = below * (count - below) / count * (high - low).powi(2);
    if squares > 0.0 { between / squares } else { 0.0 }
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

    /// Ranks give what sorting gives, for every number of values.
    #[test]
    fn the_middle_is_that_of_the_sorted_values() {
        let value = |i: usize| ((i * 7_919 + 13) % 101) as f32;
        for count in 1..60 {
            let values: Vec<f32> = (0..count).map(value).collect();
            let mut sorted: Vec<f64> = values.iter().map(|value| f64::from(*value)).collect();
            sorted.sort_by(f64::total_cmp);
            let median = crate::number::median(&mut sorted.clone());
            let middle = &sorted[count / 5..count - count / 5];
            let expected = middle.iter().sum::<f64>() / middle.len() as f64;
            let found = ChannelStatistics::of(&values, &vec![0; count]);
            assert!((found.trimmed_mean - expected).abs() < 1e-9, "{count}");
            assert_eq!(found.median, median, "{count}");
        }
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
