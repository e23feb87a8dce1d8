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
    /// `Olmon et al. 2012`, or the empty string when the header names nobody.
    pub fn citation(&self) -> String {
        let first = self.authors.split([',', ';']).next().unwrap_or_default().trim();
        let et_al = if self.authors.contains(',') || self.authors.contains(" and ") { " et al." } else { "" };
        format!("{first}{et_al} {}", self.year).trim().to_owned()
    }
}
