//! Does the window look as it was judged to look? Needs a renderer: software Vulkan is enough, none is a failure.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test --test window` writes the pictures anew; look at them before committing them.

use edgewise::sample::samples;
use eframe::egui::{Key, Modifiers, Theme};

use crate::drive::Window;

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

#[test]
fn the_page_of_metals() {
    let mut window = Window::for_picture(Theme::Light);
    window.press(Modifiers::COMMAND, Key::Num2);
    window.picture("metals");
}

#[test]
fn the_page_of_demonstrations() {
    let mut window = Window::for_picture(Theme::Dark);
    window.press(Modifiers::COMMAND, Key::Num3);
    window.click("Blending: Can a painted mask be filtered?");
    window.picture("demonstrations");
}
