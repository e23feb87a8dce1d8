//! Does the program itself do what its help says? Every test runs the real binary, as a person would.
#![cfg(feature = "cli")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use edgewise::color::{Rgb, RgbSpace};
use edgewise::fresnel::{CosTheta, THETA_MAX_DEG, hoffman, schlick, t_from_r_h};
use edgewise::metal::{metal_by_name, metals, preferred_metals};
use edgewise::preset::{Origin, Preset, built_in_presets};
use edgewise::sample::{sample, samples};
use serde_json::{Value, json};

fn edgewise(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_edgewise")).args(arguments).stdin(Stdio::null()).output().unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Standard output of a run that succeeds without a word on standard error.
fn quiet(arguments: &[&str]) -> String {
    let output = edgewise(arguments);
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), String::new()), "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

fn json(arguments: &[&str]) -> Value {
    let output = edgewise(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// A run that must fail with one sentence and print nothing.
fn refusal(code: i32, arguments: &[&str]) -> String {
    let output = edgewise(arguments);
    let sentence = stderr(&output);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {sentence}");
    assert_eq!(String::from_utf8_lossy(&output.stdout), "", "{arguments:?}");
    assert!(sentence.starts_with("edgewise: ") && sentence.lines().count() == 1, "{arguments:?}: {sentence}");
    sentence
}

fn csv_rows(text: &str) -> Vec<Vec<f64>> {
    text.lines().skip(1).map(|line| line.split(',').map(|number| number.parse().unwrap()).collect()).collect()
}

fn rgb(row: &[f64]) -> Rgb {
    Rgb([row[1], row[2], row[3]])
}

// --- reflect ---

#[test]
fn reflect_csv_is_the_truth_at_full_precision() {
    let text = quiet(&["reflect", "--metal", "Gold", "--model", "spectral", "--space", "acescg", "--format", "csv"]);
    assert_eq!(text.lines().next(), Some("theta_deg,red,green,blue"));
    let rows = csv_rows(&text);
    assert_eq!(rows.len(), 91);
    for row in rows {
        let truth = metal_by_name("Gold").unwrap().reflectance(CosTheta::from_deg(row[0]), RgbSpace::AcesCg);
        assert_eq!(rgb(&row), truth, "every bit survives");
    }
}

#[test]
fn reflect_is_unclamped_and_says_so() {
    let output = edgewise(&["reflect", "--metal", "Gold", "--space", "lin_rec709", "--angles", "0", "--format", "csv"]);
    let row = &csv_rows(&String::from_utf8(output.stdout.clone()).unwrap())[0];
    assert!(row[1] > 1.0, "measured gold exceeds 1 in linear sRGB: {row:?}");
    assert!(stderr(&output).starts_with("edgewise: warning: r "), "{}", stderr(&output));
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn reflect_evaluates_each_model_of_given_colours() {
    let curve = |model: &str| {
        let colours = ["reflect", "--r", "0.6,0.5,0.4", "--h", "0.7,0.6,0.55", "--angles", "0,45,max,90"];
        let output = edgewise(&[&colours[..], &["--model", model, "--format", "csv"]].concat());
        assert_eq!(output.status.code(), Some(0));
        csv_rows(&String::from_utf8(output.stdout).unwrap())
    };
    let angle = |row: &[f64]| CosTheta::from_deg(row[0]);
    for row in curve("hoffman").iter().chain(&curve("f82-tint")) {
        assert!((row[1] - hoffman(0.6, 0.7, angle(row))).abs() < 1e-14);
    }
    for row in curve("schlick") {
        assert_eq!(row[3], schlick(0.4, angle(&row)));
    }
    assert_eq!(curve("constant")[3][1..], [0.6, 0.5, 0.4]);
    assert_eq!(curve("hoffman")[2][0], THETA_MAX_DEG);
}

#[test]
fn reflect_warns_of_what_no_material_shows() {
    let curve =
        edgewise(&["reflect", "--r", "0.5,0.5,0.5", "--h", "0.01,0.5,0.5", "--angles", "60", "--format", "csv"]);
    assert_eq!(curve.status.code(), Some(0));
    assert!(stderr(&curve).contains("no material has this r and h"), "{}", stderr(&curve));
    let outside =
        edgewise(&["reflect", "--r", "-0.1,0.5,0.5", "--h", "0.5,1.5,0.5", "--angles", "0,max", "--format", "csv"]);
    assert_eq!(stderr(&outside).lines().count(), 2, "{}", stderr(&outside));
    let rows = csv_rows(&String::from_utf8(outside.stdout).unwrap());
    assert!(rows[0][1] == -0.1 && (rows[1][2] - 1.5).abs() < 1e-14, "unclamped: {rows:?}");
}

#[test]
fn reflect_with_few_wavelengths_approaches_the_truth() {
    let r = |model: &str| {
        json(&["reflect", "--metal", "Cr", "--model", model, "--angles", "0", "--json"])["curve"][0]["red"]
            .as_f64()
            .unwrap()
    };
    let errors = ["spectral-3", "spectral-8", "spectral-31"].map(|model| (r(model) - r("spectral")).abs());
    assert!(errors[0] > errors[2] && errors[2] < 1e-4, "{errors:?}");
}

#[test]
fn reflect_json_names_the_model_and_its_parameters() {
    let value = json(&["reflect", "--metal", "Cr", "--model", "f82-tint", "--angles", "0:90:45", "--json"]);
    let metal = metal_by_name("Cr").unwrap();
    let (r, h) = (metal.r(RgbSpace::LinRec709), metal.h(RgbSpace::LinRec709));
    assert_eq!(value["model"], json!({ "kind": "f82-tint", "r": r, "t": r.zip(h, t_from_r_h) }));
    assert_eq!((&value["space"], &value["material"]), (&json!("lin_rec709"), &json!("Chromium")));
    let angles: Vec<f64> =
        value["curve"].as_array().unwrap().iter().map(|row| row["theta_deg"].as_f64().unwrap()).collect();
    assert_eq!(angles, [0.0, 45.0, 90.0]);
}

#[test]
fn reflect_table_names_unit_and_space() {
    let text = quiet(&["reflect", "--metal", "Cr", "--space", "acescg", "--angles", "0,90"]);
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].contains("θ (°)") && lines[0].contains("red (acescg)"), "{text}");
    assert_eq!(lines.len(), 3);
    assert!(lines.iter().all(|line| line.chars().count() == lines[0].chars().count()), "aligned:\n{text}");
}

#[test]
fn reflect_reads_a_persons_own_data() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.csv");
    let rows: String = (38..=78).map(|w| format!("{},0.2,3.5\n", w * 10)).collect();
    fs::write(&path, format!("wavelength_nm,n,k\n{rows}")).unwrap();
    let value = json(&["reflect", "--nk", path.to_str().unwrap(), "--angles", "0", "--json"]);
    let r = value["curve"][0]["green"].as_f64().unwrap();
    // ((n − 1)² + k²) / ((n + 1)² + k²), the same for every wavelength.
    assert!((r - (0.64 + 12.25) / (1.44 + 12.25)).abs() < 1e-12, "{r}");
    assert_eq!(value["material"], json!("mine"));

    let yaml = folder.path().join("mine.yml");
    let rows: String = (38..=78).map(|w| format!("        {} 0.2 3.5\n", f64::from(w) / 100.0)).collect();
    fs::write(&yaml, format!("DATA:\n  - type: tabulated nk\n    data: |\n{rows}")).unwrap();
    let of_yaml = json(&["reflect", "--nk", yaml.to_str().unwrap(), "--angles", "0", "--json"]);
    assert!((of_yaml["curve"][0]["green"].as_f64().unwrap() - r).abs() < 1e-12);

    fs::write(&path, "wavelength_nm,n,k\n400,1,5\n").unwrap();
    let sentence = refusal(1, &["reflect", "--nk", path.to_str().unwrap()]);
    assert!(sentence.contains("mine.csv") && sentence.contains("450"), "{sentence}");
}

