//! `edgewise export`: presets as files for renderers.

mod batch;

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args;
use serde_json::json;

use self::batch::{Batch, Source, Step, Written};
use super::export_plan::{Destination, export_plan};
use super::output::{Cell, Format, FormatArguments, Output, Table};
use super::preset_files::listed;
use super::progress::progress_bar;
use super::shard::Shard;
use super::usage;
use crate::color::RgbSpace;
use crate::export::{Loss, Options, Target};
use crate::file::Placed;
use crate::metal::metal_by_name;
use crate::preset::pretty_json;

/// Arguments of `edgewise export`.
#[derive(Debug, Args)]
pub struct Export {
    /// Preset files, or folders of them
    #[arg(required_unless_present_any = ["metal", "list", "plan"])]
    presets: Vec<PathBuf>,
    /// A metal of the library by its exact r and h; may be given again
    #[arg(long, value_name = "ID")]
    metal: Vec<String>,
    /// The materials of a scene as `edgewise plan -o` saved it, without h where it needs none
    #[arg(long, value_name = "FILE", conflicts_with_all = ["presets", "metal"])]
    plan: Option<PathBuf>,
    /// What to write; may be given again. --list says what there is
    #[arg(long = "to", value_name = "TARGET", required_unless_present = "list")]
    targets: Vec<Target>,
    /// The working space of the reader; lin_rec709 unless given
    #[arg(long)]
    space: Option<RgbSpace>,
    /// The folder to write into, created where missing; or, for one file, its name with the target's extension
    #[arg(long, short, value_name = "DIR|FILE", default_value = ".")]
    output: PathBuf,
    /// Replace files that are there
    #[arg(long)]
    force: bool,
    /// Refuse to write anything that loses something
    #[arg(long)]
    strict: bool,
    /// Write only the i-th of n parts of the batch, as one of n processes that share it
    #[arg(long, value_name = "I/N", default_value = "1/1", hide_default_value = true)]
    shard: Shard,
    /// Write each metal as r and ten coefficients for each channel, nearer to it than r and h: a function in glsl, hlsl,
    /// wgsl or osl
    #[arg(long, requires = "metal", conflicts_with_all = ["presets", "plan"])]
    bake: bool,
    /// List the targets with what their readers do
    #[arg(long)]
    list: bool,
    #[command(flatten)]
    format: FormatArguments,
}

impl Export {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        if self.list {
            return Ok(Output { text: targets().render(self.format.format()), ..Output::default() });
        }
        if let Some(plan) = &self.plan {
            let (folder, force, strict) = (self.output.as_path(), self.force, self.strict);
            let to = Destination { folder, force, strict, space: self.space, shard: self.shard };
            return export_plan(plan, &self.targets, &to, self.format.format());
        }
        let mut batch = self.batch()?;
        let folder = self.name_files(&mut batch)?;
        if self.strict {
            batch.refuse_losses()?;
        }
        if !self.force {
            batch.refuse_to_replace()?;
        }
        std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
        let written = batch.write(self.force, &progress_bar("Writing"))?;
        let each: Vec<(&Step, &Written)> = batch.steps.iter().zip(&written).collect();
        let text = match self.format.format() {
            Format::Json => pretty_json(&self.documents(&each)),
            format => table(&each).render(format),
        };
        let mut warnings = batch.warnings.clone();
        warnings.extend(each.iter().flat_map(|(step, written)| sentences(step, written)));
        Ok(Output { text, warnings, ..Output::default() })
    }

    /// The targets asked for, each once.
    fn targets(&self) -> Vec<Target> {
        let mut targets = Vec::new();
        for &target in &self.targets {
            if !targets.contains(&target) {
                targets.push(target);
            }
        }
        targets
    }

    fn batch(&self) -> anyhow::Result<Batch> {
        let targets = self.targets();
        if let Some(palette) = targets.iter().find(|target| target.is_palette()).filter(|_| !self.shard.is_whole()) {
            return Err(usage(&format!("--shard cannot divide {palette}, which is one file of all presets")));
        }
        if let Some(target) = targets.iter().find(|target| self.bake && !target.can_bake()) {
            return Err(usage(&format!("--bake writes glsl, hlsl, wgsl and osl, not {target}")));
        }
        let mut sources: Vec<Source> = listed(&self.presets)?.into_iter().map(Source::File).collect();
        for name in &self.metal {
            let (metal, space) = (metal_by_name(name)?, self.space.unwrap_or_default());
            sources.push(if self.bake { Source::Baked(metal, space) } else { Source::Metal(metal, space) });
        }
        Batch::new(sources, &targets, Options { space: self.space }, self.shard, &progress_bar("Reading"))
    }

    /// Says where the files go, and returns their folder. `-o FILE`: a name that ends as the target's files do is that
    /// of the one file, unless it is a folder.
    fn name_files(&self, batch: &mut Batch) -> anyhow::Result<PathBuf> {
        let extension = self.output.extension().map(|extension| extension.to_ascii_lowercase());
        let is_file = |target: &Target| extension.as_deref().is_some_and(|e| e == target.extension());
        if self.output.is_dir() || !self.targets.iter().any(is_file) {
            batch.place_in(&self.output);
            return Ok(self.output.clone());
        }
        let [step] = &mut batch.steps[..] else {
            let path = self.output.display();
            bail!("{path} is the name of one file, and this export has several; -o takes a folder for them");
        };
        step.path.clone_from(&self.output);
        let folder = self.output.parent().filter(|folder| !folder.as_os_str().is_empty());
        Ok(folder.unwrap_or(Path::new(".")).to_path_buf())
    }

    fn documents(&self, each: &[(&Step, &Written)]) -> serde_json::Value {
        let of_target = |target: Target| {
            let own: Vec<_> = each.iter().filter(|(step, _)| step.target == target).collect();
            let files: Vec<String> = own.iter().map(|(step, _)| step.path.display().to_string()).collect();
            let losses: Vec<&Loss> = own.iter().flat_map(|(_, written)| &written.losses).collect();
            let warnings: Vec<String> = own.iter().flat_map(|(step, written)| sentences(step, written)).collect();
            let unchanged = own.iter().filter(|(_, written)| written.placed == Placed::Same).count();
            json!({
                "target": target.id(), "files": files, "unchanged": unchanged, "losses": losses, "warnings": warnings,
            })
        };
        self.targets().into_iter().map(of_target).collect()
    }
}

fn table(each: &[(&Step, &Written)]) -> Table {
    let mut table = Table::new([("target", "target"), ("file", "file"), ("bytes", "bytes")]);
    for (step, written) in each {
        let path = Cell::Text(step.path.display().to_string());
        table.push(vec![step.target.id().into(), path, Cell::Count(written.bytes)]);
    }
    table
}

fn sentences(step: &Step, written: &Written) -> Vec<String> {
    written.losses.iter().map(|loss| step.sentence(loss)).collect()
}

fn targets() -> Table {
    let mut table = Table::new([
        ("target", "target"),
        ("label", "writes"),
        ("extension", "extension"),
        ("spaces", "spaces"),
        ("note", "what its readers do"),
    ]);
    for target in Target::ALL {
        let spaces: Vec<&str> = target.spaces().iter().map(|space| space.id()).collect();
        table.push(vec![
            target.id().into(),
            target.label().into(),
            target.extension().into(),
            Cell::Text(spaces.join(" ")),
            target.note().into(),
        ]);
    }
    table
}
