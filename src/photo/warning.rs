//! What a person must know about a photograph or a match, as sentences.

use serde::{Deserialize, Serialize};

/// A warning with a stable code and one sentence for people.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Warning {
    /// The stable word scripts can test.
    pub code: WarningCode,
    /// One sentence that names what was seen and what to do.
    pub message: String,
}

impl Warning {
    /// A warning of a code.
    pub fn new(code: WarningCode, message: impl Into<String>) -> Self {
        Self { code, message: message.into() }
    }
}

/// The kinds of warnings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WarningCode {
    /// A colour space or tone curve was assumed.
    Assumed,
    /// A colour profile is unusable.
    Profile,
    /// Pixels at the end of their range.
    Clipped,
    /// Pixels too dark to measure.
    Black,
    /// NaN or infinite pixels.
    #[serde(rename = "nonfinite")]
    NonFinite,
    /// Negative pixels.
    Negative,
    /// An animation or a multi-page file, of which one picture was read.
    Animated,
    /// An alpha channel was dropped.
    Alpha,
    /// The outline is no circle, or a mark leaves the picture.
    Geometry,
    /// The surroundings are uneven.
    Environment,
    /// The reflection is blurred: a rough metal shows means over many angles.
    Rough,
    /// The ball is too small for h.
    SmallBall,
    /// h is out of reach for any real material at this r, or F leaves `[0, 1]`.
    Infeasible,
    /// Two colours in one area.
    Multimodal,
    /// A colour outside the gamut of the space it is shown in.
    Gamut,
    /// The result is an estimate: the light or the tone curve is not known.
    Estimate,
}

impl WarningCode {
    /// The stable word.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Assumed => "assumed",
            Self::Profile => "profile",
            Self::Clipped => "clipped",
            Self::Black => "black",
            Self::NonFinite => "nonfinite",
            Self::Negative => "negative",
            Self::Animated => "animated",
            Self::Alpha => "alpha",
            Self::Geometry => "geometry",
            Self::Environment => "environment",
            Self::Rough => "rough",
            Self::SmallBall => "small_ball",
            Self::Infeasible => "infeasible",
            Self::Multimodal => "multimodal",
            Self::Gamut => "gamut",
            Self::Estimate => "estimate",
        }
    }
}
