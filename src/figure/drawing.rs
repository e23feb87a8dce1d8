//! A figure laid out: shapes and texts in points, ready for any plotters backend.

use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind};
use plotters::prelude::{Circle, DrawingBackend, PathElement, Polygon, Rectangle, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color as _, FontTransform, RGBAColor, ShapeStyle, TextStyle};

use super::style::{Dashes, Ink, SOLID};
use super::text::{LINE_HEIGHT_PER_EM, Weight, font, text_width};
use crate::render::Srgb8Picture;

/// A place, x to the right and y down.
pub type Point = (f64, f64);

/// Which end of a text its x names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Align {
    #[default]
    Left,
    Centre,
    Right,
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// What it says.
    pub text: String,
    /// Where it stands; see `align`.
    pub x: f64,
    /// Its baseline.
    pub baseline: f64,
    /// Which end `x` names.
    pub align: Align,
    /// Size of the em.
    pub em: f64,
    /// How heavy it is.
    pub weight: Weight,
    /// Its colour.
    pub ink: Ink,
    /// It reads upwards: `x` is then the place of its baseline and `baseline` that of its beginning.
    pub is_upright: bool,
}

impl Label {
    /// Regular text whose left end is at `x`.
    pub fn new(text: impl Into<String>, x: f64, baseline: f64, em: f64, ink: Ink) -> Self {
        Self { text: text.into(), x, baseline, align: Align::Left, em, weight: Weight::Regular, ink, is_upright: false }
    }

    /// The same text held at another end.
    pub fn aligned(self, align: Align) -> Self {
        Self { align, ..self }
    }

    /// The same text, reading upwards from a point.
    pub fn upright(self) -> Self {
        Self { is_upright: true, ..self }
    }

    /// The same text in semi-bold.
    pub fn semi_bold(self) -> Self {
        Self { weight: Weight::SemiBold, ..self }
    }

    /// Width of the text.
    pub fn width(&self) -> f64 {
        text_width(&self.text, self.weight, self.em)
    }

    /// Left, top, right and bottom of the box that capitals and descenders fill.
    pub fn bounds(&self) -> [f64; 4] {
        let width = self.width();
        let before = match self.align {
            Align::Left => 0.0,
            Align::Centre => width / 2.0,
            Align::Right => width,
        };
        let (above, below) = (0.73 * self.em, 0.22 * self.em);
        if self.is_upright {
            let bottom = self.baseline + before;
            [self.x - above, bottom - width, self.x + below, bottom]
        } else {
            let left = self.x - before;
            [left, self.baseline - above, left + width, self.baseline + below]
        }
    }
}

/// One thing drawn.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Shape {
    Line { points: Vec<Point>, width: f64, dashes: Dashes, ink: Ink },
    Area { points: Vec<Point>, ink: Ink },
    Box { x: f64, y: f64, width: f64, height: f64, ink: Ink },
    Dot { centre: Point, radius: f64, ink: Ink },
    Text(Label),
}

/// A picture set into a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Inset {
    /// Left edge.
    pub x: f64,
    /// Upper edge.
    pub y: f64,
    /// Width; the height follows from the picture.
    pub width: f64,
    /// What is shown.
    pub picture: Srgb8Picture,
}

/// A figure laid out, in points: later shapes cover earlier ones, pictures cover shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// What the figure shows, for readers who cannot see it.
    pub title: String,
    /// Width in points.
    pub width: f64,
    /// Height in points.
    pub height: f64,
    /// The colour behind everything.
    pub ground: Ink,
    /// What is drawn.
    pub shapes: Vec<Shape>,
    /// Pictures on top.
    pub insets: Vec<Inset>,
}

impl Drawing {
    /// An empty drawing.
    pub fn new(title: impl Into<String>, width: f64, height: f64, ground: Ink) -> Self {
        Self { title: title.into(), width, height, ground, shapes: Vec::new(), insets: Vec::new() }
    }

    /// Adds a text.
    pub fn text(&mut self, label: Label) {
        self.shapes.push(Shape::Text(label));
    }

    /// Adds a straight solid line.
    pub fn rule(&mut self, from: Point, to: Point, width: f64, ink: Ink) {
        self.shapes.push(Shape::Line { points: vec![from, to], width, dashes: SOLID, ink });
    }

    /// Adds a line; points that are not finite interrupt it.
    pub fn line(&mut self, points: &[Point], width: f64, dashes: Dashes, ink: Ink) {
        let is_finite = |p: &Point| p.0.is_finite() && p.1.is_finite();
        for run in points.split(|p| !is_finite(p)).filter(|run| run.len() > 1) {
            self.shapes.push(Shape::Line { points: run.to_vec(), width, dashes, ink });
        }
    }

    /// Adds a filled polygon.
    pub fn area(&mut self, points: Vec<Point>, ink: Ink) {
        self.shapes.push(Shape::Area { points, ink });
    }

    /// Adds a filled box.
    pub fn fill(&mut self, x: f64, y: f64, width: f64, height: f64, ink: Ink) {
        self.shapes.push(Shape::Box { x, y, width, height, ink });
    }

