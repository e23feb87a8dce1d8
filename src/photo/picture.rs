//! A photograph in memory.

use super::{Pixel, PixelFlags, Warning};
use crate::color::Rgb;

/// A photograph: its pixels in linear Rec.709, how they became linear, and what is wrong with them.
#[derive(Clone, Debug)]
pub struct Photo {
    /// File name, or the name of a built-in sample.
    pub name: String,
    /// SHA-256 of the file, hexadecimal; empty for a picture that never was a file.
    pub sha256: String,
    /// Width in pixels after orientation.
    pub width: u32,
    /// Height in pixels after orientation.
    pub height: u32,
    /// What a person must know before measuring in it.
    pub warnings: Vec<Warning>,
    linear: Vec<[f32; 3]>,
}

impl Photo {
    /// A picture that is linear Rec.709 already, row by row.
    ///
    /// # Panics
    /// If `linear` does not hold `width` × `height` pixels.
    pub fn from_linear(name: &str, width: u32, height: u32, linear: Vec<[f32; 3]>) -> Self {
        assert_eq!(linear.len(), width as usize * height as usize, "one value for each pixel");
        Self { name: name.to_owned(), sha256: String::new(), width, height, warnings: Vec::new(), linear }
    }

    /// The pixel in a column and row, counted from the top left; `None` outside.
    pub fn pixel(&self, column: u32, row: u32) -> Option<Pixel> {
        let is_inside = column < self.width && row < self.height;
        let index = || row as usize * self.width as usize + column as usize;
        is_inside.then(|| Pixel { rgb: Rgb(self.linear[index()].map(f64::from)), flags: PixelFlags::default() })
    }
}
