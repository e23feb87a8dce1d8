//! What all demonstrations share: a title, a sentence, names at the left, numbers at the right.

use crate::color::{Rgb, RgbSpace, srgb8};
use crate::figure::axis::{Axis, tick_text};
use crate::figure::drawing::{Align, Drawing, Label, Point};
use crate::figure::spread::spread;
use crate::figure::strip::draw_strip;
use crate::figure::style::{Dashes, FigureTheme, Ink, Palette, SOLID, em, model_dashes};
use crate::figure::text::{Weight, fitted, text_width};
use crate::study::Parameters;

/// Width of the page.
pub(super) const WIDTH: f64 = 880.0;
pub(super) const MARGIN: f64 = 28.0;
/// Left end of the panels.
pub(super) const LEFT: f64 = 108.0;
/// Right end of the panels.
pub(super) const RIGHT: f64 = WIDTH - 146.0;
/// Gap between a panel and the texts beside it.
pub(super) const GUTTER: f64 = 14.0;
pub(super) const HAIR: f64 = 1.0;
/// From the middle of a text's capitals to its baseline.
pub(super) const TO_BASELINE: f64 = 4.2;

/// A drawing under construction, from the top down.
pub(super) struct Page {
    pub(super) drawing: Drawing,
    pub(super) palette: Palette,
    /// Where the next thing goes.
    pub(super) y: f64,
}

impl Page {
    /// A page with its title, and the sentence that says what is seen.
    pub(super) fn new(title: &str, sentence: &str, theme: FigureTheme) -> Self {
        let palette = theme.palette();
        let mut drawing = Drawing::new(format!("{title}. {sentence}"), WIDTH, 0.0, palette.ground);
        let title = fitted(title, Weight::SemiBold, em::TITLE, WIDTH - 2.0 * MARGIN);
        drawing.text(Label::new(title, MARGIN, 40.0, em::TITLE, palette.ink).semi_bold());
        let mut page = Self { drawing, palette, y: 64.0 };
        // “n, k” is one name.
        let sentence = sentence.replace("n, k", "n,\u{a0}k");
        for line in wrapped(&sentence, em::SUBTITLE, WIDTH - 2.0 * MARGIN) {
            page.drawing.text(Label::new(line, MARGIN, page.y, em::SUBTITLE, palette.muted));
            page.y += 18.0;
        }
        page.y += 22.0;
        page
    }

    /// The drawing, as high as what is on it.
    pub(super) fn finish(mut self) -> Drawing {
        self.drawing.height = self.y + MARGIN;
        self.drawing
    }

    /// A caption above what follows.
    pub(super) fn caption(&mut self, text: &str, x: f64) {
        self.drawing.text(Label::new(text, x, self.y - 8.0, em::SMALL, self.palette.muted));
    }

    /// A name in the column at the left, beside a height.
    pub(super) fn name(&mut self, text: &str, middle: f64, ink: Ink) {
        let text = fitted(text, Weight::SemiBold, em::LABEL, LEFT - GUTTER - 8.0);
        let label = Label::new(text, LEFT - GUTTER, middle + TO_BASELINE, em::LABEL, ink);
        self.drawing.text(label.aligned(Align::Right).semi_bold());
    }

    /// A smaller text below a name.
    pub(super) fn note(&mut self, text: &str, middle: f64) {
        let text = fitted(text, Weight::Regular, em::SMALL, LEFT - GUTTER - 8.0);
        let label = Label::new(text, LEFT - GUTTER, middle + TO_BASELINE, em::SMALL, self.palette.muted);
        self.drawing.text(label.aligned(Align::Right));
    }

    /// A number with what it is, right of the panels.
    pub(super) fn value(&mut self, number: &str, what: &str, middle: f64) {
        let (ink, muted) = (self.palette.ink, self.palette.muted);
        let x = RIGHT + GUTTER;
        let baseline = middle + TO_BASELINE;
        self.drawing.text(Label::new(number, x, baseline, em::LABEL, ink).semi_bold());
        let after = x + text_width(number, Weight::SemiBold, em::LABEL) + 5.0;
        self.drawing.text(Label::new(what, after, baseline, em::SMALL, muted));
    }

