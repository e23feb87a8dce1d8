//! Matt cards of known reflectance: what is white in a picture.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::Area;
use super::mark::{MarkError, numbers};
use crate::color::Rgb;

/// A matt card or patch and its diffuse reflectance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Card {
    /// Where it is in the picture.
    pub area: Area,
    /// Diffuse reflectance, above 0 and at most 1; the mean of the channels where they differ.
    pub reflectance: f64,
    /// Reflectance of each channel in linear Rec.709, where it was measured and is not neutral.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<Rgb>,
}

impl Card {
    /// A card that reflects every channel alike.
    pub const fn neutral(area: Area, reflectance: f64) -> Self {
        Self { area, reflectance, colour: None }
    }

    /// A region whose reflectance of each channel was measured, linear Rec.709.
    pub fn coloured(area: Area, colour: Rgb) -> Self {
        let reflectance = colour.0.iter().sum::<f64>() / 3.0;
        Self { area, reflectance, colour: Some(colour) }
    }

    /// The reflectance of a channel, linear Rec.709.
    pub fn reflectance_of(&self, channel: usize) -> f64 {
        self.colour.map_or(self.reflectance, |colour| colour[channel])
    }

    /// Cards people own, with the reflectance their makers state.
    pub const COMMON: [(&'static str, f64); 3] =
        [("White card", 0.90), ("Grey card", 0.18), ("ColorChecker white", 0.90)];

    /// Bottom row of the ColorChecker, white to black (McCamy, Marcus & Davidson 1976, table 1, Y/100).
    pub const COLOR_CHECKER_NEUTRALS: [f64; 6] = [0.900, 0.591, 0.362, 0.198, 0.090, 0.031];
}

impl fmt::Display for Card {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.colour {
            None => write!(f, "{}@{}", self.area, self.reflectance),
            Some(Rgb([red, green, blue])) => write!(f, "{}@{red},{green},{blue}", self.area),
        }
    }
}

impl FromStr for Card {
    type Err = MarkError;

    fn from_str(text: &str) -> Result<Self, MarkError> {
        let form = || {
            let written = "x,y,width,height@reflectance, for example 40,60,80,80@0.9, or @red,green,blue";
            MarkError::form(text, "card", written)
        };
        let (area, reflectance) = text.split_once('@').ok_or_else(form)?;
        let (area, reflectance) = (area.parse()?, numbers(reflectance).ok_or_else(form)?);
        if !reflectance.iter().all(|value| *value > 0.0 && *value <= 1.0) {
            return Err(MarkError::Reflectance { text: text.to_owned() });
        }
        match *reflectance {
            [reflectance] => Ok(Self::neutral(area, reflectance)),
            [red, green, blue] => Ok(Self::coloured(area, Rgb([red, green, blue]))),
            _ => Err(form()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_it_writes() {
        let area = Area::rectangle(1.0, 2.0, 3.0, 4.0);
        let cards = [
            ("1,2,3,4@0.9", Card::neutral(area, 0.9)),
            ("1,2,3,4@0.9,0.6,0.3", Card::coloured(area, Rgb([0.9, 0.6, 0.3]))),
        ];
        for (text, card) in cards {
            assert_eq!(card.to_string(), text);
            assert_eq!(text.parse(), Ok(card));
            let json = serde_json::to_string(&card).unwrap();
            assert_eq!(serde_json::from_str::<Card>(&json).unwrap(), card, "{json}");
        }
    }

    #[test]
    fn says_what_is_wrong() {
        assert!("1,2,3,4".parse::<Card>().unwrap_err().to_string().contains("@reflectance"));
        assert!("1,2,3,4@90".parse::<Card>().unwrap_err().to_string().contains("at most 1"));
        assert!("1,2,3,4@nan".parse::<Card>().is_err());
        assert!("1,2,3,4@0.9,0.8".parse::<Card>().unwrap_err().to_string().contains("red,green,blue"));
        assert!("1,2@0.9".parse::<Card>().unwrap_err().to_string().contains("“1,2”"));
    }
}
