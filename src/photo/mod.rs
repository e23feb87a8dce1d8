//! From the pixels of a photograph to r and h.

mod picture;
mod pixel;
mod recipe;
mod warning;

pub use picture::Photo;
pub use pixel::{Pixel, PixelFlags};
pub use recipe::Recipe;
pub use warning::{Warning, WarningCode};
