//! What converting parameters as colours does to one material.

use super::page::{LEFT, Lines, Page, RIGHT, degree_ticks, delta_e_text, ink};
use crate::figure::axis::Axis;
use crate::figure::drawing::Drawing;
use crate::figure::output::Figure;
use crate::figure::style::FigureTheme;
use crate::study::{ColourConversion, ConvertedParameters, Parameters};

/// Strips over the angle: for each description what should be seen above what is seen, and ΔE below.
#[derive(Clone, Debug)]
pub struct ConversionFigure {
    /// What is shown.
    pub study: ColourConversion,
}

const STRIP: f64 = 20.0;
const ROW_GAP: f64 = 14.0;
const CHART: f64 = 170.0;

impl Figure for ConversionFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let study = &self.study;
        let title = format!(
            "{}: parameters converted from {} to {}",
            study.name,
            study.options.from.label(),
            study.options.to.label()
        );
        let mut page = Page::new(&title, &study.summary(), theme);
        let angle = Axis::new((0.0, 90.0), (LEFT, RIGHT));
        page.caption("Above: the appearance that should be kept. Below: what the converted parameters show", LEFT);
        let mut has_clipped = self.truth(&mut page, angle);
        for result in &study.results {
            has_clipped |= self.pair_of_strips(&mut page, angle, result);
        }
        page.y += 4.0;
        let ticks = degree_ticks();
        page.ticks_below(angle, &ticks, page.y);
        page.axis_name("Angle", page.y);
        page.y += 46.0;
        page.caption("ΔE2000 by the conversion alone", LEFT);
        let values = Parameters::ALL.map(|parameters| study.results[parameters as usize].delta_e.clone());
        Lines { x: angle, x_ticks: &ticks, top: page.y, height: CHART, values }.draw(&mut page);
        page.y += CHART + 4.0;
        page.clip_note(has_clipped);
        page.finish()
    }
}

impl ConversionFigure {
    fn truth(&self, page: &mut Page, angle: Axis) -> bool {
        let ink = page.palette.ink;
        let clipped = page.strip(angle, (page.y, STRIP), &self.study.truth, self.study.options.to);
        page.name("Truth", page.y + STRIP / 2.0, ink);
        page.y += STRIP + ROW_GAP;
        clipped
    }

    fn pair_of_strips(&self, page: &mut Page, angle: Axis, result: &ConvertedParameters) -> bool {
        let (palette, space) = (page.palette, self.study.options.to);
        let clipped = page.strip(angle, (page.y, STRIP), &result.appearance, space)
            | page.strip(angle, (page.y + STRIP, STRIP), &result.curve, space);
        let middle = page.y + STRIP;
        page.name(result.parameters().label(), middle, ink(result.parameters(), palette));
        page.value(&delta_e_text(result.error.max_delta_e), "max ΔE", middle - 8.0);
        let back = format!("{} there and back", delta_e_text(result.there_and_back_delta_e));
        page.remark(&back, middle + 9.0);
        page.y += 2.0 * STRIP + ROW_GAP;
        clipped
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::metal::preferred_metals;
    use crate::study::{ConversionOptions, Subject, conversion};

    #[test]
    fn texts_are_legible_for_every_metal() {
        for metal in preferred_metals() {
            for to in [RgbSpace::AcesCg, RgbSpace::LinRec709] {
                let options = ConversionOptions { from: RgbSpace::LinRec2020, to, ..Default::default() };
                let study = conversion(&Subject::Metal(metal), &options).unwrap();
                let drawing = ConversionFigure { study }.drawing(FigureTheme::Dark);
                crate::figure::check::assert_texts_are_legible(&drawing);
            }
        }
    }
}
