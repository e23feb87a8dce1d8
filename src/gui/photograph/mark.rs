//! Marks in the photograph: which there are, and how they are moved.

use crate::photo::{Area, Card, Circle, MatchRequest};

/// A mark of a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Mark {
    /// The outline of the ball.
    Ball,
    /// A card of known reflectance.
    Card(usize),
    /// Where r is picked.
    Facing,
    /// Where h is picked.
    Edge,
    /// The bright area beside the rim.
    Backdrop,
}

/// The outline of a mark, in pixels of the photograph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum MarkShape {
    /// A circle.
    Round(Circle),
    /// A rectangle: x, y, width, height.
    Square([f64; 4]),
}

/// The smallest radius or side a mark may be dragged to, in pixels of the photograph.
const SMALLEST: f64 = 2.0;

impl MarkShape {
    fn of_area(area: Area) -> Self {
        match area {
            Area::Box { x, y, width, height } => Self::Square([x, y, width, height]),
            Area::Disc { x, y, radius } => Self::Round(Circle::new(x, y, radius)),
        }
    }

    fn area(self) -> Area {
        match self {
            Self::Round(Circle { x, y, radius }) => Area::disc(x, y, radius),
            Self::Square([x, y, width, height]) => Area::rectangle(x, y, width, height),
        }
    }

    /// The same shape elsewhere.
    pub(crate) fn moved(self, dx: f64, dy: f64) -> Self {
        match self {
            Self::Round(c) => Self::Round(Circle { x: c.x + dx, y: c.y + dy, ..c }),
            Self::Square([x, y, width, height]) => Self::Square([x + dx, y + dy, width, height]),
        }
    }

    /// The points by which its size is changed: right, bottom, left and top of a circle, corners of a rectangle.
    pub(crate) fn grips(self) -> [[f64; 2]; 4] {
        match self {
            Self::Round(Circle { x, y, radius }) => {
                [[x + radius, y], [x, y + radius], [x - radius, y], [x, y - radius]]
            }
            Self::Square([x, y, w, h]) => [[x, y], [x + w, y], [x + w, y + h], [x, y + h]],
        }
    }

    /// The shape after one of its grips was dragged to a point. A circle keeps its opposite side.
    pub(crate) fn resized(self, grip: usize, [px, py]: [f64; 2]) -> Self {
        let opposite = self.grips()[(grip + 2) % 4];
        match self {
            Self::Round(c) => {
                let (along, is_across) =
                    if grip.is_multiple_of(2) { (px - opposite[0], true) } else { (py - opposite[1], false) };
                let side = if grip < 2 { 1.0 } else { -1.0 };
                let radius = (along * side / 2.0).max(SMALLEST);
                let centre = |fixed: f64| fixed + side * radius;
                if is_across {
                    Self::Round(Circle { x: centre(opposite[0]), radius, ..c })
                } else {
                    Self::Round(Circle { y: centre(opposite[1]), radius, ..c })
                }
            }
            Self::Square(_) => {
                let [x, y] = [px.min(opposite[0]), py.min(opposite[1])];
                let size = |a: f64, b: f64| (a - b).abs().max(SMALLEST);
                Self::Square([x, y, size(px, opposite[0]), size(py, opposite[1])])
            }
        }
    }

    /// True when a point is on the shape or inside.
    pub(crate) fn contains(self, [px, py]: [f64; 2]) -> bool {
        match self {
            Self::Round(Circle { x, y, radius }) => (px - x).hypot(py - y) <= radius,
            Self::Square([x, y, width, height]) => (x..=x + width).contains(&px) && (y..=y + height).contains(&py),
        }
    }
}

impl Mark {
    /// The marks that a request has, those that are drawn last at the end.
    pub(crate) fn all_of(request: &MatchRequest) -> Vec<Self> {
        let mut marks: Vec<Self> = request.circle.iter().map(|_| Self::Ball).collect();
        marks.extend((0..request.cards.len()).map(Self::Card));
        marks.extend(request.backdrop.iter().map(|_| Self::Backdrop));
        marks.extend(request.facing.iter().map(|_| Self::Facing));
        marks.extend(request.edge.iter().map(|_| Self::Edge));
        marks
    }

