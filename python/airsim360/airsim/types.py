"""AirSim's structures and enumerations. NED, metres, radians; see docs/reference/airsim_functions.md.

`fields` of a structure names its keys on the wire with their defaults; a default that is a structure is made anew for
each object.
"""
from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Callable, ClassVar, Dict, Iterator, List, Optional, Tuple, Type, TypeVar, Union

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from .lending import Region

__all__ = [
    "ImageType", "DrivetrainType", "LandedState", "WeatherParameter", "GnssFixType", "Vector2r", "Vector3r",
    "Quaternionr", "Pose", "CollisionInfo", "GeoPoint", "YawMode", "RCData", "ImageRequest", "ImageResponse",
    "CarControls", "CarState", "KinematicsState", "EnvironmentState", "MultirotorState", "RotorStates",
    "ProjectionMatrix", "CameraInfo", "LidarData", "ImuData", "BarometerData", "MagnetometerData", "GnssReport",
    "GpsData", "DistanceSensorData", "Box2D", "Box3D", "DetectionInfo", "PIDGains", "AngleRateControllerGains",
    "AngleLevelControllerGains", "VelocityControllerGains", "PositionControllerGains",
    "MeshPositionVertexBuffersResponse", "MsgpackMixin"]

_Structure = TypeVar("_Structure", bound="MsgpackMixin")
_Few = TypeVar("_Few", bound="_Numbers")


class ImageType:
    """What a picture shows, for ImageRequest. Depth is in metres; normals, flow and Annotation are this server's (docs/reference/airsim_functions.md)."""

    Scene = 0
    DepthPlanar = 1
    DepthPerspective = 2
    DepthVis = 3
    DisparityNormalized = 4
    Segmentation = 5
    SurfaceNormals = 6
    Infrared = 7
    OpticalFlow = 8
    OpticalFlowVis = 9
    Annotation = 11


class DrivetrainType:
    """How a moving drone looks: as yaw_mode says, or along its way."""

    MaxDegreeOfFreedom = 0
    ForwardOnly = 1


class LandedState:
    """MultirotorState.landed_state."""

    Landed = 0
    Flying = 1


class WeatherParameter:
    """What simSetWeatherParameter sets, 0 ... 1 each."""

    Rain = 0
    Roadwetness = 1
    Snow = 2
    RoadSnow = 3
    MapleLeaf = 4
    RoadLeaf = 5
    Dust = 6
    Fog = 7
    Enabled = 8


class GnssFixType:
    """GnssReport.fix_type."""

    GNSS_FIX_NO_FIX = 0
    GNSS_FIX_TIME_ONLY = 1
    GNSS_FIX_2D_FIX = 2
    GNSS_FIX_3D_FIX = 3


class MsgpackMixin:
    """A structure: attributes named as its keys on the wire."""
    fields: ClassVar[Dict[str, Any]] = {}

    def __init__(self, **values: Any) -> None:
        for name, default in self.fields.items():
            setattr(self, name, values.pop(name) if name in values else
                    default() if isinstance(default, type) else list(default) if isinstance(default, list) else default)
        if values:
            raise TypeError(f"{type(self).__name__} has no field {next(iter(values))!r}")

    def to_msgpack(self, *args: Any, **kwargs: Any) -> Dict[str, Any]:
        """As it is sent."""
        return vars(self)

    @classmethod
    def from_msgpack(cls: Type[_Structure], encoded: Dict[str, Any]) -> _Structure:
        """From what was sent."""
        made = cls.__new__(cls)
        MsgpackMixin.__init__(made)
        for name, value in encoded.items():
            kind: Any = cls.fields.get(name)
            structure = isinstance(value, dict) and isinstance(kind, type) and issubclass(kind, MsgpackMixin)
            setattr(made, name, kind.from_msgpack(value) if structure else value)
        return made

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and vars(self) == vars(other)

    def __repr__(self) -> str:
        return f"<{type(self).__name__}> " + repr(vars(self))


