//! Reflectance over cos θ, tabulated: on a sphere seen from afar it only depends on the radius.

use rayon::prelude::*;

use super::ggx::{Vector, hammersley, smith_lambda, visible_facet};
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{CosTheta, FresnelModel};
use crate::metal::Metal;

/// Intervals of the table. Linear interpolation is then off by at most 2.4e-6 on Schlick's x⁵.
const INTERVALS: usize = 1024;

/// Reflectance at equal steps of cos θ, and the space it is given in.
#[derive(Clone, Debug, PartialEq)]
pub struct RadialTable {
    space: RgbSpace,
    at_cos: Vec<[f32; 3]>,
}

impl RadialTable {
    /// The table of any reflectance that is a function of cos θ.
    pub fn new(space: RgbSpace, reflectance: impl Fn(CosTheta) -> Rgb + Sync) -> Self {
        let node = |i: usize| reflectance(CosTheta::new(i as f64 / INTERVALS as f64)).0.map(|v| v as f32);
        Self { space, at_cos: (0..INTERVALS + 1).into_par_iter().with_min_len(128).map(node).collect() }
    }

    /// The table of a model whose parameters are given in `space`.
    pub fn of_model(model: &FresnelModel, space: RgbSpace) -> Self {
        Self::new(space, |cos_theta| model.reflectance(cos_theta))
    }

    /// The table of a measured metal's ground truth.
    pub fn of_metal(metal: &Metal, space: RgbSpace) -> Self {
        Self::new(space, |cos_theta| metal.reflectance(cos_theta, space))
    }

    /// The space of the reflectances.
    pub fn space(&self) -> RgbSpace {
        self.space
    }

    /// The reflectance at a cosine, linear between the nodes.
    pub fn at(&self, cos_theta: f32) -> [f32; 3] {
        let position = cos_theta.clamp(0.0, 1.0) * INTERVALS as f32;
        let index = (position as usize).min(INTERVALS - 1);
        let weight = position - index as f32;
        let (low, high) = (self.at_cos[index], self.at_cos[index + 1]);
        std::array::from_fn(|i| low[i] + (high[i] - low[i]) * weight)
    }

    /// The reflectance a rough surface shows: the mean over the facets it mirrors with.
    ///
    /// Facets are drawn as seen (Heitz 2018) and weighted by Smith's height-correlated masking of
    /// the outgoing ray, over the weights' sum: what facets hide from each other is given back, so
    /// that white stays white. Roughness is perceptual; α is its square.
    pub fn rough(&self, roughness: f64) -> Self {
        let alpha = roughness.clamp(0.0, 1.0).powi(2);
        if alpha < 1e-3 {
            return self.clone();
        }
        let coarse: Vec<[f32; 3]> = (0..=ROUGH_INTERVALS)
            .into_par_iter()
            .map(|i| self.mean_over_facets(i as f64 / ROUGH_INTERVALS as f64, alpha))
            .collect();
        let fine = |i: usize| {
            let position = i as f32 / INTERVALS as f32 * ROUGH_INTERVALS as f32;
            let index = (position as usize).min(ROUGH_INTERVALS - 1);
            let weight = position - index as f32;
            std::array::from_fn(|c| coarse[index][c] + (coarse[index + 1][c] - coarse[index][c]) * weight)
        };
        Self { space: self.space, at_cos: (0..=INTERVALS).map(fine).collect() }
    }

    fn mean_over_facets(&self, cos_view: f64, alpha: f64) -> [f32; 3] {
        let cos_view = cos_view.max(1e-4);
        let view = Vector::new((1.0 - cos_view * cos_view).sqrt(), 0.0, cos_view);
        let view_lambda = smith_lambda(cos_view, alpha);
        let (mut sum, mut weights) = ([0.0; 3], 0.0);
        for index in 0..FACETS {
            let facet = visible_facet(view, hammersley(index, FACETS), alpha);
            let cos_facet = view.dot(&facet);
            let outgoing = 2.0 * cos_facet * facet.z - view.z;
            if outgoing > 0.0 {
                let weight = (1.0 + view_lambda) / (1.0 + view_lambda + smith_lambda(outgoing, alpha));
                let reflectance = self.at(cos_facet as f32);
                (0..3).for_each(|i| sum[i] += weight * f64::from(reflectance[i]));
                weights += weight;
            }
        }
        sum.map(|v| (v / weights) as f32)
    }
}

/// A lobe average is smooth: few angles and facets do.
const ROUGH_INTERVALS: usize = 128;
const FACETS: u32 = 128;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::{h_of_schlick, hoffman};

    fn gold() -> FresnelModel {
        FresnelModel::Hoffman { r: Rgb([1.02, 0.76, 0.33]), h: Rgb([1.0, 0.86, 0.65]) }
    }

    #[test]
    fn table_is_the_model_between_the_nodes_too() {
        let table = RadialTable::of_model(&gold(), RgbSpace::LinRec709);
        for step in 0..=10_000 {
            let c = f64::from(step) / 10_000.0;
            let exact = gold().reflectance(CosTheta::new(c));
            assert!(Rgb(table.at(c as f32).map(f64::from)).max_abs_difference(exact) < 1e-5, "{c}");
        }
    }

    #[test]
    fn a_rough_white_surface_is_white() {
        let white = RadialTable::new(RgbSpace::LinRec709, |_| Rgb::WHITE);
        let rough = white.rough(0.7);
        assert!((0..=50).all(|i| rough.at(i as f32 / 50.0).iter().all(|v| (v - 1.0).abs() < 1e-6)));
    }

    /// As roughness goes to 0 the mean over facets goes to the mirror's reflectance.
    #[test]
    fn roughness_converges_to_the_mirror() {
        let mirror = RadialTable::of_model(&gold(), RgbSpace::LinRec709);
        let distance = |roughness: f64| {
            let rough = mirror.rough(roughness);
            let at = |i: u32| (i as f32 + 0.5) / 20.0;
            (2..20).map(|i| (rough.at(at(i))[2] - mirror.at(at(i))[2]).abs()).fold(0.0, f32::max)
        };
        // α is the square of roughness: halving roughness must at least quarter the effect.
        assert!(distance(0.1) < distance(0.2) / 4.0 && distance(0.2) < distance(0.4) / 4.0);
    }

    /// Facets that mirror towards the eye at grazing face it more than the surface does: the rim of
    /// a rough sphere is darker than that of a mirror.
    #[test]
    fn roughness_lowers_grazing_reflectance() {
        let mirror = RadialTable::new(RgbSpace::LinRec709, |c| Rgb::splat(hoffman(0.5, h_of_schlick(0.5), c)));
        assert!(mirror.rough(0.6).at(0.0)[0] < mirror.at(0.0)[0] - 0.1);
    }
}
