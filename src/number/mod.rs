//! Largest, smallest and middle values that hide nothing.

mod extremes;
mod median;

pub use extremes::{larger, largest, smallest};
pub use median::{median, median_of_sorted};