class _Numbers(MsgpackMixin):
    """Structures that are a few numbers, given in their order."""

    def __init__(self, *values: Any, **named: Any) -> None:
        names = list(self.fields)
        if len(values) > len(names):
            raise TypeError(f"{type(self).__name__} takes at most {len(names)} numbers")
        MsgpackMixin.__init__(self, **{**dict(zip(names, values)), **named})

    def __iter__(self) -> Iterator[Any]:
        return (getattr(self, name) for name in self.fields)

    def to_numpy_array(self) -> npt.NDArray[np.float32]:
        """The numbers as float32."""
        return np.array(list(self), dtype=np.float32)

    def containsNan(self) -> bool:
        """Whether any number is NaN."""
        return any(math.isnan(value) for value in self)

    def _each(self: _Few, operation: Callable[[Any], Any]) -> _Few:
        return type(self)(*(operation(value) for value in self))


class Vector2r(_Numbers):
    """Two numbers, pixels in Box2D."""

    fields = {"x_val": 0.0, "y_val": 0.0}
    x_val: float
    y_val: float


class Vector3r(_Numbers):
    """Three numbers: metres, m/s, m/s^2 or rad/s in NED (north, east, down) unless said otherwise."""

    fields = {"x_val": 0.0, "y_val": 0.0, "z_val": 0.0}
    x_val: float
    y_val: float
    z_val: float

    @staticmethod
    def nanVector3r() -> Vector3r:
        """NaN three times: "leave it as it is" in some calls."""
        return Vector3r(math.nan, math.nan, math.nan)

    def __add__(self, other: Vector3r) -> Vector3r:
        return Vector3r(*(a + b for a, b in zip(self, other)))

    def __sub__(self, other: Vector3r) -> Vector3r:
        return Vector3r(*(a - b for a, b in zip(self, other)))

    def __mul__(self, factor: float) -> Vector3r:
        return self._each(lambda value: value * factor)

    def __truediv__(self, divisor: float) -> Vector3r:
        return self._each(lambda value: value / divisor)

    def dot(self, other: Vector3r) -> float:
        """The scalar product."""
        return float(sum(a * b for a, b in zip(self, other)))

    def cross(self, other: Vector3r) -> Vector3r:
        """The vector product."""
        return Vector3r(*np.cross(list(self), list(other)).tolist())

    def get_length(self) -> float:
        """Euclidean."""
        return math.sqrt(self.dot(self))

    def distance_to(self, other: Vector3r) -> float:
        """Length of the difference."""
        return (self - other).get_length()

    def to_Quaternionr(self) -> Quaternionr:
        """The vector as a quaternion with w = 0."""
        return Quaternionr(self.x_val, self.y_val, self.z_val, 0)


class Quaternionr(_Numbers):
    """Hamilton; the constructor takes x, y, z, w."""
    fields = {"x_val": 0.0, "y_val": 0.0, "z_val": 0.0, "w_val": 1.0}
    x_val: float
    y_val: float
    z_val: float
    w_val: float

    @staticmethod
    def nanQuaternionr() -> Quaternionr:
        """NaN four times: "leave it as it is" in some calls."""
        return Quaternionr(math.nan, math.nan, math.nan, math.nan)

    def __add__(self, other: Quaternionr) -> Quaternionr:
        return Quaternionr(*(a + b for a, b in zip(self, other)))

    def __mul__(self, other: Quaternionr) -> Quaternionr:
        a, b = Vector3r(self.x_val, self.y_val, self.z_val), Vector3r(other.x_val, other.y_val, other.z_val)
        v = b * self.w_val + a * other.w_val + a.cross(b)
        return Quaternionr(v.x_val, v.y_val, v.z_val, self.w_val * other.w_val - a.dot(b))

    def __truediv__(self, other: Union[Quaternionr, float]) -> Quaternionr:
        return self * other.inverse() if isinstance(other, Quaternionr) else self._each(lambda value: value / other)

    def dot(self, other: Quaternionr) -> float:
        """The scalar product."""
        return float(sum(a * b for a, b in zip(self, other)))

    def cross(self, other: Quaternionr) -> Quaternionr:
        """Half the commutator."""
        return (self * other - other * self) / 2

    def __sub__(self, other: Quaternionr) -> Quaternionr:
        return Quaternionr(*(a - b for a, b in zip(self, other)))

    def outer_product(self, other: Quaternionr) -> Quaternionr:
        """AirSim's outer product."""
        return (self.inverse() * other - other.inverse() * self) / 2

    def rotate(self, other: Quaternionr) -> Quaternionr:
        """The rotation `other` seen through this one; this must be a unit quaternion."""
        if abs(self.get_length() - 1) > 1e-3:
            raise ValueError("only a unit quaternion rotates")
        return other * self * other.inverse()

    def conjugate(self) -> Quaternionr:
        """The inverse of a unit quaternion."""
        return Quaternionr(-self.x_val, -self.y_val, -self.z_val, self.w_val)

    def star(self) -> Quaternionr:
        """As conjugate()."""
        return self.conjugate()

    def inverse(self) -> Quaternionr:
        """What it is multiplied with to be one."""
        return self.conjugate() / self.dot(self)

    def sgn(self) -> Quaternionr:
        """Of length one."""
        return self / self.get_length()

    def get_length(self) -> float:
        """Euclidean."""
        return math.sqrt(self.dot(self))


