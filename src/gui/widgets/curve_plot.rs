//! Reflectance over the angle, three channels a curve.

use std::ops::RangeInclusive;

use eframe::egui::{Color32, Id, Pos2, Rect, Sense, Ui, Vec2, pos2};
use egui_plot::{FilledArea, Line, LineStyle, PlotPoint, PlotPoints, PlotUi, VLine};

use super::angle_plot::angle_plot;
use super::channel_names;
use crate::color::Rgb;
use crate::fresnel::THETA_MAX_DEG;
use crate::gui::theme::{self, Palette};
use crate::gui::truth::curve_angles_deg;

/// One curve of the plot.
pub(crate) struct PlotLine<'a> {
    /// What it is called.
    pub name: &'a str,
    /// Reflectance at each angle of [`curve_angles_deg`].
    pub curve: &'a [Rgb],
    /// How it is drawn.
    pub style: LineStyle,
    /// Its width.
    pub width: f32,
    /// How much of its colour is left, 0–1.
    pub opacity: f32,
}

/// A dot on the curve that can be dragged up and down.
pub(crate) struct Handle {
    /// Where on the axis.
    pub angle_deg: f64,
    /// The parameter it stands for.
    pub name: &'static str,
    /// Its value in each channel.
    pub value: Rgb,
}

/// What happened in the plot.
pub(crate) struct PlotOutput {
    /// The rectangle of the axes, for whatever stands below on the same axis.
    pub frame: Rect,
    /// The angle under the pointer.
    pub cursor_deg: Option<f64>,
    /// New values of the handles, in their order, when one is dragged.
    pub dragged: Option<(usize, Rgb)>,
}

/// A plot of curves over the angle.
pub(crate) struct CurvePlot<'a> {
    /// Bottom to top.
    pub lines: &'a [PlotLine<'a>],
    /// Lower and upper curves of an uncertainty.
    pub band: Option<(&'a [Rgb], &'a [Rgb])>,
    /// Dots that can be dragged.
    pub handles: &'a [Handle],
    /// The angles shown.
    pub range_deg: RangeInclusive<f64>,
    /// A line at this angle, from a pointer elsewhere.
    pub cursor_deg: Option<f64>,
    /// Height in points.
    pub height: f32,
}

impl CurvePlot<'_> {
    /// Shows it over the whole width.
    pub(crate) fn show(self, ui: &mut Ui) -> PlotOutput {
        let palette = Palette::of(ui);
        let bounds_y = self.bounds_y();
        let (start, end) = (*self.range_deg.start(), *self.range_deg.end());
        let background = ui.visuals().extreme_bg_color;
        ui.visuals_mut().extreme_bg_color = palette.canvas;
        let step_deg = if end - start > 45.0 { 10.0 } else { 5.0 };
        let label = |value: f64| format!("{value:.1}");
        let response = angle_plot("reflectance over angle", (step_deg, 0.2), label, palette)
            .height(self.height)
            .default_x_bounds(start, end)
            .default_y_bounds(*bounds_y.start(), *bounds_y.end())
            .show(ui, |plot| {
                plot.set_plot_bounds_x(start..=end);
                plot.set_plot_bounds_y(bounds_y.clone());
                self.draw(plot, palette);
            });
        ui.visuals_mut().extreme_bg_color = background;
        let frame = *response.transform.frame();
        let pointer = response.response.hover_pos().filter(|pointer| frame.contains(*pointer));
        let cursor_deg = pointer.map(|pointer| response.transform.value_from_position(pointer).x);
        let to_screen = |deg: f64, value: f64| response.transform.position_from_point(&PlotPoint::new(deg, value));
        let points_per_unit = response.transform.dpos_dvalue_y();
        let dragged = self.drag_handles(ui, frame, to_screen, points_per_unit);
        PlotOutput { frame, cursor_deg, dragged }
    }

    /// 0–1, or more where a curve leaves it.
    fn bounds_y(&self) -> RangeInclusive<f64> {
        let curves = self.lines.iter().flat_map(|line| line.curve);
        let values = curves.flat_map(|rgb| rgb.0).filter(|value| value.is_finite());
        let (low, high) = values.fold((0.0_f64, 1.0_f64), |(low, high), v| (low.min(v), high.max(v)));
        (low.max(-1.0) - 0.02)..=(high.min(2.0) + 0.03)
    }

    fn draw<'p>(&self, plot: &mut PlotUi<'p>, palette: Palette) {
        plot.vline(VLine::new("θ_max", THETA_MAX_DEG).color(palette.guide).width(1.0).style(LineStyle::dotted_dense()));
        if let Some(deg) = self.cursor_deg {
            plot.vline(VLine::new("cursor", deg).color(palette.guide).width(1.0));
        }
        if let Some((low, high)) = self.band {
            for (channel, colour) in palette.channels.into_iter().enumerate() {
                plot.add(band(low, high, channel, colour));
            }
        }
        for line in self.lines {
            if line.curve.iter().all(|rgb| is_grey(*rgb)) {
                plot.line(curve_line(line, 0, palette.grey));
                continue;
            }
            for (channel, colour) in palette.channels.into_iter().enumerate() {
                plot.line(curve_line(line, channel, colour));
            }
        }
    }

    /// Shows the handles; a drag moves the channel nearest to where it began, and every channel equal to it.
    fn drag_handles(
        &self,
        ui: &Ui,
        frame: Rect,
        to_screen: impl Fn(f64, f64) -> Pos2,
        points_per_unit: f64,
    ) -> Option<(usize, Rgb)> {
        let mut dragged = None;
        let palette = Palette::of(ui);
        let shown = |handle: &&Handle| self.range_deg.contains(&handle.angle_deg);
        for (index, handle) in self.handles.iter().enumerate().filter(|(_, handle)| shown(handle)) {
            let dots = handle.value.0.map(|value| to_screen(handle.angle_deg, value));
            let area = Rect::from_points(&dots).expand(theme::HANDLE_RADIUS + 2.0);
            let id = ui.scope_id().with(("handle", handle.name));
            let response = ui.interact(area.intersect(frame.expand(8.0)), id, Sense::DRAG);
            let hovered = ui.ctx().pointer_latest_pos().filter(|_| response.contains_pointer());
            let held = held_channel(ui, id, &response, &dots);
            let nearest = held.or_else(|| hovered.map(|pointer| nearest(&dots, pointer)));
            for (channel, dot) in dots.into_iter().enumerate() {
                let is_near = nearest.is_some_and(|n| handle.value[n] == handle.value[channel]);
                let colour = if is_grey(handle.value) { palette.grey } else { palette.channels[channel] };
                paint_handle(ui, frame, dot, colour, is_near);
            }
            if let Some(channel) = held.filter(|_| response.dragged()) {
                let change = f64::from(response.drag_delta().y) / points_per_unit;
                let moves = |value: f64| if value == handle.value[channel] { value + change } else { value };
                dragged = Some((index, handle.value.map(moves)));
            }
            let [red, green, blue] = handle.value.0.map(|v| format!("{v:.4}"));
            response.on_hover_text(format!("{}\n{red}  {green}  {blue}\nDrag up or down", handle.name));
        }
        dragged
    }
}

