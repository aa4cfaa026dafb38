"""Blender side of the comparison with Cycles: opens a world exported by `airsim360 world export` and renders it on request.

    blender -b --factory-startup -P cycles_server.py -- WORLD.glb THREADS [plain]

`plain`: matt opaque surfaces of their base colours, as `frame_server ... plain` has them.

Reads one JSON object a line from standard input:
    {"size": [W, H], "samples": N, "bounces": B, "X_WC": {"p": [...], "q_wxyz": [...]}, "out": FILE or null,
     "columns": [first, end] of the picture to render, else all, "centred": rays through the middle of pixels, "sky": linear EXR panorama or null}
and answers each with a line `CYCLES {"seconds": ...}`. The scene and its acceleration structure stay in memory
between requests, so the seconds are those of rendering alone. Colour: sun of the export (0.53 degrees) and the
sky picture, else an even sky. Passes: combined, Z (along the ray, as Cycles does for panoramas), object index
(= entity id), normal.
"""
import json
import math
import os
import sys
import time

import bpy
import mathutils
import numpy

# Blender 3.4's importer uses a name that NumPy 1.24 (both of Debian 12) no longer has.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

SUN_ANGLE = math.radians(0.53)


def open_world(path, plain):
    """Imports the file; entity ids become pass indices, tints multiply base colours. What was imported is kept beside
    the file as .blend, which opens in seconds where a city's import takes minutes. Returns the sun."""
    kept = path + ".blend"
    if os.path.exists(kept) and os.path.getmtime(kept) > os.path.getmtime(path):
        bpy.ops.wm.open_mainfile(filepath=kept)
    else:
        import_world(path)
        bpy.ops.wm.save_as_mainfile(filepath=kept)
    for material in bpy.data.materials if plain else []:
        make_plain(material)
    return next((thing for thing in bpy.context.scene.objects if thing.type == "LIGHT"), None)


def import_world(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    for thing in bpy.context.scene.objects:
        if "airsim360_entity" in thing:
            thing.pass_index = int(thing["airsim360_entity"])
        if "airsim360_tint" in thing:
            thing.color = (*thing["airsim360_tint"], 1)
    for material in bpy.data.materials:
        tint_base_color(material)


def tint_base_color(material):
    """Base colour times the object's colour, which is its tint."""
    tree = material.node_tree
    shader = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None)
    if shader is None:
        return
    base = shader.inputs["Base Color"]
    product = tree.nodes.new("ShaderNodeMixRGB")
    product.blend_type = "MULTIPLY"
    product.inputs["Fac"].default_value = 1
    if base.is_linked:
        tree.links.new(base.links[0].from_socket, product.inputs["Color1"])
    else:
        product.inputs["Color1"].default_value = base.default_value
    info = tree.nodes.new("ShaderNodeObjectInfo")
    tree.links.new(info.outputs["Color"], product.inputs["Color2"])
    tree.links.new(product.outputs["Color"], base)


# The skin of a rough surface of n = 1.5 gives back 0.019 of even light, GGX alone 0.41 of it.
PLAIN_SKIN, GGX_ROUGH = 0.019, 0.41


def make_plain(material):
    """Lambert under the skin of roughness 1 that our BSDF has (shading_bsdf.h), holes kept."""
    tree = material.node_tree
    shader = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None)
    output = next((n for n in tree.nodes if n.type == "OUTPUT_MATERIAL"), None)
    if shader is None or output is None:
        return
    under = tree.nodes.new("ShaderNodeMixRGB")
    under.blend_type = "MULTIPLY"
    under.inputs["Fac"].default_value = 1
    under.inputs["Color2"].default_value = (*[1 - PLAIN_SKIN] * 3, 1)
    tree.links.new(shader.inputs["Base Color"].links[0].from_socket, under.inputs["Color1"])
    body, skin, both, hole, mix = (tree.nodes.new(name) for name in (
        "ShaderNodeBsdfDiffuse", "ShaderNodeBsdfGlossy", "ShaderNodeAddShader", "ShaderNodeBsdfTransparent", "ShaderNodeMixShader"))
    tree.links.new(under.outputs["Color"], body.inputs["Color"])
    skin.distribution = "GGX"
    skin.inputs["Roughness"].default_value = 1
    skin.inputs["Color"].default_value = (*[PLAIN_SKIN / GGX_ROUGH] * 3, 1)
    tree.links.new(body.outputs["BSDF"], both.inputs[0])
    tree.links.new(skin.outputs["BSDF"], both.inputs[1])
    surface = both.outputs["Shader"]
    if shader.inputs["Alpha"].is_linked:
        tree.links.new(shader.inputs["Alpha"].links[0].from_socket, mix.inputs["Fac"])
        tree.links.new(hole.outputs["BSDF"], mix.inputs[1])
        tree.links.new(surface, mix.inputs[2])
        surface = mix.outputs["Shader"]
    tree.links.new(surface, output.inputs["Surface"])


