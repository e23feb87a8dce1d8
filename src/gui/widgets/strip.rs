//! A strip of colours over the angles, on the axis of the plot above it.

use std::ops::RangeInclusive;

use eframe::egui::{Align2, Mesh, Rect, Sense, StrokeKind, TextStyle, Ui, Vec2, pos2};

use super::swatch::{clipped_corner, colour32};
use crate::color::{Rgb, RgbSpace};
use crate::gui::theme::{self, Palette};
use crate::gui::truth::at_angle;

/// Shows `curve` as a strip between the left and right ends of `frame`, with its name at the left; returns the angle
/// under the pointer.
pub(crate) fn strip(
    ui: &mut Ui,
    frame: Rect,
    name: &str,
    curve: &[Rgb],
    space: RgbSpace,
    range_deg: &RangeInclusive<f64>,
) -> Option<f64> {
    let (row, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), theme::STRIP), Sense::hover());
    let rect = Rect::from_x_y_ranges(frame.x_range(), row.y_range());
    let is_clipped = paint(ui, rect, curve, space, range_deg);
    let label = ui.visuals().weak_text_color();
    let font = TextStyle::Small.resolve(ui.style());
    ui.painter().text(pos2(frame.left() - theme::GAP, row.center().y), Align2::RIGHT_CENTER, name, font, label);
    if is_clipped {
        ui.painter().add(clipped_corner(rect, Palette::of(ui).warning));
    }
    let pointer = response.hover_pos().filter(|pointer| rect.contains(*pointer))?;
    let weight = f64::from((pointer.x - rect.left()) / rect.width());
    Some(range_deg.start() + (range_deg.end() - range_deg.start()) * weight)
}

/// One step of colour for each pixel, so that nothing is blended in the wrong space. True if a colour was clipped.
fn paint(ui: &Ui, rect: Rect, curve: &[Rgb], space: RgbSpace, range_deg: &RangeInclusive<f64>) -> bool {
    let steps = (rect.width() * ui.pixels_per_point()).round().max(1.0) as u32;
    let mut mesh = Mesh::default();
    let mut is_clipped = false;
    for step in 0..steps {
        let at = |step: f32| rect.left() + rect.width() * step / steps as f32;
        let weight = (f64::from(step) + 0.5) / f64::from(steps);
        let angle_deg = range_deg.start() + (range_deg.end() - range_deg.start()) * weight;
        let (colour, was_clipped) = colour32(at_angle(curve, angle_deg), space);
        is_clipped |= was_clipped;
        let x = at(step as f32)..=at(step as f32 + 1.0);
        mesh.add_colored_rect(Rect::from_x_y_ranges(x, rect.y_range()), colour);
    }
    ui.painter().add(mesh);
    ui.painter().rect_stroke(rect, 0, ui.visuals().window_stroke(), StrokeKind::Outside);
    is_clipped
}
