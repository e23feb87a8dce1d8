//! A material in the parameters of a variant, ready to be evaluated or stored.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::{StudyError, Subject, Variant};
use crate::color::{Rgb, RgbSpace};
use crate::fit::{Method, model_of_truth, samples_for_series, series_by_least_squares};
use crate::fresnel::{CosTheta, FresnelModel, ModelKind, Nk, SchlickSeries, conductor, conductor_over_angles};
use crate::metal::{Metal, TruthCurve};
use crate::spectrum::{FewWavelengths, Quadrature, SAMPLES, rgb_weights, wavelengths_nm};

/// The parameters of a variant for one material in one space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "form", rename_all = "kebab-case")]
pub enum Form {
    /// A model of three channels.
    Model {
        /// The model with its parameters.
        model: FresnelModel,
    },
    /// A polynomial correction on Schlick's curve.
    Series(SchlickSeries),
    /// Reflectances at cosines evenly spaced in √c, from grazing to facing.
    Table {
        /// At least two.
        rows: Vec<Rgb>,
    },
    /// n and k at some wavelengths, each with its RGB weight.
    Spectral {
        /// The wavelengths.
        wavelengths_nm: Vec<f64>,
        /// n at each.
        n: Vec<f64>,
        /// k at each.
        k: Vec<f64>,
        /// The weight of each; they sum to white.
        weights: Vec<Rgb>,
    },
}

/// What a variant makes of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct FormOfVariant {
    /// The variant.
    pub variant: Variant,
    /// Its parameters.
    pub form: Form,
    /// What they could not express, as sentences.
    pub losses: Vec<String>,
}

impl Form {
    /// The reflectance at an angle, unclamped.
    pub fn reflectance(&self, cos_theta: CosTheta) -> Rgb {
        match self {
            Self::Model { model } => model.reflectance(cos_theta),
            Self::Series(series) => series.reflectance(cos_theta),
            Self::Table { rows } => between(rows, cos_theta),
            Self::Spectral { n, k, weights, .. } => {
                let nk = n.iter().zip(k);
                nk.zip(weights).fold(Rgb::BLACK, |sum, ((n, k), weight)| sum + *weight * conductor(*n, *k, cos_theta))
            }
        }
    }

    /// The reflectance at each of many angles, unclamped: [`reflectance`](Self::reflectance) with less work.
    pub fn curve(&self, cosines: &[CosTheta]) -> Vec<Rgb> {
        match self {
            Self::Spectral { n, k, weights, .. } => {
                let mut curve = vec![Rgb::BLACK; cosines.len()];
                let mut at_wavelength = vec![f64::NAN; cosines.len()];
                for ((&n, &k), weight) in n.iter().zip(k).zip(weights) {
                    conductor_over_angles(Nk { n, k }, cosines, &mut at_wavelength);
                    curve.iter_mut().zip(&at_wavelength).for_each(|(sum, f)| *sum += *weight * *f);
                }
                curve
            }
            _ => cosines.iter().map(|c| self.reflectance(*c)).collect(),
        }
    }
}

/// Linear between the rows, which are evenly spaced in √c.
fn between(rows: &[Rgb], cos_theta: CosTheta) -> Rgb {
    let Some(last) = rows.len().checked_sub(1).filter(|last| *last > 0) else { return Rgb::splat(f64::NAN) };
    let place = cos_theta.get().sqrt() * last as f64;
    let below = (place.floor() as usize).min(last - 1);
    rows[below].lerp(rows[below + 1], place - below as f64)
}

