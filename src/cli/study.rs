//! `edgewise study`: the paper's evidence, measured.

mod blending;
mod conversion;
mod demonstrations;
mod material;
mod shown;
mod stability;
mod trade;

use std::ops::ControlFlow;

use clap::{Args, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};

use super::output::{FormatArguments, Output, Table};
use crate::color::RgbSpace;
use crate::metal::{Metal, metal_by_name, preferred_metals};
use crate::study::{AccuracyRow, Candidate, accuracy, evidence_markdown, summaries};

/// Arguments of `edgewise study`.
#[derive(Debug, Args)]
pub struct Study {
    #[command(subcommand)]
    subject: Subject,
}

#[derive(Debug, Subcommand)]
enum Subject {
    /// CIEDE2000 of every model against the spectral truth: metals × models × spaces
    Accuracy(Accuracy),
    /// What converting parameters between spaces as if they were colours changes
    Conversion(conversion::ConversionCommand),
    /// What blending parameters instead of reflectances changes
    Blending(blending::BlendingCommand),
    /// What storing parameters with few digits changes
    Quantisation(demonstrations::QuantisationCommand),
    /// Whether one parameter leaves the other's meaning alone
    Decoupling(demonstrations::DecouplingCommand),
    /// Whether equal steps of a slider look equal
    Uniformity(demonstrations::UniformityCommand),
    /// Which r and h are reflectances
    Feasibility(demonstrations::FeasibilityCommand),
    /// How much accuracy there is for how much cost
    Trade(trade::TradeCommand),
    /// How many digits each model and conversion keeps, also where its parameters are no reflectances
    Stability(stability::StabilityCommand),
}

#[derive(Debug, Args)]
struct Accuracy {
    /// A metal of the library; may be given again. The preferred data set of every material unless given
    #[arg(long, value_name = "ID")]
    metal: Vec<String>,
    /// A space; may be given again. All four unless given
    #[arg(long)]
    space: Vec<RgbSpace>,
    /// What to measure, like hoffman:exact or spectral-8:spline; may be given again. Everything that needs
    /// no numerical search unless given
    #[arg(long, value_name = "MODEL:METHOD")]
    candidate: Vec<Candidate>,
    /// Also the fits by numerical search, which take seconds
    #[arg(long, conflicts_with = "candidate")]
    searches: bool,
    /// One row for each model and space over all metals, instead of one for each metal
    #[arg(long)]
    summary: bool,
    /// Everything the paper claims, measured, as the Markdown of docs/evidence.md; takes a minute
    #[arg(long, exclusive = true)]
    evidence: bool,
    #[command(flatten)]
    format: FormatArguments,
}

impl Study {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        match self.subject {
            Subject::Accuracy(command) => command.run(),
            Subject::Conversion(command) => command.run(),
            Subject::Blending(command) => command.run(),
            Subject::Quantisation(command) => command.run(),
            Subject::Decoupling(command) => command.run(),
            Subject::Uniformity(command) => command.run(),
            Subject::Feasibility(command) => command.run(),
            Subject::Trade(command) => command.run(),
            Subject::Stability(command) => command.run(),
        }
    }
}

impl Accuracy {
    fn run(self) -> anyhow::Result<Output> {
        if self.evidence {
            return evidence();
        }
        let rows = self.rows()?;
        let table = if self.summary { Table::of_rows(&summaries(&rows)) } else { Table::of_rows(&rows) };
        Ok(Output { text: table?.render(self.format.format()), ..Output::default() })
    }

    fn rows(&self) -> anyhow::Result<Vec<AccuracyRow>> {
        let metals = named_or_preferred(&self.metal)?;
        let spaces = if self.space.is_empty() { RgbSpace::ALL.to_vec() } else { self.space.clone() };
        let bar = progress_bar("Measuring");
        let progress = |share: f32| {
            bar.set_position((share * BAR_STEPS as f32) as u64);
            ControlFlow::Continue(())
        };
        let rows = accuracy(&metals, &self.candidates(), &spaces, &progress)?;
        bar.finish_and_clear();
        Ok(rows)
    }

    fn candidates(&self) -> Vec<Candidate> {
        match (self.candidate.is_empty(), self.searches) {
            (false, _) => self.candidate.clone(),
            (true, true) => Candidate::all(),
            (true, false) => Candidate::without_search(),
        }
    }
}

fn evidence() -> anyhow::Result<Output> {
    let bar = progress_bar("Measuring");
    let progress = |share: f32| {
        bar.set_position((share * BAR_STEPS as f32) as u64);
        ControlFlow::Continue(())
    };
    let text = evidence_markdown(&progress)?;
    bar.finish_and_clear();
    Ok(Output { text, ..Output::default() })
}

/// The metals of these names; the preferred data set of every material for none.
fn named_or_preferred(names: &[String]) -> anyhow::Result<Vec<&'static Metal>> {
    if names.is_empty() {
        return Ok(preferred_metals().collect());
    }
    names.iter().map(|name| Ok(metal_by_name(name)?)).collect()
}

/// Steps of a [`progress_bar`].
pub(super) const BAR_STEPS: u64 = 1000;

/// A bar on standard error, only where that is a terminal.
pub(super) fn progress_bar(what: &'static str) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg} {wide_bar} {percent} % {eta}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(BAR_STEPS).with_style(style).with_message(what)
}
