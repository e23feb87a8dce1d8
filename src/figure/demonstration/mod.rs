//! Figures of the paper's argument: one file for each demonstration of [`study`](crate::study).
//!
//! Those that are a plain distribution, matrix or scatter are made of the general figures in `of_study`.

mod blend;
mod conversion;
mod decoupling;
mod page;
mod quantisation;
mod uniformity;

pub use blend::BlendFigure;
pub use conversion::ConversionFigure;
pub use decoupling::DecouplingFigure;
pub use quantisation::QuantisationFigure;
pub use uniformity::UniformityFigure;
