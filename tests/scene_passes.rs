//! Are facing-ratio passes, ids and mattes read as the numbers they are?

mod photo_files;

use std::ops::ControlFlow;

use edgewise::photo::{Plane, PlaneKind};
use edgewise::scene::{FacingPass, Masks};
use exr::prelude::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage};
use half::f16;
use photo_files::{gama, png};
use png::{BitDepth, ColorType};

fn read(name: &str, bytes: &[u8], kind: PlaneKind, channel: Option<&str>) -> Result<Plane, String> {
    let mut go = |_| ControlFlow::Continue(());
    Plane::from_bytes(name, bytes, kind, channel, &mut go).map_err(|error| error.to_string())
}

/// An OpenEXR of one part with any channels.
fn exr_of(size: (usize, usize), channels: Vec<(&str, FlatSamples)>) -> Vec<u8> {
    let list = channels.into_iter().map(|(name, samples)| AnyChannel::new(name, samples)).collect();
    let layer = Layer::new(size, LayerAttributes::default(), Encoding::FAST_LOSSLESS, AnyChannels::sort(list));
    let mut bytes = std::io::Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

fn floats(values: &[f32]) -> FlatSamples {
    FlatSamples::F32(values.to_vec())
}

#[test]
fn integers_are_shares_of_their_range_without_a_curve() {
    let eight = png([2, 1], ColorType::Grayscale, BitDepth::Eight, &[51, 255], &[]);
    assert_eq!(read("a.png", &eight, PlaneKind::Facing, None).unwrap().values, [0.2, 1.0]);
    let data = [0x33, 0x33, 0xff, 0xff];
    let sixteen = png([2, 1], ColorType::Grayscale, BitDepth::Sixteen, &data, &[gama(1.0 / 2.2)]);
    let plane = read("a.png", &sixteen, PlaneKind::Facing, None).unwrap();
    assert_eq!((plane.values.as_slice(), plane.channel.as_str()), ([0.2, 1.0].as_slice(), "Y"));
    assert!(plane.warnings[0].contains("display-encoded"), "{:?}", plane.warnings);
}

#[test]
fn alpha_is_coverage() {
    let rgba = png([2, 1], ColorType::Rgba, BitDepth::Eight, &[255, 0, 0, 51, 102, 0, 0, 0], &[]);
    let plane = read("a.png", &rgba, PlaneKind::Facing, None).unwrap();
    assert_eq!((plane.values, plane.coverage.unwrap(), plane.channel.as_str()), (vec![1.0, 0.4], vec![0.2, 0.0], "R"));
    // OpenEXR multiplies by alpha.
    let bytes = exr_of((2, 1), vec![("A", floats(&[0.5, 0.0])), ("Y", floats(&[0.25, 0.0]))]);
    let plane = read("a.exr", &bytes, PlaneKind::Facing, None).unwrap();
    assert_eq!((plane.values, plane.coverage.unwrap()), (vec![0.5, 0.0], vec![0.5, 0.0]));
    let seen = FacingPass { ratio: read("a.exr", &bytes, PlaneKind::Facing, None).unwrap() };
    let seen = seen.angles(&Masks::None, &[]).unwrap();
    assert_eq!((seen.report.seen, seen.report.background, seen.angles[0].total()), (1, 1, 0.5));
}

#[test]
fn the_channel_is_found_or_named() {
    let channels = || {
        vec![
            ("B", floats(&[0.0])),
            ("G", floats(&[0.0])),
            ("R", floats(&[0.9])),
            ("depth.Z", floats(&[9.0])),
            ("facing_ratio.V", FlatSamples::F16(vec![f16::from_f32(0.25)])),
        ]
    };
    let bytes = exr_of((1, 1), channels());
    let plane = read("a.exr", &bytes, PlaneKind::Facing, None).unwrap();
    assert_eq!((plane.channel.as_str(), plane.values[0]), ("facing_ratio.V", 0.25));
    assert_eq!(read("a.exr", &bytes, PlaneKind::Facing, Some("r")).unwrap().values, [0.9]);
    let refused = read("a.exr", &bytes, PlaneKind::Facing, Some("N")).unwrap_err();
    assert!(refused.contains("“N”") && refused.contains("depth.Z"), "{refused}");
    let unclear = exr_of((1, 1), vec![("u", floats(&[0.0])), ("v", floats(&[0.0]))]);
    assert!(read("a.exr", &unclear, PlaneKind::Facing, None).unwrap_err().contains("u, v"));
}

#[test]
fn ids_are_whole_numbers_of_any_depth() {
    let colours = png([2, 1], ColorType::Rgb, BitDepth::Eight, &[0xff, 0x80, 0x00, 0, 0, 7], &[]);
    assert_eq!(read("a.png", &colours, PlaneKind::Id, None).unwrap().values, [16_744_448.0, 7.0]);
    let wide = png([2, 1], ColorType::Grayscale, BitDepth::Sixteen, &[0x01, 0x00, 0, 9], &[]);
    assert_eq!(read("a.png", &wide, PlaneKind::Id, None).unwrap().values, [256.0, 9.0]);
    let small = png([2, 1], ColorType::Grayscale, BitDepth::Four, &[0x3f], &[]);
    assert_eq!(read("a.png", &small, PlaneKind::Id, None).unwrap().values, [3.0, 15.0]);
    let integers = exr_of((2, 1), vec![("MaterialID", FlatSamples::U32(vec![5, 70_000]))]);
    assert_eq!(read("a.exr", &integers, PlaneKind::Id, None).unwrap().values, [5.0, 70_000.0]);
}

#[test]
fn what_is_no_pass_is_refused_in_a_sentence() {
    let jpeg = b"\xff\xd8\xff\xe0 not really";
    assert!(read("a.jpg", jpeg, PlaneKind::Facing, None).unwrap_err().contains("OpenEXR or PNG"));
    assert!(read("a.png", &[], PlaneKind::Facing, None).unwrap_err().contains("empty"));
    let png = png([2, 2], ColorType::Grayscale, BitDepth::Eight, &[1, 2, 3, 4], &[]);
    for length in 0..png.len() {
        assert!(read("a.png", &png[..length], PlaneKind::Facing, None).is_err(), "{length}");
    }
    let bytes = exr_of((2, 2), vec![("Y", floats(&[0.1, 0.2, 0.3, 0.4]))]);
    for length in (0..bytes.len()).step_by(7) {
        assert!(read("a.exr", &bytes[..length], PlaneKind::Facing, None).is_err(), "{length}");
    }
}
