//! 8-bit sRGB pictures for screens and PNG files.

use std::path::Path;
use std::sync::LazyLock;

use super::file::{SaveError, write_atomically};
use crate::color::srgb_decode;

/// An 8-bit sRGB picture with straight alpha, and how much of it had to be clipped to get there.
#[derive(Clone, Debug, PartialEq, Eq)]
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

/// Cells of the first guess, equally wide in √linear, where sRGB codes are spread almost evenly.
const CELLS: usize = 1024;

/// Linear values at which the code changes, and the code at the start of each cell.
struct CodeTable {
    first_linear_of_code: [f32; 256],
    code_at_cell: [u8; CELLS + 1],
}

static CODES: LazyLock<CodeTable> = LazyLock::new(|| {
    let first_linear_of_code: [f32; 256] =
        std::array::from_fn(|code| if code == 0 { 0.0 } else { srgb_decode((code as f64 - 0.5) / 255.0) as f32 });
    let code_at_cell = std::array::from_fn(|cell| {
        let linear = (cell as f32 / CELLS as f32).powi(2);
        (first_linear_of_code.partition_point(|&first| first <= linear) - 1) as u8
    });
    CodeTable { first_linear_of_code, code_at_cell }
});

/// The sRGB code of a linear value, rounded to nearest; values outside `[0, 1]` and NaN are limited.
///
/// A table and at most a few comparisons instead of a power: pictures are encoded on every frame.
pub(super) fn code_of_linear(linear: f32) -> u8 {
    if linear.is_nan() || linear <= 0.0 {
        return 0;
    }
    let codes = &*CODES;
    let linear = linear.min(1.0);
    let mut code = codes.code_at_cell[(linear.sqrt() * CELLS as f32) as usize];
    while code < 255 && linear >= codes.first_linear_of_code[code as usize + 1] {
        code += 1;
    }
    code
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Rgb, RgbSpace, srgb8};

    /// The table gives what the curve gives, but for values within f32 rounding of a step.
    #[test]
    fn codes_are_those_of_the_curve() {
        for step in 0..=200_000u32 {
            let linear = step as f32 / 200_000.0;
            let exact = srgb8(Rgb::splat(f64::from(linear)), RgbSpace::LinRec709).0[0];
            let is_at_a_step = [-0.5, 0.5]
                .map(|half| srgb_decode((f64::from(exact) + half) / 255.0) - f64::from(linear))
                .iter()
                .any(|distance| distance.abs() < 1e-6);
            assert!(code_of_linear(linear) == exact || is_at_a_step, "{linear}");
        }
        assert_eq!([f32::NAN, -1.0, 0.0, 1.0, 2.0, f32::INFINITY].map(code_of_linear), [0, 0, 0, 255, 255, 255]);
    }

    #[test]
    fn png_decodes_to_the_same_pixels() {
        let rgba = vec![1, 2, 3, 255, 4, 5, 6, 0];
        let picture = Srgb8Picture { width: 2, height: 1, rgba: rgba.clone(), clipped: 0 };
        let decoded = image::load_from_memory(&picture.to_png()).unwrap().into_rgba8();
        assert_eq!((decoded.dimensions(), decoded.into_raw()), ((2, 1), rgba));
    }
}
