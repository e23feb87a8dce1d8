//! Where the materials are seen: on simple shapes, or in a rendered facing-ratio pass.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Same;
use super::material::SavedSight;
use crate::gui::demonstrations::Told;
use crate::gui::job::Progress;
use crate::photo::{Plane, PlaneKind};
use crate::scene::{Angles, FacingPass, Masks, Place, SavedPass, Seen, Shape, kept_path, scene_sentence};

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
    files: PassFiles,
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
        Ok(Arc::new(Self { files: files.clone(), pass: FacingPass { ratio }, masks, warnings }))
    }

    fn places(&self, ids: &[u32]) -> Vec<Place> {
        match &self.files.apart {
            ApartFiles::Whole => vec![Place::Whole; ids.len()],
            ApartFiles::Ids(_) => ids.iter().map(|id| Place::Id(*id)).collect(),
            ApartFiles::Mattes(paths) => paths.iter().map(|path| Place::Matte(kept_path(path))).collect(),
        }
    }

    fn saved(&self, found: String) -> SavedPass {
        let PassFiles { pass, channel, apart, .. } = &self.files;
        let ids = if let ApartFiles::Ids(path) = apart { Some(kept_path(path)) } else { None };
        SavedPass { file: kept_path(pass), channel: channel.clone(), ids, found }
    }
}

/// Where one material is seen without a pass that is read.
#[derive(Clone, PartialEq)]
pub(super) enum Sight {
    Shape(Shape),
    /// As the file of a plan says.
    Saved(Same<SavedSight>),
}

/// What the materials are looked for in.
#[derive(Clone, PartialEq)]
pub(super) enum Seeing {
    /// Each by itself, and the pass of what is as saved.
    Each(Vec<Sight>, Option<SavedPass>),
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
    /// One for each.
    pub places: Vec<Place>,
    /// The pass that some of them are seen in.
    pub pass: Option<SavedPass>,
    /// Where the angles come from, in a sentence.
    pub scene: String,
    /// What a person should know.
    pub warnings: Vec<String>,
}

impl SeenScene {
    pub(super) fn of(entries: Vec<u64>, seeing: &Seeing) -> Told<Arc<Self>> {
        let Found { angles, places, pass, warnings } = match seeing {
            Seeing::Each(sights, pass) => each(sights, pass.as_ref())?,
            Seeing::Pass(read, ids) => in_pass(&read.0, ids)?,
        };
        let scene = scene_sentence(pass.as_ref().map(|pass| pass.found.as_str()), &places);
        Ok(Arc::new(Self { entries, angles, places, pass, scene, warnings }))
    }
}

struct Found {
    angles: Vec<Angles>,
    places: Vec<Place>,
    pass: Option<SavedPass>,
    warnings: Vec<String>,
}

/// Beside what a pass showed, a shape takes as much of the picture as one of these on average.
fn each(sights: &[Sight], pass: Option<&SavedPass>) -> Told<Found> {
    let saved: Vec<&SavedSight> = sights
        .iter()
        .filter_map(|sight| if let Sight::Saved(saved) = sight { Some(&*saved.0) } else { None })
        .collect();
    let total: f64 = saved.iter().map(|saved| saved.angles.total()).sum();
    let weight = if total > 0.0 { total / saved.len() as f64 } else { 1.0 };
    let pass = pass.filter(|_| !saved.is_empty()).cloned();
    let mut known: Vec<(Shape, Angles)> = Vec::new();
    let mut found = Found { angles: Vec::new(), places: Vec::new(), pass, warnings: Vec::new() };
    for sight in sights {
        let (place, angles) = match sight {
            Sight::Saved(saved) => (saved.0.place.clone(), saved.0.angles.clone()),
            Sight::Shape(shape) => (Place::Shape(*shape), on_shape(*shape, weight, &mut known)?),
        };
        found.places.push(place);
        found.angles.push(angles);
    }
    found.warnings.extend(known.iter().filter_map(|(shape, _)| shape.warning()));
    Ok(found)
}

fn on_shape(shape: Shape, weight: f64, known: &mut Vec<(Shape, Angles)>) -> Told<Angles> {
    let shape = shape.checked().map_err(|error| error.to_string())?;
    if let Some((_, angles)) = known.iter().find(|(other, _)| *other == shape) {
        return Ok(angles.clone());
    }
    let angles = shape.angles().times(weight);
    known.push((shape, angles.clone()));
    Ok(angles)
}

fn in_pass(read: &ReadPass, ids: &[u32]) -> Told<Found> {
    if matches!(read.masks, Masks::Ids(_)) {
        let mut sorted = ids.to_vec();
        sorted.sort_unstable();
        if let Some(twice) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(format!("The id {} is given to two materials", twice[0]));
        }
    }
    let Seen { mut angles, scene, warnings, .. } = read.pass.angles(&read.masks, ids)?;
    if matches!(read.masks, Masks::None) {
        angles = vec![angles.remove(0); ids.len()];
    }
    let warnings = read.warnings.iter().cloned().chain(warnings).collect();
    Ok(Found { angles, places: read.places(ids), pass: Some(read.saved(scene)), warnings })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on(shapes: &[Shape]) -> Told<Arc<SeenScene>> {
        let sights = shapes.iter().map(|shape| Sight::Shape(*shape)).collect();
        SeenScene::of((0..shapes.len() as u64).collect(), &Seeing::Each(sights, None))
    }

    #[test]
    fn equal_shapes_are_named_once_and_impossible_ones_are_a_sentence() {
        let seen = on(&[Shape::Sphere, Shape::Cylinder, Shape::Sphere]).unwrap();
        assert_eq!((seen.angles.len(), seen.scene.as_str()), (3, "Sphere; Cylinder"));
        assert_eq!(seen.angles[0], seen.angles[2]);
        assert_eq!(seen.angles[0], Shape::Sphere.angles());
        let card = Shape::Card { from_deg: 60.0, to_deg: 30.0 };
        assert!(on(&[card]).unwrap_err().contains("tilted"));
        let edge = Shape::Card { from_deg: 90.0, to_deg: 90.0 };
        assert!(on(&[edge]).unwrap().warnings[0].contains("not seen"));
    }

    #[test]
    fn a_shape_beside_a_saved_pass_takes_its_share() {
        let saved = |pixels| {
            let angles = Shape::Cylinder.angles().times(pixels);
            Sight::Saved(Same(SavedSight { place: Place::Whole, angles }.into()))
        };
        let pass = SavedPass { file: "a.exr".to_owned(), channel: None, ids: None, found: "a.exr: 400".to_owned() };
        let sights = vec![saved(300.0), Sight::Shape(Shape::Sphere), saved(100.0)];
        let seen = SeenScene::of(vec![1, 2, 3], &Seeing::Each(sights, Some(pass.clone()))).unwrap();
        assert!((seen.angles[1].total() - 200.0).abs() < 1e-9);
        assert_eq!((seen.scene.as_str(), &seen.pass), ("a.exr: 400; Sphere", &Some(pass.clone())));
        let shapes = Seeing::Each(vec![Sight::Shape(Shape::Sphere)], Some(pass));
        assert_eq!(SeenScene::of(vec![1], &shapes).unwrap().pass, None, "nothing is seen in it any more");
    }
}
