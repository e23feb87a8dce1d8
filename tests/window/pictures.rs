//! Does the window look as it was judged to look? Needs a renderer: software Vulkan is enough, none is a failure.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test --test window` writes the pictures anew; look at them before committing them.

use std::sync::Arc;

use edgewise::metal::metal_by_name;
use edgewise::preset::{Preset, built_in_presets};
use edgewise::sample::samples;
use edgewise::scene::{Place, PlanOptions, SavedMaterial, SavedPass, SavedPlan, SavedScene, Shape, Source, plan_scene};
use edgewise::study::no_progress;
use eframe::egui::{Key, Modifiers, Theme};

use crate::drive::Window;
use crate::planner;

#[test]
fn a_new_window() {
    Window::for_picture(Theme::Dark).picture("new");
}

fn matched_photograph(theme: Theme, name: &str) {
    let mut window = Window::for_picture(theme);
    window.click(&samples()[0].facts.title);
    window.picture(name);
}

#[test]
fn a_matched_photograph_in_the_dark() {
    matched_photograph(Theme::Dark, "matched");
}

#[test]
fn a_matched_photograph_in_the_light() {
    matched_photograph(Theme::Light, "matched_light");
}

#[test]
fn a_question_before_changes_are_lost() {
    let mut window = Window::for_picture(Theme::Dark);
    window.enter("Name", "Precious");
    window.press(Modifiers::COMMAND, Key::N);
    window.picture("unsaved");
}

#[test]
fn metals_to_choose_from() {
    let mut window = Window::for_picture(Theme::Dark);
    window.press(Modifiers::COMMAND | Modifiers::SHIFT, Key::N);
    window.type_text("gold");
    window.picture("finder");
}

fn export_of_gold(theme: Theme, name: &str) {
    let mut window = Window::for_picture(theme);
    window.press(Modifiers::COMMAND | Modifiers::SHIFT, Key::N);
    window.type_text("gold");
    window.press(Modifiers::NONE, Key::Enter);
    window.press(Modifiers::COMMAND, Key::E);
    window.click("MaterialX standard surface");
    window.picture(name);
}

#[test]
fn an_export_in_the_dark() {
    export_of_gold(Theme::Dark, "export");
}

#[test]
fn an_export_in_the_light() {
    export_of_gold(Theme::Light, "export_light");
}

#[test]
fn the_page_of_the_library() {
    let folder = tempfile::tempdir().unwrap();
    for preset in built_in_presets().iter().take(12) {
        let tags = vec![if preset.r[0] > 0.8 { "bright" } else { "dim" }.to_owned()];
        let preset = Preset { tags, roughness: 0.3, ..preset.clone() };
        preset.save(&folder.path().join(preset.file_stem() + ".json")).unwrap();
    }
    let mut window = Window::for_picture(Theme::Dark);
    window.press(Modifiers::COMMAND, Key::Num5);
    window.enter("Path of a folder of presets", folder.path().to_str().unwrap());
    // The folder is called otherwise every time.
    window.clear("Path of a folder of presets");
    window.picture("library");
}

#[test]
fn the_page_of_metals() {
    let mut window = Window::for_picture(Theme::Light);
    window.press(Modifiers::COMMAND, Key::Num2);
    window.picture("metals");
    window.click("Spheres");
    window.picture("metals_spheres");
    window.click("All metals");
    window.click("Sort by Schlick");
    window.click("Sort by Schlick");
    window.picture("metals_table");
}

fn other_models(theme: Theme, name: &str) {
    let mut window = Window::for_picture(theme);
    window.command("New from metal");
    window.type_text("chromium");
    window.press(Modifiers::NONE, Key::Enter);
    for model in ["Schlick", "F82-tint", "r, g", "n, k"] {
        window.tick(model);
    }
    window.picture(name);
}

#[test]
fn other_models_beneath_the_preset_in_the_dark() {
    other_models(Theme::Dark, "compared");
}

#[test]
fn other_models_beneath_the_preset_in_the_light() {
    other_models(Theme::Light, "compared_light");
}

#[test]
fn the_page_of_demonstrations() {
    let mut window = Window::for_picture(Theme::Dark);
    window.press(Modifiers::COMMAND, Key::Num3);
    window.click("Blending: Can a painted mask be filtered?");
    window.picture("demonstrations");
}

#[test]
fn the_page_of_plans() {
    let mut window = Window::for_picture(Theme::Dark);
    window.press(Modifiers::COMMAND, Key::Num4);
    window.picture("planner");
    window.click("Trade");
    window.picture("planner_trade");
}

/// A plan of a pass whose pictures are elsewhere, as is the file of one of its metals.
#[test]
fn a_plan_of_a_file_that_was_changed() {
    let angles = Shape::Cylinder.angles().times(9000.0);
    let seen = |name: &str, file: Option<&str>, place| SavedMaterial {
        source: Source::Metal(Arc::new(metal_by_name(name).unwrap().clone())),
        file: file.map(str::to_owned),
        place,
        angles: angles.clone(),
    };
    let materials = vec![
        seen("gold", None, Place::Id(1)),
        seen("iron", Some("/studio/metals/iron.csv"), Place::Id(2)),
        seen("zinc", None, Place::Id(3)),
    ];
    let found = "facing.exr: 1920 × 1080 pixels of channel Y, 27000 with a surface and 2046600 without".to_owned();
    let file = |name: &str| format!("/studio/shots/{name}.exr");
    let pass = SavedPass { file: file("facing"), channel: None, ids: Some(file("ids")), found };
    let scene = SavedScene { materials, pass: Some(pass) };
    let materials = scene.scene_materials();
    let plan = plan_scene(&materials, "facing.exr", &PlanOptions::default(), &no_progress).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kitchen.json");
    SavedPlan { plan, scene: Ok(scene) }.save(&path).unwrap();
    let mut window = Window::for_picture(Theme::Dark);
    window.press(Modifiers::COMMAND, Key::Num4);
    planner::file(&mut window, "Open plan…", "Open a plan", &path);
    window.click("Where Gold is seen");
    window.click("Sphere");
    window.picture("planner_opened");
}

#[test]
fn the_page_of_plans_in_a_small_window() {
    let mut window = Window::for_picture_of([1000.0, 680.0], Theme::Light);
    window.picture("small");
    window.press(Modifiers::COMMAND, Key::Num4);
    window.picture("planner_small");
    window.click("Trade");
    window.picture("planner_trade_small");
}

#[test]
fn the_page_of_plans_in_a_large_window() {
    let mut window = Window::for_picture_of([1600.0, 1000.0], Theme::Light);
    window.press(Modifiers::COMMAND, Key::Num4);
    window.picture("planner_large");
}
