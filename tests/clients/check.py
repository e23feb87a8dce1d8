"""Exports gold and chromium, loads the files into the programs they are for and compares what these show.

    cargo build && tests/clients/run.sh target/debug/edgewise [words of check names]

run.sh installs the programs of requirements.txt and, where there is npm, the validator of glTF files; glslang is
Debian's glslang-tools. Blender is for requirements-blender.txt: install it into target/clients and run this file.

Prints the largest |F_reader - F_model| over 0-89 degrees and the channels, and fails where it exceeds what
docs/exports.md states. A program that is not installed fails too, but for those of MAY_BE_MISSING: their checks are
counted as skipped and named at the end.
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

Q = (6 / 7) ** 5
ANGLES = np.radians(np.arange(0, 90))
METALS = {
    "gold": ([1.0, 0.782, 0.344], [0.986, 0.882, 0.630]),
    "chromium": ([0.635, 0.662, 0.705], [0.576, 0.612, 0.697]),
}
# Linear Rec.709 to ACEScg with Bradford adaptation, as MaterialX and OpenColorIO print it to six digits.
ACESCG_FROM_REC709 = np.array([
    [0.613097, 0.339523, 0.047379],
    [0.070194, 0.916354, 0.013452],
    [0.020616, 0.109570, 0.869815],
])
SPACES = {"": np.eye(3), ".acescg": ACESCG_FROM_REC709}


def model(r, h, angles=ANGLES):
    """Hoffman's curve, one row for each angle."""
    c = np.cos(angles)[:, None]
    x = 1 - c
    r, h = np.asarray(r), np.asarray(h)
    a = 823543 / 46656 * (r - h) + 49 / 6 * (1 - r)
    return r + (1 - r) * x**5 - a * c * x**6


def tint_model(r, t, angles=ANGLES):
    """The same curve from r and t."""
    return model(r, np.asarray(t) * (Q + (1 - Q) * np.asarray(r)), angles)


def conductor(n, k, angles=ANGLES):
    """Exact unpolarised Fresnel of a conductor in air."""
    c = np.cos(angles)[:, None].astype(complex)
    eps = (np.asarray(n) + 1j * np.asarray(k)) ** 2
    root = np.sqrt(eps - (1 - c * c))
    s, p = (c - root) / (c + root), (eps * c - root) / (eps * c + root)
    return 0.5 * (abs(s) ** 2 + abs(p) ** 2)


def off(shown, metal, suffix="", angles=ANGLES):
    """Largest difference from the model of a metal, in the space a file name stands for."""
    r, h = (SPACES[suffix] @ np.array(v) for v in METALS[metal])
    return float(np.abs(shown - model(r, h, angles)).max())


# MaterialX ------------------------------------------------------------------------------------------------

def load_materialx(path):
    """A document that is valid together with the standard libraries, and its material's surface node."""
    import MaterialX as mx

    libraries = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), libraries)
    document = mx.createDocument()
    mx.readFromXmlFile(document, str(path))
    document.setDataLibrary(libraries)
    valid, message = document.validate()
    assert valid, f"{path}: {message}"
    material = document.getMaterialNodes()[0]
    return document, mx.getShaderNodes(material)[0]


def generate_glsl(document, shader):
    """MaterialX's own generator accepts the node; returns the pixel shader."""
    import MaterialX as mx
    from MaterialX import PyMaterialXGenGlsl, PyMaterialXGenShader

    generator = PyMaterialXGenGlsl.GlslShaderGenerator.create()
    context = PyMaterialXGenShader.GenContext(generator)
    context.registerSourceCodeSearchPath(mx.getDefaultDataSearchPath())
    generated = generator.generate("check", shader, context)
    return generated.getSourceCode("pixel")


def uniform(source, name):
    """The value of a color uniform of a generated shader."""
    found = re.search(rf"uniform vec3 {name} = vec3\(([^)]*)\)", source)
    assert found, f"no {name} in the generated shader"
    return [float(v) for v in found.group(1).split(",")]


