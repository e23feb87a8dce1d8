//! `edgewise export --plan`: the materials of a scene, without what it does not need.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use serde_json::json;

use super::output::{Cell, Format, Output, Table};
use super::shard::Shard;
use crate::color::RgbSpace;
use crate::export::{Kept, Options, Target, export_kept, file_stems};
use crate::file::replace_file;
use crate::fresnel::ModelKind;
use crate::preset::{Preset, pretty_json};
use crate::scene::{MaterialPlan, Plan};
use crate::study::Variant;

/// Where files go.
pub(super) struct Destination<'a> {
    pub folder: &'a Path,
    pub force: bool,
    pub strict: bool,
    pub space: Option<RgbSpace>,
    pub shard: Shard,
}

/// A file that is to be written.
struct Planned {
    target: Target,
    path: PathBuf,
    bytes: Vec<u8>,
    variant: Variant,
}

/// Everything is made before anything is written: an error leaves no half of a batch.
pub(super) fn export_plan(
    path: &Path,
    targets: &[Target],
    to: &Destination<'_>,
    format: Format,
) -> anyhow::Result<Output> {
    if let Some(palette) = targets.iter().find(|target| target.is_palette()) {
        bail!("{palette} is a palette, which holds no curve that a plan could shorten");
    }
    let plan = Plan::load(path)?;
    let presets: Vec<Preset> = plan.materials.iter().map(|material| material.preset(plan.space)).collect();
    let stems = file_stems(&presets);
    let options = Options { space: to.space };
    let (mut files, mut warnings) = (Vec::new(), Vec::new());
    for &target in targets {
        let materials = plan.materials.iter().zip(&presets).zip(&stems).enumerate();
        let mine = materials.filter(|(position, _)| to.shard.takes(*position));
        for (_, ((material, preset), stem)) in mine {
            let (kept, variant) = kept(material, target, &plan, &mut warnings);
            let exported = export_kept(stem, preset, target, &options, kept)?;
            warnings.extend(exported.losses.iter().map(|loss| format!("{target}: {loss}")));
            let files_of = exported.files.into_iter();
            files.extend(files_of.map(|f| Planned { target, path: to.folder.join(f.name), bytes: f.bytes, variant }));
        }
    }
    write(&files, &warnings, to)?;
    let text = match format {
        Format::Json => pretty_json(&documents(targets, &files)),
        format => table(&files).render(format),
    };
    Ok(Output { text, warnings, ..Output::default() })
}

/// The least that the target can say and that stays within the tolerance; where nothing does, r and h, with a warning.
fn kept(material: &MaterialPlan, target: Target, plan: &Plan, warnings: &mut Vec<String>) -> (Kept, Variant) {
    let said = |variant: Variant| match variant {
        Variant::Model(ModelKind::Constant, _) => Some(Kept::Constant),
        Variant::Model(ModelKind::Schlick, _) => Some(Kept::Schlick),
        Variant::HOFFMAN => Some(Kept::Whole),
        _ => None,
    };
    let within = material.judgements.iter().filter(|j| j.error.is_within(plan.tolerance));
    let mut candidates = within.filter_map(|j| said(j.variant).map(|kept| (kept, j.variant)));
    if let Some(found) = candidates.find(|(kept, _)| target.can_keep(*kept)) {
        return found;
    }
    if let Some(hoffman) = material.judgements.iter().find(|j| j.variant == Variant::HOFFMAN) {
        let measure = plan.tolerance.on;
        warnings.push(format!(
            "{target}: {}: the plan wants {}, which this target does not take; with r and h the {} is {:.2}, above {}",
            material.name,
            material.chosen,
            measure.label(),
            hoffman.error.of(measure),
            plan.tolerance.delta_e
        ));
    }
    (Kept::Whole, Variant::HOFFMAN)
}

fn write(files: &[Planned], warnings: &[String], to: &Destination<'_>) -> anyhow::Result<()> {
    if let Some(first) = warnings.first().filter(|_| to.strict) {
        bail!("{first}; with --strict nothing was written ({} losses)", warnings.len());
    }
    if let Some(file) = files.iter().find(|file| !to.force && file.path.exists()) {
        bail!("{} is there already; --force replaces it", file.path.display());
    }
    std::fs::create_dir_all(to.folder).with_context(|| to.folder.display().to_string())?;
    for file in files {
        replace_file(&file.path, &file.bytes)?;
    }
    Ok(())
}

fn table(files: &[Planned]) -> Table {
    let mut table = Table::new([("target", "target"), ("file", "file"), ("variant", "says"), ("bytes", "bytes")]);
    for file in files {
        let bytes = Cell::Count(file.bytes.len() as u64);
        let path = Cell::Text(file.path.display().to_string());
        table.push(vec![file.target.id().into(), path, Cell::Text(file.variant.id()), bytes]);
    }
    table
}

fn documents(targets: &[Target], files: &[Planned]) -> serde_json::Value {
    let of_target = |target: &Target| {
        let own = || files.iter().filter(|file| file.target == *target);
        let paths: Vec<String> = own().map(|file| file.path.display().to_string()).collect();
        let variants: Vec<Variant> = own().map(|file| file.variant).collect();
        json!({ "target": target.id(), "files": paths, "variants": variants })
    };
    targets.iter().map(of_target).collect()
}
