"""Example 4: fly a drone with velocity commands, look at what it meets, and record the flight bit for bit.

    PYTHONPATH=build/python /usr/bin/python3 examples/04_fly_and_record.py
"""
import sys

import numpy as np

import airsim360

# A drone that starts hovering 2 m above the floor.
drone = airsim360.Drone("hummingbird", position=[-3, -3, 2], airborne=True)
sim = airsim360.Simulation(airsim360.World("box_room"), drone)
start = sim.snapshot()

# Each leg is 2 s at 2 m/s.
sim.start_recording("a square in box_room")
for velocity in ([2, 0, 0], [0, 2, 0], [-2, 0, 0], [0, -2, 0]):
    sim.fly_velocity(velocity, yaw="forward")
    for _ in range(4):
        sim.run(0.5)
        s = sim.state()
        print(f"t {s.t:.1f} s: {np.round(s.position, 2)}, {np.linalg.norm(s.velocity):.2f} m/s, "
              f"{s.clearance:.2f} m to the nearest surface")
for event in sim.events():
    print("event:", event["event"])

# What the drone saw last, and the recording, which repeats the flight to the same bytes.
picture = sim.capture(airsim360.Rig(width=256))
print(f"nearest pixel {picture.range.min():.2f} m")
replay = sim.replay(sim.stop_recording(), start)
same = replay["same"] and replay["hash"] == sim.hash()
print(f"replay of {replay['steps']} steps: {'the same bytes' if same else 'it differs'}")
sys.exit(not same or bool(np.linalg.norm(sim.state().position - [-3, -3, 2]) > 1))
