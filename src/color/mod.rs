//! Linear colour: triples, spaces, adaptation, differences and the ways people write colours down.

mod ciede2000;
mod encoding;
mod lab;
mod rgb;
#[cfg(test)]
mod sharma;
mod space;
mod unknown_name;
mod xyz;

pub use ciede2000::{delta_e_2000, delta_e_rgb};
pub use encoding::{
    HexError, hex_from_srgb8, linear_from_srgb8, oklch_from_rgb, rgb_from_oklch, srgb_decode, srgb_encode, srgb8,
    srgb8_from_hex,
};
pub use lab::{Lab, lightness_from_luminance, luminance_from_lightness};
pub use rgb::Rgb;
#[cfg(test)]
pub(crate) use sharma::SHARMA;
pub use space::RgbSpace;
pub use unknown_name::UnknownName;
pub use xyz::{Chromaticity, Xyz, bradford, xyz_from_primaries};
