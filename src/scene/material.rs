//! A material of a scene, and what it is measured against.

use std::sync::Arc;

use super::Angles;
use crate::metal::Metal;
use crate::preset::Preset;
use crate::study::Subject;

/// What a material of a scene is.
#[derive(Clone, Debug)]
pub enum Source {
    /// A measured metal, of the library or a person's own.
    Metal(Arc<Metal>),
    /// Two colours.
    Preset(Box<Preset>),
}

impl PartialEq for Source {
    /// By what the data are and say of themselves, not by where they are kept.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Metal(a), Self::Metal(b)) => Arc::ptr_eq(a, b) || says_the_same(a, b),
            (Self::Preset(a), Self::Preset(b)) => a == b,
            _ => false,
        }
    }
}

fn says_the_same(a: &Metal, b: &Metal) -> bool {
    (&a.id, &a.name, &a.not_measured, a.table()) == (&b.id, &b.name, &b.not_measured, b.table())
}

/// A material, and the angles at which the scene sees it.
#[derive(Clone, Debug)]
pub struct SceneMaterial {
    /// What it is.
    pub source: Source,
    /// How often each angle is seen. The totals of all materials are their shares of the picture.
    pub angles: Angles,
}

/// What the error of a material is measured against, and what a person should know about it.
pub(super) struct Truth<'a> {
    pub subject: Subject<'a>,
    note: Option<String>,
}

impl<'a> Truth<'a> {
    /// A preset that is a measured metal's is held against the metal, any other against itself.
    pub(super) fn of(source: &'a Source) -> Self {
        let (subject, note) = match source {
            Source::Metal(metal) => (Subject::Metal(metal), None),
            Source::Preset(preset) => Subject::of_preset(preset),
        };
        Self { subject, note }
    }

    /// The metal, where it is one.
    pub(super) fn metal(&self) -> Option<&'a Metal> {
        if let Subject::Metal(metal) = self.subject { Some(metal) } else { None }
    }

    /// Sentences about the data.
    pub(super) fn notes(&self) -> impl Iterator<Item = String> + '_ {
        let held = self.metal().map(|metal| metal.held_ends().sentence()).filter(|sentence| !sentence.is_empty());
        held.into_iter().chain(self.note.clone())
    }
}
