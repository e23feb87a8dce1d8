//! A small copy of a photograph for the screen, averaged over every pixel of the full data.

use std::ops::Range;

use half::f16;
use rayon::prelude::*;

use super::flags::{self, PackedFlags};
use super::orientation::Orientation;
use super::picture::{Photo, Stored};
use super::samples::{Sample, Samples};

/// A small copy in linear Rec.709.
#[derive(Clone, Debug, PartialEq)]
pub struct Preview {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Means over the pixels that each small pixel covers, row by row, unclamped.
    pub rgb: Vec<[f32; 3]>,
    /// Flags that any covered pixel has.
    pub flags: Vec<PackedFlags>,
}

impl Photo {
    /// A copy whose longer side is at most `max_side`, and never larger than the photograph. Means are taken
    /// over light, so what is too small to see keeps its share; NaN and infinities count as black.
    pub fn preview(&self, max_side: u32) -> Preview {
        let stored = &*self.stored;
        let size = fitted(stored.size, max_side.max(1));
        let (rgb, flags) = match &stored.samples {
            Samples::U8(samples) => shrink(stored, samples, size),
            Samples::U16(samples) => shrink(stored, samples, size),
            Samples::F16(samples) => shrink::<f16>(stored, samples, size),
            Samples::F32(samples) => shrink(stored, samples, size),
        };
        let [width, height] = stored.orientation.size(size);
        let orientation = stored.orientation;
        Preview { width, height, rgb: turned(rgb, orientation, size), flags: turned(flags, orientation, size) }
    }
}

/// The stored pixels as they lie in the picture.
fn turned<T: Copy>(stored: Vec<T>, orientation: Orientation, size: [u32; 2]) -> Vec<T> {
    if orientation == Orientation::default() {
        return stored;
    }
    let [width, height] = orientation.size(size);
    let positions = (0..height).flat_map(|row| (0..width).map(move |column| [column, row]));
    let index = |[x, y]: [u32; 2]| y as usize * size[0] as usize + x as usize;
    positions.map(|position| stored[index(orientation.stored(position, size))]).collect()
}

/// The size with the longer side at most `max_side`.
fn fitted([width, height]: [u32; 2], max_side: u32) -> [u32; 2] {
    let longer = width.max(height);
    if longer <= max_side {
        return [width, height];
    }
    let scaled = |side: u32| (u64::from(side) * u64::from(max_side)).div_ceil(u64::from(longer)) as u32;
    [scaled(width), scaled(height)]
}

/// The full pixels that small pixel `index` of `count` covers, of `all`.
fn covered(index: usize, count: u32, all: u32) -> Range<usize> {
    let edge = |i: usize| (i as u64 * u64::from(all) / u64::from(count)) as usize;
    edge(index)..edge(index + 1)
}

fn shrink<T: Sample>(stored: &Stored, samples: &[T], [width, height]: [u32; 2]) -> (Vec<[f32; 3]>, Vec<PackedFlags>) {
    let pixels = width as usize * height as usize;
    let (mut rgb, mut flags) = (vec![[0.0; 3]; pixels], vec![PackedFlags::default(); pixels]);
    let columns = (0..width as usize).map(|column| covered(column, width, stored.size[0]));
    let (ends, shares): (Vec<usize>, Vec<f64>) = columns.map(|run| (run.end, 1.0 / run.len() as f64)).unzip();
    let length = stored.size[0] as usize * stored.channels;
    let rows = rgb.par_chunks_exact_mut(width as usize).zip(flags.par_chunks_exact_mut(width as usize)).enumerate();
    rows.for_each_init(Vec::new, |sums, (row, (rgb, small_flags))| {
        let rows = covered(row, height, stored.size[1]);
        let rows: Vec<&[T]> = samples[rows.start * length..rows.end * length].chunks_exact(length).collect();
        flags::of_runs(&rows, stored.channels, T::black(stored.is_linear), &ends, small_flags);
        sums.clear();
        sums.resize(ends.len(), [0.0; 3]);
        stored.linearizer.add_runs(&rows, stored.channels, &ends, sums);
        means(stored, sums, &shares, rows.len(), rgb);
    });
    (rgb, flags)
}

/// From the sums of a row of small pixels to their means; `shares` is one over the columns of each. The matrix comes
/// last: it commutes with means.
fn means(stored: &Stored, sums: &[[f64; 3]], shares: &[f64], rows: usize, rgb: &mut [[f32; 3]]) {
    let (to_rec709, share_of_row) = (stored.linearizer.to_rec709(), 1.0 / rows as f64);
    for ((sum, share), rgb) in sums.iter().zip(shares).zip(rgb) {
        let share = share * share_of_row;
        *rgb = to_rec709(sum.map(|sum| sum * share)).map(|mean| mean as f32);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(width: u32, height: u32) -> Photo {
        let pixels = (0..width * height).map(|i| [i as f32, 1.0, (i % 7) as f32]).collect();
        Photo::from_linear("ramp", width, height, pixels)
    }

    fn mean(rgb: &[[f32; 3]], weights: &[f64]) -> f64 {
        rgb.iter().zip(weights).map(|(rgb, weight)| f64::from(rgb[0]) * weight).sum::<f64>()
            / weights.iter().sum::<f64>()
    }

    /// The mean of the means, weighted by the pixels covered, is the mean.
    #[test]
    fn light_is_kept() {
        let (width, height) = (37, 23);
        let photo = ramp(width, height);
        let full = f64::from(width * height - 1) / 2.0;
        for max_side in [1, 5, 10, 36, 37, 100] {
            let preview = photo.preview(max_side);
            let count = |index: u32, count, all| covered(index as usize, count, all).len() as f64;
            let weights: Vec<f64> = (0..preview.width * preview.height)
                .map(|i| {
                    count(i % preview.width, preview.width, width) * count(i / preview.width, preview.height, height)
                })
                .collect();
            assert!((mean(&preview.rgb, &weights) - full).abs() < 1e-3, "{max_side}");
            assert_eq!(preview.width.max(preview.height), max_side.min(37));
        }
    }

    #[test]
    fn full_size_is_the_photograph() {
        let photo = ramp(5, 3);
        let preview = photo.preview(5);
        for (i, rgb) in preview.rgb.iter().enumerate() {
            let pixel = photo.pixel(i as u32 % 5, i as u32 / 5).unwrap();
            assert_eq!(rgb.map(f64::from), pixel.rgb.0);
            assert_eq!(preview.flags[i].unpack(), pixel.flags);
        }
    }

    #[test]
    fn one_bad_pixel_marks_its_small_pixel() {
        let mut pixels = vec![[0.5f32; 3]; 64];
        pixels[9] = [f32::NAN, 0.5, 0.5];
        let preview = Photo::from_linear("nan", 8, 8, pixels).preview(2);
        assert_eq!(
            preview.flags.iter().map(|f| f.unpack().non_finite).collect::<Vec<_>>(),
            [true, false, false, false]
        );
        assert!(preview.rgb.iter().flatten().all(|v| v.is_finite()));
    }
}
