//! Are the exported files still the ones in `tests/data/exports`?
//!
//! They were looked at and loaded into the programs they are for (`tests/clients/check.py`). After a change
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
        let changed = first_change(&golden, &file.bytes);
        assert!(changed.is_none(), "{} has changed {}; see the head of this test", file.name, changed.unwrap());
    }
}

/// Where two files first differ, byte by byte, and the line around it, as far as it is text.
fn first_change(before: &[u8], after: &[u8]) -> Option<String> {
    if before == after {
        return None;
    }
    let at = before.iter().zip(after).take_while(|(before, after)| before == after).count();
    let line = |bytes: &[u8]| {
        let start = bytes[..at].iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        let line = bytes[start..].split(|byte| *byte == b'\n').next().unwrap_or_default();
        String::from_utf8_lossy(line).into_owned()
    };
    Some(format!("at byte {at}: {:?} was {:?}", line(after), line(before)))
}

#[test]
fn one_byte_of_a_swatch_file_is_a_change() {
    assert_eq!(first_change(&[0x80, 0xfe], &[0x80, 0xfe]), None);
    for (before, after) in [([0x80, 0xfe], [0x80, 0xff]), ([b'a', b'\n'], [b'a', b'\r'])] {
        assert!(first_change(&before, &after).unwrap().starts_with("at byte 1"));
    }
    assert!(first_change(b"ab", b"abc").unwrap().starts_with("at byte 2"));
}

#[test]
fn no_file_is_left_over() {
    let names: Vec<String> = files().into_iter().map(|file| file.name).collect();
    for entry in fs::read_dir(folder()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(names.contains(&name), "{name} is written by no target");
    }
}
