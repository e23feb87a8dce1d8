//! A small copy of a photograph for the screen, averaged over every pixel of the full data.

use std::ops::Range;

use half::f16;
use nalgebra::Vector3;
use rayon::prelude::*;

use super::PixelFlags;
use super::orientation::Orientation;
use super::picture::{Photo, Stored};
use super::samples::{Sample, Samples, flags_of, for_each_pixel, is_plain};

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
    pub flags: Vec<PixelFlags>,
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

fn shrink<T: Sample>(stored: &Stored, samples: &[T], [width, height]: [u32; 2]) -> (Vec<[f32; 3]>, Vec<PixelFlags>) {
    let pixels = width as usize * height as usize;
    let (mut rgb, mut flags) = (vec![[0.0; 3]; pixels], vec![PixelFlags::default(); pixels]);
    let ends: Vec<usize> = (0..width as usize).map(|column| covered(column, width, stored.size[0]).end).collect();
    let rows = rgb.par_chunks_exact_mut(width as usize).zip(flags.par_chunks_exact_mut(width as usize)).enumerate();
    rows.for_each_init(Room::default, |room, (row, (rgb, flags))| {
        let covered = covered(row, height, stored.size[1]);
        small_row(stored, samples, &ends, covered.clone(), (rgb, room));
        for row in covered {
            add_flags(row_of(stored, samples, row), stored, &ends, flags);
        }
    });
    (rgb, flags)
}

/// Room that is used again for each row.
#[derive(Default)]
struct Room {
    /// A sum for each column of the file.
    columns: Vec<[f32; 3]>,
    decoded: Vec<[f32; 3]>,
    /// A sum for each column of the preview.
    sums: Vec<[f64; 3]>,
}

fn row_of<'a, T>(stored: &Stored, samples: &'a [T], row: usize) -> &'a [T] {
    let length = stored.size[0] as usize * stored.channels;
    &samples[row * length..][..length]
}

/// A row of the preview from some rows of the file: their columns are added up first, then runs of columns. The matrix
/// comes last: it commutes with means.
fn small_row<T: Sample>(
    stored: &Stored,
    samples: &[T],
    ends: &[usize],
    rows: Range<usize>,
    (rgb, room): (&mut [[f32; 3]], &mut Room),
) {
    /// So few rows that floats hold their sum to six digits.
    const ROWS_AT_ONCE: usize = 16;
    let Room { columns, decoded, sums } = room;
    sums.clear();
    sums.resize(ends.len(), [0.0; 3]);
    for first in rows.clone().step_by(ROWS_AT_ONCE) {
        columns.clear();
        columns.resize(stored.size[0] as usize, [0.0; 3]);
        for row in first..rows.end.min(first + ROWS_AT_ONCE) {
            stored.linearizer.add_row(row_of(stored, samples, row), stored.channels, columns, decoded);
        }
        add_runs(columns, ends, sums);
    }
    let matrix = stored.linearizer.matrix();
    let starts = std::iter::once(0).chain(ends.iter().copied());
    let counts = starts.zip(ends).map(|(start, end)| ((end - start) * rows.len()) as f64);
    for ((count, sum), rgb) in counts.zip(&*sums).zip(rgb) {
        *rgb = (matrix * Vector3::from(*sum) / count).map(|mean| mean as f32).into();
    }
}

/// Adds the columns of each run to its sum.
fn add_runs(columns: &[[f32; 3]], ends: &[usize], sums: &mut [[f64; 3]]) {
    let mut start = 0;
    for (end, sum) in ends.iter().zip(sums) {
        for column in &columns[start..*end] {
            sum.iter_mut().zip(column).for_each(|(sum, column)| *sum += f64::from(*column));
        }
        start = *end;
    }
}

/// Marks each run of pixels with the flags that any of them has. Most stretches of a picture have none, which
/// is seen at once.
fn add_flags<T: Sample>(pixels: &[T], stored: &Stored, ends: &[usize], flags: &mut [PixelFlags]) {
    const RUNS_AT_ONCE: usize = 64;
    let (black, channels) = (T::black(stored.is_linear), stored.channels);
    let mut start = 0;
    for (ends, flags) in ends.chunks(RUNS_AT_ONCE).zip(flags.chunks_mut(RUNS_AT_ONCE)) {
        let last = ends.last().copied().unwrap_or(start);
        if is_plain(&pixels[start * channels..last * channels], black) {
            start = last;
            continue;
        }
        for (end, flags) in ends.iter().zip(flags) {
            let mut of_run = PixelFlags::default();
            let run = &pixels[start * channels..end * channels];
            for_each_pixel(run, channels, |pixel| of_run = of_run.or(flags_of(pixel, black)));
            *flags = flags.or(of_run);
            start = *end;
        }
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
            assert_eq!(preview.flags[i], pixel.flags);
        }
    }

    #[test]
    fn one_bad_pixel_marks_its_small_pixel() {
        let mut pixels = vec![[0.5f32; 3]; 64];
        pixels[9] = [f32::NAN, 0.5, 0.5];
        let preview = Photo::from_linear("nan", 8, 8, pixels).preview(2);
        assert_eq!(preview.flags.iter().map(|f| f.non_finite).collect::<Vec<_>>(), [true, false, false, false]);
        assert!(preview.rgb.iter().flatten().all(|v| v.is_finite()));
    }
}
