//! Exporting from the window: what a file would say and show, where it goes, and that it was written.

mod dialog;
mod preview;
mod write;

pub(crate) use dialog::{Answer, ExportDialog};
pub(crate) use preview::Asked;
pub(crate) use write::{Failure, Writing, write};
