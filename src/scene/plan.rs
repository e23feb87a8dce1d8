//! For each material the cheapest variant within the tolerance, why not a cheaper one, and what the scene saves.

use std::ops::ControlFlow;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::material::{SceneMaterial, Source, Truth};
use super::{Angles, MaterialCurves, SceneCurves, SeenError, Target, Tolerance, VariantCurve};
use crate::color::{Rgb, RgbSpace};
use crate::metal::metals;
use crate::number::short;
use crate::preset::{Origin, Preset};
use crate::study::{Cost, Costs, Form, Measure, StudyError, Variant};

/// What a plan is made for.
#[derive(Clone, Debug, Default)]
pub struct PlanOptions {
    /// The space of parameters and differences.
    pub space: RgbSpace,
    /// How far from the truth a material may be.
    pub tolerance: Tolerance,
    /// Which cost counts.
    pub target: Target,
    /// What the variants cost.
    pub costs: Costs,
}

/// Colours reach beyond 0–1 in narrow spaces and under a bright light, but no further than this.
const MOST_REFLECTANCE: f64 = 10.0;

/// Why there is no plan.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum PlanError {
    #[error("there is no material to plan for")]
    NoMaterial,
    #[error("the tolerance must be a finite ΔE of at least 0, not {}", short(*.0))]
    Tolerance(f64),
    #[error(
        "{name}: {} is no reflectance; within ±{MOST_REFLECTANCE} the colours of a material can be planned for",
        short(*value)
    )]
    Colour { name: String, value: f64 },
    #[error(transparent)]
    Study(#[from] StudyError),
}

/// The choice for every material of a scene. The field names are stable, see docs/cli.md.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// The space of parameters and differences.
    pub space: RgbSpace,
    /// The bound that every material keeps.
    pub tolerance: Tolerance,
    /// Which cost counted.
    pub target: Target,
    /// False where an offline plan compared operations, since nothing was measured.
    pub has_times: bool,
    /// Where the angles come from, as a sentence.
    pub scene: String,
    /// One for each material, in the order given.
    pub materials: Vec<MaterialPlan>,
    /// What the scene saves.
    pub saves: Savings,
    /// What a person should know about where the angles come from; whoever found them adds it.
    #[serde(default)]
    pub notes: Vec<String>,
}

/// The choice for one material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MaterialPlan {
    /// The name people read.
    pub name: String,
    /// Identifier of the metal the errors are measured against; `None` where two colours are their own truth.
    pub metal: Option<String>,
    /// Reflectance facing the surface.
    pub r: Rgb,
    /// Reflectance at 81.8°.
    pub h: Rgb,
    /// Perceptual roughness, 0–1.
    pub roughness: f64,
    /// Share of the scene, 0–1.
    pub share: f64,
    /// The smallest and largest angle it is seen at, in degrees; `None` where it is not seen.
    pub seen_deg: Option<(f64, f64)>,
    /// The cheapest variant within the tolerance.
    pub chosen: Variant,
    /// Its parameters; `None` for the measured metal itself.
    pub parameters: Option<Form>,
    /// What was chosen from, the cheapest first.
    pub judgements: Vec<Judgement>,
    /// What a person should know.
    pub notes: Vec<String>,
}

/// A variant that was looked at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// The variant.
    pub variant: Variant,
    /// What it costs.
    pub cost: Cost,
    /// Its error at the angles that are seen.
    pub error: SeenError,
    /// What became of it.
    pub verdict: Verdict,
}

/// What became of a variant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The cheapest within the tolerance.
    Chosen,
    /// Not dearer, but outside the tolerance.
    TooFar,
    /// As cheap and within the tolerance, but farther from the truth.
    Farther,
    /// Dearer than what was chosen.
    Dearer,
}

/// A cost of the scene, planned and if every material were exact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Saved {
    /// With the chosen variants.
    pub planned: f64,
    /// With exact ones.
    pub exact: f64,
}

/// What a scene saves against modelling everything exactly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Savings {
    /// Shader operations of one evaluation, the mean over the picture.
    pub shader_operations: Saved,
    /// Nanoseconds of one evaluation on this machine, the mean over the picture; `None` where nothing was measured.
    pub measured_ns: Option<Saved>,
    /// Bytes of the parameters of all materials.
    pub parameter_bytes: Saved,
}

impl Saved {
    fn add(&mut self, weight: f64, planned: f64, exact: f64) {
        // Nothing seen costs nothing, however dear it is.
        if weight > 0.0 {
            self.planned += weight * planned;
            self.exact += weight * exact;
        }
    }
}

