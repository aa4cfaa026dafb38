# Types of the compiled module; shapes, units and frames are in the docstrings and docs/reference/python.md.
from typing import Any, Literal, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

Vector = Union[Sequence[float], npt.NDArray[np.float64]]
Points = Union[Sequence[Sequence[float]], npt.NDArray[np.float64]]
DroneRef = Union[int, str]
Yaw = Union[None, float, Literal["forward"]]
Tier = Literal["labels", "fast", "high", "reference"]
F64 = npt.NDArray[np.float64]
F32 = npt.NDArray[np.float32]

def worlds() -> list[dict[str, Any]]: ...
def gpus() -> list[dict[str, Any]]: ...
def drone_catalog() -> dict[str, str]: ...
def thread_count() -> int: ...
def plan_minimum_snap(waypoints: Points, times: Optional[Sequence[float]] = None, vmax: float = 4.0, amax: float = 4.0,
                      order: Literal[5, 7] = 7, world: Optional[World] = None, clearance: float = 0.5,
                      avoid: bool = False, limits: dict[str, Any] = ..., minimise: Literal["snap", "jerk"] = "snap",
                      start: Optional[Points] = None, end: Optional[Points] = None) -> Plan: ...

class Threads:
    def __init__(self, threads: int) -> None: ...
    def __enter__(self) -> None: ...
    def __exit__(self, *args: Any) -> None: ...

class Rig:
    width: int
    height: int
    def __init__(self, width: int = 1024, height: int = 0, tier: Tier = "fast",
                 products: Sequence[str] = ("rgb", "range", "semantic", "entity"),
                 projection: Literal["erp", "pinhole", "fisheye"] = "erp", fov: float = ..., position: Vector = (0, 0, 0),
                 yaw: float = 0.0, pitch: float = 0.0, roll: float = 0.0, level: bool = False,
                 lens: Literal["ideal", "real360"] = "ideal", tone: Literal["filmic", "agx", "linear"] = "filmic",
                 exposure_ev: float = 0.0, samples: int = 0, seed: int = 0, flow_dt: float = 0.1,
                 edge_samples: int | None = None) -> None: ...

class Tensor:
    shape: tuple[int, ...]
    def __dlpack__(self, *, stream: Optional[int] = None, max_version: Optional[tuple[int, int]] = None,
                   dl_device: Optional[tuple[int, int]] = None, copy: Optional[bool] = None) -> Any: ...
    def __dlpack_device__(self) -> tuple[int, int]: ...

PARTS: tuple[str, ...]

class Capture:
    # A picture that the rig was not asked for is a ValueError.
    products: list[str]
    rgb: npt.NDArray[np.uint8]  # (H, W, 3)
    range: F32  # (H, W) metres
    semantic: npt.NDArray[np.uint16]  # (H, W)
    entity: npt.NDArray[np.uint32]  # (H, W)
    normal: F32  # (H, W, 3)
    position: F32  # (H, W, 3)
    albedo: F32  # (H, W, 3)
    material: npt.NDArray[np.uint16]  # (H, W)
    part: npt.NDArray[np.uint8]  # (H, W)
    radiance: F32  # (H, W, 3)
    flow: F32  # (H, W, 2)
    pose: F64  # (4, 4) X_WC
    body_pose: F64  # (4, 4) X_WB
    q_wxyz: F64  # (4,)
    p: F64  # (3,)
    t_ns: int
    render_ms: float
    rays: int
    def tensor(self, product: str) -> Tensor: ...

class CudaCapture(Capture): ...

class VideoWriter:
    encoder: str
    def __init__(self, path: str, width: int = 0, height: int = 0, fps: float = 30.0, spherical: bool = True,
                 encoder: Literal["auto", "libx264", "libx265", "h264_nvenc", "hevc_nvenc", "h264_vaapi", "hevc_vaapi"] = "auto",
                 quality: int = 18) -> None: ...
    def add(self, picture: Union[Capture, npt.NDArray[np.uint8]], t: Optional[float] = None) -> None: ...
    def close(self) -> None: ...
    def __enter__(self) -> VideoWriter: ...
    def __exit__(self, *args: Any) -> None: ...
    def __len__(self) -> int: ...

class Lidar:
    channels: int
    columns: int
    def __init__(self, channels: int = 16, columns: int = 625, low: float = ..., high: float = ..., start: float = ...,
                 sweep: float = ..., pattern: Literal["spinning", "rosette"] = "spinning", field: float = ...,
                 rate: float = 10.0, min_range: float = 0.3, max_range: float = 100.0, sigma: float = 0.02,
                 dropout: float = 0.0, through_panes: bool = False, motion_distortion: bool = False,
                 position: Vector = (0, 0, 0), yaw: float = 0.0, pitch: float = 0.0, roll: float = 0.0) -> None: ...

