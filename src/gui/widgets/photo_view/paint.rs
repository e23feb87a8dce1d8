//! The photograph with everything that is marked in it.

use eframe::egui::{
    Align2, Color32, Painter, Rect, Response, Shape, Stroke, StrokeKind, TextStyle, Ui, Vec2, pos2, vec2,
};

use super::placement::Placement;
use crate::gui::photograph::{Mark, MarkShape, Session};
use crate::gui::theme::{self, Palette};
use crate::photo::{Area, Body, Circle, Cylinder};

/// Angles of the bands that are read, and of the ring that h is about.
const FACING_DEG: f64 = 40.0;
const GRAZING_DEG: [f64; 2] = [55.0, 83.0];
const EDGE_DEG: [f64; 2] = [81.0, 83.0];

pub(super) fn paint(ui: &mut Ui, session: &mut Session, rect: Rect, placement: Placement, response: &Response) {
    let palette = Palette::of(ui);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 0, palette.canvas);
    let corner = [f64::from(session.photo.width), f64::from(session.photo.height)];
    let picture = Rect::from_two_pos(placement.screen([0.0, 0.0]), placement.screen(corner));
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    if let Some(texture) = session.developer.texture(ui.ctx(), &session.preview, session.development) {
        painter.image(texture.id(), picture, whole, Color32::WHITE);
    }
    if let Some(body) = session.request.body() {
        painter.extend(bands(body, placement));
    }
    for grey in &session.request.greys {
        painter.extend(outline(shape_of(grey.area), placement, theme::MARK));
    }
    for mark in Mark::all_of(&session.request) {
        let is_selected = session.selected == Some(mark);
        if let Some(shape) = mark.shape(&session.request) {
            let colour = if is_selected { theme::SELECTED_MARK } else { theme::MARK };
            painter.extend(outline(shape, placement, colour));
            painter.extend(grips(shape, placement, colour, is_selected));
        }
    }
    labels(ui, &painter, session, placement);
    let stroke = if response.has_focus() { Stroke::new(1.0, palette.accent) } else { ui.visuals().window_stroke() };
    ui.painter().rect_stroke(rect, 0, stroke, StrokeKind::Outside);
}

/// The bands of angles that are read, and the ring around 81.8°.
fn bands(body: Body, placement: Placement) -> Vec<Shape> {
    let radius = |deg: f64| body.ring_radius(deg) as f32 * placement.scale;
    // Lines, not tints: a tint would change the very colours that are to be judged.
    let limits = [FACING_DEG, GRAZING_DEG[0], GRAZING_DEG[1]].into_iter().flat_map(|deg| {
        let line = |shift: f32, colour| ring(body, placement, radius(deg) + shift, Stroke::new(1.0, colour));
        line(0.5, theme::BAND_EDGE).into_iter().chain(line(-0.5, theme::BAND))
    });
    let (low, high) = (radius(EDGE_DEG[0]), radius(EDGE_DEG[1]));
    let edge = Stroke::new((high - low).max(0.5), theme::MARK.gamma_multiply(0.55));
    limits.chain(ring(body, placement, (low + high) / 2.0, edge)).collect()
}

/// Where a body is at a distance from its centre or its axis, in points of the screen: a circle, or a line on each side.
fn ring(body: Body, placement: Placement, distance: f32, stroke: Stroke) -> Vec<Shape> {
    match body {
        Body::Ball(circle) => {
            vec![Shape::circle_stroke(placement.screen([circle.x, circle.y]), distance, stroke)]
        }
        Body::Cylinder(cylinder) => {
            let [ux, uy] = cylinder.direction().map(|u| u as f32);
            let Cylinder { x0, y0, x1, y1, .. } = cylinder;
            let ends = [[x0, y0], [x1, y1]].map(|end| placement.screen(end));
            let line = |side: f32| ends.map(|end| end + vec2(-uy, ux) * (side * distance));
            [-1.0, 1.0].map(|side| Shape::line_segment(line(side), stroke)).to_vec()
        }
    }
}

