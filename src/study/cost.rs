//! What a variant costs: operations in a shader, bytes of parameters, and time where it was measured.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::Variant;
use crate::color::UnknownName;
use crate::fresnel::ModelKind;
use crate::spectrum::SAMPLES;

/// Operations of one evaluation of three channels, counted in the shader text with everything that depends on the
/// material alone computed before; a multiplication with an addition is one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Additions, multiplications, both in one, comparisons.
    pub simple: u32,
    /// Divisions, square roots, exponentials and logarithms.
    pub special: u32,
    /// Reads from a table.
    pub loads: u32,
}

impl Operations {
    const fn new(simple: u32, special: u32, loads: u32) -> Self {
        Self { simple, special, loads }
    }

    /// Issue slots: graphics processors take one simple operation in each, and a special one or a read in every fourth
    /// (AMD, RDNA 2 instruction set architecture, 2020).
    pub const fn slots(self) -> u32 {
        self.simple + 4 * (self.special + self.loads)
    }
}

/// Simple and special operations of one conductor channel, with both polarisations over one division.
const CONDUCTOR_CHANNEL: (u32, u32) = (16, 3);

impl Variant {
    /// The operations of one evaluation of three channels.
    pub const fn operations(self) -> Operations {
        let (simple, special) = CONDUCTOR_CHANNEL;
        match self {
            Self::Model(kind, _) => match kind {
                // A move for each channel.
                ModelKind::Constant => Operations::new(3, 0, 0),
                // x, x², x⁴, x⁵; one for each channel.
                ModelKind::Schlick => Operations::new(4 + 3, 0, 0),
                // The same and c x; two for each channel.
                ModelKind::Hoffman | ModelKind::F82Tint => Operations::new(5 + 6, 0, 0),
                // x⁵, and c x^α by a logarithm and an exponential.
                ModelKind::Lazanyi => Operations::new(6 + 6, 2, 0),
                // x^p, x⁶ c; two for each channel.
                ModelKind::GeneralizedSchlick => Operations::new(7 + 6, 2, 0),
                // Of a known material, (r, g) are n and k.
                ModelKind::Gulbrandsen | ModelKind::Conductor => Operations::new(3 * simple, 3 * special, 0),
            },
            Self::Series(count) | Self::Polynomial(count) => Operations::new(5 + 3 * (count as u32 + 1), 0, 0),
            Self::Table(_) => Operations::new(5 + 6, 1, 2),
            Self::Spectral(count) => wavelengths(count as u32),
            Self::Exact => wavelengths(SAMPLES as u32),
        }
    }

    /// Bytes of the parameters of one material as 32-bit floats; weights that all materials share are not counted.
    pub const fn parameter_bytes(self) -> u64 {
        let numbers = match self {
            Self::Model(kind, _) => match kind {
                ModelKind::Constant | ModelKind::Schlick => 3,
                ModelKind::Hoffman | ModelKind::F82Tint | ModelKind::Gulbrandsen | ModelKind::Conductor => 6,
                ModelKind::Lazanyi => 7,
                ModelKind::GeneralizedSchlick => 10,
            },
            Self::Series(count) | Self::Polynomial(count) => 3 + 3 * count,
            Self::Table(entries) => 3 * entries,
            Self::Spectral(count) => 2 * count,
            Self::Exact => 2 * SAMPLES,
        };
        4 * numbers as u64
    }
}

/// A conductor channel and three weights for each wavelength.
const fn wavelengths(count: u32) -> Operations {
    Operations::new((CONDUCTOR_CHANNEL.0 + 3) * count, CONDUCTOR_CHANNEL.1 * count, 0)
}

/// All costs of a variant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// Nanoseconds of one evaluation of three channels on this machine; `None` where it was not measured.
    pub measured_ns: Option<f64>,
    /// Issue slots of one evaluation in a shader, see [`Operations::slots`].
    pub shader_operations: u32,
    /// Bytes of the parameters of one material.
    pub parameter_bytes: u64,
}

