//! `edgewise export`: presets as files for renderers.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args;
use serde_json::json;

use super::export_plan::{Destination, export_plan};
use super::output::{Cell, Format, FormatArguments, Output, Table};
use super::study::progress_bar;
use crate::color::RgbSpace;
use crate::export::{Exported, Options, Target, export_all, file_stems};
use crate::file::replace_file;
use crate::metal::metal_by_name;
use crate::preset::{Preset, pretty_json};

/// Arguments of `edgewise export`.
#[derive(Debug, Args)]
pub struct Export {
    /// Preset files
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
    /// List the targets with what their readers do
    #[arg(long)]
    list: bool,
    #[command(flatten)]
    format: FormatArguments,
}

impl Export {
    pub(super) fn run(mut self) -> anyhow::Result<Output> {
        if self.list {
            return Ok(Output { text: targets().render(self.format.format()), ..Output::default() });
        }
        if let Some(plan) = &self.plan {
            let to = Destination { folder: &self.output, force: self.force, strict: self.strict, space: self.space };
            return export_plan(plan, &self.targets, &to, self.format.format());
        }
        let (presets, mut warnings) = self.presets()?;
        let mut exports = self.exports(&presets)?;
        self.name_the_file(&mut exports)?;
        warnings.extend(self.renamed(&presets));
        self.refuse_losses(&exports)?;
        self.refuse_to_replace(&exports)?;
        std::fs::create_dir_all(&self.output).with_context(|| self.output.display().to_string())?;
        self.write_all(&exports)?;
        warnings.extend(exports.iter().flat_map(|(target, exported)| sentences(*target, exported)));
        let text = match self.format.format() {
            Format::Json => pretty_json(&exports.iter().map(|export| self.document(export)).collect()),
            format => self.table(&exports).render(format),
        };
        Ok(Output { text, warnings, ..Output::default() })
    }

    fn presets(&self) -> anyhow::Result<(Vec<Preset>, Vec<String>)> {
        let (mut presets, mut warnings) = (Vec::new(), Vec::new());
        for path in &self.presets {
            let loaded = Preset::load(path)?;
            presets.push(loaded.preset);
            warnings.extend(loaded.warnings);
        }
        for name in &self.metal {
            presets.push(Preset::from_metal(metal_by_name(name)?, self.space.unwrap_or_default()));
        }
        Ok((presets, warnings))
    }

    /// Everything is made before anything is written: an error leaves no half of a batch.
    fn exports(&self, presets: &[Preset]) -> anyhow::Result<Vec<(Target, Exported)>> {
        let options = Options { space: self.space };
        self.targets.iter().map(|&target| Ok((target, export_all(presets, target, &options)?))).collect()
    }

    /// `-o FILE`: a name that ends as the target's files do is that of the one file, unless it is a folder.
    fn name_the_file(&mut self, exports: &mut [(Target, Exported)]) -> anyhow::Result<()> {
        let extension = self.output.extension().map(|extension| extension.to_ascii_lowercase());
        let is_file = |target: &Target| extension.as_deref().is_some_and(|e| e == target.extension());
        if self.output.is_dir() || !self.targets.iter().any(is_file) {
            return Ok(());
        }
        let path = self.output.display();
        let mut files = exports.iter_mut().flat_map(|(_, exported)| &mut exported.files);
        let (Some(file), None) = (files.next(), files.next()) else {
            bail!("{path} is the name of one file, and this export has several; -o takes a folder for them");
        };
        let name = self.output.file_name().and_then(|name| name.to_str());
        file.name = name.with_context(|| format!("{path} is no file name in UTF-8"))?.to_owned();
        let folder = self.output.parent().filter(|folder| !folder.as_os_str().is_empty());
        self.output = folder.unwrap_or(Path::new(".")).to_path_buf();
        Ok(())
    }

    /// A sentence where names met, so that files are not called what one expects.
    fn renamed(&self, presets: &[Preset]) -> Option<String> {
        if self.targets.iter().all(|target| target.is_palette()) {
            return None;
        }
        let stems = file_stems(presets);
        let mut renamed = presets.iter().zip(&stems).filter(|(preset, stem)| preset.file_stem() != **stem);
        let (preset, stem) = renamed.next()?;
        let count = 1 + renamed.count();
        Some(format!("{count} presets share their file names with others; “{}” is written as {stem}", preset.name))
    }

    fn write_all(&self, exports: &[(Target, Exported)]) -> anyhow::Result<()> {
        let bar = progress_bar("Writing");
        bar.set_length(exports.iter().map(|(_, exported)| exported.files.len() as u64).sum());
        for file in exports.iter().flat_map(|(_, exported)| &exported.files) {
            self.write(&self.output.join(&file.name), &file.bytes)?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(())
    }

    /// A file that can be made again is not waited for until it is on the disk: of ten thousand, that takes minutes.
    fn write(&self, path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
        if path.exists() {
            return Ok(replace_file(path, bytes)?);
        }
        let new = File::options().write(true).create_new(true).open(path);
        new.and_then(|mut file| file.write_all(bytes)).with_context(|| path.display().to_string())
    }

    fn refuse_losses(&self, exports: &[(Target, Exported)]) -> anyhow::Result<()> {
        let losses: Vec<String> = exports.iter().flat_map(|(target, exported)| sentences(*target, exported)).collect();
        match losses.first() {
            Some(first) if self.strict => bail!("{first}; with --strict nothing was written ({} losses)", losses.len()),
            _ => Ok(()),
        }
    }

    fn refuse_to_replace(&self, exports: &[(Target, Exported)]) -> anyhow::Result<()> {
        let names = exports.iter().flat_map(|(_, exported)| &exported.files).map(|file| &file.name);
        let existing: Vec<&String> = names.filter(|name| self.output.join(name).exists()).collect();
        match existing.first() {
            Some(first) if !self.force => {
                bail!("{} is there already ({} files are); --force replaces them", self.path(first), existing.len())
            }
            _ => Ok(()),
        }
    }

    fn path(&self, name: &str) -> String {
        let folder = if self.output == Path::new(".") { Path::new("") } else { &self.output };
        folder.join(name).display().to_string()
    }

    fn table(&self, exports: &[(Target, Exported)]) -> Table {
        let mut table = Table::new([("target", "target"), ("file", "file"), ("bytes", "bytes")]);
        for (target, exported) in exports {
            for file in &exported.files {
                let bytes = Cell::Count(file.bytes.len() as u64);
                table.push(vec![target.id().into(), Cell::Text(self.path(&file.name)), bytes]);
            }
        }
        table
    }

    fn document(&self, (target, exported): &(Target, Exported)) -> serde_json::Value {
        let files: Vec<String> = exported.files.iter().map(|file| self.path(&file.name)).collect();
        let warnings: Vec<String> = sentences(*target, exported).collect();
        json!({ "target": target.id(), "files": files, "losses": exported.losses, "warnings": warnings })
    }
}

fn sentences(target: Target, exported: &Exported) -> impl Iterator<Item = String> {
    exported.losses.iter().map(move |loss| format!("{target}: {loss}"))
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
