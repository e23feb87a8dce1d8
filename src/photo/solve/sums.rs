//! Sums over the pixels of a cell: in 32 bits over a run of few, in 64 bits over all.

use super::cells::Cell;
use super::radial::Radial;
use super::spots::{OddSpot, Spot};
use crate::fresnel::Weights;

/// A sum that can be added to.
pub(super) trait Plus {
    fn plus(&mut self, other: &Self);
}

/// Sums over the spots of a cell: of runs for all channels together, of odd spots for each channel. They stay apart,
/// since an odd spot may be so bright that no digit of the others would be left.
#[derive(Clone, Copy, Default)]
pub(super) struct Sum {
    runs: Angles,
    reflectance_of_runs: [f64; 3],
    odd: [Angles; 3],
    reflectance_of_odd: [f64; 3],
}

/// How many spots, and the sums of what their angles give.
#[derive(Clone, Copy, Default)]
struct Angles {
    count: f64,
    of_r: f64,
    of_h: f64,
    cosine: f64,
}

impl Sum {
    /// Adds `times` the spots of a run: −1 takes them off again.
    #[inline]
    pub fn add_run(&mut self, times: f64, spots: &[Spot], weights: &Radial<2>) {
        let (mut values, mut of_angles) = ([0.0_f32; 4], [0.0_f32; 2]);
        for spot in spots {
            (0..4).for_each(|i| values[i] += spot.0[i]);
            let weights = weights.at(spot.place());
            (0..2).for_each(|i| of_angles[i] += weights[i]);
        }
        let [red, green, blue, places] = values.map(f64::from);
        self.runs.add(times, spots.len() as f64, of_angles.map(f64::from), places);
        self.reflectance_of_runs.iter_mut().zip([red, green, blue]).for_each(|(sum, value)| *sum += times * value);
    }

    /// Adds a spot to the channels that can use it.
    pub fn add_odd(&mut self, odd: &OddSpot, weights: &Radial<2>) {
        let of_angle = weights.at(odd.spot.place()).map(f64::from);
        for channel in (0..3).filter(|channel| odd.is_usable[*channel]) {
            self.odd[channel].add(1.0, 1.0, of_angle, odd.spot.place().into());
            self.reflectance_of_odd[channel] += f64::from(odd.spot.0[channel]);
        }
    }

    /// Without the odd spots.
    pub fn of_runs(&self) -> Self {
        Self { runs: self.runs, reflectance_of_runs: self.reflectance_of_runs, ..Self::default() }
    }

    /// The means of a channel, of a cell that knows its number alone; `None` where no spot is left.
    pub fn mean(&self, channel: usize) -> Option<Cell> {
        let mut angles = self.runs;
        angles.plus(&self.odd[channel]);
        let Angles { count, of_r, of_h, cosine } = angles;
        (count > 0.0).then(|| Cell {
            stratum: 0,
            block: 0,
            ring: 0,
            count: count as usize,
            reflectance: (self.reflectance_of_runs[channel] + self.reflectance_of_odd[channel]) / count,
            weights: Weights { of_r: of_r / count, of_h: of_h / count, of_white: (count - of_r - of_h) / count },
            cosine: cosine / count,
        })
    }
}

impl Angles {
    /// Adds `times` some spots by their weights of r and h and their places, which are 1 + cos θ.
    #[inline]
    fn add(&mut self, times: f64, count: f64, [of_r, of_h]: [f64; 2], places: f64) {
        self.count += times * count;
        self.of_r += times * of_r;
        self.of_h += times * of_h;
        self.cosine += times * (places - count);
    }
}

impl Plus for Angles {
    fn plus(&mut self, other: &Self) {
        self.count += other.count;
        self.of_r += other.of_r;
        self.of_h += other.of_h;
        self.cosine += other.cosine;
    }
}

impl Plus for Sum {
    fn plus(&mut self, other: &Self) {
        self.runs.plus(&other.runs);
        for channel in 0..3 {
            self.odd[channel].plus(&other.odd[channel]);
            self.reflectance_of_runs[channel] += other.reflectance_of_runs[channel];
            self.reflectance_of_odd[channel] += other.reflectance_of_odd[channel];
        }
    }
}

/// How what is left around a curve scatters in a cell, in each channel.
#[derive(Clone, Copy, Default)]
pub(super) struct Scatters {
    count: [f64; 3],
    sum: [f64; 3],
    squares: [f64; 3],
}

impl Scatters {
    /// Adds the spots of a run; the curve is 0 in the fourth place.
    #[inline]
    pub fn add_run(&mut self, spots: &[Spot], curve: &Radial<4>) {
        let (mut sum, mut squares) = ([0.0_f32; 4], [0.0_f32; 4]);
        for spot in spots {
            let expected = curve.at(spot.place());
            for i in 0..4 {
                let left = spot.0[i] - expected[i];
                sum[i] += left;
                squares[i] += left * left;
            }
        }
        for channel in 0..3 {
            self.count[channel] += spots.len() as f64;
            self.sum[channel] += f64::from(sum[channel]);
            self.squares[channel] += f64::from(squares[channel]);
        }
    }

    /// Adds a spot to the channels that can use it.
    pub fn add_odd(&mut self, odd: &OddSpot, curve: &Radial<4>) {
        let expected = curve.at(odd.spot.place());
        for channel in (0..3).filter(|channel| odd.is_usable[*channel]) {
            let left = f64::from(odd.spot.0[channel]) - f64::from(expected[channel]);
            self.count[channel] += 1.0;
            self.sum[channel] += left;
            self.squares[channel] += left * left;
        }
    }

    /// The variance of a spot of a channel; `None` of fewer than two.
    pub fn variance(&self, channel: usize) -> Option<f64> {
        let (count, sum) = (self.count[channel], self.sum[channel]);
        let left = (self.squares[channel] - sum * sum / count).max(0.0);
        (count > 1.0).then(|| left / (count - 1.0))
    }
}

impl Plus for Scatters {
    fn plus(&mut self, other: &Self) {
        for channel in 0..3 {
            self.count[channel] += other.count[channel];
            self.sum[channel] += other.sum[channel];
            self.squares[channel] += other.squares[channel];
        }
    }
}
