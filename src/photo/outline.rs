//! The outline of a ball, found to a fraction of a pixel.
//!
//! Along rays from a rough centre the steepest steps of brightness are candidates; a circle through
//! three of them that most others agree with is refined by a robust geometric fit. What is left over
//! twice around the circle says whether the outline is an ellipse. The steepest step lies inside the
//! outline of a metal, so that in the end the brightness across the edge is fitted ([`super::rim`]).

use std::ops::Range;

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use serde::Serialize;
use thiserror::Error;

use super::brightness::Brightness;
use super::rim::fit_rim;
use super::{Body, Circle, Photo, Warning, WarningCode};

/// A fitted outline.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Outline {
    /// The circle.
    pub circle: Circle,
    /// Standard uncertainty of its radius in pixels.
    pub uncertainty_px: f64,
    /// Half the difference between the longest and the shortest radius, over the radius; 0 for a circle.
    pub ellipticity: f64,
    /// Share of the rays whose edge lies on it.
    pub support: f64,
}

impl Outline {
    /// The ± of the radius: its expanded uncertainty with coverage factor 2, about 95 %.
    pub fn plus_minus_px(&self) -> f64 {
        2.0 * self.uncertainty_px
    }

    /// An outline longer one way than the other: perspective, or no ball.
    pub fn warning(&self) -> Option<Warning> {
        /// A wide-angle view of a ball reaches this some way off the axis.
        const ELLIPTICITY_LIMIT: f64 = 0.015;
        (self.ellipticity > ELLIPTICITY_LIMIT).then(|| {
            let message = format!(
                "The outline is an ellipse, {:.1} % longer one way: move the camera back, or it is no ball.",
                200.0 * self.ellipticity
            );
            Warning::new(WarningCode::Geometry, message)
        })
    }
}

/// Why no outline was found.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum OutlineError {
    /// Too few edges agree on a circle.
    #[error("no round outline was found there: place the circle closer to the ball's edge")]
    NoCircle,
    /// Too few edges agree on two parallel lines.
    #[error("no two parallel edges were found there: place the cylinder closer to its edges")]
    NoCylinder,
    /// The picture shows no ball at all.
    #[error("no ball was found in the picture: mark it with a circle")]
    NoBall,
}

const RAYS: usize = 360;
/// Candidates kept for each ray: reflections inside a ball make edges, too.
const CANDIDATES: usize = 3;
/// A ray supports a circle within this many pixels, or this share of its radius if that is more.
pub(super) const INLIER_PX: f64 = 1.5;
pub(super) const INLIER_SHARE: f64 = 0.006;
/// Fewer supporting rays than this are no outline.
pub(super) const LEAST_SUPPORT: f64 = 0.35;

/// Snaps a roughly placed circle to the edge nearest to it: within a fifth of its radius.
pub fn snap_circle(photo: &Photo, rough: Circle) -> Result<Outline, OutlineError> {
    steepest_circle(photo, rough).map(|edge| on_the_rim(photo, edge))
}

/// The circle of the steepest steps nearest to a rough one: up to half a pixel inside the outline of a metal.
pub(super) fn steepest_circle(photo: &Photo, rough: Circle) -> Result<Outline, OutlineError> {
    const REACH: f64 = 0.2;
    let first = fit_edges(&candidates(photo, rough, REACH), rough).ok_or(OutlineError::NoCircle)?;
    // Again from the found centre, where rays cross the edge at right angles.
    fit_edges(&candidates(photo, first.circle, 0.1), first.circle).ok_or(OutlineError::NoCircle)
}

/// How far the outline may lie from the steepest steps, in pixels; what is farther is the edge of something else.
pub(super) const FARTHEST_FROM_STEEPEST_PX: f64 = 1.5;
/// Standard uncertainty of a radius that rests on the steepest steps alone, in pixels.
pub(super) const STEEPEST_UNCERTAINTY_PX: f64 = 0.5;
/// The fit of a rim is repeated from where it has led: depths are counted from there.
pub(super) const RIM_ROUNDS: usize = 2;
/// The blur a fit of a rim starts with, in pixels.
pub(super) const FIRST_BLUR_PX: f64 = 0.5;

