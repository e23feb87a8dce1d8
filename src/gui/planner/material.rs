//! What a plan is made for: a material, and where the scene shows it.

use std::path::PathBuf;
use std::sync::Arc;

use crate::metal::Metal;
use crate::preset::Preset;
use crate::scene::{Shape, Source};
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

impl PlanMaterial {
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

/// A material of the list with where it is seen: each way is kept, whichever the scene goes.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    /// Never given to another entry.
    pub id: u64,
    /// The material.
    pub material: PlanMaterial,
    /// Where it is seen without a pass.
    pub shape: Shape,
    /// Its number in a picture of ids.
    pub object_id: u32,
    /// The picture of its share of each pixel.
    pub matte: PathField,
}

/// A path that is typed, and the one that counts since it was entered.
#[derive(Clone, Debug, Default)]
pub(crate) struct PathField {
    /// What is typed.
    pub text: String,
    path: Option<PathBuf>,
}

impl PathField {
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
