//! A slider whose rail shows the colours it leads to.

use std::ops::RangeInclusive;

use eframe::egui::{
    Color32, Mesh, Rect, Response, Shape, Slider, SliderClamping, Stroke, StrokeKind, Ui, Vec2, epaint::RectShape,
    pos2, style::HandleShape,
};

use crate::gui::theme;

/// Colours painted along the rail.
const STOPS: usize = 24;

/// A slider over `range`, its rail coloured by `colour_at`. A value beyond the range stays; the handle rests at the end.
pub(crate) fn colour_slider(
    ui: &mut Ui,
    value: &mut f64,
    range: RangeInclusive<f64>,
    name: &str,
    width: f32,
    colour_at: impl Fn(f64) -> Color32,
) -> Response {
    let rail = ui.painter().add(Shape::Noop);
    let response = ui
        .scope(|ui| {
            ui.spacing_mut().slider_width = width;
            ui.spacing_mut().slider_rail_height = 0.0;
            theme::set_slider_handle(ui.visuals_mut());
            let slider = Slider::new(value, range.clone())
                .show_value(false)
                .clamping(SliderClamping::Never)
                .smart_aim(false)
                .handle_shape(HandleShape::Rect { aspect_ratio: 0.4 });
            ui.add(slider)
        })
        .inner;
    let outline = ui.visuals().window_stroke();
    ui.painter().set(rail, gradient(response.rect.shrink2(Vec2::new(0.0, 3.0)), range, colour_at, outline));
    response.accessible_name(name)
}

fn gradient(rect: Rect, range: RangeInclusive<f64>, colour_at: impl Fn(f64) -> Color32, outline: Stroke) -> Shape {
    let mut mesh = Mesh::default();
    for stop in 0..=STOPS {
        let weight = stop as f32 / STOPS as f32;
        let colour = colour_at(range.start() + (range.end() - range.start()) * f64::from(weight));
        let x = rect.left() + rect.width() * weight;
        mesh.colored_vertex(pos2(x, rect.top()), colour);
        mesh.colored_vertex(pos2(x, rect.bottom()), colour);
        if stop > 0 {
            let last = 2 * stop as u32;
            mesh.add_triangle(last - 2, last - 1, last);
            mesh.add_triangle(last - 1, last, last + 1);
        }
    }
    Shape::Vec(vec![mesh.into(), RectShape::stroke(rect, 0, outline, StrokeKind::Outside).into()])
}
