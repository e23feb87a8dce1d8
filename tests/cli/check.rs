//! Does `edgewise check` tell presets that can be relied on from those that cannot?

use std::fs;

use edgewise::color::Rgb;
use edgewise::preset::{Preset, built_in_presets};
use edgewise::sample::samples;
use serde_json::{Value, json};

use crate::run::{edgewise, json, quiet, refusal, stderr};

#[test]
fn the_built_in_presets_can_be_relied_on() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    built_in_presets().iter().for_each(|p| p.save(&folder.path().join(p.file_stem() + ".json")).unwrap());
    let rows = json(&["check", path, "--json"]);
    let names: std::collections::BTreeSet<_> =
        rows.as_array().unwrap().iter().map(|row| row["name"].as_str()).collect();
    assert_eq!(names.len(), built_in_presets().len());
    assert!(rows.as_array().unwrap().iter().all(|row| row["result"] != json!("error")), "{rows}");
    // Gold's red exceeds 1 in linear Rec.709, which --strict does not let pass.
    let strict = edgewise(&["check", path, "--strict"]);
    assert_eq!(strict.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&strict.stdout).contains("out-of-range"));
}

#[test]
fn one_that_cannot_be_relied_on_fails_the_run_and_not_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    Preset::new_authored().save(&folder.path().join("good.json")).unwrap();
    Preset { h: Rgb([1.0; 3]), ..Preset::new_authored() }.save(&folder.path().join("white.json")).unwrap();
    fs::write(folder.path().join("broken.json"), "{\"edgewise\": 1").unwrap();
    fs::write(folder.path().join("package.json"), "{}").unwrap();
    let output = edgewise(&["check", &path(""), "--format", "csv"]);
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    let codes: Vec<&str> = text.lines().skip(1).map(|line| line.split(',').nth(3).unwrap()).collect();
    assert_eq!(codes, ["unreadable", "", "infeasible"], "{text}");
    assert!(stderr(&output).contains("package.json is no preset"), "{}", stderr(&output));
    assert!(stderr(&output).contains("2 of 3 presets cannot"), "{}", stderr(&output));
    assert!(quiet(&["check", &path("good.json")]).contains("ok"));
    assert_eq!(edgewise(&["check", &path("package.json")]).status.code(), Some(1), "it was named");
    assert_eq!(edgewise(&["check", &path("missing.json")]).status.code(), Some(1));
    fs::create_dir(folder.path().join("empty")).unwrap();
    assert!(refusal(1, &["check", &path("empty")]).contains("no preset"));
}

#[test]
fn the_photograph_of_a_match_is_compared_by_its_hash() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let sample = &samples()[0];
    fs::write(folder.path().join(&sample.facts.file), sample.bytes).unwrap();
    edgewise(&["samples", "--match", sample.id, "-o", &path("")]);
    let preset = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path());
    let preset = preset.into_iter().find(|path| path.extension().is_some_and(|e| e == "json")).unwrap();
    let codes = |more: &[&str]| -> Vec<Value> {
        let output = edgewise(&[&["check", preset.to_str().unwrap(), "--json"], more].concat());
        let rows: Value = serde_json::from_slice(&output.stdout).unwrap();
        rows.as_array().unwrap().iter().map(|row| row["code"].clone()).collect()
    };
    assert!(!codes(&[]).iter().any(|code| code.as_str().is_some_and(|c| c.starts_with("photo"))), "{:?}", codes(&[]));
    fs::write(folder.path().join(&sample.facts.file), "another").unwrap();
    assert!(codes(&[]).contains(&json!("photo-changed")));
    fs::remove_file(folder.path().join(&sample.facts.file)).unwrap();
    assert!(codes(&["--photos", &path("")]).contains(&json!("photo-missing")));
}
