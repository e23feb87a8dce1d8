//! The photograph against the rendered match, and copying what was found.

use std::ops::ControlFlow;

use edgewise::color::{RgbSpace, hex_from_srgb8, srgb8};
use edgewise::photo::{Photo, Rendition, solve};
use edgewise::sample::{Sample, samples};
use eframe::egui::{Key, Modifiers, OutputCommand, accesskit::Role};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::drive::Window;

fn sample() -> &'static Sample {
    &samples()[0]
}

fn open_sample() -> Window {
    let mut window = Window::open(None);
    window.press(Modifiers::COMMAND, Key::P);
    window.click(&sample().facts.title);
    window
}

/// What the library says of the sample, at the resolution of the window.
fn rendition() -> Rendition {
    let photo = Photo::from_bytes(&sample().facts.file, sample().bytes, &mut |_| ControlFlow::Continue(())).unwrap();
    let found = solve(&photo, &sample().facts.request, RgbSpace::LinRec709).unwrap();
    Rendition::of(&photo, &found, 1024).unwrap()
}

fn wipe(window: &Window) -> f64 {
    let handle = window.harness.get_by_label("Wipe between the photograph and the rendered match");
    handle.accesskit_node().numeric_value().expect("a handle has a place")
}

#[test]
fn the_difference_says_the_numbers_of_the_library() {
    let mut window = open_sample();
    window.click("Look at: difference");
    let (mean, most) = rendition().mean_and_most().unwrap();
    assert!(window.shows(&format!("mean {mean:.2}, 95 % of the pixels below {most:.2}")));
    assert!(mean < 3.0, "a tent and a card: the match looks like the photograph, {mean}");
}

#[test]
fn the_pixel_under_the_pointer_says_its_difference() {
    let mut window = open_sample();
    window.click("Look at: side by side");
    let view = window.harness.get_by_role(Role::Image).rect();
    for x in [0.25, 0.75] {
        window.harness.hover_at(view.lerp_inside(eframe::egui::vec2(x, 0.62)));
        window.settle();
        assert!(window.shows("ΔE "), "both halves are over the ball");
    }
    window.click("Look at: marks");
    window.harness.hover_at(view.lerp_inside(eframe::egui::vec2(0.25, 0.62)));
    window.settle();
    assert!(!window.shows("ΔE 0."));
}

#[test]
fn the_wipe_follows_the_pointer_and_the_keys() {
    let mut window = open_sample();
    window.click("Look at: wipe");
    assert_eq!(wipe(&window), 0.5);
    let handle = window.harness.get_by_label("Wipe between the photograph and the rendered match").rect();
    let quarter = handle.center() - eframe::egui::vec2(100.0, 0.0);
    window.drag(handle.center(), quarter);
    let dragged = wipe(&window);
    assert!(dragged < 0.45, "{dragged}");
    window.press(Modifiers::NONE, Key::ArrowRight);
    window.press(Modifiers::SHIFT, Key::ArrowRight);
    assert!((wipe(&window) - dragged - 0.11).abs() < 1e-5, "{}", wipe(&window));
    for _ in 0..20 {
        window.press(Modifiers::SHIFT, Key::ArrowLeft);
    }
    assert_eq!(wipe(&window), 0.0, "the handle stays on the picture");
}

#[test]
fn without_a_match_the_view_says_why() {
    let mut window = open_sample();
    window.click("Mode D: backdrop ratio");
    window.click("Look at: wipe");
    assert!(window.harness.query_by_label("Wipe between the photograph and the rendered match").is_none());
    window.click("Mark: Backdrop");
    assert!(window.shows(&format!("Photograph {}", sample().facts.file)), "placing a mark shows the photograph again");
}

/// What the next frames put on the clipboard.
fn copied(window: &mut Window, name: &str) -> String {
    window.press(Modifiers::COMMAND, Key::K);
    window.type_text(name);
    window.harness.key_down(Key::Enter);
    for _ in 0..8 {
        window.harness.step();
        let commands = &window.harness.output().platform_output.commands;
        if let Some(OutputCommand::CopyText(text)) = commands.first() {
            let text = text.clone();
            window.harness.key_up(Key::Enter);
            window.settle();
            return text;
        }
    }
    panic!("nothing was copied")
}

#[test]
fn colours_are_copied_in_every_form() {
    let mut window = open_sample();
    let (r, h, space) = (window.preset().r, window.preset().h, window.preset().space);
    for (symbol, colour) in [("r", r), ("h", h)] {
        let code = srgb8(colour, space).0;
        let linear = copied(&mut window, &format!("Copy {symbol}, linear"));
        assert_eq!(linear, colour.0.map(|value| value.to_string()).join(", "));
        assert_eq!(copied(&mut window, &format!("Copy {symbol}, sRGB 8-bit")), code.map(|v| v.to_string()).join(", "));
        assert_eq!(copied(&mut window, &format!("Copy {symbol}, sRGB hex code")), hex_from_srgb8(code));
    }
    // Gold's red is beyond sRGB: the copy says that it holds less.
    assert!(window.notices().iter().any(|notice| notice.contains("r lies outside sRGB")), "{:?}", window.notices());
}

#[test]
fn what_was_found_is_copied_beside_its_numbers() {
    let mut window = open_sample();
    window.click("Copy what was found");
    let name = "h, sRGB hex code";
    window.harness.get_by_label(name).click();
    let expected = hex_from_srgb8(srgb8(window.preset().h, window.preset().space).0);
    for _ in 0..8 {
        window.harness.step();
        if let Some(OutputCommand::CopyText(text)) = window.harness.output().platform_output.commands.first() {
            assert_eq!(*text, expected);
            return;
        }
    }
    panic!("nothing was copied")
}

/// A preset of this photograph that is opened beside it brings its marks; another is left alone.
#[test]
fn an_opened_preset_is_not_solved_over() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.json");
    let mut other = Window::open(None);
    other.enter("r sRGB hex code", "#336699");
    other.command("Save to path");
    other.answer_path(&path);
    let mut window = open_sample();
    window.press(Modifiers::COMMAND | Modifiers::SHIFT, Key::O);
    window.answer_path(&path);
    window.click("Discard changes");
    assert_eq!(window.preset().r, other.preset().r);
    window.click("Mode D: backdrop ratio");
    window.click("Mode C: even light and a card");
    window.click("Author");
    window.click("Space of the preset");
    window.click("ACEScg");
    let converted = RgbSpace::LinRec709.convert(other.preset().r, RgbSpace::AcesCg);
    assert!(window.preset().r.max_abs_difference(converted) < 1e-12, "the photograph does not write over it");
}
