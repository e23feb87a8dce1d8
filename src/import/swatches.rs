//! Colours of a palette as metals: "<name> r" with "<name> h", or a colour alone.

use super::ImportError;
use super::imported::{Found, Imported, hoffman};
use crate::color::{Rgb, RgbSpace, srgb_decode};
use crate::fresnel::h_of_schlick;

/// A named sRGB colour, encoded.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Colour {
    pub name: String,
    pub srgb: Rgb,
}

/// Pairs become presets of r and h; a colour alone is r, with Schlick's h, and a note.
pub(super) fn presets(colours: Vec<Colour>, file: &'static str) -> Result<Imported, ImportError> {
    if colours.is_empty() {
        return Err(ImportError::NoMetal(file));
    }
    let mut imported = Imported::default();
    let mut alone = 0;
    let mut colours = colours.into_iter().peekable();
    while let Some(colour) = colours.next() {
        let metal = colour.name.strip_suffix(" r").map(str::to_owned);
        let edge = metal.as_ref().map(|metal| format!("{metal} h"));
        let partner = colours.next_if(|next| Some(&next.name) == edge.as_ref());
        let r = colour.srgb.map(srgb_decode);
        let (name, h) = match (metal, partner) {
            (Some(metal), Some(partner)) => (metal, partner.srgb.map(srgb_decode)),
            _ => {
                alone += 1;
                (colour.name, r.map(h_of_schlick))
            }
        };
        imported.add(Found { name, space: RgbSpace::LinRec709, model: hoffman(r, h), roughness: None })?;
    }
    if alone > 0 {
        imported
            .notes
            .push(format!("{alone} colours have no partner for the edge; their h is that of Schlick's curve"));
    }
    Ok(imported)
}
