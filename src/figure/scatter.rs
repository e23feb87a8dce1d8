//! Points of a plane with their names: cost against error, r against h.

use super::axis::{Axis, rounded_out};
use super::drawing::{Align, Drawing, Label, Point};
use super::output::Figure;
use super::page::{Frame, HEADING, MARGIN, Page};
use super::place::{Places, left_out_note};
use super::style::{FigureTheme, SOLID, em};

/// Named points, in series that share a colour, with the Pareto front as steps where both axes are costs.
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
    /// What the steps through the points on the front say; not said where it is empty.
    pub front_name: String,
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
    /// True where no other point is as low and as far left; nowhere where the axes are no costs.
    pub is_on_front: bool,
}

const LEFT: f64 = MARGIN + 48.0;
const PANEL: (f64, f64) = (720.0, 420.0);
const TOP: f64 = HEADING + 48.0;
const DOT: f64 = 4.0;
/// What a point on the front is larger by.
const STANDS_OUT: f64 = 1.2;
/// Width of the steps.
const FRONT: f64 = 1.5;
/// Length of the line beside their name.
const SAMPLE: f64 = 20.0;

impl ScatterFigure {
    /// The corners of the steps through the points on the front, from left to right, in the values of the axes.
    ///
    /// Steps and no slopes: between two points nothing is lower than the left one.
    pub fn front_steps(&self) -> Vec<Point> {
        let mut on_front: Vec<Point> =
            self.shown().into_iter().filter(|point| point.is_on_front).map(|point| (point.x, point.y)).collect();
        on_front.sort_by(|a, b| a.0.total_cmp(&b.0));
        let first = on_front.first().copied();
        let steps = on_front.windows(2).flat_map(|pair| [(pair[1].0, pair[0].1), pair[1]]);
        first.into_iter().chain(steps).collect()
    }

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

impl Figure for ScatterFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let size = (LEFT + PANEL.0 + MARGIN + 8.0, TOP + PANEL.1 + 74.0);
        let mut page = Page::new((&self.title, &self.subtitle), size, LEFT, theme);
        let shown = self.shown();
        let (x, y) = self.axes(&shown);
        page.frame(&Frame { x, y, x_name: self.x_name.clone(), y_name: self.y_name.clone() });
        let steps: Vec<Point> = self.front_steps().into_iter().map(|(cost, error)| (x.at(cost), y.at(error))).collect();
        let mark = page.palette.mark;
        page.drawing.line(&steps, FRONT, SOLID, mark);
        self.key(&mut page);
        let dots: Vec<Point> = shown.iter().map(|p| (x.at(p.x), y.at(p.y))).collect();
        let mut drawn: Vec<(&ScatterPoint, Point)> = shown.iter().copied().zip(dots.iter().copied()).collect();
        drawn.sort_by_key(|(point, _)| point.is_on_front);
        for (point, dot) in drawn {
            let ink = page.palette.models[point.series % page.palette.models.len()];
            page.drawing.dot(dot, point.radius() + 1.2, page.palette.ground);
            page.drawing.dot(dot, point.radius(), ink);
        }
        let unnamed = names(&mut page, &shown, &dots, &steps);
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
        if !self.front_name.is_empty() {
            page.drawing.rule((x, baseline - 4.0), (x + SAMPLE, baseline - 4.0), FRONT, page.palette.mark);
            let label = Label::new(&self.front_name, x + SAMPLE + 6.0, baseline, em::LABEL, page.palette.ink);
            page.drawing.text(label);
        }
    }
}

impl ScatterPoint {
    fn radius(&self) -> f64 {
        if self.is_on_front { DOT + STANDS_OUT } else { DOT }
    }
}

/// Names the points, those on the front first; gives back for how many there was no room.
fn names(page: &mut Page, shown: &[&ScatterPoint], dots: &[Point], front: &[Point]) -> usize {
    let limits = [LEFT + 2.0, TOP + 2.0, LEFT + PANEL.0 - 2.0, TOP + PANEL.1 - 2.0];
    let mut places = Places::new(limits, &[], 0.0);
    shown.iter().zip(dots).for_each(|(point, dot)| places.keep_free(*dot, point.radius() + 1.0));
    places.keep_clear_of(front);
    let (ink, leader) = (page.palette.ink, page.palette.mark);
    let mut named: Vec<(&ScatterPoint, Point)> = shown.iter().copied().zip(dots.iter().copied()).collect();
    named.retain(|(point, _)| !point.label.is_empty());
    named.sort_by_key(|(point, _)| !point.is_on_front);
    let mut unnamed = 0;
    for (point, dot) in named {
        unnamed += usize::from(!places.write(&mut page.drawing, &point.label, dot, ink, leader));
    }
    unnamed
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
            front_name: "Nothing is lower and farther left".to_owned(),
        }
    }

    fn point(label: &str, x: f64, y: f64) -> ScatterPoint {
        ScatterPoint { label: label.to_owned(), x, y, series: 0, is_on_front: false }
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

    /// What costs 2 buys no more than what costs 1.
    #[test]
    fn the_front_goes_in_steps() {
        let on_front = |label: &str, x, y| ScatterPoint { is_on_front: true, ..point(label, x, y) };
        let points = vec![on_front("best", 9.0, 1.0), on_front("cheap", 1.0, 5.0), point("beaten", 2.0, 6.0)];
        let of = |points| ScatterFigure { is_x_log: true, ..figure(points) }.front_steps();
        assert_eq!(of(points.clone()), [(1.0, 5.0), (9.0, 5.0), (9.0, 1.0)]);
        assert_eq!(of(points[..1].to_vec()), [(9.0, 1.0)]);
        assert_eq!(of(vec![on_front("free", 0.0, 9.0), points[0].clone()]), [(9.0, 1.0)], "what has no place");
        assert!(of(vec![points[2].clone()]).is_empty());
    }
}
