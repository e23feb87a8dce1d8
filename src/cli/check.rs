//! `edgewise check`: whether presets can be relied on, for people and for a studio's continuous integration.

use std::path::PathBuf;

use clap::Args;
use rayon::prelude::*;

use super::output::{Cell, FormatArguments, Output, Table};
use super::preset_files::{Listed, listed};
use super::progress::progress_bar;
use crate::preset::{Checked, Finding, NO_PRESET, Severity, check_preset};

/// Arguments of `edgewise check`.
#[derive(Debug, Args)]
pub struct Check {
    /// Preset files, or folders of them
    #[arg(required = true)]
    presets: Vec<PathBuf>,
    /// A folder that must hold the photographs of matched presets, unless they lie beside these
    #[arg(long, value_name = "DIR")]
    photos: Option<PathBuf>,
    /// Fail for warnings too
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    format: FormatArguments,
}

impl Check {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let mut files = listed(&self.presets)?;
        let bar = progress_bar("Checking");
        bar.set_length(files.len() as u64);
        let check = |file: &Listed| {
            let checked = check_preset(&file.path, self.photos.as_deref());
            bar.inc(1);
            checked
        };
        let mut checked: Vec<Checked> = files.par_iter().map(check).collect();
        bar.finish_and_clear();
        let mut warnings = pass_over_others(&mut files, &mut checked);
        let failed = checked.iter().filter(|checked| self.fails(checked)).count();
        if failed > 0 {
            warnings.push(format!("{failed} of {} presets cannot be relied on", files.len()));
        }
        let text = table(&files, &checked).render(self.format.format());
        Ok(Output { text, warnings, is_partial: failed > 0 })
    }

    fn fails(&self, checked: &Checked) -> bool {
        checked.findings.iter().any(|finding| self.strict || finding.severity == Severity::Error)
    }
}

/// Leaves out what only lies in a folder beside presets; a sentence for each.
fn pass_over_others(files: &mut Vec<Listed>, checked: &mut Vec<Checked>) -> Vec<String> {
    let is_other = |(file, checked): &(Listed, Checked)| {
        file.is_of_folder && checked.findings.iter().any(|finding| finding.code == NO_PRESET)
    };
    let pairs = std::mem::take(files).into_iter().zip(std::mem::take(checked));
    let (others, presets): (Vec<_>, Vec<_>) = pairs.partition(is_other);
    (*files, *checked) = presets.into_iter().unzip();
    others.iter().map(|(file, _)| format!("{} is no preset and was passed over", file.path.display())).collect()
}

/// A row for each finding, and one for a preset without any.
fn table(files: &[Listed], checked: &[Checked]) -> Table {
    let columns = ["file", "name", "result", "code", "message"];
    let mut table = Table::new(columns.map(|column| (column, column)));
    for (file, checked) in files.iter().zip(checked) {
        let name = checked.preset.as_ref().map_or(Cell::Nothing, |preset| preset.name.as_str().into());
        let row = |result: &str, code: Cell, message: Cell| {
            vec![Cell::Text(file.path.display().to_string()), name.clone(), result.into(), code, message]
        };
        if checked.findings.is_empty() {
            table.push(row("ok", Cell::Nothing, Cell::Nothing));
        }
        for Finding { severity, code, message } in &checked.findings {
            table.push(row(severity.id(), (*code).into(), message.as_str().into()));
        }
    }
    table
}
