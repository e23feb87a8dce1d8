//! The page of plans.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use edgewise::color::Rgb;
use edgewise::metal::metal_by_name;
use edgewise::preset::Preset;
use edgewise::scene::{Plan, PlanOptions, SavedPlan, SceneMaterial, Shape, Source, Target, Tolerance, plan_scene};
use edgewise::study::{Costs, Measure, Subject, TradeOptions, Variant, no_progress, trade, trade_summary};
use eframe::egui::{Key, Modifiers, accesskit::Role};
use egui_kittest::kittest::{NodeT, Queryable};
use image::GrayImage;

use crate::drive::Window;

const CARD: Shape = Shape::Card { from_deg: 0.0, to_deg: 60.0 };
const FLOOR: Shape = Shape::Floor { eye_m: 1.7, near_m: 1.0, far_m: 20.0 };

fn open() -> Window {
    let mut window = Window::open(None);
    window.press(Modifiers::COMMAND, Key::Num4);
    window
}

fn on(name: &str, shape: Shape) -> SceneMaterial {
    let metal = metal_by_name(name).unwrap().clone();
    SceneMaterial { source: Source::Metal(Arc::new(metal)), angles: shape.angles() }
}

/// The plan that a new window shows, from the planner itself.
fn default_plan(options: &PlanOptions) -> Plan {
    let materials = [on("gold", CARD), on("copper", Shape::Sphere), on("chromium", FLOOR), on("zinc", Shape::Sphere)];
    plan_scene(&materials, "", options, &no_progress).unwrap()
}

/// The words of the row of a material.
fn row_of(window: &Window, name: &str) -> String {
    let beginning = format!("Look at {name}: ");
    let rows = window.harness.query_all_by_label_contains(&beginning);
    rows.filter_map(|row| row.accesskit_node().label()).next().unwrap_or_else(|| panic!("no row of {name}"))
}

/// The shader operations of a row, as it shows them.
fn operations(row: &str) -> u32 {
    let words: Vec<&str> = row.split_whitespace().collect();
    let at = words.iter().position(|word| *word == "operations,").unwrap();
    words[at - 1].parse().unwrap()
}

#[test]
fn a_new_window_has_a_telling_plan() {
    let window = open();
    let plan = default_plan(&PlanOptions::default());
    assert!(window.shows(&plan.summary()), "{}", plan.summary());
    for material in &plan.materials {
        let row = row_of(&window, &material.name);
        assert!(row.contains(&material.chosen.label()), "{row}");
        assert_eq!(operations(&row), material.choice().cost.shader_operations);
    }
    let kinds: Vec<_> = plan.materials.iter().map(|material| material.chosen).collect();
    assert!(kinds.iter().any(|variant| variant.needs_only_r()), "{kinds:?}");
    assert!(kinds.contains(&Variant::HOFFMAN), "{kinds:?}");
    let hoffman = Costs::counted().of(Variant::HOFFMAN).shader_operations;
    assert!(plan.materials.iter().any(|material| material.choice().cost.shader_operations > hoffman), "{kinds:?}");
    assert_eq!(window.notices(), [""; 0]);
}

#[test]
fn a_material_seen_below_60_degrees_is_plain_r() {
    let mut window = open();
    window.click("Empty the list");
    assert!(window.shows("Add the materials of a scene"));
    window.click("Metal…");
    window.type_text("silver");
    window.press(Modifiers::NONE, Key::Enter);
    window.click("Where Silver is seen");
    window.click("Card");
    window.enter("Tolerance, number", "2");
    let row = row_of(&window, "Silver");
    assert!(row.contains("Schlick") || row.contains("Constant"), "{row}");
    window.enter("Largest tilt of Silver", "90");
    window.enter("Tolerance, number", "0.05");
    let row = row_of(&window, "Silver");
    assert!(!row.contains("Schlick") && !row.contains("Constant"), "{row}");
}

