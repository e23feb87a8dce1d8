//! Parameters converted between spaces as if they were colours (paper section 4).

use std::ops::ControlFlow;

use nalgebra::Matrix3;
use rayon::prelude::*;
use serde::Serialize;

use super::accuracy::Meter;
use super::distribution::told;
use super::parameters::{Pair, Parameters, transformed};
use super::{Contestants, Distribution, StudyError, Subject};
use crate::color::{Lab, Rgb, RgbSpace, delta_e_2000};
use crate::fit::{CurveError, FitError, Method};
use crate::metal::Metal;
use crate::number::largest;

/// What is converted, and how n, k and g come about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConversionOptions {
    /// The space the parameters were made in.
    pub from: RgbSpace,
    /// The space they are wanted in.
    pub to: RgbSpace,
    /// How n, k and g of a measured metal are derived.
    pub method: Method,
}

impl Default for ConversionOptions {
    /// Textures painted in sRGB, rendered in ACEScg: the everyday case.
    fn default() -> Self {
        Self { from: RgbSpace::LinRec709, to: RgbSpace::AcesCg, method: Method::ColourMatching }
    }
}

/// One material, converted.
#[derive(Clone, Debug)]
pub struct ColourConversion {
    /// The material's name.
    pub name: String,
    /// Where from and where to.
    pub options: ConversionOptions,
    /// The true appearance, converted, at 0°, 1°, …, 90°.
    pub truth: Vec<Rgb>,
    /// One for each of [`Parameters::ALL`].
    pub results: Vec<ConvertedParameters>,
    /// What the parameters could not express before any conversion.
    pub losses: Vec<String>,
}

/// What became of one description.
#[derive(Clone, Debug)]
pub struct ConvertedParameters {
    /// The parameters in the first space.
    pub original: Pair,
    /// The same, multiplied by the matrix between the spaces; unlimited.
    pub converted: Pair,
    /// The appearance the original parameters have, converted: what should be seen.
    pub appearance: Vec<Rgb>,
    /// What the converted parameters look like, after those outside their domain were limited.
    pub curve: Vec<Rgb>,
    /// CIEDE2000 between the two at each whole degree.
    pub delta_e: Vec<f64>,
    /// The same over the angles: the fault of the conversion alone.
    pub error: CurveError,
    /// What the converted parameters look like against the truth: conversion and model together.
    pub truth_error: CurveError,
    /// Largest CIEDE2000 over the angles after conversion there and back.
    pub there_and_back_delta_e: f64,
    /// How many of the six converted numbers had no meaning and were limited.
    pub left_domain: usize,
}

/// Converts one material.
pub fn conversion(subject: &Subject<'_>, options: &ConversionOptions) -> Result<ColourConversion, StudyError> {
    let contestants = Contestants::of(subject, options.from, options.method)?;
    Ok(conversion_of(&contestants, options))
}

/// Converts contestants that are known already; they must be in the space the options start from.
pub fn conversion_of(contestants: &Contestants, options: &ConversionOptions) -> ColourConversion {
    assert_eq!(contestants.space, options.from, "contestants of the space the options name");
    let there = options.from.matrix_to(options.to);
    let back = options.to.matrix_to(options.from);
    let truth: Vec<Rgb> = contestants.truth.iter().map(|rgb| transformed(&there, *rgb)).collect();
    let result = |pair: &Pair| ConvertedParameters::new(*pair, &truth, &there, &back, options);
    let results = contestants.pairs.iter().map(result).collect();
    ColourConversion {
        name: contestants.name.clone(),
        options: *options,
        truth,
        results,
        losses: contestants.losses.clone(),
    }
}

impl ConvertedParameters {
    fn new(
        original: Pair,
        truth: &[Rgb],
        there: &Matrix3<f64>,
        back: &Matrix3<f64>,
        options: &ConversionOptions,
    ) -> Self {
        let before = original.curve();
        let appearance: Vec<Rgb> = before.iter().map(|rgb| transformed(there, *rgb)).collect();
        let converted = original.converted(there);
        let curve = converted.limited().curve();
        let returned = converted.limited().converted(back).limited().curve();
        let delta_e = delta_e_of_curves(&curve, &appearance, options.to);
        Self {
            original,
            converted,
            error: CurveError::over_degrees(delta_e.iter().copied()),
            truth_error: CurveError::over_degrees(delta_e_of_curves(&curve, truth, options.to)),
            there_and_back_delta_e: largest(delta_e_of_curves(&returned, &before, options.from)),
            left_domain: converted.outside_domain(),
            appearance,
            curve,
            delta_e,
        }
    }

