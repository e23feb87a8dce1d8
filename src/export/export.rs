//! From presets to files: translate, measure what that loses, write.

use rayon::prelude::*;

use super::edge_tint::EdgeTint;
use super::loss::{Cause, Difference, Part};
use super::material::Material;
use super::swatch::Swatch;
use super::tint::Tint;
use super::{ExportError, ExportFile, Exported, Kept, Loss, Options, Target, file_stems};
use super::{aco, ase, blender, cube, curve_csv, exr_ramp, gltf, gpl, materialx, mitsuba, mitsuba_plugin, shader, usd};
use crate::color::RgbSpace;
use crate::fresnel::{ARTISTIC_IOR_MAX_R, FresnelModel};
use crate::preset::{Preset, file_stem};

/// What writers return; their own error types differ.
pub(super) type Written = Result<Vec<u8>, Box<dyn std::error::Error>>;

/// r = 1 has no index. With this limit k stays below 300, and the curve within 1e-4.
const INDEX_MAX_R: f64 = 0.9999;

/// Writes one preset. Its file is named after it.
pub fn export(preset: &Preset, target: Target, options: &Options) -> Result<Exported, ExportError> {
    export_as(&file_stem(&preset.name), preset, target, options)
}

/// Writes one preset under a stem of the caller's, as [`file_stems`] gives for a batch.
pub fn export_as(stem: &str, preset: &Preset, target: Target, options: &Options) -> Result<Exported, ExportError> {
    export_kept(stem, preset, target, options, Kept::Whole)
}

/// Writes of one preset no more than a scene requires; what the target cannot leave out is kept, see [`Target::can_keep`].
pub fn export_kept(
    stem: &str,
    preset: &Preset,
    target: Target,
    options: &Options,
    kept: Kept,
) -> Result<Exported, ExportError> {
    let kept = if target.can_keep(kept) { kept } else { Kept::Whole };
    let material = Material::new(preset, target, options)?.keeping(kept);
    let translation = Translation::of(&material, target);
    let losses = translation.losses(&material, target);
    let header = header(&material, &losses);
    let bytes = (translation.write)(&header).map_err(ExportError::write(target))?;
    Ok(Exported { files: vec![ExportFile { name: name_in_space(stem, target, material.space), bytes }], losses })
}

/// Writes many presets: a file each, with names that do not meet, or one palette of all. In parallel, in order.
pub fn export_all(presets: &[Preset], target: Target, options: &Options) -> Result<Exported, ExportError> {
    if presets.is_empty() {
        return Err(ExportError::NoPreset);
    }
    if target.is_palette() {
        return export_palette(presets, target, options);
    }
    let stems = file_stems(presets);
    let pairs = stems.par_iter().zip(presets);
    let each: Result<Vec<Exported>, ExportError> =
        pairs.map(|(stem, preset)| export_as(stem, preset, target, options)).collect();
    Ok(each?.into_iter().fold(Exported::default(), Exported::with))
}

fn export_palette(presets: &[Preset], target: Target, options: &Options) -> Result<Exported, ExportError> {
    let mut swatches = Vec::new();
    let mut losses = Vec::new();
    for preset in presets {
        let material = Material::new(preset, target, options)?;
        losses.extend(Translation::of(&material, target).losses(&material, target));
        swatches.extend(Swatch::pair(&material));
    }
    let stem = palette_stem(presets.iter().map(|preset| preset.name.as_str()));
    let bytes = write_palette(target, &stem, &swatches).map_err(ExportError::write(target))?;
    let name = name_in_space(&stem, target, RgbSpace::LinRec709);
    Ok(Exported { files: vec![ExportFile { name, bytes }], losses })
}

/// The one file of a palette is called after its metal, or after this program where it has several.
pub fn palette_stem<'a>(mut names: impl Iterator<Item = &'a str>) -> String {
    match (names.next(), names.next()) {
        (Some(name), None) => file_stem(name),
        _ => "edgewise".to_owned(),
    }
}

/// What a reader of the target will show for a preset, and what is lost: the preview of an export.
pub fn shown(preset: &Preset, target: Target, options: &Options) -> Result<Shown, ExportError> {
    let material = Material::new(preset, target, options)?;
    let translation = Translation::of(&material, target);
    let losses = translation.losses(&material, target);
    Ok(Shown { space: material.space, wanted: material.model(), model: translation.model, losses })
}

/// See [`shown`].
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// The space of the file.
    pub space: RgbSpace,
    /// The preset's curve in that space.
    pub wanted: FresnelModel,
    /// The curve the reader shows.
    pub model: FresnelModel,
    /// Why they differ.
    pub losses: Vec<Loss>,
}

/// Whether a preset could be written at all, before anything is.
pub fn check(preset: &Preset, target: Target, options: &Options) -> Result<(), ExportError> {
    Material::new(preset, target, options).map(drop)
}

/// What the file of a preset will be called; `own` is the space of the preset.
pub fn file_name(stem: &str, target: Target, own: RgbSpace, options: &Options) -> Result<String, ExportError> {
    Ok(name_in_space(stem, target, options.space_for(target, own)?))
}

/// Files of another working space than the default say so, so that both can lie in one folder.
pub(super) fn name_in_space(stem: &str, target: Target, space: RgbSpace) -> String {
    let suffix = target.suffix();
    if space == RgbSpace::default() { format!("{stem}.{suffix}") } else { format!("{stem}.{space}.{suffix}") }
}

