"""The dictionaries that AirSim360 gives and takes, key by key, for type checkers and readers.

    import airsim360
    from airsim360.records import Entity

    def benches(world: airsim360.World) -> list[Entity]:
        return [entity for entity in world.entities if entity["category_path"].endswith("/bench")]

At run time these are plain dictionaries. Metres, seconds, radians; arrays are float64 and in W unless said otherwise
(frames: `airsim360`). `total=False`, or NotRequired, marks keys that may be missing.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Literal, NotRequired, Optional, Sequence, TypedDict, Union

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from ._native import Capture

    _F64 = npt.NDArray[np.float64]
    _Vector = Union[Sequence[float], npt.NDArray[np.float64]]
    _Rows = Union[_Vector, Sequence[Sequence[float]]]

__all__ = ["BarometerReading", "Category", "Certificate", "Collision", "Entity", "EntityRecord", "EpisodeInfo", "Event", "FrameRecord",
           "GnssReading", "Gpu", "ImuReading", "Limits", "MagnetometerReading", "Meta", "Mission", "MissionCapture", "MissionNode",
           "Person", "PersonRecord", "PlannedFrame", "Pose", "Replay", "ResetOptions", "Rotor", "TaskOptions", "TrafficVehicle", "TrajectorySamples",
           "VectorInfo", "WorldInfo"]

Kind = Literal["thing", "stuff"]


class WorldInfo(TypedDict):
    """A built-in world, from airsim360.worlds()."""

    name: str
    """What World(name) takes."""
    setting: str
    """"outdoor" or "indoor"."""
    area_m2: float
    """Square metres of ground."""
    categories: List[str]
    """Paths of the categories that it holds."""
    description: str
    """One line of words."""


class Gpu(TypedDict):
    """A GPU of this machine, from airsim360.gpus()."""

    index: int
    """What World(gpu=...) takes."""
    name: str
    driver: str
    """Name and version of its Vulkan driver."""
    software: bool
    """True: no real one, the driver runs on the CPU."""
    missing: str
    """What it lacks to render; "" where it can."""
    uuid: bytes
    """16 bytes."""


class Entity(TypedDict):
    """A thing or a surface that pictures tell apart, from World.entities and Simulation.entities."""

    id: int
    """What Capture.entity holds; from 1 on."""
    name: str
    category: int
    """What Capture.semantic holds."""
    category_path: str
    """World.categories[category], for example "furniture/box"."""
    kind: Kind
    bounds: Optional[_F64]
    """(2, 3) least and greatest corner, metres in W; None for the sky."""


class Person(TypedDict):
    """Somebody who walks about now, from Simulation.people."""

    entity: int
    """Entity id."""
    position: _F64
    """(3,) on the ground, metres in W."""
    velocity: _F64
    """(3,) m/s in W."""
    yaw: float
    """Heading: radians, 0 = east, counter-clockwise."""
    behaviour: str
    """What arms and head do: "wave", "phone", …; as `locomotion` where they do nothing else (docs/guide/people.md)."""
    locomotion: str
    """What the legs do: "idle", "walk", "sit" and so on."""
    group_id: int
    """People who walk or talk together share one; 0: alone."""
    visible: bool


class TrafficVehicle(TypedDict):
    """A vehicle that drives now, from Simulation.vehicles."""

    entity: int
    """Entity id."""
    name: str
    """"traffic/000" and so on."""
    category: str
    """Path of its category: "vehicle/car"."""
    position: _F64
    """(3,) on the ground below its middle, metres in W."""
    orientation: _F64
    """(4,) unit quaternion w, x, y, z of the body in W: +X forward, +Z away from the ground."""
    velocity: _F64
    """(3,) m/s in W."""
    size: _F64
    """(3,) length, width and height, metres."""
    track_id: int
    """Number of the vehicle, from 1: the same for the whole simulation."""
    lane: int
    """Number of the lane that its front is on, of the world's roads."""
    lane_position: float
    """Metres from the beginning of the lane to its front."""
    indicator: Literal["left", "right", "off"]
    braking: bool
    """Brake lamps."""
    stopped: bool


