//! What a preset says to each renderer, and what is lost on the way.
//!
//! [`Target`] is the list, [`export`] writes one preset, [`export_all`] a batch, [`shown`] tells before
//! writing what the reader will show; [`export_baked`] writes one metal as a function of its own, [`export_form`] one in
//! other parameters than r and h, of which [`readings`] tells what comes back. r and h are converted to the space of the
//! file first; t, g, n and k are derived there. Fields called specular color, edge tint or color82 take t = h / (q + (1 − q) r),
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
mod form;
mod gltf;
mod gpl;
mod language;
mod loss;
mod material;
mod materialx;
mod mitsuba;
mod mitsuba_plugin;
mod names;
mod number;
mod reading;
mod sampling;
mod shader;
mod sphere_mesh;
mod swatch;
mod target;
mod tint;
mod usd;

pub use baked::export_baked;
pub use export::{Shown, check, export, export_all, export_as, export_form, file_name, palette_stem, shown};
pub use exported::{ExportError, ExportFile, Exported, Options};
pub use form::form_in_space;
pub use loss::{Cause, Clip, Difference, Loss, Parameter, Part};
pub use names::{NameKey, file_stems, identifier, unique_stems};
pub use reading::{Reading, readings};
pub use target::Target;