#[test]
fn loosening_the_tolerance_never_raises_the_cost_on_show() {
    let mut window = open();
    let mut last = [u32::MAX; 4];
    for tolerance in ["0", "0.3", "1", "3", "30"] {
        window.enter("Tolerance, number", tolerance);
        let now = ["Gold", "Copper", "Chromium", "Zinc"].map(|name| operations(&row_of(&window, name)));
        assert!(now.iter().zip(&last).all(|(now, last)| now <= last), "{tolerance}: {now:?} {last:?}");
        last = now;
    }
    let schlick = Costs::counted().of(Variant::SCHLICK).shader_operations;
    assert!(last.iter().all(|operations| *operations <= schlick), "{last:?}");
}

#[test]
fn measure_target_and_space_are_those_of_the_planner() {
    let mut window = open();
    window.click("Mean");
    window.click("What is spared");
    window.click(Target::TextureMemory.label());
    let tolerance = Tolerance { on: Measure::Mean, ..Tolerance::default() };
    let plan = default_plan(&PlanOptions { tolerance, target: Target::TextureMemory, ..PlanOptions::default() });
    assert!(window.shows(&plan.summary()), "{}", plan.summary());
    window.click("What is spared");
    window.click(Target::Offline.label());
    assert!(window.shows("Times were measured on this machine") && window.shows(" ns for each pixel"));
}

#[test]
fn the_open_preset_is_planned_for_as_it_changes() {
    let mut window = open();
    window.click("Empty the list");
    window.click("Add the open preset");
    assert!(row_of(&window, "New metal").contains("Schlick"), "a new preset has Schlick's own h");
    window.press(Modifiers::COMMAND, Key::Num1);
    window.enter("h red, linear Linear sRGB (Rec.709)", "0.2");
    window.press(Modifiers::COMMAND, Key::Num4);
    assert!(row_of(&window, "New metal").contains("Hoffman"), "{}", row_of(&window, "New metal"));
}

/// Asks for a file by the name of its button and answers with a path; there is no dialog service here, and on a busy
/// machine that may have to be found out twice.
pub fn file(window: &mut Window, button: &str, question: &str, path: &Path) {
    let mut attempts = 0..20;
    while !window.shows(question) {
        assert!(attempts.next().is_some(), "no question for a path");
        window.click(button);
    }
    window.answer_path(path);
}

#[test]
fn a_saved_plan_reopens_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kitchen.json");
    let mut window = open();
    window.enter("Tolerance, number", "0.4");
    let row = row_of(&window, "Zinc");
    file(&mut window, "Save plan…", "Save the plan", &path);
    assert!(window.shows("Wrote kitchen.json"));
    let tolerance = Tolerance { delta_e: 0.4, on: Measure::Max };
    let plan = SavedPlan::load(&path).unwrap().plan;
    assert_eq!(plan.materials, default_plan(&PlanOptions { tolerance, ..PlanOptions::default() }).materials);

    let mut window = open();
    file(&mut window, "Open plan…", "Open a plan", &path);
    assert!(window.shows("kitchen.json") && window.shows(&plan.summary()));
    assert_eq!(row_of(&window, "Zinc"), row);
    window.click("Back to the scene");
    assert!(window.shows(&default_plan(&PlanOptions::default()).summary()));
}

/// A file of the plan that a new window shows.
fn save_default(path: &Path) {
    let mut window = open();
    file(&mut window, "Save plan…", "Save the plan", path);
}

fn opened(path: &Path) -> Window {
    let mut window = open();
    file(&mut window, "Open plan…", "Open a plan", path);
    window
}

