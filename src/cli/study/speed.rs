//! `edgewise study speed`: how long every kernel takes on this machine.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use anyhow::Context;
use clap::Args;
use serde::de::DeserializeOwned;

use super::super::output::{Cell, Format, FormatArguments, Output, Table};
use super::super::times::caution;
use super::super::usage;
use super::shown::with_bar;
use crate::kernel::{Level, level_id, levels};
use crate::metal::{Metal, NkTable, metals, preferred_metals};
use crate::photo::{Ids, Plane};
use crate::preset::pretty_json;
use crate::scene::{FacingPass, Masks, PlanOptions, SceneMaterial, Source, plan_scene};
use crate::spectrum::wavelengths_nm;
use crate::study::{
    Elsewhere, SpeedEvidence, SpeedOptions, SpeedRow, error_table_input, no_progress, repeat, speed, speed_kernels,
    speed_summary,
};

/// Arguments of `edgewise study speed`.
#[derive(Debug, Args)]
pub(super) struct SpeedCommand {
    /// Measure only this kernel, beside Schlick's; may be given again
    #[arg(long, value_name = "NAME", value_parser = kernel)]
    kernel: Vec<String>,
    /// Fewer rounds, for a first look
    #[arg(long)]
    quick: bool,
    /// The instruction set of the vectors: avx512, avx2, sse4.2, sse2 or neon; the best of this machine unless given
    #[arg(long, value_name = "ID")]
    instruction_set: Option<String>,
    /// Everything, as the Markdown of docs/performance.md; takes half a minute
    #[arg(long, conflicts_with_all = ["kernel", "quick"])]
    evidence: bool,
    /// What scripts/compare_accuracy.py printed, for --evidence
    #[arg(long, value_name = "FILE", requires = "evidence")]
    python: Option<PathBuf>,
    /// What scripts/compare_builds.sh wrote, for --evidence
    #[arg(long, value_name = "FILE", requires = "evidence")]
    builds: Option<PathBuf>,
    /// What scripts/count_instructions.sh wrote, for --evidence
    #[arg(long, value_name = "FILE", requires = "evidence")]
    instructions: Option<PathBuf>,
    /// Instead, run our kernel of this name so many times, unmeasured, for a simulator that counts instructions; prints
    /// how many evaluations that were. PER is material, pixel, pair or color
    #[arg(long, num_args = 3, value_names = ["NAME", "PER", "TURNS"], conflicts_with_all = ["kernel", "quick", "evidence", "format", "json"])]
    repeat: Vec<String>,
    /// Instead, what the table of errors is computed from, as JSON for scripts/compare_accuracy.py
    #[arg(long, exclusive = true)]
    error_table: bool,
    #[command(flatten)]
    format: FormatArguments,
}

impl SpeedCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        if self.error_table {
            let input = with_bar(|progress| error_table_input(progress))?;
            return Ok(Output { text: pretty_json(&serde_json::to_value(input)?), ..Output::default() });
        }
        let options = self.options()?;
        if let [kernel, per, turns] = self.repeat.as_slice() {
            return repeated(kernel, per, turns, options.level);
        }
        let warnings = Vec::from_iter(caution());
        if self.evidence {
            let elsewhere = self.elsewhere()?;
            let evidence = with_bar(|progress| SpeedEvidence::measure(&options, elsewhere, progress))?;
            return Ok(Output { text: evidence.markdown(), warnings, ..Output::default() });
        }
        let rows = with_bar(|progress| speed(&options, progress))?;
        let text = match self.format.format() {
            Format::Table => format!("{}\n{}\n", for_people(&rows).to_text(), speed_summary(&rows)),
            format => Table::of_rows(&rows)?.render(format),
        };
        Ok(Output { text, warnings, ..Output::default() })
    }

    fn options(&self) -> anyhow::Result<SpeedOptions> {
        let level = match &self.instruction_set {
            None => Level::new(),
            Some(id) => {
                let ids = || levels().into_iter().map(level_id).collect::<Vec<_>>().join(", ");
                let named = levels().into_iter().find(|level| level_id(*level) == id);
                named.ok_or_else(|| {
                    usage(&format!("“{id}” is no instruction set of this machine, which has: {}", ids()))
                })?
            }
        };
        let rounds = if self.quick { SpeedOptions::QUICK_ROUNDS } else { SpeedOptions::ROUNDS };
        Ok(SpeedOptions { level, rounds, kernels: self.kernel.clone() })
    }

    fn elsewhere(&self) -> anyhow::Result<Elsewhere> {
        Ok(Elsewhere {
            python: self.python.as_deref().map(json).transpose()?,
            builds: self.builds.as_deref().map_or(Ok(Vec::new()), rows)?,
            instructions: self.instructions.as_deref().map_or(Ok(Vec::new()), rows)?,
            plan_s: Some(plan_s(PASS_SIZE, &of_library(PLANNED))?),
            plan_of_different_s: Some(plan_s(PASS_SIZE, &all_different(PLANNED)?)?),
        })
    }
}

