//! Whether a preset can be relied on: what a studio wants to know of every file before it is used.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use serde::Serialize;
use sha2::{Digest, Sha256};

use super::{FormatError, Loaded, Origin, Preset, json};
use crate::color::Rgb;
use crate::file::read_text;
use crate::fresnel::reflectance_range;
use crate::metal::{Metal, Provenance, metals};
use crate::photo::Recipe;

/// A curve may leave 0–1 by this much, which is rounding.
const TOLERANCE: f64 = 1e-6;

/// How much a finding matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Something a person should know.
    Warning,
    /// Something that must not be relied on.
    Error,
}

impl Severity {
    /// The word for it.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

/// Something about a preset that is not as it should be.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// How much it matters.
    pub severity: Severity,
    /// What it is, by a name that stays.
    pub code: &'static str,
    /// The same as a sentence.
    pub message: String,
}

impl Finding {
    fn error(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Error, code, message: message.into() }
    }

    fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, code, message: message.into() }
    }
}

/// A file that was looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// The preset; `None` where the file holds none.
    pub preset: Option<Preset>,
    /// Nothing where all is well.
    pub findings: Vec<Finding>,
}

/// Looks at a preset file: is it one, is it a reflectance at every angle, where does it come from, and is its
/// photograph still the one it was matched from.
///
/// The photograph is looked for beside the file and in `photos`. Where that folder is named, a photograph that is in
/// neither is an error.
pub fn check_preset(path: &Path, photos: Option<&Path>) -> Checked {
    let (Loaded { preset, warnings }, has_origin) = match loaded(path) {
        Ok(loaded) => loaded,
        Err(finding) => return Checked { preset: None, findings: vec![finding] },
    };
    let mut findings: Vec<Finding> = warnings.into_iter().map(|warning| Finding::warning("tint", warning)).collect();
    if preset.name.trim().is_empty() {
        findings.push(Finding::warning("no-name", "it has no name"));
    }
    if !has_origin {
        findings.push(Finding::warning("no-origin", "it does not say where r and h come from"));
    }
    findings.extend(values(&preset));
    findings.extend(origin(&preset, &preset.origin, path, photos));
    Checked { preset: Some(preset), findings }
}

/// The code of a JSON file that does not claim to be a preset.
pub const NO_PRESET: &str = "no-preset";

/// The preset of a file, and whether the file names its origin.
fn loaded(path: &Path) -> Result<(Loaded, bool), Finding> {
    let text = read_text(path).map_err(|error| Finding::error("unreadable", error.problem.to_string()))?;
    let loaded = Preset::from_json(&text).map_err(|error| match error {
        FormatError::NoPreset => Finding::error(NO_PRESET, error.to_string()),
        _ => Finding::error("unreadable", error.to_string()),
    })?;
    Ok((loaded, names_an_origin(&text)))
}

/// A file without the field reads as authored, which nobody said.
fn names_an_origin(text: &str) -> bool {
    json::read(text.trim_start_matches('\u{feff}')).is_ok_and(|document| document.get("origin").is_some())
}

/// Reflectances lie in 0–1, and so does the curve between them. What was measured may leave it, as gold does in linear
/// Rec.709; what a person set can be set otherwise.
fn values(preset: &Preset) -> Vec<Finding> {
    let is_measurement = matches!(preset.origin, Origin::Measured { .. } | Origin::Matched(_));
    let finding = if is_measurement { Finding::warning } else { Finding::error };
    let mut findings = Vec::new();
    if !(0.0..=1.0).contains(&preset.roughness) {
        findings.push(Finding::error("roughness", format!("roughness is {}; it must lie in 0–1", preset.roughness)));
    }
    let outside: Vec<String> = [("r", preset.r), ("h", preset.h)].into_iter().filter_map(outside).collect();
    if !outside.is_empty() {
        let message = format!("{} in {} lies outside 0–1", outside.join(", "), preset.space);
        findings.push(finding("out-of-range", message));
    } else if let Some(range) = infeasible(preset.r, preset.h) {
        findings.push(finding("infeasible", format!("no material has this r and h: {range}")));
    }
    findings
}

/// `r red 1.0400, r blue -0.0100`
fn outside((symbol, rgb): (&str, Rgb)) -> Option<String> {
    let channels = CHANNELS.into_iter().zip(rgb.0).filter(|(_, value)| *value < -TOLERANCE || *value > 1.0 + TOLERANCE);
    let words: Vec<String> = channels.map(|(channel, value)| format!("{symbol} {channel} {value:.4}")).collect();
    (!words.is_empty()).then(|| words.join(", "))
}

