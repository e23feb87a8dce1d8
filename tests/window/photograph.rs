//! From a photograph to r and h, in the window.

use std::fs;

use edgewise::color::delta_e_rgb;
use edgewise::photo::{Area, Circle, MatchRequest};
use edgewise::preset::{Origin, Preset};
use edgewise::sample::{Sample, samples};
use eframe::egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::kittest::Queryable;

use crate::drive::Window;

fn first_sample() -> &'static Sample {
    &samples()[0]
}

fn open_sample() -> Window {
    let mut window = Window::open(None);
    window.click(&first_sample().facts.title);
    window
}

fn marks(window: &Window) -> MatchRequest {
    window.harness.state().state().marks().expect("a photograph is open").clone()
}

/// Where a pixel of the photograph is on the screen: the view shows all of it, centred.
fn on_screen(window: &Window, x: f64, y: f64) -> Pos2 {
    let view = window.harness.get_by_label(&format!("Photograph {}", first_sample().facts.file)).rect();
    let (width, height) = (512.0, 384.0);
    let scale = (view.width() / width).min(view.height() / height);
    view.center() + vec2(x as f32 - width / 2.0, y as f32 - height / 2.0) * scale
}

fn ball(window: &Window) -> Circle {
    marks(window).circle.unwrap()
}

#[test]
fn a_sample_opens_marked_and_gives_r_and_h() {
    let window = open_sample();
    let sample = first_sample();
    assert_eq!(marks(&window), sample.facts.request);
    let preset = window.preset();
    let truth = &sample.facts.truth;
    // The bar of the product for a tent and a card: r and h within .03 of the truth, here as a colour difference.
    assert!(delta_e_rgb(preset.r, truth.r, truth.space) < 2.0, "{:?}", preset.r);
    assert!(delta_e_rgb(preset.h, truth.h, truth.space) < 2.0, "{:?}", preset.h);
    assert!(window.shows("rendered sample"));
    assert!(window.shows("Measured"));
    assert!(matches!(&preset.origin, Origin::Matched(recipe) if recipe.request == sample.facts.request));
}

#[test]
fn dragging_the_ball_matches_again_and_undo_moves_it_back() {
    let mut window = open_sample();
    let (before, circle) = (window.preset().clone(), ball(&window));
    window.drag(on_screen(&window, circle.x, circle.y), on_screen(&window, circle.x + 20.0, circle.y));
    assert!((ball(&window).x - circle.x - 20.0).abs() < 1.5, "{:?}", ball(&window));
    assert!((ball(&window).radius - circle.radius).abs() < 1e-9);
    let after = window.preset().clone();
    assert_ne!(after.h, before.h);
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(ball(&window), circle);
    assert_eq!(*window.preset(), before);
    window.press(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(*window.preset(), after);
}

#[test]
fn what_was_matched_opens_the_same_with_its_photograph() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("matched.json");
    let photograph = folder.path().join(&first_sample().facts.file);
    fs::write(&photograph, first_sample().bytes).unwrap();
    let mut window = open_sample();
    let circle = ball(&window);
    window.drag(on_screen(&window, circle.x, circle.y), on_screen(&window, circle.x + 6.0, circle.y));
    window.command("Save to path");
    window.answer_path(&path);
    let saved = Preset::load(&path).unwrap().preset;
    assert_eq!(saved, *window.preset());
    let mut reopened = Window::open(Some(path));
    reopened.press(Modifiers::COMMAND | Modifiers::SHIFT, Key::O);
    reopened.answer_path(&photograph);
    assert_eq!(marks(&reopened), marks(&window), "the marks are those of the recipe");
    assert_eq!((reopened.preset().r, reopened.preset().h), (saved.r, saved.h));
}

