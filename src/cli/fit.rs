//! `edgewise fit`: the parameters of models for a measured metal, and how far each is from the truth.

use std::ops::ControlFlow;
use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::output::{Cell, Format, FormatArguments, Output, Table};
use super::parameters::in_one_cell;
use crate::color::RgbSpace;
use crate::fit::{Fit, Method, fit_to_truth};
use crate::fresnel::ModelKind;
use crate::metal::{Metal, TruthCurve, metal_by_name};
use crate::preset::pretty_json;

/// Arguments of `edgewise fit`.
#[derive(Debug, Args)]
pub struct FitCommand {
    /// A metal of the library: identifier, name or symbol
    #[arg(long, value_name = "ID", required_unless_present = "nk")]
    metal: Option<String>,
    /// A .csv file with the columns wavelength_nm,n,k (or wavelength_um,n,k), or a .yml of refractiveindex.info
    #[arg(long, value_name = "FILE", conflicts_with = "metal")]
    nk: Option<PathBuf>,
    /// The model to fit; may be given again. All of them unless given
    #[arg(long)]
    model: Vec<ModelKind>,
    /// How to derive the parameters; may be given again. Every method that the model takes unless given
    #[arg(long)]
    method: Vec<Method>,
    /// The space of the parameters and of the differences
    #[arg(long, default_value_t)]
    space: RgbSpace,
    #[command(flatten)]
    format: FormatArguments,
}

impl FitCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let metal = match (&self.metal, &self.nk) {
            (Some(name), _) => metal_by_name(name)?.clone(),
            (None, Some(path)) => Metal::open(path)?,
            (None, None) => return Err(super::usage("name a material: --metal or --nk")),
        };
        let fits = self.fits(&metal)?;
        let text = match self.format.format() {
            Format::Json => pretty_json(&fits.iter().map(|fit| document(&metal, fit)).collect()),
            format => self.table(&metal, &fits, format).render(format),
        };
        let mut warnings = vec![metal.held_ends().sentence()];
        warnings.extend(fits.iter().flat_map(sentences));
        warnings.retain(|sentence| !sentence.is_empty());
        Ok(Output { text, warnings, ..Output::default() })
    }

    fn fits(&self, metal: &Metal) -> anyhow::Result<Vec<Fit>> {
        let truth = TruthCurve::of(metal, self.space);
        let kinds = if self.model.is_empty() { ModelKind::ALL.to_vec() } else { self.model.clone() };
        let mut fits = Vec::new();
        for kind in kinds {
            let methods: Vec<Method> =
                if self.method.is_empty() { Method::of(kind).collect() } else { self.methods_for(kind) };
            for method in methods {
                fits.push(fit_to_truth(metal, &truth, kind, method, &mut || ControlFlow::Continue(()))?);
            }
        }
        Ok(fits)
    }

    /// The methods asked for. Where every model is fitted, only those that the model takes.
    fn methods_for(&self, kind: ModelKind) -> Vec<Method> {
        let is_wanted = |method: &&Method| !self.model.is_empty() || method.applies_to(kind);
        self.method.iter().filter(is_wanted).copied().collect()
    }

    fn table(&self, metal: &Metal, fits: &[Fit], format: Format) -> Table {
        let mut table = Table::new([
            ("metal", "metal".to_owned()),
            ("space", "space".to_owned()),
            ("model", "model".to_owned()),
            ("method", "method".to_owned()),
            ("mean_delta_e", "mean ΔE2000".to_owned()),
            ("max_delta_e", "max ΔE".to_owned()),
            ("angle_of_max_deg", "at (°)".to_owned()),
            ("sphere_delta_e", "sphere ΔE".to_owned()),
            ("parameters", format!("parameters ({})", self.space)),
        ]);
        let decimals = (format == Format::Table).then_some(4);
        for fit in fits {
            table.push(vec![
                metal.id.as_str().into(),
                fit.space.id().into(),
                fit.model.kind().id().into(),
                Cell::Text(fit.method.id()),
                Cell::Number(fit.error.mean_delta_e, 3),
                Cell::Number(fit.error.max_delta_e, 3),
                Cell::Number(fit.error.angle_of_max_deg, 0),
                Cell::Number(fit.error.sphere_delta_e, 3),
                Cell::Text(in_one_cell(&fit.model, decimals)),
            ]);
        }
        table
    }
}

fn sentences(fit: &Fit) -> impl Iterator<Item = String> {
    fit.losses.iter().map(move |loss| format!("{} by {}: {loss}", fit.model.kind(), fit.method))
}

fn document(metal: &Metal, fit: &Fit) -> serde_json::Value {
    json!({
        "metal": metal.id, "space": fit.space, "model": fit.model, "method": fit.method, "error": fit.error,
        "losses": fit.losses, "warnings": sentences(fit).collect::<Vec<_>>(),
    })
}
