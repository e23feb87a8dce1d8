//! A row of neutral patches, laid out between four corners.

use crate::photo::{Area, Card};

/// Corners of a row in turn: the first patch lies between the first and the last of them.
pub(crate) type Corners = [[f64; 2]; 4];

/// The diameter of the disc that is read, over the shorter side of its patch: clear of the edges.
const FILL: f64 = 0.6;

/// The patches of a row, evenly spaced in perspective, as discs in their middles.
pub(crate) fn patches(corners: Corners, reflectances: &[f64]) -> Vec<Card> {
    let count = reflectances.len() as f64;
    let at = |u: f64, v: f64| project(corners, u, v);
    let distance = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| (ax - bx).hypot(ay - by);
    let patch = |(index, &reflectance): (usize, &f64)| {
        let [start, middle, end] = [0.0, 0.5, 1.0].map(|share| (index as f64 + share) / count);
        let (along, across) = (distance(at(start, 0.5), at(end, 0.5)), distance(at(middle, 0.0), at(middle, 1.0)));
        let [x, y] = at(middle, 0.5);
        Card::neutral(Area::disc(x, y, (FILL / 2.0 * along.min(across)).max(1.0)), reflectance)
    };
    reflectances.iter().enumerate().map(patch).collect()
}

/// The corners of a row of patches whose own corners are not known: as wide as their areas say.
pub(crate) fn corners_of(patches: &[Card]) -> Option<Corners> {
    let (first, last) = (patches.first()?.area, patches.last()?.area);
    let ([ax, ay], [bx, by]) = (first.centre(), last.centre());
    let gaps = (patches.len() as f64 - 1.0).max(1.0);
    let (px, py) = ((bx - ax) / gaps, (by - ay) / gaps);
    let pitch = px.hypot(py).max(f64::MIN_POSITIVE);
    let [_, _, width, height] = first.bounds();
    let across = if px.abs() >= py.abs() { height } else { width } / FILL;
    let (nx, ny) = (-py / pitch * across / 2.0, px / pitch * across / 2.0);
    let corner =
        |x: f64, y: f64, along: f64, side: f64| [x + along * px / 2.0 + side * nx, y + along * py / 2.0 + side * ny];
    Some([corner(ax, ay, -1.0, -1.0), corner(bx, by, 1.0, -1.0), corner(bx, by, 1.0, 1.0), corner(ax, ay, -1.0, 1.0)])
}

/// The point of a quadrilateral seen in perspective that is at (u, v) of a square (Heckbert 1989, section 2.2.3);
/// bilinear where the corners are no perspective view of one.
fn project([p0, p1, p2, p3]: Corners, u: f64, v: f64) -> [f64; 2] {
    let sum = |axis: usize| p0[axis] - p1[axis] + p2[axis] - p3[axis];
    let (dx1, dx2, dy1, dy2) = (p1[0] - p2[0], p3[0] - p2[0], p1[1] - p2[1], p3[1] - p2[1]);
    let determinant = dx1 * dy2 - dx2 * dy1;
    let g = (sum(0) * dy2 - sum(1) * dx2) / determinant;
    let h = (dx1 * sum(1) - dy1 * sum(0)) / determinant;
    let is_view = [g, h, g + h].iter().all(|w| w.is_finite() && *w > -1.0);
    let (g, h, twist) = if is_view { (g, h, 0.0) } else { (0.0, 0.0, u * v) };
    let at = |axis: usize| {
        let (a, b) = (p1[axis] - p0[axis] + g * p1[axis], p3[axis] - p0[axis] + h * p3[axis]);
        (a * u + b * v + p0[axis] + twist * sum(axis)) / (g * u + h * v + 1.0)
    };
    [at(0), at(1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROW: Corners = [[10.0, 20.0], [130.0, 20.0], [130.0, 50.0], [10.0, 50.0]];

    #[test]
    fn a_row_seen_straight_is_evenly_spaced() {
        let patches = patches(ROW, &Card::COLOR_CHECKER_NEUTRALS);
        for (index, patch) in patches.iter().enumerate() {
            assert_eq!(patch.area.centre(), [20.0 + 20.0 * index as f64, 35.0]);
            assert_eq!(patch.reflectance, Card::COLOR_CHECKER_NEUTRALS[index]);
        }
        assert_eq!(patches[0].area, Area::disc(20.0, 35.0, 6.0));
    }

    /// Corners are met, and the diagonals of a perspective view cross in the middle of the square.
    #[test]
    fn perspective_keeps_corners_and_diagonals() {
        let corners = [[0.0, 0.0], [100.0, 10.0], [90.0, 60.0], [5.0, 80.0]];
        let unit = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        for (corner, [u, v]) in corners.into_iter().zip(unit) {
            let [x, y] = project(corners, u, v);
            assert!((x - corner[0]).abs() < 1e-9 && (y - corner[1]).abs() < 1e-9);
        }
        let [x, y] = project(corners, 0.5, 0.5);
        let off = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| (bx - ax) * (y - ay) - (by - ay) * (x - ax);
        assert!(off(corners[0], corners[2]).abs() < 1e-9 && off(corners[1], corners[3]).abs() < 1e-9);
    }

    #[test]
    fn crossed_corners_still_give_numbers() {
        let crossed = [[0.0, 0.0], [100.0, 0.0], [0.0, 50.0], [100.0, 50.0]];
        let patches = patches(crossed, &Card::COLOR_CHECKER_NEUTRALS);
        assert!(patches.iter().all(|patch| patch.area.bounds().iter().all(|v| v.is_finite())));
    }

    #[test]
    fn the_corners_of_a_row_lay_it_out_again() {
        for corners in [ROW, [[20.0, 10.0], [20.0, 130.0], [50.0, 130.0], [50.0, 10.0]]] {
            let row = patches(corners, &Card::COLOR_CHECKER_NEUTRALS);
            let again = patches(corners_of(&row).unwrap(), &Card::COLOR_CHECKER_NEUTRALS);
            for (a, b) in row.iter().zip(&again) {
                let ([ax, ay], [bx, by]) = (a.area.centre(), b.area.centre());
                assert!((ax - bx).hypot(ay - by) < 1e-9);
            }
        }
        assert_eq!(corners_of(&[]), None);
    }
}
