//! The photograph against the rendered match: side by side, parted by a handle, or as their difference.

use eframe::egui::{
    Align2, Color32, CornerRadius, CursorIcon, EventFilter, Key, Modifiers, Painter, Pos2, Rect, Response, Sense,
    Stroke, StrokeKind, TextStyle, TextureId, Ui, Vec2, WidgetInfo, accesskit::Role, pos2, vec2,
};

use super::placement::{Frame, Placement, pan, zoom};
use crate::gui::photograph::{Compared, Looking, Matching, Scale, Session};
use crate::gui::theme::{self, Palette};
use crate::render::false_colour;

/// Shows the comparison; returns the point of the photograph under the pointer, in its pixels.
pub(super) fn show(ui: &mut Ui, session: &mut Session, size: Vec2) -> Option<[f64; 2]> {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let name = name(session);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &name));
    ui.painter().rect_filled(rect, 0, Palette::of(ui).canvas);
    let point = match why_not(session) {
        Some(sentence) => {
            message(ui, rect, &sentence);
            None
        }
        None => pictures(ui, session, rect, &response),
    };
    ui.painter().rect_stroke(rect, 0, ui.visuals().window_stroke(), StrokeKind::Outside);
    point
}

/// What is shown, with its numbers where it is the difference.
fn name(session: &Session) -> String {
    let name = format!("{}: {}", session.comparison.looking.explanation(), session.photo.name);
    match session.comparison.shown() {
        Some(Ok(compared)) if session.comparison.looking == Looking::Difference => {
            format!("{name}; {}", scale_words(compared.scale))
        }
        _ => name,
    }
}

fn scale_words(scale: Scale) -> String {
    format!("mean {:.2}, 95 % of the pixels below {:.2}", scale.mean, scale.most)
}

/// Why there is nothing to see yet.
fn why_not(session: &Session) -> Option<String> {
    match (session.matching(), session.comparison.shown()) {
        (Matching::NotMarked, _) => Some("There is no match yet: place the marks that the mode needs.".to_owned()),
        (Matching::Failed(_), _) => Some("There is no match to compare with.".to_owned()),
        (_, Some(Err(sentence))) => Some(sentence.to_owned()),
        (_, None) => Some("Rendering the match".to_owned()),
        (_, Some(Ok(_))) => None,
    }
}

fn message(ui: &Ui, rect: Rect, sentence: &str) {
    let (font, colour) = (TextStyle::Body.resolve(ui.style()), ui.visuals().weak_text_color());
    let galley = ui.painter().layout(sentence.to_owned(), font, colour, rect.width() - 4.0 * theme::GROUP_GAP);
    let place = Align2::CENTER_CENTER.anchor_size(rect.center(), galley.size());
    ui.painter().galley(place.min, galley, colour);
}

fn pictures(ui: &mut Ui, session: &mut Session, rect: Rect, response: &Response) -> Option<[f64; 2]> {
    let frame = frame(session)?;
    let halves = halves(session.comparison.looking, rect);
    let is_under = |half: &&Rect| response.hover_pos().is_some_and(|pointer| half.contains(pointer));
    zoom(ui, session, frame, *halves.iter().find(is_under).unwrap_or(&rect), response);
    let placements = halves.each_ref().map(|half| Placement::of(session, frame, *half));
    if response.dragged() && session.zoom > 1.0 {
        pan(session, frame, placements[0], response.drag_delta());
    }
    let picture = Rect::from_two_pos(screen(placements[0], frame, 0.0), screen(placements[0], frame, 1.0));
    let is_held = session.comparison.looking == Looking::Wipe && handle(ui, session, picture.intersect(rect), picture);
    let Some(Ok(compared)) = session.comparison.shown() else { return None };
    let painter = ui.painter_at(rect);
    let words = if session.request.greys.is_empty() { "photograph" } else { "photograph, through the grey scale" };
    match session.comparison.looking {
        Looking::Photograph => {}
        Looking::SideBySide => side_by_side(ui, compared, frame, halves, placements, words),
        Looking::Wipe => {
            wipe(ui, &painter, compared, picture, session.comparison.wipe, words);
            grip(ui, &painter, picture, session.comparison.wipe, is_held);
        }
        Looking::Difference => {
            image(&painter, compared.difference.id(), picture);
            scale(ui, &painter, rect, compared.scale);
        }
    }
    let pointer = response.hover_pos()?;
    let under = halves.iter().zip(placements).find(|(half, _)| half.contains(pointer));
    under.map(|(_, placement)| placement.pixel(pointer))
}

