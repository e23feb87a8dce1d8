//! Where measured data come from.

use serde::{Deserialize, Serialize};

/// The source of a data set, as its file's header states it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Provenance {
    /// Authors as published.
    pub authors: String,
    /// Year of publication.
    pub year: String,
    /// Title of the publication.
    pub title: String,
    /// Journal, volume and pages.
    pub reference: String,
    /// Digital object identifier of the publication.
    pub doi: String,
    /// Address of the publication or of the data.
    pub url: String,
    /// Licence of the data.
    pub licence: String,
    /// Wavelength range of the original, in nm.
    pub range_nm: String,
    /// Conditions of the measurement, and what was derived.
    pub comments: String,
}

impl Provenance {
    /// `Querry 1985`, `Johnson & Christy 1974` or `Olmon et al. 2012`; empty when the header names nobody.
    pub fn citation(&self) -> String {
        let authors: Vec<&str> = self.authors.split(" and ").flat_map(|part| part.split(", ")).collect();
        let surname = |author: &str| author.split_whitespace().last().unwrap_or_default().to_owned();
        let names = match authors[..] {
            [one] => surname(one),
            [one, two] => format!("{} & {}", surname(one), surname(two)),
            [first, ..] => format!("{} et al.", surname(first)),
            [] => String::new(),
        };
        format!("{names} {}", self.year).trim().to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cites_by_the_number_of_authors() {
        let cite = |authors: &str| {
            Provenance { authors: authors.into(), year: "1974".into(), ..Default::default() }.citation()
        };
        assert_eq!(cite("M. R. Querry"), "Querry 1974");
        assert_eq!(cite("P. B. Johnson and R. W. Christy"), "Johnson & Christy 1974");
        assert_eq!(cite("R. L. Olmon, B. Slovick, and T. W. Johnson"), "Olmon et al. 1974");
        assert_eq!(Provenance::default().citation(), "");
    }
}
