//! Does every exported file say, by its reader's formula, the curve of the preset?

use std::collections::BTreeSet;

use edgewise::color::{Rgb, RgbSpace};
use edgewise::export::{Difference, Exported, Options, Target, export, export_all, shown};
use edgewise::fresnel::{CosTheta, FresnelModel, f82_tint, whole_degrees};
use edgewise::preset::{Preset, built_in_presets};

fn preset(name: &str, r: [f64; 3], h: [f64; 3]) -> Preset {
    Preset { name: name.to_owned(), r: Rgb(r), h: Rgb(h), ..Preset::new_authored() }
}

/// Gold is nearly Schlick; chromium is far from it and tells mistakes apart.
fn gold_and_chromium() -> [Preset; 2] {
    [
        preset("Gold", [1.0, 0.782, 0.344], [0.986, 0.882, 0.630]),
        preset("Chromium", [0.635, 0.662, 0.705], [0.576, 0.612, 0.697]),
    ]
}

fn export_in(preset: &Preset, target: Target, space: RgbSpace) -> Exported {
    export(preset, target, &Options { space: Some(space) }).unwrap()
}

fn text(exported: &Exported) -> &str {
    std::str::from_utf8(&exported.files[0].bytes).unwrap()
}

fn rgb(text: &str) -> Rgb {
    let values: Vec<f64> = text.split(',').map(|v| v.trim().parse().unwrap()).collect();
    Rgb(values.try_into().unwrap())
}

/// Largest |ΔF| from the preset over whole degrees, both in `space`.
fn distance(preset: &Preset, space: RgbSpace, reader: impl Fn(CosTheta) -> Rgb) -> f64 {
    let wanted = preset.in_space(space).model();
    whole_degrees().map(|c| reader(c).max_abs_difference(wanted.reflectance(c))).fold(0.0, f64::max)
}

/// The value of an input of a node in a MaterialX document.
fn materialx_input(document: &roxmltree::Document, node: &str, input: &str) -> String {
    let node = document.descendants().find(|n| n.has_tag_name(node)).unwrap();
    let input = node.children().find(|n| n.attribute("name") == Some(input)).unwrap();
    input.attribute("value").unwrap().to_owned()
}

fn tint_model(r: Rgb, t: Rgb) -> impl Fn(CosTheta) -> Rgb {
    move |c| r.zip(t, |r, t| f82_tint(r, t, c))
}

#[test]
fn materialx_says_the_tint() {
    for (target, node, r_name, t_name) in [
        (Target::OpenPbr, "open_pbr_surface", "base_color", "specular_color"),
        (Target::GeneralizedSchlick, "generalized_schlick_bsdf", "color0", "color82"),
    ] {
        for preset in gold_and_chromium() {
            for &space in target.spaces() {
                let exported = export_in(&preset, target, space);
                let document = roxmltree::Document::parse(text(&exported)).unwrap();
                assert_eq!(document.root_element().attribute("colorspace"), Some(space.id()));
                let [r, t] = [r_name, t_name].map(|name| rgb(&materialx_input(&document, node, name)));
                let off = distance(&preset, space, tint_model(r, t));
                assert!(off < 1e-6, "{target} {} {space}: {off}", preset.name);
                assert!(exported.losses.is_empty());
            }
        }
    }
}

/// The classic mistake, h in the field of t, is far outside the tolerance of the tests of this file.
#[test]
fn h_in_the_field_of_t_would_be_seen() {
    let [_, chromium] = gold_and_chromium();
    let off = distance(&chromium, chromium.space, tint_model(chromium.r, chromium.h));
    assert!((off - 0.113).abs() < 1e-3, "{off}");
}

#[test]
fn materialx_has_one_material_that_leads_to_its_nodes() {
    let [gold, _] = gold_and_chromium();
    for target in [Target::OpenPbr, Target::GeneralizedSchlick, Target::StandardSurface] {
        let exported = export_in(&gold, target, RgbSpace::AcesCg);
        let document = roxmltree::Document::parse(text(&exported)).unwrap();
        let names: Vec<_> = document.root_element().children().filter_map(|n| n.attribute("name")).collect();
        assert_eq!(names.last(), Some(&"gold"));
        for link in document.descendants().filter_map(|n| n.attribute("nodename")) {
            assert!(names.contains(&link), "{link}");
        }
    }
}

