//! Saving, opening, and what is refused.

use std::fs;

use edgewise::preset::Preset;
use edgewise::sample::samples;
use eframe::egui::{Key, Modifiers};

use crate::drive::Window;

#[test]
fn what_is_saved_opens_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine é.json");
    let mut window = Window::open(None);
    window.enter("Name", "Mine é");
    window.enter("r sRGB hex code", "#c89b6e");
    window.command("Save to path");
    window.answer_path(&path);
    assert_eq!(window.notices(), [""; 0]);
    assert!(window.shows("mine é.json, no changes"));
    let reopened = Window::open(Some(path.clone()));
    assert_eq!(reopened.preset(), window.preset());
    window.enter("h sRGB hex code", "#808080");
    assert!(window.shows("mine é.json, unsaved changes"));
    window.press(Modifiers::COMMAND, Key::S);
    assert_eq!(Preset::load(&path).unwrap().preset, *window.preset(), "saved to the file it has");
}

#[test]
fn fields_that_a_match_leaves_no_place_for_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("studio.json");
    let text = Preset::new_authored().to_json().unwrap();
    fs::write(&path, text.replace("\"kind\": \"authored\"", "\"kind\": \"authored\", \"artist\": \"M\"")).unwrap();
    let mut window = Window::open(Some(path.clone()));
    window.enter("Name", "Matched");
    window.press(Modifiers::COMMAND, Key::S);
    assert_eq!(window.notices(), [""; 0]);
    assert!(fs::read_to_string(&path).unwrap().contains("\"artist\": \"M\""));
    window.click(&samples()[0].facts.title);
    window.press(Modifiers::COMMAND, Key::S);
    let notices = window.notices();
    assert!(notices.len() == 1 && notices[0].contains("left out: origin"), "{notices:?}");
}

#[test]
fn a_bad_file_is_a_sentence_and_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.json");
    fs::write(&path, "{\"edgewise\": 999}").unwrap();
    let mut window = Window::open(None);
    let before = window.preset().clone();
    for bad in [&path, &folder.path().join("missing.json"), &folder.path().to_owned()] {
        window.press(Modifiers::COMMAND | Modifiers::SHIFT, Key::O);
        window.answer_path(bad);
        let notices = window.notices();
        assert!(notices.len() == 1 && notices[0].contains(bad.to_str().unwrap()), "{notices:?}");
        window.click(&format!("Dismiss: {}", notices[0]));
        assert_eq!(window.notices(), [""; 0]);
    }
    assert_eq!(*window.preset(), before);
}

#[test]
fn unsaved_changes_are_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kept.json");
    let mut window = Window::open(None);
    window.enter("Name", "Precious");
    let changed = window.preset().clone();
    window.press(Modifiers::COMMAND, Key::N);
    assert!(window.shows("Save changes?"));
    window.click("Cancel");
    assert_eq!(*window.preset(), changed);
    // Save, by typing a path because there is no dialog service here, and then go on.
    window.press(Modifiers::COMMAND, Key::N);
    window.click("Save");
    window.answer_path(&path);
    assert_eq!(Preset::load(&path).unwrap().preset, changed);
    assert_eq!(*window.preset(), Preset::new_authored());
    window.enter("Name", "Lost");
    window.press(Modifiers::COMMAND, Key::N);
    window.click("Discard changes");
    assert_eq!(*window.preset(), Preset::new_authored());
}

#[test]
fn closing_the_window_asks_too() {
    let mut window = Window::open(None);
    window.enter("Name", "Precious");
    window
        .harness
        .input_mut()
        .viewports
        .entry(eframe::egui::ViewportId::ROOT)
        .or_default()
        .events
        .push(eframe::egui::ViewportEvent::Close);
    window.settle();
    assert!(window.shows("Save changes?"));
}
