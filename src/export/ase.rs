//! Adobe Swatch Exchange 1.0, big-endian.

use super::export::Written;
use super::swatch::Swatch;

const COLOR_ENTRY: u16 = 0x0001;
/// "Normal", as opposed to global and spot.
const NORMAL_COLOR: u16 = 2;

/// A block for each colour: name in UTF-16 with a zero, model `RGB `, three floats, the kind.
pub(super) fn write(swatches: &[Swatch]) -> Written {
    let mut bytes = b"ASEF\x00\x01\x00\x00".to_vec();
    bytes.extend(u32::try_from(swatches.len())?.to_be_bytes());
    for Swatch { name, srgb } in swatches {
        let mut block = Vec::new();
        let name: Vec<u16> = name.encode_utf16().chain([0]).collect();
        block.extend(u16::try_from(name.len())?.to_be_bytes());
        block.extend(name.iter().flat_map(|unit| unit.to_be_bytes()));
        block.extend(b"RGB ");
        block.extend(srgb.0.iter().flat_map(|&v| (v as f32).to_be_bytes()));
        block.extend(NORMAL_COLOR.to_be_bytes());
        bytes.extend(COLOR_ENTRY.to_be_bytes());
        bytes.extend(u32::try_from(block.len())?.to_be_bytes());
        bytes.extend(block);
    }
    Ok(bytes)
}
