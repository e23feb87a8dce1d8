//! The outline of a mark: how it is drawn, moved and resized.

use crate::photo::{Area, Circle, Cylinder};

/// The outline of a mark, in pixels of the photograph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum MarkShape {
    /// A circle.
    Round(Circle),
    /// A rectangle: x, y, width, height.
    Square([f64; 4]),
    /// Four corners, in turn.
    Quad([[f64; 2]; 4]),
    /// A cylinder: two parallel edges.
    Rod(Cylinder),
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

    /// The area inside; of four corners and of a cylinder the smallest rectangle around them.
    pub(super) fn area(self) -> Area {
        match self {
            Self::Round(Circle { x, y, radius }) => Area::disc(x, y, radius),
            Self::Square([x, y, width, height]) => Area::rectangle(x, y, width, height),
            Self::Quad(corners) => {
                let low = |axis: usize| corners.iter().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min);
                let high = |axis: usize| corners.iter().map(|corner| corner[axis]).fold(f64::NEG_INFINITY, f64::max);
                Area::rectangle(low(0), low(1), high(0) - low(0), high(1) - low(1))
            }
            Self::Rod(cylinder) => {
                let [x, y, width, height] = cylinder.bounds();
                Area::rectangle(x, y, width, height)
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
            Self::Rod(Cylinder { x0, y0, x1, y1, radius }) => {
                Self::Rod(Cylinder::new([x0 + dx, y0 + dy], [x1 + dx, y1 + dy], radius))
            }
        }
    }

    /// A shape of this kind drawn from one point to another: across a circle, from corner to corner of a
    /// rectangle, and along the longer way of a row or of a cylinder.
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
            Self::Rod(_) => {
                let ([width, height], [mx, my]) =
                    ([size(ax, bx), size(ay, by)], [f64::midpoint(ax, bx), f64::midpoint(ay, by)]);
                let (dx, dy) = (width / 2.0, height / 2.0);
                Self::Rod(if width >= height {
                    Cylinder::new([mx - dx, my], [mx + dx, my], dy)
                } else {
                    Cylinder::new([mx, my - dy], [mx, my + dy], dx)
                })
            }
        }
    }

    /// The points by which its size is changed: right, bottom, left and top of a circle, the ends of the axis of a
    /// cylinder with the middles of its edges between them, corners of the others.
    pub(crate) fn grips(self) -> [[f64; 2]; 4] {
        match self {
            Self::Round(Circle { x, y, radius }) => {
                [[x + radius, y], [x, y + radius], [x - radius, y], [x, y - radius]]
            }
            Self::Square([x, y, w, h]) => [[x, y], [x + w, y], [x + w, y + h], [x, y + h]],
            Self::Quad(corners) => corners,
            Self::Rod(cylinder) => {
                let [a, b, c, d] = cylinder.corners();
                let middle = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| [f64::midpoint(ax, bx), f64::midpoint(ay, by)];
                [[cylinder.x0, cylinder.y0], middle(a, b), [cylinder.x1, cylinder.y1], middle(c, d)]
            }
        }
    }

    /// The shape after one of its grips was dragged to a point. A circle keeps its opposite side, a rectangle its
    /// opposite corner, a cylinder its other end or its other edge, and of four corners the other three stay.
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
            Self::Rod(cylinder) => Self::Rod(resized_rod(cylinder, grip, opposite, [px, py])),
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
            Self::Rod(cylinder) => {
                let [right, down] = cylinder.offset(px, py);
                (0.0..=1.0).contains(&cylinder.along(px, py)) && right.hypot(down) <= 1.0
            }
        }
    }
}

/// A cylinder whose end or edge was dragged, with the grip opposite to it held.
fn resized_rod(cylinder: Cylinder, grip: usize, opposite: [f64; 2], [px, py]: [f64; 2]) -> Cylinder {
    let [ox, oy] = opposite;
    if grip.is_multiple_of(2) {
        // Shorter than this it has no direction.
        let is_long = (px - ox).hypot(py - oy) >= SMALLEST;
        let (start, end) = if grip == 0 { ([px, py], opposite) } else { (opposite, [px, py]) };
        return if is_long { Cylinder::new(start, end, cylinder.radius) } else { cylinder };
    }
    let [ux, uy] = cylinder.direction();
    let side = if grip == 1 { 1.0 } else { -1.0 };
    let [nx, ny] = [-uy * side, ux * side];
    let radius = (((px - ox) * nx + (py - oy) * ny) / 2.0).max(SMALLEST / 2.0);
    let shift = radius - cylinder.radius;
    let moved = |x: f64, y: f64| [x + shift * nx, y + shift * ny];
    Cylinder::new(moved(cylinder.x0, cylinder.y0), moved(cylinder.x1, cylinder.y1), radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [MarkShape; 4] = [
        MarkShape::Round(Circle::new(50.0, 40.0, 20.0)),
        MarkShape::Square([10.0, 20.0, 30.0, 40.0]),
        MarkShape::Quad([[10.0, 20.0], [60.0, 24.0], [58.0, 40.0], [12.0, 36.0]]),
        MarkShape::Rod(Cylinder::new([20.0, 30.0], [90.0, 30.0], 12.0)),
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
        let rod = SHAPES[3].drawn(from, to);
        assert_eq!(rod, MarkShape::Rod(Cylinder::new([40.0, 20.0], [40.0, 100.0], 30.0)), "and so does an axis");
    }

    #[test]
    fn an_end_of_a_cylinder_turns_it_and_an_edge_widens_it() {
        let rod = SHAPES[3];
        assert_eq!(rod.resized(2, [90.0, 50.0]), MarkShape::Rod(Cylinder::new([20.0, 30.0], [90.0, 50.0], 12.0)));
        assert_eq!(rod.resized(1, [50.0, 50.0]), MarkShape::Rod(Cylinder::new([20.0, 34.0], [90.0, 34.0], 16.0)));
        assert_eq!(rod.resized(0, [90.0, 30.0]), rod, "without a length there is no direction");
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
