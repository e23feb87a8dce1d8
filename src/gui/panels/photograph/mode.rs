//! Where the light comes from: six small drawings, a sentence, and what is still to be marked.

use eframe::egui::accesskit::Role;
use eframe::egui::{Align2, CornerRadius, Label, RichText, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo};

use super::marks::{add_button, find_button, found_nowhere};
use crate::gui::photograph::{Mark, Need, Session};
use crate::gui::theme::{self, Palette};
use crate::gui::widgets::mode_picture;
use crate::photo::LightMode;

/// Space between the drawings.
const TILE_GAP: f32 = 4.0;

pub(super) fn show(ui: &mut Ui, session: &mut Session) {
    ui.label(theme::title("Light from")).on_hover_text("How the light on the metal is known, best first");
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = TILE_GAP;
        let count = LightMode::ALL.len() as f32;
        let width = ((ui.available_width() - (count - 1.0) * TILE_GAP) / count).floor();
        for mode in LightMode::ALL {
            if tile(ui, session, mode, Vec2::new(width, theme::MODE_TILE)) {
                session.set_mode(mode);
            }
        }
    });
    let mode = session.request.mode;
    ui.label(RichText::new(name(mode)).strong());
    ui.add(Label::new(theme::hint(mode.explanation())).wrap());
    suggestion(ui, session);
    still_needs(ui, session);
}

/// The letter and the label of a mode.
fn name(mode: LightMode) -> String {
    format!("{}  {}", mode.letter(), mode.label())
}

/// One drawing; true when it was clicked.
fn tile(ui: &mut Ui, session: &Session, mode: LightMode, size: Vec2) -> bool {
    let is_chosen = session.request.mode == mode;
    let is_suggested = session.request.suggested_mode() == Some(mode);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let label = format!("Mode {}: {}", mode.letter(), mode.label().to_lowercase());
    response.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, is_chosen, &label));
    let style = ui.style().interact_selectable(&response, is_chosen);
    let palette = Palette::of(ui);
    let rounding = CornerRadius::same(theme::ROUNDING);
    ui.painter().rect_filled(
        rect,
        rounding,
        if is_chosen { ui.visuals().selection.bg_fill } else { style.weak_bg_fill },
    );
    let letter = TextStyle::Small.resolve(ui.style());
    let picture = rect.shrink2(Vec2::new(4.0, 3.0)).with_min_y(rect.top() + theme::MODE_LETTER);
    mode_picture(ui, ui.painter(), picture, mode);
    let corner = rect.left_top() + Vec2::new(4.0, 2.0);
    let colour = if is_chosen { ui.visuals().strong_text_color() } else { ui.visuals().text_color() };
    ui.painter().text(corner, Align2::LEFT_TOP, mode.letter(), letter, colour);
    if is_suggested && !is_chosen {
        ui.painter().circle_filled(rect.right_top() + Vec2::new(-6.0, 6.0), 2.5, palette.accent);
    }
    if response.has_focus() || is_chosen {
        ui.painter().rect_stroke(rect, rounding, Stroke::new(1.0, palette.accent), StrokeKind::Inside);
    }
    let suggested = if is_suggested { "\nThe best for what is marked." } else { "" };
    response.on_hover_text(format!("{}\n{}{suggested}", name(mode), mode.explanation())).clicked()
}

/// A better mode that the marks allow, or one that lacks nothing.
fn suggestion(ui: &mut Ui, session: &mut Session) {
    let Some(suggested) = session.request.suggested_mode().filter(|mode| *mode != session.request.mode) else {
        return;
    };
    ui.horizontal(|ui| {
        ui.label(theme::hint("Suggested by the marks:"));
        let button = ui.small_button(name(suggested)).on_hover_text(suggested.explanation());
        if button.accessible_name(format!("Take the suggested mode {}", suggested.letter())).clicked() {
            session.set_mode(suggested);
        }
    });
}

/// The marks that the mode lacks, each with a button that places it.
fn still_needs(ui: &mut Ui, session: &mut Session) {
    let missing = session.missing();
    if missing.is_empty() {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("Still needs").small().color(Palette::of(ui).warning));
        for need in &missing {
            add_button(ui, session, *need);
        }
        if missing.contains(&Need::Mark(Mark::Ball)) {
            find_button(ui, session);
        }
    });
    if missing.contains(&Need::Mark(Mark::Ball)) {
        found_nowhere(ui, session);
    }
}