def check_open_pbr(folder, metal, suffix):
    document, shader = load_materialx(folder / f"{metal}{suffix}.open_pbr.mtlx")
    source = generate_glsl(document, shader)
    name = shader.getName()
    return off(tint_model(uniform(source, "base_color"), uniform(source, "specular_color")), metal, suffix)


def check_generalized_schlick(folder, metal, suffix):
    document, shader = load_materialx(folder / f"{metal}{suffix}.generalized_schlick.mtlx")
    source = generate_glsl(document, shader)
    bsdf = f"{metal}_bsdf"
    return off(tint_model(uniform(source, f"{bsdf}_color0"), uniform(source, f"{bsdf}_color82")), metal, suffix)


def check_standard_surface(folder, metal, suffix):
    document, shader = load_materialx(folder / f"{metal}{suffix}.standard_surface.mtlx")
    source = generate_glsl(document, shader)
    r, g = np.clip(uniform(source, "base_color"), 0, 0.99), np.array(uniform(source, "specular_color"))
    n = g * (1 - r) / (1 + r) + (1 - g) * (1 + np.sqrt(r)) / (1 - np.sqrt(r))
    k = np.sqrt(np.maximum(((n + 1) ** 2 * r - (n - 1) ** 2) / (1 - r), 0))
    return off(conductor(n, k), metal, suffix)


# OpenUSD --------------------------------------------------------------------------------------------------

def check_usd(folder, metal, suffix):
    from pxr import Usd, UsdShade, UsdValidation

    path = folder / f"{metal}{suffix}.usda"
    stage = Usd.Stage.Open(str(path))
    context = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators())
    # The wheel of usd-core has no MaterialX, so it cannot know the node.
    unknown = "'ND_open_pbr_surface_surfaceshader' specified on shader prim"
    errors = [error.GetMessage() for error in context.Validate(stage) if unknown not in error.GetMessage()]
    assert not errors, f"{path}: {errors}"
    material = UsdShade.Material(stage.GetDefaultPrim())
    worst = 0.0
    for context_name, (r, t) in {"mtlx": ("base_color", "specular_color"), "": ("diffuseColor", "specularColor")}.items():
        shader = material.ComputeSurfaceSource(context_name)[0]
        value = lambda name: list(shader.GetInput(name).Get())
        worst = max(worst, off(tint_model(value(r), value(t)), metal, suffix))
    return worst


# Mitsuba --------------------------------------------------------------------------------------------------

def mirror_reflectance(bsdf):
    """What a smooth BSDF of Mitsuba returns for each angle."""
    import mitsuba as mi

    rows = []
    for angle in ANGLES:
        si = mi.SurfaceInteraction3f()
        si.wi = mi.Vector3f(float(np.sin(angle)), 0.0, float(np.cos(angle)))
        _, weight = bsdf.sample(mi.BSDFContext(), si, 0.5, mi.Point2f(0.5, 0.5), True)
        rows.append([float(v) for v in weight])
    return np.array(rows)


def check_mitsuba(folder, metal, suffix):
    import mitsuba as mi

    mi.set_variant("scalar_rgb")
    path = folder / f"{metal}{suffix}.mitsuba.xml"
    mi.load_file(str(path))  # as a scene of its own, to which another can refer
    bsdf = re.search(r"<bsdf.*</bsdf>", path.read_text(), re.S).group(0)
    bsdf = mi.load_string(bsdf.replace("<bsdf", '<bsdf version="3.0.0"', 1))
    return off(mirror_reflectance(bsdf), metal, suffix)


def check_mitsuba_plugin(folder, metal, suffix):
    import mitsuba as mi

    mi.set_variant("scalar_rgb")
    path = folder / f"{metal}{suffix}.mitsuba.py"
    exec(compile(path.read_text(), str(path), "exec"), {"__name__": "plugin"})
    return off(mirror_reflectance(mi.load_dict({"type": f"edgewise_{metal}"})), metal, suffix)


