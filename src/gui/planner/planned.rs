//! A plan with what is drawn of it.

use std::sync::Arc;

use super::Same;
use super::material::Resolved;
use super::seeing::SeenScene;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::CosTheta;
use crate::gui::demonstrations::{Band, Told};
use crate::gui::job::Progress;
use crate::metal::metals;
use crate::scene::{
    Angles, MaterialCurves, MaterialPlan, NODES, Plan, PlanOptions, SceneCurves, SceneMaterial, Source, Target,
    Tolerance, plan_with_curves,
};
use crate::study::{Costs, Variant, no_progress};

/// The materials of the list in every variant.
pub(crate) struct ListCurves {
    /// The entries, in the order of the curves.
    pub entries: Vec<u64>,
    sources: Vec<Source>,
    curves: SceneCurves,
}

impl ListCurves {
    pub(super) fn of(
        entries: Vec<u64>,
        materials: &[Resolved],
        space: RgbSpace,
        known: Option<&Self>,
        progress: &Progress,
    ) -> Told<Arc<Self>> {
        let sources: Vec<Source> = materials.iter().map(Resolved::source).collect();
        let each: Vec<&Source> = sources.iter().collect();
        let curves = SceneCurves::of(&each, space, known.map(|known| &known.curves), &|share| progress.report(share));
        let curves = curves.map_err(|error| error.to_string())?;
        Ok(Arc::new(Self { entries, sources, curves }))
    }

    /// The curves of a material.
    pub(crate) fn get(&self, material: usize) -> &MaterialCurves {
        self.curves.get(material)
    }
}

/// What a plan depends on.
#[derive(Clone, PartialEq)]
pub(super) struct PlanAsked {
    pub curves: Same<ListCurves>,
    pub seen: Same<SeenScene>,
    pub tolerance: Tolerance,
    pub target: Target,
    pub costs: Costs,
}

/// A plan, and the colours it leads to.
pub(crate) struct Planned {
    /// The plan.
    pub plan: Plan,
    /// The entries, in the order of its materials; empty for a plan of a file.
    pub entries: Vec<u64>,
    /// One for each material.
    pub looks: Vec<Look>,
    /// The errors of every variant at every angle.
    pub curves: Arc<ListCurves>,
    /// The angles; of a plan of a file nobody knows them.
    pub seen: Option<Arc<SeenScene>>,
}

fn scene_of(curves: &ListCurves, seen: &SeenScene) -> Vec<SceneMaterial> {
    let pairs = curves.sources.iter().zip(&seen.angles);
    let material =
        |(source, angles): (&Source, &Angles)| SceneMaterial { source: source.clone(), angles: angles.clone() };
    pairs.map(material).collect()
}

/// A material over 0–90°.
pub(crate) struct Look {
    /// Its truth; `None` where it is a metal that this window does not have.
    pub truth: Option<Band>,
    /// What was chosen for it.
    pub chosen: Option<Band>,
}

impl Planned {
    pub(super) fn of(asked: &PlanAsked) -> Told<Arc<Self>> {
        let PlanAsked { curves: Same(curves), seen: Same(seen), tolerance, target, costs } = asked;
        let materials = scene_of(curves, seen);
        let space = curves.curves.space();
        let options = PlanOptions { space, tolerance: *tolerance, target: *target, costs: costs.clone() };
        let plan = plan_with_curves(&materials, &curves.curves, &seen.scene, &options);
        let plan = plan.map_err(|error| error.to_string())?;
        let looks =
            plan.materials.iter().enumerate().map(|(index, material)| Look::of(material, curves.get(index), space));
        Ok(Arc::new(Self {
            looks: looks.collect(),
            plan,
            entries: seen.entries.clone(),
            curves: curves.clone(),
            seen: Some(seen.clone()),
        }))
    }

    /// What was planned for; of a plan of a file nobody knows it.
    pub(super) fn scene(&self) -> Option<Vec<SceneMaterial>> {
        self.seen.as_deref().map(|seen| scene_of(&self.curves, seen))
    }

    /// A plan of a file: what it says stays as it was saved; the curves are those of its materials today.
    pub(super) fn of_file(plan: Plan) -> Told<Arc<Self>> {
        let space = plan.space;
        let source = |material: &MaterialPlan| Source::Preset(Box::new(material.preset(space)));
        let sources: Vec<Source> = plan.materials.iter().map(source).collect();
        let each: Vec<&Source> = sources.iter().collect();
        let curves = SceneCurves::of(&each, space, None, &no_progress).map_err(|error| error.to_string())?;
        let curves = Arc::new(ListCurves { entries: Vec::new(), sources, curves });
        let look = |(index, material): (usize, &MaterialPlan)| {
            let look = Look::of(material, curves.get(index), space);
            let is_known = material.metal.as_ref().is_none_or(|id| metals().iter().any(|metal| metal.id == *id));
            Look { truth: look.truth.filter(|_| is_known), ..look }
        };
        let looks = plan.materials.iter().enumerate().map(look).collect();
        Ok(Arc::new(Self { plan, entries: Vec::new(), looks, curves, seen: None }))
    }
}

/// Colours in each band: one for every two degrees.
const STEPS: u8 = 45;

impl Look {
    fn of(material: &MaterialPlan, curves: &MaterialCurves, space: RgbSpace) -> Self {
        let cosines = || (0..=STEPS).map(|step| CosTheta::from_deg(90.0 * f64::from(step) / f64::from(STEPS)));
        let truth = |c: CosTheta| at_node(&curves.truth, c);
        let chosen = match (&material.parameters, material.chosen) {
            (Some(form), _) => Some(Band::of(cosines().map(|c| form.reflectance(c)), space)),
            (None, Variant::Exact) => Some(Band::of(cosines().map(truth), space)),
            (None, _) => None,
        };
        Self { truth: Some(Band::of(cosines().map(truth), space)), chosen }
    }
}

/// Between the nodes, which are even steps of √c.
fn at_node(values: &[Rgb; NODES], cos_theta: CosTheta) -> Rgb {
    let place = cos_theta.get().sqrt() * (NODES - 1) as f64;
    let below = (place.floor() as usize).min(NODES - 2);
    values[below].lerp(values[below + 1], place - below as f64)
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;
    use crate::metal::metal_by_name;
    use crate::study::Subject;

    /// The strip shows the metal: between nodes its curve is nearly straight.
    #[test]
    fn the_truth_between_nodes_is_the_metals() {
        let zinc = metal_by_name("zinc").unwrap();
        let curves =
            MaterialCurves::of(&Subject::Metal(zinc), RgbSpace::AcesCg, &mut || ControlFlow::Continue(())).unwrap();
        for deg in [0.0, 33.3, 71.7, 86.1, 90.0] {
            let c = CosTheta::from_deg(deg);
            let off = at_node(&curves.truth, c).max_abs_difference(zinc.reflectance(c, RgbSpace::AcesCg));
            assert!(off < 5e-4, "{deg}: {off}");
        }
    }
}
