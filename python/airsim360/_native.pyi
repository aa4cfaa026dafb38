# Types of the compiled module (python/src); tests/python/stubs_test.py compares names, parameters and defaults.
# Metres, seconds, radians; W east-north-up, B forward-left-up, C right-down-forward; poses (4, 4) X_AB: p_A = X_AB p_B.
from typing import Any, Literal, Sequence, overload

import numpy as np
import numpy.typing as npt

from . import metrics as metrics
from .records import (Certificate, Collision, Entity, Event, Gpu, Limits, Mission, Person, Replay, ResetOptions, Rotor, TaskOptions,
                      TrafficVehicle, TrajectorySamples, WorldInfo)

_F64 = npt.NDArray[np.float64]
_F32 = npt.NDArray[np.float32]
_U8 = npt.NDArray[np.uint8]
_U16 = npt.NDArray[np.uint16]
_U32 = npt.NDArray[np.uint32]
_I64 = npt.NDArray[np.int64]
_Flags = npt.NDArray[np.bool_]
_Numbers = Sequence[float] | npt.NDArray[Any]
_Vector = _Numbers  # (3,)
_Points = Sequence[_Numbers] | npt.NDArray[Any]  # (N, 3)
_DroneRef = int | str  # number from 0, or name
_Yaw = float | Literal["forward"] | None
_Tier = Literal["labels", "fast", "high", "reference"]
_Product = Literal["rgb", "range", "semantic", "entity", "normal", "position", "albedo", "material", "part",
                   "sky", "flow", "coverage", "radiance"]

PRODUCTS: tuple[str, ...]
"""Pictures that a capture can hold, as Rig(products=…) names them."""
PICTURE_SETTINGS: tuple[str, ...]
"""How pictures are made: keywords of Rig and of environments, keys of meta.json, and, with dashes, flags of commands."""
PARTS: tuple[str, ...]
"""What the numbers of Capture.part mean: PARTS[1] is "window". PARTS[0] is "", the body itself."""

def worlds() -> list[WorldInfo]:
    """The built-in worlds: dictionaries with name, setting, area_m2, categories, description."""

def gpus() -> list[Gpu]:
    """GPUs of this machine: dictionaries with index, name, driver, software, missing (what it lacks to render), uuid."""

def drone_catalog() -> dict[str, str]:
    """Real drones that are known: name -> what it is."""

def thread_count() -> int:
    """Number of threads that parallel loops use now."""

def plan_minimum_snap(waypoints: _Points, times: Sequence[float] | None = None, vmax: float = 4.0, amax: float = 4.0,
                      order: Literal[5, 7] = 7, world: World | None = None, clearance: float = 0.5, avoid: bool = False,
                      limits: Limits = {}, minimise: Literal["snap", "jerk"] = "snap", start: _Points | None = None,
                      end: _Points | None = None) -> Plan:
    """The smoothest flight through waypoints (N, 3) of W, at rest at both ends.

    times: (N,) seconds; None: the fastest that were found within vmax (m/s) and amax (m/s^2). order: 7 (minimum snap) or
    5 (the paper's quintic; with minimise="jerk" least jerk). world: the flight is checked against its surfaces with
    `clearance` metres; avoid: it is led around them. limits: more of them, axis_vmax and axis_amax (3,), climb, descent
    (m/s), thrust (m/s^2, of a drone: |a + g|), body_rate (rad/s, roll and pitch). start, end: (1 to 3, 3), velocity,
    acceleration and jerk there. ValueError for what cannot be planned.
    """

class Threads:
    """Limits every parallel loop of the process to `threads` (0 = all cores) in a with block."""

    def __init__(self, threads: int) -> None:
        """ValueError for a negative number."""
    def __enter__(self) -> None: ...
    def __exit__(self, *args: object) -> None: ...

class Rig:
    """A camera on a drone, panoramic unless told otherwise, and what it captures."""

    def __init__(self, width: int = 1024, height: int = 0, *, tier: _Tier = "fast", samples: int | None = None,
                 denoise: bool = True, edge_samples: int | None = None,
                 tone: Literal["filmic", "agx", "linear"] = "filmic", exposure: float | Literal["auto"] = 0.0,
                 pano_frame: Literal["body", "level"] = "body", lens: Literal["ideal", "real360"] = "ideal",
                 look: Literal["clean", "photo"] = "clean", camera_look: dict[str, float | bool] = {},
                 products: Sequence[_Product] | None = None,
                 projection: Literal["erp", "pinhole", "fisheye"] = "erp", fov: float = 1.5707963267948966,
                 position: _Vector = (0.0, 0.0, 0.0), yaw: float = 0.0, pitch: float = 0.0, roll: float = 0.0,
                 level: bool = False, seed: int = 0, flow_dt: float = 0.1) -> None:
        """width, height: pixels (height 0: half the width for panoramas, else the width). tier: labels (no colour), fast,
        high or reference. samples: light samples of a pixel in the
        tiers high and reference, None = the tier's own. denoise: noise filter of tier high. edge_samples: colour samples
        of a pixel on an edge, 1 to 64; 1 is the fastest (None: 2 in tier fast, 8 in high). tone: tone curve. exposure:
        stops added to the fixed daylight exposure, or "auto". pano_frame: "level" keeps the horizon level. lens: real360
        distorts and fades as a real camera of two fisheyes. look: photo is what a consumer camera makes of the light, by camera_look (metering, glare, … : docs/guide/pictures.md). products: pictures that are made, None: rgb (but in tier labels), range, semantic, entity. projection: erp, pinhole or fisheye (fov:
        radians, across the width or the shorter side). position (3,) metres, yaw, pitch, roll radians: the mount in B.
        level: the same as pano_frame="level". seed: of samples and noise. flow_dt: seconds that optical flow leads on by,
        above 0, at most 10. ValueError names the nearest choice."""
    @property
    def width(self) -> int:
        """Pixels."""
    @property
    def height(self) -> int:
        """Pixels."""

