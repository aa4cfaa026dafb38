"""A client for AirSim-compatible servers with the names of AirSim's own Python client.

    import airsim360.airsim as airsim
    client = airsim.MultirotorClient()                       # a running `airsim360 serve --world W`
    client.enableApiControl(True)
    client.armDisarm(True)
    client.takeoffAsync().join()
    client.moveToPositionAsync(10, 0, -5, 3).join()          # 10 m north, 5 m up, 3 m/s
    depth, = client.simGetImages([airsim.ImageRequest("0", airsim.ImageType.DepthPlanar, True, False)])
    depth.pixels()                                            # (height, width) float32, metres

Frames are AirSim's: NED (north, east, down) in metres from the vehicle's start, bodies forward, right, down; radians but
for headings in YawMode and rotateToYaw, which are degrees. docs/reference/airsim_functions.md tells what each function does here.

Needs only NumPy and msgpack. `import airsim360.airsim as airsim` is all that an existing script has to change. Unlike
the original it raises what went wrong in `Async` calls at `.join()` only if asked to (`.get()`), as the original does,
and takes float images as bytes, so that `image_data_float` is a NumPy array at once.
"""
from .client import CarClient, MultirotorClient, VehicleClient
from .types import *  # noqa: F401,F403  (the names of AirSim's client)
from .utils import *  # noqa: F401,F403

__all__ = ["CarClient", "MultirotorClient", "VehicleClient", "ImageType", "DrivetrainType", "LandedState",
           "WeatherParameter", "GnssFixType", "Vector2r", "Vector3r", "Quaternionr", "Pose", "CollisionInfo",
           "GeoPoint", "YawMode", "RCData", "ImageRequest", "ImageResponse", "CarControls", "CarState",
           "KinematicsState", "EnvironmentState", "MultirotorState", "RotorStates", "ProjectionMatrix", "CameraInfo",
           "LidarData", "ImuData", "BarometerData", "MagnetometerData", "GnssReport", "GpsData", "DistanceSensorData",
           "Box2D", "Box3D", "DetectionInfo", "PIDGains", "AngleRateControllerGains", "AngleLevelControllerGains",
           "VelocityControllerGains", "PositionControllerGains", "MeshPositionVertexBuffersResponse", "MsgpackMixin",
           "string_to_uint8_array", "string_to_float_array", "list_to_2d_float_array", "get_pfm_array",
           "get_public_fields", "to_dict", "to_str", "write_file", "to_eularian_angles", "to_quaternion", "wait_key",
           "read_pfm", "write_pfm", "write_png"]

__version__ = "1.8.1"
