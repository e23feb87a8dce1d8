//! The regions of the window. Each reads the state, edits the preset where it is an editor, and returns actions.

pub(crate) mod curves;
pub(crate) mod demonstrations;
pub(crate) mod inspector;
pub(crate) mod library;
pub(crate) mod menu_bar;
pub(crate) mod metals;
pub(crate) mod notices;
pub(crate) mod photograph;
pub(crate) mod planner;
pub(crate) mod preview;
pub(crate) mod spheres;
pub(crate) mod status_bar;
