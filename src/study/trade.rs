//! Cost against accuracy: every variant of one material or of many, and those that nothing beats.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::Serialize;

use super::{CostAxis, Costs, Measure, StudyError, Subject, Variant, forms, true_reflectance};
use crate::color::{RgbSpace, delta_e_rgb};
use crate::fresnel::whole_degrees;
use crate::number::largest;

/// What is compared.
#[derive(Clone, Debug, Default)]
pub struct TradeOptions {
    /// The space of parameters and differences.
    pub space: RgbSpace,
    /// Which cost the front is of.
    pub cost: CostAxis,
    /// Which error the front is of.
    pub measure: Measure,
    /// What the variants cost.
    pub costs: Costs,
}

/// One variant over the materials that have it. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TradeRow {
    /// The variant.
    pub variant: Variant,
    /// Number of materials.
    pub materials: usize,
    /// Nanoseconds of one RGB evaluation on this machine; `None` where it was not measured.
    pub measured_ns: Option<f64>,
    /// Shader operations of one RGB evaluation.
    pub shader_operations: u32,
    /// Bytes of the parameters of one material.
    pub parameter_bytes: u64,
    /// Mean CIEDE2000 over materials and 0°, 1°, …, 90°.
    pub mean_delta_e: f64,
    /// What 95 % of these stay within.
    pub p95_delta_e: f64,
    /// The largest of these.
    pub max_delta_e: f64,
    /// The material with the largest; `None` where none has an error.
    pub worst: Option<String>,
    /// True where no other variant is as cheap, see [`Costs::order`], and nearer to the truth.
    pub is_on_front: bool,
}

impl TradeRow {
    /// One of the errors.
    pub const fn error(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Mean => self.mean_delta_e,
            Measure::P95 => self.p95_delta_e,
            Measure::Max => self.max_delta_e,
        }
    }
}

/// Errors of one variant of one material at the whole degrees.
type Errors = (Variant, Vec<f64>);

/// The errors of every variant of some materials: what charts over any cost and of any measure share.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeErrors {
    /// Each material by its name.
    of: Vec<(String, Vec<Errors>)>,
}

impl TradeErrors {
    /// Fits and measures every variant of every material. `progress` breaks to stop.
    pub fn of(
        subjects: &[Subject<'_>],
        space: RgbSpace,
        progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
    ) -> Result<Self, StudyError> {
        let done = AtomicUsize::new(0);
        let of_subject = |subject: &Subject<'_>| -> Result<(String, Vec<Errors>), StudyError> {
            let share = || done.load(Ordering::Relaxed) as f32 / subjects.len() as f32;
            let errors = errors(subject, space, &mut || progress(share()))?;
            done.fetch_add(1, Ordering::Relaxed);
            Ok((subject.name(), errors))
        };
        let of: Result<Vec<(String, Vec<Errors>)>, StudyError> = subjects.par_iter().map(of_subject).collect();
        Ok(Self { of: of? })
    }

    /// One row for each variant, the cheapest first by [`Costs::order`]; the space of `options` is that of the errors.
    pub fn rows(&self, options: &TradeOptions) -> Vec<TradeRow> {
        let mut rows: Vec<TradeRow> =
            Variant::ALL.into_iter().filter_map(|variant| self.row(variant, options)).collect();
        let unknown = (f64::INFINITY, f64::INFINITY);
        let cost = |row: &TradeRow| options.costs.order(row.variant, options.cost).unwrap_or(unknown);
        rows.sort_by(|a, b| {
            let ((a_first, a_then), (b_first, b_then)) = (cost(a), cost(b));
            let errors = a.error(options.measure).total_cmp(&b.error(options.measure));
            a_first.total_cmp(&b_first).then(a_then.total_cmp(&b_then)).then(errors)
        });
        let mut best = f64::INFINITY;
        for row in &mut rows {
            row.is_on_front = cost(row) != unknown && row.error(options.measure) < best;
            best = best.min(row.error(options.measure));
        }
        rows
    }

    fn row(&self, variant: Variant, options: &TradeOptions) -> Option<TradeRow> {
        let named: Vec<(&str, &[f64])> =
            (self.of.iter()).filter_map(|(name, errors)| Some((name.as_str(), errors_of(errors, variant)?))).collect();
        let worst =
            named.iter().max_by(|(_, a), (_, b)| largest(a.iter().copied()).total_cmp(&largest(b.iter().copied())))?;
        let mut values: Vec<f64> = named.iter().flat_map(|(_, values)| *values).copied().collect();
        values.sort_by(f64::total_cmp);
        let cost = options.costs.of(variant);
        Some(TradeRow {
            variant,
            materials: named.len(),
            measured_ns: cost.measured_ns,
            shader_operations: cost.shader_operations,
            parameter_bytes: cost.parameter_bytes,
            mean_delta_e: values.iter().sum::<f64>() / values.len() as f64,
            p95_delta_e: values[((values.len() as f64 * 0.95).ceil() as usize).clamp(1, values.len()) - 1],
            max_delta_e: largest(values.iter().copied()),
            worst: Some(worst.0.to_owned()).filter(|_| values.iter().any(|value| *value > 0.0)),
            is_on_front: false,
        })
    }
}

