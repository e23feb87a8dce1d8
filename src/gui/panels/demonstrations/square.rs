//! The square itself: two regions, the metals, and a cross for each channel of the preset.

use eframe::egui::{
    Align2, Color32, CornerRadius, EventFilter, Id, Key, Mesh, Modifiers, Pos2, Rect, Response, Sense, Shape, Stroke,
    StrokeKind, Ui, Vec2, WidgetInfo, accesskit::Role, pos2, vec2,
};

use super::{dots::nearest, row};
use crate::color::Rgb;
use crate::fresnel::h_of_schlick;
use crate::gui::demonstrations::ShownSquare;
use crate::gui::theme::{self, Palette};
use crate::gui::widgets::channel_names;
use crate::preset::Preset;
use crate::study::{BoundaryRow, MetalPoint};

/// Both axes reach a little beyond the square: measured gold does too.
const HIGHEST: f64 = 1.1;
/// Room for the names of the axes.
const BESIDE: f32 = 42.0;
/// What an arrow key moves, and with Shift.
const STEP: f64 = 0.005;
const LARGE_STEP: f64 = 0.05;

/// The regions' colours.
pub(super) fn feasible_fill(ui: &Ui) -> Color32 {
    ui.visuals().text_color().gamma_multiply(0.10)
}

/// The band inside it.
pub(super) fn reachable_fill(ui: &Ui) -> Color32 {
    ui.visuals().text_color().gamma_multiply(0.26)
}

/// From values to places on the screen.
#[derive(Clone, Copy)]
struct Axes {
    rect: Rect,
}

impl Axes {
    fn at(self, r: f64, h: f64) -> Pos2 {
        let share = |value: f64| (value / HIGHEST) as f32;
        pos2(self.rect.left() + self.rect.width() * share(r), self.rect.bottom() - self.rect.height() * share(h))
    }

    /// A pair beyond the axes, on their edge.
    fn on_page(self, r: f64, h: f64) -> Pos2 {
        let limited = |value: f64| if value.is_nan() { 0.0 } else { value.clamp(0.0, HIGHEST) };
        self.at(limited(r), limited(h))
    }

    /// How much a distance on the screen is worth.
    fn change(self, distance: Vec2) -> (f64, f64) {
        let share = distance / self.rect.size();
        (f64::from(share.x) * HIGHEST, -f64::from(share.y) * HIGHEST)
    }
}

/// Shows the square, `side` points wide with its axes; a drag of a cross changes the preset.
pub(super) fn show(ui: &mut Ui, side: f32, shown: &ShownSquare, preset: &mut Preset) {
    let (whole, response) = ui.allocate_exact_size(Vec2::splat(side), Sense::hover());
    let rect = Rect::from_min_size(whole.min + vec2(theme::AXIS_WIDTH, 2.0), Vec2::splat(side - BESIDE));
    let axes = Axes { rect };
    ui.painter().rect_filled(rect, CornerRadius::ZERO, Palette::of(ui).canvas);
    regions(ui, axes, &shown.boundary);
    grid(ui, axes);
    let dots: Vec<Pos2> = shown.points.iter().map(|point| axes.on_page(point.r, point.h)).collect();
    for (dot, point) in dots.iter().zip(&shown.points) {
        ui.painter().circle_filled(*dot, theme::DOT, channel_colour(ui, point).gamma_multiply(0.85));
    }
    let inside = shown.points.iter().filter(|point| point.is_feasible).count();
    let spoken = format!("{} measured channels, {inside} of them inside the region", shown.points.len());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &spoken));
    let is_on_cross = crosses(ui, axes, preset);
    if !is_on_cross {
        name_dot(ui, &response, &dots, &shown.points);
    }
}

fn channel_colour(ui: &Ui, point: &MetalPoint) -> Color32 {
    let channel = channel_names().iter().position(|name| *name == point.channel).unwrap_or(0);
    Palette::of(ui).channels[channel]
}

fn regions(ui: &Ui, axes: Axes, boundary: &[BoundaryRow]) {
    let feasible = |row: &BoundaryRow| (row.r, row.feasible_low, row.feasible_high);
    let reachable = |row: &BoundaryRow| (row.r, row.reachable_low, row.reachable_high);
    let rows = |of: fn(&BoundaryRow) -> (f64, f64, f64)| -> Vec<(f64, f64, f64)> {
        boundary.iter().map(of).filter(|(_, low, high)| low.is_finite() && high.is_finite()).collect()
    };
    let feasible = rows(feasible);
    ui.painter().add(area(axes, &feasible, feasible_fill(ui)));
    ui.painter().add(area(axes, &rows(reachable), reachable_fill(ui)));
    let stroke = Stroke::new(1.0, Palette::of(ui).guide);
    for side in [|row: &(f64, f64, f64)| row.1, |row: &(f64, f64, f64)| row.2] {
        let line = feasible.iter().map(|row| axes.at(row.0, side(row))).collect();
        ui.painter().add(Shape::line(line, stroke));
    }
}