impl Cost {
    /// One of the costs; `None` where it was not measured.
    pub fn on(self, axis: CostAxis) -> Option<f64> {
        match axis {
            CostAxis::MeasuredNs => self.measured_ns,
            CostAxis::ShaderOperations => Some(f64::from(self.shader_operations)),
            CostAxis::ParameterBytes => Some(self.parameter_bytes as f64),
        }
    }
}

/// The costs of all variants: what can be counted, and the times of this machine where they were measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Costs {
    measured_ns: Vec<(Variant, f64)>,
}

impl Costs {
    /// Only what can be counted.
    pub fn counted() -> Self {
        Self::default()
    }

    /// With nanoseconds of one evaluation of three channels.
    pub fn with_measured(measured_ns: Vec<(Variant, f64)>) -> Self {
        Self { measured_ns }
    }

    /// The costs of a variant.
    pub fn of(&self, variant: Variant) -> Cost {
        Cost {
            measured_ns: self.measured_ns.iter().find(|(v, _)| *v == variant).map(|(_, ns)| *ns),
            shader_operations: variant.operations().slots(),
            parameter_bytes: variant.parameter_bytes(),
        }
    }

    /// True when every variant has a time, so that times can be compared.
    pub fn has_times(&self) -> bool {
        Variant::ALL.iter().all(|variant| self.of(*variant).measured_ns.is_some())
    }
}

/// Which cost is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CostAxis {
    /// Nanoseconds of one evaluation on this machine.
    MeasuredNs,
    /// Issue slots of a shader.
    #[default]
    ShaderOperations,
    /// Bytes of the parameters.
    ParameterBytes,
}

impl CostAxis {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::MeasuredNs, Self::ShaderOperations, Self::ParameterBytes];

    /// The stable identifier used in files and on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::MeasuredNs => "measured-ns",
            Self::ShaderOperations => "shader-operations",
            Self::ParameterBytes => "parameter-bytes",
        }
    }

    /// The name people read, with its unit.
    pub const fn label(self) -> &'static str {
        match self {
            Self::MeasuredNs => "Time of one RGB evaluation (ns)",
            Self::ShaderOperations => "Shader operations of one RGB evaluation",
            Self::ParameterBytes => "Parameters of one material (bytes)",
        }
    }
}

impl fmt::Display for CostAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

impl FromStr for CostAxis {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        let named = Self::ALL.into_iter().find(|axis| axis.id() == text);
        named.ok_or_else(|| UnknownName::new("cost", text, Self::ALL.map(Self::id)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// More coefficients, wavelengths or parameters are never cheaper.
    #[test]
    fn richer_variants_cost_more() {
        let costs = Costs::counted();
        let pairs = [
            (Variant::CONSTANT, Variant::SCHLICK),
            (Variant::SCHLICK, Variant::HOFFMAN),
            (Variant::HOFFMAN, Variant::Series(3)),
            (Variant::Series(3), Variant::Polynomial(6)),
            (Variant::Polynomial(6), Variant::Polynomial(10)),
            (Variant::Spectral(3), Variant::Spectral(31)),
            (Variant::Spectral(31), Variant::Exact),
        ];
        for (cheap, dear) in pairs {
            let (cheap, dear) = (costs.of(cheap), costs.of(dear));
            assert!(cheap.shader_operations < dear.shader_operations && cheap.parameter_bytes <= dear.parameter_bytes);
        }
        assert_eq!(costs.of(Variant::SCHLICK).measured_ns, None);
        let timed = Costs::with_measured(vec![(Variant::SCHLICK, 0.2)]);
        assert_eq!(timed.of(Variant::SCHLICK).on(CostAxis::MeasuredNs), Some(0.2));
    }

    /// The exported shader of Hoffman's model with `a` stored: 1 subtraction, 4 multiplications, 6 of both.
    #[test]
    fn counts_are_those_of_the_text() {
        assert_eq!(Variant::HOFFMAN.operations(), Operations::new(11, 0, 0));
        assert_eq!(Variant::SCHLICK.operations().slots(), 7);
    }

    #[test]
    fn names_parse_back() {
        for axis in CostAxis::ALL {
            assert_eq!(axis.id().parse(), Ok(axis));
        }
    }
}
