//! Are the exported files still the ones in `tests/data/exports`?
//!
//! They were looked at and loaded into the programs they are for (`scripts/check_exports.py`). After a change
//! that is meant, `UPDATE_GOLDEN=1 cargo test --test export_files` writes them again; then load them again.

use std::fs;
use std::path::{Path, PathBuf};

use edgewise::color::{Rgb, RgbSpace};
use edgewise::export::{ExportFile, Options, Target, export};
use edgewise::preset::Preset;

/// Left out: the preset itself, which has tests of its own, and what is long and not text.
const TARGETS: [Target; 15] = [
    Target::Csv,
    Target::OpenPbr,
    Target::GeneralizedSchlick,
    Target::Blender,
    Target::Usd,
    Target::Glsl,
    Target::Hlsl,
    Target::Wgsl,
    Target::Osl,
    Target::StandardSurface,
    Target::Mitsuba,
    Target::MitsubaPlugin,
    Target::Gpl,
    Target::Ase,
    Target::Aco,
];

fn presets() -> [Preset; 2] {
    let preset = |name: &str, r, h| Preset {
        name: name.to_owned(),
        r: Rgb(r),
        h: Rgb(h),
        roughness: 0.0,
        ..Preset::new_authored()
    };
    [
        preset("Gold", [1.0, 0.782, 0.344], [0.986, 0.882, 0.630]),
        preset("Chromium", [0.635, 0.662, 0.705], [0.576, 0.612, 0.697]),
    ]
}

fn files() -> Vec<ExportFile> {
    let mut files = Vec::new();
    for preset in presets() {
        for target in TARGETS {
            files.extend(export(&preset, target, &Options::default()).unwrap().files);
        }
        let acescg = Options { space: Some(RgbSpace::AcesCg) };
        files.extend(export(&preset, Target::OpenPbr, &acescg).unwrap().files);
    }
    files
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/exports")
}

#[test]
fn files_are_as_they_were() {
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::create_dir_all(folder()).unwrap();
        files().iter().for_each(|file| fs::write(folder().join(&file.name), &file.bytes).unwrap());
    }
    for file in files() {
        let golden = fs::read(folder().join(&file.name)).unwrap_or_else(|error| panic!("{}: {error}", file.name));
        let [golden, now] = [&golden, &file.bytes].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
        let changed = golden.lines().zip(now.lines()).find(|(before, after)| before != after);
        assert!(golden == now, "{} has changed, first in {changed:?}; see the head of this test", file.name);
    }
}

#[test]
fn no_file_is_left_over() {
    let names: Vec<String> = files().into_iter().map(|file| file.name).collect();
    for entry in fs::read_dir(folder()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(names.contains(&name), "{name} is written by no target");
    }
}