/// The formula of MaterialX's artistic_ior, with its clamp, then the exact conductor.
#[test]
fn standard_surface_shows_what_the_loss_says() {
    for preset in gold_and_chromium() {
        let exported = export_in(&preset, Target::StandardSurface, RgbSpace::LinRec709);
        let document = roxmltree::Document::parse(text(&exported)).unwrap();
        let input = |name| rgb(&materialx_input(&document, "standard_surface", name));
        let r = input("base_color").map(|r| r.clamp(0.0, 0.99));
        let n = r.zip(input("specular_color"), |r, g| {
            g * (1.0 - r) / (1.0 + r) + (1.0 - g) * (1.0 + r.sqrt()) / (1.0 - r.sqrt())
        });
        let k = r.zip(n, |r, n| (((n + 1.0).powi(2) * r - (n - 1.0).powi(2)) / (1.0 - r)).max(0.0).sqrt());
        let model = FresnelModel::Conductor { n, k };
        let off = distance(&preset, RgbSpace::LinRec709, |c| model.reflectance(c));
        let told = exported.losses.last().unwrap().difference;
        assert!((off - told.max_delta_f).abs() < 1e-6, "{}: {off} {told:?}", preset.name);
    }
}

#[test]
fn mitsuba_shows_what_the_loss_says() {
    for preset in gold_and_chromium() {
        let exported = export_in(&preset, Target::Mitsuba, RgbSpace::LinRec709);
        let document = roxmltree::Document::parse(text(&exported)).unwrap();
        let value = |name| {
            let node = document.descendants().find(|n| n.attribute("name") == Some(name)).unwrap();
            rgb(node.attribute("value").unwrap())
        };
        let model = FresnelModel::Conductor { n: value("eta"), k: value("k") };
        let off = distance(&preset, RgbSpace::LinRec709, |c| model.reflectance(c));
        let told = exported.losses.last().unwrap().difference;
        assert!((off - told.max_delta_f).abs() < 1e-6, "{}: {off} {told:?}", preset.name);
    }
}

/// Numbers of a Python tuple literal after `key`.
fn numbers_after(text: &str, key: &str) -> Vec<f64> {
    let rest = &text[text.find(key).unwrap_or_else(|| panic!("no {key}")) + key.len()..];
    let line = rest.lines().next().unwrap();
    line.split(|c: char| !(c.is_ascii_digit() || "+-.".contains(c))).filter_map(|v| v.parse().ok()).collect()
}

#[test]
fn blender_has_a_tint_for_each_working_space() {
    for preset in gold_and_chromium() {
        let exported = export_in(&preset, Target::Blender, RgbSpace::LinRec709);
        for (interop_id, space) in [
            ("\"lin_rec709_scene\"", RgbSpace::LinRec709),
            ("\"lin_rec2020_scene\"", RgbSpace::LinRec2020),
            ("\"lin_ap1_scene\"", RgbSpace::AcesCg),
        ] {
            let v = numbers_after(text(&exported).split("VALUES").nth(1).unwrap(), interop_id);
            let (r, t) = (Rgb([v[0], v[1], v[2]]), Rgb([v[3], v[4], v[5]]));
            assert!(distance(&preset, space, tint_model(r, t)) < 1e-6, "{} {space}", preset.name);
        }
    }
}

#[test]
fn usd_says_the_tint_twice() {
    for preset in gold_and_chromium() {
        for &space in Target::Usd.spaces() {
            let exported = export_in(&preset, Target::Usd, space);
            for (r_name, t_name) in [("base_color", "specular_color"), ("diffuseColor", "specularColor")] {
                let value = |name: &str| {
                    Rgb(numbers_after(text(&exported), &format!("color3f inputs:{name} =")).try_into().unwrap())
                };
                let off = distance(&preset, space, tint_model(value(r_name), value(t_name)));
                assert!(off < 1e-6, "{} {space} {off}", preset.name);
            }
        }
    }
}

