//! The curves of the preset over the truth, and the same as swatches.

use std::ops::RangeInclusive;

use eframe::egui::{Align, Grid, Label, Layout, RichText, ScrollArea, Ui};
use egui_plot::LineStyle;

use crate::color::{Rgb, RgbSpace, delta_e_rgb};
use crate::fresnel::{CosTheta, FresnelModel, THETA_MAX_DEG, Weights};
use crate::gui::command::{Action, Command};
use crate::gui::comparisons::{Asked, Compared, Comparison};
use crate::gui::panels::spheres;
use crate::gui::state::State;
use crate::gui::theme;
use crate::gui::truth::{at_angle, curve_angles_deg};
use crate::gui::widgets::{CurvePlot, Handle, PlotLine, line_sample, strip};
use crate::preset::{Origin, Preset};

/// Dashes of the measured truth.
const TRUTH: LineStyle = LineStyle::Dashed { length: 6.0 };

/// Shows the plot with its legend, strips and read-out.
pub(crate) fn show(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    legend(ui, state, actions);
    let space = state.document.space();
    let model = state.document.preset.model();
    let curve = sample(&model);
    let asked = Asked { model, space, which: state.view.comparisons.clone() };
    let compared = state.comparisons.curves(ui.ctx(), &asked);
    let truth = state.view.metal.map(|metal| state.truth.curve(metal, space).clone());
    let mut lines: Vec<PlotLine<'_>> = compared.iter().filter(|other| !other.curve.is_empty()).map(line_of).collect();
    if let Some(curve) = &truth {
        lines.push(PlotLine { name: "truth", curve, style: TRUTH, width: theme::THIN_CURVE, opacity: 0.95 });
    }
    lines.push(PlotLine { name: "preset", curve: &curve, style: LineStyle::Solid, width: theme::CURVE, opacity: 1.0 });
    let band = uncertainty_band(&state.document.preset, &curve);
    let range_deg = if state.view.is_grazing_only { 60.0..=90.0 } else { 0.0..=90.0 };
    let preset = &state.document.preset;
    let handles = [
        Handle { angle_deg: 0.0, name: "r, facing", value: preset.r },
        Handle { angle_deg: THETA_MAX_DEG, name: "h, at 81.8°", value: preset.h },
    ];
    let strips = if truth.is_some() { 2.0 } else { 1.0 };
    // Room for the rows that are asked for, not for those that have come: nothing jumps when they do.
    let rows = asked.which.len() as f32 * READ_OUT_ROW;
    let below = strips * (theme::STRIP + theme::GAP)
        + READ_OUT
        + rows
        + spheres::height(ui.available_width())
        + theme::GROUP_GAP;
    let plot = CurvePlot {
        lines: &lines,
        band: band.as_ref().map(|(low, high)| (low.as_slice(), high.as_slice())),
        handles: &handles,
        range_deg: range_deg.clone(),
        cursor_deg: state.view.cursor_deg,
        height: (ui.available_height() - below).max(LEAST_PLOT),
    };
    let output = plot.show(ui);
    let mut cursor_deg = output.cursor_deg;
    if let Some(curve) = &truth {
        cursor_deg = cursor_deg.or(strip(ui, output.frame, "truth", curve, space, &range_deg));
    }
    cursor_deg = cursor_deg.or(strip(ui, output.frame, "r, h", &curve, space, &range_deg));
    let numbers = ReadOut { preset: &curve, truth: truth.as_deref(), compared: &compared, space };
    if ui.available_width() < LEAST_READ_OUT {
        // Else the spheres below would be as wide.
        let scrolled = ScrollArea::horizontal().id_salt("numbers").auto_shrink([false, true]);
        scrolled.show(ui, |ui| read_out(ui, cursor_deg, &numbers));
    } else {
        read_out(ui, cursor_deg, &numbers);
    }
    keep_cursor(ui, state, cursor_deg, &range_deg);
    spheres::show(ui, state);
    if let Some((index, value)) = output.dragged {
        let preset = &mut state.document.preset;
        *(if index == 0 { &mut preset.r } else { &mut preset.h }) = value;
        preset.mark_edited();
    }
}

/// In a low window the spheres become smaller before the plot does.
const LEAST_PLOT: f32 = 160.0;
/// Height of the numbers of preset and truth below the strips.
const READ_OUT: f32 = 58.0;
/// Narrower, the numbers do not fit beside each other.
const LEAST_READ_OUT: f32 = 520.0;
/// Height of each further row.
const READ_OUT_ROW: f32 = theme::ROW + 3.0;

fn line_of(other: &Compared) -> PlotLine<'_> {
    PlotLine {
        name: other.which.name(),
        curve: &other.curve,
        style: style_of(other.which),
        width: theme::THIN_CURVE,
        opacity: 0.9,
    }
}

fn style_of(which: Comparison) -> LineStyle {
    theme::comparison_line(which as usize)
}

/// The curve of a model at the angles of the plot.
pub(crate) fn sample(model: &FresnelModel) -> Vec<Rgb> {
    curve_angles_deg().map(|deg| model.reflectance(CosTheta::from_deg(deg))).collect()
}