class Tensor:
    """A picture as DLPack exports it: pass it to torch, jax, cupy or numpy's from_dlpack.

    Nothing is copied; the memory stays alive for as long as any consumer has it. copy=True, or dl_device=(1, 0) of a
    picture on a GPU, gives a copy.
    """

    @property
    def shape(self) -> tuple[int, ...]:
        """(H, W) or (H, W, channels)."""
    def __dlpack__(self, *, stream: int | None = None, max_version: tuple[int, int] | None = None,
                   dl_device: tuple[int, int] | None = None, copy: bool | None = None) -> Any:
        """DLPack's capsule; BufferError for a device that it cannot go to."""
    def __dlpack_device__(self) -> tuple[int, int]:
        """(1, 0) in memory of the CPU, (2, number) of a CUDA device."""

class Capture:
    """What one trigger gave: all pictures from the same rays at one instant.

    Pictures are views of this object's memory (no copies); one that the rig was not asked for is a ValueError. H rows
    from top to bottom, W columns from left to right; the middle of a panorama looks along +Z of C.
    """

    @property
    def products(self) -> list[str]:
        """Names of the pictures that are there."""
    @property
    def rgb(self) -> _U8:
        """(H, W, 3) uint8, sRGB."""
    @property
    def range(self) -> _F32:
        """(H, W) float32, metres along the ray, 0 = nothing hit (sky)."""
    @property
    def semantic(self) -> _U16:
        """(H, W) uint16, category id (World.categories)."""
    @property
    def entity(self) -> _U32:
        """(H, W) uint32, entity id (World.entities)."""
    @property
    def normal(self) -> _F32:
        """(H, W, 3) float32, unit normal in W towards the camera."""
    @property
    def position(self) -> _F32:
        """(H, W, 3) float32, point hit, metres in W."""
    @property
    def albedo(self) -> _F32:
        """(H, W, 3) float32, linear base colour."""
    @property
    def material(self) -> _U16:
        """(H, W) uint16, material index plus 1."""
    @property
    def part(self) -> _U8:
        """(H, W) uint8, which part of the pixel's entity (airsim360.PARTS); 0 = its body, or nothing hit."""
    @property
    def sky(self) -> _U8:
        """(H, W) uint8, 255 = the ray through the pixel centre meets the sky, else 0."""
    @property
    def coverage(self) -> npt.NDArray[np.void]:
        """(H, W) records of entity (4,) uint32 and share (4,) float32: the entities in a pixel by the share of its area,
        largest first; entity 0 = no more."""
    @property
    def radiance(self) -> _F32:
        """(H, W, 3) float32, linear light."""
    @property
    def flow(self) -> _F32:
        """(H, W, 2) float32, pixels to where the point is flow_dt later if commands stay; x wraps."""
    @property
    def pose(self) -> _F64:
        """(4, 4) X_WC: p_W = X_WC p_C, C with +X right, +Y down, +Z forward."""
    @property
    def look(self) -> dict[str, float] | None:
        """What the camera of look photo chose: exposure_ev, white_cd_m2, gain, red, green, blue, contrast, sun_seen; None
        for look clean."""
    @property
    def developed(self) -> dict[str, float] | None:
        """The exposure of rgb: factor (radiance times it is what the tone curve was given), stops (its logarithm to base
        2); None without rgb."""
    @property
    def body_pose(self) -> _F64:
        """(4, 4) X_WB."""
    @property
    def q_wxyz(self) -> _F64:
        """(4,) rotation of the camera in W as w, x, y, z."""
    @property
    def p(self) -> _F64:
        """(3,) place of the camera in W, metres."""
    @property
    def t_ns(self) -> int:
        """Time of the trigger, nanoseconds."""
    @property
    def render_ms(self) -> float:
        """Milliseconds of rays and shading alone."""
    @property
    def rays(self) -> int:
        """Rays that were cast."""
    def tensor(self, product: _Product) -> Tensor:
        """A picture for from_dlpack of torch, jax, cupy or numpy, without a copy."""

