//! Every metal against every model, sortable by any column.

use eframe::egui::{Align, Button, ComboBox, Layout, RichText, Ui};
use egui_extras::{Column, TableBuilder};

use super::{saving, views};
use crate::fit::CurveError;
use crate::gui::command::Action;
use crate::gui::metals::{CONTESTANTS, Measure, MetalsPage, Sorting};
use crate::gui::sheet::SheetKind;
use crate::gui::theme;

/// Shows the table.
pub(crate) fn show(ui: &mut Ui, page: &mut MetalsPage, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.heading("Accuracy of every model");
        views(ui, page);
    });
    ui.horizontal(|ui| {
        ui.label(theme::hint("CIEDE2000 to the spectral truth."));
        ComboBox::from_id_salt("measure")
            .selected_text(Measure::ALL.iter().find(|(m, _)| *m == page.measure).map_or("", |(_, name)| name))
            .show_ui(ui, |ui| {
                for (measure, name) in Measure::ALL {
                    ui.selectable_value(&mut page.measure, measure, name);
                }
            })
            .response
            .on_hover_text("What the cells show")
            .accessible_name("What the cells show");
        let what = "Every metal against every model by the mean over 0–90°, as .svg or .png";
        saving(ui, &[(SheetKind::Table, "Save table…")], what, actions);
    });
    let (sorting, measure, selected) = (page.sorting, page.measure, page.metal.id.clone());
    let Some(rows) = page.table(ui.ctx()) else {
        ui.label(theme::hint("Measuring"));
        return;
    };
    let mut clicked = None;
    let mut chosen = None;
    let table = TableBuilder::new(ui)
        .striped(true)
        .sense(eframe::egui::Sense::click())
        .column(Column::remainder().at_least(110.0).clip(true))
        .columns(Column::exact(CELL_WIDTH), CONTESTANTS.len());
    let table = table.header(theme::ROW + 4.0, |mut header| {
        header.col(|ui| clicked = clicked.or(heading(ui, "Metal", "By name", sorting, None)));
        for (index, contestant) in CONTESTANTS.iter().enumerate() {
            header.col(|ui| clicked = clicked.or(heading(ui, contestant.name, contestant.what, sorting, Some(index))));
        }
    });
    table.body(|body| {
        body.rows(theme::ROW - 2.0, rows.len(), |mut row| {
            let entry = &rows[row.index()];
            row.set_selected(entry.metal.id == selected);
            row.col(|ui| {
                let name = &entry.metal.name;
                ui.spacing_mut().button_padding.x = 0.0;
                let button = ui.add(Button::new(name).frame(false).truncate());
                if button.accessible_name(format!("{name} in the table")).clicked() {
                    chosen = Some(entry.metal);
                }
            });
            for cell in &entry.cells {
                row.col(|ui| {
                    value(ui, measure, cell);
                });
            }
            if row.response().clicked() {
                chosen = Some(entry.metal);
            }
        });
    });
    if let Some(column) = clicked {
        page.sorting.click(column);
    }
    if let Some(metal) = chosen {
        page.metal = metal;
    }
}

const CELL_WIDTH: f32 = 62.0;

/// A heading that sorts, over the edge of its values that lines up; gives its column when it was clicked.
fn heading(ui: &mut Ui, name: &str, what: &str, sorting: Sorting, column: Option<usize>) -> Option<Option<usize>> {
    let arrow = match (sorting.column == column, sorting.is_descending) {
        (false, _) => "",
        (true, false) => "▲ ",
        (true, true) => "▼ ",
    };
    let text = RichText::new(format!("{arrow}{name}")).small();
    let align = if column.is_none() { Align::LEFT } else { Align::RIGHT };
    let button = ui.with_layout(Layout::top_down(align), |ui| {
        ui.spacing_mut().button_padding.x = 0.0;
        ui.add(Button::new(text).frame(false).wrap())
    });
    let button = button.inner.on_hover_text(format!("{what}. Click to sort"));
    button.accessible_name(format!("Sort by {name}")).clicked().then_some(column)
}

fn value(ui: &mut Ui, measure: Measure, error: &CurveError) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let value = measure.of(error);
        if measure == Measure::Angle {
            ui.label(theme::number(format!("{value:.0}°")));
            return;
        }
        let words = theme::number(format!("{value:.2}"));
        // Just noticeable is about 1: what is above stands out, what is below steps back.
        ui.label(if value < 1.0 { words.weak() } else { words });
    });
}
