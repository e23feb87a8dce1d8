//! A photograph in memory.

use std::fmt;
use std::ops::{ControlFlow, Range};
use std::path::Path;

use half::f16;
use nalgebra::{Matrix3, Vector3};

use super::curve::Curve;
use super::linearizer::Linearizer;
use super::orientation::{Orientation, Places};
use super::read;
use super::samples::{Sample, Samples, flags_of, is_plain, triple};
use super::{ColourRule, FirstLook, PhotoError, Pixel, PixelFlags, Warning};
use crate::color::Rgb;

/// What to do where a file leaves a choice.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OpenOptions {
    /// The layer of an EXR to read; the unnamed one when `None`.
    pub layer: Option<String>,
    /// How to read a file that says nothing about its colours.
    pub untagged: Untagged,
}

/// How to read a file that says nothing about its colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Untagged {
    /// As sRGB; floating-point TIFF as linear Rec.709.
    #[default]
    Srgb,
    /// As linear Rec.709, for linear files of a raw converter.
    Linear,
}

/// A photograph: its stored samples, how they become linear Rec.709, and what is wrong with them.
#[derive(Clone)]
pub struct Photo {
    /// File name, or the name of a built-in sample.
    pub name: String,
    /// SHA-256 of the file, hexadecimal; empty for a picture that never was a file.
    pub sha256: String,
    /// Width in pixels after orientation.
    pub width: u32,
    /// Height in pixels after orientation.
    pub height: u32,
    /// Which rule made it linear.
    pub colour_rule: ColourRule,
    /// Every colour layer of an EXR; empty for other formats.
    pub layers: Vec<String>,
    /// What a person must know before measuring in it.
    pub warnings: Vec<Warning>,
    pub(super) stored: std::sync::Arc<Stored>,
}

/// The samples of a file, in its own order, with the way to linear Rec.709.
pub(super) struct Stored {
    pub samples: Samples,
    /// Channels of each pixel: 1 for grey, 3 for RGB.
    pub channels: usize,
    /// Width and height as stored.
    pub size: [u32; 2],
    pub orientation: Orientation,
    pub linearizer: Linearizer,
    /// True when the samples are proportional to light.
    pub is_linear: bool,
}

impl fmt::Debug for Photo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Photo")
            .field("name", &self.name)
            .field("size", &[self.width, self.height])
            .field("depth", &self.stored.samples.depth())
            .field("colour_rule", &self.colour_rule)
            .field("warnings", &self.warnings)
            .finish_non_exhaustive()
    }
}

impl Photo {
    /// Opens a file. `progress` hears fractions of the work and may stop it.
    pub fn open(path: &Path, progress: &mut dyn FnMut(f32) -> ControlFlow<()>) -> Result<Self, PhotoError> {
        Self::open_with(path, &OpenOptions::default(), progress)
    }

    /// Opens a file where a choice is to be made.
    pub fn open_with(
        path: &Path,
        options: &OpenOptions,
        progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
    ) -> Result<Self, PhotoError> {
        Self::open_file(path, options, None, progress)
    }

    /// Opens a file and shows `look` a coarse copy of a large JPEG, from another thread, before it is decoded.
    pub fn open_showing(
        path: &Path,
        options: &OpenOptions,
        look: &mut (dyn FnMut(FirstLook) + Send),
        progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
    ) -> Result<Self, PhotoError> {
        Self::open_file(path, options, Some(look), progress)
    }

    fn open_file(
        path: &Path,
        options: &OpenOptions,
        look: Option<read::Look<'_>>,
        progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
    ) -> Result<Self, PhotoError> {
        let bytes = read::file_bytes(path).map_err(|kind| kind.of(&path.display().to_string()))?;
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        read::photo(&name, &bytes, options, look, progress).map_err(|kind| kind.of(&name))
    }

    /// Reads the bytes of a file; the extension of `name` serves only to recognise raw files.
    pub fn from_bytes(
        name: &str,
        bytes: &[u8],
        progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
    ) -> Result<Self, PhotoError> {
        Self::from_bytes_with(name, bytes, &OpenOptions::default(), progress)
    }

    /// Reads the bytes of a file where a choice is to be made.
    pub fn from_bytes_with(
        name: &str,
        bytes: &[u8],
        options: &OpenOptions,
        progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
    ) -> Result<Self, PhotoError> {
        read::photo(name, bytes, options, None, progress).map_err(|kind| kind.of(name))
    }

    /// A picture that is linear Rec.709 already, row by row.
    ///
    /// # Panics
    /// If `linear` does not hold `width` × `height` pixels.
    pub fn from_linear(name: &str, width: u32, height: u32, linear: Vec<[f32; 3]>) -> Self {
        assert_eq!(linear.len(), width as usize * height as usize, "one value for each pixel");
        let samples = Samples::F32(linear.into_flattened());
        let linearizer = Linearizer::from_curves([const { Curve::Linear }; 3], Matrix3::identity(), &samples);
        let (size, orientation) = ([width, height], Orientation::default());
        let stored = Stored { samples, channels: 3, size, orientation, linearizer, is_linear: true };
        Self::new(name, String::new(), ColourRule::Linear, stored)
    }

    pub(super) fn new(name: &str, sha256: String, colour_rule: ColourRule, stored: Stored) -> Self {
        assert_eq!(stored.samples.len(), stored.size[0] as usize * stored.size[1] as usize * stored.channels);
        let [width, height] = stored.orientation.size(stored.size);
        let (layers, warnings) = (Vec::new(), Vec::new());
        Self { name: name.to_owned(), sha256, width, height, colour_rule, layers, warnings, stored: stored.into() }
    }

