//! All measurements that `docs/evidence.md` states, taken at once.

use std::ops::ControlFlow;

use rayon::prelude::*;

use super::{
    AccuracyRow, Candidate, ConversionOptions, Distribution, SpreadRow, StudyError, Summary, accuracy, blend_matrix,
    blend_spread, conversion_spread, conversions, spread, summaries,
};
use crate::color::{Rgb, RgbSpace};
use crate::fit::{CurveError, Method};
use crate::fresnel::{CosTheta, FresnelModel, ModelKind, whole_degrees};
use crate::metal::{Metal, TruthCurve, metals, preferred_metals};

/// The measurements behind the paper's claims, over the preferred data set of every material.
#[derive(Clone, Debug)]
pub struct Evidence {
    /// Every metal, space and contestant.
    pub rows: Vec<AccuracyRow>,
    /// The same over all metals.
    pub summaries: Vec<Summary>,
    /// How far published data sets of one material are apart, in linear sRGB.
    pub spread: Vec<SpreadRow>,
    /// Error of parameters converted as colours from ACEScg to linear sRGB, for h, t, g and n, k.
    pub conversion: [Distribution; 4],
    /// Error of parameters blended half and half over all pairs in ACEScg, for h, t, g and n, k.
    pub blending: [Distribution; 4],
    /// The angle at which the linear error of Schlick's model is largest, for each metal, in degrees (ACEScg).
    pub schlick_peak_deg: Distribution,
    /// The one g for all metals and channels with the smallest mean error in ACEScg, and that error.
    pub best_constant_g: (f64, f64),
}

/// Where the smallest ΔE is searched for; the rest is measured in all four spaces.
const SEARCHED: [RgbSpace; 2] = [RgbSpace::LinRec709, RgbSpace::AcesCg];

/// The space of the demonstrations that need one.
const SPACE: RgbSpace = RgbSpace::AcesCg;

impl Evidence {
    /// The contestant that the paper calls black-box fitting.
    pub const FITTED_NK: Candidate = Candidate::Model(ModelKind::Conductor, Method::BlackBox);
    /// Lazányi's model with everything fitted.
    pub const FITTED_LAZANYI: Candidate = Candidate::Model(ModelKind::Lazanyi, Method::BlackBox);

    /// Takes all measurements; seconds, most of them for the searches. `progress` breaks to stop.
    pub fn measure(progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync)) -> Result<Self, StudyError> {
        let library: Vec<&Metal> = preferred_metals().collect();
        let stopped = |stopped| StudyError::Fit(crate::fit::FitError::Stopped(stopped));
        let quick = Candidate::without_black_box();
        let part = |from: f32, to: f32| move |share: f32| progress(from + (to - from) * share);
        let mut rows = accuracy(&library, &quick, &RgbSpace::ALL, &part(0.0, 0.1)).map_err(stopped)?;
        let searches = [Self::FITTED_LAZANYI, Self::FITTED_NK];
        rows.extend(accuracy(&library, &searches, &SEARCHED, &part(0.1, 0.9)).map_err(stopped)?);
        let to_srgb = ConversionOptions { from: SPACE, to: RgbSpace::LinRec709, ..ConversionOptions::default() };
        let truths: Vec<(&str, TruthCurve)> =
            library.par_iter().map(|metal| (metal.name.as_str(), TruthCurve::of(metal, SPACE))).collect();
        Ok(Self {
            summaries: summaries(&rows),
            rows,
            spread: spread(metals(), RgbSpace::LinRec709),
            conversion: conversion_spread(&conversions(&library, &to_srgb, &part(0.9, 0.95))?),
            blending: blend_spread(&blend_matrix(&library, SPACE, Method::LeastSquares, &part(0.95, 1.0))?),
            schlick_peak_deg: Distribution::of(
                truths.iter().map(|(name, truth)| (*name, peak_of_schlicks_error_deg(truth))),
            ),
            best_constant_g: best_constant_g(truths.iter().map(|(_, truth)| truth)),
        })
    }

    /// The summary of a contestant in a space, if it was measured.
    pub fn summary(&self, space: RgbSpace, candidate: Candidate) -> Option<&Summary> {
        self.summaries.iter().find(|summary| summary.space == space && summary.candidate == candidate)
    }

    /// The rows of a contestant in a space, one for each metal.
    pub fn rows_of(&self, space: RgbSpace, candidate: Candidate) -> impl Iterator<Item = &AccuracyRow> + Clone {
        self.rows.iter().filter(move |row| row.space == space && row.candidate == candidate)
    }

    /// Metals for which `x` has a smaller mean ΔE than `y`.
    pub fn wins(&self, space: RgbSpace, x: Candidate, y: Candidate) -> usize {
        let other = |row: &AccuracyRow| self.rows_of(space, y).find(|other| other.metal == row.metal);
        let is_better = |row: &&AccuracyRow| other(row).is_some_and(|y| row.mean_delta_e < y.mean_delta_e);
        self.rows_of(space, x).filter(is_better).count()
    }

    /// The metals with the largest mean ΔE of Hoffman's model with exact r and h, worst first.
    pub fn hard_cases(&self, space: RgbSpace) -> Vec<&AccuracyRow> {
        let mut rows: Vec<&AccuracyRow> = self.rows_of(space, Candidate::HOFFMAN).collect();
        rows.sort_by(|a, b| b.mean_delta_e.total_cmp(&a.mean_delta_e));
        rows
    }
}

/// The whole degree at which |Schlick − truth|, averaged over the channels, is largest (paper section 8).
fn peak_of_schlicks_error_deg(truth: &TruthCurve) -> f64 {
    let schlick = FresnelModel::Schlick { r: truth.r() };
    let mean = |rgb: Rgb| rgb.0.iter().sum::<f64>() / 3.0;
    let errors =
        whole_degrees().zip(truth.rgb()).map(|(c, rgb)| (mean((schlick.reflectance(c) - *rgb).map(f64::abs)), c));
    errors.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(f64::NAN, |(_, cos_theta): (f64, CosTheta)| cos_theta.deg())
}

/// Tries g = 0, 0.05, …, 1 for all metals, with r exact and limited to 1.
fn best_constant_g<'a>(truths: impl Iterator<Item = &'a TruthCurve> + Clone) -> (f64, f64) {
    let mean_error = |g: f64| {
        let of_metal = |truth: &TruthCurve| {
            let r = truth.r().clipped();
            CurveError::of(&FresnelModel::Gulbrandsen { r, g: Rgb::splat(g) }, truth).mean_delta_e
        };
        truths.clone().map(of_metal).sum::<f64>() / truths.clone().count() as f64
    };
    let tried = (0..=20).map(|step| f64::from(step) / 20.0).map(|g| (g, mean_error(g)));
    tried.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((f64::NAN, f64::NAN))
}