    /// A remark right of the panels, below a number.
    pub(super) fn remark(&mut self, text: &str, middle: f64) {
        let text = fitted(text, Weight::Regular, em::SMALL, WIDTH - RIGHT - GUTTER - 8.0);
        let label = Label::new(text, RIGHT + GUTTER, middle + TO_BASELINE, em::SMALL, self.palette.muted);
        self.drawing.text(label);
    }

    /// Colours at equal steps along an axis, blending into one another; says whether sRGB had to clip one.
    pub(super) fn strip(&mut self, along: Axis, (top, height): (f64, f64), colours: &[Rgb], space: RgbSpace) -> bool {
        // Two strips that are compared must touch: what is clipped is said below instead of underlined.
        let invisible = self.palette.muted.alpha(0.0);
        draw_strip(&mut self.drawing, along, (top, height), colours, space, invisible)
    }

    /// A hairline around a box.
    pub(super) fn frame(&mut self, [left, top, right, bottom]: [f64; 4]) {
        let outline = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
        self.drawing.line(&outline, HAIR, SOLID, self.palette.grid);
    }

    /// Colours as equal boxes side by side; says whether sRGB had to clip one.
    pub(super) fn boxes(&mut self, [left, top, right, bottom]: [f64; 4], colours: &[Rgb], space: RgbSpace) -> bool {
        let step = (right - left) / colours.len().max(1) as f64;
        let mut has_clipped = false;
        for (index, colour) in colours.iter().enumerate() {
            let (code, is_clipped) = srgb8(*colour, space);
            let x = left + step * index as f64;
            // Each reaches to the end and the next covers it: no seams.
            self.drawing.fill(x, top, right - x, bottom - top, Ink::opaque(code));
            has_clipped |= is_clipped;
        }
        has_clipped
    }

    /// Says that some of the colours shown are clipped.
    pub(super) fn clip_note(&mut self, has_clipped: bool) {
        if has_clipped {
            self.y += 22.0;
            let note = "Colours in sRGB; some lie outside it and are shown clipped.";
            self.drawing.text(Label::new(note, MARGIN, self.y, em::SMALL, self.palette.muted));
        }
    }

    /// Texts centred under an axis.
    pub(super) fn ticks_below(&mut self, axis: Axis, ticks: &[(f64, String)], baseline: f64) {
        for (value, text) in ticks {
            let label = Label::new(text.clone(), axis.at(*value), baseline, em::SMALL, self.palette.muted);
            self.drawing.text(label.aligned(Align::Centre));
        }
    }

    /// A name under the left end of an axis, in the column of names.
    pub(super) fn axis_name(&mut self, text: &str, baseline: f64) {
        let label = Label::new(text, LEFT - 2.0 * GUTTER, baseline, em::SMALL, self.palette.muted);
        self.drawing.text(label.aligned(Align::Right));
    }

    /// A triangle that points down at a place.
    pub(super) fn pointer(&mut self, (x, y): Point) {
        self.drawing.area(vec![(x, y), (x - 4.5, y - 8.0), (x + 4.5, y - 8.0)], self.palette.ink);
    }
}

/// Lines of ΔE over something, named at the right.
pub(super) struct Lines<'a> {
    pub(super) x: Axis,
    pub(super) x_ticks: &'a [(f64, String)],
    pub(super) top: f64,
    pub(super) height: f64,
    /// The values of each of [`Parameters::ALL`] at equal steps of x.
    pub(super) values: [Vec<f64>; 4],
}