class CudaCapture(Capture):
    """A capture whose pictures stay in memory of the GPU.

    rgb, range and so on are ValueErrors; tensor("rgb") is a tensor of CUDA for from_dlpack of torch, jax or cupy.
    """

    def tensor(self, product: _Product) -> Tensor:
        """A picture for from_dlpack of torch, jax or cupy, without a copy."""

class VideoWriter:
    """A 360 degree video (MP4) that players show as a sphere; needs the program ffmpeg.

        with airsim360.VideoWriter("flight.mp4", fps=30) as video:
            for _ in range(90):
                sim.run(1 / 30)
                video.add(sim.capture(rig))

    The file appears when the block ends; after an exception there is none.
    """

    def __init__(self, path: str, width: int = 0, height: int = 0, fps: float = 30.0, spherical: bool = True,
                 encoder: Literal["auto", "libx264", "libx265", "h264_nvenc", "hevc_nvenc", "h264_vaapi", "hevc_vaapi"] = "auto",
                 quality: int = 18) -> None:
        """width, height: pixels, 0 = of the first picture. fps: pictures a second. spherical: say that
        the picture is a whole panorama. encoder: libx264 gives the same bytes everywhere. quality: 0 (best) ... 51. ValueError for wrong options,
        RuntimeError where ffmpeg fails."""
    @property
    def encoder(self) -> str:
        """The one that was taken, once there is a picture."""
    def add(self, picture: Capture | _U8, t: float | None = None) -> None:
        """A Capture (shown from its t_ns on if that is later than the last picture) or (H, W, 3) uint8; else 1 / fps
        after the last. t: seconds instead."""
    def close(self) -> None:
        """Waits for ffmpeg and puts the video at its path."""
    def __enter__(self) -> VideoWriter: ...
    def __exit__(self, type: object, value: object, traceback: object, /) -> None: ...
    def __len__(self) -> int: ...

class Lidar:
    """A lidar on a drone. The default is AirSim's lidar."""

    def __init__(self, channels: int = 16, columns: int = 625, low: float = -0.7853981633974483,
                 high: float = -0.2617993877991494, start: float = 3.141592653589793, sweep: float = 6.283185307179586,
                 pattern: Literal["spinning", "rosette"] = "spinning", field: float = 1.2217304763960306,
                 rate: float = 10.0, min_range: float = 0.3, max_range: float = 100.0, sigma: float = 0.02,
                 dropout: float = 0.0, through_panes: bool = False, motion_distortion: bool = False,
                 position: _Vector = (0.0, 0.0, 0.0), yaw: float = 0.0, pitch: float = 0.0, roll: float = 0.0) -> None:
        """channels: beams above each other from elevation `low` to `high`; columns: shots of each in one turn, from
        azimuth `start` (to the left of forward) over `sweep`, clockwise seen from above. pattern: spinning, or rosette
        (channels * columns shots in a cone of full opening `field`). rate: turns a second. min_range, max_range, sigma
        (noise): metres. dropout: share of points lost. through_panes: clear glass is not seen. motion_distortion: each
        shot leaves at its own time. position (3,) metres, yaw, pitch, roll: the mount in B. Radians. ValueError names
        what is out of range."""
    @property
    def channels(self) -> int:
        """Beams above each other."""
    @property
    def columns(self) -> int:
        """Shots of each beam in one turn."""

class LidarScan:
    """One turn of a lidar, which ends at t_ns: points in the order of their shots, without those that met nothing.

    S: +X forward, +Y left, +Z up. Arrays are views of this object's memory (no copies).
    """

    @property
    def points(self) -> _F32:
        """(N, 3) float32, metres in S at the time of the scan, with noise."""
    @property
    def range(self) -> _F32:
        """(N,) float32, metres along the shot."""
    @property
    def intensity(self) -> _F32:
        """(N,) float32, 0 … 1: reflectance times the cosine of the angle of incidence."""
    @property
    def time(self) -> _F32:
        """(N,) float32, seconds before the scan's time (<= 0)."""
    @property
    def semantic(self) -> _U16:
        """(N,) uint16, category id."""
    @property
    def entity(self) -> _U32:
        """(N,) uint32, entity id."""
    @property
    def shot(self) -> _U32:
        """(N,) uint32, column * channels + channel."""
    @property
    def pose(self) -> _F64:
        """(4, 4) X_WS: p_W = X_WS p_S."""
    @property
    def shots(self) -> int:
        """Shots of the turn, those that met nothing too."""
    @property
    def t_ns(self) -> int:
        """Time of the scan, nanoseconds."""
    def __len__(self) -> int: ...

