//! How pixels of a photograph lie on the screen.

use eframe::egui::{Pos2, Rect, Response, Ui, Vec2, vec2};

use crate::gui::photograph::Session;

/// The most a picture is enlarged over the size that fits.
const MOST_ZOOM: f32 = 40.0;

/// The part of a photograph that fits into a view before it is enlarged, in its pixels.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    /// Left and top.
    pub origin: Vec2,
    /// Width and height.
    pub size: Vec2,
}

impl Frame {
    /// All of it.
    pub(super) fn whole(session: &Session) -> Self {
        Self { origin: Vec2::ZERO, size: vec2(session.photo.width as f32, session.photo.height as f32) }
    }
}

/// Where pixels are on the screen.
#[derive(Clone, Copy)]
pub(super) struct Placement {
    origin: Pos2,
    /// Points of the screen for each pixel.
    pub scale: f32,
}

impl Placement {
    /// Fits a frame into a rectangle, enlarged and moved as the session says.
    pub(super) fn of(session: &Session, frame: Frame, rect: Rect) -> Self {
        let scale = (rect.width() / frame.size.x).min(rect.height() / frame.size.y) * session.zoom;
        let centre = frame.origin + frame.size * (Vec2::splat(0.5) + session.pan);
        Self { origin: rect.center() - centre * scale, scale }
    }

    pub(super) fn screen(self, [x, y]: [f64; 2]) -> Pos2 {
        self.origin + vec2(x as f32, y as f32) * self.scale
    }

    pub(super) fn pixel(self, at: Pos2) -> [f64; 2] {
        let position = (at - self.origin) / self.scale;
        [f64::from(position.x), f64::from(position.y)]
    }
}

/// The wheel enlarges around the pointer; a double click shows all again.
pub(super) fn zoom(ui: &Ui, session: &mut Session, frame: Frame, rect: Rect, response: &Response) {
    if response.double_clicked() {
        (session.zoom, session.pan) = (1.0, Vec2::ZERO);
    }
    let Some(pointer) = response.hover_pos().filter(|pointer| rect.contains(*pointer)) else { return };
    let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta.y, input.zoom_delta()));
    let factor = pinch * (scroll / 200.0).exp();
    if factor == 1.0 {
        return;
    }
    let before = Placement::of(session, frame, rect).pixel(pointer);
    session.zoom = (session.zoom * factor).clamp(1.0, MOST_ZOOM);
    let after = Placement::of(session, frame, rect).pixel(pointer);
    let shift = |i: usize| ((before[i] - after[i]) / f64::from(frame.size[i])) as f32;
    session.pan = limited(session.pan + vec2(shift(0), shift(1)), session.zoom);
}

/// Moves the picture with the pointer.
pub(super) fn pan(session: &mut Session, frame: Frame, placement: Placement, drag: Vec2) {
    session.pan = limited(session.pan - drag / placement.scale / frame.size, session.zoom);
}

/// The middle of the view stays where there is picture.
fn limited(pan: Vec2, zoom: f32) -> Vec2 {
    let limit = 0.5 - 0.5 / zoom;
    pan.clamp(Vec2::splat(-limit), Vec2::splat(limit))
}