def check_mitsuba_plugin_rough(folder, metal, suffix):
    """For r = h = 1, which is white at every angle, the rough plugin is Mitsuba's own GGX without a material."""
    import mitsuba as mi

    if suffix:
        return None
    mi.set_variant("scalar_rgb")
    path = folder / f"{metal}.mitsuba.py"
    exec(compile(path.read_text(), str(path), "exec"), {"__name__": "plugin"})
    white = mi.ScalarColor3f(1.0)
    ours = mi.load_dict({"type": f"edgewise_{metal}", "alpha": 0.3, "r": white, "h": white})
    theirs = mi.load_dict({"type": "roughconductor", "material": "none", "alpha": 0.3, "distribution": "ggx"})
    si, context, worst = mi.SurfaceInteraction3f(), mi.BSDFContext(), 0.0
    for x, z, u, v in np.random.default_rng(1).uniform(0.05, 0.95, (200, 4)):
        wi = np.array([x, 0.1, z]) / np.linalg.norm([x, 0.1, z])
        si.wi = mi.Vector3f(*wi)
        results = []
        for bsdf in (ours, theirs):
            sample, weight = bsdf.sample(context, si, 0.5, mi.Point2f(u, v), True)
            wo = mi.Vector3f(*(0.1, 0.2, 0.9747))
            results.append([*weight, *sample.wo, sample.pdf, *bsdf.eval(context, si, wo, True), bsdf.pdf(context, si, wo, True)])
        worst = max(worst, float(np.abs(np.subtract(*results)).max()))
    return worst


# Blender --------------------------------------------------------------------------------------------------

def blender_material(folder, metal):
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    path = folder / f"{metal}.blender.py"
    exec(compile(path.read_text(), str(path), "exec"), {"__name__": "script"})
    return bpy.data.materials[metal.capitalize()]


def check_blender(folder, metal, suffix):
    """The material the script leaves behind says r and t."""
    if suffix:
        return None
    nodes = blender_material(folder, metal).node_tree.nodes
    principled = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    value = lambda name: list(principled.inputs[name].default_value)[:3]
    return off(tint_model(value("Base Color"), value("Specular Tint")), metal)


def check_cycles(folder, metal, suffix):
    """Cycles itself: an orthographic camera looks at a smooth plane under each angle in a white world."""
    if suffix:
        return None
    import bpy

    material = blender_material(folder, metal)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 1
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 1
    scene.render.resolution_x = scene.render.resolution_y = 4
    scene.render.threads_mode = "FIXED"
    scene.render.threads = 1
    scene.view_settings.view_transform = "Raw"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.world = bpy.data.worlds.new("white")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    bpy.ops.mesh.primitive_plane_add(size=1000)
    bpy.context.object.data.materials.append(material)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 0.01
    scene.collection.objects.link(camera)
    scene.camera = camera
    degrees = np.array([0, 30, 60, 75, 80, 82, 85, 88])
    rows = []
    for degree in degrees:
        angle = np.radians(degree)
        camera.location = (10 * np.sin(angle), 0, 10 * np.cos(angle))
        camera.rotation_euler = (0, angle, 0)
        scene.render.filepath = str(folder / "cycles.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        pixels = np.array(image.pixels[:]).reshape(-1, 4)[:, :3]
        bpy.data.images.remove(image)
        rows.append(pixels.mean(axis=0))
    return off(np.array(rows), metal, angles=np.radians(degrees))


def check_blender_gltf(folder, metal, suffix):
    """Blender's glTF importer finds r and t."""
    if suffix:
        return None
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(folder / f"{metal}.glb"))
    nodes = bpy.data.materials[0].node_tree.nodes
    principled = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    value = lambda name: list(principled.inputs[name].default_value)[:3]
    return off(tint_model(value("Base Color"), value("Specular Tint")), metal)


