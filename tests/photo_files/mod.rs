//! Small picture files of known content, made for the tests that read them.

#![allow(dead_code, reason = "each test binary uses some of the writers")]

use std::io::Cursor;

use exif::experimental::Writer;
use exif::{Field, In, Tag, Value};
use image::{ExtendedColorType, ImageEncoder};
use png::chunk::ChunkType;

/// One chunk of a PNG, written before the pixels.
pub type PngChunk = ([u8; 4], Vec<u8>);

/// A PNG; `data` as the PNG has it, big-endian for 16 bits.
pub fn png(size: [u32; 2], color: png::ColorType, depth: png::BitDepth, data: &[u8], chunks: &[PngChunk]) -> Vec<u8> {
    png_of(png_info(size, color, depth), data, chunks)
}

/// What a PNG says of itself, to be added to.
pub fn png_info(size: [u32; 2], color: png::ColorType, depth: png::BitDepth) -> png::Info<'static> {
    let mut info = png::Info::with_size(size[0], size[1]);
    info.color_type = color;
    info.bit_depth = depth;
    info
}

/// A PNG of an info block, for profiles and palettes.
pub fn png_of(info: png::Info<'_>, data: &[u8], chunks: &[PngChunk]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = png::Encoder::with_info(&mut bytes, info).unwrap().write_header().unwrap();
    for (name, content) in chunks {
        writer.write_chunk(ChunkType(*name), content).unwrap();
    }
    writer.write_image_data(data).unwrap();
    writer.finish().unwrap();
    bytes
}

/// An 8-bit RGB PNG with one profile.
pub fn png_with_profile(size: [u32; 2], data: &[u8], profile: &[u8], chunks: &[PngChunk]) -> Vec<u8> {
    let mut info = png_info(size, png::ColorType::Rgb, png::BitDepth::Eight);
    info.icc_profile = Some(profile.to_vec().into());
    png_of(info, data, chunks)
}

/// A PNG `gAMA` chunk.
pub fn gama(gamma: f64) -> PngChunk {
    (*b"gAMA", ((gamma * 1e5).round() as u32).to_be_bytes().to_vec())
}

/// A PNG `cHRM` chunk of white, red, green and blue.
pub fn chrm(xy: [f64; 8]) -> PngChunk {
    (*b"cHRM", xy.iter().flat_map(|v| ((v * 1e5).round() as u32).to_be_bytes()).collect())
}

/// An EXIF block that starts with the TIFF header.
pub fn exif(orientation: Option<u16>, color_space: Option<u16>, interoperability: Option<&str>) -> Vec<u8> {
    let short = |tag, value| Field { tag, ifd_num: In::PRIMARY, value: Value::Short(vec![value]) };
    let index = |text: &str| Field {
        tag: Tag::InteroperabilityIndex,
        ifd_num: In::PRIMARY,
        value: Value::Ascii(vec![text.as_bytes().to_vec()]),
    };
    let fields: Vec<Field> = [
        orientation.map(|value| short(Tag::Orientation, value)),
        color_space.map(|value| short(Tag::ColorSpace, value)),
        interoperability.map(index),
    ]
    .into_iter()
    .flatten()
    .collect();
    let mut writer = Writer::new();
    fields.iter().for_each(|field| writer.push_field(field));
    let mut bytes = Cursor::new(Vec::new());
    writer.write(&mut bytes, false).unwrap();
    bytes.into_inner()
}

/// A JPEG of 8-bit RGB pixels at quality 100.
pub fn jpeg(size: [u32; 2], data: &[u8], profile: Option<&[u8]>, exif: Option<&[u8]>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 100);
    if let Some(profile) = profile {
        encoder.set_icc_profile(profile.to_vec()).unwrap();
    }
    if let Some(exif) = exif {
        encoder.set_exif_metadata(exif.to_vec()).unwrap();
    }
    encoder.write_image(data, size[0], size[1], ExtendedColorType::Rgb8).unwrap();
    bytes
}

/// An EXR of one part. Channels by name; each is `width × height` floats.
pub fn exr(size: [usize; 2], channels: &[(&str, Vec<f32>)], layer_name: Option<&str>) -> Vec<u8> {
    exr_with(size, channels, layer_name, |_| {})
}

