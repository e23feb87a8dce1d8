//! The photograph: opening it, looking at it, marking it.

use std::path::PathBuf;

use eframe::egui::{Align, Button, Key, Label, Layout, ProgressBar, RichText, ScrollArea, Slider, TextEdit, Ui, Vec2};

use super::matching;
use crate::gui::command::{Action, Command};
use crate::gui::photograph::{Mark, MarkShape, Session, Source};
use crate::gui::state::State;
use crate::gui::theme::{self, Palette};
use crate::gui::widgets::{NumberField, photo_view, row_label};
use crate::photo::{Card, Circle};
use crate::sample::samples;

/// A photograph that is being read: its name and how far it is.
pub(crate) type Reading<'a> = Option<(&'a str, f32)>;

/// Shows the panel; `reading` is the photograph on its way.
pub(crate) fn show(ui: &mut Ui, state: &mut State, reading: Reading, actions: &mut Vec<Action>) {
    let space = state.document.space();
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        if let Some((name, progress)) = reading {
            reading_bar(ui, name, progress, actions);
        }
        match &mut state.photograph {
            None => empty(ui, &mut state.path, actions),
            Some(session) => {
                header(ui, session, actions);
                let point = photo_view(ui, session, Vec2::new(ui.available_width(), theme::PHOTO_HEIGHT));
                development(ui, session);
                under_pointer(ui, session, point);
                marks(ui, session);
                ui.add_space(theme::GAP);
                matching::show(ui, session, space);
            }
        }
    });
}

fn reading_bar(ui: &mut Ui, name: &str, progress: f32, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let width = ui.available_width() - 76.0;
        ui.add(ProgressBar::new(progress).desired_width(width).text(format!("Reading {name}")));
        if ui.button("Cancel").on_hover_text("Stop reading the photograph").clicked() {
            actions.push(Action::StopReading);
        }
    });
}

/// What to do where there is no photograph yet.
fn empty(ui: &mut Ui, path: &mut String, actions: &mut Vec<Action>) {
    ui.heading("Match a photograph");
    let words = "Open a photograph of a metal ball, mark the ball and what is white, and r and h are measured from it.";
    ui.add(Label::new(RichText::new(words).weak()).wrap());
    ui.add_space(theme::GAP);
    if ui.button("Open…").on_hover_text(Command::Open.tooltip()).accessible_name("Open a photograph…").clicked() {
        actions.push(Command::Open.into());
    }
    path_row(ui, path, actions);
    ui.label(theme::hint("Or drop a file on the window."));
    ui.add_space(theme::GROUP_GAP);
    ui.label(theme::title("Samples"));
    ui.label(theme::hint("Rendered from measured metals, with known r and h."));
    for sample in samples() {
        ui.add_space(theme::GAP);
        let button = Button::new(&sample.facts.title).min_size(Vec2::new(ui.available_width(), theme::ROW));
        if ui.add(button).on_hover_text("Open this sample").accessible_name(&sample.facts.title).clicked() {
            actions.push(Action::OpenSample(sample));
        }
        ui.add(Label::new(theme::hint(&sample.facts.description)).wrap());
    }
}

fn path_row(ui: &mut Ui, path: &mut String, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let width = ui.available_width() - 64.0;
        let field = TextEdit::singleline(path).desired_width(width).hint_text("Path of a photograph");
        let response = ui.add(field).accessible_name("Path of a photograph");
        let is_entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let is_chosen = ui.button("Open").on_hover_text("Open the path").accessible_name("Open the path").clicked();
        if (is_entered || is_chosen) && !path.trim().is_empty() {
            actions.push(Action::Load(PathBuf::from(path.trim())));
        }
    });
}

