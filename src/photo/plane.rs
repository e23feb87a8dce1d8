//! A picture of numbers that are no colours: a facing ratio, ids of materials, a matte.

use std::ops::ControlFlow;
use std::path::Path;

use super::{PhotoError, read};

/// Channels that should say the same differ where they are farther apart: lossy files round by less.
pub(super) const DIFFERENT: f32 = 0.02;

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
    /// What the numbers are, as a warning says it.
    const fn label(self) -> &'static str {
        match self {
            Self::Facing => "facing ratio",
            Self::Id => "id",
            Self::Matte => "matte",
        }
    }

    /// What a person should know where the channels of a colour or a vector differ, of which one was taken.
    pub(super) fn differing(self, names: &[&str], taken: &str, differing: usize, pixels: usize) -> Option<String> {
        let share = 100.0 * differing as f64 / pixels.max(1) as f64;
        let sentence = || {
            format!(
                "channels {} differ in {share:.1} % of the pixels, as those of normals or colours do; {taken} was taken \
                 as the {}",
                names.join(", "),
                self.label()
            )
        };
        (differing > 0).then(sentence)
    }

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
    /// What of it can be an id.
    pub ids: Ids,
    /// What a person should know.
    pub warnings: Vec<String>,
}

/// Which ids the numbers of a picture can be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ids {
    /// The largest that is told from the next one.
    pub largest: u32,
    /// The id of each pixel, where the file has whole numbers that 32-bit floats would round.
    pub exact: Option<Vec<u32>>,
}

impl Ids {
    /// Those of half floats: 2049 is stored as 2048.
    pub const OF_HALVES: Self = Self { largest: (1 << 11) - 1, exact: None };
    /// Those of floats: 16777217 is stored as 16777216.
    pub const OF_FLOATS: Self = Self { largest: (1 << 24) - 1, exact: None };
}

/// What a reader of a format hands over.
pub(super) struct PlanePixels {
    pub size: [u32; 2],
    pub channel: String,
    pub values: Vec<f32>,
    pub coverage: Option<Vec<f32>>,
    pub ids: Ids,
    pub warnings: Vec<String>,
}

impl Plane {
    /// The id of a pixel; a mixture at an edge is none, nor is a number that stands for several.
    pub fn id(&self, pixel: usize) -> Option<u32> {
        if let Some(exact) = &self.ids.exact {
            return Some(exact[pixel]);
        }
        let value = self.values[pixel];
        let is_whole = value.fract() == 0.0 && value >= 0.0 && f64::from(value) <= f64::from(self.ids.largest);
        is_whole.then_some(value as u32)
    }

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
            ids: pixels.ids,
            warnings: pixels.warnings,
        })
    }
}
