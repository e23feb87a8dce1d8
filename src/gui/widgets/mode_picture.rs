//! Small drawings of the six ways to know the light.

use eframe::egui::epaint::QuadraticBezierShape;
use eframe::egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Ui, Vec2, pos2, vec2};

use crate::gui::theme::Palette;
use crate::photo::LightMode;

/// Width and height of a drawing in its own units.
const SIZE: Vec2 = Vec2::new(48.0, 32.0);

/// Draws a mode into a rectangle.
pub(crate) fn mode_picture(ui: &Ui, painter: &Painter, rect: Rect, mode: LightMode) {
    let pen = Pen::new(ui, painter, rect);
    match mode {
        LightMode::FlatMirror => flat_mirror(&pen),
        LightMode::ReferenceBall => reference_ball(&pen),
        LightMode::Card => card(&pen),
        LightMode::Backdrop => backdrop(&pen),
        LightMode::SolvedLight => solved_light(&pen),
        LightMode::ByEye => by_eye(&pen),
    }
}

/// Draws in units of [`SIZE`].
struct Pen<'a> {
    painter: &'a Painter,
    origin: Pos2,
    scale: f32,
    line: Color32,
    metal: Color32,
    bright: Color32,
    accent: Color32,
}

impl<'a> Pen<'a> {
    fn new(ui: &Ui, painter: &'a Painter, rect: Rect) -> Self {
        let scale = (rect.width() / SIZE.x).min(rect.height() / SIZE.y);
        let is_dark = ui.visuals().dark_mode;
        let grey = |dark, light| Color32::from_gray(if is_dark { dark } else { light });
        let palette = Palette::of(ui);
        Self {
            painter,
            origin: rect.center() - SIZE * scale / 2.0,
            scale,
            line: ui.visuals().text_color(),
            metal: grey(0x74, 0x9c),
            bright: grey(0xf0, 0xfc),
            accent: palette.accent,
        }
    }

    fn at(&self, x: f32, y: f32) -> Pos2 {
        self.origin + vec2(x, y) * self.scale
    }

    fn stroke(&self, colour: Color32) -> Stroke {
        Stroke::new(1.1, colour)
    }

    fn line(&self, from: [f32; 2], to: [f32; 2], colour: Color32) {
        let points = [from, to].map(|[x, y]| self.at(x, y));
        self.painter.line_segment(points, self.stroke(colour));
    }

    fn arrow(&self, from: [f32; 2], to: [f32; 2]) {
        self.line(from, to, self.accent);
        let tip = self.at(to[0], to[1]);
        let back = (self.at(from[0], from[1]) - tip).normalized() * 3.2 * self.scale;
        let wing = |turn: f32| tip + vec2(back.x - turn * back.y, back.y + turn * back.x);
        self.painter.add(Shape::convex_polygon(vec![tip, wing(0.5), wing(-0.5)], self.accent, Stroke::NONE));
    }

    fn ball(&self, x: f32, y: f32, radius: f32) {
        let (centre, radius) = (self.at(x, y), radius * self.scale);
        self.painter.circle(centre, radius, self.metal, self.stroke(self.line));
    }

    fn rectangle(&self, [x, y, width, height]: [f32; 4], fill: Color32) {
        let rect = Rect::from_min_size(self.at(x, y), vec2(width, height) * self.scale);
        self.painter.rect(rect, 0, fill, self.stroke(self.line), StrokeKind::Inside);
    }

    /// The reflection of a window on a ball.
    fn glint(&self, x: f32, y: f32) {
        let rect = Rect::from_min_size(self.at(x, y), vec2(3.0, 3.4) * self.scale);
        self.painter.rect_filled(rect, 0, self.bright);
    }

    fn curve(&self, points: [[f32; 2]; 3], stroke: Stroke) {
        let points = points.map(|[x, y]| self.at(x, y));
        self.painter.add(QuadraticBezierShape::from_points_stroke(points, false, Color32::TRANSPARENT, stroke));
    }

