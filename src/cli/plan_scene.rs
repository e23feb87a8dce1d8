//! The scene that `edgewise plan` is about: materials, and the angles at which they are seen.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, bail};
use clap::Args;

use super::arguments;
use crate::color::RgbSpace;
use crate::file::read_text;
use crate::fresnel::h_of_schlick;
use crate::metal::{Metal, metal_by_name, preferred_metals};
use crate::photo::{Plane, PlaneKind};
use crate::preset::{Preset, built_in_presets};
use crate::scene::{
    Angles, FacingPass, Masks, Place, SavedMaterial, SavedPass, SavedScene, Seen, Shape, Source, kept_path,
    scene_sentence,
};

/// The arguments that name a scene.
#[derive(Debug, Args)]
pub(super) struct SceneArguments {
    /// MATERIAL or MATERIAL@SEEN. A material is a metal of the library, a preset (.json), n and k (.csv, .yml), or
    /// colours as 0.9,0.7,0.4 or r/h. SEEN is sphere, cylinder, card:0-60, floor:1.7:1-20, id:7 with --ids, or the
    /// file of a matte with --pass
    #[arg(value_name = "MATERIAL@SEEN", required_unless_present_any = ["list", "metals", "presets", "from"])]
    materials: Vec<String>,
    /// A text file with one MATERIAL@SEEN on each line
    #[arg(long, value_name = "FILE")]
    list: Option<PathBuf>,
    /// Also every metal of the library, by its preferred data set
    #[arg(long)]
    metals: bool,
    /// Also every built-in preset
    #[arg(long)]
    presets: bool,
    /// How materials are seen that do not say it
    #[arg(long, default_value = "sphere", conflicts_with = "pass")]
    seen: Shape,
    /// A rendered facing-ratio pass (cosine between normal and view) as .exr or .png
    #[arg(long, value_name = "FILE")]
    pass: Option<PathBuf>,
    /// The channel of the pass; the likeliest unless given
    #[arg(long, value_name = "NAME", requires = "pass")]
    channel: Option<String>,
    /// A picture of whole numbers that tell the materials of the pass apart; in an 8-bit colour PNG, #rrggbb as a number
    #[arg(long, value_name = "FILE", requires = "pass")]
    ids: Option<PathBuf>,
    /// The channel of the ids
    #[arg(long, value_name = "NAME", requires = "ids")]
    ids_channel: Option<String>,
}

/// What the arguments name.
pub(super) struct FoundScene {
    pub(super) scene: SavedScene,
    /// Where its angles come from.
    pub(super) sentence: String,
    /// What a person should know about that.
    pub(super) notes: Vec<String>,
}

/// A material as it was named.
struct Named {
    source: Source,
    file: Option<String>,
    seen: Where,
}

/// Where a material is seen.
#[derive(Clone, Debug, PartialEq)]
enum Where {
    /// As the scene says.
    Default,
    Shape(Shape),
    Id(u32),
    Matte(PathBuf),
}

impl Where {
    fn place(&self) -> Place {
        match self {
            Self::Default => Place::Whole,
            Self::Shape(shape) => Place::Shape(*shape),
            Self::Id(id) => Place::Id(*id),
            Self::Matte(path) => Place::Matte(kept_path(path)),
        }
    }
}

impl SceneArguments {
    /// Reads whatever the arguments name; colours are in the space.
    pub(super) fn scene(&self, space: RgbSpace, warnings: &mut Vec<String>) -> anyhow::Result<FoundScene> {
        let named = self.named(space, warnings)?;
        let seen: Vec<Where> = named.iter().map(|named| named.seen.clone()).collect();
        let Sights { places, angles, pass, notes } = match &self.pass {
            Some(path) => self.in_pass(path, &seen)?,
            None => self.on_shapes(&seen)?,
        };
        let sentence = scene_sentence(pass.as_ref().map(|pass| pass.found.as_str()), &places);
        let each = named.into_iter().zip(places).zip(angles);
        let materials = each.map(|((named, place), angles)| {
            let Named { source, file, .. } = named;
            SavedMaterial { source, file, place, angles }
        });
        Ok(FoundScene { scene: SavedScene { materials: materials.collect(), pass }, sentence, notes })
    }

