//! The photograph: opening it, looking at it, marking it, and what is solved from it.

mod marks;
mod matching;
mod mode;
mod opening;
mod references;
mod view;

use eframe::egui::{CentralPanel, Frame, Panel, ScrollArea, Ui, Vec2};

use crate::gui::command::Action;
use crate::gui::photograph::{Reading, Session};
use crate::gui::state::State;
use crate::gui::theme;
use crate::gui::widgets::photo_view;

/// Shows the panel beside the preset; `reading` is the photograph on its way.
pub(crate) fn show(ui: &mut Ui, state: &mut State, reading: Option<&Reading>, actions: &mut Vec<Action>) {
    let space = state.document.space();
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        opening::reading_bar(ui, reading, actions);
        if opening::first_look(ui, reading, theme::PHOTO_HEIGHT) {
            return;
        }
        match &mut state.photograph {
            None => opening::empty(ui, &mut state.path, actions),
            Some(session) => {
                view::header(ui, session, actions);
                picture(ui, session, theme::PHOTO_HEIGHT);
                // Here r and h are what matters: they stand where no list of marks pushes them out of sight.
                matching::show(ui, session, space);
                ui.add_space(theme::GAP);
                controls(ui, session, actions);
            }
        }
    });
}

/// Shows the page on which the photograph has most of the window.
pub(crate) fn page(ui: &mut Ui, state: &mut State, reading: Option<&Reading>, side: Frame, actions: &mut Vec<Action>) {
    let space = state.document.space();
    if reading.is_some_and(|reading| reading.look().is_some()) {
        CentralPanel::no_frame().frame(side).show(ui, |ui| {
            opening::reading_bar(ui, reading, actions);
            let height = (ui.available_height() - theme::ROW - theme::GAP).max(theme::PHOTO_HEIGHT);
            opening::first_look(ui, reading, height);
        });
        return;
    }
    let Some(session) = &mut state.photograph else {
        CentralPanel::no_frame().frame(side).show(ui, |ui| {
            ui.allocate_ui(Vec2::new(theme::PHOTO_WIDTH, ui.available_height()), |ui| {
                opening::reading_bar(ui, reading, actions);
                opening::empty(ui, &mut state.path, actions);
                opening::tips(ui);
            });
        });
        return;
    };
    Panel::right("match").frame(side).resizable(false).exact_size(theme::PHOTO_WIDTH).show(ui, |ui| {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            controls(ui, session, actions);
            ui.add_space(theme::GAP);
            matching::show(ui, session, space);
        });
    });
    CentralPanel::no_frame().frame(side).show(ui, |ui| {
        opening::reading_bar(ui, reading, actions);
        view::header(ui, session, actions);
        let below = 3.0 * (theme::ROW + theme::GAP);
        picture(ui, session, (ui.available_height() - below).max(theme::PHOTO_HEIGHT));
    });
}

/// The photograph with the ways to look at it above and below.
fn picture(ui: &mut Ui, session: &mut Session, height: f32) {
    view::looking(ui, session);
    let point = photo_view(ui, session, Vec2::new(ui.available_width(), height));
    view::development(ui, session);
    view::under_pointer(ui, session, point);
}

/// The mode and the marks.
fn controls(ui: &mut Ui, session: &mut Session, actions: &mut Vec<Action>) {
    mode::show(ui, session);
    ui.add_space(theme::GAP);
    marks::show(ui, session, actions);
}
