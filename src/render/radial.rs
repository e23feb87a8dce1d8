//! Reflectance over cos θ, tabulated: on a sphere seen from afar it only depends on the radius.

use rayon::prelude::*;

use super::facets::Facets;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{CosTheta, FresnelModel};
use crate::metal::Metal;

/// Intervals of the table. Linear interpolation is then off by at most 2.4e-6 on Schlick's x⁵.
const INTERVALS: usize = 1024;

/// Reflectance at equal steps of cos θ, and the space it is given in.
#[derive(Clone, Debug, PartialEq)]
pub struct RadialTable {
    space: RgbSpace,
    /// The fourth number is nothing: it makes a node as long as a vector of the processor.
    nodes: Vec<[f32; 4]>,
}

/// Where a cosine lies in any table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Which interval, below [`INTERVALS`].
    interval: u16,
    /// How far in it, 0–1.
    weight: f32,
}

impl RadialTable {
    /// The table of any reflectance that is a function of cos θ.
    pub fn new(space: RgbSpace, reflectance: impl Fn(CosTheta) -> Rgb + Sync) -> Self {
        let node = |i: usize| padded(reflectance(CosTheta::new(i as f64 / INTERVALS as f64)).0.map(|v| v as f32));
        Self { space, nodes: (0..INTERVALS + 1).into_par_iter().with_min_len(128).map(node).collect() }
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
        let [red, green, blue, _] = self.at_place(Place::of(cos_theta));
        [red, green, blue]
    }

    /// The reflectance at a place; the fourth number is nothing.
    #[inline]
    pub(super) fn at_place(&self, Place { interval, weight }: Place) -> [f32; 4] {
        let interval = usize::from(interval);
        let (low, high) = (self.nodes[interval], self.nodes[interval + 1]);
        std::array::from_fn(|i| low[i] + (high[i] - low[i]) * weight)
    }

    /// The reflectance a rough surface shows: the mean over the facets it mirrors with. Roughness is perceptual.
    pub fn rough(&self, roughness: f64) -> Self {
        Facets::new(roughness).map_or_else(|| self.clone(), |facets| self.over(&facets))
    }

    /// The mean over facets.
    pub(super) fn over(&self, facets: &Facets) -> Self {
        let coarse: Vec<[f32; 3]> = facets.means(|place| self.at_place(place));
        let intervals = coarse.len() - 1;
        let fine = |i: usize| {
            let position = i as f32 / INTERVALS as f32 * intervals as f32;
            let index = (position as usize).min(intervals - 1);
            let weight = position - index as f32;
            padded(std::array::from_fn(|c| coarse[index][c] + (coarse[index + 1][c] - coarse[index][c]) * weight))
        };
        Self { space: self.space, nodes: (0..=INTERVALS).map(fine).collect() }
    }
}

fn padded([red, green, blue]: [f32; 3]) -> [f32; 4] {
    [red, green, blue, 0.0]
}

impl Place {
    /// That of a cosine, which is held in `[0, 1]`; NaN is in the first interval.
    pub(super) fn of(cos_theta: f32) -> Self {
        let position = cos_theta.clamp(0.0, 1.0) * INTERVALS as f32;
        let interval = (position as u16).min(INTERVALS as u16 - 1);
        Self { interval, weight: position - f32::from(interval) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
