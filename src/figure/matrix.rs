//! A value for every pair: a matrix of coloured cells.

use super::drawing::{Align, Drawing, Label};
use super::output::Figure;
use super::page::{HEADING, MARGIN, Page, heat};
use super::style::{FigureTheme, em};
use super::text::{Weight, fitted, text_width};

/// A square matrix over one set of things.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixFigure {
    /// What is measured.
    pub title: String,
    /// Space, convention, what a reader must know.
    pub subtitle: String,
    /// The name of a value, e.g. “worst ΔE2000 of the blend”.
    pub value_name: String,
    /// The name of each thing.
    pub names: Vec<String>,
    /// One row of values for each thing; `None` is left empty.
    pub values: Vec<Vec<Option<f64>>>,
    /// The value of the strongest colour.
    pub full_scale: f64,
}

const LONGEST_NAME: f64 = 200.0;
const CELL: f64 = 16.0;

impl Figure for MatrixFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let short: Vec<String> =
            self.names.iter().map(|name| fitted(name, Weight::Regular, em::SMALL, LONGEST_NAME)).collect();
        let room = short.iter().map(|name| text_width(name, Weight::Regular, em::SMALL)).fold(40.0, f64::max) + 10.0;
        let (left, top) = (MARGIN + room, HEADING + room + 4.0);
        let side = CELL * self.names.len() as f64;
        let size = ((left + side + MARGIN).max(560.0), top + side + 70.0);
        let mut page = Page::new((&self.title, &self.subtitle), size, MARGIN, theme);
        for (index, name) in short.iter().enumerate() {
            let middle = CELL * (index as f64 + 0.5);
            page.caption(name, left - 10.0, top + middle + 4.0, Align::Right);
            let column = Label::new(name, left + middle + 4.0, top - 8.0, em::SMALL, page.palette.muted);
            page.drawing.text(column.upright());
        }
        for (row, values) in self.values.iter().enumerate() {
            for (column, value) in values.iter().enumerate() {
                let Some(value) = value else { continue };
                let (x, y) = (left + CELL * column as f64, top + CELL * row as f64);
                page.drawing.fill(x + 0.5, y + 0.5, CELL - 1.0, CELL - 1.0, heat(value / self.full_scale, theme));
            }
        }
        let scale = (size.0 - MARGIN - 190.0, top + side + 24.0, 180.0);
        page.colour_scale(&self.value_name, scale, self.full_scale, |share| heat(share, theme));
        page.drawing
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::check::assert_texts_are_legible;
    use crate::metal::preferred_metals;

    #[test]
    fn the_names_of_all_metals_fit() {
        let names: Vec<_> = preferred_metals().map(|metal| metal.name.clone()).collect();
        let values = (0..names.len()).map(|i| (0..names.len()).map(|j| (i != j).then_some((i + j) as f64)).collect());
        let figure = MatrixFigure {
            title: "Blends".to_owned(),
            subtitle: "Linear sRGB (Rec.709)".to_owned(),
            value_name: "ΔE2000 at the worst angle".to_owned(),
            values: values.collect(),
            names,
            full_scale: 90.0,
        };
        assert_texts_are_legible(&figure.drawing(FigureTheme::Light));
    }
}
