//! A script for Blender 4.2–5.0.

use std::fmt::Write as _;

use super::export::Written;
use super::material::Material;
use super::number::{number, triple};
use super::tint::Tint;
use crate::color::RgbSpace;

/// The working spaces a Blender file can have, by their Color Interop identifiers; before 5.0 only the first.
pub(super) const WORKING_SPACES: [(&str, RgbSpace); 3] = [
    ("lin_rec709_scene", RgbSpace::LinRec709),
    ("lin_rec2020_scene", RgbSpace::LinRec2020),
    ("lin_ap1_scene", RgbSpace::AcesCg),
];

/// Makes a material with a Principled BSDF: Base Color = r, Specular Tint = t.
///
/// The script states r and t for each working space and asks the file which it has: t of one space, or
/// t converted as a colour, would show another metal.
pub(super) fn write(header: &[String], material: &Material<'_>) -> Written {
    let mut values = String::new();
    for (interop_id, space) in WORKING_SPACES {
        let tint = Tint::in_space(material, space);
        let (r, t) = (triple(tint.r, ", "), triple(tint.t, ", "));
        if material.has_edge() {
            writeln!(values, "    \"{interop_id}\": (({r}), ({t})),")?;
        } else {
            writeln!(values, "    \"{interop_id}\": ({r}),")?;
        }
    }
    let (head, body) = if material.has_edge() {
        (HEAD.to_owned(), BODY.to_owned())
    } else {
        (HEAD.replace(HEAD_OF_TINT, HEAD_WITHOUT), BODY.replace("r, t = VALUES", "r = VALUES").replace(TINT, ""))
    };
    let header: String = header.iter().map(|line| format!("# {line}\n")).collect();
    // A JSON string is a Python string.
    let name = serde_json::to_string(&material.name)?;
    let roughness = number(material.roughness);
    Ok(format!("{header}{head}NAME = {name}\nROUGHNESS = {roughness}\nVALUES = {{\n{values}}}\n{body}").into_bytes())
}

const HEAD: &str = "\
# For Blender 4.2 to 5.0: open in the text editor and run.

import bpy

# Base Color r and Specular Tint t = h / (q + (1 - q) r), q = (6/7)^5, for each working space.
# t is no colour: it was derived in each space, and must not be converted between them.
";

/// What the head says of the tint, and what it says where there is none.
const HEAD_OF_TINT: &str = "\
# Base Color r and Specular Tint t = h / (q + (1 - q) r), q = (6/7)^5, for each working space.
# t is no colour: it was derived in each space, and must not be converted between them.
";
const HEAD_WITHOUT: &str = "# Base Color r for each working space; Specular Tint stays white.\n";

/// The line that sets the tint.
const TINT: &str = "    principled.inputs[\"Specular Tint\"].default_value = (*t, 1.0)\n";

const BODY: &str = r#"

def working_space():
    """The Color Interop identifier of the file's working space; before Blender 5.0 it is Linear Rec.709."""
    colorspace = getattr(bpy.data, "colorspace", None)
    return colorspace.working_space_interop_id if colorspace else "lin_rec709_scene"


def edgewise_material():
    """The material, made again if it is there."""
    space = working_space()
    if space not in VALUES:
        raise RuntimeError(f"{NAME}: the working space of this file is {space!r}; it must be one of {', '.join(VALUES)}")
    r, t = VALUES[space]
    material = bpy.data.materials.get(NAME) or bpy.data.materials.new(NAME)
    if not material.use_nodes:
        material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    principled = nodes.new("ShaderNodeBsdfPrincipled")
    output = nodes.new("ShaderNodeOutputMaterial")
    output.location = (300.0, 0.0)
    principled.inputs["Base Color"].default_value = (*r, 1.0)
    principled.inputs["Metallic"].default_value = 1.0
    principled.inputs["Specular Tint"].default_value = (*t, 1.0)
    principled.inputs["Roughness"].default_value = ROUGHNESS
    material.node_tree.links.new(principled.outputs["BSDF"], output.inputs["Surface"])
    return material


edgewise_material()
"#;
