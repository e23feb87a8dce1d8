//! A sphere by the truth of a metal and by a model of it: beside each other, wiped, and their difference.

use eframe::egui::{ComboBox, Grid, Image, Label, Rect, Sense, Slider, Stroke, TextureHandle, Ui, Vec2, pos2};

use super::{heading, saving};
use crate::figure::SphereLayout;
use crate::gui::command::Action;
use crate::gui::metals::{CONTESTANTS, MetalsPage};
use crate::gui::panels::preview;
use crate::gui::panels::spheres::{light_chooser, scale};
use crate::gui::sheet::{SPHERE_PIXELS, SheetKind};
use crate::gui::spheres::{Shown, Wanted};
use crate::gui::theme::{self, Palette};

/// Height of the words and numbers below each picture.
const CAPTION: f32 = 38.0;

/// Shows the spheres.
pub(crate) fn show(ui: &mut Ui, page: &mut MetalsPage, preview_ms: &mut f64, actions: &mut Vec<Action>) {
    heading(ui, page);
    controls(ui, page, preview_ms, actions);
    let (on_sphere, space) = (page.on_sphere, page.space);
    let model = page.curves(ui.ctx()).and_then(|curves| curves.fitted.iter().find(|f| f.contestant == on_sphere));
    let model = model.map(|fitted| fitted.model);
    let across = (ui.available_width() - theme::GROUP_GAP) / 2.0;
    let down = (ui.available_height() - theme::STANDING - theme::GAP - theme::GROUP_GAP) / 2.0 - CAPTION;
    let side = across.min(down).floor().max(64.0);
    if let Some(model) = model {
        let size = (side * ui.pixels_per_point()).round().max(8.0) as u32;
        let wanted = Wanted { model, space, roughness: 0.0, metal: Some(page.metal), light: page.light, size };
        page.spheres.want(ui.ctx(), wanted, *preview_ms);
    }
    preview::standing(ui, &page.spheres, *preview_ms);
    let MetalsPage { spheres, wipe, metal, .. } = page;
    let apart = spheres.difference_words().unwrap_or_default();
    let Some(shown) = spheres.shown() else {
        ui.label(theme::hint("Rendering"));
        return;
    };
    let name = CONTESTANTS[on_sphere].name;
    Grid::new("spheres").num_columns(2).spacing(Vec2::splat(theme::GROUP_GAP)).show(ui, |ui| {
        pictures(ui, shown, side, [&metal.name, name, &apart], wipe);
    });
}

/// Which model, under which light, and what can be saved.
fn controls(ui: &mut Ui, page: &mut MetalsPage, preview_ms: &mut f64, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.label(theme::hint("Model"));
        ComboBox::from_id_salt("model on the sphere")
            .selected_text(CONTESTANTS[page.on_sphere].name)
            .show_ui(ui, |ui| {
                for (index, contestant) in CONTESTANTS.iter().enumerate() {
                    let choice = ui.selectable_value(&mut page.on_sphere, index, contestant.name);
                    choice.on_hover_text(contestant.what);
                }
            })
            .response
            .on_hover_text(CONTESTANTS[page.on_sphere].what)
            .accessible_name("Model on the sphere");
        ui.label(theme::hint("Light"));
        light_chooser(ui, &mut page.light);
        preview::menu(ui, &mut page.spheres, preview_ms);
        let what = format!("A .png in sRGB, or a linear, unclipped .exr, {SPHERE_PIXELS} pixels a sphere");
        let kinds = [
            (SheetKind::Spheres(SphereLayout::Beside), "Truth beside model…"),
            (SheetKind::Spheres(SphereLayout::Wipe), "Wiped…"),
            (SheetKind::Spheres(SphereLayout::Difference), "Difference…"),
        ];
        saving(ui, &kinds, &what, actions);
    });
}

/// Truth and model above; both in one, and their difference, below.
fn pictures(ui: &mut Ui, shown: &Shown, side: f32, [metal, model, apart]: [&str; 3], wipe: &mut f32) {
    let Some((truth, map, difference)) = &shown.truth else { return };
    let caption = |ui: &mut Ui, words: String| ui.add_sized([side, 14.0], Label::new(theme::hint(words)).truncate());
    for (texture, what) in [(truth, format!("truth, {metal}")), (&shown.preset, format!("model, {model}"))] {
        ui.vertical(|ui| {
            ui.add(Image::new((texture.id(), Vec2::splat(side))).alt_text(format!("sphere: {what}")));
            caption(ui, what);
        });
    }
    ui.end_row();
    ui.vertical(|ui| {
        wiped(ui, [truth, &shown.preset], side, wipe);
        ui.spacing_mut().slider_width = side;
        let slider = Slider::new(wipe, 0.0..=1.0).show_value(false);
        ui.add(slider).on_hover_text("Truth left of the line, model right of it").accessible_name("Wipe");
    });
    ui.vertical(|ui| {
        ui.add(Image::new((map.id(), Vec2::splat(side))).alt_text("map of the colour difference"));
        scale(ui, side, *difference);
        caption(ui, apart.to_owned());
    });
    ui.end_row();
}

/// One sphere, left by the truth and right by the model, with the line between them; it follows the pointer.
fn wiped(ui: &mut Ui, [truth, model]: [&TextureHandle; 2], side: f32, wipe: &mut f32) {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(side), Sense::click_and_drag());
    if let Some(pointer) = response.interact_pointer_pos() {
        *wipe = ((pointer.x - rect.left()) / rect.width()).clamp(0.0, 1.0);
    }
    let edge = rect.left() + rect.width() * *wipe;
    let paint = |texture: &TextureHandle, x: std::ops::RangeInclusive<f32>, share: std::ops::RangeInclusive<f32>| {
        let part = Rect::from_x_y_ranges(x, rect.y_range());
        let uv = Rect::from_x_y_ranges(share, 0.0..=1.0);
        ui.painter().image(texture.id(), part, uv, eframe::egui::Color32::WHITE);
    };
    paint(truth, rect.left()..=edge, 0.0..=*wipe);
    paint(model, edge..=rect.right(), *wipe..=1.0);
    let guide = Palette::of(ui).guide;
    ui.painter().line_segment([pos2(edge, rect.top()), pos2(edge, rect.bottom())], Stroke::new(1.0, guide));
}
