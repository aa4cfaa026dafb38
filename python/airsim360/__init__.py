"""AirSim360: a 360 degree simulator for drones.

A short tour (every line runs; docs/reference/python.md has more, examples/ has programs):

    import airsim360

    world = airsim360.World("box_room")                        # worlds() lists them; a model file or map does as well
    picture = world.capture([0, 0, 1.5], airsim360.Rig(width=512))
    picture.rgb.shape, picture.range[128, 256]                  # (256, 512, 3), metres to what is straight ahead

    sim = airsim360.Simulation(world, drones=1)                 # time passes in step(), run() and wait() alone
    sim.takeoff(height=1.5)
    sim.wait()                                                  # True: it is there
    sim.fly_to([2, 2, 2])
    sim.run(1.0)                                                # one second
    sim.state().position, sim.capture().entity, sim.events()

    plan = airsim360.plan_minimum_snap([[-3, -3, 2], [3, 3, 3]], vmax=3, world=world)
    sim.fly_trajectory(plan)

    frames = airsim360.Dataset("my_dataset")                    # what `airsim360 collect` wrote
    frames[0].points()                                          # (H, W, 3) metres in W

Names by purpose:

    worlds        World  worlds  gpus
    pictures      Rig  Capture  CudaCapture  Tensor  PARTS  PRODUCTS  PICTURE_SETTINGS  VideoWriter
    laser         Lidar  LidarScan
    drones        Drone  drone_catalog
    flight        Simulation  DroneState  Snapshot  Recording  GeoFrame
    planning      plan_minimum_snap  Plan
    datasets      Dataset  Frame  Samples  read_png  read_exr
    in a browser  show  Viewer
    on demand     data (Panoramas, Panorama: frames of a plan, drawn when asked for)
    scores        metrics (psnr, ws_psnr, ssim, flip, path_length, spl, ndtw)
    learning      gym (make, make_vec)  VectorEnvironment
    AirSim        airsim (MultirotorClient and the other names of AirSim's own client)
    types         records (what the dictionaries hold, key by key)
    threads       Threads  thread_count

Frames, the same everywhere but in `airsim360.airsim`, which is AirSim's north-east-down:

    W  world      +X east, +Y north, +Z up
    B  body       +X forward, +Y left, +Z up, origin at the centre of mass
    C  camera     +X right, +Y down, +Z forward; the middle of a panorama is +Z
    S  lidar      as B, at the lidar

Metres, seconds, radians, kilograms; a name with another unit says so (_deg, _ns, _ms). Poses are (4, 4) arrays X_AB with
p_A = X_AB p_B; quaternions w, x, y, z (Hamilton). yaw 0 faces east and grows counter-clockwise, pitch is positive nose up,
roll right side down: R_WB = Rz(yaw) Ry(-pitch) Rx(roll). `range` is the distance along a pixel's ray, 0 where nothing is
hit. Points, vectors and poses are float64; pictures are views of the memory of what gave them.

Errors: bad input is a ValueError that names the value and the nearest choice, what fails at run time a RuntimeError, a
missing compiled module an ImportError. Long calls release the GIL; the same seed gives the same bytes with any number of
threads.

Datasets, `read_png`, `read_exr` and `airsim` work without the compiled module; it is loaded when first needed.
"""
import importlib as _importlib
import sys as _sys

__version__ = "0.1.0"
__all__ = ["Capture", "CudaCapture", "Dataset", "Drone", "DroneState", "Frame", "GeoFrame", "Lidar", "LidarScan", "PARTS",
           "PICTURE_SETTINGS", "PRODUCTS", "Plan", "Recording", "Rig", "Samples", "Simulation", "Snapshot", "Tensor", "Threads", "VectorEnvironment",
           "VideoWriter", "Viewer", "World", "airsim", "data", "dataset", "drone_catalog", "gpus", "gym", "metrics", "pictures",
           "plan_minimum_snap", "read_exr", "read_png", "records", "show", "thread_count", "viewer", "worlds"]

_SUBMODULES = ("airsim", "data", "dataset", "gym", "metrics", "pictures", "records", "viewer")
# Names that need NumPy alone, by module.
_PURE = {"Dataset": "dataset", "Frame": "dataset", "Samples": "dataset", "read_exr": "pictures", "read_png": "pictures",
         "Viewer": "viewer", "show": "viewer"}


def _load_native() -> object:
    """The compiled module. ImportError says what is missing: the module, or something that it needs."""
    try:
        return _importlib.import_module(f"{__name__}._native")
    except ImportError as failure:
        import pathlib
        built = sorted(path.name for path in pathlib.Path(__file__).parent.glob("_native*.so"))
        why = (f"{built[0]} is there but this Python ({_sys.version.split()[0]}, {_sys.executable}) cannot load it: {failure}. "
               "It is for Debian's /usr/bin/python3 with python3-numpy" if built else
               "it is not built: run `make build` and set PYTHONPATH=build/python, or install the wheel (`make wheel`)")
        raise ImportError(f"airsim360's compiled module: {why}") from failure


def __getattr__(name: str) -> object:
    # The compiled module is loaded when first needed: datasets and the AirSim client work without it.
    if name == "_native":
        return _load_native()
    if name in _SUBMODULES:
        return _importlib.import_module(f"{__name__}.{name}")
    if name not in __all__:
        raise AttributeError(f"module 'airsim360' has no attribute '{name}'")
    module = _importlib.import_module(f"{__name__}.{_PURE[name]}") if name in _PURE else _load_native()
    value = getattr(module, name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
