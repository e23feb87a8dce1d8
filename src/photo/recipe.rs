//! How r and h were taken from a photograph, so that it can be done again.

use serde::{Deserialize, Serialize};

use super::{MatchRequest, Warning};

/// The record a preset keeps of a match: with the same photograph it gives the same numbers again.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Recipe {
    /// File name of the photograph.
    pub photo: String,
    /// SHA-256 of the file, hexadecimal.
    pub photo_sha256: String,
    /// How its pixels became linear, as a sentence.
    pub colour_rule: String,
    /// What was marked and how it was solved.
    pub request: MatchRequest,
    /// The ± of r (coverage factor 2) in the preset's space; `None` where r was not measured.
    pub r_uncertainty: [Option<f64>; 3],
    /// The ± of h (coverage factor 2) in the preset's space; `None` where h was not measured.
    pub h_uncertainty: [Option<f64>; 3],
    /// What the match warned of.
    pub warnings: Vec<Warning>,
    /// True when the light or the tone curve is not known: an estimate, never a measurement.
    pub is_estimate: bool,
}
