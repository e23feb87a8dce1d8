//! From the pixels of a photograph to r and h.

mod recipe;

pub use recipe::Recipe;
