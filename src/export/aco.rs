//! Photoshop colour swatches: version 1, and after it version 2 with names.

use super::export::Written;
use super::swatch::Swatch;

/// The colour space number of RGB.
const RGB: u16 = 0;

/// Both versions in one file, as Photoshop writes it: old readers stop after the first.
pub(super) fn write(swatches: &[Swatch]) -> Written {
    let count = u16::try_from(swatches.len())?;
    let mut bytes = Vec::new();
    for version in [1_u16, 2] {
        bytes.extend(version.to_be_bytes());
        bytes.extend(count.to_be_bytes());
        for swatch in swatches {
            bytes.extend(color(swatch));
            if version == 2 {
                let name: Vec<u16> = swatch.name.encode_utf16().chain([0]).collect();
                bytes.extend(u32::try_from(name.len())?.to_be_bytes());
                bytes.extend(name.iter().flat_map(|unit| unit.to_be_bytes()));
            }
        }
    }
    Ok(bytes)
}

/// The space, three 16-bit channels and an unused fourth.
fn color(swatch: &Swatch) -> impl Iterator<Item = u8> {
    let [red, green, blue] = swatch.srgb.0.map(|v| (v * 65_535.0).round() as u16);
    [RGB, red, green, blue, 0].into_iter().flat_map(u16::to_be_bytes)
}
