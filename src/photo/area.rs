//! A marked part of a picture.

use std::{fmt, ops::Range, str::FromStr};

use serde::{Deserialize, Serialize};

use super::Circle;
use super::mark::{MarkError, numbers, positive};

/// A box or a disc in pixel coordinates; a pixel belongs to it when its centre does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "shape", rename_all = "kebab-case")]
pub enum Area {
    /// A rectangle.
    Box {
        /// Left edge.
        x: f64,
        /// Top edge.
        y: f64,
        /// Width in pixels.
        width: f64,
        /// Height in pixels.
        height: f64,
    },
    /// A disc.
    Disc {
        /// Horizontal position of the centre.
        x: f64,
        /// Vertical position of the centre.
        y: f64,
        /// Radius in pixels.
        radius: f64,
    },
}

impl Area {
    /// A rectangle from its top left corner.
    pub const fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self::Box { x, y, width, height }
    }

    /// A disc around a point.
    pub const fn disc(x: f64, y: f64, radius: f64) -> Self {
        Self::Disc { x, y, radius }
    }

    /// True when a point lies inside.
    pub fn contains(self, px: f64, py: f64) -> bool {
        match self {
            Self::Box { x, y, width, height } => (x..x + width).contains(&px) && (y..y + height).contains(&py),
            Self::Disc { x, y, radius } => (px - x).hypot(py - y) <= radius,
        }
    }

    /// The smallest rectangle around it: `[left, top, width, height]`.
    pub fn bounds(self) -> [f64; 4] {
        match self {
            Self::Box { x, y, width, height } => [x, y, width, height],
            Self::Disc { x, y, radius } => [x - radius, y - radius, 2.0 * radius, 2.0 * radius],
        }
    }

    /// The middle.
    pub fn centre(self) -> [f64; 2] {
        let [x, y, width, height] = self.bounds();
        [x + width / 2.0, y + height / 2.0]
    }

    /// The same shape elsewhere.
    pub fn moved_by(self, dx: f64, dy: f64) -> Self {
        match self {
            Self::Box { x, y, width, height } => Self::Box { x: x + dx, y: y + dy, width, height },
            Self::Disc { x, y, radius } => Self::Disc { x: x + dx, y: y + dy, radius },
        }
    }

    /// True when all of it lies inside a picture of this size.
    pub fn is_inside(self, width: u32, height: u32) -> bool {
        let [x, y, w, h] = self.bounds();
        x >= 0.0 && y >= 0.0 && x + w <= f64::from(width) && y + h <= f64::from(height)
    }

    /// The columns of each row of a picture whose pixels' centres lie inside: neither shape has a gap in a row.
    pub(super) fn rows(self, width: u32, height: u32) -> impl Iterator<Item = (u32, Range<u32>)> {
        let [_, y, _, h] = self.bounds();
        pixel_range(y, h, height).map(move |row| (row, self.columns(row, width)))
    }

    /// The same of one row.
    pub(super) fn columns(self, row: u32, width: u32) -> Range<u32> {
        let [x, _, w, _] = self.bounds();
        let columns = pixel_range(x, w, width);
        let is_inside = |column: &u32| self.contains(f64::from(*column) + 0.5, f64::from(row) + 0.5);
        let start = columns.clone().find(is_inside).unwrap_or(columns.end);
        let end = columns.clone().rev().find(is_inside).map_or(start, |last| last + 1);
        start..end
    }

    /// The pixels of a picture whose centre lies inside, row by row.
    pub(super) fn pixels(self, width: u32, height: u32) -> impl Iterator<Item = (u32, u32)> {
        self.rows(width, height).flat_map(|(row, columns)| columns.map(move |column| (column, row)))
    }

    /// At least as many pixels of a picture as lie inside.
    pub(super) fn most_pixels(self, width: u32, height: u32) -> usize {
        let [x, y, w, h] = self.bounds();
        pixel_range(x, w, width).len() * pixel_range(y, h, height).len()
    }
}

impl From<Circle> for Area {
    fn from(Circle { x, y, radius }: Circle) -> Self {
        Self::Disc { x, y, radius }
    }
}

/// The whole pixels a stretch may touch, cut at the picture's ends.
pub(super) fn pixel_range(start: f64, size: f64, picture_size: u32) -> Range<u32> {
    let limit = f64::from(picture_size);
    start.floor().clamp(0.0, limit) as u32..(start + size).ceil().clamp(0.0, limit) as u32
}

impl fmt::Display for Area {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Box { x, y, width, height } => write!(f, "{x},{y},{width},{height}"),
            Self::Disc { x, y, radius } => write!(f, "{x},{y},{radius}"),
        }
    }
}

impl FromStr for Area {
    type Err = MarkError;

    fn from_str(text: &str) -> Result<Self, MarkError> {
        match numbers(text).as_deref() {
            Some(&[x, y, width, height]) => Ok(Self::Box {
                x,
                y,
                width: positive(text, "width", width)?,
                height: positive(text, "height", height)?,
            }),
            Some(&[x, y, radius]) => Ok(Self::Disc { x, y, radius: positive(text, "radius", radius)? }),
            _ => Err(MarkError::form(text, "area", "x,y,width,height or x,y,radius in pixels")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_it_writes() {
        for area in [Area::rectangle(1.0, 2.0, 3.5, 4.0), Area::disc(-1.0, 2.0, 3.0)] {
            assert_eq!(area.to_string().parse(), Ok(area));
            let json = serde_json::to_string(&area).unwrap();
            assert_eq!(serde_json::from_str::<Area>(&json).unwrap(), area);
        }
    }

    #[test]
    fn says_what_is_wrong() {
        for text in ["", "1,2", "1,2,3,4,5", "a,b,c,d"] {
            assert!(text.parse::<Area>().unwrap_err().to_string().contains("x,y,width,height"), "{text}");
        }
        assert!("1,2,-3,4".parse::<Area>().unwrap_err().to_string().contains("width"));
    }

    #[test]
    fn holds_the_pixels_whose_centre_is_inside() {
        let pixels = |area: Area| area.pixels(10, 10).collect::<Vec<_>>();
        assert_eq!(pixels(Area::rectangle(1.0, 2.0, 2.0, 1.0)), [(1, 2), (2, 2)]);
        assert_eq!(pixels(Area::rectangle(1.6, 2.0, 1.0, 1.0)), [(2, 2)]);
        assert_eq!(pixels(Area::disc(5.0, 5.0, 0.8)).len(), 4);
        assert_eq!(pixels(Area::rectangle(-5.0, -5.0, 100.0, 100.0)).len(), 100);
        assert_eq!(pixels(Area::rectangle(20.0, 20.0, 5.0, 5.0)), []);
    }
}
