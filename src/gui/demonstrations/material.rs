//! What a demonstration is about: chosen by a person, or the most telling that the window has.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use crate::color::{Rgb, RgbSpace};
use crate::fit::Method;
use crate::gui::state::State;
use crate::metal::Metal;
use crate::preset::Preset;
use crate::study::{Contestants, StudyError, Subject};

/// What a person chose.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Choice {
    /// The open preset, as it is at every moment.
    Preset,
    /// A measured metal.
    Metal(&'static Metal),
    /// A colourless dielectric.
    Dielectric,
    /// Two colours on which every description differs.
    Example,
}

impl Choice {
    /// The name in a list of choices.
    pub(crate) fn label(self, state: &State) -> String {
        match self {
            Self::Preset => format!("The preset: {}", state.document.preset.name),
            Self::Metal(metal) => metal.name.clone(),
            Self::Dielectric => "A dielectric".to_owned(),
            Self::Example => "Example colours".to_owned(),
        }
    }

    /// One sentence about it.
    pub(crate) const fn tooltip(self) -> &'static str {
        match self {
            Self::Preset => "The r and h that are being authored, as they change",
            Self::Metal(_) => "Your own n and k",
            Self::Dielectric => "Glass, paint or plastic, by its refractive index",
            Self::Example => "An r and h on which every description differs",
        }
    }
}

/// Which of the two materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Slot {
    /// The one every demonstration has.
    First,
    /// What the first is blended with, or what a gradient leads to.
    Second,
}

/// A material that is owned, so that a job can take it along.
#[derive(Clone, Debug)]
pub(crate) enum Material {
    /// A measured metal.
    Metal(&'static Metal),
    /// Two colours.
    Colours {
        /// The name people read.
        name: String,
        /// The space of r and h.
        space: RgbSpace,
        /// Reflectance facing the surface.
        r: Rgb,
        /// Reflectance at 81.8°.
        h: Rgb,
    },
    /// A colourless dielectric.
    Dielectric {
        /// Refractive index.
        n: f64,
    },
}

impl PartialEq for Material {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Metal(ours), Self::Metal(theirs)) => std::ptr::eq(*ours, *theirs),
            (Self::Colours { name, space, r, h }, Self::Colours { name: n, space: s, r: r2, h: h2 }) => {
                (name, space, r, h) == (n, s, r2, h2)
            }
            (Self::Dielectric { n }, Self::Dielectric { n: other }) => n == other,
            _ => false,
        }
    }
}

impl Material {
    /// What a choice stands for now; `n` is the index of a dielectric.
    pub(crate) fn of(choice: Choice, preset: &Preset, n: f64) -> Self {
        match choice {
            Choice::Preset => Self::of_preset(preset),
            Choice::Metal(metal) => Self::Metal(metal),
            Choice::Dielectric => Self::Dielectric { n },
            Choice::Example => Self::Colours {
                name: "Example colours".to_owned(),
                space: RgbSpace::AcesCg,
                r: Rgb([0.9, 0.7, 0.4]),
                h: Rgb([0.75, 0.65, 0.5]),
            },
        }
    }

    fn of_preset(preset: &Preset) -> Self {
        Self::Colours { name: preset.name.clone(), space: preset.space, r: preset.r, h: preset.h }
    }

    /// The name people read.
    pub(crate) fn name(&self) -> String {
        self.subject().name()
    }

    /// The material as the studies take it.
    pub(crate) fn subject(&self) -> Subject<'_> {
        match self {
            Self::Metal(metal) => Subject::Metal(metal),
            Self::Colours { name, space, r, h } => Subject::Colours { name, space: *space, r: *r, h: *h },
            Self::Dielectric { n } => Subject::Dielectric { n: *n },
        }
    }
}

/// A material in one space, described by one method.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Described {
    /// The material.
    pub material: Material,
    /// The space of its parameters.
    pub space: RgbSpace,
    /// How n, k and g of a metal are derived.
    pub method: Method,
}

/// How many descriptions are kept: two materials, in a few spaces a person goes back and forth between.
const KEPT: usize = 8;

impl Described {
    /// The truth and the four descriptions. Deriving them takes tens of milliseconds, so the last few are kept.
    pub(crate) fn contestants(&self) -> Result<Arc<Contestants>, StudyError> {
        static LAST: Mutex<VecDeque<(Described, Arc<Contestants>)>> = Mutex::new(VecDeque::new());
        // Held while one is derived: whoever wants the same then finds it. A panic leaves the list whole.
        let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, contestants)) = last.iter().find(|(known, _)| known == self) {
            return Ok(contestants.clone());
        }
        let contestants = Arc::new(Contestants::of(&self.material.subject(), self.space, self.method)?);
        last.push_front((self.clone(), contestants.clone()));
        last.truncate(KEPT);
        Ok(contestants)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;

    #[test]
    fn what_is_kept_is_what_was_asked() {
        let gold = Material::Metal(metal_by_name("gold").unwrap());
        let of = |material: &Material, space| {
            let described = Described { material: material.clone(), space, method: Method::ColourMatching };
            described.contestants().unwrap()
        };
        let (first, again) = (of(&gold, RgbSpace::AcesCg), of(&gold, RgbSpace::AcesCg));
        assert!(Arc::ptr_eq(&first, &again));
        assert_eq!(of(&gold, RgbSpace::LinRec709).space, RgbSpace::LinRec709);
        let glass = |n| of(&Material::Dielectric { n }, RgbSpace::AcesCg).truth[0][0];
        assert!((glass(1.5) - 0.04).abs() < 1e-12 && glass(2.0) > glass(1.5));
    }
}
