//! One parameter moved while the other is held.

use eframe::egui::{Rect, Slider, StrokeKind, Ui, WidgetInfo, accesskit::Role, pos2};

use super::{delta_e_text, row, sentence, told};
use crate::gui::demonstrations::{Open, ShownDecoupling, SweepBands};
use crate::gui::state::State;
use crate::gui::theme;
use crate::gui::widgets::row_label;
use crate::study::{Parameters, Swept};

/// How far a parameter can be moved.
const AMOUNTS: std::ops::RangeInclusive<f64> = 0.01..=0.5;
/// Room for a number and a word right of a sweep.
const NUMBERS: f32 = 92.0;
const GAP_OF_ROWS: f32 = 16.0;
/// Width of a grey edge.
const SWATCH: f32 = 64.0;
/// Height of the words above the columns.
const CAPTIONS: f32 = 22.0;
/// Height of a band where there is room.
const TALLEST: f32 = 56.0;

/// Shows the sweeps and the grey edges.
pub(super) fn show(ui: &mut Ui, state: &mut State) {
    let open = Open { preset: &state.document.preset, metal: state.view.metal };
    let page = &mut state.demonstrations;
    let mut amount = page.amount;
    let result = page.decoupling(ui.ctx(), open);
    let Some(shown) = told(ui, result, None) else { return };
    sentence(ui, &shown.study.summary(), &shown.notes);
    ui.horizontal(|ui| {
        let label = row_label(ui, "Moved by");
        ui.spacing_mut().slider_width = theme::DIALOG_WIDTH;
        let slider = Slider::new(&mut amount, AMOUNTS).max_decimals(3);
        let what = "How far r and the edge parameter fall; for n and k, the share of the value";
        ui.add(slider).labelled_by(label.id).on_hover_text(what);
    });
    ui.add_space(theme::GROUP_GAP);
    let place = Places::of(ui);
    captions(ui, place);
    for parameters in Parameters::ALL {
        description(ui, place, shown, parameters);
    }
    page.amount = amount;
}

/// Left ends of the three columns, the width of a sweep and the height of a band.
#[derive(Clone, Copy)]
struct Places {
    columns: [f32; 3],
    sweep: f32,
    band: f32,
}

impl Places {
    fn of(ui: &Ui) -> Self {
        let row = (ui.available_height() - CAPTIONS) / Parameters::ALL.len() as f32 - GAP_OF_ROWS - theme::GAP;
        let band = (row / 2.0).clamp(theme::BAND_HEIGHT, TALLEST);
        let room = ui.available_width() - theme::BAND_NAMES - 3.0 * NUMBERS - SWATCH;
        let sweep = (room / 2.0).max(60.0);
        let first = theme::BAND_NAMES;
        Self { columns: [first, first + sweep + NUMBERS, first + 2.0 * (sweep + NUMBERS)], sweep, band }
    }
}

fn captions(ui: &mut Ui, places: Places) {
    let (rect, _) =
        ui.allocate_exact_size(eframe::egui::vec2(ui.available_width(), 16.0), eframe::egui::Sense::hover());
    let texts = [
        "r (or n) falls, the edge parameter is held",
        "The edge parameter falls, r (or n) is held",
        "Grey edge parameter",
    ];
    for (x, text) in places.columns.into_iter().zip(texts) {
        let at = pos2(rect.left() + x, rect.center().y);
        let colour = ui.visuals().weak_text_color();
        ui.painter().text(at, eframe::egui::Align2::LEFT_CENTER, text, row::small(ui), colour);
    }
}

fn description(ui: &mut Ui, places: Places, shown: &ShownDecoupling, parameters: Parameters) {
    let size = eframe::egui::vec2(ui.available_width(), 2.0 * places.band);
    let (rect, response) = ui.allocate_exact_size(size, eframe::egui::Sense::hover());
    let at = |column: usize, width: f32| {
        let left = rect.left() + places.columns[column];
        Rect::from_x_y_ranges(left..=left + width, rect.y_range())
    };
    let study = &shown.study;
    let [first, edge] = &shown.sweeps[parameters as usize];
    let mut spoken = Vec::new();
    for (column, swept, bands) in [(0, Swept::First, first), (1, Swept::Edge, edge)] {
        let moved = study.sweep(parameters, swept).map_or([f64::NAN; 2], |sweep| sweep.moved());
        spoken.push(sweep(ui, at(column, places.sweep), bands, moved));
    }
    let grey = at(2, SWATCH);
    ui.painter().rect_filled(grey, 0, shown.greys.colours[parameters as usize]);
    ui.painter().rect_stroke(grey, 0, ui.visuals().window_stroke(), StrokeKind::Outside);
    let off = delta_e_text(study.cross_talk[parameters as usize].delta_e_from_grey);
    row::numbers(ui, grey, &[off.clone(), "off grey".to_owned()]);
    row::name(ui, at(0, places.sweep), parameters.label(), row::ink(ui, parameters));
    let [symbol, edge_symbol] = parameters.symbols();
    let text = format!(
        "{}: {symbol} moved: {}; {edge_symbol} moved: {}; grey {edge_symbol}: {off} off grey",
        parameters.label(),
        spoken[0],
        spoken[1]
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &text));
    ui.add_space(GAP_OF_ROWS - theme::GAP);
}

/// The facing colour above the edge colour, with how far each moved; gives that in words.
fn sweep(ui: &Ui, rect: Rect, bands: &SweepBands, moved: [f64; 2]) -> String {
    let mut spoken = Vec::new();
    for (index, (band, (moved, name))) in bands.iter().zip(moved.into_iter().zip(["facing", "edge"])).enumerate() {
        let height = rect.height() / 2.0;
        let top = rect.top() + height * index as f32;
        let half = Rect::from_x_y_ranges(rect.x_range(), top..=top + height);
        row::paint(ui, half, band, true);
        let words = format!("{} {name}", delta_e_text(moved));
        row::numbers(ui, half, std::slice::from_ref(&words));
        spoken.push(words);
    }
    ui.painter().rect_stroke(rect, 0, ui.visuals().window_stroke(), StrokeKind::Outside);
    spoken.join(", ")
}
