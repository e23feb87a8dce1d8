//! The photograph beside the preset: its pixels, its marks, and what is solved from them.

mod develop;
mod mark;
mod session;
mod source;

pub(crate) use develop::{Developer, Development};
pub(crate) use mark::{Mark, MarkShape};
pub(crate) use session::{Matching, Session};
pub(crate) use source::{Loaded, Source};
