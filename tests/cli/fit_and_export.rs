//! Do fits, conversions, studies and exports say what they found and what they lost?

use std::fs;

use edgewise::color::RgbSpace;
use edgewise::fresnel::t_from_r_h;
use edgewise::metal::{metal_by_name, preferred_metals};
use edgewise::preset::Preset;
use serde_json::{Value, json};

use crate::run::{edgewise, json, quiet, refusal, stderr};

#[test]
fn convert_is_exact_between_two_words_for_one_curve() {
    let value = json(&[
        "convert",
        "--r",
        "0.6,0.5,0.4",
        "--h",
        "0.7,0.6,0.55",
        "--to",
        "f82-tint",
        "--to",
        "schlick",
        "--json",
    ]);
    let [tint, schlick] = [&value["conversions"][0], &value["conversions"][1]];
    assert_eq!((&tint["exact"], &schlick["exact"]), (&json!(true), &json!(false)));
    assert!((tint["model"]["t"][0].as_f64().unwrap() - t_from_r_h(0.6, 0.7)).abs() < 1e-14);
    assert_eq!(schlick["losses"][0]["code"], json!("edge-dropped"));

    let all = quiet(&["convert", "--n", "1.5,1.5,1.5", "--k", "2,2,2", "--to", "gulbrandsen", "--format", "csv"]);
    assert_eq!(all.lines().next(), Some("model,parameter,red,green,blue,max_difference,max_delta_e"));
    let lossy = edgewise(&["convert", "--metal", "Cr", "--to", "gulbrandsen"]);
    assert!(stderr(&lossy).contains("warning: gulbrandsen: "), "{}", stderr(&lossy));
}

