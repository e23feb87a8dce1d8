//! Which cost counts.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use crate::color::UnknownName;
use crate::study::{CostAxis, Costs, Variant};

/// Where the models run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Target {
    /// A shader: operations count, then bytes.
    #[default]
    RealTime,
    /// A renderer on this machine's processor: measured time counts, then operations, which decide where times are equal
    /// within the noise of the clock; operations, then bytes where nothing was measured.
    Offline,
    /// Parameters in textures: bytes count, then operations.
    TextureMemory,
}

impl Target {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::RealTime, Self::Offline, Self::TextureMemory];

    /// The stable identifier used in files and on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::RealTime => "real-time",
            Self::Offline => "offline",
            Self::TextureMemory => "texture-memory",
        }
    }

    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::RealTime => "Real-time shader",
            Self::Offline => "Offline renderer",
            Self::TextureMemory => "Texture memory",
        }
    }

    /// What is compared first and second; smaller is cheaper. Times count only where all variants have one.
    pub fn price(self, variant: Variant, costs: &Costs, has_times: bool) -> (f64, f64) {
        let cost = costs.of(variant);
        let (operations, bytes) = (f64::from(cost.shader_operations), cost.parameter_bytes as f64);
        let timed = || costs.order(variant, CostAxis::MeasuredNs).filter(|_| has_times);
        match self {
            Self::RealTime => (operations, bytes),
            Self::Offline => timed().unwrap_or((operations, bytes)),
            Self::TextureMemory => (bytes, operations),
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

impl FromStr for Target {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        let named = Self::ALL.into_iter().find(|target| target.id() == text);
        named.ok_or_else(|| UnknownName::new("target", text, Self::ALL.map(Self::id)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_target_looks_at_its_own_cost() {
        let costs = Costs::with_measured(vec![(Variant::SCHLICK, 0.5)]);
        let prices = Target::ALL.map(|target| target.price(Variant::SCHLICK, &costs, true));
        assert_eq!(prices, [(9.0, 12.0), (0.5, 9.0), (12.0, 9.0)]);
        assert_eq!(Target::Offline.price(Variant::SCHLICK, &costs, false), (9.0, 12.0));
        assert!(Target::ALL.into_iter().all(|target| target.id().parse() == Ok(target)));
    }
}
