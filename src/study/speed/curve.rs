//! A variant of a material as its kernel.

use crate::fresnel::{FresnelModel, Nk, SchlickSeries};
use crate::kernel::{
    Conductor, Constant, Factored, Form as Formula, GeneralizedSchlick, Lazanyi, Level, Material, Operations,
    Polynomial, Schlick, Spectral, Table,
};
use crate::spectrum::SAMPLES;
use crate::study::{Form, Variant};

/// In vectors of an instruction set, into a slice for each channel.
pub(super) type InVectors = Box<dyn Fn(Level, &[f32], [&mut [f32]; 3]) + Send + Sync>;

/// One cosine after the other, into one result of three channels for each.
pub(super) type OneByOne = Box<dyn Fn(&[f32], &mut [[[f32; 3]; 1]]) + Send + Sync>;

/// The curve of a material in 32 bits, at cosines.
pub(super) struct Curve {
    pub(super) in_vectors: InVectors,
    /// The same text.
    pub(super) one_by_one: OneByOne,
    /// Of one evaluation.
    pub(super) operations: Operations,
}

/// The name of the kernel that a variant is evaluated by. r and g of a known material are n and k.
pub(super) fn kernel_of(variant: Variant) -> String {
    use crate::fresnel::ModelKind;
    match variant {
        Variant::Model(ModelKind::Gulbrandsen, _) => ModelKind::Conductor.id().to_owned(),
        Variant::Model(kind, _) => kind.id().to_owned(),
        Variant::Exact => format!("spectral-{SAMPLES}"),
        other => other.id(),
    }
}

/// The kernel with these parameters; `None` for a number of coefficients that none has.
pub(super) fn curve(form: &Form) -> Option<Curve> {
    match form {
        Form::Model { model } => Some(of_model(model)),
        Form::Series(series) => of_series(series),
        Form::Table { rows } => Some(of_table(rows)),
        Form::Spectral { n, k, weights, .. } => {
            let nk = n.iter().zip(k).map(|(n, k)| Nk { n: *n, k: *k });
            Some(of_spectral(Spectral::new(nk.zip(weights.iter().copied()))))
        }
    }
}

fn of_model(model: &FresnelModel) -> Curve {
    match *model {
        FresnelModel::Constant { r } => of_material(Constant::material(r)),
        FresnelModel::Schlick { r } => of_material(Schlick::material(r)),
        FresnelModel::Lazanyi { r, a, alpha } => of_material(Lazanyi::material(r, a, alpha)),
        FresnelModel::Hoffman { r, h } => of_material(Factored::hoffman(r, h)),
        FresnelModel::F82Tint { r, t } => of_material(Factored::f82_tint(r, t)),
        FresnelModel::GeneralizedSchlick { r0, t, r90, p } => of_material(GeneralizedSchlick::material(r0, t, r90, p)),
        FresnelModel::Gulbrandsen { r, g } => of_material(Conductor::gulbrandsen(r, g)),
        FresnelModel::Conductor { n, k } => of_material(Conductor::material(n, k)),
    }
}

fn of_series(series: &SchlickSeries) -> Option<Curve> {
    match series.coefficients.len() {
        3 => Polynomial::material::<5>(series).map(of_material),
        6 => Polynomial::material::<8>(series).map(of_material),
        10 => Polynomial::material::<12>(series).map(of_material),
        _ => None,
    }
}

/// The rows are at the cosines that the kernel asks for, one after the other.
fn of_table(rows: &[crate::color::Rgb]) -> Curve {
    let mut values = rows.iter().copied();
    let table = Table::new(rows.len(), |_| values.next().unwrap_or(crate::color::Rgb::splat(f64::NAN)));
    let alone = table.clone();
    Curve {
        in_vectors: Box::new(move |level, cosines, out| table.over(level, cosines, out)),
        one_by_one: Box::new(move |cosines, out| each(cosines, out, |c| alone.at(c))),
        operations: Table::OPERATIONS,
    }
}

fn of_spectral(spectral: Spectral) -> Curve {
    let (alone, operations) = (spectral.clone(), spectral.operations());
    Curve {
        in_vectors: Box::new(move |level, cosines, out| spectral.over(level, cosines, out)),
        one_by_one: Box::new(move |cosines, out| each(cosines, out, |c| alone.at(c))),
        operations,
    }
}

fn of_material<F: Formula<P> + Send + Sync + 'static, const P: usize>(material: Material<F, P>) -> Curve {
    Curve {
        in_vectors: Box::new(move |level, cosines, out| material.over(level, cosines, [out])),
        one_by_one: Box::new(move |cosines, out| material.one_by_one(cosines, out)),
        operations: material.operations(),
    }
}

fn each(cosines: &[f32], out: &mut [[[f32; 3]; 1]], at: impl Fn(f32) -> [f32; 3]) {
    for ([out], c) in out.iter_mut().zip(cosines) {
        *out = at(*c);
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;
    use crate::color::RgbSpace;
    use crate::fresnel::CosTheta;
    use crate::metal::metal_by_name;
    use crate::study::{Subject, forms};

    /// The same parameters in 64 bits.
    #[test]
    fn every_variant_has_its_curve() {
        let gold = Subject::Metal(metal_by_name("gold").unwrap());
        let cosines: Vec<f32> = (0..=40_u8).map(|i| f32::from(i) / 40.0).collect();
        for of in forms(&gold, &Variant::ALL, RgbSpace::AcesCg, &mut || ControlFlow::Continue(())).unwrap() {
            let curve = curve(&of.form).unwrap_or_else(|| panic!("{} has no kernel", of.variant));
            let mut out = [(); 3].map(|()| vec![f32::NAN; cosines.len()]);
            (curve.in_vectors)(Level::new(), &cosines, out.each_mut().map(Vec::as_mut_slice));
            let mut alone = vec![[[f32::NAN; 3]]; cosines.len()];
            (curve.one_by_one)(&cosines, &mut alone);
            for (at, c) in cosines.iter().enumerate() {
                let exact = of.form.reflectance(CosTheta::new(f64::from(*c)));
                for got in [std::array::from_fn(|channel| out[channel][at]), alone[at][0]] {
                    let off = crate::color::Rgb(got.map(f64::from)).max_abs_difference(exact);
                    assert!(off < 1e-5, "{} at {c}: {off}", of.variant);
                }
            }
        }
    }
}
