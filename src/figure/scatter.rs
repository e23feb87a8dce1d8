//! Points of a plane with their names: cost against error, r against h.

use super::axis::{Axis, rounded_out};
use super::drawing::{Align, Drawing, Label, Point};
use super::output::Figure;
use super::page::{Frame, HEADING, MARGIN, Page};
use super::place::{Places, left_out_note};
use super::style::{FigureTheme, em, model_dashes};

/// Named points, in series that share a colour, with the Pareto front where both axes are costs.
#[derive(Clone, Debug, PartialEq)]
pub struct ScatterFigure {
    /// What is shown.
    pub title: String,
    /// Space, convention, what a reader must know.
    pub subtitle: String,
    /// Name of the horizontal axis, with its unit.
    pub x_name: String,
    /// Name of the vertical axis, with its unit.
    pub y_name: String,
    /// Equal factors equally far apart on the horizontal axis; points at or below 0 are then not drawn, and counted in a note.
    pub is_x_log: bool,
    /// The same of the vertical axis.
    pub is_y_log: bool,
    /// Names of the series; a single one is not named.
    pub series: Vec<String>,
    /// The points.
    pub points: Vec<ScatterPoint>,
    /// Join the points that no other beats on both axes.
    pub has_front: bool,
}

/// One point of a [`ScatterFigure`].
#[derive(Clone, Debug, PartialEq)]
pub struct ScatterPoint {
    /// Its name.
    pub label: String,
    /// Horizontal value.
    pub x: f64,
    /// Vertical value.
    pub y: f64,
    /// Index of its series.
    pub series: usize,
}

const LEFT: f64 = MARGIN + 48.0;
const PANEL: (f64, f64) = (720.0, 420.0);
const TOP: f64 = HEADING + 48.0;
const DOT: f64 = 4.0;

impl ScatterFigure {
    /// The points that can be drawn.
    fn shown(&self) -> Vec<&ScatterPoint> {
        let fits = |value: f64, is_log: bool| value.is_finite() && (!is_log || value > 0.0);
        let can_be_drawn = |p: &&ScatterPoint| fits(p.x, self.is_x_log) && fits(p.y, self.is_y_log);
        self.points.iter().filter(can_be_drawn).collect()
    }

    fn axes(&self, shown: &[&ScatterPoint]) -> (Axis, Axis) {
        let range = |value: fn(&ScatterPoint) -> f64| {
            let all = shown.iter().map(|p| value(p));
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
        };
        let (x_range, y_range) =
            if shown.is_empty() { ((1.0, 2.0), (1.0, 2.0)) } else { (range(|p| p.x), range(|p| p.y)) };
        let (x_places, y_places) = ((LEFT, LEFT + PANEL.0), (TOP + PANEL.1, TOP));
        let linear = |(low, high): (f64, f64), places| {
            let start = if low >= 0.0 && low < 0.3 * high { 0.0 } else { low };
            let range = rounded_out(start..=high.max(start + 1e-9), 6);
            Axis::new((*range.start(), *range.end()), places)
        };
        let axis = |(low, high): (f64, f64), is_log: bool, places| {
            if is_log { Axis::log((low / 1.5, high * 1.5), places) } else { linear((low, high), places) }
        };
        (axis(x_range, self.is_x_log, x_places), axis(y_range, self.is_y_log, y_places))
    }
}

/// The points that no other beats on both axes, from left to right.
fn front<'a>(points: &[&'a ScatterPoint]) -> Vec<&'a ScatterPoint> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| (a.x, a.y).partial_cmp(&(b.x, b.y)).unwrap_or(std::cmp::Ordering::Equal));
    let mut best = f64::INFINITY;
    sorted.retain(|p| {
        p.y < best && {
            best = p.y;
            true
        }
    });
    sorted
}

