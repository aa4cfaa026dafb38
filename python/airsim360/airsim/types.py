"""AirSim's structures and enumerations. NED, metres, radians; see docs/reference/airsim_functions.md.

`fields` of a structure names its keys on the wire with their defaults; a default that is a structure is made anew for
each object.
"""
import math

import numpy as np

__all__ = [
    "ImageType", "DrivetrainType", "LandedState", "WeatherParameter", "GnssFixType", "Vector2r", "Vector3r",
    "Quaternionr", "Pose", "CollisionInfo", "GeoPoint", "YawMode", "RCData", "ImageRequest", "ImageResponse",
    "CarControls", "CarState", "KinematicsState", "EnvironmentState", "MultirotorState", "RotorStates",
    "ProjectionMatrix", "CameraInfo", "LidarData", "ImuData", "BarometerData", "MagnetometerData", "GnssReport",
    "GpsData", "DistanceSensorData", "Box2D", "Box3D", "DetectionInfo", "PIDGains", "AngleRateControllerGains",
    "AngleLevelControllerGains", "VelocityControllerGains", "PositionControllerGains",
    "MeshPositionVertexBuffersResponse", "MsgpackMixin"]


class ImageType:
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
    MaxDegreeOfFreedom = 0
    ForwardOnly = 1


class LandedState:
    Landed = 0
    Flying = 1


class WeatherParameter:
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
    GNSS_FIX_NO_FIX = 0
    GNSS_FIX_TIME_ONLY = 1
    GNSS_FIX_2D_FIX = 2
    GNSS_FIX_3D_FIX = 3


class MsgpackMixin:
    """A structure: attributes named as its keys on the wire."""
    fields = {}

    def __init__(self, **values):
        for name, default in self.fields.items():
            setattr(self, name, values.pop(name) if name in values else
                    default() if isinstance(default, type) else list(default) if isinstance(default, list) else default)
        if values:
            raise TypeError(f"{type(self).__name__} has no field {next(iter(values))!r}")

    def to_msgpack(self, *args, **kwargs):
        return vars(self)

    @classmethod
    def from_msgpack(cls, encoded):
        made = cls.__new__(cls)
        MsgpackMixin.__init__(made)
        for name, value in encoded.items():
            kind = cls.fields.get(name)
            setattr(made, name, kind.from_msgpack(value) if isinstance(value, dict) and isinstance(kind, type) else value)
        return made

    def __eq__(self, other):
        return type(self) is type(other) and vars(self) == vars(other)

    def __repr__(self):
        return f"<{type(self).__name__}> " + repr(vars(self))


class _Numbers(MsgpackMixin):
    """Structures that are a few numbers, given in their order."""

    def __init__(self, *values, **named):
        names = list(self.fields)
        if len(values) > len(names):
            raise TypeError(f"{type(self).__name__} takes at most {len(names)} numbers")
        MsgpackMixin.__init__(self, **{**dict(zip(names, values)), **named})

    def __iter__(self):
        return (getattr(self, name) for name in self.fields)

    def to_numpy_array(self):
        return np.array(list(self), dtype=np.float32)

    def containsNan(self):
        return any(math.isnan(value) for value in self)

    def _each(self, operation):
        return type(self)(*(operation(value) for value in self))


class Vector2r(_Numbers):
    fields = {"x_val": 0.0, "y_val": 0.0}


class Vector3r(_Numbers):
    fields = {"x_val": 0.0, "y_val": 0.0, "z_val": 0.0}

    @staticmethod
    def nanVector3r():
        return Vector3r(math.nan, math.nan, math.nan)

    def __add__(self, other):
        return Vector3r(*(a + b for a, b in zip(self, other)))

    def __sub__(self, other):
        return Vector3r(*(a - b for a, b in zip(self, other)))

    def __mul__(self, factor):
        return self._each(lambda value: value * factor)

    def __truediv__(self, divisor):
        return self._each(lambda value: value / divisor)

    def dot(self, other):
        return sum(a * b for a, b in zip(self, other))

    def cross(self, other):
        return Vector3r(*np.cross(list(self), list(other)).tolist())

    def get_length(self):
        return math.sqrt(self.dot(self))

    def distance_to(self, other):
        return (self - other).get_length()

    def to_Quaternionr(self):
        return Quaternionr(self.x_val, self.y_val, self.z_val, 0)


