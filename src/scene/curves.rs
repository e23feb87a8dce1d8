//! A material in every variant, with its error at every angle: what every scene's plan for it is made from.

use std::ops::ControlFlow;

use super::{NODES, node_cosines};
use crate::color::{Lab, RgbSpace, delta_e_2000};
use crate::study::{FormOfVariant, StudyError, Subject, Variant, forms, true_reflectance};

/// A material as a plan needs it: independent of the scene, so that it is computed once.
#[derive(Clone, Debug)]
pub struct MaterialCurves {
    /// The space of every parameter and difference.
    pub space: RgbSpace,
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
        let truth = node_cosines().map(|c| Lab::from_rgb(true_reflectance(subject, c, space), space));
        let variants = Variant::of(subject);
        let curve = |of: FormOfVariant| {
            let difference = |node: usize| {
                let shown = of.form.reflectance(node_cosines()[node]);
                delta_e_2000(Lab::from_rgb(shown, space), truth[node])
            };
            // The last is the truth, not only to rounding.
            let is_exact = variants.last() == Some(&of.variant);
            let delta_e = if is_exact { [0.0; NODES] } else { std::array::from_fn(difference) };
            VariantCurve { of, delta_e: Box::new(delta_e) }
        };
        let forms = forms(subject, variants, space, keep_going)?;
        Ok(Self { space, variants: forms.into_iter().map(curve).collect() })
    }

    /// The variant that is the truth.
    pub fn exact(&self) -> &VariantCurve {
        self.variants.last().expect("every subject has an exact variant")
    }
}