#[test]
fn reflect_keeps_a_presets_space_unless_another_is_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.json");
    let preset = Preset { space: RgbSpace::AcesCg, ..Preset::new_authored() };
    preset.save(&path).unwrap();
    let path = path.to_str().unwrap();
    let own = json(&["reflect", "--preset", path, "--angles", "0", "--json"]);
    assert_eq!((&own["space"], &own["model"]["r"]), (&json!("acescg"), &json!(preset.r)));
    let other = json(&["reflect", "--preset", path, "--space", "lin_rec2020", "--angles", "0", "--json"]);
    assert_eq!(other["model"]["r"], json!(preset.in_space(RgbSpace::LinRec2020).r));
}

#[test]
fn what_cannot_reflect_is_refused() {
    let colours = ["reflect", "--r", "0.6,0.5,0.4", "--h", "0.7,0.6,0.55"];
    let with = |more: &[&'static str]| [&colours[..], more].concat();
    assert!(refusal(1, &["reflect", "--metal", "Unobtainium"]).contains("Unobtainium"));
    assert!(refusal(1, &["reflect", "--nk", "no/such.csv"]).contains("no/such.csv"));
    assert!(refusal(1, &["reflect", "--preset", env!("CARGO_MANIFEST_DIR")]).contains("no regular file"));
    assert!(refusal(1, &with(&["--model", "spectral"])).contains("spectrum"));
    assert!(refusal(2, &with(&["--model", "phong"])).contains("hoffman"));
    assert!(refusal(2, &with(&["--model", "spectral-1"])).contains("2–401"));
    assert!(refusal(1, &with(&["--method", "exact"])).contains("--method"));
    assert!(
        refusal(1, &["reflect", "--metal", "Au", "--model", "conductor", "--method", "exact"])
            .contains("colour-matching")
    );
    assert!(refusal(2, &["reflect", "--r", "1.1,1,1", "--g", "1,1,1"]).contains("0–1"));
    assert!(refusal(2, &["reflect", "--n", "1,-1,1", "--k", "1,1,1"]).contains("at least 0"));
    assert!(refusal(2, &with(&["--t", "1,1,1"])).contains("one of --h, --t and --g"));
    assert!(refusal(2, &with(&["--space", "srgb"])).contains("lin_rec709"));
    assert!(refusal(2, &with(&["--angles", "0:91:1"])).contains("91°"));
    assert!(refusal(2, &with(&["--angles", "a"])).contains("“a” is no number"));
    assert!(refusal(2, &["reflect", "--r", "1,2", "--h", "1,2,3"]).contains("three numbers"));
    assert!(refusal(2, &["reflect", "--r", "NaN,0,0", "--h", "1,2,3"]).contains("not finite"));
    assert!(refusal(2, &["reflect", "--r", "1,1,1"]).contains("--h"));
    assert!(refusal(2, &["reflect", "--metal", "Au", "--preset", "p.json"]).contains("one material"));
    assert!(refusal(2, &["reflect"]).contains("one material"));
    refusal(2, &["reflect", "--metal", "Au", "--json", "--format", "csv"]);
}

#[test]
fn presets_of_another_version_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("future.json");
    fs::write(&path, Preset::new_authored().to_json().unwrap().replacen("\"edgewise\": 1", "\"edgewise\": 7", 1))
        .unwrap();
    let sentence = refusal(1, &["reflect", "--preset", path.to_str().unwrap()]);
    assert!(sentence.contains("future.json") && sentence.contains("format 7"), "{sentence}");
}

