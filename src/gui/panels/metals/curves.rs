//! The truth of a metal, models over it, and how far they are from it at each angle.

use eframe::egui::{Checkbox, Grid, Label, ScrollArea, Ui};

use super::{heading, saving};
use crate::color::RgbSpace;
use crate::gui::command::Action;
use crate::gui::metals::{CONTESTANTS, Curves, Fitted, MetalsPage, Spread, other_measurements};
use crate::gui::sheet::SheetKind;
use crate::gui::theme::{self, Palette};
use crate::gui::truth::at_angle;
use crate::gui::widgets::{CurvePlot, DifferenceLine, PlotLine, difference_plot, line_sample, strip};

const RANGE_DEG: std::ops::RangeInclusive<f64> = 0.0..=90.0;

/// Shows the curves.
pub(crate) fn show(ui: &mut Ui, page: &mut MetalsPage, actions: &mut Vec<Action>) {
    heading(ui, page);
    chooser(ui, page, actions);
    let (space, cursor, drawn) = (page.space, page.cursor_deg, page.shown.clone());
    let Some(mut curves) = page.curves(ui.ctx()).cloned() else {
        ui.label(theme::hint("Fitting models"));
        return;
    };
    curves.fitted.retain(|fitted| drawn.contains(&fitted.contestant));
    // With every model drawn there is more than fits.
    let shown = ScrollArea::vertical().auto_shrink(false).show(ui, |ui| plots(ui, &curves, space, cursor));
    let cursor_deg = shown.inner;
    if page.cursor_deg != cursor_deg {
        page.cursor_deg = cursor_deg;
        ui.ctx().request_repaint();
    }
}

/// Reflectance, strips, differences and numbers; gives the angle under the pointer.
fn plots(ui: &mut Ui, curves: &Curves, space: RgbSpace, cursor: Option<f64>) -> Option<f64> {
    let plot = CurvePlot {
        lines: &lines(curves),
        band: curves.spread.as_ref().map(|spread| (spread.low.as_slice(), spread.high.as_slice())),
        handles: &[],
        range_deg: RANGE_DEG,
        cursor_deg: cursor,
        height: plot_height(ui, curves),
    };
    let output = plot.show(ui);
    let mut cursor_deg = output.cursor_deg.or(strip(ui, output.frame, "truth", &curves.truth, space, &RANGE_DEG));
    for fitted in &curves.fitted {
        let name = CONTESTANTS[fitted.contestant].name;
        cursor_deg = cursor_deg.or(strip(ui, output.frame, name, &fitted.curve, space, &RANGE_DEG));
    }
    cursor_deg = cursor_deg.or(difference_plot(ui, &differences(ui, curves), RANGE_DEG, cursor, DIFFERENCE_HEIGHT));
    numbers(ui, curves, cursor_deg);
    cursor_deg
}

const DIFFERENCE_HEIGHT: f32 = 128.0;
/// Height of a row of numbers.
const NUMBER_ROW: f32 = theme::ROW + 2.0;

fn plot_height(ui: &Ui, curves: &Curves) -> f32 {
    let models = curves.fitted.len() as f32;
    let strips = (models + 1.0) * (theme::STRIP + theme::GAP);
    let numbers = (models + if curves.spread.is_some() { 2.0 } else { 1.0 }) * NUMBER_ROW;
    (ui.available_height() - strips - DIFFERENCE_HEIGHT - numbers - theme::GROUP_GAP).max(140.0)
}

/// Which models are drawn, each with the look of its line.
fn chooser(ui: &mut Ui, page: &mut MetalsPage, actions: &mut Vec<Action>) {
    ui.horizontal_wrapped(|ui| {
        for (index, contestant) in CONTESTANTS.iter().enumerate() {
            let mut is_shown = page.shown.contains(&index);
            if is_shown {
                let (style, width) = theme::contestant_line(index);
                line_sample(ui, style, width, 1.0);
            }
            if ui.checkbox(&mut is_shown, contestant.name).on_hover_text(contestant.what).changed() {
                if is_shown {
                    page.shown.insert(index)
                } else {
                    page.shown.remove(&index)
                };
            }
            ui.add_space(theme::GAP);
        }
        measurements(ui, page);
        let what = "These curves with their ΔE and strips of colour, as .svg or .png";
        saving(ui, &[(SheetKind::Curves, "Save curves…")], what, actions);
    });
}

