//! Does what leaves Edgewise come back, and is everything else refused or read with a word?

use std::time::{Duration, Instant};

use edgewise::color::{Rgb, RgbSpace};
use edgewise::export::{Options, Target, export, export_all};
use edgewise::fresnel::{CosTheta, FresnelModel, whole_degrees};
use edgewise::import::{ImportFormat, Imported, import};
use edgewise::preset::{Preset, built_in_presets};

fn preset(name: &str, r: [f64; 3], h: [f64; 3]) -> Preset {
    Preset { name: name.to_owned(), r: Rgb(r), h: Rgb(h), roughness: 0.3, ..Preset::new_authored() }
}

fn gold_and_chromium() -> [Preset; 2] {
    [
        preset("gold", [1.0, 0.782, 0.344], [0.986, 0.882, 0.630]),
        preset("chromium", [0.635, 0.662, 0.705], [0.576, 0.612, 0.697]),
    ]
}

fn there_and_back(preset: &Preset, target: Target, space: RgbSpace) -> Imported {
    let exported = export(preset, target, &Options { space: Some(space) }).unwrap();
    let file = &exported.files[0];
    import(ImportFormat::of_name(&file.name).unwrap(), &file.bytes, None).unwrap()
}

fn distance(a: &Preset, b: &Preset) -> f64 {
    let [a, b] = [a, b].map(|preset| preset.in_space(RgbSpace::LinRec709).model());
    whole_degrees().map(|c| a.reflectance(c).max_abs_difference(b.reflectance(c))).fold(0.0, f64::max)
}

#[test]
fn exact_targets_come_back() {
    for preset in gold_and_chromium() {
        for target in [Target::Json, Target::OpenPbr, Target::GeneralizedSchlick, Target::Gltf] {
            for &space in target.spaces() {
                let back = there_and_back(&preset, target, space);
                assert!(back.notes.is_empty(), "{target}: {:?}", back.notes);
                let back = &back.presets[0];
                assert_eq!((back.name.as_str(), back.space), (preset.name.as_str(), space), "{target}");
                assert!((back.roughness - preset.roughness).abs() < 1e-7, "{target}");
                assert!(distance(&preset, back) < 1e-6, "{target} {space}: {}", distance(&preset, back));
            }
        }
    }
}

#[test]
fn every_built_in_preset_comes_back_as_far_as_its_loss_says() {
    for preset in built_in_presets() {
        for target in [Target::OpenPbr, Target::GeneralizedSchlick, Target::Gltf] {
            let exported = export(preset, target, &Options::default()).unwrap();
            let file = &exported.files[0];
            let back = import(ImportFormat::of_name(&file.name).unwrap(), &file.bytes, None).unwrap();
            let told = exported.losses.first().map_or(0.0, |loss| loss.difference.max_delta_f);
            let off = distance(preset, &back.presets[0]);
            assert!((off - told).abs() < 1e-6, "{} {target}: {off} {told}", preset.name);
        }
    }
}

/// g is fitted on the way out and h on the way in; the note has the residual.
#[test]
fn standard_surface_comes_back_with_its_losses_told() {
    for preset in gold_and_chromium() {
        let back = there_and_back(&preset, Target::StandardSurface, RgbSpace::LinRec709);
        assert_eq!(back.notes.len(), 1, "{:?}", back.notes);
        assert!(back.notes[0].contains("Gulbrandsen (r, g)") && back.notes[0].contains("ΔE2000"));
        assert!(distance(&preset, &back.presets[0]) < 0.03);
    }
}

/// Beside the h of the smallest squared distance every other h is farther from the curve of g.
#[test]
fn g_becomes_the_h_whose_curve_is_nearest() {
    let text = "r: 0.95 0.72 0.4\ng: 0.1 0.5 0.9\nspace: lin_rec709";
    let back = import(ImportFormat::Values, text.as_bytes(), None).unwrap();
    let (preset, original) = (&back.presets[0], Rgb([0.1, 0.5, 0.9]));
    let curve = FresnelModel::Gulbrandsen { r: preset.r, g: original };
    let distance = |change: f64| {
        let ours = FresnelModel::Hoffman { r: preset.r, h: preset.h + Rgb::splat(change) };
        let square = |c, i: usize| (ours.reflectance(c)[i] - curve.reflectance(c)[i]).powi(2);
        [0, 1, 2].map(|i| whole_degrees().map(|c| square(c, i)).sum::<f64>())
    };
    let best = distance(0.0);
    for change in [-1e-3, 1e-3] {
        assert!((0..3).all(|i| distance(change)[i] > best[i]), "{change}");
    }
    assert!(preset.h.max_abs_difference(curve.reflectance(CosTheta::MAX)) > 1e-3, "no reading at 81.8°");
    assert!(back.notes[0].contains("fitted"), "{:?}", back.notes);
}

