//! Does a photograph that is damaged, hostile or no photograph at all give one clear sentence?

mod photo_files;

use std::fs;
use std::ops::ControlFlow;
use std::panic;

use edgewise::photo::{Photo, PhotoError, PhotoErrorKind};
use image::ExtendedColorType;
use photo_files::*;
use png::{BitDepth, ColorType};
use proptest::prelude::*;

fn go_on(_: f32) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn from_bytes(name: &str, bytes: &[u8]) -> Result<Photo, PhotoError> {
    Photo::from_bytes(name, bytes, &mut go_on)
}

#[track_caller]
fn assert_one_sentence(error: &PhotoError) {
    let text = error.to_string();
    assert!(text.lines().count() == 1 && text.len() < 400 && text.starts_with(&error.name), "{text}");
}

/// A small valid file of every format, with metadata that a reader has to parse.
fn files() -> Vec<(&'static str, Vec<u8>)> {
    let data: Vec<u8> = (0..32 * 16 * 3).map(|i| (i % 251) as u8).collect();
    let block = exif(Some(6), Some(65_535), Some("R03"));
    let profile = moxcms::ColorProfile::new_display_p3().encode().unwrap();
    let channel = |scale: f32| (0..64).map(|i| scale * i as f32).collect::<Vec<f32>>();
    let channels = [("A", channel(0.01)), ("B", channel(1.0)), ("G", channel(2.0)), ("R", channel(3.0))];
    let floats: Vec<u8> = (0..48).flat_map(|i| (i as f32).to_le_bytes()).collect();
    vec![
        ("a.png", png([32, 16], ColorType::Rgb, BitDepth::Eight, &data, &[gama(0.5), (*b"eXIf", block.clone())])),
        ("b.png", png_with_profile([32, 16], &data, &profile, &[])),
        ("a.jpg", jpeg([32, 16], &data, Some(&profile), Some(&block))),
        ("a.webp", webp([32, 16], &data, ExtendedColorType::Rgb8, Some(&profile), Some(&block))),
        ("a.tif", tiff([32, 16], &[8; 3], 1, &data, &[(274, vec![8])])),
        ("b.tif", tiff([4, 4], &[32; 3], 3, &floats, &[])),
        ("a.exr", exr([8, 8], &channels, None)),
        ("a.hdr", hdr("EXPOSURE=2\n", "+X 4 -Y 4", &[[10, 20, 30, 130]; 16])),
    ]
}

#[test]
fn every_file_of_this_test_is_valid() {
    for (name, bytes) in files() {
        from_bytes(name, &bytes).unwrap();
    }
}

#[test]
fn every_truncation_gives_a_picture_or_one_sentence() {
    quietly(|| {
        for (name, bytes) in files() {
            for length in (0..bytes.len()).step_by(1 + bytes.len() / 400) {
                if let Err(error) = from_bytes(name, &bytes[..length]) {
                    assert_one_sentence(&error);
                }
            }
        }
    });
}

/// A picture that was cut in its pixels must not be measured.
#[test]
fn a_file_without_its_end_is_refused() {
    for (name, bytes) in files().iter().filter(|(name, _)| !name.ends_with("tif")) {
        let error = from_bytes(name, &bytes[..bytes.len() - bytes.len().min(40) / 2]).unwrap_err();
        assert!(matches!(error.kind, PhotoErrorKind::Damaged { .. }), "{name} {error}");
    }
}

/// Decoders that panic are caught; their message would only clutter the report of the test.
fn quietly(work: impl FnOnce()) {
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let result = panic::catch_unwind(panic::AssertUnwindSafe(work));
    panic::set_hook(hook);
    if let Err(reason) = result {
        panic::resume_unwind(reason);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1500) })]

    /// Bytes turned at random give a picture or one sentence, never a panic.
    #[test]
    fn turned_bytes_give_a_picture_or_one_sentence(
        file in 0..8usize,
        turns in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let (name, mut bytes) = files().swap_remove(file);
        for (place, value) in turns {
            let place = place.index(bytes.len());
            bytes[place] = value;
        }
        if let Err(error) = from_bytes(name, &bytes) {
            assert_one_sentence(&error);
        }
    }
}

