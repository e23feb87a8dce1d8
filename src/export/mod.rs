//! What a preset says to each renderer, and what is lost on the way.
//!
//! [`Target`] is the list, [`export`] writes one preset, [`export_all`] a batch, [`shown`] tells before
//! writing what the reader will show; [`export_baked`] writes one metal as a function of its own. r and h are converted to the space of the file first; t, g, n and k
//! are derived there. Fields called specular color, edge tint or color82 take t = h / (q + (1 − q) r),
//! q = (6/7)⁵, never h.

mod aco;
mod ase;
mod baked;
mod blender;
mod cube;
mod curve_csv;
mod edge_tint;
#[expect(clippy::module_inception, reason = "the function the folder is about")]
mod export;
mod exported;
mod exr_ramp;
mod gltf;
mod gpl;
mod kept;
mod loss;
mod material;
mod materialx;
mod mitsuba;
mod mitsuba_plugin;
mod names;
mod number;
mod shader;
mod sphere_mesh;
mod swatch;
mod target;
mod tint;
mod usd;

pub use baked::export_baked;
pub use export::{Shown, check, export, export_all, export_as, export_kept, file_name, palette_stem, shown};
pub use exported::{ExportError, ExportFile, Exported, Options};
pub use kept::Kept;
pub use loss::{Cause, Clip, Difference, Loss, Parameter, Part};
pub use names::{NameKey, file_stems, identifier, unique_stems};
pub use target::Target;
