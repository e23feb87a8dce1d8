//! What a reader makes of a file: the curve by which a plan weighs it.

use super::blender::WORKING_SPACES;
use super::export::Translation;
use super::material::Material;
use super::tint::Tint;
use super::{ExportError, Options, Target};
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::CosTheta;
use crate::preset::Preset;
use crate::study::Form;

/// The curve that is read from a file: of what was clipped, fitted and left out, and linear where the file has numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// The space of its values.
    pub space: RgbSpace,
    shown: Form,
    target: Target,
}

impl Reading {
    /// The reflectance at an angle, unclamped, to the digits that files have.
    pub fn reflectance(&self, cos_theta: CosTheta) -> Rgb {
        self.target.read(|c| self.shown.reflectance(c), cos_theta)
    }
}

/// What comes back of the file that [`export_form`](super::export_form) writes: one curve for each working space that it
/// speaks for, which is one unless it is a script.
pub fn readings(preset: &Preset, target: Target, options: &Options, form: &Form) -> Result<Vec<Reading>, ExportError> {
    let material = Material::new(preset, target, options)?.saying(form)?;
    let reading = |(space, shown)| Reading { space, shown, target };
    Ok(match target {
        Target::Blender => {
            WORKING_SPACES.map(|(_, space)| (space, Tint::in_space(&material, space).form())).map(reading).to_vec()
        }
        _ => vec![reading((material.space, Translation::of(&material, target).shown))],
    })
}
