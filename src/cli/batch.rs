//! `edgewise match` over many photographs: one line of JSON each.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use rayon::prelude::*;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::marks::Marks;
use super::match_photo::MatchCommand;
use super::output::{Format, Output, complain, print_line, sentence};
use super::progress::progress_bar;
use super::usage;
use crate::file::other_kind;
use crate::photo::Untagged;
use crate::preset::Preset;

/// File names that end in one of these are taken for photographs.
const EXTENSIONS: [&str; 9] = ["png", "jpg", "jpeg", "tif", "tiff", "webp", "exr", "hdr", "pic"];

/// Matches every photograph. One that fails is said and does not stop the rest.
pub(super) fn run(command: &MatchCommand) -> anyhow::Result<Output> {
    if matches!(command.format.chosen(), Some(Format::Table | Format::Csv)) {
        return Err(usage("several photographs give one line of JSON each; there is no other format for them"));
    }
    let (photos, mut warnings) = photographs(&command.photos)?;
    if photos.is_empty() {
        bail!("there is no photograph in {}", command.photos[0].display());
    }
    let marks = command.marks.marks()?;
    let task = task(command, &marks);
    let jobs = jobs(command, photos);
    warnings.extend(renamed(&jobs));
    let mut results = Results::open(command.results.as_deref(), &task)?;
    let bar = progress_bar("Matching");
    bar.set_length(jobs.len() as u64);
    let mut failed = 0;
    // As many at a time as there are threads: lines come in the order of the files, whatever their number.
    for some in jobs.chunks(rayon::current_num_threads()) {
        let lines: Vec<Value> = some.par_iter().map(|job| line(command, job, &marks, &task, &results)).collect();
        for line in lines {
            bar.inc(1);
            if let Some(error) = line["error"].as_str() {
                failed += 1;
                bar.suspend(|| complain(error));
            }
            results.append(&line)?;
            bar.suspend(|| print_line(&line.to_string()))?;
        }
    }
    bar.finish_and_clear();
    if failed > 0 {
        warnings.push(format!("{failed} of {} photographs failed", jobs.len()));
    }
    Ok(Output { warnings, is_partial: failed > 0, ..Output::default() })
}

/// The files given, and those of folders by name; and a sentence about what was left out of these.
fn photographs(paths: &[PathBuf]) -> anyhow::Result<(Vec<PathBuf>, Vec<String>)> {
    let (mut photos, mut warnings) = (Vec::new(), Vec::new());
    for path in paths {
        if !path.is_dir() {
            photos.push(path.clone());
            continue;
        }
        let entries = fs::read_dir(path).with_context(|| path.display().to_string())?;
        let mut files = entries.map(|entry| Ok(entry?.path())).collect::<std::io::Result<Vec<_>>>()?;
        files.retain(|file| file.is_file());
        files.sort();
        let (of_folder, others): (Vec<_>, Vec<_>) = files.into_iter().partition(|file| is_photograph(file));
        if !others.is_empty() {
            warnings.push(format!("{}: {} files are no photographs by their names", path.display(), others.len()));
        }
        photos.extend(of_folder);
    }
    let (given, mut seen) = (photos.len(), BTreeSet::new());
    photos.retain(|photo| seen.insert(photo.clone()));
    if photos.len() < given {
        warnings.push(format!("{} photographs were named again; each is matched once", given - photos.len()));
    }
    Ok((photos, warnings))
}

fn is_photograph(path: &Path) -> bool {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    EXTENSIONS.contains(&extension.as_str())
}

/// A photograph and the file of its preset, where presets are saved.
struct Job {
    path: PathBuf,
    preset: Option<PathBuf>,
}

/// Where photographs of several folders share a name, each preset's name gets a hash of its photograph's path:
/// no preset is lost, and the names do not depend on the order. Case does not tell files apart everywhere.
fn jobs(command: &MatchCommand, photos: Vec<PathBuf>) -> Vec<Job> {
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut uses = BTreeMap::<String, usize>::new();
    photos.iter().for_each(|path| *uses.entry(name(path).to_lowercase()).or_default() += 1);
    let preset_name = |path: &Path| match uses.get(&name(path).to_lowercase()) {
        Some(2..) => format!("{}-{}.json", name(path), &hexadecimal(path.as_os_str().as_encoded_bytes())[..8]),
        _ => format!("{}.json", name(path)),
    };
    let job =
        |path: PathBuf| Job { preset: command.output.as_ref().map(|folder| folder.join(preset_name(&path))), path };
    photos.into_iter().map(job).collect()
}

/// A sentence where names met, so that presets are not called what one expects.
fn renamed(jobs: &[Job]) -> Option<String> {
    let plain = |job: &Job| job.path.file_name().map(|name| Path::new(name).with_added_extension("json"));
    let is_renamed = |job: &&Job| {
        job.preset.as_ref().is_some_and(|preset| preset.file_name() != plain(job).as_deref().map(Path::as_os_str))
    };
    let mut renamed = jobs.iter().filter(is_renamed);
    let first = renamed.next()?;
    let preset = first.preset.as_ref()?.display();
    let count = 1 + renamed.count();
    Some(format!(
        "{count} photographs share their names with others; the preset of {} is {preset}",
        first.path.display()
    ))
}

