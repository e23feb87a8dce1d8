//! The one document of Edgewise.

use serde::{Deserialize, Serialize};

use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{FresnelModel, h_of_schlick, t_from_r_h};
use crate::metal::{Metal, Provenance};
use crate::photo::{Match, Photo, Recipe};

/// A material: two colours a person can see, and where they come from.
#[derive(Clone, Debug, PartialEq)]
pub struct Preset {
    /// The name people read; exporters derive identifiers from it.
    pub name: String,
    /// The space r and h are given in.
    pub space: RgbSpace,
    /// Reflectance facing the surface. Unclamped: measured gold exceeds 1 in linear sRGB.
    pub r: Rgb,
    /// Reflectance at 81.8°.
    pub h: Rgb,
    /// Perceptual roughness, 0 (mirror) to 1; microfacet α is its square.
    pub roughness: f64,
    /// Where r and h come from.
    pub origin: Origin,
    /// Words to find it by.
    pub tags: Vec<String>,
    /// Anything a person wants to remember.
    pub notes: String,
    /// Fields of a file that this version does not know; they survive a save.
    pub unknown_fields: serde_json::Map<String, serde_json::Value>,
}

/// Where the colours of a preset come from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[expect(clippy::large_enum_variant, reason = "there is one for each document")]
pub enum Origin {
    /// Set by a person.
    #[default]
    Authored,
    /// The ground truth of a measured metal.
    Measured {
        /// Identifier of the data set in the library, or the file it was read from.
        metal: String,
        /// Source of the data set.
        provenance: Provenance,
    },
    /// Solved from a photograph.
    Matched(Box<Recipe>),
    /// Changed by hand after it came from elsewhere: no longer measured, yet not from nothing.
    Edited {
        /// Where the colours came from before.
        from: Box<Origin>,
    },
}

impl Preset {
    /// A neutral mid-grey metal on Schlick's curve: a place to start authoring.
    pub fn new_authored() -> Self {
        let r = Rgb::splat(0.6);
        Self {
            name: "New metal".to_owned(),
            space: RgbSpace::LinRec709,
            r,
            h: r.map(h_of_schlick),
            roughness: 0.2,
            origin: Origin::Authored,
            tags: Vec::new(),
            notes: String::new(),
            unknown_fields: serde_json::Map::new(),
        }
    }

    /// The exact r and h of a measured metal.
    pub fn from_metal(metal: &Metal, space: RgbSpace) -> Self {
        Self {
            name: metal.name.clone(),
            r: metal.r(space),
            h: metal.h(space),
            space,
            origin: Origin::Measured { metal: metal.id.clone(), provenance: metal.provenance.clone() },
            tags: vec![metal.category.clone()],
            notes: metal.held_ends().sentence(),
            ..Self::new_authored()
        }
    }

    /// What a match found; `None` unless r and h were measured in every channel. The recipe keeps the rest.
    pub fn from_match(name: &str, photo: &Photo, matched: &Match) -> Option<Self> {
        Some(Self {
            name: name.to_owned(),
            r: matched.complete_r()?,
            h: matched.complete_h()?,
            space: matched.space,
            origin: Origin::Matched(Box::new(matched.recipe(photo))),
            ..Self::new_authored()
        })
    }

    /// To be called when a person changes r or h: what was measured or matched is then edited.
    pub fn mark_edited(&mut self) {
        if !matches!(self.origin, Origin::Measured { .. } | Origin::Matched(_)) {
            return;
        }
        self.origin = Origin::Edited { from: Box::new(std::mem::take(&mut self.origin)) };
        if let Some(of_origin) = self.unknown_fields.get_mut("origin") {
            *of_origin = serde_json::json!({ "kind": "edited", "from": of_origin.take() });
        }
    }

    /// The name as a file name without extension: `Brass, 70 % copper` is `brass-70-copper`.
    pub fn file_stem(&self) -> String {
        super::file_stem(&self.name)
    }

    /// The model the preset stands for, in its own space.
    pub fn model(&self) -> FresnelModel {
        FresnelModel::Hoffman { r: self.r, h: self.h }
    }

    /// t = h / S(r, 1/7) in the preset's space: what F82-tint fields take.
    pub fn tint(&self) -> Rgb {
        self.r.zip(self.h, t_from_r_h)
    }

    /// The same material with r and h given in another space, which changes nothing one can see.
    pub fn in_space(&self, space: RgbSpace) -> Self {
        let convert = |rgb| self.space.convert(rgb, space);
        Self { r: convert(self.r), h: convert(self.h), space, ..self.clone() }
    }
}
