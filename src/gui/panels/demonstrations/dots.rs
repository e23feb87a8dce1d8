//! Values of all metals, one row of dots for each description.

use eframe::egui::{Color32, Pos2, Rect, Response, Sense, Stroke, Ui, WidgetInfo, accesskit::Role, pos2};

use super::{delta_e_text, row};
use crate::gui::theme;
use crate::study::Distribution;

/// One row.
pub(super) struct DotsRow<'a> {
    /// What the values are of.
    pub name: &'a str,
    /// The colour of the name and the dots.
    pub colour: Color32,
    /// Each value with the metal it is of.
    pub values: Vec<(&'a str, f64)>,
    /// The same in short.
    pub spread: &'a Distribution,
}

/// Rows over one axis that begins at 0.
pub(super) struct Dots<'a> {
    /// What the values are.
    pub caption: &'a str,
    /// From the top.
    pub rows: &'a [DotsRow<'a>],
}

const TALLEST_ROW: f32 = 118.0;

impl Dots<'_> {
    /// Shows the rows; gives the metal whose dot was clicked.
    pub(super) fn show(self, ui: &mut Ui, height: f32) -> Option<String> {
        row::caption(ui, self.caption);
        let values = self.rows.iter().flat_map(|row| &row.values).map(|(_, value)| *value);
        let top = values.filter(|value| value.is_finite()).fold(0.1, f64::max) * 1.04;
        let height = (height / self.rows.len().max(1) as f32 - theme::GAP).clamp(44.0, TALLEST_ROW);
        let mut clicked = None;
        for row in self.rows {
            clicked = clicked.or(row.show(ui, height, top));
        }
        let ticks: Vec<(f32, String)> =
            super::chart::marks(top).map(|value| ((value / top) as f32, delta_e_text(value))).collect();
        row::ticks(ui, &ticks);
        clicked
    }
}

impl DotsRow<'_> {
    fn show(&self, ui: &mut Ui, height: f32, top: f64) -> Option<String> {
        let (whole, _) = row::allocate(ui, height);
        let response = ui.interact(whole, ui.scope_id().with(("dots", self.name)), Sense::CLICK);
        let rect = whole.shrink2(eframe::egui::vec2(0.0, 3.0));
        ui.painter().rect_filled(rect, 0, theme::Palette::of(ui).canvas);
        let x = |value: f64| rect.left() + rect.width() * (value / top).clamp(0.0, 1.0) as f32;
        let box_of_quartiles =
            Rect::from_x_y_ranges(x(self.spread.lower_quartile)..=x(self.spread.upper_quartile), rect.y_range());
        ui.painter().rect_filled(box_of_quartiles, 0, self.colour.gamma_multiply(0.18));
        let dots = self.places(rect, x);
        for dot in &dots {
            ui.painter().circle_filled(*dot, theme::DOT, self.colour.gamma_multiply(0.8));
        }
        ui.painter().vline(x(self.spread.median), rect.y_range(), Stroke::new(2.0, self.colour));
        row::name(ui, rect, self.name, self.colour);
        let numbers = [
            format!("{} mean", delta_e_text(self.spread.mean)),
            format!("{} at worst", delta_e_text(self.spread.max)),
            if self.spread.max < 1e-6 { "exact".to_owned() } else { self.spread.worst.clone() },
        ];
        row::numbers(ui, rect, &numbers);
        let spoken = format!("{}: {}", self.name, numbers.join(", "));
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &spoken));
        self.under_pointer(ui, &response, &dots)
    }

    /// Neighbours in value are spread over the row by the golden ratio: even, and the same in every frame.
    fn places(&self, rect: Rect, x: impl Fn(f64) -> f32) -> Vec<Pos2> {
        let mut ranks: Vec<usize> = (0..self.values.len()).collect();
        ranks.sort_by(|&a, &b| self.values[a].1.total_cmp(&self.values[b].1));
        let mut places = vec![Pos2::ZERO; ranks.len()];
        for (rank, index) in ranks.into_iter().enumerate() {
            let offset = (rank as f32 * 0.618_034).fract() - 0.5;
            let room = rect.height() - 4.0 * theme::DOT;
            places[index] = pos2(x(self.values[index].1), rect.center().y + offset * room);
        }
        places
    }

    /// Names the dot under the pointer; gives its metal when it was clicked.
    fn under_pointer(&self, ui: &Ui, response: &Response, dots: &[Pos2]) -> Option<String> {
        let pointer = response.hover_pos()?;
        let index = nearest(dots, pointer)?;
        let (name, value) = self.values[index];
        let colour = ui.visuals().strong_text_color();
        ui.painter().circle_stroke(dots[index], theme::DOT + 2.0, Stroke::new(1.5, colour));
        let text = format!("{name}: {value:.3}\nClick to look at it alone");
        response.clone().on_hover_text_at_pointer(text).clicked().then(|| name.to_owned())
    }
}

/// The dot nearest to the pointer, if one is near.
pub(in crate::gui::panels) fn nearest(dots: &[Pos2], pointer: Pos2) -> Option<usize> {
    let distance = |index: &usize| dots[*index].distance(pointer);
    let nearest = (0..dots.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    (distance(&nearest) <= theme::DOT_REACH).then_some(nearest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dot_is_named_only_when_the_pointer_is_near() {
        let dots = [pos2(0.0, 0.0), pos2(10.0, 0.0)];
        assert_eq!(nearest(&dots, pos2(8.0, 1.0)), Some(1));
        assert_eq!(nearest(&dots, pos2(30.0, 0.0)), None);
        assert_eq!(nearest(&[], pos2(0.0, 0.0)), None);
    }
}
