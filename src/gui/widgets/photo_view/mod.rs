//! The photograph: marked by dragging, or held against the rendered match.

mod compare;
mod hold;
mod loupe;
mod paint;
mod placement;

use eframe::egui::{Sense, Ui, Vec2, WidgetInfo, accesskit::Role};

use crate::gui::photograph::{Looking, Session};
use hold::{cursor, drag, find_hold, keys};
use placement::{Frame, Placement, zoom};

/// Shows the photograph; returns the point of it under the pointer, in its pixels.
pub(crate) fn photo_view(ui: &mut Ui, session: &mut Session, size: Vec2) -> Option<[f64; 2]> {
    match session.comparison.looking {
        Looking::Photograph => marked(ui, session, size),
        _ => compare::show(ui, session, size),
    }
}

fn marked(ui: &mut Ui, session: &mut Session, size: Vec2) -> Option<[f64; 2]> {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, format!("Photograph {}", session.photo.name)));
    let frame = Frame::whole(session);
    zoom(ui, session, frame, rect, &response);
    let placement = Placement::of(session, frame, rect);
    let held = drag(ui, session, frame, placement, &response);
    keys(ui, session, &response);
    paint::paint(ui, session, rect, placement, &response);
    let pointer = response.hover_pos()?;
    let hold = held.or_else(|| find_hold(session, placement, pointer));
    ui.set_cursor_icon(cursor(session, hold));
    loupe::loupe(ui, session, rect, pointer, placement.pixel(pointer));
    Some(placement.pixel(pointer))
}
