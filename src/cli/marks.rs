//! What a person marks in a photograph, as arguments.

use clap::Args;
use serde::Serialize;

use super::{arguments, usage};
use crate::color::Rgb;
use crate::photo::{
    Area, Card, Circle, Cylinder, CylinderOutline, LightMode, MarkError, MatchRequest, MirrorPair, Outline, Photo,
    ReferenceBall, find_ball_beside, snap_circle, snap_cylinder,
};

/// The marks of `edgewise match`. Pixel coordinates count from the top left corner; the centre of the
/// first pixel is 0.5,0.5.
#[derive(Debug, Default, Args)]
pub struct MarkArguments {
    /// Where the light comes from: flat-mirror, reference-ball, card, backdrop, solved-light, by-eye, or A–F;
    /// the best that is marked unless given
    #[arg(long)]
    mode: Option<LightMode>,
    /// The outline of the ball, or auto to find it
    #[arg(long, value_name = "X,Y,RADIUS|auto", value_parser = circle, allow_hyphen_values = true)]
    circle: Option<CircleMark>,
    /// Instead of a ball: the ends of a cylinder's axis and its radius
    #[arg(long, value_name = "X0,Y0,X1,Y1,RADIUS", allow_hyphen_values = true, conflicts_with = "circle")]
    cylinder: Option<Cylinder>,
    /// Take circles and cylinder as hints: fit each to the edges nearest to it
    #[arg(long)]
    snap: bool,
    /// Standard uncertainty of the outline's radius; what the fit says of an outline that is found or snapped
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

/// What `--circle` says.
#[derive(Clone, Copy, Debug, PartialEq)]
enum CircleMark {
    /// The ball is there.
    At(Circle),
    /// The ball is to be found.
    Auto,
}

fn circle(text: &str) -> Result<CircleMark, MarkError> {
    if text == "auto" { Ok(CircleMark::Auto) } else { text.parse().map(CircleMark::At) }
}

/// Everything that is marked, before there is a photograph to find outlines in.
#[derive(Clone, Debug, PartialEq)]
pub struct Marks {
    /// As typed; without the circle where that is to be found.
    pub request: MatchRequest,
    /// Where outlines come from.
    pub outlines: Outlines,
}

/// Where outlines come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outlines {
    /// As typed.
    Given,
    /// Fitted to the edges nearest to what was typed.
    Snap,
    /// The ball is found, its reference fitted.
    Auto,
}

/// The outlines that were fitted in a photograph.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fitted {
    /// That of the ball.
    pub ball: Option<Outline>,
    /// That of the cylinder.
    pub cylinder: Option<CylinderOutline>,
    /// That of the reference ball.
    pub reference: Option<Outline>,
}

impl Marks {
    /// The request with the outlines fitted in a photograph, where they are to be.
    pub fn in_photo(&self, photo: &Photo) -> anyhow::Result<(MatchRequest, Fitted)> {
        let (mut request, mut fitted) = (self.request.clone(), Fitted::default());
        if self.outlines == Outlines::Given {
            return Ok((request, fitted));
        }
        if let Some(reference) = &mut request.reference_ball {
            let outline = snap_circle(photo, reference.circle)?;
            reference.circle = outline.circle;
            fitted.reference = Some(outline);
        }
        fitted.ball = match request.circle {
            Some(circle) => Some(snap_circle(photo, circle)?),
            None if self.outlines == Outlines::Auto => {
                let others: Vec<Circle> = request.reference_ball.iter().map(|ball| ball.circle).collect();
                Some(find_ball_beside(photo, &others)?)
            }
            None => None,
        };
        if let Some(outline) = &fitted.ball {
            request = request.with_outline(outline);
        }
        if let Some(cylinder) = request.cylinder {
            let outline = snap_cylinder(photo, cylinder)?;
            request = request.with_cylinder(&outline);
            fitted.cylinder = Some(outline);
        }
        Ok((request, fitted))
    }
}

impl MarkArguments {
    /// True when nothing is marked.
    pub fn is_empty(&self) -> bool {
        self.circle.is_none() && self.marks().is_ok_and(|marks| marks.request == MatchRequest::default())
    }

    /// What is to be solved.
    pub fn marks(&self) -> anyhow::Result<Marks> {
        let outlines = self.outlines()?;
        let circle = self.circle.and_then(|mark| if let CircleMark::At(circle) = mark { Some(circle) } else { None });
        let mut request = MatchRequest {
            mode: LightMode::default(),
            circle,
            cylinder: self.cylinder,
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
        let ball = self.circle.map(|_| circle.unwrap_or(Circle::new(0.0, 0.0, 1.0)));
        let with_ball = MatchRequest { circle: ball, ..request.clone() };
        request.mode = self.mode.or_else(|| with_ball.suggested_mode()).unwrap_or_default();
        Ok(Marks { request, outlines })
    }

    fn outlines(&self) -> anyhow::Result<Outlines> {
        let outlines = match self.circle {
            Some(CircleMark::Auto) => Outlines::Auto,
            _ if self.snap => Outlines::Snap,
            _ => Outlines::Given,
        };
        match (outlines, self.circle_uncertainty) {
            (_, Some(uncertainty)) if uncertainty <= 0.0 => Err(usage("--circle-uncertainty must be above 0")),
            (Outlines::Snap | Outlines::Auto, Some(_)) => {
                Err(usage("--circle-uncertainty is for a circle that is given: an outline that is fitted has its own"))
            }
            (Outlines::Snap, None) if !self.has_hint() => {
                Err(usage("--snap needs an outline to start from: give --circle, --cylinder or --reference-ball"))
            }
            _ => Ok(outlines),
        }
    }

    fn has_hint(&self) -> bool {
        self.circle.is_some() || self.cylinder.is_some() || self.reference_ball.is_some()
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
