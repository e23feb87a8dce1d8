//! Where two pictures differ, and by how much.

use rayon::prelude::*;

use super::{Picture, Srgb8Picture};
use crate::color::{Rgb, RgbSpace, delta_e_rgb};

/// CIEDE2000 for each pixel of two pictures, relative to the white of their space.
#[derive(Clone, Debug, PartialEq)]
pub struct DeltaEMap {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// One difference for each pixel, row by row from the top left; 0 where nothing is covered.
    pub delta_e: Vec<f32>,
    /// Coverage of the first picture.
    pub coverage: Vec<f32>,
}

impl DeltaEMap {
    /// The map of two pictures of one size and space.
    ///
    /// # Panics
    /// If sizes or spaces differ.
    pub fn between(a: &Picture, b: &Picture) -> Self {
        let shape = |p: &Picture| (p.space, p.width, p.height);
        assert_eq!(shape(a), shape(b), "pictures of one size and space");
        let wide = |rgb: &[f32; 3]| Rgb(rgb.map(f64::from));
        let pixels = a.linear.par_iter().zip(&b.linear).zip(&a.coverage);
        let difference = |((a_rgb, b_rgb), &coverage): ((&[f32; 3], &[f32; 3]), &f32)| {
            if coverage > 0.0 && a_rgb != b_rgb { delta_e_rgb(wide(a_rgb), wide(b_rgb), a.space) as f32 } else { 0.0 }
        };
        let delta_e = pixels.with_min_len(4096).map(difference).collect();
        Self { width: a.width, height: a.height, delta_e, coverage: a.coverage.clone() }
    }

    /// Mean over what is covered; on a sphere under white light this weighs angles by sin θ cos θ.
    pub fn mean(&self) -> f64 {
        let pixels = self.delta_e.iter().zip(&self.coverage);
        let (sum, area) = pixels.fold((0.0, 0.0), |(sum, area), (&delta_e, &coverage)| {
            (sum + f64::from(delta_e) * f64::from(coverage), area + f64::from(coverage))
        });
        if area > 0.0 { sum / area } else { 0.0 }
    }

    /// Largest difference.
    pub fn max(&self) -> f64 {
        self.delta_e.iter().copied().fold(0.0_f32, f32::max).into()
    }

    /// The map as a picture whose three channels all hold the difference itself: for files that keep numbers.
    pub fn to_picture(&self, space: RgbSpace) -> Picture {
        let linear = self.delta_e.iter().map(|&delta_e| [delta_e; 3]).collect();
        Picture { width: self.width, height: self.height, space, linear, coverage: self.coverage.clone() }
    }

    /// The map in false colour: black at 0, through violet and orange to pale yellow at `full_scale` and above.
    pub fn to_false_colour(&self, full_scale: f64) -> Srgb8Picture {
        let pixels = self.delta_e.iter().zip(&self.coverage);
        let rgba = pixels.flat_map(|(&delta_e, &coverage)| {
            let [red, green, blue] = false_colour(f64::from(delta_e) / full_scale);
            [red, green, blue, (coverage * 255.0).round() as u8]
        });
        let clipped = self.delta_e.iter().filter(|&&delta_e| f64::from(delta_e) > full_scale).count();
        Srgb8Picture { width: self.width, height: self.height, rgba: rgba.collect(), clipped }
    }
}

/// Every eighth of matplotlib's colour map “inferno” (Smith & van der Walt 2015, CC0): even steps of lightness.
const INFERNO: [[u8; 3]; 9] = [
    [0, 0, 4],
    [31, 12, 72],
    [85, 15, 109],
    [136, 34, 106],
    [186, 54, 85],
    [227, 89, 51],
    [249, 140, 10],
    [249, 201, 50],
    [252, 255, 164],
];

/// The sRGB code of a share 0–1 of the full scale; beyond, the ends.
pub fn false_colour(share: f64) -> [u8; 3] {
    let position = share.clamp(0.0, 1.0) * (INFERNO.len() - 1) as f64;
    let index = (position as usize).min(INFERNO.len() - 2);
    let weight = position - index as f64;
    let mix = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * weight).round() as u8;
    std::array::from_fn(|i| mix(INFERNO[index][i], INFERNO[index + 1][i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{linear_from_srgb8, srgb8};
    use crate::fresnel::{CosTheta, FresnelModel};
    use crate::metal::metal_by_name;
    use crate::render::{Light, RadialTable, SphereView};

    #[test]
    fn identical_pictures_do_not_differ() {
        let table = RadialTable::of_model(&FresnelModel::Schlick { r: Rgb([0.9, 0.7, 0.4]) }, RgbSpace::LinRec709);
        let sphere = SphereView::new(64, Light::SoftBoxes, 0.3, RgbSpace::LinRec709).render(&table);
        let map = DeltaEMap::between(&sphere, &sphere);
        assert_eq!((map.max(), map.mean()), (0.0, 0.0));
    }

    /// Under white light the sphere's mean ΔE is the mean over angles weighted by sin θ cos θ.
    #[test]
    fn mean_over_the_sphere_is_the_weighted_mean_over_angles() {
        let (zinc, space) = (metal_by_name("zinc").unwrap(), RgbSpace::LinRec709);
        let schlick = FresnelModel::Schlick { r: zinc.r(space) };
        let view = SphereView::new(400, Light::White, 0.0, space);
        let truth = view.render(&RadialTable::of_metal(zinc, space));
        let map = DeltaEMap::between(&truth, &view.render(&RadialTable::of_model(&schlick, space)));
        let steps = 900;
        let (sum, weights) = (0..steps).fold((0.0, 0.0), |(sum, weights), i| {
            let c = CosTheta::from_deg((f64::from(i) + 0.5) * 90.0 / f64::from(steps));
            let weight = c.get() * (1.0 - c.get() * c.get()).sqrt();
            let delta_e = delta_e_rgb(zinc.reflectance(c, space), schlick.reflectance(c), space);
            (sum + weight * delta_e, weights + weight)
        });
        let expected = sum / weights;
        assert!((map.mean() / expected - 1.0).abs() < 0.01, "{} {expected}", map.mean());
    }

    #[test]
    fn false_colour_grows_in_lightness() {
        let lightness = |step: u32| {
            let linear = linear_from_srgb8(false_colour(f64::from(step) / 100.0));
            crate::color::Lab::from_rgb(linear, RgbSpace::LinRec709).lightness
        };
        assert!((1..=100).all(|step| lightness(step) >= lightness(step - 1)));
        assert_eq!(false_colour(7.0), false_colour(1.0));
        assert_eq!(srgb8(linear_from_srgb8(false_colour(0.0)), RgbSpace::LinRec709).0, [0, 0, 4]);
    }
}
