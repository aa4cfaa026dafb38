"""Example 2: turning the camera by k columns rolls the panorama by exactly k columns, byte for byte.

    PYTHONPATH=build/python /usr/bin/python3 examples/02_turn_the_rig.py
"""
import sys

import numpy as np

import airsim360

WIDTH, COLUMNS = 512, 37
world, rig = airsim360.World("box_room"), airsim360.Rig(width=WIDTH)

# The same place twice; the second time turned left by 37 columns, so everything moves 37 columns to the right.
before = world.capture([-1, 2, 1.5], rig)
after = world.capture([-1, 2, 1.5], rig, yaw=COLUMNS * 2 * np.pi / WIDTH)

different = sum(np.count_nonzero(np.roll(getattr(before, name), COLUMNS, axis=1) != getattr(after, name))
                for name in ("entity", "range", "rgb"))
print(f"{different} values differ")
sys.exit(different != 0)
