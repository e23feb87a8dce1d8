//! Exporting for renderers, and importing what other programs wrote.

use std::fs;

use edgewise::color::{Rgb, RgbSpace};
use edgewise::export::{Options, Target, export};
use edgewise::metal::metal_by_name;
use edgewise::preset::Preset;
use eframe::egui::{Key, Modifiers};

use crate::drive::Window;

fn open_export() -> Window {
    let mut window = Window::open(None);
    window.command("Export");
    window
}

fn gold() -> Preset {
    Preset::from_metal(metal_by_name("gold").unwrap(), RgbSpace::LinRec709)
}

fn with_gold() -> Window {
    let mut window = Window::open(None);
    window.command("New from metal");
    window.type_text("gold");
    window.press(Modifiers::NONE, Key::Enter);
    window.press(Modifiers::COMMAND, Key::E);
    window
}

#[test]
fn every_target_shows_its_file() {
    let mut window = open_export();
    assert!(window.shows("Nothing is lost"), "OpenPBR says all of a grey metal");
    for target in Target::ALL {
        window.click(target.label());
        let exported = export(window.preset(), target, &Options::default()).unwrap();
        let file = &exported.files[0];
        assert!(window.shows(&file.name), "{target}");
        assert!(window.shows(&format!("{} bytes", file.bytes.len())), "{target}");
    }
    window.click("GLSL source");
    assert!(window.shows("vec3 fresnel_new_metal(float cosTheta)"), "the text itself");
}

#[test]
fn what_is_lost_is_said_by_channel() {
    let mut window = with_gold();
    let exported = export(&gold(), Target::OpenPbr, &Options::default()).unwrap();
    let loss = &exported.losses[0];
    assert!(window.shows(&loss.to_string()), "{loss}");
    assert!(window.shows("largest |ΔF|, red") && window.shows("largest |ΔF|, blue"));
    assert!(window.shows(&format!("{:.5}", loss.difference.delta_f[0])));
    assert!(window.shows(&format!("{:.3}", loss.difference.max_delta_e)));
    window.click("Working space of the export");
    window.click("ACEScg");
    assert!(window.shows("gold.acescg.open_pbr.mtlx"));
    assert!(!window.shows("clip r red"), "ACEScg holds the r of gold");
    window.click("glTF binary");
    assert!(window.shows("the only one this format has"));
}

#[test]
fn the_file_is_written_to_a_path_and_replaced_only_with_a_yes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.glsl");
    let mut window = with_gold();
    window.click("GLSL source");
    window.enter("Path to write to", path.to_str().unwrap());
    let wanted = export(&gold(), Target::Glsl, &Options::default()).unwrap().files.remove(0).bytes;
    assert_eq!(fs::read(&path).unwrap(), wanted);
    assert!(window.shows(&format!("Written: {}", path.display())));

    fs::write(&path, "precious").unwrap();
    window.click("Write");
    assert!(window.shows("Replace the file?"));
    assert_eq!(fs::read_to_string(&path).unwrap(), "precious");
    window.click("Cancel");
    assert_eq!(fs::read_to_string(&path).unwrap(), "precious");
    window.click("Write");
    window.click("Replace");
    assert_eq!(fs::read(&path).unwrap(), wanted);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);

    window.enter("Path to write to", folder.path().to_str().unwrap());
    assert!(folder.path().join("gold.glsl").is_file(), "a folder stands for the usual name in it");
    window.enter("Path to write to", folder.path().join("no/such/a.glsl").to_str().unwrap());
    assert!(window.shows("no such file or folder"));
    window.click("Close");
    assert!(!window.shows("Path to write to"));
    assert_eq!(window.notices(), [""; 0]);
}

#[test]
fn a_system_without_a_dialog_says_so_and_takes_a_path() {
    let mut window = open_export();
    window.click("Choose a file…");
    assert!(window.shows("no file dialog service"));
    window.press(Modifiers::NONE, Key::Escape);
    assert!(!window.shows("Path to write to"));
}

#[test]
fn what_another_program_wrote_becomes_the_preset() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("chromium.mtlx");
    let chromium = Preset::from_metal(metal_by_name("chromium").unwrap(), RgbSpace::AcesCg);
    let options = Options { space: Some(RgbSpace::AcesCg) };
    fs::write(&path, &export(&chromium, Target::OpenPbr, &options).unwrap().files[0].bytes).unwrap();
    let mut window = Window::open(None);
    window.command("Import");
    window.answer_path(&path);
    assert_eq!((window.preset().name.as_str(), window.preset().space), ("chromium", RgbSpace::AcesCg));
    assert!(window.preset().h.max_abs_difference(chromium.h) < 1e-8);
    assert_eq!(window.notices(), [""; 0]);
    let opened = Window::open(Some(path));
    assert_eq!(opened.preset().h, window.preset().h, "Open knows it too");
}

#[test]
fn of_several_imported_metals_one_is_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.csv");
    let head = "name,space,r_red,r_green,r_blue,h_red,h_green,h_blue";
    fs::write(&path, format!("{head}\nOne,acescg,0.5,0.5,0.5,0.7,0.7,0.7\nTwo,acescg,0.6,0.5,0.4,0.7,0.7,0.7\n"))
        .unwrap();
    let mut window = Window::open(None);
    window.press(Modifiers::COMMAND, Key::I);
    window.answer_path(&path);
    assert!(window.shows("2 metals were found"));
    window.click("Start with Two");
    assert_eq!((window.preset().name.as_str(), window.preset().r), ("Two", Rgb([0.6, 0.5, 0.4])));
}

#[test]
fn a_file_that_holds_no_metal_is_a_sentence_and_unsaved_changes_are_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let (bad, good) = (folder.path().join("bad.gltf"), folder.path().join("good.txt"));
    fs::write(&bad, "[".repeat(100_000)).unwrap();
    fs::write(&good, "name: Pasted\nspace: acescg\nr: 0.5 0.5 0.5\nh: 0.7 0.7 0.7\n").unwrap();
    let mut window = Window::open(None);
    window.enter("Name", "Precious");
    window.command("Import");
    window.answer_path(&bad);
    let notices = window.notices();
    assert!(notices.len() == 1 && notices[0].contains("bad.gltf"), "{notices:?}");
    window.command("Import");
    window.answer_path(&good);
    assert!(window.shows("Save changes?"));
    window.click("Discard changes");
    assert_eq!(window.preset().name, "Pasted");
}
