//! What comes out of an export, and why there may be none.

use thiserror::Error;

use super::{Loss, Target};
use crate::color::RgbSpace;

/// A file in memory; the shells decide where it goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportFile {
    /// File name without folder, safe on every system.
    pub name: String,
    /// Its contents.
    pub bytes: Vec<u8>,
}

/// The files of one export and what is lost in them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exported {
    /// One for each preset, or one palette for all.
    pub files: Vec<ExportFile>,
    /// Empty where every reader shows exactly what the presets say.
    pub losses: Vec<Loss>,
}

impl Exported {
    /// This and what another export adds.
    pub(super) fn with(mut self, other: Self) -> Self {
        self.files.extend(other.files);
        self.losses.extend(other.losses);
        self
    }
}

/// How to export.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The working space of the reader; `None` is linear Rec.709, or for the preset's own file its own.
    pub space: Option<RgbSpace>,
}

impl Options {
    /// The space the numbers of a target are written in; `own` is the preset's.
    pub fn space_for(&self, target: Target, own: RgbSpace) -> Result<RgbSpace, ExportError> {
        let allowed = target.spaces();
        match self.space {
            None if target == Target::Json => Ok(own),
            None => Ok(allowed[0]),
            Some(space) if allowed.contains(&space) => Ok(space),
            Some(space) => Err(ExportError::Space { target, space }),
        }
    }
}

/// Why a preset cannot be written.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum ExportError {
    #[error("there is no preset to export")]
    NoPreset,
    #[error("“{0}” has a value that is no number; only finite parameters can be exported")]
    NotFinite(String),
    #[error("“{preset}” has roughness {roughness}; it must lie in 0–1")]
    Roughness { preset: String, roughness: f64 },
    #[error("{} knows {}, not {space}", target.label(), names(target.spaces()))]
    Space { target: Target, space: RgbSpace },
    #[error("{} has no place for a function of one metal; glsl, hlsl, wgsl and osl have", target.label())]
    Baked { target: Target },
    #[error("{} could not be written: {reason}", target.label())]
    Write { target: Target, reason: String },
}

impl ExportError {
    /// A writer's own error, which for files in memory stands for a fault of this program.
    pub(super) fn write(target: Target) -> impl FnOnce(Box<dyn std::error::Error>) -> Self {
        move |error| Self::Write { target, reason: error.to_string() }
    }
}

fn names(spaces: &[RgbSpace]) -> String {
    spaces.iter().map(|space| space.id()).collect::<Vec<_>>().join(", ")
}
