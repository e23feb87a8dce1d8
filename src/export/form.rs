//! The parameters that a file says: which kinds a target takes, and the same in another space.

use super::Target;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{COS_THETA_MAX, FresnelModel, ModelKind, PEAK_GAIN, SchlickSeries, h_from_r_t};
use crate::study::Form;

impl Target {
    /// Whether files of this target can say the parameters of a model; `None` stands for series, tables and wavelengths.
    ///
    /// Where a file cannot leave h out, it has no place for less either. Readers that know metals by g, or n and k, take
    /// r and h too: what comes nearest to their curve.
    pub const fn takes(self, model: Option<ModelKind>) -> bool {
        use ModelKind::{Conductor, F82Tint, GeneralizedSchlick, Gulbrandsen, Hoffman, Schlick};
        if self.is_sampled() || self.is_shader() {
            return true;
        }
        match model {
            Some(Hoffman | F82Tint) => true,
            Some(Schlick) => {
                matches!(self, Self::OpenPbr | Self::GeneralizedSchlick | Self::Blender | Self::Gltf | Self::Usd)
            }
            Some(GeneralizedSchlick) => matches!(self, Self::GeneralizedSchlick),
            Some(Gulbrandsen) => matches!(self, Self::StandardSurface | Self::Mitsuba),
            Some(Conductor) => matches!(self, Self::Mitsuba),
            _ => false,
        }
    }

    /// True where the file is a function of the cosine, in a language that can say any.
    pub const fn is_shader(self) -> bool {
        matches!(self, Self::Glsl | Self::Hlsl | Self::Wgsl | Self::Osl)
    }
}

/// Whether every number of a form can be written.
pub(super) fn is_finite(form: &Form) -> bool {
    let all = |values: &[f64]| values.iter().all(|value| value.is_finite());
    let all_rgb = |values: &[Rgb]| values.iter().all(|value| value.is_finite());
    match form {
        Form::Model { model } => match *model {
            FresnelModel::Constant { r } | FresnelModel::Schlick { r } => r.is_finite(),
            FresnelModel::Lazanyi { r, a, alpha } => all_rgb(&[r, a]) && alpha.is_finite(),
            FresnelModel::GeneralizedSchlick { r0, t, r90, p } => all_rgb(&[r0, t, r90]) && p.is_finite(),
            FresnelModel::Hoffman { r: first, h: second }
            | FresnelModel::F82Tint { r: first, t: second }
            | FresnelModel::Gulbrandsen { r: first, g: second }
            | FresnelModel::Conductor { n: first, k: second } => all_rgb(&[first, second]),
        },
        Form::Series(series) => series.r.is_finite() && series.bend.is_finite() && all_rgb(&series.coefficients),
        Form::Table { rows } => rows.len() > 1 && all_rgb(rows),
        Form::Spectral { n, k, weights, .. } => all(n) && all(k) && all_rgb(weights),
    }
}

/// n or k as single precision can compute with it: a fit to a reflectance above 1 leads to 1e40, whose square is infinite.
/// The limit and everything above it are mirrors.
pub(super) fn limited_index(index: Rgb) -> Rgb {
    index.map(|value| value.min(1e8))
}

/// A form with r and h in place of r and t, which are one curve.
pub(super) fn with_h(form: Form) -> Form {
    match form {
        Form::Model { model: FresnelModel::F82Tint { r, t } } => {
            Form::Model { model: FresnelModel::Hoffman { r, h: r.zip(t, h_from_r_t) } }
        }
        form => form,
    }
}

/// The same curve in another space; `None` where its parameters are no colours: n and k, r and g.
pub fn form_in_space(form: &Form, own: RgbSpace, space: RgbSpace) -> Option<Form> {
    if own == space {
        return Some(form.clone());
    }
    let to = |rgb: Rgb| own.convert(rgb, space);
    Some(match form {
        Form::Model { model } => Form::Model { model: model_in_space(model, to)? },
        Form::Series(series) => Form::Series(SchlickSeries {
            r: to(series.r),
            coefficients: series.coefficients.iter().map(|b| to(*b)).collect(),
            ..series.clone()
        }),
        Form::Table { rows } => Form::Table { rows: rows.iter().map(|row| to(*row)).collect() },
        Form::Spectral { wavelengths_nm, n, k, weights } => Form::Spectral {
            wavelengths_nm: wavelengths_nm.clone(),
            n: n.clone(),
            k: k.clone(),
            weights: weights.iter().map(|weight| to(*weight)).collect(),
        },
    })
}

