//! r and h as two colours of a palette.

use super::Target;
use super::loss::{Cause, Parameter, clip};
use super::material::Material;
use crate::color::{Rgb, srgb_decode, srgb_encode};
use crate::fresnel::FresnelModel;

/// A named sRGB colour, encoded, each channel in 0–1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Swatch {
    pub name: String,
    pub srgb: Rgb,
}

impl Swatch {
    /// "<name> r" and "<name> h". The material is in linear Rec.709.
    pub(super) fn pair(material: &Material<'_>) -> [Self; 2] {
        let swatch = |symbol: &str, linear: Rgb| Self {
            name: format!("{} {symbol}", material.name),
            srgb: linear.clipped().map(srgb_encode),
        };
        [swatch("r", material.r), swatch("h", material.h)]
    }

    /// The curve of the colours as they can be read back, and what that loses.
    pub(super) fn reading(material: &Material<'_>, target: Target) -> (FresnelModel, Vec<Cause>) {
        let mut clips = Vec::new();
        let r = clip(Parameter::R, material.r, 1.0, &mut clips);
        let h = clip(Parameter::H, material.h, 1.0, &mut clips);
        let clipped = (!clips.is_empty()).then_some(Cause::Clipped(clips));
        let bits = match target {
            Target::Gpl => Some(8),
            Target::Aco => Some(16),
            _ => None,
        };
        let read = |linear: Rgb| match bits {
            Some(bits) => linear.map(|v| srgb_decode(round_to_bits(srgb_encode(v), bits))),
            None => linear.map(|v| srgb_decode(f64::from(srgb_encode(v) as f32))),
        };
        let model = FresnelModel::Hoffman { r: read(r), h: read(h) };
        (model, clipped.into_iter().chain(bits.map(Cause::Rounded)).collect())
    }
}

fn round_to_bits(value: f64, bits: u32) -> f64 {
    let largest = f64::from((1_u32 << bits) - 1);
    (value * largest).round() / largest
}