    fn named(&self, space: RgbSpace, warnings: &mut Vec<String>) -> anyhow::Result<Vec<Named>> {
        let listed = match &self.list {
            Some(path) => read_text(path)?,
            None => String::new(),
        };
        let lines = listed.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
        let words = self.materials.iter().map(String::as_str).chain(lines);
        let mut named: Vec<Named> = words.map(|word| material(word, space, warnings)).collect::<anyhow::Result<_>>()?;
        let metals = preferred_metals().filter(|_| self.metals).map(|metal| Source::Metal(Arc::new(metal.clone())));
        let presets = built_in_presets().iter().filter(|_| self.presets);
        let presets = presets.map(|preset| Source::Preset(Box::new(preset.clone())));
        named.extend(metals.chain(presets).map(|source| Named { source, file: None, seen: Where::Default }));
        Ok(named)
    }

    fn on_shapes(&self, seen: &[Where]) -> anyhow::Result<Sights> {
        let shape = |seen: &Where| match seen {
            Where::Default => Ok(self.seen),
            Where::Shape(shape) => Ok(*shape),
            Where::Id(_) | Where::Matte(_) => bail!("ids and mattes belong to a facing-ratio pass: --pass FILE"),
        };
        let shapes: Vec<Shape> = seen.iter().map(shape).collect::<anyhow::Result<_>>()?;
        let angles = shapes.iter().map(|shape| shape.angles()).collect();
        let mut notes: Vec<String> = Vec::new();
        for note in shapes.iter().filter_map(|shape| shape.warning()) {
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
        Ok(Sights { places: shapes.into_iter().map(Place::Shape).collect(), angles, pass: None, notes })
    }

    fn in_pass(&self, path: &Path, seen: &[Where]) -> anyhow::Result<Sights> {
        let mut notes = Vec::new();
        let pass = FacingPass { ratio: open(path, PlaneKind::Facing, self.channel.as_deref(), &mut notes)? };
        let (masks, ids) = self.masks(seen, &mut notes)?;
        let Seen { mut angles, scene, warnings, .. } = pass.angles(&masks, &ids).map_err(anyhow::Error::msg)?;
        notes.extend(warnings);
        if matches!(masks, Masks::None) {
            angles = vec![angles.remove(0); seen.len()];
        }
        let saved = SavedPass {
            file: kept_path(path),
            channel: self.channel.clone(),
            ids: self.ids.as_deref().map(kept_path),
            found: scene,
        };
        Ok(Sights { places: seen.iter().map(Where::place).collect(), angles, pass: Some(saved), notes })
    }

    /// What tells the materials of the pass apart: all in one way.
    fn masks(&self, seen: &[Where], warnings: &mut Vec<String>) -> anyhow::Result<(Masks, Vec<u32>)> {
        if let Some(ids) = &self.ids {
            let id = |seen: &Where| if let Where::Id(id) = seen { Some(*id) } else { None };
            let all: Option<Vec<u32>> = seen.iter().map(id).collect();
            let all = all.context("with --ids every material says which one it has, like gold@id:7")?;
            let mut sorted = all.clone();
            sorted.sort_unstable();
            if let Some(twice) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
                bail!("the id {} is given to two materials", twice[0]);
            }
            return Ok((Masks::Ids(open(ids, PlaneKind::Id, self.ids_channel.as_deref(), warnings)?), all));
        }
        if seen.iter().all(|seen| *seen == Where::Default) {
            return Ok((Masks::None, Vec::new()));
        }
        let mattes = seen.iter().map(|seen| match seen {
            Where::Matte(path) => open(path, PlaneKind::Matte, None, warnings),
            Where::Id(_) => bail!("ids need their picture: --ids FILE"),
            Where::Shape(shape) => bail!("with --pass no material is seen on a shape ({})", shape.label()),
            Where::Default => bail!("where one material has a matte, every one has: MATERIAL@FILE"),
        });
        Ok((Masks::Mattes(mattes.collect::<anyhow::Result<_>>()?), Vec::new()))
    }
}

