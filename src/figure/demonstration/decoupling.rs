//! What moving one parameter does to what the other means.

use super::page::{LEFT, MARGIN, Page, WIDTH, delta_e_text, ink};
use crate::color::Rgb;
use crate::figure::drawing::{Drawing, Label};
use crate::figure::output::Figure;
use crate::figure::style::{FigureTheme, em};
use crate::study::{Decoupling, DecouplingRow, Parameters, Swept};

/// Facing and edge colours along both sweeps, and the colour a grey edge parameter takes on.
#[derive(Clone, Debug)]
pub struct DecouplingFigure {
    /// What is shown.
    pub study: Decoupling,
}

const STRIP: f64 = 24.0;
const ROW_GAP: f64 = 22.0;
const SWEEP: f64 = 196.0;
/// Room for a number and a word right of a sweep.
const NUMBERS: f64 = 84.0;
const SWATCH: f64 = 2.0 * STRIP;

impl Figure for DecouplingFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let title = format!("{}: does one parameter leave the other alone?", self.study.name);
        let mut page = Page::new(&title, &self.study.summary(), theme);
        let [first, edge, grey] = columns();
        page.caption("r (or n) falls, the edge parameter is held", first);
        page.caption("The edge parameter falls, r (or n) is held", edge);
        page.caption("Grey edge parameter", grey);
        let mut has_clipped = false;
        for parameters in Parameters::ALL {
            has_clipped |= self.row(&mut page, parameters);
        }
        page.y -= ROW_GAP;
        page.clip_note(has_clipped);
        page.finish()
    }
}

/// Left ends of the three columns.
fn columns() -> [f64; 3] {
    [LEFT, LEFT + SWEEP + NUMBERS, WIDTH - MARGIN - SWATCH - NUMBERS]
}

impl DecouplingFigure {
    fn row(&self, page: &mut Page, parameters: Parameters) -> bool {
        let palette = page.palette;
        page.name(parameters.label(), page.y + STRIP, ink(parameters, palette));
        let [first, edge, grey] = columns();
        let clipped =
            self.sweep(page, parameters, Swept::First, first) | self.sweep(page, parameters, Swept::Edge, edge);
        let talk = &self.study.cross_talk[parameters as usize];
        let place = [grey, page.y, grey + SWATCH, page.y + SWATCH];
        let grey_clipped = page.boxes(place, &[talk.edge()], self.study.space);
        number(page, grey + SWATCH, page.y + STRIP, talk.delta_e_from_grey, "off grey");
        page.y += 2.0 * STRIP + ROW_GAP;
        clipped | grey_clipped
    }

    /// The facing colour above the edge colour, with how far each moved.
    fn sweep(&self, page: &mut Page, parameters: Parameters, swept: Swept, x: f64) -> bool {
        let Some(sweep) = self.study.sweep(parameters, swept) else { return false };
        let colours = |of: fn(&DecouplingRow) -> Rgb| sweep.rows.iter().rev().map(of).collect::<Vec<_>>();
        let strips = [("facing", colours(DecouplingRow::facing)), ("edge", colours(DecouplingRow::edge))];
        let mut has_clipped = false;
        for (index, ((name, colours), moved)) in strips.iter().zip(sweep.moved()).enumerate() {
            let top = page.y + STRIP * index as f64;
            has_clipped |= page.boxes([x, top, x + SWEEP, top + STRIP], colours, self.study.space);
            number(page, x + SWEEP, top + STRIP / 2.0, moved, name);
        }
        has_clipped
    }
}

fn number(page: &mut Page, x: f64, middle: f64, delta_e: f64, what: &str) {
    let baseline = middle + super::page::TO_BASELINE;
    let (ink, muted) = (page.palette.ink, page.palette.muted);
    let number = Label::new(delta_e_text(delta_e), x + 8.0, baseline, em::LABEL, ink).semi_bold();
    let after = x + 8.0 + number.width() + 5.0;
    page.drawing.text(number);
    page.drawing.text(Label::new(what, after, baseline, em::SMALL, muted));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::fit::Method;
    use crate::metal::preferred_metals;
    use crate::study::{Contestants, DecouplingOptions, Subject, decoupling};

    #[test]
    fn texts_are_legible_for_every_metal() {
        for metal in preferred_metals() {
            let contestants =
                Contestants::of(&Subject::Metal(metal), RgbSpace::LinRec709, Method::LeastSquares).unwrap();
            let study = decoupling(&contestants, &DecouplingOptions::default());
            crate::figure::check::assert_texts_are_legible(&DecouplingFigure { study }.drawing(FigureTheme::Dark));
        }
    }
}
