//! A metal in another program's words, and the preset it becomes.

use super::ImportError;
use crate::color::{Rgb, RgbSpace, delta_e_rgb};
use crate::fit::{convert, h_by_least_squares};
use crate::fresnel::{CosTheta, FresnelModel, ModelKind, whole_degrees};
use crate::number::larger;
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
        let r = model.reflectance(CosTheta::FACING);
        let h = match model {
            FresnelModel::Gulbrandsen { .. } => fitted_h(&model, r),
            _ => model.reflectance(CosTheta::MAX),
        };
        if !conversion.is_exact() {
            self.notes.push(not_exact(&name, &model, h, space));
        }
        let mut preset = Preset::new_authored();
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

/// g says how the whole curve bends, so it becomes the h whose curve is nearest over the whole degrees, r being kept.
fn fitted_h(model: &FresnelModel, r: Rgb) -> Rgb {
    Rgb(std::array::from_fn(|channel| {
        let samples = whole_degrees().map(|cos_theta| (cos_theta, model.reflectance(cos_theta)[channel]));
        h_by_least_squares(samples, r[channel]).expect("the angles between 0° and 90° depend on h")
    }))
}

/// What a curve loses as r and h.
fn not_exact(name: &str, model: &FresnelModel, h: Rgb, space: RgbSpace) -> String {
    let ours = hoffman(model.reflectance(CosTheta::FACING), h);
    let differences = whole_degrees().map(|c| (ours.reflectance(c), model.reflectance(c)));
    let (f, delta_e) = differences.fold((0.0, 0.0), |(f, delta_e), (ours, theirs)| {
        (larger(f, ours.max_abs_difference(theirs)), larger(delta_e, delta_e_rgb(ours, theirs, space)))
    });
    let how = match model {
        FresnelModel::Gulbrandsen { .. } => "its r is kept and its h fitted to that curve by least squares",
        _ => "its r and h are read off that curve at 0° and 81.8°",
    };
    let kind = model.kind().label();
    format!("“{name}” is given as {kind}; {how}, off by at most {f:.4} in F and {delta_e:.2} in ΔE2000 over the angles")
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
