//! Around the photograph: its name, ways to look at it, and the numbers under the pointer.

use eframe::egui::{Align, Button, Label, Layout, RichText, Slider, Ui};

use crate::gui::command::{Action, Command};
use crate::gui::photograph::{Looking, Mark, Session, Source};
use crate::gui::theme::{self, Palette};
use crate::photo::PixelFlags;

pub(super) fn header(ui: &mut Ui, session: &Session, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button("Close").on_hover_text("Close the photograph; r and h stay").clicked() {
                actions.push(Action::ClosePhotograph);
            }
            if ui.button("Open…").on_hover_text(Command::Open.tooltip()).clicked() {
                actions.push(Command::Open.into());
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                ui.add(Label::new(theme::title(session.source.name())).truncate()).on_hover_text(&session.photo.name);
            });
        });
    });
    let rule = session.photo.colour_rule.to_string();
    let (width, height) = (session.photo.width, session.photo.height);
    let kind = if matches!(session.source, Source::Sample(_)) { "rendered sample, " } else { "" };
    let words = format!("{kind}{width} × {height}. {rule}");
    ui.add(Label::new(theme::hint(&words)).truncate()).on_hover_text(words);
}

/// The photograph with its marks, or held against the match.
pub(super) fn looking(ui: &mut Ui, session: &mut Session) {
    ui.horizontal(|ui| {
        for choice in Looking::ALL {
            let button = Button::selectable(session.comparison.looking == choice, choice.label());
            let response = ui.add(button).on_hover_text(choice.explanation());
            if response.accessible_name(format!("Look at: {}", choice.label().to_lowercase())).clicked() {
                session.comparison.looking = choice;
                (session.zoom, session.pan, session.placing) = (1.0, eframe::egui::Vec2::ZERO, None);
            }
        }
    });
}

/// Exposure and false colour, for looking only.
pub(super) fn development(ui: &mut Ui, session: &mut Session) {
    ui.horizontal(|ui| {
        let development = &mut session.development;
        let is_exposed = development.exposure_ev != 0.0;
        let words = RichText::new(if is_exposed { "View exposed" } else { "View" });
        ui.label(if is_exposed { words.color(Palette::of(ui).warning) } else { words.weak() })
            .on_hover_text("For looking only: what is measured stays as it is");
        let rest = if is_exposed { 176.0 } else { 216.0 };
        ui.spacing_mut().slider_width = (ui.available_width() - rest).clamp(40.0, 240.0);
        let slider = Slider::new(&mut development.exposure_ev, -6.0..=6.0).fixed_decimals(1).suffix(" EV");
        ui.add(slider).on_hover_text("Exposure of the view").accessible_name("Exposure of the view");
        if ui.add_enabled(is_exposed, Button::new("Reset")).accessible_name("Reset the exposure").clicked() {
            development.exposure_ev = 0.0;
        }
        if session.comparison.looking == Looking::Photograph {
            ui.checkbox(&mut development.is_false_colour, "Alarms")
                .on_hover_text("Red is clipped, blue is too dark, cyan is negative, magenta is no number");
        }
    });
}

/// The numbers of the pixel under the pointer, in a row that is always there; without one, what can be done.
pub(super) fn under_pointer(ui: &mut Ui, session: &Session, point: Option<[f64; 2]>) {
    let pixel = point.and_then(|[x, y]| {
        let (column, row) = (x.floor(), y.floor());
        let pixel = session.photo.pixel(whole(column)?, whole(row)?)?;
        Some((column, row, pixel))
    });
    ui.horizontal(|ui| {
        ui.set_min_height(theme::ROW);
        if let Some(mark) = session.placing {
            let words = RichText::new(mark.how_to_draw()).small().color(Palette::of(ui).accent);
            ui.add(Label::new(words).truncate()).on_hover_text("Esc leaves the mark where it is");
            return;
        }
        let Some((column, row, pixel)) = pixel else {
            ui.add(Label::new(theme::hint(idle_words(session))).truncate());
            return;
        };
        ui.label(theme::number(format!("{column:.0},{row:.0}")).weak());
        ui.label(theme::number(pixel.rgb.0.map(|v| format!("{v:.4}")).join(" ")))
            .on_hover_text("linear sRGB (Rec.709)");
        if let Some(angle_deg) = session.request.body().and_then(|body| body.angle_deg(column + 0.5, row + 0.5)) {
            ui.label(theme::number(format!("{angle_deg:.1}°")).weak());
        }
        if let Some(delta_e) = difference_at(session, column + 0.5, row + 0.5) {
            ui.label(theme::number(format!("ΔE {delta_e:.2}")));
        }
        let (words, colour) = if pixel.flags.is_clean() {
            ("linear sRGB".to_owned(), ui.visuals().weak_text_color())
        } else {
            (flag_words(pixel.flags), Palette::of(ui).warning)
        };
        ui.add(Label::new(RichText::new(words).small().color(colour)).truncate());
    });
}

fn idle_words(session: &Session) -> &'static str {
    match (session.comparison.looking, session.selected) {
        (Looking::Wipe, _) => "Drag the handle, or move it with the arrow keys; the wheel enlarges",
        (Looking::Photograph, Some(Mark::GreyScale)) => "Drag the corners; the circles are what is read",
        (Looking::Photograph, Some(_)) => "Arrow keys move the mark, with Shift by ten pixels; Delete removes it",
        _ => "The wheel enlarges, a double click shows all",
    }
}

/// ΔE between photograph and match, where both are compared.
fn difference_at(session: &Session, x: f64, y: f64) -> Option<f32> {
    let Some(Ok(compared)) = session.comparison.shown() else { return None };
    let is_compared = session.comparison.looking != Looking::Photograph;
    let delta_e = compared.rendition.delta_e[compared.rendition.index_at(x, y)?];
    (is_compared && delta_e.is_finite()).then_some(delta_e)
}

/// A column or row of the photograph; `None` left of it or above.
fn whole(position: f64) -> Option<u32> {
    (position >= 0.0).then_some(position as u32)
}

fn flag_words(flags: PixelFlags) -> String {
    let names = ["red", "green", "blue"];
    let clipped: Vec<&str> = (0..3).filter(|&i| flags.clipped[i]).map(|i| names[i]).collect();
    let mut words = Vec::new();
    if !clipped.is_empty() {
        words.push(format!("clipped in {}", clipped.join(", ")));
    }
    if flags.black {
        words.push("too dark".to_owned());
    }
    if flags.non_finite {
        words.push("no number".to_owned());
    }
    words.join("; ")
}
