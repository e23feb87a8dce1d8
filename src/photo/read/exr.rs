//! OpenEXR: scan lines and tiles, any chromaticities, luminance, layers by name.

use std::collections::BTreeSet;
use std::io::Cursor;

use ::exr::block::chunk::Chunk;
use ::exr::block::reader::{ChunksReader, Reader};
use ::exr::block::{UncompressedBlock, read};
use ::exr::meta::MetaData;
use ::exr::meta::attribute::{Chromaticities, SampleType};
use ::exr::meta::header::Header;
use half::f16;
use rayon::prelude::*;

use super::alpha::{AlphaSample, Opaque};
use super::colour::{Claim, Colour, Primaries};
use super::{Decoded, Progress, limits, report};
use crate::color::RgbSpace;
use crate::photo::orientation::Orientation;
use crate::photo::samples::Samples;
use crate::photo::{ColourRule, PhotoErrorKind, Warning};

pub(super) fn damaged(error: ::exr::error::Error) -> PhotoErrorKind {
    match error {
        ::exr::error::Error::NotSupported(what) => PhotoErrorKind::Unsupported {
            what: format!("an OpenEXR with {what}"),
            advice: "save it as flat scan lines with ZIP or PIZ compression",
        },
        error => PhotoErrorKind::damaged("OpenEXR")(&error),
    }
}

/// Channels of one header that make a picture: colour, then perhaps alpha.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Layer {
    /// Index of the header.
    pub part: usize,
    /// The name people choose it by; empty for the unnamed layer.
    pub name: String,
    /// Indices of R, G, B or of Y in the channel list of the header.
    pub colours: Vec<usize>,
    /// Index of A.
    pub alpha: Option<usize>,
}

/// Decodes one layer: the unnamed one, or the one asked for.
pub(super) fn decode(bytes: &[u8], wanted: Option<&str>, progress: Progress<'_>) -> Result<Decoded, PhotoErrorKind> {
    let reader = read(Cursor::new(bytes), false).map_err(damaged)?;
    check_headers(reader.headers(), bytes.len())?;
    let all = layers(reader.headers());
    let layer = choose(&all, wanted)?.clone();
    let names = all.iter().filter(|layer| !layer.name.is_empty()).map(|layer| layer.name.clone()).collect();
    let header = &reader.headers()[layer.part];
    let is_half = layer.channels().all(|index| header.channels.list[index].sample_type == SampleType::F16);
    let size = size_of_header(header, if is_half { 8 } else { 16 })?;
    let colour = Colour { claims: vec![claim(header.shared_attributes.chromaticities.as_ref())] };

    let (samples, warning) = if is_half {
        let (samples, warning) = pixels::<f16>(reader, &layer, size, progress)?;
        (Samples::F16(samples), warning)
    } else {
        let (samples, warning) = pixels::<f32>(reader, &layer, size, progress)?;
        (Samples::F32(samples), warning)
    };
    let (channels, warnings) = (layer.colours.len(), warning.into_iter().collect());
    Ok(Decoded { samples, channels, size, orientation: Orientation::default(), colour, layers: names, warnings })
}

/// Refuses what a hostile header could ask for: every chunk has an offset of 8 bytes in the file.
pub(super) fn check_headers(headers: &[Header], file_bytes: usize) -> Result<(), PhotoErrorKind> {
    let chunks = headers.iter().fold(0usize, |sum, header| sum.saturating_add(header.chunk_count));
    if chunks > file_bytes / 8 {
        return Err(PhotoErrorKind::damaged("OpenEXR")(&"its table of blocks is longer than the file"));
    }
    Ok(())
}

pub(super) fn size_of_header(header: &Header, bytes_per_pixel: u64) -> Result<[u32; 2], PhotoErrorKind> {
    // A block is decompressed with all its channels, also those not asked for.
    let all_channels = header.channels.bytes_per_pixel as u64 * header.max_block_pixels();
    if all_channels > 1 << 30 {
        return Err(PhotoErrorKind::TooLarge {
            what: format!("a block of {} MiB", all_channels >> 20),
            limit: "1024 MiB".to_owned(),
        });
    }
    limits::check_size(header.layer_size.0 as u64, header.layer_size.1 as u64, bytes_per_pixel)
}

/// Sizes of blocks.
trait BlockSize {
    /// Pixels of the largest block.
    fn max_block_pixels(&self) -> u64;
}

impl BlockSize for Header {
    fn max_block_pixels(&self) -> u64 {
        let size = match self.blocks {
            ::exr::meta::BlockDescription::Tiles(tiles) => tiles.tile_size,
            ::exr::meta::BlockDescription::ScanLines => {
                ::exr::math::Vec2(self.layer_size.0, self.compression.scan_lines_per_block())
            }
        };
        (size.0 as u64).saturating_mul(size.1 as u64)
    }
}