class LidarScan:
    points: F32  # (N, 3) metres in S
    range: F32  # (N,)
    intensity: F32  # (N,)
    time: F32  # (N,) seconds
    semantic: npt.NDArray[np.uint16]  # (N,)
    entity: npt.NDArray[np.uint32]  # (N,)
    shot: npt.NDArray[np.uint32]  # (N,)
    pose: F64  # (4, 4) X_WS
    shots: int
    t_ns: int
    def __len__(self) -> int: ...

class World:
    name: str
    entities: list[dict[str, Any]]
    categories: dict[int, str]
    bounds: F64  # (2, 3)
    spawn: F64  # (3,)
    triangles: int
    device: str
    def __init__(self, name: str, seed: int = 0, models: bool = True, *, labels: str = "", device: str = "auto",
                 gpu: int = -1) -> None: ...
    def relabel(self, labels: dict[str, str]) -> int: ...
    def raycast(self, origins: Points, directions: Points) -> tuple[F32, npt.NDArray[np.uint32]]: ...
    def clearance(self, points: Points, most: float = 100.0) -> F32: ...
    def export(self, path: str) -> None: ...
    def capture(self, position: Vector, rig: Rig = ..., yaw: float = 0.0, pitch: float = 0.0, roll: float = 0.0) -> Capture: ...
    def scan(self, position: Vector, lidar: Lidar = ..., yaw: float = 0.0, pitch: float = 0.0, roll: float = 0.0) -> LidarScan: ...

class Drone:
    model: str
    name: str
    mass: float
    inertia: F64  # (3, 3)
    rotors: list[dict[str, Any]]
    max_thrust: float
    hover_speed: float
    half_size: F64  # (3,)
    laws: dict[str, str]
    yaml: str
    def __init__(self, model: str = "hummingbird", name: str = "", position: Optional[Vector] = None, yaw: float = 0.0,
                 airborne: bool = False, controller: Literal["simple_flight", "px4", "se3", "indi"] = "indi",
                 sensors: str = "") -> None: ...
    @staticmethod
    def from_words(words: str) -> Drone: ...

class Plan:
    times: F64  # (S + 1,)
    waypoints: F64  # (S + 1, 3)
    coefficients: F64  # (S, 3, order + 1)
    order: int
    duration: float
    cost_snap: float
    max_speed: float
    max_acceleration: float
    certificate: Optional[dict[str, Any]]
    def at(self, times: Sequence[float]) -> dict[str, F64]: ...
    def sample(self, dt: float = 0.1) -> dict[str, F64]: ...

class DroneState:
    t: float
    t_ns: int
    position: F64  # (3,)
    velocity: F64  # (3,)
    angular_velocity: F64  # (3,)
    acceleration: F64  # (3,)
    orientation: F64  # (4,) w, x, y, z
    euler: F64  # (3,) roll, pitch, yaw
    pose: F64  # (4, 4)
    rotor_speeds: F64
    charge: float
    clearance: float
    mode: str
    touching: bool
    collision: Optional[dict[str, Any]]
    sensors: dict[str, dict[str, Any]]

class GeoFrame:
    origin: F64  # (3,) latitude_deg, longitude_deg, altitude
    def __init__(self, latitude_deg: float, longitude_deg: float, altitude: float = 0.0) -> None: ...
    def to_world(self, places: Union[Vector, Points]) -> F64: ...  # (3,) or (N, 3)
    def to_geodetic(self, points: Union[Vector, Points]) -> F64: ...  # (3,) or (N, 3)

class Snapshot:
    t: float
    step: int
    hash: int
    def state(self, drone: int = 0) -> DroneState: ...

class Recording:
    note: str
    steps: int
    def write(self, path: str) -> None: ...
    @staticmethod
    def read(path: str) -> Recording: ...