/// Moves a circle of steepest steps to where the metal ends.
fn on_the_rim(photo: &Photo, steepest: Outline) -> Outline {
    let rim = rim_of(photo, steepest.circle).filter(|(circle, _)| {
        let Circle { x, y, radius } = steepest.circle;
        let moved = (circle.radius - radius).abs() + (circle.x - x).hypot(circle.y - y);
        moved < FARTHEST_FROM_STEEPEST_PX
    });
    match rim {
        Some((circle, uncertainty_px)) => Outline { circle, uncertainty_px, ..steepest },
        None => Outline { uncertainty_px: steepest.uncertainty_px.hypot(STEEPEST_UNCERTAINTY_PX), ..steepest },
    }
}

/// The circle of the rim near another, and the uncertainty of its radius.
fn rim_of(photo: &Photo, near: Circle) -> Option<(Circle, f64)> {
    let (mut circle, mut blur_px, mut uncertainty_px) = (near, FIRST_BLUR_PX, f64::NAN);
    for _ in 0..RIM_ROUNDS {
        let outwards = |x: f64, y: f64| {
            let (right, down) = (x - circle.x, y - circle.y);
            [right / right.hypot(down), down / right.hypot(down)]
        };
        let rim = fit_rim(photo, Body::Ball(circle), blur_px, &outwards)?;
        let [radius, x, y] = rim.change;
        circle = Circle::new(circle.x + x, circle.y + y, circle.radius + radius);
        (blur_px, uncertainty_px) = (rim.blur_px, rim.uncertainty_px);
    }
    (circle.radius > 1.0).then_some((circle, uncertainty_px))
}

/// A step of brightness on a ray.
#[derive(Clone, Copy, Debug)]
struct Edge {
    x: f64,
    y: f64,
    ray: usize,
}

/// The steepest steps of each ray within `reach` of the circle's radius.
fn candidates(photo: &Photo, circle: Circle, reach: f64) -> Vec<Edge> {
    let half_width = (circle.radius * reach).max(4.0);
    (0..RAYS).flat_map(|ray| edges_on_ray(photo, circle, ray, half_width)).collect()
}

fn edges_on_ray(photo: &Photo, circle: Circle, ray: usize, half_width: f64) -> Vec<Edge> {
    let (sin, cos) = (std::f64::consts::TAU * ray as f64 / RAYS as f64).sin_cos();
    let point = |r: f64| (circle.x + r * cos, circle.y + r * sin);
    let stretch = circle.radius - half_width..circle.radius + half_width;
    let edge = |r: f64| Edge { x: point(r).0, y: point(r).1, ray };
    steepest_steps(photo, stretch, point).into_iter().map(edge).collect()
}

/// Where on a stretch of a line, in pixels, brightness changes most; the steepest first, at most [`CANDIDATES`].
pub(super) fn steepest_steps(photo: &Photo, stretch: Range<f64>, point: impl Fn(f64) -> (f64, f64)) -> Vec<f64> {
    const STEP_PX: f64 = 0.5;
    let steps = ((stretch.end - stretch.start) / STEP_PX) as usize;
    let position = |step: f64| stretch.start + step * STEP_PX;
    let mut brightness = Brightness::of(photo);
    let profile: Vec<Option<f64>> = (0..=steps).map(|step| brightness.at(point(position(step as f64)))).collect();
    // The slope over ± 1 px: as wide as a lens is sharp, so that the peak of the slope is the edge.
    let slope = |step: usize| {
        let (before, after) = (step.checked_sub(2)?, step + 2);
        Some((profile.get(after).copied()?? - profile[before]?).abs())
    };
    let slopes: Vec<f64> = (0..=steps).map(|step| slope(step).unwrap_or(0.0)).collect();
    let is_peak = |step: &usize| slopes[*step] > slopes[step - 1] && slopes[*step] >= slopes[step + 1];
    let mut peaks: Vec<usize> = (1..steps).filter(is_peak).filter(|&step| slopes[step] > 0.01).collect();
    peaks.sort_by(|a, b| slopes[*b].total_cmp(&slopes[*a]));
    peaks
        .into_iter()
        .take(CANDIDATES)
        .map(|step| position(step as f64 + parabola_peak([slopes[step - 1], slopes[step], slopes[step + 1]])))
        .collect()
}