/// r, h and a are colours, as white is white in every space; t is made again of what it stands for.
fn model_in_space(model: &FresnelModel, to: impl Fn(Rgb) -> Rgb) -> Option<FresnelModel> {
    Some(match *model {
        FresnelModel::Constant { r } => FresnelModel::Constant { r: to(r) },
        FresnelModel::Schlick { r } => FresnelModel::Schlick { r: to(r) },
        FresnelModel::Lazanyi { r, a, alpha } => FresnelModel::Lazanyi { r: to(r), a: to(a), alpha },
        FresnelModel::Hoffman { r, h } => FresnelModel::Hoffman { r: to(r), h: to(h) },
        FresnelModel::F82Tint { r, t } => FresnelModel::Hoffman { r: to(r), h: to(r.zip(t, h_from_r_t)) },
        FresnelModel::GeneralizedSchlick { r0, t, r90, p } => {
            let a = to(a_of_generalized(r0, t, r90, p));
            let (r0, r90) = (to(r0), to(r90));
            let t = a.zip(at_theta_max(r0, r90, p), |a, edge| 1.0 - a / (edge * PEAK_GAIN));
            FresnelModel::GeneralizedSchlick { r0, t, r90, p }
        }
        FresnelModel::Gulbrandsen { .. } | FresnelModel::Conductor { .. } => return None,
    })
}

/// The size of generalized Schlick's correction, which is a colour: a = G(1/7) (1 − t) 7⁷/6⁶.
pub(super) fn a_of_generalized(r0: Rgb, t: Rgb, r90: Rgb, p: f64) -> Rgb {
    at_theta_max(r0, r90, p).zip(t, |edge, t| edge * (1.0 - t) * PEAK_GAIN)
}

fn at_theta_max(r0: Rgb, r90: Rgb, p: f64) -> Rgb {
    let weight = (1.0 - COS_THETA_MAX).powf(p);
    r0.lerp(r90, weight)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::whole_degrees;
    use crate::metal::metal_by_name;
    use crate::study::{Subject, Variant, forms};

    /// What is converted is the curve, not the look of its parameters.
    #[test]
    fn a_converted_form_is_the_converted_curve() {
        let zinc = Subject::Metal(metal_by_name("zinc").unwrap());
        let (own, space) = (RgbSpace::LinRec709, RgbSpace::AcesCg);
        let forms = forms(&zinc, &Variant::ALL, own, &mut || std::ops::ControlFlow::Continue(())).unwrap();
        let mut unconverted = Vec::new();
        for of in forms {
            let Some(converted) = form_in_space(&of.form, own, space) else {
                let Form::Model { model } = of.form else { panic!("{} holds colours", of.variant) };
                unconverted.push(model.kind());
                continue;
            };
            for c in whole_degrees() {
                let wanted = own.convert(of.form.reflectance(c), space);
                let off = converted.reflectance(c).max_abs_difference(wanted);
                assert!(off < 1e-12, "{} {}°: {off}", of.variant, c.deg());
            }
        }
        let no_colours = [ModelKind::Gulbrandsen, ModelKind::Conductor];
        assert!(unconverted.iter().all(|kind| no_colours.contains(kind)));
        assert_eq!(unconverted.len(), 4);
    }

    #[test]
    fn every_target_takes_r_and_h() {
        assert!(Target::ALL.into_iter().all(|target| target.takes(Some(ModelKind::Hoffman))));
        assert!(!Target::Json.takes(Some(ModelKind::Schlick)) && Target::Usd.takes(Some(ModelKind::Schlick)));
        assert!(Target::Cube.takes(None) && Target::Wgsl.takes(None) && !Target::OpenPbr.takes(None));
    }
}