#[test]
fn reflect_plots_what_it_prints() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    let plot =
        |name: &str| quiet(&["reflect", "--metal", "Cr", "--model", "hoffman", "--plot", file(name).to_str().unwrap()]);
    assert_eq!(plot("curve.svg"), plot("curve.png"));
    let svg = fs::read_to_string(file("curve.svg")).unwrap();
    assert!(svg.contains("<svg") && svg.contains("Chromium") && svg.contains("Hoffman"), "{}", &svg[..200]);
    let png = image::open(file("curve.png")).unwrap().into_rgb8();
    let colours: std::collections::BTreeSet<[u8; 3]> = png.pixels().map(|pixel| pixel.0).collect();
    assert!(colours.len() > 100, "{} colours in {:?}", colours.len(), png.dimensions());

    for (name, reason) in [("curve.gif", ".svg or .png"), ("no/such/curve.svg", "no such file or folder")] {
        let sentence = refusal(1, &["reflect", "--metal", "Cr", "--plot", file(name).to_str().unwrap()]);
        assert!(sentence.contains(reason) && sentence.contains(name), "{sentence}");
    }
}

// --- inspect ---

/// A PNG whose sRGB chunk says how it is encoded.
fn png(folder: &Path, name: &str, width: u32, rgb: &[[u8; 3]]) -> String {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, rgb.len() as u32 / width);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(rgb.as_flattened()).unwrap();
    writer.finish().unwrap();
    let path = folder.join(name);
    fs::write(&path, bytes).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn inspect_reads_pixels_as_linear_rec709() {
    let folder = tempfile::tempdir().unwrap();
    let path = png(folder.path(), "two.png", 2, &[[128, 0, 255], [64, 64, 64]]);
    let value = json(&["inspect", &path, "--probe", "0,0;1,0", "--json"]);
    assert_eq!(
        (&value["width"], &value["height"], &value["colour_rule"]),
        (&json!(2), &json!(1), &json!("PNG sRGB chunk: sRGB"))
    );
    let red = value["probes"]["0,0"][0].as_f64().unwrap();
    // IEC 61966-2-1: ((128/255 + 0.055) / 1.055)^2.4.
    assert!((red - 0.215_860_5).abs() < 1e-6, "{red}");

    let csv = edgewise(&["inspect", &path, "--probe", "1,0", "--format", "csv"]);
    assert!(String::from_utf8(csv.stdout).unwrap().starts_with("x,y,red,green,blue\n1,0,0.05"));
    let facts = edgewise(&["inspect", &path, "--format", "csv"]);
    assert_eq!(String::from_utf8(facts.stdout).unwrap(), "width,height,colour_rule\n2,1,PNG sRGB chunk: sRGB\n");

    let outside = edgewise(&["inspect", &path, "--probe", "2,0", "--json"]);
    assert!(stderr(&outside).contains("there is no pixel 2,0 in a picture of 2 × 1"), "{}", stderr(&outside));
    assert_eq!(serde_json::from_slice::<Value>(&outside.stdout).unwrap()["probes"], json!({ "2,0": null }));
}