/// Where a parabola through three equal steps peaks, relative to the middle one.
fn parabola_peak([before, at, after]: [f64; 3]) -> f64 {
    let curvature = before - 2.0 * at + after;
    if curvature < 0.0 { (0.5 * (before - after) / curvature).clamp(-0.5, 0.5) } else { 0.0 }
}

/// RANSAC (Fischler & Bolles 1981) over a fixed sequence of triples, then the geometric fit.
fn fit_edges(edges: &[Edge], rough: Circle) -> Option<Outline> {
    const TRIPLES: usize = 1000;
    /// Reflections near the rim make rings, too, but inside: of circles about as well supported, the largest is the
    /// outline.
    const ABOUT_AS_WELL: f64 = 0.85;
    if edges.len() < 12 {
        return None;
    }
    let limit = INLIER_PX.max(INLIER_SHARE * rough.radius);
    let mut sequence = Sequence::default();
    let mut pick = || edges[sequence.below(edges.len())];
    let circles = (0..TRIPLES).filter_map(|_| circle_through([pick(), pick(), pick()]));
    let near = circles.filter(|circle| is_near(*circle, rough));
    let supported: Vec<(usize, Circle)> = near.map(|circle| (support(edges, circle, limit), circle)).collect();
    let enough = ABOUT_AS_WELL * supported.iter().map(|(support, _)| *support).max()? as f64;
    let good = supported.into_iter().filter(|(support, _)| *support as f64 >= enough).map(|(_, circle)| circle);
    let outermost = good.max_by(|a, b| a.radius.total_cmp(&b.radius))?;
    let circle = geometric_fit(edges, outermost, limit)?;
    let supporting = support(edges, circle, limit);
    let share = supporting as f64 / RAYS as f64;
    if share < LEAST_SUPPORT {
        return None;
    }
    let (scatter, ellipticity) = leftover(edges, circle, limit);
    // Neighbouring rays share pixels: about one independent edge for each pixel of the outline, at most.
    let independent = (supporting as f64).min(share * std::f64::consts::TAU * circle.radius / 2.0);
    let uncertainty_px = (scatter / independent.sqrt()).hypot(0.05);
    Some(Outline { circle, uncertainty_px, ellipticity, support: share })
}

/// A linear congruential sequence (Knuth, MMIX): the same picks for the same picture.
pub(super) struct Sequence(u64);

impl Default for Sequence {
    fn default() -> Self {
        Self(1)
    }
}

impl Sequence {
    /// The next number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % count
    }
}

fn is_near(circle: Circle, rough: Circle) -> bool {
    let offset = (circle.x - rough.x).hypot(circle.y - rough.y);
    (0.7..1.4).contains(&(circle.radius / rough.radius)) && offset < 0.4 * rough.radius
}

