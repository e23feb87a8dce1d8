//! The materials of a plan as files of other programs, without what the scene does not need.

use rayon::prelude::*;
use thiserror::Error;

use super::plan_weighing::{Scales, model_of};
use super::{MaterialPlan, Plan, SceneMaterial};
use crate::export::{ExportError, Options, Target, export_form, file_stems, readings};
use crate::preset::Preset;
use crate::study::{Form, Variant};

/// A file of one material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedFile {
    /// Whose file it is.
    pub target: Target,
    /// Its usual name.
    pub name: String,
    /// What it holds.
    pub bytes: Vec<u8>,
    /// What it says of the material: what was chosen, where the target takes it, or better.
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

/// What a file is to say.
struct Said {
    variant: Variant,
    form: Form,
    /// The number that the plan bounds, of what will be read from the file.
    error: f64,
}

impl Plan {
    /// The files of the materials whose place `is_wanted`; their names do not depend on which those are.
    ///
    /// They say the plan's own parameters where a target takes them. `scene` is what was planned for, by which every file
    /// is weighed; without it a metal is that of the library, and only the range of its angles is known.
    ///
    /// # Panics
    /// If the scene has another number of materials.
    pub fn export(
        &self,
        scene: Option<&[SceneMaterial]>,
        targets: &[Target],
        options: &Options,
        is_wanted: impl Fn(usize) -> bool,
    ) -> Result<PlanExport, PlanExportError> {
        if let Some(palette) = targets.iter().find(|target| target.is_palette()) {
            return Err(PlanExportError::Palette(*palette));
        }
        assert!(scene.is_none_or(|scene| scene.len() == self.materials.len()), "the scene of these materials");
        let presets: Vec<Preset> = self.materials.iter().map(|material| material.preset(self.space)).collect();
        let stems = file_stems(&presets);
        let wanted: Vec<usize> = (0..self.materials.len()).filter(|place| is_wanted(*place)).collect();
        let mut made = PlanExport::default();
        for &target in targets {
            let file = |&place: &usize| {
                let scales = Scales::of(self, &self.materials[place], scene.map(|scene| &scene[place]));
                self.file(scales, &self.materials[place], &presets[place], &stems[place], target, options)
            };
            let each: Result<Vec<PlanExport>, ExportError> = wanted.par_iter().map(file).collect();
            for PlanExport { files, losses } in each? {
                made.files.extend(files);
                made.losses.extend(losses);
            }
        }
        Ok(made)
    }

    fn file(
        &self,
        mut scales: Scales<'_>,
        material: &MaterialPlan,
        preset: &Preset,
        stem: &str,
        target: Target,
        options: &Options,
    ) -> Result<PlanExport, ExportError> {
        let said = nearest(&mut scales, preset, target, options)?;
        let beyond = (!scales.is_within(said.error)).then(|| self.sentence(&scales, material, target, &said));
        let remarks: Vec<String> = beyond.into_iter().collect();
        let exported = export_form(stem, preset, target, options, &said.form, &remarks)?;
        let losses = exported.losses.iter().map(|loss| format!("{target}: {loss}"));
        let beyond = remarks.iter().map(|remark| format!("{target}: {}: {remark}", material.name));
        let losses = beyond.chain(losses).collect();
        let file = |file: crate::export::ExportFile| PlannedFile {
            target,
            name: file.name,
            bytes: file.bytes,
            variant: said.variant,
        };
        Ok(PlanExport { files: exported.files.into_iter().map(file).collect(), losses })
    }

    /// How far a file is beyond the bound, and why.
    fn sentence(&self, scales: &Scales<'_>, material: &MaterialPlan, target: Target, said: &Said) -> String {
        let chosen = material.chosen;
        let untaken = if target.takes(model_of(chosen)) { "" } else { ", which this target does not take" };
        let written = if said.variant == chosen { String::new() } else { format!("{} is written, and ", said.variant) };
        let most = if scales.is_exact() { "" } else { "at most " };
        format!(
            "the plan wants {chosen}{untaken}; {written}as its reader shows it the {} is {most}{:.3}, above {}",
            self.tolerance.on.label(),
            said.error,
            self.tolerance.delta_e
        )
    }
}