fn shape_of(area: Area) -> MarkShape {
    match area {
        Area::Box { x, y, width, height } => MarkShape::Square([x, y, width, height]),
        Area::Disc { x, y, radius } => MarkShape::Round(Circle::new(x, y, radius)),
    }
}

fn outline(shape: MarkShape, placement: Placement, colour: Color32) -> [Shape; 2] {
    let strokes = [Stroke::new(3.0, theme::MARK_EDGE), Stroke::new(1.25, colour)];
    strokes.map(|stroke| match shape {
        MarkShape::Round(Circle { x, y, radius }) => {
            Shape::circle_stroke(placement.screen([x, y]), radius as f32 * placement.scale, stroke)
        }
        MarkShape::Square([x, y, width, height]) => {
            let corners = Rect::from_two_pos(placement.screen([x, y]), placement.screen([x + width, y + height]));
            Shape::rect_stroke(corners, 0, stroke, StrokeKind::Middle)
        }
        MarkShape::Quad(corners) => Shape::closed_line(corners.map(|corner| placement.screen(corner)).to_vec(), stroke),
        MarkShape::Rod(cylinder) => {
            Shape::closed_line(cylinder.corners().map(|corner| placement.screen(corner)).to_vec(), stroke)
        }
    })
}

fn grips(shape: MarkShape, placement: Placement, colour: Color32, is_selected: bool) -> Vec<Shape> {
    let side = if is_selected { 2.0 * theme::GRIP } else { theme::GRIP };
    let grip = |at: [f64; 2]| {
        let grip = Rect::from_center_size(placement.screen(at), Vec2::splat(side));
        let edge = Stroke::new(1.0, theme::MARK_EDGE);
        [Shape::rect_filled(grip, 1, colour), Shape::rect_stroke(grip, 1, edge, StrokeKind::Outside)]
    };
    shape.grips().into_iter().flat_map(grip).collect()
}

/// The names of the marks, the selected one first; where two would cover each other the later one is left out.
fn labels(ui: &Ui, painter: &Painter, session: &Session, placement: Placement) {
    let request = &session.request;
    let mut marks = Mark::all_of(request);
    // What is measured needs no name by itself.
    marks.retain(|mark| !mark.is_body() || request.reference_ball.is_some());
    marks.sort_by_key(|mark| session.selected != Some(*mark));
    let mut taken: Vec<Rect> = Vec::new();
    for mark in marks {
        let Some(shape) = mark.shape(request) else { continue };
        let colour = if session.selected == Some(mark) { theme::SELECTED_MARK } else { theme::MARK };
        let font = TextStyle::Small.resolve(ui.style());
        let galley = painter.layout_no_wrap(mark.name(request), font, colour);
        let ground = label_place(shape, placement, galley.size(), painter.clip_rect());
        if taken.iter().all(|other| !other.intersects(ground)) {
            painter.rect_filled(ground, 2, theme::MARK_EDGE);
            painter.galley(ground.shrink2(LABEL_MARGIN).min, galley, colour);
            taken.push(ground);
        }
    }
}

/// Around the words of a label.
const LABEL_MARGIN: Vec2 = Vec2::new(3.0, 1.0);

/// Above a mark, or below it where the view ends.
fn label_place(shape: MarkShape, placement: Placement, size: Vec2, view: Rect) -> Rect {
    let [x, y, width, height] = shape.bounds();
    let at = |y: f64, align: Align2, away: f32| {
        let point = placement.screen([x + width / 2.0, y]) + vec2(0.0, away);
        align.anchor_size(point, size).expand2(LABEL_MARGIN)
    };
    let above = at(y, Align2::CENTER_BOTTOM, -theme::GRIP_REACH);
    if above.top() > view.top() { above } else { at(y + height, Align2::CENTER_TOP, theme::GRIP_REACH) }
}
