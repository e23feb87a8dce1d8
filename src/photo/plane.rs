//! A picture of numbers that are no colours: a facing ratio, ids of materials, a matte.

use std::ops::ControlFlow;
use std::path::Path;

use super::{PhotoError, read};

/// What the numbers of a [`Plane`] are, which says how integers and alpha are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaneKind {
    /// The cosine between normal and view, 0–1: integers are shares of their range.
    Facing,
    /// Whole numbers: integers as they are, colours of 8 bits as the number `#rrggbb`.
    Id,
    /// How much of each pixel belongs to something, 0–1.
    Matte,
}

impl PlaneKind {
    /// Words in the names of channels that hold it, in small letters without separators.
    pub(super) const fn names(self) -> &'static [&'static str] {
        match self {
            Self::Facing => &["facing", "ndotv", "vdotn", "nov"],
            Self::Id => &["materialid", "objectid", "matid", "objid", "indexma", "indexob"],
            Self::Matte => &["matte", "mask"],
        }
    }
}

/// One channel of a picture, as stored: no tone curve, no matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// File name.
    pub name: String,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Name of the channel that was read.
    pub channel: String,
    /// One value for each pixel, row by row.
    pub values: Vec<f32>,
    /// Alpha of each pixel, where the file has it.
    pub coverage: Option<Vec<f32>>,
    /// What a person should know.
    pub warnings: Vec<String>,
}

/// What a reader of a format hands over.
pub(super) struct PlanePixels {
    pub size: [u32; 2],
    pub channel: String,
    pub values: Vec<f32>,
    pub coverage: Option<Vec<f32>>,
    pub warnings: Vec<String>,
}

impl Plane {
    /// Opens an OpenEXR or a PNG. `channel` names the one to read; the likeliest unless given.
    pub fn open(
        path: &Path,
        kind: PlaneKind,
        channel: Option<&str>,
        progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
    ) -> Result<Self, PhotoError> {
        let name = path.display().to_string();
        let bytes = read::file_bytes(path).map_err(|kind| kind.of(&name))?;
        Self::from_bytes(&name, &bytes, kind, channel, progress)
    }

    /// Reads the bytes of a file.
    pub fn from_bytes(
        name: &str,
        bytes: &[u8],
        kind: PlaneKind,
        channel: Option<&str>,
        progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
    ) -> Result<Self, PhotoError> {
        let pixels = read::plane(name, bytes, kind, channel, progress).map_err(|kind| kind.of(name))?;
        let [width, height] = pixels.size;
        Ok(Self {
            name: name.to_owned(),
            width,
            height,
            channel: pixels.channel,
            values: pixels.values,
            coverage: pixels.coverage,
            warnings: pixels.warnings,
        })
    }
}
