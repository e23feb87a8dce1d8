//! A preset as a writer sees it: in the target's space, with names its format takes.

use super::names::{identifier, one_line};
use super::{ExportError, Kept, Options, Target};
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{FresnelModel, h_of_schlick};
use crate::preset::Preset;

/// What every writer starts from. r and h have been converted; nothing has been clipped or derived.
#[derive(Debug)]
pub(super) struct Material<'a> {
    /// The preset as it was given, in its own space.
    pub preset: &'a Preset,
    /// Its name without anything that could leave a line.
    pub name: String,
    /// Its name as an identifier.
    pub identifier: String,
    /// The space of this file.
    pub space: RgbSpace,
    /// Reflectance facing the surface, in `space`.
    pub r: Rgb,
    /// Reflectance at 81.8°, in `space`.
    pub h: Rgb,
    /// Perceptual roughness.
    pub roughness: f64,
    /// What the file says of the curve.
    pub kept: Kept,
}

impl<'a> Material<'a> {
    /// Converts a preset for a target; refuses numbers no file can carry and spaces the reader does not know.
    pub(super) fn new(preset: &'a Preset, target: Target, options: &Options) -> Result<Self, ExportError> {
        let space = options.space_for(target, preset.space)?;
        if !(preset.r.is_finite() && preset.h.is_finite()) {
            return Err(ExportError::NotFinite(one_line(&preset.name)));
        }
        if !(0.0..=1.0).contains(&preset.roughness) {
            return Err(ExportError::Roughness { preset: one_line(&preset.name), roughness: preset.roughness });
        }
        Ok(Self {
            name: one_line(&preset.name),
            identifier: identifier(&preset.name),
            space,
            r: preset.space.convert(preset.r, space),
            h: preset.space.convert(preset.h, space),
            roughness: preset.roughness,
            kept: Kept::Whole,
            preset,
        })
    }

    /// The same with less of its curve.
    pub(super) fn keeping(self, kept: Kept) -> Self {
        let h = if kept == Kept::Whole { self.h } else { self.r.map(h_of_schlick) };
        Self { h, kept, ..self }
    }

    /// The whole preset, in the space of the file.
    pub(super) fn in_its_space(&self) -> Preset {
        self.preset.in_space(self.space)
    }

    /// The curve the file is to say, in its space.
    pub(super) fn model(&self) -> FresnelModel {
        self.model_of(self.r, self.h)
    }

    /// The same in a space the file also speaks for.
    pub(super) fn model_in(&self, space: RgbSpace) -> FresnelModel {
        let preset = self.preset.in_space(space);
        self.model_of(preset.r, preset.h)
    }

    fn model_of(&self, r: Rgb, h: Rgb) -> FresnelModel {
        match self.kept {
            Kept::Whole => FresnelModel::Hoffman { r, h },
            Kept::Schlick => FresnelModel::Schlick { r },
            Kept::Constant => FresnelModel::Constant { r },
        }
    }

    /// Microfacet α of the usual parameterisation, the square of roughness.
    pub(super) fn alpha(&self) -> f64 {
        self.roughness * self.roughness
    }
}
