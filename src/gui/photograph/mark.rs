//! Marks in the photograph: which there are, and how they are made and taken away.

use super::grey_scale::{corners_of, patches};
use super::shape::MarkShape;
use crate::metal::metal_by_name;
use crate::photo::{Area, Card, Circle, Cylinder, MatchRequest, MirrorPair, ReferenceBall};

/// A mark of a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Mark {
    /// The outline of the ball.
    Ball,
    /// Instead of a ball: the outline of a cylinder.
    Cylinder,
    /// The outline of a ball of a known metal.
    Reference,
    /// A card of known reflectance.
    Card(usize),
    /// A card beside a flat mirror, seen directly.
    Direct(usize),
    /// The same card in the mirror.
    Mirrored(usize),
    /// The row of neutral patches.
    GreyScale,
    /// Where r is picked.
    Facing,
    /// Where h is picked.
    Edge,
    /// The bright area beside the rim.
    Backdrop,
}

/// The metal of a new reference ball, until a person says which it is: bearing balls look like it.
const FIRST_METAL: &str = "chromium";
/// The angles of the first two mirror pairs: one for h, one for r.
const FIRST_ANGLES_DEG: [f64; 2] = [82.0, 10.0];

impl Mark {
    /// The marks that a request has, those that are drawn last at the end.
    pub(crate) fn all_of(request: &MatchRequest) -> Vec<Self> {
        let mut marks: Vec<Self> = request.circle.iter().map(|_| Self::Ball).collect();
        marks.extend(request.cylinder.iter().map(|_| Self::Cylinder));
        marks.extend(request.reference_ball.iter().map(|_| Self::Reference));
        marks.extend((0..request.cards.len()).map(Self::Card));
        marks.extend((0..request.mirrors.len()).flat_map(|index| [Self::Direct(index), Self::Mirrored(index)]));
        marks.extend(request.greys.first().map(|_| Self::GreyScale));
        marks.extend(request.backdrop.iter().map(|_| Self::Backdrop));
        marks.extend(request.facing.iter().map(|_| Self::Facing));
        marks.extend(request.edge.iter().map(|_| Self::Edge));
        marks
    }

    /// What people call it.
    pub(crate) fn name(self, request: &MatchRequest) -> String {
        let numbered = |name: &str, index: usize, count: usize| {
            if count < 2 { name.to_owned() } else { format!("{name} {}", index + 1) }
        };
        match self {
            Self::Card(index) => numbered("Card", index, request.cards.len()),
            Self::Direct(index) => numbered("Direct card", index, request.mirrors.len()),
            Self::Mirrored(index) => numbered("In the mirror", index, request.mirrors.len()),
            _ => self.kind().to_owned(),
        }
    }

