"""Example 5: plan the smoothest trajectory through waypoints within limits, and fly it.

    PYTHONPATH=build/python /usr/bin/python3 examples/05_minimum_snap.py
"""
import sys

import numpy as np

import airsim360

# Around the room, at most 3 m/s and 4 m/s^2 anywhere on the way, proved to keep 0.4 m from every surface.
world = airsim360.World("box_room")
waypoints = np.array([[-3, -3, 2], [3, -3, 3], [3, 3, 2], [-3, 3, 3], [-3, -3, 2]], float)
plan = airsim360.plan_minimum_snap(waypoints, vmax=3, amax=4, world=world, clearance=0.4)
print(f"{len(waypoints)} waypoints in {plan.duration:.2f} s, coefficients {plan.coefficients.shape}, {plan.certificate}")

# A drone hovers at the first waypoint; its autopilot follows the plan with every derivative of it.
sim = airsim360.Simulation(world, airsim360.Drone("hummingbird", position=waypoints[0], airborne=True))
sim.fly_trajectory(plan, yaw=0.0)

# How far is it from where it should be?
errors, speeds = [], []
while sim.t < plan.duration:
    sim.step(5)
    state = sim.state()
    errors.append(np.linalg.norm(state.position - plan.at([sim.t])["p"][0]))
    speeds.append(np.linalg.norm(state.velocity))
rms = np.sqrt(np.mean(np.square(errors)))
print(f"tracking error {rms:.3f} m rms, {max(errors):.3f} m at most; fastest {max(speeds):.2f} m/s")
sys.exit(bool(max(errors) > 0.3) or sim.state().collision is not None)
