//! Is a photograph read as linear Rec.709, by the right rule, from every format, and nothing hidden?

mod photo_files;

use std::ops::ControlFlow;

use edgewise::color::{Rgb, RgbSpace, srgb_decode};
use edgewise::photo::{OpenOptions, Photo, PhotoError, PhotoErrorKind, Untagged, WarningCode};
use image::ExtendedColorType;
use photo_files::*;
use png::{BitDepth, ColorType};

/// A colour with three different codes.
const CODE: [u8; 3] = [200, 100, 50];

fn go_on(_: f32) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn read(name: &str, bytes: &[u8]) -> Photo {
    Photo::from_bytes(name, bytes, &mut go_on).unwrap()
}

fn refused(name: &str, bytes: &[u8]) -> PhotoError {
    Photo::from_bytes(name, bytes, &mut go_on).unwrap_err()
}

fn codes(photo: &Photo) -> Vec<WarningCode> {
    photo.warnings.iter().map(|warning| warning.code).collect()
}

fn colour(photo: &Photo) -> Rgb {
    photo.pixel(0, 0).unwrap().rgb
}

#[track_caller]
fn assert_near(got: Rgb, expected: Rgb, tolerance: f64) {
    assert!(got.max_abs_difference(expected) < tolerance, "{got:?} is not {expected:?}");
}

/// An 8-bit PNG of one colour.
fn png8(chunks: &[PngChunk]) -> Vec<u8> {
    png([2, 2], ColorType::Rgb, BitDepth::Eight, &CODE.repeat(4), chunks)
}

/// What a code means through a curve, in linear Rec.709.
fn expected(curve: impl Fn(f64) -> f64, space: RgbSpace) -> Rgb {
    space.convert(Rgb(CODE.map(|v| curve(f64::from(v) / 255.0))), RgbSpace::LinRec709)
}

fn srgb() -> Rgb {
    expected(srgb_decode, RgbSpace::LinRec709)
}

const CICP_P3: [u8; 4] = [12, 13, 0, 1];

#[test]
fn png_statements_count_in_the_order_of_its_specification() {
    let p3 = moxcms::ColorProfile::new_display_p3().encode().unwrap();
    let cicp = || (*b"cICP", CICP_P3.to_vec());
    let srgb_chunk = || (*b"sRGB", vec![0]);
    let chrm_2020 = || chrm([0.3127, 0.329, 0.708, 0.292, 0.17, 0.797, 0.131, 0.046]);

    let photo = read("a.png", &png8(&[]));
    assert!(photo.colour_rule.is_assumed() && codes(&photo) == [WarningCode::Assumed]);
    assert_near(colour(&photo), srgb(), 1e-6);

    let photo = read("a.png", &png8(&[gama(1.0)]));
    assert!(photo.is_scene_linear() && codes(&photo) == [WarningCode::Assumed]);
    assert_near(colour(&photo), expected(|x| x, RgbSpace::LinRec709), 1e-6);

    let photo = read("a.png", &png8(&[gama(0.5), chrm_2020()]));
    assert_eq!((codes(&photo), photo.colour_rule.to_string().as_str()), (vec![], "PNG gAMA 0.5 and cHRM"));
    assert_near(colour(&photo), expected(|x| x * x, RgbSpace::LinRec2020), 1e-6);

    let photo = read("a.png", &png8(&[srgb_chunk(), gama(1.0), chrm_2020()]));
    assert_eq!((codes(&photo), photo.colour_rule.to_string().as_str()), (vec![], "PNG sRGB chunk: sRGB"));
    assert_near(colour(&photo), srgb(), 1e-6);

    let photo = read("a.png", &png_with_profile([2, 2], &CODE.repeat(4), &p3, &[gama(1.0)]));
    assert_eq!(photo.colour_rule.to_string(), "ICC profile: Display P3");
    assert_near(colour(&photo), expected(srgb_decode, RgbSpace::LinDisplayP3), 3e-4);

    let photo = read("a.png", &png_with_profile([2, 2], &CODE.repeat(4), &p3, &[(*b"cICP", vec![9, 8, 0, 1])]));
    assert!(photo.colour_rule.to_string().starts_with("PNG cICP") && photo.is_scene_linear());
    assert_near(colour(&photo), expected(|x| x, RgbSpace::LinRec2020), 1e-6);

    let photo = read("a.png", &png8(&[cicp(), srgb_chunk()]));
    assert_near(colour(&photo), expected(srgb_decode, RgbSpace::LinDisplayP3), 1e-6);
    // Red beyond Rec.709 stays beyond: nothing is clamped.
    assert!(
        read("a.png", &png([1, 1], ColorType::Rgb, BitDepth::Eight, &[200, 0, 0], &[cicp()])).pixel(0, 0).unwrap().rgb
            [1]
            < 0.0
    );
}