#[test]
fn palettes_come_back_in_pairs() {
    let presets = gold_and_chromium();
    for (target, tolerance) in [(Target::Gpl, 0.005), (Target::Ase, 1e-6)] {
        let exported = export_all(&presets, target, &Options::default()).unwrap();
        let file = &exported.files[0];
        let back = import(ImportFormat::of_name(&file.name).unwrap(), &file.bytes, None).unwrap();
        assert_eq!((back.presets.len(), back.notes.len()), (2, 0));
        for (before, after) in presets.iter().zip(&back.presets) {
            assert!(distance(before, after) < tolerance, "{target} {}", before.name);
        }
    }
}

fn materialx(body: &str) -> String {
    format!("<materialx version=\"1.39\" colorspace=\"acescg\">{body}</materialx>")
}

fn read_materialx(body: &str) -> Result<Imported, String> {
    import(ImportFormat::MaterialX, materialx(body).as_bytes(), None).map_err(|error| error.to_string())
}

/// The gold of MaterialX's artistic_ior, by its default index, by values and through the node that makes them.
#[test]
fn conductors_become_the_r_and_h_of_their_curve() {
    let wanted = FresnelModel::Conductor { n: Rgb([0.183, 0.421, 1.373]), k: Rgb([3.424, 2.346, 1.770]) };
    let by_node = "<artistic_ior name=\"a\" type=\"multioutput\"/><conductor_bsdf name=\"c\" type=\"BSDF\">\
                   <input name=\"ior\" type=\"color3\" nodename=\"a\" output=\"ior\"/>\
                   <input name=\"extinction\" type=\"color3\" nodename=\"a\" output=\"extinction\"/></conductor_bsdf>";
    // The node states r and g to three digits, and from g h is fitted.
    for (body, of_r, of_h) in [("<conductor_bsdf name=\"c\" type=\"BSDF\"/>", 1e-12, 1e-12), (by_node, 5e-3, 0.02)] {
        let back = read_materialx(body).unwrap();
        let preset = &back.presets[0];
        assert_eq!((preset.space, back.notes.len()), (RgbSpace::AcesCg, 1));
        assert!(preset.r.max_abs_difference(wanted.reflectance(CosTheta::FACING)) < of_r);
        assert!(preset.h.max_abs_difference(wanted.reflectance(CosTheta::MAX)) < of_h);
    }
}

#[test]
fn what_r_and_h_cannot_say_is_refused() {
    let input = |name: &str, rest: &str| format!("<input name=\"{name}\" type=\"float\" {rest}/>");
    let open_pbr = |inputs: &str| read_materialx(&format!("<open_pbr_surface name=\"m\">{inputs}</open_pbr_surface>"));
    let metal = input("base_metalness", "value=\"1\"");
    assert!(open_pbr(&metal).is_ok());
    for (inputs, reason) in [
        (String::new(), "base_metalness is 0"),
        (metal.clone() + &input("specular_weight", "value=\"0.5\""), "specular_weight is 0.5"),
        (metal.clone() + &input("base_color", "nodename=\"image\""), "comes from another node"),
        (metal.clone() + &input("base_color", "value=\"1, 1\""), "colour of three numbers"),
        (metal.clone() + &input("base_color", "value=\"nan, 1, 1\""), "nan"),
        (metal.clone() + &input("specular_roughness", "value=\"1e999\""), "1e999"),
        (metal.clone() + &input("specular_roughness", "value=\"-1\""), "0–1"),
        (metal.clone() + &input("base_color", "colorspace=\"lin_rec709\" value=\"1, 1, 1\""), "different spaces"),
    ] {
        let error = open_pbr(&inputs).unwrap_err();
        assert!(error.contains(reason), "{error}");
    }
    assert!(read_materialx("<image name=\"i\"/>").unwrap_err().contains("no metal"));
    assert!(import(ImportFormat::MaterialX, b"<a/>", None).unwrap_err().to_string().contains("materialx"));
}