def check_blender_usd(folder, metal, suffix):
    """Blender's USD importer finds r and t in UsdPreviewSurface."""
    if suffix:
        return None
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=str((folder / f"{metal}.usda").resolve()), import_all_materials=True)
    nodes = bpy.data.materials[0].node_tree.nodes
    principled = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    value = lambda name: list(principled.inputs[name].default_value)[:3]
    return off(tint_model(value("Base Color"), value("Specular Tint")), metal)


# Others ---------------------------------------------------------------------------------------------------

def check_gltf_validator(folder, metal, suffix):
    if suffix:
        return None
    script = (
        "const v=require('gltf-validator');const fs=require('fs');"
        "v.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1])))"
        ".then(r=>console.log(JSON.stringify(r.issues)))"
    )
    path = (folder / f"{metal}.glb").resolve()
    modules = Path(sys.prefix)
    if not (modules / "node_modules/gltf-validator").is_dir():
        raise ImportError("gltf-validator")
    done = subprocess.run(["node", "-e", script, str(path)], cwd=modules, capture_output=True, text=True, check=True)
    issues = json.loads(done.stdout)
    assert issues["numErrors"] == issues["numWarnings"] == 0, issues
    for message in issues["messages"]:
        print(f"    {message['code']}: {message['message']}")
    return 0.0


def check_opencolorio(folder, metal, suffix):
    import PyOpenColorIO as ocio

    config = ocio.Config.CreateRaw()
    path = str((folder / f"{metal}{suffix}.cube").resolve())
    transform = ocio.FileTransform(src=path, interpolation=ocio.INTERP_LINEAR)
    cpu = config.getProcessor(transform).getOptimizedCPUProcessor(ocio.OPTIMIZATION_LOSSLESS)
    return off(np.array([cpu.applyRGB([float(np.cos(angle))] * 3) for angle in ANGLES]), metal, suffix)


# glslang --------------------------------------------------------------------------------------------------

def compile_shader(folder, name, source, *options):
    """glslang takes the source; its complaint is the error."""
    if not shutil.which("glslangValidator"):
        raise ImportError("glslangValidator (Debian: glslang-tools)")
    path = folder / name
    path.write_text(source)
    done = subprocess.run(["glslangValidator", *options, str(path)], capture_output=True, text=True)
    assert done.returncode == 0, f"{name}: {done.stdout}{done.stderr}"


def check_glsl(folder, metal, suffix):
    """The function compiles in OpenGL, OpenGL ES and Vulkan."""
    source = (folder / f"{metal}{suffix}.glsl").read_text()
    main = f"layout(location = 0) out vec4 colour;\nvoid main() {{ colour = vec4(fresnel_{metal}(0.5), 1.0); }}\n"
    compile_shader(folder, "check.330.frag", f"#version 330\n{source}{main}")
    compile_shader(folder, "check.300es.frag", f"#version 300 es\nprecision highp float;\n{source}{main}")
    compile_shader(folder, "check.450.frag", f"#version 450\n{source}{main}", "-V", "-o", str(folder / "check.spv"))
    return 0.0


def check_hlsl(folder, metal, suffix):
    """The function compiles as HLSL."""
    source = (folder / f"{metal}{suffix}.hlsl").read_text()
    main = f"float4 main() : SV_Target {{ return float4(fresnel_{metal}(0.5), 1.0); }}\n"
    options = ["-D", "-V", "-S", "frag", "-e", "main", "-o", str(folder / "check.spv")]
    compile_shader(folder, "check.hlsl", source + main, *options)
    return 0.0


def check_generated_glsl(folder, metal, suffix):
    """What MaterialX generates from the documents compiles."""
    for kind in ["open_pbr", "generalized_schlick", "standard_surface"]:
        document, shader = load_materialx(folder / f"{metal}{suffix}.{kind}.mtlx")
        compile_shader(folder, "generated.frag", generate_glsl(document, shader))
    return 0.0


