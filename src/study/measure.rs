//! Which number of many errors is looked at.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use crate::color::UnknownName;

/// Mean, 95th percentile or largest CIEDE2000.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// The mean over the angles.
    Mean,
    /// What 95 % of the angles stay within.
    P95,
    /// The largest at any angle.
    #[default]
    Max,
}

impl Measure {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Mean, Self::P95, Self::Max];

    /// The stable identifier used in files and on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::P95 => "p95",
            Self::Max => "max",
        }
    }

    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Mean => "mean ΔE",
            Self::P95 => "ΔE of 95 %",
            Self::Max => "largest ΔE",
        }
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

impl FromStr for Measure {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        let named = Self::ALL.into_iter().find(|measure| measure.id() == text);
        named.ok_or_else(|| UnknownName::new("measure", text, Self::ALL.map(Self::id)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_parse_back() {
        assert!(Measure::ALL.into_iter().all(|measure| measure.id().parse() == Ok(measure)));
        assert!("median".parse::<Measure>().unwrap_err().to_string().contains("p95"));
    }
}