/// The ± of a matched curve, by the weights of r and h at each angle; `None` where either colour
/// was not measured or was changed since.
fn uncertainty_band(preset: &Preset, curve: &[Rgb]) -> Option<(Vec<Rgb>, Vec<Rgb>)> {
    let Origin::Matched(recipe) = &preset.origin else { return None };
    let complete = |values: [Option<f64>; 3]| Some(Rgb([values[0]?, values[1]?, values[2]?]));
    let (r, h) = (complete(recipe.r_uncertainty)?, complete(recipe.h_uncertainty)?);
    let at = |deg: f64| {
        let weights = Weights::at(CosTheta::from_deg(deg));
        r.zip(h, |r, h| (weights.of_r * r).hypot(weights.of_h * h))
    };
    let uncertainties: Vec<Rgb> = curve_angles_deg().map(at).collect();
    let shifted = |sign: f64| curve.iter().zip(&uncertainties).map(|(&f, &u)| f + u * sign).collect();
    Some((shifted(-1.0), shifted(1.0)))
}

fn keep_cursor(ui: &Ui, state: &mut State, cursor_deg: Option<f64>, range_deg: &RangeInclusive<f64>) {
    let cursor_deg = cursor_deg.map(|deg| deg.clamp(*range_deg.start(), *range_deg.end()));
    if state.view.cursor_deg != cursor_deg {
        state.view.cursor_deg = cursor_deg;
        ui.ctx().request_repaint();
    }
}

fn legend(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.label(theme::title("Reflectance over the angle"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let mut is_grazing_only = state.view.is_grazing_only;
            if ui.checkbox(&mut is_grazing_only, "60–90°").on_hover_text(Command::ToggleGrazing.tooltip()).changed()
            {
                actions.push(Command::ToggleGrazing.into());
            }
        });
    });
    ui.horizontal_wrapped(|ui| {
        line_sample(ui, LineStyle::Solid, theme::CURVE, 1.0);
        ui.label("preset");
        ui.add_space(theme::GAP);
        line_sample(ui, TRUTH, theme::THIN_CURVE, 1.0);
        truth_menu(ui, state, actions);
        for which in Comparison::ALL {
            // A line and its name stay together.
            if ui.available_size_before_wrap().x < COMPARISON_WIDTH {
                ui.end_row();
            }
            comparison(ui, state, which);
        }
    });
}

/// Room for the longest name with its line and box.
const COMPARISON_WIDTH: f32 = 106.0;

/// A model that can be drawn beneath the preset, with the look of its line.
fn comparison(ui: &mut Ui, state: &mut State, which: Comparison) {
    let mut is_drawn = state.view.comparisons.contains(&which);
    line_sample(ui, style_of(which), theme::THIN_CURVE, 1.0);
    let response = ui.checkbox(&mut is_drawn, which.name()).on_hover_text(which.what());
    if response.changed() {
        let drawn = &mut state.view.comparisons;
        if is_drawn {
            drawn.insert(which)
        } else {
            drawn.remove(&which)
        };
    }
}

fn truth_menu(ui: &mut Ui, state: &State, actions: &mut Vec<Action>) {
    let chosen = state.view.metal.map_or("no metal", |metal| metal.name.as_str());
    let button = ui.button(format!("{chosen} ▾")).on_hover_text(Command::Compare.tooltip());
    if button.accessible_name(format!("Truth: {chosen}")).clicked() {
        actions.push(Command::Compare.into());
    }
}

/// The curves whose numbers are shown.
struct ReadOut<'a> {
    preset: &'a [Rgb],
    truth: Option<&'a [Rgb]>,
    compared: &'a [Compared],
    space: RgbSpace,
}

impl ReadOut<'_> {
    /// ΔE to the truth, or to the preset where there is none.
    fn difference(&self, curve: &[Rgb], angle_deg: f64) -> String {
        let (reference, name) = self.truth.map_or((self.preset, "preset"), |truth| (truth, "truth"));
        let delta_e = delta_e_rgb(at_angle(curve, angle_deg), at_angle(reference, angle_deg), self.space);
        format!("ΔE {delta_e:.2} to {name}")
    }
}

/// Numbers at the angle under the pointer, or at θ_max while there is none.
fn read_out(ui: &mut Ui, cursor_deg: Option<f64>, curves: &ReadOut) {
    let angle_deg = cursor_deg.unwrap_or(THETA_MAX_DEG);
    let words = |curve: &[Rgb]| at_angle(curve, angle_deg).0.map(|v| format!("{v:>7.4}")).join(" ");
    ui.add_space(theme::GAP);
    Grid::new("read-out").num_columns(5).spacing([theme::GROUP_GAP, 3.0]).show(ui, |ui| {
        ui.label(theme::number(format!("{angle_deg:5.1}°")).strong());
        ui.label(theme::hint("preset"));
        ui.label(theme::number(words(curves.preset)));
        let difference = curves.truth.map_or_else(String::new, |_| curves.difference(curves.preset, angle_deg));
        ui.label(RichText::new(difference).small());
        ui.label(theme::hint(curves.space.label()));
        ui.end_row();
        if let Some(truth) = curves.truth {
            ui.label("");
            ui.label(theme::hint("truth"));
            ui.label(theme::number(words(truth)));
            ui.end_row();
        }
        for other in curves.compared {
            ui.label("");
            ui.label(theme::hint(other.which.name()));
            if other.curve.is_empty() {
                ui.label(theme::hint("none"));
                ui.label("");
            } else {
                ui.label(theme::number(words(&other.curve)));
                ui.label(RichText::new(curves.difference(&other.curve, angle_deg)).small());
            }
            ui.add(Label::new(theme::hint(&other.losses)).truncate()).on_hover_text(&other.losses);
            ui.end_row();
        }
    });
}
