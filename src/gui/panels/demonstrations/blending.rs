//! Parameters blended between two materials.

use eframe::egui::{Image, Label, Sense, Stroke, Ui, Vec2};

use super::chart::Chart;
use super::row::{self, Row};
use super::{delta_e_text, sentence, told};
use crate::gui::demonstrations::{Open, ShownBlend};
use crate::gui::state::State;
use crate::gui::theme::{self, Palette};
use crate::gui::widgets::colour_slider;
use crate::study::Parameters;

/// Shows two materials.
pub(super) fn show(ui: &mut Ui, state: &mut State) {
    let open = Open { preset: &state.document.preset, metal: state.view.metal };
    let page = &mut state.demonstrations;
    let mut share = page.share;
    let result = page.blend(ui.ctx(), open);
    let Some(shown) = told(ui, result, None) else { return };
    sentence(ui, &shown.study.summary(), &shown.losses);
    slider(ui, shown, &mut share);
    strips(ui, shown, share);
    let values = Parameters::ALL
        .map(|p| shown.study.results[p as usize].own.iter().map(|error| error.max_delta_e).collect::<Vec<_>>());
    let ticks = row::share_ticks();
    let name_of = |share: f64| format!("{:.0} %", 100.0 * share);
    let caption = "Largest ΔE2000 over the angles, by blending alone";
    let chart = Chart { caption, values, ticks: &ticks, cursor: Some(share as f32), name_of: &name_of };
    let side = (ui.available_width() / 5.0 - theme::GROUP_GAP).clamp(60.0, theme::PAINTED_SPHERE).floor();
    chart.show(ui, ui.available_height() - side - BELOW);
    let names = [shown.study.a.clone(), shown.study.b.clone()];
    page.share = share;
    spheres(ui, state, &names, side);
}

/// Height of the words around the chart and the spheres.
const BELOW: f32 = 104.0;

/// A slider whose rail is the blended truth.
fn slider(ui: &mut Ui, shown: &ShownBlend, share: &mut f64) {
    ui.horizontal(|ui| {
        ui.add_space(theme::BAND_NAMES);
        let width = ui.available_width() - theme::BAND_NUMBERS;
        let name = format!("Share of {} in {}", shown.study.b, shown.study.a);
        colour_slider(ui, share, 0.0..=1.0, &name, width, |share| shown.truth.at(share))
            .on_hover_text("The truth, blended: drag to read what each description makes of it");
        ui.add_space(theme::GAP);
        ui.label(theme::number(format!("{:.0} %", 100.0 * *share)));
    });
}

fn strips(ui: &mut Ui, shown: &ShownBlend, share: f64) {
    let text = "Each at its worst angle. Above: blended reflectance. Below: blended parameters. ▼ the worst place";
    row::caption(ui, text);
    let here = shown.delta_e_at(share);
    for (result, [wanted, got]) in shown.study.results.iter().zip(&shown.pairs) {
        let (parameters, worst) = (result.parameters, result.worst);
        let numbers = [
            format!("{} max ΔE", delta_e_text(worst.delta_e)),
            if worst.delta_e < 1e-6 {
                "exact everywhere".to_owned()
            } else {
                format!("at {:.0} % and {:.0}°", 100.0 * worst.weight, worst.theta_deg)
            },
            format!("{} at the slider", delta_e_text(here[parameters as usize])),
        ];
        let colour = row::ink(ui, parameters);
        let bands = [wanted, got];
        let (name, height) = (parameters.label(), theme::BAND_HEIGHT - 1.0);
        let rect = Row { name, colour, bands: &bands, height, is_stepped: false, numbers: &numbers }.show(ui);
        let x = |share: f64| rect.left() + rect.width() * share as f32;
        ui.painter().vline(x(share), rect.y_range(), Stroke::new(1.0, Palette::of(ui).guide));
        if worst.delta_e > 1e-6 {
            let tip = eframe::egui::pos2(x(worst.weight), rect.top() - 0.5);
            row::pointer(ui.painter(), tip, ui.visuals().strong_text_color());
        }
    }
    row::ticks(ui, &row::share_ticks());
}

/// Texture filtering is blending: a soft brush on a sphere.
fn spheres(ui: &mut Ui, state: &mut State, [a, b]: &[String; 2], side: f32) {
    let open = Open { preset: &state.document.preset, metal: state.view.metal };
    let size = (side * ui.pixels_per_point()).round().max(8.0) as u32;
    ui.label(theme::hint(format!("A sphere of {a} with a soft spot of {b}, in white surroundings")));
    let names = std::iter::once("blended truth").chain(Parameters::ALL.map(Parameters::label));
    let textures = state.demonstrations.spheres(ui.ctx(), open, size);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = theme::GROUP_GAP;
        if textures.is_empty() {
            ui.allocate_exact_size(Vec2::splat(side), Sense::hover());
        }
        for (texture, name) in textures.iter().zip(names) {
            ui.vertical(|ui| {
                ui.add(Image::new((texture.id(), Vec2::splat(side))).alt_text(format!("painted sphere: {name}")));
                ui.add_sized([side, 14.0], Label::new(theme::hint(name)).truncate());
            });
        }
    });
}
