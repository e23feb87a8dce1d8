//! ΔE of the four descriptions along an axis, under the bands it belongs to.

use eframe::egui::{
    Align2, Color32, CornerRadius, Pos2, Rect, Response, Sense, Shape, Stroke, Ui, WidgetInfo, accesskit::Role, pos2,
};
use egui_plot::LineStyle;

use super::{delta_e_text, row};
use crate::gui::theme::{self, Palette};
use crate::study::Parameters;

/// Four lines over one axis.
pub(super) struct Chart<'a> {
    /// What the values are.
    pub caption: &'a str,
    /// Values at equal steps, for each of [`Parameters::ALL`].
    pub values: [Vec<f64>; 4],
    /// Names under the axis.
    pub ticks: &'a [(f32, String)],
    /// A line at this share of the axis.
    pub cursor: Option<f32>,
    /// What a share of the axis is called.
    pub name_of: &'a dyn Fn(f64) -> String,
}

impl Chart<'_> {
    /// Shows it in the height that is left.
    pub(super) fn show(self, ui: &mut Ui, height: f32) {
        legend(ui, self.caption);
        let (rect, response) = row::allocate(ui, height.max(theme::LEAST_CHART));
        let palette = Palette::of(ui);
        ui.painter().rect_filled(rect, CornerRadius::ZERO, palette.canvas);
        let top = scale(&self.values);
        self.grid(ui, rect, top);
        for (parameters, values) in Parameters::ALL.into_iter().zip(&self.values).rev() {
            line(ui, parameters, &points(values, rect, top));
        }
        if let Some(share) = self.cursor {
            ui.painter().vline(rect.left() + rect.width() * share, rect.y_range(), Stroke::new(1.0, palette.guide));
        }
        self.explain(ui, rect, &response);
        row::ticks(ui, self.ticks);
    }

    fn grid(&self, ui: &Ui, rect: Rect, top: f64) {
        let stroke = Stroke::new(1.0, Palette::of(ui).grid);
        for (share, _) in self.ticks {
            ui.painter().vline(rect.left() + rect.width() * share, rect.y_range(), stroke);
        }
        for value in marks(top) {
            let y = rect.bottom() - rect.height() * (value / top) as f32;
            ui.painter().hline(rect.x_range(), y, stroke);
            let at = pos2(rect.left() - theme::GAP, y);
            let text = delta_e_text(value);
            ui.painter().text(at, Align2::RIGHT_CENTER, text, row::small(ui), ui.visuals().weak_text_color());
        }
    }

    /// The values under the pointer, and the largest for those who cannot see.
    fn explain(&self, ui: &Ui, rect: Rect, response: &Response) {
        let spoken = || {
            let largest = |p: Parameters| self.values[p as usize].iter().copied().fold(0.0, f64::max);
            let each = Parameters::ALL.map(|p| format!("{} at most {}", p.label(), delta_e_text(largest(p))));
            format!("{}: {}", self.caption, each.join(", "))
        };
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, spoken()));
        let Some(pointer) = response.hover_pos().filter(|pointer| rect.contains(*pointer)) else { return };
        let share = f64::from((pointer.x - rect.left()) / rect.width());
        ui.painter().vline(pointer.x, rect.y_range(), Stroke::new(1.0, Palette::of(ui).guide));
        let value = |p: Parameters| format!("{}  {}", p.label(), delta_e_text(at(&self.values[p as usize], share)));
        let text = format!("{}\n{}", (self.name_of)(share), Parameters::ALL.map(value).join("\n"));
        response.clone().on_hover_text_at_pointer(text);
    }
}

/// The caption, and how each description is drawn.
fn legend(ui: &mut Ui, caption: &str) {
    ui.horizontal(|ui| {
        ui.add_space(theme::BAND_NAMES);
        ui.label(theme::hint(caption));
        for parameters in Parameters::ALL {
            ui.add_space(theme::GAP);
            let (sample, _) = ui.allocate_exact_size(crate::gui::widgets::SAMPLE, Sense::hover());
            line(ui, parameters, &[sample.left_center(), sample.right_center()]);
            ui.label(theme::hint(parameters.label()).color(row::ink(ui, parameters)));
        }
    });
}

fn line(ui: &Ui, parameters: Parameters, points: &[Pos2]) {
    let colour: Color32 = row::ink(ui, parameters);
    let stroke = Stroke::new(1.6, colour);
    let shapes = match theme::contestant_line(parameters as usize).0 {
        LineStyle::Solid => vec![Shape::line(points.to_vec(), stroke)],
        LineStyle::Dotted { spacing } => Shape::dotted_line(points, colour, spacing, 1.0),
        LineStyle::Dashed { length } => Shape::dashed_line(points, stroke, length, 0.5 * length),
    };
    ui.painter().extend(shapes);
}

fn points(values: &[f64], rect: Rect, top: f64) -> Vec<Pos2> {
    let last = values.len().saturating_sub(1).max(1) as f32;
    let point = |(index, value): (usize, &f64)| {
        let share = (value / top).clamp(0.0, 1.0) as f32;
        pos2(rect.left() + rect.width() * index as f32 / last, rect.bottom() - rect.height() * share)
    };
    values.iter().enumerate().filter(|(_, value)| value.is_finite()).map(point).collect()
}

/// A value at any share of the axis, linear between steps.
fn at(values: &[f64], share: f64) -> f64 {
    let Some(last) = values.len().checked_sub(1) else { return f64::NAN };
    let place = share.clamp(0.0, 1.0) * last as f64;
    let (below, above) = (place.floor() as usize, place.ceil() as usize);
    values[below] + (values[above] - values[below]) * (place - place.floor())
}

/// The upper end of the axis: a little above every value.
fn scale(values: &[Vec<f64>; 4]) -> f64 {
    let finite = values.iter().flatten().copied().filter(|value| value.is_finite());
    finite.fold(0.5, f64::max) * 1.06
}

/// Round values that give two to five lines.
pub(super) fn marks(top: f64) -> impl Iterator<Item = f64> {
    let step = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0].into_iter().find(|step| top / step <= 5.0).unwrap_or(50.0);
    (0..=(top / step) as u32).map(move |index| f64::from(index) * step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_holds_every_value_with_a_few_round_marks() {
        for most in [0.0, 0.03, 0.9, 4.0, 13.0, 88.0] {
            let values = [vec![0.0, most], vec![f64::NAN], vec![], vec![0.0]];
            let top = scale(&values);
            assert!(top > most && (2..=6).contains(&marks(top).count()), "{most}: {top}");
        }
    }

    #[test]
    fn values_between_steps_are_linear() {
        assert_eq!([0.0, 0.25, 0.5, 1.0, 2.0].map(|share| at(&[0.0, 2.0, 6.0], share)), [0.0, 1.0, 2.0, 6.0, 6.0]);
        assert!(at(&[], 0.5).is_nan());
    }
}