class Pose(MsgpackMixin):
    """Place (metres, NED) and rotation."""

    fields = {"position": Vector3r, "orientation": Quaternionr}
    position: Vector3r
    orientation: Quaternionr

    def __init__(self, position_val: Optional[Vector3r] = None, orientation_val: Optional[Quaternionr] = None) -> None:
        MsgpackMixin.__init__(self)
        if position_val is not None:
            self.position = position_val
        if orientation_val is not None:
            self.orientation = orientation_val

    @staticmethod
    def nanPose() -> Pose:
        """NaN everywhere: "leave it as it is" in some calls."""
        return Pose(Vector3r.nanVector3r(), Quaternionr.nanQuaternionr())

    def containsNan(self) -> bool:
        """Whether any number is NaN."""
        return self.position.containsNan() or self.orientation.containsNan()

    def __iter__(self) -> Iterator[Union[Vector3r, Quaternionr]]:
        yield self.position
        yield self.orientation


class GeoPoint(MsgpackMixin):
    """Degrees, and metres over the WGS 84 ellipsoid."""

    fields = {"latitude": 0.0, "longitude": 0.0, "altitude": 0.0}
    latitude: float
    longitude: float
    altitude: float


class CollisionInfo(MsgpackMixin):
    """The last collision. Places in metres, NED; time_stamp in nanoseconds; object_id is the segmentation id."""

    fields = {"has_collided": False, "normal": Vector3r, "impact_point": Vector3r, "position": Vector3r,
              "penetration_depth": 0.0, "time_stamp": 0.0, "object_name": "", "object_id": -1}
    has_collided: bool
    normal: Vector3r
    impact_point: Vector3r
    position: Vector3r
    penetration_depth: float
    time_stamp: int
    object_name: str
    object_id: int


class YawMode(MsgpackMixin):
    """Degrees, or degrees per second."""
    fields = {"is_rate": True, "yaw_or_rate": 0.0}
    is_rate: bool
    yaw_or_rate: float

    def __init__(self, is_rate: bool = True, yaw_or_rate: float = 0.0) -> None:
        MsgpackMixin.__init__(self, is_rate=is_rate, yaw_or_rate=yaw_or_rate)


class RCData(_Numbers):
    """What a remote control sends: sticks -1 ... 1, throttle 0 ... 1."""

    fields = {"timestamp": 0, "pitch": 0.0, "roll": 0.0, "throttle": 0.0, "yaw": 0.0, "switch1": 0, "switch2": 0,
              "switch3": 0, "switch4": 0, "switch5": 0, "switch6": 0, "switch7": 0, "switch8": 0,
              "is_initialized": False, "is_valid": False}
    timestamp: int
    pitch: float
    roll: float
    throttle: float
    yaw: float
    switch1: int
    switch2: int
    switch3: int
    switch4: int
    switch5: int
    switch6: int
    switch7: int
    switch8: int
    is_initialized: bool
    is_valid: bool


class ImageRequest(MsgpackMixin):
    """A picture that simGetImages is to make: camera by name or number, an ImageType, float32 or 8 bits, PNG or plain."""

    fields = {"camera_name": "0", "image_type": ImageType.Scene, "pixels_as_float": False, "compress": True,
              "annotation_name": "", "binary_float": True}
    camera_name: str
    image_type: int
    pixels_as_float: bool
    compress: bool
    annotation_name: str
    binary_float: bool

    def __init__(self, camera_name: Union[str, int], image_type: int, pixels_as_float: bool = False, compress: bool = True,
                 annotation_name: str = "") -> None:
        MsgpackMixin.__init__(self, camera_name=str(camera_name), image_type=image_type,
                              pixels_as_float=pixels_as_float, compress=compress, annotation_name=annotation_name)