    /// Adds a filled disc.
    pub fn dot(&mut self, centre: Point, radius: f64, ink: Ink) {
        self.shapes.push(Shape::Dot { centre, radius, ink });
    }

    /// Every text of the drawing.
    pub fn labels(&self) -> impl Iterator<Item = &Label> {
        self.shapes.iter().filter_map(|shape| match shape {
            Shape::Text(label) => Some(label),
            _ => None,
        })
    }

    /// Draws all but the insets onto a plotters area with `scale` backend units per point.
    pub fn draw_on<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        scale: f64,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        area.fill(&colour(self.ground))?;
        self.shapes.iter().try_for_each(|shape| shape.draw_on(area, scale))
    }
}

impl Shape {
    fn draw_on<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        scale: f64,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let unit = |v: f64| (v * scale).round() as i32;
        let place = |&(x, y): &Point| (unit(x), unit(y));
        let filled = |ink: Ink| ShapeStyle { color: colour(ink), filled: true, stroke_width: 0 };
        match self {
            Self::Line { points, width, dashes, ink } => {
                let stroke_width = (width * scale).round().max(1.0) as u32;
                let style = ShapeStyle { color: colour(*ink), filled: false, stroke_width };
                dashed(points, dashes)
                    .into_iter()
                    .try_for_each(|run| area.draw(&PathElement::new(run.iter().map(place).collect::<Vec<_>>(), style)))
            }
            Self::Area { points, ink } => {
                area.draw(&Polygon::new(points.iter().map(place).collect::<Vec<_>>(), filled(*ink)))
            }
            Self::Box { x, y, width, height, ink } => {
                area.draw(&Rectangle::new([place(&(*x, *y)), place(&(x + width, y + height))], filled(*ink)))
            }
            Self::Dot { centre, radius, ink } => area.draw(&Circle::new(place(centre), unit(*radius), filled(*ink))),
            Self::Text(label) => area.draw(&text_element(label, scale)),
        }
    }
}

/// plotters hangs text from a line half its line height above the baseline.
pub(super) const BASELINE_EM: f64 = LINE_HEIGHT_PER_EM / 2.0;

fn text_element(label: &Label, scale: f64) -> Text<'_, (i32, i32), &str> {
    let h_pos = match label.align {
        Align::Left => HPos::Left,
        Align::Centre => HPos::Center,
        Align::Right => HPos::Right,
    };
    let upwards = if label.is_upright { FontTransform::Rotate270 } else { FontTransform::None };
    let style = TextStyle {
        color: colour(label.ink).to_backend_color(),
        pos: Pos::new(h_pos, VPos::Top),
        ..TextStyle::from(font(label.weight, label.em * scale).transform(upwards))
    };
    let hang = BASELINE_EM * label.em;
    let (x, y) = if label.is_upright { (label.x - hang, label.baseline) } else { (label.x, label.baseline - hang) };
    Text::new(label.text.as_str(), ((x * scale).round() as i32, (y * scale).round() as i32), style)
}

fn colour(ink: Ink) -> RGBAColor {
    let [red, green, blue] = ink.rgb;
    RGBAColor(red, green, blue, ink.alpha)
}

/// The visible runs of a line: all of it when it is solid.
fn dashed(points: &[Point], dashes: &[f64]) -> Vec<Vec<Point>> {
    if dashes.is_empty() {
        return vec![points.to_vec()];
    }
    let mut runs = Vec::new();
    let (mut index, mut left) = (0, dashes[0]);
    let mut run = vec![points[0]];
    for pair in points.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let length = (to.0 - from.0).hypot(to.1 - from.1);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let place = (from.0 + (to.0 - from.0) * done / length, from.1 + (to.1 - from.1) * done / length);
            run.push(place);
            if index % 2 == 0 {
                runs.push(std::mem::take(&mut run));
            }
            run = vec![place];
            index = (index + 1) % dashes.len();
            left = dashes[index];
        }
        left -= length - done;
        run.push(to);
    }
    if index % 2 == 0 {
        runs.push(run);
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(run: &[Point]) -> f64 {
        run.windows(2).map(|p| (p[1].0 - p[0].0).hypot(p[1].1 - p[0].1)).sum()
    }

    #[test]
    fn dashes_have_their_lengths_around_corners() {
        let corner = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)];
        let runs = dashed(&corner, &[6.0, 2.0]);
        let lengths: Vec<f64> = runs.iter().map(|run| length(run)).collect();
        assert_eq!(lengths, [6.0, 6.0, 4.0]);
        assert_eq!(runs[1], [(8.0, 0.0), (10.0, 0.0), (10.0, 4.0)]);
    }

    #[test]
    fn what_is_not_finite_interrupts_a_line() {
        let mut drawing = Drawing::new("", 1.0, 1.0, Ink::hex(0));
        drawing.line(&[(0.0, 0.0), (1.0, 0.0), (2.0, f64::NAN), (3.0, 0.0), (4.0, 0.0)], 1.0, SOLID, Ink::hex(0));
        assert_eq!(drawing.shapes.len(), 2);
    }
}