#[test]
fn what_is_no_photograph_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let text = folder.path().join("text.png");
    fs::write(&text, "no picture").unwrap();
    assert!(refusal(1, &["inspect", text.to_str().unwrap()]).contains("text.png"));
    assert!(refusal(1, &["inspect", "no/such.png"]).contains("no/such.png"));
    assert!(refusal(1, &["inspect", env!("CARGO_MANIFEST_DIR")]).contains("not a file"));
    assert!(refusal(2, &["inspect", "p.png", "--probe", "0.5,1"]).contains("“0.5,1” is no pixel"));
}

// --- samples, match ---

/// The file of a built-in sample, in a folder.
fn sample_file(folder: &Path, id: &str) -> String {
    let sample = sample(id).unwrap();
    let path = folder.join(&sample.facts.file);
    fs::write(&path, sample.bytes).unwrap();
    path.to_str().unwrap().to_owned()
}

const GOLD_MARKS: [&str; 4] = ["--circle", "206,204,132", "--card", "396,186,68,96@0.9"];

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
    let output = edgewise(&[&["match", &photo, "-o", preset.to_str().unwrap(), "--json"], &marks[..]].concat());
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

#[test]
fn a_folder_gives_one_line_each_and_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let photos = folder.path().join("photos");
    fs::create_dir(&photos).unwrap();
    let first = sample_file(&photos, "gold_tent");
    fs::copy(&first, photos.join("again.png")).unwrap();
    fs::write(photos.join("broken.png"), "no picture").unwrap();
    fs::write(photos.join("notes.txt"), "not a photograph").unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (results, presets) = (file("results.jsonl"), file("presets"));
    let run = |threads: &str| {
        let command =
            [&["match", photos.to_str().unwrap(), "--results", &results, "-o", &presets], &GOLD_MARKS[..]].concat();
        let binary = env!("CARGO_BIN_EXE_edgewise");
        Command::new(binary).args(&command).env("RAYON_NUM_THREADS", threads).output().unwrap()
    };

    let output = run("1");
    assert_eq!(output.status.code(), Some(1), "one failed");
    assert!(
        stderr(&output).contains("broken.png") && stderr(&output).contains("1 of 3 photographs failed"),
        "{}",
        stderr(&output)
    );
    assert!(stderr(&output).contains("1 files are no photographs"), "{}", stderr(&output));
    let lines: Vec<Value> =
        std::str::from_utf8(&output.stdout).unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let paths: Vec<&str> =
        lines.iter().map(|line| line["path"].as_str().unwrap().rsplit('/').next().unwrap()).collect();
    assert_eq!(paths, ["again.png", "broken.png", "gold_tent.png"]);
    assert_eq!(lines[0]["r"], lines[2]["r"]);
    assert!(lines[1]["error"].as_str().unwrap().contains("broken.png"));
    assert_eq!(fs::read_dir(&presets).unwrap().count(), 2);

    assert_eq!(fs::read_to_string(&results).unwrap().lines().count(), 2);
    let cut = fs::read_to_string(&results).unwrap();
    fs::write(&results, &cut[..cut.len() - 40]).unwrap();
    let resumed = run("4");
    assert_eq!(resumed.stdout, output.stdout, "whatever was known and however many threads");
    let repaired = fs::read_to_string(&results).unwrap();
    assert_eq!(repaired, cut, "the line that was cut short is whole again");

    fs::write(&results, "a letter\n").unwrap();
    let other = run("1");
    assert!(stderr(&other).lines().last().unwrap().contains("line 1 is no result"), "{}", stderr(&other));
    assert_eq!(fs::read_to_string(&results).unwrap(), "a letter\n");
    assert!(refusal(2, &["match", photos.to_str().unwrap(), "--format", "csv"]).contains("JSON"));
}

