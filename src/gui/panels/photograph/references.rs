//! What is known of the marks: reflectances, metals, angles and the light.

use eframe::egui::{Align, Button, Label, Layout, Ui, Vec2};

use super::marks::remove_light;
use crate::color::{Rgb, RgbSpace};
use crate::gui::command::Action;
use crate::gui::photograph::{Mark, Session};
use crate::gui::theme;
use crate::gui::widgets::{NumberField, channel_names, swatch};
use crate::metal::metal_by_name;
use crate::photo::{Card, MirrorPair};

/// The reflectance of a card: typed, or one that people own, or that of a measured region.
pub(super) fn card_fields(ui: &mut Ui, card: &mut Card, name: &str) {
    if card.colour.is_none() {
        let mut percent = card.reflectance * 100.0;
        let field = NumberField::new(&mut percent, format!("{name} reflectance, percent"));
        if field.precision(1, 0.25).range(0.1..=100.0).suffix(" %").width(56.0).show(ui).changed() {
            card.reflectance = percent / 100.0;
        }
    }
    let menu = ui.menu_button("…", |ui| card_menu(ui, card));
    menu.response.on_hover_text("Cards people own, or a measured region").accessible_name(format!("{name} is"));
}

fn card_menu(ui: &mut Ui, card: &mut Card) {
    for (label, reflectance) in Card::COMMON {
        if ui.button(format!("{label}, {:.0} %", reflectance * 100.0)).clicked() {
            *card = Card::neutral(card.area, reflectance);
        }
    }
    ui.separator();
    let button = ui.button("Measured region").on_hover_text("Type the linear reflectance of each channel");
    if button.clicked() {
        *card = Card::coloured(card.area, card.colour.unwrap_or(Rgb::splat(card.reflectance)));
    }
}

/// The reflectance of each channel of a measured region.
pub(super) fn colour_row(ui: &mut Ui, card: &mut Card, name: &str) {
    let Some(mut colour) = card.colour else { return };
    ui.horizontal(|ui| {
        lead(ui, "linear Rec.709");
        for (channel, word) in channel_names().into_iter().enumerate() {
            let field = NumberField::new(&mut colour.0[channel], format!("{name} {word} reflectance, linear Rec.709"));
            field.precision(3, 0.002).range(0.001..=1.0).width(48.0).show(ui);
        }
    });
    if Some(colour) != card.colour {
        *card = Card::coloured(card.area, colour);
    }
}

/// The angle of incidence on the flat piece.
pub(super) fn pair_angle(ui: &mut Ui, pair: &mut MirrorPair, name: &str) {
    let field = NumberField::new(&mut pair.angle_deg, format!("{name} angle of incidence, degrees"));
    field.precision(1, 0.1).range(0.0..=89.9).suffix("°").width(56.0).show(ui);
}

/// Quiet words below the name of a mark, as wide as it.
pub(super) fn lead(ui: &mut Ui, words: &str) {
    let size = Vec2::new(theme::MARK_WIDTH, theme::ROW);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_size(size);
        ui.add_space(ui.spacing().button_padding.x);
        ui.label(theme::hint(words));
    });
}

/// Which metal the reference ball is of.
pub(super) fn metal_row(ui: &mut Ui, session: &Session, actions: &mut Vec<Action>) {
    let Some(ball) = &session.request.reference_ball else { return };
    let words = match metal_by_name(&ball.metal) {
        Ok(metal) => format!("{}, {}", metal.name, metal.provenance.citation()),
        Err(_) => ball.metal.clone(),
    };
    ui.horizontal(|ui| {
        lead(ui, "of metal");
        let button = ui.add(Button::new(&words).truncate());
        let button = button.on_hover_text(format!("{words}. Choose another metal of the library"));
        if button.accessible_name(format!("Metal of the reference ball: {words}")).clicked() {
            actions.push(Action::ChooseReferenceMetal);
        }
    });
}

/// The reflectances of the neutral patches, in the order of the row.
pub(super) fn grey_fields(ui: &mut Ui, session: &mut Session) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = theme::GAP / 2.0;
        let count = session.request.greys.len().max(1) as f32;
        let width = ((ui.available_width() - (count - 1.0) * theme::GAP / 2.0) / count).floor();
        for (index, grey) in session.request.greys.iter_mut().enumerate() {
            let mut percent = grey.reflectance * 100.0;
            let field = NumberField::new(&mut percent, format!("Grey patch {} reflectance, percent", index + 1));
            if field.precision(1, 0.1).range(0.1..=100.0).width(width).show(ui).changed() {
                grey.reflectance = percent / 100.0;
            }
        }
    });
    ui.horizontal(|ui| {
        ui.label(theme::hint("Reflectance in percent, in the order of the row"));
        let button = ui.small_button("Turn round").on_hover_text("The row begins with the darkest patch");
        if button.accessible_name("Turn the grey scale round").clicked() {
            turn_round(session);
        }
    });
}

/// Gives the first patch the reflectance of the last, and so on.
fn turn_round(session: &mut Session) {
    let reflectances: Vec<f64> = session.request.greys.iter().rev().map(|grey| grey.reflectance).collect();
    for (grey, reflectance) in session.request.greys.iter_mut().zip(reflectances) {
        grey.reflectance = reflectance;
    }
    session.selected = Some(Mark::GreyScale);
}

/// The light that a person sets: its channels, and all of them by stops.
pub(super) fn light_row(ui: &mut Ui, session: &mut Session) {
    let Some(mut light) = session.request.light else { return };
    ui.horizontal(|ui| {
        ui.add_sized(Vec2::new(40.0, theme::ROW), Label::new("Light"))
            .on_hover_text("The pixel that a perfect mirror would have, linear Rec.709");
        swatch(ui, light, RgbSpace::LinRec709, Vec2::splat(theme::ROW));
        for (channel, word) in channel_names().into_iter().enumerate() {
            let field = NumberField::new(&mut light.0[channel], format!("Light {word}, linear Rec.709"));
            field.precision(3, 0.002).range(0.001..=1000.0).width(50.0).show(ui);
        }
        let mut level_ev = light.max_channel().log2();
        let before_ev = level_ev;
        let field = NumberField::new(&mut level_ev, "Light level, stops over 1").precision(2, 0.01);
        if field.range(-9.0..=9.0).suffix(" EV").width(62.0).show(ui).changed() {
            light = light * (level_ev - before_ev).exp2();
        }
        remove_light(ui, session);
    });
    if session.request.light.is_some() {
        session.request.light = Some(light);
    }
    ui.label(theme::hint("linear Rec.709: what a perfect mirror would show"));
}
