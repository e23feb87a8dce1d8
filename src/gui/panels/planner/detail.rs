//! What is said of one material: its errors over the angle, and every variant with what became of it.

use eframe::egui::{
    Align, Align2, Color32, CornerRadius, Label, Layout, Mesh, Pos2, Rangef, Rect, Response, RichText, Sense, Shape,
    Stroke, StrokeKind, TextStyle, TextWrapMode, Ui, Vec2, WidgetInfo, WidgetText, accesskit::Role, pos2,
};

use egui_extras::{Column, TableBuilder, TableRow};

use super::silhouette::silhouette;
use super::words;
use crate::gui::panels::demonstrations::row;
use crate::gui::planner::{Planned, PlannerPage};
use crate::gui::theme::{self, Palette};
use crate::scene::{Angles, Judgement, MaterialCurves, MaterialPlan, NODES, Tolerance, Verdict, node_cosines};
use crate::study::Variant;

/// Shows the material that is selected.
pub(super) fn show(ui: &mut Ui, page: &PlannerPage, planned: &Planned) {
    let id = page.entries().get(page.selected).map(|entry| entry.id);
    let at = match page.is_fixed() {
        true => Some(page.selected),
        false => id.and_then(|id| planned.entries.iter().position(|own| *own == id)),
    };
    let Some((at, material)) = at.and_then(|at| Some((at, planned.plan.materials.get(at)?))) else { return };
    ui.add_space(theme::GAP);
    ui.separator();
    said(ui, material, planned.plan.tolerance);
    let height = (ui.available_height() - theme::GAP).max(theme::PLAN_CHART);
    let chart = Chart {
        material,
        curves: planned.curves.get(at),
        angles: planned.seen.as_ref().and_then(|seen| seen.angles.get(at)),
        tolerance: planned.plan.tolerance,
    };
    ui.horizontal_top(|ui| {
        let table = theme::JUDGEMENTS.min(theme::JUDGEMENTS_SHARE * ui.available_width());
        let width = ui.available_width() - table - theme::GROUP_GAP;
        let down = Layout::top_down(Align::LEFT);
        ui.allocate_ui_with_layout(Vec2::new(width, height), down, |ui| chart.show(ui, height));
        ui.add_space(theme::GROUP_GAP);
        ui.vertical(|ui| judgements(ui, material, planned.plan.tolerance, height));
    });
}

/// Why this model: what is cheaper and too far, and what a person should know.
fn said(ui: &mut Ui, material: &MaterialPlan, tolerance: Tolerance) {
    let reason = material.reason(tolerance);
    let reason = if reason.is_empty() { "nothing is cheaper".to_owned() } else { format!("too far: {reason}") };
    ui.horizontal(|ui| {
        ui.label(theme::title(&material.name));
        let text = format!("{}; {reason}", material.choice().reason(tolerance));
        ui.add(Label::new(&text).truncate()).on_hover_text(text);
    });
    if !material.notes.is_empty() {
        let all = material.notes.join("\n");
        let notes = theme::hint(format!("▲ {}", material.notes.join(". "))).color(Palette::of(ui).warning);
        ui.add(Label::new(notes).truncate()).on_hover_text(all);
    }
}

/// Every variant, the cheapest first.
fn judgements(ui: &mut Ui, material: &MaterialPlan, tolerance: Tolerance, height: f32) {
    let numbers = theme::JUDGEMENT_COLUMNS.map(Column::exact);
    let table = TableBuilder::new(ui).striped(true).max_scroll_height(height - theme::ROW).auto_shrink([false, true]);
    let table = table.column(Column::remainder().clip(true));
    let table = numbers.into_iter().fold(table, TableBuilder::column);
    let table = table.header(theme::ROW, |mut header| {
        header.col(|ui| _ = ui.label(theme::hint("Cheapest first")));
        for heading in [tolerance.on.label(), "operations", "bytes"] {
            header.col(|ui| right(ui, theme::hint(heading)));
        }
        header.col(|ui| last(ui, theme::hint("verdict")));
    });
    table.body(|body| {
        body.rows(theme::JUDGEMENT_ROW, material.judgements.len(), |mut row| {
            let judgement = &material.judgements[row.index()];
            judged(&mut row, judgement, tolerance);
        });
    });
}

