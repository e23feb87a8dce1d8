//! A folder of presets, as people keep them under version control.

use std::fs;
use std::path::{Path, PathBuf};

use crate::file::FileError;

/// The files of a folder and of those inside it that may be presets, by path.
///
/// Those are `.json` files. What begins with a point is passed over (`.git`), and so are links to folders, which
/// could lead round in circles.
pub fn preset_files(folder: &Path) -> Result<Vec<PathBuf>, FileError> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        collect(&folder, &mut files, &mut folders)
            .map_err(|error| FileError { path: folder, problem: error.into() })?;
    }
    files.sort();
    Ok(files)
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>, folders: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let path = entry.path();
        if entry.file_name().to_string_lossy().starts_with('.') {
            continue;
        }
        if entry.file_type()?.is_dir() {
            folders.push(path);
        } else if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json")) {
            files.push(path);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_presets_at_every_depth_by_path() {
        let folder = tempfile::tempdir().unwrap();
        for path in ["b.json", "a/z.JSON", "a/b/c.json", ".git/d.json", "a/notes.txt", ".hidden.json"] {
            let path = folder.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "{}").unwrap();
        }
        #[cfg(unix)]
        std::os::unix::fs::symlink(folder.path(), folder.path().join("a/round")).unwrap();
        let found = preset_files(folder.path()).unwrap();
        let wanted = ["a/b/c.json", "a/z.JSON", "b.json"].map(|path| folder.path().join(path));
        assert_eq!(found, wanted);
        assert!(preset_files(&folder.path().join("no")).unwrap_err().to_string().contains("no such"));
    }
}
