//! `edgewise study trade`: accuracy for cost.

use std::path::PathBuf;

use clap::Args;

use super::super::output::Output;
use super::super::preset_files::{Listed, listed};
use super::super::times::measured;
use super::material::{MATERIAL_HELP, Material};
use super::named_or_preferred;
use super::shown::{Shown, with_bar};
use crate::color::RgbSpace;
use crate::figure::trade_figure;
use crate::preset::{Preset, built_in_presets};
use crate::study::{CostAxis, Costs, Measure, Subject, TradeOptions, trade, trade_summary};

/// Arguments of `edgewise study trade`.
#[derive(Debug, Args)]
pub(super) struct TradeCommand {
    #[arg(default_value = "gold", help = MATERIAL_HELP)]
    material: String,
    /// Every metal of the library
    #[arg(long, conflicts_with_all = ["material", "presets", "preset"])]
    all: bool,
    /// The built-in presets
    #[arg(long, conflicts_with_all = ["material", "preset"])]
    presets: bool,
    /// A preset of yours, or a folder of them; may be given again
    #[arg(long, value_name = "PATH", conflicts_with = "material")]
    preset: Vec<PathBuf>,
    /// The cost: shader-operations, parameter-bytes, or measured-ns on this machine
    #[arg(long, default_value_t)]
    cost: CostAxis,
    /// The error: max, mean or p95 over the angles
    #[arg(long, default_value_t)]
    on: Measure,
    /// The space of parameters and differences
    #[arg(long, default_value_t)]
    space: RgbSpace,
    #[command(flatten)]
    shown: Shown,
}

impl TradeCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let mut warnings = Vec::new();
        let presets = self.presets(&mut warnings)?;
        let material = Material::read(&self.material, self.space, &mut warnings);
        let (name, subjects) = if self.all {
            ("All metals".to_owned(), named_or_preferred(&[])?.into_iter().map(Subject::Metal).collect())
        } else if presets.is_empty() {
            let subject = material.as_ref().map_err(|error| anyhow::anyhow!("{error:#}"))?.subject();
            (subject.name(), vec![subject])
        } else {
            (of_presets(&presets), presets.iter().map(|preset| Subject::of_preset(preset).0).collect::<Vec<_>>())
        };
        let costs = match self.cost {
            CostAxis::MeasuredNs => measured(&mut warnings)?,
            CostAxis::ShaderOperations | CostAxis::ParameterBytes => Costs::counted(),
        };
        let options = TradeOptions { space: self.space, cost: self.cost, measure: self.on, costs };
        let rows = with_bar(|progress| trade(&subjects, &options, progress))?;
        self.shown.draw(|| Box::new(trade_figure(&name, &rows, &options)))?;
        self.shown.output(&rows, &trade_summary(&rows, &options), warnings)
    }

    fn presets(&self, warnings: &mut Vec<String>) -> anyhow::Result<Vec<Preset>> {
        if self.presets {
            return Ok(built_in_presets().to_vec());
        }
        let mut presets = Vec::new();
        for Listed { path, is_of_folder } in listed(&self.preset)? {
            let loaded = match Preset::load(&path) {
                Ok(loaded) => loaded,
                // Other files may lie beside presets.
                Err(error) if is_of_folder => {
                    warnings.push(format!("left out: {error}"));
                    continue;
                }
                Err(error) => return Err(error.into()),
            };
            warnings.extend(loaded.warnings);
            warnings.extend(Subject::of_preset(&loaded.preset).1.map(|note| format!("{}: {note}", loaded.preset.name)));
            presets.push(loaded.preset);
        }
        anyhow::ensure!(self.preset.is_empty() || !presets.is_empty(), "none of the files is a preset");
        Ok(presets)
    }
}

fn of_presets(presets: &[Preset]) -> String {
    match presets {
        [preset] => preset.name.clone(),
        _ => format!("{} presets", presets.len()),
    }
}
