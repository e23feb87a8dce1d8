//! Every way to read many pixels agrees with reading one at a time, for every kind of picture.

use half::f16;
use nalgebra::Matrix3;
use proptest::prelude::*;

use super::channel::{ChannelStatistics, ChannelValues};
use super::curve::Curve;
use super::linearizer::{Linearizer, rec709_from_primaries};
use super::orientation::Orientation;
use super::picture::Stored;
use super::samples::Samples;
use super::statistics::{TILES, usable_channels};
use super::{Area, AreaStatistics, ColourRule, Photo, Pixel, PixelFlags};
use crate::color::RgbSpace;

/// Samples of each kind, with clipped, black, negative and no numbers among them.
fn samples(kind: usize, codes: &[u16]) -> Samples {
    let float = |code: &u16| match code {
        0..500 => f32::NAN,
        500..1000 => f32::INFINITY,
        1000..1500 => f32::MAX,
        1500..4000 => 0.0,
        _ => f32::from(*code) / 20_000.0 - 0.5,
    };
    match kind {
        0 => Samples::U8(codes.iter().map(|code| (code >> 8) as u8).collect()),
        1 => Samples::U16(codes.to_vec()),
        2 => Samples::F16(codes.iter().map(|code| f16::from_f32(float(code))).collect()),
        _ => Samples::F32(codes.iter().map(float).collect()),
    }
}

/// What a random picture is made of.
#[derive(Clone, Debug)]
struct Made {
    kind: usize,
    channels: usize,
    size: [u32; 2],
    /// By its EXIF value.
    orientation: u32,
    is_curved: bool,
    is_wide: bool,
    is_linear: bool,
    codes: Vec<u16>,
}

impl Made {
    fn photo(&self) -> Photo {
        let [width, height] = self.size;
        let samples = samples(self.kind, &self.codes[..width as usize * height as usize * self.channels]);
        let curved = [Curve::Srgb, Curve::Power(2.2), Curve::Srgb];
        // The largest float has no finite square.
        let curves = if self.is_curved && self.kind < 3 { curved } else { [const { Curve::Linear }; 3] };
        let matrix = if self.is_wide { wide() } else { Matrix3::identity() };
        let linearizer = Linearizer::from_curves(curves, matrix, &samples);
        let orientation = Orientation::from_exif(self.orientation).unwrap();
        let (channels, size, is_linear) = (self.channels, self.size, self.is_linear);
        let stored = Stored { samples, channels, size, orientation, linearizer, is_linear };
        Photo::new("random", String::new(), ColourRule::Linear, stored)
    }
}

/// From the primaries of another space.
fn wide() -> Matrix3<f64> {
    let spaces = RgbSpace::ALL.into_iter();
    let mut matrices = spaces.filter_map(|space| rec709_from_primaries(space.primaries(), space.white()));
    matrices.find(|matrix| *matrix != Matrix3::identity()).expect("a space of other primaries")
}

fn photo() -> impl Strategy<Value = Photo> {
    let kinds = (0..4_usize, prop_oneof![Just(1_usize), Just(3)], 1..9_u32, any::<[bool; 3]>());
    let code = prop_oneof![any::<u16>(), 20_000..30_000_u16];
    let pictures = prop::array::uniform2(1..40_u32)
        .prop_flat_map(move |size| (Just(size), prop::collection::vec(code.clone(), 3 * (size[0] * size[1]) as usize)));
    (kinds, pictures).prop_map(|((kind, channels, orientation, is), (size, codes))| {
        let [is_curved, is_wide, is_linear] = is;
        Made { kind, channels, size, orientation, is_curved, is_wide, is_linear, codes }.photo()
    })
}

fn area() -> impl Strategy<Value = Area> {
    let rectangle =
        prop::array::uniform4(0.1..50.0_f64).prop_map(|[x, y, w, h]| Area::rectangle(x - 10.0, y - 10.0, w, h));
    let disc = prop::array::uniform3(0.1..40.0_f64).prop_map(|[x, y, radius]| Area::disc(x, y, radius));
    prop_oneof![rectangle, disc]
}

fn is_near(found: f64, expected: f64, scale: f64) -> bool {
    found == expected || (found - expected).abs() <= 1e-6 * scale || (found.is_nan() && expected.is_nan())
}

