//! The materials of a plan as files of other programs, without what the scene does not need.

use thiserror::Error;

use super::{MaterialPlan, Plan};
use crate::export::{ExportError, Kept, Options, Target, export_kept, file_stems};
use crate::fresnel::ModelKind;
use crate::preset::Preset;
use crate::study::Variant;

/// A file of one material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedFile {
    /// Whose file it is.
    pub target: Target,
    /// Its usual name.
    pub name: String,
    /// What it holds.
    pub bytes: Vec<u8>,
    /// What it says of the material: at most what was chosen, where the target can say that.
    pub variant: Variant,
}

/// The files of a plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PlanExport {
    /// Target by target, in the order of the materials.
    pub files: Vec<PlannedFile>,
    /// Sentences about what the files do not say.
    pub losses: Vec<String>,
}

/// Why there are no files.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum PlanExportError {
    #[error("{0} is a palette, which holds no curve that a plan could shorten")]
    Palette(Target),
    #[error(transparent)]
    Export(#[from] ExportError),
}

impl Plan {
    /// The files of the materials whose place `is_wanted`; their names do not depend on which those are.
    pub fn export(
        &self,
        targets: &[Target],
        options: &Options,
        is_wanted: impl Fn(usize) -> bool,
    ) -> Result<PlanExport, PlanExportError> {
        if let Some(palette) = targets.iter().find(|target| target.is_palette()) {
            return Err(PlanExportError::Palette(*palette));
        }
        let presets: Vec<Preset> = self.materials.iter().map(|material| material.preset(self.space)).collect();
        let stems = file_stems(&presets);
        let mut made = PlanExport::default();
        for &target in targets {
            let materials = self.materials.iter().zip(&presets).zip(&stems).enumerate();
            for (_, ((material, preset), stem)) in materials.filter(|(place, _)| is_wanted(*place)) {
                let (kept, variant) = self.kept(material, target, &mut made.losses);
                let exported = export_kept(stem, preset, target, options, kept)?;
                made.losses.extend(exported.losses.iter().map(|loss| format!("{target}: {loss}")));
                let files = exported.files.into_iter();
                made.files.extend(files.map(|f| PlannedFile { target, name: f.name, bytes: f.bytes, variant }));
            }
        }
        Ok(made)
    }

    /// The least that the target can say and that stays within the tolerance; where nothing does, r and h, and that is
    /// said.
    fn kept(&self, material: &MaterialPlan, target: Target, losses: &mut Vec<String>) -> (Kept, Variant) {
        let said = |variant: Variant| match variant {
            Variant::Model(ModelKind::Constant, _) => Some(Kept::Constant),
            Variant::Model(ModelKind::Schlick, _) => Some(Kept::Schlick),
            Variant::HOFFMAN => Some(Kept::Whole),
            _ => None,
        };
        let within = material.judgements.iter().filter(|j| j.error.is_within(self.tolerance));
        let mut candidates = within.filter_map(|j| said(j.variant).map(|kept| (kept, j.variant)));
        if let Some(found) = candidates.find(|(kept, _)| target.can_keep(*kept)) {
            return found;
        }
        if let Some(hoffman) = material.judgements.iter().find(|j| j.variant == Variant::HOFFMAN) {
            let measure = self.tolerance.on;
            losses.push(format!(
                "{target}: {}: the plan wants {}, which this target does not take; with r and h the {} is {:.2}, above {}",
                material.name,
                material.chosen,
                measure.label(),
                hoffman.error.of(measure),
                self.tolerance.delta_e
            ));
        }
        (Kept::Whole, Variant::HOFFMAN)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::metal::metal_by_name;
    use crate::scene::{PlanOptions, SceneMaterial, Shape, Source, Tolerance, plan_scene};
    use crate::study::{Measure, no_progress};

    fn plan() -> Plan {
        let on = |name, shape: Shape| SceneMaterial {
            source: Source::Metal(Arc::new(metal_by_name(name).unwrap().clone())),
            angles: shape.angles(),
        };
        let materials = [
            on("gold", Shape::Card { from_deg: 0.0, to_deg: 60.0 }),
            on("iron", Shape::Sphere),
            on("zinc", Shape::Sphere),
        ];
        let tolerance = Tolerance { delta_e: 1.0, on: Measure::Max };
        plan_scene(&materials, "", &PlanOptions { tolerance, ..PlanOptions::default() }, &no_progress).unwrap()
    }

    #[test]
    fn files_say_no_more_than_the_scene_requires_and_what_they_cannot_is_a_loss() {
        let made = plan().export(&[Target::Glsl], &Options::default(), |_| true).unwrap();
        let variants: Vec<Variant> = made.files.iter().map(|file| file.variant).collect();
        assert_eq!(variants, [Variant::SCHLICK, Variant::HOFFMAN, Variant::HOFFMAN]);
        let zinc = made.losses.iter().filter(|loss| loss.contains("Zinc: the plan wants table-32")).count();
        assert_eq!(zinc, 1, "{:?}", made.losses);
    }

    #[test]
    fn one_of_them_has_the_same_name_as_among_all() {
        let (plan, options) = (plan(), Options::default());
        let all = plan.export(&[Target::Glsl, Target::Csv], &options, |_| true).unwrap();
        let second = plan.export(&[Target::Glsl, Target::Csv], &options, |place| place == 1).unwrap();
        assert_eq!(second.files.iter().collect::<Vec<_>>(), [&all.files[1], &all.files[4]]);
        let palette = Target::ALL.into_iter().find(|target| target.is_palette()).unwrap();
        assert!(matches!(plan.export(&[palette], &options, |_| true), Err(PlanExportError::Palette(_))));
    }
}
