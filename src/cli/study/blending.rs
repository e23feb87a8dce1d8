//! `edgewise study blending`: parameters blended between two materials.

use clap::Args;

use super::super::output::Output;
use super::material::{MATERIAL_HELP, Material};
use super::named_or_preferred;
use super::shown::{METHOD_HELP, Shown, index_method, with_bar};
use crate::color::RgbSpace;
use crate::figure::{BlendFigure, blend_matrix_of_two};
use crate::fit::Method;
use crate::study::{Contestants, Parameters, blend_matrix, blend_pairs_summary, blending};

/// Arguments of `edgewise study blending`.
#[derive(Debug, Args)]
pub(super) struct BlendingCommand {
    #[arg(default_value = "gold", help = MATERIAL_HELP)]
    a: String,
    /// What it is blended with, in the same form
    #[arg(default_value = "n=1.5")]
    b: String,
    /// Every pair of the measured materials, half and half
    #[arg(long, conflicts_with_all = ["a", "b", "detail"])]
    all: bool,
    /// The space of the parameters
    #[arg(long, default_value_t = RgbSpace::AcesCg)]
    space: RgbSpace,
    #[arg(long, default_value = "colour-matching", value_parser = index_method, help = METHOD_HELP)]
    method: Method,
    /// One row for each step of the slider
    #[arg(long)]
    detail: bool,
    #[command(flatten)]
    shown: Shown,
}

impl BlendingCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        if self.all {
            let metals = named_or_preferred(&[])?;
            let rows = with_bar(|progress| blend_matrix(&metals, self.space, self.method, progress))?;
            self.shown.draw(|| Box::new(blend_matrix_of_two(&rows, Parameters::G, Parameters::Nk)))?;
            return self.shown.output(&rows, &blend_pairs_summary(&rows), vec![]);
        }
        let mut warnings = Vec::new();
        let mut contestants = |word: &str| -> anyhow::Result<Contestants> {
            let material = Material::read(word, self.space, &mut warnings)?;
            let contestants = Contestants::of(&material.subject(), self.space, self.method)?;
            warnings.extend(contestants.losses.iter().cloned());
            Ok(contestants)
        };
        let (a, b) = (contestants(&self.a)?, contestants(&self.b)?);
        let blend = blending(&a, &b);
        self.shown.draw(|| Box::new(BlendFigure::new(&a, &b)))?;
        if self.detail {
            return self.shown.output(&blend.rows(), &blend.summary(), warnings);
        }
        self.shown.output(&blend.summaries(), &blend.summary(), warnings)
    }
}
