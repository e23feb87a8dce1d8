//! The photograph with its marks: zoomed, panned, and marked by dragging.

use eframe::egui::{
    Color32, CursorIcon, EventFilter, Key, Modifiers, Pos2, Rect, Response, Sense, Shape, Stroke, StrokeKind, Ui, Vec2,
    WidgetInfo, accesskit::Role, pos2, vec2,
};

use crate::gui::photograph::{Mark, MarkShape, Session};
use crate::gui::theme::{self, Palette};
use crate::photo::Circle;

/// Angles of the bands that are read, and of the ring that h is about.
const FACING_DEG: f64 = 40.0;
const GRAZING_DEG: [f64; 2] = [55.0, 83.0];
const EDGE_DEG: [f64; 2] = [81.0, 83.0];
/// The most a picture is enlarged over the size that fits.
const MOST_ZOOM: f32 = 40.0;

/// What a drag took hold of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Hold {
    Move(Mark),
    Resize(Mark, usize),
    Pan,
}

/// How pixels of the photograph lie on the screen.
#[derive(Clone, Copy)]
struct Placement {
    origin: Pos2,
    scale: f32,
}

impl Placement {
    fn of(session: &Session, rect: Rect) -> Self {
        let size = vec2(session.photo.width as f32, session.photo.height as f32);
        let scale = (rect.width() / size.x).min(rect.height() / size.y) * session.zoom;
        let centre = size * (Vec2::splat(0.5) + session.pan);
        Self { origin: rect.center() - centre * scale, scale }
    }

    fn screen(self, [x, y]: [f64; 2]) -> Pos2 {
        self.origin + vec2(x as f32, y as f32) * self.scale
    }

    fn pixel(self, at: Pos2) -> [f64; 2] {
        let position = (at - self.origin) / self.scale;
        [f64::from(position.x), f64::from(position.y)]
    }
}

/// Shows the photograph; returns the point of it under the pointer, in its pixels.
pub(crate) fn photo_view(ui: &mut Ui, session: &mut Session, size: Vec2) -> Option<[f64; 2]> {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, format!("Photograph {}", session.photo.name)));
    zoom(ui, session, rect, &response);
    let placement = Placement::of(session, rect);
    let held = drag(ui, session, placement, &response);
    keys(ui, session, &response);
    paint(ui, session, rect, placement, &response);
    let pointer = response.hover_pos()?;
    let hold = held.or_else(|| find_hold(session, placement, pointer));
    ui.set_cursor_icon(cursor(hold));
    loupe(ui, session, rect, pointer, placement.pixel(pointer));
    Some(placement.pixel(pointer))
}

fn cursor(hold: Option<Hold>) -> CursorIcon {
    match hold {
        Some(Hold::Move(_)) => CursorIcon::Move,
        Some(Hold::Resize(..)) => CursorIcon::Crosshair,
        Some(Hold::Pan) => CursorIcon::Grab,
        None => CursorIcon::Default,
    }
}

/// The wheel enlarges around the pointer; a double click shows all again.
fn zoom(ui: &Ui, session: &mut Session, rect: Rect, response: &Response) {
    if response.double_clicked() {
        (session.zoom, session.pan) = (1.0, Vec2::ZERO);
    }
    let Some(pointer) = response.hover_pos() else { return };
    let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta.y, input.zoom_delta()));
    let factor = pinch * (scroll / 200.0).exp();
    if factor == 1.0 {
        return;
    }
    let before = Placement::of(session, rect).pixel(pointer);
    session.zoom = (session.zoom * factor).clamp(1.0, MOST_ZOOM);
    let after = Placement::of(session, rect).pixel(pointer);
    let size = [f64::from(session.photo.width), f64::from(session.photo.height)];
    let shift = |i: usize| ((before[i] - after[i]) / size[i]) as f32;
    session.pan = limited(session.pan + vec2(shift(0), shift(1)), session.zoom);
}

/// The middle of the view stays where there is picture.
fn limited(pan: Vec2, zoom: f32) -> Vec2 {
    let limit = 0.5 - 0.5 / zoom;
    pan.clamp(Vec2::splat(-limit), Vec2::splat(limit))
}

