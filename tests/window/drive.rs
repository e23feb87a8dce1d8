//! A window without a display, and what a person does with it.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use edgewise::gui::App;
use edgewise::preset::Preset;
use eframe::egui::{DroppedFile, Event, Key, Modifiers, Pos2, Theme, accesskit::Role, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

/// No job of these tests takes long by itself, but a machine may be busy with much else; one that does not end must
/// not hang the tests.
const PATIENCE: Duration = Duration::from_secs(600);

/// Size of a new window, in points.
const USUAL: [f32; 2] = [1280.0, 800.0];

/// A file as a file manager hands it over.
#[derive(Debug)]
struct Dropped(PathBuf);

impl DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

pub struct Window {
    pub harness: Harness<'static, App>,
}

impl Window {
    pub fn open(path: Option<PathBuf>) -> Self {
        Self::of_size(USUAL, path)
    }

    /// A window so many points wide and high.
    pub fn of_size(size: [f32; 2], path: Option<PathBuf>) -> Self {
        let builder = Harness::builder().with_size(size).with_max_steps(30);
        let mut window = Self { harness: builder.build_eframe(move |cc| App::new(&cc.egui_ctx, path)) };
        window.settle();
        window
    }

    /// A window for a picture: the usual size, at fewer pixels so that the pictures in the repository stay small.
    pub fn for_picture(theme: Theme) -> Self {
        Self::for_picture_of(USUAL, theme)
    }

    /// A window for a picture of another size.
    pub fn for_picture_of(size: [f32; 2], theme: Theme) -> Self {
        let builder = Harness::builder().with_size(size).with_max_steps(30).with_theme(theme);
        let builder = builder.with_pixels_per_point(0.7);
        let mut window = Self { harness: builder.build_eframe(|cc| App::new(&cc.egui_ctx, None)) };
        window.settle();
        window
    }

    /// Holds what is shown against the picture of that name.
    pub fn picture(&mut self, name: &str) {
        self.harness.remove_cursor();
        self.settle();
        self.harness.snapshot(name);
    }

    /// Runs frames until no job is at work and nothing moves.
    pub fn settle(&mut self) {
        let start = Instant::now();
        loop {
            // One by one: a job that reports how far it is asks for as many frames as it likes.
            self.harness.step();
            if !self.harness.state().is_busy() {
                self.harness.run();
                if !self.harness.state().is_busy() {
                    return;
                }
            }
            assert!(start.elapsed() < PATIENCE, "a job does not end");
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    pub fn preset(&self) -> &Preset {
        &self.harness.state().state().document.preset
    }

    pub fn notices(&self) -> Vec<String> {
        self.harness.state().state().notices().map(str::to_owned).collect()
    }

    pub fn click(&mut self, name: &str) {
        self.harness.get_by_label(name).click();
        self.settle();
    }

    /// Clicks a checkbox, where a number or a legend may have the same name.
    pub fn tick(&mut self, name: &str) {
        self.harness.get_by_role_and_label(Role::CheckBox, name).click();
        self.settle();
    }

    pub fn press(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.settle();
    }

    /// Types into whatever has the focus.
    pub fn type_text(&mut self, text: &str) {
        self.harness.event(Event::Text(text.to_owned()));
        self.settle();
    }

    /// Runs a command as a person would without a mouse: by its name.
    pub fn command(&mut self, name: &str) {
        self.press(Modifiers::COMMAND, Key::K);
        self.type_text(name);
        self.press(Modifiers::NONE, Key::Enter);
    }

    /// Replaces the text of a field.
    pub fn enter(&mut self, name: &str, text: &str) {
        self.harness.get_by_label(name).click();
        self.settle();
        self.press(Modifiers::COMMAND, Key::A);
        self.type_text(text);
        self.press(Modifiers::NONE, Key::Enter);
    }

    /// Drops a file on the window.
    pub fn drop_file(&mut self, path: &Path) {
        self.harness.input_mut().dropped_files.push(std::sync::Arc::new(Dropped(path.to_owned())));
        self.settle();
    }

    /// Empties a field.
    pub fn clear(&mut self, name: &str) {
        self.harness.get_by_label(name).click();
        self.settle();
        self.press(Modifiers::COMMAND, Key::A);
        self.press(Modifiers::NONE, Key::Backspace);
    }

    /// Answers the question for a path.
    pub fn answer_path(&mut self, path: &Path) {
        self.press(Modifiers::COMMAND, Key::A);
        self.type_text(path.to_str().unwrap());
        self.press(Modifiers::NONE, Key::Enter);
    }

    pub fn drag(&mut self, from: Pos2, to: Pos2) {
        self.harness.drag_at(from);
        self.harness.run();
        for step in 1..=4 {
            self.harness.hover_at(from + (to - from) * (step as f32 / 4.0));
            self.harness.run();
        }
        self.harness.drop_at(to);
        self.settle();
    }

    /// Drags the handle of a slider from one fraction of its rail to another.
    pub fn drag_slider(&mut self, name: &str, from: f32, to: f32) {
        let rect = self.harness.get_by_role_and_label(Role::Slider, name).rect();
        let at = |fraction: f32| rect.left_center() + vec2(rect.width() * fraction, 0.0);
        self.drag(at(from), at(to));
    }

    pub fn shows(&self, text: &str) -> bool {
        self.harness.query_all_by_label_contains(text).next().is_some()
    }
}