# Programs that the continuous integration may be without: Blender is large, and node is not everywhere.
MAY_BE_MISSING = {"bpy", "gltf-validator"}

CHECKS = {
    "open-pbr (MaterialX)": (check_open_pbr, 1e-6),
    "generalized-schlick (MaterialX)": (check_generalized_schlick, 1e-6),
    "standard-surface (MaterialX)": (check_standard_surface, 0.03),
    "usd (OpenUSD)": (check_usd, 1e-6),
    "mitsuba": (check_mitsuba, 0.03),
    "mitsuba-plugin": (check_mitsuba_plugin, 1e-6),
    "mitsuba-plugin, rough": (check_mitsuba_plugin_rough, 1e-4),
    "gltf (validator)": (check_gltf_validator, 0.0),
    "cube (OpenColorIO)": (check_opencolorio, 2e-6),
    "glsl (glslang)": (check_glsl, 0.0),
    "hlsl (glslang)": (check_hlsl, 0.0),
    "generated GLSL (MaterialX, glslang)": (check_generated_glsl, 0.0),
    "blender script": (check_blender, 1e-6),
    "gltf (Blender)": (check_blender_gltf, 1e-6),
    "usd (Blender)": (check_blender_usd, 1e-6),
    "blender (Cycles)": (check_cycles, 2e-6),
}


def export(edgewise, folder):
    """Every target of the checks in both spaces, of smooth metals."""
    files = []
    for name, (r, h) in METALS.items():
        preset = {"edgewise": 1, "name": name.capitalize(), "space": "lin_rec709", "r": r, "h": h}
        preset |= {"roughness": 0.0, "origin": {"kind": "authored"}}
        files.append(folder / f"{name}.preset.json")
        files[-1].write_text(json.dumps(preset))
    targets = ["open-pbr", "generalized-schlick", "standard-surface", "usd", "mitsuba", "mitsuba-plugin", "cube"]
    targets += ["glsl", "hlsl"]
    for space, names in {"lin_rec709": [*targets, "blender", "gltf"], "acescg": targets}.items():
        to = [word for name in names for word in ("--to", name)]
        subprocess.run([edgewise, "export", *files, *to, "--space", space, "-o", folder], check=True, stdout=subprocess.DEVNULL)


def main(edgewise, wanted):
    with tempfile.TemporaryDirectory() as folder:
        export(edgewise, Path(folder))
        return run_checks(Path(folder), wanted)


def run_checks(folder, wanted):
    passed, failed, skipped = 0, 0, {}
    for name, (check, limit) in CHECKS.items():
        if wanted and not any(word in name for word in wanted):
            continue
        for metal in METALS:
            for suffix in SPACES:
                try:
                    difference = check(folder, metal, suffix)
                except ImportError as missing:
                    program = missing.name or str(missing)
                    if program in MAY_BE_MISSING:
                        skipped.setdefault(f"{name}: {program}", []).append(metal + suffix)
                        continue
                    print(f"FAILED   {name} {metal}{suffix}: {program} is not installed")
                    failed += 1
                    continue
                except Exception as error:
                    print(f"FAILED   {name} {metal}{suffix}: {error}")
                    failed += 1
                    continue
                if difference is None:
                    continue
                # The matrix of this script has six digits.
                bad = difference > limit + (2e-6 if suffix else 0)
                failed, passed = failed + bad, passed + (not bad)
                print(f"{'FAILED  ' if bad else 'ok      '} {name} {metal}{suffix}: {difference:.2g}")
    for what, files in skipped.items():
        print(f"SKIPPED  {what} is not installed, so {', '.join(files)} was not loaded into it")
    print(f"clients: {passed} passed, {failed} failed, {sum(map(len, skipped.values()))} skipped")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve(), sys.argv[2:]))
