//! Every mark with its numbers, and buttons for those that are missing.

use eframe::egui::{Align, Button, Label, Layout, Response, RichText, Ui, Vec2};

use super::references::{card_fields, grey_fields, lead, light_row, metal_row, pair_angle};
use crate::gui::command::Action;
use crate::gui::photograph::{Mark, MarkShape, Need, Session};
use crate::gui::theme::{self, Palette};
use crate::gui::widgets::NumberField;
use crate::photo::{Circle, Cylinder, LightMode, MatchRequest};

pub(super) fn show(ui: &mut Ui, session: &mut Session, actions: &mut Vec<Action>) {
    ui.label(theme::title("Marks")).on_hover_text("Drag them on the photograph, or type their numbers, in pixels");
    for mark in Mark::all_of(&session.request) {
        // A mark may have been taken away by the row before it.
        if mark.shape(&session.request).is_some() {
            mark_row(ui, session, mark);
            below(ui, session, mark, actions);
        }
    }
    light_row(ui, session);
    ui.horizontal_wrapped(|ui| {
        let (close, far) = offers(session);
        for need in close {
            add_button(ui, session, need);
        }
        if !far.is_empty() {
            ui.menu_button("More marks", |ui| {
                for need in far {
                    add_button(ui, session, need);
                }
            });
        }
    });
}

/// What can still be marked: first what the mode reads, then the rest. What the mode lacks is offered beside it.
fn offers(session: &Session) -> (Vec<Need>, Vec<Need>) {
    let request = &session.request;
    let all = [
        Need::Mark(Mark::Ball),
        Need::Mark(Mark::Cylinder),
        Need::Mark(Mark::Reference),
        Need::Mark(Mark::Card(request.cards.len())),
        Need::Mark(Mark::Direct(request.mirrors.len())),
        Need::Mark(Mark::GreyScale),
        Need::Mark(Mark::Facing),
        Need::Mark(Mark::Edge),
        Need::Mark(Mark::Backdrop),
        Need::Light,
    ];
    let missing = session.missing();
    let is_open = |need: &Need| !is_there(*need, request) && !missing.contains(need);
    // Of a ball and a cylinder one is measured: the other would take its place.
    let is_instead = |need: &Need| matches!(need, Need::Mark(mark) if mark.is_body()) && request.body().is_some();
    all.into_iter().filter(is_open).partition(|need| is_read(request.mode, *need) && !is_instead(need))
}

fn is_there(need: Need, request: &MatchRequest) -> bool {
    match need {
        Need::Mark(Mark::GreyScale) => !request.greys.is_empty(),
        Need::Mark(mark) => mark.shape(request).is_some(),
        Need::Light => request.light.is_some(),
    }
}

/// True for what a mode makes use of.
fn is_read(mode: LightMode, need: Need) -> bool {
    let Need::Mark(mark) = need else { return matches!(mode, LightMode::ByEye | LightMode::SolvedLight) };
    match mark {
        Mark::GreyScale => true,
        Mark::Ball | Mark::Cylinder | Mark::Edge => mode != LightMode::FlatMirror,
        Mark::Facing => !matches!(mode, LightMode::FlatMirror | LightMode::Backdrop),
        Mark::Reference => mode == LightMode::ReferenceBall,
        Mark::Card(_) => mode == LightMode::Card,
        Mark::Direct(_) | Mark::Mirrored(_) => mode == LightMode::FlatMirror,
        Mark::Backdrop => mode == LightMode::Backdrop,
    }
}

/// A button that places what is not there yet.
pub(super) fn add_button(ui: &mut Ui, session: &mut Session, need: Need) {
    let name = need.name();
    let button = ui.button(format!("+ {name}")).on_hover_text(need.purpose());
    if button.accessible_name(format!("Mark: {name}")).clicked() {
        match need {
            Need::Mark(mark) => session.add(mark),
            Need::Light => session.set_light(Some(crate::color::Rgb::WHITE)),
        }
    }
}

/// What looking for the ball does.
const FIND_PURPOSE: &str = "Look for the roundest outline in the whole picture, beside the reference ball";

/// A button that looks for the ball everywhere.
pub(super) fn find_button(ui: &mut Ui, session: &mut Session) {
    let button = ui.add_enabled(!session.is_outlining(), Button::new("Find the ball"));
    if button.on_hover_text(FIND_PURPOSE).clicked() {
        session.find_ball();
    }
}

/// Why the ball was not found, if it was looked for last.
pub(super) fn found_nowhere(ui: &mut Ui, session: &Session) {
    if let Some(error) = session.found_nowhere() {
        warning_line(ui, sentence(&error.to_string()));
    }
}

fn warning_line(ui: &mut Ui, words: String) {
    ui.add(Label::new(RichText::new(words).small().color(Palette::of(ui).warning)).wrap());
}

fn mark_row(ui: &mut Ui, session: &mut Session, mark: Mark) {
    let Some(shape) = mark.shape(&session.request) else { return };
    let name = mark.name(&session.request);
    ui.horizontal(|ui| {
        let label = Button::selectable(session.selected == Some(mark), &name).right_text("");
        let label = label.min_size(Vec2::new(theme::MARK_WIDTH, theme::ROW));
        let label = ui.add(label).on_hover_text(format!("{}. Select it; arrow keys then move it", mark.purpose()));
        if label.accessible_name(format!("Select {name}")).clicked() {
            (session.selected, session.placing) = (Some(mark), None);
        }
        if let Some(changed) = shape_fields(ui, shape, &name) {
            mark.set(&mut session.request, changed);
            session.placing = None;
        }
        match mark {
            Mark::Card(index) => card_fields(ui, &mut session.request.cards[index], &name),
            Mark::Direct(index) => pair_angle(ui, &mut session.request.mirrors[index], &name),
            _ => {}
        }
        if !matches!(mark, Mark::Mirrored(_)) {
            remove_button(ui, session, mark, &name);
        }
    });
}

