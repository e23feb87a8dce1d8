//! What a plan is made for: the materials with where they are seen, and what is allowed.

use std::path::PathBuf;

use super::Same;
use super::material::{Entry, PathField, PlanMaterial, Resolved, SavedSight};
use super::seeing::{Apart, ApartFiles, PassFiles, Sight};
use crate::color::RgbSpace;
use crate::gui::demonstrations::Told;
use crate::metal::{metal_by_name, preferred_metals};
use crate::preset::Preset;
use crate::scene::{Place, Plan, SavedMaterial, SavedPass, SavedScene, Shape, Target, Tolerance};

/// A scene and the choices for it.
#[derive(Clone, PartialEq)]
pub(crate) struct PlanScene {
    entries: Vec<Entry>,
    /// Whether a rendered pass says where materials are seen.
    pub has_pass: bool,
    /// The pass.
    pub pass: PathField,
    /// The channel of the pass; the likeliest where it is empty.
    pub channel: String,
    /// How its materials are told apart.
    pub apart: Apart,
    /// The picture of ids.
    pub ids: PathField,
    /// What is allowed.
    pub tolerance: Tolerance,
    /// What is spared.
    pub target: Target,
    /// The space of parameters and differences.
    pub space: RgbSpace,
    /// The pass of the file that entries have their saved angles from.
    saved_pass: Option<SavedPass>,
}

/// What a new window plans for: where a metal is seen decides as much as which it is.
const TELLING: [(&str, Shape); 4] = [
    ("Gold", Shape::Card { from_deg: 0.0, to_deg: 60.0 }),
    ("Copper", Shape::Sphere),
    ("Chromium", Shape::Floor { eye_m: 1.7, near_m: 1.0, far_m: 20.0 }),
    ("Zinc", Shape::Sphere),
];

impl Default for PlanScene {
    fn default() -> Self {
        let mut scene = Self {
            entries: Vec::new(),
            has_pass: false,
            pass: PathField::default(),
            channel: String::new(),
            apart: Apart::default(),
            ids: PathField::default(),
            tolerance: Tolerance::default(),
            target: Target::default(),
            space: RgbSpace::default(),
            saved_pass: None,
        };
        for (name, shape) in TELLING {
            if let Ok(metal) = metal_by_name(name) {
                scene.add(PlanMaterial::Metal(metal), shape, None);
            }
        }
        scene
    }
}

impl PlanScene {
    /// The scene of a file, with what its plan was made for. What a pass showed is seen as it was saved, and the files of
    /// the pass are there to be read again.
    pub(super) fn of_saved(saved: &SavedScene, plan: &Plan) -> Self {
        let pass = saved.pass.as_ref();
        let text = |file: Option<&String>| file.map(PathField::of).unwrap_or_default();
        let mut scene = Self {
            entries: Vec::with_capacity(saved.materials.len()),
            has_pass: false,
            pass: text(pass.map(|pass| &pass.file)),
            channel: pass.and_then(|pass| pass.channel.clone()).unwrap_or_default(),
            apart: Apart::default(),
            ids: text(pass.and_then(|pass| pass.ids.as_ref())),
            tolerance: plan.tolerance,
            target: plan.target,
            space: plan.space,
            saved_pass: saved.pass.clone(),
        };
        saved.materials.iter().for_each(|material| scene.add_saved(material));
        scene
    }

    fn add_saved(&mut self, saved: &SavedMaterial) {
        let SavedMaterial { source, file, place, angles } = saved;
        let sight = || Some(Same(SavedSight { place: place.clone(), angles: angles.clone() }.into()));
        let shape = if let Place::Shape(shape) = place { *shape } else { Shape::Sphere };
        self.add(PlanMaterial::of(source), shape, file.clone());
        let Some(entry) = self.entries.last_mut() else { return };
        match place {
            Place::Shape(_) => {}
            Place::Whole => entry.saved = sight(),
            Place::Id(id) => {
                (entry.saved, entry.object_id) = (sight(), *id);
                self.apart = Apart::Ids;
            }
            Place::Matte(file) => {
                (entry.saved, entry.matte) = (sight(), PathField::of(file));
                self.apart = Apart::Mattes;
            }
        }
        entry.is_as_saved = entry.saved.is_some();
    }

    /// The materials.
    pub(crate) fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// A material, to be seen elsewhere.
    pub(crate) fn entry_mut(&mut self, index: usize) -> Option<&mut Entry> {
        self.entries.get_mut(index)
    }

    /// Adds a material at the end.
    pub(super) fn add(&mut self, material: PlanMaterial, shape: Shape, file: Option<String>) {
        let object_id = self.entries.iter().map(|entry| entry.object_id).max().unwrap_or(0).saturating_add(1);
        self.entries.push(Entry::new(material, shape, object_id, file));
    }

