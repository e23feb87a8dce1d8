//! glTF: metals with plain factors.

use serde_json::Value;

use super::ImportError;
use super::imported::{Found, Imported};
use super::numbers::shortened;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::FresnelModel;
use crate::preset::read_strict_json;

/// Every metal of a file; glTF factors are linear Rec.709.
pub(super) fn read(bytes: &[u8]) -> Result<Imported, ImportError> {
    let file = gltf::Gltf::from_slice(bytes).map_err(|error| ImportError::Gltf(error.to_string()))?;
    refuse_keys_given_twice(bytes)?;
    let mut imported = Imported::default();
    let mut refusal = None;
    for (index, material) in file.materials().enumerate() {
        let name = material.name().map_or_else(|| format!("material {index}"), str::to_owned);
        let added = found(&name, &material, &mut imported.notes).and_then(|found| imported.add(found));
        if let Err(error) = added {
            imported.notes.push(error.to_string());
            refusal = refusal.or(Some(error));
        }
    }
    if imported.presets.is_empty() {
        return Err(refusal.unwrap_or(ImportError::NoMetal("the glTF file")));
    }
    Ok(imported)
}

/// The reader of glTF keeps the last of two equal keys in an extension.
fn refuse_keys_given_twice(bytes: &[u8]) -> Result<(), ImportError> {
    let broken = |error: &dyn std::fmt::Display| ImportError::Gltf(error.to_string());
    let glb = if bytes.starts_with(b"glTF") { gltf::Glb::from_slice(bytes).map(Some) } else { Ok(None) };
    let glb = glb.map_err(|error| broken(&error))?;
    let json = std::str::from_utf8(glb.as_ref().map_or(bytes, |glb| &glb.json)).map_err(|error| broken(&error))?;
    read_strict_json(json).map(drop).map_err(|error| broken(&error))
}

/// What lies on or in a material beyond r, h and roughness: the field that switches it on, by its extension.
const LAYERS: [(&str, &str); 4] = [
    ("KHR_materials_anisotropy", "anisotropyStrength"),
    ("KHR_materials_clearcoat", "clearcoatFactor"),
    ("KHR_materials_sheen", "sheenColorFactor"),
    ("KHR_materials_iridescence", "iridescenceFactor"),
];

/// What only light that enters a material would show; none enters a metal.
const INSIDE: [&str; 5] = [
    "KHR_materials_transmission",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_volume",
    "KHR_materials_ior",
    "KHR_materials_dispersion",
];

/// Refuses what r and h cannot say and notes what they need not.
fn check_surroundings(name: &str, material: &gltf::Material<'_>, notes: &mut Vec<String>) -> Result<(), ImportError> {
    let refused = |what: &str| Err(ImportError::metal(name, format!("it has {what}, which r and h cannot say")));
    let alpha = material.pbr_metallic_roughness().base_color_factor()[3];
    if alpha != 1.0 && material.alpha_mode() != gltf::material::AlphaMode::Opaque {
        return refused(&format!("an alpha of {alpha}"));
    }
    if material.emissive_factor() != [0.0; 3] {
        return refused("a light of its own");
    }
    if material.normal_texture().is_some() {
        notes.push(format!("“{name}” has a normal map, which is not read"));
    }
    for (extension, value) in material.extensions().into_iter().flatten() {
        match LAYERS.iter().find(|(layer, _)| *layer == extension.as_str()) {
            Some((_, field)) if is_zero(&value[*field]) => {}
            Some((_, field)) => return refused(field),
            None if extension == SPECULAR => {}
            None if INSIDE.contains(&extension.as_str()) => {
                notes.push(format!("“{name}” has {extension}, which no metal shows"));
            }
            None => notes.push(format!("“{name}” has {}, which is not read", shortened(extension))),
        }
    }
    Ok(())
}

/// Absent, 0 or a list of these.
fn is_zero(value: &Value) -> bool {
    match value {
        Value::Null => true,
        Value::Array(values) => values.iter().all(is_zero),
        value => value.as_f64() == Some(0.0),
    }
}

const SPECULAR: &str = "KHR_materials_specular";

fn found(name: &str, material: &gltf::Material<'_>, notes: &mut Vec<String>) -> Result<Found, ImportError> {
    let pbr = material.pbr_metallic_roughness();
    if pbr.metallic_factor() != 1.0 {
        return Err(ImportError::metal(
            name,
            format!("metallicFactor is {}; only 1 is a metal", pbr.metallic_factor()),
        ));
    }
    if pbr.base_color_texture().is_some() || pbr.metallic_roughness_texture().is_some() {
        return Err(ImportError::metal(name, "it has textures, and only plain factors can be read"));
    }
    check_surroundings(name, material, notes)?;
    let [red, green, blue, _] = pbr.base_color_factor().map(f64::from);
    let t = edge_tint(name, material, notes)?;
    Ok(Found {
        name: name.to_owned(),
        space: RgbSpace::LinRec709,
        model: FresnelModel::F82Tint { r: Rgb([red, green, blue]), t },
        roughness: Some(f64::from(pbr.roughness_factor())),
    })
}

/// specularColorFactor, where the nested extension makes it an edge tint; otherwise white, glTF's Schlick curve.
fn edge_tint(name: &str, material: &gltf::Material<'_>, notes: &mut Vec<String>) -> Result<Rgb, ImportError> {
    let Some(specular) = material.extension_value(SPECULAR) else { return Ok(Rgb::WHITE) };
    let edge = &specular["extensions"]["EXT_materials_specular_edge_color"];
    if edge["specularEdgeColorEnabled"] != Value::Bool(true) {
        notes.push(format!("“{name}” has {SPECULAR} without an edge color, which no metal shows"));
        return Ok(Rgb::WHITE);
    }
    if ["specularTexture", "specularColorTexture"].iter().any(|texture| specular.get(texture).is_some()) {
        return Err(ImportError::metal(name, "its edge tint is a texture, and only plain factors can be read"));
    }
    if let Some(weight) = specular.get("specularFactor").filter(|weight| weight.as_f64() != Some(1.0)) {
        return Err(ImportError::metal(name, format!("specularFactor is {weight}; only 1 leaves the edge as it is")));
    }
    let Some(factor) = specular.get("specularColorFactor") else { return Ok(Rgb::WHITE) };
    let factor: Result<[f64; 3], _> = serde_json::from_value(factor.clone());
    factor.map(Rgb).map_err(|_| ImportError::metal(name, "specularColorFactor is no list of three numbers"))
}