class Event(TypedDict):
    """What happened to a drone or on a road, from Simulation.events(). The keys of a contact and of a near miss are there for those
    alone."""

    event: Literal["collision", "crash", "command refused", "command lost", "command done", "fence", "rotor failed",
                   "battery low", "battery empty", "world edge", "near person", "near miss"]
    drone: int | None
    """Number of the drone; None for near misses without one."""
    t_ns: int
    """Simulated time, nanoseconds."""
    entity: NotRequired[int]
    """Entity id of what was met."""
    point: NotRequired[_F64]
    """(3,) metres in W: of a contact, or of the first of a near miss."""
    normal: NotRequired[_F64]
    """(3,) unit normal in W, away from the surface."""
    impact_speed: NotRequired[float]
    """m/s along the normal."""
    first: NotRequired[str]
    """Vehicle of a near miss: "traffic/012" (docs/guide/traffic.md)."""
    second: NotRequired[str]
    """Whom it nearly met: "traffic/040", "person/007", or a drone's name."""
    time_to_collision: NotRequired[float]
    """The least of a near miss, seconds."""
    braking: NotRequired[float]
    """m/s^2 that would have avoided it then."""
    text: NotRequired[str]
    """More in words, for instance why a command was refused."""


class MissionNode(TypedDict):
    """A node of a mission that still ran when the mission was stopped."""

    line: int
    """Of the XML, from 1."""
    label: str
    """Its `name`, or what it is."""


class MissionCapture(TypedDict):
    """A frame that a mission has taken."""

    to: str
    """Name of its dataset."""
    t_ns: int
    """Simulated time, nanoseconds."""
    position: _F64
    """(3,) metres in W, of the drone."""
    orientation: _F64
    """(4,) unit quaternion w, x, y, z of the drone in W."""
    picture: Optional[Capture]
    """What the rig saw then; None without a rig."""


class Mission(TypedDict):
    """What a mission did, from Simulation.fly_mission()."""

    result: Literal["success", "failure", "stopped"]
    """Stopped: the time was over."""
    seconds: float
    """That it took, simulated."""
    log: list[str]
    """What failed and why: "12.34 s, line 5, Goto: …"."""
    active: list[MissionNode]
    captures: list[MissionCapture]


class Collision(TypedDict):
    """The last contact of a drone, from DroneState.collision."""

    count: int
    """Contacts since the start or the last reset."""
    t_ns: int
    point: _F64
    """(3,) metres in W."""
    normal: _F64
    """(3,) unit normal in W, away from the surface."""
    impact_speed: float
    """m/s along the normal."""
    entity: int
    """Entity id of what was met."""


class ImuReading(TypedDict):
    """The last reading of an inertial unit, in the axes of B."""

    t_ns: int
    angular_velocity: _F64
    """(3,) rad/s."""
    specific_force: _F64
    """(3,) m/s^2; +9.81 along the up axis at rest."""


class GnssReading(TypedDict):
    """The last reading of a satellite receiver."""

    t_ns: int
    """When it was given out."""
    measured_ns: int
    """The instant that it tells of."""
    latitude_deg: float
    longitude_deg: float
    altitude: float
    """Metres over the WGS 84 ellipsoid."""
    position: _F64
    """(3,) the same place in W, metres."""
    velocity: _F64
    """(3,) m/s in W."""
    eph: float
    """Standard deviation told by the receiver, metres along the ground."""
    epv: float
    """The same for the height."""
    has_fix: bool


class BarometerReading(TypedDict):
    """The last reading of a barometer."""

    t_ns: int
    pressure: float
    """Pascal."""
    altitude: float
    """Metres above the sea, from the pressure."""
    temperature: float
    """Kelvin, of the air."""


class MagnetometerReading(TypedDict):
    """The last reading of a magnetometer."""

    t_ns: int
    field: _F64
    """(3,) tesla, in B."""


class Rotor(TypedDict):
    """A rotor, from Drone.rotors, in the order of rotor commands."""

    position: _F64
    """(3,) metres in B."""
    axis: _F64
    """(3,) unit direction of the thrust, in B."""
    direction: float
    """+1: turns clockwise seen from the tip of the axis, its reaction torque is along +axis; -1: the other way."""
    diameter: float
    """Metres."""
    thrust_factor: float
    """N s^2: thrust = thrust_factor * speed^2."""
    torque_ratio: float
    """Metres: drag torque / thrust."""
    max_speed: float
    """rad/s."""
    tau_up: float
    """Time constant of a faster command, seconds."""


class Certificate(TypedDict):
    """Whether a plan is proved to keep its clearance at every instant, from Plan.certificate."""

    certified: bool
    least_clearance: float
    """Metres, a proved lower bound where certified."""
    violation_time: Optional[float]
    """Seconds into the flight where it is too near; None where certified."""


class TrajectorySamples(TypedDict):
    """Samples of a Plan, from at() and sample()."""

    t: _F64
    """(N,) seconds."""
    p: _F64
    """(N, 3) metres in W."""
    v: _F64
    """(N, 3) m/s."""
    a: _F64
    """(N, 3) m/s^2."""
    jerk: _F64
    """(N, 3) m/s^3."""
    snap: _F64
    """(N, 3) m/s^4."""


