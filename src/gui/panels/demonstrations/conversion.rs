//! Parameters converted between spaces as if they were colours.

use eframe::egui::Ui;

use super::chart::Chart;
use super::dots::{Dots, DotsRow};
use super::row::{self, Row};
use super::{delta_e_text, sentence, told};
use crate::gui::command::Action;
use crate::gui::demonstrations::{Choice, ShownConversion, ShownConversions, Slot};
use crate::gui::state::State;
use crate::gui::theme;
use crate::metal::preferred_metals;
use crate::study::{ConvertedParameters, Parameters, conversion_spread};

/// Shows one material.
pub(super) fn show(ui: &mut Ui, state: &mut State) {
    let open = crate::gui::demonstrations::Open { preset: &state.document.preset, metal: state.view.metal };
    let result = state.demonstrations.conversion(ui.ctx(), open);
    let Some(shown) = told(ui, result, None) else { return };
    sentence(ui, &shown.study.summary(), &shown.study.losses);
    strips(ui, shown);
    let values = Parameters::ALL.map(|p| shown.study.results[p as usize].delta_e.clone());
    let height = ui.available_height() - CHART_WORDS;
    let name_of = |share: f64| format!("{:.0}°", 90.0 * share);
    let ticks = row::degree_ticks();
    let caption = "ΔE2000 by the conversion alone";
    Chart { caption, values, ticks: &ticks, cursor: None, name_of: &name_of }.show(ui, height);
}

/// Height of the words above and below a chart.
const CHART_WORDS: f32 = 56.0;

fn strips(ui: &mut Ui, shown: &ShownConversion) {
    row::caption(ui, "Above: the appearance that should be kept. Below: what the converted parameters show");
    let ink = ui.visuals().text_color();
    let height = theme::BAND_HEIGHT;
    Row { name: "truth", colour: ink, bands: &[&shown.truth], height, is_stepped: false, numbers: &[] }.show(ui);
    for (result, [wanted, got]) in shown.study.results.iter().zip(&shown.pairs) {
        let parameters = result.parameters();
        let (colour, bands) = (row::ink(ui, parameters), [wanted, got]);
        let (name, numbers) = (parameters.label(), numbers(result));
        Row { name, colour, bands: &bands, height, is_stepped: false, numbers: &numbers }.show(ui);
    }
    row::ticks(ui, &row::degree_ticks());
}

fn numbers(result: &ConvertedParameters) -> Vec<String> {
    let left = match result.left_domain {
        0 => "all in their domain".to_owned(),
        1 => "1 left its domain".to_owned(),
        count => format!("{count} left their domain"),
    };
    vec![
        format!("{} max ΔE", delta_e_text(result.error.max_delta_e)),
        format!("{} there and back", delta_e_text(result.there_and_back_delta_e)),
        left,
    ]
}

/// Shows all metals as a distribution.
pub(super) fn show_all(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    let progress = state.demonstrations.progress();
    let result = state.demonstrations.conversions(ui.ctx());
    let Some(ShownConversions { sentence: seen, rows }) = told(ui, result, progress) else { return };
    sentence(ui, seen, &[]);
    let spread = conversion_spread(rows);
    let row = |parameters: Parameters| DotsRow {
        name: parameters.label(),
        colour: row::ink(ui, parameters),
        values: rows
            .iter()
            .filter(|row| row.parameters == parameters)
            .map(|row| (row.material.as_str(), row.mean_delta_e))
            .collect(),
        spread: &spread[parameters as usize],
    };
    let rows = Parameters::ALL.map(row);
    let caption = "Mean ΔE2000 over 0–90° to the converted appearance; each dot is a metal, the stroke the median";
    let clicked = Dots { caption, rows: &rows }.show(ui, ui.available_height() - theme::TICKS);
    let metal = clicked.and_then(|name| preferred_metals().find(|metal| metal.name == name));
    if let Some(metal) = metal {
        actions.push(Action::Demonstrate(Slot::First, Choice::Metal(metal)));
    }
}
