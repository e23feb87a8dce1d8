//! The sphere of the preset, of the truth, and the map of their difference.

use eframe::egui::{
    Align, Align2, Color32, ComboBox, CornerRadius, Image, Label, Layout, Rect, Sense, StrokeKind, TextStyle,
    TextureHandle, Ui, Vec2,
};

use crate::gui::drawn::Difference;
use crate::gui::panels::preview;
use crate::gui::spheres::Wanted;
use crate::gui::state::State;
use crate::gui::theme;
use crate::render::{Light, false_colour};

/// Height of the row above the spheres.
const ABOVE: f32 = theme::ROW + theme::GAP;
/// Height of the captions and of what is said of the quality, below them.
const BELOW: f32 = 14.0 + theme::STANDING + 2.0 * theme::GAP;
/// Smaller spheres show nothing.
const LEAST_SPHERE: f32 = 48.0;

/// Height of the whole panel where it is so wide.
pub(crate) fn height(width: f32) -> f32 {
    side(width) + ABOVE + BELOW + 2.0 * theme::GAP
}

/// Three beside each other.
fn side(width: f32) -> f32 {
    theme::SPHERE.min((width - 2.0 * theme::GROUP_GAP) / 3.0)
}

/// Shows the previews.
pub(crate) fn show(ui: &mut Ui, state: &mut State) {
    let size = side(ui.available_width()).min(ui.available_height() - ABOVE - BELOW).max(LEAST_SPHERE).floor();
    let wanted = Wanted {
        model: state.document.preset.model(),
        space: state.document.space(),
        roughness: state.document.preset.roughness,
        metal: state.view.metal,
        light: state.view.light,
        size: (size * ui.pixels_per_point()).round().max(8.0) as u32,
    };
    state.spheres.want(ui.ctx(), wanted, state.view.preview_ms);
    // What it says is of the spheres that are shown below it.
    header(ui, state);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = theme::GROUP_GAP;
        let Some(shown) = state.spheres.shown() else {
            ui.allocate_exact_size(Vec2::splat(size), Sense::hover());
            return;
        };
        picture(ui, &shown.preset, size, "preset");
        if let (Some((truth, map, difference)), Some(metal)) = (&shown.truth, state.view.metal) {
            picture(ui, truth, size, &format!("truth, {}", metal.name));
            ui.vertical(|ui| {
                ui.add(Image::new((map.id(), Vec2::splat(size))).alt_text("map of the colour difference"));
                scale(ui, size, *difference);
            });
        }
    });
    preview::standing(ui, &state.spheres, state.view.preview_ms);
}

fn header(ui: &mut Ui, state: &mut State) {
    ui.horizontal(|ui| {
        ui.label(theme::title("Sphere"));
        light_chooser(ui, &mut state.view.light);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            preview::menu(ui, &mut state.spheres, &mut state.view.preview_ms);
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                if let Some(words) = state.spheres.difference_words() {
                    ui.add(Label::new(theme::hint(format!("preset to truth: {words}"))).truncate());
                }
            });
        });
    });
}

/// The lights to choose from.
pub(crate) fn light_chooser(ui: &mut Ui, light: &mut Light) {
    ComboBox::from_id_salt("light")
        .selected_text(light.label())
        .show_ui(ui, |ui| {
            for choice in Light::ALL {
                ui.selectable_value(light, choice, choice.label());
            }
        })
        .response
        .on_hover_text("The light around the sphere")
        .accessible_name("Light around the sphere");
}

fn picture(ui: &mut Ui, texture: &TextureHandle, size: f32, caption: &str) {
    ui.vertical(|ui| {
        ui.add(Image::new((texture.id(), Vec2::splat(size))).alt_text(format!("sphere: {caption}")));
        ui.add_sized([size, 14.0], Label::new(theme::hint(caption)).truncate());
    });
}

/// The colours of the map from 0 to its full scale, with both ends named.
pub(crate) fn scale(ui: &mut Ui, width: f32, difference: Difference) {
    let (row, _) = ui.allocate_exact_size(Vec2::new(width, 14.0), Sense::hover());
    let bar = Rect::from_center_size(row.center(), Vec2::new(width * 0.5, 6.0));
    const STEPS: u8 = 32;
    for step in 0..STEPS {
        let share = |step: u8| f32::from(step) / f32::from(STEPS);
        let [red, green, blue] = false_colour(f64::from(share(step)));
        let x = bar.left() + bar.width() * share(step)..=bar.left() + bar.width() * share(step + 1);
        let cell = Rect::from_x_y_ranges(x, bar.y_range());
        ui.painter().rect_filled(cell, CornerRadius::ZERO, Color32::from_rgb(red, green, blue));
    }
    ui.painter().rect_stroke(bar, 0, ui.visuals().window_stroke(), StrokeKind::Outside);
    let font = TextStyle::Small.resolve(ui.style());
    let (colour, gap) = (ui.visuals().weak_text_color(), theme::GAP);
    let painter = ui.painter();
    painter.text(bar.left_center() - Vec2::new(gap, 0.0), Align2::RIGHT_CENTER, "ΔE 0", font.clone(), colour);
    let end = format!("{:.0}", difference.full_scale);
    painter.text(bar.right_center() + Vec2::new(gap, 0.0), Align2::LEFT_CENTER, end, font, colour);
}