fn repeated(kernel: &str, per: &str, turns: &str, level: Level) -> anyhow::Result<Output> {
    let turns = turns.parse().map_err(|_| usage(&format!("--repeat needs a whole number of turns, not “{turns}”")))?;
    let evaluations = repeat(kernel, per, turns, level)?;
    let evaluations = evaluations.ok_or_else(|| usage(&format!("there is no kernel “{kernel}” of ours per {per}")))?;
    Ok(Output { text: format!("{evaluations}\n"), ..Output::default() })
}

fn kernel(name: &str) -> Result<String, String> {
    let names = speed_kernels();
    let known = names.iter().any(|own| own == name).then(|| name.to_owned());
    known.ok_or_else(|| format!("there is no kernel “{name}”; there are: {}", names.join(", ")))
}

fn json<T: DeserializeOwned>(path: &Path) -> anyhow::Result<T> {
    let text = std::fs::read(path).with_context(|| path.display().to_string())?;
    serde_json::from_slice(&text).with_context(|| path.display().to_string())
}

fn rows<T: DeserializeOwned>(path: &Path) -> anyhow::Result<Vec<T>> {
    let mut reader = csv::Reader::from_path(path).with_context(|| path.display().to_string())?;
    reader.deserialize().collect::<Result<_, _>>().with_context(|| path.display().to_string())
}

/// Width and height of the pass that is planned for: 4 megapixels.
const PASS_SIZE: u32 = 2048;
/// Materials that are planned for.
const PLANNED: usize = 1000;

/// The metals of the library over and over, of which each is fitted once.
fn of_library(count: usize) -> Vec<Source> {
    let library: Vec<Arc<_>> = metals().iter().cloned().map(Arc::new).collect();
    library.iter().cycle().take(count).map(|metal| Source::Metal(Arc::clone(metal))).collect()
}

/// Metals with n and k between those of two of the library, as a person's own files have them: each is fitted anew.
fn all_different(count: usize) -> anyhow::Result<Vec<Source>> {
    let library: Vec<&Metal> = preferred_metals().collect();
    let metal = |index: usize| -> anyhow::Result<Source> {
        let (turn, place) = (index / library.len(), index % library.len());
        let (a, b) = (library[place], library[(place + turn + 1) % library.len()]);
        let share = (index as f64 + 0.5) / count as f64;
        let row = |nm: f64| {
            let (a, b) = (a.table().at(nm), b.table().at(nm));
            (nm, a.n + (b.n - a.n) * share, a.k + (b.k - a.k) * share)
        };
        let table = NkTable::new(wavelengths_nm().step_by(10).map(row))?;
        let (id, name) = (format!("between-{index}"), format!("Between {} and {}", a.name, b.name));
        Ok(Source::Metal(Arc::new(Metal::from_table(id, name, table))))
    };
    (0..count).map(metal).collect()
}

