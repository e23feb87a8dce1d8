//! The outline of a cylinder, found to a fraction of a pixel.
//!
//! Across a roughly placed axis the steepest steps of brightness on both sides are candidates; two parallel
//! lines through three of them that most others agree with are refined by robust least squares. What widens
//! along the axis says whether the edges converge. In the end the brightness across the edges is fitted, as that of a
//! ball is ([`super::rim`]).

use nalgebra::{SMatrix, SVector};
use serde::Serialize;

use super::outline::{
    FARTHEST_FROM_STEEPEST_PX, FIRST_BLUR_PX, INLIER_PX, INLIER_SHARE, LEAST_SUPPORT, RIM_ROUNDS,
    STEEPEST_UNCERTAINTY_PX, Sequence, steepest_steps,
};
use super::rim::fit_rim;
use super::{Body, Cylinder, OutlineError, Photo, Warning, WarningCode};

/// A fitted outline of a cylinder.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CylinderOutline {
    /// The cylinder; the ends of its axis stay where they were marked.
    pub cylinder: Cylinder,
    /// Standard uncertainty of its radius in pixels.
    pub uncertainty_px: f64,
    /// Change of the radius from one end to the other, over the radius; 0 for parallel edges.
    pub taper: f64,
    /// Share of the stations whose edges lie on it.
    pub support: f64,
}

impl CylinderOutline {
    /// The ± of the radius: its expanded uncertainty with coverage factor 2, about 95 %.
    pub fn plus_minus_px(&self) -> f64 {
        2.0 * self.uncertainty_px
    }

    /// Edges that converge: perspective, or no cylinder.
    pub fn warning(&self) -> Option<Warning> {
        /// What a camera held a little askew gives; the radius is then off by half of it at the ends.
        const TAPER_LIMIT: f64 = 0.02;
        (self.taper.abs() > TAPER_LIMIT).then(|| {
            let message = format!(
                "The edges converge, the cylinder is {:.1} % wider at one end: hold the camera square to it, or it is \
                 no cylinder.",
                100.0 * self.taper.abs()
            );
            Warning::new(WarningCode::Geometry, message)
        })
    }
}

/// Places along the axis at which edges are looked for.
const STATIONS: usize = 120;

/// Snaps a roughly placed cylinder to the edges nearest to it: within a fifth of its radius.
pub fn snap_cylinder(photo: &Photo, rough: Cylinder) -> Result<CylinderOutline, OutlineError> {
    steepest_cylinder(photo, rough).map(|edges| on_the_rim(photo, edges))
}

/// The cylinder between the steepest steps nearest to a rough one: up to half a pixel inside the outline of a metal.
pub(super) fn steepest_cylinder(photo: &Photo, rough: Cylinder) -> Result<CylinderOutline, OutlineError> {
    let first = fit_edges(&candidates(photo, rough, 0.2), rough).ok_or(OutlineError::NoCylinder)?;
    // Again across the axis that was found, where lines cross the edges at right angles.
    fit_edges(&candidates(photo, first.cylinder, 0.1), first.cylinder).ok_or(OutlineError::NoCylinder)
}

/// Moves the edges of steepest steps to where the metal ends.
fn on_the_rim(photo: &Photo, steepest: CylinderOutline) -> CylinderOutline {
    let rim = rim_of(photo, steepest.cylinder).filter(|(cylinder, _)| {
        let moved = steepest.cylinder.corners().into_iter().zip(cylinder.corners());
        moved.map(|([ax, ay], [bx, by])| (ax - bx).hypot(ay - by)).all(|moved| moved < FARTHEST_FROM_STEEPEST_PX)
    });
    match rim {
        Some((cylinder, uncertainty_px)) => CylinderOutline { cylinder, uncertainty_px, ..steepest },
        None => CylinderOutline { uncertainty_px: steepest.uncertainty_px.hypot(STEEPEST_UNCERTAINTY_PX), ..steepest },
    }
}

/// The cylinder of the rims near another, and the uncertainty of its radius.
fn rim_of(photo: &Photo, near: Cylinder) -> Option<(Cylinder, f64)> {
    let (mut cylinder, mut blur_px, mut uncertainty_px) = (near, FIRST_BLUR_PX, f64::NAN);
    for _ in 0..RIM_ROUNDS {
        let outwards = |x: f64, y: f64| {
            let ([ux, uy], [right, down]) = (cylinder.direction(), cylinder.offset(x, y));
            let side = (ux * down - uy * right).signum();
            [side, side * (cylinder.along(x, y) - 0.5)]
        };
        let rim = fit_rim(photo, Body::Cylinder(cylinder), blur_px, &outwards)?;
        let [radius, offset, slope] = rim.change;
        cylinder = beside(cylinder, Lines { offset, slope, radius: cylinder.radius + radius });
        (blur_px, uncertainty_px) = (rim.blur_px, rim.uncertainty_px);
    }
    (cylinder.radius > 1.0).then_some((cylinder, uncertainty_px))
}