#[test]
fn layers_and_directions_are_refused_or_noted() {
    let node = |tag: &str, metal: &str, name: &str, value: &str| {
        let input = |name: &str, value: &str| format!("<input name=\"{name}\" value=\"{value}\"/>");
        read_materialx(&format!("<{tag} name=\"m\">{}{}</{tag}>", input(metal, "1"), input(name, value)))
    };
    let (open_pbr, standard) = (("open_pbr_surface", "base_metalness"), ("standard_surface", "metalness"));
    let (schlick, conductor) = (("generalized_schlick_bsdf", "weight"), ("conductor_bsdf", "weight"));
    for ((tag, metal), name, off, on) in [
        (open_pbr, "specular_roughness_anisotropy", "0.0", "0.5"),
        (open_pbr, "coat_weight", "0", "1"),
        (open_pbr, "fuzz_weight", "0", "0.1"),
        (open_pbr, "thin_film_weight", "0", "1"),
        (open_pbr, "emission_luminance", "0", "100"),
        (open_pbr, "geometry_opacity", "1", "0.5"),
        (standard, "specular_anisotropy", "0", "0.5"),
        (standard, "coat", "0", "1"),
        (standard, "thin_film_thickness", "0", "500"),
        (standard, "emission", "0", "1"),
        (standard, "opacity", "1, 1, 1", "1, 1, 0.5"),
        (schlick, "thinfilm_thickness", "0", "500"),
        (schlick, "scatter_mode", "R", "RT"),
        (conductor, "retroreflective", "false", "true"),
        (conductor, "extinction", "3, 2, 1", "3, -2, 1"),
    ] {
        assert!(node(tag, metal, name, off).is_ok(), "{tag} {name}");
        node(tag, metal, name, on).expect_err(name);
    }
    for ((tag, metal), name) in [(open_pbr, "transmission_weight"), (standard, "sheen")] {
        let notes_with = |value| node(tag, metal, name, value).unwrap().notes;
        assert!(!notes_with("0").iter().any(|note| note.contains(name)));
        assert!(notes_with("0.5").iter().any(|note| note.contains(name)));
    }
}

fn read_gltf(material: &str) -> Result<Imported, String> {
    let text = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"materials\":[{{{material}}}]}}");
    import(ImportFormat::Gltf, text.as_bytes(), None).map_err(|error| error.to_string())
}

#[test]
fn gltf_layers_are_refused_or_noted() {
    let edge = r#""extensions":{"EXT_materials_specular_edge_color":{"specularEdgeColorEnabled":true}}"#;
    let extension = |name: &str, fields: &str| read_gltf(&format!("\"extensions\":{{\"{name}\":{{{fields}}}}}"));
    for (name, field, off, on) in [
        ("KHR_materials_anisotropy", "anisotropyStrength", "0", "0.5"),
        ("KHR_materials_clearcoat", "clearcoatFactor", "0.0", "1"),
        ("KHR_materials_sheen", "sheenColorFactor", "[0,0,0]", "[0,0.1,0]"),
        ("KHR_materials_iridescence", "iridescenceFactor", "0", "1"),
    ] {
        assert!(extension(name, &format!("\"{field}\":{off}")).unwrap().notes.is_empty(), "{name}");
        assert!(extension(name, &format!("\"{field}\":{on}")).unwrap_err().contains(field));
    }
    let specular = |fields: &str| extension("KHR_materials_specular", &format!("{fields},{edge}"));
    assert!(specular("\"specularFactor\":1.0").unwrap().notes.is_empty());
    assert!(specular("\"specularFactor\":0.5").unwrap_err().contains("specularFactor"));
    assert!(specular("\"specularTexture\":{\"index\":0}").unwrap_err().contains("texture"));
    let twice = "\"specularColorFactor\":[1,1,1],\"specularColorFactor\":[0,0,0]";
    assert!(specular(twice).unwrap_err().contains("twice"));
    let dimmed = extension("KHR_materials_specular", "\"specularFactor\":0.5").unwrap();
    assert!(dimmed.notes[0].contains("KHR_materials_specular"));
    assert!(
        extension("KHR_materials_transmission", "\"transmissionFactor\":1").unwrap().notes[0].contains("transmission")
    );
    assert!(extension("VENDOR_flakes", "\"size\":1").unwrap().notes[0].contains("VENDOR_flakes"));
    let base = r#""pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}"#;
    assert!(read_gltf(&format!("{base},\"alphaMode\":\"BLEND\"")).unwrap_err().contains("alpha of 0.5"));
    assert!(read_gltf(base).is_ok(), "an opaque material ignores its alpha");
    assert!(read_gltf("\"emissiveFactor\":[1,0,0]").unwrap_err().contains("light"));
}

