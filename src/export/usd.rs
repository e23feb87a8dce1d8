//! USD: one material with two surfaces, the exact one and the one every viewer knows.

use super::export::Written;
use super::material::Material;
use super::number::{number, triple};
use super::tint::Tint;
use crate::color::RgbSpace;

/// A `Material` prim with OpenPBR for renderers that take MaterialX, and UsdPreviewSurface for the others.
///
/// useSpecularWorkflow stays 0: with 1, Blender reads a black dielectric.
pub(super) fn write(header: &[String], material: &Material<'_>, tint: &Tint) -> Written {
    let comments: String = header.iter().map(|line| format!("# {line}\n")).collect();
    let name = &material.identifier;
    let display_name = material.name.replace('"', "\\\"");
    let space = interop_id(material.space);
    let (r, t, roughness) = (triple(tint.r, ", "), triple(tint.t, ", "), number(material.roughness));
    // Without them both surfaces have a white tint, which is Schlick's edge.
    let tint = |input: &str| {
        if material.has_edge() { format!("        color3f inputs:{input} = ({t})\n") } else { String::new() }
    };
    let (open_pbr_tint, preview_tint) = (tint("specular_color"), tint("specularColor"));
    Ok(format!(
        r#"#usda 1.0
(
    defaultPrim = "{name}"
    metersPerUnit = 1
    upAxis = "Y"
)

{comments}
def Material "{name}" (
    displayName = "{display_name}"
    prepend apiSchemas = ["ColorSpaceAPI"]
)
{{
    uniform token colorSpace:name = "{space}"
    token outputs:mtlx:surface.connect = </{name}/OpenPbr.outputs:out>
    token outputs:surface.connect = </{name}/Preview.outputs:surface>

    def Shader "OpenPbr"
    {{
        uniform token info:id = "ND_open_pbr_surface_surfaceshader"
        float inputs:base_weight = 1
        color3f inputs:base_color = ({r})
        float inputs:base_metalness = 1
        float inputs:specular_weight = 1
{open_pbr_tint}        float inputs:specular_roughness = {roughness}
        token outputs:out
    }}

    def Shader "Preview"
    {{
        uniform token info:id = "UsdPreviewSurface"
        int inputs:useSpecularWorkflow = 0
        float inputs:metallic = 1
        color3f inputs:diffuseColor = ({r})
{preview_tint}        float inputs:roughness = {roughness}
        token outputs:surface
    }}
}}
"#
    )
    .into_bytes())
}

/// USD names spaces by the Color Interop Forum's identifiers and knows no other.
const fn interop_id(space: RgbSpace) -> &'static str {
    match space {
        RgbSpace::LinRec709 => "lin_rec709_scene",
        RgbSpace::LinDisplayP3 => "lin_p3d65_scene",
        RgbSpace::LinRec2020 => "lin_rec2020_scene",
        RgbSpace::AcesCg => "lin_ap1_scene",
    }
}
