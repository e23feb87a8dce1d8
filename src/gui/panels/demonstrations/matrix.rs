//! Every pair of metals blended half and half.

use eframe::egui::{
    Align2, ComboBox, FontId, Mesh, Pos2, Rangef, Rect, Response, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2,
    WidgetInfo, accesskit::Role, pos2, vec2,
};

use super::{delta_e_text, row, sentence, told};
use crate::gui::command::Action;
use crate::gui::demonstrations::{Choice, ShownBlends, Slot};
use crate::gui::state::State;
use crate::gui::theme::{self, Palette};
use crate::study::Parameters;

/// The ΔE of the strongest colour.
const FULL_SCALE: f64 = 10.0;
/// Room for the names of the rows.
const NAMES: f32 = 148.0;
/// Height of the symbols over the columns.
const SYMBOLS: f32 = 66.0;

/// Shows the matrix.
pub(super) fn show(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    let page = &mut state.demonstrations;
    let (progress, mut matrix) = (page.progress(), page.matrix);
    let result = page.blends(ui.ctx());
    let Some(shown) = told(ui, result, progress) else { return };
    sentence(ui, &shown.sentence, &[]);
    ui.horizontal(|ui| {
        for (index, place) in ["Below the diagonal", "Above the diagonal"].into_iter().enumerate() {
            ui.label(theme::hint(place));
            description(ui, place, &mut matrix[index]);
            ui.add_space(theme::GAP);
        }
        scale(ui);
    });
    if let Some((row, column)) = cells(ui, shown, matrix) {
        let [first, second] = [row, column].map(|index| Choice::Metal(shown.metals[index]));
        actions.extend([Action::Demonstrate(Slot::First, first), Action::Demonstrate(Slot::Second, second)]);
    }
    page.matrix = matrix;
}

fn description(ui: &mut Ui, place: &str, parameters: &mut Parameters) {
    let response = ComboBox::from_id_salt(place)
        .selected_text(parameters.label())
        .show_ui(ui, |ui| {
            for choice in Parameters::ALL {
                ui.selectable_value(parameters, choice, choice.label());
            }
        })
        .response;
    response.on_hover_text("The description that is blended").accessible_name(place);
}

fn scale(ui: &mut Ui) {
    ui.label(theme::hint("ΔE2000 at the worst angle  0"));
    let (rect, _) = ui.allocate_exact_size(vec2(120.0, 8.0), Sense::hover());
    let palette = Palette::of(ui);
    let mut mesh = Mesh::default();
    const STEPS: u8 = 40;
    for step in 0..STEPS {
        let share = |step: u8| f32::from(step) / f32::from(STEPS);
        let x = rect.left() + rect.width() * share(step)..=rect.left() + rect.width() * share(step + 1);
        mesh.add_colored_rect(Rect::from_x_y_ranges(x, rect.y_range()), palette.heat(f64::from(share(step))));
    }
    ui.painter().add(mesh);
    ui.painter().rect_stroke(rect, 0, ui.visuals().window_stroke(), StrokeKind::Outside);
    ui.label(theme::hint(format!("{FULL_SCALE:.0} and more")));
}

/// Shows the cells; gives the pair that was clicked.
fn cells(ui: &mut Ui, shown: &ShownBlends, matrix: [Parameters; 2]) -> Option<(usize, usize)> {
    let count = shown.metals.len();
    let room = (ui.available_width() - NAMES).min(ui.available_height() - SYMBOLS - theme::GAP);
    let cell = (room / count.max(1) as f32).clamp(8.0, 16.0);
    let side = cell * count as f32;
    let (whole, _) = ui.allocate_exact_size(vec2(NAMES + side, SYMBOLS + side), Sense::hover());
    let rect = Rect::from_min_size(whole.min + vec2(NAMES, SYMBOLS), Vec2::splat(side));
    let response = ui.interact(rect, ui.scope_id().with("pairs"), Sense::CLICK);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, format!("{count} metals by {count} metals")));
    let under = response.hover_pos().map(|pointer| place(rect, cell, count, pointer));
    paint(ui, shown, matrix, rect, cell);
    names(ui, shown, rect, cell, under);
    explain(ui, shown, matrix, &response, under)
}

