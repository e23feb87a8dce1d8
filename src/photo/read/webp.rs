//! WebP, lossy and lossless.

use std::io::Cursor;

use image::codecs::webp::WebPDecoder;
use image::{ColorType, ImageDecoder, ImageError};

use super::alpha::Opaque;
use super::colour::{Claim, Colour};
use super::exif::Exif;
use super::{Decoded, Progress, limits, report, several};
use crate::photo::PhotoErrorKind;
use crate::photo::samples::Samples;

fn damaged(error: ImageError) -> PhotoErrorKind {
    PhotoErrorKind::damaged("WebP")(&error)
}

/// Decodes the picture, or the first frame of an animation.
pub(super) fn decode(bytes: &[u8], progress: Progress<'_>) -> Result<Decoded, PhotoErrorKind> {
    // The container says its length (RFC 9649, section 2.4).
    let length = bytes.get(4..).and_then(|rest| rest.first_chunk()).map(|length| u32::from_le_bytes(*length));
    if length.is_none_or(|length| u64::from(length) + 8 > bytes.len() as u64) {
        return Err(PhotoErrorKind::damaged("WebP")(&"its end is missing"));
    }
    let mut decoder = WebPDecoder::new(Cursor::new(bytes)).map_err(damaged)?;
    let (width, height) = decoder.dimensions();
    let channels: usize = if decoder.color_type() == ColorType::Rgba8 { 4 } else { 3 };
    // The decoder keeps a second copy with alpha.
    let size = limits::check_size(width.into(), height.into(), channels as u64 + 4)?;
    report(progress, 0, 1)?;

    let animated = decoder.has_animation().then(|| several("frames"));
    let icc = decoder.icc_profile().unwrap_or_else(|_| Some(Vec::new())).map(Claim::Icc);
    let exif = Exif::read(decoder.exif_metadata().unwrap_or_else(|_| Some(Vec::new())).as_deref());
    let count = size[0] as usize * size[1] as usize * channels;
    let mut samples = limits::reserve(count)?;
    samples.resize(count, 0);
    decoder.read_image(&mut samples).map_err(damaged)?;
    report(progress, 1, 1)?;

    let mut alpha = None;
    if channels == 4 {
        let mut opaque = Opaque::new(limits::reserve(samples.len() / 4 * 3)?, channels, false);
        opaque.extend(&samples);
        alpha = opaque.warning();
        samples = opaque.samples;
    }
    Ok(Decoded {
        samples: Samples::U8(samples),
        channels: 3,
        size,
        orientation: exif.orientation,
        colour: Colour { claims: icc.into_iter().chain(exif.claim).collect() },
        layers: Vec::new(),
        warnings: animated.into_iter().chain(alpha).chain(exif.warning).collect(),
    })
}