#[test]
fn gltf_says_the_tint_on_a_sphere() {
    for preset in gold_and_chromium() {
        let exported = export_in(&preset, Target::Gltf, RgbSpace::LinRec709);
        let gltf = gltf::Gltf::from_slice(&exported.files[0].bytes).unwrap();
        let material = gltf.materials().next().unwrap();
        let pbr = material.pbr_metallic_roughness();
        let [red, green, blue, _] = pbr.base_color_factor().map(f64::from);
        let specular = material.extension_value("KHR_materials_specular").unwrap();
        let t: [f64; 3] = serde_json::from_value(specular["specularColorFactor"].clone()).unwrap();
        assert!(distance(&preset, preset.space, tint_model(Rgb([red, green, blue]), Rgb(t))) < 1e-6);
        let edge = &specular["extensions"]["EXT_materials_specular_edge_color"];
        assert_eq!(edge["specularEdgeColorEnabled"], true);
        assert_eq!(gltf.extensions_required().count(), 0);
        assert_eq!((pbr.metallic_factor(), pbr.roughness_factor()), (1.0, preset.roughness as f32));
        let positions = gltf.accessors().next().unwrap();
        assert_eq!(gltf.blob.as_ref().unwrap().len() % 4, 0);
        assert!(positions.count() > 1000);
    }
}

#[test]
fn curve_reads_back_exactly() {
    for preset in gold_and_chromium() {
        let exported = export_in(&preset, Target::Csv, RgbSpace::LinRec709);
        let mut csv = csv::Reader::from_reader(exported.files[0].bytes.as_slice());
        assert_eq!(csv.headers().unwrap().iter().collect::<Vec<_>>(), ["theta_deg", "red", "green", "blue"]);
        let rows: Vec<(f64, f64, f64, f64)> = csv.deserialize().map(Result::unwrap).collect();
        assert_eq!(rows.len(), 91);
        for (deg, red, green, blue) in rows {
            assert_eq!(preset.model().reflectance(CosTheta::from_deg(deg)), Rgb([red, green, blue]));
        }
    }
}

#[test]
fn a_preset_reads_back_as_it_was() {
    for preset in built_in_presets() {
        let exported = export(preset, Target::Json, &Options::default()).unwrap();
        assert_eq!(Preset::from_json(text(&exported)).unwrap().preset, *preset);
        let in_aces = export_in(preset, Target::Json, RgbSpace::AcesCg);
        assert_eq!(Preset::from_json(text(&in_aces)).unwrap().preset.space, RgbSpace::AcesCg);
    }
}

#[test]
fn every_built_in_preset_goes_through_every_target() {
    let presets = built_in_presets();
    for target in Target::ALL {
        let exported = export_all(presets, target, &Options::default()).unwrap();
        let files = if target.is_palette() { 1 } else { presets.len() };
        let names: BTreeSet<_> = exported.files.iter().map(|file| &file.name).collect();
        assert_eq!((exported.files.len(), names.len()), (files, files), "{target}");
        for loss in &exported.losses {
            let Difference { delta_f, max_delta_f, max_delta_e } = loss.difference;
            assert!(max_delta_f.is_finite() && max_delta_e.is_finite(), "{loss}");
            assert_eq!(delta_f.max_channel(), max_delta_f, "{loss}");
        }
    }
}