    /// Adds every metal of the library that is not in the list.
    pub(crate) fn add_all_metals(&mut self) {
        for metal in preferred_metals().map(PlanMaterial::Metal) {
            if !self.entries.iter().any(|entry| entry.material == metal) {
                self.add(metal, Shape::Sphere, None);
            }
        }
    }

    /// Takes a material off the list.
    pub(super) fn remove(&mut self, index: usize) {
        self.entries.remove(index);
    }

    /// Empties the list.
    pub(super) fn clear(&mut self) {
        self.entries.clear();
    }

    /// The matte of an entry.
    pub(super) fn matte_mut(&mut self, id: u64) -> Option<&mut PathField> {
        self.entries.iter_mut().find(|entry| entry.id == id).map(|entry| &mut entry.matte)
    }

    /// True where some entry is seen as the file of a plan says.
    pub(crate) fn is_as_saved_somewhere(&self) -> bool {
        self.entries.iter().any(|entry| entry.is_as_saved)
    }

    /// What tells entries apart, in their order.
    pub(super) fn keys(&self) -> Vec<u64> {
        self.entries.iter().map(|entry| entry.id).collect()
    }

    /// The materials as they are now.
    pub(super) fn resolved(&self, open: &Preset) -> Vec<Resolved> {
        self.entries.iter().map(|entry| entry.material.resolved(open)).collect()
    }

    /// The files that materials were read from.
    pub(super) fn files(&self) -> Vec<Option<String>> {
        self.entries.iter().map(|entry| entry.file.clone()).collect()
    }

    /// Where each is seen without a pass that is read, and the pass that was read for some of them.
    pub(super) fn sights(&self) -> (Vec<Sight>, Option<SavedPass>) {
        (self.entries.iter().map(Entry::sight).collect(), self.saved_pass.clone())
    }

    /// The number of each in the picture of ids.
    pub(super) fn object_ids(&self) -> Vec<u32> {
        self.entries.iter().map(|entry| entry.object_id).collect()
    }

    /// The files of the pass, or what is missing.
    pub(super) fn pass_files(&self, reads: u64) -> Told<PassFiles> {
        let Some(pass) = self.pass.path() else {
            return Err("Choose a facing-ratio pass: the cosine between normal and view, as OpenEXR or PNG".to_owned());
        };
        let apart = match self.apart {
            Apart::Whole => ApartFiles::Whole,
            Apart::Ids => match self.ids.path() {
                Some(ids) => ApartFiles::Ids(ids.clone()),
                None => return Err("Choose the picture of ids that belongs to the pass".to_owned()),
            },
            Apart::Mattes => {
                let mattes: Option<Vec<PathBuf>> =
                    self.entries.iter().map(|entry| entry.matte.path().cloned()).collect();
                ApartFiles::Mattes(mattes.ok_or("Choose a matte for every material")?)
            }
        };
        let channel = Some(self.channel.trim().to_owned()).filter(|channel| !channel.is_empty());
        Ok(PassFiles { pass: pass.clone(), channel, apart, reads })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{PlanOptions, plan_scene};
    use crate::study::no_progress;

    #[test]
    fn a_scene_of_a_file_is_seen_as_it_was_and_its_pass_can_be_read_again() {
        let card = Shape::Card { from_deg: 0.0, to_deg: 30.0 };
        let gold = PlanMaterial::Metal(metal_by_name("gold").unwrap()).resolved(&Preset::new_authored()).source();
        let material = |place, angles| SavedMaterial { source: gold.clone(), file: None, place, angles };
        let pass = SavedPass {
            file: "/shots/facing.exr".to_owned(),
            channel: None,
            ids: Some("/shots/ids.exr".to_owned()),
            found: "facing.exr".to_owned(),
        };
        let saved = SavedScene {
            materials: vec![
                material(Place::Shape(card), card.angles()),
                material(Place::Id(9), Shape::Sphere.angles()),
            ],
            pass: Some(pass),
        };
        let plan = plan_scene(&saved.scene_materials(), "", &PlanOptions::default(), &no_progress).unwrap();
        let mut scene = PlanScene::of_saved(&saved, &plan);
        let (sights, _) = scene.sights();
        assert!(matches!(sights[0], Sight::Shape(shape) if shape == card) && matches!(sights[1], Sight::Saved(_)));
        assert!(scene == scene.clone() && scene.is_as_saved_somewhere());
        let files = scene.pass_files(0).unwrap();
        assert_eq!(files.pass, PathBuf::from("/shots/facing.exr"));
        assert_eq!((files.apart, scene.object_ids()), (ApartFiles::Ids("/shots/ids.exr".into()), vec![1, 9]));
        let before = scene.clone();
        scene.entry_mut(1).unwrap().is_as_saved = false;
        assert!(scene != before && !scene.is_as_saved_somewhere());
    }
}
