//! The layout of a [`CurveFigure`]: reflectance, colours and differences on one angle axis.

use super::axis::{Axis, rounded_out, tick_text};
use super::curve::{CurveFigure, CurveSeries, DeltaE, STEPS_PER_DEG};
use super::drawing::{Align, Drawing, Label, Point};
use super::output::Figure;
use super::spread::spread;
use super::strip::draw_strip;
use super::style::{Dashes, FigureTheme, Ink, Palette, SOLID, em, model_dashes};
use super::text::{Weight, fitted, text_width};
use crate::fresnel::THETA_MAX_DEG;

/// Width of the panels.
const PANEL: f64 = 700.0;
/// Narrowest column of names.
const NAMES: f64 = 154.0;
/// Gap between the names and the panels.
const GUTTER: f64 = 14.0;
const MARGIN: f64 = 24.0;
/// Room for the values at the right.
const VALUES: f64 = 32.0 + MARGIN;
const KEY: f64 = 88.0;
/// From the key to the first panel.
const KEY_TO_PANEL: f64 = 36.0;
const CURVES: f64 = 330.0;
const TICK_ROW: f64 = 34.0;
const STRIP: f64 = 22.0;
const DELTA_E: f64 = 132.0;
/// Room for one name with its numbers beside the differences.
const DELTA_E_LABEL: f64 = 36.0;
/// Between panels, with room for a caption.
const PANEL_GAP: f64 = 40.0;
const LABEL_GAP: f64 = 16.0;
/// From the middle of a text's capitals to its baseline.
const TO_BASELINE: f64 = 4.2;

const CURVE: f64 = 2.0;
const HAIR: f64 = 1.0;

impl Figure for CurveFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let layout = Layout::of(self);
        let palette = theme.palette();
        let title = format!("{}. {}", self.title, self.subtitle);
        let mut drawing = Drawing::new(title, layout.right + VALUES, layout.height, palette.ground);
        let mut painter = Painter { figure: self, layout, palette, drawing: &mut drawing };
        painter.heading();
        painter.key();
        painter.reflectance();
        painter.strips();
        painter.differences();
        drawing
    }
}

/// Where the panels are.
#[derive(Clone, Copy, Debug)]
struct Layout {
    left: f64,
    right: f64,
    angle: Axis,
    reflectance: Axis,
    curves_top: f64,
    strips_top: f64,
    differences_top: f64,
    differences_height: f64,
    height: f64,
}

impl Layout {
    fn of(figure: &CurveFigure) -> Self {
        let range = rounded_out(figure.lowest()..=figure.highest(), 6);
        let names = figure.curves().map(|curve| text_width(&curve.label, Weight::SemiBold, em::LABEL));
        let left = MARGIN + names.fold(NAMES - MARGIN, f64::max).min(LONGEST_NAME) + GUTTER;
        let right = left + PANEL;
        let curves_top =
            KEY + KEY_TO_PANEL + KEY_LINE * (figure.key_places(left).last().map_or(0.0, |&(_, line)| line as f64));
        let strips_top = curves_top + CURVES + TICK_ROW;
        let strips_bottom = strips_top + STRIP * figure.curves().count() as f64;
        let differences_top = strips_bottom + PANEL_GAP;
        let differences_height = DELTA_E.max(DELTA_E_LABEL * figure.models.len() as f64);
        let has_differences = figure.truth.is_some() && !figure.models.is_empty();
        let bottom = if has_differences { differences_top + differences_height } else { strips_bottom };
        Self {
            left,
            right,
            angle: Axis::new((0.0, 90.0), (left, right)),
            reflectance: Axis::new((*range.start(), *range.end()), (curves_top + CURVES, curves_top)),
            curves_top,
            strips_top,
            differences_top,
            differences_height,
            height: bottom + 46.0,
        }
    }
}

/// Longer names are cut, with an ellipsis.
const LONGEST_NAME: f64 = 260.0;
const KEY_SAMPLE: f64 = 30.0;
const KEY_LINE: f64 = 20.0;

