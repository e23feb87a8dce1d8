//! A sphere seen from afar.

use rayon::prelude::*;

use super::{Light, Picture, RadialTable};
use crate::color::RgbSpace;

/// What a sphere of one size shows of one light, before it reflects: the part of a picture that a
/// change of colour leaves as it is. Make it once, [`render`](Self::render) it on every change.
///
/// The view is orthographic, the sphere fills the square but for a margin of one pixel. Pixels near
/// the rim, where reflectance changes fast and coverage is partial, are means of 4 × 4 samples.
#[derive(Clone, Debug)]
pub struct SphereView {
    size: u32,
    space: RgbSpace,
    roughness: f64,
    rows: Vec<Row>,
}

/// The samples of a row of pixels, one pixel after another.
#[derive(Clone, Debug, Default)]
struct Row {
    samples: Vec<Sample>,
    /// Number of samples and coverage of each pixel.
    pixels: Vec<(u8, f32)>,
}

#[derive(Clone, Copy, Debug)]
struct Sample {
    cos_theta: f32,
    radiance: [f32; 3],
}

/// Samples across a pixel near the rim.
const RIM_SAMPLES: u32 = 4;

impl SphereView {
    /// The view of a sphere in a picture of `size` × `size` pixels (at least 8), its light in values of `space`.
    pub fn new(size: u32, light: Light, roughness: f64, space: RgbSpace) -> Self {
        let size = size.max(8);
        let rows = match light {
            Light::White => rows_of(size, &|_| [1.0; 3]),
            _ => {
                let environment = light.environment().converted(RgbSpace::LinRec709, space).blurred(roughness);
                rows_of(size, &|direction| environment.radiance(direction))
            }
        };
        Self { size, space, roughness, rows }
    }

    /// The picture of a sphere with this reflectance.
    ///
    /// # Panics
    /// If the table's space is not the view's.
    pub fn render(&self, reflectance: &RadialTable) -> Picture {
        assert_eq!(reflectance.space(), self.space, "light and reflectance in one space");
        let reflectance = reflectance.rough(self.roughness);
        let mut picture = Picture::new(self.size, self.size, self.space);
        let width = self.size as usize;
        let pixels = picture.linear.par_chunks_mut(width).zip(picture.coverage.par_chunks_mut(width));
        pixels.zip(&self.rows).for_each(|((linear, coverage), row)| row.render(&reflectance, linear, coverage));
        picture
    }
}

fn rows_of(size: u32, radiance: &(impl Fn([f64; 3]) -> [f32; 3] + Sync)) -> Vec<Row> {
    (0..size).into_par_iter().map(|row| Row::new(row, size, radiance)).collect()
}

impl Row {
    fn new(row: u32, size: u32, radiance: &impl Fn([f64; 3]) -> [f32; 3]) -> Self {
        let mut result = Self::default();
        for column in 0..size {
            let across = if is_near_rim(column, row, size) { RIM_SAMPLES } else { 1 };
            let before = result.samples.len();
            for index in 0..across * across {
                let offset = |i: u32| (f64::from(i) + 0.5) / f64::from(across);
                let (x, y) = (f64::from(column) + offset(index % across), f64::from(row) + offset(index / across));
                result.samples.extend(Sample::at(x, y, size, radiance));
            }
            let found = result.samples.len() - before;
            result.pixels.push((found as u8, found as f32 / (across * across) as f32));
        }
        result
    }

    fn render(&self, reflectance: &RadialTable, linear: &mut [[f32; 3]], coverage: &mut [f32]) {
        let mut samples = self.samples.as_slice();
        for (&(count, covered), (pixel, coverage)) in self.pixels.iter().zip(linear.iter_mut().zip(coverage)) {
            let (own, rest) = samples.split_at(usize::from(count));
            samples = rest;
            *coverage = covered;
            if count > 0 {
                *pixel = mean_of(own, reflectance);
            }
        }
    }
}

fn mean_of(samples: &[Sample], reflectance: &RadialTable) -> [f32; 3] {
    let mut sum = [0.0; 3];
    for sample in samples {
        let factor = reflectance.at(sample.cos_theta);
        (0..3).for_each(|i| sum[i] += factor[i] * sample.radiance[i]);
    }
    sum.map(|v| v / samples.len() as f32)
}

impl Sample {
    /// The sample at a place of the picture; `None` beside the sphere.
    fn at(column: f64, row: f64, size: u32, radiance: &impl Fn([f64; 3]) -> [f32; 3]) -> Option<Self> {
        let (x, y) = on_disc(column, row, size);
        let z_squared = 1.0 - x * x - y * y;
        let cos_theta = (z_squared >= 0.0).then(|| z_squared.sqrt())?;
        // The mirrored view direction 2 (n·v) n − v with v along z.
        let mirrored = [2.0 * cos_theta * x, 2.0 * cos_theta * y, 2.0 * z_squared - 1.0];
        Some(Self { cos_theta: cos_theta as f32, radiance: radiance(mirrored) })
    }
}

/// A place of the picture on the unit disc, y up.
fn on_disc(column: f64, row: f64, size: u32) -> (f64, f64) {
    let centre = f64::from(size) / 2.0;
    let radius = centre - 1.0;
    ((column - centre) / radius, (centre - row) / radius)
}

/// True from θ ≈ 64° outwards, up to the farthest corner of a pixel that the disc can touch, where a pixel spans so much
/// of the cosine that its middle does not stand for it.
fn is_near_rim(column: u32, row: u32, size: u32) -> bool {
    /// F bends by at most 140 over the cosine: a mean over this much of it is within .001 of its middle.
    const MOST_COSINE: f64 = 0.0125;
    let (x, y) = on_disc(f64::from(column) + 0.5, f64::from(row) + 0.5, size);
    let pixel = 1.0 / f64::from(size / 2 - 1);
    let (rho, margin) = (x.hypot(y), 2.0 * pixel);
    let cosine_of_pixel = rho * pixel / (1.0 - rho * rho).max(0.0).sqrt();
    (0.9 - margin..1.0 + margin).contains(&rho) && cosine_of_pixel > MOST_COSINE
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

    /// A perfect mirror shows the light itself: the pixel facing up-left shows the box there.
    #[test]
    fn a_white_mirror_shows_the_light() {
        let mirror = RadialTable::new(SPACE, |_| Rgb::WHITE);
        for space_light in [Light::SoftBoxes, Light::CitySquare] {
            let picture = SphereView::new(201, space_light, 0.0, SPACE).render(&mirror);
            let (x, y) = ((60.5 - 100.5) / 99.5, (100.5 - 60.5) / 99.5_f64);
            let z = (1.0 - x * x - y * y).sqrt();
            let expected = space_light.environment().radiance([2.0 * z * x, 2.0 * z * y, 2.0 * z * z - 1.0]);
            assert!(picture.rgb(60, 60).max_abs_difference(Rgb(expected.map(f64::from))) < 1e-5);
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