class World:
    """A world by name, or a path to .glb, .gltf, .obj, .osm, CityJSON or world .yaml."""

    def __init__(self, name: str, seed: int = 0, models: bool = True, *, labels: str = "",
                 device: Literal["auto", "cpu", "vulkan"] = "auto", gpu: int = -1, weather: str = "", sun: str = "",
                 time: str = "", place: str = "", hdri: str = "", environment: str = "", clouds: str = "", sky_seed: str = "",
                 bbox: str = "", centre: str = "", radius: float = 0.0, people: int | str = 0, wind: str = "", traffic: int = 0) -> None:
        """name: one of worlds(), or a path. seed: of what is made at random. models: furniture from model files where they
        are installed. labels: a label file, categories by patterns of names (docs/guide/labels.md).

        device: what draws the pictures of it and of simulations in it: "auto" (a GPU where there is one), "cpu", or
        "vulkan" (RuntimeError says why where there is none). gpu: number of one among several, as gpus() lists them.

        The light instead of the world's own, as the flags of those names of `airsim360 render`: weather: a preset. sun:
        "AZ,EL", compass and elevation in degrees. time: "YYYY-MM-DDTHH:MM[+ZZ:ZZ]" with place: "LAT,LON" in degrees. hdri:
        a sky picture (.hdr, .exr). environment: single values, "cloud_cover=0.6,visibility_m=800". clouds: a preset of the
        clouds alone. sky_seed: draws other clouds of the same kind, "1" ... "4294967295".

        A piece of a map: bbox: "SOUTH,WEST,NORTH,EAST" in degrees, or centre: "LAT,LON" with radius: 10 ... 30000 metres to
        each side.

        people: a number, 0 ... 10000, or the path of a people .yaml; they live in simulations of it, and captures of the
        world show them where they begin. wind: a wind file, for simulations (docs/guide/flying.md). traffic: how many
        vehicles drive on its roads, 0 ... 20000, likewise (docs/guide/traffic.md).

        ValueError names the nearest choice, for instance the nearest world where there is none of that name."""
    @property
    def name(self) -> str:
        """Name or path that it was opened by."""
    @property
    def device(self) -> str:
        """What draws its pictures: cpu or vulkan."""
    @property
    def entities(self) -> list[Entity]:
        """Entities by id (ids begin at 1)."""
    @property
    def categories(self) -> dict[int, str]:
        """Category id -> path."""
    @property
    def bounds(self) -> _F64:
        """(2, 3) least and greatest corner in W, metres."""
    @property
    def spawn(self) -> _F64:
        """(3,) a good first viewpoint in W, metres."""
    @property
    def triangles(self) -> int:
        """Triangles, those of every copy of a mesh counted."""
    def relabel(self, labels: dict[str, str]) -> int:
        """Categories by patterns of entity names ({'node/22*': 'furniture/misc'}; * any characters, ? one; the first
        that matches counts; paths that the tree lacks are added), from the next capture or scan on, in this world and
        its simulations. Returns how many entities match; a pattern that matches none gives a UserWarning."""
    def raycast(self, origins: _Points | _Vector, directions: _Points | _Vector) -> tuple[_F32, _U32]:
        """Nearest surfaces along rays: origins and directions in W, (3,) or (N, 3), one for all or one each -> range (N,)
        float32 metres (0 = nothing), entity (N,) uint32; arrays of no dimension for one ray."""
    def clearance(self, points: _Points | _Vector, most: float = 100.0) -> _F32:
        """Distance (N,) float32 from points (N, 3) of W to the nearest surface, at most `most` metres; of no dimension for (3,)."""
    def export(self, path: str) -> None:
        """Writes the world as binary glTF (.glb); ValueError for a path of another ending."""
    def capture(self, position: _Vector, rig: Rig = ..., yaw: float = 0.0, pitch: float = 0.0, roll: float = 0.0) -> Capture:
        """A capture by a body that stands still at `position` (3,) of W. Radians; yaw 0 faces east and grows
        counter-clockwise, pitch is positive nose up, roll right side down."""
    def scan(self, position: _Vector, lidar: Lidar = ..., yaw: float = 0.0, pitch: float = 0.0, roll: float = 0.0) -> LidarScan:
        """LidarScan of one turn by a body that stands still, as capture."""

