//! Opening a photograph where there is none yet.

use std::path::PathBuf;

use eframe::egui::{Button, Image, Key, Label, ProgressBar, RichText, TextEdit, Ui, Vec2};

use crate::gui::command::{Action, Command};
use crate::gui::photograph::Reading;
use crate::gui::theme;
use crate::sample::samples;

/// How far the photograph on its way is.
pub(super) fn reading_bar(ui: &mut Ui, reading: Option<&Reading>, actions: &mut Vec<Action>) {
    let Some(reading) = reading else { return };
    let (name, progress) = (reading.source().name(), reading.progress());
    ui.horizontal(|ui| {
        let width = ui.available_width() - 76.0;
        ui.add(ProgressBar::new(progress).desired_width(width).text(format!("Reading {name}")));
        if ui.button("Cancel").on_hover_text("Stop reading the photograph").clicked() {
            actions.push(Action::StopReading);
        }
    });
}

/// A coarse copy of the photograph on its way, no higher than a height; false where there is none yet.
pub(super) fn first_look(ui: &mut Ui, reading: Option<&Reading>, height: f32) -> bool {
    let Some((reading, (texture, size))) = reading.and_then(|reading| Some((reading, reading.look()?))) else {
        return false;
    };
    ui.label(theme::hint("A first look, still reading: nothing is measured in it."));
    let scale = (ui.available_width() / size.x).min(height / size.y);
    let name = format!("First look at {}, still reading", reading.source().name());
    let image = Image::from_texture((texture.id(), size * scale)).alt_text(&name);
    ui.add(image).accessible_name(name);
    true
}

/// What to do where there is no photograph yet.
pub(super) fn empty(ui: &mut Ui, path: &mut String, actions: &mut Vec<Action>) {
    ui.heading("Match a photograph");
    let words = "Open a photograph of a metal ball, mark the ball and what is white, and r and h are measured from it.";
    ui.add(Label::new(RichText::new(words).weak()).wrap());
    ui.add_space(theme::GAP);
    if ui.button("Open…").on_hover_text(Command::Open.tooltip()).accessible_name("Open a photograph…").clicked() {
        actions.push(Command::Open.into());
    }
    path_row(ui, path, actions);
    ui.label(theme::hint("Or drop a file on the window."));
    ui.add_space(theme::GROUP_GAP);
    ui.label(theme::title("Samples"));
    ui.label(theme::hint("Rendered from measured metals, with known r and h."));
    for sample in samples() {
        ui.add_space(theme::GAP);
        let button = Button::new(&sample.facts.title).min_size(Vec2::new(ui.available_width(), theme::ROW));
        if ui.add(button).on_hover_text("Open this sample").accessible_name(&sample.facts.title).clicked() {
            actions.push(Action::OpenSample(sample));
        }
        ui.add(Label::new(theme::hint(&sample.facts.description)).wrap());
    }
}

/// What spoils a photograph without a trace in it: nothing can warn of these afterwards.
const TIPS: [&str; 4] = [
    "No polarising filter: a metal's reflection is polarised at the rim, where h shows.",
    "No screen as a light or as a backdrop: its light is polarised, too.",
    "No clear blue sky: at a right angle to the sun it is polarised, which moves h by up to .1.",
    "Polished metal: a rough surface shows a mean over many angles, and glass baubles are silvered glass.",
];

/// How to photograph.
pub(super) fn tips(ui: &mut Ui) {
    ui.add_space(theme::GROUP_GAP);
    ui.label(theme::title("When photographing"));
    for tip in TIPS {
        ui.add(Label::new(theme::hint(tip)).wrap());
    }
}

fn path_row(ui: &mut Ui, path: &mut String, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let width = ui.available_width() - 64.0;
        let field = TextEdit::singleline(path).desired_width(width).hint_text("Path of a photograph");
        let response = ui.add(field).accessible_name("Path of a photograph");
        let is_entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let is_chosen = ui.button("Open").on_hover_text("Open the path").accessible_name("Open the path").clicked();
        if (is_entered || is_chosen) && !path.trim().is_empty() {
            actions.push(Action::Load(PathBuf::from(path.trim())));
        }
    });
}
