"""Example 7: collect a small dataset along a survey of a world, check it, and evaluate a depth estimate on it.

    PYTHONPATH=build/python /usr/bin/python3 examples/07_dataset.py [FOLDER]
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

import airsim360

program = os.environ.get("AIRSIM360", str(pathlib.Path(__file__).resolve().parents[1] / "build/bin/airsim360"))
temporary = tempfile.TemporaryDirectory()
folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else temporary.name) / "box_room"

# A tour through the free space of the world: eight panoramas spread evenly along it. Every file keeps its SHA-256.
subprocess.run([program, "collect", "--world", "box_room", "--frames", "8", "--size", "256x128", "--out", folder],
               check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
subprocess.run([program, "verify", folder], check=True, stdout=subprocess.DEVNULL)
frames = [json.loads(line) for line in (folder / "frames.jsonl").read_text().splitlines()]

# The poses of the dataset are enough to see again what was seen, in memory and without files: depth from the renderer.
world, rig = airsim360.World("box_room"), airsim360.Rig(width=256, products=["range"], tier="labels")
phi = np.pi * (0.5 - (np.arange(128) + 0.5) / 128)
weights = np.repeat(np.cos(phi)[:, None], 256, axis=1)  # solid angle of a pixel, but for a factor
errors = []
for frame in frames:
    w, x, y, z = frame["X_WC"]["q_wxyz"]
    forward = np.array([2 * (x * z + w * y), 2 * (y * z - w * x)])  # third column of the rotation, seen from above
    capture = world.capture(frame["X_WC"]["p"], rig, yaw=float(np.arctan2(forward[1], forward[0])))
    np.testing.assert_allclose(capture.q_wxyz, [w, x, y, z], atol=1e-6)
    truth = capture.range
    # An estimator that always says 4 m, scored as depth papers do, every pixel weighted by its solid angle.
    errors.append(np.average(np.abs(4 - truth) / truth, weights=weights * (truth > 0)))
print(f"{len(frames)} frames; 'always 4 m': mean relative error {np.mean(errors):.3f}")
sys.exit(len(frames) != 8)
