//! Does the window do what a person asks of it? Driven by the names of its controls, without a display.

mod author;
mod demonstrations;
mod drive;
mod files;
mod metals;
mod photograph;
mod pictures;
mod recovery;