/// A step of brightness on a line across the axis.
#[derive(Clone, Copy, Debug)]
struct Edge {
    station: usize,
    /// Along the axis: −½ at its first end, ½ at the other.
    along: f64,
    /// 1 on the right of the axis, −1 on its left.
    side: f64,
    /// Across the axis in pixels, to the right.
    across: f64,
}

fn candidates(photo: &Photo, rough: Cylinder, reach: f64) -> Vec<Edge> {
    let half_width = (rough.radius * reach).max(4.0);
    let ([ux, uy], length) = (rough.direction(), rough.length());
    let place = move |station: usize| (station as f64 + 0.5) / STATIONS as f64;
    let of_line = |station: usize, side: f64| {
        let (x, y) = (rough.x0 + ux * length * place(station), rough.y0 + uy * length * place(station));
        let stretch = rough.radius - half_width..rough.radius + half_width;
        let steps = steepest_steps(photo, stretch, |distance| (x - uy * side * distance, y + ux * side * distance));
        steps.into_iter().map(move |distance| Edge {
            station,
            along: place(station) - 0.5,
            side,
            across: side * distance,
        })
    };
    (0..STATIONS).flat_map(|station| [-1.0, 1.0].map(|side| of_line(station, side))).flatten().collect()
}

/// Two parallel lines beside the rough axis: across = offset + slope · along ± radius.
#[derive(Clone, Copy, Debug)]
struct Lines {
    offset: f64,
    slope: f64,
    radius: f64,
}

impl Lines {
    fn residual(self, edge: Edge) -> f64 {
        edge.across - self.offset - self.slope * edge.along - self.radius * edge.side
    }

    /// Through two edges of one side and one of the other.
    fn through(edges: [Edge; 3]) -> Option<Self> {
        let matrix = SMatrix::<f64, 3, 3>::from_rows(&edges.map(|edge| SVector::from(row(edge)).transpose()));
        let right = SVector::<f64, 3>::from(edges.map(|edge| edge.across));
        let solution = matrix.lu().solve(&right)?;
        Some(Self::of(solution)).filter(|lines| lines.radius.is_finite() && lines.slope.is_finite())
    }

    fn of(solution: SVector<f64, 3>) -> Self {
        Self { offset: solution[0], slope: solution[1], radius: solution[2] }
    }
}

fn row(edge: Edge) -> [f64; 3] {
    [1.0, edge.along, edge.side]
}

/// RANSAC (Fischler & Bolles 1981) over a fixed sequence of triples, then robust least squares.
fn fit_edges(edges: &[Edge], rough: Cylinder) -> Option<CylinderOutline> {
    const TRIPLES: usize = 600;
    if edges.len() < 12 {
        return None;
    }
    let limit = INLIER_PX.max(INLIER_SHARE * rough.radius);
    let mut sequence = Sequence::default();
    let mut pick = || edges[sequence.below(edges.len())];
    let lines = (0..TRIPLES).filter_map(|_| Lines::through([pick(), pick(), pick()]));
    let near = lines.filter(|lines| (0.7..1.4).contains(&(lines.radius / rough.radius)));
    let best = near.max_by_key(|lines| support(edges, *lines, limit))?;
    let lines = refined(edges, best, limit)?;
    let supporting = support(edges, lines, limit);
    let share = supporting as f64 / (2 * STATIONS) as f64;
    if share < LEAST_SUPPORT || lines.radius < 1.0 {
        return None;
    }
    // Neighbouring stations share pixels: about one independent edge for each two pixels of both edges, at most.
    let independent = (supporting as f64).min(share * rough.length());
    let uncertainty_px = (scatter(edges, lines, limit) / independent.max(1.0).sqrt()).hypot(0.05);
    let taper = taper(edges, lines, limit);
    Some(CylinderOutline { cylinder: beside(rough, lines), uncertainty_px, taper, support: share })
}

/// Sides of stations with an edge on the lines.
fn support(edges: &[Edge], lines: Lines, limit: f64) -> usize {
    let mut sides = [[false; 2]; STATIONS];
    for edge in edges.iter().filter(|edge| lines.residual(**edge).abs() < limit) {
        sides[edge.station][usize::from(edge.side > 0.0)] = true;
    }
    sides.iter().flatten().filter(|is_hit| **is_hit).count()
}