#[test]
fn a_statement_that_cannot_be_followed_is_named_and_the_next_one_counts() {
    let bad = [
        png8(&[(*b"cICP", vec![2, 2, 0, 1])]),
        png8(&[(*b"cICP", vec![1, 13, 0, 0])]),
        png8(&[(*b"iCCP", b"x\0\0rubbish".to_vec())]),
        png8(&[gama(0.0)]),
        png_with_profile([2, 2], &CODE.repeat(4), b"rubbish", &[]),
        png8(&[chrm([0.3; 8]), gama(0.5)]),
    ];
    for bytes in bad {
        let photo = read("a.png", &bytes);
        assert_eq!(codes(&photo), [WarningCode::Profile, WarningCode::Assumed], "{:?}", photo.warnings);
        assert_near(colour(&photo), srgb(), 1e-6);
    }
}

#[test]
fn png_depths_agree() {
    let wide: Vec<u8> = CODE.iter().flat_map(|v| (u16::from(*v) * 257).to_be_bytes()).collect();
    let sixteen = read("a.png", &png([1, 1], ColorType::Rgb, BitDepth::Sixteen, &wide, &[]));
    assert_near(colour(&sixteen), srgb(), 1e-6);

    let grey = read("a.png", &png([1, 1], ColorType::Grayscale, BitDepth::Eight, &[100], &[]));
    assert_near(colour(&grey), Rgb::splat(srgb_decode(100.0 / 255.0)), 1e-6);

    let four_bits = read("a.png", &png([2, 1], ColorType::Grayscale, BitDepth::Four, &[0x5a], &[]));
    assert_near(colour(&four_bits), Rgb::splat(srgb_decode(5.0 / 15.0)), 1e-6);

    let mut palette = png_info([2, 1], ColorType::Indexed, BitDepth::One);
    palette.palette = Some(vec![0, 0, 0, CODE[0], CODE[1], CODE[2]].into());
    assert_near(colour(&read("a.png", &png_of(palette, &[0b1000_0000], &[]))), srgb(), 1e-6);
}

#[test]
fn alpha_is_ignored_and_said() {
    let rgba = |alpha| {
        png([1, 1], ColorType::Rgba, BitDepth::Eight, &[CODE[0], CODE[1], CODE[2], alpha], &[(*b"sRGB", vec![0])])
    };
    assert_eq!(codes(&read("a.png", &rgba(255))), []);
    let photo = read("a.png", &rgba(128));
    assert_eq!(codes(&photo), [WarningCode::Alpha]);
    assert_near(colour(&photo), srgb(), 1e-6);
}

/// Four corners of different lightness, in the order top left, top right, bottom left, bottom right, as EXIF
/// (CIPA DC-008-2019, tag 274) describes the stored picture for each orientation.
fn corners(photo: &Photo) -> [usize; 4] {
    let [right, bottom] = [photo.width - 1, photo.height - 1];
    [[0, 0], [right, 0], [0, bottom], [right, bottom]].map(|[column, row]| {
        let lightness = photo.pixel(column, row).unwrap().rgb[1];
        (0..4).min_by(|a, b| distance(lightness, *a).total_cmp(&distance(lightness, *b))).unwrap()
    })
}

const CORNER_CODES: [u8; 4] = [40, 100, 160, 220];

fn distance(lightness: f64, corner: usize) -> f64 {
    (lightness - srgb_decode(f64::from(CORNER_CODES[corner]) / 255.0)).abs()
}