/// Linear interpolation between the rows, as every reader of .cube does.
#[test]
fn lut_interpolates_to_the_curve() {
    for preset in gold_and_chromium() {
        let exported = export_in(&preset, Target::Cube, RgbSpace::AcesCg);
        let is_row = |line: &&str| line.starts_with(|c: char| c.is_ascii_digit() || c == '-');
        let rows: Vec<Rgb> = text(&exported).lines().filter(is_row).map(|line| rgb(&line.replace(' ', ","))).collect();
        assert!(text(&exported).contains(&format!("LUT_1D_SIZE {}\n", rows.len())));
        let reader = |c: CosTheta| {
            let at = c.get() * (rows.len() - 1) as f64;
            let row = (at as usize).min(rows.len() - 2);
            rows[row].lerp(rows[row + 1], at - row as f64)
        };
        let off = distance(&preset, RgbSpace::AcesCg, reader);
        assert!(off < 1e-6, "{}: {off}", preset.name);
    }
}

#[test]
fn ramp_is_the_curve_at_texel_centres() {
    use exr::prelude::*;
    for preset in gold_and_chromium() {
        let exported = export_in(&preset, Target::Exr, RgbSpace::LinRec709);
        let image = read()
            .no_deep_data()
            .largest_resolution_level()
            .rgba_channels(
                |size, _| vec![[0.0_f32; 3]; size.area()],
                |row: &mut Vec<[f32; 3]>, at, (r, g, b, _): (f32, f32, f32, f32)| row[at.x()] = [r, g, b],
            )
            .first_valid_layer()
            .all_attributes()
            .from_buffered(std::io::Cursor::new(&exported.files[0].bytes))
            .unwrap();
        let row = &image.layer_data.channel_data.pixels;
        for (i, pixel) in row.iter().enumerate() {
            let c = CosTheta::new((i as f64 + 0.5) / row.len() as f64);
            let off = preset.model().reflectance(c).max_abs_difference(Rgb(pixel.map(f64::from)));
            assert!(off < 6e-8, "{}: {off}", preset.name);
        }
        assert!(image.attributes.chromaticities.is_some());
    }
}

#[test]
fn palettes_hold_every_metal() {
    let presets = gold_and_chromium();
    let palette = |target| export_all(&presets, target, &Options::default()).unwrap();
    let gpl = palette(Target::Gpl);
    assert_eq!(gpl.files.len(), 1);
    let names: Vec<_> = text(&gpl).lines().filter_map(|line| line.split_once('\t')).map(|(_, name)| name).collect();
    assert_eq!(names, ["Gold r", "Gold h", "Chromium r", "Chromium h"]);
    assert_eq!(&palette(Target::Ase).files[0].bytes[..12], b"ASEF\0\x01\0\0\0\0\0\x04");
    let aco = &palette(Target::Aco).files[0].bytes;
    assert_eq!((&aco[..4], &aco[44..48]), (&b"\0\x01\0\x04"[..], &b"\0\x02\0\x04"[..]));
}

/// Measured gold exceeds 1 in linear sRGB: clipping is told, with its size, in the file too.
#[test]
fn a_metal_out_of_range_is_clipped_with_a_word() {
    let gold = preset("Gold", [1.04, 0.78, 0.34], [1.01, 0.88, 0.63]);
    for target in Target::ALL {
        let exported = export(&gold, target, &Options::default()).unwrap();
        let seen = shown(&gold, target, &Options::default()).unwrap();
        assert_eq!(exported.losses, seen.losses);
        let off = distance(&gold, seen.space, |c| seen.model.reflectance(c));
        let told = exported.losses.first().map_or(0.0, |loss| loss.difference.max_delta_f);
        assert!((told - off).abs() < 1e-12, "{target}: {told} {off}");
    }
    let open_pbr = export(&gold, Target::OpenPbr, &Options::default()).unwrap();
    assert!(text(&open_pbr).contains("r red 1.0400 → 1.0, t red 1.0100 → 1.0"), "{}", text(&open_pbr));
    assert!((open_pbr.losses[0].difference.max_delta_f - 0.04).abs() < 1e-12);
}

