//! One channel of an OpenEXR, whatever its name, as the numbers it holds.

use std::io::Cursor;

use ::exr::block::read;
use ::exr::block::reader::Reader;
use ::exr::meta::attribute::SampleType;
use ::exr::meta::header::Header;

use super::alpha::AlphaSample;
use super::exr::{self, Layer};
use super::{Progress, limits};
use crate::photo::PhotoErrorKind;
use crate::photo::plane::{DIFFERENT, Ids, PlaneKind, PlanePixels};

/// One channel as it is stored, whatever its name, and the alpha beside it.
///
/// Data are multiplied by alpha as colours are (OpenEXR, "Technical introduction", 2023): a facing ratio is divided by
/// it, so that an edge has the ratio of its surface. Ids and mattes stay as they are.
pub(super) fn plane(
    bytes: &[u8],
    kind: PlaneKind,
    wanted: Option<&str>,
    progress: Progress<'_>,
) -> Result<PlanePixels, PhotoErrorKind> {
    let reader = read(Cursor::new(bytes), false).map_err(exr::damaged)?;
    exr::check_headers(reader.headers(), bytes.len())?;
    let all = channels(reader.headers());
    let chosen = choose_channel(&all, kind, wanted)?;
    // A channel that a person chose is meant, and ids are what they are.
    let alike = if wanted.is_none() && kind != PlaneKind::Id { alike(&all, chosen) } else { Vec::new() };
    let colours = std::iter::once(chosen.index).chain(alike.iter().map(|other| other.index)).collect();
    let alpha = alpha_beside(&all, chosen).map(|alpha| alpha.index);
    let layer = Layer { part: chosen.part, name: chosen.name.clone(), colours, alpha };
    let header = &reader.headers()[layer.part];
    let samples = header.channels.list[chosen.index].sample_type;
    let size = exr::size_of_header(header, 4 * (layer.channels().count() as u64 + 2))?;
    if kind == PlaneKind::Id && samples == SampleType::U32 {
        return whole_numbers(reader, Layer { alpha: None, ..layer }, size, progress);
    }
    let Separate { mut values, coverage, differing } =
        Separate::of(exr::interleaved(reader, &layer, size, progress)?, &layer)?;
    let warning = kind.differing(&in_order(chosen, &alike), &layer.name, differing, values.len());
    if let Some(alpha) = coverage.as_ref().filter(|_| kind == PlaneKind::Facing) {
        values.iter_mut().zip(alpha).for_each(|(value, alpha)| *value = value.divided_by(*alpha));
    }
    let ids = if samples == SampleType::F16 { Ids::OF_HALVES } else { Ids::OF_FLOATS };
    Ok(PlanePixels { size, channel: layer.name, values, coverage, ids, warnings: warning.into_iter().collect() })
}

/// Ids as they are: floats would round those above 2²⁴.
fn whole_numbers(
    reader: Reader<Cursor<&[u8]>>,
    layer: Layer,
    size: [u32; 2],
    progress: Progress<'_>,
) -> Result<PlanePixels, PhotoErrorKind> {
    let exact: Vec<u32> = exr::interleaved(reader, &layer, size, progress)?;
    let values = exact.iter().map(|id| *id as f32).collect();
    let ids = Ids { largest: u32::MAX, exact: Some(exact) };
    Ok(PlanePixels { size, channel: layer.name, values, coverage: None, ids, warnings: Vec::new() })
}

/// What follows the last dot of a channel's name, in small letters.
fn last_part(name: &str) -> String {
    name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase()
}

/// The channels that make a colour or a vector with one of them, without that one.
fn alike<'a>(all: &'a [Channel], chosen: &Channel) -> Vec<&'a Channel> {
    let own = last_part(&chosen.name);
    let Some(family) = ["rgb", "xyz"].into_iter().find(|family| own.len() == 1 && family.contains(&own)) else {
        return Vec::new();
    };
    let prefix = chosen.name.len() - own.len();
    let is_beside = |other: &&Channel| {
        let last = last_part(&other.name);
        other.part == chosen.part
            && other.index != chosen.index
            && other.name.get(..prefix) == chosen.name.get(..prefix)
            && other.name.len() == chosen.name.len()
            && family.contains(&last)
    };
    let others: Vec<&Channel> = all.iter().filter(is_beside).collect();
    // Y and Z without X are a grey and a depth.
    if family == "xyz" && others.len() < 2 { Vec::new() } else { others }
}

