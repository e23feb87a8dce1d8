//! The lights a sphere can be shown under.

use std::fmt;
use std::str::FromStr;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::Environment;
use crate::color::{Rgb, RgbSpace, UnknownName};

/// A light around the sphere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Light {
    /// The same white from everywhere: the picture is the reflectance itself.
    White,
    /// Two soft boxes before a dark gradient; nothing is brighter than white.
    #[default]
    SoftBoxes,
    /// A photo studio (CC0 panorama, Poly Haven).
    PhotoStudio,
    /// A sunlit empty room (CC0 panorama, Poly Haven).
    SunlitRoom,
    /// A city square under cloud (CC0 panorama, Poly Haven).
    CitySquare,
}

impl Light {
    /// Every light, in menu order.
    pub const ALL: [Self; 5] = [Self::White, Self::SoftBoxes, Self::PhotoStudio, Self::SunlitRoom, Self::CitySquare];

    /// The stable identifier used in files and on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::White => "white",
            Self::SoftBoxes => "soft-boxes",
            Self::PhotoStudio => "photo-studio",
            Self::SunlitRoom => "sunlit-room",
            Self::CitySquare => "city-square",
        }
    }

    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::White => "White from everywhere",
            Self::SoftBoxes => "Soft boxes",
            Self::PhotoStudio => "Photo studio",
            Self::SunlitRoom => "Sunlit room",
            Self::CitySquare => "City square",
        }
    }

    /// The light as a map in linear Rec.709.
    ///
    /// Panoramas are scaled to a mean luminance of [`PANORAMA_MEAN`]; lamps and sky stay brighter than white.
    pub fn environment(self) -> &'static Environment {
        &ENVIRONMENTS[self as usize]
    }
}

/// Mean luminance of a panorama relative to white: about that of a room around a grey card.
pub const PANORAMA_MEAN: f64 = 0.45;

static ENVIRONMENTS: LazyLock<[Environment; 5]> = LazyLock::new(|| {
    [
        Environment::from_fn(4, |_| Rgb::WHITE),
        Environment::from_fn(256, soft_boxes),
        panorama(include_bytes!("../../assets/environments/studio.hdr")),
        panorama(include_bytes!("../../assets/environments/apartment.hdr")),
        panorama(include_bytes!("../../assets/environments/city.hdr")),
    ]
});

fn panorama(file: &[u8]) -> Environment {
    let image =
        image::load_from_memory_with_format(file, image::ImageFormat::Hdr).expect("a file that a test has read");
    let texels = image.to_rgb32f();
    let width = texels.width() as usize;
    let map = Environment::from_texels(width, texels.pixels().map(|pixel| pixel.0).collect());
    let scale = (PANORAMA_MEAN / RgbSpace::LinRec709.xyz(map.mean()).0[1]) as f32;
    Environment::from_texels(width, texels.pixels().map(|pixel| pixel.0.map(|v| v * scale)).collect())
}

/// A large box above left, a strip at the right, a gradient from floor to ceiling. The viewer is at +z.
fn soft_boxes([x, y, z]: [f64; 3]) -> Rgb {
    let gradient = 0.05 + 0.3 * smooth_step(-1.0, 1.0, y);
    let (azimuth_deg, elevation_deg) = (x.atan2(z).to_degrees(), y.asin().to_degrees());
    let soft_box = |azimuth: f64, elevation: f64, half_width: f64, half_height: f64| {
        let inside = |offset: f64, half: f64| smooth_step(half + 3.0, half - 3.0, offset.abs());
        inside(azimuth_deg - azimuth, half_width) * inside(elevation_deg - elevation, half_height)
    };
    let boxes = soft_box(-48.0, 38.0, 34.0, 26.0) + 0.75 * soft_box(82.0, 8.0, 14.0, 46.0);
    Rgb::splat(gradient + (1.0 - gradient) * boxes)
}

/// 3t² − 2t³ from one edge to the other.
fn smooth_step(from: f64, to: f64, value: f64) -> f64 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

impl fmt::Display for Light {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

impl FromStr for Light {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        let found = Self::ALL.into_iter().find(|light| light.id() == text);
        found.ok_or_else(|| UnknownName::new("light", text, Self::ALL.map(Self::id)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_light_reads_and_panoramas_have_the_stated_mean() {
        for light in Light::ALL {
            let mean = RgbSpace::LinRec709.xyz(light.environment().mean()).0[1];
            let expected = match light {
                Light::White => 1.0,
                Light::SoftBoxes => continue,
                _ => PANORAMA_MEAN,
            };
            assert!((mean - expected).abs() < 1e-5, "{light}: {mean}");
        }
    }

    #[test]
    fn soft_boxes_never_exceed_white() {
        let brightest = (0..10_000).map(|i| {
            let (azimuth, height) = (f64::from(i % 100) * 0.0628, f64::from(i / 100) / 50.0 - 0.99);
            let ring = (1.0 - height * height).sqrt();
            soft_boxes([ring * azimuth.sin(), height, ring * azimuth.cos()]).max_channel()
        });
        let brightest = brightest.fold(0.0, f64::max);
        assert!(brightest > 0.99 && brightest <= 1.0, "{brightest}");
    }

    #[test]
    fn identifiers_parse_back_and_match_the_files() {
        for light in Light::ALL {
            assert_eq!(light.id().parse(), Ok(light));
            assert_eq!(serde_json::to_string(&light).unwrap(), format!("\"{light}\""));
        }
    }
}