fn remove_button(ui: &mut Ui, session: &mut Session, mark: Mark, name: &str) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let button = ui.small_button("×").on_hover_text("Take it away");
        if button.accessible_name(format!("Remove {name}")).clicked() {
            session.remove(mark);
        }
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
        MarkShape::Quad(_) => None,
        // The other end has a row of its own.
        MarkShape::Rod(Cylinder { mut x0, mut y0, x1, y1, mut radius }) => {
            let changed = [field(&mut x0, "start x"), field(&mut y0, "start y"), field(&mut radius, "radius")];
            changed.contains(&true).then(|| MarkShape::Rod(Cylinder::new([x0, y0], [x1, y1], radius.max(1.0))))
        }
    }
}

/// The other end of a cylinder's axis.
fn end_row(ui: &mut Ui, session: &mut Session) {
    let Some(Cylinder { x0, y0, mut x1, mut y1, radius }) = session.request.cylinder else { return };
    let name = Mark::Cylinder.kind();
    let changed = ui.horizontal(|ui| {
        lead(ui, "other end");
        let mut field = |value: &mut f64, what: &str| {
            NumberField::new(value, format!("{name} {what}, pixels")).precision(1, 0.25).width(48.0).show(ui).changed()
        };
        [field(&mut x1, "end x"), field(&mut y1, "end y")].contains(&true)
    });
    // Both ends in one place would leave the axis without a direction.
    if changed.inner && (x1 - x0).hypot(y1 - y0) >= 1.0 {
        Mark::Cylinder.set(&mut session.request, MarkShape::Rod(Cylinder::new([x0, y0], [x1, y1], radius)));
        session.placing = None;
    }
}

/// What belongs to a mark beside its place: how well its outline is known, its metal, its reflectances.
fn below(ui: &mut Ui, session: &mut Session, mark: Mark, actions: &mut Vec<Action>) {
    match mark {
        Mark::Ball => outline_row(ui, session, mark),
        Mark::Cylinder => {
            end_row(ui, session);
            outline_row(ui, session, mark);
        }
        Mark::Reference => {
            metal_row(ui, session, actions);
            outline_row(ui, session, mark);
        }
        Mark::Card(index) => {
            let name = mark.name(&session.request);
            if let Some(card) = session.request.cards.get_mut(index) {
                super::references::colour_row(ui, card, &name);
            }
        }
        Mark::GreyScale => grey_fields(ui, session),
        _ => {}
    }
}

/// How well an outline is known, and buttons that find it.
fn outline_row(ui: &mut Ui, session: &mut Session, mark: Mark) {
    if mark.shape(&session.request).is_none() {
        return;
    }
    ui.horizontal(|ui| {
        ui.add_space(ui.spacing().button_padding.x);
        ui.label(theme::hint(outline_words(session, mark)));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if mark == Mark::Ball {
                let button = small(ui, session, "Find", FIND_PURPOSE);
                if button.accessible_name("Find the ball").clicked() {
                    session.find_ball();
                }
            }
            let purpose = if mark == Mark::Cylinder {
                "Fit the two lines to the edges nearest to them"
            } else {
                "Fit the circle to the edge of the ball nearest to it"
            };
            let button = small(ui, session, "Snap to the edge", purpose);
            if button.accessible_name(format!("Snap to the edge: {}", mark.kind())).clicked() {
                session.snap(mark);
            }
        });
    });
    if let Some(warning) = outline_warning(session, mark) {
        warning_line(ui, warning);
    }
    if mark == Mark::Ball {
        found_nowhere(ui, session);
    }
}

/// A small button that cannot be pressed while an edge is looked for.
fn small(ui: &mut Ui, session: &Session, words: &str, purpose: &str) -> Response {
    ui.add_enabled(!session.is_outlining(), Button::new(words).small()).on_hover_text(purpose)
}

/// How well the radius is known, about 95 %, and from what.
fn outline_words(session: &Session, mark: Mark) -> String {
    if session.is_outlining() {
        return "Looking for the edge".to_owned();
    }
    if let Some(Ok(outline)) = session.found_outline(mark) {
        let (plus_minus_px, share) = (2.0 * outline.uncertainty_px(), 100.0 * outline.support());
        return format!("± {plus_minus_px:.2} px, on {share:.0} % of the edge");
    }
    let is_fitted = mark.is_body() && session.request.circle_uncertainty_px.is_some();
    let how = if is_fitted { "by the edge" } else { "by hand" };
    let hand_px = MatchRequest::HAND_PLACED_UNCERTAINTY_PX;
    let uncertainty = if is_fitted { session.request.radius_uncertainty_px() } else { hand_px };
    format!("± {:.2} px, {how}", 2.0 * uncertainty)
}

/// Why there is no edge, or why it is no ball or no cylinder.
fn outline_warning(session: &Session, mark: Mark) -> Option<String> {
    match session.found_outline(mark)? {
        Ok(outline) => outline.warning().map(|warning| warning.message),
        Err(error) => Some(sentence(&error.to_string())),
    }
}

/// A message as a sentence of its own.
fn sentence(message: &str) -> String {
    let mut letters = message.chars();
    let first = letters.next().map(|letter| letter.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}

/// Takes the light by eye away.
pub(super) fn remove_light(ui: &mut Ui, session: &mut Session) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let button = ui.small_button("×").on_hover_text("Take it away");
        if button.accessible_name("Remove Light").clicked() {
            session.set_light(None);
        }
    });
}
