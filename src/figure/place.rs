//! Names beside points of a plane, without overlap.

use super::drawing::{Align, Drawing, Label, Point};
use super::page::{HAIR, TO_BASELINE};
use super::style::{Ink, SOLID, em};

/// A box: left, top, right, bottom.
type Bounds = [f64; 4];

/// Where names may stand, and what they must not cover.
#[derive(Debug)]
pub(super) struct Places {
    limits: Bounds,
    dots: Vec<Bounds>,
    names: Vec<Bounds>,
    lines: Vec<[Point; 2]>,
}

/// Directions in the order they are tried: right, left, above, below, the corners.
const DIRECTIONS: [(f64, f64); 8] =
    [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0), (0.7, -0.7), (-0.7, -0.7), (0.7, 0.7), (-0.7, 0.7)];
/// Distances from the point in the order they are tried; from the second on, a leader joins name and point.
const DISTANCES: [f64; 6] = [8.0, 16.0, 26.0, 38.0, 52.0, 68.0];

impl Places {
    /// Room inside `limits` beside dots of a radius.
    pub(super) fn new(limits: Bounds, dots: &[Point], radius: f64) -> Self {
        let mut places = Self { limits, dots: Vec::new(), names: Vec::new(), lines: Vec::new() };
        dots.iter().for_each(|&dot| places.keep_free(dot, radius));
        places
    }

    /// Keeps a square around a point free of names.
    pub(super) fn keep_free(&mut self, (x, y): Point, half: f64) {
        self.dots.push([x - half, y - half, x + half, y + half]);
    }

    /// Keeps names and leaders off a line.
    pub(super) fn keep_clear_of(&mut self, line: &[Point]) {
        self.lines.extend(line.windows(2).map(|pair| [pair[0], pair[1]]));
    }

    /// Writes a name as near to its point as there is room; false if there is none.
    pub(super) fn write(&mut self, drawing: &mut Drawing, text: &str, point: Point, ink: Ink, leader: Ink) -> bool {
        let candidates = DISTANCES.iter().flat_map(|&distance| DIRECTIONS.map(|direction| (distance, direction)));
        for (distance, (dx, dy)) in candidates {
            let (x, y) = (point.0 + dx * distance, point.1 + dy * distance);
            let align = match dx {
                d if d > 0.0 => Align::Left,
                d if d < 0.0 => Align::Right,
                _ => Align::Centre,
            };
            let label = Label::new(text, x, y + TO_BASELINE, em::SMALL, ink).aligned(align);
            let line = (distance > DISTANCES[0])
                .then_some([(point.0 + dx * 6.0, point.1 + dy * 6.0), (x - dx * 2.0, y - dy * 5.0)]);
            if self.is_free(label.bounds()) && line.is_none_or(|line| self.is_clear(line, point)) {
                if let Some(line) = line {
                    drawing.line(&line, HAIR, SOLID, leader);
                    self.lines.push(line);
                }
                self.names.push(label.bounds());
                drawing.text(label);
                return true;
            }
        }
        false
    }

    /// Nothing is in the box, nor a name or a line close to it.
    fn is_free(&self, bounds: Bounds) -> bool {
        let ([left, top, right, bottom], [l, t, r, b]) = (bounds, self.limits);
        let is_inside = left >= l && top >= t && right <= r && bottom <= b;
        let (from_names, from_lines) = (with_air(bounds, AIR_OF_NAMES), with_air(bounds, AIR_OF_LINES));
        is_inside
            && !self.dots.iter().any(|dot| overlap(*dot, bounds))
            && !self.names.iter().any(|name| overlap(*name, from_names))
            && !self.lines.iter().any(|line| crosses_box(*line, from_lines))
    }

    /// A leader from a point meets no name, no other dot and no other line.
    fn is_clear(&self, line: [Point; 2], own: Point) -> bool {
        let meets_box = |bounds: &Bounds| !contains(*bounds, own) && crosses_box(line, *bounds);
        !self.dots.iter().chain(&self.names).any(meets_box) && !self.lines.iter().any(|other| crosses(line, *other))
    }
}

