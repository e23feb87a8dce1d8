//! Are many photographs matched one by one, whatever happens to one of them or to the run?

use std::fs;
use std::process::Command;

use edgewise::preset::Preset;
use serde_json::Value;

use crate::matching::{GOLD_MARKS, sample_file};
use crate::run::{edgewise, refusal, stderr};

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

/// The lines of a run, whether or not a photograph failed.
fn lines(arguments: &[&str]) -> (Vec<Value>, String) {
    let output = edgewise(arguments);
    let text = std::str::from_utf8(&output.stdout).unwrap();
    (text.lines().map(|line| serde_json::from_str(line).unwrap()).collect(), stderr(&output))
}

#[test]
fn photographs_of_one_name_get_presets_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for name in ["a", "b"] {
        fs::create_dir(file(name)).unwrap();
    }
    let gold = sample_file(&folder.path().join("a"), "gold_tent");
    let darker = image::open(&gold).unwrap().brighten(-2);
    darker.save(file("b/gold_tent.png")).unwrap();
    let (a, b, presets) = (file("a"), file("b"), file("presets"));
    let run = [&["match", &a, &b, &gold, "-o", &presets], &GOLD_MARKS[..]].concat();
    let (found, said) = lines(&run);
    assert!(said.contains("2 photographs share their names") && said.contains("named again"), "{said}");
    let saved: Vec<&str> = found.iter().map(|line| line["preset"].as_str().unwrap()).collect();
    assert!(saved.len() == 2 && saved[0] != saved[1], "{saved:?}");
    for (line, preset) in found.iter().zip(&saved) {
        let preset = Preset::load(preset.as_ref()).unwrap().preset;
        assert_eq!(serde_json::to_value(preset.r).unwrap(), line["r"]);
    }

    // The order changes no name, and what is there already is what would be written.
    let reversed = [&["match", &b, &a, "-o", &presets], &GOLD_MARKS[..]].concat();
    let again = lines(&reversed).0;
    assert_eq!((&again[0]["preset"], &again[1]["preset"]), (&found[1]["preset"], &found[0]["preset"]));
}

#[test]
fn another_preset_is_replaced_only_by_force() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    sample_file(folder.path(), "gold_tent");
    let preset = folder.path().join("gold_tent.png.json");
    Preset::new_authored().save(&preset).unwrap();
    let (out, results) = (folder.path().to_str().unwrap(), file("results.jsonl"));
    let run = [&["match", out, "-o", out, "--results", &results], &GOLD_MARKS[..]].concat();
    let (found, said) = lines(&run);
    assert!(found[0]["error"].as_str().unwrap().contains("--force") && said.contains("1 of 1"), "{said}");
    assert_eq!(Preset::load(&preset).unwrap().preset, Preset::new_authored());

    let forced = lines(&[&run[..], &["--force"]].concat()).0;
    assert_eq!(forced[0]["preset"].as_str().unwrap(), preset.to_str().unwrap());
    assert_ne!(Preset::load(&preset).unwrap().preset, Preset::new_authored());
    // A known line whose preset is another's by now is no result any more.
    Preset::new_authored().save(&preset).unwrap();
    assert!(lines(&run).0[0]["error"].is_string());
}

/// Outlines that are found differ from photograph to photograph; so does what the lines say.
#[test]
fn outlines_are_found_in_each_photograph() {
    let folder = tempfile::tempdir().unwrap();
    sample_file(folder.path(), "gold_tent");
    image::RgbImage::from_pixel(64, 64, image::Rgb([90; 3])).save(folder.path().join("plain.png")).unwrap();
    let (found, said) =
        lines(&["match", folder.path().to_str().unwrap(), "--circle", "auto", GOLD_MARKS[2], GOLD_MARKS[3]]);
    let radius = found[0]["request"]["circle"]["radius"].as_f64().unwrap();
    assert!((radius - 132.0).abs() < 1.0, "{radius}");
    assert_eq!(found[0]["outline"]["uncertainty_px"], found[0]["request"]["circle_uncertainty_px"]);
    assert!(found[1]["error"].as_str().unwrap().contains("no ball was found"), "{said}");
    assert_eq!(found[0]["task"]["outlines"], "auto");
}
