//! Colour differences over the angle, on the axis of the plot above.

use std::ops::RangeInclusive;

use eframe::egui::{Align2, Color32, TextStyle, Ui, vec2};
use egui_plot::{Line, LineStyle, PlotPoints, VLine};

use super::angle_plot::angle_plot;
use crate::fresnel::THETA_MAX_DEG;
use crate::gui::theme::Palette;
use crate::gui::truth::curve_angles_deg;

/// The difference of one model from the truth.
pub(crate) struct DifferenceLine<'a> {
    /// The model.
    pub name: &'a str,
    /// ΔE at each angle of the curves.
    pub delta_e: &'a [f64],
    /// The model's colour.
    pub colour: Color32,
    /// The model's line.
    pub style: LineStyle,
}

/// Shows the differences; returns the angle under the pointer.
pub(crate) fn difference_plot(
    ui: &mut Ui,
    lines: &[DifferenceLine],
    range_deg: RangeInclusive<f64>,
    cursor_deg: Option<f64>,
    height: f32,
) -> Option<f64> {
    let palette = Palette::of(ui);
    let values = lines.iter().flat_map(|line| line.delta_e).copied().filter(|value| value.is_finite());
    let top = values.fold(1.0_f64, f64::max) * 1.08;
    let step = step_for(top);
    let background = std::mem::replace(&mut ui.visuals_mut().extreme_bg_color, palette.canvas);
    let (start, end) = (*range_deg.start(), *range_deg.end());
    let response = angle_plot("difference over angle", (10.0, step), |value| value.to_string(), palette)
        .height(height)
        .show(ui, |plot| {
            plot.set_plot_bounds_x(start..=end);
            plot.set_plot_bounds_y(0.0..=top);
            plot.vline(
                VLine::new("θ_max", THETA_MAX_DEG).color(palette.guide).width(1.0).style(LineStyle::dotted_dense()),
            );
            if let Some(deg) = cursor_deg {
                plot.vline(VLine::new("cursor", deg).color(palette.guide).width(1.0));
            }
            for line in lines {
                let points: PlotPoints =
                    curve_angles_deg().zip(line.delta_e).map(|(deg, &value)| [deg, value]).collect();
                plot.line(
                    Line::new(line.name, points).color(line.colour).width(1.5).style(line.style).allow_hover(false),
                );
            }
        });
    ui.visuals_mut().extreme_bg_color = background;
    let frame = *response.transform.frame();
    let (font, colour) = (TextStyle::Small.resolve(ui.style()), ui.visuals().weak_text_color());
    ui.painter().text(frame.left_top() + vec2(6.0, 4.0), Align2::LEFT_TOP, "ΔE to the truth", font, colour);
    let pointer = response.response.hover_pos().filter(|pointer| frame.contains(*pointer))?;
    Some(response.transform.value_from_position(pointer).x)
}

/// A round step that gives two to five lines.
fn step_for(top: f64) -> f64 {
    [0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0].into_iter().find(|step| top / step <= 5.0).unwrap_or(100.0)
}