/// The plan's own parameters where they stay within its bound as the target's reader shows them, else the cheapest that
/// do; where none do, the plan's own again, or the nearest that the target takes.
fn nearest(scales: &mut Scales<'_>, preset: &Preset, target: Target, options: &Options) -> Result<Said, ExportError> {
    let space = options.space_for(target, preset.space)?;
    let mut nearest: Option<Said> = None;
    let candidates = scales.candidates(target.is_sampled());
    let is_own = |said: &Said| said.variant == candidates[0] && said.error.is_finite();
    for &variant in candidates.iter().filter(|variant| target.takes(model_of(**variant))) {
        let Some(form) = scales.form(variant, space) else { continue };
        let read = match readings(preset, target, options, &form) {
            Err(ExportError::NotFinite(_)) if variant != Variant::HOFFMAN => continue,
            read => read?,
        };
        let error = scales.error(&read, variant, &form, space);
        if scales.is_within(error) {
            return Ok(Said { variant, form, error });
        }
        if nearest.as_ref().is_none_or(|nearest| !is_own(nearest) && error < nearest.error) {
            nearest = Some(Said { variant, form, error });
        }
    }
    Ok(nearest.expect("every target takes r and h, which every material has"))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::color::RgbSpace;
    use crate::fit::Method;
    use crate::fresnel::{FresnelModel, ModelKind};
    use crate::metal::{Metal, metal_by_name};
    use crate::scene::{PlanOptions, Shape, Source, Tolerance, plan_scene};
    use crate::study::{Measure, no_progress};

    fn on(name: &str, shape: Shape) -> SceneMaterial {
        let metal = metal_by_name(name).unwrap().clone();
        SceneMaterial { source: Source::Metal(Arc::new(metal)), angles: shape.angles() }
    }

    fn planned(materials: &[SceneMaterial], delta_e: f64) -> Plan {
        let tolerance = Tolerance { delta_e, ..Tolerance::default() };
        plan_scene(materials, "", &PlanOptions { tolerance, ..PlanOptions::default() }, &no_progress).unwrap()
    }

    const CARD: Shape = Shape::Card { from_deg: 0.0, to_deg: 60.0 };

    fn three() -> [SceneMaterial; 3] {
        [on("gold", CARD), on("iron", Shape::Sphere), on("zinc", Shape::Sphere)]
    }

    fn text(file: &PlannedFile) -> &str {
        std::str::from_utf8(&file.bytes).unwrap()
    }

    #[test]
    fn files_say_no_more_than_the_scene_requires() {
        let (scene, options) = (three(), Options::default());
        let plan = planned(&scene, 1.0);
        let made = plan.export(Some(&scene), &[Target::Glsl], &options, |_| true).unwrap();
        let variants: Vec<Variant> = made.files.iter().map(|file| file.variant).collect();
        assert_eq!(variants, [Variant::SCHLICK, Variant::HOFFMAN, Variant::Table(32)]);
        assert!(made.losses.is_empty(), "{:?}", made.losses);
        assert!(text(&made.files[2]).contains("32 rows"));
    }

    /// The fitted r and h of the plan, not the exact ones, which are farther off than it allows.
    #[test]
    fn fitted_r_and_h_are_written() {
        let scene = [on("gold", Shape::Sphere)];
        let plan = planned(&scene, 0.75);
        let Some(Form::Model { model: FresnelModel::Hoffman { r, h } }) = plan.materials[0].parameters else {
            panic!("{:?}", plan.materials[0].chosen)
        };
        assert_eq!(plan.materials[0].chosen, Variant::Model(ModelKind::Hoffman, Method::LeastSquares));
        for scene in [Some(&scene[..]), None] {
            let made = plan.export(scene, &[Target::Glsl, Target::Json], &Options::default(), |_| true).unwrap();
            assert!(made.losses.is_empty(), "{:?}", made.losses);
            let green = format!("{:.9}", h[1]).trim_end_matches('0').to_owned();
            assert!(text(&made.files[0]).contains(&green), "{green} {}", text(&made.files[0]));
            let preset = Preset::from_json(text(&made.files[1])).unwrap().preset;
            assert_eq!((preset.r, preset.h), (r, h));
            assert!(matches!(preset.origin, crate::preset::Origin::Edited { .. }), "no longer the measured r and h");
        }
    }

    /// Gold's red of 1.04 becomes 1, which is farther off than the plan allows.
    #[test]
    fn what_is_clipped_is_weighed_and_told_in_the_file() {
        let scene = [on("gold", CARD)];
        let plan = planned(&scene, 1.0);
        for scene in [Some(&scene[..]), None] {
            let made = plan.export(scene, &[Target::OpenPbr], &Options::default(), |_| true).unwrap();
            let [beyond, clipped] = &made.losses[..] else { panic!("{:?}", made.losses) };
            assert!(beyond.contains("above 1") && beyond.contains("largest ΔE is 1.26"), "{beyond}");
            assert!(clipped.contains("r red 1.03") && !clipped.contains("t red"), "{clipped}");
            assert!(text(&made.files[0]).contains("above 1 "), "{}", text(&made.files[0]));
        }
        let wide = Options { space: Some(RgbSpace::AcesCg) };
        let made = plan.export(Some(&scene), &[Target::OpenPbr], &wide, |_| true).unwrap();
        assert!(made.losses.is_empty(), "ACEScg holds gold: {:?}", made.losses);
    }

    /// A plan of a mean keeps it, whatever its largest error is, also where nobody knows how often an angle is seen.
    #[test]
    fn a_bounded_mean_is_no_bounded_largest() {
        let scene = [on("zinc", Shape::Sphere)];
        let tolerance = Tolerance { delta_e: 1.0, on: Measure::Mean };
        let options = PlanOptions { tolerance, ..PlanOptions::default() };
        let plan = plan_scene(&scene, "", &options, &no_progress).unwrap();
        assert!(plan.materials[0].choice().error.max_delta_e > 1.0);
        for scene in [Some(&scene[..]), None] {
            let made = plan.export(scene, &[Target::Glsl, Target::Blender], &Options::default(), |_| true).unwrap();
            assert_eq!(made.files[0].variant, plan.materials[0].chosen);
            assert!(!made.losses.iter().any(|loss| loss.contains("above")), "{:?}", made.losses);
        }
    }

    /// Its truth is not at hand: what the plan found counts, and what a file adds to it.
    #[test]
    fn a_metal_that_is_not_at_hand_keeps_its_parameters() {
        let Source::Metal(gold) = on("gold", CARD).source else { unreachable!() };
        let mut own = Metal::clone(&gold);
        "mine".clone_into(&mut own.id);
        let scene = [SceneMaterial { source: Source::Metal(Arc::new(own)), angles: CARD.angles() }];
        let plan = planned(&scene, 1.0);
        let targets = [Target::Glsl, Target::Csv, Target::OpenPbr];
        let made = plan.export(None, &targets, &Options::default(), |_| true).unwrap();
        assert!(made.files.iter().all(|file| file.variant == Variant::SCHLICK));
        assert!(
            made.losses[0].starts_with("open-pbr: Gold") && made.losses[0].contains("at most"),
            "{:?}",
            made.losses
        );
        let known = plan.export(Some(&scene), &targets, &Options::default(), |_| true).unwrap();
        assert_eq!(known.files[1].variant, Variant::Exact);
    }

    #[test]
    fn one_of_them_has_the_same_name_as_among_all() {
        let scene = three();
        let (plan, options, targets) = (planned(&scene, 1.0), Options::default(), [Target::Glsl, Target::Csv]);
        let all = plan.export(None, &targets, &options, |_| true).unwrap();
        let second = plan.export(None, &targets, &options, |place| place == 1).unwrap();
        assert_eq!(second.files.iter().collect::<Vec<_>>(), [&all.files[1], &all.files[4]]);
        let palette = Target::ALL.into_iter().find(|target| target.is_palette()).unwrap();
        assert!(matches!(plan.export(None, &[palette], &options, |_| true), Err(PlanExportError::Palette(_))));
    }
}
