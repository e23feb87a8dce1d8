//! Does the window do what a person asks of it? Driven by the names of its controls, without a display.

mod author;
mod comparison;
mod demonstrations;
mod drive;
mod export;
mod files;
mod library;
mod light_modes;
mod metals;
mod outlines;
mod photograph;
mod pictures;
mod planner;
mod recovery;
mod refining;
mod replacing;
mod settings;
mod small;
#[path = "../studio/mod.rs"]
mod studio;