/// The part of the photograph that both pictures show.
fn frame(session: &Session) -> Option<Frame> {
    let Some(Ok(Compared { rendition, .. })) = session.comparison.shown() else { return None };
    let size = vec2(rendition.width as f32, rendition.height as f32) * rendition.step as f32;
    Some(Frame { origin: vec2(rendition.left as f32, rendition.top as f32), size })
}

/// Where the pictures go: two beside each other, or both in the same place.
fn halves(looking: Looking, rect: Rect) -> [Rect; 2] {
    if looking != Looking::SideBySide {
        return [rect; 2];
    }
    let (left, right) = rect.split_left_right_at_fraction(0.5);
    let gap = theme::GAP / 2.0;
    [left.with_max_x(left.right() - gap), right.with_min_x(right.left() + gap)]
}

/// A corner of the frame on the screen: 0 is the first, 1 the last.
fn screen(placement: Placement, frame: Frame, share: f32) -> Pos2 {
    let [x, y] = [0, 1].map(|axis| f64::from(frame.origin[axis] + frame.size[axis] * share));
    placement.screen([x, y])
}

fn image(painter: &Painter, texture: TextureId, rect: Rect) {
    painter.image(texture, rect, Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0)), Color32::WHITE);
}

fn side_by_side(
    ui: &Ui,
    compared: &Compared,
    frame: Frame,
    halves: [Rect; 2],
    placements: [Placement; 2],
    words: &str,
) {
    let pictures = [(&compared.photograph, words), (&compared.rendered, "rendered match")];
    for (((texture, words), half), placement) in pictures.into_iter().zip(halves).zip(placements) {
        let painter = ui.painter_at(half);
        let picture = Rect::from_two_pos(screen(placement, frame, 0.0), screen(placement, frame, 1.0));
        image(&painter, texture.id(), picture);
        caption(ui, &painter, picture.intersect(half).left_bottom(), Align2::LEFT_BOTTOM, words);
    }
}

fn wipe(ui: &Ui, painter: &Painter, compared: &Compared, picture: Rect, share: f32, words: &str) {
    let x = picture.left() + picture.width() * share;
    let clip = painter.clip_rect().intersect(picture);
    let (left, right) = (clip.with_max_x(x.max(clip.left())), clip.with_min_x(x.min(clip.right())));
    let sides = [
        (&compared.photograph, left, left.left_bottom(), Align2::LEFT_BOTTOM, words),
        (&compared.rendered, right, right.right_bottom(), Align2::RIGHT_BOTTOM, "rendered match"),
    ];
    for (texture, side, corner, align, words) in sides {
        let painter = painter.with_clip_rect(side);
        image(&painter, texture.id(), picture);
        caption(ui, &painter, corner, align, words);
    }
}

/// The line between both, with a grip in its middle.
fn grip(ui: &Ui, painter: &Painter, picture: Rect, share: f32, is_held: bool) {
    let x = picture.left() + picture.width() * share;
    let line = [pos2(x, picture.top()), pos2(x, picture.bottom())];
    painter.line_segment(line, Stroke::new(3.0, theme::MARK_EDGE));
    painter.line_segment(line, Stroke::new(1.25, theme::SELECTED_MARK));
    let grip = Rect::from_center_size(pos2(x, picture.center().y), theme::WIPE_GRIP);
    let edge = if is_held { Stroke::new(2.0, Palette::of(ui).accent) } else { Stroke::new(1.0, theme::MARK_EDGE) };
    painter.rect(grip, 3, theme::SELECTED_MARK, edge, StrokeKind::Outside);
}