fn header(ui: &mut Ui, session: &Session, actions: &mut Vec<Action>) {
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

/// Exposure and false colour, for looking only.
fn development(ui: &mut Ui, session: &mut Session) {
    ui.horizontal(|ui| {
        let development = &mut session.development;
        let is_exposed = development.exposure_ev != 0.0;
        let words = RichText::new("View");
        ui.label(if is_exposed { words.color(Palette::of(ui).warning) } else { words.weak() })
            .on_hover_text("For looking only: what is measured stays as it is");
        ui.spacing_mut().slider_width = (ui.available_width() - 216.0).max(40.0);
        let slider = Slider::new(&mut development.exposure_ev, -6.0..=6.0).fixed_decimals(1).suffix(" EV");
        ui.add(slider).on_hover_text("Exposure of the view").accessible_name("Exposure of the view");
        if ui.add_enabled(is_exposed, Button::new("Reset")).accessible_name("Reset the exposure").clicked() {
            development.exposure_ev = 0.0;
        }
        ui.checkbox(&mut development.is_false_colour, "Alarms")
            .on_hover_text("Red is clipped, blue is too dark, cyan is negative, magenta is no number");
    });
}

/// The numbers of the pixel under the pointer, in a row that is always there.
fn under_pointer(ui: &mut Ui, session: &Session, point: Option<[f64; 2]>) {
    let pixel = point.and_then(|[x, y]| {
        let (column, row) = (x.floor(), y.floor());
        let pixel = session.photo.pixel(whole(column)?, whole(row)?)?;
        Some((column, row, pixel))
    });
    ui.horizontal(|ui| {
        ui.set_min_height(theme::ROW);
        let Some((column, row, pixel)) = pixel else {
            ui.label(theme::hint("The wheel enlarges, a double click shows all"));
            return;
        };
        ui.label(theme::number(format!("{column:.0},{row:.0}")).weak());
        ui.label(theme::number(pixel.rgb.0.map(|v| format!("{v:.4}")).join(" ")))
            .on_hover_text("linear sRGB (Rec.709)");
        if let Some(angle_deg) = session.request.circle.and_then(|ball| ball.angle_deg(column + 0.5, row + 0.5)) {
            ui.label(theme::number(format!("{angle_deg:.1}°")).weak());
        }
        let (words, colour) = if pixel.flags.is_clean() {
            ("linear sRGB".to_owned(), ui.visuals().weak_text_color())
        } else {
            (flag_words(&pixel.flags), Palette::of(ui).warning)
        };
        ui.add(Label::new(RichText::new(words).small().color(colour)).truncate());
    });
}

/// A column or row of the photograph; `None` left of it or above.
fn whole(position: f64) -> Option<u32> {
    (position >= 0.0).then_some(position as u32)
}

fn flag_words(flags: &crate::photo::PixelFlags) -> String {
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

/// Every mark with its numbers, and buttons for those that are missing.
fn marks(ui: &mut Ui, session: &mut Session) {
    ui.label(theme::title("Marks")).on_hover_text("Drag them on the photograph, or type their numbers");
    for mark in Mark::all_of(&session.request) {
        mark_row(ui, session, mark);
    }
    ui.horizontal_wrapped(|ui| {
        let next_card = Mark::Card(session.request.cards.len());
        let missing = [
            (Mark::Ball, "Ball", "The outline of the ball"),
            (next_card, "Card", "A card of known reflectance; several show how even the light is"),
            (Mark::Facing, "Facing pick", "Where r is read, instead of the middle of the ball"),
            (Mark::Edge, "Edge pick", "Where h is read, instead of the rim of the ball"),
            (Mark::Backdrop, "Backdrop", "An even bright area just outside the rim"),
        ];
        for (mark, name, what) in missing {
            if mark.shape(&session.request).is_none() {
                let button = ui.button(format!("+ {name}")).on_hover_text(what);
                if button.accessible_name(format!("Mark: {name}")).clicked() {
                    session.add(mark);
                }
            }
        }
    });
}

fn mark_row(ui: &mut Ui, session: &mut Session, mark: Mark) {
    let Some(shape) = mark.shape(&session.request) else { return };
    let name = mark.name(&session.request);
    ui.horizontal(|ui| {
        let is_selected = session.selected == Some(mark);
        let label =
            Button::selectable(is_selected, &name).right_text("").min_size(Vec2::new(theme::LABEL_WIDTH, theme::ROW));
        if ui.add(label).on_hover_text("Select it; arrow keys then move it").clicked() {
            session.selected = Some(mark);
        }
        if let Some(changed) = shape_fields(ui, shape, &name) {
            mark.set(&mut session.request, changed);
        }
        if let Mark::Card(index) = mark {
            card_field(ui, &mut session.request.cards[index], &name);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let button = ui.small_button("×").on_hover_text("Take it away");
            if button.accessible_name(format!("Remove {name}")).clicked() {
                session.remove(mark);
            }
        });
    });
}

fn shape_fields(ui: &mut Ui, shape: MarkShape, name: &str) -> Option<MarkShape> {
    let mut field = |value: &mut f64, what: &str| {
        NumberField::new(value, format!("{name} {what}, pixels")).precision(1, 0.25).width(48.0).show(ui).changed()
    };
    match shape {
        MarkShape::Round(Circle { mut x, mut y, mut radius }) => {
            let changed = [field(&mut x, "x"), field(&mut y, "y"), field(&mut radius, "radius")];
            changed.contains(&true).then(|| MarkShape::Round(Circle::new(x, y, radius.max(1.0))))
        }
        MarkShape::Square([mut x, mut y, width, height]) => {
            let changed = [field(&mut x, "x"), field(&mut y, "y")];
            changed.contains(&true).then_some(MarkShape::Square([x, y, width, height]))
        }
    }
}

fn card_field(ui: &mut Ui, card: &mut Card, name: &str) {
    let mut percent = card.reflectance * 100.0;
    let field = NumberField::new(&mut percent, format!("{name} reflectance, percent"));
    if field.precision(0, 0.25).range(1.0..=100.0).suffix(" %").width(48.0).show(ui).changed() {
        card.reflectance = percent / 100.0;
    }
}

/// Keeps the row of a form in one place for the panels beside this one.
pub(crate) fn form_row(ui: &mut Ui, words: &str, fields: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        row_label(ui, words);
        fields(ui);
    });
}