    /// Which parameters these are.
    pub fn parameters(&self) -> Parameters {
        self.original.parameters
    }
}

/// CIEDE2000 between two curves of a space, angle by angle.
pub(super) fn delta_e_of_curves(x: &[Rgb], y: &[Rgb], space: RgbSpace) -> Vec<f64> {
    let lab = |rgb: &Rgb| Lab::from_rgb(*rgb, space);
    x.iter().zip(y).map(|(x, y)| delta_e_2000(lab(x), lab(y))).collect()
}

/// One angle of one description. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ConversionRow {
    /// The material.
    pub material: String,
    /// `h`, `t`, `g` or `nk`.
    pub parameters: Parameters,
    /// The space the parameters were made in.
    pub from: RgbSpace,
    /// The space of every colour of the row.
    pub to: RgbSpace,
    /// Angle of incidence in degrees.
    pub theta_deg: f64,
    /// The appearance that should be kept.
    pub wanted_red: f64,
    /// The same, green.
    pub wanted_green: f64,
    /// The same, blue.
    pub wanted_blue: f64,
    /// What the converted parameters look like.
    pub red: f64,
    /// The same, green.
    pub green: f64,
    /// The same, blue.
    pub blue: f64,
    /// CIEDE2000 between the two.
    pub delta_e: f64,
}

/// One description of one material, over the angles. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ConversionSummary {
    /// The material.
    pub material: String,
    /// `h`, `t`, `g` or `nk`.
    pub parameters: Parameters,
    /// The space the parameters were made in.
    pub from: RgbSpace,
    /// The space they were converted to.
    pub to: RgbSpace,
    /// Mean CIEDE2000 over the angles between the converted parameters and the converted appearance.
    pub mean_delta_e: f64,
    /// Largest of the same.
    pub max_delta_e: f64,
    /// The angle of the largest, in degrees.
    pub angle_of_max_deg: f64,
    /// Mean CIEDE2000 to the converted truth: conversion and model together.
    pub truth_mean_delta_e: f64,
    /// Largest CIEDE2000 after conversion there and back.
    pub there_and_back_delta_e: f64,
    /// How many of the six numbers left their domain.
    pub left_domain: usize,
}

impl ColourConversion {
    /// Every angle of every description.
    pub fn rows(&self) -> Vec<ConversionRow> {
        self.results.iter().flat_map(|result| (0..result.delta_e.len()).map(|deg| self.row(result, deg))).collect()
    }

    fn row(&self, result: &ConvertedParameters, deg: usize) -> ConversionRow {
        let ([wanted_red, wanted_green, wanted_blue], [red, green, blue]) =
            (result.appearance[deg].0, result.curve[deg].0);
        ConversionRow {
            material: self.name.clone(),
            parameters: result.parameters(),
            from: self.options.from,
            to: self.options.to,
            theta_deg: deg as f64,
            wanted_red,
            wanted_green,
            wanted_blue,
            red,
            green,
            blue,
            delta_e: result.delta_e[deg],
        }
    }

    /// One row for each description.
    pub fn summaries(&self) -> Vec<ConversionSummary> {
        let of = |result: &ConvertedParameters| ConversionSummary {
            material: self.name.clone(),
            parameters: result.parameters(),
            from: self.options.from,
            to: self.options.to,
            mean_delta_e: result.error.mean_delta_e,
            max_delta_e: result.error.max_delta_e,
            angle_of_max_deg: result.error.angle_of_max_deg,
            truth_mean_delta_e: result.truth_error.mean_delta_e,
            there_and_back_delta_e: result.there_and_back_delta_e,
            left_domain: result.left_domain,
        };
        self.results.iter().map(of).collect()
    }

    /// What is seen, with the numbers in it.
    pub fn summary(&self) -> String {
        let [h, t, g, nk] = Parameters::ALL.map(|parameters| &self.results[parameters as usize]);
        let max = |result: &ConvertedParameters| result.error.max_delta_e;
        let left: usize = self.results.iter().map(|result| result.left_domain).sum();
        let limits = match left {
            0 => String::new(),
            1 => " One parameter left its domain and had to be limited.".to_owned(),
            _ => format!(" {left} parameters left their domain and had to be limited."),
        };
        format!(
            "{} from {} to {}: r and h convert as colours without a change ({:.2} ΔE); converted in the same way, \
             t is off by up to {:.2} ΔE, g by {:.2} and n, k by {:.2}.{limits}",
            self.name,
            self.options.from.label(),
            self.options.to.label(),
            max(h),
            max(t),
            max(g),
            max(nk)
        )
    }
}