#[test]
fn an_opened_plan_is_changed_and_planned_again() {
    let folder = tempfile::tempdir().unwrap();
    let (path, other) = (folder.path().join("kitchen.json"), folder.path().join("other.json"));
    save_default(&path);
    let mut window = opened(&path);
    assert!(window.shows("It is shown as it was saved") && !window.shows("planned again"));
    let before = row_of(&window, "Zinc");
    window.enter("Tolerance, number", "0.2");
    window.enter("Largest tilt of Gold", "80");
    window.click("What is spared");
    window.click(Target::TextureMemory.label());
    assert!(window.shows("It was changed, and is planned again"));
    assert_ne!(row_of(&window, "Zinc"), before);
    file(&mut window, "Save plan…", "Save the plan", &other);
    let tolerance = Tolerance { delta_e: 0.2, on: Measure::Max };
    let options = PlanOptions { tolerance, target: Target::TextureMemory, ..PlanOptions::default() };
    let card = Shape::Card { from_deg: 0.0, to_deg: 80.0 };
    let materials = [on("gold", card), on("copper", Shape::Sphere), on("chromium", FLOOR), on("zinc", Shape::Sphere)];
    let fresh = plan_scene(&materials, "", &options, &no_progress).unwrap();
    assert_eq!(SavedPlan::load(&other).unwrap().plan.materials, fresh.materials);
    assert!(window.shows(&fresh.summary()));

    window.click("As it was saved");
    assert!(window.shows("It is shown as it was saved"));
    assert_eq!(row_of(&window, "Zinc"), before);
    window.click("Remove Zinc");
    assert!(window.shows("planned again") && !window.shows("Remove Zinc"));
    window.click("Back to the scene");
    assert!(window.shows(&default_plan(&PlanOptions::default()).summary()));
}

/// The pictures may be gone: their angles are in the plan.
#[test]
fn an_opened_plan_of_a_pass_needs_no_picture() {
    let folder = tempfile::tempdir().unwrap();
    let [ratio, ids, path] = ["facing.png", "ids.png", "shot.json"].map(|name| folder.path().join(name));
    pass(&ratio);
    GrayImage::from_fn(8, 4, |x, _| image::Luma([if x < 4 { 2 } else { 1 }])).save(&ids).unwrap();
    let mut window = open();
    for name in ["Zinc", "Chromium"] {
        window.click(&format!("Remove {name}"));
    }
    window.click("Rendered pass");
    window.enter("Path of the facing-ratio pass", ratio.to_str().unwrap());
    window.click("How the materials of the pass are told apart");
    window.click("Ids");
    window.enter("Path of the picture of ids", ids.to_str().unwrap());
    file(&mut window, "Save plan…", "Save the plan", &path);
    window.enter("Tolerance, number", "0.01");
    let fresh = ["Gold", "Copper"].map(|name| row_of(&window, name));

    for picture in [&ratio, &ids] {
        fs::remove_file(picture).unwrap();
    }
    let mut window = opened(&path);
    assert!(window.shows("As saved are the angles"));
    assert_ne!(row_of(&window, "Gold"), fresh[0]);
    window.enter("Tolerance, number", "0.01");
    assert_eq!(["Gold", "Copper"].map(|name| row_of(&window, name)), fresh);
    assert!(window.shows("50 %, 80°"));
    window.click("Where Gold is seen");
    window.click("Card");
    window.enter("Largest tilt of Gold", "40");
    assert!(window.shows("50 %, 0–40°") && window.shows("50 %, 0°"), "gold is elsewhere, copper is where it was");
    window.click("Where Gold is seen");
    window.click("As saved");
    assert_eq!(row_of(&window, "Gold"), fresh[0]);
    window.click("Rendered pass");
    assert!(window.shows("facing.png") && window.shows("no such file"), "what it is read from is known");
}