    fn sun(&self, x: f32, y: f32, colour: Color32) {
        self.painter.circle_stroke(self.at(x, y), 2.2 * self.scale, self.stroke(colour));
        for turn in 0..8 {
            let (sin, cos) = (std::f32::consts::TAU * turn as f32 / 8.0).sin_cos();
            self.line([x + 3.6 * cos, y + 3.6 * sin], [x + 5.4 * cos, y + 5.4 * sin], colour);
        }
    }
}

/// A card stands on a flat piece; the eye sees it directly and in the mirror.
fn flat_mirror(pen: &Pen) {
    pen.rectangle([2.0, 21.0, 44.0, 9.0], pen.metal);
    pen.rectangle([34.0, 5.0, 8.0, 16.0], pen.bright);
    pen.rectangle([34.0, 21.0, 8.0, 8.0], pen.bright.gamma_multiply(0.45));
    pen.arrow([4.0, 8.0], [32.5, 11.0]);
    pen.line([4.0, 8.0], [20.0, 21.0], pen.accent);
    pen.arrow([20.0, 21.0], [32.5, 13.5]);
    pen.painter.circle_filled(pen.at(4.0, 8.0), 2.2 * pen.scale, pen.line);
}

/// Two balls in the same surroundings: both show the same window.
fn reference_ball(pen: &Pen) {
    pen.ball(13.0, 17.0, 10.5);
    pen.glint(8.0, 10.0);
    pen.ball(35.0, 17.0, 10.5);
    pen.glint(30.0, 10.0);
    // A tick: this one is known.
    pen.line([31.0, 19.5], [34.0, 22.5], pen.bright);
    pen.line([34.0, 22.5], [40.0, 15.5], pen.bright);
}

/// A ball and a card in a tent.
fn card(pen: &Pen) {
    let tent = pen.stroke(pen.line);
    pen.curve([[2.0, 30.0], [3.0, 3.0], [24.0, 3.0]], tent);
    pen.curve([[24.0, 3.0], [45.0, 3.0], [46.0, 30.0]], tent);
    pen.line([1.0, 30.0], [47.0, 30.0], pen.line);
    pen.ball(19.0, 21.0, 8.5);
    pen.rectangle([32.0, 16.0, 8.0, 13.5], pen.bright);
}

/// The rim beside an even bright backdrop.
fn backdrop(pen: &Pen) {
    pen.rectangle([22.0, 2.0, 24.0, 28.0], pen.bright);
    pen.ball(16.0, 16.0, 13.0);
    pen.painter.circle_filled(pen.at(26.6, 16.0), 1.7 * pen.scale, pen.accent);
    pen.painter.circle_filled(pen.at(35.0, 16.0), 1.7 * pen.scale, pen.accent);
    pen.line([26.6, 16.0], [35.0, 16.0], pen.accent);
}

/// A ball whose outermost rim is white.
fn solved_light(pen: &Pen) {
    let (centre, radius) = (pen.at(19.0, 16.5), 12.0 * pen.scale);
    pen.painter.circle(centre, radius, pen.metal, Stroke::new(2.6 * pen.scale, pen.bright));
    pen.painter.circle_stroke(centre, radius + 1.6 * pen.scale, pen.stroke(pen.line));
    pen.sun(40.0, 8.0, pen.accent);
    pen.arrow([36.0, 11.5], [32.0, 14.8]);
}

/// An eye and the light it sets.
fn by_eye(pen: &Pen) {
    let lid = pen.stroke(pen.line);
    pen.curve([[3.0, 18.0], [16.0, 5.0], [29.0, 18.0]], lid);
    pen.curve([[3.0, 18.0], [16.0, 31.0], [29.0, 18.0]], lid);
    pen.painter.circle(pen.at(16.0, 18.0), 5.0 * pen.scale, pen.metal, lid);
    pen.painter.circle_filled(pen.at(16.0, 18.0), 2.0 * pen.scale, pen.line);
    pen.sun(39.0, 12.0, pen.accent);
    pen.line([33.0, 26.0], [45.0, 26.0], pen.line);
    pen.painter.circle(pos2(pen.at(41.0, 0.0).x, pen.at(0.0, 26.0).y), 1.9 * pen.scale, pen.bright, lid);
}