/// The lines every commented format begins with.
fn header(material: &Material<'_>, losses: &[Loss]) -> Vec<String> {
    let (r, h) = (super::number::triple(material.r, " "), super::number::triple(material.h, " "));
    let mut lines = vec![
        format!("{}, written by Edgewise", material.name),
        match material.kept {
            Kept::Whole => format!("{}: r = {r} facing, h = {h} at 81.8°", material.space),
            Kept::Schlick => format!("{}: r = {r} facing, Schlick's edge: its scene needs no h", material.space),
            Kept::Constant => format!("{}: r = {r} at every angle: its scene needs no edge", material.space),
        },
    ];
    lines.extend(losses.iter().map(|loss| super::names::one_line(&loss.to_string())));
    lines
}

type Writer<'a> = Box<dyn FnOnce(&[String]) -> Written + 'a>;

/// A material in the words of one target.
struct Translation<'a> {
    /// The curve a reader makes of these words.
    model: FresnelModel,
    causes: Vec<Cause>,
    write: Writer<'a>,
}

impl<'a> Translation<'a> {
    fn of(material: &'a Material<'a>, target: Target) -> Self {
        match target {
            Target::Json => Self::exact(material, |_| Ok(material.in_its_space().to_json()?.into_bytes())),
            Target::Csv => Self::exact(material, |_| curve_csv::write(&material.model())),
            Target::OpenPbr => Self::tint(material, |header, tint| materialx::open_pbr(header, material, tint)),
            Target::GeneralizedSchlick => {
                Self::tint(material, |header, tint| materialx::generalized_schlick(header, material, tint))
            }
            Target::Blender => Self::tint(material, |header, _| blender::write(header, material)),
            Target::Gltf => Self::tint(material, |_, tint| gltf::write(material, tint)),
            Target::Usd => Self::tint(material, |header, tint| usd::write(header, material, tint)),
            Target::Glsl => Self::exact(material, |header| shader::glsl(header, material)),
            Target::Hlsl => Self::exact(material, |header| shader::hlsl(header, material)),
            Target::Wgsl => Self::exact(material, |header| shader::wgsl(header, material)),
            Target::Osl => Self::exact(material, |header| shader::osl(header, material)),
            Target::Cube => Self::exact(material, |header| cube::write(header, material)),
            Target::Exr => Self::exact(material, |_| exr_ramp::write(material)),
            Target::StandardSurface => Self::edge_tint(material, ARTISTIC_IOR_MAX_R, "edge tint g", |header, fit| {
                materialx::standard_surface(header, material, fit)
            }),
            Target::Mitsuba => {
                Self::edge_tint(material, INDEX_MAX_R, "n and k", |header, fit| mitsuba::write(header, material, fit))
            }
            Target::MitsubaPlugin => Self::exact(material, |header| mitsuba_plugin::write(header, material)),
            Target::Gpl | Target::Ase | Target::Aco => Self::palette(material, target),
        }
    }

    /// The file says r and h, or the curve itself.
    fn exact(material: &Material<'_>, write: impl FnOnce(&[String]) -> Written + 'a) -> Self {
        Self { model: material.model(), causes: Vec::new(), write: Box::new(write) }
    }

    /// The file says r and t.
    fn tint(material: &Material<'_>, write: impl FnOnce(&[String], &Tint) -> Written + 'a) -> Self {
        let tint = Tint::of_material(material);
        Self { model: tint.model(), causes: tint.causes(), write: Box::new(move |header| write(header, &tint)) }
    }

    /// The file says r and g, or the n and k these stand for.
    fn edge_tint(
        material: &Material<'_>,
        max_r: f64,
        what: &'static str,
        write: impl FnOnce(&[String], &EdgeTint) -> Written + 'a,
    ) -> Self {
        let fit = EdgeTint::fitted(material.r, material.h, max_r);
        Self { model: fit.model(), causes: fit.causes(what), write: Box::new(move |header| write(header, &fit)) }
    }

    /// The file says two colours.
    fn palette(material: &Material<'_>, target: Target) -> Self {
        let swatches = Swatch::pair(material);
        let (model, causes) = Swatch::reading(material, target);
        let stem = material.name.clone();
        Self { model, causes, write: Box::new(move |_| write_palette(target, &stem, &swatches)) }
    }

    /// What is lost in every space the file speaks for, and what the file has no place for.
    fn losses(&self, material: &Material<'_>, target: Target) -> Vec<Loss> {
        let difference = Difference::between(&material.model(), &self.model, material.space);
        let loss = |cause| Loss { preset: material.name.clone(), space: material.space, cause, difference };
        let mut losses = match target {
            Target::Blender => blender_losses(material),
            _ => self.causes.iter().cloned().map(loss).collect(),
        };
        losses.extend(dropped(material, target).map(|part| loss(Cause::Dropped(part))));
        losses
    }
}

/// The script holds the numbers of three working spaces, and which is used is known only when it runs.
fn blender_losses(material: &Material<'_>) -> Vec<Loss> {
    let mut losses = Vec::new();
    for (_, space) in blender::WORKING_SPACES {
        let tint = Tint::in_space(material, space);
        let difference = Difference::between(&material.model_in(space), &tint.model(), space);
        let loss = |cause| Loss { preset: material.name.clone(), space, cause, difference };
        losses.extend(tint.causes().into_iter().map(loss));
    }
    losses
}

fn dropped(material: &Material<'_>, target: Target) -> impl Iterator<Item = Part> {
    let roughness =
        (!target.says_roughness() && material.roughness > 0.0).then_some(Part::Roughness(material.roughness));
    let curve = target.is_palette().then_some(Part::Curve);
    roughness.into_iter().chain(curve)
}

fn write_palette(target: Target, title: &str, swatches: &[Swatch]) -> Written {
    match target {
        Target::Ase => ase::write(swatches),
        Target::Aco => aco::write(swatches),
        _ => gpl::write(title, swatches),
    }
}
