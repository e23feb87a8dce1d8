//! What a ball mirrors: a light tent or a panorama, and the floor it stands on.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;
use thiserror::Error;

use crate::color::Rgb;

/// A direction or a point: x to the right, y up, z towards the camera. The ball has radius 1 around the origin.
pub type Vec3 = Vector3<f64>;

/// Light from every direction; neutral spectra scaled by linear Rec.709.
#[derive(Clone, Debug)]
pub enum Dome {
    /// A light tent.
    Tent(Tent),
    /// A photographed panorama.
    Panorama(Panorama),
}

/// A light tent of radiance 1 with the unevenness real tents have.
#[derive(Clone, Copy, Debug)]
pub struct Tent {
    /// Change of the radiance from the horizon to the top.
    pub top: f64,
    /// Change from the middle to the right.
    pub right: f64,
    /// Radius of the lens that looks in, as an angle in degrees; 0 for none.
    pub lens_deg: f64,
    /// How far a rectangular lamp on the left outshines the tent; 0 for none.
    pub lamp: f64,
    /// Darkening of everything behind the ball beyond this angle from the camera, in degrees.
    pub dark_beyond_deg: Option<f64>,
    /// Tint of the light.
    pub tint: Rgb,
}

impl Default for Tent {
    fn default() -> Self {
        Self { top: 0.0, right: 0.0, lens_deg: 0.0, lamp: 0.0, dark_beyond_deg: None, tint: Rgb::WHITE }
    }
}

impl Tent {
    fn radiance(&self, direction: &Vec3) -> Rgb {
        let angle_deg = direction.z.clamp(-1.0, 1.0).acos().to_degrees();
        let gradient = 1.0 + self.top * direction.y + self.right * direction.x;
        let lens = 1.0 - 0.96 * smooth_step(self.lens_deg + 0.6, self.lens_deg - 0.6, angle_deg);
        let backdrop =
            self.dark_beyond_deg.map_or(1.0, |limit| 1.0 - 0.9 * smooth_step(limit - 2.0, limit + 2.0, angle_deg));
        let lens = if self.lens_deg > 0.0 { lens } else { 1.0 };
        self.tint * (gradient * lens * backdrop + self.lamp * lamp(direction))
    }
}

/// A softbox on the upper left: 1 inside, with soft edges.
fn lamp(direction: &Vec3) -> f64 {
    let centre = Vec3::new(-0.74, 0.52, 0.42).normalize();
    let right = Vec3::y().cross(&centre).normalize();
    let up = centre.cross(&right);
    let depth = direction.dot(&centre);
    if depth <= 0.2 {
        return 0.0;
    }
    let edge = |offset: f64, half: f64| smooth_step(half + 0.015, half - 0.015, (offset / depth).abs());
    edge(direction.dot(&right), 0.22) * edge(direction.dot(&up), 0.32)
}

/// 0 below `from`, 1 above `to` (or the other way where `from` > `to`), smooth between.
pub(super) fn smooth_step(from: f64, to: f64, value: f64) -> f64 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// An equirectangular picture of the surroundings, linear Rec.709, its middle seen by the camera.
#[derive(Clone, Debug)]
pub struct Panorama {
    width: usize,
    height: usize,
    pixels: Vec<Rgb>,
    yaw_deg: f64,
}

