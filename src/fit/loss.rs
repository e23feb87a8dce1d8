//! What a set of parameters could not express.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Names of the channels, in order.
const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// Something lost on the way to other parameters. Displays as one sentence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "code", rename_all = "kebab-case")]
#[expect(missing_docs, reason = "each variant is said in its sentence; channels count from 0")]
pub enum Loss {
    /// No n and k reflect this much facing the surface, or less than nothing; `used` stands in.
    RWithoutIndex { channel: usize, r: f64, used: f64 },
    /// A weighting with negative parts gave an index below zero, which stands for no material; zero is used.
    NegativeIndex { channel: usize, n: f64, k: f64 },
    /// n and k with |n + i k| < 1 have a g above 1, which Gulbrandsen's formulas do not take; 1 is used.
    GOutsideUnit { channel: usize, g: f64 },
    /// No g reaches the h of this channel; the nearest curve has g at an end of its range.
    HOutOfReach { channel: usize, h: f64, nearest_h: f64 },
    /// t is outside 0–1, which most fields that take a tint refuse.
    TintOutsideUnit { channel: usize, t: f64 },
    /// The angle-dependence of the original is replaced by the new model's, which agrees at 0°, 81.8° and 90°.
    ShapeReplaced { largest_difference: f64 },
    /// Only the reflectance facing the surface is kept.
    EdgeDropped { largest_difference: f64 },
    /// The original is not white at grazing; the new model is.
    GrazingColourDropped { largest_difference: f64 },
    /// The new parameters are the ones whose curve is nearest by least squares; none is the same curve.
    NearestCurve { largest_difference: f64 },
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |channel: usize| CHANNELS.get(channel).copied().unwrap_or("unknown");
        match *self {
            Self::RWithoutIndex { channel, r, used } => {
                write!(f, "{}: no n and k have r = {r:.4}; {used:.4} is used", name(channel))
            }
            Self::NegativeIndex { channel, n, k } => {
                write!(f, "{}: n = {n:.4}, k = {k:.4} is no material; zero is used for what is negative", name(channel))
            }
            Self::GOutsideUnit { channel, g } => {
                write!(f, "{}: n and k have g = {g:.4}, outside 0–1; the nearer end is used", name(channel))
            }
            Self::HOutOfReach { channel, h, nearest_h } => {
                write!(f, "{}: no n and k reach h = {h:.4} at this r; the nearest is {nearest_h:.4}", name(channel))
            }
            Self::TintOutsideUnit { channel, t } => {
                write!(f, "{}: the tint t = {t:.4} is outside 0–1, which many programs clamp", name(channel))
            }
            Self::ShapeReplaced { largest_difference: d } => {
                write!(f, "the curves agree at 0°, 81.8° and 90°, and differ by up to {d:.4} between")
            }
            Self::EdgeDropped { largest_difference: d } => {
                write!(f, "only the reflectance facing the surface is kept; at other angles it is up to {d:.4} off")
            }
            Self::GrazingColourDropped { largest_difference: d } => {
                write!(f, "the colour at grazing is replaced by white, up to {d:.4} off")
            }
            Self::NearestCurve { largest_difference: d } => {
                write!(f, "no parameters give the same curve; the nearest by least squares is up to {d:.4} off")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_the_channel_and_the_number() {
        let loss = Loss::RWithoutIndex { channel: 0, r: 1.03, used: 1.0 };
        assert_eq!(loss.to_string(), "red: no n and k have r = 1.0300; 1.0000 is used");
        assert!(serde_json::to_string(&loss).unwrap().contains("r-without-index"));
    }
}
