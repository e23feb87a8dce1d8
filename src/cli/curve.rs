//! What computes a reflectance over the angle: the truth of a material, or a model of it.

use anyhow::bail;
use serde_json::{Value, json};

use super::arguments::Model;
use super::source::{Material, Source};
use crate::color::Rgb;
use crate::fit::{Method, convert, fit};
use crate::fresnel::{CosTheta, FresnelModel, ModelKind};
use crate::metal::{Metal, SpectralModel};
use crate::render::RadialTable;
use crate::spectrum::Quadrature;

/// What computes the curve.
pub enum Curve<'a> {
    /// The truth of measured n and k.
    Spectral(&'a Metal),
    /// The spectral model with so many wavelengths.
    FewWavelengths(usize, SpectralModel),
    /// A model, and how its parameters were derived from a metal.
    Model(FresnelModel, Option<Method>),
}

impl<'a> Curve<'a> {
    /// The curve of a model of a material; the material's own unless a model is named.
    pub fn new(
        source: &'a Source,
        model: Option<Model>,
        method: Option<Method>,
        warnings: &mut Vec<String>,
    ) -> anyhow::Result<Self> {
        match (&source.material, model) {
            (Material::Measured(_), None | Some(Model::Spectral | Model::FewWavelengths(_))) if method.is_some() => {
                bail!("--method derives the parameters of a model of three channels; name one with --model")
            }
            (Material::Measured(metal), None | Some(Model::Spectral)) => Ok(Self::Spectral(metal)),
            (Material::Measured(metal), Some(Model::FewWavelengths(count))) => {
                let few = SpectralModel::new(metal, count, Quadrature::default(), source.space);
                Ok(Self::FewWavelengths(count, few))
            }
            (Material::Measured(metal), Some(Model::Rgb(kind))) => fitted(metal, (kind, method), source, warnings),
            (Material::Model(_), Some(Model::Spectral | Model::FewWavelengths(_))) => {
                bail!("only a metal or a file of n and k has a spectrum; choose another --model")
            }
            (Material::Model(_), _) if method.is_some() => bail!("--method is for a metal or a file of n and k"),
            (Material::Model(own), None) => Ok(Self::Model(*own, None)),
            (Material::Model(own), Some(Model::Rgb(kind))) => {
                let conversion = convert(own, kind, source.space)?;
                warnings.extend(conversion.losses.iter().map(ToString::to_string));
                Ok(Self::Model(conversion.model, None))
            }
        }
    }

    /// The reflectance at an angle, in the space of the source.
    pub fn reflectance(&self, angle: CosTheta, source: &Source) -> Rgb {
        match self {
            Self::Spectral(metal) => metal.reflectance(angle, source.space),
            Self::FewWavelengths(_, model) => model.reflectance(angle),
            Self::Model(model, _) => model.reflectance(angle),
        }
    }

    /// The name people read.
    pub fn label(&self) -> String {
        match self {
            Self::Spectral(_) => "Truth".to_owned(),
            Self::FewWavelengths(count, _) => format!("Spectral, {count} wavelengths"),
            Self::Model(model, None) => model.kind().label().to_owned(),
            Self::Model(model, Some(method)) => format!("{}, {method}", model.kind().label()),
        }
    }

    /// The reflectance at every angle under a light so many times as bright, for rendering.
    pub fn table(&self, source: &Source, gain: f64) -> RadialTable {
        RadialTable::new(source.space, |angle| self.reflectance(angle, source) * gain)
    }

    /// The model with its parameters as JSON, and how they were derived.
    pub fn document(&self) -> (Value, Option<Method>) {
        match self {
            Self::Spectral(_) => (json!({ "kind": "spectral" }), None),
            Self::FewWavelengths(count, _) => (json!({ "kind": format!("spectral-{count}") }), None),
            Self::Model(model, method) => (json!(model), *method),
        }
    }
}

fn fitted<'a>(
    metal: &Metal,
    (kind, method): (ModelKind, Option<Method>),
    source: &Source,
    warnings: &mut Vec<String>,
) -> anyhow::Result<Curve<'a>> {
    let best_known = if Method::Exact.applies_to(kind) { Method::Exact } else { Method::LeastSquares };
    let method = method.unwrap_or(best_known);
    let fit = fit(metal, kind, method, source.space)?;
    warnings.extend(fit.losses.iter().map(ToString::to_string));
    Ok(Curve::Model(fit.model, Some(method)))
}
