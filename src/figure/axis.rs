//! Axes: where values lie, and which of them are written down.

use std::ops::RangeInclusive;

/// A map from values to places in points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis {
    is_log: bool,
    /// Values at the two ends.
    pub(super) values: (f64, f64),
    /// Places of the two ends.
    pub(super) places: (f64, f64),
}

impl Axis {
    /// From the value at one place to the value at another.
    pub(super) const fn new(values: (f64, f64), places: (f64, f64)) -> Self {
        Self { is_log: false, values, places }
    }

    /// The same between positive values, equal factors being equally far apart.
    pub(super) const fn log(values: (f64, f64), places: (f64, f64)) -> Self {
        Self { is_log: true, values, places }
    }

    /// The place of a value.
    pub(super) fn at(self, value: f64) -> f64 {
        let scale = |v: f64| if self.is_log { v.log10() } else { v };
        let (first, last) = (scale(self.values.0), scale(self.values.1));
        let share = (scale(value) - first) / (last - first);
        self.places.0 + share * (self.places.1 - self.places.0)
    }

    /// Round values from end to end.
    pub(super) fn ticks(self, about: usize) -> Vec<f64> {
        let (first, last) = self.values;
        if self.is_log { log_ticks(first..=last) } else { ticks(first..=last, about) }
    }
}

/// The step of 1, 2 or 5 times a power of ten that cuts a span into about `count` parts.
pub(super) fn round_step(span: f64, count: usize) -> f64 {
    let raw = span / count.max(1) as f64;
    let power = 10.0_f64.powf(raw.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|factor| factor * power >= raw * (1.0 - 1e-9));
    factor.unwrap_or(10.0) * power
}

/// Multiples of a round step within a range.
pub(super) fn ticks(range: RangeInclusive<f64>, about: usize) -> Vec<f64> {
    let step = round_step(range.end() - range.start(), about);
    let first = (range.start() / step - 1e-9).ceil() as i64;
    let last = (range.end() / step + 1e-9).floor() as i64;
    (first..=last).map(|i| i as f64 * step).collect()
}

/// 1, 2 and 5 times powers of ten within a range of positive values; powers alone where it is wide.
fn log_ticks(range: RangeInclusive<f64>) -> Vec<f64> {
    let (first, last) = (range.start().log10().floor() as i32, range.end().log10().ceil() as i32);
    let factors: &[f64] = if last - first > 4 { &[1.0] } else { &[1.0, 2.0, 5.0] };
    let all = (first..=last).flat_map(|power| factors.iter().map(move |factor| factor * 10.0_f64.powi(power)));
    all.filter(|v| (range.start() * (1.0 - 1e-9)..=range.end() * (1.0 + 1e-9)).contains(v)).collect()
}

/// The range widened to multiples of a round step.
pub(super) fn rounded_out(range: RangeInclusive<f64>, about: usize) -> RangeInclusive<f64> {
    let step = round_step((range.end() - range.start()).max(1e-9), about);
    (range.start() / step + 1e-9).floor() * step..=(range.end() / step - 1e-9).ceil() * step
}

/// A tick's value without needless zeros: `0`, `0.25`, `−1.5`.
pub(super) fn tick_text(value: f64) -> String {
    let rounded = format!("{:.6}", value + 0.0);
    let text = rounded.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.replace('-', "−") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks(0.0..=1.0, 5).len(), 6);
        assert_eq!(ticks(0.31..=0.99, 4), [0.4, 0.6000000000000001, 0.8]);
        assert_eq!(rounded_out(0.31..=0.99, 4), 0.2..=1.0);
        assert_eq!(ticks(0.0..=13.7, 4), [0.0, 5.0, 10.0]);
    }

    #[test]
    fn log_axes_have_equal_factors_equally_far_apart() {
        let axis = Axis::log((1.0, 100.0), (0.0, 200.0));
        assert!((axis.at(10.0) - 100.0).abs() < 1e-9);
        assert_eq!(axis.ticks(5), [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0]);
    }

    #[test]
    fn tick_texts_are_short() {
        assert_eq!([0.0, 0.6000000000000001, -1.5, 20.0, -1e-12].map(tick_text), ["0", "0.6", "−1.5", "20", "0"]);
    }

    #[test]
    fn ends_are_at_their_places() {
        let axis = Axis::new((0.0, 90.0), (100.0, 700.0));
        assert_eq!([axis.at(0.0), axis.at(45.0), axis.at(90.0)], [100.0, 400.0, 700.0]);
    }
}
