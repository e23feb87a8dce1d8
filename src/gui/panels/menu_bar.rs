//! The menus, and the button for dark and light.

use eframe::egui::{Align, Button, Layout, MenuBar, Ui, Vec2};

use crate::gui::command::{Action, Command};
use crate::gui::state::{Page, State};
use crate::gui::theme;

/// Shows the menu bar.
pub(crate) fn show(ui: &mut Ui, state: &State, actions: &mut Vec<Action>) {
    MenuBar::new().ui(ui, |ui| {
        for (name, groups) in Command::MENUS {
            ui.menu_button(name, |ui| menu(ui, groups, state, actions));
        }
        ui.add_space(theme::GROUP_GAP);
        let padding = std::mem::replace(&mut ui.spacing_mut().button_padding.x, theme::TAB_PADDING);
        for page in Page::ALL {
            let command = Command::show(page);
            let tab = Button::selectable(state.page == page, theme::title(page.label()))
                .min_size(Vec2::new(theme::TAB_WIDTH, theme::ROW));
            let key = command.shortcut().map(|key| ui.ctx().format_shortcut(&key)).unwrap_or_default();
            let response = ui.add(tab).on_hover_text(format!("{} ({key})", command.tooltip()));
            if response.accessible_name(page.label()).clicked() {
                actions.push(command.into());
            }
        }
        ui.spacing_mut().button_padding.x = padding;
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
