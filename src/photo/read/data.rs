//! Pictures of numbers that are no colours: one channel as stored, and how far its pixels are covered.

use std::io::Cursor;

use ::png::{BitDepth, ColorType, Decoder, Transformations};

use super::sniff::Format;
use super::{Progress, exr_plane, limits, report, sniff};
use crate::photo::PhotoErrorKind;
use crate::photo::plane::{DIFFERENT, Ids, PlaneKind, PlanePixels};

/// Decodes one channel of an OpenEXR or a PNG.
pub(in crate::photo) fn plane(
    name: &str,
    bytes: &[u8],
    kind: PlaneKind,
    channel: Option<&str>,
    progress: Progress<'_>,
) -> Result<PlanePixels, PhotoErrorKind> {
    limits::check_file(bytes.len() as u64)?;
    match sniff::format(name, bytes)? {
        Format::Exr => exr_plane::plane(bytes, kind, channel, progress),
        Format::Png => png(bytes, kind, channel, progress),
        other => Err(PhotoErrorKind::Unsupported {
            what: format!("{} as a picture of numbers", other.label()),
            advice: "save it as OpenEXR or PNG",
        }),
    }
}

/// A PNG at full depth, without any tone curve.
fn png(
    bytes: &[u8],
    kind: PlaneKind,
    channel: Option<&str>,
    progress: Progress<'_>,
) -> Result<PlanePixels, PhotoErrorKind> {
    let damaged = |error: ::png::DecodingError| PhotoErrorKind::damaged("PNG")(&error);
    let mut decoder = Decoder::new(Cursor::new(bytes));
    // A palette of ids counts by its colours; other depths below 8 bits keep their numbers where these are ids.
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    let header = decoder.read_header_info().map_err(damaged)?;
    let size = limits::check_size(header.width.into(), header.height.into(), 8)?;
    let stored_depth = header.bit_depth;
    let mut reader = decoder.read_info().map_err(damaged)?;
    let (color, depth) = reader.output_color_type();
    let layout = Layout::of(color, depth, stored_depth, kind, channel)?;
    let length = reader.output_buffer_size().ok_or_else(|| limits::out_of_memory(u64::MAX))?;
    let mut buffer = limits::reserve::<u8>(length)?;
    buffer.resize(length, 0);
    reader.next_frame(&mut buffer).map_err(damaged)?;
    reader.finish().map_err(damaged)?;
    report(progress, 1, 2)?;
    let info = reader.info();
    let is_encoded = info.srgb.is_some() || info.icc_profile.is_some() || info.gama_chunk.is_some();
    let encoded = (is_encoded && kind != PlaneKind::Id).then(|| {
        "the file says that its values are display-encoded colours; they were taken as the numbers they are".to_owned()
    });
    let pixels = size[0] as usize * size[1] as usize;
    let mut values = limits::reserve::<f32>(pixels)?;
    let mut coverage = limits::reserve::<f32>(if layout.alpha.is_some() { pixels } else { 0 })?;
    let mut differing = 0;
    for pixel in buffer.chunks_exact(layout.stride) {
        values.push(layout.value(pixel));
        differing += usize::from(layout.differs(pixel));
        coverage.extend(layout.alpha.map(|alpha| layout.sample(pixel, alpha) as f32 / layout.largest()));
    }
    report(progress, 2, 2)?;
    let coverage = layout.alpha.map(|_| coverage);
    let colours = kind.differing(&["R", "G", "B"], &layout.name, differing, pixels);
    let (channel, ids) = (layout.name, Ids { largest: layout.largest_id, exact: None });
    Ok(PlanePixels { size, channel, values, coverage, ids, warnings: encoded.into_iter().chain(colours).collect() })
}

