//! `edgewise export --plan`: the materials of a scene, without what it does not need.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use serde_json::json;

use super::output::{Cell, Format, Output, Table};
use super::shard::Shard;
use crate::color::RgbSpace;
use crate::export::{Options, Target};
use crate::file::replace_file;
use crate::preset::pretty_json;
use crate::scene::{PlannedFile, SavedPlan};
use crate::study::Variant;

/// Where files go.
pub(super) struct Destination<'a> {
    pub folder: &'a Path,
    pub force: bool,
    pub strict: bool,
    pub space: Option<RgbSpace>,
    pub shard: Shard,
}

/// A file and where it goes.
type Placed = (PathBuf, PlannedFile);

/// Everything is made before anything is written: an error leaves no half of a batch.
pub(super) fn export_plan(
    path: &Path,
    targets: &[Target],
    to: &Destination<'_>,
    format: Format,
) -> anyhow::Result<Output> {
    let options = Options { space: to.space };
    let SavedPlan { plan, scene } = SavedPlan::load(path)?;
    let scene = scene.ok().map(|scene| scene.scene_materials());
    let made = plan.export(scene.as_deref(), targets, &options, |position| to.shard.takes(position))?;
    let place = |file: PlannedFile| (to.folder.join(&file.name), file);
    let (files, warnings): (Vec<Placed>, Vec<String>) = (made.files.into_iter().map(place).collect(), made.losses);
    write(&files, &warnings, to)?;
    let text = match format {
        Format::Json => pretty_json(&documents(targets, &files)),
        format => table(&files).render(format),
    };
    Ok(Output { text, warnings, ..Output::default() })
}

fn write(files: &[Placed], warnings: &[String], to: &Destination<'_>) -> anyhow::Result<()> {
    if let Some(first) = warnings.first().filter(|_| to.strict) {
        bail!("{first}; with --strict nothing was written ({} losses)", warnings.len());
    }
    if let Some((path, _)) = files.iter().find(|(path, _)| !to.force && path.exists()) {
        bail!("{} is there already; --force replaces it", path.display());
    }
    std::fs::create_dir_all(to.folder).with_context(|| to.folder.display().to_string())?;
    for (path, file) in files {
        replace_file(path, &file.bytes)?;
    }
    Ok(())
}

fn table(files: &[Placed]) -> Table {
    let mut table = Table::new([("target", "target"), ("file", "file"), ("variant", "says"), ("bytes", "bytes")]);
    for (path, file) in files {
        let bytes = Cell::Count(file.bytes.len() as u64);
        let path = Cell::Text(path.display().to_string());
        table.push(vec![file.target.id().into(), path, Cell::Text(file.variant.id()), bytes]);
    }
    table
}

fn documents(targets: &[Target], files: &[Placed]) -> serde_json::Value {
    let of_target = |target: &Target| {
        let own = || files.iter().filter(|(_, file)| file.target == *target);
        let paths: Vec<String> = own().map(|(path, _)| path.display().to_string()).collect();
        let variants: Vec<Variant> = own().map(|(_, file)| file.variant).collect();
        json!({ "target": target.id(), "files": paths, "variants": variants })
    };
    targets.iter().map(of_target).collect()
}