/// Seconds that the planner takes for materials on balls that fill `size` × `size` pixels, reading excepted, the
/// shortest of a few.
fn plan_s(size: u32, sources: &[Source]) -> anyhow::Result<f64> {
    let radius = |pixel: u32| (f64::from(pixel) + 0.5) * 2.0 / f64::from(size) - 1.0;
    let pixels = || (0..size).flat_map(|y| (0..size).map(move |x| (x, y)));
    let ratio = pixels().map(|(x, y)| (1.0 - radius(x).powi(2) - radius(y).powi(2)).max(0.0).sqrt() as f32).collect();
    let count = sources.len() as u32;
    let ids = pixels().map(|(x, y)| ((x / 64 + y / 64 * (size / 64)) % count) as f32).collect();
    let plane = |name: &str, values: Vec<f32>| Plane {
        name: name.to_owned(),
        channel: "Y".to_owned(),
        width: size,
        height: size,
        values,
        coverage: None,
        ids: Ids::OF_FLOATS,
        warnings: Vec::new(),
    };
    let (pass, masks) = (FacingPass { ratio: plane("ratio", ratio) }, Masks::Ids(plane("ids", ids)));
    let all: Vec<u32> = (0..count).collect();
    let once = || -> anyhow::Result<f64> {
        let start = Instant::now();
        let seen = pass.angles(&masks, &all).map_err(anyhow::Error::msg)?;
        let pairs = sources.iter().cloned().zip(seen.angles);
        let materials: Vec<SceneMaterial> = pairs.map(|(source, angles)| SceneMaterial { source, angles }).collect();
        plan_scene(&materials, "", &PlanOptions::default(), &no_progress)?;
        Ok(start.elapsed().as_secs_f64())
    };
    (0..3).try_fold(f64::INFINITY, |shortest, _| Ok(once()?.min(shortest)))
}

/// The counts of single operations are for machines.
fn for_people(rows: &[SpeedRow]) -> Table {
    let titles = [
        ("kernel", "kernel"),
        ("kind", "kind"),
        ("per", "per"),
        ("min_ns", "shortest (ns)"),
        ("median_ns", "middle (ns)"),
        ("times_schlick", "× Schlick"),
        ("parameter_bytes", "bytes"),
        ("shader_operations", "operations"),
    ];
    let mut table = Table::new(titles);
    for row in rows {
        table.push(vec![
            row.kernel.as_str().into(),
            row.kind.into(),
            row.per.into(),
            Cell::Number(row.min_ns, 3),
            Cell::Number(row.median_ns, 3),
            row.times_schlick.map_or(Cell::Nothing, |times| Cell::Number(times, 2)),
            row.parameter_bytes.map_or(Cell::Nothing, Cell::Count),
            row.shader_operations.map_or(Cell::Nothing, |operations| Cell::Count(operations.into())),
        ]);
    }
    table
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn a_plan_is_timed() {
        for sources in [of_library(3), all_different(3).unwrap()] {
            let seconds = plan_s(128, &sources).unwrap();
            assert!(seconds > 0.0 && seconds.is_finite());
        }
    }

    #[test]
    fn no_two_of_a_thousand_are_the_same() {
        let all = all_different(PLANNED).unwrap();
        let bits = |source: &Source| match source {
            Source::Metal(metal) => metal.nk().map(|nk| (nk.n.to_bits(), nk.k.to_bits())),
            Source::Preset(_) => panic!("a preset"),
        };
        assert_eq!(all.iter().map(bits).collect::<HashSet<_>>().len(), PLANNED);
    }

    #[test]
    fn names_of_kernels_are_known_or_refused_with_all_of_them() {
        assert_eq!(kernel("spectral-81"), Ok("spectral-81".to_owned()));
        assert!(kernel("warp").unwrap_err().contains("hoffman-basis"));
    }
}