class Quaternionr(_Numbers):
    """Hamilton; the constructor takes x, y, z, w."""
    fields = {"x_val": 0.0, "y_val": 0.0, "z_val": 0.0, "w_val": 1.0}

    @staticmethod
    def nanQuaternionr():
        return Quaternionr(math.nan, math.nan, math.nan, math.nan)

    def __add__(self, other):
        return Quaternionr(*(a + b for a, b in zip(self, other)))

    def __mul__(self, other):
        a, b = Vector3r(self.x_val, self.y_val, self.z_val), Vector3r(other.x_val, other.y_val, other.z_val)
        v = b * self.w_val + a * other.w_val + a.cross(b)
        return Quaternionr(v.x_val, v.y_val, v.z_val, self.w_val * other.w_val - a.dot(b))

    def __truediv__(self, other):
        return self * other.inverse() if isinstance(other, Quaternionr) else self._each(lambda value: value / other)

    def dot(self, other):
        return sum(a * b for a, b in zip(self, other))

    def cross(self, other):
        return (self * other - other * self) / 2

    def __sub__(self, other):
        return Quaternionr(*(a - b for a, b in zip(self, other)))

    def outer_product(self, other):
        return (self.inverse() * other - other.inverse() * self) / 2

    def rotate(self, other):
        """The rotation `other` seen through this one; this must be a unit quaternion."""
        if abs(self.get_length() - 1) > 1e-3:
            raise ValueError("only a unit quaternion rotates")
        return other * self * other.inverse()

    def conjugate(self):
        return Quaternionr(-self.x_val, -self.y_val, -self.z_val, self.w_val)

    def star(self):
        return self.conjugate()

    def inverse(self):
        return self.conjugate() / self.dot(self)

    def sgn(self):
        return self / self.get_length()

    def get_length(self):
        return math.sqrt(self.dot(self))


class Pose(MsgpackMixin):
    fields = {"position": Vector3r, "orientation": Quaternionr}

    def __init__(self, position_val=None, orientation_val=None):
        MsgpackMixin.__init__(self)
        if position_val is not None:
            self.position = position_val
        if orientation_val is not None:
            self.orientation = orientation_val

    @staticmethod
    def nanPose():
        return Pose(Vector3r.nanVector3r(), Quaternionr.nanQuaternionr())

    def containsNan(self):
        return self.position.containsNan() or self.orientation.containsNan()

    def __iter__(self):
        return iter((self.position, self.orientation))


class GeoPoint(MsgpackMixin):
    fields = {"latitude": 0.0, "longitude": 0.0, "altitude": 0.0}


class CollisionInfo(MsgpackMixin):
    fields = {"has_collided": False, "normal": Vector3r, "impact_point": Vector3r, "position": Vector3r,
              "penetration_depth": 0.0, "time_stamp": 0.0, "object_name": "", "object_id": -1}


class YawMode(MsgpackMixin):
    """Degrees, or degrees per second."""
    fields = {"is_rate": True, "yaw_or_rate": 0.0}

    def __init__(self, is_rate=True, yaw_or_rate=0.0):
        MsgpackMixin.__init__(self, is_rate=is_rate, yaw_or_rate=yaw_or_rate)


class RCData(_Numbers):
    fields = {"timestamp": 0, "pitch": 0.0, "roll": 0.0, "throttle": 0.0, "yaw": 0.0, "switch1": 0, "switch2": 0,
              "switch3": 0, "switch4": 0, "switch5": 0, "switch6": 0, "switch7": 0, "switch8": 0,
              "is_initialized": False, "is_valid": False}


