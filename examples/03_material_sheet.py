"""Example 3: a world of your own: panels in a row, written as OBJ with materials, imported, labelled and rendered.

    PYTHONPATH=build/python /usr/bin/python3 examples/03_material_sheet.py
"""
import pathlib
import sys
import tempfile

import numpy as np

import airsim360

COLOURS = {"red_paint": (0.6, 0.05, 0.05), "green_paint": (0.05, 0.5, 0.1), "blue_paint": (0.05, 0.1, 0.6)}

with tempfile.TemporaryDirectory() as folder:
    # OBJ files are +Y up here, as glTF: a panel is 2 m wide and stands 4 m in front of the origin, which looks along -Z.
    obj, mtl = ["mtllib sheet.mtl"], []
    for i, (name, colour) in enumerate(COLOURS.items()):
        left = 2.5 * i - 3.5
        obj += [f"o {name}_panel", f"usemtl {name}"]
        obj += [f"v {left + dx} {y} -4" for dx, y in ((0, 0), (2, 0), (2, 2), (0, 2))]
        obj.append("f " + " ".join(str(4 * i + k) for k in (1, 2, 3, 4)))
        mtl += [f"newmtl {name}", "Kd " + " ".join(map(str, colour))]
    path = pathlib.Path(folder) / "sheet.obj"
    path.write_text("\n".join(obj) + "\n")
    path.with_name("sheet.mtl").write_text("\n".join(mtl) + "\n")
    world = airsim360.World(str(path))

# Where the panels are in W, and a picture of them from 4 m away.
middle = world.bounds.mean(axis=0)
print("bounds:", np.round(world.bounds, 2).tolist())
ahead = np.array([0.0, 4.0, 0.0]) if np.ptp(world.bounds[:, 1]) < 0.1 else np.array([4.0, 0.0, 0.0])
capture = world.capture(middle - ahead, airsim360.Rig(width=512), yaw=float(np.arctan2(ahead[1], ahead[0])))

# Every panel is an entity of its own, in its colour.
for entity in world.entities:
    pixels = capture.entity == entity["id"]
    if pixels.any():
        print(f"{entity['name']}: {pixels.sum()} pixels, mean colour {capture.rgb[pixels].mean(axis=0).round()}")
panels = [e for e in world.entities if "panel" in e["name"] and (capture.entity == e["id"]).any()]
sys.exit(len(panels) != len(COLOURS))
