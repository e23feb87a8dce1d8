//! glTF: metals with plain factors.

use serde_json::Value;

use super::ImportError;
use super::imported::{Found, Imported};
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::FresnelModel;

/// Every metal of a file; glTF factors are linear Rec.709.
pub(super) fn read(bytes: &[u8]) -> Result<Imported, ImportError> {
    let file = gltf::Gltf::from_slice(bytes).map_err(|error| ImportError::Gltf(error.to_string()))?;
    let mut imported = Imported::default();
    let mut refusal = None;
    for (index, material) in file.materials().enumerate() {
        let name = material.name().map_or_else(|| format!("material {index}"), str::to_owned);
        let added = found(&name, &material).and_then(|found| imported.add(found));
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

fn found(name: &str, material: &gltf::Material<'_>) -> Result<Found, ImportError> {
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
    let [red, green, blue, _] = pbr.base_color_factor().map(f64::from);
    let t = edge_tint(name, material)?;
    Ok(Found {
        name: name.to_owned(),
        space: RgbSpace::LinRec709,
        model: FresnelModel::F82Tint { r: Rgb([red, green, blue]), t },
        roughness: Some(f64::from(pbr.roughness_factor())),
    })
}

/// specularColorFactor, where the nested extension makes it an edge tint; otherwise white, glTF's Schlick curve.
fn edge_tint(name: &str, material: &gltf::Material<'_>) -> Result<Rgb, ImportError> {
    let Some(specular) = material.extension_value("KHR_materials_specular") else { return Ok(Rgb::WHITE) };
    let edge = &specular["extensions"]["EXT_materials_specular_edge_color"];
    if edge["specularEdgeColorEnabled"] != Value::Bool(true) {
        return Ok(Rgb::WHITE);
    }
    if specular.get("specularColorTexture").is_some() {
        return Err(ImportError::metal(name, "its edge tint is a texture, and only plain factors can be read"));
    }
    let Some(factor) = specular.get("specularColorFactor") else { return Ok(Rgb::WHITE) };
    let factor: Result<[f64; 3], _> = serde_json::from_value(factor.clone());
    factor.map(Rgb).map_err(|_| ImportError::metal(name, "specularColorFactor is no list of three numbers"))
}