/// Everything but the photograph that a line depends on.
fn task(command: &MatchCommand, marks: &Marks) -> Value {
    let options = command.reading.options();
    json!({
        "request": marks.request, "outlines": marks.outlines, "space": command.space, "layer": options.layer,
        "untagged_is_linear": options.untagged == Untagged::Linear, "presets": command.output,
    })
}

/// The line of one photograph: its match, or its error as a sentence.
fn line(command: &MatchCommand, job: &Job, marks: &Marks, task: &Value, results: &Results) -> Value {
    if let Some(known) = results.known(job) {
        return known.clone();
    }
    let found = matched(command, job, marks).unwrap_or_else(|error| json!({ "error": sentence(&error) }));
    let mut line = json!({ "path": job.path.display().to_string(), "task": task });
    if let (Some(line), Value::Object(found)) = (line.as_object_mut(), found) {
        line.extend(found);
    }
    line
}

fn matched(command: &MatchCommand, job: &Job, marks: &Marks) -> anyhow::Result<Value> {
    let matched = command.of_file(&job.path, marks)?;
    let mut value = matched.json()?;
    if let Some(path) = &job.preset {
        value["preset"] = match matched.preset() {
            Some(preset) => {
                save(&preset, path, command.force)?;
                json!(path.display().to_string())
            }
            None => Value::Null,
        };
    }
    Ok(value)
}

/// Saves a preset. The same one may be there from a run that was interrupted; another is replaced only with `--force`.
fn save(preset: &Preset, path: &Path, force: bool) -> anyhow::Result<()> {
    let folder = path.parent().unwrap_or(Path::new(""));
    fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    if force || !path.exists() {
        return Ok(preset.save(path)?);
    }
    if fs::read(path).is_ok_and(|there| there == preset.to_json().unwrap_or_default().into_bytes()) {
        return Ok(());
    }
    bail!("{} is there already and differs; --force replaces it", path.display())
}

fn hexadecimal(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Lines of an earlier run, so that an interrupted one can go on.
struct Results {
    path: Option<PathBuf>,
    known: BTreeMap<String, Value>,
}

impl Results {
    /// Reads what is there. A last line that was cut short is taken off; lines about another task do not count.
    fn open(path: Option<&Path>, task: &Value) -> anyhow::Result<Self> {
        let Some(path) = path else { return Ok(Self { path: None, known: BTreeMap::new() }) };
        let lines = lines_of(path).with_context(|| path.display().to_string())?;
        let same = lines.into_iter().filter(|line| line["task"] == *task);
        let known = same.filter_map(|line| Some((line["path"].as_str()?.to_owned(), line))).collect();
        Ok(Self { path: Some(path.to_owned()), known })
    }

    /// The earlier line about a file whose bytes are still the same and whose own preset is still there.
    fn known(&self, job: &Job) -> Option<&Value> {
        let line = self.known.get(&job.path.display().to_string())?;
        let sha256 = line["photo_sha256"].as_str()?;
        let is_of_photo = |preset: &str| fs::read_to_string(preset).is_ok_and(|text| text.contains(sha256));
        let has_preset = line["preset"].as_str().is_none_or(is_of_photo);
        (has_preset && hexadecimal(&fs::read(&job.path).ok()?) == sha256).then_some(line)
    }

    /// Adds a line that is not there yet.
    fn append(&mut self, line: &Value) -> anyhow::Result<()> {
        let Some(path) = &self.path else { return Ok(()) };
        let key = line["path"].as_str().unwrap_or_default();
        if line["error"].is_string() || self.known.get(key) == Some(line) {
            return Ok(());
        }
        let write =
            || OpenOptions::new().create(true).append(true).open(path)?.write_all(format!("{line}\n").as_bytes());
        write().with_context(|| path.display().to_string())
    }
}

/// The lines of a file of results; none where it is not there yet.
fn lines_of(path: &Path) -> anyhow::Result<Vec<Value>> {
    if !path.exists() {
        return Ok(Vec::new());
    }
    let text = read_results(path)?;
    let whole = text.rfind('\n').map_or(0, |end| end + 1);
    let line = |(index, line): (usize, &str)| match serde_json::from_str::<Value>(line) {
        Ok(value) if value["task"].is_object() => Ok(value),
        _ => bail!("line {} is no result of a match, so nothing is added to this file", index + 1),
    };
    let lines = text[..whole].lines().enumerate().map(line).collect::<anyhow::Result<_>>()?;
    match &text[whole..] {
        "" => {}
        cut if cut.starts_with(FIRST_KEY) => OpenOptions::new().write(true).open(path)?.set_len(whole as u64)?,
        _ => bail!("the last line is no result of a match, so nothing is added to this file"),
    }
    Ok(lines)
}

fn read_results(path: &Path) -> anyhow::Result<String> {
    let kind = fs::metadata(path)?.file_type();
    if !kind.is_file() {
        bail!("this is {}, not a file", other_kind(kind));
    }
    Ok(fs::read_to_string(path)?)
}

/// How every line begins.
const FIRST_KEY: &str = "{\"path\":";
