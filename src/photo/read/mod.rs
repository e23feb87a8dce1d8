//! From the bytes of a file to stored samples and the way to linear Rec.709.
//!
//! A reader of a format decodes at full depth and says which colours the file speaks of; what they mean is
//! decided here, once, for every format.

mod alpha;
mod cicp;
mod colour;
mod data;
mod exif;
mod exr;
mod exr_plane;
mod hdr;
mod icc;
mod jpeg;
mod jpeg_small;
mod limits;
mod png;
mod raw;
mod sniff;
mod tiff;
mod watched;
mod webp;

use std::fs::{self, File};
use std::io::Read;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use sha2::{Digest, Sha256};

use self::colour::Colour;
pub(super) use self::data::plane;
use self::sniff::Format;
use super::census::Census;
use super::orientation::Orientation;
use super::picture::{OpenOptions, Photo, Stored};
use super::samples::Samples;
use super::{FirstLook, PhotoErrorKind, Warning, WarningCode};

/// Hears the fraction that is done, and may stop the work.
type Progress<'a> = &'a mut dyn FnMut(f32) -> ControlFlow<()>;

/// Hears a first look, from another thread, before the photograph is there.
pub(super) type Look<'a> = &'a mut (dyn FnMut(FirstLook) + Send);

/// What a reader of a format hands over.
struct Decoded {
    samples: Samples,
    /// 1 for grey, 3 for RGB; alpha is gone.
    channels: usize,
    size: [u32; 2],
    orientation: Orientation,
    colour: Colour,
    layers: Vec<String>,
    warnings: Vec<Warning>,
}

/// The bytes of a regular file within the limit. A pipe or a device would block for ever, so it is refused.
pub(super) fn file_bytes(path: &Path) -> Result<Vec<u8>, PhotoErrorKind> {
    let metadata = fs::metadata(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => PhotoErrorKind::Missing,
        _ => PhotoErrorKind::Io(error),
    })?;
    match metadata.file_type() {
        kind if kind.is_dir() => return Err(PhotoErrorKind::NotAFile("a folder")),
        kind if !kind.is_file() => return Err(PhotoErrorKind::NotAFile("a pipe or a device")),
        _ => limits::check_file(metadata.len())?,
    }
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(metadata.len() as usize).map_err(|_| limits::out_of_memory(metadata.len()))?;
    File::open(path)?.take(limits::FILE_BYTES).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Reads a photograph; the hash and a first look are taken at the same time.
pub(super) fn photo(
    name: &str,
    bytes: &[u8],
    options: &OpenOptions,
    look: Option<Look<'_>>,
    progress: Progress<'_>,
) -> Result<Photo, PhotoErrorKind> {
    if bytes.is_empty() {
        return Err(PhotoErrorKind::Empty);
    }
    limits::check_file(bytes.len() as u64)?;
    std::thread::scope(|scope| {
        let format = sniff::format(name, bytes)?;
        let look = look.filter(|_| format == Format::Jpeg);
        // One thread beside the decoder's: a person waits for the look, and nobody for the hash.
        let sha256 = scope.spawn(move || {
            if let Some(look) = look {
                first_look(bytes, options).map(look);
            }
            sha256(bytes)
        });
        let decoded = decode(format, bytes, options, progress)?;
        Ok(finish(name, sha256.join().expect("neither a look nor hashing panics"), decoded, options))
    })
}

/// A first look at a JPEG, if one can be had before the whole.
fn first_look(bytes: &[u8], options: &OpenOptions) -> Option<FirstLook> {
    /// What is decoded in less than a tenth of a second needs none.
    const LARGE_SIDE: u32 = 2048;
    const LOOK_SIDE: u32 = 1024;
    let small = catch_unwind(AssertUnwindSafe(|| jpeg_small::decode(bytes)));
    let (decoded, full) = small.ok().flatten()?;
    let [width, height] = decoded.orientation.size(full);
    (width.max(height) >= LARGE_SIDE).then(|| {
        let preview = finish("", String::new(), decoded, options).preview(LOOK_SIDE);
        FirstLook { width, height, preview }
    })
}

/// Decodes; a decoder that panics on a damaged file must not take the program with it.
fn decode(
    format: Format,
    bytes: &[u8],
    options: &OpenOptions,
    progress: Progress<'_>,
) -> Result<Decoded, PhotoErrorKind> {
    let decode = || match format {
        Format::Png => png::decode(bytes, progress),
        Format::Jpeg => jpeg::decode(bytes, progress),
        Format::Exr => exr::decode(bytes, options.layer.as_deref(), progress),
        Format::Tiff => tiff::decode(bytes, progress),
        Format::WebP => webp::decode(bytes, progress),
        Format::Hdr => hdr::decode(bytes, progress),
    };
    catch_unwind(AssertUnwindSafe(decode))
        .unwrap_or_else(|_| Err(PhotoErrorKind::damaged(format.label())(&"its decoder gave up")))
}

fn finish(name: &str, sha256: String, decoded: Decoded, options: &OpenOptions) -> Photo {
    let Decoded { samples, channels, size, orientation, colour, layers, mut warnings } = decoded;
    let (linearizer, rule) = colour.resolve(&samples, channels, options.untagged, &mut warnings);
    let is_linear = rule.is_scene_linear();
    let stored = Stored { samples, channels, size, orientation, linearizer, is_linear };
    warnings.extend(Census::of(&stored).warnings());
    let photo = Photo::new(name, sha256, rule, stored);
    Photo { layers, warnings, ..photo }
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Tells how far the work is, and fails if it is to stop.
fn report(progress: Progress<'_>, done: usize, all: usize) -> Result<(), PhotoErrorKind> {
    match progress(done as f32 / all.max(1) as f32) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(PhotoErrorKind::Cancelled),
    }
}

/// The warning that the first of several pictures was read.
fn several(what: &str) -> Warning {
    Warning::new(WarningCode::Animated, format!("The file holds several {what}; the first one was read"))
}
