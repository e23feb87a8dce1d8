//! The page of metals: the library, curves of models over the truth, a table of all, and where data come from.

mod curves;
mod detail;
mod library;
mod table;

use eframe::egui::{CentralPanel, Frame, Margin, Panel, Ui};

use crate::gui::command::Action;
use crate::gui::state::State;
use crate::gui::theme;

/// Shows the page.
pub(crate) fn show(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    let side = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(theme::MARGIN, 10));
    Panel::left("library").frame(side).resizable(false).exact_size(theme::LIBRARY_WIDTH).show(ui, |ui| {
        library::show(ui, &mut state.metals, actions);
    });
    Panel::right("detail").frame(side).resizable(false).exact_size(theme::INSPECTOR_WIDTH).show(ui, |ui| {
        detail::show(ui, &mut state.metals, actions);
    });
    CentralPanel::no_frame().frame(side).show(ui, |ui| {
        if state.metals.is_table {
            table::show(ui, &mut state.metals);
        } else {
            curves::show(ui, &mut state.metals);
        }
    });
}