    /// True when the stored values are proportional to light, so that no tone curve stands between.
    pub fn is_scene_linear(&self) -> bool {
        self.colour_rule.is_scene_linear()
    }

    /// The pixel in a column and row, counted from the top left; `None` outside.
    pub fn pixel(&self, column: u32, row: u32) -> Option<Pixel> {
        let is_inside = column < self.width && row < self.height;
        is_inside.then(|| self.stored.pixel(self.stored.orientation.stored([column, row], self.stored.size)))
    }

    /// Hands on the pixels of a row in some columns, from left to right; columns outside are left out.
    pub fn for_each_of_row(&self, row: u32, columns: Range<u32>, take: impl FnMut(Pixel)) {
        let columns = if row < self.height { columns.start..columns.end.min(self.width) } else { 0..0 };
        let stored = &*self.stored;
        let places = stored.orientation.places(row, columns, stored.size);
        match &stored.samples {
            Samples::U8(samples) => stored.for_each(samples, &places, take),
            Samples::U16(samples) => stored.for_each(samples, &places, take),
            Samples::F16(samples) => stored.for_each::<f16>(samples, &places, take),
            Samples::F32(samples) => stored.for_each(samples, &places, take),
        }
    }
}

/// Part of a row in linear Rec.709.
#[derive(Default)]
pub(super) struct RowPart {
    pub rgb: Vec<[f64; 3]>,
    /// The flags of each pixel; nothing where it was seen at once that none has any.
    pub flags: Vec<PixelFlags>,
}

impl RowPart {
    /// Reads some columns of a row, all inside the picture.
    pub fn read(&mut self, photo: &Photo, row: u32, columns: Range<u32>) {
        let stored = &*photo.stored;
        let places = stored.orientation.places(row, columns, stored.size);
        match &stored.samples {
            Samples::U8(samples) => self.read_places(stored, samples, &places),
            Samples::U16(samples) => self.read_places(stored, samples, &places),
            Samples::F16(samples) => self.read_places::<f16>(stored, samples, &places),
            Samples::F32(samples) => self.read_places(stored, samples, &places),
        }
    }

    fn read_places<T: Sample>(&mut self, stored: &Stored, samples: &[T], places: &Places) {
        let (black, channels) = (T::black(stored.is_linear), stored.channels);
        let pixels = || places.iter().map(|place| stored.at(samples, place));
        self.rgb.clear();
        stored.linearizer.for_each(pixels(), |_, linear| self.rgb.push(linear));
        self.flags.clear();
        let run = places.range().map(|range| &samples[range.start * channels..range.end * channels]);
        if !run.is_some_and(|run| is_plain(run, black)) {
            self.flags.extend(pixels().map(|pixel| flags_of(pixel, black)));
        }
    }
}

impl Stored {
    /// The pixel at a stored position.
    fn pixel(&self, position: [u32; 2]) -> Pixel {
        match &self.samples {
            Samples::U8(samples) => self.pixel_of(samples, position),
            Samples::U16(samples) => self.pixel_of(samples, position),
            Samples::F16(samples) => self.pixel_of::<f16>(samples, position),
            Samples::F32(samples) => self.pixel_of(samples, position),
        }
    }

    fn for_each<T: Sample>(&self, samples: &[T], places: &Places, mut take: impl FnMut(Pixel)) {
        let black = T::black(self.is_linear);
        self.linearizer.for_each(places.iter().map(|place| self.at(samples, place)), |stored, linear| {
            take(Pixel { rgb: Rgb(linear), flags: flags_of(stored, black) });
        });
    }

    #[inline]
    fn at<T: Sample>(&self, samples: &[T], place: usize) -> [T; 3] {
        triple(&samples[place * self.channels..][..self.channels])
    }

    fn pixel_of<T: Sample>(&self, samples: &[T], [x, y]: [u32; 2]) -> Pixel {
        let stored = self.at(samples, y as usize * self.size[0] as usize + x as usize);
        let linear: Vector3<f64> = self.linearizer.pixel(stored);
        Pixel { rgb: Rgb::from(linear), flags: flags_of(stored, T::black(self.is_linear)) }
    }
}

impl PixelFlags {
    /// The flags that either of two pixels has.
    pub fn or(self, other: Self) -> Self {
        Self {
            clipped: [
                self.clipped[0] | other.clipped[0],
                self.clipped[1] | other.clipped[1],
                self.clipped[2] | other.clipped[2],
            ],
            black: self.black | other.black,
            non_finite: self.non_finite | other.non_finite,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_picture_gives_back_its_values() {
        let linear = vec![[0.1, 0.2, 0.3], [-0.5, 2.0, 0.0], [f32::NAN, 1.0, 1.0], [0.0; 3]];
        let photo = Photo::from_linear("made", 2, 2, linear);
        assert_eq!(photo.pixel(0, 0).unwrap().rgb, Rgb([0.1f32, 0.2, 0.3].map(f64::from)));
        assert_eq!(photo.pixel(1, 0).unwrap().rgb, Rgb([-0.5, 2.0, 0.0]));
        assert!(photo.pixel(0, 1).unwrap().flags.non_finite);
        assert_eq!(photo.pixel(0, 1).unwrap().rgb, Rgb::BLACK);
        assert!(photo.pixel(1, 1).unwrap().flags.black);
        assert_eq!(photo.pixel(2, 0), None);
        let mut row = Vec::new();
        photo.for_each_of_row(0, 0..9, |pixel| row.push(pixel));
        assert_eq!(row, [photo.pixel(0, 0).unwrap(), photo.pixel(1, 0).unwrap()]);
        assert!(photo.is_scene_linear());
    }
}
