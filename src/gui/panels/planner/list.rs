//! The materials, each with its colours, where it is seen, and what is chosen for it.

use eframe::egui::{
    Align, Button, Label, Layout, Rect, Response, RichText, ScrollArea, Sense, StrokeKind, Ui, UiBuilder, Vec2, pos2,
};

use super::{place, words};
use crate::gui::command::Action;
use crate::gui::panels::demonstrations::row;
use crate::gui::planner::{Look, Planned, PlannerPage};
use crate::gui::theme::{self, Palette};
use crate::preset::Preset;
use crate::scene::MaterialPlan;

/// Between columns.
const GAP: f32 = 12.0;
/// Room for the button that takes a material off.
const REMOVE: f32 = 24.0;
/// Around what a row holds.
const ROW_MARGIN: Vec2 = Vec2::new(4.0, 3.0);
/// So many rows are seen however low the window is.
const LEAST_ROWS: f32 = 2.2;
/// Room beside the name for how much of it is seen, and at which angles.
const SEEN: f32 = 96.0;
/// Height of the name and of where it is seen, in a row that stacks.
const PLACE: f32 = 46.0;

/// True where the columns do not fit beside each other.
fn is_stacked(width: f32) -> bool {
    width < theme::PLAN_STACKS_BELOW
}

fn row_height(width: f32) -> f32 {
    if is_stacked(width) { theme::PLAN_ROW_STACKED } else { theme::PLAN_ROW }
}

/// Shows the list.
pub(super) fn show(
    ui: &mut Ui,
    page: &mut PlannerPage,
    open: &Preset,
    planned: Option<&Planned>,
    actions: &mut Vec<Action>,
) {
    let count = match planned {
        Some(planned) if page.is_fixed() => planned.plan.materials.len(),
        _ => page.entries().len(),
    };
    if count == 0 {
        return;
    }
    captions(ui);
    let height = row_height(ui.available_width());
    let all = count as f32 * (height + theme::GAP) - theme::GAP;
    let room = (ui.available_height() - theme::PLAN_DETAIL).max(LEAST_ROWS * height);
    let list = ScrollArea::vertical().id_salt("materials of the plan").auto_shrink([false, true]);
    list.max_height(all.min(room)).show_rows(ui, height, count, |ui, rows| {
        for index in rows {
            // By its own identity: what is typed stays in its row while others come and go.
            let id = id_of(page, index).unwrap_or(index as u64);
            ui.push_id(id, |ui| entry(ui, page, open, planned, index, actions));
        }
    });
}

/// What tells the entry of a row apart; `None` where a plan is looked at that has none.
fn id_of(page: &PlannerPage, index: usize) -> Option<u64> {
    page.entries().get(index).filter(|_| !page.is_fixed()).map(|entry| entry.id)
}

/// The places of the columns.
struct Columns {
    strip: Rect,
    place: Rect,
    model: Rect,
    error: Rect,
    cost: Rect,
    remove: Rect,
}

impl Columns {
    fn of(row: Rect) -> Self {
        let inner = row.shrink2(ROW_MARGIN);
        if is_stacked(row.width()) { Self::stacked(inner) } else { Self::beside(inner) }
    }

    /// What is chosen stands below where it is seen.
    fn stacked(row: Rect) -> Self {
        let [model, error, cost] = theme::PLAN_COLUMNS;
        let (strip, rest) = row.split_left_right_at_x(row.left() + theme::PLAN_STRIP);
        let (rest, remove) = rest.split_left_right_at_x(row.right() - REMOVE);
        let (place, below) = rest.with_min_x(rest.left() + GAP).split_top_bottom_at_y(row.top() + PLACE);
        let column = |left: f32, width: f32| Rect::from_x_y_ranges(left..=left + width, below.y_range());
        let error_at = below.left() + model + GAP;
        Self {
            strip,
            place,
            model: column(below.left(), model),
            error: column(error_at, error),
            cost: column(error_at + error + GAP, cost),
            remove,
        }
    }