class Limits(TypedDict, total=False):
    """Further limits of plan_minimum_snap(limits=...)."""

    axis_vmax: _Vector
    """(3,) m/s along each axis of W."""
    axis_amax: _Vector
    """(3,) m/s^2 along each axis of W."""
    climb: float
    """m/s upwards."""
    descent: float
    """m/s downwards."""
    thrust: float
    """m/s^2: |a + g| of the drone."""
    body_rate: float
    """rad/s of roll and pitch."""


class Replay(TypedDict):
    """How a repeated recording compares, from Simulation.replay()."""

    same: bool
    """Every hash is that of the recording."""
    steps: int
    differs_at: Optional[int]
    """First step whose hash differs; None where all agree."""
    hash: int
    """Of the state at the end."""


class TaskOptions(TypedDict, total=False):
    """Options of a task of airsim360.gym and VectorEnvironment (rewards: docs/reference/python.md)."""

    target: str
    """search: category path of what is to be found; "" = any thing of everyday size."""
    least_distance: float
    """Metres from start to goal, at least."""
    most_distance: float
    """Metres from start to goal, at most."""
    goal_radius: float
    """Metres at which a goal is reached."""
    clearance: float
    """Metres that starts, goals and a way between them keep from surfaces."""
    area: float
    """Metres around the world's spawn within which episodes take place."""
    min_height: float
    """Metres above the ground."""
    max_height: float
    """Metres above the ground."""
    seconds: float
    """Length of an episode, then it is truncated."""
    safe_distance: float
    """avoid: metres to a surface below which near_cost counts."""
    progress_reward: float
    """For each metre nearer to the goal."""
    goal_reward: float
    crash_cost: float
    step_cost: float
    """Of every step."""
    near_cost: float
    """avoid: times 1 - clearance / safe_distance where that is positive."""
    seen_reward: float
    """search: of a step with the target in sight."""


class ResetOptions(TypedDict, total=False):
    """What reset(options=...) sets for the next episodes, for all or with one row an environment."""

    goal: _Rows
    """(3,) or (count, 3) metres in W."""
    start: _Rows
    """(3,) or (count, 3) metres in W."""
    yaw: Union[float, _Vector]
    """Radians, or (count,)."""


class EpisodeInfo(TypedDict):
    """info of gym.Env."""

    success: bool
    crashed: bool
    distance: float
    """Metres to the goal."""
    episode_step: int


class VectorInfo(TypedDict):
    """info of gym.VectorEnv, (num_envs,) each."""

    success: npt.NDArray[np.bool_]
    crashed: npt.NDArray[np.bool_]
    distance: npt.NDArray[np.float32]
    """Metres to the goals."""
    episode_step: npt.NDArray[np.int64]


class Pose(TypedDict):
    """A pose in a file: p_W = R(q) p + p."""

    p: List[float]
    """(3,) metres."""
    q_wxyz: List[float]
    """(4,) w, x, y, z."""


class FrameRecord(TypedDict):
    """A line of frames.jsonl, from Frame.record."""

    index: int
    stem: str
    """Name of its files without extension."""
    t_ns: int
    """Simulated time, nanoseconds."""
    world: str
    X_WC: Pose
    """Camera in W."""
    X_WC_next: NotRequired[Pose]
    """The same in the next frame, where optical flow leads to."""
    X_WB: NotRequired[Pose]
    """Body in W, with several cameras."""
    v_WB: List[float]
    """(3,) m/s in W."""
    w_WB_B: List[float]
    """(3,) rad/s in B."""
    pano_frame: Literal["body", "level"]
    seed: int
    range_min: float
    """Metres."""
    range_median: float
    """Metres."""
    K: NotRequired[Dict[str, Any]]
    """Intrinsics of pinhole and fisheye pictures: model, width, height, fx, fy, cx, cy, distortion."""
    developed: NotRequired[Dict[str, float]]
    """Of colour pictures, their exposure: factor (radiance times it is what the tone curve was given), stops (log2 of it)."""
    look: NotRequired[Dict[str, Any]]
    """With look photo: exposure_ev, white_cd_m2, gain, white_balance (red, green, blue), contrast, sun_seen."""
    cameras: NotRequired[Dict[str, Dict[str, Any]]]
    """With several cameras, for each by name: X_WC, X_WC_next, K, developed, look."""
    sha256: Dict[str, str]
    """Checksum of each picture, by product and view."""


