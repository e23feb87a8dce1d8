//! What a reader will show instead of the preset, and by how much.

use std::fmt;

use serde::Serialize;

use super::number::number;
use crate::color::{Rgb, RgbSpace, delta_e_rgb};
use crate::fresnel::{CosTheta, FresnelModel, whole_degrees};
use crate::number::larger;

/// Rounding of a 3×3 conversion is no loss worth a word.
const CLIP_TOLERANCE: f64 = 1e-9;

/// A parameter that a file states, by the paper's symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "the paper's symbols")]
pub enum Parameter {
    R,
    H,
    T,
    R90,
    G,
}

/// One channel of a parameter that was brought into the range its reader takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Clip {
    /// Which parameter.
    pub parameter: Parameter,
    /// Which channel: 0 red, 1 green, 2 blue.
    pub channel: usize,
    /// What the preset asks for.
    pub before: f64,
    /// What the file says.
    pub after: f64,
}

/// Why a reader shows another curve.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", content = "detail", rename_all = "kebab-case")]
pub enum Cause {
    /// Values outside the reader's range.
    Clipped(Vec<Clip>),
    /// The reader's parameters were fitted to the curve: which ones.
    Fitted(&'static str),
    /// Colours were rounded to this many bits.
    Rounded(u32),
    /// The file has no place for this part of the preset.
    Dropped(Part),
}

/// A part of a preset that a file may have no place for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Part {
    /// The perceptual roughness; 0 is what a file without one says.
    Roughness(f64),
    /// What lies between and beyond r and h.
    Curve,
}

/// The distance of two curves over 0–90°.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Difference {
    /// Largest |ΔF| of each channel at a whole degree.
    pub delta_f: Rgb,
    /// The largest of these.
    pub max_delta_f: f64,
    /// Largest CIEDE2000 at a whole degree.
    pub max_delta_e: f64,
}

impl Difference {
    /// How far `shown` is from `wanted`, both in `space`.
    pub fn between(wanted: &FresnelModel, shown: &FresnelModel, space: RgbSpace) -> Self {
        Self::of_curves(|c| wanted.reflectance(c), |c| shown.reflectance(c), space)
    }

    /// How far a curve is from the one that is wanted, both in `space`.
    pub(super) fn of_curves(
        wanted: impl Fn(CosTheta) -> Rgb,
        shown: impl Fn(CosTheta) -> Rgb,
        space: RgbSpace,
    ) -> Self {
        whole_degrees().fold(Self::default(), |worst, cos_theta| {
            let (wanted, shown) = (wanted(cos_theta), shown(cos_theta));
            Self {
                delta_f: worst.delta_f.zip(wanted.zip(shown, |wanted, shown| (wanted - shown).abs()), larger),
                max_delta_f: larger(worst.max_delta_f, wanted.max_abs_difference(shown)),
                max_delta_e: larger(worst.max_delta_e, delta_e_rgb(wanted, shown, space)),
            }
        })
    }
}

/// What one preset loses in one target; its text is one sentence.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Loss {
    /// Name of the preset.
    pub preset: String,
    /// The space of the numbers it is about.
    pub space: RgbSpace,
    /// Why.
    pub cause: Cause,
    /// How far all that this target does to the preset takes its curve.
    pub difference: Difference,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Difference { max_delta_f, max_delta_e, .. } = self.difference;
        write!(f, "{}: {}", self.preset, self.cause)?;
        match self.cause {
            Cause::Dropped(_) => return Ok(()),
            Cause::Clipped(_) => write!(f, " in {}", self.space)?,
            Cause::Fitted(_) | Cause::Rounded(_) => {}
        }
        write!(
            f,
            "; the curve shown is off by at most {max_delta_f:.2} in F and {max_delta_e:.2} in ΔE2000",
            max_delta_f = Short(max_delta_f),
            max_delta_e = Short(max_delta_e),
        )
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Clipped(clips) => {
                let clips: Vec<String> = clips.iter().map(Clip::to_string).collect();
                write!(f, "its reader would clip {}", clips.join(", "))
            }
            Self::Fitted(what) => write!(f, "{what} can only be fitted to the curve"),
            Self::Rounded(bits) => write!(f, "colours have {bits} bits"),
            Self::Dropped(Part::Roughness(roughness)) => write!(f, "the file cannot say its roughness {roughness}"),
            Self::Dropped(Part::Curve) => f.write_str("the file says two colours and not the curve between them"),
        }
    }
}

impl fmt::Display for Clip {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parameter = match self.parameter {
            Parameter::R => "r",
            Parameter::H => "h",
            Parameter::T => "t",
            Parameter::R90 => "r90",
            Parameter::G => "g",
        };
        let channel = ["red", "green", "blue"][self.channel];
        write!(f, "{parameter} {channel} {:.4} → {}", self.before, number(self.after))
    }
}

/// A number to the given count of significant digits, without an exponent.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = f.precision().unwrap_or(2).saturating_sub(1);
        let rounded: f64 = format!("{:.digits$e}", self.0).parse().unwrap_or(self.0);
        write!(f, "{rounded}")
    }
}

/// Limits a parameter to `[0, max]` and remembers every channel that this changed.
pub(super) fn clip(parameter: Parameter, before: Rgb, max: f64, clips: &mut Vec<Clip>) -> Rgb {
    let after = before.map(|v| v.clamp(0.0, max));
    for channel in 0..3 {
        if (before[channel] - after[channel]).abs() > CLIP_TOLERANCE {
            clips.push(Clip { parameter, channel, before: before[channel], after: after[channel] });
        }
    }
    after
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_was_clipped_is_told() {
        let mut clips = Vec::new();
        let after = clip(Parameter::R, Rgb([1.02, 0.5, 1.0 + 1e-12]), 1.0, &mut clips);
        assert_eq!(after, Rgb([1.0, 0.5, 1.0]));
        assert_eq!(clips, [Clip { parameter: Parameter::R, channel: 0, before: 1.02, after: 1.0 }]);
    }

    #[test]
    fn a_loss_is_one_sentence() {
        let clips = vec![Clip { parameter: Parameter::T, channel: 1, before: 1.0123, after: 1.0 }];
        let difference = Difference { max_delta_f: 0.012345, max_delta_e: 0.5, ..Difference::default() };
        let loss =
            Loss { preset: "Gold".to_owned(), space: RgbSpace::AcesCg, cause: Cause::Clipped(clips), difference };
        assert_eq!(
            loss.to_string(),
            "Gold: its reader would clip t green 1.0123 → 1.0 in acescg; \
             the curve shown is off by at most 0.012 in F and 0.5 in ΔE2000"
        );
    }

    #[test]
    fn equal_curves_do_not_differ() {
        let model = FresnelModel::Schlick { r: Rgb([0.9, 0.5, 0.2]) };
        assert_eq!(Difference::between(&model, &model, RgbSpace::AcesCg), Difference::default());
    }
}
