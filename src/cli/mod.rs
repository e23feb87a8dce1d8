//! The command line: one file per subcommand.
//!
//! | file | what it is for |
//! |---|---|
//! | `arguments` | triples, angles and other things people type |
//! | `check` | `edgewise check`: whether presets can be relied on |
//! | `convert` | `edgewise convert`: the same material in other parameters |
//! | `curve` | the truth of a material, or a model of it, over the angle |
//! | `export` | `edgewise export`: presets as files for renderers |
//! | `export_plan` | `edgewise export --plan`: the materials of a scene, without what it does not need |
//! | `fit` | `edgewise fit`: parameters of models for a measured metal |
//! | `import` | `edgewise import`: presets from what other programs write |
//! | `inspect` | `edgewise inspect`: what a photograph says about its colours |
//! | `marks` | what a person marks in a photograph |
//! | `match_photo`, `batch` | `edgewise match`: r and h from one photograph, or from many |
//! | `metals` | `edgewise metals`: the library of measured data |
//! | `output` | table, CSV and JSON, one form of each for every subcommand |
//! | `parameters` | the parameters of a model as rows |
//! | `picture` | `edgewise picture`: a sphere by the truth and by a model |
//! | `plan` | `edgewise plan`: what a scene requires |
//! | `preset_files` | presets that are named as files or as whole folders |
//! | `presets` | `edgewise presets`: the presets that ship with the program |
//! | `progress` | a bar on standard error, and an ear for Ctrl-C |
//! | `reflect` | `edgewise reflect`: reflectance over angle |
//! | `samples` | `edgewise samples`: the rendered photographs inside the program |
//! | `shard` | one of several processes that share a job |
//! | `source` | what material a subcommand is about |
//! | `study` | `edgewise study`: the paper's evidence, measured |
//! | `times` | what every variant takes on this machine |

mod arguments;
mod batch;
mod check;
mod convert;
mod curve;
mod export;
mod export_plan;
mod fit;
mod import;
mod inspect;
mod marks;
mod match_photo;
mod metals;
mod output;
mod parameters;
mod picture;
mod plan;
mod plan_scene;
mod preset_files;
mod presets;
mod progress;
mod reflect;
mod samples;
mod shard;
mod source;
mod study;
mod times;

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::sample::{Sample, sample as built_in_sample};
use output::Output;

/// Author how metals reflect: r facing the surface, h at 81.8°.
#[derive(Debug, Parser)]
#[command(name = "edgewise", version, args_conflicts_with_subcommands = true)]
pub struct Arguments {
    /// A photograph or a preset to open in the window
    pub path: Option<PathBuf>,
    /// Open a photograph that ships with the program instead; `edgewise samples` lists them
    #[arg(long, value_name = "ID", value_parser = sample, conflicts_with = "path")]
    pub sample: Option<&'static Sample>,
    /// What draws the window; auto goes by what the machine has
    #[arg(long, default_value = "auto", value_parser = ["auto", "wgpu", "glow"])]
    pub renderer: String,
    /// What to do without a window
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// The subcommands, in the order of the help.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Measure r and h in photographs
    Match(Box<match_photo::MatchCommand>),
    /// Say how a photograph's colours are read, and its values at some pixels
    Inspect(inspect::Inspect),
    /// List the built-in photographs, or render them again
    Samples(samples::Samples),
    /// List the measured metals of the library
    Metals(metals::Metals),
    /// Print or plot reflectance over the angle of incidence
    Reflect(reflect::Reflect),
    /// Render a sphere by the truth and by a model, and where they differ
    Picture(picture::PictureCommand),
    /// Fit models to a measured metal
    Fit(fit::FitCommand),
    /// Give the same material in the parameters of other models
    Convert(convert::Convert),
    /// List the built-in presets, or write them as files
    Presets(presets::Presets),
    /// Say of presets whether they can be relied on
    Check(check::Check),
    /// Write presets for renderers
    Export(export::Export),
    /// Read presets from what other programs write
    Import(import::Import),
    /// Measure what the paper claims
    Study(study::Study),
    /// Find the cheapest model of each material of a scene within a tolerance
    Plan(Box<plan::PlanCommand>),
}

impl Command {
    fn run(self) -> anyhow::Result<Output> {
        match self {
            Self::Match(command) => command.run(),
            Self::Samples(command) => command.run(),
            Self::Inspect(command) => command.run(),
            Self::Metals(command) => command.run(),
            Self::Reflect(command) => command.run(),
            Self::Picture(command) => command.run(),
            Self::Fit(command) => command.run(),
            Self::Convert(command) => command.run(),
            Self::Presets(command) => command.run(),
            Self::Check(command) => command.run(),
            Self::Export(command) => command.run(),
            Self::Import(command) => command.run(),
            Self::Study(command) => command.run(),
            Self::Plan(command) => command.run(),
        }
    }
}

/// The built-in photograph of an identifier.
fn sample(id: &str) -> Result<&'static Sample, String> {
    built_in_sample(id).ok_or_else(|| format!("there is no sample “{id}”; `edgewise samples` lists them"))
}

/// Parses arguments. `Err` is the exit code when nothing is left to do: help was shown or the usage was wrong.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Arguments, ExitCode> {
    Arguments::try_parse_from(arguments).map_err(|error| {
        if error.use_stderr() {
            output::complain(&usage_sentence(&error));
            return ExitCode::from(USAGE);
        }
        // Help and version; a reader that went away wants none.
        let _ = error.print();
        ExitCode::SUCCESS
    })
}

/// Runs a subcommand: results on standard output, warnings and errors as sentences on standard error.
pub fn run(command: Command) -> ExitCode {
    let result = command.run().and_then(|output| output.print());
    match result {
        Ok(code) => code,
        Err(error) => fail(&error),
    }
}

/// Says an error in one sentence; a reader that went away is none.
pub fn fail(error: &anyhow::Error) -> ExitCode {
    let is_broken_pipe = |cause: &(dyn std::error::Error + 'static)| {
        cause.downcast_ref::<std::io::Error>().is_some_and(|e| e.kind() == std::io::ErrorKind::BrokenPipe)
    };
    if error.chain().any(is_broken_pipe) {
        return ExitCode::SUCCESS;
    }
    if let Some(usage) = error.downcast_ref::<clap::Error>() {
        output::complain(&usage_sentence(usage));
        return ExitCode::from(USAGE);
    }
    if progress::was_stopped() {
        output::complain("stopped; nothing was written");
        return ExitCode::from(progress::STOPPED);
    }
    output::complain(&output::sentence(error));
    ExitCode::FAILURE
}

/// Exit code of arguments that cannot be understood.
const USAGE: u8 = 2;

/// Arguments that clap takes one by one, but that make no sense together.
fn usage(sentence: &str) -> anyhow::Error {
    clap::Error::raw(clap::error::ErrorKind::ArgumentConflict, sentence).into()
}

/// The first paragraph of clap's message on one line, without its tips.
fn usage_sentence(error: &clap::Error) -> String {
    let message = error.render().to_string();
    let first = message.split("\n\n").next().unwrap_or_default();
    let words: Vec<&str> = first.split_whitespace().collect();
    let sentence = words.join(" ");
    sentence.strip_prefix("error: ").unwrap_or(&sentence).to_owned()
}