class ImageRequest(MsgpackMixin):
    fields = {"camera_name": "0", "image_type": ImageType.Scene, "pixels_as_float": False, "compress": True,
              "annotation_name": "", "binary_float": True}

    def __init__(self, camera_name, image_type, pixels_as_float=False, compress=True, annotation_name=""):
        MsgpackMixin.__init__(self, camera_name=str(camera_name), image_type=image_type,
                              pixels_as_float=pixels_as_float, compress=compress, annotation_name=annotation_name)


class ImageResponse(MsgpackMixin):
    """`image_data_uint8`: bytes, B, G, R per pixel or a PNG. `image_data_float`: float32 array of width * height."""
    fields = {"image_data_uint8": b"", "image_data_float": 0.0, "camera_name": "", "camera_position": Vector3r,
              "camera_orientation": Quaternionr, "time_stamp": 0, "message": "", "pixels_as_float": 0.0,
              "compress": True, "width": 0, "height": 0, "image_type": ImageType.Scene, "annotation_name": ""}

    @classmethod
    def from_msgpack(cls, encoded, region=None, place=(0, 0)):
        """`region`, `place` (offset, size): where the pixels lie in lent memory, if they do."""
        made = super().from_msgpack(encoded)
        if place[1] > 0:
            if made.pixels_as_float:
                made.image_data_float = region.view(*place, "<f4")
            else:
                made._lent = region.view(*place, np.uint8)
                del made.image_data_uint8
        elif isinstance(made.image_data_float, bytes):
            made.image_data_float = np.frombuffer(made.image_data_float, dtype="<f4")
        return made

    def __getattr__(self, name):
        # Bytes are made of lent memory when somebody asks for them.
        if name != "image_data_uint8" or "_lent" not in vars(self):
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
        self.image_data_uint8 = self._lent.tobytes()
        del self._lent
        return self.image_data_uint8

    def pixels(self):
        """The picture as a read-only array, without a copy: (height, width, 3) uint8, or float32 (height, width), flow
        (height, width, 2). ValueError for a PNG."""
        if self.pixels_as_float:
            flat, channels = np.asarray(self.image_data_float, np.float32), ()
        elif self.compress:
            raise ValueError("pixels(): the picture is a PNG; ask for compress=False")
        else:
            flat, channels = vars(self).get("_lent"), (3,)
            if flat is None:
                flat = np.frombuffer(self.image_data_uint8, np.uint8)
        if flat.size == 2 * self.width * self.height:
            channels = (2,)
        return flat.reshape(self.height, self.width, *channels)

    def __getstate__(self):
        return self.to_msgpack()

    def to_msgpack(self, *args, **kwargs):
        self.image_data_uint8  # pylint: disable=pointless-statement  # made of lent memory
        return vars(self)

    def __eq__(self, other):
        return type(self) is type(other) and all(
            np.array_equal(value, getattr(other, name)) for name, value in self.to_msgpack().items())

    def __repr__(self):
        return f"<{type(self).__name__}> " + repr(self.to_msgpack())


class CarControls(_Numbers):
    fields = {"throttle": 0.0, "steering": 0.0, "brake": 0.0, "handbrake": False, "is_manual_gear": False,
              "manual_gear": 0, "gear_immediate": True}

    def set_throttle(self, throttle_val, forward):
        self.is_manual_gear = not forward
        self.manual_gear = 0 if forward else -1
        self.throttle = throttle_val if forward else -abs(throttle_val)


class KinematicsState(MsgpackMixin):
    fields = {"position": Vector3r, "orientation": Quaternionr, "linear_velocity": Vector3r,
              "angular_velocity": Vector3r, "linear_acceleration": Vector3r, "angular_acceleration": Vector3r}


class EnvironmentState(MsgpackMixin):
    fields = {"position": Vector3r, "geo_point": GeoPoint, "gravity": Vector3r, "air_pressure": 0.0,
              "temperature": 0.0, "air_density": 0.0}


class CarState(MsgpackMixin):
    fields = {"speed": 0.0, "gear": 0, "rpm": 0.0, "maxrpm": 0.0, "handbrake": False, "collision": CollisionInfo,
              "kinematics_estimated": KinematicsState, "timestamp": 0}


