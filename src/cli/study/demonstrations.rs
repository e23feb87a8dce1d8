//! `edgewise study quantisation`, `decoupling`, `uniformity` and `feasibility`.

use clap::Args;

use super::super::output::Output;
use super::material::{MATERIAL_HELP, Material};
use super::named_or_preferred;
use super::shown::{METHOD_HELP, Shown, index_method};
use crate::color::RgbSpace;
use crate::figure::{DecouplingFigure, QuantisationFigure, UniformityFigure, feasible_figure};
use crate::fit::Method;
use crate::study::{
    Contestants, DecouplingOptions, UniformityOptions, decoupling, feasibility_boundary, feasibility_summary,
    metal_points, quantisation, uniformity, uniformity_summary,
};

/// A space and a method: what every description of a material depends on.
#[derive(Debug, Args)]
struct Descriptions {
    /// The space of the parameters
    #[arg(long, default_value_t = RgbSpace::AcesCg)]
    space: RgbSpace,
    #[arg(long, default_value = "colour-matching", value_parser = index_method, help = METHOD_HELP)]
    method: Method,
}

impl Descriptions {
    fn of(&self, word: &str, warnings: &mut Vec<String>) -> anyhow::Result<Contestants> {
        let material = Material::read(word, self.space, warnings)?;
        let contestants = Contestants::of(&material.subject(), self.space, self.method)?;
        warnings.extend(contestants.losses.iter().cloned());
        Ok(contestants)
    }
}

/// Arguments of `edgewise study quantisation`.
#[derive(Debug, Args)]
pub(super) struct QuantisationCommand {
    #[arg(default_value = "gold", help = MATERIAL_HELP)]
    material: String,
    /// What the gradient that shows banding leads to, in the same form
    #[arg(default_value = "silver")]
    towards: String,
    #[command(flatten)]
    descriptions: Descriptions,
    #[command(flatten)]
    shown: Shown,
}

impl QuantisationCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let mut warnings = Vec::new();
        let material = self.descriptions.of(&self.material, &mut warnings)?;
        let towards = self.descriptions.of(&self.towards, &mut warnings)?;
        let study = quantisation(&material, &towards);
        self.shown.draw(|| Box::new(QuantisationFigure { study: study.clone() }))?;
        self.shown.output(&study.rows(), &study.summary(), warnings)
    }
}

/// Arguments of `edgewise study decoupling`.
#[derive(Debug, Args)]
pub(super) struct DecouplingCommand {
    #[arg(default_value = "0.9,0.7,0.4/0.75,0.65,0.5", help = MATERIAL_HELP)]
    material: String,
    /// How far r and the edge parameter fall; for n and k, the share of the value
    #[arg(long, default_value_t = DecouplingOptions::default().amount, value_parser = amount, allow_hyphen_values = true)]
    amount: f64,
    /// The colours that a grey edge parameter takes on, instead of the sweeps
    #[arg(long)]
    cross_talk: bool,
    #[command(flatten)]
    descriptions: Descriptions,
    #[command(flatten)]
    shown: Shown,
}

fn amount(text: &str) -> Result<f64, String> {
    let amount = super::super::arguments::number(text)?;
    let is_inside = amount > 0.0 && amount <= 1.0;
    if is_inside { Ok(amount) } else { Err(format!("the amount {amount} must be above 0 and at most 1")) }
}

impl DecouplingCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let mut warnings = Vec::new();
        let material = self.descriptions.of(&self.material, &mut warnings)?;
        let study = decoupling(&material, &DecouplingOptions { amount: self.amount });
        warnings.extend(study.warnings());
        self.shown.draw(|| Box::new(DecouplingFigure { study: study.clone() }))?;
        if self.cross_talk {
            return self.shown.output(&study.cross_talk, &study.summary(), warnings);
        }
        self.shown.output(&study.rows(), &study.summary(), warnings)
    }
}

/// Arguments of `edgewise study uniformity`.
#[derive(Debug, Args)]
pub(super) struct UniformityCommand {
    /// Reflectance facing the surface, grey, above 0 and below 1; may be given again. A set from .02 to .98 unless given
    #[arg(long, value_name = "R", value_parser = reflectance, allow_hyphen_values = true)]
    r: Vec<f64>,
    /// Equal steps of each slider
    #[arg(long, default_value_t = UniformityOptions::default().steps, value_parser = super::super::arguments::steps)]
    steps: usize,
    /// One row for each step
    #[arg(long)]
    detail: bool,
    #[command(flatten)]
    shown: Shown,
}

fn reflectance(text: &str) -> Result<f64, String> {
    let r = super::super::arguments::number(text)?;
    let is_inside = r > 0.0 && r < 1.0;
    if is_inside { Ok(r) } else { Err(format!("r = {r} has no g: it must lie between 0 and 1")) }
}

impl UniformityCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let default = UniformityOptions::default();
        let r = if self.r.is_empty() { default.r } else { self.r.clone() };
        // The figure and the sentence are about one r: a typical metal unless one was asked for.
        let told = if self.r.is_empty() { 0.8 } else { r[0] };
        let sweeps = uniformity(&UniformityOptions { r, steps: self.steps });
        let sentence = uniformity_summary(&sweeps, told);
        self.shown.draw(|| Box::new(UniformityFigure { sweeps: sweeps.clone(), r: told }))?;
        if self.detail {
            let rows: Vec<_> = sweeps.iter().flat_map(|sweep| sweep.step_rows()).collect();
            return self.shown.output(&rows, &sentence, vec![]);
        }
        let rows: Vec<_> = sweeps.iter().map(|sweep| sweep.row()).collect();
        self.shown.output(&rows, &sentence, vec![])
    }
}

/// Arguments of `edgewise study feasibility`.
#[derive(Debug, Args)]
pub(super) struct FeasibilityCommand {
    /// Where the metals of the library lie, instead of the boundary of r and h
    #[arg(long)]
    metals: bool,
    /// The space of the metals' r and h
    #[arg(long, default_value_t)]
    space: RgbSpace,
    /// Steps of r along the boundary
    #[arg(long, default_value_t = 40, value_parser = super::super::arguments::steps)]
    steps: usize,
    #[command(flatten)]
    shown: Shown,
}

impl FeasibilityCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let points = metal_points(&named_or_preferred(&[])?, self.space);
        let sentence = feasibility_summary(&points);
        self.shown.draw(|| Box::new(feasible_figure(&points, None)))?;
        if self.metals {
            return self.shown.output(&points, &sentence, vec![]);
        }
        self.shown.output(&feasibility_boundary(self.steps), &sentence, vec![])
    }
}
