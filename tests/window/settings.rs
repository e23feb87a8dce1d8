//! What a person chose about the window is there again in the next one.

use std::fs;
use std::path::Path;

use eframe::egui::{Key, Modifiers, Theme};

use crate::drive::Window;

/// A window that keeps its settings in the file.
fn open_with(settings: &Path) -> Window {
    let mut window = Window::open(None);
    let ctx = window.harness.ctx.clone();
    window.harness.state_mut().keep_settings_in(&ctx, settings.to_owned());
    window.settle();
    window
}

#[test]
fn look_size_and_budget_outlive_the_window() {
    let folder = tempfile::tempdir().unwrap();
    let settings = folder.path().join("made/on/demand/settings.json");
    let mut window = open_with(&settings);
    let (theme, size) = (window.harness.ctx.theme(), window.harness.ctx.zoom_factor());
    assert!(!settings.exists(), "a window that is as every new one has nothing to keep");
    window.press(Modifiers::COMMAND, Key::L);
    window.click("Preview");
    window.drag_slider("Preview quality", 0.5, 0.99);
    window.press(Modifiers::NONE, Key::Escape);
    window.command("Larger");
    drop(window);
    let window = open_with(&settings);
    let other = if theme == Theme::Dark { Theme::Light } else { Theme::Dark };
    assert_eq!(window.harness.ctx.theme(), other);
    assert!(window.harness.ctx.zoom_factor() > size);
    let kept: serde_json::Value = serde_json::from_str(&fs::read_to_string(&settings).unwrap()).unwrap();
    assert!(kept["preview_ms"].as_f64().unwrap() > 100.0, "{kept}");
}

#[test]
fn a_file_that_cannot_be_used_is_said_and_left_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let settings = folder.path().join("settings.json");
    for text in [
        "{",
        r#"{"edgewise_settings":2,"preview_ms":16.0,"theme":"Dark","zoom":1.0}"#,
        r#"{"edgewise_settings":1,"preview_ms":1e9,"theme":"Dark","zoom":1.0}"#,
        r#"{"edgewise_settings":1,"preview_ms":16.0,"theme":"Dark","zoom":0.0}"#,
    ] {
        fs::write(&settings, text).unwrap();
        let mut window = open_with(&settings);
        assert!(window.notices()[0].contains("settings.json"), "{text}: {:?}", window.notices());
        window.press(Modifiers::COMMAND, Key::L);
        window.settle();
        assert_eq!(fs::read_to_string(&settings).unwrap(), text);
    }
}
