//! Whether the metal mirrors anything sharply.
//!
//! A rough metal shows every lamp as a soft glow, and each of its pixels is a mean over many angles. In even light that
//! cannot be seen; where something is mirrored, the width of its edges tells.

use rayon::prelude::*;

use super::view::View;
use crate::photo::Body;

/// What is mirrored within 49° shows some of the surroundings, and the rim none of its own steps.
const FACING_SINE: f64 = 0.75;
/// Between cells so far apart a mirrored edge is sharp, over the radius: 1.4° of the surroundings.
const CELL: f64 = 0.012;
/// Between cells so far apart the glow of a rough metal has changed, too.
const FAR_CELLS: usize = 5;
/// A change of less than this over the mean says nothing.
const LEAST_CHANGE: f64 = 0.15;
/// Where a sharp edge is mirrored, nearly all of the change lies between near cells; in a glow less than this share.
const SHARP_SHARE: f64 = 0.5;

/// True when the surroundings that a body mirrors change, but nowhere at an edge.
pub(super) fn is_blurred(view: &View, body: Body) -> bool {
    let cells = Cells::of(view, body);
    let (Some(near), Some(far)) = (cells.largest_change(1), cells.largest_change(FAR_CELLS)) else { return false };
    far > LEAST_CHANGE && near < SHARP_SHARE * far
}

/// Brightness over its mean, on a square grid; NaN where the body is not seen.
struct Cells {
    width: usize,
    values: Vec<f64>,
}

impl Cells {
    fn of(view: &View, body: Body) -> Self {
        /// Of a pixel or less each cell would be noise.
        const LEAST_PX: f64 = 1.5;
        let side = (CELL * body.radius()).max(LEAST_PX);
        let [x, y, width, height] = body.bounds();
        let [columns, rows] = [width, height].map(|size| (size / side) as usize);
        let cell = |index: usize| {
            let middle = |start: f64, index: usize| start + (index as f64 + 0.5) * side;
            let (x, y) = (middle(x, index % columns), middle(y, index / columns));
            body.sine(x, y).filter(|sine| *sine < FACING_SINE).map_or(f64::NAN, |_| brightness(view, x, y, side))
        };
        let values: Vec<f64> = (0..columns * rows).into_par_iter().map(cell).collect();
        let (sum, count) = values
            .iter()
            .filter(|value| value.is_finite())
            .fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
        let mean = sum / f64::from(count);
        Self { width: columns, values: values.into_iter().map(|value| value / mean).collect() }
    }

    /// The largest change between two cells on either side of a third, but for a few: dust is small.
    fn largest_change(&self, cells: usize) -> Option<f64> {
        const DUST: usize = 8;
        let rows = || self.values.chunks(self.width.max(1));
        let along = rows().flat_map(|row| row.iter().zip(row.get(2 * cells..).unwrap_or_default()));
        let down = self.values.iter().zip(self.values.get(2 * cells * self.width..).unwrap_or_default());
        let changes = along.chain(down).map(|(before, after)| (after - before).abs());
        let mut changes: Vec<f64> = changes.filter(|change| change.is_finite()).collect();
        let index = changes.len().checked_sub(DUST + 1)?;
        Some(*changes.select_nth_unstable_by(index, f64::total_cmp).1)
    }
}

/// The mean brightness of two points of a cell.
fn brightness(view: &View, x: f64, y: f64, side: f64) -> f64 {
    let quarter = side / 4.0;
    let points = [(-1.0, -1.0), (1.0, 1.0)];
    let at = |(right, down): (f64, f64)| {
        let (column, row) = (x + right * quarter, y + down * quarter);
        let is_inside = column >= 0.0 && row >= 0.0;
        let pixel = is_inside.then(|| view.pixel(column as u32, row as u32)).flatten();
        pixel.filter(|pixel| !pixel.flags.non_finite).map_or(f64::NAN, |pixel| pixel.rgb.0.iter().sum::<f64>() / 3.0)
    };
    points.into_iter().map(at).sum::<f64>() / points.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::{Circle, MatchRequest, Photo};

    const BALL: Circle = Circle::new(128.0, 128.0, 120.0);

    /// A ball that mirrors an edge which is `width` radii wide, of a height over the mean.
    fn is_blurred_at(width: f64, height: f64) -> bool {
        let value = |x: u32| {
            let across = (f64::from(x) + 0.5 - BALL.x) / BALL.radius;
            [(0.4 + 0.4 * height * ((across / width).clamp(-0.5, 0.5))) as f32; 3]
        };
        let pixels = (0..256 * 256).map(|index| value(index % 256)).collect();
        let photo = Photo::from_linear("edge", 256, 256, pixels);
        let view = View::of(&photo, &MatchRequest::default()).unwrap();
        is_blurred(&view, Body::Ball(BALL))
    }

    #[test]
    fn a_glow_is_told_from_an_edge_and_from_an_even_change() {
        assert!(is_blurred_at(0.15, 1.0));
        assert!(!is_blurred_at(0.01, 1.0), "an edge is sharp");
        assert!(!is_blurred_at(0.15, 0.1), "a faint change says nothing");
        assert!(!is_blurred_at(2.0, 0.6), "nor does a tent that is brighter on one side");
    }
}
