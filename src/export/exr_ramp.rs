//! The curve as a picture one pixel high.

use std::io::Cursor;

use exr::prelude::*;

use super::export::Written;
use super::material::Material;
use super::names::one_ascii_line;
use super::sampling::{RAMP_WIDTH, texel_centre};
use crate::color::{Chromaticity, RgbSpace};

/// Column i is F at cos θ = (i + 0.5) / width, the centre of its texel; 32-bit, unclamped.
pub(super) fn write(header: &[String], material: &Material<'_>) -> Written {
    let column = |Vec2(x, _): Vec2<usize>| {
        let [red, green, blue] = material.form.reflectance(texel_centre(x as f64)).0.map(|v| v as f32);
        (red, green, blue)
    };
    let mut image = Image::from_channels((RAMP_WIDTH as usize, 1), SpecificChannels::rgb(column));
    image.attributes.chromaticities = Some(chromaticities(material.space));
    let comments: Vec<String> = header.iter().map(|line| one_ascii_line(line)).collect();
    image.layer_data.attributes.comments = Text::new_or_none(comments.join("\n"));
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}

fn chromaticities(space: RgbSpace) -> exr::meta::attribute::Chromaticities {
    let xy = |c: Chromaticity| Vec2(c.x as f32, c.y as f32);
    let [red, green, blue] = space.primaries().map(xy);
    exr::meta::attribute::Chromaticities { red, green, blue, white: xy(space.white()) }
}
