//! Presets that are named as files or as whole folders.

use std::collections::HashSet;
use std::path::PathBuf;

use anyhow::bail;

use crate::preset::preset_files;

/// A file to read.
#[derive(Clone, Debug)]
pub struct Listed {
    /// Where it is.
    pub path: PathBuf,
    /// True where only its folder was named, in which other JSON files may lie.
    pub is_of_folder: bool,
}

/// The files given and those of the folders given, each once: in the order given, those of a folder by path.
pub fn listed(paths: &[PathBuf]) -> anyhow::Result<Vec<Listed>> {
    let mut files = Vec::new();
    for path in paths {
        if !path.is_dir() {
            files.push(Listed { path: path.clone(), is_of_folder: false });
            continue;
        }
        let inside = preset_files(path)?;
        if inside.is_empty() {
            bail!("there is no preset in {}", path.display());
        }
        files.extend(inside.into_iter().map(|path| Listed { path, is_of_folder: true }));
    }
    let mut known = HashSet::new();
    files.retain(|file| known.insert(file.path.clone()));
    Ok(files)
}