/// Whether other measurements are drawn: how far they are apart is the measure of every model's error.
fn measurements(ui: &mut Ui, page: &mut MetalsPage) {
    let others = other_measurements(page.metal).count();
    let what = match others {
        0 => "There is no other measurement of this material".to_owned(),
        1 => "The other measurement: the span between the two, and its ΔE to this one".to_owned(),
        _ => format!("{others} other measurements: the span of all, and their median ΔE to this one"),
    };
    let checkbox = Checkbox::new(&mut page.has_spread, MEASUREMENTS);
    ui.add_enabled(others > 0, checkbox).on_hover_text(&what).on_disabled_hover_text(&what);
    ui.add_space(theme::GAP);
}

fn lines(curves: &Curves) -> Vec<PlotLine<'_>> {
    let fitted = curves.fitted.iter().map(|fitted| {
        let (style, width) = theme::contestant_line(fitted.contestant);
        PlotLine { name: CONTESTANTS[fitted.contestant].name, curve: &fitted.curve, style, width, opacity: 0.9 }
    });
    let truth = PlotLine {
        name: "truth",
        curve: &curves.truth,
        style: egui_plot::LineStyle::Solid,
        width: theme::TRUTH_CURVE,
        opacity: 0.45,
    };
    std::iter::once(truth).chain(fitted).collect()
}

fn differences<'a>(ui: &Ui, curves: &'a Curves) -> Vec<DifferenceLine<'a>> {
    let palette = Palette::of(ui);
    let line = |fitted: &'a Fitted| DifferenceLine {
        name: CONTESTANTS[fitted.contestant].name,
        delta_e: &fitted.delta_e,
        colour: palette.models[fitted.contestant],
        style: theme::contestant_line(fitted.contestant).0,
    };
    let others = curves.spread.iter().map(|spread| DifferenceLine {
        name: MEASUREMENTS,
        delta_e: &spread.delta_e,
        colour: palette.guide,
        style: egui_plot::LineStyle::Solid,
    });
    others.chain(curves.fitted.iter().map(line)).collect()
}

/// What the other measurements of a material are called.
const MEASUREMENTS: &str = "measurements";

/// Mean and largest ΔE, and the one at the angle under the pointer.
fn numbers(ui: &mut Ui, curves: &Curves, cursor_deg: Option<f64>) {
    let palette = Palette::of(ui);
    Grid::new("errors").num_columns(5).spacing([theme::GROUP_GAP, 2.0]).show(ui, |ui| {
        for fitted in &curves.fitted {
            let contestant = &CONTESTANTS[fitted.contestant];
            ui.label(theme::number(contestant.name).color(palette.models[fitted.contestant]));
            ui.label(theme::number(format!("mean ΔE {:5.2}", fitted.mean)));
            ui.label(theme::number(format!("largest {:5.2}", fitted.max)));
            if let Some(deg) = cursor_deg {
                ui.label(theme::number(at(&fitted.delta_e, deg)));
            } else {
                ui.label("");
            }
            ui.add(Label::new(theme::hint(&fitted.losses)).truncate()).on_hover_text(&fitted.losses);
            ui.end_row();
        }
        if let Some(spread) = &curves.spread {
            numbers_of_spread(ui, spread, cursor_deg);
        }
    });
}

/// The same of other measurements.
fn numbers_of_spread(ui: &mut Ui, spread: &Spread, cursor_deg: Option<f64>) {
    // Every second point is a whole degree.
    let degrees = || spread.delta_e.iter().step_by(2);
    let mean = degrees().sum::<f64>() / degrees().count().max(1) as f64;
    let largest = degrees().copied().fold(0.0, f64::max);
    ui.label(theme::number(MEASUREMENTS).color(Palette::of(ui).guide));
    ui.label(theme::number(format!("mean ΔE {mean:5.2}")));
    ui.label(theme::number(format!("largest {largest:5.2}")));
    ui.label(theme::number(cursor_deg.map_or_else(String::new, |deg| at(&spread.delta_e, deg))));
    let words = if spread.others == 1 {
        "the other to this one".to_owned()
    } else {
        format!("median of {} others to this one", spread.others)
    };
    ui.label(theme::hint(words));
    ui.end_row();
}

/// The difference at the angle under the pointer.
fn at(delta_e: &[f64], deg: f64) -> String {
    let as_curve: Vec<_> = delta_e.iter().map(|&v| crate::color::Rgb::splat(v)).collect();
    format!("at {deg:4.1}° {:5.2}", at_angle(&as_curve, deg)[0])
}
