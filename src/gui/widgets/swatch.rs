//! A colour as a patch on the screen.

use eframe::egui::{Color32, CornerRadius, Rect, Response, Sense, Shape, Stroke, StrokeKind, Ui, Vec2, pos2};

use crate::color::{Rgb, RgbSpace, hex_from_srgb8, srgb8};
use crate::gui::theme::{self, Palette};

/// The colour as the screen shows it, and whether it had to be clipped to sRGB.
pub(crate) fn colour32(rgb: Rgb, space: RgbSpace) -> (Color32, bool) {
    let ([red, green, blue], is_clipped) = srgb8(rgb, space);
    (Color32::from_rgb(red, green, blue), is_clipped)
}

/// A patch of a colour; a corner is marked where sRGB cannot show it.
pub(crate) fn swatch(ui: &mut Ui, rgb: Rgb, space: RgbSpace, size: Vec2) -> Response {
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    paint(ui, rect, rgb, space);
    let (code, is_clipped) = srgb8(rgb, space);
    let note = if is_clipped { "\nOutside sRGB: the screen shows the nearest colour" } else { "" };
    response.on_hover_text(format!("{} as sRGB{note}", hex_from_srgb8(code)))
}

fn paint(ui: &Ui, rect: Rect, rgb: Rgb, space: RgbSpace) {
    let (colour, is_clipped) = colour32(rgb, space);
    let rounding = CornerRadius::same(theme::ROUNDING);
    ui.painter().rect(rect, rounding, colour, ui.visuals().window_stroke(), StrokeKind::Inside);
    if is_clipped {
        ui.painter().add(clipped_corner(rect, Palette::of(ui).warning));
    }
}

/// The mark of a colour the screen cannot show: a triangle in the upper right corner.
pub(crate) fn clipped_corner(rect: Rect, colour: Color32) -> Shape {
    let side = (rect.height() / 4.0).min(10.0);
    let corner = rect.right_top();
    let points = vec![corner, corner + Vec2::new(-side, 0.0), pos2(corner.x, corner.y + side)];
    Shape::convex_polygon(points, colour, Stroke::NONE)
}
