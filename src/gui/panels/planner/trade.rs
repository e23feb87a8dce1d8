//! Every variant by its cost and its error.

use eframe::egui::{
    Align2, Color32, CornerRadius, FontId, Label, Painter, Pos2, ProgressBar, Rect, Sense, Shape, Stroke, StrokeKind,
    Ui, Vec2, WidgetInfo, accesskit::Role, pos2, vec2,
};

use crate::gui::panels::demonstrations::{row, sentence};
use crate::gui::planner::{Chart, ChartPoint};
use crate::gui::state::State;
use crate::gui::theme::{self, Palette};

/// Room below the chart for its ticks and the name of its axis.
const BELOW: f32 = 40.0;

/// Shows the chart.
pub(super) fn show(ui: &mut Ui, state: &mut State) {
    let State { planner: page, document, library, .. } = state;
    match page.follow_chart(ui.ctx(), &document.preset, library.shelf()) {
        Some(Ok(chart)) => {
            sentence(ui, &chart.summary, page.trading.remarks());
            draw(ui, &chart);
        }
        Some(Err(error)) => {
            ui.add(Label::new(theme::sentence(error).color(Palette::of(ui).error)).wrap());
        }
        None => {
            ui.label(theme::hint("Measuring every model"));
            ui.add(ProgressBar::new(page.trading.progress().unwrap_or(0.0)).desired_width(theme::DIALOG_WIDTH));
        }
    }
}

/// Places on two axes of equal factors.
struct Axes {
    rect: Rect,
    /// Logarithms of the ends.
    x: [f64; 2],
    y: [f64; 2],
}

impl Axes {
    fn of(rect: Rect, points: &[ChartPoint]) -> Self {
        let range = |value: fn(&ChartPoint) -> f64| {
            let logarithms = points.iter().map(|point| value(point).log10());
            let (low, high) = logarithms.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
            if low <= high { [low - 0.2, high + 0.2] } else { [0.0, 1.0] }
        };
        Self { rect, x: range(|point| point.x), y: range(|point| point.y) }
    }

    fn x_at(&self, value: f64) -> f32 {
        self.rect.left() + self.rect.width() * share(value, self.x)
    }

    fn y_at(&self, value: f64) -> f32 {
        self.rect.bottom() - self.rect.height() * share(value, self.y)
    }

    fn at(&self, point: &ChartPoint) -> Pos2 {
        pos2(self.x_at(point.x), self.y_at(point.y))
    }
}

fn share(value: f64, [low, high]: [f64; 2]) -> f32 {
    ((value.log10() - low) / (high - low)) as f32
}

fn draw(ui: &mut Ui, chart: &Chart) {
    ui.label(theme::hint(&chart.figure.subtitle));
    key(ui, chart);
    let size = vec2(ui.available_width(), (ui.available_height() - theme::GAP).max(200.0));
    let (whole, response) = ui.allocate_exact_size(size, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &chart.figure.title));
    let rect = Rect::from_min_max(whole.min + vec2(theme::AXIS_WIDTH + 14.0, 4.0), whole.max - vec2(2.0, BELOW));
    let axes = Axes::of(rect, &chart.points);
    ui.painter().rect_filled(rect, CornerRadius::ZERO, Palette::of(ui).canvas);
    grid(ui, &axes, chart);
    let front: Vec<Pos2> =
        chart.figure.front_steps().into_iter().map(|(cost, error)| pos2(axes.x_at(cost), axes.y_at(error))).collect();
    ui.painter().add(Shape::line(front.clone(), Stroke::new(1.5, Palette::of(ui).guide)));
    let dots: Vec<Pos2> = chart.points.iter().map(|point| axes.at(point)).collect();
    for (dot, point) in dots.iter().zip(&chart.points) {
        let radius = if point.is_on_front { theme::DOT + 1.5 } else { theme::DOT };
        ui.painter().circle_filled(*dot, radius + 1.2, Palette::of(ui).canvas);
        ui.painter().circle_filled(*dot, radius, ink(ui, point.series));
    }
    names(ui, rect, &dots, &front, &chart.points);
    for (index, (dot, point)) in dots.iter().zip(&chart.points).enumerate() {
        let place = Rect::from_center_size(*dot, Vec2::splat(2.0 * theme::DOT_REACH));
        let response = ui.interact(place, ui.scope_id().with(("variant", index)), Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &point.words));
        if response.hovered() {
            let colour = ui.visuals().strong_text_color();
            ui.painter().circle_stroke(*dot, theme::DOT + 3.5, Stroke::new(1.5, colour));
        }
        response.on_hover_text(point.words.replace(", ", "\n").replacen(": ", "\n", 1));
    }
}

fn ink(ui: &Ui, series: usize) -> Color32 {
    let models = Palette::of(ui).models;
    // One colour for each family, far apart.
    models[[0, 1, 3, 5][series % 4]]
}

fn key(ui: &mut Ui, chart: &Chart) {
    ui.horizontal_wrapped(|ui| {
        for (series, name) in chart.figure.series.iter().enumerate() {
            let (place, _) = ui.allocate_exact_size(Vec2::splat(10.0), Sense::hover());
            ui.painter().circle_filled(place.center(), theme::DOT + 1.0, ink(ui, series));
            ui.label(theme::hint(name));
            ui.add_space(theme::GAP);
        }
        let (place, _) = ui.allocate_exact_size(crate::gui::widgets::SAMPLE, Sense::hover());
        ui.painter().hline(place.x_range(), place.center().y, Stroke::new(1.5, Palette::of(ui).guide));
        ui.label(theme::hint(&chart.figure.front_name));
    });
}