/// Three curves that lie on each other are one, in no channel's colour.
fn is_grey(rgb: Rgb) -> bool {
    rgb.max_channel() - rgb.min_channel() < 1e-3
}

/// The channel a drag took hold of when it began.
fn held_channel(ui: &Ui, id: Id, response: &eframe::egui::Response, dots: &[Pos2; 3]) -> Option<usize> {
    if response.drag_started() {
        let origin = ui.input(|input| input.pointer.press_origin())?;
        ui.data_mut(|data| data.insert_temp(id, nearest(dots, origin)));
    }
    response.dragged().then(|| ui.data(|data| data.get_temp(id)))?
}

fn nearest(dots: &[Pos2; 3], pointer: Pos2) -> usize {
    let distance = |channel: &usize| (dots[*channel].y - pointer.y).abs();
    (0..3).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}

fn paint_handle(ui: &Ui, frame: Rect, dot: Pos2, colour: Color32, is_near: bool) {
    let radius = if is_near { theme::HANDLE_RADIUS } else { theme::HANDLE_RADIUS - 1.5 };
    let painter = ui.painter().with_clip_rect(frame.expand(theme::HANDLE_RADIUS + 1.0));
    painter.circle(dot, radius, colour, eframe::egui::Stroke::new(1.5, Palette::of(ui).canvas));
}

fn curve_line<'p>(line: &PlotLine, channel: usize, colour: Color32) -> Line<'p> {
    let points: PlotPoints = curve_angles_deg().zip(line.curve).map(|(deg, rgb)| [deg, rgb[channel]]).collect();
    Line::new(format!("{} {}", line.name, channel_names()[channel]), points)
        .color(colour.gamma_multiply(line.opacity))
        .width(line.width)
        .style(line.style)
        .allow_hover(false)
}

fn band(low: &[Rgb], high: &[Rgb], channel: usize, colour: Color32) -> FilledArea {
    let angles: Vec<f64> = curve_angles_deg().collect();
    let of = |curve: &[Rgb]| curve.iter().map(|rgb| rgb[channel]).collect::<Vec<_>>();
    FilledArea::new(format!("uncertainty {}", channel_names()[channel]), &angles, &of(low), &of(high))
        .fill_color(colour.gamma_multiply(0.22))
}

/// The size of a line sample in a legend.
pub(crate) const SAMPLE: Vec2 = Vec2::new(22.0, 10.0);

/// Shows how a curve is drawn, for a legend.
pub(crate) fn line_sample(ui: &mut Ui, style: LineStyle, width: f32, opacity: f32) {
    let (rect, _) = ui.allocate_exact_size(SAMPLE, Sense::hover());
    let colour = ui.visuals().strong_text_color().gamma_multiply(opacity);
    let stroke = eframe::egui::Stroke::new(width, colour);
    let ends = [pos2(rect.left(), rect.center().y), pos2(rect.right(), rect.center().y)];
    let shapes = match style {
        LineStyle::Solid => vec![eframe::egui::Shape::line_segment(ends, stroke)],
        LineStyle::Dotted { spacing } => eframe::egui::Shape::dotted_line(&ends, colour, spacing, width / 2.0),
        LineStyle::Dashed { length } => eframe::egui::Shape::dashed_line(&ends, stroke, length, length / 2.0),
    };
    ui.painter().extend(shapes);
}
