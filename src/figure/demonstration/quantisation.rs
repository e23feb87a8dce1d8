//! What storing parameters with few digits does.

use super::page::{LEFT, MARGIN, Page, RIGHT, WIDTH, delta_e_text, ink};
use crate::figure::axis::Axis;
use crate::figure::drawing::{Align, Drawing, Label};
use crate::figure::output::Figure;
use crate::figure::style::{FigureTheme, em};
use crate::study::{Encoding, Parameters, Quantisation, Quantised, Storage};

/// Gradients with eight-bit edge parameters, and the worst ΔE of every storage as a table.
#[derive(Clone, Debug)]
pub struct QuantisationFigure {
    /// What is shown.
    pub study: Quantisation,
}

const STRIP: f64 = 22.0;
const ROW_GAP: f64 = 16.0;
const TABLE_ROW: f64 = 24.0;

impl Figure for QuantisationFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let study = &self.study;
        let title = format!("{}: parameters stored with few digits", study.name);
        let mut page = Page::new(&title, &study.summary(), theme);
        page.caption(
            &format!(
                "Colour at 81.8° while only h, t, g or k goes from {} to {} in 8 bits. Above: linear. Below: sRGB-encoded",
                study.name, study.towards
            ),
            LEFT,
        );
        let mut has_clipped = false;
        for parameters in Parameters::ALL {
            has_clipped |= self.gradients(&mut page, parameters);
        }
        page.y += 34.0;
        self.table(&mut page);
        page.clip_note(has_clipped);
        page.finish()
    }
}

impl QuantisationFigure {
    fn gradients(&self, page: &mut Page, parameters: Parameters) -> bool {
        let along = Axis::new((0.0, 1.0), (LEFT, RIGHT));
        let mut has_clipped = false;
        let top = page.y;
        for (row, encoding) in Encoding::ALL.into_iter().enumerate() {
            let Some(result) = self.study.result(parameters, Storage::Bits8, encoding) else { continue };
            let place = top + STRIP * row as f64;
            has_clipped |= page.strip(along, (place, STRIP), &result.gradient, self.study.space);
            page.value(&delta_e_text(result.row.band_delta_e), "largest band", place + STRIP / 2.0);
        }
        let palette = page.palette;
        page.name(parameters.label(), top + STRIP, ink(parameters, palette));
        page.y += 2.0 * STRIP + ROW_GAP;
        has_clipped
    }

    fn table(&self, page: &mut Page) {
        let caption =
            format!("Largest ΔE2000 that rounding h, t, g or k of {} by half a code can cause", self.study.name);
        page.caption(&caption, MARGIN);
        let ways: Vec<(Storage, Encoding)> =
            Storage::ALL.into_iter().flat_map(|storage| Encoding::ALL.map(|encoding| (storage, encoding))).collect();
        let column = |index: usize| LEFT + (WIDTH - MARGIN - LEFT) * (index as f64 + 1.0) / ways.len() as f64;
        let palette = page.palette;
        let mut baseline = page.y + 12.0;
        for (index, (storage, encoding)) in ways.iter().enumerate() {
            for (line, text) in [storage.label(), encoding.label()].into_iter().enumerate() {
                let label = Label::new(text, column(index), baseline + 15.0 * line as f64, em::SMALL, palette.muted);
                page.drawing.text(label.aligned(Align::Right));
            }
        }
        baseline += 15.0 + TABLE_ROW;
        for parameters in Parameters::ALL {
            page.name(parameters.label(), baseline - super::page::TO_BASELINE, ink(parameters, palette));
            for (index, (storage, encoding)) in ways.iter().enumerate() {
                let value = |result: &Quantised| format!("{:.3}", result.row.rounding_delta_e);
                let text = self.study.result(parameters, *storage, *encoding).map(value).unwrap_or_default();
                let label = Label::new(text, column(index), baseline, em::LABEL, palette.ink);
                page.drawing.text(label.aligned(Align::Right));
            }
            baseline += TABLE_ROW;
        }
        page.y = baseline - TABLE_ROW;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::fit::Method;
    use crate::metal::metal_by_name;
    use crate::study::{Contestants, Subject, quantisation};

    #[test]
    fn texts_are_legible() {
        let metal = |name| {
            let subject = Subject::Metal(metal_by_name(name).unwrap());
            Contestants::of(&subject, RgbSpace::LinRec709, Method::LeastSquares).unwrap()
        };
        let study = quantisation(&metal("gold"), &metal("stainless steel, austenitic"));
        crate::figure::check::assert_texts_are_legible(&QuantisationFigure { study }.drawing(FigureTheme::Light));
    }
}