impl Figure for ScatterFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let size = (LEFT + PANEL.0 + MARGIN + 8.0, TOP + PANEL.1 + 74.0);
        let mut page = Page::new((&self.title, &self.subtitle), size, LEFT, theme);
        let shown = self.shown();
        let (x, y) = self.axes(&shown);
        page.frame(&Frame { x, y, x_name: self.x_name.clone(), y_name: self.y_name.clone() });
        let place = |p: &ScatterPoint| -> Point { (x.at(p.x), y.at(p.y)) };
        let joined: Vec<Point> =
            if self.has_front { front(&shown).into_iter().map(place).collect() } else { Vec::new() };
        let mark = page.palette.mark;
        page.drawing.line(&joined, 1.5, model_dashes(4), mark);
        self.key(&mut page);
        let dots: Vec<Point> = shown.iter().map(|p| place(p)).collect();
        for (point, &dot) in shown.iter().zip(&dots) {
            let ink = page.palette.models[point.series % page.palette.models.len()];
            page.drawing.dot(dot, DOT + 1.2, page.palette.ground);
            page.drawing.dot(dot, DOT, ink);
        }
        let unnamed = self.names(&mut page, &shown, &dots, &joined);
        page.caption(&left_out_note(self.points.len() - shown.len(), unnamed), LEFT, size.1 - 14.0, Align::Left);
        page.drawing
    }
}

impl ScatterFigure {
    /// A dot and a name for each series.
    fn key(&self, page: &mut Page) {
        let (mut x, baseline) = (LEFT, HEADING + 12.0);
        for (index, name) in self.series.iter().enumerate().filter(|_| self.series.len() > 1) {
            let ink = page.palette.models[index % page.palette.models.len()];
            page.drawing.dot((x + DOT, baseline - 4.0), DOT, ink);
            let label = Label::new(name, x + 14.0, baseline, em::LABEL, page.palette.ink);
            x += 14.0 + label.width() + 22.0;
            page.drawing.text(label);
        }
    }

    /// Names the points; gives back for how many there was no room.
    fn names(&self, page: &mut Page, shown: &[&ScatterPoint], dots: &[Point], front: &[Point]) -> usize {
        let limits = [LEFT + 2.0, TOP + 2.0, LEFT + PANEL.0 - 2.0, TOP + PANEL.1 - 2.0];
        let mut places = Places::new(limits, dots, DOT + 1.0);
        places.keep_clear_of(front);
        let (ink, leader) = (page.palette.ink, page.palette.mark);
        let named = shown.iter().zip(dots).filter(|(point, _)| !point.label.is_empty());
        named.filter(|(point, dot)| !places.write(&mut page.drawing, &point.label, **dot, ink, leader)).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::figure::check::assert_texts_are_legible;
    use crate::metal::preferred_metals;

    fn figure(points: Vec<ScatterPoint>) -> ScatterFigure {
        ScatterFigure {
            title: "r and h of all metals".to_owned(),
            subtitle: "Green channel, linear sRGB (Rec.709)".to_owned(),
            x_name: "r".to_owned(),
            y_name: "h".to_owned(),
            is_x_log: false,
            is_y_log: false,
            series: vec!["Metals".to_owned(), "Others".to_owned()],
            points,
            has_front: true,
        }
    }

    fn point(label: &str, x: f64, y: f64) -> ScatterPoint {
        ScatterPoint { label: label.to_owned(), x, y, series: 0 }
    }

    #[test]
    fn names_of_all_metals_do_not_overlap() {
        let space = RgbSpace::LinRec709;
        let points = preferred_metals().map(|metal| point(&metal.name, metal.r(space)[1], metal.h(space)[1]));
        assert_texts_are_legible(&figure(points.collect()).drawing(FigureTheme::Light));
    }

    #[test]
    fn what_cannot_be_drawn_is_said() {
        let log = ScatterFigure { is_x_log: true, ..figure(vec![point("a", 0.0, 1.0), point("b", 10.0, 1.0)]) };
        let drawing = log.drawing(FigureTheme::Dark);
        assert!(drawing.labels().any(|label| label.text.starts_with("1 point outside")));
        assert_texts_are_legible(&figure(Vec::new()).drawing(FigureTheme::Dark));
    }

    #[test]
    fn the_front_has_what_nothing_beats() {
        let points =
            [point("cheap", 1.0, 5.0), point("beaten", 2.0, 6.0), point("best", 3.0, 1.0), point("dear", 9.0, 1.0)];
        let front: Vec<_> = front(&points.iter().collect::<Vec<_>>()).into_iter().map(|p| p.label.as_str()).collect();
        assert_eq!(front, ["cheap", "best"]);
    }
}
