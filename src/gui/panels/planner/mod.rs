//! The page of plans: the materials of a scene with the cheapest model for each, and cost against accuracy.

mod choices;
mod detail;
mod list;
mod place;
mod plan;
mod silhouette;
mod trade;
mod words;

use eframe::egui::{Align, CentralPanel, Frame, Key, Layout, Margin, Panel, ScrollArea, TextEdit, Ui};

use crate::gui::command::Action;
use crate::gui::planner::{PathField, PlanAction, PlanFile, PlannerView};
use crate::gui::state::State;
use crate::gui::theme;

/// Shows the page.
pub(crate) fn show(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    let side = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(theme::MARGIN, 10));
    Panel::left("planner").frame(side).resizable(false).exact_size(theme::DEMONSTRATIONS_WIDTH).show(ui, |ui| {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| choices::show(ui, state, actions));
    });
    CentralPanel::no_frame().frame(side).show(ui, |ui| {
        let before = state.planner.view;
        heading(ui, &mut state.planner.view);
        if state.planner.view != before {
            // What came of a file of the other view.
            state.planner.said = None;
        }
        let height = ui.available_height();
        ScrollArea::vertical().id_salt("view").auto_shrink(false).show(ui, |ui| {
            // What can grow fills the window; what cannot shrink as far is scrolled.
            ui.set_max_height(height);
            match state.planner.view {
                PlannerView::Plan => plan::show(ui, state, actions),
                PlannerView::Trade => trade::show(ui, state),
            }
        });
    });
}

fn heading(ui: &mut Ui, view: &mut PlannerView) {
    ui.horizontal(|ui| {
        let (title, question) = match view {
            PlannerView::Plan => {
                ("What the scene requires", "The cheapest model for each material that stays within a tolerance")
            }
            PlannerView::Trade => {
                ("Accuracy for cost", "Every model by what it costs and how far it is from the truth")
            }
        };
        ui.heading(title);
        ui.label(theme::hint(question));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            for (choice, name, what) in PlannerView::ALL.into_iter().rev() {
                ui.selectable_value(view, choice, name).on_hover_text(what);
            }
        });
    });
}

/// A path to type, and a button for the system's dialog.
fn path_field(ui: &mut Ui, field: &mut PathField, name: &str, file: PlanFile, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let text = TextEdit::singleline(&mut field.text).desired_width(ui.available_width() - 34.0);
        let response = ui.add(text.hint_text("/path/to/file.exr")).accessible_name(format!("Path of {name}"));
        if response.lost_focus() || (response.has_focus() && ui.input(|input| input.key_pressed(Key::Enter))) {
            field.enter();
        }
        let button = ui.button("…").on_hover_text(format!("Choose {name} in the system's dialog"));
        if button.accessible_name(format!("Choose {name}")).clicked() {
            actions.push(Action::Plan(PlanAction::Choose(file)));
        }
    });
}
