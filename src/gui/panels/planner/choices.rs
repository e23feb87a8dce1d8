//! The column of choices: where materials are seen and what is allowed, or what the chart is of; and files.

use eframe::egui::{Button, ComboBox, Label, ProgressBar, RichText, Slider, SliderClamping, TextEdit, Ui, Vec2};

use super::path_field;
use crate::color::RgbSpace;
use crate::export::Target;
use crate::figure::FigureFormat;
use crate::gui::command::Action;
use crate::gui::planner::{Apart, DataFormat, PlanAction, PlanFile, PlannerPage, PlannerView, TradeOf};
use crate::gui::state::State;
use crate::gui::theme::{self, Palette};
use crate::gui::warnings::capitalised;
use crate::gui::widgets::{NumberField, row_label};
use crate::scene::{Plan, Target as Spared};
use crate::study::{CostAxis, Measure};

/// The tolerances that the slider reaches; any other can be typed.
const TOLERANCES: std::ops::RangeInclusive<f64> = 0.02..=10.0;

/// Shows the column.
pub(super) fn show(ui: &mut Ui, state: &mut State, actions: &mut Vec<Action>) {
    let page = &mut state.planner;
    match page.view {
        PlannerView::Plan => {
            of_file(ui, page);
            if !page.is_fixed() {
                ui.label(theme::title("Where materials are seen"));
                seen(ui, page, actions);
                ui.add_space(theme::GROUP_GAP);
                ui.label(theme::title("What is allowed"));
                allowed(ui, page);
            }
        }
        PlannerView::Trade => {
            ui.label(theme::title("What it is of"));
            traded(ui, page, actions);
        }
    }
    ui.add_space(theme::GROUP_GAP);
    files(ui, page, actions);
}

/// A plan that was opened says what it was made for, and what has become of it.
fn of_file(ui: &mut Ui, page: &mut PlannerPage) {
    let Some(opened) = page.opened() else { return };
    let is_as_saved = page.as_saved().is_some();
    ui.label(theme::title("A saved plan"));
    let name = opened.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    ui.add(Label::new(name).truncate()).on_hover_text(opened.path.display().to_string());
    let become_of_it = match is_as_saved {
        true => "It is shown as it was saved",
        false => "It was changed, and is planned again",
    };
    ui.add(Label::new(theme::hint(format!("{} {become_of_it}.", made_for(&opened.planned.plan)))).wrap());
    let why_fixed = opened.why_fixed().map(ToString::to_string);
    for remark in why_fixed.iter().chain(&opened.remarks) {
        let warning = Palette::of(ui).warning;
        ui.add(Label::new(theme::hint(format!("▲ {}", capitalised(remark))).color(warning)).wrap());
    }
    ui.horizontal(|ui| {
        let back = ui.button("Back to the scene").on_hover_text("Plan for what was in the list before it was opened");
        let was = ui.add_enabled(!is_as_saved, Button::new("As it was saved"));
        if back.clicked() {
            page.close_opened();
        } else if was.on_hover_text("Take back what was changed since it was opened").clicked() {
            page.revert_opened();
        }
    });
    ui.add_space(theme::GROUP_GAP);
}

fn made_for(plan: &Plan) -> String {
    format!(
        "Made for a {} of at most {}, sparing {}, in {}.",
        plan.tolerance.on.label(),
        plan.tolerance.delta_e,
        spared(plan.target),
        plan.space.label()
    )
}

const fn spared(target: Spared) -> &'static str {
    match target {
        Spared::RealTime => "shader operations",
        Spared::Offline => "time",
        Spared::TextureMemory => "bytes",
    }
}

fn seen(ui: &mut Ui, page: &mut PlannerPage, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.selectable_value(&mut page.scene.has_pass, false, "Simple shapes")
            .on_hover_text("A sphere, a cylinder, a card or a floor for each material");
        ui.selectable_value(&mut page.scene.has_pass, true, "Rendered pass")
            .on_hover_text("A facing-ratio pass of the scene: the cosine between normal and view");
    });
    if !page.scene.has_pass {
        if page.scene.is_as_saved_somewhere() {
            let saved = "As saved are the angles in the plan's file; Rendered pass reads the pictures again";
            ui.add(Label::new(theme::hint(saved)).wrap());
        }
        return;
    }
    path_field(ui, &mut page.scene.pass, "the facing-ratio pass", PlanFile::Pass, actions);
    ui.horizontal(|ui| {
        row_label(ui, "Channel");
        let channel = TextEdit::singleline(&mut page.scene.channel).desired_width(ui.available_width());
        ui.add(channel.hint_text("the likeliest")).accessible_name("Channel of the pass");
    });
    ui.horizontal(|ui| {
        row_label(ui, "Told apart by");
        combo(
            ui,
            "How the materials of the pass are told apart",
            &mut page.scene.apart,
            &Apart::ALL.map(|(a, name, _)| (a, name)),
        );
    });
    if page.scene.apart == Apart::Ids {
        path_field(ui, &mut page.scene.ids, "the picture of ids", PlanFile::Ids, actions);
    }
    if page.scene.pass.path().is_some()
        && ui.button("Read again").on_hover_text("Read the pictures again, where they have changed").clicked()
    {
        page.read_again();
    }
}

