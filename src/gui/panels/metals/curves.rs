//! The truth of a metal, models over it, and how far they are from it at each angle.

use eframe::egui::{Grid, Label, Ui};

use super::table::view_switch;
use crate::gui::metals::{CONTESTANTS, Curves, Fitted, MetalsPage};
use crate::gui::theme::{self, Palette};
use crate::gui::truth::at_angle;
use crate::gui::widgets::{CurvePlot, DifferenceLine, PlotLine, difference_plot, line_sample, strip};

const RANGE_DEG: std::ops::RangeInclusive<f64> = 0.0..=90.0;

/// Shows the curves.
pub(crate) fn show(ui: &mut Ui, page: &mut MetalsPage) {
    header(ui, page);
    chooser(ui, page);
    let (space, cursor) = (page.space, page.cursor_deg);
    let Some(curves) = page.curves(ui.ctx()).cloned() else {
        ui.label(theme::hint("Fitting models"));
        return;
    };
    let plot = CurvePlot {
        lines: &lines(&curves),
        band: None,
        handles: &[],
        range_deg: RANGE_DEG,
        cursor_deg: cursor,
        height: plot_height(ui, &curves),
    };
    let output = plot.show(ui);
    let mut cursor_deg = output.cursor_deg.or(strip(ui, output.frame, "truth", &curves.truth, space, &RANGE_DEG));
    for fitted in &curves.fitted {
        let name = CONTESTANTS[fitted.contestant].name;
        cursor_deg = cursor_deg.or(strip(ui, output.frame, name, &fitted.curve, space, &RANGE_DEG));
    }
    cursor_deg = cursor_deg.or(difference_plot(ui, &differences(ui, &curves), RANGE_DEG, cursor, DIFFERENCE_HEIGHT));
    numbers(ui, &curves, cursor_deg);
    if page.cursor_deg != cursor_deg {
        page.cursor_deg = cursor_deg;
        ui.ctx().request_repaint();
    }
}

const DIFFERENCE_HEIGHT: f32 = 128.0;

fn plot_height(ui: &Ui, curves: &Curves) -> f32 {
    let count = curves.fitted.len() as f32;
    let strips = (count + 1.0) * (theme::STRIP + theme::GAP);
    let numbers = (count + 1.0) * 18.0;
    (ui.available_height() - strips - DIFFERENCE_HEIGHT - numbers - theme::GROUP_GAP).max(140.0)
}

fn header(ui: &mut Ui, page: &mut MetalsPage) {
    ui.horizontal(|ui| {
        ui.heading(&page.metal.name);
        ui.label(theme::hint(format!("{} {}", page.metal.provenance.citation(), page.metal.dataset)));
        view_switch(ui, page);
    });
}

/// Which models are drawn, each with the look of its line.
fn chooser(ui: &mut Ui, page: &mut MetalsPage) {
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
    });
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
    curves.fitted.iter().map(line).collect()
}

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
                let as_curve: Vec<_> = fitted.delta_e.iter().map(|&v| crate::color::Rgb::splat(v)).collect();
                ui.label(theme::number(format!("at {deg:4.1}° {:5.2}", at_angle(&as_curve, deg)[0])));
            } else {
                ui.label("");
            }
            ui.add(Label::new(theme::hint(&fitted.losses)).truncate()).on_hover_text(&fitted.losses);
            ui.end_row();
        }
    });
}
