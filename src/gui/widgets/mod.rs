//! The parts that panels are made of.

mod angle_plot;
mod colour_field;
mod colour_slider;
mod curve_plot;
mod difference_plot;
mod mode_picture;
mod number_field;
mod photo_view;
mod strip;
mod swatch;

pub(crate) use colour_field::{ColourField, VALUE_WIDTH, channel_names, row_label};
pub(crate) use colour_slider::colour_slider;
pub(crate) use curve_plot::{CurvePlot, Handle, PlotLine, SAMPLE, line_sample};
pub(crate) use difference_plot::{DifferenceLine, difference_plot};
pub(crate) use mode_picture::mode_picture;
pub(crate) use number_field::NumberField;
pub(crate) use photo_view::photo_view;
pub(crate) use strip::strip;
pub(crate) use swatch::{clipped_corner, colour32, swatch};