const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// The channels whose curve leaves 0–1 between r and h.
fn infeasible(r: Rgb, h: Rgb) -> Option<String> {
    let leaves = |index: usize| {
        let range = reflectance_range(r[index], h[index]);
        let is_inside = *range.start() >= -TOLERANCE && *range.end() <= 1.0 + TOLERANCE;
        let words = || format!("{} runs from {:.4} to {:.4}", CHANNELS[index], range.start(), range.end());
        (!is_inside).then(words)
    };
    let words: Vec<String> = (0..3).filter_map(leaves).collect();
    (!words.is_empty()).then(|| words.join(", "))
}

fn origin(preset: &Preset, origin: &Origin, path: &Path, photos: Option<&Path>) -> Vec<Finding> {
    match origin {
        Origin::Authored => Vec::new(),
        Origin::Measured { metal, provenance } => measured(preset, metal, provenance).into_iter().collect(),
        Origin::Matched(recipe) => matched(recipe, path, photos),
        // Its colours are no longer those; where they came from must hold all the same.
        Origin::Edited { from } => match from.as_ref() {
            Origin::Matched(recipe) => photograph(recipe, path, photos).into_iter().collect(),
            Origin::Measured { provenance, .. } if is_anonymous(provenance) => vec![no_provenance()],
            _ => Vec::new(),
        },
    }
}

fn is_anonymous(source: &Provenance) -> bool {
    [&source.authors, &source.reference, &source.doi, &source.url].iter().all(|text| text.trim().is_empty())
}

fn no_provenance() -> Finding {
    Finding::error("no-provenance", "it is measured, and names neither authors nor a publication")
}

/// A metal of the library has one r and h; whoever names it must have these.
fn measured(preset: &Preset, metal: &str, provenance: &Provenance) -> Option<Finding> {
    if is_anonymous(provenance) {
        return Some(no_provenance());
    }
    let same = |known: &&Metal| known.id == metal && known.provenance == *provenance;
    let known = metals().iter().find(same)?;
    let off = |ours: Rgb, theirs: Rgb| ours.max_abs_difference(theirs);
    let differs = off(preset.r, known.r(preset.space)).max(off(preset.h, known.h(preset.space)));
    (differs.is_nan() || differs > TOLERANCE).then(|| {
        let message = format!("r and h are up to {differs:.6} off those of {metal}, which it says it is");
        Finding::error("not-its-metal", message)
    })
}

fn matched(recipe: &Recipe, path: &Path, photos: Option<&Path>) -> Vec<Finding> {
    let estimate = recipe.is_estimate.then(|| {
        Finding::warning("estimate", "it is an estimate: the light or the tone curve of its photograph is not known")
    });
    estimate.into_iter().chain(photograph(recipe, path, photos)).collect()
}

/// The photograph must have the bytes that were matched, wherever it is found.
fn photograph(recipe: &Recipe, path: &Path, photos: Option<&Path>) -> Option<Finding> {
    let name = recipe.photo.as_str();
    if Path::new(name).file_name() != Some(name.as_ref()) {
        return Some(Finding::error("photo-name", format!("its photograph “{}” is no file name", shortened(name))));
    }
    let beside = path.parent();
    let mut found = None;
    for folder in beside.into_iter().chain(photos) {
        match sha256_of(&folder.join(name)) {
            Ok(Some(hash)) if hash.eq_ignore_ascii_case(&recipe.photo_sha256) => return None,
            Ok(Some(_)) => {
                found = Some(Finding::error(
                    "photo-changed",
                    format!("“{name}” is not the photograph it was matched from"),
                ));
            }
            Ok(None) => {}
            Err(error) => found = Some(Finding::error("photo-unreadable", format!("“{name}” cannot be read: {error}"))),
        }
    }
    found.or_else(|| {
        let message = format!("its photograph “{name}” was not found, so its hash was not compared");
        Some(if photos.is_some() {
            Finding::error("photo-missing", message)
        } else {
            Finding::warning("photo-missing", message)
        })
    })
}

fn shortened(text: &str) -> String {
    text.chars().take(60).collect()
}