class Drone:
    """A kind of drone and where it starts."""

    def __init__(self, model: str = "hummingbird", name: str = "", position: _Vector | None = None, yaw: float = 0.0,
                 airborne: bool = False, controller: Literal["simple_flight", "px4", "se3", "indi"] = "indi",
                 sensors: str = "") -> None:
        """model: a name of drone_catalog(), a .yaml file, or words ("a 250 g five-inch racing quad"). name: ""
        = drone0, drone1 and so on. position (3,) metres of W: where it hovers (airborne) or above where it stands; None: the world's spawn. yaw:
        radians. controller: who flies it. sensors: a sensor file (docs/reference/sensors.md). ValueError names what was not
        understood."""
    @staticmethod
    def from_words(words: str) -> Drone:
        """A drone from a description; every figure has its reason in `laws`."""
    @property
    def model(self) -> str:
        """Name of its kind."""
    @property
    def name(self) -> str:
        """What it is called in a simulation; "" = by its number."""
    @property
    def mass(self) -> float:
        """kg"""
    @property
    def inertia(self) -> _F64:
        """(3, 3) kg m^2 about the centre of mass, in B."""
    @property
    def rotors(self) -> list[Rotor]:
        """The rotors, in the order of rotor commands."""
    @property
    def max_thrust(self) -> float:
        """N, all rotors"""
    @property
    def hover_speed(self) -> float:
        """rad/s of a rotor, all alike, that carry the weight."""
    @property
    def half_size(self) -> _F64:
        """(3,) metres: half of length, width and height, in B."""
    @property
    def laws(self) -> dict[str, str]:
        """Parameter -> where its figure comes from."""
    @property
    def yaml(self) -> str:
        """The drone as a file that Drone(path) reads."""

class Plan:
    """A minimum-snap trajectory in W: metres, seconds."""

    @property
    def times(self) -> _F64:
        """(segments + 1,) seconds at which the waypoints are passed."""
    @property
    def waypoints(self) -> _F64:
        """(segments + 1, 3) metres in W."""
    @property
    def coefficients(self) -> _F64:
        """(segments, 3, order + 1): ascending powers of the segment's local time. A view, do not write."""
    @property
    def order(self) -> int:
        """Degree of the polynomials."""
    @property
    def duration(self) -> float:
        """Seconds."""
    @property
    def cost_snap(self) -> float:
        """Integral of squared snap over all axes, m^2/s^7."""
    @property
    def max_speed(self) -> float:
        """m/s, certified upper bound"""
    @property
    def max_acceleration(self) -> float:
        """m/s^2, certified upper bound"""
    @property
    def certificate(self) -> Certificate | None:
        """With a world: whether the clearance is proved everywhere; else None."""
    def at(self, times: float | Sequence[float] | npt.NDArray[Any]) -> TrajectorySamples:
        """t (N,), p, v, a, jerk, snap (N, 3) at given times, clamped to the flight; for one time a number and (3,)."""
    def sample(self, dt: float = 0.1) -> TrajectorySamples:
        """As at(), every dt seconds and at the end."""

class DroneState:
    """One drone at one instant: a look at an immutable snapshot. W, metres, seconds, radians."""

    @property
    def t(self) -> float:
        """Simulated time, seconds."""
    @property
    def t_ns(self) -> int:
        """Simulated time, nanoseconds."""
    @property
    def position(self) -> _F64:
        """(3,) p_WB, metres"""
    @property
    def velocity(self) -> _F64:
        """(3,) v_WB in W, m/s"""
    @property
    def angular_velocity(self) -> _F64:
        """(3,) rad/s in B"""
    @property
    def acceleration(self) -> _F64:
        """(3,) m/s^2 in W, mean over the last step"""
    @property
    def orientation(self) -> _F64:
        """(4,) q_WB as w, x, y, z"""
    @property
    def euler(self) -> _F64:
        """(3,) roll, pitch, yaw: R_WB = Rz(yaw) Ry(-pitch) Rx(roll)"""
    @property
    def pose(self) -> _F64:
        """(4, 4) X_WB"""
    @property
    def rotor_speeds(self) -> _F64:
        """(rotors,) rad/s"""
    @property
    def charge(self) -> float:
        """of the battery, 0 … 1"""
    @property
    def clearance(self) -> float:
        """metres to the nearest surface, at most 2; renewed every 10 ms"""
    @property
    def mode(self) -> str:
        """What the autopilot does, in words: "hold", "takeoff", "commanded (done)" and so on."""
    @property
    def touching(self) -> bool:
        """Whether it is in contact with a surface."""
    @property
    def collision(self) -> Collision | None:
        """The last contact; None if there was none."""
    @property
    def sensors(self) -> dict[str, Any]:
        """Sensor name -> its last reading: records.ImuReading, GnssReading, BarometerReading or MagnetometerReading."""

class GeoFrame:
    """The world frame W (east, north, up) at a place of the Earth (WGS 84 ellipsoid).

    The frame is a tangent plane: altitude grows with the square of the distance (8 cm at 1 km). Simulation.geo_frame is
    that of satellite receivers.
    """

    def __init__(self, latitude_deg: float, longitude_deg: float, altitude: float = 0.0) -> None:
        """latitude_deg, longitude_deg: degrees, -90 … 90 and -180 … 180; altitude: metres over the ellipsoid. ValueError
        beyond that."""
    @property
    def origin(self) -> _F64:
        """(3,) latitude, longitude (degrees) and altitude (metres) of W's origin."""
    def to_world(self, places: _Vector | _Points) -> _F64:
        """Latitude, longitude (degrees), altitude (metres), (3,) or (N, 3) -> metres in W, the same shape."""
    def to_geodetic(self, points: _Vector | _Points) -> _F64:
        """Metres in W, (3,) or (N, 3) -> latitude, longitude (degrees), altitude (metres), the same shape."""

