//! Plots and strips as SVG or PNG, shared by the command line and the window.
//!
//! A figure is plain data. [`Figure::drawing`] lays it out in points; the [`Drawing`] goes onto any
//! plotters backend, and from there to an SVG document or an anti-aliased PNG.

mod axis;
#[cfg(test)]
mod check;
mod curve;
mod curve_layout;
mod drawing;
mod output;
mod spread;
mod strip;
mod style;
mod text;

pub use curve::{CurveFigure, CurveSeries, curve_figure};
pub use drawing::{Align, Drawing, Inset, Label, Point, Shape};
pub use output::{Figure, FigureFormat};
pub use style::{FigureTheme, Ink, Palette};
pub use text::{Weight, text_width};
