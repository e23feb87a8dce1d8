//! A preset as a writer sees it: in the target's space, with names its format takes.

use super::form::{form_in_space, is_finite, with_h};
use super::names::{identifier, one_line};
use super::{ExportError, Options, Target};
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{CosTheta, FresnelModel};
use crate::preset::Preset;
use crate::study::Form;

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
    /// What the file is to say, in `space`; r and h in place of r and t.
    pub form: Form,
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
        let (r, h) = (preset.space.convert(preset.r, space), preset.space.convert(preset.h, space));
        Ok(Self {
            name: one_line(&preset.name),
            identifier: identifier(&preset.name),
            space,
            r,
            h,
            roughness: preset.roughness,
            form: Form::Model { model: FresnelModel::Hoffman { r, h } },
            preset,
        })
    }

    /// The same with other parameters, which are in the space of the file.
    pub(super) fn saying(self, form: &Form) -> Result<Self, ExportError> {
        if !is_finite(form) {
            return Err(ExportError::NotFinite(self.name));
        }
        let form = with_h(form.clone());
        let (r, h) = match form {
            Form::Model { model: FresnelModel::Hoffman { r, h } } => (r, h),
            _ => (form.reflectance(CosTheta::FACING), form.reflectance(CosTheta::MAX)),
        };
        Ok(Self { r, h, form, ..self })
    }

    /// False where r alone says everything.
    pub(super) const fn has_edge(&self) -> bool {
        !matches!(self.form, Form::Model { model: FresnelModel::Constant { .. } | FresnelModel::Schlick { .. } })
    }

    /// The preset with the r and h of the file, in its space.
    pub(super) fn in_its_space(&self) -> Preset {
        let whole = self.preset.in_space(self.space);
        if whole.r == self.r && whole.h == self.h {
            return whole;
        }
        let mut changed = Preset { r: self.r, h: self.h, ..whole };
        changed.mark_edited();
        changed
    }

    /// r and h in a space the file also speaks for.
    pub(super) fn r_h_in(&self, space: RgbSpace) -> (Rgb, Rgb) {
        (self.space.convert(self.r, space), self.space.convert(self.h, space))
    }

    /// What is to be said in a space the file also speaks for.
    pub(super) fn form_in(&self, space: RgbSpace) -> Form {
        form_in_space(&self.form, self.space, space).expect("files of many spaces say r and h, which are colours")
    }

    /// Microfacet α of the usual parameterisation, the square of roughness.
    pub(super) fn alpha(&self) -> f64 {
        self.roughness * self.roughness
    }
}
