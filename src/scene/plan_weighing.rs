//! How far from the truth is what a file says of a material, at the angles at which the plan's scene sees it?

use std::ops::ControlFlow;

use super::material::{SceneMaterial, Truth};
use super::{Angles, MaterialPlan, NODES, Plan, SeenError, node_cosines};
use crate::color::{Rgb, RgbSpace, delta_e_rgb};
use crate::export::{Reading, form_in_space};
use crate::fresnel::{CosTheta, FresnelModel, ModelKind};
use crate::metal::metals;
use crate::number::larger;
use crate::study::{Form, Measure, Subject, Variant, forms, true_reflectance};

/// Nine digits, single precision and 4096 rows of a table change a curve by less, which nobody tells as a loss.
const OF_WRITING: f64 = 1e-3;

/// A material of a plan with its truth and its angles, as far as they are known.
pub(super) struct Scales<'a> {
    plan: &'a Plan,
    material: &'a MaterialPlan,
    /// `None` for a metal that is neither in the library nor at hand.
    subject: Option<Subject<'a>>,
    angles: Angles,
    /// False where only the range of the angles is known.
    is_counted: bool,
    /// The truth at the nodes that are seen, for each space that was asked for.
    truths: Vec<(RgbSpace, Vec<(usize, Rgb)>)>,
}

impl<'a> Scales<'a> {
    /// `scene` is the material as it was planned for, where that is at hand.
    pub(super) fn of(plan: &'a Plan, material: &'a MaterialPlan, scene: Option<&'a SceneMaterial>) -> Self {
        let (subject, angles) = match scene {
            Some(scene) => (Some(Truth::of(&scene.source).subject), scene.angles.clone()),
            None => (subject(plan, material), angles_of_range(material.seen_deg)),
        };
        Self { plan, material, subject, angles, is_counted: scene.is_some(), truths: Vec::new() }
    }

    /// The variants in the order in which a target should try them: what was chosen, then the others, the cheapest
    /// first. A file of samples has the same size whatever it samples: the truth, where it is known.
    pub(super) fn candidates(&self, is_sampled: bool) -> Vec<Variant> {
        let exact = self.subject.as_ref().and_then(|subject| Variant::of(subject).last());
        let first = [exact.copied().filter(|_| is_sampled), Some(self.material.chosen)];
        let others = self.material.judgements.iter().map(|judgement| judgement.variant);
        let mut candidates: Vec<Variant> = Vec::new();
        for variant in first.into_iter().flatten().chain(others).chain([Variant::HOFFMAN]) {
            if !candidates.contains(&variant) {
                candidates.push(variant);
            }
        }
        candidates
    }

    /// The parameters of a variant in a space: the plan's own, or those of the material, where they can be known.
    pub(super) fn form(&self, variant: Variant, space: RgbSpace) -> Option<Form> {
        let MaterialPlan { chosen, parameters, r, h, .. } = self.material;
        let own = parameters.as_ref().filter(|_| variant == *chosen);
        if let Some(form) = own.and_then(|form| form_in_space(form, self.plan.space, space)) {
            return Some(form);
        }
        let [r, h] = [r, h].map(|rgb| self.plan.space.convert(*rgb, space));
        match variant {
            Variant::CONSTANT => Some(Form::Model { model: FresnelModel::Constant { r } }),
            Variant::SCHLICK => Some(Form::Model { model: FresnelModel::Schlick { r } }),
            Variant::HOFFMAN => Some(Form::Model { model: FresnelModel::Hoffman { r, h } }),
            _ => {
                let made = forms(self.subject.as_ref()?, &[variant], space, &mut || ControlFlow::Continue(()));
                made.ok()?.pop().map(|of| of.form)
            }
        }
    }

