//! Many presets in one run: looked at once for their names, then read, written and forgotten one by one.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use indicatif::ProgressBar;
use rayon::prelude::*;

use crate::cli::preset_files::Listed;
use crate::cli::shard::Shard;
use crate::color::RgbSpace;
use crate::export::{
    ExportFile, Exported, Loss, NameKey, Options, Target, check, export_all, export_as, export_baked, file_name,
    palette_stem, unique_stems,
};
use crate::file::{Placed, place_file};
use crate::metal::Metal;
use crate::preset::{FormatError, Loaded, Preset, PresetFileError};

/// Where a preset comes from; it is read again when its turn comes.
#[derive(Clone, Debug)]
pub(super) enum Source {
    File(Listed),
    Metal(&'static Metal, RgbSpace),
    /// A metal that is written as a function of its own.
    Baked(&'static Metal, RgbSpace),
}

impl Source {
    /// The preset; `None` for a JSON file of a folder that is something else.
    fn load(&self) -> anyhow::Result<Option<Loaded>> {
        match self {
            Self::Metal(metal, space) | Self::Baked(metal, space) => {
                Ok(Some(Loaded { preset: Preset::from_metal(metal, *space), warnings: Vec::new() }))
            }
            Self::File(file) => match Preset::load(&file.path) {
                Err(PresetFileError::Format { reason: FormatError::NoPreset, .. }) if file.is_of_folder => Ok(None),
                loaded => Ok(Some(loaded?)),
            },
        }
    }

    /// What it is called, and what it is sorted by.
    fn name(&self) -> String {
        match self {
            Self::File(file) => file.path.display().to_string(),
            Self::Metal(metal, _) | Self::Baked(metal, _) => metal.id.clone(),
        }
    }

    fn preset(&self) -> anyhow::Result<Preset> {
        let loaded = self.load()?;
        Ok(loaded.context("a file that was a preset is none any more")?.preset)
    }
}

/// What is kept of a preset between the two readings.
struct Seen {
    source: Source,
    name: String,
    key: NameKey,
    space: RgbSpace,
    warnings: Vec<String>,
}

/// One file to write.
#[derive(Debug)]
pub(super) struct Step {
    pub target: Target,
    pub path: PathBuf,
    stem: String,
    /// One preset, or all of a palette.
    sources: Vec<Source>,
}

/// A file that was written.
#[derive(Debug)]
pub(super) struct Written {
    pub bytes: u64,
    pub losses: Vec<Loss>,
    pub placed: Placed,
}

/// Everything a batch will write, and what there is to say before it does.
#[derive(Debug)]
pub(super) struct Batch {
    pub steps: Vec<Step>,
    pub warnings: Vec<String>,
    options: Options,
}

impl Batch {
    /// Reads every preset once. Whatever cannot be exported is found here, before anything is written.
    ///
    /// The names depend on all presets, so that each of several shards calls its files as one process would.
    pub(super) fn new(
        sources: Vec<Source>,
        targets: &[Target],
        options: Options,
        shard: Shard,
        bar: &ProgressBar,
    ) -> anyhow::Result<Self> {
        bar.set_length(sources.len() as u64);
        let looked: Vec<Result<Seen, Source>> = sources
            .into_par_iter()
            .map(|source| {
                bar.inc(1);
                look(source, targets, &options)
            })
            .collect::<anyhow::Result<_>>()?;
        bar.finish_and_clear();
        let (mut seen, mut warnings) = (Vec::new(), Vec::new());
        for look in looked {
            match look {
                Ok(preset) => seen.push(preset),
                Err(other) => warnings.push(format!("{} is no preset and was passed over", other.name())),
            }
        }
        if seen.is_empty() {
            bail!("there is no preset to export");
        }
        warnings.extend(seen.iter_mut().flat_map(|seen| std::mem::take(&mut seen.warnings)));
        let mut batch = Self { steps: Vec::new(), warnings, options };
        let palette: Vec<Source> = seen.iter().map(|seen| seen.source.clone()).collect();
        seen.sort_by_cached_key(|seen| seen.source.name());
        batch.name_files(&seen, &palette, targets, shard)?;
        Ok(batch)
    }

    /// A palette keeps the order in which presets were given; for everything else that order means nothing.
    fn name_files(
        &mut self,
        seen: &[Seen],
        palette: &[Source],
        targets: &[Target],
        shard: Shard,
    ) -> anyhow::Result<()> {
        let keys: Vec<NameKey> = seen.iter().map(|seen| seen.key.clone()).collect();
        let stems = unique_stems(&keys);
        for &target in targets {
            if target.is_palette() {
                let stem = palette_stem(seen.iter().map(|seen| seen.name.as_str()));
                let path = file_name(&stem, target, RgbSpace::default(), &self.options)?.into();
                self.steps.push(Step { target, path, stem, sources: palette.to_vec() });
                continue;
            }
            let mine = seen.iter().zip(&stems).enumerate().filter(|(position, _)| shard.takes(*position));
            for (_, (seen, stem)) in mine {
                let path = file_name(stem, target, seen.space, &self.options)?.into();
                self.steps.push(Step { target, path, stem: stem.clone(), sources: vec![seen.source.clone()] });
            }
        }
        if !targets.iter().all(|target| target.is_palette()) {
            self.warnings.extend(renamed(seen, &stems));
        }
        Ok(())
    }

    /// Puts every file into a folder.
    pub(super) fn place_in(&mut self, folder: &Path) {
        let folder = if folder == Path::new(".") { Path::new("") } else { folder };
        for step in &mut self.steps {
            step.path = folder.join(&step.path);
        }
    }

    /// Refuses a batch that would lose something.
    pub(super) fn refuse_losses(&self) -> anyhow::Result<()> {
        let losses = |step: &Step| Ok(step.make(&self.options)?.1.first().map(|loss| step.sentence(loss)));
        let lossy: Vec<Option<String>> = self.steps.par_iter().map(losses).collect::<anyhow::Result<_>>()?;
        let mut lossy = lossy.into_iter().flatten();
        match lossy.next() {
            Some(first) => {
                bail!("{first}; with --strict nothing was written ({} files would lose something)", 1 + lossy.count())
            }
            None => Ok(()),
        }
    }

    /// Refuses a batch that would replace a file.
    pub(super) fn refuse_to_replace(&self) -> anyhow::Result<()> {
        let mut existing = self.steps.iter().map(|step| &step.path).filter(|path| path.exists());
        match existing.next() {
            Some(first) => {
                let count = 1 + existing.count();
                bail!("{} is there already ({count} files are); --force replaces them", first.display())
            }
            None => Ok(()),
        }
    }

    /// Writes everything, in parallel; what comes back is in the order of the steps.
    pub(super) fn write(&self, may_replace: bool, bar: &ProgressBar) -> anyhow::Result<Vec<Written>> {
        bar.set_length(self.steps.len() as u64);
        let write = |step: &Step| {
            let (file, losses) = step.make(&self.options)?;
            let placed = place_file(&step.path, &file.bytes, may_replace)?;
            bar.inc(1);
            Ok(Written { bytes: file.bytes.len() as u64, losses, placed })
        };
        let written = self.steps.par_iter().map(write).collect();
        bar.finish_and_clear();
        written
    }
}

/// A first reading; the source itself where it is no preset.
fn look(source: Source, targets: &[Target], options: &Options) -> anyhow::Result<Result<Seen, Source>> {
    let Some(Loaded { preset, warnings }) = source.load()? else { return Ok(Err(source)) };
    targets.iter().try_for_each(|&target| check(&preset, target, options))?;
    let (key, space) = (NameKey::of(&preset), preset.space);
    Ok(Ok(Seen { source, name: preset.name, key, space, warnings }))
}

/// A sentence where names met, so that files are not called what one expects.
fn renamed(seen: &[Seen], stems: &[String]) -> Option<String> {
    let mut renamed = seen.iter().zip(stems).filter(|(seen, stem)| seen.key.stem != **stem);
    let (seen, stem) = renamed.next()?;
    let count = 1 + renamed.count();
    Some(format!("{count} presets share their file names with others; “{}” is written as {stem}", seen.name))
}

impl Step {
    fn make(&self, options: &Options) -> anyhow::Result<(ExportFile, Vec<Loss>)> {
        let Exported { mut files, losses } = match &self.sources[..] {
            [Source::Baked(metal, _)] => export_baked(&self.stem, metal, self.target, options)?,
            [source] => export_as(&self.stem, &source.preset()?, self.target, options)?,
            sources => {
                let presets = sources.iter().map(Source::preset).collect::<anyhow::Result<Vec<_>>>()?;
                export_all(&presets, self.target, options)?
            }
        };
        Ok((files.pop().context("an export without a file")?, losses))
    }

    /// A loss, with the target it is about.
    pub(super) fn sentence(&self, loss: &Loss) -> String {
        format!("{}: {loss}", self.target)
    }
}
