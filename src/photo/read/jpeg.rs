//! JPEG, 8 bits, grey or three channels.

use std::cell::Cell;

use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;
use zune_jpeg::errors::DecodeErrors;

use super::colour::{Claim, Colour};
use super::exif::Exif;
use super::watched::Watched;
use super::{Decoded, Progress, limits};
use crate::photo::PhotoErrorKind;
use crate::photo::samples::Samples;

fn damaged(error: DecodeErrors) -> PhotoErrorKind {
    match error {
        DecodeErrors::Unsupported(scheme) => PhotoErrorKind::Unsupported {
            what: format!("a JPEG of an uncommon kind ({scheme:?})"),
            advice: "save it as an ordinary JPEG, PNG or TIFF",
        },
        error => PhotoErrorKind::damaged("JPEG")(&format!("{error:?}")),
    }
}

/// Decodes a JPEG. Between markers it is lenient, as cameras are; in the pixels it is strict, since what a
/// decoder fills in must not be measured.
pub(super) fn decode(bytes: &[u8], progress: Progress<'_>) -> Result<Decoded, PhotoErrorKind> {
    let is_cancelled = Cell::new(false);
    let decoded = decode_watched(bytes, Watched::new(bytes, progress, &is_cancelled));
    if is_cancelled.get() { Err(PhotoErrorKind::Cancelled) } else { decoded }
}

/// What a header may hold.
fn lenient() -> DecoderOptions {
    DecoderOptions::default().set_max_width(usize::MAX).set_max_height(usize::MAX).set_strict_mode(false)
}

fn decode_watched(bytes: &[u8], watched: Watched<'_>) -> Result<Decoded, PhotoErrorKind> {
    let mut decoder = JpegDecoder::new_with_options(watched, lenient());
    decoder.decode_headers().map_err(damaged)?;
    let info = decoder.info().ok_or_else(|| PhotoErrorKind::damaged("JPEG")(&"it has no header"))?;
    let channels = match info.components {
        1 => 1,
        3 => 3,
        4 => return Err(four_channels()),
        count => return Err(PhotoErrorKind::damaged("JPEG")(&format!("{count} channels"))),
    };
    let size = limits::check_size(info.width.into(), info.height.into(), channels)?;
    if !ends_properly(bytes) {
        return Err(PhotoErrorKind::damaged("JPEG")(&"its end is missing"));
    }
    let output = if channels == 1 { ColorSpace::Luma } else { ColorSpace::RGB };
    decoder.set_options(lenient().set_strict_mode(true).jpeg_set_out_colorspace(output));
    let exif = Exif::read(decoder.exif().map(Vec::as_slice));
    let icc = icc(&decoder, bytes);
    let mut samples = limits::zeros(size[0] as usize * size[1] as usize * channels as usize)?;
    decoder.decode_into(&mut samples).map_err(damaged)?;

    Ok(Decoded {
        samples: Samples::U8(samples),
        channels: channels as usize,
        size,
        orientation: exif.orientation,
        colour: Colour { claims: icc.into_iter().chain(exif.claim).collect() },
        layers: Vec::new(),
        warnings: exif.warning.into_iter().collect(),
    })
}

fn four_channels() -> PhotoErrorKind {
    PhotoErrorKind::Unsupported {
        what: "a JPEG with four ink channels (CMYK or YCCK)".to_owned(),
        advice: "convert it to RGB with its profile and open that",
    }
}

/// The profile that the decoder joined from its parts, or the statement that it could not.
fn icc(decoder: &JpegDecoder<Watched<'_>>, bytes: &[u8]) -> Option<Claim> {
    const SIGNATURE: &[u8] = b"ICC_PROFILE\0";
    let headers = &bytes[..first_scan(bytes).unwrap_or(0)];
    let is_there = || headers.windows(SIGNATURE.len()).any(|window| window == SIGNATURE);
    let damaged = || Claim::Damaged("The ICC profile is incomplete and is not followed".to_owned());
    decoder.icc_profile().map(Claim::Icc).or_else(|| is_there().then(damaged))
}

/// Where the first scan starts, by stepping over the segments before it (ITU-T T.81, section B.1.1).
fn first_scan(bytes: &[u8]) -> Option<usize> {
    let mut at = 2;
    loop {
        match *bytes.get(at..at + 4)? {
            [0xff, 0xda, ..] => return Some(at),
            // Fill bytes.
            [0xff, 0xff, ..] => at += 1,
            [0xff, _, high, low] => at += 2 + usize::from(u16::from_be_bytes([high, low])),
            // Bytes between segments, which some cameras write.
            _ => at += 1,
        }
    }
}

/// True when an end marker follows the first scan. Inside coded pixels 0xFF is never followed by 0xD9.
fn ends_properly(bytes: &[u8]) -> bool {
    first_scan(bytes).is_some_and(|start| bytes[start..].windows(2).rev().any(|window| window == b"\xff\xd9"))
}
