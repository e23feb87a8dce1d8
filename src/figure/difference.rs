//! Two renderings and where they differ.

use super::drawing::{Align, Drawing, Inset};
use super::output::Figure;
use super::page::{HEADING, MARGIN, Page};
use super::style::{FigureTheme, Ink};
use crate::render::{DeltaEMap, Picture, false_colour};

/// A truth, a model, and their ΔE in false colour with its scale.
#[derive(Clone, Debug)]
pub struct DifferenceFigure {
    /// What is rendered.
    pub title: String,
    /// Space, light, convention.
    pub subtitle: String,
    /// What the left and the middle picture show.
    pub labels: [String; 2],
    /// The two renderings, of one size and space.
    pub pictures: [Picture; 2],
    /// The difference shown in the brightest colour.
    pub full_scale: f64,
}

impl DifferenceFigure {
    /// Width of each picture in points.
    pub const SIDE: f64 = 276.0;
}

const SIDE: f64 = DifferenceFigure::SIDE;
const GAP: f64 = 20.0;

impl Figure for DifferenceFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let [truth, model] = &self.pictures;
        let map = DeltaEMap::between(truth, model);
        let height = SIDE * f64::from(truth.height) / f64::from(truth.width);
        let size = (2.0 * MARGIN + 3.0 * SIDE + 2.0 * GAP, HEADING + height + 104.0);
        let mut page = Page::new((&self.title, &self.subtitle), size, MARGIN, theme);
        let left = |column: usize| MARGIN + (SIDE + GAP) * column as f64;
        let shown = [truth.to_srgb8(), model.to_srgb8(), map.to_false_colour(self.full_scale)];
        let clipped: usize = shown[..2].iter().map(|picture| picture.clipped).sum();
        let difference = format!("ΔE2000: mean {:.2}, max {:.2}", map.mean(), map.max());
        let names = [&self.labels[0], &self.labels[1], &difference];
        for (column, (picture, name)) in shown.into_iter().zip(names).enumerate() {
            page.drawing.insets.push(Inset { x: left(column), y: HEADING + 4.0, width: SIDE, picture });
            page.name(name, left(column) + SIDE / 2.0, HEADING + height + 26.0, Align::Centre);
        }
        let scale = (left(2), HEADING + height + 50.0, SIDE);
        let beyond = if map.max() > self.full_scale { ", brightest beyond the scale" } else { "" };
        page.colour_scale(&format!("ΔE2000{beyond}"), scale, self.full_scale, |share| {
            Ink::opaque(false_colour(share))
        });
        if clipped > 0 {
            let visible: f32 = self.pictures.iter().flat_map(|picture| &picture.coverage).sum();
            let share = 100.0 * clipped as f32 / visible;
            let note = format!("Shown in sRGB, which clips {share:.0} % of the pixels; ΔE is measured unclipped.");
            page.caption(&note, MARGIN, size.1 - 16.0, Align::Left);
        }
        page.drawing
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::figure::check::assert_texts_are_legible;
    use crate::fresnel::FresnelModel;
    use crate::metal::metal_by_name;
    use crate::render::{Light, RadialTable, SphereView};

    #[test]
    fn the_figure_is_legible_and_embeds_three_pictures() {
        let (zinc, space) = (metal_by_name("zinc").unwrap(), RgbSpace::LinRec709);
        let view = SphereView::new(64, Light::SoftBoxes, 0.0, space);
        let schlick = FresnelModel::Schlick { r: zinc.r(space) };
        let figure = DifferenceFigure {
            title: "Zinc".to_owned(),
            subtitle: "Linear sRGB (Rec.709) · soft boxes".to_owned(),
            labels: ["Truth".to_owned(), "Schlick (r)".to_owned()],
            pictures: [
                view.render(&RadialTable::of_metal(zinc, space)),
                view.render(&RadialTable::of_model(&schlick, space)),
            ],
            full_scale: 10.0,
        };
        assert_texts_are_legible(&figure.drawing(FigureTheme::Light));
        let svg = figure.to_svg(FigureTheme::Light);
        let document = roxmltree::Document::parse(&svg).unwrap();
        assert_eq!(document.descendants().filter(|node| node.has_tag_name("image")).count(), 3);
    }
}
