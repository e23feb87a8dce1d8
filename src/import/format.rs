//! Which kind of file it is, and who reads it.

use std::fs;
use std::path::Path;

use super::{ImportError, Imported, ase, gltf, gpl, materialx, table, values};
use crate::color::RgbSpace;
use crate::preset::Preset;

/// What can be imported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImportFormat {
    /// A preset of this program.
    Preset,
    /// MaterialX with open_pbr_surface, generalized_schlick_bsdf, standard_surface or conductor_bsdf.
    MaterialX,
    /// glTF, as text or binary.
    Gltf,
    /// A CSV table of (r, h), (r, t), (r, g) or (n, k).
    Table,
    /// Lines like `Base Color: 0.9, 0.7, 0.3`, as one pastes them from a node editor.
    Values,
    /// Adobe Swatch Exchange.
    Ase,
    /// A GIMP palette.
    Gpl,
}

impl ImportFormat {
    /// The format by the extension of a file name.
    pub fn of_name(name: &str) -> Option<Self> {
        let extension = name.rsplit_once('.')?.1.to_ascii_lowercase();
        Some(match extension.as_str() {
            "json" => Self::Preset,
            "mtlx" => Self::MaterialX,
            "glb" | "gltf" => Self::Gltf,
            "csv" => Self::Table,
            "txt" => Self::Values,
            "ase" => Self::Ase,
            "gpl" => Self::Gpl,
            _ => return None,
        })
    }

    /// Refuses a file by its size, before it is read.
    pub fn check_size(self, bytes: u64) -> Result<(), ImportError> {
        if bytes > (self.limit_mib() as u64) << 20 { Err(ImportError::TooLarge(self.limit_mib())) } else { Ok(()) }
    }

    /// Geometry makes glTF large; a table of ten thousand metals takes a megabyte.
    const fn limit_mib(self) -> usize {
        match self {
            Self::Gltf => 256,
            _ => 16,
        }
    }
}

/// Reads the presets of a file that is opened only where its name and size promise something to read.
pub fn import_file(path: &Path, space: Option<RgbSpace>) -> Result<Imported, ImportError> {
    let format = ImportFormat::of_name(&path.to_string_lossy()).ok_or(ImportError::UnknownFormat)?;
    let metadata = fs::metadata(path)?;
    if !metadata.is_file() {
        return Err(ImportError::NotRegular(if metadata.is_dir() { "a folder" } else { "a pipe or a device" }));
    }
    format.check_size(metadata.len())?;
    import(format, &fs::read(path)?, space)
}

/// Reads the presets of a file. `space` is for values that come without a colour space; what a file says wins.
pub fn import(format: ImportFormat, bytes: &[u8], space: Option<RgbSpace>) -> Result<Imported, ImportError> {
    format.check_size(bytes.len() as u64)?;
    let text = || std::str::from_utf8(bytes).map_err(|_| ImportError::NotUtf8);
    match format {
        ImportFormat::Preset => own(text()?),
        ImportFormat::MaterialX => materialx::read(text()?, space),
        ImportFormat::Gltf => gltf::read(bytes),
        ImportFormat::Table => table::read(text()?, space),
        ImportFormat::Values => values::read(text()?, space),
        ImportFormat::Ase => ase::read(bytes),
        ImportFormat::Gpl => gpl::read(text()?),
    }
}

fn own(text: &str) -> Result<Imported, ImportError> {
    let loaded = Preset::from_json(text)?;
    Ok(Imported { presets: vec![loaded.preset], notes: loaded.warnings })
}
