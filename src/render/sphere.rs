//! A sphere seen from afar.

use std::borrow::Cow;

use rayon::prelude::*;

use super::facets::Facets;
use super::row::{RowPair, Scratch, Shown};
use super::{Light, Picture, RadialTable};
use crate::color::RgbSpace;

/// What a sphere of one size shows of one light, before it reflects: the part of a picture that a
/// change of colour leaves as it is. Make it once, [`render`](Self::render) it on every change.
///
/// The view is orthographic, the sphere fills the square but for a margin of one pixel. Pixels near
/// the rim, where reflectance changes fast and coverage is partial, are means of 4 × 4 samples.
#[derive(Clone, Debug)]
pub struct SphereView {
    pub(super) size: u32,
    space: RgbSpace,
    /// What a rough surface is the mean of; `None` of a mirror.
    facets: Option<Facets>,
    /// From the top to the middle.
    pub(super) rows: Vec<RowPair>,
}

/// Rows that are drawn in one go: fewer would take less time than handing them out.
pub(super) const LEAST_ROWS: usize = 16;

impl SphereView {
    /// The view of a sphere in a picture of `size` × `size` pixels (at least 8), its light in values of `space`.
    pub fn new(size: u32, light: Light, roughness: f64, space: RgbSpace) -> Self {
        let size = size.max(8);
        let environment = (light != Light::White)
            .then(|| light.environment().converted(RgbSpace::LinRec709, space).blurred(roughness));
        let radiance = environment.as_ref().map(|environment| |direction| environment.radiance(direction));
        let rows =
            (0..size.div_ceil(2)).into_par_iter().map(|row| RowPair::new(row, size, radiance.as_ref())).collect();
        Self { size, space, facets: Facets::new(roughness), rows }
    }

    /// The picture of a sphere with this reflectance.
    ///
    /// # Panics
    /// If the table's space is not the view's.
    pub fn render(&self, reflectance: &RadialTable) -> Picture {
        let reflectance = self.seen(reflectance);
        let mut picture = Picture::new(self.size, self.size, self.space);
        let pixels = mirrored_rows(&mut picture.linear, self.size).into_par_iter();
        let pixels = pixels.zip(mirrored_rows(&mut picture.coverage, self.size)).zip(&self.rows);
        pixels.with_min_len(LEAST_ROWS).for_each_init(Scratch::default, |scratch, ((linear, coverage), row)| {
            row.reflect(&reflectance, scratch);
            let covered = row.beside..row.beside + row.covered;
            for (is_lower, (linear, coverage)) in [false, true].into_iter().zip(linear.each().zip(coverage.each())) {
                draw(row.shown(is_lower, scratch), &mut linear[covered.clone()], &mut coverage[covered.clone()]);
            }
        });
        picture
    }

    /// The reflectance that the surface shows.
    pub(super) fn seen<'a>(&self, reflectance: &'a RadialTable) -> Cow<'a, RadialTable> {
        assert_eq!(reflectance.space(), self.space, "light and reflectance in one space");
        self.facets.as_ref().map_or(Cow::Borrowed(reflectance), |facets| Cow::Owned(reflectance.over(facets)))
    }

    /// The space of its light.
    pub(super) fn space(&self) -> RgbSpace {
        self.space
    }
}

fn draw(shown: Shown<'_>, linear: &mut [[f32; 3]], coverage: &mut [f32]) {
    coverage.copy_from_slice(shown.coverage);
    let [red, green, blue] = shown.colours;
    for (((pixel, red), green), blue) in linear.iter_mut().zip(red).zip(green).zip(blue) {
        *pixel = [*red, *green, *blue];
    }
    let Some([red, green, blue]) = shown.light else { return };
    for (((pixel, red), green), blue) in linear[shown.between].iter_mut().zip(red).zip(green).zip(blue) {
        *pixel = [pixel[0] * red, pixel[1] * green, pixel[2] * blue];
    }
}

/// A row in the upper half of a picture and the one that mirrors it in the lower; a row in the middle has none.
pub(super) struct Mirrored<'a, T> {
    pub(super) upper: &'a mut [T],
    pub(super) lower: Option<&'a mut [T]>,
}

impl<'a, T> Mirrored<'a, T> {
    pub(super) fn each(self) -> impl Iterator<Item = &'a mut [T]> {
        std::iter::once(self.upper).chain(self.lower)
    }
}

