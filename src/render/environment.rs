//! Radiance from every direction, as an equirectangular map.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use super::ggx::{Vector, facet_around_z, ggx_density, hammersley};
use crate::color::{Rgb, RgbSpace};

/// Radiance over the sphere of directions: row 0 looks up (+y), the centre of the map looks along −z.
#[derive(Clone, Debug)]
pub struct Environment {
    /// The map, then each half as wide as the one before.
    levels: Vec<Level>,
}

#[derive(Clone, Debug)]
struct Level {
    width: usize,
    height: usize,
    radiance: Vec<[f32; 3]>,
}

impl Environment {
    /// A map of `width` × `width / 2` from the radiance of unit directions; `width` is a power of two, at least 4.
    pub fn from_fn(width: usize, radiance: impl Fn([f64; 3]) -> Rgb + Sync) -> Self {
        let height = width / 2;
        let texel = |index: usize| {
            let (row, column) = (index / width, index % width);
            let direction = direction_of((column as f64 + 0.5) / width as f64, (row as f64 + 0.5) / height as f64);
            radiance(direction.into()).0.map(|v| v as f32)
        };
        Self::from_texels(width, (0..width * height).into_par_iter().map(texel).collect())
    }

    /// A map from its texels, row by row; `radiance` holds `width` × `width / 2` of them.
    ///
    /// # Panics
    /// If it does not, or `width` is no power of two of at least 4.
    pub fn from_texels(width: usize, radiance: Vec<[f32; 3]>) -> Self {
        assert!(width.is_power_of_two() && width >= 4 && radiance.len() == width * width / 2, "an equirectangular map");
        let mut levels = vec![Level { width, height: width / 2, radiance }];
        while levels[levels.len() - 1].height > 1 {
            levels.push(levels[levels.len() - 1].halved());
        }
        Self { levels }
    }

    /// The same light in another space's values.
    pub fn converted(&self, from: RgbSpace, to: RgbSpace) -> Self {
        let matrix = from.matrix_to(to).cast::<f32>();
        let texels = self.levels[0].radiance.iter().map(|&rgb| (matrix * nalgebra::Vector3::from(rgb)).into());
        Self::from_texels(self.levels[0].width, texels.collect())
    }

    /// The radiance of a unit direction, bilinear.
    pub fn radiance(&self, direction: [f64; 3]) -> [f32; 3] {
        self.levels[0].bilinear(Vector::from(direction))
    }

    /// Mean radiance over all directions.
    pub fn mean(&self) -> Rgb {
        let level = &self.levels[0];
        let rows = level.radiance.chunks(level.width).enumerate().map(|(row, texels)| {
            let weight = (PI * (row as f64 + 0.5) / level.height as f64).sin();
            let sum = texels.iter().fold(Rgb::BLACK, |sum, rgb| sum + Rgb(rgb.map(f64::from)));
            (sum * weight, weight * level.width as f64)
        });
        let (sum, weights) = rows.fold((Rgb::BLACK, 0.0), |(s, w), (sum, weight)| (s + sum, w + weight));
        sum / weights
    }

    /// What a rough mirror sees in each direction it mirrors to: the map blurred by the GGX lobe.
    ///
    /// The lobe is taken as seen along the normal (Karis 2013, "Real Shading in Unreal Engine 4"),
    /// each sample from the level whose texels are as large as its share of the lobe (Křivánek &
    /// Colbert 2008). Roughness is perceptual; α is its square.
    pub fn blurred(&self, roughness: f64) -> Self {
        let alpha = roughness.clamp(0.0, 1.0).powi(2);
        if alpha < 1e-3 {
            return self.clone();
        }
        let lobe = self.lobe(alpha);
        let width = ((8.0 / alpha) as usize).next_power_of_two().clamp(64, self.levels[0].width.max(64));
        Self::from_fn(width, |direction| self.mean_over_lobe(&lobe, Vector::from(direction)))
    }

    /// Directions around z with their weights and the level to take them from.
    fn lobe(&self, alpha: f64) -> Vec<(Vector, f64, usize)> {
        const SAMPLES: u32 = 64;
        let texel = 4.0 * PI / self.levels[0].radiance.len() as f64;
        let sample = |index| {
            let facet = facet_around_z(hammersley(index, SAMPLES), alpha);
            let outgoing = Vector::new(2.0 * facet.z * facet.x, 2.0 * facet.z * facet.y, 2.0 * facet.z * facet.z - 1.0);
            let solid_angle = 4.0 / (f64::from(SAMPLES) * ggx_density(facet.z, alpha));
            let level = (0.5 * (solid_angle / texel).log2() + 1.0).round().max(0.0) as usize;
            (outgoing, outgoing.z, level.min(self.levels.len() - 1))
        };
        (0..SAMPLES).map(sample).filter(|(_, weight, _)| *weight > 0.0).collect()
    }