impl CurveFigure {
    /// The truth, then the models.
    fn curves(&self) -> impl Iterator<Item = &CurveSeries> {
        self.truth.iter().chain(&self.models)
    }

    fn finite_values(&self) -> impl Iterator<Item = f64> {
        let bands = self.curves().filter_map(|curve| curve.band.as_deref()).flatten();
        let values = self.curves().flat_map(|curve| curve.values.iter().copied());
        values.chain(bands.flat_map(|(low, high)| [*low, *high])).flat_map(|rgb| rgb.0).filter(|v| v.is_finite())
    }

    /// The lowest value shown: 0 where that costs no more than a third of the panel.
    fn lowest(&self) -> f64 {
        let lowest = self.finite_values().fold(1.0, f64::min);
        if (0.0..=0.34).contains(&lowest) { 0.0 } else { lowest.min(0.9) }
    }

    fn highest(&self) -> f64 {
        self.finite_values().fold(1.0, f64::max)
    }

    /// Where each entry of the key begins, and in which line.
    fn key_places(&self, left: f64) -> Vec<(f64, usize)> {
        let (mut x, mut line) = (left, 0);
        let widths =
            self.curves().map(|curve| KEY_SAMPLE + 8.0 + text_width(&short(&curve.label), Weight::Regular, em::LABEL));
        let place = |width: f64| {
            if x > left && x + width > left + PANEL {
                (x, line) = (left, line + 1);
            }
            x += width + 24.0;
            (x - width - 24.0, line)
        };
        widths.map(place).collect()
    }
}

struct Painter<'a> {
    figure: &'a CurveFigure,
    layout: Layout,
    palette: Palette,
    drawing: &'a mut Drawing,
}

