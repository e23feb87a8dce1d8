//! What an area of a photograph holds: means, spread, and how well the mean is known.

use std::cmp::Ordering;
use std::ops::Range;

use serde::Serialize;

use super::{Area, Photo, Pixel};

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
        let mut samples = Samples::default();
        for (column, row) in area.pixels(photo.width, photo.height) {
            if let Some(pixel) = photo.pixel(column, row) {
                samples.push(read(pixel), tile_of(area, f64::from(column) + 0.5, f64::from(row) + 0.5));
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

fn tile_of(area: Area, x: f64, y: f64) -> u8 {
    let [left, top, width, height] = area.bounds();
    let index = |offset: f64, size: f64| ((offset / size * TILES as f64) as usize).min(TILES - 1);
    (index(y - top, height) * TILES + index(x - left, width)) as u8
}

/// The usable pixels of an area. Floats keep a large area small: 13 bytes for each pixel.
#[derive(Default)]
struct Samples {
    /// Linear values; NaN in a channel that is clipped or not finite.
    values: Vec<[f32; 3]>,
    /// The tile of each.
    tiles: Vec<u8>,
    clipped: [usize; 3],
    black: usize,
    non_finite: usize,
}

impl Samples {
    fn push(&mut self, pixel: Pixel, tile: u8) {
        self.black += usize::from(pixel.flags.black);
        self.non_finite += usize::from(pixel.flags.non_finite);
        for channel in 0..3 {
            self.clipped[channel] += usize::from(pixel.flags.clipped[channel]);
        }
        let is_usable = usable_channels(&pixel);
        self.values.push(std::array::from_fn(|i| if is_usable[i] { pixel.rgb[i] as f32 } else { f32::NAN }));
        self.tiles.push(tile);
    }

    fn statistics(self) -> AreaStatistics {
        let mut usable = Vec::with_capacity(self.values.len());
        let channels: [ChannelStatistics; 3] = std::array::from_fn(|i| {
            let of_channel = self.values.iter().zip(&self.tiles).map(|(value, tile)| (value[i], *tile));
            usable.clear();
            usable.extend(of_channel.filter(|(value, _)| !value.is_nan()));
            ChannelStatistics::of(&mut usable)
        });
        let of = |f: fn(&ChannelStatistics) -> f64| channels.each_ref().map(f);
        AreaStatistics {
            mean: of(|s| s.mean),
            trimmed_mean: of(|s| s.trimmed_mean),
            median: of(|s| s.median),
            standard_deviation: of(|s| s.standard_deviation),
            standard_error: of(|s| s.standard_error),
            bimodality: of(|s| s.bimodality),
            pixels: self.values.len(),
            clipped: self.clipped,
            black: self.black,
            non_finite: self.non_finite,
        }
    }
}

/// A value of one channel and its tile.
type Sample = (f32, u8);

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
    /// Of samples in any order, which it reorders: selecting the fifths and the middle is enough, none is sorted.
    fn of(samples: &mut [Sample]) -> Self {
        let mean = mean(samples);
        let (standard_deviation, bimodality) = (standard_deviation(samples, mean), bimodality(samples, mean));
        let Some(middle) = middle_fifths(samples) else {
            return Self {
                mean,
                trimmed_mean: mean,
                median: mean,
                standard_deviation,
                standard_error: mean,
                bimodality,
            };
        };
        let (trimmed_mean, median) = (self::mean(&samples[middle.clone()]), median(&mut samples[middle.clone()]));
        let limits = [samples[middle.start].0, samples[middle.end - 1].0];
        let standard_error = standard_error(samples, limits);
        Self { mean, trimmed_mean, median, standard_deviation, standard_error, bimodality }
    }
}

/// Brings the middle 60 % of the samples together, the smallest of them first, the largest last; `None` of nothing.
fn middle_fifths(samples: &mut [Sample]) -> Option<Range<usize>> {
    let cut = samples.len() / 5;
    let middle = cut..samples.len() - cut;
    if middle.is_empty() {
        return None;
    }
    samples.select_nth_unstable_by(middle.start, by_value);
    let rest = &mut samples[middle.start + 1..];
    if let Some(last) = middle.len().checked_sub(2) {
        rest.select_nth_unstable_by(last, by_value);
    }
    Some(middle)
}

fn by_value(a: &Sample, b: &Sample) -> Ordering {
    a.0.total_cmp(&b.0)
}

fn mean(samples: &[Sample]) -> f64 {
    samples.iter().map(|(value, _)| f64::from(*value)).sum::<f64>() / samples.len() as f64
}

/// The median, with the ends of the samples left where they are.
fn median(samples: &mut [Sample]) -> f64 {
    let (middle, last) = (samples.len() / 2, samples.len() - 1);
    if samples.len() < 3 {
        return mean(samples);
    }
    let is_even = samples.len().is_multiple_of(2);
    let (below, upper, _) = samples[1..last].select_nth_unstable_by(middle - 1, by_value);
    let lower = below.iter().map(|sample| sample.0).max_by(f32::total_cmp).filter(|_| is_even);
    let upper = f64::from(upper.0);
    lower.map_or(upper, |lower| 0.5 * (f64::from(lower) + upper))
}

fn standard_deviation(samples: &[Sample], centre: f64) -> f64 {
    (sum_of_squares(samples, centre) / (samples.len() as f64 - 1.0)).sqrt()
}

fn sum_of_squares(samples: &[Sample], centre: f64) -> f64 {
    samples.iter().map(|(value, _)| (f64::from(*value) - centre).powi(2)).sum()
}

/// Delete-a-block jackknife of the trimmed mean (Künsch 1989) over tiles.
///
/// A tile's pull on the trimmed mean is the sum of its winsorised deviations over 0.6 n, the trimmed
/// mean's influence function (Huber 1981, section 3.3), so that one pass serves every tile.
fn standard_error(samples: &[Sample], [low, high]: [f32; 2]) -> f64 {
    let winsorised = |value: f32| f64::from(value.clamp(low, high));
    let count = samples.len() as f64;
    let centre = samples.iter().map(|(value, _)| winsorised(*value)).sum::<f64>() / count;
    let mut tiles = [(0.0, 0.0); TILES * TILES];
    for (value, tile) in samples {
        tiles[usize::from(*tile)].0 += winsorised(*value) - centre;
        tiles[usize::from(*tile)].1 += 1.0;
    }
    let estimates: Vec<f64> =
        tiles.iter().filter(|tile| tile.1 > 0.0).map(|(pull, size)| -pull / (0.6 * (count - size))).collect();
    jackknife_error(&estimates)
}

/// The jackknife's standard error from the estimates with one block left out each; NaN for fewer than two.
pub(super) fn jackknife_error(estimates: &[f64]) -> f64 {
    let blocks = estimates.len() as f64;
    let centre = estimates.iter().sum::<f64>() / blocks;
    let spread: f64 = estimates.iter().map(|estimate| (estimate - centre).powi(2)).sum();
    if estimates.len() < 2 { f64::NAN } else { ((blocks - 1.0) / blocks * spread).sqrt() }
}

/// Between-class share of the variance when the samples are split at their mean (Otsu 1979, eq. 12).
fn bimodality(samples: &[Sample], centre: f64) -> f64 {
    let (mut below, mut sum_below) = (0.0, 0.0);
    for value in samples.iter().map(|(value, _)| f64::from(*value)).filter(|value| *value < centre) {
        (below, sum_below) = (below + 1.0, sum_below + value);
    }
    let count = samples.len() as f64;
    let (low, high) = (sum_below / below, (centre * count - sum_below) / (count - below));
    let between = below * (count - below) / (count * count) * (high - low).powi(2);
    let total = sum_of_squares(samples, centre) / count;
    if total > 0.0 { between / total } else { 0.0 }
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

    /// Selecting gives what sorting gives, for every number of samples.
    #[test]
    fn the_middle_is_that_of_the_sorted_samples() {
        let value = |i: usize| ((i * 7_919 + 13) % 101) as f32;
        for count in 1..60 {
            let mut samples: Vec<Sample> = (0..count).map(|i| (value(i), 0)).collect();
            let mut sorted: Vec<f64> = samples.iter().map(|(value, _)| f64::from(*value)).collect();
            sorted.sort_by(f64::total_cmp);
            let median = crate::number::median(&mut sorted.clone());
            let middle = &sorted[count / 5..count - count / 5];
            let expected = middle.iter().sum::<f64>() / middle.len() as f64;
            let found = ChannelStatistics::of(&mut samples);
            assert!((found.trimmed_mean - expected).abs() < 1e-9, "{count}");
            assert_eq!(found.median, median, "{count}");
            let limits = [samples[count / 5].0, samples[count - 1 - count / 5].0].map(f64::from);
            assert_eq!(limits, [middle[0], middle[middle.len() - 1]], "{count}");
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