/// Where each material is seen, at which angles, the pass that shows them, and what a person should know about that.
struct Sights {
    places: Vec<Place>,
    angles: Vec<Angles>,
    pass: Option<SavedPass>,
    notes: Vec<String>,
}

/// A material and, after the last @, where it is seen.
fn material(word: &str, space: RgbSpace, warnings: &mut Vec<String>) -> anyhow::Result<Named> {
    let (word, seen) = match word.rsplit_once('@') {
        Some((material, place)) => (material, seen(place)?),
        None => (word, Where::Default),
    };
    let path = Path::new(word);
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    let (source, is_file) = match ending.as_str() {
        "json" => {
            let loaded = Preset::load(path)?;
            warnings.extend(loaded.warnings);
            (Source::Preset(Box::new(loaded.preset)), true)
        }
        "csv" | "yml" | "yaml" => (Source::Metal(Arc::new(Metal::open(path)?)), true),
        _ if word.contains(',') => (colours(word, space, warnings)?, false),
        _ => (Source::Metal(Arc::new(metal_by_name(word)?.clone())), false),
    };
    Ok(Named { source, file: is_file.then(|| kept_path(path)), seen })
}

fn colours(word: &str, space: RgbSpace, warnings: &mut Vec<String>) -> anyhow::Result<Source> {
    let triple = |text: &str| arguments::triple(text).map_err(anyhow::Error::msg);
    let (r, h) = match word.split_once('/') {
        Some((r, h)) => (triple(r)?, triple(h)?),
        None => (triple(word)?, triple(word)?.map(h_of_schlick)),
    };
    if r.0.into_iter().chain(h.0).any(|value| !(0.0..=1.0).contains(&value)) {
        warnings.push(format!("{word} leaves 0–1 in {space}; nothing is clamped"));
    }
    // Nobody said how rough it is; a metal of the library is none either.
    let preset = Preset { name: "Given colours".to_owned(), r, h, space, roughness: 0.0, ..Preset::new_authored() };
    Ok(Source::Preset(Box::new(preset)))
}

fn open(path: &Path, kind: PlaneKind, channel: Option<&str>, warnings: &mut Vec<String>) -> anyhow::Result<Plane> {
    let plane = Plane::open(path, kind, channel, &mut |_| ControlFlow::Continue(()))?;
    warnings.extend(plane.warnings.iter().map(|warning| format!("{}: {warning}", path.display())));
    Ok(plane)
}

fn seen(text: &str) -> anyhow::Result<Where> {
    if let Some(id) = text.strip_prefix("id:") {
        let id = id.strip_prefix('#').map_or_else(|| id.parse().ok(), |hex| u32::from_str_radix(hex, 16).ok());
        return Ok(Where::Id(id.with_context(|| format!("“{text}” needs a whole number, like id:7 or id:#ff8000"))?));
    }
    let is_picture =
        Path::new(text).extension().is_some_and(|e| e.eq_ignore_ascii_case("exr") || e.eq_ignore_ascii_case("png"));
    if is_picture {
        return Ok(Where::Matte(PathBuf::from(text)));
    }
    Ok(Where::Shape(text.parse()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_shapes_ids_or_mattes() {
        ensure_place("sphere", Where::Shape(Shape::Sphere));
        ensure_place("id:7", Where::Id(7));
        ensure_place("id:#ff8000", Where::Id(0xff8000));
        ensure_place("gold.EXR", Where::Matte(PathBuf::from("gold.EXR")));
        for (text, reason) in [("id:x", "whole number"), ("id:-1", "whole number"), ("cube", "no shape")] {
            assert!(seen(text).unwrap_err().to_string().contains(reason), "{text}");
        }
    }

    fn ensure_place(text: &str, expected: Where) {
        assert_eq!(seen(text).unwrap(), expected);
    }
}