class Snapshot:
    """Everything that changes in a simulation, at one instant. Simulation.restore goes back to it exactly."""

    @property
    def t(self) -> float:
        """Simulated time, seconds."""
    @property
    def step(self) -> int:
        """Steps since the start."""
    @property
    def hash(self) -> int:
        """64 bits over every number of the state."""
    def state(self, drone: int = 0) -> DroneState:
        """DroneState of a drone by number, then."""

class Recording:
    """The commands of a run with hashes of its states."""

    @property
    def note(self) -> str:
        """What start_recording was told."""
    @property
    def steps(self) -> int:
        """Steps that it holds."""
    def write(self, path: str) -> None:
        """Writes it to a file. RuntimeError where that fails."""
    @staticmethod
    def read(path: str) -> Recording:
        """ValueError for anything but a recording."""

class Simulation:
    """Drones in a world, advanced in fixed steps of dt seconds; no clock but the steps.

    The same seed and the same commands give the same bytes with any number of threads. Commands hold from the next step
    on, until the next command or their timeout (seconds, 0 = none); `drone` is a number from 0 or a name. yaw: None
    keeps the heading, a number is an angle (radians, 0 = east, counter-clockwise), "forward" looks along the way;
    yaw_rate (rad/s) turns instead.
    """

    def __init__(self, world: World, drones: int | str | Drone | Sequence[str | Drone] = 1, people: int = 0,
                 seed: int = 0, dt: float = 0.001, wind: _Vector | None = None) -> None:
        """drones: a number of hummingbirds, a Drone (or a name, words, a .yaml file), or a list of them. people: how many
        walk about, 0 … 10000. seed: of people, wind and sensors. dt: seconds, 0.00001 … 0.1. wind: (3,) m/s in W; None:
        that of the world. The world says what draws the pictures."""
    @property
    def t(self) -> float:
        """Seconds since the start."""
    @property
    def t_ns(self) -> int:
        """Nanoseconds since the start."""
    @property
    def dt(self) -> float:
        """Seconds of a step."""
    @property
    def world(self) -> World:
        """The world that it takes place in."""
    @property
    def geo_frame(self) -> GeoFrame:
        """GeoFrame: where W lies on the Earth, for satellite receivers."""
    @property
    def drones(self) -> list[str]:
        """Names of the drones, in order."""
    @property
    def entities(self) -> list[Entity]:
        """As World.entities, with the bodies of drones (if there are several) and people."""
    @property
    def people(self) -> list[Person]:
        """Everybody now: where they are and what they do."""
    @property
    def vehicles(self) -> list[TrafficVehicle]:
        """The traffic now: where each vehicle is and what it is about to do."""
    def step(self, n: int = 1) -> None:
        """Takes n steps of dt."""
    def run(self, seconds: float) -> None:
        """Takes the steps of so many simulated seconds."""
    def wait(self, drone: _DroneRef = 0, timeout: float = 60.0) -> bool:
        """Takes steps until the drone's command has reached its end (a take-off its height, fly_to its place, a landing
        the ground): True; or until it is refused or lost, or `timeout` simulated seconds are over: False."""
    def state(self, drone: _DroneRef = 0) -> DroneState:
        """DroneState of a drone by number or name."""
    @overload
    def capture(self, rig: Rig = ..., drone: _DroneRef = 0, memory: Literal["cpu"] = "cpu") -> Capture:
        """What the rig on a drone sees now; its own body is hidden. Changes nothing. memory="cuda": a CudaCapture, whose
        pictures stay on the GPU."""
    @overload
    def capture(self, rig: Rig = ..., drone: _DroneRef = 0, *, memory: Literal["cuda"]) -> CudaCapture: ...
    @overload
    def capture(self, rig: Rig, drone: _DroneRef, memory: Literal["cuda"]) -> CudaCapture: ...
    def scan(self, lidar: Lidar | str = ..., drone: _DroneRef = 0) -> LidarScan:
        """LidarScan of one turn now, with other drones and people in it; its own body is hidden. Changes nothing. lidar:
        also the name of one in the drone's sensor file."""
    def snapshot(self) -> Snapshot:
        """A copy of everything that changes."""
    def restore(self, snapshot: Snapshot) -> None:
        """Goes back to a snapshot of this simulation; commands not yet applied are dropped. ValueError for one of
        another simulation."""
    def start_recording(self, note: str = "") -> None:
        """Notes commands and hashes from now on."""
    def stop_recording(self) -> Recording:
        """The Recording since start_recording; ValueError without one."""
    def replay(self, recording: Recording, start: Snapshot) -> Replay:
        """Repeats a recording from the snapshot it began with, beside this simulation."""
    def hash(self) -> int:
        """64 bits over every number of the state."""
    def fly_mission(self, mission: str, drone: _DroneRef = 0, rig: Rig | None = None, timeout: float = 600.0) -> Mission:
        """Takes steps until a mission has ended, or `timeout` simulated seconds are over. mission: XML, or the path of a file
        of it (docs/guide/missions.md). ValueError for what is wrong in it."""
    def events(self) -> list[Event]:
        """What happened since the last call."""
    def arm(self, drone: _DroneRef = 0) -> None:
        """Lets the rotors turn."""
    def disarm(self, drone: _DroneRef = 0) -> None:
        """Stops the rotors, in the air too."""
    def takeoff(self, height: float = 2.0, speed: float = 1.0, drone: _DroneRef = 0) -> None:
        """Arms and climbs `height` metres above where it stands, at `speed` m/s."""
    def land(self, speed: float = 0.7, drone: _DroneRef = 0) -> None:
        """Descends at `speed` m/s until the ground stops it, then disarms."""
    def hover(self, yaw: _Yaw = None, yaw_rate: float | None = None, drone: _DroneRef = 0) -> None:
        """Stops and stays."""
    def return_home(self, height: float = 5.0, speed: float = 0.0, land: bool = True, drone: _DroneRef = 0) -> None:
        """Climbs to at least `height` metres above where it was armed, flies there at `speed` m/s (0 = what the drone is
        made for), and lands if `land`."""
    def fly_velocity(self, velocity: _Vector, body_heading: bool = False, altitude: float | None = None, yaw: _Yaw = None,
                     yaw_rate: float | None = None, drone: _DroneRef = 0, timeout: float = 0.0) -> None:
        """velocity: (3,) m/s in W, or (body_heading) ahead, left, up of the drone's heading. altitude: z of W that is
        kept instead of velocity's."""
    def fly_to(self, position: _Vector, speed: float = 0.0, yaw: _Yaw = None, yaw_rate: float | None = None,
               drone: _DroneRef = 0, timeout: float = 0.0) -> None:
        """position: (3,) metres of W. speed: m/s, 0 = what the drone is made for."""
    def fly_path(self, waypoints: _Points, speed: float = 0.0, lookahead: float = 0.0, yaw: _Yaw = None,
                 yaw_rate: float | None = None, drone: _DroneRef = 0, timeout: float = 0.0) -> None:
        """Follows the polyline through waypoints (N, 3) of W. speed: m/s, 0 = what the drone is made for. lookahead:
        metres ahead that it flies towards, 0 = 0.6 s of the speed and at least 0.75."""
    def fly_trajectory(self, plan: Plan, yaw: float | None = None, drone: _DroneRef = 0) -> None:
        """Follows a Plan from now on; yaw: a fixed heading, None = along the way."""
    def set_attitude(self, roll: float, pitch: float, throttle: float | None = None, altitude: float | None = None,
                     yaw: _Yaw = None, yaw_rate: float | None = None, drone: _DroneRef = 0, timeout: float = 0.0) -> None:
        """Radians: roll right side down, pitch nose up positive. throttle: 0 … 1 of the full thrust; or altitude: metres
        kept."""
    def set_rates(self, rates: _Vector, throttle: float | None = None, altitude: float | None = None,
                  drone: _DroneRef = 0, timeout: float = 0.0) -> None:
        """rates: (3,) rad/s about the axes of B. throttle or altitude as set_attitude."""
    def set_rotor_speeds(self, speeds: _Numbers, drone: _DroneRef = 0, timeout: float = 0.0) -> None:
        """(rotors,) rad/s."""
    def set_rotor_signals(self, signals: _Numbers, drone: _DroneRef = 0, timeout: float = 0.0) -> None:
        """(rotors,) 0 … 1 of each rotor's full static thrust."""
    def set_rotor_health(self, health: _Numbers, drone: _DroneRef = 0) -> None:
        """(rotors,) 1 works, 0 has failed."""
    def set_wind(self, wind: _Vector) -> None:
        """(3,) mean velocity of the air, m/s in W."""
    def reset_drone(self, position: _Vector | None = None, yaw: float = 0.0, airborne: bool | None = None,
                    drone: _DroneRef = 0) -> None:
        """Puts a drone where it started, or at `position` (3,) of W with heading `yaw`, as new. airborne:
        hovering or standing; None: as it started."""

