//! Where the light of a match comes from.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use crate::color::UnknownName;

/// The six ways to know L, the light that a spot of the metal mirrors; best first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightMode {
    /// A: a card seen in a flat piece, over the same card seen directly.
    FlatMirror,
    /// B: a ball of a known metal in the same place.
    ReferenceBall,
    /// C: even surroundings and a card of known reflectance.
    #[default]
    Card,
    /// D: an even bright backdrop just outside the rim; h only.
    Backdrop,
    /// E: one light solved together with r and h.
    SolvedLight,
    /// F: the person sets the light.
    ByEye,
}

impl LightMode {
    /// Every mode, best first.
    pub const ALL: [Self; 6] =
        [Self::FlatMirror, Self::ReferenceBall, Self::Card, Self::Backdrop, Self::SolvedLight, Self::ByEye];

    /// The stable identifier used in files and on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::FlatMirror => "flat-mirror",
            Self::ReferenceBall => "reference-ball",
            Self::Card => "card",
            Self::Backdrop => "backdrop",
            Self::SolvedLight => "solved-light",
            Self::ByEye => "by-eye",
        }
    }

    /// The letter of the mode, A–F.
    pub const fn letter(self) -> char {
        (b'A' + self as u8) as char
    }

    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::FlatMirror => "Flat mirror ratio",
            Self::ReferenceBall => "Reference ball",
            Self::Card => "Even light and a card",
            Self::Backdrop => "Backdrop ratio",
            Self::SolvedLight => "Solved light",
            Self::ByEye => "By eye",
        }
    }

    /// One sentence that says what to photograph and what is computed.
    pub const fn explanation(self) -> &'static str {
        match self {
            Self::FlatMirror => {
                "Stand a card behind a flat polished piece: the card in the mirror over the card itself is the \
                 reflectance, whatever the light."
            }
            Self::ReferenceBall => {
                "Put a ball of a known metal in the same place: the ratio of the two balls at each angle cancels uneven \
                 surroundings."
            }
            Self::Card => {
                "Photograph a ball in a light tent or under an overcast sky with a card of known reflectance: the card \
                 says what white is."
            }
            Self::Backdrop => {
                "Mark an even bright backdrop just outside the rim: the rim mirrors it, so their ratio is h; r stays \
                 unknown."
            }
            Self::SolvedLight => {
                "Use a ball whose outermost rim is sharp: close to 90° every metal is white, so the light is solved \
                 together with r and h."
            }
            Self::ByEye => "Set the light yourself; the result is an estimate, never a measurement.",
        }
    }
}

impl fmt::Display for LightMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

impl FromStr for LightMode {
    type Err = UnknownName;

    /// Reads an identifier or the letter A–F.
    fn from_str(text: &str) -> Result<Self, UnknownName> {
        Self::ALL
            .into_iter()
            .find(|mode| mode.id() == text || text.eq_ignore_ascii_case(&mode.letter().to_string()))
            .ok_or_else(|| UnknownName::new("light mode", text, Self::ALL.map(Self::id)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_and_letters_parse_back() {
        for mode in LightMode::ALL {
            assert_eq!(mode.id().parse(), Ok(mode));
            assert_eq!(mode.letter().to_string().parse(), Ok(mode));
            assert_eq!(serde_json::to_string(&mode).unwrap(), format!("\"{mode}\""));
        }
        assert!("tent".parse::<LightMode>().unwrap_err().to_string().contains("flat-mirror"));
    }

    #[test]
    fn each_explanation_is_one_sentence() {
        for mode in LightMode::ALL {
            let text = mode.explanation();
            assert!(text.ends_with('.') && text.matches(". ").count() == 0, "{text}");
        }
    }
}