fn right(ui: &mut Ui, text: RichText) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(text));
}

/// At the right end, with room for the bar that scrolls.
fn last(ui: &mut Ui, text: RichText) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        ui.add_space(theme::GAP);
        ui.label(text);
    });
}

fn judged(row: &mut TableRow<'_, '_>, judgement: &Judgement, tolerance: Tolerance) {
    let is_chosen = judgement.verdict == Verdict::Chosen;
    let ink = |text: RichText| if is_chosen { text.strong() } else { text };
    row.col(|ui| {
        let label = Label::new(ink(RichText::new(judgement.variant.label()).size(11.5))).truncate();
        ui.add(label).on_hover_text(judgement.reason(tolerance));
    });
    row.col(|ui| {
        let value = theme::number(words::delta_e(judgement.error.of(tolerance.on)));
        let is_too_far = judgement.verdict == Verdict::TooFar;
        right(ui, if is_too_far { value.color(Palette::of(ui).error) } else { ink(value) });
    });
    for count in [judgement.cost.shader_operations.into(), judgement.cost.parameter_bytes] {
        row.col(|ui| right(ui, ink(theme::number(words::count(count)))));
    }
    row.col(|ui| {
        let verdict = theme::hint(words::verdict(judgement.verdict));
        last(ui, if is_chosen { verdict.color(Palette::of(ui).good) } else { verdict });
    });
}

/// ΔE over the angle: what was chosen, what was nearly, the tolerance, and how often each angle is seen.
struct Chart<'a> {
    material: &'a MaterialPlan,
    curves: &'a MaterialCurves,
    angles: Option<&'a Angles>,
    tolerance: Tolerance,
}

/// A curve of the chart.
struct Curve<'a> {
    name: String,
    delta_e: &'a [f64; NODES],
    colour: Color32,
    width: f32,
}