impl MaterialPlan {
    /// The judgement of the chosen variant.
    pub fn choice(&self) -> &Judgement {
        self.judgements.iter().find(|judgement| judgement.verdict == Verdict::Chosen).expect("one was chosen")
    }

    /// True where the scene shows it.
    pub const fn is_seen(&self) -> bool {
        self.seen_deg.is_some()
    }

    /// Why nothing cheaper was chosen, as a sentence; empty where nothing is cheaper.
    pub fn reason(&self, tolerance: Tolerance) -> String {
        let too_far = self.judgements.iter().filter(|judgement| judgement.verdict == Verdict::TooFar);
        let told: Vec<String> = too_far.map(|judgement| judgement.reason(tolerance)).collect();
        told.join("; ")
    }

    /// The material as a preset, in the space of the plan.
    pub fn preset(&self, space: RgbSpace) -> Preset {
        let own = Preset { name: self.name.clone(), r: self.r, h: self.h, space, ..Preset::new_authored() };
        let metal = self.metal.as_deref().and_then(|id| metals().iter().find(|metal| metal.id == id));
        let measured =
            metal.map(|metal| Origin::Measured { metal: metal.id.clone(), provenance: metal.provenance.clone() });
        Preset { roughness: self.roughness, origin: measured.unwrap_or_default(), ..own }
    }
}

impl Judgement {
    /// What became of the variant, as a sentence.
    pub fn reason(&self, tolerance: Tolerance) -> String {
        let SeenError { max_delta_e, angle_of_max_deg, .. } = self.error;
        let label = self.variant.label();
        let at = if tolerance.on == Measure::Max { format!(" at {angle_of_max_deg:.0}°") } else { String::new() };
        let value = self.error.of(tolerance.on);
        match self.verdict {
            Verdict::Chosen => format!("{label}: up to ΔE {max_delta_e:.2} at {angle_of_max_deg:.0}°"),
            Verdict::TooFar => format!("{label}: {} {value:.2}{at}", tolerance.on.label()),
            Verdict::Farther => format!("{label}: as cheap, but {} {value:.2}{at}", tolerance.on.label()),
            Verdict::Dearer => format!("{label}: dearer"),
        }
    }
}

