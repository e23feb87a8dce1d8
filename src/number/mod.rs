//! Largest, smallest and middle values that hide nothing, and those at any rank.

mod extremes;
mod median;
mod ranks;

pub use extremes::{larger, largest, smallest};
pub use median::{median, median_of_sorted};
pub use ranks::at_ranks;