/// Where the wanted numbers are in a pixel.
struct Layout {
    name: String,
    /// Bytes of a pixel.
    stride: usize,
    is_wide: bool,
    /// The channels that make the number: one, or three of a colour that stands for an id.
    channels: Vec<usize>,
    alpha: Option<usize>,
    /// The channels that should say the same, where nobody chose one of them.
    alike: Option<[usize; 3]>,
    /// What an integer is divided by.
    divisor: f32,
    largest_id: u32,
}

impl Layout {
    fn of(
        color: ColorType,
        depth: BitDepth,
        stored_depth: BitDepth,
        kind: PlaneKind,
        wanted: Option<&str>,
    ) -> Result<Self, PhotoErrorKind> {
        let names: &[&str] = match color {
            ColorType::Grayscale => &["Y"],
            ColorType::GrayscaleAlpha => &["Y", "A"],
            ColorType::Rgba => &["R", "G", "B", "A"],
            _ => &["R", "G", "B"],
        };
        let is_wide = depth == BitDepth::Sixteen;
        let alpha = names.iter().position(|name| *name == "A");
        let position = |name: &str| names.iter().position(|own| own.eq_ignore_ascii_case(name));
        let none = |wanted: &str| PhotoErrorKind::NoSuchLayer {
            wanted: wanted.to_owned(),
            layers: names.iter().map(ToString::to_string).collect(),
        };
        let is_colour_id = wanted.is_none() && kind == PlaneKind::Id && names.len() > 2;
        let channels = match wanted {
            Some(wanted) => vec![position(wanted).ok_or_else(|| none(wanted))?],
            None if is_colour_id && is_wide => {
                let what = "a 16-bit colour PNG of ids".to_owned();
                let advice = "save the ids as 8-bit colours or as 16-bit grey";
                return Err(PhotoErrorKind::Unsupported { what, advice });
            }
            None if is_colour_id => vec![0, 1, 2],
            None => vec![0],
        };
        let largest = if is_wide { 65535.0 } else { 255.0 };
        // The decoder widens small depths to 8 bits, which multiplies ids.
        let small = [(BitDepth::One, 255.0), (BitDepth::Two, 85.0), (BitDepth::Four, 17.0)];
        let factor = small.into_iter().find(|(depth, _)| *depth == stored_depth).map_or(1.0, |(_, factor)| factor);
        let divisor = match kind {
            PlaneKind::Id if color == ColorType::Grayscale => factor,
            PlaneKind::Id => 1.0,
            _ => largest,
        };
        let alike = (wanted.is_none() && kind != PlaneKind::Id && names.len() > 2).then_some([0, 1, 2]);
        // The largest sample, or three of 8 bits beside each other, which floats hold.
        let largest_id = if channels.len() > 1 { 0xff_ff_ff } else { (largest / divisor) as u32 };
        let name = channels.iter().map(|channel| names[*channel]).collect();
        let stride = names.len() * (1 + usize::from(is_wide));
        Ok(Self { name, stride, is_wide, channels, alpha, alike, divisor, largest_id })
    }

    /// True where the channels of a colour differ by more than rounding.
    fn differs(&self, pixel: &[u8]) -> bool {
        self.alike.is_some_and(|alike| {
            let samples = alike.map(|channel| self.sample(pixel, channel) as f32 / self.largest());
            samples.iter().any(|sample| (sample - samples[0]).abs() > DIFFERENT)
        })
    }

    fn largest(&self) -> f32 {
        if self.is_wide { 65535.0 } else { 255.0 }
    }

    fn sample(&self, pixel: &[u8], channel: usize) -> u32 {
        if self.is_wide {
            u32::from(u16::from_be_bytes([pixel[2 * channel], pixel[2 * channel + 1]]))
        } else {
            u32::from(pixel[channel])
        }
    }

    /// The number of a pixel; three channels are the digits of `#rrggbb`.
    fn value(&self, pixel: &[u8]) -> f32 {
        let number = self.channels.iter().fold(0, |number, channel| number << 8 | self.sample(pixel, *channel));
        number as f32 / self.divisor
    }
}
