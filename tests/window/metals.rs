//! The page of measured metals.

use std::fs;

use edgewise::color::RgbSpace;
use edgewise::fit::{Method, fit};
use edgewise::fresnel::ModelKind;
use edgewise::gui::Page;
use edgewise::metal::metal_by_name;
use edgewise::preset::Origin;
use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

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
    window.tick("n, k weighted");
    let metal = metal_by_name("gold").unwrap();
    let fit = fit(metal, ModelKind::Conductor, Method::ColourMatching, RgbSpace::LinRec709).unwrap();
    assert!(window.shows(&format!("mean ΔE {:5.2}", fit.error.mean_delta_e)));
}

/// The spread of published measurements stands beside the error of the models.
#[test]
fn other_measurements_are_drawn_with_their_distance() {
    let mut window = open_metals();
    assert!(window.shows("median of 8 others"), "gold has nine sets");
    window.tick("measurements");
    assert!(!window.shows("median of 8 others"));
    window.tick("measurements");
    window.enter("Search metals", "iron");
    window.click("Iron");
    assert!(window.shows("the other to this one"), "a calculation is no measurement");
    assert!(window.shows("not measured"));
}

#[test]
fn the_table_sorts_and_chooses() {
    let mut window = open_metals();
    window.click("All metals");
    let top = |window: &Window, name: &str| window.harness.get_by_label(&format!("{name} in the table")).rect().top();
    assert!(top(&window, "Aluminium") < top(&window, "Beryllium"), "by name");
    window.click("Sort by Metal");
    assert!(!window.shows("Aluminium in the table"), "out of sight at the end");
    for (column, method) in [("r, h", Method::Exact), ("Lazányi", Method::LeastSquares)] {
        let kind = if column == "r, h" { ModelKind::Hoffman } else { ModelKind::Lazanyi };
        let mean = |name: &str| {
            fit(metal_by_name(name).unwrap(), kind, method, RgbSpace::LinRec709).unwrap().error.mean_delta_e
        };
        window.click(&format!("Sort by {column}"));
        window.click(&format!("Sort by {column}"));
        let mut worst = ["Caesium", "Zinc", "Rubidium"];
        worst.sort_by(|a, b| mean(b).total_cmp(&mean(a)));
        let tops = worst.map(|name| top(&window, name));
        assert!(tops.is_sorted(), "{column}: {worst:?} at {tops:?}");
    }
    window.click("Zinc in the table");
    window.click("Curves");
    assert!(window.shows("Querry 1987"), "the metal that was clicked is on show");
    assert!(window.shows("n reaches 13.908"), "and what is odd about its data");
}

/// The system's dialog is missing here, so the path is typed.
#[test]
fn curves_table_and_spheres_are_saved_from_the_window() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let mut window = open_metals();
    let save = |window: &mut Window, name: &str| {
        assert!(window.shows("Save the"), "a path is asked for");
        window.answer_path(&path(name));
        let notices = window.notices();
        assert!(notices.len() == 1 && notices[0].starts_with("Saved ") && notices[0].contains(name), "{notices:?}");
        window.click(&format!("Dismiss: {}", notices[0]));
    };
    window.click("Save curves…");
    save(&mut window, "curves.svg");
    let svg = fs::read_to_string(path("curves.svg")).unwrap();
    assert!(svg.contains("Gold") && svg.contains("Schlick"), "the models that were drawn");
    window.click("All metals");
    window.click("Save table…");
    save(&mut window, "table.png");
    assert!(image::open(path("table.png")).unwrap().height() > 1000);
    window.click("Spheres");
    for (what, name) in [("Truth beside model…", "beside.exr"), ("Wiped…", "wiped.png"), ("Difference…", "d.png")]
    {
        window.click("Save the spheres");
        window.click(what);
        save(&mut window, name);
    }
    assert_eq!(image::open(path("beside.exr")).unwrap().width(), 2 * 1024 + 64);
    assert_eq!(image::open(path("wiped.png")).unwrap().width(), 1024);
    assert!(image::open(path("d.png")).unwrap().width() > 3000);
}

#[test]
fn what_cannot_be_saved_is_a_sentence() {
    let mut window = open_metals();
    window.click("Save curves…");
    window.answer_path(std::path::Path::new("/no such folder/curves.svg"));
    let notices = window.notices();
    assert!(notices.len() == 1 && notices[0].contains("/no such folder"), "{notices:?}");
    window.click(&format!("Dismiss: {}", notices[0]));
    window.click("Save curves…");
    window.answer_path(std::path::Path::new("/tmp/curves.bmp"));
    assert!(window.notices()[0].contains(".svg or .png"), "{:?}", window.notices());
}

#[test]
fn spheres_show_the_truth_the_model_and_how_far_apart_they_are() {
    let mut window = open_metals();
    window.enter("Search metals", "chromium");
    window.click("Chromium");
    window.click("Spheres");
    let mean = |window: &Window| {
        let found = window.harness.query_all_by_label_contains("mean ΔE").next().expect("the difference");
        let words = found.accesskit_node().value().unwrap_or_default();
        words.split_whitespace().nth(2).unwrap().trim_end_matches(',').parse::<f64>().unwrap()
    };
    let hoffman = mean(&window);
    window.click("Model on the sphere");
    window.click("Schlick");
    assert!(mean(&window) > 2.0 * hoffman && hoffman > 0.0, "{hoffman}");
    let wipe = window.harness.get_by_role_and_label(Role::Slider, "Wipe");
    let before = wipe.accesskit_node().numeric_value();
    wipe.focus();
    window.press(Modifiers::NONE, Key::ArrowRight);
    let after = window.harness.get_by_role_and_label(Role::Slider, "Wipe").accesskit_node().numeric_value();
    assert!(after > before, "the keyboard moves the line: {before:?} {after:?}");
}

#[test]
fn a_dropped_file_of_n_and_k_joins_the_library() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("A dropped one.csv");
    let rows: String = (400..=700).step_by(50).map(|nm| format!("{nm},0.2,3.4\n")).collect();
    fs::write(&path, format!("wavelength_nm,n,k\n{rows}")).unwrap();
    let mut window = Window::open(None);
    window.drop_file(&path);
    assert_eq!(window.harness.state().state().page, Page::Metals);
    assert!(window.shows("A dropped one") && window.shows("The data cover 400–700 nm"));
    window.click("All metals");
    assert!(window.shows("A dropped one in the table"));
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