/// The alpha of the channels with the same name before the dot.
fn alpha_beside<'a>(all: &'a [Channel], chosen: &Channel) -> Option<&'a Channel> {
    let name = chosen.name.rsplit_once('.').map_or("A".to_owned(), |(prefix, _)| format!("{prefix}.A"));
    let is_alpha = |other: &&Channel| other.part == chosen.part && other.name.eq_ignore_ascii_case(&name);
    all.iter().find(is_alpha).filter(|alpha| alpha.index != chosen.index)
}

/// The names of channels that should say the same, in the order in which people say them.
fn in_order<'a>(chosen: &'a Channel, alike: &[&'a Channel]) -> Vec<&'a str> {
    let mut names: Vec<&str> = alike.iter().copied().chain([chosen]).map(|channel| channel.name.as_str()).collect();
    names.sort_unstable_by_key(|name| "rgbxyz".find(&last_part(name)));
    names
}

/// The wanted channel of a plane and the alpha beside it, apart.
struct Separate {
    values: Vec<f32>,
    coverage: Option<Vec<f32>>,
    /// Pixels in which a channel that should say the same says something else.
    differing: usize,
}

impl Separate {
    /// From pixels of the wanted channel, those like it, and perhaps alpha.
    fn of(interleaved: Vec<f32>, layer: &Layer) -> Result<Self, PhotoErrorKind> {
        let (colours, channels) = (layer.colours.len(), layer.channels().count());
        if channels == 1 {
            return Ok(Self { values: interleaved, coverage: None, differing: 0 });
        }
        let pixels = interleaved.len() / channels;
        let mut values = limits::reserve(pixels)?;
        let mut coverage = limits::reserve(if layer.alpha.is_some() { pixels } else { 0 })?;
        let mut differing = 0;
        for pixel in interleaved.chunks_exact(channels) {
            values.push(pixel[0]);
            coverage.extend(pixel.get(colours));
            differing += usize::from(pixel[1..colours].iter().any(|other| (other - pixel[0]).abs() > DIFFERENT));
        }
        Ok(Self { values, coverage: layer.alpha.map(|_| coverage), differing })
    }
}

/// A channel of any part.
struct Channel {
    part: usize,
    index: usize,
    /// With the part's name before it, where there are several.
    name: String,
}

fn channels(headers: &[Header]) -> Vec<Channel> {
    let in_part = |(part, header): (usize, &Header)| -> Vec<Channel> {
        let own_name = header.own_attributes.layer_name.as_ref().map(ToString::to_string).unwrap_or_default();
        let name = |channel: &str| match own_name.as_str() {
            own if headers.len() > 1 && !own.is_empty() => format!("{own}.{channel}"),
            _ => channel.to_owned(),
        };
        let list = header.channels.list.iter().enumerate();
        list.map(|(index, channel)| Channel { part, index, name: name(&channel.name.to_string()) }).collect()
    };
    headers.iter().enumerate().flat_map(in_part).collect()
}

/// The channel asked for; else the one whose name says what is looked for, a single one, or the grey or red of a picture.
fn choose_channel<'a>(
    all: &'a [Channel],
    kind: PlaneKind,
    wanted: Option<&str>,
) -> Result<&'a Channel, PhotoErrorKind> {
    let names = || all.iter().map(|channel| channel.name.clone()).collect();
    if let Some(wanted) = wanted {
        let found = all.iter().find(|channel| channel.name.eq_ignore_ascii_case(wanted));
        return found.ok_or_else(|| PhotoErrorKind::NoSuchLayer { wanted: wanted.to_owned(), layers: names() });
    }
    let plain = |name: &str| name.to_ascii_lowercase().replace(['_', '-', ' '], "");
    let is_named = |channel: &&Channel| kind.names().iter().any(|name| plain(&channel.name).contains(name));
    let is_called = |wanted: &'static str| move |channel: &&Channel| channel.name.eq_ignore_ascii_case(wanted);
    let mut of_surface = all.iter().filter(|channel| !is_called("A")(channel));
    let single = of_surface.next().filter(|_| of_surface.next().is_none());
    let found = all.iter().find(is_named).or(single).or_else(|| all.iter().find(is_called("Y")));
    found.or_else(|| all.iter().find(is_called("R"))).ok_or_else(|| PhotoErrorKind::ChooseLayer { layers: names() })
}
