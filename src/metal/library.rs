//! The metals that ship with the program.

use std::sync::LazyLock;

use include_dir::{Dir, include_dir};
use thiserror::Error;

use super::{Metal, metal_from_csv};

static FILES: Dir = include_dir!("$CARGO_MANIFEST_DIR/assets/metals");

static METALS: LazyLock<Vec<Metal>> = LazyLock::new(|| {
    let mut metals: Vec<Metal> = FILES.files().filter_map(built_in).collect();
    metals.sort_by(|a, b| (&a.name, !a.is_preferred, &a.id).cmp(&(&b.name, !b.is_preferred, &b.id)));
    metals
});

fn built_in(file: &include_dir::File) -> Option<Metal> {
    let stem = file.path().file_stem()?.to_str()?;
    let is_csv = file.path().extension().is_some_and(|extension| extension == "csv");
    is_csv.then(|| metal_from_csv(stem, file.contents_utf8().expect("UTF-8")).expect("a file that a test has read"))
}

/// A name that no built-in metal has.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("there is no metal “{0}” in the library; `edgewise metals` lists them")]
pub struct UnknownMetal(String);

/// Every built-in data set, by name, the preferred one of each material first.
pub fn metals() -> &'static [Metal] {
    &METALS
}

/// One data set for each material: the preferred ones.
pub fn preferred_metals() -> impl Iterator<Item = &'static Metal> {
    metals().iter().filter(|metal| metal.is_preferred)
}

/// A built-in metal by its id, or the preferred data set by name or symbol. Case does not matter.
pub fn metal_by_name(name: &str) -> Result<&'static Metal, UnknownMetal> {
    let matches = |candidate: &str| candidate.eq_ignore_ascii_case(name.trim());
    let by_id = metals().iter().find(|metal| matches(&metal.id));
    by_id
        .or_else(|| preferred_metals().find(|metal| matches(&metal.name) || matches(&metal.symbol)))
        .ok_or_else(|| UnknownMetal(name.to_owned()))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_file_is_a_metal_with_a_source() {
        let csv_files = FILES.files().filter(|file| file.path().extension().is_some_and(|e| e == "csv")).count();
        assert_eq!(metals().len(), csv_files);
        for metal in metals() {
            assert!(!metal.provenance.authors.is_empty() && !metal.provenance.licence.is_empty(), "{}", metal.id);
        }
    }

    #[test]
    fn names_lead_to_one_preferred_set() {
        let names: BTreeSet<_> = metals().iter().map(|metal| &metal.name).collect();
        assert_eq!(preferred_metals().count(), names.len());
        assert!(metal_by_name("GOLD").unwrap().is_preferred);
        assert_eq!(metal_by_name("Au_Johnson").unwrap().dataset, "Johnson");
        assert!(metal_by_name("unobtainium").is_err());
    }
}