/// Least squares with Tukey's biweight at `limit`; what is left is linear in all three unknowns.
fn refined(edges: &[Edge], start: Lines, limit: f64) -> Option<Lines> {
    const ROUNDS: usize = 12;
    let mut lines = start;
    for _ in 0..ROUNDS {
        let (mut normal, mut right) = (SMatrix::<f64, 3, 3>::zeros(), SVector::<f64, 3>::zeros());
        for edge in edges {
            let share = (lines.residual(*edge) / limit).powi(2);
            if share < 1.0 {
                let (row, weight) = (SVector::from(row(*edge)), (1.0 - share).powi(2));
                normal += row * row.transpose() * weight;
                right += row * (edge.across * weight);
            }
        }
        lines = Lines::of(normal.cholesky()?.solve(&right));
    }
    Some(lines)
}

fn scatter(edges: &[Edge], lines: Lines, limit: f64) -> f64 {
    let errors = edges.iter().map(|edge| lines.residual(*edge)).filter(|error| error.abs() < limit);
    let (squares, count) = errors.fold((0.0, 0.0), |(squares, count), error| (squares + error * error, count + 1.0));
    if count > 1.0 { f64::sqrt(squares / count) } else { limit }
}

/// Change of the radius over the whole stretch: the slope of side · residual along the axis. Edges that converge
/// leave the inliers of parallel lines, so that the nearest within a tenth of the radius count.
fn taper(edges: &[Edge], lines: Lines, limit: f64) -> f64 {
    let reach = limit.max(0.1 * lines.radius);
    let mut nearest = [[None::<Edge>; 2]; STATIONS];
    for edge in edges.iter().filter(|edge| lines.residual(**edge).abs() < reach) {
        let best = &mut nearest[edge.station][usize::from(edge.side > 0.0)];
        if best.is_none_or(|other| lines.residual(*edge).abs() < lines.residual(other).abs()) {
            *best = Some(*edge);
        }
    }
    let edges: Vec<Edge> = nearest.into_iter().flatten().flatten().collect();
    let mean = edges.iter().map(|edge| edge.along).sum::<f64>() / edges.len().max(1) as f64;
    let (product, square) = edges.iter().fold((0.0, 0.0), |(product, square), edge| {
        let along = edge.along - mean;
        (product + along * edge.side * lines.residual(*edge), square + along * along)
    });
    if square > 0.0 { product / square / lines.radius } else { 0.0 }
}

/// The cylinder of lines that were measured beside a rough one.
fn beside(rough: Cylinder, lines: Lines) -> Cylinder {
    let [ux, uy] = rough.direction();
    let moved = |x: f64, y: f64, along: f64| {
        let across = lines.offset + lines.slope * along;
        [x - uy * across, y + ux * across]
    };
    // Across a turned axis a line is shorter by the cosine of the turn.
    let radius = lines.radius / (lines.slope / rough.length()).hypot(1.0);
    Cylinder::new(moved(rough.x0, rough.y0, -0.5), moved(rough.x1, rough.y1, 0.5), radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A soft-edged strip of brightness 0.7 on 0.2 along an axis, its half width `radius` at the first end and wider by
    /// `taper` of it at the other.
    fn strip(axis: Cylinder, taper: f64) -> Photo {
        let pixel = |x: u32, y: u32| {
            let (x, y) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            let [right, down] = axis.offset(x, y);
            let half_width = axis.radius * (1.0 + taper * (axis.along(x, y) - 0.5));
            let inside = (half_width - right.hypot(down) * axis.radius + 0.5).clamp(0.0, 1.0);
            [(0.2 + 0.5 * inside) as f32; 3]
        };
        let pixels = (0..200).flat_map(|y| (0..240).map(move |x| pixel(x, y))).collect();
        Photo::from_linear("strip", 240, 200, pixels)
    }

    const AXIS: Cylinder = Cylinder::new([30.0, 80.0], [210.0, 110.0], 40.4);

    #[test]
    fn snaps_to_a_fraction_of_a_pixel() {
        let rough = Cylinder::new([30.0, 84.0], [210.0, 104.0], 36.0);
        let found = snap_cylinder(&strip(AXIS, 0.0), rough).unwrap();
        assert!((found.cylinder.radius - 40.4).abs() < 0.1, "{found:?}");
        for (x, y) in [(30.0, 80.0), (210.0, 110.0)] {
            let [right, down] = found.cylinder.offset(x, y);
            assert!(right.hypot(down) * found.cylinder.radius < 0.15, "{found:?}");
        }
        assert!(found.uncertainty_px < 0.2 && found.support > 0.9 && found.warning().is_none(), "{found:?}");
    }

    #[test]
    fn edges_that_converge_are_seen() {
        let found = snap_cylinder(&strip(AXIS, 0.06), AXIS).unwrap();
        assert!((found.taper - 0.06).abs() < 0.01, "{found:?}");
        assert_eq!(found.warning().unwrap().code, WarningCode::Geometry);
    }

    #[test]
    fn no_edges_are_said() {
        let grey = Photo::from_linear("grey", 240, 200, vec![[0.5; 3]; 48_000]);
        assert_eq!(snap_cylinder(&grey, AXIS), Err(OutlineError::NoCylinder));
    }
}