/// 32 × 16 pixels in four quarters, so that JPEG blocks keep them apart.
fn quarters() -> Vec<u8> {
    let code = |x: usize, y: usize| CORNER_CODES[usize::from(x >= 16) + 2 * usize::from(y >= 8)];
    (0..16).flat_map(|y| (0..32).flat_map(move |x| [code(x, y); 3])).collect()
}

/// Where each stored quarter is seen: EXIF names the visual place of the stored first row and first column.
const SEEN: [[usize; 4]; 8] =
    [[0, 1, 2, 3], [1, 0, 3, 2], [3, 2, 1, 0], [2, 3, 0, 1], [0, 2, 1, 3], [2, 0, 3, 1], [3, 1, 2, 0], [1, 3, 0, 2]];

#[test]
fn exif_orientation_is_applied_in_every_format_that_carries_it() {
    for (orientation, seen) in (1u16..).zip(SEEN) {
        let block = exif(Some(orientation), None, None);
        let files = [
            ("a.jpg", jpeg([32, 16], &quarters(), None, Some(&block))),
            ("a.png", png([32, 16], ColorType::Rgb, BitDepth::Eight, &quarters(), &[(*b"eXIf", block.clone())])),
            ("a.tif", tiff([32, 16], &[8; 3], 1, &quarters(), &[(274, vec![orientation.into()])])),
            ("a.webp", webp([32, 16], &quarters(), ExtendedColorType::Rgb8, None, Some(&block))),
        ];
        for (name, bytes) in files {
            let photo = read(name, &bytes);
            let size = if orientation < 5 { [32, 16] } else { [16, 32] };
            assert_eq!([photo.width, photo.height], size, "{name} {orientation}");
            assert_eq!(corners(&photo), seen, "{name} {orientation}");
        }
    }
}

#[test]
fn jpeg_statements_count_in_order() {
    let p3 = moxcms::ColorProfile::new_display_p3().encode().unwrap();
    let data = CODE.repeat(256);
    let of = |profile: Option<&[u8]>, exif: Option<&[u8]>| read("a.jpg", &jpeg([16, 16], &data, profile, exif));
    // One code of the encoder's colour conversion.
    let tolerance = 0.01;

    let photo = of(None, None);
    assert_eq!(codes(&photo), [WarningCode::Assumed]);
    assert_near(colour(&photo), srgb(), tolerance);
    let photo = of(None, Some(&exif(None, Some(1), None)));
    assert_eq!((codes(&photo), photo.colour_rule.to_string().as_str()), (vec![], "EXIF: sRGB"));
    let adobe = of(None, Some(&exif(None, Some(65_535), Some("R03"))));
    assert_eq!((codes(&adobe), adobe.colour_rule.to_string().as_str()), (vec![], "EXIF: Adobe RGB (1998)"));
    assert_eq!(codes(&of(None, Some(&exif(None, Some(65_535), None)))), [WarningCode::Assumed]);

    let photo = of(Some(&p3), Some(&exif(None, Some(1), None)));
    assert_eq!(photo.colour_rule.to_string(), "ICC profile: Display P3");
    assert_near(colour(&photo), expected(srgb_decode, RgbSpace::LinDisplayP3), tolerance);
    // Adobe's own profile and the EXIF shorthand for it mean the same.
    let profile = moxcms::ColorProfile::new_adobe_rgb().encode().unwrap();
    assert_near(colour(&of(Some(&profile), None)), colour(&adobe), 1e-3);
}

#[test]
fn a_joined_profile_with_a_missing_part_is_said() {
    let long = vec![7; 100_000];
    let bytes = jpeg([16, 16], &CODE.repeat(256), Some(&long), None);
    let second = bytes.windows(14).rposition(|window| window.starts_with(b"ICC_PROFILE\0")).unwrap();
    let mut broken = bytes.clone();
    broken[second + 12] = 1;
    let photo = read("a.jpg", &broken);
    assert_eq!(codes(&photo), [WarningCode::Profile, WarningCode::Assumed]);
    assert!(photo.warnings[0].message.contains("incomplete"));
}