#[test]
fn gigantic_headers_are_refused_before_anything_is_allocated() {
    let mut ihdr = png([1, 1], ColorType::Rgb, BitDepth::Eight, &[0; 3], &[]);
    ihdr[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
    let crc = crc32(&ihdr[12..29]);
    ihdr[29..33].copy_from_slice(&crc.to_be_bytes());
    let mut sof = jpeg([16, 16], &[9; 768], None, None);
    let frame = sof.windows(2).position(|window| window == [0xff, 0xc0]).unwrap();
    sof[frame + 5..frame + 9].copy_from_slice(&[0xff; 4]);
    let files = [
        ("a.png", ihdr),
        ("a.jpg", sof),
        ("a.hdr", hdr("", "-Y 4000000000 +X 4000000000", &[])),
        ("a.tif", tiff([4_000_000_000, 4_000_000_000], &[8; 3], 1, &[0; 3], &[])),
    ];
    for (name, bytes) in files {
        let error = from_bytes(name, &bytes).unwrap_err();
        assert_one_sentence(&error);
        assert!(matches!(error.kind, PhotoErrorKind::TooLarge { .. }), "{error}");
        assert!(error.to_string().contains("limit of"), "{error}");
    }
}

/// ISO 3309, as PNG uses it.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 })
    })
}

/// An EXR header can ask for hundreds of gigabytes in a few hundred bytes.
#[test]
fn a_hostile_exr_window_is_refused() {
    let bytes = exr([8, 8], &[("R", vec![0.0; 64]), ("G", vec![0.0; 64]), ("B", vec![0.0; 64])], None);
    let window =
        bytes.windows(10).position(|window| window == b"dataWindow").unwrap() + b"dataWindow\0box2i\0".len() + 4;
    for (width, height) in [(200_000, 200_000), (2_000_000_000, 1), (16_383, 2_000_000)] {
        let mut hostile = bytes.clone();
        hostile[window + 8..window + 12].copy_from_slice(&i32::to_le_bytes(width));
        hostile[window + 12..window + 16].copy_from_slice(&i32::to_le_bytes(height));
        assert_one_sentence(&from_bytes("a.exr", &hostile).unwrap_err());
    }
}

#[test]
fn what_is_no_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing.png");
    let empty = folder.path().join("empty.png");
    fs::write(&empty, []).unwrap();
    let text = folder.path().join("text.png");
    fs::write(&text, "no picture at all").unwrap();
    let cases = [
        (missing.as_path(), "there is no such file"),
        (folder.path(), "a folder"),
        (&empty, "the file is empty"),
        (&text, "no picture known here"),
    ];
    for (path, expected) in cases {
        let error = Photo::open(path, &mut go_on).unwrap_err();
        assert_one_sentence(&error);
        assert!(error.to_string().contains(expected), "{error}");
    }
}

/// Opening a pipe for reading waits for a writer that never comes.
#[cfg(unix)]
#[test]
fn a_pipe_is_refused_instead_of_waited_for() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.png");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let error = Photo::open(&pipe, &mut go_on).unwrap_err();
    assert!(matches!(error.kind, PhotoErrorKind::NotAFile(_)), "{error}");
}

#[test]
fn raw_files_and_inks_are_refused_by_name() {
    let error = from_bytes("DSC_0001.NEF", b"MM\x00\x2a\x00\x00\x00\x08\x00\x00").unwrap_err();
    assert!(error.to_string().contains("Nikon NEF") && error.to_string().contains("16-bit linear TIFF"), "{error}");

    let ink = tiff([1, 1], &[8; 4], 1, &[0; 4], &[(262, vec![5])]);
    assert!(from_bytes("a.tif", &ink).unwrap_err().to_string().contains("CMYK"));

    // A JPEG frame header of four components.
    let mut sof = jpeg([16, 16], &[9; 768], None, None);
    let frame = sof.windows(2).position(|window| window == [0xff, 0xc0]).unwrap();
    sof[frame + 3] += 3;
    sof[frame + 9] = 4;
    sof.splice(frame + 19..frame + 19, [4, 0x11, 0]);
    let error = from_bytes("a.jpg", &sof).unwrap_err();
    assert_one_sentence(&error);
    assert!(error.to_string().contains("CMYK"), "{error}");
}

/// The whole picture is the first frame, and a warning says so.
#[test]
fn of_an_animation_the_first_frame_is_read() {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
    encoder.set_color(ColorType::Grayscale);
    encoder.set_animated(2, 0).unwrap();
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&[255, 0]).unwrap();
    writer.write_image_data(&[0, 255]).unwrap();
    writer.finish().unwrap();
    let photo = from_bytes("a.png", &bytes).unwrap();
    assert!(photo.warnings.iter().any(|warning| warning.code.id() == "animated"), "{:?}", photo.warnings);
    assert_eq!(photo.pixel(0, 0).unwrap().rgb.0, [1.0; 3]);
}
