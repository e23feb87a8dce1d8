//! Parameters of each model for a measured metal, and conversions between parameterisations.
//!
//! [`fit`] takes a metal, a model and a [`Method`]; [`CurveError`] says how far a curve is from the truth.

mod black_box;
mod convert;
mod curve_error;
mod edge_tint;
mod index;
mod least_squares;
mod loss;
mod metal_fit;
mod method;
mod nearest;
mod search;
mod series;

pub use convert::{Conversion, NotAMaterial, convert};
pub use curve_error::{CurveError, delta_e_over_degrees};
pub use edge_tint::{Nearness, g_nearest};
pub use index::nk_by_least_squares;
pub use least_squares::{h_by_least_squares, r_h_by_least_squares, schlick_r_by_least_squares};
pub use loss::Loss;
pub use metal_fit::{Fit, FitError, fit, fit_to_truth, model_of_truth};
pub use method::{Method, Triple};
pub use nearest::nearest_conductor;
pub use search::Stopped;
pub use series::{BAKED_COEFFICIENTS, bake, samples_for_series, series_by_least_squares};
