//! `edgewise reflect`: reflectance over the angle of incidence.

use anyhow::bail;
use clap::Args;
use serde_json::json;

use super::arguments::{self, Angles};
use super::output::{Cell, Format, FormatArguments, Output, Table};
use super::source::{Material, Source, SourceArguments};
use crate::color::Rgb;
use crate::fresnel::{CosTheta, FresnelModel, ModelKind, t_from_r_h};
use crate::preset::pretty_json;

/// Arguments of `edgewise reflect`.
#[derive(Debug, Args)]
pub struct Reflect {
    #[command(flatten)]
    source: SourceArguments,
    /// What computes the curve: spectral (the truth of a metal, its default), hoffman (the default of
    /// colours), schlick, f82-tint or constant
    #[arg(long)]
    model: Option<String>,
    /// Angles in degrees: first:last:step, or a list; “max” is 81.787°
    #[arg(long, default_value = "0:90:1", value_parser = arguments::angles, allow_hyphen_values = true)]
    angles: Angles,
    #[command(flatten)]
    format: FormatArguments,
}

/// What computes the curve.
enum Curve<'a> {
    Spectral(&'a crate::metal::Metal),
    Model(FresnelModel),
}

impl Reflect {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let source = self.source.source()?;
        let curve = self.curve(&source)?;
        let rows: Vec<(f64, Rgb)> =
            self.angles.0.iter().map(|&deg| (deg, curve.reflectance(CosTheta::from_deg(deg), &source))).collect();
        let text = match self.format.format() {
            Format::Json => pretty_json(&curve.json(&source, &rows)),
            format => table(&source, &rows).render(format),
        };
        Ok(Output { text, warnings: source.warnings, ..Output::default() })
    }

    fn curve<'a>(&self, source: &'a Source) -> anyhow::Result<Curve<'a>> {
        let model = match (self.model.as_deref(), &source.material) {
            (None | Some("spectral"), Material::Measured(metal)) => return Ok(Curve::Spectral(metal)),
            (Some("spectral"), Material::Colours { .. }) => {
                bail!("only a metal or a file of n and k has a spectrum; choose another --model")
            }
            (None, Material::Colours { .. }) => ModelKind::Hoffman,
            (Some(name), _) => name.parse::<ModelKind>()?,
        };
        let (r, h) = source.material.r_h(source.space);
        Ok(Curve::Model(match model {
            ModelKind::Constant => FresnelModel::Constant { r },
            ModelKind::Schlick => FresnelModel::Schlick { r },
            ModelKind::Hoffman => FresnelModel::Hoffman { r, h },
            ModelKind::F82Tint => FresnelModel::F82Tint { r, t: r.zip(h, t_from_r_h) },
            other => bail!("the model {other} has more parameters than r and h; fit them first"),
        }))
    }
}

impl Curve<'_> {
    fn reflectance(&self, angle: CosTheta, source: &Source) -> Rgb {
        match self {
            Self::Spectral(metal) => metal.reflectance(angle, source.space),
            Self::Model(model) => model.reflectance(angle),
        }
    }

    fn json(&self, source: &Source, rows: &[(f64, Rgb)]) -> serde_json::Value {
        let model = match self {
            Self::Spectral(_) => json!({ "kind": "spectral" }),
            Self::Model(model) => json!(model),
        };
        let row = |(theta_deg, rgb): &(f64, Rgb)| json!({ "theta_deg": theta_deg, "red": rgb[0], "green": rgb[1], "blue": rgb[2] });
        json!({
            "material": source.material.name(), "space": source.space, "model": model, "warnings": source.warnings,
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
