//! Spectra over 380–780 nm at 1 nm: the observer, the illuminants and the way to RGB.

mod few_wavelengths;
mod grid;
mod illuminant;
mod observer;
mod rgb_weights;
mod table;

pub use few_wavelengths::{FewWavelengths, Quadrature};
pub use grid::{FIRST_NM, LAST_NM, SAMPLES, wavelengths_nm};
pub use illuminant::Illuminant;
pub use observer::observer;
pub use rgb_weights::{RgbWeights, rgb_from_reflectance, rgb_weights};