impl Chart<'_> {
    fn show(&self, ui: &mut Ui, height: f32) {
        let curves = self.curves(ui);
        legend(ui, &curves, self.angles.is_some());
        let above = ui.min_rect().height() + theme::GAP;
        let size = Vec2::new(ui.available_width(), (height - above - theme::TICKS).max(60.0));
        let (whole, response) = ui.allocate_exact_size(size, Sense::hover());
        let rect = Rect::from_min_max(whole.min + Vec2::new(theme::AXIS_WIDTH, 4.0), whole.max);
        ui.painter().rect_filled(rect, CornerRadius::ZERO, Palette::of(ui).canvas);
        let top = self.top(&curves);
        grid(ui, rect, top);
        self.seen(ui, rect);
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let limit = rect.bottom() - rect.height() * (self.tolerance.delta_e / top) as f32;
        let ends = [pos2(rect.left(), limit), pos2(rect.right(), limit)];
        painter.extend(Shape::dashed_line(&ends, Stroke::new(1.0, Palette::of(ui).warning), 5.0, 4.0));
        for curve in curves.iter().rev() {
            painter.add(Shape::line(points(curve.delta_e, rect, top), Stroke::new(curve.width, curve.colour)));
        }
        self.dim_unseen(ui, rect);
        ui.painter().rect_stroke(rect, 0, ui.visuals().window_stroke(), StrokeKind::Outside);
        self.name_limit(ui, rect, limit);
        self.explain(ui, rect, &response, &curves);
    }

    /// What was chosen, then the dearest of what is too far and cheaper, for which one would like to settle.
    fn curves(&self, ui: &Ui) -> Vec<Curve<'_>> {
        let palette = Palette::of(ui);
        let curve = |variant: Variant, colour, width| {
            let delta_e = &*self.curves.variant(variant)?.delta_e;
            Some(Curve { name: variant.label(), delta_e, colour, width })
        };
        let chosen = curve(self.material.chosen, palette.accent, 2.0);
        let cheaper = self.material.judgements.iter().take_while(|j| j.verdict == Verdict::TooFar).last();
        let cheaper = cheaper.and_then(|judgement| curve(judgement.variant, palette.error, 1.2));
        chosen.into_iter().chain(cheaper).collect()
    }

    /// The upper end of the axis: what is chosen and the tolerance fit; what is too far may leave.
    fn top(&self, curves: &[Curve<'_>]) -> f64 {
        let chosen = curves.first().map_or(0.0, |curve| largest(curve.delta_e));
        let cheaper = curves.get(1).map_or(0.0, |curve| largest(curve.delta_e));
        let least = 1.25 * self.tolerance.delta_e.max(self.material.choice().error.max_delta_e).max(0.02);
        least.max((1.1 * chosen.max(cheaper)).min(4.0 * least))
    }

    /// How often each angle is seen, as a silhouette along the axis.
    fn seen(&self, ui: &Ui, rect: Rect) {
        const SHARE: f32 = 0.3;
        let Some(angles) = self.angles else { return };
        let fill = ui.visuals().text_color().gamma_multiply(0.14);
        let density = silhouette(angles);
        let most = density.iter().map(|(_, value)| *value).fold(0.0, f64::max);
        if most <= 0.0 {
            return;
        }
        let mut mesh = Mesh::default();
        for (index, (deg, value)) in density.iter().enumerate() {
            let x = x_of(rect, *deg);
            mesh.colored_vertex(pos2(x, rect.bottom()), fill);
            mesh.colored_vertex(pos2(x, rect.bottom() - rect.height() * SHARE * (value / most) as f32), fill);
            if index > 0 {
                let corner = 2 * index as u32;
                mesh.add_triangle(corner - 2, corner - 1, corner);
                mesh.add_triangle(corner - 1, corner, corner + 1);
            }
        }
        ui.painter().add(mesh);
    }

    /// What is not seen does not count.
    fn dim_unseen(&self, ui: &Ui, rect: Rect) {
        let Some((from, to)) = self.material.seen_deg else { return };
        let fill = ui.visuals().panel_fill.gamma_multiply(0.7);
        for (low, high) in [(0.0, from), (to, 90.0)] {
            let x = Rangef::new(x_of(rect, low), x_of(rect, high));
            if high - low > 0.5 {
                ui.painter().rect_filled(Rect::from_x_y_ranges(x, rect.y_range()), CornerRadius::ZERO, fill);
            }
        }
    }

    fn name_limit(&self, ui: &Ui, rect: Rect, limit: f32) {
        let text = format!("tolerance {}", self.tolerance.delta_e);
        let at = pos2(rect.left() + 6.0, limit - 2.0);
        let colour = Palette::of(ui).warning;
        ui.painter().text(at, Align2::LEFT_BOTTOM, text, row::small(ui), colour);
    }

    /// The values under the pointer, and the largest for those who cannot see.
    fn explain(&self, ui: &Ui, rect: Rect, response: &Response, curves: &[Curve<'_>]) {
        let each = |curve: &Curve<'_>| format!("{} at most {}", curve.name, words::delta_e(largest(curve.delta_e)));
        let spoken = || {
            let all: Vec<String> = curves.iter().map(each).collect();
            format!("ΔE of {} over 0–90°: {}", self.material.name, all.join(", "))
        };
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, spoken()));
        let Some(pointer) = response.hover_pos().filter(|pointer| rect.contains(*pointer)) else { return };
        let deg = 90.0 * f64::from((pointer.x - rect.left()) / rect.width());
        ui.painter().vline(pointer.x, rect.y_range(), Stroke::new(1.0, Palette::of(ui).guide));
        let value = |curve: &Curve<'_>| format!("{}  ΔE {}", curve.name, words::delta_e(at(curve.delta_e, deg)));
        let all: Vec<String> = curves.iter().map(value).collect();
        response.clone().on_hover_text_at_pointer(format!("{deg:.0}°\n{}", all.join("\n")));
    }
}

