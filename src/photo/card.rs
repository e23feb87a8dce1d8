//! Matt cards of known reflectance: what is white in a picture.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::Area;
use super::mark::MarkError;

/// A matt, neutral card or patch and its diffuse reflectance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Card {
    /// Where it is in the picture.
    pub area: Area,
    /// Diffuse reflectance, above 0 and at most 1.
    pub reflectance: f64,
}

impl Card {
    /// Cards people own, with the reflectance their makers state.
    pub const COMMON: [(&'static str, f64); 3] =
        [("White card", 0.90), ("Grey card", 0.18), ("ColorChecker white", 0.90)];

    /// Bottom row of the ColorChecker, white to black (McCamy, Marcus & Davidson 1976, table 1, Y/100).
    pub const COLOR_CHECKER_NEUTRALS: [f64; 6] = [0.900, 0.591, 0.362, 0.198, 0.090, 0.031];
}

impl fmt::Display for Card {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}@{}", self.area, self.reflectance)
    }
}

impl FromStr for Card {
    type Err = MarkError;

    fn from_str(text: &str) -> Result<Self, MarkError> {
        let form = || MarkError::form(text, "card", "x,y,width,height@reflectance, for example 40,60,80,80@0.9");
        let (area, reflectance) = text.split_once('@').ok_or_else(form)?;
        let reflectance: f64 = reflectance.trim().parse().map_err(|_| form())?;
        if !(reflectance > 0.0 && reflectance <= 1.0) {
            return Err(MarkError::Reflectance { text: text.to_owned() });
        }
        Ok(Self { area: area.parse()?, reflectance })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_it_writes() {
        let card = Card { area: Area::rectangle(1.0, 2.0, 3.0, 4.0), reflectance: 0.9 };
        assert_eq!(card.to_string(), "1,2,3,4@0.9");
        assert_eq!("1,2,3,4@0.9".parse(), Ok(card));
    }

    #[test]
    fn says_what_is_wrong() {
        assert!("1,2,3,4".parse::<Card>().unwrap_err().to_string().contains("@reflectance"));
        assert!("1,2,3,4@90".parse::<Card>().unwrap_err().to_string().contains("at most 1"));
        assert!("1,2,3,4@nan".parse::<Card>().is_err());
        assert!("1,2@0.9".parse::<Card>().unwrap_err().to_string().contains("“1,2”"));
    }
}