impl Lines<'_> {
    /// Draws the lines with grid and names.
    pub(super) fn draw(&self, page: &mut Page) {
        let palette = page.palette;
        let most = self.values.iter().flatten().copied().filter(|v| v.is_finite()).fold(1.0, f64::max);
        let range = crate::figure::axis::rounded_out(0.0..=most, 4);
        let y = Axis::new((0.0, *range.end()), (self.top + self.height, self.top));
        self.grid(page, y);
        for (index, values) in self.values.iter().enumerate().rev() {
            page.drawing.line(&self.points(values, y), 2.0, dashes(index), palette.models[index]);
        }
        let ends: Vec<f64> =
            self.values.iter().map(|values| y.at(values.iter().copied().fold(0.0, f64::max))).collect();
        let places = spread(&ends, 17.0, self.top + 4.0..=self.top + self.height - 2.0);
        for (parameters, place) in Parameters::ALL.into_iter().zip(places) {
            page.name(parameters.label(), place, ink(parameters, palette));
        }
    }

    fn grid(&self, page: &mut Page, y: Axis) {
        let Palette { grid, muted, .. } = page.palette;
        let (left, right) = self.x.places;
        for (value, _) in self.x_ticks {
            let x = self.x.at(*value);
            page.drawing.rule((x, self.top), (x, self.top + self.height), HAIR, grid);
        }
        for value in y.ticks(4) {
            page.drawing.rule((left, y.at(value)), (right, y.at(value)), HAIR, grid);
            page.drawing.text(Label::new(tick_text(value), right + 8.0, y.at(value) + 4.0, em::SMALL, muted));
        }
    }

    fn points(&self, values: &[f64], y: Axis) -> Vec<Point> {
        let (from, to) = self.x.values;
        let steps = (values.len().max(2) - 1) as f64;
        let place =
            |(index, value): (usize, &f64)| (self.x.at(from + (to - from) * index as f64 / steps), y.at(*value));
        values.iter().enumerate().map(place).collect()
    }
}

/// The colour of a description's lines and name.
pub(super) fn ink(parameters: Parameters, palette: Palette) -> Ink {
    palette.models[parameters as usize]
}

fn dashes(index: usize) -> Dashes {
    index.checked_sub(1).map_or(SOLID, model_dashes)
}

/// The angles written under an axis of degrees.
pub(super) fn degree_ticks() -> Vec<(f64, String)> {
    (0..=6).map(|i| f64::from(i) * 15.0).map(|deg| (deg, format!("{deg}°"))).collect()
}

/// Shares written under a slider.
pub(super) fn share_ticks() -> Vec<(f64, String)> {
    (0..=4).map(|i| f64::from(i) * 0.25).map(|share| (share, format!("{:.0} %", 100.0 * share))).collect()
}

/// A ΔE with as many digits as say something.
pub(super) fn delta_e_text(value: f64) -> String {
    match value {
        v if v.is_nan() => "–".to_owned(),
        v if v < 1e-6 => "0".to_owned(),
        v if v < 0.095 => format!("{v:.2}"),
        v if v < 9.95 => format!("{v:.1}"),
        v => format!("{v:.0}"),
    }
}

/// Text broken between words into lines of a width.
pub(super) fn wrapped(text: &str, em: f64, width: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let line = lines.last_mut().expect("there is always a last line");
        let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        if line.is_empty() || text_width(&longer, Weight::Regular, em) <= width {
            *line = longer;
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_fit_and_keep_every_word() {
        let text = "Equal steps of g vary by 1.60 and those of h by 0.15 over the same appearances.";
        let lines = wrapped(text, 12.0, 150.0);
        assert!(lines.len() > 2 && lines.iter().all(|line| text_width(line, Weight::Regular, 12.0) <= 150.0));
        assert_eq!(lines.join(" "), text);
    }

    #[test]
    fn numbers_keep_two_digits_that_matter() {
        assert_eq!([0.0, 0.034, 0.46, 3.84, 21.05, f64::NAN].map(delta_e_text), ["0", "0.03", "0.5", "3.8", "21", "–"]);
    }
}