/// In as many rows as it takes: a chart beside a table may be narrow.
fn legend(ui: &mut Ui, curves: &[Curve<'_>], has_angles: bool) {
    ui.horizontal(|ui| {
        ui.add_space(theme::AXIS_WIDTH);
        ui.horizontal_wrapped(|ui| {
            ui.label(theme::hint("ΔE to the truth"));
            ui.add_space(theme::GAP);
            for curve in curves {
                entry(ui, &curve.name, |ui, sample| {
                    let stroke = Stroke::new(curve.width, curve.colour);
                    ui.painter().hline(sample.x_range(), sample.center().y, stroke);
                });
            }
            if has_angles {
                entry(ui, "how often seen", |ui, sample| {
                    ui.painter().rect_filled(sample, 0, ui.visuals().text_color().gamma_multiply(0.14));
                });
            }
        });
    });
}

/// A sample and its name, which stay together.
fn entry(ui: &mut Ui, name: &str, paint: impl FnOnce(&Ui, Rect)) {
    let text = WidgetText::from(theme::hint(name));
    let text = text.into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, TextStyle::Small);
    let width = crate::gui::widgets::SAMPLE.x + ui.spacing().item_spacing.x + text.size().x;
    if ui.available_size_before_wrap().x < width {
        ui.end_row();
    }
    let (sample, _) = ui.allocate_exact_size(crate::gui::widgets::SAMPLE, Sense::hover());
    paint(ui, sample);
    ui.add(Label::new(text));
    ui.add_space(theme::GAP);
}

fn grid(ui: &Ui, rect: Rect, top: f64) {
    let (stroke, weak) = (Stroke::new(1.0, Palette::of(ui).grid), ui.visuals().weak_text_color());
    for deg in (0..=6_u8).map(|index| 15.0 * f64::from(index)) {
        let x = x_of(rect, deg);
        ui.painter().vline(x, rect.y_range(), stroke);
        let text = format!("{deg:.0}°");
        ui.painter().text(pos2(x, rect.bottom() + 4.0), Align2::CENTER_TOP, text, row::small(ui), weak);
    }
    for value in marks(top) {
        let y = rect.bottom() - rect.height() * (value / top) as f32;
        ui.painter().hline(Rangef::new(rect.left(), rect.right()), y, stroke);
        let text = format!("{value}");
        ui.painter().text(pos2(rect.left() - theme::GAP, y), Align2::RIGHT_CENTER, text, row::small(ui), weak);
    }
}

/// Round values that give two to five lines.
fn marks(top: f64) -> impl Iterator<Item = f64> {
    let steps = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0];
    let step =
        steps.into_iter().find(|step| top / step <= 5.0).unwrap_or_else(|| 10_f64.powf((top / 5.0).log10().ceil()));
    // From whole numbers: 3 × 0.1 is not 0.3.
    (0..=(top / step) as u32).map(move |index| (f64::from(index) * step * 100.0).round() / 100.0)
}

fn x_of(rect: Rect, deg: f64) -> f32 {
    rect.left() + rect.width() * (deg / 90.0) as f32
}

fn points(delta_e: &[f64; NODES], rect: Rect, top: f64) -> Vec<Pos2> {
    let nodes = node_cosines().iter().zip(delta_e).filter(|(_, value)| value.is_finite());
    // Beyond the frame a line is cut anyway; far beyond it would lose precision.
    let y = |value: f64| rect.bottom() - rect.height() * (value / top).min(10.0) as f32;
    nodes.map(|(c, value)| pos2(x_of(rect, c.deg()), y(*value))).collect()
}

fn largest(delta_e: &[f64; NODES]) -> f64 {
    delta_e.iter().copied().filter(|value| value.is_finite()).fold(0.0, f64::max)
}

/// The value at an angle, of the nearest node.
fn at(delta_e: &[f64; NODES], deg: f64) -> f64 {
    let place = deg.to_radians().cos().max(0.0).sqrt() * (NODES - 1) as f64;
    delta_e[(place.round() as usize).min(NODES - 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_round_and_few() {
        for top in [0.03, 0.4, 1.25, 7.0, 60.0] {
            let marks: Vec<f64> = marks(top).collect();
            assert!((2..=6).contains(&marks.len()), "{top}: {marks:?}");
            assert!(marks.iter().all(|mark| format!("{mark}").len() <= 4), "{marks:?}");
        }
    }
}
