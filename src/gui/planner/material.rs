//! What a plan is made for: a material, and where the scene shows it.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::Same;
use super::seeing::Sight;
use crate::metal::{Metal, metals};
use crate::preset::Preset;
use crate::scene::{Angles, Place, Shape, Source};
use crate::study::Subject;

/// A material of the list.
#[derive(Clone, Debug)]
pub(crate) enum PlanMaterial {
    /// The open preset, as it is at every moment.
    Open,
    /// A measured metal.
    Metal(&'static Metal),
    /// A preset of a file.
    Preset(Arc<Preset>),
}

impl PartialEq for PlanMaterial {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Open, Self::Open) => true,
            (Self::Metal(ours), Self::Metal(theirs)) => std::ptr::eq(*ours, *theirs),
            (Self::Preset(ours), Self::Preset(theirs)) => Arc::ptr_eq(ours, theirs) || ours == theirs,
            _ => false,
        }
    }
}

impl PlanMaterial {
    /// The material of a plan's file.
    pub(super) fn of(source: &Source) -> Self {
        match source {
            Source::Metal(own) => {
                let is_own = |metal: &&Metal| metal.id == own.id && metal.table() == own.table();
                Self::Metal(metals().iter().find(is_own).unwrap_or_else(|| for_ever((**own).clone())))
            }
            Source::Preset(preset) => Self::Preset(Arc::new((**preset).clone())),
        }
    }

    /// The name people read.
    pub(crate) fn name<'a>(&'a self, open: &'a Preset) -> &'a str {
        match self {
            Self::Open => &open.name,
            Self::Metal(metal) => &metal.name,
            Self::Preset(preset) => &preset.name,
        }
    }

    /// What it stands for now.
    pub(super) fn resolved(&self, open: &Preset) -> Resolved {
        match self {
            Self::Open => Resolved::Preset(Arc::new(open.clone())),
            Self::Metal(metal) => Resolved::Metal(metal),
            Self::Preset(preset) => Resolved::Preset(preset.clone()),
        }
    }
}

/// As long as the program runs: the list, plans and charts refer to a person's own data.
pub(super) fn for_ever(metal: Metal) -> &'static Metal {
    Box::leak(Box::new(metal))
}

/// A material that is owned, so that a job can take it along and know it again.
#[derive(Clone, Debug)]
pub(crate) enum Resolved {
    /// A measured metal.
    Metal(&'static Metal),
    /// A preset.
    Preset(Arc<Preset>),
    /// A preset that ships with the program.
    BuiltIn(&'static Preset),
}

impl PartialEq for Resolved {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Metal(ours), Self::Metal(theirs)) => std::ptr::eq(*ours, *theirs),
            (Self::Preset(ours), Self::Preset(theirs)) => Arc::ptr_eq(ours, theirs) || ours == theirs,
            (Self::BuiltIn(ours), Self::BuiltIn(theirs)) => std::ptr::eq(*ours, *theirs),
            _ => false,
        }
    }
}

impl Resolved {
    /// The material as the planner takes it.
    pub(super) fn source(&self) -> Source {
        match self {
            Self::Metal(metal) => Source::Metal(Arc::new((*metal).clone())),
            Self::Preset(preset) => Source::Preset(Box::new((**preset).clone())),
            Self::BuiltIn(preset) => Source::Preset(Box::new((*preset).clone())),
        }
    }

    /// The material as the studies take it: a preset that is a measured metal's is the metal.
    pub(super) fn subject(&self) -> Subject<'_> {
        match self {
            Self::Metal(metal) => Subject::Metal(metal),
            Self::Preset(preset) => Subject::of_preset(preset).0,
            Self::BuiltIn(preset) => Subject::of_preset(preset).0,
        }
    }
}

/// Where a saved plan shows a material, and how often it is seen there at each angle.
pub(crate) struct SavedSight {
    /// Where.
    pub place: Place,
    /// How often.
    pub angles: Angles,
}

/// A material of the list with where it is seen: each way is kept, whichever the scene goes.
#[derive(Clone, PartialEq)]
pub(crate) struct Entry {
    /// Never given to another entry.
    pub id: u64,
    /// The material.
    pub material: PlanMaterial,
    /// The file that it was read from.
    pub file: Option<String>,
    /// Where it is seen without a pass.
    pub shape: Shape,
    /// Where the pass of a saved plan shows it.
    pub saved: Option<Same<SavedSight>>,
    /// Whether that counts in place of the shape.
    pub is_as_saved: bool,
    /// Its number in a picture of ids.
    pub object_id: u32,
    /// The picture of its share of each pixel.
    pub matte: PathField,
}

impl Entry {
    pub(super) fn new(material: PlanMaterial, shape: Shape, object_id: u32, file: Option<String>) -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let id = NEXT.fetch_add(1, Ordering::Relaxed);
        Self { id, material, file, shape, saved: None, is_as_saved: false, object_id, matte: PathField::default() }
    }

    /// Where it is seen without a pass that is read.
    pub(super) fn sight(&self) -> Sight {
        match &self.saved {
            Some(saved) if self.is_as_saved => Sight::Saved(saved.clone()),
            _ => Sight::Shape(self.shape),
        }
    }
}

/// A path that is typed, and the one that counts since it was entered.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct PathField {
    /// What is typed.
    pub text: String,
    path: Option<PathBuf>,
}

impl PathField {
    /// A path of a plan's file.
    pub(super) fn of(text: &String) -> Self {
        Self { text: text.clone(), path: Some(PathBuf::from(text)) }
    }

    /// The path that was entered last.
    pub(crate) fn path(&self) -> Option<&PathBuf> {
        self.path.as_ref()
    }

    /// Lets what is typed count.
    pub(crate) fn enter(&mut self) {
        let text = self.text.trim();
        self.path = (!text.is_empty()).then(|| PathBuf::from(text));
    }

    /// Takes the path of a file that was chosen.
    pub(super) fn set(&mut self, path: PathBuf) {
        self.text = path.display().to_string();
        self.path = Some(path);
    }
}
