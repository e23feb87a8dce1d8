//! Equal steps of a slider.

use eframe::egui::{
    Align2, Color32, Mesh, Rect, Sense, Stroke, StrokeKind, Ui, WidgetInfo, accesskit::Role, pos2, vec2,
};

use super::{row, sentence};
use crate::color::{Rgb, RgbSpace};
use crate::gui::demonstrations::{Band, Open, R_RANGE, ShownUniformity};
use crate::gui::state::State;
use crate::gui::theme::{self, Palette};
use crate::gui::widgets::{NumberField, VALUE_WIDTH, colour_slider, colour32, row_label};
use crate::study::{Reach, Slider, SliderSweep};

const COLUMN_GAP: f32 = 28.0;
const SHOWN: [Reach; 2] = [Reach::Reachable, Reach::Full];
/// Height of a row without its bars.
const BELOW_BARS: f32 = 22.0 + 18.0 + 16.0;
/// Room for the names of the sliders.
const NAMES: f32 = 104.0;

/// Shows the sliders.
pub(super) fn show(ui: &mut Ui, state: &mut State) {
    let open = Open { preset: &state.document.preset, metal: state.view.metal };
    let page = &mut state.demonstrations;
    let mut r = page.slider_r(open);
    let before = r;
    if let Some(shown) = page.uniformity(ui.ctx(), open) {
        sentence(ui, &shown.sentence, &[]);
        choose_r(ui, &mut r);
        ui.add_space(theme::GAP);
        captions(ui);
        let height = (ui.available_height() / Slider::ALL.len() as f32 - BELOW_BARS - theme::GAP).clamp(34.0, 72.0);
        for slider in Slider::ALL {
            steps(ui, shown, slider, height);
        }
    } else {
        ui.label(theme::hint("Measuring"));
    }
    if r != before {
        page.r = Some(r);
    }
}

fn choose_r(ui: &mut Ui, r: &mut f64) {
    ui.horizontal(|ui| {
        row_label(ui, "Grey metal, r");
        let grey = |r: f64| colour32(Rgb::splat(r), RgbSpace::LinRec709).0;
        colour_slider(ui, r, R_RANGE, "r of the grey metal", theme::DIALOG_WIDTH, grey);
        let field = NumberField::new(r, "r of the grey metal, number").precision(3, 0.002).range(R_RANGE);
        field.width(VALUE_WIDTH).show(ui);
    });
}

/// The two columns right of the names.
fn columns(whole: Rect) -> [Rect; 2] {
    let width = (whole.width() - NAMES - COLUMN_GAP) / 2.0;
    [0.0, 1.0].map(|index| {
        let left = whole.left() + NAMES + (width + COLUMN_GAP) * index;
        Rect::from_x_y_ranges(left..=left + width, whole.y_range())
    })
}

fn captions(ui: &mut Ui) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 16.0), Sense::hover());
    let texts = ["Over the appearances that g can reach", "Over the whole slider, 0 to 1"];
    for (column, text) in columns(rect).into_iter().zip(texts) {
        let colour = ui.visuals().strong_text_color();
        ui.painter().text(column.left_center(), Align2::LEFT_CENTER, text, row::body(ui), colour);
    }
}

fn steps(ui: &mut Ui, shown: &ShownUniformity, slider: Slider, height: f32) {
    let size = vec2(ui.available_width(), height + BELOW_BARS);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let mut spoken = vec![slider.label().to_owned()];
    for (column, reach) in columns(rect).into_iter().zip(SHOWN) {
        let sweep = shown.sweeps.iter().find(|(sweep, _)| (sweep.slider, sweep.reach) == (slider, reach));
        let Some((sweep, band)) = sweep else { continue };
        let bars = Rect::from_min_size(column.min, vec2(column.width(), height));
        paint_bars(ui, bars, sweep, most(shown, reach));
        swatches(ui, Rect::from_min_size(bars.left_bottom() + vec2(0.0, 3.0), vec2(bars.width(), 18.0)), band);
        let text = words(sweep);
        let at = bars.left_bottom() + vec2(0.0, 25.0);
        ui.painter().text(at, Align2::LEFT_TOP, &text, row::small(ui), ui.visuals().weak_text_color());
        spoken.push(text);
    }
    names(ui, rect, slider, height);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, spoken.join("; ")));
}

fn names(ui: &Ui, rect: Rect, slider: Slider, height: f32) {
    let (name, encoding) = slider.label().split_once(", ").unwrap_or((slider.label(), ""));
    let at = |line: f32| pos2(rect.left() + NAMES - 2.0 * theme::GAP, rect.top() + height - 8.0 + 14.0 * line);
    let colour = bar_colour(ui, slider);
    ui.painter().text(at(0.0), Align2::RIGHT_CENTER, name, row::body(ui), colour);
    let weak = ui.visuals().weak_text_color();
    ui.painter().text(at(1.0), Align2::RIGHT_CENTER, encoding, row::small(ui), weak);
    if slider == Slider::OURS {
        ui.painter().text(at(2.0), Align2::RIGHT_CENTER, "our slider", row::small(ui), weak);
    }
}

/// The tallest bar of a column.
fn most(shown: &ShownUniformity, reach: Reach) -> f64 {
    let sweeps = shown.sweeps.iter().filter(|(sweep, _)| sweep.reach == reach);
    sweeps.flat_map(|(sweep, _)| sweep.delta_e.iter().copied()).fold(1e-9, f64::max)
}

fn bar_colour(ui: &Ui, slider: Slider) -> Color32 {
    Palette::of(ui).models[if slider == Slider::G { 2 } else { 0 }]
}

fn paint_bars(ui: &Ui, rect: Rect, sweep: &SliderSweep, most: f64) {
    let mut mesh = Mesh::default();
    let step = rect.width() / sweep.delta_e.len().max(1) as f32;
    let colour = bar_colour(ui, sweep.slider);
    for (index, delta_e) in sweep.delta_e.iter().enumerate() {
        let height = rect.height() * (delta_e / most) as f32;
        let left = rect.left() + step * (index as f32 + 0.12);
        let bar = Rect::from_x_y_ranges(left..=left + 0.76 * step, rect.bottom() - height..=rect.bottom());
        mesh.add_colored_rect(bar, colour);
    }
    ui.painter().add(mesh);
    ui.painter().hline(rect.x_range(), rect.bottom(), Stroke::new(1.0, Palette::of(ui).guide));
}

fn swatches(ui: &Ui, rect: Rect, band: &Band) {
    row::paint(ui, rect, band, true);
    ui.painter().rect_stroke(rect, 0, ui.visuals().window_stroke(), StrokeKind::Outside);
}

fn words(sweep: &SliderSweep) -> String {
    let row = sweep.row();
    format!(
        "variation {:.2}, half of the change on {:.0} %, {:.1}–{:.1} ΔE a step (max/min {:.1})",
        row.variation,
        100.0 * row.share_of_half,
        row.max_delta_e / row.max_over_min,
        row.max_delta_e,
        row.max_over_min
    )
}