    fn mean_over_lobe(&self, lobe: &[(Vector, f64, usize)], axis: Vector) -> Rgb {
        let helper = if axis.y.abs() < 0.9 { Vector::y() } else { Vector::x() };
        let tangent = helper.cross(&axis).normalize();
        let bitangent = axis.cross(&tangent);
        let (mut sum, mut weights) = (Rgb::BLACK, 0.0);
        for &(local, weight, level) in lobe {
            let direction = tangent * local.x + bitangent * local.y + axis * local.z;
            sum += Rgb(self.levels[level].bilinear(direction).map(f64::from)) * weight;
            weights += weight;
        }
        sum / weights
    }
}

/// The unit direction of a place on the map, both coordinates 0–1.
fn direction_of(u: f64, v: f64) -> Vector {
    let (azimuth, polar) = (TAU * (u - 0.5), PI * v);
    Vector::new(polar.sin() * azimuth.sin(), polar.cos(), -polar.sin() * azimuth.cos())
}

impl Level {
    fn halved(&self) -> Self {
        let (width, height) = (self.width / 2, self.height / 2);
        let texel = |index: usize| {
            let (row, column) = (2 * (index / width), 2 * (index % width));
            let corner = |dr: usize, dc: usize| self.radiance[(row + dr) * self.width + column + dc];
            let corners = [corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1)];
            std::array::from_fn(|i| corners.iter().map(|rgb| rgb[i]).sum::<f32>() / 4.0)
        };
        Self { width, height, radiance: (0..width * height).map(texel).collect() }
    }

    fn bilinear(&self, direction: Vector) -> [f32; 3] {
        let u = 0.5 + direction.x.atan2(-direction.z) / TAU;
        let v = direction.y.clamp(-1.0, 1.0).acos() / PI;
        let (x, y) = (u * self.width as f64 - 0.5, (v * self.height as f64 - 0.5).clamp(0.0, (self.height - 1) as f64));
        let (wx, wy) = ((x - x.floor()) as f32, (y - y.floor()) as f32);
        let column = |offset: i64| (x.floor() as i64 + offset).rem_euclid(self.width as i64) as usize;
        let row = |offset: usize| (y as usize + offset).min(self.height - 1) * self.width;
        let texels = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| self.radiance[row(dy) + column(dx)]);
        std::array::from_fn(|i| {
            let across = |a: usize, b: usize| texels[a][i] + (texels[b][i] - texels[a][i]) * wx;
            across(0, 1) + (across(2, 3) - across(0, 1)) * wy
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A lobe's weights sum to one: constant light stays constant.
    #[test]
    fn constant_light_stays_constant() {
        let constant = Environment::from_fn(64, |_| Rgb([0.2, 0.4, 0.8]));
        for roughness in [0.0, 0.2, 0.5, 1.0] {
            let blurred = constant.blurred(roughness);
            assert!(blurred.mean().max_abs_difference(Rgb([0.2, 0.4, 0.8])) < 1e-6, "{roughness}");
            assert!((blurred.radiance([0.6, 0.8, 0.0])[1] - 0.4).abs() < 1e-6);
        }
    }

    #[test]
    fn directions_lead_to_their_texels() {
        let by_direction = Environment::from_fn(256, Rgb);
        for direction in [[0.0, 0.6, 0.8], [0.6, 0.0, -0.8], [-0.48, -0.64, 0.6], [0.8, -0.6, 0.0]] {
            let found = Rgb(by_direction.radiance(direction).map(f64::from));
            assert!(found.max_abs_difference(Rgb(direction)) < 1e-3, "{direction:?} {found:?}");
        }
    }

    #[test]
    fn a_rougher_mirror_sees_a_lamp_dimmer_and_wider() {
        let lamp = Environment::from_fn(256, |[_, y, _]| Rgb::splat(f64::from(u8::from(y > 0.98))));
        let (sharp, soft) = (lamp.blurred(0.3), lamp.blurred(0.7));
        let aside = [0.8, 0.6, 0.0];
        assert!(sharp.radiance([0.0, 1.0, 0.0])[0] > soft.radiance([0.0, 1.0, 0.0])[0]);
        assert!(sharp.radiance(aside)[0] < soft.radiance(aside)[0]);
    }
}
