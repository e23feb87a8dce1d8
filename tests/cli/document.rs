//! Does docs/cli.md say all of it?

use std::fs;

use edgewise::preset::Preset;

use crate::matching::sample_file;
use crate::program::SUBCOMMANDS;
use crate::run::{edgewise, json};

const CLI_DOCUMENT: &str = include_str!("../../docs/cli.md");

/// The part of the document under a heading.
fn section(heading: &str) -> &'static str {
    let parts =
        CLI_DOCUMENT.split("\n## ").find(|part| part.lines().next().unwrap().split(", ").any(|name| name == heading));
    parts.unwrap_or_else(|| panic!("docs/cli.md has no section {heading}"))
}

#[test]
fn the_document_has_a_section_for_each_subcommand() {
    for subcommand in SUBCOMMANDS {
        assert!(section(subcommand).contains(&format!("`edgewise {subcommand}")), "{subcommand}");
    }
}

#[test]
fn the_document_names_every_field() {
    let folder = tempfile::tempdir().unwrap();
    let photo = sample_file(folder.path(), "gold_tent");
    let out = folder.path().to_str().unwrap();
    let preset = folder.path().join("preset.json").to_str().unwrap().to_owned();
    Preset::new_authored().save(preset.as_ref()).unwrap();
    let runs: [&[&str]; 13] = [
        &["match", "--sample", "gold_tent"],
        &["inspect", &photo, "--probe", "0,0"],
        &["samples"],
        &["metals", "Au"],
        &["reflect", "--metal", "Au", "--angles", "0"],
        &["picture", "--metal", "Cr", "--size", "16"],
        &["fit", "--metal", "Cr", "--model", "schlick"],
        &["convert", "--r", "0.6,0.5,0.4", "--h", "0.7,0.6,0.5", "--to", "f82-tint"],
        &["presets"],
        &["export", "--metal", "Cr", "--to", "glsl", "-o", out],
        &["check", &preset],
        &["study", "accuracy", "--metal", "Cr", "--candidate", "hoffman:exact"],
        &["study", "speed", "--quick", "--kernel", "schlick"],
    ];
    for arguments in runs {
        let value = json(&[arguments, &["--json"]].concat());
        let object = value.get(0).unwrap_or(&value).as_object().unwrap();
        for name in object.keys() {
            assert!(
                section(arguments[0]).contains(&format!("`{name}`")),
                "docs/cli.md: {} has no `{name}`",
                arguments[0]
            );
        }
        let _ = fs::remove_file(folder.path().join("chromium.glsl"));
        let csv = edgewise(&[arguments, &["--format", "csv"]].concat());
        let header = std::str::from_utf8(&csv.stdout).unwrap().lines().next().unwrap().replace(",true_r,true_h", "");
        let text = section(arguments[0]);
        let names_it = text.contains(&header) || header.split(',').all(|name| text.contains(&format!("`{name}`")));
        assert!(names_it, "docs/cli.md: {} has no {header}", arguments[0]);
    }
}
