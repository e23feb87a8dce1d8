//! Measured metals: their spectral n and k, and the ground truth these give.

mod csv_file;
mod dispersion;
mod doubt;
mod few_wavelengths;
mod library;
#[expect(clippy::module_inception, reason = "the type the folder is about")]
mod metal;
mod nk_table;
mod open;
mod provenance;
mod reflectance_table;
mod truth;
mod yaml_file;

pub use csv_file::{NkCsvError, metal_from_csv};
pub use doubt::Doubt;
pub use few_wavelengths::SpectralModel;
pub use library::{UnknownMetal, metal_by_name, metals, preferred_metals};
pub use metal::Metal;
pub use nk_table::{HeldEnds, NkTable, NkTableError};
pub use open::MetalFileError;
pub use provenance::Provenance;
pub use reflectance_table::ReflectanceTable;
pub use truth::{SpectralCurve, TruthCurve};
pub use yaml_file::{NkYamlError, metal_from_yaml};