// --- convert, fit, study, export ---

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

// --- metals, presets ---

#[test]
fn metals_are_listed_in_every_format() {
    let all = json(&["metals", "--json"]);
    assert_eq!(all.as_array().unwrap().len(), metals().len());
    let preferred = json(&["metals", "--preferred", "--json"]);
    assert_eq!(preferred.as_array().unwrap().len(), preferred_metals().count());
    let gold = json(&["metals", "Au_Olmon-ts", "--space", "acescg", "--json"]);
    assert_eq!(gold[0]["r"], json!(metal_by_name("Gold").unwrap().r(RgbSpace::AcesCg)));
    assert_eq!(gold[0]["provenance"]["year"], json!("2012"));

    let csv = quiet(&["metals", "--format", "csv"]);
    let header = "id,name,symbol,category,preferred,r_red,r_green,r_blue,h_red,h_green,h_blue,source,range_nm";
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

// --- picture ---

/// A picture of 64 pixels written into a folder, and what is printed and said about it.
fn picture(folder: &Path, name: &str, more: &[&str]) -> (Vec<u8>, Value, String) {
    let path = folder.join(name);
    let arguments = [&["picture", "--size", "64", "--json", "-o", path.to_str().unwrap()], more].concat();
    let output = edgewise(&arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
    (fs::read(path).unwrap(), serde_json::from_slice(&output.stdout).unwrap(), stderr(&output))
}

/// Under white light the pixel in the middle is r itself, and an .exr keeps it although sRGB cannot show it.
#[test]
fn picture_exr_is_linear_in_the_space_and_unclipped() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--metal", "Au", "--light", "white", "--layout", "truth", "--space", "lin_rec709"];
    let (exr, _, _) = picture(folder.path(), "gold.exr", &options);
    let pixels = image::load_from_memory(&exr).unwrap().into_rgba32f();
    assert_eq!(pixels.dimensions(), (64, 64));
    let middle = Rgb([0, 1, 2].map(|channel| f64::from(pixels.get_pixel(32, 32)[channel])));
    let r = metal_by_name("Au").unwrap().r(RgbSpace::LinRec709);
    assert!(r[0] > 1.0 && middle.max_abs_difference(r) < 1e-4, "{middle:?} {r:?}");
    assert_eq!(pixels.get_pixel(0, 0).0, [0.0; 4], "nothing beside the sphere");

    let (_, _, said) = picture(folder.path(), "gold.png", &options);
    assert!(said.contains("outside sRGB and are clipped"), "{said}");
    let darker = [&options[..], &["--exposure", "-1"]].concat();
    let (exr, _, _) = picture(folder.path(), "darker.exr", &darker);
    let pixels = image::load_from_memory(&exr).unwrap().into_rgba32f();
    assert!((f64::from(pixels.get_pixel(32, 32)[0]) / middle[0] - 0.5).abs() < 1e-6, "a stop is a factor of two");
}

/// The numbers that are printed are those of the difference picture, and beside and wipe hold the same pixels.
#[test]
fn picture_layouts_show_the_same_two_spheres() {
    let folder = tempfile::tempdir().unwrap();
    let of = |layout: &str, ending: &str| {
        let options = ["--metal", "Cr", "--model", "schlick", "--light", "soft-boxes", "--layout", layout];
        picture(folder.path(), &format!("{layout}.{ending}"), &options)
    };
    let decoded = |layout: &str| image::load_from_memory(&of(layout, "exr").0).unwrap().into_rgba32f();
    let [truth, model, beside, wipe, difference] = ["truth", "model", "beside", "wipe", "difference"].map(decoded);
    assert_eq!(beside.dimensions(), (64 + 4 + 64, 64));
    for (column, row) in [(20, 5), (32, 32), (50, 60)] {
        assert_eq!(beside.get_pixel(column, row), truth.get_pixel(column, row));
        assert_eq!(beside.get_pixel(column + 68, row), model.get_pixel(column, row));
        let half = if column < 32 { &truth } else { &model };
        assert_eq!(wipe.get_pixel(column, row), half.get_pixel(column, row));
    }
    let (png, value, _) = of("difference", "png");
    let whole = difference.pixels().filter(|pixel| pixel[3] == 1.0).map(|pixel| f64::from(pixel[0]));
    let largest = whole.fold(0.0, f64::max);
    let (mean, max) = (value["mean_delta_e"].as_f64().unwrap(), value["max_delta_e"].as_f64().unwrap());
    assert!(0.0 < mean && mean < largest && largest <= max, "{mean} {largest} {max}");
    assert_eq!(image::load_from_memory(&png).unwrap().width(), 916, "a legible page around small spheres");
}

#[test]
fn picture_of_a_preset_needs_a_model_to_compare_with() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rough.json");
    Preset { roughness: 0.5, ..Preset::new_authored() }.save(&path).unwrap();
    let preset = ["--preset", path.to_str().unwrap()];
    let (_, alone, _) = picture(folder.path(), "alone.png", &preset);
    assert_eq!(
        (&alone["roughness"], &alone["max_delta_e"], &alone["model"]),
        (&json!(0.5), &Value::Null, &Value::Null)
    );
    let same = [&preset[..], &["--model", "f82-tint", "--roughness", "0"]].concat();
    let (_, same, _) = picture(folder.path(), "same.png", &same);
    assert_eq!((&same["roughness"], &same["model"]["kind"]), (&json!(0.0), &json!("f82-tint")));
    assert!(same["max_delta_e"].as_f64().unwrap() < 1e-3, "two words for one curve: {same}");

    let wipe = [&["picture"], &preset[..], &["--layout", "wipe", "-o", "never.png"]].concat();
    assert!(refusal(1, &wipe).contains("--model"));
}

