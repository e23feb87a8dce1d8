//! `edgewise reflect`: reflectance over the angle of incidence.

use std::path::PathBuf;

use anyhow::bail;
use clap::Args;
use serde_json::json;

use super::arguments::{self, Angles, Model};
use super::output::{Cell, Format, FormatArguments, Output, Table};
use super::source::{Material, Source, SourceArguments};
use crate::color::Rgb;
use crate::figure::{CurveFigure, CurveSeries, Figure, FigureTheme, curve_figure};
use crate::fit::{Method, convert, fit};
use crate::fresnel::{CosTheta, FresnelModel, ModelKind};
use crate::metal::{Metal, SpectralModel};
use crate::preset::pretty_json;
use crate::spectrum::Quadrature;

/// Arguments of `edgewise reflect`.
#[derive(Debug, Args)]
pub struct Reflect {
    #[command(flatten)]
    source: SourceArguments,
    /// What computes the curve: spectral (a metal's default), spectral-N for N wavelengths, hoffman (the
    /// default otherwise), schlick, lazanyi, f82-tint, generalized-schlick, gulbrandsen, conductor or constant
    #[arg(long, value_parser = arguments::model)]
    model: Option<Model>,
    /// How a metal's parameters are derived; `edgewise fit` lists the methods. Exact where the model has
    /// exact parameters, otherwise least squares
    #[arg(long)]
    method: Option<Method>,
    /// Angles in degrees: first:last:step, or a list; “max” is 81.787°
    #[arg(long, default_value = "0:90:1", value_parser = arguments::angles, allow_hyphen_values = true)]
    angles: Angles,
    /// Also draw the curve over 0–90° into an .svg or .png file, with the truth where there is one
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArguments,
}

/// What computes the curve.
enum Curve<'a> {
    Spectral(&'a Metal),
    FewWavelengths(usize, SpectralModel),
    Model(FresnelModel, Option<Method>),
}

impl Reflect {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let source = self.source.source()?;
        let mut warnings = source.warnings.clone();
        let curve = self.curve(&source, &mut warnings)?;
        if let Some(path) = &self.plot {
            curve.figure(&source).save(path, FigureTheme::Light)?;
        }
        let reflectance = |&deg: &f64| (deg, curve.reflectance(CosTheta::from_deg(deg), &source));
        let rows: Vec<(f64, Rgb)> = self.angles.0.iter().map(reflectance).collect();
        let text = match self.format.format() {
            Format::Json => pretty_json(&curve.json(&source, &rows, &warnings)),
            format => table(&source, &rows).render(format),
        };
        Ok(Output { text, warnings, ..Output::default() })
    }

    fn curve<'a>(&self, source: &'a Source, warnings: &mut Vec<String>) -> anyhow::Result<Curve<'a>> {
        match (&source.material, self.model) {
            (Material::Measured(metal), None | Some(Model::Spectral)) => Ok(Curve::Spectral(metal)),
            (Material::Measured(metal), Some(Model::FewWavelengths(count))) => {
                let model = SpectralModel::new(metal, count, Quadrature::default(), source.space);
                Ok(Curve::FewWavelengths(count, model))
            }
            (Material::Measured(metal), Some(Model::Rgb(kind))) => self.fitted(metal, kind, source, warnings),
            (Material::Model(_), Some(Model::Spectral | Model::FewWavelengths(_))) => {
                bail!("only a metal or a file of n and k has a spectrum; choose another --model")
            }
            (Material::Model(_), _) if self.method.is_some() => bail!("--method is for a metal or a file of n and k"),
            (Material::Model(model), None) => Ok(Curve::Model(*model, None)),
            (Material::Model(model), Some(Model::Rgb(kind))) => {
                let conversion = convert(model, kind, source.space)?;
                warnings.extend(conversion.losses.iter().map(ToString::to_string));
                Ok(Curve::Model(conversion.model, None))
            }
        }
    }

    fn fitted<'a>(
        &self,
        metal: &Metal,
        kind: ModelKind,
        source: &Source,
        warnings: &mut Vec<String>,
    ) -> anyhow::Result<Curve<'a>> {
        let best_known = if Method::Exact.applies_to(kind) { Method::Exact } else { Method::LeastSquares };
        let method = self.method.unwrap_or(best_known);
        let fit = fit(metal, kind, method, source.space)?;
        warnings.extend(fit.losses.iter().map(ToString::to_string));
        Ok(Curve::Model(fit.model, Some(method)))
    }
}

impl Curve<'_> {
    fn reflectance(&self, angle: CosTheta, source: &Source) -> Rgb {
        match self {
            Self::Spectral(metal) => metal.reflectance(angle, source.space),
            Self::FewWavelengths(_, model) => model.reflectance(angle),
            Self::Model(model, _) => model.reflectance(angle),
        }
    }

    /// The name people read.
    fn label(&self) -> String {
        match self {
            Self::Spectral(_) => "Truth".to_owned(),
            Self::FewWavelengths(count, _) => format!("Spectral, {count} wavelengths"),
            Self::Model(model, None) => model.kind().label().to_owned(),
            Self::Model(model, Some(method)) => format!("{}, {method}", model.kind().label()),
        }
    }

    fn figure(&self, source: &Source) -> CurveFigure {
        let truth = match &source.material {
            Material::Measured(metal) => Some(metal.as_ref()),
            Material::Model(_) => None,
        };
        let mut figure = CurveFigure { title: source.name.clone(), ..curve_figure(truth, &[], source.space) };
        if !matches!(self, Self::Spectral(_)) {
            figure.models.push(CurveSeries::new(self.label(), |angle| self.reflectance(angle, source)));
        }
        figure
    }

    fn json(&self, source: &Source, rows: &[(f64, Rgb)], warnings: &[String]) -> serde_json::Value {
        let (model, method) = match self {
            Self::Spectral(_) => (json!({ "kind": "spectral" }), None),
            Self::FewWavelengths(count, _) => (json!({ "kind": format!("spectral-{count}") }), None),
            Self::Model(model, method) => (json!(model), *method),
        };
        let row = |(theta_deg, rgb): &(f64, Rgb)| json!({ "theta_deg": theta_deg, "red": rgb[0], "green": rgb[1], "blue": rgb[2] });
        json!({
            "material": source.name, "space": source.space, "model": model, "method": method, "warnings": warnings,
            "curve": rows.iter().map(row).collect::<Vec<_>>(),
        })
    }
}

fn table(source: &Source, rows: &[(f64, Rgb)]) -> Table {
    let mut table = Table::new([
        ("theta_deg", "θ (°)".to_owned()),
        ("red", format!("red ({})", source.space)),
        ("green", "green".to_owned()),
        ("blue", "blue".to_owned()),
    ]);
    for (theta_deg, rgb) in rows {
        let mut row = vec![Cell::Number(*theta_deg, 2)];
        row.extend(rgb.0.map(Cell::unit));
        table.push(row);
    }
    table
}
