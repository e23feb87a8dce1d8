//! r and t: what every field called specular color, edge tint or color82 takes.

use super::Kept;
use super::loss::{Cause, Clip, Parameter, clip};
use super::material::Material;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{FresnelModel, h_of_schlick, t_from_r_h};

/// r and t within `[0, 1]`, where readers would clip without a word.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tint {
    pub r: Rgb,
    pub t: Rgb,
    pub clips: Vec<Clip>,
}

impl Tint {
    /// t = h / S(r, 1/7) of the clipped r and the original h, so that h survives wherever t can reach it.
    pub(super) fn of(r: Rgb, h: Rgb) -> Self {
        let mut clips = Vec::new();
        let r = clip(Parameter::R, r, 1.0, &mut clips);
        let t = clip(Parameter::T, r.zip(h, t_from_r_h), 1.0, &mut clips);
        Self { r, t, clips }
    }

    /// The tint of a material in the space of its file.
    pub(super) fn of_material(material: &Material<'_>) -> Self {
        Self::of(material.r, material.h)
    }

    /// The tint of a material in a space its file also speaks for: r and h are converted first, then t is derived.
    pub(super) fn in_space(material: &Material<'_>, space: RgbSpace) -> Self {
        let preset = material.preset.in_space(space);
        let h = if material.kept == Kept::Whole { preset.h } else { preset.r.map(h_of_schlick) };
        Self::of(preset.r, h)
    }

    /// The curve a reader shows.
    pub(super) fn model(&self) -> FresnelModel {
        FresnelModel::F82Tint { r: self.r, t: self.t }
    }

    /// What was lost to get there.
    pub(super) fn causes(&self) -> Vec<Cause> {
        if self.clips.is_empty() { Vec::new() } else { vec![Cause::Clipped(self.clips.clone())] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::CosTheta;

    /// Measured gold leaves the box in red; its h must not leave with it.
    #[test]
    fn clipping_r_keeps_h() {
        let (r, h) = (Rgb([1.04, 0.78, 0.34]), Rgb([0.98, 0.88, 0.63]));
        let tint = Tint::of(r, h);
        assert_eq!((tint.r[0], tint.clips.len()), (1.0, 1));
        assert!(tint.model().reflectance(CosTheta::MAX).max_abs_difference(h) < 1e-14);
    }

    #[test]
    fn both_ends_of_t_are_told() {
        let tint = Tint::of(Rgb::splat(0.5), Rgb([0.9, -0.1, 0.5]));
        let clipped: Vec<_> = tint.clips.iter().map(|clip| (clip.channel, clip.after)).collect();
        assert_eq!(clipped, [(0, 1.0), (1, 0.0)]);
        assert_eq!(tint.causes().len(), 1);
    }
}
