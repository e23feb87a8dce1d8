//! Does match find the truth of a sample, and refuse what it cannot solve?

use std::fs;
use std::path::Path;

use edgewise::color::{Rgb, RgbSpace};
use edgewise::preset::{Origin, Preset};
use edgewise::sample::{sample, samples};
use serde_json::{Value, json};

use crate::run::{edgewise, json, quiet, refusal, stderr};

/// The file of a built-in sample, in a folder.
pub fn sample_file(folder: &Path, id: &str) -> String {
    let sample = sample(id).unwrap();
    let path = folder.join(&sample.facts.file);
    fs::write(&path, sample.bytes).unwrap();
    path.to_str().unwrap().to_owned()
}

pub const GOLD_MARKS: [&str; 4] = ["--circle", "206,204,132", "--card", "396,186,68,96@0.9"];

fn triple(value: &Value) -> Rgb {
    serde_json::from_value(value.clone()).unwrap()
}

#[test]
fn samples_are_listed_with_their_truth() {
    let list = json(&["samples", "--json"]);
    assert_eq!(list.as_array().unwrap().len(), samples().len());
    assert_eq!((&list[0]["id"], &list[0]["rendered"]), (&json!("gold_tent"), &json!(true)));
    assert_eq!(triple(&list[0]["truth"]["r"]), sample("gold_tent").unwrap().facts.truth.r);
    assert_eq!(quiet(&["samples", "--format", "csv"]).lines().next(), Some("id,metal,rendered,title,description"));
    assert_eq!(quiet(&["samples"]).lines().count(), samples().len() + 1);
}

#[test]
fn a_sample_is_matched_with_everything_written() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let output = edgewise(&["samples", "--match", "gold_tent", "-o", out.to_str().unwrap()]);
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(text.contains("ΔE2000 to the truth of Au_Olmon-ts") && text.contains("true h"), "{text}");
    assert!(Preset::load(&out.join("gold_tent.json")).is_ok());
    for name in ["gold_tent_curve.png", "gold_tent_swatches.png"] {
        assert!(text.contains(name) && image::open(out.join(name)).unwrap().width() > 400, "{name}: {text}");
    }
    refusal(2, &["samples", "-o", "somewhere"]);
}

#[test]
fn match_has_the_fixed_form_and_finds_the_truth() {
    let folder = tempfile::tempdir().unwrap();
    let photo = sample_file(folder.path(), "gold_tent");
    let found = json(&[&["match", &photo, "--json"], &GOLD_MARKS[..]].concat());
    assert_eq!((&found["space"], &found["mode"]), (&json!("lin_rec709"), &json!("card")));
    let truth = sample("gold_tent").unwrap().facts.truth;
    for (name, truth) in [("r", truth.r), ("h", truth.h)] {
        let uncertainty = triple(&found[format!("{name}_uncertainty")]);
        let difference = (triple(&found[name]) - truth).map(f64::abs);
        assert!((uncertainty * 2.0 - difference).min_channel() > 0.0, "{name} lies within 2 u of the truth: {found:#}");
    }
    assert!(found["warnings"].as_array().unwrap().iter().all(|w| w["code"].is_string() && w["message"].is_string()));

    let by_sample = json(&["match", "--sample", "gold_tent", "--json"]);
    assert_eq!((&by_sample["r"], &by_sample["h"]), (&found["r"], &found["h"]), "the sample's own marks are these");
    assert!(by_sample["truth"]["delta_e_r"].as_f64().unwrap() < 2.0, "{:#}", by_sample["truth"]);

    let wide = json(&[&["match", &photo, "--space", "acescg", "--json"], &GOLD_MARKS[..]].concat());
    let converted = RgbSpace::LinRec709.convert(triple(&found["r"]), RgbSpace::AcesCg);
    assert!(triple(&wide["r"]).max_abs_difference(converted) < 1e-12);

    let csv = edgewise(&[&["match", &photo, "--format", "csv"], &GOLD_MARKS[..]].concat());
    let csv = String::from_utf8(csv.stdout).unwrap();
    assert_eq!(csv.lines().next(), Some("channel,r,r_uncertainty,h,h_uncertainty"));
    assert_eq!(csv.lines().nth(1).unwrap().split(',').nth(1).unwrap(), found["r"][0].to_string());
}

