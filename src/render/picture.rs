//! A rendered picture in linear light.

use std::io::Cursor;
use std::path::Path;

use exr::meta::attribute::Chromaticities;
use exr::prelude::{Encoding, Image, IntegerBounds, LayerAttributes, SpecificChannels, Vec2, WritableImage as _};
use rayon::prelude::*;

use super::encode::{Encoder, Linear, write_alpha};
use super::file::{SaveError, write_atomically};
use super::srgb8::Srgb8Picture;
use crate::color::{Chromaticity, Rgb, RgbSpace};

/// A picture in linear light, row by row from the top left, unclamped.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The space the pixels are given in.
    pub space: RgbSpace,
    /// One colour for each pixel, not multiplied by its coverage.
    pub linear: Vec<[f32; 3]>,
    /// How much of each pixel the object covers, 0–1.
    pub coverage: Vec<f32>,
}

impl Picture {
    /// A black picture that covers nothing.
    pub fn new(width: u32, height: u32, space: RgbSpace) -> Self {
        let pixels = width as usize * height as usize;
        Self { width, height, space, linear: vec![[0.0; 3]; pixels], coverage: vec![0.0; pixels] }
    }

    /// The colour of a pixel.
    ///
    /// # Panics
    /// Outside the picture.
    pub fn rgb(&self, column: u32, row: u32) -> Rgb {
        Rgb(self.linear[row as usize * self.width as usize + column as usize].map(f64::from))
    }

    /// Mean colour of what is covered.
    pub fn mean(&self) -> Rgb {
        let covered = self.linear.iter().zip(&self.coverage);
        let (sum, area) = covered.fold((Rgb::BLACK, 0.0), |(sum, area), (rgb, &coverage)| {
            let weight = f64::from(coverage);
            (sum + Rgb(rgb.map(f64::from)) * weight, area + weight)
        });
        sum / area
    }

    /// The picture in 8-bit sRGB. Pixels outside sRGB are clipped, and counted.
    pub fn to_srgb8(&self) -> Srgb8Picture {
        let encoder = Encoder::new(self.space);
        let width = self.width as usize;
        let mut rgba = vec![0; 4 * self.linear.len()];
        let codes = rgba.as_chunks_mut().0.par_chunks_mut(width);
        let rows = codes.zip(self.linear.par_chunks(width).zip(self.coverage.par_chunks(width)));
        let new_planes = || [(); 3].map(|()| vec![0.0; width]);
        let clipped = rows.map_init(new_planes, |planes, (codes, (linear, coverage))| {
            for (at, colour) in linear.iter().enumerate() {
                (0..3).for_each(|channel| planes[channel][at] = colour[channel]);
            }
            let clipped =
                encoder.colours(Linear { colours: planes.each_ref().map(Vec::as_slice), light: None }, coverage, codes);
            write_alpha(coverage, codes);
            clipped
        });
        Srgb8Picture { clipped: clipped.sum(), width: self.width, height: self.height, rgba }
    }

    /// The picture as OpenEXR: 32-bit floats, colour multiplied by alpha, with the space's chromaticities.
    pub fn to_exr(&self) -> Result<Vec<u8>, exr::error::Error> {
        let width = self.width as usize;
        let channels = SpecificChannels::rgba(|position: Vec2<usize>| {
            let index = position.y() * width + position.x();
            let ([red, green, blue], alpha) = (self.linear[index], self.coverage[index]);
            (red * alpha, green * alpha, blue * alpha, alpha)
        });
        let size = (width, self.height as usize);
        let layer = LayerAttributes::named("");
        let mut image = Image::from_layer(exr::prelude::Layer::new(size, layer, Encoding::FAST_LOSSLESS, channels));
        image.attributes.display_window = IntegerBounds::from_dimensions(size);
        image.attributes.chromaticities = Some(chromaticities(self.space));
        let mut bytes = Cursor::new(Vec::new());
        image.write().to_buffered(&mut bytes)?;
        Ok(bytes.into_inner())
    }

    /// Saves the picture as OpenEXR.
    pub fn save_exr(&self, path: &Path) -> Result<(), SaveError> {
        let encoded = self.to_exr();
        let bytes = encoded.map_err(|e| SaveError::Encode { path: path.to_owned(), reason: e.to_string() })?;
        write_atomically(path, &bytes)
    }