class ImageResponse(MsgpackMixin):
    """`image_data_uint8`: bytes, B, G, R per pixel or a PNG. `image_data_float`: float32 array of width * height."""
    fields = {"image_data_uint8": b"", "image_data_float": 0.0, "camera_name": "", "camera_position": Vector3r,
              "camera_orientation": Quaternionr, "time_stamp": 0, "message": "", "pixels_as_float": 0.0,
              "compress": True, "width": 0, "height": 0, "image_type": ImageType.Scene, "annotation_name": "",
              "exposure_factor": 0.0}
    image_data_uint8: bytes
    image_data_float: Any
    camera_name: str
    camera_position: Vector3r
    camera_orientation: Quaternionr
    time_stamp: int
    message: str
    pixels_as_float: bool
    compress: bool
    width: int
    height: int
    image_type: int
    annotation_name: str
    exposure_factor: float
    """Of colours: radiance times it is what the tone curve was given. Not in AirSim."""
    _lent: npt.NDArray[np.uint8]

    @classmethod
    def from_msgpack(cls, encoded: Dict[str, Any], region: Optional[Region] = None,
                     place: Tuple[int, int] = (0, 0)) -> ImageResponse:
        """`region`, `place` (offset, size): where the pixels lie in lent memory, if they do."""
        made = super().from_msgpack(encoded)
        if region is not None and place[1] > 0:
            if made.pixels_as_float:
                made.image_data_float = region.view(*place, "<f4")
            else:
                made._lent = region.view(*place, np.uint8)
                del made.image_data_uint8
        elif isinstance(made.image_data_float, bytes):
            made.image_data_float = np.frombuffer(made.image_data_float, dtype="<f4")
        return made

    if not TYPE_CHECKING:  # checkers are to find unknown names themselves
        def __getattr__(self, name):
            # Bytes are made of lent memory when somebody asks for them.
            if name != "image_data_uint8" or "_lent" not in vars(self):
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            self.image_data_uint8 = self._lent.tobytes()
            del self._lent
            return self.image_data_uint8

    def pixels(self) -> npt.NDArray[Any]:
        """The picture as a read-only array, without a copy: (height, width, 3) uint8, or float32 (height, width), flow
        (height, width, 2). ValueError for a PNG."""
        if self.pixels_as_float:
            flat: Any = np.asarray(self.image_data_float, np.float32)
            channels: Tuple[int, ...] = ()
        elif self.compress:
            raise ValueError("pixels(): the picture is a PNG; ask for compress=False")
        else:
            flat, channels = vars(self).get("_lent"), (3,)
            if flat is None:
                flat = np.frombuffer(self.image_data_uint8, np.uint8)
        if flat.size == 2 * self.width * self.height:
            channels = (2,)
        picture: npt.NDArray[Any] = flat.reshape(self.height, self.width, *channels)
        return picture

    def __getstate__(self) -> Dict[str, Any]:
        return self.to_msgpack()

    def to_msgpack(self, *args: Any, **kwargs: Any) -> Dict[str, Any]:
        """As it is sent."""
        self.image_data_uint8  # pylint: disable=pointless-statement  # made of lent memory
        return vars(self)

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and all(
            np.array_equal(value, getattr(other, name)) for name, value in self.to_msgpack().items())

    def __repr__(self) -> str:
        return f"<{type(self).__name__}> " + repr(self.to_msgpack())


class CarControls(_Numbers):
    """What a driver does."""

    fields = {"throttle": 0.0, "steering": 0.0, "brake": 0.0, "handbrake": False, "is_manual_gear": False,
              "manual_gear": 0, "gear_immediate": True}
    throttle: float
    steering: float
    brake: float
    handbrake: bool
    is_manual_gear: bool
    manual_gear: int
    gear_immediate: bool

    def set_throttle(self, throttle_val: float, forward: bool) -> None:
        """Sets throttle and gear."""
        self.is_manual_gear = not forward
        self.manual_gear = 0 if forward else -1
        self.throttle = throttle_val if forward else -abs(throttle_val)


