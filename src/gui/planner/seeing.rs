//! Where the materials are seen: on simple shapes, or in a rendered facing-ratio pass.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Same;
use crate::gui::demonstrations::Told;
use crate::gui::job::Progress;
use crate::photo::{Plane, PlaneKind};
use crate::scene::{Angles, FacingPass, Masks, Seen, Shape};

/// How the materials of a pass are told apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Apart {
    /// Not at all: every material is seen at all the angles of the pass.
    #[default]
    Whole,
    /// By a picture of whole numbers.
    Ids,
    /// By a picture for each.
    Mattes,
}

impl Apart {
    /// Every way with its name and what it is.
    pub(crate) const ALL: [(Self, &'static str, &'static str); 3] = [
        (Self::Whole, "Not at all", "Every material is seen at all the angles of the pass"),
        (Self::Ids, "Ids", "A picture of whole numbers, one for each material"),
        (Self::Mattes, "Mattes", "A picture for each material, by its share of each pixel"),
    ];
}

/// The files of a pass.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PassFiles {
    pub pass: PathBuf,
    /// The channel to read; the likeliest unless named.
    pub channel: Option<String>,
    pub apart: ApartFiles,
    /// Makes a file that has changed be read again.
    pub reads: u64,
}

/// The files that tell its materials apart.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ApartFiles {
    Whole,
    Ids(PathBuf),
    Mattes(Vec<PathBuf>),
}

/// The pictures of a pass.
pub(super) struct ReadPass {
    pass: FacingPass,
    masks: Masks,
    warnings: Vec<String>,
}

impl ReadPass {
    /// Reads every picture; a sentence where one cannot be.
    pub(super) fn read(files: &PassFiles, progress: &Progress) -> Told<Arc<Self>> {
        let mut warnings = Vec::new();
        let mut open = |path: &Path, kind, channel: Option<&str>| -> Told<Plane> {
            let mut report = |share: f32| -> ControlFlow<()> { progress.report(share) };
            let plane = Plane::open(path, kind, channel, &mut report).map_err(|error| error.to_string())?;
            warnings.extend(plane.warnings.iter().map(|warning| format!("{}: {warning}", path.display())));
            Ok(plane)
        };
        let ratio = open(files.pass.as_path(), PlaneKind::Facing, files.channel.as_deref())?;
        let masks = match &files.apart {
            ApartFiles::Whole => Masks::None,
            ApartFiles::Ids(path) => Masks::Ids(open(path.as_path(), PlaneKind::Id, None)?),
            ApartFiles::Mattes(paths) => {
                let mattes = paths.iter().map(|path| open(path.as_path(), PlaneKind::Matte, None));
                Masks::Mattes(mattes.collect::<Told<_>>()?)
            }
        };
        Ok(Arc::new(Self { pass: FacingPass { ratio }, masks, warnings }))
    }
}

/// What the materials are looked for in.
#[derive(Clone, PartialEq)]
pub(super) enum Seeing {
    /// A shape for each.
    Shapes(Vec<Shape>),
    /// A pass, and the number of each in its picture of ids.
    Pass(Same<ReadPass>, Vec<u32>),
}

/// How often each material is seen at each angle.
#[derive(Debug)]
pub(crate) struct SeenScene {
    /// The entries, in the order of the angles.
    pub entries: Vec<u64>,
    /// One for each.
    pub angles: Vec<Angles>,
    /// Where they come from, in a sentence.
    pub scene: String,
    /// What a person should know.
    pub warnings: Vec<String>,
}

impl SeenScene {
    pub(super) fn of(entries: Vec<u64>, seeing: &Seeing) -> Told<Arc<Self>> {
        let (angles, scene, warnings) = match seeing {
            Seeing::Shapes(shapes) => on_shapes(shapes)?,
            Seeing::Pass(read, ids) => in_pass(&read.0, ids, entries.len())?,
        };
        Ok(Arc::new(Self { entries, angles, scene, warnings }))
    }
}

type Found = (Vec<Angles>, String, Vec<String>);

fn on_shapes(shapes: &[Shape]) -> Told<Found> {
    let mut known: Vec<(Shape, Angles)> = Vec::new();
    let mut angles = Vec::new();
    for shape in shapes {
        let shape = shape.checked().map_err(|error| error.to_string())?;
        if !known.iter().any(|(other, _)| *other == shape) {
            known.push((shape, shape.angles()));
        }
        angles.extend(known.iter().find(|(other, _)| *other == shape).map(|(_, angles)| angles.clone()));
    }
    let labels: Vec<String> = known.iter().map(|(shape, _)| shape.label()).collect();
    let warnings = known.iter().filter_map(|(shape, _)| shape.warning()).collect();
    Ok((angles, labels.join("; "), warnings))
}

fn in_pass(read: &ReadPass, ids: &[u32], materials: usize) -> Told<Found> {
    if matches!(read.masks, Masks::Ids(_)) {
        let mut sorted = ids.to_vec();
        sorted.sort_unstable();
        if let Some(twice) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(format!("The id {} is given to two materials", twice[0]));
        }
    }
    let Seen { mut angles, scene, warnings, .. } = read.pass.angles(&read.masks, ids)?;
    if matches!(read.masks, Masks::None) {
        angles = vec![angles.remove(0); materials];
    }
    Ok((angles, scene, read.warnings.iter().cloned().chain(warnings).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_shapes_are_named_once_and_impossible_ones_are_a_sentence() {
        let seen = SeenScene::of(vec![4, 7, 9], &Seeing::Shapes(vec![Shape::Sphere, Shape::Cylinder, Shape::Sphere]));
        let seen = seen.unwrap();
        assert_eq!((seen.angles.len(), seen.scene.as_str()), (3, "Sphere; Cylinder"));
        assert_eq!(seen.angles[0], seen.angles[2]);
        let card = Shape::Card { from_deg: 60.0, to_deg: 30.0 };
        assert!(SeenScene::of(vec![1], &Seeing::Shapes(vec![card])).unwrap_err().contains("tilted"));
        let edge = Shape::Card { from_deg: 90.0, to_deg: 90.0 };
        let seen = SeenScene::of(vec![1], &Seeing::Shapes(vec![edge])).unwrap();
        assert!(seen.warnings[0].contains("not seen"), "{:?}", seen.warnings);
    }
}
