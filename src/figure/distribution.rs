//! Distributions: every value as a dot, with median and quartiles.

use super::axis::{Axis, rounded_out};
use super::drawing::{Align, Drawing};
use super::output::Figure;
use super::page::{Frame, HEADING, MARGIN, Page};
use super::style::{FigureTheme, em};
use super::text::{Weight, fitted, text_width};

/// One row of dots for each series, on one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct DistributionFigure {
    /// What is measured.
    pub title: String,
    /// Space, convention, what a reader must know.
    pub subtitle: String,
    /// The name of a value, with its unit.
    pub value_name: String,
    /// Equal factors equally far apart; what is below [`LOG_FLOOR`](Self::LOG_FLOOR) is drawn at the left end.
    pub is_log: bool,
    /// Name and values of each series, from the top.
    pub rows: Vec<(String, Vec<f64>)>,
}

const ROW: f64 = 46.0;
const PANEL: f64 = 620.0;
const DOT: f64 = 3.0;
const LONGEST_NAME: f64 = 240.0;

impl DistributionFigure {
    /// The smallest value of a logarithmic axis.
    pub const LOG_FLOOR: f64 = 1e-3;

    fn axis(&self, left: f64) -> Axis {
        let values = || self.rows.iter().flat_map(|(_, values)| values).copied().filter(|v| v.is_finite());
        let highest = values().fold(0.0, f64::max);
        let places = (left, left + PANEL);
        if self.is_log {
            let lowest = values().fold(highest, f64::min).max(Self::LOG_FLOOR);
            Axis::log((lowest / 1.3, (highest * 1.3).max(10.0 * lowest)), places)
        } else {
            Axis::new((0.0, *rounded_out(0.0..=highest.max(1e-6), 6).end()), places)
        }
    }
}

/// The value below which a share of sorted values lies, interpolated (Hyndman & Fan 1996, type 7).
fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let position = share * sorted.len().checked_sub(1)? as f64;
    let (low, high) = (sorted[position.floor() as usize], sorted[position.ceil() as usize]);
    Some(low + (high - low) * position.fract())
}

impl Figure for DistributionFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let names =
            self.rows.iter().map(|(name, _)| text_width(name, Weight::SemiBold, em::LABEL)).fold(110.0, f64::max);
        let left = MARGIN + names.min(LONGEST_NAME) + 18.0;
        let top = HEADING + 10.0;
        let bottom = top + ROW * self.rows.len().max(1) as f64;
        let size = (left + PANEL + MARGIN + 10.0, bottom + 74.0);
        let mut page = Page::new((&self.title, &self.subtitle), size, MARGIN, theme);
        let x = self.axis(left);
        let y = Axis::new((0.0, 1.0), (bottom, top));
        page.vertical_grid(&Frame { x, y, x_name: self.value_name.clone(), y_name: String::new() });
        for (index, row) in self.rows.iter().enumerate() {
            draw_row(&mut page, index, row, x, top + ROW * (index as f64 + 0.5));
        }
        page.caption(
            "Each dot is one value; the bar spans the quartiles, the stroke is the median.",
            MARGIN,
            size.1 - 14.0,
            Align::Left,
        );
        page.drawing
    }
}

fn draw_row(page: &mut Page, index: usize, (name, values): &(String, Vec<f64>), x: Axis, middle: f64) {
    let ink = page.palette.models[index % page.palette.models.len()];
    let right = x.places.0 - 18.0;
    page.name(fitted(name, Weight::SemiBold, em::LABEL, LONGEST_NAME), right, middle - 7.0, Align::Right);
    let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let place = |v: f64| x.at(v.max(x.values.0)).min(x.places.1);
    let [Some(low), Some(median), Some(high)] = [0.25, 0.5, 0.75].map(|share| quantile(&sorted, share)) else {
        page.caption("no values", right, middle + 12.0, Align::Right);
        return;
    };
    page.caption(&format!("median {median:.2}"), right, middle + 12.0, Align::Right);
    page.drawing.fill(place(low), middle - 13.0, (place(high) - place(low)).max(1.0), 26.0, ink.alpha(0.16));
    for (rank, &value) in sorted.iter().enumerate() {
        // Neighbours in value are spread over the row by the golden ratio: even, and the same every time.
        let offset = ((rank as f64 * 0.618_033_988_749_895).fract() - 0.5) * 22.0;
        page.drawing.dot((place(value), middle + offset), DOT, ink.alpha(0.7));
    }
    page.drawing.rule((place(median), middle - 15.0), (place(median), middle + 15.0), 2.5, ink);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::check::assert_texts_are_legible;

    #[test]
    fn quantiles_interpolate() {
        let sorted = [1.0, 2.0, 3.0, 4.0];
        assert_eq!([0.0, 0.5, 1.0].map(|share| quantile(&sorted, share)), [Some(1.0), Some(2.5), Some(4.0)]);
        assert_eq!(quantile(&[], 0.5), None);
    }

    #[test]
    fn rows_are_legible_on_both_axes() {
        for is_log in [false, true] {
            let figure = DistributionFigure {
                title: "Conversion".to_owned(),
                subtitle: "ACEScg to linear sRGB, all metals".to_owned(),
                value_name: "ΔE2000 at the worst angle".to_owned(),
                is_log,
                rows: vec![
                    ("Hoffman (r, h)".to_owned(), vec![0.0; 12]),
                    ("Gulbrandsen (r, g)".to_owned(), (0..40).map(|i| 0.03 * f64::from(i)).collect()),
                    ("Nothing".to_owned(), vec![f64::NAN]),
                ],
            };
            assert_texts_are_legible(&figure.drawing(FigureTheme::Light));
        }
    }
}
