//! The list of demonstrations, what the one on show is about, and its files.

use eframe::egui::{Button, ComboBox, Label, Ui, Vec2};

use crate::color::RgbSpace;
use crate::figure::FigureFormat;
use crate::gui::command::Action;
use crate::gui::demonstrations::{Demonstration, DemonstrationsPage, Exhibit, METHODS, Material, Piece, Slot};
use crate::gui::state::State;
use crate::gui::theme;
use crate::gui::widgets::{NumberField, row_label};

/// Shows the column.
pub(super) fn show(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    list(ui, &mut state.demonstrations.demonstration);
    ui.add_space(theme::GROUP_GAP);
    ui.label(theme::title("What it is about"));
    let shown = state.demonstrations.demonstration;
    let has_materials = !matches!(shown, Demonstration::Uniformity | Demonstration::Feasibility);
    match shown {
        Demonstration::Conversion => {
            how_many(ui, ["One material", "All metals"], &mut state.demonstrations.has_all_metals);
        }
        Demonstration::Blending => {
            how_many(ui, ["Two materials", "All pairs of metals"], &mut state.demonstrations.has_all_pairs);
        }
        _ => {}
    }
    if has_materials && !is_of_all(state) {
        materials(ui, state, actions);
    }
    match shown {
        Demonstration::Uniformity => {
            ui.add(Label::new(theme::hint("Greys: a slider of h, or of g, beside one r")).wrap());
        }
        Demonstration::Feasibility => {
            ui.add(Label::new(theme::hint("The open preset among all measured metals, in its own space")).wrap());
        }
        _ => spaces(ui, &mut state.demonstrations, shown),
    }
    ui.add_space(theme::GROUP_GAP);
    files(ui, state, actions);
}

fn list(ui: &mut Ui, shown: &mut Demonstration) {
    for demonstration in Demonstration::ALL {
        let button = Button::selectable(*shown == demonstration, demonstration.label());
        let response = ui.add(button.min_size(Vec2::new(ui.available_width(), theme::ROW + 2.0)).right_text(""));
        let name = format!("{}: {}", demonstration.label(), demonstration.question());
        if response.on_hover_text(demonstration.question()).accessible_name(name).clicked() {
            *shown = demonstration;
        }
    }
}

fn how_many(ui: &mut Ui, [one, all]: [&str; 2], has_all: &mut bool) {
    ui.horizontal(|ui| {
        ui.selectable_value(has_all, false, one);
        ui.selectable_value(has_all, true, all);
    });
}

fn is_of_all(state: &State) -> bool {
    let exhibit = state.demonstrations.exhibit(state.open());
    matches!(exhibit, Exhibit::Conversions(_) | Exhibit::Blends(_))
}

fn materials(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    let shown = state.demonstrations.demonstration;
    let first = ("Material", "What the demonstration is about", Slot::First);
    let second = match shown {
        Demonstration::Blending => ("Blended with", "What it is blended with", Slot::Second),
        _ => ("Gradient to", "Where the gradient that shows banding leads", Slot::Second),
    };
    let slots = if shown.has_second() { vec![first, second] } else { vec![first] };
    let mut has_dielectric = false;
    for (label, what, slot) in slots {
        let material = state.demonstrations.material(slot, state.open());
        has_dielectric |= matches!(material, Material::Dielectric { .. });
        ui.horizontal(|ui| {
            row_label(ui, label);
            let button = Button::new(format!("{} ▾", material.name())).truncate();
            let response = ui.add(button.min_size(Vec2::new(ui.available_width(), theme::ROW))).on_hover_text(what);
            if response.accessible_name(format!("{label}: {}", material.name())).clicked() {
                actions.push(Action::FindMaterial(slot));
            }
        });
    }
    if has_dielectric {
        ui.horizontal(|ui| {
            row_label(ui, "n");
            let field = NumberField::new(&mut state.demonstrations.n, "Refractive index of the dielectric");
            field.precision(3, 0.005).range(1.0..=4.0).width(ui.available_width()).show(ui);
        });
    }
}

fn spaces(ui: &mut Ui, page: &mut DemonstrationsPage, shown: Demonstration) {
    if shown == Demonstration::Conversion {
        space(ui, "From", "Space the parameters were made in", &mut page.from);
        space(ui, "To", "Space they are converted to", &mut page.to);
    } else {
        space(ui, "Space", "Space of the parameters", &mut page.space);
    }
    ui.horizontal(|ui| {
        row_label(ui, "n, k and g");
        let response = ComboBox::from_id_salt("method")
            .width(ui.available_width())
            .selected_text(page.method.label())
            .truncate()
            .show_ui(ui, |ui| {
                for method in METHODS {
                    ui.selectable_value(&mut page.method, method, method.label());
                }
            })
            .response;
        let what = "How n, k and g of a measured metal are derived";
        response.on_hover_text(what).accessible_name(what);
    });
}

fn space(ui: &mut Ui, label: &str, what: &str, space: &mut RgbSpace) {
    ui.horizontal(|ui| {
        row_label(ui, label);
        let response = ComboBox::from_id_salt(what)
            .width(ui.available_width())
            .selected_text(space.label())
            .truncate()
            .show_ui(ui, |ui| {
                for choice in RgbSpace::ALL {
                    ui.selectable_value(space, choice, choice.label());
                }
            })
            .response;
        response.on_hover_text(what).accessible_name(what);
    });
}

/// Buttons for the figure and the numbers in it.
fn files(ui: &mut Ui, state: &State, actions: &mut Vec<Action>) {
    ui.label(theme::title("Export"));
    ui.horizontal(|ui| {
        row_label(ui, "Figure");
        for format in FigureFormat::ALL {
            let name = format.extension().to_uppercase();
            let button = ui.button(format!("{name}…")).on_hover_text("Save the figure");
            if button.accessible_name(format!("Export the figure as {name}")).clicked() {
                actions.push(Action::SavePiece(Piece::Figure(format)));
            }
        }
    });
    ui.horizontal_top(|ui| {
        row_label(ui, "Data");
        ui.vertical(|ui| {
            for &(piece, label) in state.demonstrations.exhibit(state.open()).tables() {
                let button = ui.button(label).on_hover_text("Save the numbers in it");
                let name = format!("Export the data as {}", label.trim_end_matches('…'));
                if button.accessible_name(name).clicked() {
                    actions.push(Action::SavePiece(piece));
                }
            }
        });
    });
    if let Some(path) = &state.demonstrations.exported {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        ui.add(Label::new(theme::hint(format!("Wrote {name}"))).truncate()).on_hover_text(path.display().to_string());
    }
}