fn circle_through([a, b, c]: [Edge; 3]) -> Option<Circle> {
    let (bx, by, cx, cy) = (b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
    let area = 2.0 * (bx * cy - by * cx);
    let (b2, c2) = (bx * bx + by * by, cx * cx + cy * cy);
    let (x, y) = ((cy * b2 - by * c2) / area, (bx * c2 - cx * b2) / area);
    let radius = x.hypot(y);
    (area != 0.0 && radius.is_finite()).then(|| Circle::new(a.x + x, a.y + y, radius))
}

/// Rays with an edge on the circle.
fn support(edges: &[Edge], circle: Circle, limit: f64) -> usize {
    let mut rays = [false; RAYS];
    for edge in edges {
        rays[edge.ray] |= residual(*edge, circle).abs() < limit;
    }
    rays.iter().filter(|is_hit| **is_hit).count()
}

/// Distance from the circle. Not by `hypot`: pixels are no numbers whose squares overflow, and this is asked for often.
fn residual(edge: Edge, circle: Circle) -> f64 {
    let (right, down) = (edge.x - circle.x, edge.y - circle.y);
    (right * right + down * down).sqrt() - circle.radius
}

/// Gauss–Newton on the distances to the circle, with Tukey's biweight at `limit`.
fn geometric_fit(edges: &[Edge], start: Circle, limit: f64) -> Option<Circle> {
    const ROUNDS: usize = 12;
    let mut circle = start;
    for _ in 0..ROUNDS {
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for edge in edges {
            let error = residual(*edge, circle);
            let share = (error / limit).powi(2);
            if share < 1.0 {
                let distance = error + circle.radius;
                let row = Vector3::new((edge.x - circle.x) / distance, (edge.y - circle.y) / distance, 1.0);
                normal += row * row.transpose() * (1.0 - share).powi(2);
                right += row * error * (1.0 - share).powi(2);
            }
        }
        let step = normal.cholesky()?.solve(&right);
        circle = Circle::new(circle.x + step[0], circle.y + step[1], circle.radius + step[2]);
    }
    (circle.radius > 1.0 && circle.radius.is_finite()).then_some(circle)
}

/// Standard deviation of the supporting edges, and the amplitude of their second harmonic over the radius.
fn leftover(edges: &[Edge], circle: Circle, limit: f64) -> (f64, f64) {
    let supporting = edges.iter().map(|edge| residual(*edge, circle)).filter(|error| error.abs() < limit);
    let (squares, count) =
        supporting.fold((0.0, 0.0), |(squares, count), error| (squares + error * error, count + 1.0));
    let scatter = if count > 1.0 { f64::sqrt(squares / count) } else { limit };
    (scatter, second_harmonic(edges, circle, limit.max(0.08 * circle.radius)) / circle.radius)
}

/// The amplitude of cos 2φ in the distances to the circle, fitted beside its centre and radius.
///
/// An ellipse leaves the circle's inliers, so the edge of each ray nearest to it within `reach` counts.
fn second_harmonic(edges: &[Edge], circle: Circle, reach: f64) -> f64 {
    let mut nearest: [Option<Edge>; RAYS] = [None; RAYS];
    for edge in edges.iter().filter(|edge| residual(**edge, circle).abs() < reach) {
        let best = &mut nearest[edge.ray];
        if best.is_none_or(|other| residual(*edge, circle).abs() < residual(other, circle).abs()) {
            *best = Some(*edge);
        }
    }
    let (mut normal, mut right) = (SMatrix::<f64, 5, 5>::zeros(), SVector::<f64, 5>::zeros());
    for edge in nearest.into_iter().flatten() {
        let (sin, cos) = (edge.y - circle.y).atan2(edge.x - circle.x).sin_cos();
        let row = SVector::<f64, 5>::from([1.0, cos, sin, cos * cos - sin * sin, 2.0 * sin * cos]);
        normal += row * row.transpose();
        right += row * residual(edge, circle);
    }
    normal.cholesky().map_or(0.0, |normal| {
        let solution = normal.solve(&right);
        solution[3].hypot(solution[4])
    })
}

/// Finds the ball of a picture without a hint: the roundest, best supported outline.
pub fn find_ball(photo: &Photo) -> Result<Outline, OutlineError> {
    find_ball_beside(photo, &[])
}

/// Finds the ball of a picture that is none of `others`: a reference ball is in the picture, too.
pub fn find_ball_beside(photo: &Photo, others: &[Circle]) -> Result<Outline, OutlineError> {
    /// A shape of a few reduced pixels is rough: its edge may lie beyond the reach of one radius.
    const RADII: [f64; 3] = [1.0, 1.15, 0.87];
    let near = |shape: Circle, factor: f64| steepest_circle(photo, shape.with_radius(factor * shape.radius)).ok();
    let shapes = Reduced::of(photo).round_shapes();
    let snapped = shapes.into_iter().filter_map(|shape| RADII.iter().find_map(|factor| near(shape, *factor)));
    let is_other = |outline: &Outline| others.iter().any(|other| overlap(outline.circle, *other));
    let clear = snapped.filter(|outline| !is_other(outline)).map(|outline| (clearness(photo, outline.circle), outline));
    let score = |(clearness, outline): &(f64, Outline)| clearness * outline.circle.radius.sqrt();
    let balls = clear.filter(|(clearness, _)| *clearness >= LEAST_CLEARNESS);
    let best = balls.max_by(|a, b| score(a).total_cmp(&score(b))).ok_or(OutlineError::NoBall)?;
    Ok(on_the_rim(photo, best.1))
}

/// Less than this is what carvings, leaves and cloth give: up to 0.32 on a bronze full of curls, 0.55 on a mirror ball
/// in a street and 0.61 on the back of a ladle.
const LEAST_CLEARNESS: f64 = 0.4;

/// How much more often edges run along a circle than along its neighbours of the same centre: 1 for a lone outline, 0
/// where a picture is full of edges.
fn clearness(photo: &Photo, circle: Circle) -> f64 {
    // A small circle needs neighbours, too, or chance would pass for an outline.
    let reach = (9.0 / circle.radius).max(0.1);
    let along: Vec<Edge> =
        candidates(photo, circle, reach).into_iter().filter(|edge| runs_along(photo, *edge, circle)).collect();
    let limit = INLIER_PX.max(INLIER_SHARE * circle.radius);
    let share = |radius: f64| support(&along, circle.with_radius(radius), limit) as f64 / RAYS as f64;
    let farthest = reach * circle.radius - limit;
    let steps = (1..).map(|step| (1.0 + f64::from(step)) * limit).take_while(|offset| *offset <= farthest);
    let neighbours: Vec<f64> =
        steps.flat_map(|offset| [circle.radius - offset, circle.radius + offset]).map(share).collect();
    share(circle.radius) - neighbours.iter().sum::<f64>() / neighbours.len().max(1) as f64
}

/// True where brightness changes across a circle and not along it: within about 25° of its radius.
fn runs_along(photo: &Photo, edge: Edge, circle: Circle) -> bool {
    const COSINE: f64 = 0.9;
    let mut brightness = Brightness::of(photo);
    let mut slope = |dx: f64, dy: f64| {
        Some(brightness.at((edge.x + dx, edge.y + dy))? - brightness.at((edge.x - dx, edge.y - dy))?)
    };
    let (Some(gx), Some(gy)) = (slope(1.0, 0.0), slope(0.0, 1.0)) else { return false };
    let (x, y) = (edge.x - circle.x, edge.y - circle.y);
    (gx * x + gy * y).abs() > COSINE * gx.hypot(gy) * x.hypot(y)
}

/// True when two balls would stand in one another.
fn overlap(a: Circle, b: Circle) -> bool {
    (a.x - b.x).hypot(a.y - b.y) < 0.9 * (a.radius + b.radius)
}

/// A picture of brightness at most 160 pixels wide and high, for a first look.
struct Reduced {
    width: usize,
    height: usize,
    scale: f64,
    values: Vec<f64>,
}

impl Reduced {
    const LARGEST_SIDE: f64 = 160.0;

    fn of(photo: &Photo) -> Self {
        let scale = (f64::from(photo.width.max(photo.height)) / Self::LARGEST_SIDE).max(1.0);
        let size = |full: u32| ((f64::from(full) / scale) as usize).max(1);
        let (width, height) = (size(photo.width), size(photo.height));
        // Four points in each reduced pixel are enough against aliasing for a vote.
        let mut brightness = Brightness::of(photo);
        let mut value = |x: usize, y: usize| {
            let mut at = |dx: f64, dy: f64| brightness.at(((x as f64 + dx) * scale, (y as f64 + dy) * scale));
            let points = [at(0.25, 0.25), at(0.75, 0.25), at(0.25, 0.75), at(0.75, 0.75)];
            let mean = points.iter().flatten().sum::<f64>() / points.iter().flatten().count().max(1) as f64;
            // Contrast, not difference: a dark ball before a bright sky has an outline, too.
            (mean + 0.01).ln()
        };
        let values = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| value(x, y)).collect();
        Self { width, height, scale, values }
    }

    /// Circles that many edges point at: each edge votes for centres along its gradient (Duda & Hart 1972).
    fn round_shapes(&self) -> Vec<Circle> {
        const KEPT: usize = 12;
        let edges = self.edges();
        let (smallest, largest) = (6.0, 0.55 * self.width.max(self.height) as f64);
        let mut shapes: Vec<(f64, Circle)> = Vec::new();
        let mut radius = smallest;
        while radius < largest {
            let (votes, x, y) = self.best_centre(&edges, radius);
            // Votes over the circumference: the share of the outline that was seen.
            let share = votes / (std::f64::consts::TAU * radius);
            let circle = Circle::new((x + 0.5) * self.scale, (y + 0.5) * self.scale, radius * self.scale);
            shapes.push((share * radius.sqrt(), circle));
            radius *= 1.06;
        }
        shapes.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut kept: Vec<Circle> = Vec::new();
        for (_, circle) in shapes {
            if kept.len() < KEPT && kept.iter().all(|other| !is_near(circle, *other)) {
                kept.push(circle);
            }
        }
        kept
    }

    /// The steepest quarter of the pixels with the direction of their gradient.
    fn edges(&self) -> Vec<(f64, f64, f64, f64)> {
        let at = |x: usize, y: usize| self.values[y * self.width + x];
        let mut edges = Vec::new();
        for y in 1..self.height.saturating_sub(1) {
            for x in 1..self.width.saturating_sub(1) {
                let (gx, gy) = (at(x + 1, y) - at(x - 1, y), at(x, y + 1) - at(x, y - 1));
                let length = gx.hypot(gy);
                if length > 0.02 {
                    edges.push((x as f64, y as f64, gx / length, gy / length, length));
                }
            }
        }
        edges.sort_by(|a, b| b.4.total_cmp(&a.4));
        edges.truncate(self.values.len() / 4);
        edges.into_iter().map(|(x, y, dx, dy, _)| (x, y, dx, dy)).collect()
    }

    /// The centre most edges agree on for a radius, votes gathered over 3×3 pixels.
    fn best_centre(&self, edges: &[(f64, f64, f64, f64)], radius: f64) -> (f64, f64, f64) {
        let mut votes = vec![0.0; self.width * self.height];
        for (x, y, dx, dy) in edges {
            for side in [-1.0, 1.0] {
                let (cx, cy) = (x + side * radius * dx, y + side * radius * dy);
                if cx >= 1.0 && cy >= 1.0 && cx < self.width as f64 - 1.0 && cy < self.height as f64 - 1.0 {
                    votes[cy.round() as usize * self.width + cx.round() as usize] += 1.0;
                }
            }
        }
        let around = |index: usize| {
            let (x, y) = (index % self.width, index / self.width);
            let rows = y.saturating_sub(1)..=(y + 1).min(self.height - 1);
            rows.map(|y| {
                let columns = x.saturating_sub(1)..=(x + 1).min(self.width - 1);
                columns.map(|x| votes[y * self.width + x]).sum::<f64>()
            })
            .sum::<f64>()
        };
        let best = (0..votes.len()).map(|i| (around(i), i)).max_by(|a, b| a.0.total_cmp(&b.0));
        best.map_or((0.0, 0.0, 0.0), |(votes, i)| (votes, (i % self.width) as f64, (i / self.width) as f64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A soft-edged ellipse of brightness 0.7 on 0.2, its edge where it is half covered.
    fn ellipse(rx: f64, ry: f64) -> Photo {
        let (cx, cy) = (101.3, 98.6);
        let pixel = |x: u32, y: u32| {
            let (dx, dy) = ((f64::from(x) + 0.5 - cx) / rx, (f64::from(y) + 0.5 - cy) / ry);
            let inside = ((1.0 - dx.hypot(dy)) * rx.min(ry) + 0.5).clamp(0.0, 1.0);
            [(0.2 + 0.5 * inside) as f32; 3]
        };
        let pixels = (0..200).flat_map(|y| (0..200).map(move |x| pixel(x, y))).collect();
        Photo::from_linear("disc", 200, 200, pixels)
    }

    #[test]
    fn snaps_to_a_fraction_of_a_pixel() {
        let found = snap_circle(&ellipse(70.4, 70.4), Circle::new(106.0, 95.0, 63.0)).unwrap();
        let Circle { x, y, radius } = found.circle;
        assert!((x - 101.3).abs() < 0.1 && (y - 98.6).abs() < 0.1 && (radius - 70.4).abs() < 0.15, "{found:?}");
        assert!(found.uncertainty_px < 0.2 && found.support > 0.95 && found.warning().is_none(), "{found:?}");
    }

    #[test]
    fn finds_a_ball_by_itself() {
        let found = find_ball(&ellipse(70.4, 70.4)).unwrap();
        assert!((found.circle.radius - 70.4).abs() < 0.2, "{found:?}");
    }

    /// Noise gives steps on every ray, of which some lie on any circle.
    #[test]
    fn a_picture_full_of_edges_holds_no_ball() {
        let noise = |x: u32, y: u32| (x.wrapping_mul(2_654_435_761) ^ y.wrapping_mul(2_246_822_519)) >> 13 & 0xff;
        let value = |x: u32, y: u32| [0.2 + noise(x / 3, y / 3) as f32 / 400.0; 3];
        let pixels = (0..200).flat_map(|y| (0..200).map(move |x| value(x, y))).collect();
        assert_eq!(find_ball(&Photo::from_linear("noise", 200, 200, pixels)), Err(OutlineError::NoBall));
    }

    /// A dark ring inside the rim, as a far horizon makes, is no outline.
    #[test]
    fn the_outermost_of_two_rings_is_the_outline() {
        let pixel = |x: u32, y: u32| {
            let distance = (f64::from(x) + 0.5 - 101.3).hypot(f64::from(y) + 0.5 - 98.6);
            let inside = |radius: f64| (radius - distance + 0.5).clamp(0.0, 1.0);
            [(0.2 + 0.3 * inside(70.4) - 0.4 * inside(66.0) + 0.5 * inside(62.0)) as f32; 3]
        };
        let pixels = (0..200).flat_map(|y| (0..200).map(move |x| pixel(x, y))).collect();
        let photo = Photo::from_linear("rings", 200, 200, pixels);
        for found in [find_ball(&photo).unwrap(), snap_circle(&photo, Circle::new(103.0, 98.0, 67.0)).unwrap()] {
            assert!((found.circle.radius - 70.4).abs() < 0.25, "{found:?}");
        }
    }

    #[test]
    fn an_ellipse_is_seen() {
        let found = snap_circle(&ellipse(72.0, 68.0), Circle::new(101.0, 99.0, 70.0)).unwrap();
        assert!((found.ellipticity - 2.0 / 70.0).abs() < 0.006, "{found:?}");
        assert_eq!(found.warning().unwrap().code, WarningCode::Geometry);
    }

    #[test]
    fn nothing_round_is_said() {
        let grey = Photo::from_linear("grey", 100, 100, vec![[0.5; 3]; 10_000]);
        assert_eq!(snap_circle(&grey, Circle::new(50.0, 50.0, 30.0)), Err(OutlineError::NoCircle));
        assert_eq!(find_ball(&grey), Err(OutlineError::NoBall));
    }
}