/// Every set of channels R, G, B or Y in every part. Names come from the part, or from the text before the
/// last dot of a channel.
fn layers(headers: &[Header]) -> Vec<Layer> {
    let in_part = |(part, header): (usize, &Header)| -> Vec<Layer> {
        let names: Vec<String> = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
        let prefixes: BTreeSet<&str> = names.iter().map(|name| name.rsplit_once('.').map_or("", |(p, _)| p)).collect();
        let own_name = header.own_attributes.layer_name.as_ref().map(ToString::to_string).unwrap_or_default();
        let part_name = if headers.len() > 1 { own_name.as_str() } else { "" };
        prefixes.iter().filter_map(|prefix| layer(part, part_name, prefix, &names)).collect()
    };
    headers.iter().enumerate().flat_map(in_part).collect()
}

fn layer(part: usize, part_name: &str, prefix: &str, names: &[String]) -> Option<Layer> {
    let index = |channel: &str| {
        let full = if prefix.is_empty() { channel.to_owned() } else { format!("{prefix}.{channel}") };
        names.iter().position(|name| name.eq_ignore_ascii_case(&full))
    };
    let rgb: Option<Vec<usize>> = ["R", "G", "B"].into_iter().map(index).collect();
    let colours = rgb.or_else(|| index("Y").map(|y| vec![y]))?;
    let name = [part_name, prefix].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join(".");
    // A part is often called what everybody calls the picture itself.
    let name = if matches!(name.as_str(), "rgb" | "rgba" | "RGB" | "RGBA") { String::new() } else { name };
    Some(Layer { part, name, colours, alpha: index("A") })
}

fn choose<'a>(all: &'a [Layer], wanted: Option<&str>) -> Result<&'a Layer, PhotoErrorKind> {
    let names = || all.iter().filter(|layer| !layer.name.is_empty()).map(|layer| layer.name.clone()).collect();
    match wanted {
        Some(wanted) => all
            .iter()
            .find(|layer| layer.name == wanted)
            .ok_or_else(|| PhotoErrorKind::NoSuchLayer { wanted: wanted.to_owned(), layers: names() }),
        None if all.is_empty() => Err(PhotoErrorKind::Unsupported {
            what: "an OpenEXR without channels R, G, B or Y".to_owned(),
            advice: "save the colours under these names",
        }),
        None => all
            .iter()
            .find(|layer| layer.name.is_empty())
            .ok_or_else(|| PhotoErrorKind::ChooseLayer { layers: names() }),
    }
}

impl Layer {
    /// Colour, then alpha.
    pub fn channels(&self) -> impl Iterator<Item = usize> + '_ {
        self.colours.iter().copied().chain(self.alpha)
    }
}

/// Chromaticities, or Rec.709 as OpenEXR's standard has it without them.
fn claim(chromaticities: Option<&Chromaticities>) -> Claim {
    let rec709 = Claim::Linear { primaries: Primaries::of(RgbSpace::LinRec709), rule: ColourRule::ExrDefault };
    chromaticities.map_or(rec709, |c| {
        let xy = [c.red, c.green, c.blue, c.white].map(|v| [f64::from(v.0), f64::from(v.1)]);
        Claim::Linear { primaries: Primaries::from_xy(xy), rule: ColourRule::ExrChromaticities }
    })
}

/// What the samples of a file become.
pub(super) trait Sample: Copy + Default + Send + Sync {
    /// One sample of a line in native byte order.
    fn of_half(sample: f16) -> Self;
    /// One sample of a line in native byte order.
    fn of_float(sample: f32) -> Self;
    /// One sample of a line in native byte order.
    fn of_whole(sample: u32) -> Self;
}

impl Sample for f16 {
    fn of_half(sample: f16) -> Self {
        sample
    }
    fn of_float(sample: f32) -> Self {
        f16::from_f32(sample)
    }
    fn of_whole(sample: u32) -> Self {
        f16::from_f32(sample as f32)
    }
}

impl Sample for f32 {
    fn of_half(sample: f16) -> Self {
        sample.to_f32()
    }
    fn of_float(sample: f32) -> Self {
        sample
    }
    fn of_whole(sample: u32) -> Self {
        sample as f32
    }
}

/// For channels of whole numbers alone: a fraction would be lost.
impl Sample for u32 {
    fn of_half(sample: f16) -> Self {
        sample.to_f32() as u32
    }
    fn of_float(sample: f32) -> Self {
        sample as u32
    }
    fn of_whole(sample: u32) -> Self {
        sample
    }
}

