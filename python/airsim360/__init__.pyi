from . import airsim as airsim, data as data, dataset as dataset, gym as gym, metrics as metrics, pictures as pictures, records as records, viewer as viewer
from ._native import (PARTS as PARTS, PICTURE_SETTINGS as PICTURE_SETTINGS, PRODUCTS as PRODUCTS,
                      Capture as Capture, CudaCapture as CudaCapture, Drone as Drone,
                      DroneState as DroneState, GeoFrame as GeoFrame, Lidar as Lidar, LidarScan as LidarScan, Plan as Plan,
                      Recording as Recording, Rig as Rig, Simulation as Simulation, Snapshot as Snapshot, Tensor as Tensor,
                      Threads as Threads, VectorEnvironment as VectorEnvironment, VideoWriter as VideoWriter, World as World,
                      drone_catalog as drone_catalog, gpus as gpus, plan_minimum_snap as plan_minimum_snap,
                      thread_count as thread_count, worlds as worlds)
from .dataset import Dataset as Dataset, Frame as Frame, Samples as Samples
from .pictures import read_exr as read_exr, read_png as read_png
from .viewer import Viewer as Viewer, show as show

__version__: str
__all__ = ["Capture", "CudaCapture", "Dataset", "Drone", "DroneState", "Frame", "GeoFrame", "Lidar", "LidarScan", "PARTS",
           "PICTURE_SETTINGS", "PRODUCTS", "Plan", "Recording", "Rig", "Samples", "Simulation", "Snapshot", "Tensor", "Threads", "VectorEnvironment",
           "VideoWriter", "Viewer", "World", "airsim", "data", "dataset", "drone_catalog", "gpus", "gym", "metrics", "pictures",
           "plan_minimum_snap", "read_exr", "read_png", "records", "show", "thread_count", "viewer", "worlds"]
