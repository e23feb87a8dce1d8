//! A material in every variant, with its error at every angle: what every scene's plan for it is made from.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::material::{Source, Truth};
use super::{NODES, node_cosines};
use crate::color::{Lab, Rgb, RgbSpace, delta_e_2000};
use crate::metal::Metal;
use crate::study::{Form, FormOfVariant, StudyError, Subject, Variant, forms, true_reflectance};

/// A material as a plan needs it: independent of the scene, so that it is computed once.
#[derive(Clone, Debug)]
pub struct MaterialCurves {
    /// The space of every parameter and difference.
    pub space: RgbSpace,
    /// The true reflectance at each node of [`Angles`](super::Angles).
    pub truth: Box<[Rgb; NODES]>,
    /// One for each variant, the exact one last.
    pub variants: Vec<VariantCurve>,
}

/// One variant of a material.
#[derive(Clone, Debug)]
pub struct VariantCurve {
    /// The variant with its parameters.
    pub of: FormOfVariant,
    /// CIEDE2000 to the truth at each node of [`Angles`](super::Angles).
    pub delta_e: Box<[f64; NODES]>,
}

impl MaterialCurves {
    /// Fits and measures every variant. `keep_going` is asked before each.
    ///
    /// Parameters do not depend on the scene: a scene that sees more angles never has a smaller largest error.
    pub fn of(
        subject: &Subject<'_>,
        space: RgbSpace,
        keep_going: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Self, StudyError> {
        let truth = node_cosines().map(|c| true_reflectance(subject, c, space));
        let lab = truth.map(|rgb| Lab::from_rgb(rgb, space));
        let variants = Variant::of(subject);
        let curve = |of: FormOfVariant| {
            // The last is the truth, not only to rounding.
            let is_exact = variants.last() == Some(&of.variant);
            let delta_e = if is_exact { [0.0; NODES] } else { differences(&of.form, &lab, space) };
            VariantCurve { of, delta_e: Box::new(delta_e) }
        };
        let forms = forms(subject, variants, space, keep_going)?;
        Ok(Self { space, truth: Box::new(truth), variants: forms.into_iter().map(curve).collect() })
    }

    /// The variant that is the truth.
    pub fn exact(&self) -> &VariantCurve {
        self.variants.last().expect("every subject has an exact variant")
    }

    /// One of the variants.
    pub fn variant(&self, variant: Variant) -> Option<&VariantCurve> {
        self.variants.iter().find(|curve| curve.of.variant == variant)
    }
}

/// CIEDE2000 of a form to the truth at each node.
fn differences(form: &Form, truth: &[Lab; NODES], space: RgbSpace) -> [f64; NODES] {
    let shown = form.curve(node_cosines());
    std::array::from_fn(|node| delta_e_2000(Lab::from_rgb(shown[node], space), truth[node]))
}

/// The curves of every material of a scene. A metal is fitted once, however often it occurs.
#[derive(Clone, Debug)]
pub struct SceneCurves {
    space: RgbSpace,
    distinct: Vec<Distinct>,
    /// Which of them each material has.
    index: Vec<usize>,
}

/// The curves of one truth.
#[derive(Clone, Debug)]
struct Distinct {
    /// `None` where two colours are their own truth.
    metal: Option<Metal>,
    curves: Arc<MaterialCurves>,
}

impl SceneCurves {
    /// The curves of materials, in their order. `progress` hears the share done, from any thread, and stops the work by
    /// breaking. Metals that are known in the same space are not fitted again.
    pub fn of(
        sources: &[&Source],
        space: RgbSpace,
        known: Option<&Self>,
        progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
    ) -> Result<Self, StudyError> {
        let truths: Vec<Truth> = sources.iter().map(|source| Truth::of(source)).collect();
        let (different, index) = different(&truths);
        let done = AtomicUsize::new(0);
        let curves_of = |truth: &&Truth| -> Result<Distinct, StudyError> {
            let share = || done.load(Ordering::Relaxed) as f32 / different.len() as f32;
            let found = known.filter(|known| known.space == space).and_then(|known| known.find(truth.metal()?));
            let curves = match found {
                Some(curves) => curves,
                None => Arc::new(MaterialCurves::of(&truth.subject, space, &mut || progress(share()))?),
            };
            done.fetch_add(1, Ordering::Relaxed);
            Ok(Distinct { metal: truth.metal().cloned(), curves })
        };
        let distinct: Result<Vec<Distinct>, StudyError> = different.par_iter().map(curves_of).collect();
        Ok(Self { space, distinct: distinct?, index })
    }

    /// The space of every parameter and difference.
    pub const fn space(&self) -> RgbSpace {
        self.space
    }

    /// Number of materials.
    pub fn len(&self) -> usize {
        self.index.len()
    }

    /// True of a scene without materials.
    pub fn is_empty(&self) -> bool {
        self.index.is_empty()
    }

    /// The curves of a material, by its place in the order given.
    ///
    /// # Panics
    /// Where there are fewer materials.
    pub fn get(&self, material: usize) -> &MaterialCurves {
        &self.distinct[self.index[material]].curves
    }

    fn find(&self, metal: &Metal) -> Option<Arc<MaterialCurves>> {
        let is_same = |distinct: &&Distinct| distinct.metal.as_ref().is_some_and(|known| is_same_metal(known, metal));
        self.distinct.iter().find(is_same).map(|distinct| distinct.curves.clone())
    }
}

fn is_same_metal(a: &Metal, b: &Metal) -> bool {
    std::ptr::eq(a, b) || (a.id == b.id && a.table() == b.table())
}

/// The truths that differ, and which of them each is.
fn different<'a, 'b>(truths: &'b [Truth<'a>]) -> (Vec<&'b Truth<'a>>, Vec<usize>) {
    let mut metals: Vec<(&Metal, usize)> = Vec::new();
    let mut different: Vec<&Truth<'a>> = Vec::new();
    let index = truths.iter().map(|truth| {
        if let Some(metal) = truth.metal() {
            if let Some((_, known)) = metals.iter().find(|(known, _)| is_same_metal(known, metal)) {
                return *known;
            }
            metals.push((metal, different.len()));
        }
        different.push(truth);
        different.len() - 1
    });
    let index = index.collect();
    (different, index)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;
    use crate::preset::Preset;
    use crate::study::no_progress;

    fn source(name: &str) -> Source {
        Source::Metal(Arc::new(metal_by_name(name).unwrap().clone()))
    }

    #[test]
    fn a_metal_is_fitted_once_and_never_again_in_the_same_space() {
        let mine = Source::Preset(Box::new(Preset::new_authored()));
        let sources = [source("gold"), mine, source("silver"), source("gold")];
        let of = |sources: &[&Source], space, known| SceneCurves::of(sources, space, known, &no_progress).unwrap();
        let all: Vec<&Source> = sources.iter().collect();
        let first = of(&all, RgbSpace::AcesCg, None);
        assert_eq!((first.len(), first.distinct.len(), first.index.as_slice()), (4, 3, [0, 1, 2, 0].as_slice()));
        let again = of(&all[2..], RgbSpace::AcesCg, Some(&first));
        assert!(Arc::ptr_eq(&again.distinct[0].curves, &first.distinct[2].curves));
        assert!(Arc::ptr_eq(&again.distinct[1].curves, &first.distinct[0].curves));
        let elsewhere = of(&all[2..], RgbSpace::LinRec709, Some(&first));
        assert_eq!(elsewhere.get(0).space, RgbSpace::LinRec709);
    }
}