#[test]
fn pictures_that_cannot_be_are_refused() {
    let with = |more: &[&'static str]| [&["picture", "--metal", "Cr"], more].concat();
    assert!(refusal(1, &with(&["-o", "sphere.bmp"])).contains(".png or .exr"));
    assert!(refusal(2, &with(&["--light", "moon"])).contains("city-square"));
    assert!(refusal(2, &with(&["--size", "7"])).contains("8..=4096"));
    assert!(refusal(2, &with(&["--roughness", "-0.1"])).contains("0–1"));
    assert!(refusal(2, &with(&["--exposure", "99"])).contains("99 stops"));
    assert!(refusal(2, &with(&["--full-scale", "0"])).contains("above 0"));
    assert!(refusal(2, &with(&["--layout", "wipe"])).contains("--output"));
    assert!(refusal(2, &["picture"]).contains("name one material"));
    assert!(refusal(1, &with(&["--model", "spectral", "--method", "exact"])).contains("--method"));
    assert!(refusal(1, &with(&["-o", "no/such/folder/sphere.png"])).contains("no/such/folder"));
}

// --- the program ---

const SUBCOMMANDS: [&str; 12] = [
    "match", "inspect", "samples", "metals", "reflect", "picture", "fit", "convert", "presets", "import", "export",
    "study",
];

#[test]
fn help_names_every_subcommand_and_each_has_both_format_flags() {
    let help = quiet(&["--help"]);
    for subcommand in SUBCOMMANDS {
        assert!(help.contains(&format!("\n  {subcommand} ")), "{help}");
        let path: &[&str] =
            if subcommand == "study" { &["study", "accuracy", "--help"] } else { &[subcommand, "--help"] };
        let help = quiet(path);
        assert!(help.contains("--json") && help.contains("--format"), "{subcommand}");
    }
    assert!(quiet(&["--version"]).contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn a_file_that_is_not_there_opens_no_window() {
    assert!(refusal(1, &["no/such/photo.png"]).contains("no/such/photo.png"));
    assert!(refusal(2, &["--no-such-flag"]).contains("--no-such-flag"));
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_is_no_error() {
    let script =
        format!("'{}' metals --json | head -c 1 >/dev/null; exit ${{PIPESTATUS[0]}}", env!("CARGO_BIN_EXE_edgewise"));
    let output = Command::new("bash").args(["-c", &script]).output().unwrap();
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), String::new()));
    assert!(Path::new("/dev/null").exists());
}

// --- docs/cli.md ---

const CLI_DOCUMENT: &str = include_str!("../docs/cli.md");

/// The part of the document under a heading.
fn section(heading: &str) -> &'static str {
    let parts =
        CLI_DOCUMENT.split("\n## ").find(|part| part.lines().next().unwrap().split(", ").any(|name| name == heading));
    parts.unwrap_or_else(|| panic!("docs/cli.md has no section {heading}"))
}

