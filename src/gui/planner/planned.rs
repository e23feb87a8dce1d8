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
    Angles, MaterialCurves, MaterialPlan, NODES, NotPlannable, Place, Plan, PlanOptions, SavedMaterial, SavedPlan,
    SavedScene, SceneCurves, SceneMaterial, Source, Target, Tolerance, plan_with_curves,
};
use crate::study::{Costs, Variant, no_progress};

/// The materials of the list, in a space.
#[derive(Clone, PartialEq)]
pub(super) struct ListAsked {
    /// What tells them apart.
    pub entries: Vec<u64>,
    /// As they are read.
    pub materials: Vec<Resolved>,
    /// The files that they were read from.
    pub files: Vec<Option<String>>,
    pub space: RgbSpace,
}

/// The materials of the list in every variant.
pub(crate) struct ListCurves {
    /// The entries, in the order of the curves.
    pub entries: Vec<u64>,
    sources: Vec<Source>,
    files: Vec<Option<String>>,
    curves: SceneCurves,
}

impl ListCurves {
    pub(super) fn of(asked: ListAsked, known: Option<&Self>, progress: &Progress) -> Told<Arc<Self>> {
        let ListAsked { entries, materials, files, space } = asked;
        let sources: Vec<Source> = materials.iter().map(Resolved::source).collect();
        let each: Vec<&Source> = sources.iter().collect();
        let curves = SceneCurves::of(&each, space, known.map(|known| &known.curves), &|share| progress.report(share));
        let curves = curves.map_err(|error| error.to_string())?;
        Ok(Arc::new(Self { entries, sources, files, curves }))
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
    /// The entries, in the order of its materials; empty for a plan of a file that cannot be changed.
    pub entries: Vec<u64>,
    /// One for each material.
    pub looks: Vec<Look>,
    /// The errors of every variant at every angle.
    pub curves: Arc<ListCurves>,
    /// The angles; of an old file nobody knows them.
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
        let plan = Plan { notes: seen.warnings.clone(), ..plan.map_err(|error| error.to_string())? };
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
    pub(super) fn of_file(saved: SavedPlan, entries: Vec<u64>) -> Told<Self> {
        let SavedPlan { plan, scene } = saved;
        let space = plan.space;
        let preset = |material: &MaterialPlan| Source::Preset(Box::new(material.preset(space)));
        let (sources, files, seen) = match scene {
            Ok(scene) => taken_apart(scene, &plan, &entries),
            Err(_) => (plan.materials.iter().map(preset).collect(), vec![None; plan.materials.len()], None),
        };
        let each: Vec<&Source> = sources.iter().collect();
        let curves = SceneCurves::of(&each, space, None, &no_progress).map_err(|error| error.to_string())?;
        let curves = Arc::new(ListCurves { entries: entries.clone(), sources, files, curves });
        let look = |(index, material): (usize, &MaterialPlan)| {
            let look = Look::of(material, curves.get(index), space);
            let is_known =
                seen.is_some() || material.metal.as_ref().is_none_or(|id| metals().iter().any(|m| m.id == *id));
            Look { truth: look.truth.filter(|_| is_known), ..look }
        };
        let looks = plan.materials.iter().enumerate().map(look).collect();
        Ok(Self { plan, entries, looks, curves, seen })
    }

    /// The plan as a file keeps it.
    pub(super) fn saved(&self) -> SavedPlan {
        let ListCurves { sources, files, .. } = &*self.curves;
        let scene = self.seen.as_ref().map(|seen| {
            let each = sources.iter().zip(files).zip(seen.places.iter().zip(&seen.angles));
            let material = |((source, file), (place, angles)): ((&Source, &Option<String>), (&Place, &Angles))| {
                let (source, file) = (source.clone(), file.clone());
                SavedMaterial { source, file, place: place.clone(), angles: angles.clone() }
            };
            SavedScene { materials: each.map(material).collect(), pass: seen.pass.clone() }
        });
        SavedPlan { plan: self.plan.clone(), scene: scene.ok_or(NotPlannable::Nothing) }
    }
}

type Parts = (Vec<Source>, Vec<Option<String>>, Option<Arc<SeenScene>>);

/// The scene of a file as what is computed from it here.
fn taken_apart(scene: SavedScene, plan: &Plan, entries: &[u64]) -> Parts {
    let mut seen = SeenScene {
        entries: entries.to_vec(),
        angles: Vec::new(),
        places: Vec::new(),
        pass: scene.pass,
        scene: plan.scene.clone(),
        warnings: Vec::new(),
    };
    let (mut sources, mut files) = (Vec::new(), Vec::new());
    for SavedMaterial { source, file, place, angles } in scene.materials {
        sources.push(source);
        files.push(file);
        seen.places.push(place);
        seen.angles.push(angles);
    }
    (sources, files, Some(seen.into()))
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
