//! Plots and strips as SVG or PNG, shared by the command line and the window.
//!
//! A figure is plain data. [`Figure::drawing`] lays it out in points; the [`Drawing`] goes onto any
//! plotters backend, and from there to an SVG document or an anti-aliased PNG.

mod axis;
mod bars;
#[cfg(test)]
mod check;
mod curve;
mod curve_layout;
mod demonstration;
mod difference;
mod distribution;
mod drawing;
mod feasible;
mod matrix;
mod of_study;
mod output;
mod page;
mod place;
mod scatter;
mod spheres;
mod spread;
mod strip;
mod style;
mod swatch;
mod table;
mod text;
mod trade;

pub use bars::{Bar, BarFigure};
pub use curve::{CurveFigure, CurveSeries, DeltaE, curve_angles, curve_figure};
pub use demonstration::{BlendFigure, ConversionFigure, DecouplingFigure, QuantisationFigure, UniformityFigure};
pub use difference::DifferenceFigure;
pub use distribution::DistributionFigure;
pub use drawing::{Align, Drawing, Inset, Label, Point, Shape};
pub use feasible::{FeasibleFigure, FeasiblePoint};
pub use matrix::MatrixFigure;
pub use of_study::{
    accuracy_distribution, accuracy_table, blend_matrix_figure, blend_matrix_of_two, conversion_distribution,
    feasible_figure, step_figure,
};
pub use output::{Figure, FigureFormat};
pub use scatter::{ScatterFigure, ScatterPoint};
pub use spheres::{ComparedSpheres, SphereLayout, round_scale, save_picture};
pub use style::{FigureTheme, Ink, Palette};
pub use swatch::{SwatchFigure, swatch_figure};
pub use table::{HeatRow, HeatTable};
pub use text::{Weight, text_width};
pub use trade::trade_figure;