/// The pixels that each pixel of a preview of this size covers.
fn covered(photo: &Photo, preview: [u32; 2]) -> Vec<Vec<Pixel>> {
    let Stored { size, orientation, .. } = *photo.stored;
    let small = orientation.size(preview);
    let index = |place: u32, i: usize| (0..small[i]).find(|index| place < (index + 1) * size[i] / small[i]).unwrap();
    let mut stored = vec![Vec::new(); (small[0] * small[1]) as usize];
    for [x, y] in (0..photo.height).flat_map(|y| (0..photo.width).map(move |x| [x, y])) {
        let place = orientation.stored([x, y], size);
        stored[(index(place[1], 1) * small[0] + index(place[0], 0)) as usize].push(photo.pixel(x, y).unwrap());
    }
    let positions = (0..preview[1]).flat_map(|row| (0..preview[0]).map(move |column| [column, row]));
    let places = positions.map(|position| orientation.stored(position, small));
    places.map(|[x, y]| stored[(y * small[0] + x) as usize].clone()).collect()
}

/// The tile of an area that a pixel lies in.
fn tile_of(area: Area, column: u32, row: u32) -> usize {
    let [left, top, width, height] = area.bounds();
    let place = |pixel: u32, start: f64, size: f64| ((f64::from(pixel) + 0.5 - start) / size * TILES as f64) as usize;
    let last = TILES - 1;
    place(row, top, height).min(last) * TILES + place(column, left, width).min(last)
}

proptest! {
    #[test]
    fn rows_are_their_pixels(photo in photo(), start in 0..20_u32, length in 0..40_u32) {
        for row in 0..photo.height + 1 {
            let mut found = Vec::new();
            photo.for_each_of_row(row, start..start + length, |pixel| found.push(pixel));
            let expected: Vec<Pixel> = (start..start + length).filter_map(|column| photo.pixel(column, row)).collect();
            prop_assert_eq!(found, expected);
        }
    }

    #[test]
    fn small_pixels_are_the_means_of_what_they_cover(photo in photo(), max_side in 1..50_u32) {
        let preview = photo.preview(max_side);
        let covered = covered(&photo, [preview.width, preview.height]);
        for ((rgb, flags), pixels) in preview.rgb.iter().zip(&preview.flags).zip(covered) {
            let expected = pixels.iter().fold(PixelFlags::default(), |flags, pixel| flags.or(pixel.flags));
            prop_assert_eq!(flags.unpack(), expected);
            for (channel, found) in rgb.iter().enumerate() {
                let mean = pixels.iter().map(|pixel| pixel.rgb[channel]).sum::<f64>() / pixels.len() as f64;
                let scale = crate::number::largest(pixels.iter().flat_map(|pixel| pixel.rgb.0).map(f64::abs));
                let is_near = is_near(f64::from(*found), f64::from(mean as f32), scale);
                prop_assert!(is_near, "{found} {mean}");
            }
        }
    }

    #[test]
    fn statistics_are_those_of_the_pixels(photo in photo(), area in area()) {
        let found = AreaStatistics::of(&photo, area);
        let pixels: Vec<(u32, u32, Pixel)> =
            area.pixels(photo.width, photo.height).map(|(x, y)| (x, y, photo.pixel(x, y).unwrap())).collect();
        let count = |is: &dyn Fn(&Pixel) -> bool| pixels.iter().filter(|(_, _, pixel)| is(pixel)).count();
        prop_assert_eq!(found.pixels, pixels.len());
        prop_assert_eq!(found.black, count(&|pixel| pixel.flags.black));
        prop_assert_eq!(found.non_finite, count(&|pixel| pixel.flags.non_finite));
        for channel in 0..3 {
            prop_assert_eq!(found.clipped[channel], count(&|pixel| pixel.flags.clipped[channel]));
            let mut values = ChannelValues::with_capacity(0);
            for tile in 0..TILES * TILES {
                let of_tile = pixels.iter().filter(|(x, y, _)| tile_of(area, *x, *y) == tile);
                let usable = of_tile.filter(|(_, _, pixel)| usable_channels(pixel)[channel]);
                values.values.extend(usable.map(|(_, _, pixel)| pixel.rgb[channel] as f32));
                values.end_stretch(tile);
            }
            let expected = ChannelStatistics::of(&values);
            let scale = values.values.iter().fold(0.0, |scale: f64, v| scale.max(f64::from(v.abs())));
            let found = [
                found.mean,
                found.trimmed_mean,
                found.median,
                found.standard_deviation,
                found.standard_error,
                found.bimodality,
            ];
            for (found, expected) in found.map(|of| of[channel]).into_iter().zip(expected.numbers()) {
                prop_assert!(is_near(found, expected, scale.max(1.0)), "{found} {expected}");
            }
        }
    }
}