class VectorEnvironment:
    """Many drones that learn at once (see airsim360.gym). Arrays stay where they are: each step writes into them."""

    TASK_OPTIONS: tuple[str, ...]
    """Names that task_options takes."""
    def __init__(self, world: World, task: Literal["reach", "avoid", "search"] = "reach", task_options: TaskOptions = {},
                 count: int = 1, drone: str | Drone = "hummingbird",
                 action: Literal["velocity", "rates", "rotors"] = "velocity", width: int = 128, height: int = 0,
                 *, tier: _Tier = "fast", samples: int | None = None,
                 denoise: bool = True, edge_samples: int | None = None,
                 tone: Literal["filmic", "agx", "linear"] = "filmic", exposure: float | Literal["auto"] = 0.0,
                 pano_frame: Literal["body", "level"] = "body", lens: Literal["ideal", "real360"] = "ideal",
                 look: Literal["clean", "photo"] = "clean", camera_look: dict[str, float | bool] = {},
                 observations: Sequence[Literal["rgb", "range", "semantic", "entity"]] | None = None,
                 period: float = 0.1, max_speed: float = 3.0, max_turn: float = 1.5, max_rate: float = 6.0,
                 level: bool = False, auto_reset: bool = True, seed: int = 0) -> None:
        """count: environments. action: what a step commands (docs/reference/python.md). width, height: pixels of the
        panoramas (height 0: half the width). tier to camera_look: how they are made, as Rig. period: seconds of a step. max_speed (m/s), max_turn, max_rate (rad/s): what an action of 1 means. level:
        panoramas keep the horizon level. auto_reset: one that has ended begins anew in the next step. ValueError names
        the nearest for an unknown task option."""
    @property
    def count(self) -> int:
        """Environments."""
    @property
    def action_size(self) -> int:
        """Numbers of an action."""
    @property
    def width(self) -> int:
        """Pixels."""
    @property
    def height(self) -> int:
        """Pixels."""
    @property
    def rgb(self) -> _U8 | None:
        """(count, H, W, 3) uint8; None if not among the observations, as the next three."""
    @property
    def range(self) -> _F32 | None:
        """(count, H, W) float32, metres, 0 = sky"""
    @property
    def semantic(self) -> _U16 | None:
        """(count, H, W) uint16"""
    @property
    def entity(self) -> _U32 | None:
        """(count, H, W) uint32"""
    @property
    def state(self) -> _F32:
        """(count, 17) float32; columns: docs/reference/python.md"""
    @property
    def reward(self) -> _F32:
        """(count,) float32"""
    @property
    def distance(self) -> _F32:
        """(count,) float32, metres to the goal"""
    @property
    def steps(self) -> _I64:
        """(count,) int64, of the present episode"""
    @property
    def terminated(self) -> _Flags:
        """(count,) bool: reached or crashed"""
    @property
    def truncated(self) -> _Flags:
        """(count,) bool: out of time"""
    @property
    def reached(self) -> _Flags:
        """(count,) bool"""
    @property
    def crashed(self) -> _Flags:
        """(count,) bool"""
    def reset(self, seed: int | None = None, options: ResetOptions | None = None) -> None:
        """Begins anew: episode 0 of `seed`, or everyone's next episode. options: a dictionary with goal and start (3,) of
        W and yaw (radians), for all or with one row an environment; ValueError for places that are not free."""
    def step(self, actions: npt.ArrayLike) -> None:
        """actions: (count, action_size) float32 in -1 … 1."""
    def pose_of(self, environment: int) -> _F64:
        """(4, 4) X_WB of a drone."""
    def goal_of(self, environment: int) -> _F64:
        """(3,) goal in W."""
    def hash(self) -> int:
        """64 bits over every number of all simulations."""

