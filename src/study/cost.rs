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
                // Of a known material, (r, g) are n and k. Whether k ≥ n, which is cheaper, a shader does not know.
                ModelKind::Gulbrandsen | ModelKind::Conductor => Operations::of(Conductor::OF_ANY_INDEX),
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

/// Two times of which the longer one is within this factor of the other count as equal.
///
/// In twelve runs on a busy machine the ratio of the times of [`Variant::CONSTANT`] and [`Variant::SCHLICK`] was .90 to
/// 1.02: which of them was shorter, and by how much, was noise.
pub const EQUAL_TIMES: f64 = 1.15;

/// The costs of all variants: what can be counted, and the times of this machine where they were measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Costs {
    times: Vec<Time>,
}

/// The time of a variant.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Time {
    variant: Variant,
    ns: f64,
    /// The shortest of the times that count as equal to it.
    equal_ns: f64,
}

impl Costs {
    /// Only what can be counted.
    pub fn counted() -> Self {
        Self::default()
    }

    /// With nanoseconds of one evaluation of three channels.
    pub fn with_measured(measured_ns: Vec<(Variant, f64)>) -> Self {
        let mut times: Vec<Time> =
            measured_ns.into_iter().map(|(variant, ns)| Time { variant, ns, equal_ns: ns }).collect();
        times.sort_by(|a, b| a.ns.total_cmp(&b.ns));
        for index in 1..times.len() {
            let before = times[index - 1];
            if times[index].ns <= EQUAL_TIMES * before.ns {
                times[index].equal_ns = before.equal_ns;
            }
        }
        Self { times }
    }

    fn time(&self, variant: Variant) -> Option<&Time> {
        self.times.iter().find(|time| time.variant == variant)
    }

    /// The time of a variant for comparisons, in ns: of equal times the shortest, where two times are equal when they are
    /// within [`EQUAL_TIMES`] of each other or of one in between. It depends on no other choice than the measurements, so
    /// that it orders the variants of every material alike. `None` where it was not measured.
    pub fn equal_ns(&self, variant: Variant) -> Option<f64> {
        self.time(variant).map(|time| time.equal_ns)
    }

    /// What decides on an axis which of two variants is cheaper: the first number, and where it is equal the second.
    /// Times that count as equal are decided by shader operations; `None` where nothing was measured.
    pub fn order(&self, variant: Variant, axis: CostAxis) -> Option<(f64, f64)> {
        let operations = || f64::from(variant.operations().slots());
        match axis {
            CostAxis::MeasuredNs => Some((self.equal_ns(variant)?, operations())),
            CostAxis::ShaderOperations | CostAxis::ParameterBytes => Some((self.of(variant).on(axis)?, 0.0)),
        }
    }

    /// The costs of a variant.
    pub fn of(&self, variant: Variant) -> Cost {
        Cost {
            measured_ns: self.time(variant).map(|time| time.ns),
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
    use proptest::prelude::*;

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

    /// What differs by the noise of a clock is decided by operations, whichever was faster.
    #[test]
    fn times_within_the_noise_are_equal_and_operations_decide() {
        for [constant, schlick] in [[0.2, 0.215], [0.215, 0.2], [0.2, 0.2]] {
            let times = vec![(Variant::SCHLICK, schlick), (Variant::CONSTANT, constant), (Variant::HOFFMAN, 0.27)];
            let costs = Costs::with_measured(times);
            let order = |variant| costs.order(variant, CostAxis::MeasuredNs).unwrap();
            assert_eq!(order(Variant::CONSTANT), (0.2, 3.0));
            assert_eq!(order(Variant::SCHLICK), (0.2, 9.0));
            assert_eq!(order(Variant::HOFFMAN), (0.27, 13.0));
            assert_eq!(costs.of(Variant::SCHLICK).measured_ns, Some(schlick), "what was measured stays");
        }
    }

    proptest! {
        /// Equal times are runs of the sorted ones: equality is transitive, and never turns an order around.
        #[test]
        fn equal_times_are_classes(ns in prop::collection::vec(0.1..10.0_f64, Variant::ALL.len())) {
            let costs = Costs::with_measured(Variant::ALL.into_iter().zip(ns.iter().copied()).collect());
            let mut all: Vec<(f64, f64)> =
                Variant::ALL.into_iter().zip(&ns).map(|(v, ns)| (*ns, costs.equal_ns(v).unwrap())).collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0));
            for pair in all.windows(2) {
                let is_near = pair[1].0 <= EQUAL_TIMES * pair[0].0;
                prop_assert_eq!(pair[0].1 == pair[1].1, is_near || pair[0].0 == pair[1].0);
                prop_assert!(pair[0].1 <= pair[1].1);
            }
            prop_assert!(all.iter().all(|(ns, equal)| equal <= ns && ns_is_known(&all, *equal)));
        }
    }

    fn ns_is_known(all: &[(f64, f64)], equal: f64) -> bool {
        all.iter().any(|(ns, _)| *ns == equal)
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