/// Measures every variant of every material, the cheapest first. `progress` breaks to stop.
pub fn trade(
    subjects: &[Subject<'_>],
    options: &TradeOptions,
    progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Result<Vec<TradeRow>, StudyError> {
    Ok(TradeErrors::of(subjects, options.space, progress)?.rows(options))
}

fn errors_of(all: &[Errors], variant: Variant) -> Option<&[f64]> {
    all.iter().find(|(own, _)| *own == variant).map(|(_, errors)| errors.as_slice())
}

fn errors(
    subject: &Subject<'_>,
    space: RgbSpace,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Vec<Errors>, StudyError> {
    let truth: Vec<_> = whole_degrees().map(|c| true_reflectance(subject, c, space)).collect();
    let forms = forms(subject, Variant::of(subject), space, keep_going)?;
    let of = |form: super::FormOfVariant| {
        let pairs = whole_degrees().zip(&truth);
        (form.variant, pairs.map(|(c, truth)| delta_e_rgb(form.form.reflectance(c), *truth, space)).collect())
    };
    Ok(forms.into_iter().map(of).collect())
}

/// What the front says: how near one comes for how much.
pub fn trade_summary(rows: &[TradeRow], options: &TradeOptions) -> String {
    let told = rows.iter().filter(|row| row.is_on_front).map(|row| {
        let cost = options.costs.of(row.variant).on(options.cost).unwrap_or(f64::NAN);
        let digits = usize::from(options.cost == CostAxis::MeasuredNs) * 2;
        format!("{} {} at {cost:.digits$}", row.variant.label(), error_text(row.error(options.measure)))
    });
    let cost = match options.cost {
        CostAxis::MeasuredNs => "nanoseconds",
        CostAxis::ShaderOperations => "shader operations",
        CostAxis::ParameterBytes => "bytes of parameters",
    };
    let front = told.collect::<Vec<_>>().join("; ");
    let error = match options.measure {
        Measure::Mean => "Mean ΔE",
        Measure::P95 => "ΔE of 95 %",
        Measure::Max => "Largest ΔE",
    };
    format!("{error} by {cost}, where nothing as cheap is nearer: {front}.")
}

fn error_text(value: f64) -> String {
    if value > 0.0 && value < 0.01 { "below 0.01".to_owned() } else { format!("{value:.2}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::{metal_by_name, preferred_metals};
    use crate::study::no_progress;

    #[test]
    fn the_front_falls_from_constant_to_exact() {
        let gold = [Subject::Metal(metal_by_name("gold").unwrap())];
        for measure in Measure::ALL {
            let options = TradeOptions { measure, ..TradeOptions::default() };
            let rows = trade(&gold, &options, &no_progress).unwrap();
            assert_eq!(rows.len(), Variant::ALL.len());
            let front: Vec<&TradeRow> = rows.iter().filter(|row| row.is_on_front).collect();
            assert!(front.windows(2).all(|pair| pair[0].error(measure) > pair[1].error(measure)));
            assert_eq!((front[0].variant, front.last().unwrap().variant), (Variant::CONSTANT, Variant::Exact));
            for row in &rows {
                let beaten = front
                    .iter()
                    .any(|f| f.shader_operations <= row.shader_operations && f.error(measure) <= row.error(measure));
                assert!(beaten, "{}", row.variant);
            }
        }
    }

    /// The noise of a clock moves no variant onto the front, nor off it.
    #[test]
    fn the_front_of_times_is_the_same_where_equal_times_swap() {
        let chromium = [Subject::Metal(metal_by_name("chromium").unwrap())];
        let errors = TradeErrors::of(&chromium, RgbSpace::LinRec709, &no_progress).unwrap();
        let front = |constant_ns: f64, schlick_ns: f64| {
            let ns = |variant: Variant| match variant {
                Variant::CONSTANT => constant_ns,
                Variant::SCHLICK => schlick_ns,
                other => f64::from(other.operations().slots()) * 0.03,
            };
            let costs = Costs::with_measured(Variant::ALL.into_iter().map(|v| (v, ns(v))).collect());
            let rows = errors.rows(&TradeOptions { cost: CostAxis::MeasuredNs, costs, ..TradeOptions::default() });
            rows.into_iter().filter(|row| row.is_on_front).map(|row| row.variant).collect::<Vec<_>>()
        };
        assert_eq!(front(0.20, 0.21), front(0.21, 0.20));
        assert_eq!(front(0.20, 0.21)[..2], [Variant::CONSTANT, Variant::SCHLICK]);
    }

    #[test]
    fn many_materials_are_one_point_each_variant() {
        let some: Vec<Subject<'_>> = preferred_metals().take(3).map(Subject::Metal).collect();
        let rows = trade(&some, &TradeOptions::default(), &no_progress).unwrap();
        assert!(rows.iter().all(|row| row.materials == 3 && row.mean_delta_e <= row.max_delta_e));
        assert!(rows.iter().all(|row| row.p95_delta_e <= row.max_delta_e));
        let without_worst: Vec<Variant> = rows.iter().filter(|r| r.worst.is_none()).map(|r| r.variant).collect();
        assert_eq!(without_worst, [Variant::Exact], "what is the truth is nowhere worst");
        let times = TradeOptions { cost: CostAxis::MeasuredNs, ..TradeOptions::default() };
        let rows = trade(&some[..1], &times, &no_progress).unwrap();
        assert!(rows.iter().all(|row| !row.is_on_front), "nothing was measured");
    }
}