def _read_rgb(path: str) -> _U8:
    """A PNG, JPEG or WebP file as (H, W, 3) uint8 sRGB. ValueError names the file where it is none."""

def _find_plan(name: str, worlds: Sequence[str], frames: int, seed: int, device: str, gpu: int) -> str:
    """The text of a plan file: of a recipe or a file, with '@HASH' behind or not."""

class _PlanFrames:
    """Frames of a plan as dataset run would write them; airsim360.data.Panoramas is for users."""

    def __init__(self, plan: str, picture: dict[str, Any], products: Sequence[str] | None, projection: str, size: str, fov_deg: float,
                 cameras: str, environment: dict[str, str], device: str, gpu: int, cache: str | None, cache_bytes: int) -> None: ...
    @property
    def hash(self) -> str:
        """Of the plan."""
    @property
    def count(self) -> int:
        """Number of frames."""
    @property
    def worlds(self) -> dict[str, str | None]:
        """World -> hash, None where it did not exist."""
    @property
    def uses_gpu(self) -> bool:
        """Whether a GPU draws."""
    @property
    def meta(self) -> str:
        """meta.json of a dataset of these frames."""
    def blocks(self) -> list[tuple[int, int]]:
        """(first, last) of the frames of each sky whose worlds exist."""
    def open(self, threads: int) -> None:
        """Opens worlds, as many as are kept."""
    def describe(self, frame: int, threads: int) -> str:
        """What a frame is, JSON."""
    def take(self, frame: int, threads: int) -> tuple[str, list[tuple[str, str, list[str], npt.NDArray[Any]]]]:
        """The same with persons, and (product, view, channels, picture) of all pictures."""