class KinematicsState(MsgpackMixin):
    """Motion in NED; angular velocities in the body's forward, right, down."""

    fields = {"position": Vector3r, "orientation": Quaternionr, "linear_velocity": Vector3r,
              "angular_velocity": Vector3r, "linear_acceleration": Vector3r, "angular_acceleration": Vector3r}
    position: Vector3r
    orientation: Quaternionr
    linear_velocity: Vector3r
    angular_velocity: Vector3r
    linear_acceleration: Vector3r
    angular_acceleration: Vector3r


class EnvironmentState(MsgpackMixin):
    """Air and gravity at a place: m/s^2, pascal, kelvin, kg/m^3."""

    fields = {"position": Vector3r, "geo_point": GeoPoint, "gravity": Vector3r, "air_pressure": 0.0,
              "temperature": 0.0, "air_density": 0.0}
    position: Vector3r
    geo_point: GeoPoint
    gravity: Vector3r
    air_pressure: float
    temperature: float
    air_density: float


class CarState(MsgpackMixin):
    """A car, which our server does not have."""

    fields = {"speed": 0.0, "gear": 0, "rpm": 0.0, "maxrpm": 0.0, "handbrake": False, "collision": CollisionInfo,
              "kinematics_estimated": KinematicsState, "timestamp": 0}
    speed: float
    gear: int
    rpm: float
    maxrpm: float
    handbrake: bool
    collision: CollisionInfo
    kinematics_estimated: KinematicsState
    timestamp: int


class MultirotorState(MsgpackMixin):
    """A drone as its own estimator knows it; timestamp in nanoseconds."""

    fields = {"collision": CollisionInfo, "kinematics_estimated": KinematicsState, "gps_location": GeoPoint,
              "timestamp": 0, "landed_state": LandedState.Landed, "rc_data": RCData, "ready": False,
              "ready_message": "", "can_arm": False}
    collision: CollisionInfo
    kinematics_estimated: KinematicsState
    gps_location: GeoPoint
    timestamp: int
    landed_state: int
    rc_data: RCData
    ready: bool
    ready_message: str
    can_arm: bool


class RotorStates(MsgpackMixin):
    """Thrust (N), torque (N m) and speed (rad/s) of each rotor, as dictionaries."""

    fields = {"timestamp": 0, "rotors": []}
    timestamp: int
    rotors: List[Dict[str, float]]


class ProjectionMatrix(MsgpackMixin):
    """Rows of a 4 by 4 matrix."""

    fields = {"matrix": []}
    matrix: List[List[float]]


class CameraInfo(MsgpackMixin):
    """Where a camera is (NED) and its horizontal field of view, degrees."""

    fields = {"pose": Pose, "fov": -1, "proj_mat": ProjectionMatrix}
    pose: Pose
    fov: float
    proj_mat: ProjectionMatrix


class LidarData(MsgpackMixin):
    """One turn: x, y, z of each point in metres one behind the other, and the segmentation id of each."""

    fields = {"point_cloud": 0.0, "time_stamp": 0, "pose": Pose, "segmentation": 0}
    point_cloud: Union[List[float], npt.NDArray[np.float32]]
    time_stamp: int
    pose: Pose
    segmentation: Union[List[int], npt.NDArray[Any]]


class ImuData(MsgpackMixin):
    """Rotation, rad/s and m/s^2 (without gravity taken out) in the body's forward, right, down."""

    fields = {"time_stamp": 0, "orientation": Quaternionr, "angular_velocity": Vector3r,
              "linear_acceleration": Vector3r}
    time_stamp: int
    orientation: Quaternionr
    angular_velocity: Vector3r
    linear_acceleration: Vector3r


class BarometerData(MsgpackMixin):
    """Metres, pascal, and the pressure at sea level that the altitude is worked out with."""

    fields = {"time_stamp": 0, "altitude": 0.0, "pressure": 0.0, "qnh": 0.0}
    time_stamp: int
    altitude: float
    pressure: float
    qnh: float


class MagnetometerData(MsgpackMixin):
    """Gauss in the body's forward, right, down."""

    fields = {"time_stamp": 0, "magnetic_field_body": Vector3r, "magnetic_field_covariance": 0.0}
    time_stamp: int
    magnetic_field_body: Vector3r
    magnetic_field_covariance: Any


class GnssReport(MsgpackMixin):
    """Where a receiver thinks it is: standard deviations in metres, m/s in NED."""

    fields = {"geo_point": GeoPoint, "eph": 0.0, "epv": 0.0, "velocity": Vector3r, "fix_type": 0, "time_utc": 0}
    geo_point: GeoPoint
    eph: float
    epv: float
    velocity: Vector3r
    fix_type: int
    time_utc: int


