//! Runs the program and reads what it says.

use std::process::{Command, Output, Stdio};

use edgewise::color::Rgb;
use serde_json::Value;

pub fn edgewise(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_edgewise")).args(arguments).stdin(Stdio::null()).output().unwrap()
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Standard output of a run that succeeds without a word on standard error.
pub fn quiet(arguments: &[&str]) -> String {
    let output = edgewise(arguments);
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), String::new()), "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

pub fn json(arguments: &[&str]) -> Value {
    let output = edgewise(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// A run that must fail with one sentence and print nothing.
pub fn refusal(code: i32, arguments: &[&str]) -> String {
    let output = edgewise(arguments);
    let sentence = stderr(&output);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {sentence}");
    assert_eq!(String::from_utf8_lossy(&output.stdout), "", "{arguments:?}");
    assert!(sentence.starts_with("edgewise: ") && sentence.lines().count() == 1, "{arguments:?}: {sentence}");
    sentence
}

pub fn csv_rows(text: &str) -> Vec<Vec<f64>> {
    text.lines().skip(1).map(|line| line.split(',').map(|number| number.parse().unwrap()).collect()).collect()
}

pub fn rgb(row: &[f64]) -> Rgb {
    Rgb([row[1], row[2], row[3]])
}
