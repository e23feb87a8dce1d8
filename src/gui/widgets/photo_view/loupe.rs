//! The loupe: pixels of the full data, one by one.

use eframe::egui::{Pos2, Rect, Stroke, StrokeKind, Ui, Vec2, vec2};

use crate::color::RgbSpace;
use crate::gui::photograph::Session;
use crate::gui::theme;
use crate::gui::widgets::colour32;

/// The pixels around a point, one by one, with the middle one outlined: in a corner away from the pointer.
pub(super) fn loupe(ui: &Ui, session: &Session, view: Rect, pointer: Pos2, [x, y]: [f64; 2]) {
    const PIXELS: i64 = 15;
    let left = Rect::from_min_size(view.min + Vec2::splat(theme::GAP), Vec2::splat(theme::LOUPE));
    let right = left.translate(vec2(view.width() - theme::LOUPE - 2.0 * theme::GAP, 0.0));
    let rect = if left.expand(theme::LOUPE / 2.0).contains(pointer) { right } else { left };
    let painter = ui.painter_at(rect.expand(2.0));
    painter.rect_filled(rect.expand(1.0), 0, theme::LOUPE_GRID);
    painter.rect_stroke(rect, 0, Stroke::new(1.0, theme::MARK_EDGE), StrokeKind::Outside);
    let side = theme::LOUPE / PIXELS as f32;
    let gain = f64::from(session.development.exposure_ev.exp2());
    for (row, column) in (0..PIXELS).flat_map(|row| (0..PIXELS).map(move |column| (row, column))) {
        let at = |base: f64, offset: i64| u32::try_from(base.floor() as i64 + offset - PIXELS / 2).ok();
        let pixel = at(x, column).zip(at(y, row)).and_then(|(column, row)| session.photo.pixel(column, row));
        let cell = Rect::from_min_size(rect.min + vec2(column as f32, row as f32) * side, Vec2::splat(side));
        if let Some(pixel) = pixel {
            let (colour, _) = colour32(pixel.rgb * gain, RgbSpace::LinRec709);
            painter.rect_filled(cell.shrink(0.25), 0, colour);
        }
    }
    let middle = Rect::from_center_size(rect.center(), Vec2::splat(side));
    painter.rect_stroke(middle, 0, Stroke::new(2.5, theme::MARK_EDGE), StrokeKind::Outside);
    painter.rect_stroke(middle, 0, Stroke::new(1.0, theme::SELECTED_MARK), StrokeKind::Outside);
}
