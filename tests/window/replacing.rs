//! A path that was typed, and the file that is there already.

use std::fs;
use std::path::Path;

use edgewise::preset::Preset;
use eframe::egui::{Key, Modifiers};

use crate::drive::Window;
use crate::planner::file;

const QUESTION: &str = "Replace the file?";

/// What the file says after the question was answered with a no, and with a yes.
fn answered(window: &mut Window, path: &Path, ask: impl Fn(&mut Window)) -> [String; 2] {
    fs::write(path, "precious").unwrap();
    ["Cancel", "Replace"].map(|answer| {
        ask(window);
        assert!(window.shows(QUESTION) && window.shows(path.to_str().unwrap()));
        window.click(answer);
        assert!(!window.shows(QUESTION));
        fs::read_to_string(path).unwrap()
    })
}

#[test]
fn a_plan_and_its_chart_replace_no_file_without_a_yes() {
    let folder = tempfile::tempdir().unwrap();
    let (plan, chart) = (folder.path().join("plan.json"), folder.path().join("trade.svg"));
    let mut window = Window::open(None);
    window.press(Modifiers::COMMAND, Key::Num4);
    let [no, yes] = answered(&mut window, &plan, |window| file(window, "Save plan…", "Save the plan", &plan));
    assert!(no == "precious" && yes.contains("edgewise_plan"));
    assert!(window.shows("Wrote plan.json"));
    window.click("Trade");
    let [no, yes] = answered(&mut window, &chart, |window| file(window, "SVG…", "Save the chart", &chart));
    assert!(no == "precious" && yes.starts_with("<svg"));
    assert_eq!(window.notices(), [""; 0]);
}

#[test]
fn a_preset_replaces_only_its_own_file_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.json");
    let mut window = Window::open(None);
    let save = |window: &mut Window| {
        window.command("Save to path");
        window.answer_path(&path);
    };
    let [no, _] = answered(&mut window, &path, save);
    assert_eq!(no, "precious");
    assert_eq!(Preset::load(&path).unwrap().preset, *window.preset());
    window.enter("Name", "Mine");
    save(&mut window);
    assert!(!window.shows(QUESTION));
    assert_eq!(Preset::load(&path).unwrap().preset.name, "Mine");
}

#[test]
fn what_is_to_be_done_after_saving_waits_for_the_answer() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kept.json");
    fs::write(&path, "precious").unwrap();
    let mut window = Window::open(None);
    window.enter("Name", "Changed");
    for (answer, name) in [("Cancel", "Changed"), ("Replace", "New metal")] {
        window.press(Modifiers::COMMAND, Key::N);
        window.click("Save");
        window.answer_path(&path);
        assert!(window.shows(QUESTION));
        window.click(answer);
        assert_eq!(window.preset().name, name);
    }
    assert_eq!(Preset::load(&path).unwrap().preset.name, "Changed");
}
