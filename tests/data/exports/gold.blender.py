# Gold, written by Edgewise
# lin_rec709: r = 1.0 0.782 0.344 facing, h = 0.986 0.882 0.63 at 81.8°
# For Blender 4.2 to 5.0: open in the text editor and run.

import bpy

# Base Color r and Specular Tint t = h / (q + (1 - q) r), q = (6/7)^5, for each working space.
# t is no colour: it was derived in each space, and must not be converted between them.
NAME = "Gold"
ROUGHNESS = 0.0
VALUES = {
    "lin_rec709_scene": ((1.0, 0.782, 0.344), (0.986, 0.999024952, 0.972961216)),
    "lin_rec2020_scene": ((0.899802927, 0.792086515, 0.393302613), (0.989615473, 0.997795898, 0.976283128)),
    "lin_ap1_scene": ((0.894903034, 0.791410081, 0.405515389), (0.989713977, 0.997739586, 0.977060877)),
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
