//! The ways to store and evaluate a material that a person can choose between, each with its parameters.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::Subject;
use crate::fit::{Method, Triple};
use crate::fresnel::ModelKind;

/// A model with the way to its parameters, or another stand-in for the truth: what the trade chart has a point for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Variant {
    /// A model of three channels.
    Model(ModelKind, Method),
    /// Schlick and c x⁶ times a polynomial of 1 − 2c with so many coefficients for each channel, by least squares.
    Series(usize),
    /// Schlick and c x times a polynomial of (2 − 9c)/(2 + 5c) with so many coefficients for each channel, by least
    /// squares.
    Polynomial(usize),
    /// Three channels at so many angles, evenly spaced in √c, linear between.
    Table(usize),
    /// The exact equations at so many wavelengths, with spline weights.
    Spectral(usize),
    /// The exact equations at each nanometre of 380–780: the truth itself.
    Exact,
}

impl Variant {
    /// No Fresnel term.
    pub const CONSTANT: Self = Self::Model(ModelKind::Constant, Method::Exact);
    /// Schlick with the exact r.
    pub const SCHLICK: Self = Self::Model(ModelKind::Schlick, Method::Exact);
    /// Hoffman with the exact r and h.
    pub const HOFFMAN: Self = Self::Model(ModelKind::Hoffman, Method::Exact);

    /// Every variant for a measured metal.
    pub const ALL: [Self; 22] = [
        Self::CONSTANT,
        Self::SCHLICK,
        Self::HOFFMAN,
        Self::Model(ModelKind::Hoffman, Method::LeastSquares),
        Self::Model(ModelKind::F82Tint, Method::Exact),
        Self::Model(ModelKind::Lazanyi, Method::LeastSquares),
        Self::Model(ModelKind::GeneralizedSchlick, Method::LeastSquares),
        Self::Series(3),
        Self::Polynomial(6),
        Self::Polynomial(10),
        Self::Table(32),
        Self::Table(128),
        Self::Model(ModelKind::Gulbrandsen, Method::LeastSquares),
        Self::Model(ModelKind::Conductor, Method::Points(Triple::ROUND)),
        Self::Model(ModelKind::Conductor, Method::ColourMatching),
        Self::Model(ModelKind::Conductor, Method::LeastSquares),
        Self::Spectral(3),
        Self::Spectral(8),
        Self::Spectral(16),
        Self::Spectral(20),
        Self::Spectral(31),
        Self::Exact,
    ];

    /// The variants that make sense for a subject, the exact one last. Of two colours, r and h are the whole truth:
    /// nothing richer can be nearer to it.
    pub fn of(subject: &Subject<'_>) -> &'static [Self] {
        const OF_DIELECTRIC: [Variant; 4] = [
            Variant::CONSTANT,
            Variant::SCHLICK,
            Variant::HOFFMAN,
            Variant::Model(ModelKind::Conductor, Method::ColourMatching),
        ];
        match subject {
            Subject::Metal(_) => &Self::ALL,
            Subject::Colours { .. } => &Self::ALL[..3],
            Subject::Dielectric { .. } => &OF_DIELECTRIC,
        }
    }

    /// The stable name: `hoffman:exact`, `polynomial-10`, `exact`.
    pub fn id(self) -> String {
        match self {
            Self::Model(kind, method) => format!("{kind}:{method}"),
            Self::Series(count) => format!("series-{count}"),
            Self::Polynomial(count) => format!("polynomial-{count}"),
            Self::Table(entries) => format!("table-{entries}"),
            Self::Spectral(count) => format!("spectral-{count}"),
            Self::Exact => "exact".to_owned(),
        }
    }

    /// The name people read in a table.
    pub fn label(self) -> String {
        match self {
            Self::Model(kind, Method::Exact) => kind.label().to_owned(),
            Self::Model(kind, Method::LeastSquares) => format!("{}, fitted", kind.label()),
            Self::Model(kind, Method::ColourMatching) => format!("{}, weighted", kind.label()),
            Self::Model(kind, method) => format!("{}, {}", kind.label(), method.label()),
            Self::Series(count) => format!("Series of {count}"),
            Self::Polynomial(count) => format!("Polynomial of {count}"),
            Self::Table(entries) => format!("Table of {entries}"),
            Self::Spectral(count) => format!("Spectral, {count} wavelengths"),
            Self::Exact => "Spectral, every nm".to_owned(),
        }
    }

    /// True where r alone says everything.
    pub const fn needs_only_r(self) -> bool {
        matches!(self, Self::Model(ModelKind::Constant | ModelKind::Schlick, _))
    }
}

impl fmt::Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.id())
    }
}

/// A text that names none of [`Variant::ALL`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no variant “{0}”; there are: {names}", names = Variant::ALL.map(Variant::id).join(", "))]
pub struct UnknownVariant(String);

impl FromStr for Variant {
    type Err = UnknownVariant;

    fn from_str(text: &str) -> Result<Self, UnknownVariant> {
        let named = Self::ALL.into_iter().find(|variant| variant.id() == text);
        named.ok_or_else(|| UnknownVariant(text.to_owned()))
    }
}

impl Serialize for Variant {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Variant {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_parse_back() {
        for variant in Variant::ALL {
            assert_eq!(variant.id().parse(), Ok(variant));
            if let Variant::Model(kind, method) = variant {
                assert!(method.applies_to(kind), "{variant}");
            }
        }
        assert!("spectral-7".parse::<Variant>().unwrap_err().to_string().contains("hoffman:exact"));
    }
}
