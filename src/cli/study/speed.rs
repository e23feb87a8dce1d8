//! `edgewise study speed`: what each model costs on this machine.

use anyhow::Context;
use clap::Args;

use super::super::output::{Format, FormatArguments, Output, Table};
use super::shown::with_bar;
use crate::kernel::{Level, level_id, levels};
use crate::metal::metal_by_name;
use crate::study::{Fineness, SpeedOptions, performance_markdown, speed, speed_summary, stability};

/// Arguments of `edgewise study speed`.
#[derive(Debug, Args)]
pub(super) struct SpeedCommand {
    /// The metal whose parameters are evaluated
    #[arg(long, value_name = "ID", default_value = "gold")]
    metal: String,
    /// How often every kernel takes its turn
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    rounds: u32,
    /// Values in one pass: 1024 stay in the cache, millions come from memory
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=16_777_216))]
    size: u32,
    /// The instruction set, of those that this machine has; the best unless given
    #[arg(long, value_parser = instruction_set)]
    instruction_set: Option<Level>,
    /// Speed, from the cache and from memory, and stability, as the Markdown of docs/performance.md
    #[arg(long, conflicts_with_all = ["size", "format", "json"])]
    evidence: bool,
    #[command(flatten)]
    format: FormatArguments,
}

fn instruction_set(text: &str) -> Result<Level, String> {
    let found = levels().into_iter().find(|level| level_id(*level) == text);
    found.ok_or_else(|| {
        let ids: Vec<&str> = levels().into_iter().map(level_id).collect();
        format!("this machine has no “{text}”; one of: {}", ids.join(", "))
    })
}

impl SpeedCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let options = SpeedOptions {
            metal: metal_by_name(&self.metal)?,
            level: self.instruction_set.unwrap_or_else(Level::new),
            size: self.size as usize,
            rounds: self.rounds as usize,
        };
        if self.evidence {
            return evidence(&options);
        }
        let rows = with_bar(|progress| speed(&options, progress)).context(STOPPED)?;
        let format = self.format.format();
        let sentence = if format == Format::Table { format!("\n{}\n", speed_summary(&rows)) } else { String::new() };
        Ok(Output {
            text: Table::of_rows(&rows)?.render(format) + &sentence,
            warnings: warnings(),
            ..Output::default()
        })
    }
}

/// Values that no cache holds.
const IN_MEMORY: usize = 4_000_000;

fn evidence(options: &SpeedOptions) -> anyhow::Result<Output> {
    let in_memory = SpeedOptions { size: IN_MEMORY, rounds: options.rounds.min(5), ..*options };
    let cached = with_bar(|progress| speed(options, progress)).context(STOPPED)?;
    let from_memory = with_bar(|progress| speed(&in_memory, progress)).context(STOPPED)?;
    let stability = with_bar(|progress| stability(Fineness::Default, progress)).context(STOPPED)?;
    let text = performance_markdown(&cached, &from_memory, &stability);
    Ok(Output { text, warnings: warnings(), ..Output::default() })
}

const STOPPED: &str = "the measurement was stopped";

fn warnings() -> Vec<String> {
    if cfg!(debug_assertions) { vec![NOT_OPTIMISED.to_owned()] } else { vec![] }
}

/// What a person should know before quoting the numbers.
const NOT_OPTIMISED: &str = "this is a build without optimisation: build with --release for times that mean something";
