//! `edgewise study`: the paper's evidence, measured.

mod blending;
mod conversion;
mod demonstrations;
mod material;
mod shown;
mod speed;
mod stability;
mod trade;

use clap::{Args, Subcommand, ValueEnum};

use super::output::Output;
use crate::color::RgbSpace;
use crate::figure::{Figure, accuracy_distribution, accuracy_table};
use crate::metal::{Metal, metal_by_name, preferred_metals};
use crate::study::{AccuracyRow, Candidate, Summary, accuracy, evidence_markdown, summaries};

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
    /// How long each kernel takes on this machine, ours, textbook forms and bounds in one run
    Speed(speed::SpeedCommand),
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
    /// What --plot draws, in the first of the spaces
    #[arg(long, value_enum, default_value_t, requires = "plot")]
    figure: AccuracyFigure,
    #[command(flatten)]
    shown: shown::Shown,
}

/// What `--plot` draws of the accuracy study.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum AccuracyFigure {
    /// Every metal against every model
    #[default]
    Table,
    /// One row of dots for each model
    Distribution,
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
            Subject::Speed(command) => command.run(),
        }
    }
}

impl Accuracy {
    fn run(self) -> anyhow::Result<Output> {
        if self.evidence {
            let text = shown::with_bar(|progress| evidence_markdown(progress))?;
            return Ok(Output { text, ..Output::default() });
        }
        let metals = named_or_preferred(&self.metal)?;
        let spaces = if self.space.is_empty() { RgbSpace::ALL.to_vec() } else { self.space.clone() };
        let rows = shown::with_bar(|progress| accuracy(&metals, &self.candidates(), &spaces, progress))?;
        self.shown.draw(|| self.figure_of(&rows, spaces[0]))?;
        let overview = summaries(&rows);
        let seen = accuracy_sentence(&overview);
        if self.summary {
            return self.shown.output(&overview, &seen, vec![]);
        }
        self.shown.output(&rows, &seen, vec![])
    }

    fn candidates(&self) -> Vec<Candidate> {
        match (self.candidate.is_empty(), self.searches) {
            (false, _) => self.candidate.clone(),
            (true, true) => Candidate::all(),
            (true, false) => Candidate::without_search(),
        }
    }

    /// A figure of the candidates that were named; of all would be too wide to read, so then the usual ones.
    fn figure_of(&self, rows: &[AccuracyRow], space: RgbSpace) -> Box<dyn Figure> {
        let is_drawn = |row: &&AccuracyRow| !self.candidate.is_empty() || Candidate::USUAL.contains(&row.candidate);
        let drawn: Vec<AccuracyRow> = rows.iter().filter(is_drawn).cloned().collect();
        match self.figure {
            AccuracyFigure::Table => Box::new(accuracy_table(&drawn, space)),
            AccuracyFigure::Distribution => Box::new(accuracy_distribution(&drawn, space)),
        }
    }
}

/// The mean ΔE of Schlick and Hoffman in each space, where they were measured.
fn accuracy_sentence(overview: &[Summary]) -> String {
    let of = |candidate: Candidate, name: &str| {
        let means = overview.iter().filter(|summary| summary.candidate == candidate);
        let words: Vec<String> = means.map(|s| format!("{:.2} in {}", s.mean_delta_e, s.space.label())).collect();
        (!words.is_empty()).then(|| format!("{name} {}", words.join(", ")))
    };
    let told: Vec<String> = [(Candidate::SCHLICK, "Schlick with the true r"), (Candidate::HOFFMAN, "r and h")]
        .into_iter()
        .filter_map(|(candidate, name)| of(candidate, name))
        .collect();
    let metals = overview.iter().map(|summary| summary.metals).max().unwrap_or(0);
    if told.is_empty() { String::new() } else { format!("Mean ΔE over {metals} metals: {}.", told.join("; ")) }
}

/// The metals of these names; the preferred data set of every material for none.
fn named_or_preferred(names: &[String]) -> anyhow::Result<Vec<&'static Metal>> {
    if names.is_empty() {
        return Ok(preferred_metals().collect());
    }
    names.iter().map(|name| Ok(metal_by_name(name)?)).collect()
}
