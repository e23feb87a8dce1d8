//! The page of metals: the library, curves and spheres of models over the truth, a table of all, where data come from.

mod curves;
mod detail;
mod library;
mod spheres;
mod table;

use eframe::egui::{Align, CentralPanel, ComboBox, Frame, Layout, Margin, Panel, Ui};

use crate::color::RgbSpace;
use crate::gui::command::Action;
use crate::gui::metals::{MetalsPage, MetalsView};
use crate::gui::sheet::SheetKind;
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
        let page = &mut state.metals;
        match page.view {
            MetalsView::Curves => curves::show(ui, page, actions),
            MetalsView::Spheres => spheres::show(ui, page, &mut state.view.preview_ms, actions),
            MetalsView::Table => table::show(ui, page, actions),
        }
    });
}

/// The metal on show, and the views of it.
fn heading(ui: &mut Ui, page: &mut MetalsPage) {
    ui.horizontal(|ui| {
        ui.heading(&page.metal.name);
        ui.label(theme::hint(format!("{} {}", page.metal.provenance.citation(), page.metal.dataset)));
        views(ui, page);
    });
}

/// Curves, spheres or table, and the space of all of them.
fn views(ui: &mut Ui, page: &mut MetalsPage) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        ComboBox::from_id_salt("space of metals")
            .selected_text(page.space.label())
            .show_ui(ui, |ui| {
                for space in RgbSpace::ALL {
                    ui.selectable_value(&mut page.space, space, space.label());
                }
            })
            .response
            .on_hover_text("The space of the models and of the differences")
            .accessible_name("Space of the comparison");
        for (view, name, what) in MetalsView::ALL.into_iter().rev() {
            ui.selectable_value(&mut page.view, view, name).on_hover_text(what);
        }
    });
}

/// A menu of what can be saved; one thing alone is a button.
fn saving(ui: &mut Ui, kinds: &[(SheetKind, &str)], what: &str, actions: &mut Vec<Action>) {
    ui.add_space(theme::GAP);
    if let [(kind, name)] = kinds {
        if ui.button(*name).on_hover_text(what).clicked() {
            actions.push(Action::SaveSheet(*kind));
        }
        return;
    }
    let menu = ui.menu_button("Save ▾", |ui| {
        for (kind, name) in kinds {
            if ui.button(*name).on_hover_text(what).clicked() {
                actions.push(Action::SaveSheet(*kind));
            }
        }
    });
    menu.response.on_hover_text(what).accessible_name("Save the spheres");
}
