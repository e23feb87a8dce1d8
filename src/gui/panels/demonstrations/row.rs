//! Bands of colours between a name at the left and numbers at the right.

use eframe::egui::{
    Align2, Color32, FontId, Mesh, Painter, Rangef, Rect, Response, Sense, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo,
    accesskit::Role, pos2, vec2,
};

use crate::gui::demonstrations::Band;
use crate::gui::theme::{self, Palette};
use crate::gui::widgets::clipped_corner;
use crate::study::Parameters;

/// The columns between names and numbers.
pub(super) fn between(row: Rect) -> Rangef {
    Rangef::new(row.left() + theme::BAND_NAMES, row.right() - theme::BAND_NUMBERS)
}

/// A row across the whole width, and what stands between names and numbers.
pub(super) fn allocate(ui: &mut Ui, height: f32) -> (Rect, Response) {
    let (row, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), height), Sense::hover());
    (Rect::from_x_y_ranges(between(row), row.y_range()), response)
}

/// Bands that are compared: they touch.
pub(super) struct Row<'a> {
    /// What the bands are of.
    pub name: &'a str,
    /// The colour of the name.
    pub colour: Color32,
    /// From the top.
    pub bands: &'a [&'a Band],
    /// Height of each band.
    pub height: f32,
    /// Equal boxes, or colours that blend into one another.
    pub is_stepped: bool,
    /// What is measured, the most important first.
    pub numbers: &'a [String],
}

impl Row<'_> {
    /// Shows it; gives the place of the bands.
    pub(super) fn show(self, ui: &mut Ui) -> Rect {
        let (rect, response) = allocate(ui, self.height * self.bands.len() as f32);
        let spoken = format!("{}: {}", self.name, self.numbers.join(", "));
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &spoken));
        for (index, band) in self.bands.iter().enumerate() {
            let top = rect.top() + self.height * index as f32;
            let place = Rect::from_x_y_ranges(rect.x_range(), top..=top + self.height);
            paint(ui, place, band, self.is_stepped);
        }
        ui.painter().rect_stroke(rect, 0, ui.visuals().window_stroke(), StrokeKind::Outside);
        name(ui, rect, self.name, self.colour);
        numbers(ui, rect, self.numbers);
        rect
    }
}

/// The colour of a description's name and lines.
pub(super) fn ink(ui: &Ui, parameters: Parameters) -> Color32 {
    Palette::of(ui).models[parameters as usize]
}

/// Colours over a rectangle, the mark of clipping in its corner.
pub(in crate::gui::panels) fn paint(ui: &Ui, rect: Rect, band: &Band, is_stepped: bool) {
    let mesh = if is_stepped { boxes(rect, &band.colours) } else { gradient(rect, &band.colours) };
    ui.painter().add(mesh);
    if band.is_clipped {
        ui.painter().add(clipped_corner(rect, Palette::of(ui).warning));
    }
}

/// Equal boxes side by side.
fn boxes(rect: Rect, colours: &[Color32]) -> Mesh {
    let mut mesh = Mesh::default();
    let width = rect.width() / colours.len().max(1) as f32;
    for (index, &colour) in colours.iter().enumerate() {
        let left = rect.left() + width * index as f32;
        mesh.add_colored_rect(Rect::from_x_y_ranges(left..=left + width, rect.y_range()), colour);
    }
    mesh
}

/// Colours at equal steps from edge to edge; between two neighbours, which hardly differ, the screen's codes blend.
fn gradient(rect: Rect, colours: &[Color32]) -> Mesh {
    let mut mesh = Mesh::default();
    let last = colours.len().saturating_sub(1).max(1) as f32;
    for (index, &colour) in colours.iter().enumerate() {
        let x = rect.left() + rect.width() * index as f32 / last;
        mesh.colored_vertex(pos2(x, rect.top()), colour);
        mesh.colored_vertex(pos2(x, rect.bottom()), colour);
        if index > 0 {
            let corner = 2 * index as u32;
            mesh.add_triangle(corner - 2, corner - 1, corner);
            mesh.add_triangle(corner - 1, corner, corner + 1);
        }
    }
    mesh
}

/// A name left of a place.
pub(super) fn name(ui: &Ui, rect: Rect, text: &str, colour: Color32) {
    let at = pos2(rect.left() - 2.0 * theme::GAP, rect.center().y);
    ui.painter().text(at, Align2::RIGHT_CENTER, text, body(ui), colour);
}

/// Numbers right of a place, the first one stronger.
pub(super) fn numbers(ui: &Ui, rect: Rect, texts: &[String]) {
    const LINE: f32 = 14.0;
    let left = rect.right() + 2.0 * theme::GAP;
    let top = rect.center().y - LINE * texts.len().saturating_sub(1) as f32 / 2.0;
    for (index, text) in texts.iter().enumerate() {
        let at = pos2(left, top + LINE * index as f32);
        let (font, colour) = match index {
            0 => (body(ui), ui.visuals().strong_text_color()),
            _ => (small(ui), ui.visuals().weak_text_color()),
        };
        ui.painter().text(at, Align2::LEFT_CENTER, text, font, colour);
    }
}

/// Marks and names under an axis.
pub(super) fn ticks(ui: &mut Ui, ticks: &[(f32, String)]) {
    let (rect, _) = allocate(ui, theme::TICKS);
    let (colour, line) = (ui.visuals().weak_text_color(), ui.visuals().window_stroke());
    for (share, text) in ticks {
        let x = rect.left() + rect.width() * share;
        ui.painter().vline(x, rect.top()..=rect.top() + 4.0, line);
        ui.painter().text(pos2(x, rect.top() + 5.0), Align2::CENTER_TOP, text, small(ui), colour);
    }
}

/// 0° to 90°.
pub(super) fn degree_ticks() -> Vec<(f32, String)> {
    (0..=6u8).map(|index| (f32::from(index) / 6.0, format!("{}°", 15 * index))).collect()
}

/// 0 % to 100 %.
pub(super) fn share_ticks() -> Vec<(f32, String)> {
    (0..=4u8).map(|index| (f32::from(index) / 4.0, format!("{} %", 25 * u16::from(index)))).collect()
}

/// A caption above bands, at their left end.
pub(super) fn caption(ui: &mut Ui, text: &str) {
    ui.horizontal(|ui| {
        ui.add_space(theme::BAND_NAMES);
        ui.label(theme::hint(text));
    });
}

/// A triangle over a place that points down at it.
pub(super) fn pointer(painter: &Painter, tip: eframe::egui::Pos2, colour: Color32) {
    let points = vec![tip, tip + vec2(-4.0, -6.0), tip + vec2(4.0, -6.0)];
    painter.add(eframe::egui::Shape::convex_polygon(points, colour, eframe::egui::Stroke::NONE));
}

/// The font of names and numbers.
pub(in crate::gui::panels) fn body(ui: &Ui) -> FontId {
    TextStyle::Body.resolve(ui.style())
}

/// The font of ticks and notes.
pub(in crate::gui::panels) fn small(ui: &Ui) -> FontId {
    TextStyle::Small.resolve(ui.style())
}
