//! What other programs say about a metal, as presets.
//!
//! [`import`] takes the bytes of a file or of the clipboard. Values keep their meaning: t becomes
//! h = t (q + (1 − q) r), which is exact; g, n and k become the r and h of their curve, and a note says how far
//! that is off. What names a metal no r and h can say is refused with one sentence.

mod ase;
mod error;
mod format;
mod gltf;
mod gpl;
mod imported;
mod materialx;
mod materialx_node;
mod numbers;
mod swatches;
mod table;
mod values;
mod xml;

pub use error::ImportError;
pub use format::{ImportFormat, import, import_file};
pub use imported::Imported;
