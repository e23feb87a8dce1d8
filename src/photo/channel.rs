//! What one channel of an area holds.

use super::statistics::{TILES, jackknife_error};
use crate::number::at_ranks;

/// The usable values of a channel in the order they are met: stretch after stretch, each within one tile. Floats keep a
/// large area small.
pub(super) struct ChannelValues {
    pub values: Vec<f32>,
    stretches: Vec<Stretch>,
}

/// Neighbours in a row.
struct Stretch {
    tile: usize,
    /// Where its values end.
    end: usize,
}

impl ChannelValues {
    pub fn with_capacity(values: usize) -> Self {
        Self { values: Vec::with_capacity(values), stretches: Vec::new() }
    }

    /// What was pushed since the last end lies in a tile.
    pub fn end_stretch(&mut self, tile: usize) {
        self.stretches.push(Stretch { tile, end: self.values.len() });
    }

    /// The sum and the number of the values of each tile, all held between `low` and `high`.
    fn winsorised_tiles(&self, low: f32, high: f32) -> [(f64, f64); TILES * TILES] {
        let (mut tiles, mut start) = ([(0.0, 0.0); TILES * TILES], 0);
        for &Stretch { tile, end } in &self.stretches {
            let values = &self.values[start..end];
            tiles[tile].0 += sum(values, |value| f64::from(value.clamp(low, high)));
            tiles[tile].1 += values.len() as f64;
            start = end;
        }
        tiles
    }
}

/// What one channel of an area holds; NaN where nothing is usable.
pub(super) struct ChannelStatistics {
    pub mean: f64,
    pub trimmed_mean: f64,
    pub median: f64,
    pub standard_deviation: f64,
    pub standard_error: f64,
    pub bimodality: f64,
}

impl ChannelStatistics {
    pub fn of(channel: &ChannelValues) -> Self {
        let values = &*channel.values;
        let count = values.len() as f64;
        let mean = sum(values, f64::from) / count;
        let deviations = Deviations::of(values, mean);
        let standard_deviation = (deviations.squares / (count - 1.0)).sqrt();
        let bimodality = deviations.bimodality(count);
        if values.is_empty() {
            let (trimmed_mean, median, standard_error) = (mean, mean, mean);
            return Self { mean, trimmed_mean, median, standard_deviation, standard_error, bimodality };
        }
        let (last, cut) = (values.len() - 1, values.len() / 5);
        let [low, lower, upper, high] = at_ranks(values, [cut, last / 2, values.len() / 2, last - cut]);
        let tiles = channel.winsorised_tiles(low, high);
        Self {
            mean,
            trimmed_mean: trimmed_mean(&tiles, count, cut as f64, [low, high]),
            median: 0.5 * (f64::from(lower) + f64::from(upper)),
            standard_deviation,
            standard_error: standard_error(&tiles, count),
            bimodality,
        }
    }
}

#[cfg(test)]
impl ChannelStatistics {
    /// All of them, to be held against others.
    pub fn numbers(&self) -> [f64; 6] {
        let Self { mean, trimmed_mean, median, standard_deviation, standard_error, bimodality } = *self;
        [mean, trimmed_mean, median, standard_deviation, standard_error, bimodality]
    }
}

/// The sum of a function of the values, in eight lanes: one sum would wait for each addition.
#[inline(always)]
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
fn trimmed_mean(tiles: &[(f64, f64)], count: f64, cut: f64, [low, high]: [f32; 2]) -> f64 {
    let held: f64 = tiles.iter().map(|(sum, _)| sum).sum();
    let ends = cut * (f64::from(low) + f64::from(high));
    (held - ends) / (count - 2.0 * cut)
}

/// Delete-a-block jackknife of the trimmed mean (Künsch 1989) over tiles.
///
/// A tile's pull on the trimmed mean is the sum of its winsorised deviations over 0.6 n, the trimmed
/// mean's influence function (Huber 1981, section 3.3), so that one pass serves every tile.
fn standard_error(tiles: &[(f64, f64)], count: f64) -> f64 {
    let centre = tiles.iter().map(|(sum, _)| sum).sum::<f64>() / count;
    let pull = |(sum, size): &(f64, f64)| (centre * size - sum) / (0.6 * (count - size));
    let estimates: Vec<f64> = tiles.iter().filter(|(_, size)| *size > 0.0).map(pull).collect();
    jackknife_error(&estimates)
}

