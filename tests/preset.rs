//! Does a preset survive everything that happens to files?

use std::fs;
use std::path::Path;

use edgewise::color::{Rgb, RgbSpace};
use edgewise::file::replace_file;
use edgewise::metal::{Provenance, metal_by_name, preferred_metals};
use edgewise::photo::Recipe;
use edgewise::preset::{Origin, PRESET_FORMAT, Preset, built_in_presets, presets_from_metals};
use proptest::prelude::*;
use serde_json::{Map, Value, json};

fn gold() -> Preset {
    Preset::from_metal(metal_by_name("Gold").unwrap(), RgbSpace::LinRec709)
}

/// The JSON of gold with one field set, or removed by `None`.
fn with_field(name: &str, value: Option<Value>) -> String {
    let mut document: Map<String, Value> = serde_json::from_str(&gold().to_json().unwrap()).unwrap();
    match value {
        Some(value) => document.insert(name.to_owned(), value),
        None => document.shift_remove(name),
    };
    Value::Object(document).to_string()
}

fn reason(text: &str) -> String {
    let reason = Preset::from_json(text).expect_err(text).to_string();
    assert!(!reason.contains('\n'), "one sentence: {reason}");
    reason
}

// --- The text ---

prop_compose! {
    fn json_value()(kind in 0..5_usize, number in prop::num::f64::NORMAL, text in ".{0,8}", flag: bool) -> Value {
        let values: [Value; 5] = [number.into(), text.clone().into(), flag.into(), Value::Null, json!([number, { "deep": [text] }])];
        values[kind].clone()
    }
}

fn finite() -> impl Strategy<Value = f64> {
    prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO
}

fn rgb() -> impl Strategy<Value = Rgb> {
    prop::array::uniform3(finite()).prop_map(Rgb)
}

fn origin() -> impl Strategy<Value = Origin> {
    let measured = (".{0,12}", ".{0,40}", ".{0,4}").prop_map(|(metal, authors, year)| Origin::Measured {
        metal,
        provenance: Provenance { authors, year, ..Provenance::default() },
    });
    let matched = ".{0,12}".prop_map(|photo| Origin::Matched(Box::new(Recipe { photo, ..Recipe::default() })));
    prop_oneof![Just(Origin::Authored), measured, matched]
        .prop_flat_map(|o| prop_oneof![Just(o.clone()), Just(Origin::Edited { from: Box::new(o) })])
}

prop_compose! {
    fn preset()(
        name in ".{0,20}", space in prop::sample::select(RgbSpace::ALL.to_vec()), r in rgb(), h in rgb(),
        roughness in finite(), origin in origin(), tags in prop::collection::vec(".{0,8}", 0..3), notes in ".{0,40}",
        unknown in prop::collection::btree_map("new_[a-z]{1,8}", json_value(), 0..4),
    ) -> Preset {
        Preset { name, space, r, h, roughness, origin, tags, notes, unknown_fields: unknown.into_iter().collect() }
    }
}

proptest! {
    #[test]
    fn what_is_written_reads_back_exactly(preset in preset()) {
        let text = preset.to_json().unwrap();
        let read = Preset::from_json(&text).unwrap();
        prop_assert_eq!(&read.preset, &preset);
        prop_assert_eq!(read.warnings, Vec::<String>::new());
        prop_assert_eq!(read.preset.to_json().unwrap(), text);
    }

    #[test]
    fn any_text_is_read_or_refused_in_one_sentence(text in ".{0,200}") {
        prop_assert!(!Preset::from_json(&text).unwrap_err().to_string().contains('\n'));
    }

    /// Bytes of a real preset, changed: never a panic, and whatever is accepted can be written again.
    #[test]
    fn damaged_presets_are_read_or_refused(at in 0..1200_usize, with in any::<char>()) {
        let mut text: Vec<char> = gold().to_json().unwrap().chars().collect();
        let at = at % text.len();
        text[at] = with;
        if let Ok(read) = Preset::from_json(&text.into_iter().collect::<String>()) {
            prop_assert!(read.preset.to_json().is_ok());
        }
    }
}

#[test]
fn short_lists_are_on_one_line() {
    let text = gold().to_json().unwrap();
    assert!(text.starts_with(&format!("{{\n  \"edgewise\": {PRESET_FORMAT},\n  \"name\": \"Gold\",\n")), "{text}");
    assert!(text.lines().any(|line| line.starts_with("  \"r\": [") && line.ends_with("],")), "{text}");
}

