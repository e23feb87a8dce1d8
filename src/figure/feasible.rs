//! The (r, h) square: where 0 ≤ F ≤ 1, what real n and k can reach, where metals are.

use super::axis::Axis;
use super::drawing::{Align, Drawing, Label, Point};
use super::output::Figure;
use super::page::{Frame, HEADING, MARGIN, Page};
use super::place::{Places, left_out_note};
use super::style::{FigureTheme, Ink, SOLID, em, model_dashes};
use crate::fresnel::{feasible_h, h_of_schlick, reachable_h};

/// Pairs of one channel's r and h, on the region of reflectances.
#[derive(Clone, Debug, PartialEq)]
pub struct FeasibleFigure {
    /// What is shown.
    pub title: String,
    /// Space, what a reader must know.
    pub subtitle: String,
    /// Measured pairs.
    pub points: Vec<FeasiblePoint>,
    /// The pair being authored, in each channel.
    pub current: Option<[(f64, f64); 3]>,
}

/// One measured pair of a [`FeasibleFigure`].
#[derive(Clone, Debug, PartialEq)]
pub struct FeasiblePoint {
    /// Its name; empty for none.
    pub label: String,
    /// Reflectance facing the surface.
    pub r: f64,
    /// Reflectance at 81.8°.
    pub h: f64,
    /// The channel whose colour it has.
    pub channel: usize,
}

const SIDE: f64 = 560.0;
const LEFT: f64 = MARGIN + 44.0;
const TOP: f64 = HEADING + 34.0;
const DOT: f64 = 3.2;
const ARM: f64 = 8.0;
/// Both axes reach a little beyond the square: measured gold does too.
const RANGE: (f64, f64) = (0.0, 1.1);

impl Figure for FeasibleFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let size = (LEFT + SIDE + MARGIN + 8.0, TOP + SIDE + 84.0);
        let mut page = Page::new((&self.title, &self.subtitle), size, LEFT, theme);
        let x = Axis::new(RANGE, (LEFT, LEFT + SIDE));
        let y = Axis::new(RANGE, (TOP + SIDE, TOP));
        let at = |(r, h): (f64, f64)| (x.at(r), y.at(h));
        regions(&mut page, at);
        let (x_name, y_name) = ("r, facing the surface".to_owned(), "h, at 81.8°".to_owned());
        page.frame(&Frame { x, y, x_name, y_name });
        let schlick: Vec<Point> = [0.0, 1.0].map(|r| at((r, h_of_schlick(r)))).into();
        let (ink, mark) = (page.palette.muted, page.palette.mark);
        page.drawing.line(&schlick, 1.2, model_dashes(4), mark);
        let is_on_page = |p: &&FeasiblePoint| [p.r, p.h].iter().all(|v| (RANGE.0..=RANGE.1).contains(v));
        let shown: Vec<&FeasiblePoint> = self.points.iter().filter(is_on_page).collect();
        let dots: Vec<Point> = shown.iter().map(|p| at((p.r, p.h))).collect();
        for (point, &dot) in shown.iter().zip(&dots) {
            page.drawing.dot(dot, DOT, page.palette.channels[point.channel % 3].alpha(0.85));
        }
        let crosses: Vec<Point> = self.current.iter().flatten().map(|&pair| at(limited(pair))).collect();
        let mut places = Places::new([LEFT + 2.0, TOP + 2.0, LEFT + SIDE - 2.0, TOP + SIDE - 2.0], &dots, DOT);
        places.keep_clear_of(&schlick);
        crosses.iter().for_each(|&cross| places.keep_free(cross, ARM));
        let regions = [("0 ≤ F ≤ 1", (0.22, 0.2)), ("real n and k", (0.5, 0.66)), ("Schlick", (0.1, 0.5164))];
        for (name, place) in regions {
            places.write(&mut page.drawing, name, at(place), ink, mark);
        }
        let named = shown.iter().zip(&dots).filter(|(point, _)| !point.label.is_empty());
        let ink = page.palette.ink;
        let unnamed =
            named.filter(|(point, dot)| !places.write(&mut page.drawing, &point.label, **dot, ink, mark)).count();
        self.crosses(&mut page, &crosses);
        let note = left_out_note(self.points.len() - shown.len(), unnamed);
        page.caption(&note, LEFT, size.1 - 14.0, Align::Left);
        page.drawing
    }
}

/// The region 0 ≤ F ≤ 1, and in it the band of real indices.
fn regions(page: &mut Page, at: impl Fn((f64, f64)) -> Point) {
    let mark = page.palette.mark;
    let steps = || (0..=200).map(|i| f64::from(i) / 200.0);
    let feasible = steps().filter_map(|r| Some((r, feasible_h(r)?)));
    page.drawing.area(outline(feasible.map(|(r, h)| (r, *h.start(), *h.end())), &at), mark.alpha(0.14));
    let reachable = steps().filter_map(|r| Some((r, reachable_h(r)?)));
    page.drawing.area(outline(reachable.map(|(r, h)| (r, *h.start(), *h.end())), &at), mark.alpha(0.22));
}

fn outline(band: impl Iterator<Item = (f64, f64, f64)>, at: impl Fn((f64, f64)) -> Point) -> Vec<Point> {
    let band: Vec<_> = band.collect();
    let upper = band.iter().rev().map(|&(r, _, high)| at((r, high)));
    band.iter().map(|&(r, low, _)| at((r, low))).chain(upper).collect()
}

/// A pair moved onto the page.
fn limited((r, h): (f64, f64)) -> (f64, f64) {
    (r.clamp(RANGE.0, RANGE.1), h.clamp(RANGE.0, RANGE.1))
}

impl FeasibleFigure {
    /// The pair being authored, as a cross in each channel's colour.
    fn crosses(&self, page: &mut Page, crosses: &[Point]) {
        let inks: [Ink; 3] = page.palette.channels;
        for (&(x, y), ink) in crosses.iter().zip(inks) {
            page.drawing.line(&[(x - ARM, y), (x + ARM, y)], 2.2, SOLID, ink);
            page.drawing.line(&[(x, y - ARM), (x, y + ARM)], 2.2, SOLID, ink);
        }
        if self.current.is_some() {
            let text = "+ the current preset in R, G, B";
            let label = Label::new(text, LEFT, TOP + SIDE + 38.0, em::SMALL, page.palette.ink);
            page.drawing.text(label);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::figure::check::assert_texts_are_legible;
    use crate::metal::preferred_metals;

    #[test]
    fn all_metals_are_legible_and_what_is_beyond_is_said() {
        let space = RgbSpace::LinRec709;
        let mut points: Vec<FeasiblePoint> = preferred_metals()
            .map(|metal| FeasiblePoint {
                label: metal.symbol.clone(),
                r: metal.r(space)[1],
                h: metal.h(space)[1],
                channel: 1,
            })
            .collect();
        points.push(FeasiblePoint { label: "beyond".to_owned(), r: 2.0, h: 0.5, channel: 0 });
        let figure = FeasibleFigure {
            title: "Which r and h are reflectances".to_owned(),
            subtitle: "Green channel of all metals, linear sRGB (Rec.709)".to_owned(),
            points,
            current: Some([(0.9, 0.8), (0.7, 0.8), (0.4, 0.6)]),
        };
        let drawing = figure.drawing(FigureTheme::Light);
        assert_texts_are_legible(&drawing);
        assert!(drawing.labels().any(|label| label.text.starts_with("1 point outside")));
    }
}