#[test]
fn an_opened_plan_keeps_n_and_k_whose_file_is_gone_or_has_changed() {
    let folder = tempfile::tempdir().unwrap();
    let (alloy, path) = (folder.path().join("alloy.csv"), folder.path().join("plan.json"));
    let rows = "wavelength_nm,n,k\n380,1.4,1.9\n480,1.1,2.3\n580,.4,2.9\n680,.2,3.6\n780,.2,4.4\n";
    fs::write(&alloy, rows).unwrap();
    let mut window = open();
    window.click("Empty the list");
    file(&mut window, "Add a file", "Add a preset, or n and k, to the plan", &alloy);
    file(&mut window, "Save plan…", "Save the plan", &path);
    window.enter("Tolerance, number", "0.05");
    let fresh = row_of(&window, "alloy");
    assert!(!opened(&path).shows("alloy.csv"), "nothing to say");

    fs::write(&alloy, rows.replace("2.9", "2.4")).unwrap();
    let mut window = opened(&path);
    assert!(window.shows("alloy.csv has changed since the plan was saved"));
    window.enter("Tolerance, number", "0.05");
    assert_eq!(row_of(&window, "alloy"), fresh);
    fs::remove_file(&alloy).unwrap();
    assert!(opened(&path).shows("alloy.csv is gone; the plan keeps what it held"));
}

/// Of a plan that keeps no scene the page says so, and shows what it can.
#[test]
fn a_plan_of_an_older_version_is_looked_at() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("old.json");
    save_default(&path);
    let mut old: serde_json::Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    old.as_object_mut().unwrap().remove("made_from").unwrap();
    fs::write(&path, old.to_string()).unwrap();
    let mut window = opened(&path);
    assert!(window.shows("The plan was saved before plans kept where their materials are seen"));
    assert!(row_of(&window, "Zinc").contains("operations") && !window.shows("Remove Zinc"));
    assert!(window.harness.query_by_label("Tolerance, number").is_none());
    let out = folder.path().join("out");
    file(&mut window, "Export…", "Export the materials of the plan into a folder", &out);
    assert!(window.shows("Wrote 4 files into"));
    window.click("Back to the scene");
    assert!(window.shows("Remove Zinc"));
}

#[test]
fn the_materials_are_exported_without_what_is_not_needed() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open();
    let question = "Export the materials of the plan into a folder";
    file(&mut window, "Export…", question, folder.path());
    assert!(window.shows("Wrote 4 files into"), "{:?}", window.notices());
    assert!(!window.shows("the plan wants"), "a shader can say all that was chosen");
    let mut names: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["chromium.glsl", "copper.glsl", "gold.glsl", "zinc.glsl"]);
    let text = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(text("gold.glsl").len() < text("chromium.glsl").len(), "gold needs no h");
    assert!(text("zinc.glsl").contains("vec3 rows_zinc[32]"), "zinc is a table");
    // Another plan would replace them.
    window.enter("Tolerance, number", "0.1");
    file(&mut window, "Export…", question, folder.path());
    assert!(window.shows("it is there already"));
}

/// OpenPBR takes no r above 1, which gold has in linear sRGB.
#[test]
fn what_a_target_cannot_say_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open();
    window.enter("Tolerance, number", "1");
    window.click("Whose files the materials are exported to");
    window.click("MaterialX OpenPBR surface");
    file(&mut window, "Export…", "Export the materials of the plan into a folder", folder.path());
    assert!(window.shows("Gold: the plan wants schlick:exact"), "{:?}", window.notices());
    let text = fs::read_to_string(folder.path().join("gold.open_pbr.mtlx")).unwrap();
    assert!(text.contains("the plan wants schlick:exact"), "{text}");
}

#[test]
fn files_that_are_none_are_one_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let bad = folder.path().join("bad.json");
    fs::write(&bad, "{\"edgewise_plan\": 7}").unwrap();
    let mut window = open();
    file(&mut window, "Open plan…", "Open a plan", &bad);
    assert!(window.shows("plan format 7"));
    let damaged = folder.path().join("damaged.json");
    save_default(&damaged);
    let mut plan: serde_json::Value = serde_json::from_slice(&fs::read(&damaged).unwrap()).unwrap();
    plan["made_from"]["materials"][0]["weights"] = serde_json::json!([1.0, -2.0]);
    fs::write(&damaged, plan.to_string()).unwrap();
    file(&mut window, "Open plan…", "Open a plan", &damaged);
    assert!(window.shows("“Gold”: there must be 257 weights, not 2"));
    file(&mut window, "Add a file", "Add a preset, or n and k, to the plan", &folder.path().join("none.json"));
    assert!(window.shows("no such file or folder"));
    assert!(window.shows(&default_plan(&PlanOptions::default()).summary()), "the plan is untouched");
}