class PlannedFrame(TypedDict):
    """What a frame of a plan is, from data.Panoramas.meta and `airsim360 dataset plan --show`."""

    index: int
    row: str
    """Of the recipe."""
    world: str
    t_ns: int
    """Simulated time in the dataset, nanoseconds."""
    X_WC: Pose
    """Camera in W, of the first view."""
    v_WB: List[float]
    """(3,) m/s in W."""
    w_WB_B: List[float]
    """(3,) rad/s in B."""
    environment: str
    """Sun, sky and weather; World(environment=...) takes it."""
    people: int
    """How many are in the world."""
    seed: int
    """Of the noise and samples of its block."""
    block: List[int]
    """(2,) first frame that shares its sky, and the one behind the last."""
    persons: NotRequired[List[PersonRecord]]
    """Of data.Panorama.about in rows of people: entries of people.jsonl."""


class Category(TypedDict):
    """A category of a dataset's tree, from Dataset.categories."""

    id: int
    path: str
    """From the root, for example "construction/wall"."""
    color: List[int]
    """(3,) of the palette, 0 to 255."""
    parent: int
    """Id of the category above."""
    kind: Kind
    ade20k: int
    """Id in ADE20K; likewise the next two."""
    cityscapes: int
    coco: int


class EntityRecord(TypedDict):
    """An entity of a dataset, from Dataset.entities."""

    name: str
    category: int
    category_path: str
    kind: Kind
    first_frame: int
    """Index of the first frame that shows it."""


class PersonRecord(TypedDict):
    """A person in a frame, from Frame.people: the keys of people.jsonl, described in docs/reference/people_format.md."""

    entity_id: int
    """The id in Frame.entity."""
    track_id: int
    """The same person in all frames."""
    name: str
    character: str
    outfit: str
    stature_m: float
    age: float
    sex: Literal["female", "male"]
    behaviour: str
    """What the upper body does."""
    locomotion: str
    """What the legs do."""
    group_id: int
    speaking: bool
    partner_track_id: int
    """Whom they talk with; 0 = nobody."""
    position_world: List[float]
    """(3,) on the ground, metres in W."""
    yaw: float
    velocity_world: List[float]
    """(3,) m/s in W."""
    bbox: Optional[List[float]]
    """x, y, width, height of the visible pixels, which may cross the seam; None where nothing is seen."""
    bbox_wrap: NotRequired[bool]
    bbox_parts: NotRequired[List[List[float]]]
    segmentation: NotRequired[Dict[str, Any]]
    """COCO's run lengths of the visible pixels."""
    area: int
    """Visible pixels."""
    iscrowd: int
    box2d_amodal: Optional[List[float]]
    """As bbox, of the whole body as if nothing stood before it."""
    box2d_amodal_wrap: NotRequired[bool]
    box2d_amodal_parts: NotRequired[List[List[float]]]
    amodal_area: int
    visible_fraction: float
    """0 ... 1 of the body's pixels."""
    visibility_token: int
    truncation: float
    bfov: List[float]
    """Box on the sphere: longitude, latitude, width, height, radians."""
    rbfov: List[float]
    """The same turned by a fifth number."""
    box3d_world: Dict[str, Any]
    box3d_cam: Dict[str, Any]
    alpha: float
    distance: float
    """Metres from the camera to the middle of the 3D box."""
    keypoints: List[float]
    """COCO's 17 keypoints as x, y, v in pixels, flat."""
    num_keypoints: int
    keypoints_px: List[List[float]]
    keypoints_world: List[List[float]]
    """(K, 3) metres in W."""
    keypoints_cam: List[List[float]]
    """(K, 3) metres in C."""
    keypoints_sph: List[List[float]]
    """(K, 3) longitude, latitude, range."""
    keypoint_state: List[int]
    keypoint_occluder: List[int]
    joints_world: List[List[float]]
    joint_q_wxyz_world: List[List[float]]
    joint_q_wxyz_cam: List[List[float]]
    crop: Dict[str, Any]


class Meta(TypedDict):
    """meta.json of a dataset, from Dataset.meta."""

    format: str
    generator: str
    command: str
    world: str
    seed: int
    size: List[int]
    """Width, height of a picture in pixels."""
    tier: str
    parameters: Dict[str, Any]
    """What it was collected with: "projection", "fov_deg", "products" and more."""
    scene: Dict[str, Any]
    """"name", "triangles", "entities" of the world."""
    attributions: List[str]
    """Whom the world's models and maps are from."""
    conventions: Dict[str, str]
    """Frames and units in words."""
    encodings: Dict[str, str]
    """How each product's files are to be read, in words."""
    categories: List[Category]
    cameras: NotRequired[List[Dict[str, Any]]]
