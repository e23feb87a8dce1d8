//! What a person marks in a photograph, as arguments.

use clap::Args;

use super::{arguments, usage};
use crate::color::Rgb;
use crate::photo::{Area, Card, Circle, LightMode, MatchRequest, MirrorPair, ReferenceBall};

/// The marks of `edgewise match`. Pixel coordinates count from the top left corner; the centre of the
/// first pixel is 0.5,0.5.
#[derive(Debug, Default, Args)]
pub struct MarkArguments {
    /// Where the light comes from: flat-mirror, reference-ball, card, backdrop, solved-light, by-eye, or A–F;
    /// the best that is marked unless given
    #[arg(long)]
    mode: Option<LightMode>,
    /// The outline of the ball
    #[arg(long, value_name = "X,Y,RADIUS", allow_hyphen_values = true)]
    circle: Option<Circle>,
    /// Standard uncertainty of the outline's radius
    #[arg(long, value_name = "PIXELS", value_parser = arguments::number)]
    circle_uncertainty: Option<f64>,
    /// A card of known reflectance; may be given again for other positions
    #[arg(long = "card", value_name = "X,Y,WIDTH,HEIGHT@REFLECTANCE", allow_hyphen_values = true)]
    cards: Vec<Card>,
    /// Where to read r; the ball's middle unless given
    #[arg(long, value_name = "X,Y,WIDTH,HEIGHT", allow_hyphen_values = true)]
    facing: Option<Area>,
    /// Where to read h; the ball's rim unless given
    #[arg(long, value_name = "X,Y,WIDTH,HEIGHT", allow_hyphen_values = true)]
    edge: Option<Area>,
    /// A ball of a metal of the library in the same place
    #[arg(long, value_name = "X,Y,RADIUS@METAL", allow_hyphen_values = true)]
    reference_ball: Option<ReferenceBall>,
    /// A card seen directly, with --mirrored and --angle; may be given again
    #[arg(long, value_name = "X,Y,WIDTH,HEIGHT", allow_hyphen_values = true)]
    direct: Vec<Area>,
    /// The same card in the flat metal
    #[arg(long, value_name = "X,Y,WIDTH,HEIGHT", allow_hyphen_values = true)]
    mirrored: Vec<Area>,
    /// The angle of incidence on the flat metal, in degrees
    #[arg(long, value_name = "DEGREES", value_parser = arguments::number, allow_hyphen_values = true)]
    angle: Vec<f64>,
    /// An even bright area just outside the rim
    #[arg(long, value_name = "X,Y,WIDTH,HEIGHT", allow_hyphen_values = true)]
    backdrop: Option<Area>,
    /// The pixel of a perfect mirror, linear Rec.709
    #[arg(long, value_name = "R,G,B", value_parser = arguments::triple, allow_hyphen_values = true)]
    light: Option<Rgb>,
    /// A neutral patch of known reflectance that undoes the camera's tone curve; may be given again
    #[arg(long, value_name = "X,Y,WIDTH,HEIGHT@REFLECTANCE", allow_hyphen_values = true)]
    greys: Vec<Card>,
}

impl MarkArguments {
    /// True when nothing is marked.
    pub fn is_empty(&self) -> bool {
        self.request().is_ok_and(|request| request == MatchRequest::default())
    }

    /// What is to be solved.
    pub fn request(&self) -> anyhow::Result<MatchRequest> {
        if self.circle_uncertainty.is_some_and(|uncertainty| uncertainty <= 0.0) {
            return Err(usage("--circle-uncertainty must be above 0"));
        }
        let mut request = MatchRequest {
            mode: LightMode::default(),
            circle: self.circle,
            circle_uncertainty_px: self.circle_uncertainty,
            cards: self.cards.clone(),
            facing: self.facing,
            edge: self.edge,
            reference_ball: self.reference_ball.clone(),
            mirrors: self.mirrors()?,
            backdrop: self.backdrop,
            light: self.light,
            greys: self.greys.clone(),
            grey_corners: None,
        };
        request.mode = self.mode.or_else(|| request.suggested_mode()).unwrap_or_default();
        Ok(request)
    }

    fn mirrors(&self) -> anyhow::Result<Vec<MirrorPair>> {
        let (direct, mirrored, angles) = (&self.direct, &self.mirrored, &self.angle);
        if direct.len() != mirrored.len() || direct.len() != angles.len() {
            return Err(usage("--direct, --mirrored and --angle belong together: give each as often as the others"));
        }
        let pairs = direct.iter().zip(mirrored).zip(angles);
        pairs
            .map(|((direct, mirrored), angle)| {
                MirrorPair::new(*direct, *mirrored, *angle).map_err(|error| usage(&error.to_string()))
            })
            .collect()
    }
}