class GpsData(MsgpackMixin):
    """A reading of a satellite receiver; time_stamp in nanoseconds."""

    fields = {"time_stamp": 0, "gnss": GnssReport, "is_valid": False}
    time_stamp: int
    gnss: GnssReport
    is_valid: bool


class DistanceSensorData(MsgpackMixin):
    """Metres to what is before the sensor."""

    fields = {"time_stamp": 0, "distance": 0.0, "min_distance": 0.0, "max_distance": 0.0, "relative_pose": Pose}
    time_stamp: int
    distance: float
    min_distance: float
    max_distance: float
    relative_pose: Pose


class Box2D(MsgpackMixin):
    """Corners in pixels."""

    fields = {"min": Vector2r, "max": Vector2r}
    min: Vector2r
    max: Vector2r


class Box3D(MsgpackMixin):
    """Corners in metres, in the axes of the camera."""

    fields = {"min": Vector3r, "max": Vector3r}
    min: Vector3r
    max: Vector3r


class DetectionInfo(MsgpackMixin):
    """A thing that simGetDetections has found."""

    fields = {"name": "", "geo_point": GeoPoint, "box2D": Box2D, "box3D": Box3D, "relative_pose": Pose}
    name: str
    geo_point: GeoPoint
    box2D: Box2D
    box3D: Box3D
    relative_pose: Pose


class MeshPositionVertexBuffersResponse(MsgpackMixin):
    """Triangles of a mesh: x, y, z of each vertex, three indices a triangle."""

    fields = {"position": Vector3r, "orientation": Quaternionr, "vertices": 0.0, "indices": 0.0, "name": ""}
    position: Vector3r
    orientation: Quaternionr
    vertices: List[float]
    indices: List[int]
    name: str


class PIDGains:
    """Proportional, integral and derivative gain."""

    def __init__(self, kp: float, ki: float, kd: float) -> None:
        self.kp, self.ki, self.kd = kp, ki, kd

    def to_list(self) -> List[float]:
        """kp, ki, kd."""
        return [self.kp, self.ki, self.kd]


class _ControllerGains:
    """Three axes of gains; `defaults` are their proportional, integral and derivative ones."""
    axes: ClassVar[Tuple[str, ...]] = ()
    defaults: ClassVar[Tuple[Tuple[float, float, float], ...]] = ()

    def __init__(self, *gains: PIDGains, **named: PIDGains) -> None:
        for i, (axis, default) in enumerate(zip(self.axes, self.defaults)):
            setattr(self, axis, gains[i] if i < len(gains) else named.get(axis, PIDGains(*default)))

    def to_lists(self) -> Tuple[List[float], ...]:
        """As they are sent: kp, ki and kd of all axes."""
        return tuple([getattr(getattr(self, axis), kind) for axis in self.axes] for kind in ("kp", "ki", "kd"))


class AngleRateControllerGains(_ControllerGains):
    """Gains of roll, pitch and yaw rate."""

    roll_gains: PIDGains
    pitch_gains: PIDGains
    yaw_gains: PIDGains
    axes = ("roll_gains", "pitch_gains", "yaw_gains")
    defaults = ((0.25, 0, 0),) * 3


class AngleLevelControllerGains(_ControllerGains):
    """Gains of roll, pitch and yaw."""

    roll_gains: PIDGains
    pitch_gains: PIDGains
    yaw_gains: PIDGains
    axes = ("roll_gains", "pitch_gains", "yaw_gains")
    defaults = ((2.5, 0, 0),) * 3


class VelocityControllerGains(_ControllerGains):
    """Gains of velocity along x, y, z."""

    x_gains: PIDGains
    y_gains: PIDGains
    z_gains: PIDGains
    axes = ("x_gains", "y_gains", "z_gains")
    defaults = ((0.2, 0, 0), (0.2, 0, 0), (2.0, 2.0, 0))


class PositionControllerGains(_ControllerGains):
    """Gains of position along x, y, z."""

    x_gains: PIDGains
    y_gains: PIDGains
    z_gains: PIDGains
    axes = ("x_gains", "y_gains", "z_gains")
    defaults = ((0.25, 0, 0),) * 3
