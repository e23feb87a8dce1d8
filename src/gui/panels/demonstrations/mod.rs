//! The page of demonstrations: a list, what the one on show is about, and what is seen.

mod blending;
mod chart;
mod choices;
mod conversion;
mod decoupling;
pub(super) mod dots;
mod feasibility;
mod matrix;
mod quantisation;
pub(super) mod row;
mod square;
mod uniformity;

use eframe::egui::{CentralPanel, Frame, Label, Margin, Panel, ProgressBar, ScrollArea, Ui};

use crate::gui::command::Action;
use crate::gui::demonstrations::{Demonstration, Told};
use crate::gui::state::State;
use crate::gui::theme::{self, Palette};

/// Shows the page.
pub(crate) fn show(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    let side = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(theme::MARGIN, 10));
    Panel::left("demonstrations").frame(side).resizable(false).exact_size(theme::DEMONSTRATIONS_WIDTH).show(ui, |ui| {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| choices::show(ui, state, actions));
    });
    CentralPanel::no_frame().frame(side).show(ui, |ui| {
        let height = ui.available_height();
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            // What can grow fills the window; what cannot shrink as far is scrolled.
            ui.set_max_height(height);
            let demonstration = state.demonstrations.demonstration;
            ui.horizontal(|ui| {
                ui.heading(demonstration.label());
                ui.label(theme::hint(demonstration.question()));
            });
            body(ui, demonstration, state, actions);
        });
    });
}

fn body(ui: &mut Ui, demonstration: Demonstration, state: &mut State, actions: &mut Vec<Action>) {
    match demonstration {
        Demonstration::Conversion if state.demonstrations.has_all_metals => conversion::show_all(ui, state, actions),
        Demonstration::Conversion => conversion::show(ui, state),
        Demonstration::Blending if state.demonstrations.has_all_pairs => matrix::show(ui, state, actions),
        Demonstration::Blending => blending::show(ui, state),
        Demonstration::Quantisation => quantisation::show(ui, state),
        Demonstration::Decoupling => decoupling::show(ui, state),
        Demonstration::Uniformity => uniformity::show(ui, state),
        Demonstration::Feasibility => feasibility::show(ui, state),
    }
}

/// What came of a study; where nothing has yet, how far it is, and where nothing can, why.
fn told<'a, T>(ui: &mut Ui, told: Option<&'a Told<T>>, progress: Option<f32>) -> Option<&'a T> {
    match (told, progress) {
        (Some(Ok(shown)), _) => return Some(shown),
        (Some(Err(error)), _) => {
            ui.add(Label::new(theme::sentence(error).color(Palette::of(ui).error)).wrap());
        }
        (None, Some(share)) => {
            ui.label(theme::hint("Measuring every metal"));
            ui.add(ProgressBar::new(share).desired_width(theme::DIALOG_WIDTH));
        }
        (None, None) => {
            ui.label(theme::hint("Measuring"));
        }
    }
    None
}

/// What is seen, and what has to be known about it.
pub(super) fn sentence(ui: &mut Ui, text: &str, notes: &[String]) {
    // “n, k” is one name.
    ui.add(Label::new(theme::sentence(text.replace("n, k", "n,\u{a0}k"))).wrap());
    if !notes.is_empty() {
        let all = notes.join("\n");
        let shown = theme::hint(format!("▲ {}", notes.join(". "))).color(Palette::of(ui).warning);
        ui.add(Label::new(shown).truncate()).on_hover_text(all);
    }
    ui.add_space(theme::GAP);
}

/// A ΔE with as many digits as say something.
pub(super) fn delta_e_text(value: f64) -> String {
    match value {
        v if v.is_nan() => "–".to_owned(),
        v if v < 1e-6 => "0".to_owned(),
        v if v < 0.095 => format!("{v:.2}"),
        v if v < 9.95 => format!("{v:.1}"),
        v => format!("{v:.0}"),
    }
}
