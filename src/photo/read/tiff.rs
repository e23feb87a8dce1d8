//! TIFF 6.0: grey and RGB, 8 and 16 bits, 16-, 32- and 64-bit floats.

use std::io::Cursor;

use ::tiff::decoder::ifd::Value;
use ::tiff::decoder::{ChunkType, DecodingResult, Limits};
use ::tiff::tags::Tag;
use ::tiff::{ColorType, TiffError};

use super::alpha::{AlphaSample, Opaque};
use super::colour::{Claim, Colour, Primaries};
use super::exif::{self, Exif};
use super::{Decoded, Progress, limits, report, several};
use crate::photo::error::first_line;
use crate::photo::samples::Samples;
use crate::photo::{PhotoErrorKind, Warning};

type Decoder<'a> = ::tiff::decoder::Decoder<Cursor<&'a [u8]>>;

const ADVICE: &str = "save it as RGB with 8 or 16 bits or as floats, compressed with ZIP or LZW";
const WHITE_POINT: Tag = Tag::Unknown(318);
const PRIMARY_CHROMATICITIES: Tag = Tag::Unknown(319);
const TRANSFER_FUNCTION: Tag = Tag::Unknown(301);
const COLOR_SPACE: Tag = Tag::Unknown(40_961);
const INTEROPERABILITY_IFD: Tag = Tag::Unknown(40_965);
const INTEROPERABILITY_INDEX: Tag = Tag::Unknown(1);

fn damaged(error: TiffError) -> PhotoErrorKind {
    match error {
        TiffError::UnsupportedError(what) => {
            unsupported(format!("a TIFF of this kind ({})", first_line(&what.to_string())))
        }
        error => PhotoErrorKind::damaged("TIFF")(&error),
    }
}

fn unsupported(what: String) -> PhotoErrorKind {
    PhotoErrorKind::Unsupported { what, advice: ADVICE }
}

/// How the samples of a pixel are stored.
struct Form {
    size: [u32; 2],
    /// Samples of a pixel, alpha included.
    channels: usize,
    is_premultiplied: bool,
    is_planar: bool,
    /// Samples of every stored number type, as many as the picture has.
    result: DecodingResult,
}

/// Decodes the first page at full depth.
pub(super) fn decode(bytes: &[u8], progress: Progress<'_>) -> Result<Decoded, PhotoErrorKind> {
    let limit = limits::FILE_BYTES as usize;
    let mut limits = Limits::default();
    (limits.decoding_buffer_size, limits.intermediate_buffer_size) = (limit, limit);
    limits.ifd_value_size = 1 << 25;
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(damaged)?.with_limits(limits);
    let mut form = Form::of(&mut decoder)?;
    let exif = exif_of(&mut decoder);
    let colour = Colour { claims: claims(&mut decoder, exif.claim.clone()) };
    let pages = decoder.more_images().then(|| several("pages"));
    read_samples(&mut decoder, &mut form, progress)?;

    let size = form.size;
    let (samples, channels, alpha) = form.into_samples()?;
    let warnings = pages.into_iter().chain(alpha).chain(exif.warning).collect();
    Ok(Decoded { samples, channels, size, orientation: exif.orientation, colour, layers: vec![], warnings })
}