/// The handle of the wipe: dragged anywhere along its line, or moved by the arrow keys; true when these go to it.
fn handle(ui: &Ui, session: &mut Session, visible: Rect, picture: Rect) -> bool {
    let wipe = &mut session.comparison.wipe;
    let x = picture.left() + picture.width() * *wipe;
    let reach = Rect::from_x_y_ranges(x - theme::GRIP_REACH..=x + theme::GRIP_REACH, visible.y_range());
    let response = ui.interact(reach, ui.scope_id().with("wipe"), Sense::click_and_drag());
    if response.hovered() || response.dragged() {
        ui.set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        *wipe = (pointer.x - picture.left()) / picture.width();
    }
    if response.has_focus() {
        let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        *wipe += step(ui);
    }
    *wipe = wipe.clamp(0.0, 1.0);
    let value = f64::from(*wipe);
    response.widget_info(|| WidgetInfo::slider(true, value, "Wipe between the photograph and the rendered match"));
    response.has_focus()
}

/// How far the arrow keys move the handle: a hundredth of the picture, with Shift a tenth.
fn step(ui: &Ui) -> f32 {
    let keys = [(Key::ArrowLeft, -1.0), (Key::ArrowRight, 1.0)];
    let taken = |modifiers, key| ui.input_mut(|input| input.count_and_consume_key(modifiers, key)) as f32;
    keys.into_iter()
        .map(|(key, sign)| sign * (0.1 * taken(Modifiers::SHIFT, key) + 0.01 * taken(Modifiers::NONE, key)))
        .sum()
}

/// Words on a dark ground in a corner of a picture.
fn caption(ui: &Ui, painter: &Painter, corner: Pos2, align: Align2, words: &str) {
    let font = TextStyle::Small.resolve(ui.style());
    let galley = painter.layout_no_wrap(words.to_owned(), font, theme::SELECTED_MARK);
    let inward = vec2(theme::GAP, theme::GAP) * -align.to_sign();
    let place = align.anchor_size(corner + inward, galley.size());
    painter.rect_filled(place.expand2(vec2(4.0, 2.0)), 2, theme::MARK_EDGE);
    painter.galley(place.min, galley, theme::SELECTED_MARK);
}

/// The false colours with their numbers, along the lower edge.
fn scale(ui: &Ui, painter: &Painter, rect: Rect, scale: Scale) {
    const STEPS: u8 = 64;
    let font = TextStyle::Small.resolve(ui.style());
    let words = scale_words(scale);
    let ends = format!("ΔE 0 to {:.0}", scale.full_scale);
    let row = Rect::from_min_max(rect.left_bottom() - vec2(0.0, theme::SCALE_ROW), rect.right_bottom());
    painter.rect_filled(row, 0, theme::MARK_EDGE);
    let inner = row.shrink2(vec2(theme::GAP, 0.0));
    let ends = painter.text(inner.left_center(), Align2::LEFT_CENTER, ends, font.clone(), theme::SELECTED_MARK);
    let bar = Rect::from_min_size(
        pos2(ends.right() + theme::GAP, row.center().y - theme::SCALE_BAR.y / 2.0),
        theme::SCALE_BAR,
    );
    for index in 0..STEPS {
        let share = |index: u8| f32::from(index) / f32::from(STEPS);
        let [red, green, blue] = false_colour(f64::from(share(index)));
        let x = bar.left() + bar.width() * share(index)..=bar.left() + bar.width() * share(index + 1);
        let cell = Rect::from_x_y_ranges(x, bar.y_range());
        painter.rect_filled(cell, CornerRadius::ZERO, Color32::from_rgb(red, green, blue));
    }
    painter.rect_stroke(bar, 0, Stroke::new(1.0, theme::BAND), StrokeKind::Outside);
    painter.text(
        pos2(bar.right() + theme::GAP, row.center().y),
        Align2::LEFT_CENTER,
        words,
        font,
        theme::SELECTED_MARK,
    );
}
