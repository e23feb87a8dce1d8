//! Does a curve on the command line have the values, formats and warnings it promises?

use std::fs;

use edgewise::color::RgbSpace;
use edgewise::fresnel::{CosTheta, THETA_MAX_DEG, hoffman, schlick, t_from_r_h};
use edgewise::metal::metal_by_name;
use edgewise::preset::Preset;
use serde_json::json;

use crate::run::{csv_rows, edgewise, json, quiet, refusal, rgb, stderr};

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
    assert!(refusal(1, &["reflect", "--preset", env!("CARGO_MANIFEST_DIR")]).contains("not a file"));
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

#[test]
fn reflect_draws_other_models_beside_it_on_either_ground() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("curves.svg");
    let arguments = ["reflect", "--metal", "Cr", "--plot", path.to_str().unwrap()];
    let draw = |more: &[&str]| {
        quiet(&[&arguments[..], more].concat());
        std::fs::read_to_string(&path).unwrap()
    };
    let others = ["--compare", "schlick", "--compare", "conductor:colour-matching", "--compare", "spectral-8"];
    let light = draw(&others);
    for name in ["Truth", "Schlick", "Conductor", "colour-matching", "8 wavelengths"] {
        assert!(light.contains(name), "{name}");
    }
    let dark = draw(&[&others[..], &["--theme", "dark"]].concat());
    assert!(dark.contains("#191919") && !light.contains("#191919"), "the ground");
    assert!(refusal(2, &[&arguments[..], &["--theme", "sepia"]].concat()).contains("light, dark"));
    assert!(refusal(2, &[&arguments[..], &["--compare", "schlick:by-eye"]].concat()).contains("by-eye"));
    assert!(refusal(2, &["reflect", "--metal", "Cr", "--compare", "schlick"]).contains("--plot"));
}