    /// What people call its kind.
    pub(crate) const fn kind(self) -> &'static str {
        match self {
            Self::Ball => "Ball",
            Self::Cylinder => "Cylinder",
            Self::Reference => "Reference ball",
            Self::Card(_) => "Card",
            Self::Direct(_) | Self::Mirrored(_) => "Mirror pair",
            Self::GreyScale => "Grey scale",
            Self::Facing => "Facing pick",
            Self::Edge => "Edge pick",
            Self::Backdrop => "Backdrop",
        }
    }

    /// What it is for.
    pub(crate) const fn purpose(self) -> &'static str {
        match self {
            Self::Ball => "The outline of the ball",
            Self::Cylinder => "The outline of a cylinder, instead of a ball",
            Self::Reference => "The outline of a ball of a known metal in the same surroundings",
            Self::Card(_) => "A card of known reflectance; several show how even the light is",
            Self::Direct(_) | Self::Mirrored(_) => "A card seen directly, and the same card in the flat metal",
            Self::GreyScale => "Six neutral patches that undo the camera's tone curve",
            Self::Facing => "Where r is read, instead of the middle of the ball",
            Self::Edge => "Where h is read, instead of the rim of the ball",
            Self::Backdrop => "An even bright area just outside the rim",
        }
    }

    /// How to draw it.
    pub(crate) const fn how_to_draw(self) -> &'static str {
        match self {
            Self::Ball | Self::Reference => "Drag across the ball, from edge to edge. It snaps to the edge.",
            Self::Cylinder => {
                "Drag over the cylinder, from corner to corner. It snaps to its edges; turn it by its ends."
            }
            Self::GreyScale => "Drag along the row from the brightest patch to the darkest, then drag its corners.",
            Self::Facing | Self::Edge => "Drag across the spot to read.",
            _ => "Drag from corner to corner, well inside the edges.",
        }
    }

    /// True for an outline, which can snap to its edge.
    pub(crate) const fn is_outline(self) -> bool {
        matches!(self, Self::Ball | Self::Cylinder | Self::Reference)
    }

    /// True for the outline of what is measured.
    pub(crate) const fn is_body(self) -> bool {
        matches!(self, Self::Ball | Self::Cylinder)
    }

    /// Its shape; `None` when the request has no such mark.
    pub(crate) fn shape(self, request: &MatchRequest) -> Option<MarkShape> {
        let pair = |index: usize| request.mirrors.get(index);
        match self {
            Self::Ball => request.circle.map(MarkShape::Round),
            Self::Cylinder => request.cylinder.map(MarkShape::Rod),
            Self::Reference => request.reference_ball.as_ref().map(|ball| MarkShape::Round(ball.circle)),
            Self::Card(index) => request.cards.get(index).map(|card| MarkShape::of_area(card.area)),
            Self::Direct(index) => pair(index).map(|pair| MarkShape::of_area(pair.direct)),
            Self::Mirrored(index) => pair(index).map(|pair| MarkShape::of_area(pair.mirrored)),
            Self::GreyScale => request.grey_corners.or_else(|| corners_of(&request.greys)).map(MarkShape::Quad),
            Self::Facing => request.facing.map(MarkShape::of_area),
            Self::Edge => request.edge.map(MarkShape::of_area),
            Self::Backdrop => request.backdrop.map(MarkShape::of_area),
        }
    }

    /// Gives it another shape, or makes it. Of a ball and a cylinder the one set last is measured.
    pub(crate) fn set(self, request: &mut MatchRequest, shape: MarkShape) {
        match (self, shape) {
            (Self::Ball, MarkShape::Round(circle)) => {
                if request.circle != Some(circle) {
                    // What a fit said of another circle says nothing about this one.
                    request.circle_uncertainty_px = None;
                }
                (request.circle, request.cylinder) = (Some(circle), None);
            }
            (Self::Cylinder, MarkShape::Rod(cylinder)) => {
                if request.cylinder != Some(cylinder) {
                    request.circle_uncertainty_px = None;
                }
                (request.circle, request.cylinder) = (None, Some(cylinder));
            }
            (Self::Reference, MarkShape::Round(circle)) => match &mut request.reference_ball {
                Some(ball) => ball.circle = circle,
                None => request.reference_ball = new_reference(circle),
            },
            (Self::GreyScale, MarkShape::Quad(corners)) => {
                let reflectances: Vec<f64> = request.greys.iter().map(|grey| grey.reflectance).collect();
                let known = if reflectances.is_empty() { &Card::COLOR_CHECKER_NEUTRALS[..] } else { &reflectances };
                request.greys = patches(corners, known);
                request.grey_corners = Some(corners);
            }
            (Self::Ball | Self::Cylinder | Self::Reference | Self::GreyScale, _) => {}
            (mark, shape) => mark.set_area(request, shape.area()),
        }
    }

    fn set_area(self, request: &mut MatchRequest, area: Area) {
        match self {
            Self::Card(index) => match request.cards.get_mut(index) {
                Some(card) => card.area = area,
                None => request.cards.push(Card::neutral(area, Card::COMMON[0].1)),
            },
            Self::Direct(index) => match request.mirrors.get_mut(index) {
                Some(pair) => pair.direct = area,
                None => request.mirrors.push(new_pair(area, request.mirrors.len())),
            },
            Self::Mirrored(index) => {
                if let Some(pair) = request.mirrors.get_mut(index) {
                    pair.mirrored = area;
                }
            }
            Self::Facing => request.facing = Some(area),
            Self::Edge => request.edge = Some(area),
            Self::Backdrop => request.backdrop = Some(area),
            Self::Ball | Self::Cylinder | Self::Reference | Self::GreyScale => {}
        }
    }

    /// Takes it away; a card in a mirror goes with the card itself.
    pub(crate) fn remove(self, request: &mut MatchRequest) {
        match self {
            Self::Ball => (request.circle, request.circle_uncertainty_px) = (None, None),
            Self::Cylinder => (request.cylinder, request.circle_uncertainty_px) = (None, None),
            Self::Reference => request.reference_ball = None,
            Self::Card(index) => {
                if index < request.cards.len() {
                    request.cards.remove(index);
                }
            }
            Self::Direct(index) | Self::Mirrored(index) => {
                if index < request.mirrors.len() {
                    request.mirrors.remove(index);
                }
            }
            Self::GreyScale => (request.greys, request.grey_corners) = (Vec::new(), None),
            Self::Facing => request.facing = None,
            Self::Edge => request.edge = None,
            Self::Backdrop => request.backdrop = None,
        }
    }

    /// Where it starts in a picture of this size: the ball in the middle, the rest where they can be seen.
    pub(crate) fn first_shape(self, width: u32, height: u32) -> MarkShape {
        let (w, h) = (f64::from(width), f64::from(height));
        let unit = w.min(h);
        let beside = |index: usize| {
            let step = unit * 0.15 * index as f64;
            MarkShape::Square([w * 0.05 + step, h * 0.05, unit * 0.12, unit * 0.12])
        };
        match self {
            Self::Ball => MarkShape::Round(Circle::new(w / 2.0, h / 2.0, unit * 0.35)),
            Self::Cylinder => MarkShape::Rod(Cylinder::new([w * 0.2, h / 2.0], [w * 0.8, h / 2.0], unit * 0.2)),
            Self::Reference => MarkShape::Round(Circle::new(w * 0.78, h / 2.0, unit * 0.2)),
            Self::Facing => MarkShape::Round(Circle::new(w / 2.0, h / 2.0, unit * 0.05)),
            Self::Edge => MarkShape::Round(Circle::new(w / 2.0 + unit * 0.33, h / 2.0, unit * 0.02)),
            Self::GreyScale => {
                let (left, right, top, bottom) = (w * 0.1, w * 0.9, h * 0.8, h * 0.92);
                MarkShape::Quad([[left, top], [right, top], [right, bottom], [left, bottom]])
            }
            Self::Backdrop => MarkShape::Square([w * 0.83, h * 0.05, unit * 0.12, unit * 0.12]),
            Self::Card(index) => beside(index),
            Self::Direct(index) => beside(2 * index),
            Self::Mirrored(index) => beside(2 * index + 1),
        }
    }
}

