//! The wavelengths every spectral sum runs over.

/// First wavelength in nanometres.
pub const FIRST_NM: usize = 380;
/// Last wavelength in nanometres.
pub const LAST_NM: usize = 780;
/// Number of wavelengths: 380, 381, …, 780 nm.
pub const SAMPLES: usize = LAST_NM - FIRST_NM + 1;

/// The wavelengths in nanometres, in order.
pub fn wavelengths_nm() -> impl ExactSizeIterator<Item = f64> + Clone {
    (0..SAMPLES).map(|index| (FIRST_NM + index) as f64)
}