/// What lies between a lower and an upper curve.
fn area(axes: Axes, rows: &[(f64, f64, f64)], fill: Color32) -> Mesh {
    let mut mesh = Mesh::default();
    for (index, &(r, low, high)) in rows.iter().enumerate() {
        mesh.colored_vertex(axes.at(r, low), fill);
        mesh.colored_vertex(axes.at(r, high), fill);
        if index > 0 {
            let corner = 2 * index as u32;
            mesh.add_triangle(corner - 2, corner - 1, corner);
            mesh.add_triangle(corner - 1, corner, corner + 1);
        }
    }
    mesh
}

fn grid(ui: &Ui, axes: Axes) {
    let palette = Palette::of(ui);
    let (rect, weak) = (axes.rect, ui.visuals().weak_text_color());
    let stroke = Stroke::new(1.0, palette.grid);
    for mark in (0..=5u8).map(|index| 0.2 * f64::from(index)) {
        let at = axes.at(mark, mark);
        ui.painter().vline(at.x, rect.y_range(), stroke);
        ui.painter().hline(rect.x_range(), at.y, stroke);
        let text = format!("{mark:.1}");
        ui.painter().text(pos2(at.x, rect.bottom() + 4.0), Align2::CENTER_TOP, &text, row::small(ui), weak);
        ui.painter().text(pos2(rect.left() - 6.0, at.y), Align2::RIGHT_CENTER, &text, row::small(ui), weak);
    }
    let ends = [axes.at(0.0, h_of_schlick(0.0)), axes.at(1.0, 1.0)];
    ui.painter().extend(Shape::dotted_line(&ends, palette.guide, 4.0, 1.0));
    ui.painter().rect_stroke(rect, 0, ui.visuals().window_stroke(), StrokeKind::Outside);
    for (name, r, h) in [("0 ≤ F ≤ 1", 0.3, 0.2), ("real n and k", 0.24, 0.52), ("Schlick", 0.09, 0.59)] {
        ui.painter().text(axes.at(r, h), Align2::LEFT_CENTER, name, row::small(ui), ui.visuals().text_color());
    }
    let below = pos2(rect.center().x, rect.bottom() + 18.0);
    ui.painter().text(below, Align2::CENTER_TOP, "r, facing the surface", row::small(ui), weak);
    let inside = rect.left_top() + vec2(8.0, 6.0);
    ui.painter().text(inside, Align2::LEFT_TOP, "h, at 81.8°", row::small(ui), weak);
}

/// Names the metal under the pointer.
fn name_dot(ui: &Ui, response: &Response, dots: &[Pos2], points: &[MetalPoint]) {
    let Some(index) = response.hover_pos().and_then(|pointer| nearest(dots, pointer)) else { return };
    let MetalPoint { name, channel, r, h, .. } = &points[index];
    ui.painter().circle_stroke(dots[index], theme::DOT + 2.0, Stroke::new(1.5, ui.visuals().strong_text_color()));
    response.clone().on_hover_text_at_pointer(format!("{name}, {channel}\nr {r:.4}, h {h:.4}"));
}

/// What a drag took hold of.
#[derive(Clone, Copy)]
struct Grip {
    r: Rgb,
    h: Rgb,
    origin: Pos2,
}

/// Shows the crosses; true when the pointer is at one.
fn crosses(ui: &mut Ui, axes: Axes, preset: &mut Preset) -> bool {
    let mut is_at_one = false;
    for (channel, name) in channel_names().into_iter().enumerate() {
        let (r, h) = (preset.r[channel], preset.h[channel]);
        let place = axes.on_page(r, h);
        let id = ui.scope_id().with(("cross", channel));
        let area = Rect::from_center_size(place, Vec2::splat(2.0 * theme::CROSS + 4.0));
        let response = ui.interact(area, id, Sense::drag());
        let spoken = format!("Cross of {name}: r {r:.4}, h {h:.4}");
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, &spoken));
        is_at_one |= response.contains_pointer() || response.dragged();
        paint_cross(ui, &response, place, cross_colour(ui, channel, preset));
        drag(ui, axes, &response, channel, preset);
        press(ui, &response, channel, preset);
        response.on_hover_text(format!("{spoken}\nDrag, or press the arrow keys"));
    }
    is_at_one
}

/// The channel's own colour, unless all three lie on each other.
fn cross_colour(ui: &Ui, channel: usize, preset: &Preset) -> Color32 {
    let is_grey = |rgb: Rgb| rgb.max_channel() == rgb.min_channel();
    let palette = Palette::of(ui);
    if is_grey(preset.r) && is_grey(preset.h) { ui.visuals().strong_text_color() } else { palette.channels[channel] }
}

