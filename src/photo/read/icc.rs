//! ICC profiles: our own double-precision matrices where they suffice, a colour management system elsewhere.

use std::sync::Arc;

use moxcms::{
    ColorProfile, DataColorSpace, Layout, ProfileText, RenderingIntent, ToneReprCurve, TransformOptions, Xyzd,
};
use nalgebra::Matrix3;

use crate::color::Xyz;
use crate::photo::ColourRule;
use crate::photo::curve::Curve;
use crate::photo::linearizer::{Linearizer, ProfileTransform, rec709_from_xyz};
use crate::photo::samples::Samples;

/// The illuminant of the profile connection space (ICC.1:2022, section 7.2.16).
const D50: Xyz = Xyz([0.9642, 1.0, 0.8249]);

/// The way to linear Rec.709 by a profile, relative to its media white, or why it is unusable.
pub(super) fn follow(bytes: &[u8], samples: &Samples, channels: usize) -> Result<(Linearizer, ColourRule), String> {
    let unusable = |reason: &str| format!("The ICC profile is unusable ({reason}) and is not followed");
    let profile = ColorProfile::new_from_slice(bytes).map_err(|error| unusable(&error.to_string()))?;
    let linearizer = match profile.color_space {
        DataColorSpace::Gray if channels == 1 => grey(&profile, samples),
        DataColorSpace::Rgb if has_tables(&profile) => by_tables(&profile),
        DataColorSpace::Rgb => by_matrix(&profile, samples),
        DataColorSpace::Gray => Err("a grey profile in a colour picture".to_owned()),
        other => Err(format!("{other:?} pixels are not what the picture holds")),
    };
    let (linearizer, is_linear) = linearizer.map_err(|reason| unusable(&reason))?;
    Ok((linearizer, ColourRule::IccProfile { description: description(&profile), is_linear }))
}

/// Look-up tables take precedence over a matrix (ICC.1:2022, section 8.2).
fn has_tables(profile: &ColorProfile) -> bool {
    profile.lut_a_to_b_perceptual.is_some() || profile.lut_a_to_b_colorimetric.is_some()
}

fn grey(profile: &ColorProfile, samples: &Samples) -> Result<(Linearizer, bool), String> {
    let curve = curve(profile.gray_trc.as_ref())?;
    let is_linear = curve.is_linear();
    let curves = [curve.clone(), curve.clone(), curve];
    Ok((Linearizer::from_curves(curves, Matrix3::identity(), samples), is_linear))
}

fn by_matrix(profile: &ColorProfile, samples: &Samples) -> Result<(Linearizer, bool), String> {
    let trcs = [&profile.red_trc, &profile.green_trc, &profile.blue_trc];
    let [red, green, blue] = trcs.map(|trc| curve(trc.as_ref()));
    let curves = [red?, green?, blue?];
    let is_linear = curves.iter().all(Curve::is_linear);
    Ok((Linearizer::from_curves(curves, rec709_from_profile(profile)?, samples), is_linear))
}

/// The matrix from a profile's linear RGB by its colorants, which the profile gives adapted to D50.
fn rec709_from_profile(profile: &ColorProfile) -> Result<Matrix3<f64>, String> {
    let column = |colorant: Xyzd| [colorant.x, colorant.y, colorant.z].into();
    let colorants = [profile.red_colorant, profile.green_colorant, profile.blue_colorant].map(column);
    let xyz_from_rgb = Matrix3::from_columns(&colorants);
    if xyz_from_rgb.determinant().abs() < 1e-6 {
        return Err("its primaries span no colours".to_owned());
    }
    Ok(rec709_from_xyz(D50) * xyz_from_rgb)
}