#[test]
fn unknown_fields_survive_at_every_level() {
    let mut document: Value = serde_json::from_str(&gold().to_json().unwrap()).unwrap();
    document["studio"] = json!({ "shot": [1, 2.5, null] });
    document["origin"]["lab"] = json!("B12");
    document["origin"]["provenance"]["sample"] = json!({ "polish": true });
    let preset = Preset::from_json(&document.to_string()).unwrap().preset;
    let renamed = Preset { name: "Renamed".to_owned(), ..preset.clone() };
    document["name"] = json!("Renamed");
    assert_eq!(serde_json::from_str::<Value>(&renamed.to_json().unwrap()).unwrap(), document);

    let mut edited = preset.clone();
    edited.mark_edited();
    let edited: Value = serde_json::from_str(&edited.to_json().unwrap()).unwrap();
    assert_eq!(edited["origin"]["kind"], json!("edited"));
    assert_eq!(edited["origin"]["from"], document["origin"]);

    assert_eq!(preset.lost_fields(), [""; 0]);
    let authored = Preset { origin: Origin::Authored, ..preset };
    assert_eq!(authored.lost_fields(), ["origin"], "and whoever saves can say so");
    let authored: Value = serde_json::from_str(&authored.to_json().unwrap()).unwrap();
    assert_eq!(authored["origin"], json!({ "kind": "authored" }), "nothing of a measurement is left");
}

#[test]
fn missing_fields_are_named() {
    for name in ["name", "space", "r", "h", "roughness"] {
        assert!(reason(&with_field(name, None)).contains(&format!("“{name}” is missing")), "{name}");
    }
    for name in ["t", "origin", "tags", "notes"] {
        assert!(Preset::from_json(&with_field(name, None)).is_ok(), "{name} may be missing");
    }
    assert!(reason(&with_field("edgewise", None)).contains("no Edgewise preset"));
}

#[test]
fn wrong_types_are_named() {
    let wrong =
        [json!(null), json!("1"), json!(true), json!({}), json!([1, 2]), json!([1, 2, "3"]), json!([1, null, 3])];
    for value in wrong {
        for name in ["r", "h", "t", "roughness", "name", "space", "tags", "notes", "origin"] {
            let (is_text, is_empty) = (value.is_string(), name == "tags" && value == json!([]));
            if is_empty || (is_text && matches!(name, "name" | "notes")) {
                continue;
            }
            let reason = reason(&with_field(name, Some(value.clone())));
            assert!(reason.contains(name) || reason.contains("colour space"), "{name} = {value}: {reason}");
        }
    }
    assert!(reason(&with_field("space", Some(json!("srgb")))).contains("lin_rec709"));
    assert!(reason(&with_field("origin", Some(json!({ "kind": "dreamt" })))).contains("dreamt"));
}

#[test]
fn other_versions_are_refused_by_number() {
    for version in [json!(2), json!(0), json!("1"), json!(1.5), json!(null)] {
        let reason = reason(&with_field("edgewise", Some(version.clone())));
        assert!(reason.contains(&version.to_string()) && reason.contains("reads format 1"), "{reason}");
    }
}

#[test]
fn json_that_is_none_is_refused() {
    let r = |numbers: &str| gold().to_json().unwrap().replacen("\"r\": [", &format!("\"r\": [{numbers}, "), 1);
    for text in [r("NaN"), r("Infinity"), r("-Infinity"), r("1e999"), "[".repeat(100_000), String::new(), "[1]".into()]
    {
        reason(&text);
    }
    let twice = gold().to_json().unwrap().replacen("{", "{ \"name\": \"Silver\",", 1);
    assert!(reason(&twice).contains("“name” is given twice"));
}

#[test]
fn numbers_outside_the_unit_interval_are_kept() {
    let preset = Preset { r: Rgb([1.04, -0.02, 7.0]), h: Rgb([1e9, -3.0, 0.0]), roughness: 1.5, ..gold() };
    assert_eq!(Preset::from_json(&preset.to_json().unwrap()).unwrap().preset, preset);
}

#[test]
fn numbers_that_are_none_are_not_written() {
    for number in [f64::NAN, f64::INFINITY] {
        assert!(
            Preset { h: Rgb([0.5, number, 0.5]), ..gold() }.to_json().unwrap_err().to_string().starts_with("h is not")
        );
        assert!(Preset { roughness: number, ..gold() }.to_json().is_err());
    }
}

