//! The files of the page: what is read into it, and what is written from it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::material::{PlanMaterial, for_ever};
use super::opened::ReadPlan;
use super::planned::Planned;
use super::trading::Chart;
use crate::export::{Options, Target};
use crate::figure::{Figure, FigureFormat, FigureTheme};
use crate::file::place_file;
use crate::gui::demonstrations::Told;
use crate::metal::Metal;
use crate::preset::Preset;
use crate::render::{SaveError, write_atomically};

/// What a file is to the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PlanFile {
    /// A preset, or n and k, to plan for.
    Material,
    /// A facing-ratio pass.
    Pass,
    /// The picture of ids beside it.
    Ids,
    /// The matte of an entry.
    Matte(u64),
    /// A plan to look at and to change.
    Open,
    /// Where to write the plan.
    Save,
    /// The folder for files of the materials.
    Export(Target),
    /// Where to write the chart.
    Chart(FigureFormat),
    /// Where to write its numbers.
    ChartData(DataFormat),
}

/// A format for the numbers of the chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DataFormat {
    /// Comma-separated values.
    Csv,
    /// A list of objects.
    Json,
}

impl DataFormat {
    /// Both formats.
    pub(crate) const ALL: [Self; 2] = [Self::Csv, Self::Json];

    /// The ending of file names.
    pub(crate) const fn extension(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Json => "json",
        }
    }

    /// The format that the ending of a file name asks for.
    fn of(path: &Path) -> Result<Self, SaveError> {
        let found = Self::ALL.into_iter().find(|format| has_ending(path, &[format.extension()]));
        found.ok_or_else(|| SaveError::UnknownFormat { path: path.to_owned(), known: ".csv or .json" })
    }
}

impl PlanFile {
    /// Whether it is written, and the name to begin with.
    pub(crate) const fn file_name(self) -> Option<&'static str> {
        match self {
            Self::Material | Self::Pass | Self::Ids | Self::Matte(_) | Self::Open | Self::Export(_) => None,
            Self::Save => Some("plan.json"),
            Self::Chart(FigureFormat::Svg) => Some("trade.svg"),
            Self::Chart(FigureFormat::Png) => Some("trade.png"),
            Self::ChartData(DataFormat::Csv) => Some("trade.csv"),
            Self::ChartData(DataFormat::Json) => Some("trade.json"),
        }
    }

    /// The question for its path.
    pub(crate) const fn question(self) -> &'static str {
        match self {
            Self::Material => "Add a preset, or n and k, to the plan",
            Self::Pass => "Open a facing-ratio pass",
            Self::Ids => "Open a picture of ids",
            Self::Matte(_) => "Open a matte",
            Self::Open => "Open a plan",
            Self::Save => "Save the plan",
            Self::Export(_) => "Export the materials of the plan into a folder",
            Self::Chart(_) => "Save the chart",
            Self::ChartData(_) => "Save the numbers of the chart",
        }
    }

    /// What the button below it says.
    pub(crate) const fn verb(self) -> &'static str {
        match self {
            Self::Export(_) => "Export",
            _ if self.file_name().is_some() => "Save",
            _ => "Open",
        }
    }

    /// What such files are called, and their endings.
    pub(crate) const fn kind(self) -> (&'static str, &'static [&'static str]) {
        match self {
            Self::Material => ("Presets, n and k", &["json", "csv", "yml", "yaml"]),
            Self::Pass | Self::Ids | Self::Matte(_) => ("OpenEXR and PNG", &["exr", "png"]),
            Self::Open | Self::Save => ("Edgewise plan", &["json"]),
            Self::Export(_) => ("Folders", &[]),
            Self::Chart(FigureFormat::Svg) => ("SVG", &["svg"]),
            Self::Chart(FigureFormat::Png) => ("PNG", &["png"]),
            Self::ChartData(DataFormat::Csv) => ("CSV", &["csv"]),
            Self::ChartData(DataFormat::Json) => ("JSON", &["json"]),
        }
    }
}

/// Something to do with a file, with all that it takes.
#[derive(Clone)]
pub(super) enum Task {
    Add(PathBuf),
    Open(PathBuf),
    Save(PathBuf, Arc<Planned>),
    Export(PathBuf, Arc<Planned>, Target),
    SaveChart(PathBuf, Arc<Chart>),
    SaveData(PathBuf, Arc<Chart>),
}

/// What came of it.
pub(super) enum Done {
    Added(PlanMaterial, Vec<String>),
    Opened(Box<ReadPlan>),
    Wrote,
    Exported(String),
}

impl Task {
    pub(super) fn path(&self) -> &Path {
        match self {
            Self::Add(path)
            | Self::Open(path)
            | Self::Save(path, _)
            | Self::Export(path, _, _)
            | Self::SaveChart(path, _)
            | Self::SaveData(path, _) => path,
        }
    }

    /// Does it; a sentence where it cannot be done.
    pub(super) fn run(&self) -> Told<Done> {
        match self {
            Self::Add(path) => add(path),
            Self::Open(path) => ReadPlan::read(path).map(|read| Done::Opened(Box::new(read))),
            Self::Save(path, planned) => {
                planned.saved().save(path).map(|()| Done::Wrote).map_err(|error| error.to_string())
            }
            Self::Export(folder, planned, target) => export(folder, planned, *target),
            Self::SaveChart(path, chart) => said(chart.figure.save(path, FigureTheme::Light)),
            Self::SaveData(path, chart) => {
                let format = DataFormat::of(path);
                said(format.and_then(|format| write_atomically(path, chart.data(format).as_bytes())))
            }
        }
    }
}

fn said(outcome: Result<(), SaveError>) -> Told<Done> {
    outcome.map(|()| Done::Wrote).map_err(|error| error.to_string())
}

fn add(path: &Path) -> Told<Done> {
    if has_ending(path, &["csv", "yml", "yaml"]) {
        let metal = Metal::open(path).map_err(|error| error.to_string())?;
        let remarks = metal.remarks();
        return Ok(Done::Added(PlanMaterial::Metal(for_ever(metal)), remarks));
    }
    let loaded = Preset::load(path).map_err(|error| error.to_string())?;
    Ok(Done::Added(PlanMaterial::Preset(Arc::new(loaded.preset)), loaded.warnings))
}

/// So many losses are told; the command line prints all.
const MOST_LOSSES: usize = 3;

/// Everything is made before anything is written, and no file is replaced that says something else.
fn export(folder: &Path, planned: &Planned, target: Target) -> Told<Done> {
    let scene = planned.scene();
    let made = planned.plan.export(scene.as_deref(), &[target], &Options::default(), |_| true);
    let made = made.map_err(|error| error.to_string())?;
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for file in &made.files {
        place_file(&folder.join(&file.name), &file.bytes, false).map_err(|error| error.to_string())?;
    }
    let told: Vec<&str> = made.losses.iter().take(MOST_LOSSES).map(String::as_str).collect();
    let more = made.losses.len() - told.len();
    let more = if more > 0 { format!("; {more} more, which edgewise export --plan prints") } else { String::new() };
    let losses = if told.is_empty() { String::new() } else { format!(": {}{more}", told.join("; ")) };
    let files = if made.files.len() == 1 { "1 file".to_owned() } else { format!("{} files", made.files.len()) };
    Ok(Done::Exported(format!("Wrote {files} into {}{losses}", folder.display())))
}

fn has_ending(path: &Path, endings: &[&str]) -> bool {
    path.extension().is_some_and(|own| endings.iter().any(|ending| own.eq_ignore_ascii_case(ending)))
}