impl Form {
    fn of(decoder: &mut Decoder<'_>) -> Result<Self, PhotoErrorKind> {
        let color_type = decoder.colortype().map_err(damaged)?;
        let (colours, bits) = match color_type {
            ColorType::Gray(bits) | ColorType::GrayA(bits) => (1, bits),
            ColorType::Multiband { bit_depth, num_samples: 2 } => (1, bit_depth),
            ColorType::RGB(bits) | ColorType::RGBA(bits) => (3, bits),
            other => return Err(unsupported(format!("a TIFF with {other:?} pixels"))),
        };
        let number = |decoder: &mut Decoder<'_>, tag| decoder.find_tag_unsigned_vec::<u16>(tag).map_err(damaged);
        let first = |values: Option<Vec<u16>>, default| values.and_then(|v| v.first().copied()).unwrap_or(default);
        let channels = usize::from(first(number(decoder, Tag::SamplesPerPixel)?, 1));
        if !(colours..=colours + 1).contains(&channels) {
            return Err(unsupported(format!("a TIFF with {channels} channels")));
        }
        let is_premultiplied = first(number(decoder, Tag::ExtraSamples)?, 0) == 1;
        let is_planar = first(number(decoder, Tag::PlanarConfiguration)?, 1) == 2 && channels > 1;
        let format = first(number(decoder, Tag::SampleFormat)?, 1);

        let (width, height) = decoder.dimensions().map_err(damaged)?;
        let bytes_per_pixel = channels as u64 * u64::from(bits).div_ceil(8);
        let size = limits::check_size(width.into(), height.into(), bytes_per_pixel)?;
        let count = size[0] as usize * size[1] as usize * channels;
        let result = match (format, bits) {
            (1, 8) => DecodingResult::U8(limits::zeros(count)?),
            (1, 16) => DecodingResult::U16(limits::zeros(count)?),
            (3, 16) => DecodingResult::F16(limits::zeros(count)?),
            (3, 32) => DecodingResult::F32(limits::zeros(count)?),
            (3, 64) => DecodingResult::F64(limits::zeros(count)?),
            (format, bits) => {
                let kind = ["unsigned", "signed", "floating-point"].get(usize::from(format).wrapping_sub(1));
                return Err(unsupported(format!("a TIFF with {bits}-bit {} samples", kind.unwrap_or(&"undefined"))));
            }
        };
        Ok(Self { size, channels, is_premultiplied, is_planar, result })
    }

    /// The samples without alpha, the number of colour channels, and what to say about alpha.
    fn into_samples(self) -> Result<(Samples, usize, Option<Warning>), PhotoErrorKind> {
        let Self { channels, is_premultiplied, is_planar, .. } = self;
        let colours = if channels < 3 { 1 } else { 3 };
        let layout = (channels, is_premultiplied, is_planar);
        let (samples, warning) = match self.result {
            DecodingResult::U8(samples) => wrap(Samples::U8, colour_only(samples, layout)),
            DecodingResult::U16(samples) => wrap(Samples::U16, colour_only(samples, layout)),
            DecodingResult::F16(samples) => wrap(Samples::F16, colour_only(samples, layout)),
            DecodingResult::F32(samples) => wrap(Samples::F32, colour_only(samples, layout)),
            DecodingResult::F64(samples) => {
                wrap(Samples::F32, colour_only(samples.into_iter().map(|v| v as f32).collect(), layout))
            }
            _ => return Err(unsupported("a TIFF with samples of this type".to_owned())),
        };
        Ok((samples, colours, warning))
    }
}

fn wrap<T>(depth: fn(Vec<T>) -> Samples, (samples, warning): (Vec<T>, Option<Warning>)) -> (Samples, Option<Warning>) {
    (depth(samples), warning)
}

/// Interleaves planes and drops alpha.
fn colour_only<T: AlphaSample>(samples: Vec<T>, layout: (usize, bool, bool)) -> (Vec<T>, Option<Warning>) {
    let (channels, is_premultiplied, is_planar) = layout;
    let samples = if is_planar { interleaved(&samples, channels) } else { samples };
    if channels == 1 || channels == 3 {
        return (samples, None);
    }
    let mut opaque = Opaque::new(Vec::new(), channels, is_premultiplied);
    opaque.extend(&samples);
    let warning = opaque.warning();
    (opaque.samples, warning)
}

fn interleaved<T: Copy>(planes: &[T], channels: usize) -> Vec<T> {
    let pixels = planes.len() / channels;
    (0..pixels).flat_map(|pixel| (0..channels).map(move |channel| planes[channel * pixels + pixel])).collect()
}

