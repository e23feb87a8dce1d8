//! A row of pixels, cut where it crosses from one cell of a region to another.
//!
//! The crossings of a row are known, so that no pixel has to be asked which cell it belongs to.

use std::f64::consts::PI;
use std::ops::Range;

use crate::photo::{Circle, Cylinder};

/// Pixels beside one another that belong to one cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Stretch {
    pub columns: Range<u32>,
    pub cell: usize,
}

impl Stretch {
    /// Cuts columns at every crossing; `cell` tells the cell of a point of the row, `None` where none is.
    pub fn between(columns: Range<u32>, crossings: &[f64], cell: impl Fn(f64) -> Option<usize>) -> Vec<Self> {
        // The first column whose middle lies at a crossing or beyond.
        let first_beyond = |x: &f64| ((x - 0.5).ceil() as u32).clamp(columns.start, columns.end);
        let known = crossings.iter().filter(|x| x.is_finite());
        let mut cuts: Vec<u32> = known.map(first_beyond).chain([columns.start, columns.end]).collect();
        cuts.sort_unstable();
        cuts.dedup();
        let stretch = |cut: &[u32]| {
            let middle = f64::from(cut[0].midpoint(cut[1])) + 0.5;
            cell(middle).map(|cell| Self { columns: cut[0]..cut[1], cell })
        };
        cuts.windows(2).filter_map(stretch).collect()
    }
}

/// Where a row crosses circles of these radii, as shares of a ball's, and the lines between its sectors.
pub(super) fn crossings_of_ball(ball: Circle, rings: &[f64], sectors: usize, y: f64) -> Vec<f64> {
    let down = y - ball.y;
    let of_ring = |rho: &f64| {
        let half = ((rho * ball.radius).powi(2) - down * down).sqrt();
        [ball.x - half, ball.x + half]
    };
    // Sectors lie opposite each other: half as many lines part them, the first along the row. In the row of the
    // centre all the others cross at the centre.
    let lines = sectors / 2;
    let of_line = |line: usize| ball.x + down / (PI * line as f64 / lines as f64).tan();
    rings.iter().flat_map(of_ring).chain((1..lines).map(of_line)).collect()
}

/// Where a row crosses lines along a cylinder at these distances from its axis, as shares of its radius, the axis, and
/// the lines across it between as many stretches of each side as there are `parts` of both.
pub(super) fn crossings_of_cylinder(cylinder: Cylinder, rings: &[f64], parts: usize, y: f64) -> Vec<f64> {
    let [ux, uy] = cylinder.direction();
    let of_distance = |rho: f64| cylinder.x0 + ((y - cylinder.y0) * ux - rho * cylinder.radius) / uy;
    let of_share = |share: f64| cylinder.x0 + (share * cylinder.length() - (y - cylinder.y0) * uy) / ux;
    let across = (parts / 2).max(1);
    let ends_and_between = (0..=across).map(|line| of_share(line as f64 / across as f64));
    let sides = rings.iter().flat_map(|rho| [*rho, -rho]).chain([0.0]);
    sides.map(of_distance).chain(ends_and_between).collect()
}
