//! Does a batch come out the same however it is divided, ordered and repeated?

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::SystemTime;

use edgewise::color::Rgb;
use edgewise::preset::Preset;

use crate::run::{edgewise, json, quiet, refusal, stderr};

/// Presets of which some are called the same, some are copies, and one has a name like a hash.
fn library(folder: &Path) {
    for index in 0..40_u32 {
        let level = f64::from(index % 20) / 40.0 + 0.3;
        let name = if index % 5 == 0 { "Gold".to_owned() } else { format!("Metal {}", index % 20) };
        let preset = Preset { name, r: Rgb([level, 0.5, 0.4]), h: Rgb([0.8, 0.75, 0.7]), ..Preset::new_authored() };
        let inside = folder.join(format!("{}", index % 3));
        fs::create_dir_all(&inside).unwrap();
        preset.save(&inside.join(format!("{index:02}.json"))).unwrap();
    }
}

fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), fs::read(path).unwrap())).collect()
}

fn dates(folder: &Path) -> Vec<SystemTime> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<_> = entries.collect();
    paths.sort();
    paths.iter().map(|path| fs::metadata(path).unwrap().modified().unwrap()).collect()
}

fn with_threads(threads: &str, arguments: &[&str]) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewise"));
    let status = command.args(arguments).env("RAYON_NUM_THREADS", threads).stdin(Stdio::null());
    let status = status.stdout(Stdio::null()).stderr(Stdio::null()).status().unwrap();
    assert!(status.success(), "{arguments:?}");
}

#[test]
fn order_threads_and_shards_change_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    library(&folder.path().join("library"));
    let targets = ["--to", "open-pbr", "--to", "glsl", "--to", "standard-surface"];
    with_threads("1", &[&["export", &path("library"), "-o", &path("whole")], &targets[..]].concat());
    let whole = contents(&folder.path().join("whole"));
    assert_eq!(whole.len(), 3 * 40);

    let mut files: Vec<String> = (0..40).map(|index| path(&format!("library/{}/{index:02}.json", index % 3))).collect();
    files.reverse();
    files.swap(3, 17);
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    with_threads("4", &[&["export"], &files[..], &["-o", &path("reversed")], &targets[..]].concat());
    assert_eq!(contents(&folder.path().join("reversed")), whole);

    for shard in ["3/3", "1/3", "2/3"] {
        with_threads(
            "2",
            &[&["export", &path("library"), "--shard", shard, "-o", &path("shards")], &targets[..]].concat(),
        );
    }
    assert_eq!(contents(&folder.path().join("shards")), whole);
}

#[test]
fn what_is_there_already_stays_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    library(&folder.path().join("library"));
    let arguments = ["export", &path("library"), "--to", "usd", "-o", &path("out"), "--json"];
    edgewise(&arguments);
    let out = folder.path().join("out");
    let (before, written) = (contents(&out), dates(&out));
    assert!(refusal(1, &arguments).contains("40 files are"));
    let again = json(&[&arguments[..], &["--force"]].concat());
    assert_eq!(again[0]["unchanged"], 40);
    assert_eq!((contents(&out), dates(&out)), (before.clone(), written));
    // A file that a killed process or a person left in another state is made right.
    let (name, _) = before.first_key_value().unwrap();
    fs::write(out.join(name), "half a fi").unwrap();
    assert_eq!(json(&[&arguments[..], &["--force"]].concat())[0]["unchanged"], 39);
    assert_eq!(contents(&out), before);
}

#[test]
fn a_shard_may_be_empty_and_a_palette_is_never_divided() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    Preset { roughness: 0.0, ..Preset::new_authored() }.save(&folder.path().join("a.json")).unwrap();
    quiet(&["export", &path("a.json"), "--to", "glsl", "--shard", "2/2", "-o", &path("out")]);
    assert_eq!(fs::read_dir(folder.path().join("out")).unwrap().count(), 0);
    let palette = refusal(2, &["export", &path("a.json"), "--to", "gpl", "--shard", "1/2", "-o", &path("out")]);
    assert!(palette.contains("one file"), "{palette}");
    assert!(refusal(2, &["export", &path("a.json"), "--to", "glsl", "--shard", "3/2"]).contains("no shard"));
}

/// What cannot be exported is found before anything is written; what is no preset is said.
#[test]
fn a_folder_is_read_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    library(&folder.path().join("library"));
    fs::write(folder.path().join("library/package.json"), "{\"name\": 1}").unwrap();
    let output = edgewise(&["export", &path("library"), "--to", "hlsl", "-o", &path("out")]);
    assert!(stderr(&output).contains("package.json is no preset"), "{}", stderr(&output));
    assert_eq!(contents(&folder.path().join("out")).len(), 40);
    fs::write(folder.path().join("library/zzz.json"), "{\"edgewise\": 1}").unwrap();
    let error = refusal(1, &["export", &path("library"), "--to", "wgsl", "-o", &path("never")]);
    assert!(error.contains("zzz.json"), "{error}");
    assert!(!folder.path().join("never").exists());
    let named = refusal(1, &["export", &path("library/package.json"), "--to", "wgsl", "-o", &path("never")]);
    assert!(named.contains("no Edgewise preset"), "{named}");
}

#[test]
fn a_palette_keeps_the_order_it_was_given() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for name in ["A", "B"] {
        Preset { name: name.to_owned(), ..Preset::new_authored() }
            .save(&folder.path().join(format!("{name}.json")))
            .unwrap();
    }
    edgewise(&["export", &path("B.json"), &path("A.json"), "--to", "gpl", "-o", &path("mine.gpl")]);
    let text = fs::read_to_string(folder.path().join("mine.gpl")).unwrap();
    assert!(text.find("B r").unwrap() < text.find("A r").unwrap(), "{text}");
}