/// Why an environment could not be read.
#[derive(Debug, Error)]
#[error("the environment is no Radiance picture: {0}")]
pub struct PanoramaError(#[from] image::ImageError);

impl Panorama {
    /// Decodes a Radiance picture, scales its mean to 1 and limits lamps to `brightest` times that.
    ///
    /// At a yaw of 0 the camera looks at the middle of the picture, at 90 a quarter further right.
    pub fn from_hdr(bytes: &[u8], brightest: f64, yaw_deg: f64) -> Result<Self, PanoramaError> {
        let picture = image::load_from_memory_with_format(bytes, image::ImageFormat::Hdr)?.into_rgb32f();
        let (width, height) = (picture.width() as usize, picture.height() as usize);
        let mut pixels: Vec<Rgb> = picture.pixels().map(|pixel| Rgb(pixel.0.map(f64::from))).collect();
        let latitude = |index: usize| PI * (0.5 - ((index / width) as f64 + 0.5) / height as f64);
        let luminance = |rgb: &Rgb| 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
        let weighted =
            pixels.iter().enumerate().map(|(i, rgb)| (latitude(i).cos() * luminance(rgb), latitude(i).cos()));
        let (sum, weight) = weighted.fold((0.0, 0.0), |(a, b), (c, d)| (a + c, b + d));
        let scale = weight / sum;
        for pixel in &mut pixels {
            let limited = (brightest / (luminance(pixel) * scale)).min(1.0);
            *pixel = *pixel * (scale * limited);
        }
        Ok(Self { width, height, pixels, yaw_deg })
    }

    /// Bilinear, wrapping around; the camera looks along −z.
    fn radiance(&self, direction: &Vec3) -> Rgb {
        let turn = direction.x.atan2(-direction.z) / TAU + self.yaw_deg / 360.0;
        let u = (0.5 + turn) * self.width as f64 - 0.5;
        let v = direction.y.clamp(-1.0, 1.0).acos() / PI * self.height as f64 - 0.5;
        let (column, row) = (u.floor(), v.floor());
        let at = |dx: f64, dy: f64| {
            let x = (column + dx).rem_euclid(self.width as f64) as usize % self.width;
            let y = (row + dy).clamp(0.0, self.height as f64 - 1.0) as usize;
            self.pixels[y * self.width + x]
        };
        let (s, t) = (u - column, v - row);
        at(0.0, 0.0).lerp(at(1.0, 0.0), s).lerp(at(0.0, 1.0).lerp(at(1.0, 1.0), s), t)
    }
}

impl Dome {
    /// Radiance from a direction.
    pub fn radiance(&self, direction: &Vec3) -> Rgb {
        match self {
            Self::Tent(tent) => tent.radiance(direction),
            Self::Panorama(panorama) => panorama.radiance(direction),
        }
    }

    /// What a white matt surface of this normal sends back: irradiance over π, by a fixed grid of directions.
    pub fn white_radiance(&self, normal: &Vec3) -> Rgb {
        const RINGS: usize = 24;
        const SPOKES: usize = 48;
        let side = if normal.y.abs() > 0.9 { Vec3::x() } else { Vec3::y() };
        let (u, v) = (normal.cross(&side).normalize(), normal.cross(&side).normalize().cross(normal));
        let mut sum = Rgb::BLACK;
        for ring in 0..RINGS {
            // Equal steps of sin² make every direction weigh the same under the cosine.
            let sin2 = (ring as f64 + 0.5) / RINGS as f64;
            for spoke in 0..SPOKES {
                let (sin, cos) = (TAU * (spoke as f64 + 0.5) / SPOKES as f64).sin_cos();
                sum += self.radiance(&(normal * (1.0 - sin2).sqrt() + (u * cos + v * sin) * sin2.sqrt()));
            }
        }
        sum / (RINGS * SPOKES) as f64
    }
}

/// A matt floor under the ball.
#[derive(Clone, Copy, Debug)]
pub struct Floor {
    /// Radiance far from the ball.
    pub radiance: Rgb,
    /// Where the floor fades into the surroundings, in ball radii behind the ball.
    pub ends_at: f64,
    /// How far the ball darkens the floor where it stands, 0 to 1.
    pub shadow: f64,
    /// What the metal throws back into its own shadow.
    pub bounce: Rgb,
}

impl Floor {
    /// The radiance of a point on the floor, and how much of it there is before it fades.
    pub(super) fn at(&self, point: &Vec3) -> (Rgb, f64) {
        let s2 = point.x * point.x + point.z * point.z;
        // Form factor of a unit sphere on the floor: h / (s² + h²)^(3/2) with h = 1 (Howell, C-44).
        let covered = self.shadow / (1.0 + s2).powf(1.5);
        let light = self.radiance * (1.0 - covered) + self.bounce * covered;
        let distance = s2.sqrt();
        (light, smooth_step(self.ends_at * 1.6, self.ends_at * 0.5, distance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_tent_makes_white_white() {
        let dome = Dome::Tent(Tent::default());
        for normal in [Vec3::y(), Vec3::z(), Vec3::new(0.6, 0.0, 0.8)] {
            assert!(dome.white_radiance(&normal).max_abs_difference(Rgb::WHITE) < 1e-12);
        }
    }

    /// A gradient g·y over the hemisphere around y: E/π = 1 + 2g/3.
    #[test]
    fn the_grid_of_directions_integrates() {
        let dome = Dome::Tent(Tent { top: 0.3, ..Tent::default() });
        assert!((dome.white_radiance(&Vec3::y())[0] - 1.2).abs() < 1e-3);
        assert!((dome.white_radiance(&Vec3::x())[0] - 1.0).abs() < 1e-12);
    }
}