    fn beside(row: Rect) -> Self {
        let [model, error, cost] = theme::PLAN_COLUMNS;
        let column = |left: f32, width: f32| Rect::from_x_y_ranges(left..=left + width, row.y_range());
        let strip = column(row.left(), theme::PLAN_STRIP);
        let right = row.right() - REMOVE;
        let (cost_at, error_at, model_at) = {
            let cost_at = right - cost;
            let error_at = cost_at - GAP - error;
            (cost_at, error_at, error_at - GAP - model)
        };
        let place_at = strip.right() + GAP;
        Self {
            place: column(place_at, (model_at - GAP - place_at).max(0.0)),
            strip,
            model: column(model_at, model),
            error: column(error_at, error),
            cost: column(cost_at, cost),
            remove: column(right, REMOVE),
        }
    }
}

fn captions(ui: &mut Ui) {
    let (rect, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), 16.0), Sense::hover());
    let columns = Columns::of(rect);
    // Where both stand above each other the name needs no caption.
    let place = if is_stacked(rect.width()) { "" } else { "Material, and where it is seen" };
    let texts = [
        (columns.strip, "Truth over model, 0–90°"),
        (columns.place, place),
        (columns.model, "Cheapest within the tolerance"),
        (columns.error, "Error that remains"),
        (columns.cost, "Cost"),
    ];
    for (column, text) in texts {
        let at = pos2(column.left(), rect.center().y);
        let colour = ui.visuals().weak_text_color();
        ui.painter().text(at, eframe::egui::Align2::LEFT_CENTER, text, row::small(ui), colour);
    }
}

/// One material; a click selects it.
fn entry(
    ui: &mut Ui,
    page: &mut PlannerPage,
    open: &Preset,
    planned: Option<&Planned>,
    index: usize,
    actions: &mut Vec<Action>,
) {
    let is_fixed = page.is_fixed();
    // The newest plan may be of an older list.
    let at = planned.and_then(|planned| match id_of(page, index) {
        Some(id) => planned.entries.iter().position(|own| *own == id),
        None => Some(index).filter(|_| is_fixed),
    });
    let found = planned.zip(at).map(|(planned, at)| (planned, &planned.plan.materials[at], &planned.looks[at]));
    let name = match (found, page.entries().get(index)) {
        (Some((_, material, _)), _) if is_fixed => material.name.clone(),
        (_, Some(entry)) => entry.material.name(open).to_owned(),
        _ => return,
    };
    let width = ui.available_width();
    let (rect, response) = ui.allocate_exact_size(Vec2::new(width, row_height(width)), Sense::click());
    let is_selected = page.selected == index;
    if is_selected || response.hovered() || response.has_focus() {
        let visuals = ui.style().interact_selectable(&response, is_selected);
        ui.painter().rect_filled(rect, theme::ROUNDING, visuals.weak_bg_fill.gamma_multiply(0.6));
    }
    let columns = Columns::of(rect);
    inside(ui, columns.place, |ui| {
        ui.horizontal(|ui| {
            let room = Vec2::new((ui.available_width() - SEEN).max(0.0), theme::ROW);
            ui.allocate_ui(room, |ui| ui.add(Label::new(theme::title(&name)).truncate()));
            if let Some((_, material, _)) = found {
                ui.add(Label::new(theme::hint(seen(material))).truncate());
            }
        });
        if !is_fixed {
            ui.horizontal(|ui| place::show(ui, page, index, &name, actions));
        }
    });
    let mut spoken = format!("Look at {name}");
    if let Some((planned, material, look)) = found {
        strip(ui, columns.strip.shrink2(Vec2::new(0.0, 2.0)), look, material);
        spoken = chosen(ui, &columns, planned, material, &name);
    }
    if !is_fixed && remove(ui, columns.remove, &name).clicked() {
        page.remove(index);
    }
    if response.accessible_name(spoken).clicked() {
        page.selected = index;
    }
}

