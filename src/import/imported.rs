//! A metal in another program's words, and the preset it becomes.

use super::ImportError;
use crate::color::{Rgb, RgbSpace};
use crate::fit::convert;
use crate::fresnel::{CosTheta, FresnelModel, ModelKind};
use crate::preset::Preset;

/// As many metals as one would keep in a library.
const MOST_METALS: usize = 100_000;

/// The presets of a file, and what a person should know about them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Imported {
    /// In the order of the file.
    pub presets: Vec<Preset>,
    /// Sentences: what was assumed, approximated or skipped.
    pub notes: Vec<String>,
}

/// What a file says about one metal.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Found {
    pub name: String,
    pub space: RgbSpace,
    pub model: FresnelModel,
    /// Perceptual roughness; `None` where the file has none.
    pub roughness: Option<f64>,
}

impl Imported {
    /// Adds a metal as r and h; anything but a rewording is noted with its size.
    pub(super) fn add(&mut self, found: Found) -> Result<(), ImportError> {
        let Found { name, space, model, roughness } = found;
        if self.presets.len() == MOST_METALS {
            return Err(ImportError::TooMany(MOST_METALS));
        }
        check_index(&name, &model)?;
        let conversion = convert(&model, ModelKind::Hoffman, space).map_err(ImportError::no_material(&name))?;
        if !conversion.is_exact() {
            self.notes.push(format!(
                "“{name}” is given as {}; its r and h are read off that curve, and between them it is off by at most \
                 {:.4} in F and {:.2} in ΔE2000",
                model.kind().label(),
                conversion.max_difference,
                conversion.max_delta_e,
            ));
        }
        let mut preset = Preset::new_authored();
        let (r, h) = (model.reflectance(CosTheta::FACING), model.reflectance(CosTheta::MAX));
        preset.roughness = checked(&name, roughness.unwrap_or(preset.roughness))?;
        self.presets.push(Preset { name, space, r, h, ..preset });
        Ok(())
    }

    /// The space of values that come without one.
    pub(super) fn space_or_assumed(&mut self, given: Option<RgbSpace>, what: &str) -> RgbSpace {
        given.unwrap_or_else(|| {
            let space = RgbSpace::default();
            self.notes.push(format!("{what} names no colour space; {space} was assumed"));
            space
        })
    }
}

/// A negative n or k reflects more than the light it gets.
fn check_index(name: &str, model: &FresnelModel) -> Result<(), ImportError> {
    match model {
        FresnelModel::Conductor { n, k } if n.min_channel() < 0.0 || k.min_channel() < 0.0 => {
            Err(ImportError::metal(name, "it has a negative n or k, which is no metal"))
        }
        _ => Ok(()),
    }
}

fn checked(name: &str, roughness: f64) -> Result<f64, ImportError> {
    if (0.0..=1.0).contains(&roughness) {
        return Ok(roughness);
    }
    Err(ImportError::metal(name, format!("roughness is {roughness}; it must lie in 0–1")))
}

/// r and h as a model.
pub(super) fn hoffman(r: Rgb, h: Rgb) -> FresnelModel {
    FresnelModel::Hoffman { r, h }
}
