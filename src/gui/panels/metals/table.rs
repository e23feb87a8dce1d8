//! Every metal against every model, sortable by any column.

use eframe::egui::{Align, Button, ComboBox, Label, Layout, RichText, Ui};
use egui_extras::{Column, TableBuilder};

use crate::color::RgbSpace;
use crate::gui::metals::{CONTESTANTS, Measure, MetalsPage, Sorting};
use crate::gui::theme;

/// Shows the table.
pub(crate) fn show(ui: &mut Ui, page: &mut MetalsPage) {
    ui.horizontal(|ui| {
        ui.heading("Accuracy of every model");
        view_switch(ui, page);
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
    });
    let (sorting, measure, selected) = (page.sorting, page.measure, page.metal.id.clone());
    let Some(rows) = page.table(ui.ctx()).map(<[_]>::to_vec) else {
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
                ui.add(Label::new(&entry.metal.name).truncate().selectable(false));
            });
            for cell in &entry.cells {
                row.col(|ui| {
                    value(ui, measure.of(cell));
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

/// A heading that sorts; gives its column when it was clicked.
fn heading(ui: &mut Ui, name: &str, what: &str, sorting: Sorting, column: Option<usize>) -> Option<Option<usize>> {
    let is_sorted = sorting.column == column;
    let arrow = match (is_sorted, sorting.is_descending) {
        (false, _) => "",
        (true, false) => " ▲",
        (true, true) => " ▼",
    };
    let text = RichText::new(format!("{name}{arrow}")).small();
    let button = ui.add(Button::new(text).frame(false).wrap());
    button
        .on_hover_text(format!("{what}. Click to sort"))
        .accessible_name(format!("Sort by {name}"))
        .clicked()
        .then_some(column)
}

fn value(ui: &mut Ui, delta_e: f64) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let words = theme::number(format!("{delta_e:.2}"));
        // Just noticeable is about 1: what is above stands out, what is below steps back.
        ui.label(if delta_e < 1.0 { words.weak() } else { words });
    });
}

/// Curves or table, and the space of both.
pub(crate) fn view_switch(ui: &mut Ui, page: &mut MetalsPage) {
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
        ui.selectable_value(&mut page.is_table, true, "All metals").on_hover_text("A table of every metal and model");
        ui.selectable_value(&mut page.is_table, false, "Curves").on_hover_text("Models over the truth of this metal");
    });
}
