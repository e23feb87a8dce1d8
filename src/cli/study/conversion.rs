//! `edgewise study conversion`: parameters converted between spaces as if they were colours.

use clap::Args;

use super::super::output::Output;
use super::material::{MATERIAL_HELP, Material};
use super::named_or_preferred;
use super::shown::{METHOD_HELP, Shown, index_method, with_bar};
use crate::color::RgbSpace;
use crate::figure::{ConversionFigure, conversion_distribution};
use crate::fit::Method;
use crate::study::{ConversionOptions, conversion, conversions, conversions_summary};

/// Arguments of `edgewise study conversion`.
#[derive(Debug, Args)]
pub(super) struct ConversionCommand {
    #[arg(default_value = "gold", help = MATERIAL_HELP)]
    material: String,
    /// Every measured material, as a distribution
    #[arg(long, conflicts_with_all = ["material", "detail"])]
    all: bool,
    /// The space the parameters were made in
    #[arg(long, default_value_t = ConversionOptions::default().from)]
    from: RgbSpace,
    /// The space they are converted to
    #[arg(long, default_value_t = ConversionOptions::default().to)]
    to: RgbSpace,
    #[arg(long, default_value = "colour-matching", value_parser = index_method, help = METHOD_HELP)]
    method: Method,
    /// One row for each angle
    #[arg(long)]
    detail: bool,
    #[command(flatten)]
    shown: Shown,
}

impl ConversionCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let options = ConversionOptions { from: self.from, to: self.to, method: self.method };
        if self.all {
            let metals = named_or_preferred(&[])?;
            let rows = with_bar(|progress| conversions(&metals, &options, progress))?;
            self.shown.draw(|| Box::new(conversion_distribution(&rows)))?;
            return self.shown.output(&rows, &conversions_summary(&rows, &options), vec![]);
        }
        let mut warnings = Vec::new();
        let material = Material::read(&self.material, self.from, &mut warnings)?;
        let study = conversion(&material.subject(), &options)?;
        warnings.extend(study.losses.iter().cloned());
        self.shown.draw(|| Box::new(ConversionFigure { study: study.clone() }))?;
        if self.detail {
            return self.shown.output(&study.rows(), &study.summary(), warnings);
        }
        self.shown.output(&study.summaries(), &study.summary(), warnings)
    }
}
