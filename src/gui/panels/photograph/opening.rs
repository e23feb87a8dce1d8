//! Opening a photograph where there is none yet.

use std::path::PathBuf;

use eframe::egui::{Button, Key, Label, ProgressBar, RichText, TextEdit, Ui, Vec2};

use super::Reading;
use crate::gui::command::{Action, Command};
use crate::gui::theme;
use crate::sample::samples;

/// How far the photograph on its way is.
pub(super) fn reading_bar(ui: &mut Ui, reading: Reading, actions: &mut Vec<Action>) {
    let Some((name, progress)) = reading else { return };
    ui.horizontal(|ui| {
        let width = ui.available_width() - 76.0;
        ui.add(ProgressBar::new(progress).desired_width(width).text(format!("Reading {name}")));
        if ui.button("Cancel").on_hover_text("Stop reading the photograph").clicked() {
            actions.push(Action::StopReading);
        }
    });
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
