//! `edgewise samples`: the rendered photographs inside the program.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use serde_json::json;

use super::match_photo::MatchCommand;
use super::output::{Cell, Format, FormatArguments, Output, Table};
use crate::file::replace_file;
use crate::preset::pretty_json;
use crate::sample::{Sample, render_all, samples};

/// Arguments of `edgewise samples`.
#[derive(Debug, Args)]
pub struct Samples {
    /// Render the photographs again and write them with their sidecars into this folder
    #[arg(long, value_name = "DIR")]
    write: Option<PathBuf>,
    /// Match this sample with its own marks and write preset, curve and swatches into --output
    #[arg(long = "match", value_name = "ID", conflicts_with = "write")]
    matched: Option<String>,
    /// The folder of --match; created where missing
    #[arg(long, short, value_name = "DIR", default_value = ".", requires = "matched")]
    output: PathBuf,
    /// Replace files of --match that are there
    #[arg(long, requires = "matched")]
    force: bool,
    #[command(flatten)]
    format: FormatArguments,
}

impl Samples {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        if let Some(id) = &self.matched {
            std::fs::create_dir_all(&self.output).with_context(|| self.output.display().to_string())?;
            return MatchCommand::of_sample_into(id, &self.output, self.force, self.format).run();
        }
        let text = match (&self.write, self.format.format()) {
            (Some(folder), format) => write_all(folder)?.render(format),
            (None, Format::Json) => pretty_json(&samples().iter().map(document).collect()),
            (None, format) => list().render(format),
        };
        Ok(Output { text, ..Output::default() })
    }
}

fn write_all(folder: &Path) -> anyhow::Result<Table> {
    std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    let mut table = Table::new([("file", "file"), ("bytes", "bytes")]);
    for rendered in render_all()? {
        for (name, bytes) in rendered.files()? {
            let path = folder.join(name);
            replace_file(&path, &bytes)?;
            table.push(vec![Cell::Text(path.display().to_string()), Cell::Count(bytes.len() as u64)]);
        }
    }
    Ok(table)
}

fn document(sample: &Sample) -> serde_json::Value {
    let mut value = json!({ "id": sample.id });
    if let (Some(value), serde_json::Value::Object(facts)) = (value.as_object_mut(), json!(sample.facts)) {
        value.extend(facts);
    }
    value
}

fn list() -> Table {
    let mut table = Table::new([
        ("id", "id"),
        ("metal", "metal"),
        ("rendered", "rendered"),
        ("title", "title"),
        ("description", "description"),
    ]);
    for sample in samples() {
        table.push(vec![
            sample.id.into(),
            sample.facts.metal.as_str().into(),
            Cell::Flag(sample.facts.rendered),
            sample.facts.title.as_str().into(),
            sample.facts.description.as_str().into(),
        ]);
    }
    table
}