/// Converts every metal; rows in the order metal, parameters. Metals run in parallel.
///
/// `progress` is told the share of metals done, from any thread, and stops the study by breaking.
pub fn conversions(
    metals: &[&Metal],
    options: &ConversionOptions,
    progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Result<Vec<ConversionSummary>, StudyError> {
    let meter = Meter::new(metals.len(), progress);
    let of_metal = |metal: &&Metal| {
        let summaries = conversion(&Subject::Metal(metal), options)?.summaries();
        meter.one_more().map_err(FitError::Stopped)?;
        Ok(summaries)
    };
    let rows: Result<Vec<Vec<ConversionSummary>>, StudyError> = metals.par_iter().map(of_metal).collect();
    Ok(rows?.into_iter().flatten().collect())
}

/// How the mean error over the angles is spread over materials, for each of [`Parameters::ALL`].
pub fn conversion_spread(rows: &[ConversionSummary]) -> [Distribution; 4] {
    Parameters::ALL.map(|parameters| {
        let own = rows.iter().filter(|row| row.parameters == parameters);
        Distribution::of(own.map(|row| (row.material.as_str(), row.mean_delta_e)))
    })
}

/// What is seen over all materials, with the numbers in it.
pub fn conversions_summary(rows: &[ConversionSummary], options: &ConversionOptions) -> String {
    let spread = conversion_spread(rows);
    format!(
        "Mean ΔE over {} materials from {} to {}: {}.",
        spread[0].count,
        options.from.label(),
        options.to.label(),
        told(&spread)
    )
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::metal::metal_by_name;
    use crate::study::no_progress;

    proptest! {
        /// Paper section 4, for any matrix whose rows sum to one.
        #[test]
        fn r_and_h_convert_without_error(
            m in prop::array::uniform3((-0.5..1.5, -0.5..1.5)),
            r in prop::array::uniform3(-0.1..1.1), h in prop::array::uniform3(-0.1..1.1),
        ) {
            let rows = m.map(|(a, b): (f64, f64)| nalgebra::RowVector3::new(a, b, 1.0 - a - b));
            let matrix = Matrix3::from_rows(&rows);
            let original = Pair::new(Parameters::H, Rgb(r), Rgb(h));
            let converted = original.converted(&matrix);
            prop_assert_eq!(converted.outside_domain(), 0);
            for (wanted, got) in original.curve().iter().zip(converted.curve()) {
                prop_assert!(transformed(&matrix, *wanted).max_abs_difference(got) < 1e-12);
            }
        }
    }

    #[test]
    fn staying_in_a_space_changes_nothing() {
        let options = ConversionOptions { from: RgbSpace::AcesCg, to: RgbSpace::AcesCg, ..Default::default() };
        let gold = conversion(&Subject::Metal(metal_by_name("gold").unwrap()), &options).unwrap();
        assert!(gold.summaries().iter().all(|row| row.max_delta_e == 0.0 && row.there_and_back_delta_e == 0.0));
    }

    /// What is not limited comes back; gold in the narrow space has limited parameters that do not.
    #[test]
    fn there_and_back_fails_only_where_parameters_were_limited() {
        let options = ConversionOptions { from: RgbSpace::AcesCg, to: RgbSpace::LinRec709, ..Default::default() };
        for metal in crate::metal::preferred_metals() {
            for row in conversion(&Subject::Metal(metal), &options).unwrap().summaries() {
                assert!(row.left_domain > 0 || row.there_and_back_delta_e < 1e-6, "{row:?}");
            }
        }
    }

    #[test]
    fn rows_serialise_flat_and_all_metals_have_four() {
        let metals = [metal_by_name("gold").unwrap(), metal_by_name("copper").unwrap()];
        let options = ConversionOptions::default();
        let rows = conversions(&metals, &options, &no_progress).unwrap();
        assert_eq!(rows.len(), 8);
        assert_eq!(conversion_spread(&rows)[0].count, 2);
        assert!(conversion_spread(&rows)[0].max < 1e-9);
        let stopped = conversions(&metals, &options, &|_| ControlFlow::Break(()));
        assert!(matches!(stopped, Err(StudyError::Fit(FitError::Stopped(_)))));
        let rows = conversion(&Subject::Metal(metals[0]), &options).unwrap().rows();
        assert_eq!(rows.len(), 4 * 91);
    }
}