/// The air that a name needs, beside it and above it, to be read apart from another.
const AIR_OF_NAMES: (f64, f64) = (2.0, 2.0);
/// The same from a line, which is bolder than a name.
const AIR_OF_LINES: (f64, f64) = (2.0, 3.0);

fn with_air([left, top, right, bottom]: Bounds, (beside, above): (f64, f64)) -> Bounds {
    [left - beside, top - above, right + beside, bottom + above]
}

fn overlap([left, top, right, bottom]: Bounds, [l, t, r, b]: Bounds) -> bool {
    left < r && l < right && top < b && t < bottom
}

fn contains([left, top, right, bottom]: Bounds, (x, y): Point) -> bool {
    (left..=right).contains(&x) && (top..=bottom).contains(&y)
}

fn crosses_box(line: [Point; 2], bounds: Bounds) -> bool {
    let [left, top, right, bottom] = bounds;
    let diagonals = [[(left, top), (right, bottom)], [(left, bottom), (right, top)]];
    line.iter().any(|&end| contains(bounds, end)) || diagonals.into_iter().any(|diagonal| crosses(line, diagonal))
}

/// What could not be shown, in one sentence each; empty when all was.
pub(super) fn left_out_note(not_drawn: usize, not_named: usize) -> String {
    let part = |count: usize, what: &str| match count {
        0 => String::new(),
        1 => format!("1 point {what} "),
        _ => format!("{count} points {what} "),
    };
    let note = part(not_drawn, "outside the axes not drawn.") + &part(not_named, "not named for want of room.");
    note.trim_end().to_owned()
}

/// Two segments cross, touch or cover each other: neither has both ends of the other on one side, nor a box apart.
fn crosses([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let side = |from: Point, to: Point, p: Point| (to.0 - from.0) * (p.1 - from.1) - (to.1 - from.1) * (p.0 - from.0);
    let overlaps = |a: f64, b: f64, c: f64, d: f64| a.min(b) <= c.max(d) && c.min(d) <= a.max(b);
    side(a, b, c) * side(a, b, d) <= 0.0
        && side(c, d, a) * side(c, d, b) <= 0.0
        && overlaps(a.0, b.0, c.0, d.0)
        && overlaps(a.1, b.1, c.1, d.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_cross_where_they_should() {
        let across = [(0.0, 0.0), (10.0, 10.0)];
        assert!(crosses(across, [(0.0, 10.0), (10.0, 0.0)]));
        assert!(!crosses(across, [(0.0, 1.0), (9.0, 10.0)]));
        let (level, corner) = ([(0.0, 0.0), (4.0, 0.0)], [(4.0, 0.0), (4.0, 9.0)]);
        assert!(crosses(level, corner) && crosses(level, [(3.0, 0.0), (8.0, 0.0)]));
        assert!(!crosses(level, [(5.0, 0.0), (8.0, 0.0)]) && !crosses(level, [(4.0, 1.0), (4.0, 9.0)]));
        assert!(crosses_box(across, [4.0, 4.0, 6.0, 6.0]) && !crosses_box(across, [4.0, 0.0, 6.0, 3.0]));
    }

    #[test]
    fn names_avoid_each_other_and_lines() {
        let ink = Ink::hex(0);
        let mut drawing = Drawing::new("", 200.0, 200.0, ink);
        let point = (100.0, 100.0);
        let mut places = Places::new([0.0, 0.0, 200.0, 200.0], &[point], 3.0);
        places.keep_clear_of(&[(110.0, 0.0), (110.0, 200.0)]);
        assert!((0..3).all(|i| places.write(&mut drawing, &format!("name {i}"), point, ink, ink)));
        let boxes: Vec<Bounds> = drawing.labels().map(Label::bounds).collect();
        assert!(boxes.iter().all(|[left, _, right, _]| *right < 110.0 || *left > 110.0));
        super::super::check::assert_texts_are_legible(&drawing);
    }

    #[test]
    fn where_there_is_no_room_it_is_said() {
        let ink = Ink::hex(0);
        let mut drawing = Drawing::new("", 20.0, 20.0, ink);
        let mut places = Places::new([0.0, 0.0, 20.0, 20.0], &[], 0.0);
        assert!(!places.write(&mut drawing, "a long name", (10.0, 10.0), ink, ink));
    }
}
