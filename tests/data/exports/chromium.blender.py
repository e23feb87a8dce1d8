# Chromium, written by Edgewise
# lin_rec709: r = 0.635 0.662 0.705 facing, h = 0.576 0.612 0.697 at 81.8°
# For Blender 4.2 to 5.0: open in the text editor and run.

import bpy

# Base Color r and Specular Tint t = h / (q + (1 - q) r), q = (6/7)^5, for each working space.
# t is no colour: it was derived in each space, and must not be converted between them.
NAME = "Chromium"
ROUGHNESS = 0.0
VALUES = {
    "lin_rec709_scene": ((0.635, 0.662, 0.705), (0.716531545, 0.747818354, 0.82829662)),
    "lin_rec2020_scene": ((0.646922557, 0.660622953, 0.700068027), (0.731964098, 0.74663401, 0.819630556)),
    "lin_ap1_scene": ((0.647483687, 0.660683223, 0.698845408), (0.732753629, 0.746773437, 0.817477125)),
}


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