fn allowed(ui: &mut Ui, page: &mut PlannerPage) {
    ui.horizontal(|ui| {
        row_label(ui, "ΔE2000 up to");
        let tolerance = &mut page.scene.tolerance.delta_e;
        ui.spacing_mut().slider_width = ui.available_width() - 60.0 - 2.0 * theme::GAP;
        let slider = Slider::new(tolerance, TOLERANCES).logarithmic(true).show_value(false);
        let slider = slider.clamping(SliderClamping::Never);
        ui.add(slider).on_hover_text("How far from the truth a material may be").accessible_name("Tolerance");
        let field = NumberField::new(&mut page.scene.tolerance.delta_e, "Tolerance, number");
        field.precision(2, 0.01).range(0.0..=100.0).show(ui);
    });
    ui.horizontal(|ui| {
        row_label(ui, "of its");
        for (measure, name, what) in MEASURES {
            ui.selectable_value(&mut page.scene.tolerance.on, measure, name).on_hover_text(what);
        }
    });
    ui.horizontal(|ui| {
        row_label(ui, "Spare");
        let before = page.scene.target;
        combo(ui, "What is spared", &mut page.scene.target, &Spared::ALL.map(|target| (target, target.label())));
        let has_times = page.costs().has_times() || page.times_progress().is_some();
        if page.scene.target != before && page.scene.target == Spared::Offline && !has_times {
            page.measure_times(ui.ctx());
        }
    });
    space(ui, page);
    if page.scene.target == Spared::Offline {
        times(ui, page, ", so that operations are compared");
    }
}

/// What is known of times, what follows where nothing is, and a way to know more.
fn times(ui: &mut Ui, page: &mut PlannerPage, otherwise: &str) {
    if let Some(share) = page.times_progress() {
        ui.add(ProgressBar::new(share).text("Measuring"));
        return;
    }
    let words = match page.costs().has_times() {
        true => "Times were measured on this machine".to_owned(),
        false => format!("No times were measured on this machine{otherwise}"),
    };
    ui.add(Label::new(theme::hint(words)).wrap());
    let what = "Measure what every variant takes on this machine, which takes a moment";
    let name = if page.costs().has_times() { "Measure again" } else { "Measure times" };
    if ui.button(name).on_hover_text(what).clicked() {
        page.measure_times(ui.ctx());
    }
}

/// The numbers that can be bounded, with short names.
const MEASURES: [(Measure, &str, &str); 3] = [
    (Measure::Max, "Largest", "At no angle that is seen"),
    (Measure::P95, "95 %", "Within it for 95 % of what is seen"),
    (Measure::Mean, "Mean", "On average over what is seen"),
];

fn space(ui: &mut Ui, page: &mut PlannerPage) {
    ui.horizontal(|ui| {
        row_label(ui, "Space");
        let name = "Space of parameters and differences";
        combo(ui, name, &mut page.scene.space, &RgbSpace::ALL.map(|space| (space, space.label())));
    });
}

