//! A number that can be typed, dragged, and stepped by the arrow keys.

use std::ops::RangeInclusive;

use eframe::egui::{DragValue, Response, Ui, Vec2};

use crate::gui::theme;

/// A field for one number; shows some decimals, keeps all of them.
pub(crate) struct NumberField<'a> {
    value: &'a mut f64,
    name: String,
    decimals: usize,
    speed: f64,
    range: RangeInclusive<f64>,
    width: f32,
    suffix: &'static str,
}

impl<'a> NumberField<'a> {
    /// A field whose accessible name says what the number is and in which space.
    pub(crate) fn new(value: &'a mut f64, name: impl Into<String>) -> Self {
        Self {
            value,
            name: name.into(),
            decimals: 4,
            speed: 0.002,
            range: f64::MIN..=f64::MAX,
            width: 60.0,
            suffix: "",
        }
    }

    /// How many decimals are shown, and what one point of dragging changes.
    pub(crate) fn precision(self, decimals: usize, speed: f64) -> Self {
        Self { decimals, speed, ..self }
    }

    /// The numbers that mean something; typing beyond them ends at the limit.
    pub(crate) fn range(self, range: RangeInclusive<f64>) -> Self {
        Self { range, ..self }
    }

    /// Width in points.
    pub(crate) fn width(self, width: f32) -> Self {
        Self { width, ..self }
    }

    /// A unit behind the number.
    pub(crate) fn suffix(self, suffix: &'static str) -> Self {
        Self { suffix, ..self }
    }

    /// Shows it; `changed` on the response says whether the number is another one.
    pub(crate) fn show(self, ui: &mut Ui) -> Response {
        let Self { value, name, decimals, speed, range, width, suffix } = self;
        let before = *value;
        let rounded = shown(before, decimals);
        // Leaving the field sets the number it shows, which would round away what it does not show.
        let get_set = |new: Option<f64>| {
            if let Some(new) = new.filter(|new| new.is_finite() && rounded.parse() != Ok(*new)) {
                *value = new;
            }
            *value
        };
        let field = DragValue::from_get_set(get_set)
            .speed(speed)
            .range(range)
            .clamp_existing_to_range(false)
            .update_while_editing(false)
            .custom_formatter(move |v, _| shown(v, decimals))
            .suffix(suffix)
            .min_size(Vec2::new(width, theme::ROW));
        ui.add_sized(Vec2::new(width, theme::ROW), field).on_hover_text(&name).accessible_name(name)
    }
}

fn shown(value: f64, decimals: usize) -> String {
    format!("{value:.decimals$}")
}
