//! What was solved from the marks, as numbers and sentences.

use eframe::egui::{Align, ComboBox, Grid, Label, Layout, RichText, Ui};

use super::photograph::form_row;
use crate::color::{Rgb, RgbSpace, delta_e_rgb};
use crate::gui::photograph::{Matching, Session, Source};
use crate::gui::theme::{self, Palette};
use crate::photo::{LightMode, Match, Warning};

/// Shows the match of a photograph.
pub(crate) fn show(ui: &mut Ui, session: &mut Session, space: RgbSpace) {
    ui.horizontal(|ui| {
        ui.label(theme::title("Match"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.checkbox(&mut session.is_followed, "The preset follows")
                .on_hover_text("Write r and h into the preset whenever marks move");
        });
    });
    mode(ui, session);
    match session.matching() {
        Matching::NotMarked => {
            ui.add(Label::new(theme::hint("Mark the ball, and a card of known reflectance.")).wrap());
        }
        Matching::Working => {
            ui.label(theme::hint("Solving"));
        }
        Matching::Failed(sentence) => {
            ui.add(Label::new(RichText::new(sentence).small().color(Palette::of(ui).error)).wrap());
        }
        Matching::Solved(found) => {
            numbers(ui, found, space);
            truth(ui, session, found, space);
            warnings(ui, &found.warnings);
        }
    }
}

/// Where the light comes from.
fn mode(ui: &mut Ui, session: &mut Session) {
    form_row(ui, "Light from", |ui| {
        let mode = &mut session.request.mode;
        ComboBox::from_id_salt("mode")
            .width(ui.available_width())
            .selected_text(format!("{}  {}", mode.letter(), mode.label()))
            .show_ui(ui, |ui| {
                for choice in [LightMode::Card, LightMode::Backdrop, LightMode::SolvedLight] {
                    let words = format!("{}  {}", choice.letter(), choice.label());
                    ui.selectable_value(mode, choice, words).on_hover_text(choice.explanation());
                }
            })
            .response
            .on_hover_text(mode.explanation())
            .accessible_name("Where the light comes from");
    });
}

fn numbers(ui: &mut Ui, found: &Match, space: RgbSpace) {
    let palette = Palette::of(ui);
    Grid::new("match").num_columns(4).spacing([theme::GROUP_GAP, 2.0]).show(ui, |ui| {
        let rows = [("r", found.r, found.r_uncertainty), ("h", found.h, found.h_uncertainty)];
        for (symbol, values, uncertainties) in rows {
            ui.label(RichText::new(symbol).heading());
            for channel in 0..3 {
                let words = match (values[channel], uncertainties[channel]) {
                    (Some(value), Some(uncertainty)) => format!("{value:.3} ± {uncertainty:.3}"),
                    (Some(value), None) => format!("{value:.3}"),
                    (None, _) => "not measured".to_owned(),
                };
                ui.label(theme::number(words).color(palette.channels[channel]));
            }
            ui.end_row();
        }
    });
    let kind = if found.is_estimate { "An estimate" } else { "Measured" };
    let colour = if found.is_estimate { palette.warning } else { palette.good };
    ui.horizontal(|ui| {
        ui.label(RichText::new(kind).small().color(colour));
        ui.label(theme::hint(format!("from {} pixels, in {}", found.pixels, space.label())));
    });
}

/// How far a sample's match is from what it was rendered with.
fn truth(ui: &mut Ui, session: &Session, found: &Match, space: RgbSpace) {
    let Source::Sample(sample) = session.source else { return };
    let truth = &sample.facts.truth;
    let differs = |found: Option<Rgb>, true_colour: Rgb| {
        let difference = delta_e_rgb(found?, truth.space.convert(true_colour, space), space);
        Some(format!("{difference:.2}"))
    };
    let words = |difference: Option<String>| difference.unwrap_or_else(|| "not measured".to_owned());
    let r = words(differs(found.complete_r(), truth.r));
    let h = words(differs(found.complete_h(), truth.h));
    ui.label(theme::hint(format!("ΔE to what it was rendered with: r {r}, h {h}")));
}

fn warnings(ui: &mut Ui, warnings: &[Warning]) {
    let palette = Palette::of(ui);
    for warning in warnings {
        ui.horizontal_top(|ui| {
            ui.label(RichText::new("▲").small().color(palette.warning));
            ui.add(Label::new(RichText::new(&warning.message).small()).wrap());
        });
    }
}