fn traded(ui: &mut Ui, page: &mut PlannerPage, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        row_label(ui, "Materials");
        combo(ui, "What the chart is of", &mut page.trading.of, &TradeOf::ALL);
    });
    if page.trading.of == TradeOf::Folder {
        let folder = "The presets of the folder that is open on the page Library";
        ui.add(Label::new(theme::hint(folder)).wrap());
    }
    if page.trading.of == TradeOf::Metal {
        ui.horizontal(|ui| {
            row_label(ui, "Metal");
            let name = &page.trading.metal.name;
            let button = Button::new(format!("{name} ▾")).truncate();
            let button = ui.add(button.min_size(Vec2::new(ui.available_width(), theme::ROW)));
            if button.accessible_name(format!("Metal of the chart: {name}")).clicked() {
                actions.push(Action::Plan(PlanAction::FindTradeMetal));
            }
        });
    }
    ui.add_space(theme::GROUP_GAP);
    ui.label(theme::title("Axes"));
    ui.horizontal_top(|ui| {
        row_label(ui, "Cost");
        ui.vertical(|ui| {
            for (axis, name) in COSTS {
                let has_values = axis != CostAxis::MeasuredNs || page.costs().has_times();
                let button = Button::selectable(page.trading.cost == axis, name);
                let button = ui.add_enabled(has_values, button).on_hover_text(axis.label());
                if button.on_disabled_hover_text("No times were measured on this machine").clicked() {
                    page.trading.cost = axis;
                }
            }
        });
    });
    ui.horizontal(|ui| {
        row_label(ui, "ΔE2000");
        for (measure, name, _) in MEASURES {
            ui.selectable_value(&mut page.trading.measure, measure, name).on_hover_text(measure.label());
        }
    });
    space(ui, page);
    times(ui, page, "");
}

/// The costs, with short names.
const COSTS: [(CostAxis, &str); 3] = [
    (CostAxis::ShaderOperations, "Shader operations"),
    (CostAxis::ParameterBytes, "Parameter bytes"),
    (CostAxis::MeasuredNs, "Measured time"),
];

fn combo<T: Copy + PartialEq>(ui: &mut Ui, what: &str, value: &mut T, choices: &[(T, &str)]) {
    let selected = choices.iter().find(|(choice, _)| choice == value).map_or("", |(_, name)| name);
    let response = ComboBox::from_id_salt(what)
        .width(ui.available_width())
        .selected_text(selected)
        .truncate()
        .show_ui(ui, |ui| {
            for &(choice, name) in choices {
                ui.selectable_value(value, choice, name);
            }
        })
        .response;
    response.on_hover_text(what).accessible_name(what);
}

fn files(ui: &mut Ui, page: &mut PlannerPage, actions: &mut Vec<Action>) {
    ui.label(theme::title("Files"));
    match page.view {
        PlannerView::Plan => {
            ui.horizontal(|ui| {
                file(
                    ui,
                    page,
                    (
                        PlanFile::Save,
                        "Save plan…",
                        "The plan as JSON, to be opened again or for edgewise export --plan",
                    ),
                    actions,
                );
                file(ui, page, (PlanFile::Open, "Open plan…", "Look at a plan that was saved, and change it"), actions);
            });
            export(ui, page, actions);
        }
        PlannerView::Trade => {
            ui.horizontal(|ui| {
                for format in FigureFormat::ALL {
                    let name = format!("{}…", format.extension().to_uppercase());
                    file(ui, page, (PlanFile::Chart(format), name.as_str(), "Save the chart"), actions);
                }
                for format in DataFormat::ALL {
                    let name = format!("{}…", format.extension().to_uppercase());
                    let what = "Save the numbers of every variant";
                    file(ui, page, (PlanFile::ChartData(format), name.as_str(), what), actions);
                }
            });
        }
    }
    match &page.said {
        Some(Ok(sentence)) => _ = ui.add(Label::new(theme::hint(sentence)).wrap()),
        Some(Err(sentence)) => {
            let error = Palette::of(ui).error;
            ui.add(Label::new(RichText::new(sentence).small().color(error)).wrap());
        }
        None => {}
    }
}

/// The materials as files of another program, without the h that the scene does not need.
fn export(ui: &mut Ui, page: &mut PlannerPage, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let room = ui.available_width() - EXPORT_BUTTON;
        ui.allocate_ui(Vec2::new(room, theme::ROW), |ui| {
            let targets: Vec<(Target, &str)> =
                Target::ALL.into_iter().filter(|target| !target.is_palette()).map(|t| (t, t.label())).collect();
            combo(ui, "Whose files the materials are exported to", &mut page.export_to, &targets);
        });
        let what = "Write each material into a folder; what is seen without needing h has none";
        file(ui, page, (PlanFile::Export(page.export_to), "Export…", what), actions);
    });
}

/// Room for the button beside the targets.
const EXPORT_BUTTON: f32 = 72.0;

fn file(ui: &mut Ui, page: &PlannerPage, (file, name, what): (PlanFile, &str, &str), actions: &mut Vec<Action>) {
    if ui.add_enabled(page.has(file), Button::new(name)).on_hover_text(what).clicked() {
        actions.push(Action::Plan(PlanAction::Choose(file)));
    }
}
