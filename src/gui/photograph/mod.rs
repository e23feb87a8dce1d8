//! The photograph beside the preset: its pixels, its marks, and what is solved from them.

mod comparison;
mod develop;
mod grey_scale;
mod mark;
mod needs;
mod outlining;
mod reading;
mod session;
mod shape;
mod source;

pub(crate) use comparison::{Compared, Looking, Scale};
pub(crate) use develop::{Developer, Development};
pub(crate) use mark::Mark;
pub(crate) use needs::{Need, missing};
pub(crate) use reading::Reading;
pub(crate) use session::{Matching, Session};
pub(crate) use shape::MarkShape;
pub(crate) use source::{Loaded, Source};
