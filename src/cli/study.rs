//! `edgewise study`: the paper's evidence, measured.

use std::ops::ControlFlow;

use clap::{Args, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use super::output::{Cell, Format, FormatArguments, Output, Table};
use crate::color::RgbSpace;
use crate::metal::{Metal, metal_by_name, preferred_metals};
use crate::preset::pretty_json;
use crate::study::{AccuracyRow, Candidate, Summary, accuracy, summaries};

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
    #[command(flatten)]
    format: FormatArguments,
}

impl Study {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        match self.subject {
            Subject::Accuracy(command) => command.run(),
        }
    }
}

impl Accuracy {
    fn run(self) -> anyhow::Result<Output> {
        let rows = self.rows()?;
        let format = self.format.format();
        let text = match (self.summary, format) {
            (true, Format::Json) => list(&summaries(&rows))?,
            (true, format) => summary_table(&summaries(&rows)).render(format),
            (false, Format::Json) => list(&rows)?,
            (false, format) => row_table(&rows).render(format),
        };
        Ok(Output { text, ..Output::default() })
    }

    fn rows(&self) -> anyhow::Result<Vec<AccuracyRow>> {
        let metals = self.metals()?;
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

    fn metals(&self) -> anyhow::Result<Vec<&'static Metal>> {
        if self.metal.is_empty() {
            return Ok(preferred_metals().collect());
        }
        self.metal.iter().map(|name| Ok(metal_by_name(name)?)).collect()
    }

    fn candidates(&self) -> Vec<Candidate> {
        match (self.candidate.is_empty(), self.searches) {
            (false, _) => self.candidate.clone(),
            (true, true) => Candidate::all(),
            (true, false) => Candidate::without_search(),
        }
    }
}

const BAR_STEPS: u64 = 1000;

/// A bar on standard error, only where that is a terminal.
pub(super) fn progress_bar(what: &'static str) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg} {wide_bar} {percent} % {eta}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(BAR_STEPS).with_style(style).with_message(what)
}

fn list<T: Serialize>(rows: &[T]) -> anyhow::Result<String> {
    Ok(pretty_json(&serde_json::to_value(rows)?))
}

fn row_table(rows: &[AccuracyRow]) -> Table {
    let mut table = Table::new([
        ("metal", "metal"),
        ("name", "name"),
        ("category", "category"),
        ("space", "space"),
        ("model", "model"),
        ("method", "method"),
        ("mean_delta_e", "mean ΔE2000"),
        ("max_delta_e", "max ΔE"),
        ("angle_of_max_deg", "at (°)"),
        ("sphere_delta_e", "sphere ΔE"),
        ("losses", "losses"),
    ]);
    for row in rows {
        table.push(vec![
            row.metal.as_str().into(),
            row.name.as_str().into(),
            row.category.as_str().into(),
            row.space.id().into(),
            row.model.as_str().into(),
            row.method.as_str().into(),
            Cell::Number(row.mean_delta_e, 3),
            Cell::Number(row.max_delta_e, 3),
            Cell::Number(row.angle_of_max_deg, 0),
            Cell::Number(row.sphere_delta_e, 3),
            row.losses.as_str().into(),
        ]);
    }
    table
}

fn summary_table(summaries: &[Summary]) -> Table {
    let mut table = Table::new([
        ("space", "space"),
        ("model", "model"),
        ("method", "method"),
        ("metals", "metals"),
        ("mean_delta_e", "mean ΔE2000"),
        ("median_delta_e", "median ΔE"),
        ("mean_max_delta_e", "mean of max ΔE"),
        ("sphere_delta_e", "sphere ΔE"),
        ("worst_metal", "worst metal"),
        ("worst_mean_delta_e", "its mean ΔE"),
        ("largest_delta_e", "largest ΔE"),
        ("angle_of_largest_deg", "at (°)"),
        ("below_two", "mean ΔE < 2"),
        ("worse_than_schlick", "worse than Schlick"),
    ]);
    for summary in summaries {
        let count = |number: usize| Cell::Number(number as f64, 0);
        table.push(vec![
            summary.space.id().into(),
            summary.model.as_str().into(),
            summary.method.as_str().into(),
            count(summary.metals),
            Cell::Number(summary.mean_delta_e, 3),
            Cell::Number(summary.median_delta_e, 3),
            Cell::Number(summary.mean_max_delta_e, 3),
            Cell::Number(summary.sphere_delta_e, 3),
            summary.worst_metal.as_str().into(),
            Cell::Number(summary.worst_mean_delta_e, 3),
            Cell::Number(summary.largest_delta_e, 3),
            Cell::Number(summary.angle_of_largest_deg, 0),
            count(summary.below_two),
            count(summary.worse_than_schlick),
        ]);
    }
    table
}
