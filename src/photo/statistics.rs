//! What an area of a photograph holds: means, spread, and how well the mean is known.

use serde::Serialize;

use super::{Area, Photo, Pixel};
use crate::number::median_of_sorted;

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

fn tile_of(area: Area, x: f64, y: f64) -> usize {
    let [left, top, width, height] = area.bounds();
    let index = |offset: f64, size: f64| ((offset / size * TILES as f64) as usize).min(TILES - 1);
    index(y - top, height) * TILES + index(x - left, width)
}

#[derive(Default)]
struct Samples {
    /// (value, tile) of each usable pixel.
    channels: [Vec<(f64, usize)>; 3],
    pixels: usize,
    clipped: [usize; 3],
    black: usize,
    non_finite: usize,
}

impl Samples {
    fn push(&mut self, pixel: Pixel, tile: usize) {
        self.pixels += 1;
        self.black += usize::from(pixel.flags.black);
        self.non_finite += usize::from(pixel.flags.non_finite);
        for (channel, is_usable) in usable_channels(&pixel).into_iter().enumerate() {
            self.clipped[channel] += usize::from(pixel.flags.clipped[channel]);
            if is_usable {
                self.channels[channel].push((pixel.rgb[channel], tile));
            }
        }
    }

    fn statistics(mut self) -> AreaStatistics {
        for channel in &mut self.channels {
            channel.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        }
        let channels = &self.channels;
        let of = |f: fn(&[(f64, usize)]) -> f64| std::array::from_fn(|i| f(&channels[i]));
        AreaStatistics {
            mean: of(mean),
            trimmed_mean: of(trimmed_mean),
            median: of(median),
            standard_deviation: of(standard_deviation),
            standard_error: of(standard_error),
            bimodality: of(bimodality),
            pixels: self.pixels,
            clipped: self.clipped,
            black: self.black,
            non_finite: self.non_finite,
        }
    }
}

fn mean(samples: &[(f64, usize)]) -> f64 {
    samples.iter().map(|(value, _)| value).sum::<f64>() / samples.len() as f64
}

fn trimmed_mean(sorted: &[(f64, usize)]) -> f64 {
    let cut = sorted.len() / 5;
    mean(&sorted[cut..sorted.len() - cut])
}

fn median(sorted: &[(f64, usize)]) -> f64 {
    median_of_sorted(sorted, |(value, _)| *value)
}

fn standard_deviation(samples: &[(f64, usize)]) -> f64 {
    let centre = mean(samples);
    let sum: f64 = samples.iter().map(|(value, _)| (value - centre).powi(2)).sum();
    (sum / (samples.len() as f64 - 1.0)).sqrt()
}

/// Delete-a-block jackknife of the trimmed mean (Künsch 1989) over tiles.
///
/// A tile's pull on the trimmed mean is the sum of its winsorised deviations over 0.6 n, the trimmed
/// mean's influence function (Huber 1981, section 3.3), so that one pass serves every tile.
fn standard_error(sorted: &[(f64, usize)]) -> f64 {
    if sorted.is_empty() {
        return f64::NAN;
    }
    let cut = sorted.len() / 5;
    let (low, high) = (sorted[cut].0, sorted[sorted.len() - 1 - cut].0);
    let count = sorted.len() as f64;
    let centre = sorted.iter().map(|(value, _)| value.clamp(low, high)).sum::<f64>() / count;
    let mut tiles = [(0.0, 0.0); TILES * TILES];
    for (value, tile) in sorted {
        tiles[*tile].0 += value.clamp(low, high) - centre;
        tiles[*tile].1 += 1.0;
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
fn bimodality(sorted: &[(f64, usize)]) -> f64 {
    let centre = mean(sorted);
    let below = sorted.partition_point(|(value, _)| *value < centre);
    let share = below as f64 / sorted.len() as f64;
    let (low, high) = sorted.split_at(below);
    let between = share * (1.0 - share) * (mean(high) - mean(low)).powi(2);
    let total = sorted.iter().map(|(value, _)| (value - centre).powi(2)).sum::<f64>() / sorted.len() as f64;
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