/// A profile with tables, by way of linear ACES 2065-1, which holds every real surface colour unclamped.
fn by_tables(profile: &ColorProfile) -> Result<(Linearizer, bool), String> {
    let wide = ColorProfile::new_aces_aces_2065_1_linear();
    // The perceptual table is the one that every such profile has.
    let is_colorimetric = profile.lut_a_to_b_colorimetric.is_some();
    let intent = if is_colorimetric { RenderingIntent::RelativeColorimetric } else { RenderingIntent::Perceptual };
    let options = TransformOptions {
        rendering_intent: intent,
        allow_use_cicp_transfer: false,
        prefer_fixed_point: false,
        allow_extended_range_rgb_xyz: true,
        ..TransformOptions::default()
    };
    let transform: ProfileTransform =
        profile.create_transform_f32(Layout::Rgb, &wide, Layout::Rgb, options).map_err(|error| error.to_string())?;
    Ok((Linearizer::from_profile(transform, rec709_from_profile(&wide)?), false))
}

/// A tone curve in our own double-precision form (ICC.1:2022, sections 10.6 and 10.18).
fn curve(trc: Option<&ToneReprCurve>) -> Result<Curve, String> {
    let curve = match trc.ok_or("it has no tone curve")? {
        ToneReprCurve::Lut(table) => match table.as_slice() {
            [] => Curve::Linear,
            [gamma] => Curve::Power(f64::from(*gamma) / 256.0),
            samples => Curve::Table(samples.iter().map(|v| f64::from(*v) / 65_535.0).collect::<Arc<[f64]>>()),
        },
        ToneReprCurve::Parametric(parameters) => {
            let parameters: Vec<f64> = parameters.iter().map(|v| f64::from(*v)).collect();
            parametric(&parameters).ok_or("its tone curve has an unknown form")?
        }
    };
    let is_finite = [0.0, 0.25, 0.5, 0.75, 1.0].iter().all(|x| curve.decode(*x).is_finite());
    if is_finite { Ok(curve) } else { Err("its tone curve is not finite".to_owned()) }
}

/// Function types 0–4 by their number of parameters.
fn parametric(parameters: &[f64]) -> Option<Curve> {
    let [g, a, b, c, d, e, f] = match *parameters {
        [g] => return Some(Curve::Power(g)),
        [g, a, b] => [g, a, b, 0.0, -b / a, 0.0, 0.0],
        [g, a, b, c] => [g, a, b, 0.0, -b / a, c, c],
        [g, a, b, c, d] => [g, a, b, c, d, 0.0, 0.0],
        [g, a, b, c, d, e, f] => [g, a, b, c, d, e, f],
        _ => return None,
    };
    Some(Curve::Parametric { g, a, b, c, d, e, f })
}

