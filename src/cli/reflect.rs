//! `edgewise reflect`: reflectance over the angle of incidence.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::arguments::{self, Angles, Model};
use super::curve::Curve;
use super::output::{Cell, Format, FormatArguments, Output, Table};
use super::source::{Material, Source, SourceArguments};
use crate::color::Rgb;
use crate::figure::{CurveFigure, CurveSeries, Figure, FigureTheme, curve_figure};
use crate::fit::Method;
use crate::fresnel::CosTheta;
use crate::preset::pretty_json;

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
    /// Another model to draw, like schlick or conductor:colour-matching; may be given again
    #[arg(long, value_name = "MODEL[:METHOD]", value_parser = arguments::model_with_method, requires = "plot")]
    compare: Vec<(Model, Option<Method>)>,
    /// The look of the figure: light, for print and slides, or dark
    #[arg(long, value_name = "THEME", default_value = "light")]
    theme: FigureTheme,
    #[command(flatten)]
    format: FormatArguments,
}

impl Reflect {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let source = self.source.source()?;
        let mut warnings = source.warnings.clone();
        let curve = Curve::new(&source, self.model, self.method, &mut warnings)?;
        if let Some(path) = &self.plot {
            let compared = self.compared(&source, &mut warnings)?;
            figure(&curve, &compared, &source).save(path, self.theme)?;
        }
        let reflectance = |&deg: &f64| (deg, curve.reflectance(CosTheta::from_deg(deg), &source));
        let rows: Vec<(f64, Rgb)> = self.angles.0.iter().map(reflectance).collect();
        let text = match self.format.format() {
            Format::Json => pretty_json(&document(&curve, &source, &rows, &warnings)),
            format => table(&source, &rows).render(format),
        };
        Ok(Output { text, warnings, ..Output::default() })
    }
}

impl Reflect {
    /// The other models of the same material.
    fn compared<'a>(&self, source: &'a Source, warnings: &mut Vec<String>) -> anyhow::Result<Vec<Curve<'a>>> {
        let curve = |&(model, method): &(Model, Option<Method>)| Curve::new(source, Some(model), method, warnings);
        self.compare.iter().map(curve).collect()
    }
}

fn figure(curve: &Curve<'_>, compared: &[Curve<'_>], source: &Source) -> CurveFigure {
    let truth = match &source.material {
        Material::Measured(metal) => Some(metal.as_ref()),
        Material::Model(_) => None,
    };
    let mut figure = CurveFigure { title: source.name.clone(), ..curve_figure(truth, &[], source.space) };
    // The truth is drawn already.
    let models = std::iter::once(curve).chain(compared).filter(|curve| !matches!(curve, Curve::Spectral(_)));
    let series = models.map(|curve| CurveSeries::new(curve.label(), |angle| curve.reflectance(angle, source)));
    figure.models.extend(series);
    figure
}

fn document(curve: &Curve<'_>, source: &Source, rows: &[(f64, Rgb)], warnings: &[String]) -> serde_json::Value {
    let (model, method) = curve.document();
    let row = |(theta_deg, rgb): &(f64, Rgb)| json!({ "theta_deg": theta_deg, "red": rgb[0], "green": rgb[1], "blue": rgb[2] });
    json!({
        "material": source.name, "space": source.space, "model": model, "method": method, "warnings": warnings,
        "curve": rows.iter().map(row).collect::<Vec<_>>(),
    })
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