fn le16(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

fn le32(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

#[test]
fn tiff_depths_and_layouts_agree() {
    let wide = CODE.map(|v| u16::from(v) * 257);
    let linear = srgb().0.map(|v| v as f32);
    let halves = linear.map(|v| half::f16::from_f32(v).to_bits());
    let doubles: Vec<u8> = linear.iter().flat_map(|v| f64::from(*v).to_le_bytes()).collect();
    let planes: Vec<u8> = CODE.iter().flat_map(|v| [*v; 4]).collect();
    // A planar file has one strip for each plane.
    let planar = [(284, vec![2]), (273, vec![8, 12, 16]), (279, vec![4; 3])];
    let cases = [
        (tiff([2, 2], &[8; 3], 1, &CODE.repeat(4), &[]), 1e-6),
        (tiff([2, 2], &[16; 3], 1, &le16(&wide.repeat(4)), &[]), 1e-6),
        (tiff([2, 2], &[32; 3], 3, &le32(&linear.repeat(4)), &[]), 1e-6),
        (tiff([2, 2], &[16; 3], 3, &le16(&halves.repeat(4)), &[]), 1e-3),
        (tiff([2, 2], &[64; 3], 3, &doubles.repeat(4), &[]), 1e-6),
        (tiff([2, 2], &[8; 3], 1, &planes, &planar), 1e-6),
    ];
    for (bytes, tolerance) in cases {
        let photo = read("a.tif", &bytes);
        assert_eq!(codes(&photo), [WarningCode::Assumed]);
        for (column, row) in [(0, 0), (1, 1)] {
            assert_near(photo.pixel(column, row).unwrap().rgb, srgb(), tolerance);
        }
    }
    let grey = read("a.tif", &tiff([2, 2], &[32], 3, &le32(&[0.25, 2.0, -1.0, 0.0]), &[]));
    assert_eq!(grey.pixel(1, 0).unwrap().rgb, Rgb::splat(2.0));
    assert_eq!(codes(&grey), [WarningCode::Assumed, WarningCode::Negative]);
    assert!(grey.is_scene_linear());
}

#[test]
fn tiff_statements_count_in_order() {
    let of = |bits: u32, more: &[(u16, Vec<u32>)]| {
        let data = if bits == 32 { le32(&[0.5; 12]) } else { CODE.repeat(4) };
        read("a.tif", &tiff([2, 2], &[bits; 3], if bits == 32 { 3 } else { 1 }, &data, more))
    };
    let profile = moxcms::ColorProfile::new_display_p3().encode().unwrap();
    let icc = (34_675, profile.iter().map(|v| u32::from(*v)).collect());
    let photo = of(8, &[icc]);
    assert_eq!(photo.colour_rule.to_string(), "ICC profile: Display P3");
    assert_near(colour(&photo), expected(srgb_decode, RgbSpace::LinDisplayP3), 3e-4);
    assert_eq!(codes(&of(8, &[(34_675, vec![1, 2, 3, 4, 5])])), [WarningCode::Profile, WarningCode::Assumed]);

    let rational = |values: &[u32]| values.iter().flat_map(|v| [*v, 1000]).collect::<Vec<_>>();
    let p3 = [(318, vec![3127, 10_000, 3290, 10_000]), (319, rational(&[680, 320, 265, 690, 150, 60]))];
    let photo = of(8, &p3);
    assert_eq!(photo.colour_rule.to_string(), "TIFF primaries; sRGB curve assumed");
    assert_near(colour(&photo), expected(srgb_decode, RgbSpace::LinDisplayP3), 1e-6);
    assert!(of(32, &p3).is_scene_linear() && of(32, &p3).colour_rule.is_assumed());
}

#[test]
fn tiff_alpha_is_divided_out_or_ignored() {
    let of = |kind: u32| read("a.tif", &tiff([1, 1], &[32; 4], 3, &le32(&[0.2, 0.1, 0.05, 0.5]), &[(338, vec![kind])]));
    assert_near(colour(&of(1)), Rgb([0.4, 0.2, 0.1]), 1e-7);
    assert_near(colour(&of(2)), Rgb([0.2, 0.1, 0.05]), 1e-7);
    assert_eq!(codes(&of(1)), [WarningCode::Alpha, WarningCode::Assumed]);
}

#[test]
fn webp_is_read_without_loss_and_with_its_profile() {
    let data = CODE.repeat(16);
    let photo = read("a.webp", &webp([4, 4], &data, ExtendedColorType::Rgb8, None, None));
    assert_eq!(codes(&photo), [WarningCode::Assumed]);
    assert_near(colour(&photo), srgb(), 1e-6);
    let profile = moxcms::ColorProfile::new_display_p3().encode().unwrap();
    let photo = read("a.webp", &webp([4, 4], &data, ExtendedColorType::Rgb8, Some(&profile), None));
    assert_near(colour(&photo), expected(srgb_decode, RgbSpace::LinDisplayP3), 3e-4);
    let rgba = [CODE[0], CODE[1], CODE[2], 100].repeat(16);
    let photo = read("a.webp", &webp([4, 4], &rgba, ExtendedColorType::Rgba8, None, None));
    assert!(codes(&photo).contains(&WarningCode::Alpha));
    assert_near(colour(&photo), srgb(), 1e-6);
}

/// Ward's format: value = mantissa / 256 · 2^(exponent − 128).
#[test]
fn radiance_values_are_undone_to_radiance() {
    let pixel = [128, 64, 32, 129];
    let value = Rgb([1.0, 0.5, 0.25]);
    let photo = read("a.hdr", &hdr("", "-Y 1 +X 1", &[pixel]));
    assert!(photo.is_scene_linear() && codes(&photo) == [WarningCode::Assumed]);
    assert_near(colour(&photo), value, 1e-9);
    let photo = read("a.hdr", &hdr("EXPOSURE=2\nEXPOSURE=4\nCOLORCORR=1 1 2\n", "-Y 1 +X 1", &[pixel]));
    assert_near(colour(&photo), Rgb([0.125, 0.0625, 0.015_625]), 1e-9);
    let p3 = "PRIMARIES=.680 .320 .265 .690 .150 .060 .3127 .3290\n";
    let photo = read("a.hdr", &hdr(p3, "-Y 1 +X 1", &[pixel]));
    assert_eq!(codes(&photo), []);
    assert_near(colour(&photo), RgbSpace::LinDisplayP3.convert(value, RgbSpace::LinRec709), 1e-6);
    // Scanlines along columns, from the bottom: the last stored pixel of the first scanline is at the top left.
    let photo = read("a.hdr", &hdr("", "+X 1 +Y 2", &[[2, 3, 4, 129], pixel]));
    assert_eq!([photo.width, photo.height], [1, 2]);
    assert_near(colour(&photo), value, 1e-9);
}

/// XYZ of the equal-energy white is white, and Y alone is the luminance of Rec.709.
#[test]
fn radiance_xyz_is_converted() {
    let bytes = |xyze: [u8; 4]| {
        let text = String::from_utf8(hdr("", "-Y 1 +X 1", &[])).unwrap().replace("rgbe", "xyze");
        [text.as_bytes(), &xyze].concat()
    };
    assert_near(colour(&read("a.hdr", &bytes([128, 128, 128, 129]))), Rgb::WHITE, 1e-9);
    let colour = colour(&read("a.hdr", &bytes([100, 128, 30, 129])));
    assert!((RgbSpace::LinRec709.xyz(colour).0[1] - 1.0).abs() < 0.02, "{colour:?}");
}

fn flat(value: f32) -> Vec<f32> {
    vec![value; 4]
}

fn rgb_channels(prefix: &str, [red, green, blue]: [f32; 3]) -> Vec<(String, Vec<f32>)> {
    let name = |channel: &str| format!("{prefix}{channel}");
    vec![(name("R"), flat(red)), (name("G"), flat(green)), (name("B"), flat(blue))]
}

fn exr_of(channels: &[(String, Vec<f32>)]) -> Vec<u8> {
    let channels: Vec<(&str, Vec<f32>)> = channels.iter().map(|(name, v)| (name.as_str(), v.clone())).collect();
    exr([2, 2], &channels, None)
}

#[test]
fn exr_is_linear_and_unclamped() {
    let photo = read("a.exr", &exr_of(&rgb_channels("", [0.25, -0.5, 7.5])));
    assert_eq!(codes(&photo), [WarningCode::Negative]);
    assert!(photo.is_scene_linear() && !photo.colour_rule.is_assumed());
    assert_eq!(colour(&photo), Rgb([0.25, -0.5, 7.5]));
}

#[test]
fn exr_chromaticities_are_followed() {
    use exr::math::Vec2;
    let channels = [("R", flat(0.5)), ("G", flat(0.25)), ("B", flat(0.125))];
    for space in RgbSpace::ALL {
        let [red, green, blue] = space.primaries().map(|p| Vec2(p.x as f32, p.y as f32));
        let white = Vec2(space.white().x as f32, space.white().y as f32);
        let bytes = exr_with([2, 2], &channels, None, |attributes| {
            attributes.chromaticities = Some(exr::meta::attribute::Chromaticities { red, green, blue, white });
        });
        let photo = read("a.exr", &bytes);
        assert_eq!(photo.colour_rule.to_string(), "OpenEXR chromaticities: linear");
        // Chromaticities are stored as 32-bit floats.
        assert_near(colour(&photo), space.convert(Rgb([0.5, 0.25, 0.125]), RgbSpace::LinRec709), 1e-6);
    }
}

#[test]
fn exr_luminance_and_premultiplied_alpha() {
    let grey = read("a.exr", &exr([2, 2], &[("Y", flat(0.25))], None));
    assert_near(colour(&grey), Rgb::splat(0.25), 1e-12);

    let mut channels = rgb_channels("", [0.25, 0.125, 0.0625]);
    channels.push(("A".to_owned(), flat(0.5)));
    let photo = read("a.exr", &exr_of(&channels));
    assert_eq!(codes(&photo), [WarningCode::Alpha]);
    assert_near(colour(&photo), Rgb([0.5, 0.25, 0.125]), 1e-12);
}

#[test]
fn exr_layers_are_chosen_by_name() {
    let named = exr_of(&[rgb_channels("beauty.", [0.1; 3]), rgb_channels("specular.", [0.2; 3])].concat());
    let error = refused("a.exr", &named);
    assert!(matches!(&error.kind, PhotoErrorKind::ChooseLayer { layers } if layers == &["beauty", "specular"]));
    assert_eq!(error.to_string(), "a.exr: the colours are in named layers; choose one of: beauty, specular");

    let with = |layer: &str| {
        let options = OpenOptions { layer: Some(layer.to_owned()), ..OpenOptions::default() };
        Photo::from_bytes_with("a.exr", &named, &options, &mut go_on)
    };
    assert_near(colour(&with("specular").unwrap()), Rgb::splat(0.2), 1e-7);
    assert_eq!(with("specular").unwrap().layers, ["beauty", "specular"]);
    assert!(with("diffuse").unwrap_err().to_string().contains("no layer “diffuse”; the layers are: beauty, specular"));

    let both = exr_of(&[rgb_channels("", [0.3; 3]), rgb_channels("specular.", [0.2; 3])].concat());
    assert_near(colour(&read("a.exr", &both)), Rgb::splat(0.3), 1e-7);
    assert!(refused("a.exr", &exr([2, 2], &[("depth.Z", flat(1.0))], None)).to_string().contains("R, G, B"));
}

#[test]
fn pixels_are_flagged_before_conversion() {
    let bytes = png(
        [3, 1],
        ColorType::Rgb,
        BitDepth::Eight,
        &[254, 100, 100, 11, 11, 11, 12, 0, 0],
        &[(*b"cICP", CICP_P3.to_vec())],
    );
    let photo = read("a.png", &bytes);
    let flags: Vec<_> = (0..3).map(|column| photo.pixel(column, 0).unwrap().flags).collect();
    assert_eq!(flags[0].clipped, [true, false, false]);
    assert!(flags[1].black && !flags[2].black && flags[2].is_clean());
    assert_eq!(codes(&photo), [WarningCode::Clipped]);
    assert!(photo.warnings[0].message.starts_with("33.3 %"), "{}", photo.warnings[0].message);

    let mut channels = rgb_channels("", [0.5; 3]);
    channels[1].1[2] = f32::NAN;
    channels[2].1[3] = f32::NEG_INFINITY;
    let photo = read("a.exr", &exr_of(&channels));
    assert_eq!(codes(&photo), [WarningCode::NonFinite]);
    assert!(photo.warnings[0].message.starts_with("2 pixels"));
    assert!(photo.pixel(0, 1).unwrap().flags.non_finite && photo.pixel(0, 1).unwrap().rgb == Rgb::BLACK);
}

#[test]
fn a_person_may_say_that_an_untagged_file_is_linear() {
    let options = OpenOptions { untagged: Untagged::Linear, ..OpenOptions::default() };
    let of = |bytes: &[u8]| Photo::from_bytes_with("a.png", bytes, &options, &mut go_on).unwrap();
    let photo = of(&png8(&[]));
    assert!(photo.is_scene_linear() && codes(&photo) == [WarningCode::Assumed]);
    assert_near(colour(&photo), expected(|x| x, RgbSpace::LinRec709), 1e-7);
    assert_near(colour(&of(&png8(&[(*b"sRGB", vec![0])]))), srgb(), 1e-7);
}

/// FIPS 180-2 gives the hash of "abc"; here the hash must be that of the bytes, whatever they are.
#[test]
fn the_hash_is_that_of_the_bytes() {
    use sha2::{Digest, Sha256};
    let bytes = png8(&[]);
    let expected: String = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    assert_eq!(read("a.png", &bytes).sha256, expected);
}

/// Before a large JPEG is decoded a coarse copy of it is there, turned and coloured like the whole.
#[test]
fn a_large_jpeg_shows_itself_before_it_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let size = [2400_u32, 400];
    let data: Vec<u8> =
        (0..size[0] * size[1]).flat_map(|i| [(i % size[0] / 10) as u8, (i / size[0] / 2) as u8, 90]).collect();
    let profile = moxcms::ColorProfile::new_display_p3().encode().unwrap();
    let file = |name: &str, bytes: &[u8]| {
        std::fs::write(folder.path().join(name), bytes).unwrap();
        folder.path().join(name)
    };
    let open = |path: &std::path::Path| {
        let mut looks = Vec::new();
        let photo = Photo::open_showing(path, &OpenOptions::default(), &mut |look| looks.push(look), &mut go_on);
        (photo.unwrap(), looks)
    };
    let turned = jpeg(size, &data, Some(&profile), Some(&exif(Some(6), None, None)));
    let (photo, looks) = open(&file("turned.jpg", &turned));
    let [look] = &looks[..] else { panic!("{} looks", looks.len()) };
    assert_eq!((look.width, look.height), (photo.width, photo.height));
    let whole = photo.preview(look.preview.width.max(look.preview.height));
    assert_eq!((look.preview.width, look.preview.height), (whole.width, whole.height));
    let differences = look.preview.rgb.iter().zip(&whole.rgb).map(|(a, b)| (0..3).map(|i| (a[i] - b[i]).abs()));
    let largest = differences.flatten().fold(0.0, f32::max);
    assert!(largest < 0.03, "{largest}");

    let small = jpeg([64, 64], &data[..3 * 4096], None, None);
    assert!(open(&file("small.jpg", &small)).1.is_empty(), "what is quickly read needs no look");
}

#[test]
fn reading_can_be_watched_and_cancelled() {
    let tall = CODE.repeat(8 * 640);
    let files = [
        ("a.png", png([8, 640], ColorType::Rgb, BitDepth::Eight, &tall, &[])),
        ("a.jpg", jpeg([8, 640], &tall, None, None)),
    ];
    for (name, bytes) in files {
        let mut heard = Vec::new();
        let mut listen = |fraction| {
            heard.push(fraction);
            if heard.len() == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let error = Photo::from_bytes(name, &bytes, &mut listen).unwrap_err();
        assert!(matches!(error.kind, PhotoErrorKind::Cancelled), "{name} {error}");
        assert!(heard.len() == 3 && heard.is_sorted() && heard.iter().all(|v| (0.0..=1.0).contains(v)));
    }
}
