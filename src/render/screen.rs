//! From a sphere and its reflectance to the codes of a screen, without a linear picture between.

use std::ops::Range;

use rayon::prelude::*;

use super::encode::{Encoder, Linear, write_alpha};
use super::row::{RowPair, Scratch, Shown, mirror};
use super::sphere::{LEAST_ROWS, Mirrored, mirrored_rows};
use super::{RadialTable, SphereView, Srgb8Picture};

impl SphereView {
    /// What [`Self::render`] shows in 8-bit sRGB: [`Picture::to_srgb8`](super::Picture::to_srgb8) of it, to the code and
    /// to the number of clipped pixels, in a fraction of the time. `picture` is written over, whatever it was; one that
    /// is used again and again costs no memory anew.
    ///
    /// # Panics
    /// If the table's space is not the view's.
    pub fn render_srgb8(&self, reflectance: &RadialTable, picture: &mut Srgb8Picture) {
        let reflectance = self.seen(reflectance);
        let encoder = Encoder::new(self.space());
        (picture.width, picture.height) = (self.size, self.size);
        picture.rgba.resize(4 * self.size as usize * self.size as usize, 0);
        let rows = mirrored_rows(picture.rgba.as_chunks_mut().0, self.size).into_par_iter().zip(&self.rows);
        let clipped = rows.with_min_len(LEAST_ROWS).map_init(Scratch::default, |scratch, (codes, row)| {
            row.reflect(&reflectance, scratch);
            if row.is_white() { same_in_all(row, encoder, scratch, codes) } else { each(row, encoder, scratch, codes) }
        });
        picture.clipped = clipped.sum();
    }
}

/// Both rows; gives the number of clipped pixels.
fn each(row: &RowPair, encoder: Encoder, scratch: &mut Scratch, codes: Mirrored<'_, [u8; 4]>) -> usize {
    let mut clipped = 0;
    for (is_lower, codes) in [false, true].into_iter().zip(codes.each()) {
        let Shown { colours, light, between, coverage } = row.shown(is_lower, scratch);
        let codes = only_covered(row, codes);
        let mut part = |range: Range<usize>, light| {
            let colours = colours.map(|channel| &channel[range.clone()]);
            clipped += encoder.colours(Linear { colours, light }, &coverage[range.clone()], &mut codes[range]);
        };
        let (left, right) = (0..between.start, between.end..row.covered);
        part(left.clone(), None);
        part(between, light);
        part(right.clone(), None);
        for rim in [left, right] {
            write_alpha(&coverage[rim.clone()], &mut codes[rim]);
        }
    }
    clipped
}

/// Both rows from the left half of one; gives the number of clipped pixels.
fn same_in_all(row: &RowPair, encoder: Encoder, scratch: &mut Scratch, codes: Mirrored<'_, [u8; 4]>) -> usize {
    let Shown { colours, between, coverage, .. } = row.shown(false, scratch);
    let covered = only_covered(row, codes.upper);
    let part = |range: Range<usize>, codes: &mut [[u8; 4]]| {
        let colours = colours.map(|channel| &channel[range.clone()]);
        encoder.colours(Linear { colours, light: None }, &coverage[range.clone()], &mut codes[range])
    };
    let half = row.covered / 2;
    let in_half = part(0..half, covered);
    let in_middle = part(half..row.covered.div_ceil(2), covered);
    write_alpha(&coverage[..between.start], covered);
    mirror(covered);
    let clipped = 2 * in_half + in_middle;
    let Some(lower) = codes.lower else { return clipped };
    lower.copy_from_slice(codes.upper);
    2 * clipped
}

/// Leaves nothing beside the sphere; gives the rest of the row.
fn only_covered<'a>(row: &RowPair, codes: &'a mut [[u8; 4]]) -> &'a mut [[u8; 4]] {
    let covered = row.beside..row.beside + row.covered;
    codes[..covered.start].fill([0; 4]);
    codes[covered.end..].fill([0; 4]);
    &mut codes[covered]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Rgb, RgbSpace};
    use crate::fresnel::FresnelModel;
    use crate::render::Light;

    fn hoffman(r: [f64; 3]) -> FresnelModel {
        FresnelModel::Hoffman { r: Rgb(r), h: Rgb([1.0, 0.86, 0.65]) }
    }

    /// Under every light, in every space, in sizes even and odd, of mirrors and of rough surfaces, some brighter than
    /// white; all into one picture, so that each must write over the one before.
    #[test]
    fn codes_and_clipped_pixels_are_those_of_the_linear_picture() {
        let mut picture = Srgb8Picture { rgba: vec![7; 1234], ..Srgb8Picture::default() };
        let models = [hoffman([0.94, 0.78, 0.37]), hoffman([1.4, 0.2, 0.0]), hoffman([0.9, f64::NAN, 0.3])];
        let views = [
            (Light::White, 0.0, RgbSpace::LinRec709),
            (Light::White, 0.5, RgbSpace::AcesCg),
            (Light::SoftBoxes, 0.0, RgbSpace::LinRec709),
            (Light::SoftBoxes, 0.6, RgbSpace::AcesCg),
            (Light::PhotoStudio, 0.0, RgbSpace::LinDisplayP3),
            (Light::SunlitRoom, 0.0, RgbSpace::LinRec709),
            (Light::CitySquare, 0.0, RgbSpace::LinRec2020),
        ];
        let mut clipped = Vec::new();
        for (light, roughness, space) in views {
            let tables = models.map(|model| RadialTable::of_model(&model, space));
            for size in [8, 9, 90, 111] {
                let view = SphereView::new(size, light, roughness, space);
                for (table, model) in tables.iter().zip(&models) {
                    view.render_srgb8(table, &mut picture);
                    assert!(picture == view.render(table).to_srgb8(), "{space} {light} {size} {model:?}");
                    clipped.push(picture.clipped);
                }
            }
        }
        assert!(clipped.contains(&0) && clipped.iter().any(|count| *count > 5_000), "{clipped:?}");
    }
}
