//! Parameters stored with few digits.

use eframe::egui::{Align, Grid, Layout, Ui};

use super::row::{self, Row};
use super::{delta_e_text, sentence, told};
use crate::gui::demonstrations::{Open, ShownQuantisation};
use crate::gui::state::State;
use crate::gui::theme;
use crate::study::{Encoding, Parameters, Storage};

/// Shows the gradients and the table.
pub(super) fn show(ui: &mut Ui, state: &mut State) {
    let open = Open { preset: &state.document.preset, metal: state.view.metal };
    let page = &mut state.demonstrations;
    let mut storage = page.storage;
    let result = page.quantisation(ui.ctx(), open);
    let Some(shown) = told(ui, result, None) else { return };
    sentence(ui, &shown.study.summary(), &shown.losses);
    storages(ui, &mut storage);
    gradients(ui, shown, storage);
    ui.add_space(theme::GROUP_GAP);
    table(ui, shown);
    page.storage = storage;
}

fn storages(ui: &mut Ui, storage: &mut Storage) {
    ui.horizontal(|ui| {
        ui.add_space(theme::BAND_NAMES);
        for choice in Storage::ALL {
            let response = ui.selectable_value(storage, choice, choice.label());
            response.on_hover_text("How the edge parameter of the gradients is stored");
        }
    });
}

fn gradients(ui: &mut Ui, shown: &ShownQuantisation, storage: Storage) {
    let study = &shown.study;
    let text = format!(
        "Colour at 81.8° while only h, t, g or k goes from {} to {}. Above: stored linear. Below: sRGB-encoded. \
         ΔE of the largest step",
        study.name, study.towards
    );
    row::caption(ui, &text);
    let height = ((ui.available_height() - TABLE) / 8.0 - theme::GAP / 2.0).clamp(theme::BAND_HEIGHT, TALLEST);
    for parameters in Parameters::ALL {
        let found = Encoding::ALL.map(|encoding| {
            let is_it = |row: &crate::study::QuantisationRow| {
                (row.parameters, row.storage, row.encoding) == (parameters, storage, encoding)
            };
            study.results.iter().position(|result| is_it(&result.row))
        });
        let [Some(linear), Some(encoded)] = found else { continue };
        let said = |index: usize| {
            let row = &study.results[index].row;
            let encoding = if row.encoding == Encoding::Linear { "linear" } else { "sRGB" };
            format!("{} {encoding}, {} bands", delta_e_text(row.band_delta_e), row.bands)
        };
        let clipped = study.results[linear].row.clipped;
        let mut numbers = vec![said(linear), said(encoded)];
        if clipped > 0 {
            numbers.push(format!("{clipped} beyond 1, clipped"));
        }
        let bands = [&shown.gradients[linear], &shown.gradients[encoded]];
        let colour = row::ink(ui, parameters);
        let name = parameters.label();
        Row { name, colour, bands: &bands, height, is_stepped: true, numbers: &numbers }.show(ui);
    }
}

/// Height of the table and the words above it.
const TABLE: f32 = 208.0;
/// Height of a band where there is room.
const TALLEST: f32 = 40.0;

/// What half a code can do, in every storage.
fn table(ui: &mut Ui, shown: &ShownQuantisation) {
    let text = format!("Largest ΔE2000 that rounding h, t, g or k of {} by half a code can cause", shown.study.name);
    row::caption(ui, &text);
    ui.horizontal(|ui| {
        ui.add_space(theme::BAND_NAMES);
        Grid::new("rounding").num_columns(7).spacing([theme::GROUP_GAP, theme::GAP]).show(ui, |ui| {
            ui.label("");
            for storage in Storage::ALL {
                for encoding in Encoding::ALL {
                    right(ui, theme::hint(format!("{}\n{}", storage.label(), encoding.label())));
                }
            }
            ui.end_row();
            for parameters in Parameters::ALL {
                ui.label(eframe::egui::RichText::new(parameters.label()).color(row::ink(ui, parameters)));
                for storage in Storage::ALL {
                    for encoding in Encoding::ALL {
                        let result = shown.study.result(parameters, storage, encoding);
                        let value = result.map_or(f64::NAN, |result| result.row.rounding_delta_e);
                        right(ui, theme::number(format!("{value:.3}")));
                    }
                }
                ui.end_row();
            }
        });
    });
}

/// Width of a column of the table.
const COLUMN: f32 = 84.0;

fn right(ui: &mut Ui, text: eframe::egui::RichText) {
    ui.allocate_ui_with_layout(
        eframe::egui::vec2(COLUMN, ui.spacing().interact_size.y),
        Layout::right_to_left(Align::Center),
        |ui| {
            ui.set_min_width(COLUMN);
            ui.label(text);
        },
    );
}
