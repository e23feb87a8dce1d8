//! The preset: its name, its two colours, and where they come from.

use eframe::egui::{ComboBox, Label, RichText, ScrollArea, Slider, TextEdit, TextStyle, Ui};

use crate::color::RgbSpace;
use crate::gui::command::Action;
use crate::gui::state::State;
use crate::gui::theme::{self, Palette};
use crate::gui::warnings::warnings;
use crate::gui::widgets::{ColourField, VALUE_WIDTH, row_label};
use crate::preset::{Origin, Preset};

/// Shows the inspector.
pub(crate) fn show(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let preset = &mut state.document.preset;
        name_and_space(ui, preset);
        ui.add_space(theme::GAP);
        colours(ui, preset);
        roughness(ui, preset);
        ui.add_space(theme::GAP);
        sentences(ui, state);
        ui.add_space(theme::GAP);
        origin(ui, &state.document.preset.origin);
        words(ui, &mut state.document.preset);
    });
    let _ = actions;
}

fn name_and_space(ui: &mut Ui, preset: &mut Preset) {
    let name = TextEdit::singleline(&mut preset.name).desired_width(f32::INFINITY).hint_text("Name");
    ui.add(name.font(TextStyle::Heading)).on_hover_text("The name of the preset").accessible_name("Name");
    ui.horizontal(|ui| {
        row_label(ui, "Space");
        let mut space = preset.space;
        ComboBox::from_id_salt("space")
            .width(ui.available_width())
            .selected_text(space.label())
            .show_ui(ui, |ui| {
                for choice in RgbSpace::ALL {
                    ui.selectable_value(&mut space, choice, choice.label());
                }
            })
            .response
            .on_hover_text("The space r and h are given in; changing it keeps the colours")
            .accessible_name("Space of the preset");
        if space != preset.space {
            *preset = preset.in_space(space);
        }
    });
}

fn colours(ui: &mut Ui, preset: &mut Preset) {
    let space = preset.space;
    let facing = ColourField { symbol: "r", title: "facing, 0°", colour: &mut preset.r, space }.show(ui);
    ui.add_space(theme::GROUP_GAP - theme::GAP);
    let edge = ColourField { symbol: "h", title: "edge, 81.8°", colour: &mut preset.h, space }.show(ui);
    if facing || edge {
        preset.mark_edited();
    }
}

fn roughness(ui: &mut Ui, preset: &mut Preset) {
    ui.add_space(theme::GROUP_GAP - theme::GAP);
    ui.horizontal(|ui| {
        let label = row_label(ui, "Roughness");
        ui.spacing_mut().slider_width = ui.available_width() - VALUE_WIDTH - theme::GAP;
        let slider = Slider::new(&mut preset.roughness, 0.0..=1.0).max_decimals(3);
        ui.add(slider).labelled_by(label.id).on_hover_text("Perceptual, 0 is a mirror; microfacet α is its square");
    });
}

/// Every warning, or that there is none.
fn sentences(ui: &mut Ui, state: &State) {
    let palette = Palette::of(ui);
    let warnings = warnings(state);
    if warnings.is_empty() {
        ui.label(RichText::new("Every channel stays within 0–1 at every angle.").small().color(palette.good));
    }
    for warning in warnings {
        ui.horizontal_top(|ui| {
            ui.label(RichText::new("▲").small().color(palette.warning));
            ui.add(Label::new(RichText::new(warning).small()).wrap());
        });
    }
}

fn origin(ui: &mut Ui, origin: &Origin) {
    ui.label(theme::title("Where it comes from"));
    ui.add(Label::new(RichText::new(origin_sentence(origin)).small()).wrap());
}

fn origin_sentence(origin: &Origin) -> String {
    match origin {
        Origin::Authored => "Set by hand.".to_owned(),
        Origin::Measured { metal, provenance } => {
            let citation = provenance.citation();
            let source = if citation.is_empty() { String::new() } else { format!(", {citation}") };
            format!("The measured truth of {metal}{source}. {}", provenance.reference)
        }
        Origin::Matched(recipe) => format!("Matched from the photograph {}.", recipe.photo),
        Origin::Edited { from } => format!("Changed by hand. Before that: {}", origin_sentence(from)),
    }
}

fn words(ui: &mut Ui, preset: &mut Preset) {
    ui.add_space(theme::GAP);
    let notes = TextEdit::multiline(&mut preset.notes).desired_rows(2).desired_width(f32::INFINITY);
    ui.add(notes.hint_text("Notes")).accessible_name("Notes");
    tags(ui, preset);
}

/// Tags as one line of words with commas; a change counts when the field is left.
fn tags(ui: &mut Ui, preset: &mut Preset) {
    let id = ui.scope_id().with("tags");
    let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| preset.tags.join(", "));
    let field = TextEdit::singleline(&mut text).desired_width(f32::INFINITY).hint_text("Tags, separated by commas");
    let response = ui.add(field).accessible_name("Tags");
    if response.lost_focus() {
        preset.tags = text.split(',').map(|tag| tag.trim().to_owned()).filter(|tag| !tag.is_empty()).collect();
    }
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text));
    } else {
        ui.data_mut(|data| data.remove::<String>(id));
    }
}
