//! A measured metal and its ground truth.

use super::{HeldEnds, NkTable, Provenance};
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{CosTheta, Nk, conductor_over_indices};
use crate::spectrum::{SAMPLES, rgb_from_reflectance};

/// A metal known by its spectral n and k: the ground truth every model is compared to.
#[derive(Clone, Debug)]
pub struct Metal {
    /// Stable identifier, e.g. `Au_Olmon-ts`.
    pub id: String,
    /// The name people read, e.g. `Gold`.
    pub name: String,
    /// Chemical symbol or composition, e.g. `Au`.
    pub symbol: String,
    /// What kind of material it is.
    pub category: String,
    /// The data set's name, e.g. `Olmon-ts`.
    pub dataset: String,
    /// True for the data set that stands for this material where only one is shown.
    pub is_preferred: bool,
    /// What the data are where they are no measurement, e.g. `a density functional calculation`; otherwise empty.
    pub not_measured: String,
    /// Where the data come from.
    pub provenance: Provenance,
    table: NkTable,
    nk: Box<[Nk; SAMPLES]>,
}

impl Metal {
    /// A metal of a table alone: a person's own file, named after it.
    pub fn from_table(id: String, name: String, table: NkTable) -> Self {
        let nk = table.on_grid();
        Self {
            symbol: String::new(),
            category: "own data".to_owned(),
            dataset: String::new(),
            is_preferred: true,
            not_measured: String::new(),
            provenance: Provenance::default(),
            id,
            name,
            table,
            nk,
        }
    }

    /// The measured rows.
    pub fn table(&self) -> &NkTable {
        &self.table
    }

    /// n and k at each wavelength of the grid.
    pub fn nk(&self) -> &[Nk; SAMPLES] {
        &self.nk
    }

    /// True for a measurement; otherwise [`not_measured`](Self::not_measured) says what it is.
    pub fn is_measured(&self) -> bool {
        self.not_measured.is_empty()
    }

    /// What a person should know about the data, a sentence each: what was held, what is odd, what was not measured.
    pub fn remarks(&self) -> Vec<String> {
        let held = Some(self.held_ends().sentence()).filter(|sentence| !sentence.is_empty());
        let doubts = self.table.doubts().into_iter().map(|doubt| doubt.to_string());
        let calculated = (!self.is_measured()).then(|| format!("This is no measurement but {}.", self.not_measured));
        calculated.into_iter().chain(held).chain(doubts).collect()
    }

    /// Where the data end inside the visible.
    pub fn held_ends(&self) -> HeldEnds {
        self.table.held_ends()
    }

    /// Spectral reflectance at an angle, one value for each wavelength of the grid.
    pub fn spectral_reflectance(&self, cos_theta: CosTheta) -> [f64; SAMPLES] {
        let mut values = [f64::NAN; SAMPLES];
        conductor_over_indices(self.nk.as_slice(), cos_theta, &mut values);
        values
    }

    /// The ground truth (paper section 2): spectral reflectance of white light, as RGB. Nothing is clipped.
    pub fn reflectance(&self, cos_theta: CosTheta, space: RgbSpace) -> Rgb {
        rgb_from_reflectance(self.spectral_reflectance(cos_theta), space)
    }

    /// r: the reflectance facing the surface.
    pub fn r(&self, space: RgbSpace) -> Rgb {
        self.reflectance(CosTheta::FACING, space)
    }

    /// h: the reflectance at θ_max.
    pub fn h(&self, space: RgbSpace) -> Rgb {
        self.reflectance(CosTheta::MAX, space)
    }
}