fn inside<R>(ui: &mut Ui, rect: Rect, content: impl FnOnce(&mut Ui) -> R) -> R {
    let layout = Layout::top_down(Align::LEFT);
    let mut child = ui.new_child(UiBuilder::new().max_rect(rect).layout(layout));
    child.spacing_mut().item_spacing.y = 2.0;
    child.set_clip_rect(rect.expand(2.0).intersect(ui.clip_rect()));
    content(&mut child)
}

fn remove(ui: &mut Ui, rect: Rect, name: &str) -> Response {
    let button = Button::new(RichText::new("×").size(14.0)).frame(false);
    let place = Rect::from_center_size(rect.center(), Vec2::splat(20.0));
    let response = ui.place(place, button).on_hover_text("Take it off the list");
    response.accessible_name(format!("Remove {name}"))
}

fn seen(material: &MaterialPlan) -> String {
    let share = 100.0 * material.share;
    match material.seen_deg {
        Some((from, to)) if to - from < 0.5 => format!("{share:.0} %, {to:.0}°"),
        Some((from, to)) => format!("{share:.0} %, {from:.0}–{to:.0}°"),
        None => "not seen".to_owned(),
    }
}

/// The truth above what was chosen; below both, the angles that are seen.
fn strip(ui: &Ui, rect: Rect, look: &Look, material: &MaterialPlan) {
    const SEEN: f32 = 3.0;
    let bands = Rect::from_min_max(rect.min, pos2(rect.right(), rect.bottom() - SEEN - 2.0));
    let (above, below) = bands.split_top_bottom_at_fraction(0.5);
    for (place, band) in [(above, &look.truth), (below, &look.chosen)] {
        match band {
            Some(band) => row::paint(ui, place, band, false),
            None => _ = ui.painter().rect_filled(place, 0, Palette::of(ui).canvas),
        }
    }
    ui.painter().rect_stroke(bands, 0, ui.visuals().window_stroke(), StrokeKind::Outside);
    if let Some((from, to)) = material.seen_deg {
        let x = |deg: f64| rect.left() + rect.width() * (deg / 90.0) as f32;
        let bar = Rect::from_x_y_ranges(x(from)..=x(to).max(x(from) + 1.0), rect.bottom() - SEEN..=rect.bottom());
        ui.painter().rect_filled(bar, 1, Palette::of(ui).accent);
    }
}

/// Model, error and cost; gives them in words.
fn chosen(ui: &mut Ui, columns: &Columns, planned: &Planned, material: &MaterialPlan, name: &str) -> String {
    let choice = material.choice();
    let measure = planned.plan.tolerance.on;
    let label = material.chosen.label();
    let error = words::delta_e(choice.error.of(measure));
    let operations = words::count(choice.cost.shader_operations.into());
    let bytes = words::count(choice.cost.parameter_bytes);
    inside(ui, columns.model, |ui| {
        ui.add(Label::new(theme::title(&label)).truncate());
        let parameters = words::parameters(material.parameters.as_ref());
        ui.add(Label::new(theme::hint(&parameters)).truncate()).on_hover_text(parameters);
    });
    inside(ui, columns.error, |ui| {
        ui.label(format!("ΔE {error}"));
        if material.seen_deg.is_some() {
            ui.label(theme::hint(format!("most at {:.0}°", choice.error.angle_of_max_deg)));
        }
    });
    inside(ui, columns.cost, |ui| {
        ui.label(format!("{operations} operations"));
        ui.label(theme::hint(format!("{bytes} bytes")));
    });
    let cost = choice.cost;
    format!(
        "Look at {name}: {label}, {} {error}, {} operations, {} bytes",
        measure.label(),
        cost.shader_operations,
        cost.parameter_bytes
    )
}
