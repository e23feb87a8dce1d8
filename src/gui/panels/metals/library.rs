//! The library of measured metals, and a person's own.

use std::path::PathBuf;

use eframe::egui::{Button, Key, ScrollArea, TextEdit, Ui, Vec2};

use crate::gui::command::Action;
use crate::gui::metals::MetalsPage;
use crate::gui::theme;
use crate::gui::truth::library_colours;
use crate::gui::widgets::swatch;
use crate::metal::{Metal, metals};

/// Shows the library.
pub(crate) fn show(ui: &mut Ui, page: &mut MetalsPage, actions: &mut Vec<Action>) {
    let search = TextEdit::singleline(&mut page.search).desired_width(f32::INFINITY).hint_text("Search metals");
    ui.add(search).accessible_name("Search metals");
    let shown = found(page);
    let height = ui.available_height() - OWN_FILES;
    ScrollArea::vertical().max_height(height).min_scrolled_height(height).auto_shrink(false).show_rows(
        ui,
        theme::ROW,
        shown.len(),
        |ui, rows| {
            for entry in &shown[rows] {
                row(ui, page, entry);
            }
        },
    );
    own_files(ui, page, actions);
}

/// Height of what stands below the list.
const OWN_FILES: f32 = 64.0;

struct Entry {
    metal: &'static Metal,
    /// Its place in the library; `None` for a person's own.
    index: Option<usize>,
    /// How many data sets the library has of it.
    data_sets: usize,
}

/// One data set of each material that matches the search, a person's own first.
fn found(page: &MetalsPage) -> Vec<Entry> {
    let typed = page.search.trim().to_lowercase();
    let matches = |metal: &Metal| {
        let words = format!("{} {} {} {}", metal.name, metal.symbol, metal.category, metal.provenance.authors);
        words.to_lowercase().contains(&typed)
    };
    let own = page.own.iter().map(|metal| Entry { metal, index: None, data_sets: 1 });
    let library = metals().iter().enumerate().filter(|(_, metal)| metal.is_preferred).map(|(index, metal)| {
        let data_sets = metals().iter().filter(|other| other.name == metal.name).count();
        Entry { metal, index: Some(index), data_sets }
    });
    own.chain(library).filter(|entry| matches(entry.metal)).collect()
}

fn row(ui: &mut Ui, page: &mut MetalsPage, entry: &Entry) {
    let metal = entry.metal;
    let (r, h) = match entry.index {
        Some(index) => library_colours(page.space)[index],
        None => (metal.r(page.space), metal.h(page.space)),
    };
    ui.horizontal(|ui| {
        swatch(ui, r, page.space, Vec2::splat(18.0));
        swatch(ui, h, page.space, Vec2::splat(18.0));
        let count = if entry.data_sets > 1 { entry.data_sets.to_string() } else { String::new() };
        let button = Button::selectable(page.metal.name == metal.name, &metal.name).right_text(theme::hint(count));
        let response = ui.add(button.min_size(Vec2::new(ui.available_width(), theme::ROW)).truncate());
        let sets = if entry.data_sets > 1 { format!(", {} data sets", entry.data_sets) } else { String::new() };
        let response = response.on_hover_text(format!("{} {}{sets}", metal.symbol, metal.category));
        if response.accessible_name(&metal.name).clicked() {
            page.metal = metal;
        }
    });
}

fn own_files(ui: &mut Ui, page: &mut MetalsPage, actions: &mut Vec<Action>) {
    ui.label(theme::hint("Your own n and k: CSV or refractiveindex.info YAML"));
    ui.horizontal(|ui| {
        let field = TextEdit::singleline(&mut page.path).desired_width(ui.available_width() - 58.0);
        let response = ui.add(field.hint_text("Path, or drop a file")).accessible_name("Path of a file of n and k");
        let is_entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let is_chosen = ui.button("Add").on_hover_text("Add the file to the library").clicked();
        if (is_entered || is_chosen) && !page.path.trim().is_empty() {
            actions.push(Action::AddMetal(PathBuf::from(page.path.trim())));
        }
    });
}
