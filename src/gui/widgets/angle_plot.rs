//! What every plot over the angle has in common: a still frame, degrees below, a round grid.

use eframe::egui::{Rangef, Sense};
use egui_plot::{AxisHints, GridInput, GridMark, Plot};

use crate::gui::theme::{self, Palette};

/// Points between marks of an axis from which its numbers fade in, and at which they are whole.
const LABEL_SPACING: Rangef = Rangef { min: 18.0, max: 28.0 };

/// An empty plot that does not move, with grid lines every so many degrees and every so much above; `label` writes a
/// value of the vertical axis.
pub(super) fn angle_plot<'a>(
    name: &'static str,
    (step_deg, step): (f64, f64),
    label: impl Fn(f64) -> String + 'a,
    palette: Palette,
) -> Plot<'a> {
    let degrees = AxisHints::new_x().label_spacing(LABEL_SPACING).formatter(|mark, _| format!("{:.0}°", mark.value));
    let values = AxisHints::new_y().min_thickness(theme::AXIS_WIDTH).label_spacing(LABEL_SPACING);
    Plot::new(name)
        .allow_zoom(false)
        .allow_drag(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .show_x(false)
        .show_y(false)
        .show_crosshair(false)
        .sense(Sense::hover())
        .grid_color(palette.grid)
        .grid_fade(0.0)
        .x_grid_spacer(move |input| grid(input, step_deg))
        .y_grid_spacer(move |input| grid(input, step))
        .custom_x_axes(vec![degrees])
        .custom_y_axes(vec![values.formatter(move |mark, _| label(mark.value))])
        .label_formatter(|_| None)
}

fn grid(input: GridInput, step: f64) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let first = (low / step).ceil() as i64;
    let last = (high / step).floor() as i64;
    (first..=last).map(|index| GridMark { value: index as f64 * step, step_size: step }).collect()
}