/// Plans for every material. `progress` hears the share done, from any thread, and stops the work by breaking.
///
/// A metal is fitted once, however often it occurs; the scene enters only by the weights of its angles.
pub fn plan_scene(
    materials: &[SceneMaterial],
    scene: &str,
    options: &PlanOptions,
    progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Result<Plan, PlanError> {
    check(materials, options)?;
    let sources: Vec<&Source> = materials.iter().map(|material| &material.source).collect();
    let curves = SceneCurves::of(&sources, options.space, None, progress)?;
    plan_with_curves(materials, &curves, scene, options)
}

/// Plans for every material from its curves, which other scenes and tolerances may share.
///
/// # Panics
/// If the curves are of other materials or in another space.
pub fn plan_with_curves(
    materials: &[SceneMaterial],
    curves: &SceneCurves,
    scene: &str,
    options: &PlanOptions,
) -> Result<Plan, PlanError> {
    check(materials, options)?;
    assert_eq!((curves.len(), curves.space()), (materials.len(), options.space), "curves of these materials");
    let total: f64 = materials.iter().map(|material| material.angles.total()).sum();
    let has_times = options.costs.has_times();
    let plans: Vec<MaterialPlan> = (0..materials.len())
        .into_par_iter()
        .map(|i| plan_material(&materials[i], curves.get(i), total, has_times, options))
        .collect();
    Ok(Plan {
        space: options.space,
        tolerance: options.tolerance,
        target: options.target,
        has_times,
        scene: scene.to_owned(),
        saves: savings(&plans, curves, &options.costs),
        materials: plans,
        notes: Vec::new(),
    })
}

fn check(materials: &[SceneMaterial], options: &PlanOptions) -> Result<(), PlanError> {
    let limit = options.tolerance.delta_e;
    if materials.is_empty() {
        return Err(PlanError::NoMaterial);
    }
    if !(limit >= 0.0 && limit.is_finite()) {
        return Err(PlanError::Tolerance(limit));
    }
    materials.iter().try_for_each(check_colours)
}

fn check_colours(material: &SceneMaterial) -> Result<(), PlanError> {
    let Source::Preset(preset) = &material.source else { return Ok(()) };
    let mut values = preset.r.0.into_iter().chain(preset.h.0);
    match values.find(|value| value.is_nan() || value.abs() > MOST_REFLECTANCE) {
        Some(value) => Err(PlanError::Colour { name: preset.name.clone(), value }),
        None => Ok(()),
    }
}

fn plan_material(
    material: &SceneMaterial,
    curves: &MaterialCurves,
    total: f64,
    has_times: bool,
    options: &PlanOptions,
) -> MaterialPlan {
    let truth = Truth::of(&material.source);
    let judgements = judge(curves, &material.angles, has_times, options);
    let chosen = judgements.iter().find(|j| j.verdict == Verdict::Chosen).map_or(Variant::Exact, |j| j.variant);
    let of = &curves.variant(chosen).unwrap_or(curves.exact()).of;
    let (name, r, h, roughness) = match &material.source {
        Source::Metal(metal) => (metal.name.clone(), metal.r(options.space), metal.h(options.space), 0.0),
        Source::Preset(preset) => {
            let Preset { name, r, h, roughness, .. } = preset.in_space(options.space);
            (name, r, h, roughness)
        }
    };
    let unseen = material.angles.is_empty().then(|| "It is not seen, so that anything will do".to_owned());
    MaterialPlan {
        name,
        metal: truth.metal().map(|metal| metal.id.clone()),
        r,
        h,
        roughness,
        share: if total > 0.0 { material.angles.total() / total } else { 0.0 },
        seen_deg: material.angles.range_deg(),
        chosen,
        parameters: (chosen != Variant::Exact).then(|| of.form.clone()),
        judgements,
        notes: truth.notes().chain(of.losses.iter().cloned()).chain(unseen).collect(),
    }
}

/// Every variant with what becomes of it, the cheapest first, see [`Target::price`], and of equally cheap ones the
/// nearest to the truth.
fn judge(curves: &MaterialCurves, angles: &Angles, has_times: bool, options: &PlanOptions) -> Vec<Judgement> {
    let tolerance = options.tolerance;
    let judgement = |curve: &VariantCurve| Judgement {
        variant: curve.of.variant,
        cost: options.costs.of(curve.of.variant),
        error: if angles.is_empty() { SeenError::NONE } else { SeenError::over(&curve.delta_e, angles) },
        verdict: Verdict::Dearer,
    };
    let price = |variant| options.target.price(variant, &options.costs, has_times);
    let priced = curves.variants.iter().map(|curve| (price(curve.of.variant), judgement(curve)));
    let mut judged: Vec<((f64, f64), Judgement)> = priced.collect();
    judged.sort_by(|((a_first, a_then), a), ((b_first, b_then), b)| {
        let errors = a.error.of(tolerance.on).total_cmp(&b.error.of(tolerance.on));
        a_first.total_cmp(b_first).then(a_then.total_cmp(b_then)).then(errors)
    });
    // The exact variant has no error, so that there is one.
    let chosen = judged.iter().position(|(_, j)| j.error.is_within(tolerance)).unwrap_or(judged.len() - 1);
    let paid = judged[chosen].0;
    for (index, (price, judgement)) in judged.iter_mut().enumerate() {
        judgement.verdict = match index {
            _ if index == chosen => Verdict::Chosen,
            _ if index < chosen => Verdict::TooFar,
            _ if *price > paid => Verdict::Dearer,
            _ if judgement.error.is_within(tolerance) => Verdict::Farther,
            _ => Verdict::TooFar,
        };
    }
    judged.into_iter().map(|(_, judgement)| judgement).collect()
}

fn savings(plans: &[MaterialPlan], curves: &SceneCurves, costs: &Costs) -> Savings {
    let mut saves = Savings::default();
    let mut ns = Saved::default();
    let mut has_ns = true;
    for (index, plan) in plans.iter().enumerate() {
        let (planned, exact) = (plan.choice().cost, costs.of(curves.get(index).exact().of.variant));
        let operations = (f64::from(planned.shader_operations), f64::from(exact.shader_operations));
        saves.shader_operations.add(plan.share, operations.0, operations.1);
        saves.parameter_bytes.add(1.0, planned.parameter_bytes as f64, exact.parameter_bytes as f64);
        match (planned.measured_ns, exact.measured_ns) {
            (Some(planned), Some(exact)) => ns.add(plan.share, planned, exact),
            _ => has_ns = false,
        }
    }
    saves.measured_ns = has_ns.then_some(ns);
    saves
}

impl Plan {
    /// What the scene saves, as a sentence.
    pub fn summary(&self) -> String {
        let of =
            |saved: Saved, unit: &str| format!("{} instead of {} {unit}", number(saved.planned), number(saved.exact));
        let Savings { shader_operations, measured_ns, parameter_bytes } = self.saves;
        let time = measured_ns.map(|ns| format!(", {}", of(ns, "ns"))).unwrap_or_default();
        let only_r = self.materials.iter().filter(|material| material.chosen.needs_only_r()).count();
        format!(
            "{}{time} for each pixel on average, and {} of parameters; {only_r} of {} materials {} no h.",
            of(shader_operations, "shader operations"),
            of(parameter_bytes, "bytes"),
            self.materials.len(),
            if only_r == 1 { "needs" } else { "need" }
        )
    }
}

/// Whole where it is large, with a decimal where it is small.
fn number(value: f64) -> String {
    let text = if value >= 100.0 { format!("{value:.0}") } else { format!("{value:.1}") };
    text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::CosTheta;
    use crate::metal::{Metal, metal_by_name, preferred_metals};
    use crate::scene::Shape;
    use crate::study::{Subject, no_progress};

    fn metal(name: &str, angles: Angles) -> SceneMaterial {
        SceneMaterial { source: Source::Metal(Arc::new(metal_by_name(name).unwrap().clone())), angles }
    }

    fn at(degrees: &[f64]) -> Angles {
        let mut angles = Angles::default();
        degrees.iter().for_each(|deg| angles.add(CosTheta::from_deg(*deg), 1.0));
        angles
    }

    fn options(delta_e: f64, on: Measure, target: Target) -> PlanOptions {
        PlanOptions { tolerance: Tolerance { delta_e, on }, target, ..PlanOptions::default() }
    }

    fn planned(material: SceneMaterial, options: &PlanOptions) -> MaterialPlan {
        plan_scene(&[material], "test", options, &no_progress).unwrap().materials.remove(0)
    }

    /// Metals that change colour before 60°, since their plasma edge lies in the visible or near it: the blue of caesium
    /// rises from .36 to .63, that of rubidium from .78 to .87 and that of titanium nitride from .15 to .22, where
    /// Schlick's curve rises to .38, .79 and .18.
    const NOT_BY_R_ALONE: [&str; 3] = ["Caesium", "Rubidium", "Titanium nitride"];

    /// What a person asks for: below 60° an edge need not be stored.
    #[test]
    fn a_material_seen_below_60_degrees_is_plain_r() {
        let card = Shape::Card { from_deg: 0.0, to_deg: 60.0 };
        let sources: Vec<Source> = preferred_metals().map(|metal| Source::Metal(Arc::new(metal.clone()))).collect();
        let each: Vec<&Source> = sources.iter().collect();
        for space in [RgbSpace::LinRec709, RgbSpace::AcesCg] {
            let curves = SceneCurves::of(&each, space, None, &no_progress).unwrap();
            let more_than_r = |shape: Shape, options: PlanOptions| {
                let on = |source: &Source| SceneMaterial { source: source.clone(), angles: shape.angles() };
                let materials: Vec<SceneMaterial> = sources.iter().map(on).collect();
                let options = PlanOptions { space, ..options };
                let plans = plan_with_curves(&materials, &curves, "test", &options).unwrap().materials;
                plans.into_iter().filter(|plan| !plan.chosen.needs_only_r()).map(|plan| plan.name).collect::<Vec<_>>()
            };
            assert_eq!(more_than_r(card, PlanOptions::default()), NOT_BY_R_ALONE, "{space}");
            let all = more_than_r(Shape::Sphere, options(0.05, Measure::Max, Target::RealTime));
            assert_eq!(all.len(), sources.len(), "a ball shows every edge");
        }
    }

    /// The noise of a clock changes nothing, however often it is looked at.
    #[test]
    fn an_offline_plan_is_the_same_whichever_of_two_equal_times_was_shorter() {
        let card = Shape::Card { from_deg: 0.0, to_deg: 60.0 }.angles();
        let chosen = |constant_ns: f64, schlick_ns: f64| {
            let ns = |variant: Variant| match variant {
                Variant::CONSTANT => constant_ns,
                Variant::SCHLICK => schlick_ns,
                other => f64::from(other.operations().slots()) * 0.03,
            };
            let costs = Costs::with_measured(Variant::ALL.into_iter().map(|v| (v, ns(v))).collect());
            let options = PlanOptions { costs, target: Target::Offline, ..PlanOptions::default() };
            planned(metal("chromium", card.clone()), &options).chosen
        };
        for [constant, schlick] in [[0.18, 0.20], [0.20, 0.18], [0.2, 0.2]] {
            assert_eq!(chosen(constant, schlick), Variant::CONSTANT);
        }
        assert_eq!(chosen(0.26, 0.2), Variant::SCHLICK, "what is slower by more than noise is dearer");
    }

    #[test]
    fn colours_that_are_no_reflectance_are_refused() {
        for value in [1e300, -11.0, f64::NAN] {
            let preset = Preset { name: "Mine".to_owned(), r: Rgb([value, 1.0, 1.0]), ..Preset::new_authored() };
            let material = SceneMaterial { source: Source::Preset(Box::new(preset)), angles: at(&[0.0]) };
            let refused = plan_scene(&[material], "", &PlanOptions::default(), &no_progress).unwrap_err().to_string();
            assert!(refused.starts_with("Mine: ") && refused.len() < 120, "{refused}");
        }
    }

    #[test]
    fn two_colours_need_no_more_than_their_model_and_a_metals_preset_has_its_truth() {
        let sphere = Shape::Sphere.angles();
        let exact = options(0.0, Measure::Max, Target::RealTime);
        let authored = SceneMaterial {
            source: Source::Preset(Box::new(Preset {
                r: Rgb([0.9, 0.6, 0.3]),
                h: Rgb([0.8, 0.6, 0.5]),
                ..Preset::new_authored()
            })),
            angles: sphere.clone(),
        };
        let plan = planned(authored, &exact);
        assert_eq!((plan.chosen, plan.metal.is_none()), (Variant::HOFFMAN, true));
        assert!(plan.notes[0].contains("own curve"), "{:?}", plan.notes);
        let gold = Preset::from_metal(metal_by_name("gold").unwrap(), RgbSpace::AcesCg);
        let plan =
            planned(SceneMaterial { source: Source::Preset(Box::new(gold.clone())), angles: sphere.clone() }, &exact);
        assert_eq!((plan.chosen, plan.metal.as_deref()), (Variant::Exact, Some("Au_Olmon-ts")));
        let edited = Preset { r: Rgb::splat(0.5), ..gold };
        let plan = planned(SceneMaterial { source: Source::Preset(Box::new(edited)), angles: sphere }, &exact);
        assert!(plan.metal.is_none() && plan.notes[0].contains("not those of"));
    }

    #[test]
    fn what_is_not_seen_costs_nothing() {
        let plan = planned(metal("gold", Angles::default()), &options(0.0, Measure::Max, Target::RealTime));
        assert_eq!((plan.chosen, plan.seen_deg, plan.share), (Variant::CONSTANT, None, 0.0));
        assert!(plan.notes.iter().any(|note| note.contains("not seen")));
    }

    #[test]
    fn nonsense_is_refused() {
        let gold = [metal("gold", at(&[0.0]))];
        for limit in [-1.0, f64::NAN, f64::INFINITY] {
            let refused = plan_scene(&gold, "", &options(limit, Measure::Max, Target::RealTime), &no_progress);
            assert!(matches!(refused, Err(PlanError::Tolerance(_))));
        }
        assert!(matches!(plan_scene(&[], "", &PlanOptions::default(), &no_progress), Err(PlanError::NoMaterial)));
        let stop = plan_scene(&gold, "", &PlanOptions::default(), &|_| ControlFlow::Break(()));
        assert!(matches!(stop, Err(PlanError::Study(_))));
    }

    #[test]
    fn the_scene_saves_what_its_materials_save() {
        let materials = [metal("gold", at(&[10.0])), metal("iron", at(&[10.0, 20.0, 30.0]))];
        let plan = plan_scene(&materials, "", &options(5.0, Measure::Max, Target::RealTime), &no_progress).unwrap();
        assert_eq!(plan.materials.iter().map(|m| m.share).collect::<Vec<_>>(), [0.25, 0.75]);
        let exact = Costs::counted().of(Variant::Exact);
        assert_eq!(plan.saves.shader_operations.exact, f64::from(exact.shader_operations));
        assert_eq!(plan.saves.parameter_bytes.exact, 2.0 * exact.parameter_bytes as f64);
        assert!(plan.saves.shader_operations.planned < 10.0 && plan.summary().contains("2 of 2 materials need no h"));
    }

    fn curves() -> &'static [MaterialCurves] {
        static CURVES: std::sync::LazyLock<Vec<MaterialCurves>> = std::sync::LazyLock::new(|| {
            let some: Vec<&Metal> = preferred_metals().step_by(4).collect();
            let of = |metal: &&Metal| {
                let subject = Subject::Metal(metal);
                MaterialCurves::of(&subject, RgbSpace::LinRec709, &mut || ControlFlow::Continue(())).unwrap()
            };
            some.par_iter().map(of).collect()
        });
        &CURVES
    }

    fn measure() -> impl Strategy<Value = Measure> {
        prop::sample::select(Measure::ALL.to_vec())
    }

    fn target() -> impl Strategy<Value = Target> {
        prop::sample::select(Target::ALL.to_vec())
    }

    fn degrees() -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec(0.0..90.0_f64, 1..30)
    }

    /// Times of any machine: many of them near each other.
    fn times() -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec(0.1..1.0_f64, Variant::ALL.len())
    }

    fn timed(ns: &[f64]) -> Costs {
        Costs::with_measured(Variant::ALL.into_iter().zip(ns.iter().copied()).collect())
    }

    fn chosen(judgements: &[Judgement]) -> &Judgement {
        judgements.iter().find(|judgement| judgement.verdict == Verdict::Chosen).unwrap()
    }

    proptest! {
        #[test]
        fn loosening_the_tolerance_never_raises_the_cost(
            metal in 0..curves().len(), degrees in degrees(), on in measure(), target in target(),
            tight in 0.0..6.0_f64, looser in 0.0..6.0_f64, ns in times(),
        ) {
            let angles = at(&degrees);
            let costs = timed(&ns);
            let price = |delta_e| {
                let options = PlanOptions { costs: costs.clone(), ..options(delta_e, on, target) };
                let judgements = judge(&curves()[metal], &angles, true, &options);
                target.price(chosen(&judgements).variant, &options.costs, true)
            };
            prop_assert!(price(tight + looser) <= price(tight));
        }

        #[test]
        fn the_plan_never_exceeds_its_tolerance(
            metal in 0..curves().len(), degrees in degrees(), on in measure(), target in target(), delta_e in 0.0..6.0_f64,
        ) {
            let options = options(delta_e, on, target);
            let judgements = judge(&curves()[metal], &at(&degrees), false, &options);
            prop_assert!(chosen(&judgements).error.of(on) <= delta_e);
        }

        #[test]
        fn adding_angles_never_lowers_the_largest_error_of_a_variant_nor_the_cost(
            metal in 0..curves().len(), degrees in degrees(), more in degrees(), target in target(), delta_e in 0.0..6.0_f64,
            ns in times(),
        ) {
            let options = PlanOptions { costs: timed(&ns), ..options(delta_e, Measure::Max, target) };
            let judged = |degrees: &[f64]| judge(&curves()[metal], &at(degrees), true, &options);
            let (few, many) = (judged(&degrees), judged(&[degrees.clone(), more].concat()));
            for judgement in &few {
                let same = many.iter().find(|other| other.variant == judgement.variant).unwrap();
                prop_assert!(same.error.max_delta_e >= judgement.error.max_delta_e);
            }
            let price = |judgements: &[Judgement]| target.price(chosen(judgements).variant, &options.costs, true);
            prop_assert!(price(&many) >= price(&few));
        }

        /// The bound holds at the angles themselves, not only at the nodes that stand for them.
        #[test]
        fn the_bound_holds_between_the_nodes(metal in 0..curves().len(), degrees in degrees(), delta_e in 0.05..6.0_f64) {
            let name = &preferred_metals().step_by(4).nth(metal).unwrap().id;
            let options = options(delta_e, Measure::Max, Target::RealTime);
            let judgements = judge(&curves()[metal], &at(&degrees), false, &options);
            let variant = chosen(&judgements).variant;
            let form = &curves()[metal].variants.iter().find(|curve| curve.of.variant == variant).unwrap().of.form;
            let subject = Subject::Metal(metal_by_name(name).unwrap());
            for deg in degrees {
                let c = CosTheta::from_deg(deg);
                let truth = crate::study::true_reflectance(&subject, c, options.space);
                let off = crate::color::delta_e_rgb(form.reflectance(c), truth, options.space);
                prop_assert!(off <= delta_e + 0.01, "{name} {variant} {deg}: {off}");
            }
        }
    }
}