    /// Saves the picture as the ending of the name says: PNG (8-bit sRGB) or OpenEXR (linear, unclipped).
    pub fn save(&self, path: &Path) -> Result<(), SaveError> {
        let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match ending.as_deref() {
            Some("png") => self.to_srgb8().save_png(path),
            Some("exr") => self.save_exr(path),
            _ => Err(SaveError::UnknownFormat { path: path.to_owned(), known: ".png or .exr" }),
        }
    }

    /// This picture, a gap, and another of the same space beside it.
    ///
    /// # Panics
    /// If the spaces or heights differ.
    pub fn beside(&self, other: &Self, gap: u32) -> Self {
        assert_eq!((self.space, self.height), (other.space, other.height), "pictures that fit together");
        let mut both = Self::new(self.width + gap + other.width, self.height, self.space);
        both.paste(self, 0);
        both.paste(other, self.width + gap);
        both
    }

    /// This picture left of a vertical edge and another of the same size right of it; `edge` from 0 to 1.
    ///
    /// # Panics
    /// If the spaces or sizes differ.
    pub fn wiped(&self, other: &Self, edge: f64) -> Self {
        let shape = |p: &Self| (p.space, p.width, p.height);
        assert_eq!(shape(self), shape(other), "pictures that fit together");
        let first_column = (edge.clamp(0.0, 1.0) * f64::from(self.width)).round() as usize;
        let mut wiped = self.clone();
        let width = self.width as usize;
        for row in 0..self.height as usize {
            let range = row * width + first_column..(row + 1) * width;
            wiped.linear[range.clone()].copy_from_slice(&other.linear[range.clone()]);
            wiped.coverage[range.clone()].copy_from_slice(&other.coverage[range]);
        }
        wiped
    }

    fn paste(&mut self, part: &Self, column: u32) {
        for row in 0..part.height as usize {
            let from = row * part.width as usize..(row + 1) * part.width as usize;
            let start = row * self.width as usize + column as usize;
            let to = start..start + part.width as usize;
            self.linear[to.clone()].copy_from_slice(&part.linear[from.clone()]);
            self.coverage[to].copy_from_slice(&part.coverage[from]);
        }
    }
}

fn chromaticities(space: RgbSpace) -> Chromaticities {
    let vector = |c: Chromaticity| Vec2(c.x as f32, c.y as f32);
    let [red, green, blue] = space.primaries().map(vector);
    Chromaticities { red, green, blue, white: vector(space.white()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one_pixel(rgb: [f32; 3]) -> Picture {
        Picture { linear: vec![rgb], coverage: vec![1.0], ..Picture::new(1, 1, RgbSpace::LinRec709) }
    }

    #[test]
    fn what_srgb_cannot_show_is_counted() {
        assert_eq!(one_pixel([1.0, 0.5, 0.0]).to_srgb8().clipped, 0);
        assert_eq!(one_pixel([1.01, 0.5, 0.0]).to_srgb8().clipped, 1);
        assert_eq!(one_pixel([f32::NAN, 0.5, 0.0]).to_srgb8().clipped, 1);
    }

    #[test]
    fn exr_keeps_floats_and_space() {
        let picture = Picture { space: RgbSpace::AcesCg, ..one_pixel([1.06, 0.25, -0.125]) };
        let bytes = picture.to_exr().unwrap();
        let decoded = image::load_from_memory_with_format(&bytes, image::ImageFormat::OpenExr).unwrap().into_rgba32f();
        assert_eq!(decoded.into_raw(), [1.06, 0.25, -0.125, 1.0]);
        let meta = exr::meta::MetaData::read_from_buffered(bytes.as_slice(), false).unwrap();
        let written = meta.headers[0].shared_attributes.chromaticities.unwrap();
        assert_eq!(written, chromaticities(RgbSpace::AcesCg));
    }

    #[test]
    fn wiping_and_placing_side_by_side_keep_pixels() {
        let (a, b) = (one_pixel([0.25; 3]), one_pixel([0.5; 3]));
        let both = a.beside(&b, 2);
        assert_eq!((both.width, both.rgb(0, 0), both.rgb(3, 0)), (4, Rgb::splat(0.25), Rgb::splat(0.5)));
        assert_eq!(both.coverage, [1.0, 0.0, 0.0, 1.0]);
        assert_eq!((a.wiped(&b, 0.0), a.wiped(&b, 1.0)), (b.clone(), a.clone()));
    }

    #[test]
    fn other_endings_are_refused() {
        let error = one_pixel([0.0; 3]).save(Path::new("sphere.bmp")).unwrap_err();
        assert!(error.to_string().contains("sphere.bmp") && error.to_string().contains(".exr"));
    }
}