#[test]
fn grips_resize_and_keys_nudge() {
    let mut window = open_sample();
    let circle = ball(&window);
    let grip = on_screen(&window, circle.x + circle.radius, circle.y);
    window.drag(grip, grip + vec2(-20.0, 0.0));
    let smaller = ball(&window);
    assert!(smaller.radius < circle.radius - 5.0);
    assert!((smaller.x - smaller.radius - (circle.x - circle.radius)).abs() < 1e-6, "the far side stays");
    window.press(Modifiers::NONE, Key::ArrowLeft);
    assert_eq!(ball(&window).x, smaller.x - 1.0);
    window.press(Modifiers::SHIFT, Key::ArrowDown);
    assert_eq!(ball(&window).y, smaller.y + 10.0);
}

#[test]
fn escape_takes_back_a_drag_under_way() {
    let mut window = open_sample();
    let circle = ball(&window);
    let from = on_screen(&window, circle.x, circle.y);
    window.harness.drag_at(from);
    window.harness.run();
    window.harness.hover_at(from + vec2(30.0, 0.0));
    window.harness.run();
    assert_ne!(ball(&window), circle);
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(ball(&window), circle);
    window.harness.drop_at(from + vec2(30.0, 0.0));
    window.settle();
    assert_eq!(ball(&window), circle);
}

#[test]
fn marks_are_made_by_name_and_typed_as_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let photograph = folder.path().join("copy.png");
    fs::write(&photograph, first_sample().bytes).unwrap();
    let mut window = Window::open(None);
    // On its own page no row has to be scrolled to.
    window.press(Modifiers::COMMAND, Key::P);
    window.enter("Path of a photograph", photograph.to_str().unwrap());
    assert_eq!(marks(&window), MatchRequest::default(), "a file has no marks yet");
    window.click("Mark: Ball");
    window.click("Mark: Card");
    let wanted = first_sample().facts.request.circle.unwrap();
    for (what, value) in [("x", wanted.x), ("y", wanted.y), ("radius", wanted.radius)] {
        window.enter(&format!("Ball {what}, pixels"), &value.to_string());
    }
    assert_eq!(marks(&window).circle, Some(wanted));
    let Some(Area::Box { x, y, .. }) = first_sample().facts.request.cards.first().map(|card| card.area) else {
        panic!("the first sample has a card")
    };
    window.enter("Card x, pixels", &x.to_string());
    window.enter("Card y, pixels", &y.to_string());
    window.enter("Card reflectance, percent", "50");
    assert_eq!(marks(&window).cards[0].reflectance, 0.5);
    let at_half = window.preset().r;
    window.enter("Card reflectance, percent", "100");
    // Nearly twice: what a conductor has beyond two colours is taken off before, and depends on how bright it is.
    let half = window.preset().r * 0.5;
    assert!(half.max_abs_difference(at_half) < 0.02, "{half:?} {at_half:?}");
    window.click("Remove Card");
    assert!(marks(&window).cards.is_empty());
}

#[test]
fn the_exposure_of_the_view_changes_no_number() {
    let mut window = open_sample();
    let before = window.preset().clone();
    window.drag_slider("Exposure of the view", 0.5, 0.7);
    window.click("Alarms");
    assert_eq!(*window.preset(), before);
}

#[test]
fn a_preset_that_does_not_follow_is_left_alone() {
    let mut window = open_sample();
    window.click("The preset follows");
    let before = window.preset().clone();
    let circle = ball(&window);
    window.drag(on_screen(&window, circle.x, circle.y), on_screen(&window, circle.x + 20.0, circle.y));
    assert_eq!(*window.preset(), before);
}

#[test]
fn what_is_no_photograph_is_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("text.png");
    fs::write(&path, "no picture").unwrap();
    let mut window = Window::open(None);
    window.enter("Path of a photograph", path.to_str().unwrap());
    let notices = window.notices();
    assert!(notices.len() == 1 && notices[0].contains("text.png"), "{notices:?}");
    assert!(window.harness.state().state().marks().is_none());
}

#[test]
fn the_pixel_under_the_pointer_is_read_in_full() {
    let mut window = open_sample();
    let circle = ball(&window);
    let (column, row) = (circle.x.floor(), circle.y.floor());
    window.harness.hover_at(on_screen(&window, column + 0.5, row + 0.5));
    window.settle();
    assert!(window.shows(&format!("{column:.0},{row:.0}")));
}
