//! What a person marked in a photograph and what is to be solved.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::mark::MarkError;
use super::{Area, Body, Card, Circle, Cylinder, CylinderOutline, LightMode, Outline};
use crate::color::Rgb;
use crate::metal::metal_by_name;

/// Everything a match is computed from, besides the photograph. A preset keeps it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct MatchRequest {
    /// Where the light comes from.
    pub mode: LightMode,
    /// The outline of the ball.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub circle: Option<Circle>,
    /// Instead of a ball: the outline of a cylinder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cylinder: Option<Cylinder>,
    /// Standard uncertainty of the outline's radius in pixels; what a steady hand reaches if `None`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub circle_uncertainty_px: Option<f64>,
    /// Cards of known reflectance, one for each position (mode C).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub cards: Vec<Card>,
    /// Where a person picked r; the ball's middle if `None`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub facing: Option<Area>,
    /// Where a person picked h; the ball's rim if `None`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edge: Option<Area>,
    /// A ball of a known metal (mode B).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference_ball: Option<ReferenceBall>,
    /// Cards seen in a flat mirror, and directly (mode A).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub mirrors: Vec<MirrorPair>,
    /// The even bright area beside the rim (mode D).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub backdrop: Option<Area>,
    /// The light a person set, linear Rec.709: the pixel of a perfect mirror (mode F).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub light: Option<Rgb>,
    /// Neutral patches that undo the camera's tone curve.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub greys: Vec<Card>,
    /// The corners of the row that the grey patches were laid out in, so that it can be moved again; patches
    /// alone are read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grey_corners: Option<[[f64; 2]; 4]>,
}

impl MatchRequest {
    /// The radius uncertainty of a circle placed by hand under a loupe, in pixels.
    pub const HAND_PLACED_UNCERTAINTY_PX: f64 = 0.5;

    /// The best mode for which everything it needs is marked; `None` when nothing says what the light is.
    pub fn suggested_mode(&self) -> Option<LightMode> {
        LightMode::ALL.into_iter().find(|mode| match mode {
            LightMode::FlatMirror => !self.mirrors.is_empty(),
            LightMode::ReferenceBall => self.reference_ball.is_some() && self.body().is_some(),
            LightMode::Card => !self.cards.is_empty() || !self.greys.is_empty(),
            LightMode::Backdrop => self.backdrop.is_some() && self.body().is_some(),
            LightMode::SolvedLight => self.body().is_some(),
            LightMode::ByEye => self.light.is_some(),
        })
    }

    /// The ball or the cylinder that is marked; the ball where both are, which no match accepts.
    pub fn body(&self) -> Option<Body> {
        self.circle.map(Body::Ball).or(self.cylinder.map(Body::Cylinder))
    }

    /// The same request with the fitted outline of a cylinder and what the fit says of its radius.
    pub fn with_cylinder(self, outline: &CylinderOutline) -> Self {
        Self { cylinder: Some(outline.cylinder), circle_uncertainty_px: Some(outline.uncertainty_px), ..self }
    }

    /// The same request with a fitted outline and what the fit says of its radius.
    pub fn with_outline(self, outline: &Outline) -> Self {
        Self { circle: Some(outline.circle), circle_uncertainty_px: Some(outline.uncertainty_px), ..self }
    }

    /// Standard uncertainty of the outline's radius in pixels.
    pub fn radius_uncertainty_px(&self) -> f64 {
        self.circle_uncertainty_px.unwrap_or(Self::HAND_PLACED_UNCERTAINTY_PX)
    }
}

/// A ball of a metal of the library.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReferenceBall {
    /// Its outline.
    pub circle: Circle,
    /// Identifier of its metal in the library.
    pub metal: String,
}

impl fmt::Display for ReferenceBall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}@{}", self.circle, self.metal)
    }
}

impl FromStr for ReferenceBall {
    type Err = MarkError;

    /// Reads `x,y,radius@metal`; a name or symbol becomes the identifier of its preferred data set.
    fn from_str(text: &str) -> Result<Self, MarkError> {
        let form = || MarkError::form(text, "reference ball", "x,y,radius@metal, for example 300,200,90@chromium");
        let (circle, metal) = text.split_once('@').ok_or_else(form)?;
        Ok(Self { circle: circle.parse()?, metal: metal_by_name(metal)?.id.clone() })
    }
}

/// One card twice: seen directly, and in a flat piece of the metal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MirrorPair {
    /// The card itself.
    pub direct: Area,
    /// The card in the mirror.
    pub mirrored: Area,
    /// Angle of incidence on the metal, in degrees.
    pub angle_deg: f64,
}

impl MirrorPair {
    /// Checks the angle: at least 0 and below 90.
    pub fn new(direct: Area, mirrored: Area, angle_deg: f64) -> Result<Self, MarkError> {
        if !(0.0..90.0).contains(&angle_deg) {
            return Err(MarkError::Angle { angle_deg });
        }
        Ok(Self { direct, mirrored, angle_deg })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn survives_a_file() {
        let request = MatchRequest {
            circle: Some(Circle::new(1.0, 2.0, 3.0)),
            cards: vec!["1,2,3,4@0.9".parse().unwrap()],
            reference_ball: Some("1,2,3@chromium".parse().unwrap()),
            ..MatchRequest::default()
        };
        let json = serde_json::to_string(&request).unwrap();
        assert_eq!(serde_json::from_str::<MatchRequest>(&json).unwrap(), request);
        assert!(!json.contains("facing"), "what is not marked is not written: {json}");
    }

    #[test]
    fn a_reference_ball_names_its_data_set() {
        let ball: ReferenceBall = "1,2,3@Cr".parse().unwrap();
        assert!(ball.metal.starts_with("Cr_"), "{}", ball.metal);
        assert!("1,2,3@cheese".parse::<ReferenceBall>().unwrap_err().to_string().contains("cheese"));
        assert!("1,2,3".parse::<ReferenceBall>().unwrap_err().to_string().contains("@metal"));
    }

    #[test]
    fn suggests_the_best_mode_that_is_marked() {
        let mut request = MatchRequest::default();
        assert_eq!(request.suggested_mode(), None);
        request.circle = Some(Circle::new(1.0, 2.0, 3.0));
        assert_eq!(request.suggested_mode(), Some(LightMode::SolvedLight));
        request.cards = vec!["1,2,3,4@0.9".parse().unwrap()];
        assert_eq!(request.suggested_mode(), Some(LightMode::Card));
        request.reference_ball = Some("1,2,3@chromium".parse().unwrap());
        assert_eq!(request.suggested_mode(), Some(LightMode::ReferenceBall));
    }
}
