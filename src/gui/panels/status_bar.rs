//! The line at the bottom: file, space, warnings.

use eframe::egui::{Align, Layout, RichText, Sense, Ui, Vec2};

use crate::gui::state::State;
use crate::gui::theme::{self, Palette};
use crate::gui::warnings::warnings;

/// Shows the status bar.
pub(crate) fn show(ui: &mut Ui, state: &State) {
    ui.horizontal(|ui| {
        file(ui, state);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.label(theme::hint("Pictures are shown as sRGB, without colour management"));
            ui.separator();
            ui.label(theme::hint(state.document.space().label()));
            ui.separator();
            let count = warnings(state).len();
            let text = match count {
                0 => "No warnings".to_owned(),
                1 => "1 warning".to_owned(),
                n => format!("{n} warnings"),
            };
            let colour = if count == 0 { ui.visuals().weak_text_color() } else { Palette::of(ui).warning };
            ui.label(RichText::new(text).small().color(colour));
        });
    });
}

fn file(ui: &mut Ui, state: &State) {
    let palette = Palette::of(ui);
    let (colour, what) = if state.document.is_changed() {
        (palette.accent, "unsaved changes")
    } else {
        (ui.visuals().weak_text_color(), "no changes")
    };
    let (rect, _) = ui.allocate_exact_size(Vec2::splat(8.0), Sense::hover());
    if state.document.is_changed() {
        ui.painter().circle_filled(rect.center(), 3.5, colour);
    } else {
        ui.painter().circle_stroke(rect.center(), 3.0, eframe::egui::Stroke::new(1.0, colour));
    }
    let label = ui.label(theme::hint(format!("{}, {what}", state.document.title())));
    if let Some(path) = state.document.file() {
        label.on_hover_text(path.display().to_string());
    }
}
