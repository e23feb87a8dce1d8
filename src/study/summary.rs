//! What the rows of the accuracy study say about each model, over all metals.

use serde::Serialize;

use super::{AccuracyRow, Candidate};
use crate::color::RgbSpace;
use crate::number::median_of_sorted;

/// The paper's bound for the mean error of Schlick's model (section 2).
const PAPER_BOUND_DELTA_E: f64 = 2.0;

/// One contestant in one space, over all metals of the study. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The space.
    pub space: RgbSpace,
    /// The model.
    pub model: String,
    /// How its parameters were derived.
    pub method: String,
    /// Number of metals.
    pub metals: usize,
    /// Mean over the metals of the mean CIEDE2000 over the angles.
    pub mean_delta_e: f64,
    /// Median of the same.
    pub median_delta_e: f64,
    /// Mean over the metals of the largest CIEDE2000.
    pub mean_max_delta_e: f64,
    /// Mean over the metals of the mean over a sphere's picture.
    pub sphere_delta_e: f64,
    /// The metal with the largest mean CIEDE2000.
    pub worst_metal: String,
    /// Its mean CIEDE2000.
    pub worst_mean_delta_e: f64,
    /// The largest CIEDE2000 at any angle of any metal.
    pub largest_delta_e: f64,
    /// The angle of that, in degrees.
    pub angle_of_largest_deg: f64,
    /// Number of metals whose mean CIEDE2000 is below 2.
    pub below_two: usize,
    /// Number of metals for which it is worse than Schlick with the exact r, by mean CIEDE2000; `None` where Schlick
    /// was not measured for each of them.
    pub worse_than_schlick: Option<usize>,
    /// The contestant itself.
    #[serde(skip)]
    pub candidate: Candidate,
}

impl Summary {
    /// [`worse_than_schlick`](Self::worse_than_schlick) for a sentence or a table: a number, or that it is unknown.
    pub fn worse_than_schlick_text(&self) -> String {
        self.worse_than_schlick.map_or_else(|| "not measured".to_owned(), |count| count.to_string())
    }
}

/// Summarises rows by space and candidate, in the order they first appear.
pub fn summaries(rows: &[AccuracyRow]) -> Vec<Summary> {
    let mut keys: Vec<(RgbSpace, Candidate)> = Vec::new();
    for row in rows {
        let key = (row.space, row.candidate);
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys.sort_by_key(|(space, _)| RgbSpace::ALL.iter().position(|s| s == space));
    keys.into_iter().filter_map(|(space, candidate)| summary(rows, space, candidate)).collect()
}

fn summary(rows: &[AccuracyRow], space: RgbSpace, candidate: Candidate) -> Option<Summary> {
    let of_space = || rows.iter().filter(move |row| row.space == space);
    let own: Vec<&AccuracyRow> = of_space().filter(|row| row.candidate == candidate).collect();
    let worst = *own.iter().max_by(|a, b| a.mean_delta_e.total_cmp(&b.mean_delta_e))?;
    let largest = *own.iter().max_by(|a, b| a.max_delta_e.total_cmp(&b.max_delta_e))?;
    let mean = |value: fn(&AccuracyRow) -> f64| own.iter().map(|row| value(row)).sum::<f64>() / own.len() as f64;
    let schlick = |metal: &str| of_space().find(|row| row.candidate == Candidate::SCHLICK && row.metal == metal);
    let is_worse = |row: &&AccuracyRow| schlick(&row.metal).map(|s| row.mean_delta_e > s.mean_delta_e);
    let worse: Option<Vec<bool>> = own.iter().map(is_worse).collect();
    Some(Summary {
        space,
        model: candidate.model_id(),
        method: candidate.method_id(),
        metals: own.len(),
        mean_delta_e: mean(|row| row.mean_delta_e),
        median_delta_e: median(own.iter().map(|row| row.mean_delta_e).collect()),
        mean_max_delta_e: mean(|row| row.max_delta_e),
        sphere_delta_e: mean(|row| row.sphere_delta_e),
        worst_metal: worst.metal.clone(),
        worst_mean_delta_e: worst.mean_delta_e,
        largest_delta_e: largest.max_delta_e,
        angle_of_largest_deg: largest.angle_of_max_deg,
        below_two: own.iter().filter(|row| row.mean_delta_e < PAPER_BOUND_DELTA_E).count(),
        worse_than_schlick: worse.map(|worse| worse.into_iter().filter(|worse| *worse).count()),
        candidate,
    })
}

/// The middle value of any order; NaN of nothing.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    median_of_sorted(&values, |value| *value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;
    use crate::study::{accuracy, no_progress};

    #[test]
    fn one_metal_summarises_to_itself() {
        let gold = [metal_by_name("gold").unwrap()];
        let candidates = [Candidate::SCHLICK, Candidate::HOFFMAN];
        let rows = accuracy(&gold, &candidates, &[RgbSpace::AcesCg], &no_progress).unwrap();
        let summaries = summaries(&rows);
        assert_eq!(summaries.len(), 2);
        for (row, summary) in rows.iter().zip(&summaries) {
            assert_eq!(
                (summary.metals, summary.mean_delta_e, summary.median_delta_e),
                (1, row.mean_delta_e, row.mean_delta_e)
            );
        }
        assert!(summaries.iter().all(|summary| summary.worse_than_schlick == Some(0)));
    }

    #[test]
    fn without_schlick_nothing_is_said_about_it() {
        let gold = [metal_by_name("gold").unwrap()];
        let rows = accuracy(&gold, &[Candidate::HOFFMAN], &[RgbSpace::AcesCg], &no_progress).unwrap();
        let summary = &summaries(&rows)[0];
        assert_eq!((summary.worse_than_schlick, summary.worse_than_schlick_text().as_str()), (None, "not measured"));
    }

    #[test]
    fn the_middle_of_an_even_number_is_between() {
        assert_eq!(median(vec![4.0, 1.0, 3.0, 2.0]), 2.5);
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert!(median(Vec::new()).is_nan());
    }
}
