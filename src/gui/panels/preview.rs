//! How good previews are while something moves.

use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{Align, Label, Layout, PopupCloseBehavior, Slider, SliderClamping, Ui, Vec2};

use crate::gui::preview::{Rung, within};
use crate::gui::settings::BUDGETS_MS;
use crate::gui::spheres::Spheres;
use crate::gui::standing::over;
use crate::gui::theme::{self, Palette};

/// A menu with the slider of the budget, and the error it costs.
pub(crate) fn menu(ui: &mut Ui, spheres: &mut Spheres, budget_ms: &mut f64) {
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (button, _) = MenuButton::new("Preview ▾").config(config).ui(ui, |ui| {
        ui.set_width(theme::PREVIEW_MENU);
        // Above the slider: a tooltip would cover the sentence below it.
        ui.label(theme::title("While something moves, a picture may take"));
        ui.spacing_mut().slider_width = theme::PREVIEW_MENU - 80.0;
        let slider = Slider::new(budget_ms, BUDGETS_MS).logarithmic(true).suffix(" ms").max_decimals(0);
        let slider = slider.clamping(SliderClamping::Edits);
        ui.add(slider).accessible_name("Preview quality");
        let rungs = spheres.measured(ui.ctx());
        let words = if rungs.is_empty() { "Measuring".to_owned() } else { words(*budget_ms, rungs) };
        ui.add(Label::new(words).wrap());
    });
    button.on_hover_text("How good the spheres are while something moves").accessible_name("Preview");
}

/// Two lines: which quality is on show, and what it costs where it is not the finished one.
pub(crate) fn standing(ui: &mut Ui, spheres: &Spheres, budget_ms: f64) {
    let size = Vec2::new(ui.available_width(), theme::STANDING);
    // As high whether it says much or little: nothing jumps when the hand comes to rest.
    ui.allocate_ui_with_layout(size, Layout::top_down(Align::LEFT), |ui| {
        ui.set_min_size(size);
        ui.spacing_mut().item_spacing.y = 1.0;
        let Some(standing) = spheres.standing() else { return };
        let (weak, warning) = (ui.visuals().weak_text_color(), Palette::of(ui).warning);
        let colour = if standing.is_finished() { weak } else { warning };
        for line in [standing.what(budget_ms), standing.cost()] {
            ui.add(Label::new(theme::hint(line).color(colour)).truncate());
        }
    });
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
    let time = match took(rung) {
        time if time > budget_ms => format!("{}; nothing is quicker", over(time, budget_ms)),
        time => format!("{time:.1} ms"),
    };
    let text = format!(
        "{}: {time}. ΔE to the finished picture {:.2} on average and {:.2} at most; it takes {:.1} ms and follows when the \
         hand rests",
        rung.quality.words(),
        rung.off.mean,
        rung.off.max,
        took(&full)
    );
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}
