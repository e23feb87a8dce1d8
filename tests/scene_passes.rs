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

/// 2²⁴ + 1 is no 32-bit float.
#[test]
fn ids_are_told_apart_as_far_as_the_file_does() {
    let ids = vec![16_777_216, 16_777_217, u32::MAX];
    let integers = exr_of((3, 1), vec![("A", floats(&[1.0; 3])), ("MaterialID", FlatSamples::U32(ids.clone()))]);
    let plane = read("a.exr", &integers, PlaneKind::Id, None).unwrap();
    assert_eq!((0..3).map(|pixel| plane.id(pixel).unwrap()).collect::<Vec<_>>(), ids);
    let largest = |name: &str, bytes: &[u8]| read(name, bytes, PlaneKind::Id, None).unwrap().ids.largest;
    assert_eq!(largest("a.exr", &integers), u32::MAX);
    assert_eq!(largest("a.exr", &exr_of((1, 1), vec![("id", floats(&[7.0]))])), 16_777_215);
    let half = FlatSamples::F16(vec![f16::from_f32(7.0)]);
    assert_eq!(largest("a.exr", &exr_of((1, 1), vec![("id", half)])), 2047);
    for (color, depth, data, expected) in [
        (ColorType::Grayscale, BitDepth::Four, &[0x3f][..], 15),
        (ColorType::Grayscale, BitDepth::Eight, &[1, 2], 255),
        (ColorType::Grayscale, BitDepth::Sixteen, &[0, 1, 0, 2], 65_535),
        (ColorType::Rgb, BitDepth::Eight, &[1, 2, 3, 4, 5, 6], 0xff_ff_ff),
    ] {
        assert_eq!(largest("a.png", &png([2, 1], color, depth, data, &[])), expected, "{color:?} {depth:?}");
    }
    let mixed = exr_of((3, 1), vec![("id", floats(&[7.5, -1.0, f32::NAN]))]);
    let mixed = read("a.exr", &mixed, PlaneKind::Id, None).unwrap();
    assert!((0..3).all(|pixel| mixed.id(pixel).is_none()));
}

/// A map of normals, a picture of ids or of colours is no facing ratio, although it has a channel that could be one.
#[test]
fn channels_that_differ_are_said_unless_one_was_named() {
    let of_exr = |names: [&'static str; 3], values: [[f32; 2]; 3]| {
        exr_of((2, 1), names.into_iter().zip(values).map(|(name, values)| (name, floats(&values))).collect())
    };
    let normals = [[0.1, 0.2], [0.5, 0.2], [0.9, 0.2]];
    for names in [["R", "G", "B"], ["X", "Y", "Z"], ["NdotV.R", "NdotV.G", "NdotV.B"]] {
        let bytes = of_exr(names, normals);
        let plane = read("a.exr", &bytes, PlaneKind::Facing, None).unwrap();
        let [told] = plane.warnings.as_slice() else { panic!("{:?}", plane.warnings) };
        assert!(told.starts_with(&format!("channels {} differ in 50.0 %", names.join(", "))), "{told}");
        assert!(told.contains(&format!("; {} was taken as the facing ratio", plane.channel)), "{told}");
        let taken = names.iter().position(|name| *name == plane.channel).unwrap();
        assert_eq!(plane.values, normals[taken]);
        let named = read("a.exr", &bytes, PlaneKind::Facing, Some(names[2])).unwrap();
        assert!(named.warnings.is_empty() && named.values == normals[2]);
        let grey = of_exr(names, [[0.25, 0.5]; 3]);
        assert!(read("a.exr", &grey, PlaneKind::Facing, None).unwrap().warnings.is_empty());
    }
    // A grey and a depth are no vector.
    let depth = exr_of((1, 1), vec![("Y", floats(&[0.5])), ("Z", floats(&[9.0]))]);
    assert!(read("a.exr", &depth, PlaneKind::Facing, None).unwrap().warnings.is_empty());
    let rgb = |data: &[u8]| png([2, 1], ColorType::Rgb, BitDepth::Eight, data, &[]);
    let plane = read("a.png", &rgb(&[255, 128, 0, 9, 9, 9]), PlaneKind::Facing, None).unwrap();
    assert!(plane.warnings[0].contains("50.0 %") && plane.warnings[0].contains("R was taken"), "{:?}", plane.warnings);
    let matte = read("a.png", &rgb(&[255, 0, 0, 0, 255, 0]), PlaneKind::Matte, None).unwrap();
    assert!(matte.warnings[0].contains("as the matte"), "{:?}", matte.warnings);
    assert!(read("a.png", &rgb(&[9, 9, 9, 7, 8, 7]), PlaneKind::Facing, None).unwrap().warnings.is_empty());
    assert!(read("a.png", &rgb(&[255, 128, 0, 9, 9, 9]), PlaneKind::Id, None).unwrap().warnings.is_empty());
    assert!(read("a.png", &rgb(&[255, 128, 0, 9, 9, 9]), PlaneKind::Facing, Some("G")).unwrap().warnings.is_empty());
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