impl Painter<'_> {
    fn heading(&mut self) {
        let (Palette { ink, muted, .. }, left) = (self.palette, self.layout.left);
        let title = fitted(&self.figure.title, Weight::SemiBold, em::TITLE, PANEL);
        let subtitle = fitted(&self.figure.subtitle, Weight::Regular, em::SUBTITLE, PANEL + VALUES - MARGIN);
        self.drawing.text(Label::new(title, left, 38.0, em::TITLE, ink).semi_bold());
        self.drawing.text(Label::new(subtitle, left, 58.0, em::SUBTITLE, muted));
    }

    /// One line sample for each curve.
    fn key(&mut self) {
        let ink = self.palette.ink;
        let places = self.figure.key_places(self.layout.left);
        for (index, (curve, (x, line))) in self.figure.curves().zip(places).enumerate() {
            let baseline = KEY + KEY_LINE * line as f64;
            let middle = baseline - TO_BASELINE;
            self.drawing.line(&[(x, middle), (x + KEY_SAMPLE, middle)], CURVE, dashes(index), ink);
            self.drawing.text(Label::new(short(&curve.label), x + KEY_SAMPLE + 8.0, baseline, em::LABEL, ink));
        }
    }

    fn reflectance(&mut self) {
        let Layout { angle, reflectance, curves_top, left, right, .. } = self.layout;
        self.caption("Reflectance", curves_top);
        self.grid(reflectance, 6);
        self.drawing.rule((left, reflectance.at(1.0)), (right, reflectance.at(1.0)), HAIR, self.palette.mark);
        self.angle_ticks(curves_top + CURVES + 19.0);
        let symbol = |text: &str, x| Label::new(text, x, curves_top - 8.0, em::LABEL, self.palette.ink).semi_bold();
        self.drawing.text(symbol("r", left - GUTTER).aligned(Align::Right));
        self.drawing.text(symbol("h", angle.at(THETA_MAX_DEG)).aligned(Align::Centre));
        for curve in self.figure.curves() {
            self.bands(curve);
        }
        let curves: Vec<_> = self.figure.curves().enumerate().collect();
        for (index, curve) in curves.into_iter().rev() {
            self.curve(curve, dashes(index));
        }
        self.channel_labels();
    }

    fn bands(&mut self, curve: &CurveSeries) {
        let Some(band) = &curve.band else { return };
        for channel in 0..3 {
            let lower = self.points(band.iter().map(|(low, _)| low[channel]), self.layout.reflectance);
            let upper = self.points(band.iter().map(|(_, high)| high[channel]), self.layout.reflectance);
            let outline = lower.into_iter().chain(upper.into_iter().rev()).collect();
            self.drawing.area(outline, self.palette.channels[channel].alpha(0.16));
        }
    }

    fn curve(&mut self, curve: &CurveSeries, dashes: Dashes) {
        for channel in 0..3 {
            let points = self.points(curve.values.iter().map(|v| v[channel]), self.layout.reflectance);
            self.drawing.line(&points, CURVE, dashes, self.palette.channels[channel]);
        }
    }

    /// The places of values at equal steps of the angle.
    fn points(&self, values: impl Iterator<Item = f64>, axis: Axis) -> Vec<Point> {
        let angle = |step: usize| self.layout.angle.at(step as f64 / STEPS_PER_DEG as f64);
        values.enumerate().map(|(step, value)| (angle(step), axis.at(value))).collect()
    }

    /// The channels and their r, where the first curve begins.
    fn channel_labels(&mut self) {
        let Layout { left, reflectance, curves_top, .. } = self.layout;
        let Some(r) = self.figure.curves().next().and_then(|curve| curve.values.first()) else { return };
        if !r.is_finite() {
            return;
        }
        let wanted = r.0.map(|v| reflectance.at(v));
        let places = spread(&wanted, LABEL_GAP, curves_top + 9.0..=curves_top + CURVES - 2.0);
        for (channel, name) in ["R", "G", "B"].into_iter().enumerate() {
            let ink = self.palette.channels[channel];
            let leader = [(left - GUTTER + 3.0, places[channel]), (left, wanted[channel])];
            self.drawing.line(&leader, HAIR, SOLID, ink);
            self.name(&format!("{name} {:.3}", r[channel]), places[channel], ink, Weight::SemiBold);
        }
    }

    /// A text in the column of names, beside a height.
    fn name(&mut self, text: &str, middle: f64, ink: Ink, weight: Weight) {
        let text = fitted(text, weight, em::LABEL, LONGEST_NAME);
        let label = Label::new(text, self.layout.left - GUTTER, middle + TO_BASELINE, em::LABEL, ink);
        self.drawing.text(Label { weight, ..label.aligned(Align::Right) });
    }

    fn strips(&mut self) {
        let Layout { left, right, angle, strips_top, .. } = self.layout;
        let Palette { ink, muted, grid, .. } = self.palette;
        let mut has_clipped = false;
        for (row, curve) in self.figure.curves().enumerate() {
            let top = strips_top + STRIP * row as f64;
            has_clipped |= draw_strip(self.drawing, angle, (top, STRIP), &curve.values, self.figure.space, muted);
            self.name(&curve.label, top + STRIP / 2.0, ink, Weight::Regular);
        }
        let bottom = strips_top + STRIP * self.figure.curves().count() as f64;
        let frame = [(left, strips_top), (right, strips_top), (right, bottom), (left, bottom), (left, strips_top)];
        self.drawing.line(&frame, HAIR, SOLID, grid);
        if has_clipped {
            let note = "Colours in sRGB; underlined where sRGB cannot show them and they are clipped.";
            self.drawing.text(Label::new(note, left, self.layout.height - 16.0, em::SMALL, muted));
        }
    }

    fn differences(&mut self) {
        let Some(truth) = &self.figure.truth else { return };
        let all: Vec<DeltaE> = self.figure.models.iter().map(|m| m.delta_e(truth, self.figure.space)).collect();
        if all.is_empty() {
            return;
        }
        let (top, bottom) = (self.layout.differences_top, self.layout.differences_top + self.layout.differences_height);
        let highest = all.iter().map(|delta_e| delta_e.max).fold(1.0, f64::max);
        let axis = Axis::new((0.0, *rounded_out(0.0..=highest, 3).end()), (bottom, top));
        self.caption("ΔE2000 to the truth", top);
        self.grid(axis, 3);
        for (index, delta_e) in all.iter().enumerate().rev() {
            let points = self.points(delta_e.values.iter().copied(), axis);
            self.drawing.line(&points, CURVE, model_dashes(index), self.model_ink(index));
        }
        self.difference_labels(&all, axis);
    }

    fn model_ink(&self, index: usize) -> Ink {
        self.palette.models[index % self.palette.models.len()]
    }

    /// Names with mean and maximum, as high as the peaks they name where there is room.
    fn difference_labels(&mut self, all: &[DeltaE], axis: Axis) {
        let wanted: Vec<f64> = all.iter().map(|delta_e| axis.at(delta_e.max)).collect();
        let (bottom, top) = axis.places;
        let places = spread(&wanted, DELTA_E_LABEL, top + 4.0..=bottom - LABEL_GAP);
        for (index, (delta_e, place)) in all.iter().zip(places).enumerate() {
            self.name(&self.figure.models[index].label, place, self.model_ink(index), Weight::SemiBold);
            let numbers = format!("mean {:.2}  max {:.2}", delta_e.mean, delta_e.max);
            let baseline = place + TO_BASELINE + 15.0;
            let numbers = Label::new(numbers, self.layout.left - GUTTER, baseline, em::SMALL, self.palette.muted);
            self.drawing.text(numbers.aligned(Align::Right));
        }
    }

    /// What a panel shows, above its left corner.
    fn caption(&mut self, text: &str, top: f64) {
        self.drawing.text(Label::new(text, self.layout.left, top - 8.0, em::SMALL, self.palette.muted));
    }

    /// Grid lines over the angle and the values, the values at the right, and the angle of h.
    fn grid(&mut self, axis: Axis, about: usize) {
        let Palette { grid, muted, mark, .. } = self.palette;
        let (Layout { left, right, angle, .. }, (bottom, top)) = (self.layout, axis.places);
        for deg in tick_angles_deg() {
            self.drawing.rule((angle.at(deg), top), (angle.at(deg), bottom), HAIR, grid);
        }
        for value in axis.ticks(about) {
            self.drawing.rule((left, axis.at(value)), (right, axis.at(value)), HAIR, grid);
            self.drawing.text(Label::new(tick_text(value), right + 8.0, axis.at(value) + 4.0, em::SMALL, muted));
        }
        let x = angle.at(THETA_MAX_DEG);
        self.drawing.line(&[(x, top), (x, bottom)], HAIR, &[3.0, 3.0], mark);
    }

    fn angle_ticks(&mut self, baseline: f64) {
        let (Palette { ink, muted, .. }, Layout { left, angle, .. }) = (self.palette, self.layout);
        let centred =
            |text: String, deg, ink| Label::new(text, angle.at(deg), baseline, em::SMALL, ink).aligned(Align::Centre);
        for deg in tick_angles_deg() {
            self.drawing.text(centred(format!("{deg}°"), deg, muted));
        }
        self.drawing.text(centred(format!("{THETA_MAX_DEG:.1}°"), THETA_MAX_DEG, ink).semi_bold());
        let name = Label::new("Angle of incidence", left - GUTTER, baseline, em::SMALL, muted);
        self.drawing.text(name.aligned(Align::Right));
    }
}

