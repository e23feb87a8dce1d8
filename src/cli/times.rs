//! What every variant takes on this machine.

use super::progress::Progress;
use crate::study::{Costs, StudyError, measured_costs};

/// What a person should know about times of a program that was not built for release.
pub(super) fn caution() -> Option<String> {
    let words = "this program was built without optimisation: its times say nothing about a release";
    cfg!(debug_assertions).then(|| words.to_owned())
}

/// The costs of all variants with their times, which take a moment to measure.
pub(super) fn measured(warnings: &mut Vec<String>) -> Result<Costs, StudyError> {
    warnings.extend(caution());
    let progress = Progress::new("Measuring");
    measured_costs(&|share| progress.report(share))
}