/// An EXR of one part whose attributes are set by a closure.
pub fn exr_with(
    size: [usize; 2],
    channels: &[(&str, Vec<f32>)],
    layer_name: Option<&str>,
    set: impl FnOnce(&mut exr::meta::header::ImageAttributes),
) -> Vec<u8> {
    use exr::prelude::*;
    let list = channels.iter().map(|(name, samples)| AnyChannel::new(*name, FlatSamples::F32(samples.clone())));
    let channels = AnyChannels::sort(list.collect());
    let attributes = layer_name.map_or_else(LayerAttributes::default, LayerAttributes::named);
    let layer = Layer::new((size[0], size[1]), attributes, Encoding::SMALL_LOSSLESS, channels);
    let mut image = Image::from_layer(layer);
    set(&mut image.attributes);
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

/// A WebP without loss.
pub fn webp(
    size: [u32; 2],
    data: &[u8],
    color: ExtendedColorType,
    profile: Option<&[u8]>,
    exif: Option<&[u8]>,
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = image::codecs::webp::WebPEncoder::new_lossless(&mut bytes);
    if let Some(profile) = profile {
        encoder.set_icc_profile(profile.to_vec()).unwrap();
    }
    if let Some(exif) = exif {
        encoder.set_exif_metadata(exif.to_vec()).unwrap();
    }
    encoder.write_image(data, size[0], size[1], color).unwrap();
    bytes
}

/// A TIFF of one strip made by hand, little-endian and uncompressed; further tags as lists of longs.
pub fn tiff(size: [u32; 2], bits: &[u32], format: u32, data: &[u8], more: &[(u16, Vec<u32>)]) -> Vec<u8> {
    let photometric = if bits.len() < 3 { 1 } else { 2 };
    let mut tags = vec![
        (256, vec![size[0]]),
        (257, vec![size[1]]),
        (258, bits.to_vec()),
        (259, vec![1]),
        (262, vec![photometric]),
        (273, vec![8]),
        (277, vec![bits.len() as u32]),
        (278, vec![size[1]]),
        (279, vec![data.len() as u32]),
        (339, vec![format; bits.len()]),
    ];
    tags.retain(|(tag, _)| more.iter().all(|(other, _)| other != tag));
    tags.extend_from_slice(more);
    tags.sort();
    tiff_of_tags(data, &tags)
}

/// Data at offset 8, then one directory, then what does not fit into it.
fn tiff_of_tags(data: &[u8], tags: &[(u16, Vec<u32>)]) -> Vec<u8> {
    let start = 8 + data.len().next_multiple_of(2);
    let mut bytes = b"II\x2a\x00".to_vec();
    bytes.extend((start as u32).to_le_bytes());
    bytes.extend(data);
    bytes.resize(start, 0);
    let mut outside = Vec::new();
    let outside_start = start + 2 + 12 * tags.len() + 4;
    bytes.extend((tags.len() as u16).to_le_bytes());
    for (tag, values) in tags {
        // Primaries and white are rationals, profiles are bytes, extra samples are shorts, all else is longs.
        let (kind, count) = match tag {
            318 | 319 => (5u16, values.len() / 2),
            34_675 => (7, values.len()),
            338 => (3, values.len()),
            _ => (4, values.len()),
        };
        let content: Vec<u8> = match kind {
            7 => values.iter().map(|v| *v as u8).collect(),
            3 => values.iter().flat_map(|v| (*v as u16).to_le_bytes()).collect(),
            _ => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
        };
        bytes.extend([tag.to_le_bytes(), kind.to_le_bytes()].concat());
        bytes.extend((count as u32).to_le_bytes());
        if content.len() <= 4 {
            bytes.extend(content.iter().chain(&[0; 4]).take(4));
        } else {
            bytes.extend(((outside_start + outside.len()) as u32).to_le_bytes());
            outside.extend(content);
        }
    }
    bytes.extend([0; 4]);
    bytes.extend(outside);
    bytes
}

/// A Radiance HDR of one scanline per row without compression; each pixel is red, green, blue, exponent.
pub fn hdr(variables: &str, resolution: &str, rgbe: &[[u8; 4]]) -> Vec<u8> {
    let mut bytes = format!("#?RADIANCE\n{variables}FORMAT=32-bit_rle_rgbe\n\n{resolution}\n").into_bytes();
    bytes.extend(rgbe.as_flattened());
    bytes
}