fn drag(ui: &Ui, session: &mut Session, placement: Placement, response: &Response) -> Option<Hold> {
    let id = response.id.with("hold");
    if response.drag_started() {
        let origin = ui.input(|input| input.pointer.press_origin())?;
        let hold = find_hold(session, placement, origin).unwrap_or(Hold::Pan);
        session.before_drag = Some(session.request.clone());
        response.request_focus();
        ui.data_mut(|data| data.insert_temp(id, hold));
    }
    if response.clicked() {
        let pointer = response.interact_pointer_pos()?;
        session.selected = find_hold(session, placement, pointer).and_then(marked);
        response.request_focus();
    }
    // Esc ends the drag before this sees it; what was dragged goes back.
    if ui.input(|input| input.key_pressed(Key::Escape))
        && let Some(before) = session.before_drag.take()
    {
        session.request = before;
        return None;
    }
    if !response.dragged() {
        session.before_drag = None;
        return None;
    }
    let hold: Hold = ui.data(|data| data.get_temp(id))?;
    let pointer = response.interact_pointer_pos()?;
    match hold {
        Hold::Pan => {
            let size = vec2(session.photo.width as f32, session.photo.height as f32);
            session.pan = limited(session.pan - response.drag_delta() / placement.scale / size, session.zoom);
        }
        Hold::Move(mark) => {
            let shift = response.total_drag_delta()? / placement.scale;
            let before = session.before_drag.as_ref().and_then(|request| mark.shape(request))?;
            mark.set(&mut session.request, before.moved(f64::from(shift.x), f64::from(shift.y)));
        }
        Hold::Resize(mark, grip) => change(session, mark, |shape| shape.resized(grip, placement.pixel(pointer))),
    }
    session.selected = marked(hold).or(session.selected);
    Some(hold)
}

fn marked(hold: Hold) -> Option<Mark> {
    match hold {
        Hold::Move(mark) | Hold::Resize(mark, _) => Some(mark),
        Hold::Pan => None,
    }
}

fn change(session: &mut Session, mark: Mark, to: impl FnOnce(MarkShape) -> MarkShape) {
    if let Some(shape) = mark.shape(&session.request) {
        mark.set(&mut session.request, to(shape));
    }
}

/// What a press here takes hold of: a grip before a mark, and of several marks the one drawn last.
fn find_hold(session: &Session, placement: Placement, at: Pos2) -> Option<Hold> {
    let marks = Mark::all_of(&session.request);
    let shapes = || marks.iter().rev().filter_map(|mark| Some((*mark, mark.shape(&session.request)?)));
    let grip_at = |shape: MarkShape| {
        let distance = |grip: &[f64; 2]| placement.screen(*grip).distance(at);
        shape.grips().iter().position(|grip| distance(grip) < theme::GRIP_REACH)
    };
    let by_grip = shapes().find_map(|(mark, shape)| Some(Hold::Resize(mark, grip_at(shape)?)));
    let inside = || shapes().find(|(_, shape)| shape.contains(placement.pixel(at))).map(|(mark, _)| Hold::Move(mark));
    by_grip.or_else(inside).or((session.zoom > 1.0).then_some(Hold::Pan))
}

/// Arrows move the selected mark by a pixel, with Shift by ten; Delete takes it away.
fn keys(ui: &Ui, session: &mut Session, response: &Response) {
    if !response.has_focus() {
        return;
    }
    let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, escape: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let take = |modifiers, key| ui.input_mut(|input| input.consume_key(modifiers, key));
    let Some(mark) = session.selected else { return };
    let arrows = [
        (Key::ArrowLeft, -1.0, 0.0),
        (Key::ArrowRight, 1.0, 0.0),
        (Key::ArrowUp, 0.0, -1.0),
        (Key::ArrowDown, 0.0, 1.0),
    ];
    for (key, dx, dy) in arrows {
        for (modifiers, step) in [(Modifiers::SHIFT, 10.0), (Modifiers::NONE, 1.0)] {
            if take(modifiers, key) {
                change(session, mark, |shape| shape.moved(dx * step, dy * step));
            }
        }
    }
    if take(Modifiers::NONE, Key::Delete) {
        session.remove(mark);
    }
}

