//! Numbers in a table, coloured by size: errors of models over all metals.

use super::drawing::{Align, Drawing, Label};
use super::output::Figure;
use super::page::{HEADING, MARGIN, Page, TO_BASELINE, heat, ink_on};
use super::style::{FigureTheme, Ink, em};
use super::text::{Weight, fitted, text_width};

/// Rows of numbers, in the order given or sorted.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatTable {
    /// What is measured.
    pub title: String,
    /// Space, convention, what a reader must know.
    pub subtitle: String,
    /// Names of the columns.
    pub columns: Vec<String>,
    /// The rows.
    pub rows: Vec<HeatRow>,
    /// The value of the strongest colour.
    pub full_scale: f64,
    /// Digits after the point.
    pub decimals: usize,
}

/// One row of a [`HeatTable`].
#[derive(Clone, Debug, PartialEq)]
pub struct HeatRow {
    /// Its name.
    pub label: String,
    /// A colour beside the name, as 8-bit sRGB.
    pub swatch: Option<[u8; 3]>,
    /// A value for each column, if there is one.
    pub values: Vec<Option<f64>>,
}

const ROW: f64 = 20.0;
const CELL: f64 = 78.0;
const SWATCH: f64 = 12.0;
/// Longer names are cut, with an ellipsis.
const LONGEST_NAME: f64 = 240.0;

impl HeatTable {
    /// The rows by the values of a column, smallest first; rows without one last.
    pub fn sorted_by(mut self, column: usize) -> Self {
        let key = |row: &HeatRow| row.values.get(column).copied().flatten().unwrap_or(f64::INFINITY);
        self.rows.sort_by(|a, b| key(a).total_cmp(&key(b)));
        self
    }

    /// Column names wrapped at spaces into lines that fit a cell.
    fn headings(&self) -> Vec<Vec<String>> {
        self.columns.iter().map(|name| wrapped(name, CELL - 8.0)).collect()
    }
}

/// A text in lines no wider than `width`, broken at spaces.
fn wrapped(text: &str, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words(text) {
        let joined = lines.last().map(|line| format!("{line} {word}"));
        match (joined, lines.last_mut()) {
            (Some(joined), Some(line)) if text_width(&joined, Weight::Regular, em::SMALL) <= width => *line = joined,
            _ => lines.push(fitted(&word, Weight::Regular, em::SMALL, width)),
        }
    }
    lines
}

/// The words of a text; what follows a comma stays with it: `(r, h)`.
fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for part in text.split_whitespace() {
        match words.last_mut().filter(|word| word.ends_with(',')) {
            Some(word) => *word = format!("{word} {part}"),
            None => words.push(part.to_owned()),
        }
    }
    words
}

impl Figure for HeatTable {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let names = self.rows.iter().map(|row| text_width(&row.label, Weight::Regular, em::LABEL)).fold(96.0, f64::max);
        let first_column = MARGIN + SWATCH + 10.0 + names.min(LONGEST_NAME) + 16.0;
        let headings = self.headings();
        let lines = headings.iter().map(Vec::len).max().unwrap_or(0) as f64;
        let top = HEADING + 14.0 * lines + 14.0;
        let width = (first_column + CELL * self.columns.len() as f64 + MARGIN).max(520.0);
        let size = (width, top + ROW * self.rows.len() as f64 + MARGIN);
        let mut page = Page::new((&self.title, &self.subtitle), size, MARGIN, theme);
        for (column, heading) in headings.iter().enumerate() {
            let middle = first_column + CELL * (column as f64 + 0.5);
            for (line, text) in heading.iter().rev().enumerate() {
                page.caption(text, middle, top - 8.0 - 14.0 * line as f64, Align::Centre);
            }
        }
        for (index, row) in self.rows.iter().enumerate() {
            self.row(&mut page, row, (first_column, top + ROW * index as f64), theme);
        }
        page.drawing
    }
}

impl HeatTable {
    fn row(&self, page: &mut Page, row: &HeatRow, (first_column, top): (f64, f64), theme: FigureTheme) {
        let middle = top + ROW / 2.0;
        if let Some(code) = row.swatch {
            page.drawing.fill(MARGIN, middle - SWATCH / 2.0, SWATCH, SWATCH, Ink::opaque(code));
        }
        let name = fitted(&row.label, Weight::Regular, em::LABEL, LONGEST_NAME);
        page.name(name, MARGIN + SWATCH + 10.0, middle, Align::Left);
        for (column, value) in row.values.iter().enumerate().take(self.columns.len()) {
            let left = first_column + CELL * column as f64;
            let ground = value.map_or(page.palette.ground, |v| heat(v / self.full_scale, theme));
            page.drawing.fill(left + 0.5, top + 0.5, CELL - 1.0, ROW - 1.0, ground);
            let text = value.map_or("–".to_owned(), |v| format!("{v:.*}", self.decimals));
            let label = Label::new(text, left + CELL - 14.0, middle + TO_BASELINE, em::LABEL, ink_on(ground));
            page.drawing.text(label.aligned(Align::Right));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::check::assert_texts_are_legible;

    #[test]
    fn rows_are_sorted_and_legible() {
        let row = |label: &str, values: [Option<f64>; 2]| HeatRow {
            label: label.to_owned(),
            swatch: Some([200, 180, 90]),
            values: values.into(),
        };
        let table = HeatTable {
            title: "Accuracy".to_owned(),
            subtitle: "Mean ΔE2000 over 0–90°".to_owned(),
            columns: vec!["Hoffman (r, h) exact".to_owned(), "Conductor (n, k) 650/550/450 nm".to_owned()],
            rows: vec![
                row("Zinc", [Some(0.8), Some(1.0)]),
                row("Unknown", [None, None]),
                row("Gold", [Some(0.3), None]),
            ],
            full_scale: 2.0,
            decimals: 2,
        };
        let table = table.sorted_by(0);
        assert_eq!(table.rows.iter().map(|row| row.label.as_str()).collect::<Vec<_>>(), ["Gold", "Zinc", "Unknown"]);
        for theme in FigureTheme::ALL {
            assert_texts_are_legible(&table.drawing(theme));
        }
    }
}
