//! The outline of a ball.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::mark::{MarkError, numbers, positive};

/// A circle in pixel coordinates: origin top left, the centre of the first pixel is (0.5, 0.5).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Circle {
    /// Horizontal position of the centre, to the right.
    pub x: f64,
    /// Vertical position of the centre, downwards.
    pub y: f64,
    /// Radius in pixels.
    pub radius: f64,
}

impl Circle {
    /// A circle around a point.
    pub const fn new(x: f64, y: f64, radius: f64) -> Self {
        Self { x, y, radius }
    }

    /// The same circle with another radius.
    pub const fn with_radius(self, radius: f64) -> Self {
        Self { radius, ..self }
    }

    /// Distance of a point from the centre over the radius: sin θ on a ball seen from afar.
    pub fn rho(self, x: f64, y: f64) -> f64 {
        (x - self.x).hypot(y - self.y) / self.radius
    }

    /// The angle of incidence on a ball seen from afar, in degrees; `None` outside the outline.
    pub fn angle_deg(self, x: f64, y: f64) -> Option<f64> {
        let rho = self.rho(x, y);
        (rho <= 1.0).then(|| rho.asin().to_degrees())
    }

    /// Where on the picture a ball shows an angle: the radius of that ring in pixels.
    pub fn ring_radius(self, angle_deg: f64) -> f64 {
        self.radius * angle_deg.to_radians().sin()
    }

    /// True when the whole circle lies inside a picture of this size.
    pub fn is_inside(self, width: u32, height: u32) -> bool {
        let fits = |centre: f64, size: u32| centre >= self.radius && centre + self.radius <= f64::from(size);
        fits(self.x, width) && fits(self.y, height)
    }
}

impl fmt::Display for Circle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{},{}", self.x, self.y, self.radius)
    }
}

impl FromStr for Circle {
    type Err = MarkError;

    fn from_str(text: &str) -> Result<Self, MarkError> {
        match numbers(text).as_deref() {
            Some(&[x, y, radius]) => Ok(Self { x, y, radius: positive(text, "radius", radius)? }),
            _ => Err(MarkError::form(text, "circle", "x,y,radius in pixels")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::THETA_MAX_DEG;

    #[test]
    fn reads_what_it_writes() {
        let circle = Circle::new(120.25, 80.0, 64.5);
        assert_eq!(circle.to_string().parse(), Ok(circle));
    }

    #[test]
    fn says_what_is_wrong() {
        let error = "1,2".parse::<Circle>().unwrap_err().to_string();
        assert!(error.contains("x,y,radius"), "{error}");
        assert!("1,2,0".parse::<Circle>().unwrap_err().to_string().contains("radius must be above 0"));
        assert!("1,2,nan".parse::<Circle>().is_err());
    }

    /// ρ = √(48/49) at θ_max, from cos θ = 1/7.
    #[test]
    fn theta_max_lies_just_inside_the_outline() {
        let circle = Circle::new(0.0, 0.0, 1.0);
        let rho = (48.0_f64 / 49.0).sqrt();
        assert!((circle.angle_deg(rho, 0.0).unwrap() - THETA_MAX_DEG).abs() < 1e-9);
        assert!((circle.ring_radius(THETA_MAX_DEG) - rho).abs() < 1e-12);
        assert_eq!(circle.angle_deg(1.01, 0.0), None);
    }

    #[test]
    fn knows_when_it_is_cut_off() {
        assert!(Circle::new(50.0, 50.0, 50.0).is_inside(100, 100));
        assert!(!Circle::new(50.0, 49.0, 50.0).is_inside(100, 100));
    }
}
