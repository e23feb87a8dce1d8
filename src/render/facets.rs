//! The facets of a rough surface that mirror to the viewer.

use rayon::prelude::*;

use super::ggx::{Vector, hammersley, smith_lambda, visible_facet};
use super::radial::Place;

/// For angles of view at equal steps of the cosine, the angles at which the facets are seen that a rough surface mirrors
/// with, and their weights.
///
/// Facets are drawn as seen (Heitz 2018) and weighted by Smith's height-correlated masking of
/// the outgoing ray, over the weights' sum: what facets hide from each other is given back, so
/// that white stays white.
#[derive(Clone, Debug)]
pub(super) struct Facets(Vec<Vec<(Place, f64)>>);

/// A lobe average is smooth: few angles and facets do.
const INTERVALS: usize = 128;
const FACETS: u32 = 128;

impl Facets {
    /// Those of a perceptual roughness of 0–1, the root of α; `None` of a mirror.
    pub(super) fn new(roughness: f64) -> Option<Self> {
        let alpha = roughness.clamp(0.0, 1.0).powi(2);
        let seen_at = |step: usize| facets_seen(step as f64 / INTERVALS as f64, alpha);
        (alpha >= 1e-3).then(|| Self((0..=INTERVALS).into_par_iter().map(seen_at).collect()))
    }

    /// The mean of a quantity over the facets, for each angle of view.
    pub(super) fn means(&self, quantity: impl Fn(Place) -> [f32; 4]) -> Vec<[f32; 3]> {
        let mean = |facets: &Vec<(Place, f64)>| {
            let mut sum = [0.0; 3];
            for &(place, weight) in facets {
                let own = quantity(place);
                (0..3).for_each(|i| sum[i] += weight * f64::from(own[i]));
            }
            sum.map(|v| v as f32)
        };
        self.0.iter().map(mean).collect()
    }
}

fn facets_seen(cos_view: f64, alpha: f64) -> Vec<(Place, f64)> {
    let cos_view = cos_view.max(1e-4);
    let view = Vector::new((1.0 - cos_view * cos_view).sqrt(), 0.0, cos_view);
    let view_lambda = smith_lambda(cos_view, alpha);
    let facet = |index| {
        let facet = visible_facet(view, hammersley(index, FACETS), alpha);
        let cos_facet = view.dot(&facet);
        let outgoing = 2.0 * cos_facet * facet.z - view.z;
        let weight = || (1.0 + view_lambda) / (1.0 + view_lambda + smith_lambda(outgoing, alpha));
        (outgoing > 0.0).then(|| (Place::of(cos_facet as f32), weight()))
    };
    let mut facets: Vec<(Place, f64)> = (0..FACETS).filter_map(facet).collect();
    let weights: f64 = facets.iter().map(|(_, weight)| weight).sum();
    facets.iter_mut().for_each(|(_, weight)| *weight /= weights);
    facets
}

#[cfg(test)]
mod tests {
    use crate::color::{Rgb, RgbSpace};
    use crate::fresnel::{FresnelModel, h_of_schlick, hoffman};
    use crate::render::RadialTable;

    #[test]
    fn a_rough_white_surface_is_white() {
        let white = RadialTable::new(RgbSpace::LinRec709, |_| Rgb::WHITE);
        let rough = white.rough(0.7);
        assert!((0..=50).all(|i| rough.at(i as f32 / 50.0).iter().all(|v| (v - 1.0).abs() < 1e-6)));
    }

    /// As roughness goes to 0 the mean over facets goes to the mirror's reflectance.
    #[test]
    fn roughness_converges_to_the_mirror() {
        let gold = FresnelModel::Hoffman { r: Rgb([1.02, 0.76, 0.33]), h: Rgb([1.0, 0.86, 0.65]) };
        let mirror = RadialTable::of_model(&gold, RgbSpace::LinRec709);
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
