//! PNG, by the third edition of its specification (W3C, 2025).

use std::io::Cursor;

use ::png::{BitDepth, Decoder, Info, Transformations};

use super::alpha::Opaque;
use super::colour::{Claim, Colour, Primaries};
use super::exif::Exif;
use super::{Decoded, Progress, limits, report, several};
use crate::photo::PhotoErrorKind;
use crate::photo::samples::Samples;

type Reader<'a> = ::png::Reader<Cursor<&'a [u8]>>;

fn damaged(error: ::png::DecodingError) -> PhotoErrorKind {
    PhotoErrorKind::damaged("PNG")(&error)
}

/// Decodes at full depth; palettes and small depths become 8 bits, which is exact.
pub(super) fn decode(bytes: &[u8], progress: Progress<'_>) -> Result<Decoded, PhotoErrorKind> {
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    let header = decoder.read_header_info().map_err(damaged)?;
    let bytes_per_pixel = if header.bit_depth == BitDepth::Sixteen { 6 } else { 3 };
    let size = limits::check_size(header.width.into(), header.height.into(), bytes_per_pixel)?;
    let mut reader = decoder.read_info().map_err(damaged)?;

    let (color_type, depth) = reader.output_color_type();
    let channels = color_type.samples();
    let (samples, colours, alpha) = if depth == BitDepth::Sixteen {
        let mut opaque = Opaque::new(room(size, channels)?, channels, false);
        let mut row = Vec::new();
        rows(&mut reader, progress, &mut |bytes| {
            row.clear();
            row.extend(bytes.as_chunks().0.iter().map(|pair| u16::from_be_bytes(*pair)));
            opaque.extend(&row);
        })?;
        let (colours, warning) = (opaque.colours(), opaque.warning());
        (Samples::U16(opaque.samples), colours, warning)
    } else {
        let mut opaque = Opaque::new(room(size, channels)?, channels, false);
        rows(&mut reader, progress, &mut |bytes| opaque.extend(bytes))?;
        let (colours, warning) = (opaque.colours(), opaque.warning());
        (Samples::U8(opaque.samples), colours, warning)
    };
    // Reads on to the end: EXIF may follow the pixels, and a file that was cut off is found out.
    reader.finish().map_err(damaged)?;

    let info = reader.info();
    let exif = Exif::read(info.exif_metadata.as_deref());
    let colour = Colour { claims: claims(info, bytes) };
    let frames = info.animation_control.map_or(1, |control| control.num_frames);
    let animated = (frames > 1).then(|| several("frames"));
    let warnings = animated.into_iter().chain(alpha).chain(exif.warning).collect();
    Ok(Decoded { samples, channels: colours, size, orientation: exif.orientation, colour, layers: vec![], warnings })
}

fn room<T>([width, height]: [u32; 2], channels: usize) -> Result<Vec<T>, PhotoErrorKind> {
    let colours = if channels < 3 { 1 } else { 3 };
    limits::reserve(width as usize * height as usize * colours)
}

/// Hands every row to `take`, from top to bottom.
fn rows(reader: &mut Reader<'_>, progress: Progress<'_>, take: &mut dyn FnMut(&[u8])) -> Result<(), PhotoErrorKind> {
    let height = reader.info().height as usize;
    if reader.info().interlaced {
        let size = reader.output_buffer_size().ok_or_else(|| limits::out_of_memory(u64::MAX))?;
        let mut picture = limits::reserve(size)?;
        picture.resize(size, 0);
        reader.next_frame(&mut picture).map_err(damaged)?;
        picture.chunks_exact(size / height).for_each(take);
        return report(progress, 1, 1);
    }
    for row in 0..height {
        let next = reader.next_row().map_err(damaged)?;
        take(next.ok_or_else(|| PhotoErrorKind::damaged("PNG")(&"rows are missing"))?.data());
        if row % 64 == 0 {
            report(progress, row, height)?;
        }
    }
    Ok(())
}

/// The statements about colour, strongest first: cICP, iCCP, sRGB, gAMA with cHRM (section 4.3). A chunk that
/// is there and was not understood is a statement too.
fn claims(info: &Info<'_>, bytes: &[u8]) -> Vec<Claim> {
    let cicp = info.coding_independent_code_points.map(|points| Claim::Cicp {
        primaries: points.color_primaries,
        transfer: points.transfer_function,
        is_rgb_full_range: points.matrix_coefficients == 0 && points.is_video_full_range_image,
    });
    let icc = info.icc_profile.as_ref().map(|profile| Claim::Icc(profile.to_vec()));
    let srgb = info.srgb.map(|_| Claim::PngSrgb);
    let gamma = info.gama_chunk.map(|gamma| f64::from(gamma.into_scaled()) / 1e5);
    let primaries = info.chrm_chunk.map(primaries);
    let damaged = |chunk: &str, is_understood: bool| {
        let claim = || Claim::Damaged(format!("The PNG chunk {chunk} is damaged and is not followed"));
        (!is_understood && has_chunk(bytes, chunk.as_bytes())).then(claim)
    };
    let (bad_gamma, bad_primaries) = (damaged("gAMA", gamma.is_some()), damaged("cHRM", primaries.is_some()));
    let gamma = (gamma.is_some() || primaries.is_some()).then_some(Claim::PngGamma { gamma, primaries });
    let (bad_cicp, bad_icc) = (damaged("cICP", cicp.is_some()), damaged("iCCP", icc.is_some()));
    let bad_srgb = damaged("sRGB", srgb.is_some());
    [cicp, bad_cicp, icc, bad_icc, srgb, bad_srgb, bad_gamma, bad_primaries, gamma].into_iter().flatten().collect()
}

/// Chunks hold 100 000 times the value.
fn primaries(chrm: ::png::SourceChromaticities) -> Primaries {
    let xy = |(x, y): (::png::ScaledFloat, ::png::ScaledFloat)| [x, y].map(|v| f64::from(v.into_scaled()) / 1e5);
    Primaries::from_xy([chrm.red, chrm.green, chrm.blue, chrm.white].map(xy))
}

/// True when a chunk of this type stands before the pixels.
fn has_chunk(bytes: &[u8], wanted: &[u8]) -> bool {
    let mut rest = bytes.get(8..).unwrap_or_default();
    while let Some((length, after)) = rest.split_first_chunk::<4>() {
        match after.first_chunk::<4>() {
            Some(b"IDAT") | None => return false,
            Some(kind) if kind.as_slice() == wanted => return true,
            Some(_) => rest = after.get(8 + u32::from_be_bytes(*length) as usize..).unwrap_or_default(),
        }
    }
    false
}