#[test]
fn a_match_becomes_a_preset_that_reflects() {
    let folder = tempfile::tempdir().unwrap();
    let photo = sample_file(folder.path(), "gold_tent");
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (preset, plot) = (file("gold.json"), file("gold.png"));
    let found = json(
        &[&["match", &photo, "-o", &preset, "--plot", &plot, "--name", "Ring", "--json"], &GOLD_MARKS[..]].concat(),
    );
    assert!(image::open(&plot).unwrap().width() > 500);

    let curve = json(&["reflect", "--preset", &preset, "--angles", "0,max", "--json"]);
    assert_eq!(curve["material"], json!("Ring"));
    assert_eq!(curve["model"]["r"], found["r"]);
    assert!((curve["curve"][1]["blue"].as_f64().unwrap() - found["h"][2].as_f64().unwrap()).abs() < 1e-14);

    let loaded = Preset::load(Path::new(&preset)).unwrap().preset;
    let Origin::Matched(recipe) = loaded.origin else { panic!("{:?}", loaded.origin) };
    assert_eq!(recipe.photo_sha256, found["photo_sha256"].as_str().unwrap());
    assert_eq!(serde_json::to_value(&recipe.request).unwrap(), found["request"], "the marks are kept");
}

#[test]
fn a_match_that_cannot_be_saved_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let photo = sample_file(folder.path(), "gold_tent");
    let preset = folder.path().join("p.json");
    Preset::new_authored().save(&preset).unwrap();
    // Only r is marked, so there is no h and no preset.
    let marks = ["--facing", "180,180,50,50", "--card", "396,186,68,96@0.9"];
    let there = ["match", &photo, "-o", preset.to_str().unwrap(), "--json"];
    let sentence = refusal(1, &[&there, &marks[..]].concat());
    assert!(sentence.contains("p.json is there already; --force replaces it"), "{sentence}");
    let output = edgewise(&[&there, &marks[..], &["--force"]].concat());
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("there is no preset"), "{}", stderr(&output));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(found["r"][0].is_number() && found["h"][0].is_null(), "{found:#}");
    assert_eq!(Preset::load(&preset).unwrap().preset, Preset::new_authored());

    let sentence = refusal_after_warnings(&[&["match", &photo, "-o", "no/such/p.json"], &GOLD_MARKS[..]].concat());
    assert!(sentence.contains("no/such/p.json"), "{sentence}");
}

/// The sentence of a run that fails after it may have warned.
fn refusal_after_warnings(arguments: &[&str]) -> String {
    let output = edgewise(arguments);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(1), 0), "{arguments:?}");
    stderr(&output).lines().last().unwrap().to_owned()
}

#[test]
fn marks_that_cannot_be_solved_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let photo = sample_file(folder.path(), "gold_tent");
    let with = |marks: &[&'static str]| [&["match", photo.as_str()], marks].concat();
    assert!(refusal(1, &with(&["--card", "396,186,68,96@0.9"])).contains("gold_tent.png: nothing is marked"));
    assert!(refusal(1, &with(&["--circle", "206,204,132", "--mode", "card"])).contains("card of known reflectance"));
    assert!(refusal(2, &with(&["--card", "1,2,3,4@1.5"])).contains("reflectance"));
    assert!(refusal(2, &with(&["--card", "1,2,3,4"])).contains("@reflectance"));
    assert!(refusal(2, &with(&["--circle", "206,204"])).contains("x,y,radius"));
    assert!(refusal(2, &with(&["--circle", "206,204,-1"])).contains("above 0"));
    assert!(refusal(2, &with(&["--mode", "G"])).contains("flat-mirror"));
    assert!(refusal(2, &with(&["--direct", "1,1,5,5", "--angle", "8"])).contains("belong together"));
    assert!(refusal(2, &with(&["--reference-ball", "9,9,9@Unobtainium"])).contains("Unobtainium"));
    assert!(refusal(1, &["match", "--sample", "nickel"]).contains("gold_tent"));
    assert!(refusal(1, &["match", "no/such.png", "--circle", "1,1,1"]).contains("no/such.png"));
    refusal(2, &["match"]);
}