/// Reads strips straight to their place, which can be watched; tiles and planes in one go.
fn read_samples(decoder: &mut Decoder<'_>, form: &mut Form, progress: Progress<'_>) -> Result<(), PhotoErrorKind> {
    if decoder.get_chunk_type() == ChunkType::Tile || form.is_planar {
        report(progress, 0, 1)?;
        decoder.read_image_bytes(form.result.as_buffer(0).as_bytes_mut()).map_err(damaged)?;
        return report(progress, 1, 1);
    }
    let strips = decoder.strip_count().map_err(damaged)?;
    let mut start = 0;
    for strip in 0..strips {
        let (width, height) = decoder.chunk_data_dimensions(strip);
        let samples = width as usize * height as usize * form.channels;
        decoder.read_chunk_bytes(strip, form.result.as_buffer(start).as_bytes_mut()).map_err(damaged)?;
        start += samples;
        report(progress, strip as usize + 1, strips as usize)?;
    }
    Ok(())
}

/// Orientation and colour space by the tags that EXIF shares with TIFF.
fn exif_of(decoder: &mut Decoder<'_>) -> Exif {
    let mut exif = Exif::default();
    exif.orient(decoder.find_tag_unsigned(Tag::Orientation).ok().flatten());
    exif.claim = exif_claim(decoder);
    exif
}

fn exif_claim(decoder: &mut Decoder<'_>) -> Option<Claim> {
    let pointer = decoder.find_tag(Tag::ExifDirectory).ok()??.into_ifd_pointer().ok()?;
    let directory = decoder.read_directory(pointer).ok()?;
    let mut tags = decoder.read_directory_tags(&directory);
    let color_space = tags.find_tag_unsigned::<u32>(COLOR_SPACE).ok()?;
    let interoperability = tags.find_tag(INTEROPERABILITY_IFD).ok().flatten().and_then(|v| v.into_ifd_pointer().ok());
    let is_r03 = interoperability.is_some_and(|pointer| {
        let Ok(directory) = decoder.read_directory(pointer) else { return false };
        let index = decoder.read_directory_tags(&directory).find_tag(INTEROPERABILITY_INDEX);
        matches!(index, Ok(Some(Value::Ascii(text))) if text.starts_with("R03"))
    });
    exif::claim(color_space, is_r03)
}

/// The statements about colour: ICC, EXIF, the primaries of TIFF's own section 20.
fn claims(decoder: &mut Decoder<'_>, exif: Option<Claim>) -> Vec<Claim> {
    let icc = match decoder.find_tag(Tag::IccProfile) {
        Ok(None) => None,
        Ok(Some(value)) => value.into_u8_vec().ok().map(Claim::Icc).or_else(|| Some(damaged_icc())),
        Err(_) => Some(damaged_icc()),
    };
    let transfer = decoder.find_tag(TRANSFER_FUNCTION).ok().flatten();
    let transfer = transfer.map(|_| Claim::Damaged("The TIFF transfer function is not followed".to_owned()));
    let is_by_transfer = icc.is_none() && exif.is_none();
    let primaries = primaries(decoder).map(Claim::TiffPrimaries);
    [icc, exif, transfer.filter(|_| is_by_transfer), primaries].into_iter().flatten().collect()
}

fn damaged_icc() -> Claim {
    Claim::Damaged("The ICC profile is damaged and is not followed".to_owned())
}

fn primaries(decoder: &mut Decoder<'_>) -> Option<Primaries> {
    let white = numbers(decoder.find_tag(WHITE_POINT).ok()??)?;
    let rgb = numbers(decoder.find_tag(PRIMARY_CHROMATICITIES).ok()??)?;
    let [xr, yr, xg, yg, xb, yb] = rgb.try_into().ok()?;
    let white: [f64; 2] = white.try_into().ok()?;
    Some(Primaries::from_xy([[xr, yr], [xg, yg], [xb, yb], white]))
}

fn numbers(value: Value) -> Option<Vec<f64>> {
    let number = |value: &Value| match *value {
        Value::Rational(numerator, denominator) => Some(f64::from(numerator) / f64::from(denominator)),
        Value::Float(value) => Some(f64::from(value)),
        Value::Double(value) => Some(value),
        _ => None,
    };
    if let Value::List(values) = value { values.iter().map(number).collect() } else { None }
}
