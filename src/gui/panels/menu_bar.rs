//! The menus, and the button for dark and light.

use eframe::egui::{Align, Layout, MenuBar, Ui};

use crate::gui::command::{Action, Command};
use crate::gui::state::State;

/// Shows the menu bar.
pub(crate) fn show(ui: &mut Ui, state: &State, actions: &mut Vec<Action>) {
    MenuBar::new().ui(ui, |ui| {
        for (name, groups) in Command::MENUS {
            ui.menu_button(name, |ui| menu(ui, groups, state, actions));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let next = if ui.visuals().dark_mode { "Light" } else { "Dark" };
            let button = ui.button(next).on_hover_text(Command::ToggleTheme.tooltip());
            if button.accessible_name(format!("Change to the {} window", next.to_lowercase())).clicked() {
                actions.push(Command::ToggleTheme.into());
            }
        });
    });
}

fn menu(ui: &mut Ui, groups: &[&[Command]], state: &State, actions: &mut Vec<Action>) {
    for (index, group) in groups.iter().enumerate() {
        if index > 0 {
            ui.separator();
        }
        for &command in *group {
            if command.button(ui, state).clicked() {
                actions.push(command.into());
            }
        }
    }
}
