//! Bars: one number for each of a list of things.

use super::axis::{Axis, rounded_out};
use super::drawing::{Align, Drawing, Label};
use super::output::Figure;
use super::page::{Frame, HEADING, MARGIN, Page, TO_BASELINE};
use super::style::{FigureTheme, Ink, em};
use super::text::{Weight, fitted, text_width};

/// Horizontal bars from 0, their values at their ends.
#[derive(Clone, Debug, PartialEq)]
pub struct BarFigure {
    /// What is measured.
    pub title: String,
    /// Space, convention, what a reader must know.
    pub subtitle: String,
    /// The name of a value, with its unit.
    pub value_name: String,
    /// The bars, from the top.
    pub bars: Vec<Bar>,
    /// Digits after the point.
    pub decimals: usize,
}

/// One bar of a [`BarFigure`].
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Its name.
    pub label: String,
    /// Its length, at least 0.
    pub value: f64,
    /// The series it belongs to: bars of one series share a colour.
    pub series: usize,
    /// A colour beside the name, as 8-bit sRGB.
    pub swatch: Option<[u8; 3]>,
}

const ROW: f64 = 24.0;
const BAR: f64 = 15.0;
const PANEL: f64 = 520.0;
const SWATCH: f64 = 15.0;
const LONGEST_NAME: f64 = 260.0;

impl Figure for BarFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let names = self.bars.iter().map(|bar| text_width(&bar.label, Weight::Regular, em::LABEL)).fold(60.0, f64::max);
        let left = MARGIN + names.min(LONGEST_NAME) + 10.0 + SWATCH + 10.0;
        let top = HEADING + 10.0;
        let bottom = top + ROW * self.bars.len().max(1) as f64;
        let size = (left + PANEL + 64.0, bottom + 56.0);
        let mut page = Page::new((&self.title, &self.subtitle), size, MARGIN, theme);
        let highest = self.bars.iter().map(|bar| bar.value).filter(|v| v.is_finite()).fold(0.0, f64::max);
        let x = Axis::new((0.0, *rounded_out(0.0..=highest.max(1e-6), 6).end()), (left, left + PANEL));
        // A frame without values at the left: the names stand there.
        let y = Axis::new((0.0, 1.0), (bottom, top));
        let frame = Frame { x, y, x_name: self.value_name.clone(), y_name: String::new() };
        page.vertical_grid(&frame);
        for (index, bar) in self.bars.iter().enumerate() {
            self.bar(&mut page, bar, x, top + ROW * (index as f64 + 0.5));
        }
        page.drawing
    }
}

impl BarFigure {
    fn bar(&self, page: &mut Page, bar: &Bar, x: Axis, middle: f64) {
        let left = x.places.0;
        let ink = page.palette.models[bar.series % page.palette.models.len()];
        if let Some(code) = bar.swatch {
            page.drawing.fill(left - 10.0 - SWATCH, middle - SWATCH / 2.0, SWATCH, SWATCH, Ink::opaque(code));
        }
        let name = fitted(&bar.label, Weight::Regular, em::LABEL, LONGEST_NAME);
        page.name(name, left - 20.0 - SWATCH, middle, Align::Right);
        let end = if bar.value.is_finite() { x.at(bar.value.max(0.0)) } else { left };
        page.drawing.fill(left, middle - BAR / 2.0, end - left, BAR, ink);
        let text = if bar.value.is_finite() { format!("{:.*}", self.decimals, bar.value) } else { "–".to_owned() };
        // On a patch of the ground, so that no grid line runs through the number.
        let label = Label::new(text, end + 6.0, middle + TO_BASELINE, em::SMALL, page.palette.muted);
        let [text_left, text_top, right, bottom] = label.bounds();
        page.drawing.fill(text_left - 1.0, text_top, right - text_left + 2.0, bottom - text_top, page.palette.ground);
        page.drawing.text(label);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::check::assert_texts_are_legible;
    use crate::figure::drawing::Shape;

    fn figure(values: &[f64]) -> BarFigure {
        let bar = |(i, &value): (usize, &f64)| Bar {
            label: format!("Step {i}"),
            value,
            series: i % 2,
            swatch: Some([90; 3]),
        };
        BarFigure {
            title: "Uniformity".to_owned(),
            subtitle: "Equal steps of h".to_owned(),
            value_name: "ΔE2000 of the step".to_owned(),
            bars: values.iter().enumerate().map(bar).collect(),
            decimals: 2,
        }
    }

    #[test]
    fn bars_are_as_long_as_their_values() {
        let figure = figure(&[1.0, 2.0, 4.0]);
        let drawing = figure.drawing(FigureTheme::Light);
        assert_texts_are_legible(&drawing);
        let inks = FigureTheme::Light.palette().models;
        let lengths: Vec<f64> = drawing
            .shapes
            .iter()
            .filter_map(|shape| match shape {
                Shape::Box { width, ink, .. } if inks.contains(ink) => Some(*width),
                _ => None,
            })
            .collect();
        assert!((lengths[1] / lengths[0] - 2.0).abs() < 1e-9 && (lengths[2] / lengths[0] - 4.0).abs() < 1e-9);
    }

    #[test]
    fn no_bars_or_no_numbers_are_no_panic() {
        assert_texts_are_legible(&figure(&[]).drawing(FigureTheme::Dark));
        assert_texts_are_legible(&figure(&[f64::NAN, 0.0]).drawing(FigureTheme::Dark));
    }
}
