"""AirSim360: a 360 degree simulator for drones.

    import airsim360
    sim = airsim360.Simulation(airsim360.World("box_room"), drones=1)
    sim.takeoff(height=1.5)
    sim.run(3)
    picture = sim.capture(airsim360.Rig(width=512))

W is east-north-up, B forward-left-up, C right-down-forward; metres, seconds, radians; quaternions w, x, y, z. Bad input
is a ValueError. `airsim360.airsim` is a client of AirSim-compatible servers, `airsim360.gym` reinforcement learning.
docs/python.md has every name.
"""
import importlib as _importlib

__version__ = "0.1.0"
__all__ = ["Capture", "CudaCapture", "Drone", "DroneState", "Lidar", "LidarScan", "PARTS", "Plan", "Recording", "Rig",
           "Simulation", "Snapshot", "Tensor", "Threads", "VectorEnvironment",
           "VideoWriter", "World", "airsim", "drone_catalog", "gpus", "gym", "metrics", "plan_minimum_snap",
           "thread_count", "worlds"]


def __getattr__(name):
    # The compiled module is loaded when first needed: the AirSim client works without it.
    if name in ("airsim", "gym", "_native"):
        return _importlib.import_module(f"{__name__}.{name}")
    if name not in __all__:
        raise AttributeError(f"module 'airsim360' has no attribute '{name}'")
    try:
        native = _importlib.import_module(f"{__name__}._native")
    except ModuleNotFoundError as missing:
        raise ImportError("airsim360's compiled module is not built: run `make build` and set PYTHONPATH=build/python, "
                          "or install the wheel (`make wheel`)") from missing
    value = getattr(native, name)
    globals()[name] = value
    return value


def __dir__():
    return sorted(__all__)