/// The rows of a square picture, from the outermost to the middle.
pub(super) fn mirrored_rows<T>(pixels: &mut [T], size: u32) -> Vec<Mirrored<'_, T>> {
    let size = size as usize;
    let (upper, lower) = pixels.split_at_mut(size.div_ceil(2) * size);
    let mut lower = lower.chunks_exact_mut(size).rev();
    upper.chunks_exact_mut(size).map(|upper| Mirrored { upper, lower: lower.next() }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;
    use crate::fresnel::{CosTheta, FresnelModel};

    const SPACE: RgbSpace = RgbSpace::LinRec709;

    fn gold() -> FresnelModel {
        FresnelModel::Hoffman { r: Rgb([1.02, 0.76, 0.33]), h: Rgb([1.0, 0.86, 0.65]) }
    }

    fn white_sphere(size: u32) -> Picture {
        SphereView::new(size, Light::White, 0.0, SPACE).render(&RadialTable::of_model(&gold(), SPACE))
    }

    #[test]
    fn the_centre_faces_the_viewer() {
        let picture = white_sphere(257);
        assert!(picture.rgb(128, 128).max_abs_difference(gold().reflectance(CosTheta::FACING)) < 1e-6);
        assert_eq!((picture.coverage[0], picture.coverage[128 * 257 + 128]), (0.0, 1.0));
    }

    /// The last pixel on the axis spans cosines from 0 to √(2/radius): its colour lies between theirs.
    #[test]
    fn the_rim_goes_to_white() {
        let size = 1024;
        let picture = white_sphere(size);
        let rim = picture.rgb(1, size / 2);
        let inner = gold().reflectance(CosTheta::new((2.0 * 1.5 / 511.0_f64).sqrt()));
        assert!(rim[2] > inner[2] && rim[2] < 1.0, "{rim:?} {inner:?}");
    }

    /// On a sphere seen from afar the mean is 2 ∫ F sin θ cos θ dθ, which for Hoffman's model is
    /// r + (1 − r)/21 − a/126. Four times the pixels bring the picture nearer to it.
    #[test]
    fn mean_under_white_converges_to_the_cosine_weighted_mean() {
        let FresnelModel::Hoffman { r, h } = gold() else { unreachable!() };
        let a = r.zip(h, crate::fresnel::a_from_r_h);
        let exact = r + (Rgb::WHITE - r) / 21.0 - a / 126.0;
        let error = |size| white_sphere(size).mean().max_abs_difference(exact);
        assert!(error(64) < 2e-3 && error(512) < 1e-4, "{} {}", error(64), error(512));
    }

    #[test]
    fn covered_area_is_the_discs() {
        let covered: f32 = white_sphere(256).coverage.iter().sum();
        assert!((covered / (std::f32::consts::PI * 127.0 * 127.0) - 1.0).abs() < 1e-4);
    }

    /// A perfect mirror shows the light itself, in each quarter and on the axes.
    #[test]
    fn a_white_mirror_shows_the_light() {
        let mirror = RadialTable::new(SPACE, |_| Rgb::WHITE);
        for space_light in [Light::SoftBoxes, Light::CitySquare] {
            let picture = SphereView::new(201, space_light, 0.0, SPACE).render(&mirror);
            for (column, row) in [(60, 50), (140, 50), (60, 150), (140, 150), (100, 20), (20, 100)] {
                let (x, y) = ((f64::from(column) - 100.0) / 99.5, (100.0 - f64::from(row)) / 99.5);
                let z = (1.0 - x * x - y * y).sqrt();
                let expected = space_light.environment().radiance([2.0 * z * x, 2.0 * z * y, 2.0 * z * z - 1.0]);
                let found = picture.rgb(column, row);
                assert!(found.max_abs_difference(Rgb(expected.map(f64::from))) < 1e-5, "{column} {row}");
            }
        }
    }

    /// Appearance does not depend on the space it was computed in when both colours are white-lit.
    #[test]
    fn white_light_is_white_in_every_space() {
        let r = Rgb([0.9, 0.6, 0.3]);
        for space in RgbSpace::ALL {
            let table = RadialTable::of_model(&FresnelModel::Schlick { r: SPACE.convert(r, space) }, space);
            let picture = SphereView::new(65, Light::White, 0.0, space).render(&table);
            assert!(space.convert(picture.rgb(32, 32), SPACE).max_abs_difference(r) < 1e-5, "{space}");
        }
    }
}
