//! What a variant costs: operations in a shader, bytes of parameters, and time where it was measured.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::Variant;
use crate::color::{Rgb, UnknownName};
use crate::fresnel::{ModelKind, SchlickSeries};
use crate::kernel::{
    Conductor, Factored, GeneralizedSchlick, Lazanyi, Operations, Polynomial, Schlick, Spectral, Table,
};
use crate::spectrum::SAMPLES;

/// A power that has to be computed as one.
const BROKEN_POWER: f64 = 5.5;

impl Variant {
    /// The operations of one evaluation of three channels, counted by running its kernel: everything that depends on
    /// the material alone is computed before.
    pub fn operations(self) -> Operations {
        let any = Rgb::splat(0.5);
        match self {
            Self::Model(kind, _) => match kind {
                // Nothing is computed: a move for each channel.
                ModelKind::Constant => Operations { choices: 3, ..Operations::default() },
                ModelKind::Schlick => Operations::of(Schlick),
                ModelKind::Hoffman | ModelKind::F82Tint => Operations::of(Factored),
                ModelKind::Lazanyi => Lazanyi::material(any, any, BROKEN_POWER).operations(),
                ModelKind::GeneralizedSchlick => {
                    GeneralizedSchlick::material(any, any, Rgb::WHITE, BROKEN_POWER).operations()
                }
                // Of a known material, (r, g) are n and k.
                ModelKind::Gulbrandsen | ModelKind::Conductor => Operations::of(Conductor),
            },
            Self::Series(count) => Polynomial::operations_of(6, 0.0, count),
            Self::Polynomial(count) => Polynomial::operations_of(1, SchlickSeries::BEND_OF_METALS, count),
            Self::Table(_) => Table::OPERATIONS,
            Self::Spectral(count) => Spectral::operations_of(count),
            Self::Exact => Spectral::operations_of(SAMPLES),
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

    /// What a cost is counted in.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::MeasuredNs => "ns",
            Self::ShaderOperations => "shader operations",
            Self::ParameterBytes => "bytes",
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

    /// Hoffman's model with `a` stored: 1 subtraction, 4 multiplications, 6 of both, and the limits of the cosine.
    #[test]
    fn counts_are_those_of_the_kernels() {
        assert_eq!(Variant::HOFFMAN.operations().slots(), 1 + 4 + 6 + 2);
        assert_eq!(Variant::SCHLICK.operations().slots(), 1 + 3 + 3 + 2);
        let exact = Variant::Exact.operations();
        assert_eq!((exact.quotients, exact.roots), (401, 2 * 401));
    }

    #[test]
    fn names_parse_back() {
        for axis in CostAxis::ALL {
            assert_eq!(axis.id().parse(), Ok(axis));
        }
    }
}
