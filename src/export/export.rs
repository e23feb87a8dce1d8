//! From presets to files: translate, measure what that loses, write.

use rayon::prelude::*;

use super::edge_tint::EdgeTint;
use super::form::limited_index;
use super::language::described;
use super::loss::{Cause, Difference, Parameter, Part, clip};
use super::material::Material;
use super::materialx::Edge;
use super::swatch::Swatch;
use super::tint::Tint;
use super::{ExportError, ExportFile, Exported, Loss, Options, Target, file_stems};
use super::{aco, ase, blender, cube, curve_csv, exr_ramp, gltf, gpl, materialx, mitsuba, mitsuba_plugin, shader, usd};
use crate::color::RgbSpace;
use crate::fresnel::{ARTISTIC_IOR_MAX_R, FresnelModel};
use crate::preset::{Preset, file_stem};
use crate::study::Form;

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
    write(stem, &Material::new(preset, target, options)?, target, &[])
}

/// Writes one preset in other parameters than its r and h, which are in the space of the file; the target takes them, see
/// [`Target::takes`]. `remarks` are told in the file beside the losses.
pub fn export_form(
    stem: &str,
    preset: &Preset,
    target: Target,
    options: &Options,
    form: &Form,
    remarks: &[String],
) -> Result<Exported, ExportError> {
    write(stem, &Material::new(preset, target, options)?.saying(form)?, target, remarks)
}

fn write(stem: &str, material: &Material<'_>, target: Target, remarks: &[String]) -> Result<Exported, ExportError> {
    let translation = Translation::of(material, target);
    let losses = translation.losses(material, target);
    let told: Vec<String> = losses.iter().map(ToString::to_string).chain(remarks.iter().cloned()).collect();
    let header = Header::of(material, &told);
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
    let model = |form| if let Form::Model { model } = form { Some(model) } else { None };
    let (wanted, shown) = (model(material.form.clone()), model(translation.shown));
    let (wanted, model) = wanted.zip(shown).expect("r and h, and what readers make of them, are models");
    Ok(Shown { space: material.space, wanted, model, losses })
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

/// What is said in words, where a format has room for them.
struct Header {
    /// The lines every commented format begins with, the losses last.
    lines: Vec<String>,
    /// Only what is lost.
    told: Vec<String>,
}

impl Header {
    fn of(material: &Material<'_>, told: &[String]) -> Self {
        let told: Vec<String> = told.iter().map(|line| super::names::one_line(line)).collect();
        let own = [format!("{}, written by Edgewise", material.name), said(material)];
        Self { lines: own.into_iter().chain(told.iter().cloned()).collect(), told }
    }
}

/// What the file says of the curve, in a line.
fn said(material: &Material<'_>) -> String {
    let space = material.space;
    let (r, h) = (super::number::triple(material.r, " "), super::number::triple(material.h, " "));
    match &material.form {
        Form::Model { model: FresnelModel::Hoffman { .. } } => format!("{space}: r = {r} facing, h = {h} at 81.8°"),
        Form::Model { model: FresnelModel::Schlick { .. } } => {
            format!("{space}: r = {r} facing, Schlick's edge: its scene needs no h")
        }
        Form::Model { model: FresnelModel::Constant { .. } } => {
            format!("{space}: r = {r} at every angle: its scene needs no edge")
        }
        form => format!("{space}: {}, as its scene requires", described(form)),
    }
}

type Writer<'a> = Box<dyn FnOnce(&Header) -> Written + 'a>;

/// A material in the words of one target.
pub(super) struct Translation<'a> {
    /// The curve a reader makes of these words.
    pub shown: Form,
    causes: Vec<Cause>,
    write: Writer<'a>,
}

impl<'a> Translation<'a> {
    pub(super) fn of(material: &'a Material<'a>, target: Target) -> Self {
        match target {
            Target::Json => Self::exact(material, |header| json(material, &header.told)),
            Target::Csv => Self::exact(material, |_| curve_csv::write(&material.form)),
            Target::OpenPbr => Self::tint(material, |header, tint| materialx::open_pbr(&header.lines, material, tint)),
            Target::GeneralizedSchlick => Self::generalized_schlick(material),
            Target::Blender => Self::tint(material, |header, _| blender::write(&header.lines, material)),
            Target::Gltf => Self::tint(material, |header, tint| gltf::write(&header.told, material, tint)),
            Target::Usd => Self::tint(material, |header, tint| usd::write(&header.lines, material, tint)),
            Target::Glsl | Target::Hlsl | Target::Wgsl | Target::Osl => {
                Self::exact(material, move |header| shader::source(&header.lines, material, target))
            }
            Target::Cube => Self::exact(material, |header| cube::write(&header.lines, material)),
            Target::Exr => Self::exact(material, |header| exr_ramp::write(&header.lines, material)),
            Target::StandardSurface => Self::edge_tint(material, ARTISTIC_IOR_MAX_R, "edge tint g", |header, fit| {
                materialx::standard_surface(&header.lines, material, fit)
            }),
            Target::Mitsuba => Self::mitsuba(material),
            Target::MitsubaPlugin => Self::exact(material, |header| mitsuba_plugin::write(&header.lines, material)),
            Target::Gpl | Target::Ase | Target::Aco => Self::palette(material, target),
        }
    }