#[test]
fn a_contradicting_t_is_said_and_derived_again() {
    let read = Preset::from_json(&with_field("t", Some(json!([0.5, 0.5, 0.5])))).unwrap();
    assert_eq!(read.preset, gold());
    assert!(read.warnings.len() == 1 && read.warnings[0].contains("[0.5, 0.5, 0.5]"), "{:?}", read.warnings);

    let rounded = gold().tint().map(|t| (t * 1e4).round() / 1e4);
    assert!(Preset::from_json(&with_field("t", Some(json!(rounded)))).unwrap().warnings.is_empty());
}

// --- The file ---

#[test]
fn saves_and_loads() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("gold.json");
    gold().save(&path).unwrap();
    assert_eq!(Preset::load(&path).unwrap().preset, gold());
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "nothing is left beside it");
}

#[test]
fn files_that_cannot_be_presets_are_refused_unread() {
    let folder = tempfile::tempdir().unwrap();
    let refusal = |path: &Path| {
        let sentence = Preset::load(path).unwrap_err().to_string();
        assert!(sentence.starts_with(&path.display().to_string()), "names the file: {sentence}");
        sentence
    };
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    };
    assert!(refusal(folder.path()).contains("not a file"));
    assert!(refusal(&folder.path().join("none.json")).contains("no such file"));
    assert!(refusal(&file("latin1", b"{\"name\": \"\xe9\"}")).contains("UTF-8"));
    assert!(refusal(&file("huge", &vec![b' '; (4 << 20) + 1])).contains("4 MiB"));
}

#[test]
fn a_save_that_fails_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("gold.json");
    gold().save(&path).unwrap();
    assert!(Preset { r: Rgb::splat(f64::NAN), ..gold() }.save(&path).is_err());
    assert_eq!(Preset::load(&path).unwrap().preset, gold());

    assert!(gold().save(folder.path()).unwrap_err().to_string().contains("not a file"));
    assert!(gold().save(&folder.path().join("no/such/folder.json")).is_err());
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::{PermissionsExt, symlink};

    use super::*;

    #[test]
    fn links_and_modes_stay() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("gold.json"), folder.path().join("link.json"));
        fs::create_dir(folder.path().join("sub")).unwrap();
        symlink("sub/../gold.json", &link).unwrap();
        gold().save(&link).unwrap();
        assert!(file.is_file(), "a link that leads nowhere yet creates its file");

        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
        Preset { name: "Second".to_owned(), ..gold() }.save(&link).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
        assert_eq!(Preset::load(&file).unwrap().preset.name, "Second");
    }

    #[test]
    fn links_in_a_circle_end() {
        let folder = tempfile::tempdir().unwrap();
        let link = folder.path().join("circle.json");
        symlink("circle.json", &link).unwrap();
        assert!(gold().save(&link).is_err() && Preset::load(&link).is_err());
    }

    #[test]
    fn read_only_files_and_devices_are_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("gold.json");
        gold().save(&path).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).unwrap();
        let sentence = Preset { name: "Second".to_owned(), ..gold() }.save(&path).unwrap_err().to_string();
        assert!(sentence.contains("read-only"), "{sentence}");
        assert_eq!(Preset::load(&path).unwrap().preset.name, "Gold");
        assert!(replace_file(Path::new("/dev/null"), b"").unwrap_err().to_string().contains("not a file"));
    }

    #[test]
    fn a_pipe_is_refused_without_waiting_for_its_writer() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe.json");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        assert!(Preset::load(&pipe).unwrap_err().to_string().contains("not a file"));
        assert!(gold().save(&pipe).unwrap_err().to_string().contains("not a file"));
    }
}

// --- The library ---

#[test]
fn built_in_presets_are_those_of_the_metals() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("presets");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), preferred_metals().count(), "one file for each material");
    assert_eq!(built_in_presets().len(), preferred_metals().count());
    for made in presets_from_metals() {
        let path = folder.join(made.file_stem()).with_extension("json");
        let kept = Preset::load(&path).unwrap().preset;
        assert_eq!(fs::read_to_string(&path).unwrap(), kept.to_json().unwrap(), "{} is as we write it", path.display());
        // Another platform's cosine may differ in the last bits; the rest is equal.
        assert!(
            kept.r.max_abs_difference(made.r) < 1e-12 && kept.h.max_abs_difference(made.h) < 1e-12,
            "{}",
            made.name
        );
        assert_eq!(Preset { r: made.r, h: made.h, ..kept }, made, "run `edgewise presets --write presets`");
    }
}
