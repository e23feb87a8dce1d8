//! Unsaved work outlives a window that ends unexpectedly.

use std::fs;
use std::path::{Path, PathBuf};

use edgewise::preset::Preset;
use eframe::egui::{Key, Modifiers};

use crate::drive::Window;

/// A window that keeps unsaved work in the folder.
fn open_in(folder: &Path) -> Window {
    let mut window = Window::open(None);
    window.harness.state_mut().keep_unsaved_work_in(folder);
    window.settle();
    window
}

fn copies(folder: &Path) -> Vec<PathBuf> {
    let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    paths.filter(|path| path.extension().is_some_and(|extension| extension == "json")).collect()
}

#[test]
fn unsaved_work_is_on_disk_while_it_is_unsaved() {
    let folder = tempfile::tempdir().unwrap();
    let state = folder.path().join("made/on/demand");
    let mut window = open_in(&state);
    assert_eq!(copies(&state).len(), 0, "nothing to lose, nothing kept");
    window.enter("Name", "Precious");
    window.harness.run_steps(8);
    window.settle();
    let kept = copies(&state);
    assert_eq!(Preset::load(&kept[0]).unwrap().preset, *window.preset());
    window.press(Modifiers::COMMAND, Key::Z);
    window.settle();
    assert_eq!(copies(&state).len(), 0, "taken back: nothing to lose again");
}

#[test]
fn what_was_left_behind_is_offered_and_has_to_be_saved() {
    let folder = tempfile::tempdir().unwrap();
    let left = Preset { name: "Left behind".to_owned(), ..Preset::new_authored() };
    left.save(&folder.path().join("0.json")).unwrap();
    fs::write(folder.path().join("0.lock"), "").unwrap();
    let mut window = open_in(folder.path());
    assert!(window.shows("Open unsaved work?"));
    window.click("Open it");
    assert_eq!(*window.preset(), left);
    assert!(window.shows("unsaved changes"));
    let kept = copies(folder.path());
    assert_eq!((kept.len(), Preset::load(&kept[0]).unwrap().preset), (1, left), "it is this window's copy now");
}

#[test]
fn what_was_left_behind_can_wait_or_be_deleted() {
    let folder = tempfile::tempdir().unwrap();
    Preset::new_authored().save(&folder.path().join("0.json")).unwrap();
    fs::write(folder.path().join("0.lock"), "").unwrap();
    let mut window = open_in(folder.path());
    window.click("Later");
    assert_eq!(copies(folder.path()).len(), 1);
    drop(window);
    let mut window = open_in(folder.path());
    window.click("Delete it");
    assert_eq!(copies(folder.path()).len(), 0);
    assert!(!window.shows("unsaved changes"));
}

#[test]
fn a_window_that_is_open_elsewhere_keeps_its_own() {
    let folder = tempfile::tempdir().unwrap();
    Preset::new_authored().save(&folder.path().join("0.json")).unwrap();
    let lock = fs::File::create(folder.path().join("0.lock")).unwrap();
    lock.lock().unwrap();
    assert!(!open_in(folder.path()).shows("Open unsaved work?"));
}
