//! Where one material is seen: a shape with its numbers, or its place in a pass.

use eframe::egui::{ComboBox, Ui};

use super::path_field;
use crate::gui::command::Action;
use crate::gui::planner::{Apart, Entry, PlanFile, PlannerPage};
use crate::gui::theme;
use crate::gui::widgets::NumberField;
use crate::scene::Shape;

/// Shows what can be changed.
pub(super) fn show(ui: &mut Ui, page: &mut PlannerPage, index: usize, name: &str, actions: &mut Vec<Action>) {
    let way = page.scene.has_pass.then_some(page.scene.apart);
    let Some(entry) = page.scene.entry_mut(index) else { return };
    match way {
        None => shape(ui, entry, name),
        Some(Apart::Whole) => _ = ui.label(theme::hint("the whole pass")),
        Some(Apart::Ids) => {
            ui.label(theme::hint("id"));
            let mut id = f64::from(entry.object_id);
            let field = NumberField::new(&mut id, format!("Id of {name}")).precision(0, 0.2).range(0.0..=16_777_216.0);
            if field.show(ui).changed() {
                entry.object_id = id.round() as u32;
            }
        }
        Some(Apart::Mattes) => {
            let file = PlanFile::Matte(entry.id);
            path_field(ui, &mut entry.matte, &format!("the matte of {name}"), file, actions);
        }
    }
}

fn shape(ui: &mut Ui, entry: &mut Entry, name: &str) {
    let response = ComboBox::from_id_salt(("shape", entry.id))
        .selected_text(if entry.is_as_saved { AS_SAVED } else { kind(entry.shape) })
        .show_ui(ui, |ui| {
            if entry.saved.is_some() {
                let what = "The angles of the pass that were saved with the plan";
                ui.selectable_value(&mut entry.is_as_saved, true, AS_SAVED).on_hover_text(what);
            }
            for choice in Shape::USUAL {
                let is_chosen = !entry.is_as_saved && kind(choice) == kind(entry.shape);
                if ui.selectable_label(is_chosen, kind(choice)).on_hover_text(choice.label()).clicked() && !is_chosen {
                    (entry.shape, entry.is_as_saved) = (choice, false);
                }
            }
        })
        .response;
    response.on_hover_text("Where it is seen").accessible_name(format!("Where {name} is seen"));
    if entry.is_as_saved {
        return;
    }
    match &mut entry.shape {
        Shape::Sphere | Shape::Cylinder => {}
        Shape::Card { from_deg, to_deg } => {
            angle(ui, from_deg, format!("Smallest tilt of {name}"));
            ui.label(theme::hint("to"));
            angle(ui, to_deg, format!("Largest tilt of {name}"));
        }
        Shape::Floor { eye_m, near_m, far_m } => {
            ui.label(theme::hint("eye"));
            metres(ui, eye_m, format!("Height of the eye above {name}"));
            ui.label(theme::hint("at"));
            metres(ui, near_m, format!("Nearest place of {name}"));
            ui.label(theme::hint("to"));
            metres(ui, far_m, format!("Farthest place of {name}"));
        }
    }
}

const AS_SAVED: &str = "As saved";

fn angle(ui: &mut Ui, value: &mut f64, name: String) {
    NumberField::new(value, name).precision(0, 0.5).range(0.0..=90.0).width(40.0).suffix("°").show(ui);
}

fn metres(ui: &mut Ui, value: &mut f64, name: String) {
    NumberField::new(value, name).precision(1, 0.05).range(0.01..=10_000.0).width(48.0).suffix(" m").show(ui);
}

const fn kind(shape: Shape) -> &'static str {
    match shape {
        Shape::Sphere => "Sphere",
        Shape::Cylinder => "Cylinder",
        Shape::Card { .. } => "Card",
        Shape::Floor { .. } => "Floor",
    }
}
