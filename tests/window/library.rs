//! A folder of presets, looked through in the window.

use std::fs;
use std::path::Path;

use edgewise::gui::Page;
use edgewise::preset::Preset;
use eframe::egui::{Key, Modifiers};

use crate::drive::Window;

fn save(folder: &Path, name: &str, tags: &[&str]) {
    let tags = tags.iter().map(|tag| (*tag).to_owned()).collect();
    let preset = Preset { name: name.to_owned(), tags, ..Preset::new_authored() };
    preset.save(&folder.join(preset.file_stem() + ".json")).unwrap();
}

fn open_library(folder: &Path) -> Window {
    let mut window = Window::open(None);
    window.press(Modifiers::COMMAND, Key::Num5);
    window.enter("Path of a folder of presets", folder.to_str().unwrap());
    window
}

/// Time enough for the folder to be looked at again.
fn wait(window: &mut Window) {
    for _ in 0..12 {
        window.harness.step();
    }
    window.settle();
}

#[test]
fn a_click_opens_what_was_searched_by_name_or_tag() {
    let folder = tempfile::tempdir().unwrap();
    save(folder.path(), "Hull steel", &["ship", "dark"]);
    save(folder.path(), "Bell bronze", &["ship"]);
    fs::write(folder.path().join("broken.json"), "{").unwrap();
    let mut window = open_library(folder.path());
    assert!(window.shows("3 of 3 files") && window.shows("broken.json"));
    window.enter("Search presets", "bron");
    assert!(window.shows("Open Bell bronze") && !window.shows("Open Hull steel"));
    window.clear("Search presets");
    window.click("Tag: dark");
    assert!(window.shows("Open Hull steel") && !window.shows("Open Bell bronze"));
    window.click("Tag: dark");
    assert!(window.shows("Open Bell bronze"));
    window.click("Open Hull steel");
    assert_eq!((window.preset().name.as_str(), window.harness.state().state().page), ("Hull steel", Page::Author));
    assert_eq!(window.notices(), [""; 0]);
}

#[test]
fn the_list_follows_what_others_do_to_the_files() {
    let folder = tempfile::tempdir().unwrap();
    save(folder.path(), "One", &[]);
    let mut window = open_library(folder.path());
    assert!(window.shows("1 of 1 files"));
    save(folder.path(), "Two", &["new"]);
    wait(&mut window);
    assert!(window.shows("Open Two") && window.shows("Tag: new"));
    fs::remove_file(folder.path().join("one.json")).unwrap();
    wait(&mut window);
    assert!(!window.shows("Open One") && window.shows("1 of 1 files"));
    fs::remove_dir_all(folder.path()).unwrap();
    wait(&mut window);
    assert!(window.shows("no such file or folder"));
}

#[test]
fn a_folder_that_is_none_is_a_sentence() {
    let mut window = Window::open(None);
    window.command("Open library folder");
    window.answer_path(Path::new("/no/such/folder"));
    assert_eq!(window.harness.state().state().page, Page::Library);
    assert!(window.shows("no such file or folder"));
}
