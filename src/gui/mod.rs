//! The window: a shell over the library.
//!
//! A frame polls the jobs, shows the panels, applies what was asked and feeds the history. Panels that edit
//! take the preset, panels that show take the [`State`]; what has a menu entry or a key is a [`Command`].
//! Work that would hold up a frame is a `Job`. Colours and sizes are in `theme` alone.

mod app;
mod command;
mod comparisons;
mod copying;
mod demonstrations;
mod document;
mod drawn;
mod export;
mod file_dialog;
mod history;
mod job;
mod library;
mod metals;
mod panels;
mod photograph;
mod planner;
mod preview;
mod prompt;
mod recovery;
mod renderer;
mod run;
mod settings;
mod sheet;
mod spheres;
mod standing;
mod state;
mod theme;
mod thumbnails;
mod truth;
mod warnings;
mod widgets;

pub use app::App;
pub use command::Command;
pub use document::Document;
pub use renderer::Renderer;
pub use run::{Options, WindowError, run};
pub use state::{Page, State};