def set_up(threads, sun, plain):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_auto_tile = False
    cycles.caustics_refractive = False
    cycles.caustics_reflective = plain  # else a surface met by a diffuse ray loses its skin
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.render.use_persistent_data = True
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Raw"
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    layer = scene.view_layers[0]
    layer.use_pass_z = layer.use_pass_object_index = layer.use_pass_normal = True
    if sun is not None:
        sun.data.angle = SUN_ANGLE
    camera = bpy.data.cameras.new("rig")
    camera.type = "PANO"
    camera.cycles.panorama_type = "EQUIRECTANGULAR"
    camera.clip_start, camera.clip_end = 1e-3, 1e5
    scene.camera = bpy.data.objects.new("rig", camera)
    scene.collection.objects.link(scene.camera)
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True


def set_sky(path):
    """A linear panorama whose centre looks along +X and whose columns go clockwise, as ours do at yaw 0."""
    tree = bpy.context.scene.world.node_tree
    background = tree.nodes["Background"]
    if path is None:
        background.inputs["Color"].default_value = (0.5, 0.6, 0.8, 1)
        return
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(path)
    picture.image.colorspace_settings.name = "Linear"
    tree.links.new(picture.outputs["Color"], background.inputs["Color"])


def render(request, sun):
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = request["size"]
    scene.cycles.samples = request["samples"]
    scene.cycles.seed = request.get("seed", 0)
    bounces = request["bounces"]
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = scene.cycles.glossy_bounces = bounces
    scene.cycles.transmission_bounces = bounces
    # Labels: rays through the middle of pixels. Cycles' table of filter positions is half an entry off its middle, so
    # even a lone sample is off by 1/1022 of half the width; only the box ignores `filter_width` and is a whole pixel wide.
    scene.cycles.pixel_filter_type = "BLACKMAN_HARRIS" if request.get("centred") else "BOX"
    scene.cycles.filter_width = 0.01
    scene.view_layers[0].use_pass_position = bool(request.get("centred"))
    first, end = request.get("columns", [0, request["size"][0]])
    scene.render.use_border = "columns" in request
    scene.render.border_min_x, scene.render.border_max_x = first / request["size"][0], end / request["size"][0]
    if sun is not None and "sun_strength" in request:
        sun.data.energy = 1
        sun.data.color = request["sun_strength"]

    # Ours: x right, y down, z forward. Blender's: x right, y up, z back.
    pose = request["X_WC"]
    rotation = mathutils.Quaternion(pose["q_wxyz"]).to_matrix()
    columns = [rotation.col[0], -rotation.col[1], -rotation.col[2]]
    world = mathutils.Matrix([[columns[c][r] for c in range(3)] for r in range(3)]).to_4x4()
    world.translation = mathutils.Vector(pose["p"])
    scene.camera.matrix_world = world

    if request.get("out"):
        scene.render.filepath = request["out"]
    start = time.perf_counter()
    bpy.ops.render.render(write_still=bool(request.get("out")))
    return time.perf_counter() - start


def main():
    path, threads, *mode = sys.argv[sys.argv.index("--") + 1:]
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)  # Blender's own chatter
    start = time.perf_counter()
    plain = mode == ["plain"]
    sun = open_world(path, plain)
    set_up(int(threads), sun, plain)
    print("CYCLES", json.dumps({"ready": True, "import_seconds": time.perf_counter() - start}), file=answers)
    sky = ""
    for line in sys.stdin:
        request = json.loads(line)
        if request.get("sky") != sky:
            sky = request.get("sky")
            set_sky(sky)
        print("CYCLES", json.dumps({"seconds": render(request, sun)}), file=answers)


main()
