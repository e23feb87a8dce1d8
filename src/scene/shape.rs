//! The angles at which built-in shapes are seen, each place of the picture counting alike.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::Angles;
use crate::fresnel::CosTheta;
use crate::number::short;

/// A shape in front of a distant eye, or a floor below a near one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Shape {
    /// A ball: every angle, those near 45° most often.
    Sphere,
    /// An upright cylinder from the side.
    Cylinder,
    /// A card that is turned about; each tilt is equally frequent and counts by the area it shows.
    Card {
        /// Smallest tilt, in degrees.
        from_deg: f64,
        /// Largest tilt, in degrees.
        to_deg: f64,
    },
    /// A floor that reaches away from the eye, in an upright picture.
    Floor {
        /// Height of the eye in metres.
        eye_m: f64,
        /// Nearest visible place in metres.
        near_m: f64,
        /// Farthest visible place in metres.
        far_m: f64,
    },
}

/// Places of the picture that are looked at.
const STEPS: usize = 4096;

/// A text or numbers that are no shape.
#[derive(Clone, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum ShapeError {
    #[error(
        "“{0}” is no shape; write sphere, cylinder, card:0-60 (degrees) or floor:1.7:1-20 (eye, near and far in m)"
    )]
    Unknown(String),
    #[error("a card is tilted between two angles of 0–90°, the smaller first, not {}–{}°", short(*.0), short(*.1))]
    Card(f64, f64),
    #[error(
        "a floor needs an eye above it and a near place before a far one, all positive, not {}:{}-{}",
        short(*.0), short(*.1), short(*.2)
    )]
    Floor(f64, f64, f64),
}

impl Shape {
    /// The shapes to choose from, with usual numbers.
    pub const USUAL: [Self; 4] = [
        Self::Sphere,
        Self::Cylinder,
        Self::Card { from_deg: 0.0, to_deg: 60.0 },
        Self::Floor { eye_m: 1.7, near_m: 1.0, far_m: 20.0 },
    ];

    /// Refuses numbers that make no shape.
    pub fn checked(self) -> Result<Self, ShapeError> {
        match self {
            Self::Card { from_deg, to_deg } if !(0.0 <= from_deg && from_deg <= to_deg && to_deg <= 90.0) => {
                Err(ShapeError::Card(from_deg, to_deg))
            }
            Self::Floor { eye_m, near_m, far_m }
                if !(eye_m > 0.0 && near_m > 0.0 && far_m >= near_m && eye_m.is_finite() && far_m.is_finite()) =>
            {
                Err(ShapeError::Floor(eye_m, near_m, far_m))
            }
            shape => Ok(shape),
        }
    }

    /// How often each angle is seen; the weights sum to 1.
    pub fn angles(self) -> Angles {
        let mut angles = Angles::default();
        let places: Vec<(CosTheta, f64)> =
            (0..STEPS).map(|step| self.place((step as f64 + 0.5) / STEPS as f64)).collect();
        let all: f64 = places.iter().map(|(_, weight)| weight).sum();
        // A card at 90° alone shows nothing: it is seen at its edge.
        let unit = if all > 0.0 { 1.0 / all } else { 0.0 };
        places.iter().for_each(|(cos_theta, weight)| angles.add(*cos_theta, weight * unit));
        [0.0, 1.0].into_iter().for_each(|end| angles.reach(self.place(end).0));
        angles
    }

    /// What a person should know of a shape that shows nothing.
    pub fn warning(self) -> Option<String> {
        let is_edge = self.angles().is_empty();
        is_edge.then(|| format!("{} shows only its edge: its material is not seen", self.label()))
    }

    /// The cosine at a share of the picture, and how much of the picture is like it.
    fn place(self, share: f64) -> (CosTheta, f64) {
        match self {
            // Equal areas of the disc are equal steps of sin²θ, and so of c².
            Self::Sphere => (CosTheta::new(share.sqrt()), 1.0),
            // Equal widths are equal steps of sin θ.
            Self::Cylinder => (CosTheta::new((1.0 - share * share).sqrt()), 1.0),
            Self::Card { from_deg, to_deg } => {
                let cos_theta = CosTheta::from_deg(from_deg + share * (to_deg - from_deg));
                (cos_theta, cos_theta.get())
            }
            // Rows of an upright picture are equal steps of the reciprocal distance.
            Self::Floor { eye_m, near_m, far_m } => {
                let distance = 1.0 / (share / near_m + (1.0 - share) / far_m);
                (CosTheta::new(eye_m / eye_m.hypot(distance)), 1.0)
            }
        }
    }

    /// The name people read.
    pub fn label(self) -> String {
        match self {
            Self::Sphere => "Sphere".to_owned(),
            Self::Cylinder => "Cylinder".to_owned(),
            Self::Card { from_deg, to_deg } => format!("Card tilted by {}–{}°", short(from_deg), short(to_deg)),
            Self::Floor { eye_m, near_m, far_m } => {
                format!("Floor {}–{} m away, eye at {} m", short(near_m), short(far_m), short(eye_m))
            }
        }
    }
}