/// The description a cell is of.
fn of_cell([below, above]: [Parameters; 2], row: usize, column: usize) -> Parameters {
    if column > row { above } else { below }
}

fn place(rect: Rect, cell: f32, count: usize, pointer: Pos2) -> (usize, usize) {
    let index = |offset: f32| ((offset / cell) as usize).min(count.saturating_sub(1));
    (index(pointer.y - rect.top()), index(pointer.x - rect.left()))
}

fn paint(ui: &Ui, shown: &ShownBlends, matrix: [Parameters; 2], rect: Rect, cell: f32) {
    let palette = Palette::of(ui);
    let count = shown.metals.len();
    let mut mesh = Mesh::default();
    for index in 0..count * count {
        let (row, column) = (index / count, index % count);
        let value = shown.value(of_cell(matrix, row, column), row, column);
        if value.is_finite() {
            let corner = rect.min + vec2(cell * column as f32, cell * row as f32);
            let colour = palette.heat(value / FULL_SCALE);
            mesh.add_colored_rect(Rect::from_min_size(corner, Vec2::splat(cell - 1.0)), colour);
        }
    }
    ui.painter().add(mesh);
}

/// Names of the rows, symbols over the columns; those under the pointer stand out.
fn names(ui: &Ui, shown: &ShownBlends, rect: Rect, cell: f32, under: Option<(usize, usize)>) {
    let size = TextStyle::Small.resolve(ui.style()).size.min(cell);
    let font = FontId::proportional(size);
    let (weak, strong) = (ui.visuals().weak_text_color(), ui.visuals().strong_text_color());
    let rows = ui.painter().with_clip_rect(Rect::from_x_y_ranges(
        Rangef::new(rect.left() - NAMES, rect.left()),
        rect.y_range().expand(2.0),
    ));
    for (index, metal) in shown.metals.iter().enumerate() {
        let middle = cell * (index as f32 + 0.5);
        let colour = |is_under: bool| if is_under { strong } else { weak };
        let at = pos2(rect.left() - theme::GAP, rect.top() + middle);
        let of_row = colour(under.is_some_and(|(row, _)| row == index));
        rows.text(at, Align2::RIGHT_CENTER, &metal.name, font.clone(), of_row);
        let of_column = colour(under.is_some_and(|(_, column)| column == index));
        let galley = ui.painter().layout_no_wrap(metal.symbol.clone(), font.clone(), of_column);
        let at = pos2(rect.left() + middle - galley.size().y / 2.0, rect.top() - theme::GAP);
        let text = eframe::egui::epaint::TextShape::new(at, galley, of_column);
        ui.painter().add(text.with_angle(-std::f32::consts::FRAC_PI_2));
    }
}

/// Says which pair is under the pointer; gives it when it was clicked.
fn explain(
    ui: &Ui,
    shown: &ShownBlends,
    matrix: [Parameters; 2],
    response: &Response,
    under: Option<(usize, usize)>,
) -> Option<(usize, usize)> {
    let (row, column) = under.filter(|(row, column)| row != column)?;
    let (a, b) = (shown.metals[row], shown.metals[column]);
    let each = Parameters::ALL.map(|p| format!("{}  {}", p.label(), delta_e_text(shown.value(p, row, column))));
    let parameters = of_cell(matrix, row, column);
    let text = format!("{} and {}, shown: {}\n{}\nClick to look at them", a.name, b.name, parameters, each.join("\n"));
    let stroke = Stroke::new(1.0, row::ink(ui, parameters));
    if let Some(pointer) = response.hover_pos() {
        ui.painter().circle_stroke(pointer, theme::DOT, stroke);
    }
    response.clone().on_hover_text_at_pointer(text).clicked().then_some((row, column))
}