fn paint(ui: &mut Ui, session: &mut Session, rect: Rect, placement: Placement, response: &Response) {
    let palette = Palette::of(ui);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 0, palette.canvas);
    let corner = [f64::from(session.photo.width), f64::from(session.photo.height)];
    let picture = Rect::from_two_pos(placement.screen([0.0, 0.0]), placement.screen(corner));
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    if let Some(texture) = session.developer.texture(ui.ctx(), &session.preview, session.development) {
        painter.image(texture.id(), picture, whole, Color32::WHITE);
    }
    if let Some(circle) = session.request.circle {
        painter.extend(bands(circle, placement));
    }
    for mark in Mark::all_of(&session.request) {
        let is_selected = session.selected == Some(mark);
        if let Some(shape) = mark.shape(&session.request) {
            painter.extend(outline(shape, placement, is_selected));
        }
    }
    let stroke = if response.has_focus() { Stroke::new(1.0, palette.accent) } else { ui.visuals().window_stroke() };
    ui.painter().rect_stroke(rect, 0, stroke, StrokeKind::Outside);
}

/// The bands of angles that are read, and the ring around 81.8°.
fn bands(circle: Circle, placement: Placement) -> Vec<Shape> {
    let centre = placement.screen([circle.x, circle.y]);
    let radius = |deg: f64| circle.ring_radius(deg) as f32 * placement.scale;
    // Lines, not tints: a tint would change the very colours that are to be judged.
    let limits = [FACING_DEG, GRAZING_DEG[0], GRAZING_DEG[1]].into_iter().flat_map(|deg| {
        let line = |shift: f32, colour| Shape::circle_stroke(centre, radius(deg) + shift, Stroke::new(1.0, colour));
        [line(0.5, theme::BAND_EDGE), line(-0.5, theme::BAND)]
    });
    let (low, high) = (radius(EDGE_DEG[0]), radius(EDGE_DEG[1]));
    let edge = Stroke::new((high - low).max(0.5), theme::MARK.gamma_multiply(0.55));
    limits.chain([Shape::circle_stroke(centre, (low + high) / 2.0, edge)]).collect()
}

fn outline(shape: MarkShape, placement: Placement, is_selected: bool) -> Vec<Shape> {
    let colour = if is_selected { theme::SELECTED_MARK } else { theme::MARK };
    let strokes = [Stroke::new(3.0, theme::MARK_EDGE), Stroke::new(1.25, colour)];
    let mut shapes: Vec<Shape> = strokes
        .into_iter()
        .map(|stroke| match shape {
            MarkShape::Round(Circle { x, y, radius }) => {
                Shape::circle_stroke(placement.screen([x, y]), radius as f32 * placement.scale, stroke)
            }
            MarkShape::Square([x, y, width, height]) => {
                let corners = Rect::from_two_pos(placement.screen([x, y]), placement.screen([x + width, y + height]));
                Shape::rect_stroke(corners, 0, stroke, StrokeKind::Middle)
            }
        })
        .collect();
    let side = if is_selected { 2.0 * theme::GRIP } else { theme::GRIP };
    for grip in shape.grips() {
        let grip = Rect::from_center_size(placement.screen(grip), Vec2::splat(side));
        shapes.push(Shape::rect_filled(grip, 1, colour));
        shapes.push(Shape::rect_stroke(grip, 1, Stroke::new(1.0, theme::MARK_EDGE), StrokeKind::Outside));
    }
    shapes
}

/// The pixels around a point, one by one, with the middle one outlined: in a corner away from the pointer.
fn loupe(ui: &Ui, session: &Session, view: Rect, pointer: Pos2, [x, y]: [f64; 2]) {
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
            let (colour, _) = super::colour32(pixel.rgb * gain, crate::color::RgbSpace::LinRec709);
            painter.rect_filled(cell.shrink(0.25), 0, colour);
        }
    }
    let middle = Rect::from_center_size(rect.center(), Vec2::splat(side));
    painter.rect_stroke(middle, 0, Stroke::new(2.5, theme::MARK_EDGE), StrokeKind::Outside);
    painter.rect_stroke(middle, 0, Stroke::new(1.0, theme::SELECTED_MARK), StrokeKind::Outside);
}