fn grid(ui: &Ui, axes: &Axes, chart: &Chart) {
    let (stroke, weak) = (Stroke::new(1.0, Palette::of(ui).grid), ui.visuals().weak_text_color());
    let rect = axes.rect;
    for value in marks(axes.x) {
        let x = axes.x_at(value);
        ui.painter().vline(x, rect.y_range(), stroke);
        let at = pos2(x, rect.bottom() + 4.0);
        ui.painter().text(at, Align2::CENTER_TOP, format!("{value}"), row::small(ui), weak);
    }
    for value in marks(axes.y) {
        let y = axes.y_at(value);
        ui.painter().hline(rect.x_range(), y, stroke);
        let at = pos2(rect.left() - theme::GAP, y);
        ui.painter().text(at, Align2::RIGHT_CENTER, format!("{value}"), row::small(ui), weak);
    }
    ui.painter().rect_stroke(rect, 0, ui.visuals().window_stroke(), StrokeKind::Outside);
    let below = pos2(rect.center().x, rect.bottom() + 20.0);
    ui.painter().text(below, Align2::CENTER_TOP, &chart.figure.x_name, row::small(ui), weak);
    let inside = rect.right_top() + vec2(-8.0, 6.0);
    ui.painter().text(inside, Align2::RIGHT_TOP, &chart.figure.y_name, row::small(ui), weak);
}

/// 1, 2 and 5 of each decade, or the decades alone where they are many.
fn marks([low, high]: [f64; 2]) -> Vec<f64> {
    let factors: &[i32] = if high - low > 3.0 { &[1] } else { &[1, 2, 5] };
    let decades = low.floor() as i32..=high.ceil() as i32;
    let all = decades.flat_map(|decade| factors.iter().map(move |factor| power(*factor, decade)));
    all.filter(|value| (low..=high).contains(&value.log10())).collect()
}

/// A factor of a power of ten, as near as it can be: 10⁻³ from 10³.
fn power(factor: i32, decade: i32) -> f64 {
    let factor = f64::from(factor);
    if decade < 0 { factor / 10_f64.powi(-decade) } else { factor * 10_f64.powi(decade) }
}

/// Names beside the points of the front first, then beside others, where there is room.
fn names(ui: &Ui, rect: Rect, dots: &[Pos2], front: &[Pos2], points: &[ChartPoint]) {
    let around_dots = dots.iter().map(|dot| Rect::from_center_size(*dot, Vec2::splat(2.0 * theme::DOT + 2.0)));
    let around_front = front.windows(2).map(|ends| Rect::from_two_pos(ends[0], ends[1]).expand(1.0));
    let mut taken: Vec<Rect> = around_dots.chain(around_front).collect();
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_key(|&index| !points[index].is_on_front);
    for index in order {
        let point = &points[index];
        let colour = if point.is_on_front { ui.visuals().strong_text_color() } else { ui.visuals().weak_text_color() };
        if let Some(place) =
            name(ui.painter(), rect, (dots[index], point.short.as_str()), (row::small(ui), colour), &taken)
        {
            taken.push(place);
        }
    }
}

/// Writes a name where it covers nothing; gives its place.
fn name(
    painter: &Painter,
    rect: Rect,
    (dot, text): (Pos2, &str),
    (font, colour): (FontId, Color32),
    taken: &[Rect],
) -> Option<Rect> {
    const AWAY: f32 = 7.0;
    let galley = painter.layout_no_wrap(text.to_owned(), font, colour);
    let anchors = [
        (Align2::LEFT_CENTER, vec2(AWAY, 0.0)),
        (Align2::LEFT_BOTTOM, vec2(AWAY - 2.0, -3.0)),
        (Align2::LEFT_TOP, vec2(AWAY - 2.0, 3.0)),
        (Align2::CENTER_BOTTOM, vec2(0.0, -AWAY)),
        (Align2::CENTER_TOP, vec2(0.0, AWAY)),
        (Align2::RIGHT_CENTER, vec2(-AWAY, 0.0)),
        (Align2::RIGHT_BOTTOM, vec2(2.0 - AWAY, -3.0)),
        (Align2::RIGHT_TOP, vec2(2.0 - AWAY, 3.0)),
    ];
    let places = anchors.map(|(align, offset)| align.anchor_size(dot + offset, galley.size()));
    let is_free = |place: &Rect| rect.shrink(2.0).contains_rect(*place) && !taken.iter().any(|t| t.intersects(*place));
    let place = places.into_iter().find(is_free)?;
    painter.galley(place.min, galley, colour);
    Some(place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_within_the_axis_and_not_many() {
        for (range, expected) in [
            ([0.4, 1.4], vec![5.0, 10.0, 20.0]),
            ([-2.1, 0.1], vec![0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0]),
            ([-3.2, 1.1], vec![0.001, 0.01, 0.1, 1.0, 10.0]),
        ] {
            assert_eq!(marks(range), expected);
        }
    }
}