/// A preset whose roughness is this.
fn preset_with(roughness: &str) -> String {
    format!(
        "{{\"edgewise\":1,\"name\":\"a\",\"space\":\"acescg\",\"r\":[1,1,1],\"h\":[1,1,1],\"roughness\":{roughness}}}"
    )
}

/// Hundreds of times what any of these takes without optimisation, and far less than what grows with a square.
const PATIENCE: Duration = Duration::from_secs(10);

/// One sentence, no panic, and time in proportion to the size.
#[test]
fn hostile_files_are_refused() {
    let bomb = "<!DOCTYPE materialx [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]><materialx x=\"&b;\"/>";
    let attributes: String = (0..200_000).map(|i| format!(" a{i}='1'")).collect();
    let nodes = "<open_pbr_surface name=\"m\"><input name=\"x\" nodename=\"m\"/></open_pbr_surface>".repeat(90_000);
    let deep_json = "[".repeat(100_000);
    let glb = export(&gold_and_chromium()[0], Target::Gltf, &Options::default()).unwrap().files.remove(0).bytes;
    let ase = export(&gold_and_chromium()[0], Target::Ase, &Options::default()).unwrap().files.remove(0).bytes;
    let mut cases: Vec<(ImportFormat, Vec<u8>)> = vec![
        (ImportFormat::MaterialX, bomb.into()),
        (ImportFormat::MaterialX, materialx(&format!("<a{attributes}/>")).into()),
        (ImportFormat::MaterialX, "<materialx>".repeat(100_000).into()),
        (ImportFormat::MaterialX, materialx(&nodes).into()),
        (ImportFormat::MaterialX, vec![0xff; 1000]),
        (ImportFormat::Preset, deep_json.clone().into()),
        (ImportFormat::Preset, b"{\"edgewise\":1,\"edgewise\":1}".to_vec()),
        (ImportFormat::Preset, preset_with("1e999").into()),
        (ImportFormat::Preset, preset_with("NaN").into()),
        (ImportFormat::Preset, preset_with(&"9".repeat(1_000_000)).into()),
        (ImportFormat::Table, "n_red,".repeat(200_000).into()),
        (ImportFormat::Values, "r: 1 1 1\n".repeat(200_000).into()),
        (ImportFormat::Gltf, deep_json.into()),
        (ImportFormat::Gltf, b"{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[1e999,1,1,1]}}]}".to_vec()),
        (ImportFormat::Gltf, b"{\"asset\":{\"version\":\"2.0\"}}".to_vec()),
        (ImportFormat::Ase, b"ASEF\0\x01\0\0\xff\xff\xff\xff".to_vec()),
        (ImportFormat::Ase, b"ASEF\0\x01\0\0\0\0\0\x01\0\x01\xff\xff\xff\xff".to_vec()),
        (ImportFormat::Gpl, b"GIMP Palette\n999 1 1 x\n".to_vec()),
        (ImportFormat::Table, vec![b','; 1_000_000]),
        (ImportFormat::Values, vec![b'\n'; 1_000_000]),
        (ImportFormat::Gpl, vec![b' '; 17 << 20]),
    ];
    for format in [
        ImportFormat::Preset,
        ImportFormat::MaterialX,
        ImportFormat::Gltf,
        ImportFormat::Table,
        ImportFormat::Values,
        ImportFormat::Ase,
        ImportFormat::Gpl,
    ] {
        cases.push((format, Vec::new()));
        cases.push((format, b"\0\0\0\0\0\0\0\0".to_vec()));
    }
    cases.extend((0..glb.len().min(4000)).step_by(97).map(|end| (ImportFormat::Gltf, glb[..end].to_vec())));
    cases.extend((0..ase.len()).map(|end| (ImportFormat::Ase, ase[..end].to_vec())));
    for (format, bytes) in cases {
        let start = Instant::now();
        let error = import(format, &bytes, None).expect_err("refused").to_string();
        assert!(start.elapsed() < PATIENCE, "{format:?}: {error}: {:?}", start.elapsed());
        assert!(!error.is_empty() && error.chars().count() < 400 && !error.contains('\n'), "{format:?}: {error}");
    }
}
