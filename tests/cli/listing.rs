//! Are metals and presets listed in full?

use edgewise::color::RgbSpace;
use edgewise::metal::{metal_by_name, metals, preferred_metals};
use edgewise::preset::{Preset, built_in_presets};
use serde_json::json;

use crate::run::{edgewise, json, quiet, refusal, stderr};

#[test]
fn metals_are_listed_in_every_format() {
    let all = json(&["metals", "--json"]);
    assert_eq!(all.as_array().unwrap().len(), metals().len());
    let preferred = json(&["metals", "--preferred", "--json"]);
    assert_eq!(preferred.as_array().unwrap().len(), preferred_metals().count());
    let gold = json(&["metals", "Au_Olmon-ts", "--space", "acescg", "--json"]);
    assert_eq!(gold[0]["r"], json!(metal_by_name("Gold").unwrap().r(RgbSpace::AcesCg)));
    assert_eq!(gold[0]["provenance"]["year"], json!("2012"));

    let iron = json(&["metals", "Fe_Werner-DFT", "--json"]);
    assert_eq!((&gold[0]["measured"], &iron[0]["measured"]), (&json!(true), &json!(false)));
    assert!(iron[0]["remarks"][0].as_str().unwrap().contains("density functional"), "{iron}");

    let csv = quiet(&["metals", "--format", "csv"]);
    let header = "id,name,symbol,category,preferred,r_red,r_green,r_blue,h_red,h_green,h_blue,source,range_nm,measured";
    assert_eq!(csv.lines().next(), Some(header));
    assert_eq!(csv.lines().count(), metals().len() + 1);
    assert_eq!(quiet(&["metals"]).lines().count(), metals().len() + 1);

    let none = edgewise(&["metals", "unobtainium"]);
    assert!(stderr(&none).contains("no metal matches “unobtainium”"), "{}", stderr(&none));
}

#[test]
fn presets_are_listed_and_written() {
    assert_eq!(json(&["presets", "--json"]).as_array().unwrap().len(), built_in_presets().len());
    assert_eq!(quiet(&["presets", "--format", "csv"]).lines().count(), built_in_presets().len() + 1);

    let folder = tempfile::tempdir().unwrap();
    quiet(&["presets", "--write", folder.path().to_str().unwrap()]);
    let gold = Preset::load(&folder.path().join("gold.json")).unwrap().preset;
    let built_in = built_in_presets().iter().find(|preset| preset.name == "Gold").unwrap();
    assert_eq!((&gold.origin, &gold.tags), (&built_in.origin, &built_in.tags));
    assert!(gold.r.max_abs_difference(built_in.r) < 1e-12, "the platform may differ in the last bits");
    assert!(
        refusal(1, &["presets", "--write", folder.path().join("gold.json").to_str().unwrap()]).contains("gold.json")
    );
}