/// A picture whose left half faces the eye and whose right half is at 80°, as 8-bit shares.
fn pass(path: &Path) {
    let grazing = (80_f64.to_radians().cos() * 255.0).round() as u8;
    GrayImage::from_fn(8, 4, |x, _| image::Luma([if x < 4 { 255 } else { grazing }])).save(path).unwrap();
}

#[test]
fn a_pass_with_ids_says_where_each_is_seen() {
    let folder = tempfile::tempdir().unwrap();
    let (ratio, ids) = (folder.path().join("facing.png"), folder.path().join("ids.png"));
    pass(&ratio);
    GrayImage::from_fn(8, 4, |x, _| image::Luma([if x < 4 { 1 } else { 2 }])).save(&ids).unwrap();
    let mut window = open();
    for name in ["Zinc", "Chromium"] {
        window.click(&format!("Remove {name}"));
    }
    window.click("Rendered pass");
    assert!(window.shows("Choose a facing-ratio pass"));
    window.enter("Path of the facing-ratio pass", ratio.to_str().unwrap());
    assert!(window.shows("50 %, 0–80°"), "both are seen at all angles");
    window.click("How the materials of the pass are told apart");
    window.click("Ids");
    assert!(window.shows("Choose the picture of ids"));
    window.enter("Path of the picture of ids", ids.to_str().unwrap());
    assert!(window.shows("50 %, 0°") && window.shows("50 %, 80°"), "gold faces the eye, copper does not");
    let (gold, copper) = (row_of(&window, "Gold"), row_of(&window, "Copper"));
    assert!(gold.contains("Constant") && !copper.contains("Constant"), "{gold} {copper}");
    window.enter("Id of Copper", "9");
    assert!(window.shows("the id 9 is not in the picture, which has 1 and 2") && window.shows("not seen"));
    window.enter("Id of Copper", "256");
    assert!(window.shows("cannot have the id 256"));
    window.enter("Id of Copper", "1");
    assert!(window.shows("The id 1 is given to two materials"));
}

#[test]
fn a_picture_that_is_no_facing_ratio_is_said_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (normals, black) = (folder.path().join("normals.png"), folder.path().join("black.png"));
    image::RgbImage::from_fn(8, 4, |x, y| image::Rgb([x as u8 * 30, y as u8 * 30, 255])).save(&normals).unwrap();
    GrayImage::new(8, 4).save(&black).unwrap();
    let mut window = open();
    window.click("Rendered pass");
    window.enter("Path of the facing-ratio pass", normals.to_str().unwrap());
    assert!(window.shows("R was taken as the facing ratio"));
    window.enter("Path of the facing-ratio pass", black.to_str().unwrap());
    assert!(window.shows("none is a cosine of 0–1 (32 without a surface)"));
}

#[test]
fn a_bad_pass_is_one_sentence_in_the_page() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.exr");
    fs::write(&path, b"v/1\x01 not really").unwrap();
    let mut window = open();
    window.click("Rendered pass");
    window.enter("Path of the facing-ratio pass", path.to_str().unwrap());
    let said: Vec<_> = window.harness.query_all_by_label_contains("broken.exr").collect();
    assert_eq!(said.iter().filter(|node| node.accesskit_node().role() == Role::Label).count(), 1);
    assert_eq!(window.notices(), [""; 0]);
    window.click("Simple shapes");
    assert!(window.shows(&default_plan(&PlanOptions::default()).summary()));
}

