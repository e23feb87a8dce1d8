//! 8-bit sRGB pictures for screens and PNG files.

use std::path::Path;

use super::file::{SaveError, write_atomically};

/// An 8-bit sRGB picture with straight alpha, and how much of it had to be clipped to get there.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Srgb8Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Red, green, blue, alpha of each pixel, row by row from the top left; colour is not multiplied by alpha.
    pub rgba: Vec<u8>,
    /// Number of visible pixels with a channel outside sRGB.
    pub clipped: usize,
}

impl Srgb8Picture {
    /// The colour of a pixel, without alpha.
    ///
    /// # Panics
    /// Outside the picture.
    pub fn rgb(&self, column: u32, row: u32) -> [u8; 3] {
        let start = 4 * (row as usize * self.width as usize + column as usize);
        [self.rgba[start], self.rgba[start + 1], self.rgba[start + 2]]
    }

    /// The picture as a PNG file that states it is sRGB.
    pub fn to_png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
        let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&self.rgba));
        written.expect("a picture of positive size, written to memory");
        bytes
    }

    /// Saves the picture as PNG.
    pub fn save_png(&self, path: &Path) -> Result<(), SaveError> {
        write_atomically(path, &self.to_png())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn png_decodes_to_the_same_pixels() {
        let rgba = vec![1, 2, 3, 255, 4, 5, 6, 0];
        let picture = Srgb8Picture { width: 2, height: 1, rgba: rgba.clone(), clipped: 0 };
        let decoded = image::load_from_memory(&picture.to_png()).unwrap().into_rgba8();
        assert_eq!((decoded.dimensions(), decoded.into_raw()), ((2, 1), rgba));
    }
}