    /// The number that the plan bounds, of what is read from a file that says a form of a variant, in `space`; of a file
    /// for several spaces the largest. Infinite where it is no number.
    ///
    /// Where the truth or the share of each angle is not known, it is what the plan found for the variant and the largest
    /// that the file adds to it.
    pub(super) fn error(&mut self, readings: &[Reading], variant: Variant, form: &Form, space: RgbSpace) -> f64 {
        if self.angles.is_empty() {
            return 0.0;
        }
        let on = self.plan.tolerance.on;
        let error = if self.is_exact() {
            readings.iter().map(|reading| self.seen_error(reading).of(on)).fold(0.0, larger)
        } else {
            let judged = self.material.judgements.iter().find(|judgement| judgement.variant == variant);
            let added = readings.iter().map(|reading| self.largest_added(reading, form, space)).fold(0.0, larger);
            judged.map_or(f64::NAN, |judgement| judgement.error.of(on)) + added
        };
        if error.is_nan() { f64::INFINITY } else { error }
    }

    /// True within the plan's bound, but for the digits of files.
    pub(super) fn is_within(&self, error: f64) -> bool {
        error <= self.plan.tolerance.delta_e + OF_WRITING
    }

    /// False where [`error`](Self::error) is only what it is at most.
    pub(super) fn is_exact(&self) -> bool {
        self.subject.is_some() && (self.is_counted || self.plan.tolerance.on == Measure::Max)
    }

    fn seen_error(&mut self, reading: &Reading) -> SeenError {
        let mut delta_e = [0.0; NODES];
        for (node, truth) in self.truth(reading.space) {
            delta_e[*node] = delta_e_rgb(reading.reflectance(node_cosines()[*node]), *truth, reading.space);
        }
        SeenError::over(&delta_e, &self.angles)
    }

    fn truth(&mut self, space: RgbSpace) -> &[(usize, Rgb)] {
        let known = self.truths.iter().position(|(known, _)| *known == space);
        let place = known.unwrap_or_else(|| {
            let at = |node: usize| {
                let truth = |subject| true_reflectance(subject, node_cosines()[node], space);
                self.subject.as_ref().map_or(Rgb::splat(f64::NAN), truth)
            };
            let truth = self.angles.seen().map(|(node, _)| (node, at(node))).collect();
            self.truths.push((space, truth));
            self.truths.len() - 1
        });
        &self.truths[place].1
    }

    /// How far what is read is from the form that was to be said.
    fn largest_added(&self, reading: &Reading, form: &Form, space: RgbSpace) -> f64 {
        let Some(wanted) = form_in_space(form, space, reading.space) else { return f64::NAN };
        let difference = |(node, _): (usize, f64)| {
            let cos_theta = node_cosines()[node];
            delta_e_rgb(reading.reflectance(cos_theta), wanted.reflectance(cos_theta), reading.space)
        };
        self.angles.seen().map(difference).fold(0.0, larger)
    }
}

/// The model of a variant; `None` for series, tables and wavelengths.
pub(super) const fn model_of(variant: Variant) -> Option<ModelKind> {
    if let Variant::Model(kind, _) = variant { Some(kind) } else { None }
}

/// What the plan's file says that the truth is.
fn subject<'a>(plan: &Plan, material: &'a MaterialPlan) -> Option<Subject<'a>> {
    match &material.metal {
        Some(id) => metals().iter().find(|metal| metal.id == *id).map(Subject::Metal),
        None => {
            let MaterialPlan { name, r, h, .. } = material;
            Some(Subject::Colours { name, space: plan.space, r: *r, h: *h })
        }
    }
}

/// Every node of a range alike, and its ends, which lie between nodes.
fn angles_of_range(range_deg: Option<(f64, f64)>) -> Angles {
    let mut angles = Angles::default();
    let Some((from_deg, to_deg)) = range_deg else { return angles };
    let is_seen = |deg: f64| from_deg - 1e-9 <= deg && deg <= to_deg + 1e-9;
    node_cosines().iter().filter(|cosine| is_seen(cosine.deg())).for_each(|cosine| angles.add(*cosine, 1.0));
    [from_deg, to_deg].into_iter().for_each(|end| angles.add(CosTheta::from_deg(end), 1.0));
    angles
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Shape;

    #[test]
    fn a_range_has_the_nodes_that_were_seen() {
        for shape in [Shape::Sphere, Shape::Card { from_deg: 0.0, to_deg: 60.0 }] {
            let angles = shape.angles();
            assert_eq!(angles_of_range(angles.range_deg()).range_deg(), angles.range_deg(), "{shape}");
        }
        assert!(angles_of_range(None).is_empty());
    }
}
