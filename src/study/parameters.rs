//! The four descriptions of a metal's edge that the paper compares, as two triples each.

use std::{fmt, str::FromStr};

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, UnknownName};
use crate::fresnel::{CosTheta, FresnelModel, whole_degrees};

/// Which parameters describe a metal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Parameters {
    /// r and h: two reflectances (the paper's section 8).
    H,
    /// r and F82-tint's t, a multiple of Schlick's value.
    T,
    /// r and Gulbrandsen's g, an interpolation between indices.
    G,
    /// n and k of each channel.
    Nk,
}

impl Parameters {
    /// All four, in the order of every table and figure.
    pub const ALL: [Self; 4] = [Self::H, Self::T, Self::G, Self::Nk];

    /// The stable identifier used in files and on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::H => "h",
            Self::T => "t",
            Self::G => "g",
            Self::Nk => "nk",
        }
    }

    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::H => "r, h",
            Self::T => "r, t",
            Self::G => "r, g",
            Self::Nk => "n, k",
        }
    }

    /// Symbols of the two triples.
    pub const fn symbols(self) -> [&'static str; 2] {
        match self {
            Self::H => ["r", "h"],
            Self::T => ["r", "t"],
            Self::G => ["r", "g"],
            Self::Nk => ["n", "k"],
        }
    }
}

impl fmt::Display for Parameters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

impl FromStr for Parameters {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        let found = Self::ALL.into_iter().find(|parameters| parameters.id() == text);
        found.ok_or_else(|| UnknownName::new("parameters", text, Self::ALL.map(Self::id)))
    }
}

/// A metal described by one of the four: two triples that people treat as colours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Pair {
    /// What the triples are.
    pub parameters: Parameters,
    /// r, or n.
    pub first: Rgb,
    /// h, t, g, or k.
    pub edge: Rgb,
}

/// How far outside its domain rounding may put a parameter.
const ROUNDING: f64 = 1e-12;

impl Pair {
    /// Two triples as `parameters`.
    pub const fn new(parameters: Parameters, first: Rgb, edge: Rgb) -> Self {
        Self { parameters, first, edge }
    }

    /// The model with these parameters.
    pub const fn model(self) -> FresnelModel {
        let Self { first, edge, .. } = self;
        match self.parameters {
            Parameters::H => FresnelModel::Hoffman { r: first, h: edge },
            Parameters::T => FresnelModel::F82Tint { r: first, t: edge },
            Parameters::G => FresnelModel::Gulbrandsen { r: first, g: edge },
            Parameters::Nk => FresnelModel::Conductor { n: first, k: edge },
        }
    }

    /// The reflectance at an angle; NaN outside the domain.
    pub fn reflectance(self, cos_theta: CosTheta) -> Rgb {
        self.model().reflectance(cos_theta)
    }

    /// The reflectance at 0°, 1°, …, 90°.
    pub fn curve(self) -> Vec<Rgb> {
        whole_degrees().map(|cos_theta| self.reflectance(cos_theta)).collect()
    }

    /// Both triples changed in the same way.
    pub fn map(self, f: impl Fn(Rgb) -> Rgb) -> Self {
        Self { first: f(self.first), edge: f(self.edge), ..self }
    }

    /// Both triples multiplied by a matrix, as if they were colours.
    pub fn converted(self, matrix: &Matrix3<f64>) -> Self {
        self.map(|triple| transformed(matrix, triple))
    }

    /// Both triples blended with those of another pair of the same parameters, as a texture filter does.
    pub fn lerp(self, other: Self, weight: f64) -> Self {
        assert_eq!(self.parameters, other.parameters, "h blends with h, g with g");
        Self {
            first: self.first.lerp(other.first, weight),
            edge: self.edge.lerp(other.edge, weight),
            parameters: self.parameters,
        }
    }

    /// How many of the six numbers stand for no material at all.
    ///
    /// Every finite r, h and t has a curve. r beside g must lie in 0–1 and so must g; n and k must not be negative.
    pub fn outside_domain(self) -> usize {
        let limited = self.limited();
        let differences = [self.first - limited.first, self.edge - limited.edge];
        differences.iter().flat_map(|triple| triple.0).filter(|d| d.is_nan() || d.abs() > ROUNDING).count()
    }

    /// The nearest parameters with a curve: what a program has to do before it can evaluate them.
    pub fn limited(self) -> Self {
        match self.parameters {
            Parameters::H | Parameters::T => self,
            Parameters::G => self.map(Rgb::clipped),
            Parameters::Nk => self.map(|triple| triple.map(|v| v.max(0.0))),
        }
    }
}

/// A triple multiplied by a matrix.
pub(super) fn transformed(matrix: &Matrix3<f64>, rgb: Rgb) -> Rgb {
    Rgb::from(matrix * Vector3::from(rgb))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_parse_back_and_match_the_files() {
        for parameters in Parameters::ALL {
            assert_eq!(parameters.id().parse(), Ok(parameters));
            assert_eq!(serde_json::to_string(&parameters).unwrap(), format!("\"{parameters}\""));
        }
    }

    #[test]
    fn only_g_and_n_k_can_leave_their_domain() {
        let (first, edge) = (Rgb([1.1, 0.5, -0.1]), Rgb([0.5, 1.2, 0.4]));
        let outside = Parameters::ALL.map(|parameters| Pair::new(parameters, first, edge).outside_domain());
        assert_eq!(outside, [0, 0, 3, 1]);
        for parameters in Parameters::ALL {
            let limited = Pair::new(parameters, first, edge).limited();
            assert!(limited.outside_domain() == 0 && limited.curve().iter().all(|rgb| rgb.is_finite()), "{parameters}");
        }
    }
}
