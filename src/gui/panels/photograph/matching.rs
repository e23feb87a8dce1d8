//! What was solved from the marks, as numbers and sentences.

use eframe::egui::{Align, Button, Grid, Label, Layout, RichText, Ui};

use crate::color::{Rgb, RgbSpace, delta_e_rgb};
use crate::gui::copying::CopyForm;
use crate::gui::photograph::{Matching, Session, Source};
use crate::gui::theme::{self, Palette};
use crate::photo::{Match, Warning};

/// Shows the match of a photograph.
pub(crate) fn show(ui: &mut Ui, session: &mut Session, space: RgbSpace) {
    ui.horizontal(|ui| {
        ui.label(theme::title("Match"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.checkbox(&mut session.is_followed, "The preset follows")
                .on_hover_text("Write r and h into the preset whenever marks move");
            if let Matching::Solved(found) = session.matching() {
                copy_menu(ui, found, space);
            }
        });
    });
    match session.matching() {
        Matching::NotMarked => {
            ui.add(Label::new(theme::hint("r and h appear when everything the mode needs is marked.")).wrap());
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

fn numbers(ui: &mut Ui, found: &Match, space: RgbSpace) {
    let palette = Palette::of(ui);
    Grid::new("match").num_columns(4).spacing([theme::MATCH_GAP, 2.0]).show(ui, |ui| {
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

/// Copies r and h as they were found, whatever the preset has become.
fn copy_menu(ui: &mut Ui, found: &Match, space: RgbSpace) {
    let colours = [("r", found.complete_r()), ("h", found.complete_h())];
    let menu = ui.menu_button("Copy", |ui| {
        for (symbol, colour) in colours {
            for form in CopyForm::ALL {
                let button = ui.add_enabled(colour.is_some(), Button::new(format!("{symbol}, {}", form.label(space))));
                if let Some(colour) = colour.filter(|_| button.clicked()) {
                    ui.ctx().copy_text(form.words(colour, space));
                }
            }
        }
    });
    menu.response.on_hover_text("Copy r or h as found").accessible_name("Copy what was found");
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
