//! Largest, smallest and middle values that hide nothing, those at any rank, and numbers in sentences.

mod extremes;
mod median;
mod ranks;
mod short;

pub use extremes::{larger, largest, smallest};
pub use median::{median, median_of_sorted};
pub use ranks::at_ranks;
pub use short::short;
