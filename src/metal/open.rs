//! A person's own file of n and k.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::{Metal, NkCsvError, NkYamlError, metal_from_csv, metal_from_yaml};
use crate::file::{FileError, read_text};

/// Why a file gives no metal. Displays as one sentence with the file's name.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum MetalFileError {
    #[error("{}: a file of n and k ends in .csv, .yml or .yaml", .0.display())]
    Extension(PathBuf),
    #[error(transparent)]
    File(#[from] FileError),
    #[error("{}: {reason}", path.display())]
    Csv { path: PathBuf, reason: NkCsvError },
    #[error("{}: {reason}", path.display())]
    Yaml { path: PathBuf, reason: NkYamlError },
}

impl Metal {
    /// Reads a file of refractiveindex.info (`.yml`, `.yaml`) or a CSV with the columns `wavelength_nm` or
    /// `wavelength_um`, `n` and `k`. Where the data end inside the visible, [`Metal::held_ends`] says so.
    pub fn open(path: &Path) -> Result<Self, MetalFileError> {
        let has = |wanted: &str| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(wanted));
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let path = path.to_owned();
        if has("csv") {
            metal_from_csv(&stem, &read_text(&path)?).map_err(|reason| MetalFileError::Csv { path, reason })
        } else if has("yml") || has("yaml") {
            metal_from_yaml(&stem, &read_text(&path)?).map_err(|reason| MetalFileError::Yaml { path, reason })
        } else {
            Err(MetalFileError::Extension(path))
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn opened(name: &str, bytes: &[u8]) -> Result<Metal, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        Metal::open(&path).map_err(|error| error.to_string())
    }

    #[test]
    fn the_extension_chooses_the_reader() {
        let csv = b"wavelength_um,n,k\n0.4,1,2\n0.5,1,2\n0.6,1,2\n0.7,1,2\n";
        let yaml = b"DATA:\n  - type: tabulated nk\n    data: |\n        0.4 1 2\n        0.5 1 2\n        0.6 1 2\n        0.7 1 2\n";
        let (csv, yaml) = (opened("mine.csv", csv).unwrap(), opened("mine.YML", yaml).unwrap());
        assert_eq!(csv.table(), yaml.table());
        assert_eq!(csv.name, "mine");
        assert!(csv.held_ends().sentence().contains("400–700 nm"));
    }

    #[test]
    fn refusals_name_the_file() {
        let reason = |name: &str, bytes: &[u8]| opened(name, bytes).unwrap_err();
        assert!(reason("mine.xlsx", b"").contains("mine.xlsx: a file of n and k ends in .csv"));
        assert!(reason("mine.csv", b"\xff\xfe").contains("not UTF-8"));
        assert!(reason("big.csv", &vec![b' '; (4 << 20) + 1]).contains("big.csv: it is larger than 4 MiB"));
        assert!(reason("mine.yaml", b"DATA: 3").contains("mine.yaml: it is no file of refractiveindex.info"));
        let missing = Metal::open(Path::new("/nowhere/gold.csv")).unwrap_err().to_string();
        assert!(missing.starts_with("/nowhere/gold.csv: "), "{missing}");
    }
}