#[test]
fn the_chart_is_the_studys_and_is_saved() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open();
    window.click("Trade");
    let gold = [Subject::Metal(metal_by_name("gold").unwrap())];
    let options = TradeOptions::default();
    let rows = trade(&gold, &options, &no_progress).unwrap();
    assert!(window.shows(&trade_summary(&rows, &options)));
    let hoffman = rows.iter().find(|row| row.variant == Variant::HOFFMAN).unwrap();
    let words = format!("{}: largest ΔE {:.2}", hoffman.variant.label(), hoffman.max_delta_e);
    assert!(window.shows(&words), "a point has its name");
    for (button, question, name) in
        [("SVG…", "Save the chart", "trade.svg"), ("CSV…", "Save the numbers of the chart", "trade.csv")]
    {
        file(&mut window, button, question, &folder.path().join(name));
        assert!(window.shows(&format!("Wrote {name}")));
    }
    let svg = fs::read_to_string(folder.path().join("trade.svg")).unwrap();
    assert!(roxmltree::Document::parse(&svg).is_ok() && svg.contains("Gold"));
    let mut csv = csv::Reader::from_path(folder.path().join("trade.csv")).unwrap();
    assert_eq!(csv.records().count(), rows.len());
    let json = folder.path().join("trade.json");
    file(&mut window, "JSON…", "Save the numbers of the chart", &json);
    let printed = Command::new(env!("CARGO_BIN_EXE_edgewise")).args(["study", "trade", "gold", "--json"]).output();
    assert_eq!(fs::read_to_string(&json).unwrap(), String::from_utf8(printed.unwrap().stdout).unwrap());
    assert!(window.shows("Wrote trade.json") && window.shows("ΔE 0, costs 13643 shader operations"));
    window.click("Plan");
    assert!(!window.shows("Wrote trade.json"), "what came of a file of the chart is no news of the plan");
    window.click("Trade");
    window.click("Metal of the chart: Gold");
    window.type_text("zinc");
    window.press(Modifiers::NONE, Key::Enter);
    let zinc = [Subject::Metal(metal_by_name("zinc").unwrap())];
    assert!(window.shows(&trade_summary(&trade(&zinc, &options, &no_progress).unwrap(), &options)));
}

#[test]
fn times_of_this_machine_are_measured_and_count() {
    let mut window = open();
    assert!(!window.shows(" ns for each pixel"));
    window.click("Trade");
    assert!(window.shows("No times were measured on this machine"));
    window.click("Measure times");
    assert!(window.shows("Times were measured on this machine") && window.shows("Measure again"));
    window.click("Measured time");
    assert!(window.shows("ΔE by nanoseconds"));
}

#[test]
fn the_chart_is_of_the_folder_that_is_open_in_the_library() {
    let mut window = open();
    window.click("Trade");
    window.click("What the chart is of");
    window.click("Presets of the library");
    assert!(window.shows("Open a folder of presets on the page Library"));
    let folder = tempfile::tempdir().unwrap();
    let presets = [("one", 0.7), ("two", 0.95)].map(|(name, h)| {
        let preset = Preset { name: name.to_owned(), r: Rgb::splat(0.6), h: Rgb::splat(h), ..Preset::new_authored() };
        preset.save(&folder.path().join(format!("{name}.json"))).unwrap();
        preset
    });
    fs::write(folder.path().join("none.json"), "{}").unwrap();
    window.press(Modifiers::COMMAND, Key::Num5);
    window.enter("Path of a folder of presets", folder.path().to_str().unwrap());
    window.press(Modifiers::COMMAND, Key::Num4);
    let options = TradeOptions::default();
    let subjects = presets.each_ref().map(|preset| Subject::of_preset(preset).0);
    assert!(window.shows(&trade_summary(&trade(&subjects, &options, &no_progress).unwrap(), &options)));
    assert!(window.shows("left out") && window.shows("none.json"), "one of the files is no preset");
}
