//! The square of r and h, and the preset in it.

use eframe::egui::{Grid, Label, RichText, Ui, Vec2};

use super::{sentence, square};
use crate::fresnel::{feasible_h, reflectance_range};
use crate::gui::state::State;
use crate::gui::theme::{self, Palette};
use crate::gui::widgets::{NumberField, channel_names};
use crate::preset::Preset;

/// Shows the square and the fields beside it.
pub(super) fn show(ui: &mut Ui, state: &mut State) {
    let space = state.document.space();
    let preset = &mut state.document.preset;
    let Some(shown) = state.demonstrations.square(ui.ctx(), space).filter(|shown| shown.space == space) else {
        ui.label(theme::hint("Measuring every metal"));
        return;
    };
    sentence(ui, &format!("{} {}", shown.sentence, of_preset(preset)), &[]);
    let beside = theme::READ_OUT_WIDTH + theme::GROUP_GAP;
    let side = (ui.available_width() - beside).min(ui.available_height() - theme::TICKS).max(240.0);
    let before = (preset.r, preset.h);
    ui.horizontal_top(|ui| {
        square::show(ui, side, shown, preset);
        ui.add_space(theme::GROUP_GAP);
        ui.vertical(|ui| {
            ui.set_width(theme::READ_OUT_WIDTH);
            fields(ui, preset);
        });
    });
    if (preset.r, preset.h) != before {
        preset.mark_edited();
    }
}

/// Where the preset's own curve goes.
fn of_preset(preset: &Preset) -> String {
    let ranges = [0, 1, 2].map(|channel| reflectance_range(preset.r[channel], preset.h[channel]));
    let low = ranges.iter().map(|range| *range.start()).fold(f64::INFINITY, f64::min);
    let high = ranges.iter().map(|range| *range.end()).fold(f64::NEG_INFINITY, f64::max);
    const TOLERANCE: f64 = 1e-9;
    let is_inside = low >= -TOLERANCE && high <= 1.0 + TOLERANCE;
    let verdict = if is_inside { "stays inside" } else { "leaves the region" };
    format!("{} {verdict}: it reflects between {low:.3} and {high:.3} over all angles.", preset.name)
}

/// r and h of each channel as numbers, with the h that stay within 0–1.
fn fields(ui: &mut Ui, preset: &mut Preset) {
    ui.label(theme::title("The preset"));
    let space = preset.space.label();
    let palette = Palette::of(ui);
    Grid::new("square").num_columns(4).spacing([theme::GROUP_GAP, theme::GAP]).show(ui, |ui| {
        for heading in ["", "r", "h", "h within 0–1"] {
            ui.label(theme::hint(heading));
        }
        ui.end_row();
        for (channel, name) in channel_names().into_iter().enumerate() {
            ui.label(RichText::new(name).color(palette.channels[channel]));
            let mut number = |value: &mut f64, symbol: &str| {
                NumberField::new(value, format!("{symbol} {name} of the preset, linear {space}")).width(72.0).show(ui);
            };
            number(&mut preset.r.0[channel], "r");
            number(&mut preset.h.0[channel], "h");
            ui.label(theme::number(range_text(preset.r[channel])));
            ui.end_row();
        }
    });
    ui.label(theme::hint(space));
    ui.add_space(theme::GROUP_GAP);
    ui.label(theme::title("How to read it"));
    key(ui, square::feasible_fill(ui), "0 ≤ F ≤ 1 at every angle");
    key(ui, square::reachable_fill(ui), "what real n and k reach");
    for text in [
        "Dots are the channels of measured metals: point at one for its name. The dotted line is Schlick's curve.",
        "Drag a cross, or select it and press the arrow keys (with Shift for large steps). Channels that lie on each \
         other move together; hold Alt to move one alone.",
    ] {
        ui.add(Label::new(theme::hint(text)).wrap());
    }
}

fn range_text(r: f64) -> String {
    feasible_h(r).map_or_else(|| "none".to_owned(), |h| format!("{:.3}–{:.3}", h.start(), h.end()))
}

fn key(ui: &mut Ui, fill: eframe::egui::Color32, text: &str) {
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(Vec2::new(22.0, 14.0), eframe::egui::Sense::hover());
        ui.painter().rect(rect, 0, fill, ui.visuals().window_stroke(), eframe::egui::StrokeKind::Outside);
        ui.label(theme::hint(text));
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;

    #[test]
    fn says_whether_the_preset_is_a_reflectance() {
        let preset = Preset::new_authored();
        assert_eq!(of_preset(&preset), "New metal stays inside: it reflects between 0.600 and 1.000 over all angles.");
        let beyond = Preset { h: Rgb([0.9, 1.0, 0.8]), ..preset };
        assert!(of_preset(&beyond).contains("leaves the region"), "{}", of_preset(&beyond));
        assert_eq!(range_text(1.05), "none");
    }
}
