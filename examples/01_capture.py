"""Example 1: load a world, take one panorama, read every product of one pixel.

    PYTHONPATH=build/python /usr/bin/python3 examples/01_capture.py [WORLD]
"""
import sys

import numpy as np

import airsim360

# A world by name (or by path to a .glb, .gltf, .obj or .yaml file), seen by a drone 1.5 m above the ground that looks
# east; its panorama looks along the body's forward axis.
world = airsim360.World(sys.argv[1] if len(sys.argv) > 1 else "box_room")
capture = world.capture([0, 0, 1.5], airsim360.Rig(width=1024))

# Colour, range, category and entity of the pixel straight ahead all come from the same ray.
x, y = 512, 256
entity = world.entities[capture.entity[y, x] - 1]
print(f"ahead: {entity['name']} ({world.categories[capture.semantic[y, x]]}) at {capture.range[y, x]:.3f} m, "
      f"colour {capture.rgb[y, x]}")

# A range image is a point cloud: p_W = X_WC * (range * ray).
theta, phi = 2 * np.pi * ((x + 0.5) / 1024 - 0.5), np.pi * (0.5 - (y + 0.5) / 512)
ray = np.array([np.cos(phi) * np.sin(theta), -np.sin(phi), np.cos(phi) * np.cos(theta)])
print("that is the point", np.round(capture.pose[:3, :3] @ (capture.range[y, x] * ray) + capture.p, 2), "of the world")
