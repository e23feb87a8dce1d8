//! Editing r and h.

use edgewise::color::{Rgb, RgbSpace, linear_from_srgb8};
use edgewise::fit::{convert, nearest_conductor};
use edgewise::fresnel::{CosTheta, FresnelModel, ModelKind, THETA_MAX_DEG};
use edgewise::metal::metal_by_name;
use edgewise::preset::Origin;
use eframe::egui::{Key, Modifiers};

use crate::drive::Window;

const RED_SLIDER: &str = "r red, sRGB-encoded Linear sRGB (Rec.709) slider";

#[test]
fn a_new_window_shows_a_grey_metal_without_changes() {
    let window = Window::open(None);
    assert!(window.shows("New metal (not saved yet), no changes"));
    assert!(window.shows("Every channel stays within 0–1 at every angle"));
    assert_eq!(window.notices(), [""; 0]);
}

#[test]
fn one_drag_of_a_slider_is_one_step() {
    let mut window = Window::open(None);
    let before = window.preset().r;
    window.drag_slider(RED_SLIDER, 0.8, 0.3);
    let after = window.preset().r;
    assert!(after[0] < before[0] - 0.3 && after[1] == before[1] && after[2] == before[2], "{after:?}");
    assert!(window.shows("unsaved changes"));
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.preset().r, before);
    window.press(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(window.preset().r, after);
}

#[test]
fn typed_numbers_are_taken_as_they_are() {
    let mut window = Window::open(None);
    window.enter("h green, linear Linear sRGB (Rec.709)", "1.07");
    assert_eq!(window.preset().h[1], 1.07);
    assert!(window.shows("Green rises to"), "a number beyond 1 is kept and said");
    window.enter("h green, linear Linear sRGB (Rec.709)", "nonsense");
    assert_eq!(window.preset().h[1], 1.07);
}

#[test]
fn a_hex_code_is_srgb_in_any_space() {
    let mut window = Window::open(None);
    window.enter("r sRGB hex code", "#c89b6e");
    let expected = linear_from_srgb8([0xc8, 0x9b, 0x6e]);
    assert!(window.preset().r.max_abs_difference(expected) < 1e-12);
    window.enter("r sRGB hex code", "#c89b");
    assert!(window.preset().r.max_abs_difference(expected) < 1e-12, "half a code changes nothing");
}

/// Visiting a field must not round the number to what the field shows.
#[test]
fn walking_through_the_fields_changes_nothing() {
    let mut window = Window::open(None);
    window.command("New from metal");
    window.type_text("copper");
    window.press(Modifiers::NONE, Key::Enter);
    let before = window.preset().clone();
    assert_eq!(before.r, metal_by_name("copper").unwrap().r(RgbSpace::LinRec709));
    for _ in 0..60 {
        window.press(Modifiers::NONE, Key::Tab);
    }
    assert_eq!(*window.preset(), before);
}

#[test]
fn a_measured_metal_changed_by_hand_says_so() {
    let mut window = Window::open(None);
    window.command("New from metal");
    window.type_text("gold");
    window.press(Modifiers::NONE, Key::Enter);
    assert!(matches!(window.preset().origin, Origin::Measured { .. }));
    assert!(window.shows("Olmon et al. 2012"));
    window.enter("r OKLCH lightness", "0.5");
    assert!(matches!(window.preset().origin, Origin::Edited { .. }));
    assert!(window.shows("Changed by hand"));
}

#[test]
fn changing_the_space_keeps_the_colours() {
    let mut window = Window::open(None);
    window.enter("r sRGB hex code", "#c89b6e");
    let before = window.preset().clone();
    window.click("Space of the preset");
    window.click("ACEScg");
    let after = window.preset();
    assert_eq!(after.space, RgbSpace::AcesCg);
    assert!(after.in_space(before.space).r.max_abs_difference(before.r) < 1e-12);
}

#[test]
fn a_hue_survives_a_grey() {
    let mut window = Window::open(None);
    window.enter("r sRGB hex code", "#c89b6e");
    let before = window.preset().r;
    let chroma = edgewise::color::oklch_from_rgb(before, RgbSpace::LinRec709)[1];
    window.enter("r OKLCH chroma", "0");
    assert!(window.preset().r.max_abs_difference(Rgb::splat(window.preset().r[0])) < 1e-3);
    window.enter("r OKLCH chroma", &chroma.to_string());
    assert!(window.preset().r.max_abs_difference(before) < 1e-5);
}

/// Each model is a curve with its own line in the legend, its numbers and its ΔE in the read-out.
#[test]
fn other_models_of_the_preset_can_be_drawn_beneath_it() {
    let mut window = Window::open(None);
    window.command("New from metal");
    window.type_text("gold");
    window.press(Modifiers::NONE, Key::Enter);
    let (r, h) = (window.preset().r, window.preset().h);
    let preset = FresnelModel::Hoffman { r, h };
    // The read-out is at 81.787° while the pointer is elsewhere, between two points of the curve half a degree apart.
    let numbers = |model: FresnelModel| {
        let [before, after] = [81.5, 82.0].map(|deg| model.reflectance(CosTheta::from_deg(deg)));
        before.lerp(after, (THETA_MAX_DEG - 81.5) / 0.5).0.map(|v| format!("{v:>7.4}")).join(" ")
    };
    let space = RgbSpace::LinRec709;
    let schlick = numbers(FresnelModel::Schlick { r });
    let gulbrandsen = numbers(convert(&preset, ModelKind::Gulbrandsen, space).unwrap().model);
    let conductor = numbers(nearest_conductor(&preset, space).unwrap());
    for (name, numbers) in [("Schlick", &schlick), ("r, g", &gulbrandsen), ("n, k", &conductor)] {
        assert!(!window.shows(numbers), "{name} is not drawn yet");
        window.tick(name);
        assert!(window.shows(numbers), "{name}: {numbers}");
    }
    window.tick("F82-tint");
    // Gold's red r is above 1, which has no g, and which most programs cut off.
    assert!(r[0] > 1.0 && window.shows("no n and k have r"));
    window.tick("n, k");
    assert!(!window.shows(&conductor));
}

#[test]
fn the_budget_of_a_preview_says_what_it_costs() {
    let mut window = Window::open(None);
    window.click("Preview");
    assert!(window.shows("finished picture"));
    let name = "Preview quality";
    window.drag_slider(name, 0.5, 0.01);
    assert!(window.shows("ΔE to the finished picture"), "a millisecond is too little for the finished one");
    window.press(Modifiers::NONE, Key::Escape);
    assert!(!window.shows("ΔE to the finished picture"));
}
