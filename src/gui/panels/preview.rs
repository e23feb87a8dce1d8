//! How good previews are while something moves.

use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{Label, PopupCloseBehavior, Slider, SliderClamping, Ui};

use crate::gui::preview::{Rung, within};
use crate::gui::settings::BUDGETS_MS;
use crate::gui::spheres::Spheres;
use crate::gui::theme;

/// A menu with the slider of the budget, and the error it costs.
pub(crate) fn menu(ui: &mut Ui, spheres: &mut Spheres, budget_ms: &mut f64) {
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (button, _) = MenuButton::new("Preview ▾").config(config).ui(ui, |ui| {
        ui.set_width(theme::PREVIEW_MENU);
        ui.label(theme::title("While something moves"));
        ui.spacing_mut().slider_width = theme::PREVIEW_MENU - 80.0;
        let slider = Slider::new(budget_ms, BUDGETS_MS).logarithmic(true).suffix(" ms").max_decimals(0);
        let slider = slider.clamping(SliderClamping::Edits);
        ui.add(slider).on_hover_text("How long a picture may take").accessible_name("Preview quality");
        let rungs = spheres.measured(ui.ctx());
        let words = if rungs.is_empty() { "Measuring".to_owned() } else { words(*budget_ms, rungs) };
        ui.add(Label::new(words).wrap());
    });
    button.on_hover_text("How good the spheres are while something moves").accessible_name("Preview");
}

/// What fits into the budget, and what it costs.
fn words(budget_ms: f64, rungs: &[Rung]) -> String {
    let full = rungs[0];
    let quality = within(budget_ms, true, full.took, rungs);
    let Some(rung) = rungs.iter().find(|rung| rung.quality == quality) else { return "Measuring".to_owned() };
    let took = |rung: &Rung| rung.took.truth_ms + rung.took.picture_ms;
    if rung.quality == full.quality {
        return format!("The finished picture takes {:.1} ms: it is always shown, and no error is made", took(&full));
    }
    let text = format!(
        "{}: {:.1} ms. ΔE to the finished picture {:.2} on average and {:.2} at most; it takes {:.1} ms and follows when \
         the hand rests",
        rung.quality.words(),
        took(rung),
        rung.mean_delta_e,
        rung.max_delta_e,
        took(&full)
    );
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}
