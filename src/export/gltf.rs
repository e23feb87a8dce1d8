//! glTF 2.0 in one binary file: a sphere that wears the material.

use std::borrow::Cow;

use gltf::binary::{Glb, Header};
use serde_json::{Value, json};

use super::export::Written;
use super::material::Material;
use super::number::rounded;
use super::sphere_mesh::SphereMesh;
use super::tint::Tint;
use crate::color::Rgb;

/// OpenGL's numbers for types, as glTF uses them.
const UNSIGNED_SHORT: u32 = 5123;
const FLOAT: u32 = 5126;
const ARRAY_BUFFER: u32 = 34_962;
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;

/// baseColorFactor = r, and KHR_materials_specular with specularColorFactor = t, which the nested
/// EXT_materials_specular_edge_color turns from a dielectric's color into an edge tint.
///
/// Neither extension is required: a viewer without the second shows Schlick's curve, one that refuses the
/// file shows nothing. What is lost is said where glTF has room for it: among the extras of the material.
pub(super) fn write(losses: &[String], material: &Material<'_>, tint: &Tint) -> Written {
    let mesh = SphereMesh::new(48, 24);
    let mut document = document(material, tint, &mesh);
    if !material.has_edge() {
        without_tint(&mut document);
    }
    if let (false, Some(surface)) = (losses.is_empty(), document.pointer_mut("/materials/0")) {
        surface["extras"] = json!({ "losses": losses });
    }
    let json = serde_json::to_vec(&document)?;
    let glb = Glb {
        header: Header { magic: *b"glTF", version: 2, length: 0 },
        json: Cow::Owned(json),
        bin: Some(Cow::Owned(mesh.bytes())),
    };
    Ok(glb.to_vec()?)
}

/// A metal without extensions has Schlick's edge (glTF 2.0, appendix B.2).
fn without_tint(document: &mut Value) {
    if let Some(document) = document.as_object_mut() {
        document.remove("extensionsUsed");
    }
    if let Some(surface) = document.pointer_mut("/materials/0").and_then(Value::as_object_mut) {
        surface.remove("extensions");
    }
}

fn document(material: &Material<'_>, tint: &Tint, mesh: &SphereMesh) -> Value {
    let [vertex_bytes, index_bytes] = [mesh.vertices.len() * 12, mesh.triangles.len() * 6];
    json!({
        "asset": { "version": "2.0", "generator": "Edgewise" },
        "extensionsUsed": ["EXT_materials_specular_edge_color", "KHR_materials_specular"],
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "name": material.name }],
        "meshes": [{
            "name": "sphere",
            "primitives": [{ "attributes": { "POSITION": 0, "NORMAL": 0 }, "indices": 1, "material": 0 }],
        }],
        "materials": [surface(material, tint)],
        "accessors": [
            {
                "bufferView": 0, "componentType": FLOAT, "count": mesh.vertices.len(), "type": "VEC3",
                "min": [-1.0, -1.0, -1.0], "max": [1.0, 1.0, 1.0],
            },
            {
                "bufferView": 1, "componentType": UNSIGNED_SHORT, "count": 3 * mesh.triangles.len(),
                "type": "SCALAR",
            },
        ],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": vertex_bytes, "target": ARRAY_BUFFER },
            { "buffer": 0, "byteOffset": vertex_bytes, "byteLength": index_bytes, "target": ELEMENT_ARRAY_BUFFER },
        ],
        "buffers": [{ "byteLength": vertex_bytes + index_bytes }],
    })
}

fn surface(material: &Material<'_>, tint: &Tint) -> Value {
    let Rgb([red, green, blue]) = tint.r.map(rounded);
    json!({
        "name": material.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [red, green, blue, 1.0],
            "metallicFactor": 1.0,
            "roughnessFactor": rounded(material.roughness),
        },
        "extensions": {
            "KHR_materials_specular": {
                "specularColorFactor": tint.t.map(rounded).0,
                "extensions": { "EXT_materials_specular_edge_color": { "specularEdgeColorEnabled": true } },
            },
        },
    })
}
