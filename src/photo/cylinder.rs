//! The outline of a cylinder.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::mark::{MarkError, numbers, positive};

/// A cylinder across the line of sight, in pixel coordinates: a stretch of its axis and its radius.
///
/// Its outline is two parallel edges. Its angles are those of a ball in one direction: sin θ is the distance
/// from the axis over the radius. An axis that leans towards the camera by τ would make cos θ smaller by cos τ.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cylinder {
    /// Horizontal position of one end of the axis, to the right.
    pub x0: f64,
    /// Vertical position of that end, downwards.
    pub y0: f64,
    /// Horizontal position of the other end.
    pub x1: f64,
    /// Vertical position of the other end.
    pub y1: f64,
    /// Radius in pixels.
    pub radius: f64,
}

impl Cylinder {
    /// A cylinder around the stretch between two points.
    pub const fn new([x0, y0]: [f64; 2], [x1, y1]: [f64; 2], radius: f64) -> Self {
        Self { x0, y0, x1, y1, radius }
    }

    /// The cylinder between two edges, each given by two points on it, in the same direction.
    ///
    /// The axis runs half way between them; edges that are not parallel give their mean radius.
    pub fn between(left: [[f64; 2]; 2], right: [[f64; 2]; 2]) -> Self {
        let middle = |end: usize| [0, 1].map(|i| 0.5 * (left[end][i] + right[end][i]));
        let axis = Self::new(middle(0), middle(1), 1.0);
        let points = left.into_iter().chain(right);
        let radius = points.map(|[x, y]| axis.offset(x, y)[0].hypot(axis.offset(x, y)[1])).sum::<f64>() / 4.0;
        Self { radius, ..axis }
    }

    /// The same cylinder with another radius.
    pub const fn with_radius(self, radius: f64) -> Self {
        Self { radius, ..self }
    }

    /// Length of the stretch in pixels.
    pub fn length(self) -> f64 {
        (self.x1 - self.x0).hypot(self.y1 - self.y0)
    }

    /// The direction of the axis, of length 1.
    pub fn direction(self) -> [f64; 2] {
        [(self.x1 - self.x0) / self.length(), (self.y1 - self.y0) / self.length()]
    }

    /// Where along the stretch a point lies: 0 at the first end, 1 at the other, beyond them outside.
    pub fn along(self, x: f64, y: f64) -> f64 {
        let [ux, uy] = self.direction();
        ((x - self.x0) * ux + (y - self.y0) * uy) / self.length()
    }

    /// The way from the axis to a point over the radius, right and down; its length is sin θ.
    pub fn offset(self, x: f64, y: f64) -> [f64; 2] {
        let [ux, uy] = self.direction();
        let side = ((y - self.y0) * ux - (x - self.x0) * uy) / self.radius;
        [-uy * side, ux * side]
    }

    /// The four ends of the two edges, in order around the outline.
    pub fn corners(self) -> [[f64; 2]; 4] {
        let [ux, uy] = self.direction().map(|u| u * self.radius);
        [
            [self.x0 - uy, self.y0 + ux],
            [self.x1 - uy, self.y1 + ux],
            [self.x1 + uy, self.y1 - ux],
            [self.x0 + uy, self.y0 - ux],
        ]
    }

    /// The smallest rectangle around it: `[left, top, width, height]`.
    pub fn bounds(self) -> [f64; 4] {
        let corners = self.corners();
        let end = |i: usize, pick: fn(f64, f64) -> f64| corners.iter().map(|corner| corner[i]).reduce(pick);
        let of = |i, pick| end(i, pick).unwrap_or_default();
        let (left, top) = (of(0, f64::min), of(1, f64::min));
        [left, top, of(0, f64::max) - left, of(1, f64::max) - top]
    }

    /// True when all of it lies inside a picture of this size.
    pub fn is_inside(self, width: u32, height: u32) -> bool {
        let [x, y, w, h] = self.bounds();
        x >= 0.0 && y >= 0.0 && x + w <= f64::from(width) && y + h <= f64::from(height)
    }
}

impl fmt::Display for Cylinder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{},{},{},{}", self.x0, self.y0, self.x1, self.y1, self.radius)
    }
}

impl FromStr for Cylinder {
    type Err = MarkError;

    fn from_str(text: &str) -> Result<Self, MarkError> {
        let Some(&[x0, y0, x1, y1, radius]) = numbers(text).as_deref() else {
            return Err(MarkError::form(text, "cylinder", "x0,y0,x1,y1,radius in pixels, the ends of its axis first"));
        };
        let cylinder = Self::new([x0, y0], [x1, y1], positive(text, "radius", radius)?);
        positive(text, "length of the axis", cylinder.length())?;
        Ok(cylinder)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_it_writes_and_says_what_is_wrong() {
        let cylinder = Cylinder::new([10.5, 20.0], [80.0, 25.0], 12.5);
        assert_eq!(cylinder.to_string().parse(), Ok(cylinder));
        for (text, reason) in
            [("1,2,3", "x0,y0,x1,y1"), ("1,2,3,4,0", "radius must"), ("1,2,1,2,5", "length of the axis")]
        {
            assert!(text.parse::<Cylinder>().unwrap_err().to_string().contains(reason), "{text}");
        }
    }

    #[test]
    fn measures_across_the_axis_alone() {
        let upright = Cylinder::new([50.0, 10.0], [50.0, 90.0], 20.0);
        for y in [10.0, 40.0, 90.0] {
            assert_eq!(upright.offset(60.0, y), [0.5, 0.0]);
            assert_eq!(upright.offset(30.0, y), [-1.0, 0.0]);
        }
        assert_eq!((upright.along(0.0, 30.0), upright.along(60.0, 100.0)), (0.25, 1.125));
        assert_eq!(upright.bounds(), [30.0, 10.0, 40.0, 80.0]);
        assert!(upright.is_inside(70, 90) && !upright.is_inside(69, 90));
    }

    #[test]
    fn lies_between_two_edges() {
        let cylinder = Cylinder::between([[30.0, 10.0], [30.0, 90.0]], [[70.0, 10.0], [70.0, 90.0]]);
        assert_eq!(cylinder, Cylinder::new([50.0, 10.0], [50.0, 90.0], 20.0));
        let turned = Cylinder::new([10.0, 10.0], [80.0, 60.0], 15.0);
        let [a, b, c, d] = turned.corners();
        let again = Cylinder::between([a, b], [d, c]);
        assert!((again.radius - 15.0).abs() < 1e-9 && (again.x1 - 80.0).abs() < 1e-9, "{again:?}");
    }
}
