//! r and t: what every field called specular color, edge tint or color82 takes.

use super::loss::{Cause, Clip, Parameter, clip};
use super::material::Material;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{FresnelModel, t_from_r_h};
use crate::study::Form;

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

    /// r alone: the file has no t, and its reader's white one is Schlick's edge.
    fn of_schlick(r: Rgb) -> Self {
        let mut clips = Vec::new();
        let r = clip(Parameter::R, r, 1.0, &mut clips);
        Self { r, t: Rgb::WHITE, clips }
    }

    /// The tint of a material in the space of its file.
    pub(super) fn of_material(material: &Material<'_>) -> Self {
        Self::in_space(material, material.space)
    }

    /// The tint of a material in a space its file also speaks for: r and h are converted first, then t is derived.
    pub(super) fn in_space(material: &Material<'_>, space: RgbSpace) -> Self {
        let (r, h) = material.r_h_in(space);
        if material.has_edge() { Self::of(r, h) } else { Self::of_schlick(r) }
    }

    /// r and t as they are, but for what the reader clips.
    pub(super) fn given(r: Rgb, t: Rgb) -> Self {
        let mut clips = Vec::new();
        let r = clip(Parameter::R, r, 1.0, &mut clips);
        let t = clip(Parameter::T, t, 1.0, &mut clips);
        Self { r, t, clips }
    }

    /// The curve a reader shows.
    pub(super) fn form(&self) -> Form {
        Form::Model { model: FresnelModel::F82Tint { r: self.r, t: self.t } }
    }

    /// What was lost to get there.
    pub(super) fn causes(&self) -> Vec<Cause> {
        if self.clips.is_empty() { Vec::new() } else { vec![Cause::Clipped(self.clips.clone())] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::{CosTheta, whole_degrees};

    /// Measured gold leaves the box in red; its h must not leave with it.
    #[test]
    fn clipping_r_keeps_h() {
        let (r, h) = (Rgb([1.04, 0.78, 0.34]), Rgb([0.98, 0.88, 0.63]));
        let tint = Tint::of(r, h);
        assert_eq!((tint.r[0], tint.clips.len()), (1.0, 1));
        assert!(tint.form().reflectance(CosTheta::MAX).max_abs_difference(h) < 1e-14);
    }

    /// Where only r is said there is no t that could be clipped.
    #[test]
    fn without_h_there_is_no_t_to_clip() {
        let tint = Tint::of_schlick(Rgb([1.04, 0.78, 0.34]));
        assert_eq!(tint.clips.iter().map(|clip| clip.parameter).collect::<Vec<_>>(), [Parameter::R]);
        let schlick = FresnelModel::Schlick { r: Rgb([1.0, 0.78, 0.34]) };
        for c in whole_degrees() {
            assert!(tint.form().reflectance(c).max_abs_difference(schlick.reflectance(c)) < 1e-14);
        }
    }

    #[test]
    fn both_ends_of_t_are_told() {
        let tint = Tint::of(Rgb::splat(0.5), Rgb([0.9, -0.1, 0.5]));
        let clipped: Vec<_> = tint.clips.iter().map(|clip| (clip.channel, clip.after)).collect();
        assert_eq!(clipped, [(0, 1.0), (1, 0.0)]);
        assert_eq!(tint.causes().len(), 1);
    }
}