/// The first curve is solid, be it a truth or the only model.
fn dashes(index: usize) -> Dashes {
    index.checked_sub(1).map_or(SOLID, model_dashes)
}

/// A name as the key and the strips show it.
fn short(label: &str) -> String {
    fitted(label, Weight::Regular, em::LABEL, LONGEST_NAME)
}

fn tick_angles_deg() -> impl Iterator<Item = f64> {
    (0..=6).map(|i| f64::from(i) * 15.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::figure::curve_figure;
    use crate::fresnel::FresnelModel;
    use crate::metal::{Metal, metal_by_name, preferred_metals};

    fn figure_of(metal: &Metal, space: RgbSpace) -> CurveFigure {
        let (r, h) = (metal.r(space), metal.h(space));
        let models = [("Hoffman (r, h)", FresnelModel::Hoffman { r, h }), ("Schlick (r)", FresnelModel::Schlick { r })];
        curve_figure(Some(metal), &models, space)
    }

    /// No text lies on another or leaves the page, for any metal; the spaces take turns.
    #[test]
    fn no_text_is_covered_or_cut() {
        for (metal, space) in preferred_metals().zip(RgbSpace::ALL.into_iter().cycle()) {
            let drawing = figure_of(metal, space).drawing(FigureTheme::Light);
            crate::figure::check::assert_texts_are_legible(&drawing);
        }
    }

    /// Long names and many models find room, or are cut with an ellipsis.
    #[test]
    fn many_and_long_names_fit() {
        let r = crate::color::Rgb([0.5, 0.6, 0.7]);
        let long = "A material with a name that somebody made far too long for any label ".repeat(3);
        let names: Vec<String> = (0..9).map(|i| format!("{i} {}", &long[..20 * i + 3])).collect();
        let models: Vec<(&str, FresnelModel)> =
            names.iter().map(|name| (name.as_str(), FresnelModel::Schlick { r })).collect();
        let figure = CurveFigure {
            title: long.clone(),
            ..curve_figure(Some(metal_by_name("zinc").unwrap()), &models, RgbSpace::AcesCg)
        };
        crate::figure::check::assert_texts_are_legible(&figure.drawing(FigureTheme::Dark));
    }

    #[test]
    fn models_without_a_truth_are_drawn_without_differences() {
        let nothing = FresnelModel::Conductor { n: crate::color::Rgb::splat(f64::NAN), k: crate::color::Rgb::WHITE };
        let figure = curve_figure(None, &[("No material", nothing)], RgbSpace::LinRec709);
        let drawing = figure.drawing(FigureTheme::Light);
        crate::figure::check::assert_texts_are_legible(&drawing);
        assert!(drawing.labels().all(|label| !label.text.contains("ΔE")));
    }

    #[test]
    fn the_svg_names_what_it_shows() {
        let svg = figure_of(metal_by_name("gold").unwrap(), RgbSpace::LinRec709).to_svg(FigureTheme::Light);
        let document = roxmltree::Document::parse(&svg).unwrap();
        let texts: Vec<&str> =
            document.descendants().filter(|n| n.has_tag_name("text")).filter_map(|n| n.text()).map(str::trim).collect();
        for expected in ["Gold", "Hoffman (r, h)", "Schlick (r)", "Truth", "81.8°", "ΔE2000 to the truth"] {
            assert!(texts.contains(&expected), "{expected} in {texts:?}");
        }
        assert!(texts.iter().any(|text| text.starts_with("Colours in sRGB")), "gold's red is outside linear sRGB");
    }

    /// The strips show the colours of the curves.
    #[test]
    fn strips_are_the_srgb_codes_of_the_curves() {
        let figure = figure_of(metal_by_name("copper").unwrap(), RgbSpace::AcesCg);
        let picture = figure.drawing(FigureTheme::Dark).to_picture(1.0);
        let layout = Layout::of(&figure);
        for (row, curve) in figure.curves().enumerate() {
            for deg in [9, 36, 63, 81] {
                let (x, y) = (layout.angle.at(deg as f64), layout.strips_top + STRIP * (row as f64 + 0.5));
                let code = crate::color::srgb8(curve.values[STEPS_PER_DEG * deg], figure.space).0;
                assert_eq!(picture.rgb(x as u32, y as u32), code, "{row} {deg}");
            }
        }
    }
}