/// The hash of a regular file, hexadecimal, read piece by piece; `None` where there is none.
fn sha256_of(path: &Path) -> io::Result<Option<String>> {
    if !fs::metadata(path).is_ok_and(|metadata| metadata.is_file()) {
        return Ok(None);
    }
    let (mut file, mut hash, mut piece) = (File::open(path)?, Sha256::new(), vec![0; 1 << 16]);
    loop {
        match file.read(&mut piece)? {
            0 => return Ok(Some(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())),
            read => hash.update(&piece[..read]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::metal::metal_by_name;

    fn codes(text: &str, files: &[(&str, &[u8])], photos: Option<&str>) -> Vec<(Severity, &'static str)> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        fs::write(&path, text).unwrap();
        fs::create_dir(folder.path().join("photos")).unwrap();
        files.iter().for_each(|(name, bytes)| fs::write(folder.path().join(name), bytes).unwrap());
        let photos = photos.map(|name| folder.path().join(name));
        let findings = check_preset(&path, photos.as_deref()).findings;
        assert!(findings.iter().all(|finding| !finding.message.contains('\n')), "{findings:?}");
        findings.into_iter().map(|finding| (finding.severity, finding.code)).collect()
    }

    fn of(preset: &Preset) -> Vec<(Severity, &'static str)> {
        codes(&preset.to_json().unwrap(), &[], None)
    }

    const ERROR: Severity = Severity::Error;
    const WARNING: Severity = Severity::Warning;

    #[test]
    fn a_preset_as_it_should_be_has_no_findings() {
        assert_eq!(of(&Preset::new_authored()), []);
        assert_eq!(of(&Preset::from_metal(metal_by_name("chromium").unwrap(), RgbSpace::AcesCg)), []);
    }

    #[test]
    fn what_a_person_set_must_be_a_reflectance_and_what_was_measured_may_not() {
        let set = |r, h| Preset { r: Rgb(r), h: Rgb(h), ..Preset::new_authored() };
        assert_eq!(of(&set([1.1, 0.5, 0.5], [0.7; 3])), [(ERROR, "out-of-range")]);
        // A white edge overshoots 1 for every r below 1.
        assert_eq!(of(&set([0.5; 3], [1.0, 0.7, 0.7])), [(ERROR, "infeasible")]);
        let gold = Preset::from_metal(metal_by_name("gold").unwrap(), RgbSpace::LinRec709);
        assert_eq!(of(&gold), [(WARNING, "out-of-range")]);
        let mut edited = gold;
        edited.mark_edited();
        assert_eq!(of(&edited), [(ERROR, "out-of-range")]);
        assert_eq!(of(&Preset { roughness: 1.5, ..Preset::new_authored() }), [(ERROR, "roughness")]);
    }

    #[test]
    fn a_source_must_be_named_and_true() {
        let chromium = Preset::from_metal(metal_by_name("chromium").unwrap(), RgbSpace::AcesCg);
        let moved = Preset { r: chromium.r * 0.99, ..chromium.clone() };
        assert_eq!(of(&moved), [(ERROR, "not-its-metal")]);
        let origin = Origin::Measured { metal: "mine".to_owned(), provenance: Provenance::default() };
        assert_eq!(of(&Preset { origin, ..chromium }), [(ERROR, "no-provenance")]);
        let without = Preset::new_authored().to_json().unwrap().replace("\"origin\": {\"kind\": \"authored\"},", "");
        assert_eq!(codes(&without, &[], None), [(WARNING, "no-origin")]);
    }

    #[test]
    fn what_is_no_preset_is_an_error() {
        assert_eq!(codes("{}", &[], None), [(ERROR, NO_PRESET)]);
        for text in ["", "{\"edgewise\": 99}", "{\"edgewise\": 1, \"edgewise\": 1}", &"[".repeat(100_000)] {
            assert_eq!(codes(text, &[], None), [(ERROR, "unreadable")]);
        }
        let contradicting =
            Preset::new_authored().to_json().unwrap().replace("\"t\": [", "\"t\": [0.1, 0.1, 0.1], \"u\": [");
        assert_eq!(codes(&contradicting, &[], None), [(WARNING, "tint")]);
    }

    fn matched(photo: &str, hash: &str) -> String {
        let recipe = Recipe { photo: photo.to_owned(), photo_sha256: hash.to_owned(), ..Recipe::default() };
        Preset { origin: Origin::Matched(Box::new(recipe)), ..Preset::new_authored() }.to_json().unwrap()
    }

    /// SHA-256 of “abc”, FIPS 180-4.
    const ABC: &str = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

    #[test]
    fn the_photograph_must_be_the_one_that_was_matched() {
        let preset = matched("a.png", ABC);
        assert_eq!(codes(&preset, &[("a.png", b"abc")], None), []);
        assert_eq!(codes(&preset, &[("a.png", b"abd")], None), [(ERROR, "photo-changed")]);
        assert_eq!(codes(&preset, &[], None), [(WARNING, "photo-missing")]);
        assert_eq!(codes(&preset, &[], Some("photos")), [(ERROR, "photo-missing")]);
        assert_eq!(codes(&preset, &[("photos/a.png", b"abc")], Some("photos")), []);
        let both: [(&str, &[u8]); 2] = [("a.png", b"abd"), ("photos/a.png", b"abc")];
        assert_eq!(codes(&preset, &both, Some("photos")), [], "one of them is it");
        assert_eq!(codes(&matched("../a.png", ABC), &[], None), [(ERROR, "photo-name")]);
    }
}
