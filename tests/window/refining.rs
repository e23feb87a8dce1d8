//! How good the spheres are while something moves, and what that costs.

use std::time::{Duration, Instant};

use eframe::egui::{Key, Modifiers, Pos2, accesskit::Role, vec2};
use egui_kittest::kittest::Queryable;

use crate::drive::Window;

/// A window in which a picture may take a millisecond while something moves.
fn hurried() -> Window {
    let mut window = Window::open(None);
    window.click("Preview");
    window.drag_slider("Preview quality", 0.5, 0.01);
    window.press(Modifiers::NONE, Key::Escape);
    window
}

/// Moves the pointer back and forth over a slider that is held, until the window shows a text; false where it does not.
fn moves_until(window: &mut Window, at: Pos2, text: &str) -> bool {
    window.harness.drag_at(at);
    for step in 0..400 {
        window.harness.hover_at(at + vec2(if step % 2 == 0 { 6.0 } else { -6.0 }, 0.0));
        window.harness.step();
        if window.shows(text) {
            return true;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    false
}

#[test]
fn a_coarse_picture_says_so_beside_the_spheres_and_what_it_costs() {
    let mut window = hurried();
    assert!(window.shows("Finished: every pixel, every nanometre") && !window.shows("Coarse"));
    let sliders: Vec<_> = window.harness.query_all_by_role(Role::Slider).map(|node| node.rect()).collect();
    let at = sliders[0].center();
    let start = Instant::now();
    // What it costs is measured while the hand rests, after a while.
    while !moves_until(&mut window, at, "ΔE ≈") || !window.shows("off the finished picture, at most ≈") {
        assert!(start.elapsed() < Duration::from_secs(300), "what it costs is never said");
        window.harness.drop_at(at);
        window.settle();
    }
    assert!(window.shows("Coarse: every ") && window.shows(" pixel, every nanometre"));
    assert!(window.shows("preset to truth: mean ΔE ≈"), "numbers of a coarse picture are marked");
    window.harness.drop_at(at);
    window.settle();
    assert!(window.shows("Finished: every pixel, every nanometre") && !window.shows("Coarse"));
    assert!(!window.shows("≈"));
}

/// The sentence about the cost changes while the slider is moved, and nothing may cover it.
#[test]
fn the_slider_of_the_budget_has_its_words_above_it_and_no_tooltip() {
    let mut window = Window::open(None);
    let tooltips = |window: &Window| window.harness.query_all_by_role(Role::Tooltip).count();
    let button = window.harness.get_by_label("Preview").rect();
    window.harness.hover_at(button.center());
    window.harness.run_steps(60);
    assert_eq!(tooltips(&window), 1, "the button has one");
    window.click("Preview");
    let slider = window.harness.get_by_role_and_label(Role::Slider, "Preview quality").rect();
    let words = window.harness.get_by_label("While something moves, a picture may take").rect();
    assert!(words.bottom() <= slider.top());
    window.harness.hover_at(slider.center());
    window.harness.run_steps(60);
    assert_eq!(tooltips(&window), 0);
}
