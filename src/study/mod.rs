//! The paper's evidence, measured: what each model costs in accuracy and robustness.

mod accuracy;
mod candidate;
mod summary;

pub use accuracy::{AccuracyRow, accuracy, no_progress};
pub use candidate::{Candidate, CandidateError};
pub use summary::{Summary, summaries};
