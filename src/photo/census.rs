//! How many pixels of a photograph cannot be trusted.

use half::f16;
use rayon::prelude::*;

use super::picture::Stored;
use super::samples::{Sample, Samples, for_each_pixel, is_plain};
use super::{Warning, WarningCode};

/// Counts over the stored samples, before any conversion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Census {
    pixels: usize,
    clipped: usize,
    non_finite: usize,
    negative: usize,
}

impl Census {
    /// Counts every pixel.
    pub fn of(stored: &Stored) -> Self {
        match &stored.samples {
            Samples::U8(samples) => count(samples, stored.channels),
            Samples::U16(samples) => count(samples, stored.channels),
            Samples::F16(samples) => count::<f16>(samples, stored.channels),
            Samples::F32(samples) => count(samples, stored.channels),
        }
    }

    /// A sentence for each kind that occurs.
    pub fn warnings(self) -> impl Iterator<Item = Warning> {
        let percent = |count: usize| percent(count, self.pixels);
        let clipped =
            || format!("{} of the picture is clipped in a channel; do not measure there", percent(self.clipped));
        let non_finite = || format!("{} pixels hold NaN or infinity and are left out", self.non_finite);
        let negative = || format!("{} pixels hold negative values, kept as they are", self.negative);
        let warning = |code, count, message: &dyn Fn() -> String| (count > 0).then(|| Warning::new(code, message()));
        [
            warning(WarningCode::Clipped, self.clipped, &clipped),
            warning(WarningCode::NonFinite, self.non_finite, &non_finite),
            warning(WarningCode::Negative, self.negative, &negative),
        ]
        .into_iter()
        .flatten()
    }

    fn plus(self, other: Self) -> Self {
        Self {
            pixels: self.pixels + other.pixels,
            clipped: self.clipped + other.clipped,
            non_finite: self.non_finite + other.non_finite,
            negative: self.negative + other.negative,
        }
    }
}

/// Counts in blocks on every core.
fn count<T: Sample>(samples: &[T], channels: usize) -> Census {
    const PIXELS_PER_BLOCK: usize = 1 << 10;
    let blocks = samples.par_chunks(PIXELS_PER_BLOCK * channels);
    blocks.map(|block| count_block(block, channels)).reduce(Census::default, Census::plus)
}

fn count_block<T: Sample>(samples: &[T], channels: usize) -> Census {
    let mut census = Census { pixels: samples.len() / channels, ..Census::default() };
    if is_plain(samples, T::default()) {
        return census;
    }
    for_each_pixel(samples, channels, |[red, green, blue]| {
        let any = |is: fn(T) -> bool| usize::from(is(red) | is(green) | is(blue));
        census.clipped += any(|v| v >= T::CLIPPED && v.is_finite());
        census.non_finite += any(|v| !v.is_finite());
        census.negative += any(|v| v.is_negative() && v.is_finite());
    });
    census
}

/// A share that is never rounded to nothing.
fn percent(count: usize, all: usize) -> String {
    match 100.0 * count as f64 / all as f64 {
        share if share < 0.01 => "Less than 0.01 %".to_owned(),
        share if share < 1.0 => format!("{share:.2} %"),
        share => format!("{share:.1} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_counted_by_pixel() {
        let samples = [1.0, f32::NAN, f32::INFINITY, -1.0, -2.0, 0.0, f32::MAX, 0.0, 0.0, 0.5, 0.5, 0.5];
        let census = count(&samples, 3);
        assert_eq!(census, Census { pixels: 4, clipped: 1, non_finite: 1, negative: 1 });
        let codes: Vec<_> = census.warnings().map(|warning| warning.code).collect();
        assert_eq!(codes, [WarningCode::Clipped, WarningCode::NonFinite, WarningCode::Negative]);
        assert_eq!(count(&[10u8, 254, 30, 40], 1), Census { pixels: 4, clipped: 1, ..Census::default() });
    }

    #[test]
    fn a_share_is_never_nothing() {
        assert_eq!(percent(1, 1_000_000), "Less than 0.01 %");
        assert_eq!(percent(1, 200), "0.50 %");
        assert_eq!(percent(1, 8), "12.5 %");
    }
}
