//! What the scene saves, the materials, and what is said of one of them.

use std::sync::Arc;

use eframe::egui::{Button, Label, ProgressBar, Ui};

use super::{detail, list};
use crate::gui::command::Action;
use crate::gui::demonstrations::Told;
use crate::gui::panels::demonstrations::sentence;
use crate::gui::planner::{PlanAction, PlanFile, PlanMaterial, Planned, PlannerPage};
use crate::gui::state::State;
use crate::gui::theme::{self, Palette};

/// Shows the plan.
pub(super) fn show(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    let State { planner: page, document, .. } = state;
    let told = page.follow(ui.ctx(), &document.preset);
    summary(ui, page, told.as_ref());
    let planned = told.and_then(Result::ok);
    if !page.is_fixed() {
        adding(ui, page, actions);
    }
    list::show(ui, page, &document.preset, planned.as_deref(), actions);
    if let Some(planned) = &planned {
        detail::show(ui, page, planned);
    }
}

fn summary(ui: &mut Ui, page: &PlannerPage, told: Option<&Told<Arc<Planned>>>) {
    match told {
        Some(Ok(planned)) => {
            let warnings = planned.seen.as_ref().map(|seen| seen.warnings.as_slice()).unwrap_or_default();
            sentence(ui, &planned.plan.summary(), warnings);
        }
        Some(Err(error)) => {
            ui.add(Label::new(theme::sentence(error).color(Palette::of(ui).error)).wrap());
        }
        None if page.entries().is_empty() => {
            ui.add(Label::new(theme::sentence("Add the materials of a scene to see what each requires")).wrap());
        }
        None => {
            ui.label(theme::hint("Fitting every model to every material"));
            ui.add(ProgressBar::new(page.progress().unwrap_or(0.0)).desired_width(theme::DIALOG_WIDTH));
        }
    }
}

/// Buttons that fill and empty the list.
fn adding(ui: &mut Ui, page: &mut PlannerPage, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.label(theme::hint("Add"));
        if ui.button("Metal…").on_hover_text("Add a material by its name").clicked() {
            actions.push(Action::Plan(PlanAction::Find));
        }
        let open = ui.button("Open preset").on_hover_text("Add the preset that is being authored, as it changes");
        if open.accessible_name("Add the open preset").clicked() {
            page.add(PlanMaterial::Open);
        }
        let file = ui.button("File…").on_hover_text("Add a preset, or n and k, from a file");
        if file.accessible_name("Add a file").clicked() {
            actions.push(Action::Plan(PlanAction::Choose(PlanFile::Material)));
        }
        let all = ui.button("All metals").on_hover_text("Add every metal of the library, seen on a sphere");
        if all.accessible_name("Add all metals").clicked() {
            page.scene.add_all_metals();
        }
        ui.separator();
        let empty = ui.add_enabled(!page.entries().is_empty(), Button::new("Empty"));
        if empty.on_hover_text("Take every material off the list").accessible_name("Empty the list").clicked() {
            page.clear();
        }
    });
}