/// The description of a profile as one short line.
fn description(profile: &ColorProfile) -> String {
    const LONGEST: usize = 80;
    let text = match &profile.description {
        Some(ProfileText::PlainString(text)) => text.as_str(),
        Some(ProfileText::Localizable(texts)) => texts.first().map_or("", |text| &text.value),
        Some(ProfileText::Description(text)) if text.ascii_string.is_empty() => &text.unicode_string,
        Some(ProfileText::Description(text)) => &text.ascii_string,
        None => "",
    };
    let line: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(LONGEST).collect();
    match line.trim() {
        "" => "without a description".to_owned(),
        line => line.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encoded(profile: &ColorProfile) -> Vec<u8> {
        profile.encode().unwrap()
    }

    fn pixel(profile: &ColorProfile, code: [u8; 3]) -> nalgebra::Vector3<f64> {
        let (linearizer, _) = follow(&encoded(profile), &Samples::U8(Vec::new()), 3).unwrap();
        linearizer.pixel(code)
    }

    /// A profile of primaries that a space of this crate has too must agree with that space's matrix. Profiles
    /// hold 16 fractional bits and a D50 rounded differently by each writer.
    #[test]
    fn matrix_profiles_agree_with_our_spaces() {
        use crate::color::{Rgb, RgbSpace, srgb_decode};
        let cases =
            [(ColorProfile::new_srgb(), RgbSpace::LinRec709), (ColorProfile::new_display_p3(), RgbSpace::LinDisplayP3)];
        for (profile, space) in cases {
            for code in [[255, 255, 255], [200, 100, 50], [255, 0, 0], [0, 10, 255]] {
                let linear = Rgb(code.map(|v| srgb_decode(f64::from(v) / 255.0)));
                let expected = space.convert(linear, RgbSpace::LinRec709);
                let got = Rgb::from(pixel(&profile, code));
                assert!(got.max_abs_difference(expected) < 1e-3, "{space} {code:?} {got:?} {expected:?}");
            }
        }
    }

    #[test]
    fn a_linear_profile_is_scene_linear() {
        let profile = encoded(&ColorProfile::new_aces_cg_linear());
        let (_, rule) = follow(&profile, &Samples::U16(Vec::new()), 3).unwrap();
        assert!(rule.is_scene_linear(), "{rule}");
        let (_, rule) = follow(&encoded(&ColorProfile::new_adobe_rgb()), &Samples::U16(Vec::new()), 3).unwrap();
        assert!(!rule.is_scene_linear(), "{rule}");
    }

    #[test]
    fn grey_profiles_belong_to_grey_pictures() {
        let profile = encoded(&ColorProfile::new_gray_with_gamma(2.2));
        let (linearizer, _) = follow(&profile, &Samples::U8(Vec::new()), 1).unwrap();
        // The gamma is stored in 8 fractional bits.
        assert!((linearizer.pixel([128u8; 3])[1] - (128.0f64 / 255.0).powf(2.2)).abs() < 1e-3);
        assert!(follow(&profile, &Samples::U8(Vec::new()), 3).is_err());
    }

    /// A table that holds nothing but the matrix of Rec.2020 must give what the matrix gives, also outside the
    /// gamut of Rec.709. The table holds 16 bits.
    #[test]
    fn a_table_that_holds_a_matrix_agrees_with_it() {
        use crate::color::{Rgb, RgbSpace};
        use moxcms::{LutDataType, LutStore, LutType, LutWarehouse};
        let rec2020 = ColorProfile::new_bt2020();
        let colorants = rec2020.colorant_matrix().v;
        let corners = (0..8).map(|i| [i >> 2, (i >> 1) & 1, i & 1].map(f64::from));
        let xyz = corners.flat_map(|rgb| colorants.map(|row| row.iter().zip(rgb).map(|(a, b)| a * b).sum::<f64>()));
        let lut = LutDataType {
            num_input_channels: 3,
            num_output_channels: 3,
            num_clut_grid_points: 2,
            matrix: moxcms::Matrix3d::IDENTITY,
            num_input_table_entries: 2,
            num_output_table_entries: 2,
            input_table: LutStore::Store16([0, 65_535].repeat(3)),
            clut_table: LutStore::Store16(xyz.map(|v| (v * 32_768.0).round() as u16).collect()),
            output_table: LutStore::Store16([0, 65_535].repeat(3)),
            lut_type: LutType::Lut16,
        };
        let mut profile = rec2020;
        profile.lut_a_to_b_perceptual = Some(LutWarehouse::Lut(lut));
        for code in [[255, 255, 255], [0, 255, 0], [200, 100, 50], [0, 0, 200]] {
            let linear = Rgb(code.map(|v| f64::from(v) / 255.0));
            let expected = RgbSpace::LinRec2020.convert(linear, RgbSpace::LinRec709);
            let got = Rgb::from(pixel(&profile, code));
            assert!(got.max_abs_difference(expected) < 3e-3, "{code:?} {got:?} {expected:?}");
        }
    }

    #[test]
    fn rubbish_is_one_sentence() {
        let error = follow(b"not a profile", &Samples::U8(Vec::new()), 3).unwrap_err();
        assert!(error.starts_with("The ICC profile is unusable") && !error.contains('\n'), "{error}");
    }
}