fn new_reference(circle: Circle) -> Option<ReferenceBall> {
    metal_by_name(FIRST_METAL).ok().map(|metal| ReferenceBall { circle, metal: metal.id.clone() })
}

/// A pair whose mirrored card stands beside the card.
fn new_pair(direct: Area, index: usize) -> MirrorPair {
    let [_, _, width, _] = direct.bounds();
    let angle_deg = FIRST_ANGLES_DEG[index.min(FIRST_ANGLES_DEG.len() - 1)];
    MirrorPair { direct, mirrored: direct.moved_by(1.25 * width, 0.0), angle_deg }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MARKS: [Mark; 10] = [
        Mark::Ball,
        Mark::Reference,
        Mark::Card(0),
        Mark::Card(1),
        Mark::Direct(0),
        Mark::Mirrored(0),
        Mark::GreyScale,
        Mark::Backdrop,
        Mark::Facing,
        Mark::Edge,
    ];

    #[test]
    fn marks_are_set_found_and_removed() {
        let mut request = MatchRequest::default();
        for mark in MARKS {
            assert_eq!(mark.shape(&request).is_some(), mark == Mark::Mirrored(0), "a pair is made at once");
            let shape = mark.first_shape(400, 300);
            mark.set(&mut request, shape);
            assert_eq!(mark.shape(&request), Some(shape));
        }
        assert_eq!(Mark::all_of(&request), MARKS);
        for mark in MARKS.into_iter().rev() {
            mark.remove(&mut request);
        }
        assert_eq!(request, MatchRequest::default());
    }

    #[test]
    fn a_cylinder_takes_the_place_of_a_ball() {
        let mut request = MatchRequest::default();
        for (mark, other) in [(Mark::Ball, Mark::Cylinder), (Mark::Cylinder, Mark::Ball), (Mark::Ball, Mark::Cylinder)]
        {
            let shape = mark.first_shape(400, 300);
            request.circle_uncertainty_px = Some(0.1);
            mark.set(&mut request, shape);
            assert_eq!((mark.shape(&request), other.shape(&request)), (Some(shape), None));
            assert_eq!(request.circle_uncertainty_px, None, "what a fit said of the other says nothing of this one");
        }
        Mark::Ball.remove(&mut request);
        assert_eq!(request, MatchRequest::default());
    }

    #[test]
    fn another_circle_is_placed_by_hand() {
        let mut request = MatchRequest { circle_uncertainty_px: Some(0.1), ..MatchRequest::default() };
        Mark::Ball.set(&mut request, MarkShape::Round(Circle::new(1.0, 2.0, 3.0)));
        assert_eq!(request.circle_uncertainty_px, None);
    }

    #[test]
    fn a_grey_scale_starts_as_a_color_checker_and_keeps_what_is_typed() {
        let mut request = MatchRequest::default();
        Mark::GreyScale.set(&mut request, Mark::GreyScale.first_shape(400, 300));
        assert_eq!(request.greys.iter().map(|g| g.reflectance).collect::<Vec<_>>(), Card::COLOR_CHECKER_NEUTRALS);
        request.greys[0].reflectance = 0.95;
        let moved = Mark::GreyScale.shape(&request).unwrap().moved(3.0, 4.0);
        Mark::GreyScale.set(&mut request, moved);
        assert_eq!(request.greys[0].reflectance, 0.95);
        assert_eq!(Mark::GreyScale.shape(&request), Some(moved));
    }
}