/// Sums over the differences of values from their mean.
struct Deviations {
    squares: f64,
    /// Of their absolute values.
    absolute: f64,
    /// How many values lie below the mean.
    below: f64,
}

impl Deviations {
    /// In lanes, like [`sum`].
    fn of(values: &[f32], mean: f64) -> Self {
        let (chunks, rest) = values.as_chunks::<8>();
        let (mut squares, mut absolute, mut below) = ([0.0; 8], [0.0; 8], [0_u64; 8]);
        let mut add = |lane: usize, value: f32| {
            let deviation = f64::from(value) - mean;
            squares[lane] += deviation * deviation;
            absolute[lane] += deviation.abs();
            below[lane] += u64::from(deviation.is_sign_negative());
        };
        for chunk in chunks {
            (0..8).for_each(|lane| add(lane, chunk[lane]));
        }
        rest.iter().for_each(|value| add(0, *value));
        Self { squares: squares.iter().sum(), absolute: absolute.iter().sum(), below: below.iter().sum::<u64>() as f64 }
    }

    /// Between-class share of the variance when the values are split at their mean (Otsu 1979, eq. 12). What lies below
    /// the mean falls short of it by half the absolute differences, and what lies above exceeds it by the other half.
    fn bimodality(&self, count: f64) -> f64 {
        let above = count - self.below;
        let between = (0.5 * self.absolute).powi(2) * count / (self.below * above);
        if self.squares > 0.0 { between / self.squares } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Values of stretches that lie in the tiles in turns.
    fn values(stretches: &[Vec<f32>]) -> ChannelValues {
        let mut channel = ChannelValues::with_capacity(0);
        for (tile, stretch) in stretches.iter().enumerate() {
            channel.values.extend(stretch);
            channel.end_stretch(tile % (TILES * TILES));
        }
        channel
    }

    /// By their definitions, over sorted values.
    fn plain(stretches: &[Vec<f32>]) -> ChannelStatistics {
        let mut sorted: Vec<f64> = stretches.iter().flatten().map(|value| f64::from(*value)).collect();
        sorted.sort_by(f64::total_cmp);
        let (count, cut) = (sorted.len() as f64, sorted.len() / 5);
        let mean_of = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let mean = mean_of(&sorted);
        let squares: f64 = sorted.iter().map(|value| (value - mean).powi(2)).sum();
        let (below, above) = sorted.split_at(sorted.partition_point(|value| *value < mean));
        let between = (below.len() * above.len()) as f64 / count * (mean_of(below) - mean_of(above)).powi(2);
        let (low, high) = (sorted[cut], sorted[sorted.len() - 1 - cut]);
        let winsorised = mean_of(&sorted.iter().map(|value| value.clamp(low, high)).collect::<Vec<_>>());
        let pulls = stretches.iter().filter(|stretch| !stretch.is_empty()).map(|stretch| {
            let pull: f64 = stretch.iter().map(|value| winsorised - f64::from(*value).clamp(low, high)).sum();
            pull / (0.6 * (count - stretch.len() as f64))
        });
        ChannelStatistics {
            mean,
            trimmed_mean: mean_of(&sorted[cut..sorted.len() - cut]),
            median: crate::number::median(&mut sorted.clone()),
            standard_deviation: (squares / (count - 1.0)).sqrt(),
            standard_error: jackknife_error(&pulls.collect::<Vec<_>>()),
            bimodality: if squares > 0.0 { between / squares } else { 0.0 },
        }
    }

    proptest! {
        #[test]
        fn they_are_what_their_definitions_say(
            stretches in prop::collection::vec(
                prop::collection::vec(prop_oneof![0.0..1.0_f32, -0.1..0.1_f32, Just(0.25), Just(30.0)], 0..40),
                1..60,
            ),
        ) {
            prop_assume!(stretches.iter().flatten().count() > 0);
            let (found, expected) = (ChannelStatistics::of(&values(&stretches)), plain(&stretches));
            for (found, expected) in found.numbers().into_iter().zip(expected.numbers()) {
                let is_near = (found - expected).abs() <= 1e-9 * expected.abs().max(1.0);
                prop_assert!(is_near || (found.is_nan() && expected.is_nan()), "{found} {expected}");
            }
        }
    }
}
