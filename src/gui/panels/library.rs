//! The library: a folder of presets with thumbnails, searched by names and tags.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::egui::{
    Align, Button, CentralPanel, Frame, Image, Key, Label, Layout, Margin, Panel, Response, RichText, ScrollArea,
    Sense, TextEdit, Ui, UiBuilder, Vec2,
};

use crate::gui::command::{Action, Command};
use crate::gui::library::LibraryPage;
use crate::gui::state::State;
use crate::gui::theme::{self, Palette};
use crate::gui::thumbnails::Key as ThumbnailKey;
use crate::gui::widgets::swatch;
use crate::preset::{Item, Shelved};

/// Shows the page.
pub(crate) fn show(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    let page = &mut state.library;
    page.follow(ui.ctx());
    let side = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(theme::MARGIN, 10));
    Panel::left("library tags").frame(side).resizable(false).exact_size(theme::LIBRARY_WIDTH).show(ui, |ui| {
        folder(ui, page, actions);
        ui.add_space(theme::GROUP_GAP);
        tags(ui, page);
    });
    CentralPanel::no_frame().frame(side).show(ui, |ui| {
        let open = state.document.file().map(Path::to_owned);
        list(ui, &mut state.library, open.as_deref(), actions);
    });
}

fn folder(ui: &mut Ui, page: &mut LibraryPage, actions: &mut Vec<Action>) {
    ui.label(theme::title("Folder of presets"));
    ui.horizontal(|ui| {
        let field = TextEdit::singleline(&mut page.path).desired_width(ui.available_width() - 64.0);
        let field = ui.add(field.hint_text("/path/to/folder")).accessible_name("Path of a folder of presets");
        let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let is_chosen = ui.button("Show").on_hover_text("Show the presets of this folder").clicked();
        if (is_entered || is_chosen) && !page.path.trim().is_empty() {
            actions.push(Action::OpenLibrary(PathBuf::from(page.path.trim())));
        }
    });
    let choose = ui.button(Command::OpenLibrary.label()).on_hover_text(Command::OpenLibrary.tooltip());
    if choose.clicked() {
        actions.push(Command::OpenLibrary.into());
    }
}

/// Each tag with how many presets have it; a click searches for it, or no longer.
fn tags(ui: &mut Ui, page: &mut LibraryPage) {
    let tags = page.tags().to_vec();
    if tags.is_empty() {
        return;
    }
    ui.label(theme::title("Tags"));
    ScrollArea::vertical().id_salt("tags").auto_shrink(false).show_rows(ui, theme::ROW, tags.len(), |ui, rows| {
        for (tag, count) in &tags[rows] {
            let is_chosen = page.chosen_tag.as_ref() == Some(tag);
            let button = Button::selectable(is_chosen, tag).right_text(theme::hint(count.to_string()));
            let button = ui.add(button.min_size(Vec2::new(ui.available_width(), theme::ROW)).truncate());
            if button.accessible_name(format!("Tag: {tag}")).clicked() {
                page.chosen_tag = (!is_chosen).then(|| tag.clone());
            }
        }
    });
}

fn list(ui: &mut Ui, page: &mut LibraryPage, open: Option<&Path>, actions: &mut Vec<Action>) {
    let search = TextEdit::singleline(&mut page.search).desired_width(f32::INFINITY);
    ui.add(search.hint_text("Search names, tags and notes")).accessible_name("Search presets");
    let found = page.found();
    summary(ui, page, found.len());
    ui.add_space(theme::GAP);
    let size = (theme::THUMBNAIL * ui.pixels_per_point()).round() as u32;
    let mut in_sight = Vec::new();
    ScrollArea::vertical().id_salt("presets").auto_shrink(false).show_rows(
        ui,
        theme::THUMBNAIL,
        found.len(),
        |ui, rows| {
            in_sight = keys(&found, rows.clone(), size);
            for item in &found[rows] {
                if row(ui, page, item, size, open == Some(&item.path)).clicked() {
                    actions.push(Action::Load(item.path.clone()));
                }
            }
        },
    );
    page.thumbnails.want(ui.ctx(), &in_sight);
}

fn keys(found: &[Arc<Item>], rows: Range<usize>, size: u32) -> Vec<ThumbnailKey> {
    let presets = found[rows].iter().filter_map(|item| item.preset.as_ref().ok());
    presets.map(|preset| ThumbnailKey::of(preset, size)).collect()
}

fn summary(ui: &mut Ui, page: &LibraryPage, found: usize) {
    if let Some(error) = page.error() {
        ui.label(RichText::new(error).color(Palette::of(ui).error));
        return;
    }
    let text = match (page.folder(), page.is_reading()) {
        (None, _) => "Open a folder to see the presets in it and in the folders inside it".to_owned(),
        (Some(_), true) => "Reading the folder…".to_owned(),
        (Some(_), false) => format!("{found} of {} files", page.shelf().items().len()),
    };
    ui.label(theme::hint(text));
}

/// A preset or a file that is none, as one thing to click.
fn row(ui: &mut Ui, page: &LibraryPage, item: &Item, size: u32, is_open: bool) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), theme::THUMBNAIL), Sense::click());
    let visuals = ui.style().interact_selectable(&response, is_open);
    if is_open || response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, theme::ROUNDING, visuals.weak_bg_fill);
    }
    let layout = Layout::left_to_right(Align::Center);
    let mut inside = ui.new_child(UiBuilder::new().max_rect(rect.shrink2(Vec2::new(theme::GAP, 2.0))).layout(layout));
    match &item.preset {
        Ok(preset) => preset_row(&mut inside, page, item, preset, size),
        Err(reason) => {
            inside.add_space(theme::THUMBNAIL);
            inside.add(Label::new(RichText::new(reason).small().color(Palette::of(ui).error)).truncate());
        }
    }
    let name = item.preset.as_ref().map_or_else(|_| item.path.display().to_string(), |preset| preset.name.clone());
    response.on_hover_text(item.path.display().to_string()).accessible_name(format!("Open {name}"))
}

fn preset_row(ui: &mut Ui, page: &LibraryPage, item: &Item, preset: &Shelved, size: u32) {
    let side = Vec2::splat(theme::THUMBNAIL - 4.0);
    match page.thumbnails.get(&ThumbnailKey::of(preset, size)) {
        Some(texture) => _ = ui.add(Image::new((texture.id(), side)).alt_text(format!("sphere: {}", preset.name))),
        None => _ = ui.allocate_exact_size(side, Sense::hover()),
    }
    ui.add_space(theme::GAP);
    for colour in [preset.r, preset.h] {
        swatch(ui, colour, preset.space, Vec2::splat(20.0));
    }
    ui.add_space(theme::GAP);
    ui.vertical(|ui| {
        ui.add_space(5.0);
        ui.add(Label::new(theme::title(&preset.name)).truncate());
        let file = page.folder().and_then(|folder| item.path.strip_prefix(folder).ok()).unwrap_or(&item.path);
        let mut words = vec![preset.origin.to_owned(), preset.space.label().to_owned(), file.display().to_string()];
        if !preset.tags.is_empty() {
            words.insert(0, preset.tags.join(", "));
        }
        ui.add(Label::new(theme::hint(words.join("  ·  "))).truncate());
    });
}
