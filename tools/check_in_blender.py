"""Opens an exported world in Blender and prints whether names, labels and places came through.

usage: blender --background --factory-startup --python-exit-code 1 --python tools/check_in_blender.py -- FILE.glb [LEAST]

FILE.glb is what `airsim360 world export` wrote. Prints counts and the size of the whole, and fails if fewer than LEAST
objects (1) carry a category.
"""
import sys

import bpy
import numpy
from mathutils import Vector


# The glTF reader of Debian 12's Blender 3.4 asks numpy for an alias that its numpy 1.24 has no more.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

LABEL = "airsim360_category"


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:]
    least = int(arguments[1]) if len(arguments) > 1 else 1
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=arguments[0])
    objects = list(bpy.data.objects)
    meshes = [o for o in objects if o.type == "MESH"]
    labelled = {}
    for o in objects:
        if LABEL in o:
            labelled.setdefault(o[LABEL], []).append(o.name)
    low, high = Vector((1e9,) * 3), Vector((-1e9,) * 3)
    for o in meshes:
        for corner in o.bound_box:
            p = o.matrix_world @ Vector(corner)
            low = Vector(map(min, low, p))
            high = Vector(map(max, high, p))
    triangles = sum(len(p.vertices) - 2 for m in bpy.data.meshes for p in m.polygons)
    print(f"blender {bpy.app.version_string}: {len(objects)} objects, {len(meshes)} of them meshes, {len(bpy.data.meshes)} different meshes,"
          f" {triangles} triangles, {len(bpy.data.materials)} materials, {len(bpy.data.images)} pictures")
    print(f"size {high.x - low.x:.2f} x {high.y - low.y:.2f} x {high.z - low.z:.2f} m from {low.x:.2f}, {low.y:.2f}, {low.z:.2f}")
    print(f"{sum(map(len, labelled.values()))} objects with a category, {len(labelled)} categories")
    for path in sorted(labelled)[:12]:
        print(f"  {path}: {len(labelled[path])}, first '{labelled[path][0]}'")
    for o in objects[:2]:
        print("  properties of", o.name, {k: o[k] for k in o.keys()})
    if sum(map(len, labelled.values())) < least:
        sys.exit("too few objects carry a category")


main()
