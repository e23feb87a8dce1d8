//! The page of measured metals.

use std::fs;

use edgewise::color::RgbSpace;
use edgewise::gui::Page;
use edgewise::metal::metal_by_name;
use edgewise::preset::Origin;
use eframe::egui::{Key, Modifiers};

use crate::drive::Window;

fn open_metals() -> Window {
    let mut window = Window::open(None);
    window.press(Modifiers::COMMAND, Key::Num2);
    window
}

#[test]
fn a_preset_starts_from_a_metal_with_its_source() {
    let mut window = open_metals();
    window.enter("Search metals", "titanium n");
    window.click("Titanium nitride");
    window.click("New preset from this metal");
    assert_eq!(window.harness.state().state().page, Page::Author);
    let metal = metal_by_name("Titanium nitride").unwrap();
    assert_eq!(window.preset().r, metal.r(RgbSpace::LinRec709));
    assert_eq!(window.preset().h, metal.h(RgbSpace::LinRec709));
    let Origin::Measured { metal: id, provenance } = &window.preset().origin else { panic!("measured") };
    assert_eq!((id, provenance), (&metal.id, &metal.provenance));
}

#[test]
fn a_model_can_be_drawn_and_its_error_read() {
    let mut window = open_metals();
    assert!(window.shows("Olmon"), "where the data come from");
    window.click("n, k weighted");
    let metal = metal_by_name("gold").unwrap();
    use edgewise::fit::{Method, fit};
    let fit = fit(metal, edgewise::fresnel::ModelKind::Conductor, Method::ColourMatching, RgbSpace::LinRec709).unwrap();
    assert!(window.shows(&format!("mean ΔE {:5.2}", fit.error.mean_delta_e)));
}

#[test]
fn the_table_sorts_and_chooses() {
    let mut window = open_metals();
    window.click("All metals");
    assert!(window.shows("Sort by Schlick"));
    window.click("Sort by Schlick");
    window.click("Sort by Schlick");
    // Facts: zinc is Schlick's hardest case but for the alkali metals.
    assert!(window.shows("Zinc"));
}

#[test]
fn a_file_of_n_and_k_joins_the_library_or_is_refused_in_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let (good, bad) = (folder.path().join("mine.csv"), folder.path().join("bad.csv"));
    let rows: String = (400..=700).step_by(50).map(|nm| format!("{nm},1.2,3.4\n")).collect();
    fs::write(&good, format!("# name: My alloy\nwavelength_nm,n,k\n{rows}")).unwrap();
    fs::write(&bad, "wavelength_nm,n,k\n400,1\n").unwrap();
    let mut window = open_metals();
    window.enter("Path of a file of n and k", good.to_str().unwrap());
    assert_eq!(window.notices(), [""; 0]);
    assert!(window.shows("My alloy"));
    assert!(window.shows("The data cover 400–700 nm"));
    window.enter("Path of a file of n and k", bad.to_str().unwrap());
    let notices = window.notices();
    assert!(notices.len() == 1 && notices[0].contains("bad.csv"), "{notices:?}");
}

#[test]
fn a_file_of_refractiveindex_info_joins_too() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.yml");
    let rows: String = (40..=70).step_by(5).map(|part| format!("        0.{part} 1.2 3.4\n")).collect();
    fs::write(&path, format!("DATA:\n  - type: tabulated nk\n    data: |\n{rows}")).unwrap();
    let mut window = open_metals();
    window.enter("Path of a file of n and k", path.to_str().unwrap());
    assert_eq!(window.notices(), [""; 0]);
    assert!(window.shows("The data cover 400–700 nm"));
}