#[test]
fn the_document_has_a_section_for_each_subcommand() {
    for subcommand in SUBCOMMANDS {
        assert!(section(subcommand).contains(&format!("`edgewise {subcommand}")), "{subcommand}");
    }
}

#[test]
fn the_document_names_every_field() {
    let folder = tempfile::tempdir().unwrap();
    let photo = sample_file(folder.path(), "gold_tent");
    let out = folder.path().to_str().unwrap();
    let runs: [&[&str]; 11] = [
        &["match", "--sample", "gold_tent"],
        &["inspect", &photo, "--probe", "0,0"],
        &["samples"],
        &["metals", "Au"],
        &["reflect", "--metal", "Au", "--angles", "0"],
        &["picture", "--metal", "Cr", "--size", "16"],
        &["fit", "--metal", "Cr", "--model", "schlick"],
        &["convert", "--r", "0.6,0.5,0.4", "--h", "0.7,0.6,0.5", "--to", "f82-tint"],
        &["presets"],
        &["export", "--metal", "Cr", "--to", "glsl", "-o", out],
        &["study", "accuracy", "--metal", "Cr", "--candidate", "hoffman:exact"],
    ];
    for arguments in runs {
        let value = json(&[arguments, &["--json"]].concat());
        let object = value.get(0).unwrap_or(&value).as_object().unwrap();
        for name in object.keys() {
            assert!(
                section(arguments[0]).contains(&format!("`{name}`")),
                "docs/cli.md: {} has no `{name}`",
                arguments[0]
            );
        }
        let _ = fs::remove_file(folder.path().join("chromium.glsl"));
        let csv = edgewise(&[arguments, &["--format", "csv"]].concat());
        let header = std::str::from_utf8(&csv.stdout).unwrap().lines().next().unwrap().replace(",true_r,true_h", "");
        let text = section(arguments[0]);
        let names_it = text.contains(&header) || header.split(',').all(|name| text.contains(&format!("`{name}`")));
        assert!(names_it, "docs/cli.md: {} has no {header}", arguments[0]);
    }
}