/// The pixels of a layer, without alpha.
fn pixels<T: Sample + AlphaSample>(
    reader: Reader<Cursor<&[u8]>>,
    layer: &Layer,
    size: [u32; 2],
    progress: Progress<'_>,
) -> Result<(Vec<T>, Option<Warning>), PhotoErrorKind> {
    Ok(without_alpha(interleaved(reader, layer, size, progress)?, layer))
}

/// The pixels of a layer with its alpha. Blocks are decompressed on every core, a few at a time.
pub(super) fn interleaved<T: Sample>(
    reader: Reader<Cursor<&[u8]>>,
    layer: &Layer,
    [width, height]: [u32; 2],
    progress: Progress<'_>,
) -> Result<Vec<T>, PhotoErrorKind> {
    const BLOCKS_AT_ONCE: usize = 32;
    let meta = reader.meta_data().clone();
    let header = &meta.headers[layer.part];
    if header.deep {
        let what = "a deep OpenEXR".to_owned();
        return Err(PhotoErrorKind::Unsupported { what, advice: "flatten it and open that" });
    }
    if header.channels.list.iter().any(|channel| channel.sampling.0 != 1 || channel.sampling.1 != 1) {
        let what = "an OpenEXR with subsampled channels (luminance and chroma)".to_owned();
        return Err(PhotoErrorKind::Unsupported { what, advice: "save it with channels R, G and B" });
    }
    let channels = layer.channels().count();
    let (width, pixels) = (width as usize, width as usize * height as usize);
    let mut interleaved = limits::reserve::<T>(pixels * channels)?;
    interleaved.resize(pixels * channels, T::default());

    let mut missing = pixels;
    let mut chunks = reader.all_chunks(false).map_err(damaged)?;
    let all = chunks.expected_chunk_count();
    loop {
        let some: Result<Vec<Chunk>, _> = chunks.by_ref().take(BLOCKS_AT_ONCE).collect();
        let some = some.map_err(damaged)?;
        if some.is_empty() {
            break;
        }
        for block in decompressed(some, layer.part, &meta)? {
            missing = missing.saturating_sub(block.index.pixel_size.0 * block.index.pixel_size.1);
            place(&block, header, layer, width, &mut interleaved);
        }
        report(progress, all - chunks.len(), all)?;
    }
    if missing > 0 {
        return Err(PhotoErrorKind::damaged("OpenEXR")(&format!("{missing} pixels are missing")));
    }
    Ok(interleaved)
}

/// The blocks of a part at full resolution.
fn decompressed(chunks: Vec<Chunk>, part: usize, meta: &MetaData) -> Result<Vec<UncompressedBlock>, PhotoErrorKind> {
    let ours = chunks.into_par_iter().filter(|chunk| chunk.layer_index == part);
    let blocks = ours.map(|chunk| UncompressedBlock::decompress_chunk(chunk, meta, false));
    let blocks: Vec<_> = blocks.collect::<Result<_, _>>().map_err(damaged)?;
    Ok(blocks.into_iter().filter(|block| block.index.level.0 == 0 && block.index.level.1 == 0).collect())
}

/// Copies the wanted channels of a block into the picture.
fn place<T: Sample>(block: &UncompressedBlock, header: &Header, layer: &Layer, width: usize, picture: &mut [T]) {
    let channels = layer.channels().count();
    for line in block.lines(&header.channels) {
        let Some(slot) = layer.channels().position(|index| index == line.location.channel) else { continue };
        let start = (line.location.position.1 * width + line.location.position.0) * channels + slot;
        let samples = picture[start..].iter_mut().step_by(channels).take(line.location.sample_count);
        match header.channels.list[line.location.channel].sample_type {
            SampleType::F16 => {
                let stored = line.value.as_chunks().0.iter().map(|bytes| f16::from_ne_bytes(*bytes));
                samples.zip(stored).for_each(|(sample, stored)| *sample = T::of_half(stored));
            }
            SampleType::F32 => {
                let stored = line.value.as_chunks().0.iter().map(|bytes| f32::from_ne_bytes(*bytes));
                samples.zip(stored).for_each(|(sample, stored)| *sample = T::of_float(stored));
            }
            SampleType::U32 => {
                let stored = line.value.as_chunks().0.iter().map(|bytes| u32::from_ne_bytes(*bytes));
                samples.zip(stored).for_each(|(sample, stored)| *sample = T::of_whole(stored));
            }
        }
    }
}

/// Divides alpha out, as OpenEXR stores colours multiplied by it.
fn without_alpha<T: AlphaSample>(interleaved: Vec<T>, layer: &Layer) -> (Vec<T>, Option<Warning>) {
    if layer.alpha.is_none() {
        return (interleaved, None);
    }
    let mut opaque = Opaque::new(Vec::new(), layer.channels().count(), true);
    opaque.extend(&interleaved);
    let warning = opaque.warning();
    (opaque.samples, warning)
}