/// A subject in every variant of a list, the truth being computed once. `keep_going` is asked before each.
pub fn forms(
    subject: &Subject<'_>,
    variants: &[Variant],
    space: RgbSpace,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Vec<FormOfVariant>, StudyError> {
    let truth = match subject {
        Subject::Metal(metal) => Some((*metal, TruthCurve::of(metal, space))),
        _ => None,
    };
    let mut fine = None;
    let each = variants.iter().map(|&variant| {
        if keep_going().is_break() {
            return Err(StudyError::Fit(crate::fit::FitError::Stopped(crate::fit::Stopped)));
        }
        let (form, losses) = match &truth {
            Some((metal, truth)) => of_metal(metal, truth, variant, &mut fine)?,
            None => (Form::Model { model: of_own_curve(subject, variant, space) }, Vec::new()),
        };
        Ok(FormOfVariant { variant, form, losses })
    });
    each.collect()
}

fn of_metal(
    metal: &Metal,
    truth: &TruthCurve,
    variant: Variant,
    fine: &mut Option<Vec<(CosTheta, Rgb)>>,
) -> Result<(Form, Vec<String>), StudyError> {
    let space = truth.space;
    let mut series = |shape, count| {
        let samples = fine.get_or_insert_with(|| samples_for_series(metal, space));
        Form::Series(series_by_least_squares(samples, truth.r(), shape, count))
    };
    let form = match variant {
        Variant::Model(kind, method) => {
            let (model, losses) = model_of_truth(metal, truth, kind, method, &mut || ControlFlow::Continue(()))?;
            return Ok((Form::Model { model }, losses.iter().map(ToString::to_string).collect()));
        }
        Variant::Series(count) => series((6, 0.0), count),
        Variant::Polynomial(count) => series((1, SchlickSeries::BEND_OF_METALS), count),
        Variant::Table(entries) => table(metal, entries, space),
        Variant::Spectral(count) => few_wavelengths(metal, count, space),
        Variant::Exact => every_wavelength(metal, space),
    };
    Ok((form, Vec::new()))
}

fn table(metal: &Metal, entries: usize, space: RgbSpace) -> Form {
    let cosine = |entry: usize| (entry as f64 / (entries - 1) as f64).powi(2);
    Form::Table { rows: (0..entries).map(|entry| metal.reflectance(CosTheta::new(cosine(entry)), space)).collect() }
}

fn few_wavelengths(metal: &Metal, count: usize, space: RgbSpace) -> Form {
    let few = FewWavelengths::shared(count, Quadrature::Spline, space);
    let nk: Vec<Nk> = few.wavelengths_nm.iter().map(|nm| metal.table().at(*nm)).collect();
    spectral(few.wavelengths_nm.clone(), &nk, few.weights.clone())
}

fn every_wavelength(metal: &Metal, space: RgbSpace) -> Form {
    spectral(wavelengths_nm().collect(), metal.nk(), rgb_weights(space)[..SAMPLES].to_vec())
}

fn spectral(wavelengths_nm: Vec<f64>, nk: &[Nk], weights: Vec<Rgb>) -> Form {
    let (n, k) = nk.iter().map(|nk| (nk.n, nk.k)).unzip();
    Form::Spectral { wavelengths_nm, n, k, weights }
}

/// A subject whose truth is a model of its own, in fewer parameters, or in all of them.
fn of_own_curve(subject: &Subject<'_>, variant: Variant, space: RgbSpace) -> FresnelModel {
    let own = own_model(subject, space);
    let (r, h) = (own.reflectance(CosTheta::FACING), own.reflectance(CosTheta::MAX));
    match variant {
        Variant::Model(ModelKind::Constant, _) => FresnelModel::Constant { r },
        Variant::Model(ModelKind::Schlick, _) => FresnelModel::Schlick { r },
        Variant::Model(ModelKind::Hoffman, Method::Exact) => FresnelModel::Hoffman { r, h },
        _ => own,
    }
}

fn own_model(subject: &Subject<'_>, space: RgbSpace) -> FresnelModel {
    match *subject {
        Subject::Metal(metal) => FresnelModel::Hoffman { r: metal.r(space), h: metal.h(space) },
        Subject::Colours { space: own, r, h, .. } => {
            FresnelModel::Hoffman { r: own.convert(r, space), h: own.convert(h, space) }
        }
        Subject::Dielectric { n } => FresnelModel::Conductor { n: Rgb::splat(n), k: Rgb::BLACK },
    }
}

/// The true reflectance of a subject at an angle.
pub fn true_reflectance(subject: &Subject<'_>, cos_theta: CosTheta, space: RgbSpace) -> Rgb {
    match subject {
        Subject::Metal(metal) => metal.reflectance(cos_theta, space),
        _ => own_model(subject, space).reflectance(cos_theta),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::whole_degrees;
    use crate::metal::metal_by_name;

    const SPACE: RgbSpace = RgbSpace::LinRec709;

    fn all(subject: &Subject<'_>) -> Vec<FormOfVariant> {
        forms(subject, Variant::of(subject), SPACE, &mut || ControlFlow::Continue(())).unwrap()
    }

    #[test]
    fn every_variant_is_near_its_metal_facing_and_the_last_is_exact() {
        let gold = Subject::Metal(metal_by_name("gold").unwrap());
        let forms = all(&gold);
        for FormOfVariant { variant, form, .. } in &forms {
            let off = |c| form.reflectance(c).max_abs_difference(true_reflectance(&gold, c, SPACE));
            let bound = match variant {
                Variant::Exact => 1e-12,
                Variant::Table(_) | Variant::Series(_) | Variant::Polynomial(_) => 1e-6,
                // Gold's edge falls between three wavelengths.
                _ => 0.5,
            };
            assert!(off(CosTheta::FACING) < bound, "{variant}");
        }
        let exact = &forms.last().unwrap().form;
        let off = |c| exact.reflectance(c).max_abs_difference(true_reflectance(&gold, c, SPACE));
        assert!(whole_degrees().all(|c| off(c) < 1e-12));
    }

    #[test]
    fn two_colours_are_their_own_truth() {
        let colours =
            Subject::Colours { name: "mine", space: RgbSpace::AcesCg, r: Rgb([0.9, 0.6, 0.4]), h: Rgb::splat(0.7) };
        for subject in [colours, Subject::Dielectric { n: 1.5 }] {
            let exact = all(&subject).pop().unwrap().form;
            for c in whole_degrees() {
                assert!(exact.reflectance(c).max_abs_difference(true_reflectance(&subject, c, SPACE)) < 1e-14);
            }
        }
    }

    #[test]
    fn a_curve_is_its_values() {
        let gold = Subject::Metal(metal_by_name("gold").unwrap());
        let cosines: Vec<CosTheta> = whole_degrees().collect();
        for FormOfVariant { variant, form, .. } in all(&gold) {
            let alone: Vec<Rgb> = cosines.iter().map(|c| form.reflectance(*c)).collect();
            assert_eq!(form.curve(&cosines), alone, "{variant}");
        }
    }

    #[test]
    fn forms_read_back_from_their_file() {
        let gold = Subject::Metal(metal_by_name("gold").unwrap());
        for FormOfVariant { form, .. } in all(&gold) {
            let text = serde_json::to_string(&form).unwrap();
            assert_eq!(serde_json::from_str::<Form>(&text).unwrap(), form);
        }
    }
}
