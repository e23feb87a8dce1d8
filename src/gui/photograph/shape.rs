//! The outline of a mark: how it is drawn, moved and resized.

use crate::photo::{Area, Circle};

/// The outline of a mark, in pixels of the photograph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum MarkShape {
    /// A circle.
    Round(Circle),
    /// A rectangle: x, y, width, height.
    Square([f64; 4]),
    /// Four corners, in turn.
    Quad([[f64; 2]; 4]),
}

/// The smallest radius or side a mark may be dragged to, in pixels of the photograph.
const SMALLEST: f64 = 2.0;

impl MarkShape {
    pub(super) fn of_area(area: Area) -> Self {
        match area {
            Area::Box { x, y, width, height } => Self::Square([x, y, width, height]),
            Area::Disc { x, y, radius } => Self::Round(Circle::new(x, y, radius)),
        }
    }

    /// The area inside; of four corners the smallest rectangle around them.
    pub(super) fn area(self) -> Area {
        match self {
            Self::Round(Circle { x, y, radius }) => Area::disc(x, y, radius),
            Self::Square([x, y, width, height]) => Area::rectangle(x, y, width, height),
            Self::Quad(corners) => {
                let low = |axis: usize| corners.iter().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min);
                let high = |axis: usize| corners.iter().map(|corner| corner[axis]).fold(f64::NEG_INFINITY, f64::max);
                Area::rectangle(low(0), low(1), high(0) - low(0), high(1) - low(1))
            }
        }
    }

    /// The smallest rectangle around it: left, top, width, height.
    pub(crate) fn bounds(self) -> [f64; 4] {
        self.area().bounds()
    }

    /// The middle of that rectangle.
    pub(crate) fn centre(self) -> [f64; 2] {
        self.area().centre()
    }

    /// The same shape elsewhere.
    pub(crate) fn moved(self, dx: f64, dy: f64) -> Self {
        match self {
            Self::Round(c) => Self::Round(Circle { x: c.x + dx, y: c.y + dy, ..c }),
            Self::Square([x, y, width, height]) => Self::Square([x + dx, y + dy, width, height]),
            Self::Quad(corners) => Self::Quad(corners.map(|[x, y]| [x + dx, y + dy])),
        }
    }

    /// A shape of this kind drawn from one point to another: across a circle, from corner to corner of a
    /// rectangle, and along the longer way of a row.
    pub(crate) fn drawn(self, [ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> Self {
        let size = |a: f64, b: f64| (a - b).abs().max(SMALLEST);
        match self {
            Self::Round(_) => {
                let radius = ((ax - bx).hypot(ay - by) / 2.0).max(SMALLEST);
                Self::Round(Circle::new(f64::midpoint(ax, bx), f64::midpoint(ay, by), radius))
            }
            Self::Square(_) => Self::Square([ax.min(bx), ay.min(by), size(ax, bx), size(ay, by)]),
            Self::Quad(_) if (ax - bx).abs() >= (ay - by).abs() => Self::Quad([[ax, ay], [bx, ay], [bx, by], [ax, by]]),
            Self::Quad(_) => Self::Quad([[ax, ay], [ax, by], [bx, by], [bx, ay]]),
        }
    }

    /// The points by which its size is changed: right, bottom, left and top of a circle, corners of the others.
    pub(crate) fn grips(self) -> [[f64; 2]; 4] {
        match self {
            Self::Round(Circle { x, y, radius }) => {
                [[x + radius, y], [x, y + radius], [x - radius, y], [x, y - radius]]
            }
            Self::Square([x, y, w, h]) => [[x, y], [x + w, y], [x + w, y + h], [x, y + h]],
            Self::Quad(corners) => corners,
        }
    }

    /// The shape after one of its grips was dragged to a point. A circle keeps its opposite side, a rectangle its
    /// opposite corner, and of four corners the other three stay.
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
            Self::Square(_) => self.drawn([px, py], opposite),
            Self::Quad(mut corners) => {
                corners[grip] = [px, py];
                Self::Quad(corners)
            }
        }
    }

    /// True when a point is on the shape or inside.
    pub(crate) fn contains(self, [px, py]: [f64; 2]) -> bool {
        match self {
            Self::Round(Circle { x, y, radius }) => (px - x).hypot(py - y) <= radius,
            Self::Square([x, y, width, height]) => (x..=x + width).contains(&px) && (y..=y + height).contains(&py),
            Self::Quad(corners) => {
                // Even-odd: sides that a line to the right crosses.
                let crosses = |i: usize| {
                    let ([ax, ay], [bx, by]) = (corners[i], corners[(i + 1) % 4]);
                    (ay > py) != (by > py) && px < ax + (py - ay) / (by - ay) * (bx - ax)
                };
                (0..4).filter(|&i| crosses(i)).count() % 2 == 1
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [MarkShape; 3] = [
        MarkShape::Round(Circle::new(50.0, 40.0, 20.0)),
        MarkShape::Square([10.0, 20.0, 30.0, 40.0]),
        MarkShape::Quad([[10.0, 20.0], [60.0, 24.0], [58.0, 40.0], [12.0, 36.0]]),
    ];

    #[test]
    fn a_dragged_grip_goes_where_the_pointer_is_and_the_opposite_one_stays() {
        for shape in SHAPES {
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
    fn what_is_drawn_begins_and_ends_where_the_pointer_was() {
        let (from, to) = ([10.0, 20.0], [70.0, 100.0]);
        for shape in SHAPES {
            let bounds = shape.drawn(from, to).area().bounds();
            match shape {
                MarkShape::Round(_) => assert_eq!(bounds, [-10.0, 10.0, 100.0, 100.0], "3-4-5: a diameter of 100"),
                _ => assert_eq!(bounds, [10.0, 20.0, 60.0, 80.0]),
            }
        }
        let MarkShape::Quad(corners) = SHAPES[2].drawn(from, to) else { panic!("stays a quadrilateral") };
        assert_eq!(corners[0], from, "the first patch is where the drag began");
        assert_eq!(corners[1], [10.0, 100.0], "and the row runs along the longer way");
    }

    #[test]
    fn the_middle_is_inside_and_beyond_a_grip_is_not() {
        for shape in SHAPES {
            let [x, y] = shape.area().centre();
            assert!(shape.contains([x, y]));
            for [gx, gy] in shape.grips() {
                assert!(!shape.contains([gx + 0.2 * (gx - x), gy + 0.2 * (gy - y)]), "{shape:?}");
            }
        }
    }
}
