//! How equal the steps of a slider look.

use super::page::{HAIR, LEFT, MARGIN, Page, WIDTH};
use crate::color::{Rgb, RgbSpace};
use crate::figure::drawing::{Align, Drawing, Label};
use crate::figure::output::Figure;
use crate::figure::style::{FigureTheme, em};
use crate::study::{Reach, Slider, SliderSweep, uniformity_summary};

/// The steps of each slider as bars over their swatches, over what g can reach and over the whole slider.
#[derive(Clone, Debug)]
pub struct UniformityFigure {
    /// Sweeps that hold those at `r`.
    pub sweeps: Vec<SliderSweep>,
    /// The reflectance facing the surface that is shown.
    pub r: f64,
}

const BARS: f64 = 54.0;
const SWATCHES: f64 = 26.0;
const ROW_GAP: f64 = 38.0;
const COLUMN_GAP: f64 = 34.0;
const SHOWN: [Reach; 2] = [Reach::Reachable, Reach::Full];

impl Figure for UniformityFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let title = format!("r = {}: do equal steps of a slider look equal?", self.r);
        let mut page = Page::new(&title, &uniformity_summary(&self.sweeps, self.r), theme);
        page.y += 4.0;
        for (column, reach) in SHOWN.into_iter().enumerate() {
            let text = match reach {
                Reach::Full => "Over the whole slider, 0 to 1",
                _ => "Over the appearances that g can reach",
            };
            page.drawing
                .text(Label::new(text, place(column).0, page.y - 12.0, em::LABEL, page.palette.ink).semi_bold());
        }
        page.y += 18.0;
        for slider in Slider::ALL {
            let middle = page.y + BARS;
            let is_ours = slider == Slider::OURS;
            let ink = page.palette.ink;
            page.name(slider.label().split(", ").next().unwrap_or_default(), middle - 8.0, ink);
            let note = slider.label().split_once(", ").map_or("", |(_, encoding)| encoding);
            page.note(note, middle + 7.0);
            if is_ours {
                page.note("(our slider)", middle + 22.0);
            }
            for (column, reach) in SHOWN.into_iter().enumerate() {
                self.sweep(&mut page, slider, reach, column);
            }
            page.y += BARS + SWATCHES + ROW_GAP;
        }
        page.y -= ROW_GAP;
        page.finish()
    }
}

/// Left and right end of a column.
fn place(column: usize) -> (f64, f64) {
    let width = (WIDTH - MARGIN - LEFT - COLUMN_GAP) / 2.0;
    let left = LEFT + (width + COLUMN_GAP) * column as f64;
    (left, left + width)
}

impl UniformityFigure {
    fn of(&self, slider: Slider, reach: Reach) -> Option<&SliderSweep> {
        self.sweeps.iter().find(|sweep| sweep.r == self.r && sweep.slider == slider && sweep.reach == reach)
    }

    /// The highest bar of a column.
    fn most(&self, reach: Reach) -> f64 {
        let sweeps = Slider::ALL.into_iter().filter_map(|slider| self.of(slider, reach));
        sweeps.flat_map(|sweep| sweep.delta_e.iter().copied()).fold(1e-9, f64::max)
    }

    fn sweep(&self, page: &mut Page, slider: Slider, reach: Reach, column: usize) {
        let Some(sweep) = self.of(slider, reach) else { return };
        let ((left, right), palette) = (place(column), page.palette);
        let base = page.y + BARS;
        let step = (right - left) / sweep.delta_e.len() as f64;
        let most = self.most(reach);
        for (index, delta_e) in sweep.delta_e.iter().enumerate() {
            let height = BARS * delta_e / most;
            let x = left + step * index as f64;
            page.drawing.fill(x + 0.1 * step, base - height, 0.8 * step, height, bar_ink(page, slider));
        }
        page.drawing.rule((left, base), (right, base), HAIR, palette.mark);
        let colours: Vec<Rgb> = sweep.edges.iter().map(|edge| Rgb::splat(*edge)).collect();
        let swatches = [left, base + 3.0, right, base + 3.0 + SWATCHES];
        page.boxes(swatches, &colours, RgbSpace::LinRec709);
        // White on white needs an edge.
        page.frame(swatches);
        let row = sweep.row();
        let text = format!(
            "variation {:.2} · half of the change on {:.0} % · {:.1}–{:.1} ΔE a step",
            row.variation,
            100.0 * row.share_of_half,
            row.max_delta_e / row.max_over_min,
            row.max_delta_e
        );
        let label = Label::new(text, left, base + SWATCHES + 19.0, em::SMALL, palette.muted);
        page.drawing.text(label.aligned(Align::Left));
    }
}

fn bar_ink(page: &Page, slider: Slider) -> crate::figure::style::Ink {
    page.palette.models[if slider == Slider::G { 2 } else { 0 }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{UniformityOptions, uniformity};

    #[test]
    fn texts_are_legible_at_every_r() {
        let options = UniformityOptions::default();
        let sweeps = uniformity(&options);
        for r in options.r {
            let figure = UniformityFigure { sweeps: sweeps.clone(), r };
            crate::figure::check::assert_texts_are_legible(&figure.drawing(FigureTheme::Light));
        }
    }
}