    /// What people call it.
    pub(crate) fn name(self, request: &MatchRequest) -> String {
        match self {
            Self::Ball => "Ball".to_owned(),
            Self::Card(_) if request.cards.len() < 2 => "Card".to_owned(),
            Self::Card(index) => format!("Card {}", index + 1),
            Self::Facing => "Facing pick".to_owned(),
            Self::Edge => "Edge pick".to_owned(),
            Self::Backdrop => "Backdrop".to_owned(),
        }
    }

    /// Its shape; `None` when the request has no such mark.
    pub(crate) fn shape(self, request: &MatchRequest) -> Option<MarkShape> {
        match self {
            Self::Ball => request.circle.map(MarkShape::Round),
            Self::Card(index) => request.cards.get(index).map(|card| MarkShape::of_area(card.area)),
            Self::Facing => request.facing.map(MarkShape::of_area),
            Self::Edge => request.edge.map(MarkShape::of_area),
            Self::Backdrop => request.backdrop.map(MarkShape::of_area),
        }
    }

    /// Gives it another shape, or makes it.
    pub(crate) fn set(self, request: &mut MatchRequest, shape: MarkShape) {
        match self {
            Self::Ball => {
                if let MarkShape::Round(circle) = shape {
                    request.circle = Some(circle);
                }
            }
            Self::Card(index) => match request.cards.get_mut(index) {
                Some(card) => card.area = shape.area(),
                None => request.cards.push(Card { area: shape.area(), reflectance: Card::COMMON[0].1 }),
            },
            Self::Facing => request.facing = Some(shape.area()),
            Self::Edge => request.edge = Some(shape.area()),
            Self::Backdrop => request.backdrop = Some(shape.area()),
        }
    }

    /// Takes it away.
    pub(crate) fn remove(self, request: &mut MatchRequest) {
        match self {
            Self::Ball => request.circle = None,
            Self::Card(index) => {
                if index < request.cards.len() {
                    request.cards.remove(index);
                }
            }
            Self::Facing => request.facing = None,
            Self::Edge => request.edge = None,
            Self::Backdrop => request.backdrop = None,
        }
    }

    /// Where it starts in a picture of this size: the ball in the middle, the rest where they can be seen.
    pub(crate) fn first_shape(self, width: u32, height: u32) -> MarkShape {
        let (w, h) = (f64::from(width), f64::from(height));
        let unit = w.min(h);
        match self {
            Self::Ball => MarkShape::Round(Circle::new(w / 2.0, h / 2.0, unit * 0.35)),
            Self::Facing => MarkShape::Round(Circle::new(w / 2.0, h / 2.0, unit * 0.05)),
            Self::Edge => MarkShape::Round(Circle::new(w / 2.0 + unit * 0.33, h / 2.0, unit * 0.02)),
            Self::Card(_) | Self::Backdrop => MarkShape::Square([w * 0.05, h * 0.05, unit * 0.12, unit * 0.12]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dragged_grip_goes_where_the_pointer_is_and_the_opposite_one_stays() {
        let shapes = [MarkShape::Round(Circle::new(50.0, 40.0, 20.0)), MarkShape::Square([10.0, 20.0, 30.0, 40.0])];
        for shape in shapes {
            for grip in 0..4 {
                let target = shape.grips()[grip].map(|v| v + 3.0 * if grip < 2 { 1.0 } else { -1.0 });
                let resized = shape.resized(grip, target);
                let (before, after) = (shape.grips()[(grip + 2) % 4], resized.grips()[(grip + 2) % 4]);
                assert!((before[0] - after[0]).abs() < 1e-9 || (before[1] - after[1]).abs() < 1e-9);
                assert_ne!(resized, shape);
            }
        }
    }

    #[test]
    fn marks_are_set_found_and_removed() {
        let mut request = MatchRequest::default();
        let marks = [Mark::Ball, Mark::Card(0), Mark::Card(1), Mark::Backdrop, Mark::Facing, Mark::Edge];
        for mark in marks {
            assert_eq!(mark.shape(&request), None);
            let shape = mark.first_shape(400, 300);
            mark.set(&mut request, shape);
            assert_eq!(mark.shape(&request), Some(shape));
        }
        assert_eq!(Mark::all_of(&request), marks);
        for mark in marks.into_iter().rev() {
            mark.remove(&mut request);
        }
        assert_eq!(request, MatchRequest::default());
    }
}
