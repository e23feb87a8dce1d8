//! `edgewise fit`: the parameters of models for a measured metal, and how far each is from the truth.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Args;
use rayon::prelude::*;
use serde_json::json;

use super::output::{Cell, Format, FormatArguments, Output, Table};
use super::parameters::in_one_cell;
use super::progress::Progress;
use crate::color::RgbSpace;
use crate::fit::{Fit, Method, fit_to_truth};
use crate::fresnel::ModelKind;
use crate::metal::{Metal, TruthCurve, metal_by_name, preferred_metals};
use crate::preset::pretty_json;

/// Arguments of `edgewise fit`.
#[derive(Debug, Args)]
pub struct FitCommand {
    /// A metal of the library: identifier, name or symbol; may be given again
    #[arg(long, value_name = "ID", required_unless_present_any = ["nk", "all"])]
    metal: Vec<String>,
    /// A .csv file with the columns wavelength_nm,n,k (or wavelength_um,n,k), or a .yml of refractiveindex.info
    #[arg(long, value_name = "FILE", conflicts_with = "metal")]
    nk: Option<PathBuf>,
    /// The preferred data set of every material of the library
    #[arg(long, conflicts_with_all = ["metal", "nk"])]
    all: bool,
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

/// A metal with its fits, in the order they were asked for.
struct Fitted {
    metal: Metal,
    fits: Vec<Fit>,
}

impl FitCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let all = self.all_fits()?;
        let pairs = || all.iter().flat_map(|fitted| fitted.fits.iter().map(|fit| (&fitted.metal, fit)));
        let text = match self.format.format() {
            Format::Json => pretty_json(&pairs().map(|(metal, fit)| document(metal, fit)).collect()),
            format => self.table(pairs(), format).render(format),
        };
        // One metal needs no name in front of what is said about it.
        let subject = |metal: &Metal| if all.len() > 1 { format!("{}: ", metal.id) } else { String::new() };
        let remarks = |fitted: &Fitted| {
            let (subject, fits) = (subject(&fitted.metal), fitted.fits.iter().flat_map(sentences));
            fitted
                .metal
                .remarks()
                .into_iter()
                .chain(fits)
                .map(move |said| format!("{subject}{said}"))
                .collect::<Vec<_>>()
        };
        Ok(Output { text, warnings: all.iter().flat_map(remarks).collect(), ..Output::default() })
    }

    fn metals(&self) -> anyhow::Result<Vec<Metal>> {
        if let Some(path) = &self.nk {
            return Ok(vec![Metal::open(path)?]);
        }
        if self.all {
            return Ok(preferred_metals().cloned().collect());
        }
        self.metal.iter().map(|name| Ok(metal_by_name(name)?.clone())).collect()
    }

    /// Fits in parallel; Ctrl-C ends every search at its next step.
    fn all_fits(&self) -> anyhow::Result<Vec<Fitted>> {
        let (metals, wanted) = (self.metals()?, self.wanted());
        let (progress, done) = (Progress::new("Fitting"), AtomicUsize::new(0));
        let total = (metals.len() * wanted.len()).max(1) as f32;
        let fits_of = |metal: Metal| -> anyhow::Result<Fitted> {
            let truth = TruthCurve::of(&metal, self.space);
            let fit = |&(kind, method): &(ModelKind, Method)| {
                let fit = fit_to_truth(&metal, &truth, kind, method, &mut || progress.keep_going())?;
                // Whoever breaks this stops the next search at its first step.
                let _ = progress.report((done.fetch_add(1, Ordering::Relaxed) + 1) as f32 / total);
                Ok(fit)
            };
            let fits = wanted.iter().map(fit).collect::<anyhow::Result<_>>()?;
            Ok(Fitted { metal, fits })
        };
        metals.into_par_iter().map(fits_of).collect()
    }

    /// Models with methods, in the order of the models.
    fn wanted(&self) -> Vec<(ModelKind, Method)> {
        let kinds = if self.model.is_empty() { ModelKind::ALL.to_vec() } else { self.model.clone() };
        let methods = |kind| if self.method.is_empty() { Method::of(kind).collect() } else { self.methods_for(kind) };
        kinds.into_iter().flat_map(|kind| methods(kind).into_iter().map(move |method| (kind, method))).collect()
    }

    /// The methods asked for. Where every model is fitted, only those that the model takes.
    fn methods_for(&self, kind: ModelKind) -> Vec<Method> {
        let is_wanted = |method: &&Method| !self.model.is_empty() || method.applies_to(kind);
        self.method.iter().filter(is_wanted).copied().collect()
    }

    fn table<'a>(&self, fits: impl Iterator<Item = (&'a Metal, &'a Fit)>, format: Format) -> Table {
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
        for (metal, fit) in fits {
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