/// Standard output of a run that may have warned.
fn quiet_or_warned(arguments: &[&str]) -> String {
    let output = edgewise(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn fit_gives_parameters_with_their_error() {
    let fits = json(&["fit", "--metal", "Cr", "--model", "hoffman", "--space", "acescg", "--json"]);
    let exact = &fits[0];
    assert_eq!((&exact["method"], &exact["space"]), (&json!("exact"), &json!("acescg")));
    assert_eq!(exact["model"]["h"], json!(metal_by_name("Cr").unwrap().h(RgbSpace::AcesCg)));
    let mean = |fit: &Value| fit["error"]["mean_delta_e"].as_f64().unwrap();
    let best = fits.as_array().unwrap().iter().find(|fit| fit["method"] == json!("black-box")).unwrap();
    assert!(mean(best) <= mean(exact), "the search starts from the exact parameters");

    let csv = quiet(&["fit", "--metal", "Cr", "--method", "exact", "--format", "csv"]);
    let header = "metal,space,model,method,mean_delta_e,max_delta_e,angle_of_max_deg,sphere_delta_e,parameters";
    assert_eq!(csv.lines().next(), Some(header));
    assert_eq!(csv.lines().count(), 1 + 5, "the models that have exact parameters");
    assert!(
        refusal(1, &["fit", "--metal", "Cr", "--model", "conductor", "--method", "exact"]).contains("least-squares")
    );
    refusal(2, &["fit"]);

    let two = json(&["fit", "--metal", "Cr", "--metal", "Fe", "--model", "schlick", "--method", "exact", "--json"]);
    assert_eq!((&two[0]["metal"], &two[1]["metal"]), (&json!("Cr_Johnson"), &json!("Fe_Querry")));
    let all = quiet_or_warned(&["fit", "--all", "--model", "hoffman", "--method", "exact", "--format", "csv"]);
    assert_eq!(all.lines().count(), 1 + preferred_metals().count());
}

#[test]
fn study_accuracy_measures_what_it_is_asked() {
    let arguments = ["study", "accuracy", "--metal", "Cr", "--metal", "Au", "--space", "acescg"];
    let candidates = ["--candidate", "schlick:exact", "--candidate", "hoffman:exact"];
    let with = |more: &[&'static str]| [&arguments[..], &candidates[..], more].concat();
    let rows = json(&with(&["--json"]));
    assert_eq!(rows.as_array().unwrap().len(), 4);
    let csv = quiet(&with(&["--format", "csv"]));
    let header =
        "metal,name,category,space,model,method,mean_delta_e,max_delta_e,angle_of_max_deg,sphere_delta_e,losses";
    assert_eq!(csv.lines().next(), Some(header));
    let folder = tempfile::tempdir().unwrap();
    for figure in ["table", "distribution"] {
        let plot = folder.path().join(format!("{figure}.svg"));
        let drawn = [&with(&[])[..], &["--plot", plot.to_str().unwrap(), "--figure", figure]].concat();
        let table = quiet(&drawn);
        assert!(table.contains("Mean ΔE over 2 metals: Schlick"), "{table}");
        let svg = fs::read_to_string(plot).unwrap();
        assert!(svg.contains("Hoffman") && svg.contains("Schlick") && svg.contains("ACEScg"), "{figure}");
    }
    refusal(2, &with(&["--figure", "table"]));
    let summary = json(&with(&["--summary", "--json"]));
    let mean = |row: &Value| row["mean_delta_e"].as_f64().unwrap();
    assert!((mean(&summary[0]) - (mean(&rows[0]) + mean(&rows[2])) / 2.0).abs() < 1e-12);
    assert!(refusal(2, &["study", "accuracy", "--candidate", "hoffman"]).contains("model:method"));
}

#[test]
fn export_refuses_to_lose_or_to_replace_when_asked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let strict = refusal(1, &["export", "--metal", "Au", "--to", "open-pbr", "--strict", "-o", path]);
    assert!(strict.contains("--strict") && folder.path().read_dir().unwrap().next().is_none(), "{strict}");
    quiet(&["export", "--metal", "Cr", "--to", "open-pbr", "--strict", "-o", path]);
    assert!(refusal(1, &["export", "--metal", "Cr", "--to", "open-pbr", "-o", path]).contains("--force"));
    quiet(&["export", "--metal", "Cr", "--to", "open-pbr", "--force", "-o", path]);
}

#[test]
fn export_names_one_file_and_tells_names_that_meet() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    quiet(&["export", "--metal", "Cr", "--to", "open-pbr", "-o", &path("new/mine.mtlx")]);
    assert!(folder.path().join("new/mine.mtlx").is_file());
    let several = ["export", "--metal", "Cr", "--metal", "Ni", "--to", "open-pbr", "-o", &path("two.mtlx")];
    assert!(refusal(1, &several).contains("takes a folder"));
    let twice = edgewise(&["export", "--metal", "Cr", "--metal", "Cr", "--to", "open-pbr", "-o", &path("both")]);
    assert!(stderr(&twice).contains("2 presets share"), "{}", stderr(&twice));
    assert_eq!(folder.path().join("both").read_dir().unwrap().count(), 2);
}

#[test]
fn a_metal_is_baked_into_a_function_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    quiet(&["export", "--metal", "Cr", "--to", "glsl", "--to", "osl", "--bake", "-o", path]);
    let text = fs::read_to_string(folder.path().join("chromium.glsl")).unwrap();
    assert!(text.contains("10 coefficients") && text.contains("vec3 fresnel_chromium(float cosTheta)"), "{text}");
    assert!(folder.path().join("chromium.osl").is_file());
    assert!(refusal(2, &["export", "--metal", "Cr", "--to", "usd", "--bake", "-o", path]).contains("not usd"));
    assert!(refusal(2, &["export", "--bake", "--to", "glsl", "-o", path]).contains("--metal"));
}

