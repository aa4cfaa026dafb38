"""AirSim360: a 360 degree simulator for drones.

    import airsim360
    sim = airsim360.Simulation(airsim360.World("box_room"), drones=1)
    sim.takeoff(height=1.5)
    sim.wait()
    picture = sim.capture(airsim360.Rig(width=512))
    frames = airsim360.Dataset("my_dataset")                # what `airsim360 collect` wrote

W is east-north-up, B forward-left-up, C right-down-forward; metres, seconds, radians; quaternions w, x, y, z. Bad input
is a ValueError. `airsim360.airsim` is a client of AirSim-compatible servers, `airsim360.gym` reinforcement learning.
docs/reference/python.md has every name.
"""
import importlib as _importlib
import pathlib as _pathlib
import sys as _sys

__version__ = "0.1.0"
__all__ = ["Capture", "CudaCapture", "Dataset", "Drone", "DroneState", "Frame", "GeoFrame", "Lidar", "LidarScan", "PARTS",
           "Plan", "Recording", "Rig", "Samples", "Simulation", "Snapshot", "Tensor", "Threads", "VectorEnvironment",
           "VideoWriter", "World", "airsim", "dataset", "drone_catalog", "gpus", "gym", "metrics", "pictures",
           "plan_minimum_snap", "read_exr", "read_png", "thread_count", "worlds"]

# Names that need NumPy alone, by module.
_PURE = {"Dataset": "dataset", "Frame": "dataset", "Samples": "dataset", "read_exr": "pictures", "read_png": "pictures"}


def _load_native():
    """The compiled module. ImportError says what is missing: the module, or something that it needs."""
    try:
        return _importlib.import_module(f"{__name__}._native")
    except ImportError as failure:
        built = sorted(path.name for path in _pathlib.Path(__file__).parent.glob("_native*.so"))
        why = (f"{built[0]} is there but this Python ({_sys.version.split()[0]}, {_sys.executable}) cannot load it: {failure}. "
               "It is for Debian's /usr/bin/python3 with python3-numpy" if built else
               "it is not built: run `make build` and set PYTHONPATH=build/python, or install the wheel (`make wheel`)")
        raise ImportError(f"airsim360's compiled module: {why}") from failure


def __getattr__(name):
    # The compiled module is loaded when first needed: datasets and the AirSim client work without it.
    if name == "_native":
        return _load_native()
    if name in ("airsim", "dataset", "gym", "pictures"):
        return _importlib.import_module(f"{__name__}.{name}")
    if name not in __all__:
        raise AttributeError(f"module 'airsim360' has no attribute '{name}'")
    module = _importlib.import_module(f"{__name__}.{_PURE[name]}") if name in _PURE else _load_native()
    value = getattr(module, name)
    globals()[name] = value
    return value


def __dir__():
    return sorted(__all__)