fn paint_cross(ui: &Ui, response: &Response, at: Pos2, colour: Color32) {
    let arm = theme::CROSS;
    let edge = Stroke::new(4.5, Palette::of(ui).canvas);
    for stroke in [edge, Stroke::new(2.2, colour)] {
        ui.painter().line_segment([at - vec2(arm, 0.0), at + vec2(arm, 0.0)], stroke);
        ui.painter().line_segment([at - vec2(0.0, arm), at + vec2(0.0, arm)], stroke);
    }
    if response.has_focus() || response.hovered() || response.dragged() {
        ui.painter().circle_stroke(at, arm + 3.0, Stroke::new(1.5, Palette::of(ui).accent));
    }
}

fn drag(ui: &Ui, axes: Axes, response: &Response, channel: usize, preset: &mut Preset) {
    let id: Id = response.id.with("grip");
    let pointer = ui.input(|input| input.pointer.interact_pos());
    if response.drag_started()
        && let Some(origin) = ui.input(|input| input.pointer.press_origin())
    {
        ui.data_mut(|data| data.insert_temp(id, Grip { r: preset.r, h: preset.h, origin }));
        // The arrow keys go on where the drag ends.
        response.request_focus();
    }
    let grip = ui.data(|data| data.get_temp::<Grip>(id));
    let (Some(grip), Some(pointer)) = (grip.filter(|_| response.dragged()), pointer) else { return };
    let change = axes.change(pointer - grip.origin);
    move_from(&grip, channel, change, ui.input(|input| input.modifiers.alt), preset);
}

/// Arrow keys move a cross that has the focus.
fn press(ui: &Ui, response: &Response, channel: usize, preset: &mut Preset) {
    if !response.has_focus() {
        return;
    }
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    let (across, up, Modifiers { shift, alt, .. }) = ui.input(|input| {
        let presses = |key| input.num_presses(key) as f64;
        let across = presses(Key::ArrowRight) - presses(Key::ArrowLeft);
        (across, presses(Key::ArrowUp) - presses(Key::ArrowDown), input.modifiers)
    });
    if (across, up) != (0.0, 0.0) {
        let step = if shift { LARGE_STEP } else { STEP };
        let grip = Grip { r: preset.r, h: preset.h, origin: Pos2::ZERO };
        move_from(&grip, channel, (across * step, up * step), alt, preset);
    }
}

/// Moves a channel, and unless `is_alone` every channel that lay on it.
fn move_from(grip: &Grip, channel: usize, (of_r, of_h): (f64, f64), is_alone: bool, preset: &mut Preset) {
    let pair = |index: usize| (grip.r[index], grip.h[index]);
    for index in 0..3 {
        let is_moved = index == channel || (!is_alone && pair(index) == pair(channel));
        let (r, h) = pair(index);
        preset.r.0[index] = if is_moved { moved(r, of_r) } else { r };
        preset.h.0[index] = if is_moved { moved(h, of_h) } else { h };
    }
}

/// A value moved no further than the axes reach; one that is beyond them already stays there.
fn moved(value: f64, change: f64) -> f64 {
    (value + change).clamp(value.min(0.0), value.max(HIGHEST))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grip() -> Grip {
        Grip { r: Rgb([0.5, 0.5, 0.4]), h: Rgb([0.8, 0.8, 0.7]), origin: Pos2::ZERO }
    }

    #[test]
    fn channels_that_lie_on_each_other_move_together_unless_held_apart() {
        let mut preset = Preset::new_authored();
        move_from(&grip(), 0, (0.1, -0.2), false, &mut preset);
        assert!(preset.r.max_abs_difference(Rgb([0.6, 0.6, 0.4])) < 1e-12, "{:?}", preset.r);
        assert!(preset.h.max_abs_difference(Rgb([0.6, 0.6, 0.7])) < 1e-12, "{:?}", preset.h);
        move_from(&grip(), 0, (0.1, 0.0), true, &mut preset);
        assert!(preset.r.max_abs_difference(Rgb([0.6, 0.5, 0.4])) < 1e-12, "{:?}", preset.r);
    }

    #[test]
    fn nothing_is_dragged_off_the_page_and_what_is_beyond_is_not_pulled_in() {
        assert_eq!([moved(0.5, 9.0), moved(0.5, -9.0)], [HIGHEST, 0.0]);
        assert_eq!([moved(1.4, 0.2), moved(-0.2, -0.1)], [1.4, -0.2]);
        assert!((moved(1.4, -0.1) - 1.3).abs() < 1e-12);
    }

    #[test]
    fn places_and_changes_are_inverse() {
        let axes = Axes { rect: Rect::from_min_size(pos2(10.0, 20.0), Vec2::splat(550.0)) };
        let (r, h) = axes.change(axes.at(0.7, 0.9) - axes.at(0.2, 0.5));
        assert!((r - 0.5).abs() < 1e-5 && (h - 0.4).abs() < 1e-5, "{r} {h}");
        assert_eq!(axes.on_page(2.0, f64::NAN), axes.at(HIGHEST, 0.0));
    }
}
