//! The CIE 1931 2° standard observer.

use std::sync::LazyLock;

use super::{grid::SAMPLES, table};
use crate::color::Xyz;

static OBSERVER: LazyLock<Box<[Xyz; SAMPLES]>> = LazyLock::new(|| {
    let [x, y, z] =
        table::columns(include_str!("../../assets/cie/observer_1931_2deg.csv"), ["x_bar", "y_bar", "z_bar"]);
    Box::new(std::array::from_fn(|i| Xyz([x[i], y[i], z[i]])))
});

/// Colour-matching functions x̄, ȳ, z̄ at each wavelength of the grid (CIE 018:2019).
pub fn observer() -> &'static [Xyz; SAMPLES] {
    &OBSERVER
}
