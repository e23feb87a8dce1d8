//! `edgewise presets`: the presets that ship with the program.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;

use super::output::{Cell, Format, FormatArguments, Output, Table};
use crate::preset::{Preset, built_in_presets, presets_from_metals, pretty_json};

/// Arguments of `edgewise presets`.
#[derive(Debug, Args)]
pub struct Presets {
    /// Compute the presets anew from the measured metals and write one file each into this folder
    #[arg(long, value_name = "DIR")]
    write: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArguments,
}

impl Presets {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let text = match (&self.write, self.format.format()) {
            (Some(folder), format) => write_all(folder)?.render(format),
            (None, Format::Json) => pretty_json(&documents()?),
            (None, format) => list().render(format),
        };
        Ok(Output { text, ..Output::default() })
    }
}

fn write_all(folder: &Path) -> anyhow::Result<Table> {
    std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    let mut table = Table::new([("name", "name"), ("file", "file")]);
    for preset in presets_from_metals() {
        let path = folder.join(preset.file_stem()).with_extension("json");
        preset.save(&path)?;
        table.push(vec![preset.name.as_str().into(), Cell::Text(path.display().to_string())]);
    }
    Ok(table)
}

/// The documents themselves, as their files hold them.
fn documents() -> anyhow::Result<serde_json::Value> {
    built_in_presets().iter().map(|preset| Ok(serde_json::from_str::<serde_json::Value>(&preset.to_json()?)?)).collect()
}

fn list() -> Table {
    let mut table = Table::new([
        ("name", "name"),
        ("space", "space"),
        ("r_red", "r red"),
        ("r_green", "green"),
        ("r_blue", "blue"),
        ("h_red", "h red"),
        ("h_green", "green"),
        ("h_blue", "blue"),
        ("roughness", "roughness"),
    ]);
    for preset in built_in_presets() {
        table.push(row(preset));
    }
    table
}

fn row(preset: &Preset) -> Vec<Cell> {
    let mut row = vec![preset.name.as_str().into(), preset.space.id().into()];
    row.extend([preset.r, preset.h].iter().flat_map(|rgb| rgb.0).map(|value| Cell::Number(value, 4)));
    row.push(Cell::Number(preset.roughness, 2));
    row
}
