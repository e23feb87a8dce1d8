//! The ways people derive a model's parameters from a measured metal.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use crate::color::UnknownName;
use crate::fresnel::ModelKind;
use crate::spectrum::{FIRST_NM, LAST_NM};

/// One wavelength for each channel, in whole nanometres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Triple {
    /// Stands for the red channel.
    pub red_nm: u16,
    /// Stands for the green channel.
    pub green_nm: u16,
    /// Stands for the blue channel.
    pub blue_nm: u16,
}

impl Triple {
    /// 650/550/450 nm, the usual round numbers.
    pub const ROUND: Self = Self { red_nm: 650, green_nm: 550, blue_nm: 450 };
    /// 630/532/465 nm, near the primaries of Rec.2020.
    pub const PRIMARIES: Self = Self { red_nm: 630, green_nm: 532, blue_nm: 465 };

    /// The wavelengths in the order of the channels.
    pub const fn nm(self) -> [u16; 3] {
        [self.red_nm, self.green_nm, self.blue_nm]
    }
}

/// How the parameters of a model are derived from a measured metal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// r, and h where there is one, read off the ground truth.
    Exact,
    /// n and k taken at one wavelength per channel; for (r, g) only g is, r is exact.
    Points(Triple),
    /// n and k averaged over thirds of 400–700 nm; for (r, g) only g is, r is exact.
    BandAverage,
    /// n and k weighted by the illuminant and the colour-matching functions, through the space's matrix.
    ColourMatching,
    /// r exact, and g = 0.5: what a user interface starts with.
    DefaultTint,
    /// Least squares of the linear reflectance over 0°, 1°, …, 90°, channel by channel.
    LeastSquares,
    /// Smallest largest difference of the linear reflectance over the angles, channel by channel.
    MinMax,
    /// Smallest mean CIEDE2000 over the angles, all channels together, by a numerical search.
    BlackBox,
}

impl Method {
    /// Every method; point sampling with the two usual triples.
    pub const ALL: [Self; 9] = [
        Self::Exact,
        Self::Points(Triple::ROUND),
        Self::Points(Triple::PRIMARIES),
        Self::BandAverage,
        Self::ColourMatching,
        Self::DefaultTint,
        Self::LeastSquares,
        Self::MinMax,
        Self::BlackBox,
    ];

    /// The methods that make sense for a model, in the order of [`Method::ALL`].
    pub fn of(kind: ModelKind) -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(move |method| method.applies_to(kind))
    }

    /// Whether people use this method for a model.
    pub const fn applies_to(self, kind: ModelKind) -> bool {
        use ModelKind as K;
        match self {
            Self::Exact => !matches!(kind, K::Lazanyi | K::Gulbrandsen | K::Conductor),
            Self::Points(_) | Self::BandAverage | Self::ColourMatching => matches!(kind, K::Gulbrandsen | K::Conductor),
            Self::DefaultTint | Self::MinMax => matches!(kind, K::Gulbrandsen),
            Self::LeastSquares | Self::BlackBox => true,
        }
    }

    /// The stable identifier used in files and on the command line.
    pub fn id(self) -> String {
        match self {
            Self::Exact => "exact".to_owned(),
            Self::Points(t) => format!("points-{}-{}-{}", t.red_nm, t.green_nm, t.blue_nm),
            Self::BandAverage => "band-average".to_owned(),
            Self::ColourMatching => "colour-matching".to_owned(),
            Self::DefaultTint => "default-g".to_owned(),
            Self::LeastSquares => "least-squares".to_owned(),
            Self::MinMax => "min-max".to_owned(),
            Self::BlackBox => "black-box".to_owned(),
        }
    }

    /// The name people read.
    pub fn label(self) -> String {
        match self {
            Self::Exact => "exact, from the truth".to_owned(),
            Self::Points(t) => format!("sampled at {}/{}/{} nm", t.red_nm, t.green_nm, t.blue_nm),
            Self::BandAverage => "averaged over 600–700/500–600/400–500 nm".to_owned(),
            Self::ColourMatching => "weighted by the colour-matching functions".to_owned(),
            Self::DefaultTint => "r exact, g = 0.5".to_owned(),
            Self::LeastSquares => "least squares over the angles".to_owned(),
            Self::MinMax => "smallest largest difference over the angles".to_owned(),
            Self::BlackBox => "smallest mean ΔE, by numerical search".to_owned(),
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.id())
    }
}

impl FromStr for Method {
    type Err = UnknownName;

    /// An [`id`](Method::id); `points-R-G-B` takes any whole nanometres of the visible.
    fn from_str(text: &str) -> Result<Self, UnknownName> {
        let named = Self::ALL.into_iter().find(|method| method.id() == text);
        named.or_else(|| points(text)).ok_or_else(|| UnknownName::new("method", text, NAMES))
    }
}

const NAMES: [&str; 8] = [
    "exact",
    "points-650-550-450 (or other whole nanometres of 380–780, red first)",
    "band-average",
    "colour-matching",
    "default-g",
    "least-squares",
    "min-max",
    "black-box",
];

fn points(text: &str) -> Option<Method> {
    let visible = |nm: &u16| (FIRST_NM..=LAST_NM).contains(&usize::from(*nm));
    let numbers: Option<Vec<u16>> =
        text.strip_prefix("points-")?.split('-').map(|nm| nm.parse().ok().filter(visible)).collect();
    match numbers?[..] {
        [red_nm, green_nm, blue_nm] => Some(Method::Points(Triple { red_nm, green_nm, blue_nm })),
        _ => None,
    }
}

impl Serialize for Method {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Method {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_parse_back() {
        let own = Method::Points(Triple { red_nm: 612, green_nm: 549, blue_nm: 465 });
        for method in Method::ALL.into_iter().chain([own]) {
            assert_eq!(method.id().parse(), Ok(method));
            let json = serde_json::to_string(&method).unwrap();
            assert_eq!(serde_json::from_str::<Method>(&json).unwrap(), method);
        }
    }

    #[test]
    fn refuses_other_names_and_invisible_light() {
        for text in ["", "points", "points-650-550", "points-650-550-450-1", "points-1000-550-450", "points-a-b-c"] {
            assert!(text.parse::<Method>().unwrap_err().to_string().contains("points-650-550-450"), "{text}");
        }
    }

    #[test]
    fn every_model_has_a_method_and_every_method_a_model() {
        assert!(ModelKind::ALL.into_iter().all(|kind| Method::of(kind).count() > 0));
        for method in Method::ALL {
            assert!(ModelKind::ALL.into_iter().any(|kind| method.applies_to(kind)), "{method}");
        }
    }
}
