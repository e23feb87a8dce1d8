//! One metal: its colours, its data sets and where they come from.

use eframe::egui::{Button, Grid, Label, RichText, ScrollArea, Ui, Vec2};

use crate::color::{Rgb, delta_e_rgb};
use crate::gui::command::Action;
use crate::gui::metals::MetalsPage;
use crate::gui::theme;
use crate::gui::truth::library_colours;
use crate::gui::widgets::swatch;
use crate::metal::{Metal, metals};

/// Shows the metal.
pub(crate) fn show(ui: &mut Ui, page: &mut MetalsPage, actions: &mut Vec<Action>) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let metal = page.metal;
        ui.horizontal(|ui| {
            ui.heading(&metal.name);
            ui.label(theme::hint(format!("{} {}", metal.symbol, metal.category)));
        });
        let author =
            Button::new("New preset from this metal").min_size(Vec2::new(ui.available_width(), theme::ROW + 4.0));
        if ui.add(author).on_hover_text("A preset with the exact r and h, and where they come from").clicked() {
            actions.push(Action::StartFrom(metal));
        }
        let compare =
            Button::new("Compare the preset with it").min_size(Vec2::new(ui.available_width(), theme::ROW + 4.0));
        if ui.add(compare).on_hover_text("Draw this truth beneath the preset").clicked() {
            actions.push(Action::CompareWith(metal));
        }
        ui.add_space(theme::GAP);
        colours(ui, page);
        ui.add_space(theme::GROUP_GAP);
        data_sets(ui, page);
        ui.add_space(theme::GROUP_GAP);
        provenance(ui, page.metal);
    });
}

fn colours(ui: &mut Ui, page: &MetalsPage) {
    let (metal, space) = (page.metal, page.space);
    for (symbol, what, colour) in [("r", "facing, 0°", metal.r(space)), ("h", "edge, 81.8°", metal.h(space))] {
        ui.horizontal(|ui| {
            swatch(ui, colour, space, Vec2::splat(36.0));
            ui.vertical(|ui| {
                ui.horizontal(|ui| {
                    ui.heading(symbol);
                    ui.label(theme::hint(what));
                });
                ui.label(theme::number(words(colour)));
            });
        });
    }
    ui.label(theme::hint(space.label()));
}

fn words(colour: Rgb) -> String {
    colour.0.map(|v| format!("{v:.4}")).join("  ")
}

/// Every data set of the same material, with how far it is from the one that stands for it.
fn data_sets(ui: &mut Ui, page: &mut MetalsPage) {
    let sets: Vec<(usize, &'static Metal)> =
        metals().iter().enumerate().filter(|(_, metal)| metal.name == page.metal.name).collect();
    let Some(&(preferred, _)) = sets.iter().find(|(_, metal)| metal.is_preferred).filter(|_| sets.len() > 1) else {
        return;
    };
    ui.label(theme::title("Data sets"));
    ui.label(theme::hint("Published measurements differ; ΔE of r and h to the preferred one"));
    let colours = library_colours(page.space);
    let (r, h) = colours[preferred];
    Grid::new("data sets").num_columns(4).spacing([8.0, 3.0]).show(ui, |ui| {
        for (index, metal) in sets {
            let name = format!("{}, {}", metal.dataset, metal.provenance.year);
            let button = Button::selectable(metal.id == page.metal.id, name)
                .right_text("")
                .min_size(Vec2::new(150.0, theme::ROW));
            let what = [metal.provenance.citation(), metal.not_measured.clone()];
            let what = what.into_iter().filter(|words| !words.is_empty()).collect::<Vec<_>>().join(", ");
            if ui.add(button.truncate()).on_hover_text(what).clicked() {
                page.metal = metal;
            }
            ui.horizontal(|ui| {
                swatch(ui, colours[index].0, page.space, Vec2::splat(16.0));
                swatch(ui, colours[index].1, page.space, Vec2::splat(16.0));
            });
            let differs =
                |theirs: Rgb, ours: Rgb| theme::number(format!("{:.1}", delta_e_rgb(theirs, ours, page.space)));
            ui.label(differs(colours[index].0, r));
            ui.label(differs(colours[index].1, h));
            ui.end_row();
        }
    });
    for metal in metals().iter().filter(|metal| metal.name == page.metal.name && !metal.is_measured()) {
        ui.add(Label::new(theme::hint(format!("{} is not measured: {}", metal.dataset, metal.not_measured))).wrap());
    }
}

fn provenance(ui: &mut Ui, metal: &Metal) {
    ui.label(theme::title("Where the data come from"));
    let source = &metal.provenance;
    let remarks = metal.remarks().join(" ");
    let address = if source.doi.is_empty() { source.url.clone() } else { format!("https://doi.org/{}", source.doi) };
    let range = if source.range_nm.is_empty() { String::new() } else { format!("{} nm", source.range_nm) };
    let rows = [
        ("Authors", &source.authors),
        ("Year", &source.year),
        ("Title", &source.title),
        ("Published", &source.reference),
        ("Range", &range),
        ("Remarks", &remarks),
        ("Notes", &source.comments),
        ("Licence", &source.licence),
    ];
    for (name, text) in rows.into_iter().filter(|(_, text)| !text.is_empty()) {
        ui.horizontal_top(|ui| {
            let size = Vec2::new(58.0, 14.0);
            ui.allocate_ui(size, |ui| {
                ui.set_min_width(size.x);
                ui.label(theme::hint(name));
            });
            ui.add(Label::new(RichText::new(text).small()).wrap());
        });
    }
    if !address.is_empty() {
        ui.hyperlink_to(RichText::new(&address).small(), &address);
    }
}