#[test]
fn import_brings_back_what_export_wrote() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    quiet(&["export", "--metal", "Cr", "--to", "open-pbr", "--space", "acescg", "-o", path]);
    let file = folder.path().join("chromium.acescg.open_pbr.mtlx");
    quiet(&["import", file.to_str().unwrap(), "-o", path]);
    let preset = Preset::load(&folder.path().join("chromium.json")).unwrap().preset;
    let chromium = metal_by_name("Cr").unwrap();
    assert_eq!(preset.space, RgbSpace::AcesCg);
    assert!(preset.h.max_abs_difference(chromium.h(RgbSpace::AcesCg)) < 1e-8);
    assert!(refusal(1, &["import", file.to_str().unwrap(), "-o", path]).contains("--force"));
    assert!(refusal(1, &["import", "x.blend"]).contains(".mtlx"));
}

#[test]
fn studies_show_what_parameters_cost() {
    let worst = |rows: &Value, field: &str, parameters: &str| {
        let own = rows.as_array().unwrap().iter().filter(|row| row["parameters"] == json!(parameters));
        own.map(|row| row[field].as_f64().unwrap()).fold(0.0, f64::max)
    };
    let converted = json(&["study", "conversion", "Au", "--json"]);
    assert!(worst(&converted, "max_delta_e", "h") < 1e-9 && worst(&converted, "max_delta_e", "nk") > 1.0);
    let blended = json(&["study", "blending", "Au", "Cu", "--detail", "--json"]);
    assert!(worst(&blended, "max_delta_e", "h") < 1e-9 && worst(&blended, "max_delta_e", "nk") > 0.1);
    let stored = json(&["study", "quantisation", "Au", "--json"]);
    assert!(worst(&stored, "edge_delta_e", "h") < worst(&stored, "edge_delta_e", "g"));
    assert!(stored[0]["bands"].is_u64(), "counts are whole numbers");
    let moved = json(&["study", "decoupling", "Cr", "--json"]);
    let first = moved.as_array().unwrap().iter().filter(|row| row["swept"] == json!("first"));
    assert!(
        first.filter(|row| row["parameters"] == json!("h")).all(|row| row["edge_delta_e"].as_f64().unwrap() < 1e-9)
    );
    assert!(quiet(&["study", "uniformity", "--format", "csv"]).starts_with("r,slider,reach,steps,"));
    assert!(
        quiet(&["study", "feasibility", "--steps", "4", "--format", "csv"])
            .starts_with("r,feasible_low,feasible_high,")
    );
    assert!(quiet(&["study", "feasibility", "--metals"]).contains("Caesium"));
    assert!(refusal(2, &["study", "feasibility", "--steps", "1"]).contains("whole number"));
}

#[test]
fn export_writes_files_and_says_what_they_lose() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let exported = edgewise(&["export", "--metal", "Au", "--metal", "Cr", "--to", "open-pbr", "-o", path, "--json"]);
    let value: Value = serde_json::from_slice(&exported.stdout).unwrap();
    for file in value[0]["files"].as_array().unwrap() {
        assert!(fs::read_to_string(file.as_str().unwrap()).unwrap().contains("open_pbr_surface"));
    }
    assert!(stderr(&exported).contains("open-pbr: Gold: its reader would clip r red"), "{}", stderr(&exported));

    let preset = folder.path().join("p.json");
    Preset { roughness: 0.0, ..Preset::new_authored() }.save(&preset).unwrap();
    let listed = quiet(&["export", preset.to_str().unwrap(), "--to", "glsl", "-o", path, "--format", "csv"]);
    assert_eq!(listed.lines().next(), Some("target,file,bytes"));
    assert!(
        refusal(1, &["export", "--metal", "Au", "--to", "gltf", "--space", "acescg", "-o", path]).contains("acescg")
    );
    assert!(refusal(2, &["export", "--metal", "Au", "--to", "maya"]).contains("open-pbr"));
    refusal(2, &["export", "--to", "glsl"]);
    assert!(quiet(&["export", "--list"]).contains("open-pbr"));
}