class Simulation:
    t: float
    t_ns: int
    dt: float
    world: World
    drones: list[str]
    entities: list[dict[str, Any]]
    people: list[dict[str, Any]]
    def __init__(self, world: World, drones: Union[int, str, Drone, Sequence[Union[str, Drone]]] = 1, people: int = 0,
                 seed: int = 0, dt: float = 0.001, wind: Vector = (0, 0, 0)) -> None: ...
    geo_frame: GeoFrame
    def step(self, n: int = 1) -> None: ...
    def wait(self, drone: DroneRef = 0, timeout: float = 60.0) -> bool: ...
    def run(self, seconds: float) -> None: ...
    def state(self, drone: DroneRef = 0) -> DroneState: ...
    def capture(self, rig: Rig = ..., drone: DroneRef = 0, memory: Literal["cpu", "cuda"] = "cpu") -> Capture: ...
    def scan(self, lidar: Union[Lidar, str] = ..., drone: DroneRef = 0) -> LidarScan: ...
    def snapshot(self) -> Snapshot: ...
    def restore(self, snapshot: Snapshot) -> None: ...
    def start_recording(self, note: str = "") -> None: ...
    def stop_recording(self) -> Recording: ...
    def replay(self, recording: Recording, start: Snapshot) -> dict[str, Any]: ...
    def hash(self) -> int: ...
    def events(self) -> list[dict[str, Any]]: ...
    def arm(self, drone: DroneRef = 0) -> None: ...
    def disarm(self, drone: DroneRef = 0) -> None: ...
    def takeoff(self, height: float = 2.0, speed: float = 1.0, drone: DroneRef = 0) -> None: ...
    def land(self, speed: float = 0.7, drone: DroneRef = 0) -> None: ...
    def hover(self, yaw: Yaw = None, yaw_rate: Optional[float] = None, drone: DroneRef = 0) -> None: ...
    def return_home(self, height: float = 5.0, speed: float = 0.0, land: bool = True, drone: DroneRef = 0) -> None: ...
    def fly_velocity(self, velocity: Vector, body_heading: bool = False, altitude: Optional[float] = None, yaw: Yaw = None,
                     yaw_rate: Optional[float] = None, drone: DroneRef = 0, timeout: float = 0.0) -> None: ...
    def fly_to(self, position: Vector, speed: float = 0.0, yaw: Yaw = None, yaw_rate: Optional[float] = None,
               drone: DroneRef = 0, timeout: float = 0.0) -> None: ...
    def fly_path(self, waypoints: Points, speed: float = 0.0, lookahead: float = 0.0, yaw: Yaw = None,
                 yaw_rate: Optional[float] = None, drone: DroneRef = 0, timeout: float = 0.0) -> None: ...
    def fly_trajectory(self, plan: Plan, yaw: Optional[float] = None, drone: DroneRef = 0) -> None: ...
    def set_attitude(self, roll: float, pitch: float, throttle: Optional[float] = None, altitude: Optional[float] = None,
                     yaw: Yaw = None, yaw_rate: Optional[float] = None, drone: DroneRef = 0, timeout: float = 0.0) -> None: ...
    def set_rates(self, rates: Vector, throttle: Optional[float] = None, altitude: Optional[float] = None,
                  drone: DroneRef = 0, timeout: float = 0.0) -> None: ...
    def set_rotor_speeds(self, speeds: Sequence[float], drone: DroneRef = 0, timeout: float = 0.0) -> None: ...
    def set_rotor_signals(self, signals: Sequence[float], drone: DroneRef = 0, timeout: float = 0.0) -> None: ...
    def set_rotor_health(self, health: Sequence[float], drone: DroneRef = 0) -> None: ...
    def set_wind(self, wind: Vector) -> None: ...
    def reset_drone(self, position: Optional[Vector] = None, yaw: float = 0.0, airborne: Optional[bool] = None,
                    drone: DroneRef = 0) -> None: ...

class VectorEnvironment:
    TASK_OPTIONS: tuple[str, ...]
    count: int
    action_size: int
    width: int
    height: int
    rgb: Optional[npt.NDArray[np.uint8]]  # (count, H, W, 3)
    range: Optional[F32]  # (count, H, W)
    semantic: Optional[npt.NDArray[np.uint16]]
    entity: Optional[npt.NDArray[np.uint32]]
    state: F32  # (count, 17)
    reward: F32  # (count,)
    distance: F32
    steps: npt.NDArray[np.int64]
    terminated: npt.NDArray[np.bool_]
    truncated: npt.NDArray[np.bool_]
    reached: npt.NDArray[np.bool_]
    crashed: npt.NDArray[np.bool_]
    def __init__(self, world: World, task: Literal["reach", "avoid", "search"] = "reach", task_options: dict[str, Any] = ...,
                 count: int = 1, drone: Union[str, Drone] = "hummingbird",
                 action: Literal["velocity", "rates", "rotors"] = "velocity", width: int = 128, height: int = 0,
                 tier: Tier = "fast", observations: Sequence[str] = ("rgb", "range"), period: float = 0.1,
                 max_speed: float = 3.0, max_turn: float = 1.5, max_rate: float = 6.0, level: bool = False,
                 auto_reset: bool = True, seed: int = 0) -> None: ...
    def reset(self, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None) -> None: ...
    def step(self, actions: Any) -> None: ...
    def pose_of(self, environment: int) -> F64: ...
    def goal_of(self, environment: int) -> F64: ...
    def hash(self) -> int: ...

class metrics:
    """The submodule airsim360.metrics."""
    @staticmethod
    def psnr(a: npt.NDArray[np.uint8], b: npt.NDArray[np.uint8]) -> float: ...
    @staticmethod
    def ws_psnr(a: npt.NDArray[np.uint8], b: npt.NDArray[np.uint8]) -> float: ...
    @staticmethod
    def ssim(a: npt.NDArray[np.uint8], b: npt.NDArray[np.uint8]) -> float: ...
    @staticmethod
    def flip(reference: npt.NDArray[np.uint8], test: npt.NDArray[np.uint8], pixels_per_degree: float = ...,
             wrap: bool = False) -> F32: ...
    @staticmethod
    def path_length(path: Points) -> float: ...
    @staticmethod
    def spl(success: bool, shortest: float, flown: float) -> float: ...
    @staticmethod
    def ndtw(path: Points, reference: Points, threshold: float) -> float: ...