#[test]
fn what_a_file_has_no_place_for_is_told() {
    let [gold, _] = gold_and_chromium();
    let told = |preset: &Preset, target| {
        let exported = export(preset, target, &Options::default()).unwrap();
        exported.losses.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    let mirror = Preset { roughness: 0.0, ..gold.clone() };
    let rough = Preset { roughness: 0.3, ..gold };
    for target in Target::ALL {
        let has = |preset, what: &str| told(preset, target).iter().any(|sentence| sentence.contains(what));
        assert_eq!(has(&rough, "roughness 0.3"), !target.says_roughness(), "{target}");
        assert!(!has(&mirror, "roughness"), "{target}");
        assert_eq!(has(&mirror, "not the curve"), target.is_palette(), "{target}");
    }
}

/// A red of Rec.2020 leaves Rec.709, and a tint above 1 leaves every space.
#[test]
fn blender_is_told_for_each_of_its_spaces() {
    let told = |preset: &Preset| export(preset, Target::Blender, &Options::default()).unwrap().losses;
    let spaces = |preset: &Preset| told(preset).iter().map(|loss| loss.space).collect::<Vec<_>>();
    let dim = preset("dim", [0.5; 3], [0.95; 3]);
    assert_eq!(spaces(&dim), [RgbSpace::LinRec709, RgbSpace::LinRec2020, RgbSpace::AcesCg]);
    let red = Preset { space: RgbSpace::LinRec2020, ..preset("red", [0.9, 0.1, 0.1], [0.9, 0.3, 0.3]) };
    assert!(spaces(&red).contains(&RgbSpace::LinRec709) && !spaces(&red).contains(&RgbSpace::LinRec2020));
}

#[test]
fn a_space_the_reader_does_not_know_is_refused() {
    let [gold, _] = gold_and_chromium();
    let error = export(&gold, Target::Gltf, &Options { space: Some(RgbSpace::AcesCg) }).unwrap_err();
    assert_eq!(error.to_string(), "glTF binary knows lin_rec709, not acescg");
}

#[test]
fn what_no_file_can_say_is_refused() {
    for broken in [
        Preset { r: Rgb([f64::NAN, 0.5, 0.5]), ..Preset::new_authored() },
        Preset { h: Rgb([0.5, f64::INFINITY, 0.5]), ..Preset::new_authored() },
        Preset { roughness: 1.5, ..Preset::new_authored() },
        Preset { roughness: f64::NAN, ..Preset::new_authored() },
    ] {
        for target in Target::ALL {
            assert!(export(&broken, target, &Options::default()).is_err(), "{target}");
        }
    }
    assert!(export_all(&[], Target::Gpl, &Options::default()).is_err());
}

/// Names that try to leave their quotes, comments, lines and folders.
#[test]
fn hostile_names_stay_names() {
    let names = ["a\"b", "x --> <y/> & z", "new\nline", "back\\", "../../up", "'); import os #", "$H$R", "真鍮", ""];
    for name in names {
        let preset = preset(name, [0.9, 0.7, 0.4], [0.95, 0.8, 0.6]);
        for target in Target::ALL {
            let exported = export(&preset, target, &Options::default()).unwrap();
            let file = &exported.files[0];
            assert!(!file.name.contains(['/', '\\', '\n', '"']) && !file.name.starts_with('.'), "{}", file.name);
            if matches!(target.extension(), "mtlx" | "xml") {
                roxmltree::Document::parse(text(&exported)).unwrap();
            }
            if target == Target::Gltf {
                gltf::Gltf::from_slice(&file.bytes).unwrap();
            }
        }
    }
}

/// A person finds each target in both documents.
#[test]
fn the_documents_have_every_target() {
    let (exports, targets) = (include_str!("../docs/exports.md"), include_str!("../docs/targets.md"));
    for target in Target::ALL {
        assert!(exports.contains(&format!("`{target}`")), "docs/exports.md has no {target}");
        let section = targets.split(&format!("\n## {target}: ")).nth(1);
        let section = section.unwrap_or_else(|| panic!("docs/targets.md has no {target}"));
        let section = section.split("\n## ").next().unwrap();
        for part in ["**Where.**", "**Shows**", "**Cannot"] {
            assert!(section.contains(part), "docs/targets.md: {target} has no {part}");
        }
    }
}
