//! The accuracy of every model for every metal (paper sections 2, 3 and 5).

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::Serialize;

use super::Candidate;
use super::candidate::SpectralWeights;
use crate::color::RgbSpace;
use crate::fit::{CurveError, FitError, Loss, Stopped};
use crate::metal::{Metal, SpectralCurve, TruthCurve};

/// One cell of the study: a metal, a space and a contestant. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AccuracyRow {
    /// Identifier of the data set, e.g. `Au_Olmon-ts`.
    pub metal: String,
    /// The metal's name, e.g. `Gold`.
    pub name: String,
    /// What kind of material it is.
    pub category: String,
    /// The space: parameters are in it and differences are measured in it.
    pub space: RgbSpace,
    /// The model, e.g. `hoffman`, or `spectral-20`.
    pub model: String,
    /// How its parameters were derived, e.g. `exact`.
    pub method: String,
    /// Mean CIEDE2000 over 0°, 1°, …, 90°.
    pub mean_delta_e: f64,
    /// Largest CIEDE2000 over the same angles.
    pub max_delta_e: f64,
    /// The angle of the largest, in degrees.
    pub angle_of_max_deg: f64,
    /// Mean over the picture of a sphere: weight sin θ · cos θ.
    pub sphere_delta_e: f64,
    /// What the parameters could not express, as sentences; empty when nothing was lost.
    pub losses: String,
    /// The contestant itself.
    #[serde(skip)]
    pub candidate: Candidate,
}

/// Measures every candidate for every metal in every space; rows in the order metal, space, candidate.
///
/// A metal's spectral reflectance is computed once for all spaces and its truth once for each space. Metals run in
/// parallel. `progress` is told the share of rows done, from any thread, and stops the study by breaking.
pub fn accuracy(
    metals: &[&Metal],
    candidates: &[Candidate],
    spaces: &[RgbSpace],
    progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Result<Vec<AccuracyRow>, Stopped> {
    let run = Run {
        candidates,
        spaces,
        weights: SpectralWeights::new(candidates, spaces),
        meter: Meter::new(metals.len() * candidates.len() * spaces.len(), progress),
    };
    let rows: Result<Vec<Vec<AccuracyRow>>, Stopped> = metals.par_iter().map(|metal| run.rows_of(metal)).collect();
    Ok(rows?.into_iter().flatten().collect())
}

/// What all metals of a study share.
struct Run<'a> {
    candidates: &'a [Candidate],
    spaces: &'a [RgbSpace],
    weights: SpectralWeights,
    meter: Meter<'a>,
}

impl Run<'_> {
    fn rows_of(&self, metal: &Metal) -> Result<Vec<AccuracyRow>, Stopped> {
        let spectral = SpectralCurve::of(metal);
        let mut rows = Vec::with_capacity(self.candidates.len() * self.spaces.len());
        for &space in self.spaces {
            let truth = spectral.truth(space);
            for &candidate in self.candidates {
                rows.extend(self.row(metal, &truth, candidate)?);
                self.meter.one_more()?;
            }
        }
        Ok(rows)
    }

    /// `None` for a candidate whose method does not fit its model: there is nothing to measure.
    fn row(&self, metal: &Metal, truth: &TruthCurve, candidate: Candidate) -> Result<Option<AccuracyRow>, Stopped> {
        let measured = candidate.measure(metal, truth, &self.weights, &mut || self.meter.keep_going());
        match measured {
            Ok((error, losses)) => Ok(Some(AccuracyRow::new(metal, truth.space, candidate, error, &losses))),
            Err(FitError::Stopped(stopped)) => Err(stopped),
            Err(FitError::NotForThisModel { .. }) => Ok(None),
        }
    }
}

impl AccuracyRow {
    fn new(metal: &Metal, space: RgbSpace, candidate: Candidate, error: CurveError, losses: &[Loss]) -> Self {
        Self {
            metal: metal.id.clone(),
            name: metal.name.clone(),
            category: metal.category.clone(),
            space,
            model: candidate.model_id(),
            method: candidate.method_id(),
            mean_delta_e: error.mean_delta_e,
            max_delta_e: error.max_delta_e,
            angle_of_max_deg: error.angle_of_max_deg,
            sphere_delta_e: error.sphere_delta_e,
            losses: losses.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "),
            candidate,
        }
    }
}

/// Counts finished rows for all threads and remembers that someone said stop.
pub(super) struct Meter<'a> {
    total: usize,
    done: AtomicUsize,
    is_stopped: AtomicBool,
    progress: &'a (dyn Fn(f32) -> ControlFlow<()> + Sync),
}

impl<'a> Meter<'a> {
    pub(super) fn new(total: usize, progress: &'a (dyn Fn(f32) -> ControlFlow<()> + Sync)) -> Self {
        Self { total, done: AtomicUsize::new(0), is_stopped: AtomicBool::new(false), progress }
    }

    fn keep_going(&self) -> ControlFlow<()> {
        if self.is_stopped.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    pub(super) fn one_more(&self) -> Result<(), Stopped> {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if (self.progress)(done as f32 / self.total as f32).is_break() {
            self.is_stopped.store(true, Ordering::Relaxed);
        }
        if self.keep_going().is_break() { Err(Stopped) } else { Ok(()) }
    }
}

/// A progress closure for those who want none.
pub fn no_progress(_: f32) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;
    use crate::metal::metal_by_name;

    #[test]
    fn rows_come_in_order_and_serialise_flat() {
        let metals = [metal_by_name("gold").unwrap(), metal_by_name("iron").unwrap()];
        let candidates = [Candidate::SCHLICK, Candidate::HOFFMAN];
        let rows = accuracy(&metals, &candidates, &RgbSpace::ALL, &no_progress).unwrap();
        assert_eq!(rows.len(), 2 * 2 * 4);
        assert_eq!((rows[0].name.as_str(), rows[1].model.as_str(), rows[8].name.as_str()), ("Gold", "hoffman", "Iron"));

        let mut csv = csv::Writer::from_writer(Vec::new());
        csv.serialize(&rows[0]).unwrap();
        let text = String::from_utf8(csv.into_inner().unwrap()).unwrap();
        assert!(text.starts_with(
            "metal,name,category,space,model,method,mean_delta_e,max_delta_e,angle_of_max_deg,sphere_delta_e,losses\n"
        ));
    }

    #[test]
    fn counts_up_to_one_and_stops_when_told() {
        let gold = [metal_by_name("gold").unwrap()];
        let seen = Mutex::new(Vec::new());
        let record = |share: f32| {
            seen.lock().unwrap().push(share);
            ControlFlow::Continue(())
        };
        accuracy(&gold, &[Candidate::SCHLICK, Candidate::HOFFMAN], &[RgbSpace::AcesCg], &record).unwrap();
        assert_eq!(*seen.lock().unwrap(), [0.5, 1.0]);
        let stopped = accuracy(&gold, &Candidate::without_search(), &RgbSpace::ALL, &|_| ControlFlow::Break(()));
        assert_eq!(stopped, Err(Stopped));
    }
}
