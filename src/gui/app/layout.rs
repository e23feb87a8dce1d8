//! Where the panels of each page are.

use eframe::egui::{CentralPanel, Frame, Margin, Panel, Ui};

use super::App;
use crate::gui::command::Action;
use crate::gui::state::Page;
use crate::gui::{panels, theme};

impl App {
    pub(super) fn panels(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        let margin = |x, y| Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(x, y));
        let (bar, side) = (margin(8, 4), margin(theme::MARGIN, 10));
        Panel::top("menu").frame(bar).show(ui, |ui| panels::menu_bar::show(ui, &self.state, actions));
        if !self.state.notices.is_empty() {
            Panel::top("notices").frame(bar).show(ui, |ui| panels::notices::show(ui, &mut self.state));
        }
        if self.dialog.is_some() {
            Panel::top("waiting").frame(bar).show(ui, |ui| self.waiting_for_dialog(ui));
        }
        Panel::bottom("status").frame(bar).show(ui, |ui| panels::status_bar::show(ui, &self.state));
        match self.state.page {
            Page::Author => self.author_page(ui, side, actions),
            Page::Photograph => {
                panels::photograph::page(ui, &mut self.state, self.reading.as_ref(), side, actions);
            }
            Page::Metals => panels::metals::show(ui, &mut self.state, actions),
            Page::Demonstrations => panels::demonstrations::show(ui, &mut self.state, actions),
            Page::Planner => panels::planner::show(ui, &mut self.state, actions),
            Page::Library => panels::library::show(ui, &mut self.state, actions),
        }
    }

    pub(super) fn author_page(&mut self, ui: &mut Ui, side: Frame, actions: &mut Vec<Action>) {
        Panel::right("inspector").frame(side).resizable(false).exact_size(theme::INSPECTOR_WIDTH).show(ui, |ui| {
            panels::inspector::show(ui, &mut self.state, actions);
        });
        let photograph = Panel::left("photograph").frame(side).resizable(true).default_size(theme::PHOTO_WIDTH);
        photograph.size_range(theme::PHOTO_WIDTHS).show(ui, |ui| {
            panels::photograph::show(ui, &mut self.state, self.reading.as_ref(), actions);
        });
        CentralPanel::no_frame().frame(side).show(ui, |ui| panels::curves::show(ui, &mut self.state, actions));
    }
}
