//! Does the program itself do what its help says? Every test runs the real binary, as a person would.
#![cfg(feature = "cli")]

mod batch;
mod check;
mod document;
mod fit_and_export;
mod inspect;
mod listing;
mod matching;
mod modes;
mod picture;
mod plan;
mod program;
mod reflect;
mod run;
mod shards;
mod stopping;
