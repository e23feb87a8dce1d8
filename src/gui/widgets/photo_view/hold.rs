//! What a drag takes hold of, and what it does to a mark.

use eframe::egui::{CursorIcon, EventFilter, Key, Modifiers, Pos2, Response, Ui};

use super::placement::{Frame, Placement, pan};
use crate::gui::photograph::{Mark, MarkShape, Session};
use crate::gui::theme;

/// What a drag took hold of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hold {
    /// A mark as a whole.
    Move(Mark),
    /// One of its grips.
    Resize(Mark, usize),
    /// A mark that is drawn anew, from a point of the photograph.
    Draw(Mark, [f64; 2]),
    /// The picture.
    Pan,
}

impl Hold {
    fn mark(self) -> Option<Mark> {
        match self {
            Self::Move(mark) | Self::Resize(mark, _) | Self::Draw(mark, _) => Some(mark),
            Self::Pan => None,
        }
    }
}

/// The cursor over what could be held.
pub(super) fn cursor(session: &Session, hold: Option<Hold>) -> CursorIcon {
    match hold {
        Some(Hold::Draw(..)) => CursorIcon::Crosshair,
        _ if session.placing.is_some() => CursorIcon::Crosshair,
        Some(Hold::Move(_)) => CursorIcon::Move,
        Some(Hold::Resize(..)) => CursorIcon::Crosshair,
        Some(Hold::Pan) => CursorIcon::Grab,
        None => CursorIcon::Default,
    }
}

/// What a press here takes hold of: a grip before a mark, and of several marks the one drawn last.
pub(super) fn find_hold(session: &Session, placement: Placement, at: Pos2) -> Option<Hold> {
    if let Some(mark) = session.placing {
        return Some(Hold::Draw(mark, placement.pixel(at)));
    }
    let marks = Mark::all_of(&session.request);
    let shapes = || marks.iter().rev().filter_map(|mark| Some((*mark, mark.shape(&session.request)?)));
    let grip_at = |shape: MarkShape| {
        let distance = |grip: &[f64; 2]| placement.screen(*grip).distance(at);
        shape.grips().iter().position(|grip| distance(grip) < theme::GRIP_REACH)
    };
    let by_grip = shapes().find_map(|(mark, shape)| Some(Hold::Resize(mark, grip_at(shape)?)));
    let inside = || shapes().find(|(_, shape)| shape.contains(placement.pixel(at))).map(|(mark, _)| Hold::Move(mark));
    by_grip.or_else(inside).or((session.zoom > 1.0).then_some(Hold::Pan))
}

/// Does what the pointer does to the marks; returns what it holds.
pub(super) fn drag(
    ui: &Ui,
    session: &mut Session,
    frame: Frame,
    placement: Placement,
    response: &Response,
) -> Option<Hold> {
    let id = response.id.with("hold");
    if response.drag_started() {
        let origin = ui.input(|input| input.pointer.press_origin())?;
        let hold = find_hold(session, placement, origin).unwrap_or(Hold::Pan);
        session.before_drag = Some(session.request.clone());
        response.request_focus();
        ui.data_mut(|data| data.insert_temp(id, hold));
    }
    if response.clicked() {
        click(session, placement, response.interact_pointer_pos()?);
        response.request_focus();
    }
    // Esc ends the drag before this sees it; what was dragged goes back.
    if ui.input(|input| input.key_pressed(Key::Escape))
        && let Some(before) = session.before_drag.take()
    {
        session.request = before;
        session.placing = None;
        ui.data_mut(|data| data.remove::<Hold>(id));
        return None;
    }
    let hold = ui.data(|data| data.get_temp::<Hold>(id));
    if response.drag_stopped()
        && let Some(Hold::Draw(mark, _)) = hold
    {
        placed(session, mark);
    }
    if !response.dragged() {
        session.before_drag = None;
        ui.data_mut(|data| data.remove::<Hold>(id));
        return None;
    }
    let hold = hold?;
    apply(session, frame, placement, hold, response);
    session.selected = hold.mark().or(session.selected);
    Some(hold)
}

fn apply(session: &mut Session, frame: Frame, placement: Placement, hold: Hold, response: &Response) {
    let Some(pointer) = response.interact_pointer_pos() else { return };
    let to = placement.pixel(pointer);
    match hold {
        Hold::Pan => pan(session, frame, placement, response.drag_delta()),
        Hold::Move(mark) => {
            let shift = response.total_drag_delta().unwrap_or_default() / placement.scale;
            if let Some(before) = session.before_drag.as_ref().and_then(|request| mark.shape(request)) {
                mark.set(&mut session.request, before.moved(f64::from(shift.x), f64::from(shift.y)));
            }
        }
        Hold::Resize(mark, grip) => change(session, mark, |shape| shape.resized(grip, to)),
        Hold::Draw(mark, from) => change(session, mark, |shape| shape.drawn(from, to)),
    }
}

/// A click selects a mark, or puts the one that is being placed there.
fn click(session: &mut Session, placement: Placement, pointer: Pos2) {
    let Some(mark) = session.placing else {
        session.selected = find_hold(session, placement, pointer).and_then(Hold::mark);
        return;
    };
    let [x, y] = placement.pixel(pointer);
    change(session, mark, |shape| {
        let [cx, cy] = shape.centre();
        shape.moved(x - cx, y - cy)
    });
    placed(session, mark);
}

/// A mark is where it was wanted: a ball snaps to its edge, and a card's mirror image comes next.
fn placed(session: &mut Session, mark: Mark) {
    session.placing = match mark {
        Mark::Direct(index) => Some(Mark::Mirrored(index)),
        _ => None,
    };
    if mark.is_outline() {
        session.snap(mark);
    }
}

pub(super) fn change(session: &mut Session, mark: Mark, to: impl FnOnce(MarkShape) -> MarkShape) {
    if let Some(shape) = mark.shape(&session.request) {
        mark.set(&mut session.request, to(shape));
    }
}

/// Arrows move the selected mark by a pixel, with Shift by ten; Delete takes it away; Esc gives up placing one.
pub(super) fn keys(ui: &Ui, session: &mut Session, response: &Response) {
    if session.placing.is_some() && ui.input(|input| input.key_pressed(Key::Escape)) {
        session.placing = None;
    }
    if !response.has_focus() {
        return;
    }
    let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, escape: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let take = |modifiers, key| ui.input_mut(|input| input.consume_key(modifiers, key));
    let Some(mark) = session.selected else { return };
    let arrows = [
        (Key::ArrowLeft, -1.0, 0.0),
        (Key::ArrowRight, 1.0, 0.0),
        (Key::ArrowUp, 0.0, -1.0),
        (Key::ArrowDown, 0.0, 1.0),
    ];
    for (key, dx, dy) in arrows {
        for (modifiers, step) in [(Modifiers::SHIFT, 10.0), (Modifiers::NONE, 1.0)] {
            if take(modifiers, key) {
                session.placing = None;
                change(session, mark, |shape| shape.moved(dx * step, dy * step));
            }
        }
    }
    if take(Modifiers::NONE, Key::Delete) {
        session.remove(mark);
    }
}
