from . import airsim as airsim, gym as gym
from ._native import (PARTS as PARTS, Capture as Capture, CudaCapture as CudaCapture, Drone as Drone, DroneState as DroneState, Lidar as Lidar,
                      LidarScan as LidarScan, Plan as Plan, Recording as Recording,
                      Rig as Rig, Simulation as Simulation, Snapshot as Snapshot, Tensor as Tensor, Threads as Threads,
                      VectorEnvironment as VectorEnvironment, VideoWriter as VideoWriter, World as World, drone_catalog as drone_catalog, gpus as gpus,
                      metrics as metrics, plan_minimum_snap as plan_minimum_snap, thread_count as thread_count,
                      worlds as worlds)

__version__: str