class MultirotorState(MsgpackMixin):
    fields = {"collision": CollisionInfo, "kinematics_estimated": KinematicsState, "gps_location": GeoPoint,
              "timestamp": 0, "landed_state": LandedState.Landed, "rc_data": RCData, "ready": False,
              "ready_message": "", "can_arm": False}


class RotorStates(MsgpackMixin):
    fields = {"timestamp": 0, "rotors": []}


class ProjectionMatrix(MsgpackMixin):
    fields = {"matrix": []}


class CameraInfo(MsgpackMixin):
    fields = {"pose": Pose, "fov": -1, "proj_mat": ProjectionMatrix}


class LidarData(MsgpackMixin):
    fields = {"point_cloud": 0.0, "time_stamp": 0, "pose": Pose, "segmentation": 0}


class ImuData(MsgpackMixin):
    fields = {"time_stamp": 0, "orientation": Quaternionr, "angular_velocity": Vector3r,
              "linear_acceleration": Vector3r}


class BarometerData(MsgpackMixin):
    fields = {"time_stamp": 0, "altitude": 0.0, "pressure": 0.0, "qnh": 0.0}


class MagnetometerData(MsgpackMixin):
    fields = {"time_stamp": 0, "magnetic_field_body": Vector3r, "magnetic_field_covariance": 0.0}


class GnssReport(MsgpackMixin):
    fields = {"geo_point": GeoPoint, "eph": 0.0, "epv": 0.0, "velocity": Vector3r, "fix_type": 0, "time_utc": 0}


class GpsData(MsgpackMixin):
    fields = {"time_stamp": 0, "gnss": GnssReport, "is_valid": False}


class DistanceSensorData(MsgpackMixin):
    fields = {"time_stamp": 0, "distance": 0.0, "min_distance": 0.0, "max_distance": 0.0, "relative_pose": Pose}


class Box2D(MsgpackMixin):
    fields = {"min": Vector2r, "max": Vector2r}


class Box3D(MsgpackMixin):
    fields = {"min": Vector3r, "max": Vector3r}


class DetectionInfo(MsgpackMixin):
    fields = {"name": "", "geo_point": GeoPoint, "box2D": Box2D, "box3D": Box3D, "relative_pose": Pose}


class MeshPositionVertexBuffersResponse(MsgpackMixin):
    fields = {"position": Vector3r, "orientation": Quaternionr, "vertices": 0.0, "indices": 0.0, "name": ""}


class PIDGains:
    def __init__(self, kp, ki, kd):
        self.kp, self.ki, self.kd = kp, ki, kd

    def to_list(self):
        return [self.kp, self.ki, self.kd]


class _ControllerGains:
    """Three axes of gains; `defaults` are their proportional, integral and derivative ones."""
    axes, defaults = (), ()

    def __init__(self, *gains, **named):
        for i, (axis, default) in enumerate(zip(self.axes, self.defaults)):
            setattr(self, axis, gains[i] if i < len(gains) else named.get(axis, PIDGains(*default)))

    def to_lists(self):
        return tuple([getattr(getattr(self, axis), kind) for axis in self.axes] for kind in ("kp", "ki", "kd"))


class AngleRateControllerGains(_ControllerGains):
    axes = ("roll_gains", "pitch_gains", "yaw_gains")
    defaults = ((0.25, 0, 0),) * 3


class AngleLevelControllerGains(_ControllerGains):
    axes = ("roll_gains", "pitch_gains", "yaw_gains")
    defaults = ((2.5, 0, 0),) * 3


class VelocityControllerGains(_ControllerGains):
    axes = ("x_gains", "y_gains", "z_gains")
    defaults = ((0.2, 0, 0), (0.2, 0, 0), (2.0, 2.0, 0))


class PositionControllerGains(_ControllerGains):
    axes = ("x_gains", "y_gains", "z_gains")
    defaults = ((0.25, 0, 0),) * 3
