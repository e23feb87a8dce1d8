//! A JPEG at an eighth of its size, from the means of its 8×8 blocks: a first look while the whole is decoded.

use jpeg_decoder::{CodingProcess, Decoder, PixelFormat};

use super::colour::{Claim, Colour};
use super::exif::Exif;
use super::{Decoded, limits};
use crate::photo::samples::Samples;

/// The small picture and the full size as stored; `None` where it would take as long as the whole, and where the
/// whole is not read either. It is a look, not data: means are taken over codes, and nothing is warned of.
pub(super) fn decode(bytes: &[u8]) -> Option<(Decoded, [u32; 2])> {
    let mut decoder = Decoder::new(bytes);
    decoder.read_info().ok()?;
    let info = decoder.info()?;
    let channels = match info.pixel_format {
        PixelFormat::L8 => 1,
        PixelFormat::RGB24 => 3,
        PixelFormat::L16 | PixelFormat::CMYK32 => return None,
    };
    // A progressive file would have all its coefficients in memory, twice with the whole.
    if info.coding_process != CodingProcess::DctSequential {
        return None;
    }
    let full = limits::check_size(info.width.into(), info.height.into(), channels).ok()?;
    let exif = Exif::read(decoder.exif_data());
    let icc = decoder.icc_profile().map(Claim::Icc);
    decoder.scale(info.width.div_ceil(8), info.height.div_ceil(8)).ok()?;
    let samples = decoder.decode().ok()?;
    let info = decoder.info()?;
    let size = [u32::from(info.width), u32::from(info.height)];
    let decoded = Decoded {
        samples: Samples::U8(samples),
        channels: channels as usize,
        size,
        orientation: exif.orientation,
        colour: Colour { claims: icc.into_iter().chain(exif.claim).collect() },
        layers: Vec::new(),
        warnings: Vec::new(),
    };
    Some((decoded, full))
}