impl fmt::Display for Shape {
    /// `sphere`, `card:0-60`, `floor:1.7:1-20`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sphere => f.write_str("sphere"),
            Self::Cylinder => f.write_str("cylinder"),
            Self::Card { from_deg, to_deg } => write!(f, "card:{from_deg}-{to_deg}"),
            Self::Floor { eye_m, near_m, far_m } => write!(f, "floor:{eye_m}:{near_m}-{far_m}"),
        }
    }
}

impl FromStr for Shape {
    type Err = ShapeError;

    fn from_str(text: &str) -> Result<Self, ShapeError> {
        let unknown = || ShapeError::Unknown(text.to_owned());
        let range = |text: &str| {
            let (from, to) = text.split_once('-')?;
            Some((from.trim().parse().ok()?, to.trim().parse().ok()?))
        };
        match text.split_once(':') {
            None if text == "sphere" => Ok(Self::Sphere),
            None if text == "cylinder" => Ok(Self::Cylinder),
            Some(("card", tilts)) => {
                let (from_deg, to_deg) = range(tilts).ok_or_else(unknown)?;
                Self::Card { from_deg, to_deg }.checked()
            }
            Some(("floor", numbers)) => {
                let (eye, distances) = numbers.split_once(':').ok_or_else(unknown)?;
                let (near_m, far_m) = range(distances).ok_or_else(unknown)?;
                Self::Floor { eye_m: eye.trim().parse().map_err(|_| unknown())?, near_m, far_m }.checked()
            }
            _ => Err(unknown()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::node_cosines;

    fn mean_cosine(shape: Shape) -> f64 {
        shape.angles().seen().map(|(node, weight)| weight * node_cosines()[node].get()).sum()
    }

    /// ∫ c · 2c dc = 2/3 over the disc of a ball; ∫ √(1 − s²) ds = π/4 over the width of a cylinder.
    #[test]
    fn mean_cosines_are_the_integrals() {
        assert!((mean_cosine(Shape::Sphere) - 2.0 / 3.0).abs() < 1e-6);
        assert!((mean_cosine(Shape::Cylinder) - std::f64::consts::FRAC_PI_4).abs() < 1e-5);
        // ∫cos² / ∫cos from 0 to 60°.
        let (sin, angle) = (60_f64.to_radians().sin(), 60_f64.to_radians());
        let card = (angle / 2.0 + (2.0 * angle).sin() / 4.0) / sin;
        assert!((mean_cosine(Shape::Card { from_deg: 0.0, to_deg: 60.0 }) - card).abs() < 1e-6);
    }

    #[test]
    fn a_floor_is_seen_between_its_ends() {
        let floor = Shape::Floor { eye_m: 1.7, near_m: 1.7, far_m: 17.0 };
        let (smallest, largest) = floor.angles().range_deg().unwrap();
        assert!((smallest - 45.0).abs() < 0.5 && (largest - 84.29).abs() < 0.3, "{smallest} {largest}");
    }

    /// What was asked for is what is reported, not the nodes or the places around it.
    #[test]
    fn the_ends_are_those_that_were_asked_for() {
        for (text, ends) in [
            ("card:0-60", (0.0, 60.0)),
            ("card:12.5-89", (12.5, 89.0)),
            ("card:30-30", (30.0, 30.0)),
            ("sphere", (0.0, 90.0)),
            ("cylinder", (0.0, 90.0)),
            ("floor:2:2-2", (45.0, 45.0)),
        ] {
            assert_eq!(text.parse::<Shape>().unwrap().angles().range_deg(), Some(ends), "{text}");
        }
    }

    #[test]
    fn a_card_from_its_edge_is_said_to_show_nothing() {
        let edge: Shape = "card:90-90".parse().unwrap();
        assert!(edge.angles().range_deg().is_none() && edge.warning().unwrap().contains("90–90°"));
        assert!(Shape::USUAL.into_iter().all(|shape| shape.warning().is_none()));
    }

    #[test]
    fn long_numbers_are_written_short() {
        let far: Shape = "floor:1.7:1-1e300".parse().unwrap();
        assert_eq!(far.label(), "Floor 1–1e300 m away, eye at 1.7 m");
        assert!("floor:1e300:2-1".parse::<Shape>().unwrap_err().to_string().ends_with("not 1e300:2-1"));
    }

    #[test]
    fn texts_name_shapes_or_are_refused() {
        for shape in Shape::USUAL {
            assert_eq!(shape.to_string().parse(), Ok(shape));
            assert!((shape.angles().total() - 1.0).abs() < 1e-9);
        }
        for text in
            ["", "cube", "card", "card:60", "card:60-0", "card:0-91", "floor:0:1-2", "floor:1.7:5-2", "card:a-b"]
        {
            assert!(text.parse::<Shape>().is_err(), "{text}");
        }
        assert!("card:nan-60".parse::<Shape>().is_err() && "floor:inf:1-2".parse::<Shape>().is_err());
    }
}
