//! What is measured: a ball or a cylinder, each with the angle every pixel of it shows.

use super::{Circle, Cylinder};

/// A round polished thing, seen from afar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Body {
    /// A ball.
    Ball(Circle),
    /// A cylinder across the line of sight.
    Cylinder(Cylinder),
}

impl Body {
    /// The noun people read.
    pub const fn noun(self) -> &'static str {
        match self {
            Self::Ball(_) => "ball",
            Self::Cylinder(_) => "cylinder",
        }
    }

    /// Radius in pixels.
    pub const fn radius(self) -> f64 {
        match self {
            Self::Ball(circle) => circle.radius,
            Self::Cylinder(cylinder) => cylinder.radius,
        }
    }

    /// The same body with another radius.
    pub const fn with_radius(self, radius: f64) -> Self {
        match self {
            Self::Ball(circle) => Self::Ball(circle.with_radius(radius)),
            Self::Cylinder(cylinder) => Self::Cylinder(cylinder.with_radius(radius)),
        }
    }

    /// The surface normal where a point of the picture shows it, right and down, in units of its length: the way
    /// from the centre or the axis over the radius. Its length is sin θ; `None` beyond the ends of a cylinder.
    pub fn normal(self, x: f64, y: f64) -> Option<[f64; 2]> {
        let is_between_ends = match self {
            Self::Ball(_) => true,
            Self::Cylinder(cylinder) => (0.0..=1.0).contains(&cylinder.along(x, y)),
        };
        is_between_ends.then(|| self.offset(x, y))
    }

    /// The way from the centre, or from the axis without its ends, over the radius: linear in x and y.
    pub(super) fn offset(self, x: f64, y: f64) -> [f64; 2] {
        match self {
            Self::Ball(circle) => [(x - circle.x) / circle.radius, (y - circle.y) / circle.radius],
            Self::Cylinder(cylinder) => cylinder.offset(x, y),
        }
    }

    /// sin θ where a point of the picture shows the body; `None` beside it.
    pub fn sine(self, x: f64, y: f64) -> Option<f64> {
        self.normal(x, y).map(|[right, down]| right.hypot(down)).filter(|sine| *sine <= 1.0)
    }

    /// The angle of incidence at a point of the picture, in degrees; `None` beside the body.
    pub fn angle_deg(self, x: f64, y: f64) -> Option<f64> {
        self.sine(x, y).map(|sine| sine.asin().to_degrees())
    }

    /// How far from the centre or the axis a body shows an angle, in pixels.
    pub fn ring_radius(self, angle_deg: f64) -> f64 {
        self.radius() * angle_deg.to_radians().sin()
    }

    /// The smallest rectangle around it: `[left, top, width, height]`.
    pub fn bounds(self) -> [f64; 4] {
        match self {
            Self::Ball(Circle { x, y, radius }) => [x - radius, y - radius, 2.0 * radius, 2.0 * radius],
            Self::Cylinder(cylinder) => cylinder.bounds(),
        }
    }

    /// True when all of it lies inside a picture of this size.
    pub fn is_inside(self, width: u32, height: u32) -> bool {
        match self {
            Self::Ball(circle) => circle.is_inside(width, height),
            Self::Cylinder(cylinder) => cylinder.is_inside(width, height),
        }
    }

    /// One of `count` (even) parts in which the body mirrors different surroundings: a sector of a ball, a
    /// stretch of one side of a cylinder.
    pub(super) fn part(self, x: f64, y: f64, count: usize) -> usize {
        let index = |share: f64, count: usize| ((share * count as f64) as usize).min(count - 1);
        match self {
            Self::Ball(circle) => index((y - circle.y).atan2(x - circle.x) / std::f64::consts::TAU + 0.5, count),
            Self::Cylinder(cylinder) => {
                let ([ux, uy], [right, down]) = (cylinder.direction(), cylinder.offset(x, y));
                let side = usize::from(ux * down > uy * right);
                side * (count / 2) + index(cylinder.along(x, y), count / 2)
            }
        }
    }

    /// Within which sine lies this share of the disc, or of the strip, within `sine`: rings of equal area.
    pub(super) fn sine_of_area_share(self, share: f64, sine: f64) -> f64 {
        match self {
            Self::Ball(_) => share.sqrt() * sine,
            Self::Cylinder(_) => share * sine,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cylinder_shows_the_angles_of_a_ball_across_its_axis() {
        let ball = Body::Ball(Circle::new(50.0, 50.0, 40.0));
        let cylinder = Body::Cylinder(Cylinder::new([50.0, 0.0], [50.0, 100.0], 40.0));
        for x in [12.0, 30.0, 50.0, 88.0] {
            assert_eq!(cylinder.normal(x, 50.0), ball.normal(x, 50.0));
            assert_eq!(cylinder.angle_deg(x, 80.0), ball.angle_deg(x, 50.0));
        }
        assert_eq!((cylinder.sine(50.0, 101.0), cylinder.sine(91.0, 50.0)), (None, None));
        assert_eq!(cylinder.ring_radius(90.0), 40.0);
    }

    #[test]
    fn parts_tell_sides_and_places_apart() {
        let cylinder = Body::Cylinder(Cylinder::new([50.0, 0.0], [50.0, 100.0], 40.0));
        let parts: std::collections::BTreeSet<usize> =
            (0..100).flat_map(|y| [20.0, 80.0].map(|x| cylinder.part(x, f64::from(y) + 0.5, 24))).collect();
        assert_eq!(parts, (0..24).collect());
        assert_ne!(cylinder.part(20.0, 10.0, 24), cylinder.part(80.0, 10.0, 24));
    }
}
