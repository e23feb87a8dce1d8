//! Does every layer use only the layers it may?

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

const ARCHITECTURE: &str = include_str!("../docs/architecture.md");

type Layers = BTreeMap<String, BTreeSet<String>>;

/// The table of `docs/architecture.md`: what each layer may use.
fn allowed() -> Layers {
    let rows = ARCHITECTURE.lines().filter_map(|line| line.strip_prefix("| `")?.strip_suffix(" |")?.split_once("` | "));
    let layers: Vec<(String, String)> = rows.map(|(layer, uses)| (layer.to_owned(), uses.to_owned())).collect();
    let names: BTreeSet<String> = layers.iter().map(|(layer, _)| layer.clone()).collect();
    let expand = |layer: &str, uses: &str| match uses.strip_prefix("all but ") {
        Some(forbidden) => names.iter().filter(|n| *n != forbidden && *n != layer).cloned().collect(),
        None => uses.split(", ").filter(|name| names.contains(*name)).map(str::to_owned).collect(),
    };
    layers.iter().map(|(layer, uses)| (layer.clone(), expand(layer, uses))).collect()
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries
        .flat_map(|path| if path.is_dir() { rust_files(&path) } else { vec![path] })
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .collect()
}

/// The layers named by `crate::layer` or `crate::{layer, layer::{…}, …}` in a source text.
fn used(source: &str, layers: &Layers) -> BTreeSet<String> {
    let after_crate = source.split("crate::").skip(1);
    let names = after_crate.flat_map(|rest| match rest.strip_prefix('{') {
        Some(group) => heads(group),
        None => vec![first_name(rest)],
    });
    names.filter(|name| layers.contains_key(*name)).map(str::to_owned).collect()
}

/// The first name of each path of a group whose `{` was read, up to its `}`; groups inside are passed over.
fn heads(group: &str) -> Vec<&str> {
    let mut depth = 0;
    let mut heads = vec![first_name(group)];
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => heads.push(first_name(&group[at + 1..])),
            _ => {}
        }
    }
    heads
}

fn first_name(path: &str) -> &str {
    path.trim_start().split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default()
}

#[test]
fn no_path_leaves_the_table() {
    let allowed = allowed();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let folders: BTreeSet<String> = fs::read_dir(&source)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_dir())
        .map(|path| path.file_name().unwrap().to_string_lossy().into_owned())
        .collect();
    assert_eq!(folders, allowed.keys().cloned().collect(), "every folder of src is a row of the table");

    for (layer, may_use) in &allowed {
        for file in rust_files(&source.join(layer)) {
            let text = fs::read_to_string(&file).unwrap();
            for name in used(&text, &allowed).iter().filter(|name| *name != layer) {
                assert!(may_use.contains(name), "{} uses {name}, which {layer} may not", file.display());
            }
        }
    }
}

#[test]
fn the_reader_of_paths_sees_groups_and_single_names() {
    let found = used("use crate::color::Rgb; use crate::{gui, fresnel::CosTheta};", &allowed());
    assert_eq!(found, ["color", "fresnel", "gui"].map(str::to_owned).into());
}

#[test]
fn the_reader_of_paths_looks_behind_groups_inside_groups() {
    let nested = "use crate::{color::{Rgb, metal}, photo::{read::{a, b}, c},\n    gui, metals}; use super::fit;";
    assert_eq!(used(nested, &allowed()), ["color", "gui", "photo"].map(str::to_owned).into());
}
