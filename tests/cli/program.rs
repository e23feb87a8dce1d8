//! Does the program behave as a command should?

use std::path::Path;
use std::process::Command;

use crate::run::{quiet, refusal, stderr};

pub const SUBCOMMANDS: [&str; 14] = [
    "match", "inspect", "samples", "metals", "reflect", "picture", "fit", "convert", "presets", "check", "import",
    "export", "study", "plan",
];

#[test]
fn help_names_every_subcommand_and_each_has_both_format_flags() {
    let help = quiet(&["--help"]);
    for subcommand in SUBCOMMANDS {
        assert!(help.contains(&format!("\n  {subcommand} ")), "{help}");
        let path: &[&str] =
            if subcommand == "study" { &["study", "accuracy", "--help"] } else { &[subcommand, "--help"] };
        let help = quiet(path);
        assert!(help.contains("--json") && help.contains("--format"), "{subcommand}");
    }
    assert!(quiet(&["--version"]).contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn a_file_that_is_not_there_opens_no_window() {
    assert!(refusal(1, &["no/such/photo.png"]).contains("no/such/photo.png"));
    assert!(refusal(2, &["--no-such-flag"]).contains("--no-such-flag"));
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_is_no_error() {
    let script =
        format!("'{}' metals --json | head -c 1 >/dev/null; exit ${{PIPESTATUS[0]}}", env!("CARGO_BIN_EXE_edgewise"));
    let output = Command::new("bash").args(["-c", &script]).output().unwrap();
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), String::new()));
    assert!(Path::new("/dev/null").exists());
}