    /// The file says the parameters themselves, or the curve.
    fn exact(material: &Material<'_>, write: impl FnOnce(&Header) -> Written + 'a) -> Self {
        Self { shown: material.form.clone(), causes: Vec::new(), write: Box::new(write) }
    }

    /// The file says r and t.
    fn tint(material: &Material<'_>, write: impl FnOnce(&Header, &Tint) -> Written + 'a) -> Self {
        let tint = Tint::of_material(material);
        Self { shown: tint.form(), causes: tint.causes(), write: Box::new(move |header| write(header, &tint)) }
    }

    /// The file says r and t, and where they are given the edge at 90° and the power that leads to it.
    fn generalized_schlick(material: &'a Material<'a>) -> Self {
        let Form::Model { model: FresnelModel::GeneralizedSchlick { r0, t, r90, p } } = material.form else {
            return Self::tint(material, |header, tint| {
                materialx::generalized_schlick(&header.lines, material, tint, &Edge::SCHLICK)
            });
        };
        let mut tint = Tint::given(r0, t);
        let edge = Edge { r90: clip(Parameter::R90, r90, 1.0, &mut tint.clips), exponent: p };
        let model = FresnelModel::GeneralizedSchlick { r0: tint.r, t: tint.t, r90: edge.r90, p };
        let causes = tint.causes();
        let write = move |header: &Header| materialx::generalized_schlick(&header.lines, material, &tint, &edge);
        Self { shown: Form::Model { model }, causes, write: Box::new(write) }
    }

    /// The file says n and k: its own, or those that r and g stand for.
    fn mitsuba(material: &'a Material<'a>) -> Self {
        if let Form::Model { model: FresnelModel::Conductor { n, k } } = material.form {
            let (n, k) = (limited_index(n), limited_index(k));
            return Self::exact(material, move |header| mitsuba::write(&header.lines, material, (n, k)));
        }
        Self::edge_tint(material, INDEX_MAX_R, "n and k", |header, fit| {
            mitsuba::write(&header.lines, material, fit.index())
        })
    }

    /// The file says r and g, or the n and k these stand for: its own, or what is nearest to the curve of r and h.
    fn edge_tint(
        material: &Material<'_>,
        max_r: f64,
        what: &'static str,
        write: impl FnOnce(&Header, &EdgeTint) -> Written + 'a,
    ) -> Self {
        let tint = match material.form {
            Form::Model { model: FresnelModel::Gulbrandsen { r, g } } => EdgeTint::given(r, g, max_r),
            _ => EdgeTint::fitted(material.r, material.h, max_r),
        };
        let shown = Form::Model { model: tint.model() };
        Self { shown, causes: tint.causes(what), write: Box::new(move |header| write(header, &tint)) }
    }

    /// The file says two colours.
    fn palette(material: &Material<'_>, target: Target) -> Self {
        let swatches = Swatch::pair(material);
        let (model, causes) = Swatch::reading(material, target);
        let stem = material.name.clone();
        let write = move |_: &Header| write_palette(target, &stem, &swatches);
        Self { shown: Form::Model { model }, causes, write: Box::new(write) }
    }

    /// What is lost in every space the file speaks for, and what the file has no place for.
    fn losses(&self, material: &Material<'_>, target: Target) -> Vec<Loss> {
        let difference = difference(&material.form, &self.shown, material.space);
        let loss = |cause| Loss { preset: material.name.clone(), space: material.space, cause, difference };
        let mut losses = match target {
            Target::Blender => blender_losses(material),
            _ => self.causes.iter().cloned().map(loss).collect(),
        };
        losses.extend(dropped(material, target).map(|part| loss(Cause::Dropped(part))));
        losses
    }
}

fn difference(wanted: &Form, shown: &Form, space: RgbSpace) -> Difference {
    Difference::of_curves(|c| wanted.reflectance(c), |c| shown.reflectance(c), space)
}

/// The preset, with what is lost among its notes.
fn json(material: &Material<'_>, told: &[String]) -> Written {
    let preset = material.in_its_space();
    let notes: Vec<&str> = [preset.notes.as_str()].into_iter().chain(told.iter().map(String::as_str)).collect();
    let notes = notes.join("\n").trim_start_matches('\n').to_owned();
    Ok(Preset { notes, ..preset }.to_json()?.into_bytes())
}

/// The script holds the numbers of three working spaces, and which is used is known only when it runs.
fn blender_losses(material: &Material<'_>) -> Vec<Loss> {
    let mut losses = Vec::new();
    for (_, space) in blender::WORKING_SPACES {
        let tint = Tint::in_space(material, space);
        let difference = difference(&material.form_in(space), &tint.form(), space);
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
