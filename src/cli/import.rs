//! `edgewise import`: presets from what other programs write.

use std::path::PathBuf;

use anyhow::{Context, bail};
use clap::Args;

use super::output::{Cell, FormatArguments, Output, Table};
use crate::color::RgbSpace;
use crate::export::file_stems;
use crate::import::import_file;
use crate::preset::Preset;

/// Arguments of `edgewise import`.
#[derive(Debug, Args)]
pub struct Import {
    /// MaterialX, glTF, CSV, pasted values, ASE or GPL files
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// The space of colours in files that name none; lin_rec709 unless given
    #[arg(long)]
    space: Option<RgbSpace>,
    /// The folder to write presets into; created where missing
    #[arg(long, short, value_name = "DIR", default_value = ".")]
    output: PathBuf,
    /// Replace files that are there
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    format: FormatArguments,
}

impl Import {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let (mut presets, mut warnings) = (Vec::new(), Vec::new());
        for path in &self.files {
            let imported = import_file(path, self.space).with_context(|| path.display().to_string())?;
            warnings.extend(imported.notes.iter().map(|note| format!("{}: {note}", path.display())));
            presets.extend(imported.presets);
        }
        let paths: Vec<PathBuf> =
            file_stems(&presets).iter().map(|stem| self.output.join(format!("{stem}.json"))).collect();
        if let Some(path) = paths.iter().find(|path| !self.force && path.exists()) {
            bail!("{} is there already; --force replaces it", path.display());
        }
        std::fs::create_dir_all(&self.output).with_context(|| self.output.display().to_string())?;
        for (preset, path) in presets.iter().zip(&paths) {
            preset.save(path)?;
        }
        let text = table(&presets, &paths).render(self.format.format());
        Ok(Output { text, warnings, ..Output::default() })
    }
}

fn table(presets: &[Preset], paths: &[PathBuf]) -> Table {
    let mut table = Table::new([("name", "name"), ("space", "space"), ("file", "file")]);
    for (preset, path) in presets.iter().zip(paths) {
        let file = Cell::Text(path.display().to_string());
        table.push(vec![preset.name.as_str().into(), preset.space.id().into(), file]);
    }
    table
}
