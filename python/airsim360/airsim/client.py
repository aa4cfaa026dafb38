"""Clients with AirSim's class and method names.

Most methods send their own name and arguments; the tables below define them. Those named ...Async return a Future at
once: `.join()` waits and never raises, `.get()` raises what the server has answered with.
"""
import msgpackrpc

from . import types as _types
from .lending import lend
from .types import (AngleLevelControllerGains, AngleRateControllerGains, DrivetrainType,
                    PositionControllerGains, RCData, VelocityControllerGains, YawMode)

_FOREVER = 3e38
_RED = [1.0, 0.0, 0.0, 1.0]

# Signature, and the structure of the result where it is one; [X] for a list of them.
_VEHICLE_CALLS = """
reset()
ping()
getServerVersion()
getMinRequiredClientVersion()
enableApiControl(is_enabled, vehicle_name='')
isApiControlEnabled(vehicle_name='')
armDisarm(arm, vehicle_name='')
simPause(is_paused)
simContinueForTime(seconds)
simContinueForFrames(frames)
getHomeGeoPoint(vehicle_name='') -> GeoPoint
simSetLightIntensity(light_name, intensity)
simSwapTextures(tags, tex_id=0, component_id=0, material_id=0)
simSetObjectMaterial(object_name, material_name, component_id=0)
simSetObjectMaterialFromTexture(object_name, texture_path, component_id=0)
simSetTimeOfDay(is_enabled, start_datetime='', is_start_datetime_dst=False, celestial_clock_speed=1, update_interval_secs=60, move_sun=True)
simEnableWeather(enable)
simSetWeatherParameter(param, val)
simGetPresetLensSettings(camera_name, vehicle_name='', external=False)
simGetLensSettings(camera_name, vehicle_name='', external=False)
simSetPresetLensSettings(preset_lens_settings, camera_name, vehicle_name='', external=False)
simGetPresetFilmbackSettings(camera_name, vehicle_name='', external=False)
simSetPresetFilmbackSettings(preset_filmback_settings, camera_name, vehicle_name='', external=False)
simGetFilmbackSettings(camera_name, vehicle_name='', external=False)
simSetFilmbackSettings(sensor_width, sensor_height, camera_name, vehicle_name='', external=False)
simGetFocalLength(camera_name, vehicle_name='', external=False)
simSetFocalLength(focal_length, camera_name, vehicle_name='', external=False)
simEnableManualFocus(enable, camera_name, vehicle_name='', external=False)
simGetFocusDistance(camera_name, vehicle_name='', external=False)
simSetFocusDistance(focus_distance, camera_name, vehicle_name='', external=False)
simGetFocusAperture(camera_name, vehicle_name='', external=False)
simSetFocusAperture(focus_aperture, camera_name, vehicle_name='', external=False)
simEnableFocusPlane(enable, camera_name, vehicle_name='', external=False)
simGetCurrentFieldOfView(camera_name, vehicle_name='', external=False)
simTestLineOfSightToPoint(point, vehicle_name='')
simTestLineOfSightBetweenPoints(point1, point2)
simGetWorldExtents() -> [GeoPoint]
simRunConsoleCommand(command)
simGetMeshPositionVertexBuffers() -> [MeshPositionVertexBuffersResponse]
simGetCollisionInfo(vehicle_name='') -> CollisionInfo
simSetVehiclePose(pose, ignore_collision, vehicle_name='')
simGetVehiclePose(vehicle_name='') -> Pose
simSetTraceLine(color_rgba, thickness=1.0, vehicle_name='')
simGetObjectPose(object_name) -> Pose
simSetObjectPose(object_name, pose, teleport=True)
simGetObjectScale(object_name) -> Vector3r
simSetObjectScale(object_name, scale_vector)
simListSceneObjects(name_regex='.*')
simLoadLevel(level_name)
simListAssets()
simSpawnObject(object_name, asset_name, pose, scale, physics_enabled=False, is_blueprint=False)
simDestroyObject(object_name)
simSetSegmentationObjectID(mesh_name, object_id, is_name_regex=False)
simGetSegmentationObjectID(mesh_name)
simAddDetectionFilterMeshName(camera_name, image_type, mesh_name, vehicle_name='', external=False)
simSetDetectionFilterRadius(camera_name, image_type, radius_cm, vehicle_name='', external=False)
simClearDetectionMeshNames(camera_name, image_type, vehicle_name='', external=False)
simGetDetections(camera_name, image_type, vehicle_name='', external=False) -> [DetectionInfo]
simPrintLogMessage(message, message_param='', severity=0)
simGetCameraInfo(camera_name, vehicle_name='', external=False) -> CameraInfo
simGetDistortionParams(camera_name, vehicle_name='', external=False)
simSetDistortionParam(camera_name, param_name, value, vehicle_name='', external=False)
simSetCameraPose(camera_name, pose, vehicle_name='', external=False)
simSetCameraFov(camera_name, fov_degrees, vehicle_name='', external=False)
simGetGroundTruthKinematics(vehicle_name='') -> KinematicsState
simSetKinematics(state, ignore_collision, vehicle_name='')
simGetGroundTruthEnvironment(vehicle_name='') -> EnvironmentState
getImuData(imu_name='', vehicle_name='') -> ImuData
getBarometerData(barometer_name='', vehicle_name='') -> BarometerData
getMagnetometerData(magnetometer_name='', vehicle_name='') -> MagnetometerData
getGpsData(gps_name='', vehicle_name='') -> GpsData
getDistanceSensorData(distance_sensor_name='', vehicle_name='') -> DistanceSensorData
getLidarData(lidar_name='', vehicle_name='') -> LidarData
simFlushPersistentMarkers()
simPlotPoints(points, color_rgba=_RED, size=10.0, duration=-1.0, is_persistent=False)
simPlotLineStrip(points, color_rgba=_RED, thickness=5.0, duration=-1.0, is_persistent=False)
simPlotLineList(points, color_rgba=_RED, thickness=5.0, duration=-1.0, is_persistent=False)
simPlotArrows(points_start, points_end, color_rgba=_RED, thickness=5.0, arrow_size=2.0, duration=-1.0, is_persistent=False)
simPlotStrings(strings, positions, scale=5, color_rgba=_RED, duration=-1.0)
simPlotTransforms(poses, scale=5.0, thickness=5.0, duration=-1.0, is_persistent=False)
simPlotTransformsWithNames(poses, names, tf_scale=5.0, tf_thickness=5.0, text_scale=10.0, text_color_rgba=_RED, duration=-1.0)
cancelLastTask(vehicle_name='')
startRecording()
stopRecording()
isRecording()
simSetWind(wind)
simCreateVoxelGrid(position, x, y, z, res, of)
simAddVehicle(vehicle_name, vehicle_type, pose, pawn_path='')
listVehicles()
getSettingsString()
simSetPanoramaResolution(camera_name, width, height, vehicle_name='')
simTriggerPanoramaCapture(camera_name='panorama_original', vehicle_name='')
"""

# Sent without "Async"; a minus before an argument: the server wants forward-right-down, scripts give
# forward-left-up.
_MOVES = """
takeoff(timeout_sec=20, vehicle_name='')
land(timeout_sec=60, vehicle_name='')
goHome(timeout_sec=_FOREVER, vehicle_name='')
moveByVelocityBodyFrame(vx, vy, vz, duration, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), vehicle_name='')
moveByVelocityZBodyFrame(vx, vy, z, duration, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), vehicle_name='')
moveByVelocity(vx, vy, vz, duration, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), vehicle_name='')
moveByVelocityZ(vx, vy, z, duration, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), vehicle_name='')
moveOnPath(path, velocity, timeout_sec=_FOREVER, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), lookahead=-1, adaptive_lookahead=1, vehicle_name='')
moveToPosition(x, y, z, velocity, timeout_sec=_FOREVER, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), lookahead=-1, adaptive_lookahead=1, vehicle_name='')
moveToGPS(latitude, longitude, altitude, velocity, timeout_sec=_FOREVER, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), lookahead=-1, adaptive_lookahead=1, vehicle_name='')
moveToZ(z, velocity, timeout_sec=_FOREVER, yaw_mode=YawMode(), lookahead=-1, adaptive_lookahead=1, vehicle_name='')
moveByManual(vx_max, vy_max, z_min, duration, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), vehicle_name='')
rotateToYaw(yaw, timeout_sec=_FOREVER, margin=5, vehicle_name='')
rotateByYawRate(yaw_rate, duration, vehicle_name='')
hover(vehicle_name='')
moveByMotorPWMs(front_right_pwm, rear_left_pwm, front_left_pwm, rear_right_pwm, duration, vehicle_name='')
moveByRollPitchYawZ(roll, -pitch, -yaw, z, duration, vehicle_name='')
moveByRollPitchYawThrottle(roll, -pitch, -yaw, throttle, duration, vehicle_name='')
moveByRollPitchYawrateThrottle(roll, -pitch, -yaw_rate, throttle, duration, vehicle_name='')
moveByRollPitchYawrateZ(roll, -pitch, -yaw_rate, z, duration, vehicle_name='')
moveByAngleRatesZ(roll_rate, -pitch_rate, -yaw_rate, z, duration, vehicle_name='')
moveByAngleRatesThrottle(roll_rate, -pitch_rate, -yaw_rate, throttle, duration, vehicle_name='')
"""


def _parameters(text):
    """The parts of a parameter list, at its top level."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts if part.strip()]


def _define(cls, table, suffix, body):
    """Adds a method for each line of a table."""
    for line in table.strip().splitlines():
        signature, _, result = line.partition(" -> ")
        name, _, rest = signature.partition("(")
        parameters = _parameters(rest[:-1])
        sent = [part.split("=")[0] for part in parameters]
        declared = [part.lstrip("-") for part in parameters]
        source = (f"def {name}{suffix}({', '.join(['self'] + declared)}):\n"
                  f"    return {body}(self, {name!r}, _result, ({''.join(part + ', ' for part in sent)}))\n")
        scope = {**globals(), "_result": result}
        exec(source, scope)  # pylint: disable=exec-used  # a table of this file
        method = scope[name + suffix]
        method.__doc__ = f"Sends {name}; see docs/reference/airsim_functions.md."
        method.__qualname__, method.__module__ = f"{cls.__name__}.{name}{suffix}", __name__
        setattr(cls, name + suffix, method)


def _call(self, name, result, arguments):
    answer = self.client.call(name, *arguments)
    if result.startswith("["):
        kind = getattr(_types, result[1:-1])
        return [kind.from_msgpack(item) for item in answer]
    return getattr(_types, result).from_msgpack(answer) if result else answer


def _call_async(self, name, _, arguments):
    return self.client.call_async(name, *arguments)


class VehicleClient:
    """What all vehicles and the world understand."""

    def __init__(self, ip="", port=41451, timeout_value=3600):
        self.client = msgpackrpc.Client(msgpackrpc.Address(ip or "127.0.0.1", port), timeout=timeout_value)
        self._lending, self._may_lend = None, True

    def getClientVersion(self):
        return 1

    def getMinRequiredServerVersion(self):
        return 1

    def confirmConnection(self):
        """Prints whether the server answers and the versions fit."""
        print("Connected!" if self.ping() else "Ping returned false!")
        server, least_client = self.getServerVersion(), self.getMinRequiredClientVersion()
        client, least_server = self.getClientVersion(), self.getMinRequiredServerVersion()
        print(f"Client Ver:{client} (Min Req: {least_client}), Server Ver:{server} (Min Req: {least_server})\n")
        if server < least_server:
            print("AirSim server is of older version and not supported by this client. Please upgrade!")
        elif client < least_client:
            print("AirSim client is of older version and not supported by this server. Please upgrade!")

    def simIsPause(self):
        return self.client.call("simIsPaused")

    def simGetImage(self, camera_name, image_type, vehicle_name="", external=False):
        """Bytes of a PNG; None if there is no picture."""
        picture = self.client.call("simGetImage", str(camera_name), image_type, vehicle_name, external)
        return None if picture in ("", b"", b"\0", "\0") else picture

    def simGetImages(self, requests, vehicle_name="", external=False):
        """Pictures of one instant, as a list of ImageResponse in the order of the requests."""
        pictures = None
        if any(getattr(r, "pixels_as_float", False) or not getattr(r, "compress", True) for r in requests):
            pictures = self._lent_images(requests, vehicle_name, external)
        if pictures is None:
            answer = self.client.call("simGetImages", requests, vehicle_name, external)
            pictures = [_types.ImageResponse.from_msgpack(item) for item in answer]
        return pictures

    def _lent_images(self, requests, vehicle_name, external):
        """The pictures through memory lent to the server; None where they have to come as usual."""
        if self._may_lend and self._lending is None:
            self._lending = lend(self.client.address.host, self.client.address.port)
            self._may_lend = self._lending is not None
        lending, region = self._lending, None
        if lending is not None:
            region = lending.take()
        if region is None:
            return None
        try:
            answer = self.client.call("simGetImagesLent", requests, vehicle_name, external, lending.token, region.offset,
                                      region.size)
        except msgpackrpc.error.RPCError:
            # A wrong request, which the usual call then tells of; or a server that was started anew: lent to once more.
            self._lending = None
            return None
        except BaseException:
            lending.lose(region)
            raise
        lending.wanted = max(answer["wanted"], 4096)
        return [_types.ImageResponse.from_msgpack(item, region, place) for item, place in zip(answer["images"], answer["places"])]

    def simSetDistortionParams(self, camera_name, distortion_params, vehicle_name="", external=False):
        for name, value in distortion_params.items():
            self.simSetDistortionParam(camera_name, name, value, vehicle_name, external)

    def simGetLidarSegmentation(self, lidar_name="", vehicle_name=""):
        return self.getLidarData(lidar_name, vehicle_name).segmentation


class MultirotorClient(VehicleClient):
    """Drones."""

    def moveByAngleZAsync(self, pitch, roll, z, yaw, duration, vehicle_name=""):
        return self.moveByRollPitchYawZAsync(roll, pitch, yaw, z, duration, vehicle_name)

    def moveByAngleThrottleAsync(self, pitch, roll, throttle, yaw_rate, duration, vehicle_name=""):
        return self.moveByRollPitchYawrateThrottleAsync(roll, pitch, yaw_rate, throttle, duration, vehicle_name)

    def moveByRC(self, rcdata=None, vehicle_name=""):
        return self.client.call("moveByRC", rcdata or RCData(), vehicle_name)

    def setAngleRateControllerGains(self, angle_rate_gains=None, vehicle_name=""):
        gains = (angle_rate_gains or AngleRateControllerGains()).to_lists()
        self.client.call("setAngleRateControllerGains", *gains, vehicle_name)

    def setAngleLevelControllerGains(self, angle_level_gains=None, vehicle_name=""):
        gains = (angle_level_gains or AngleLevelControllerGains()).to_lists()
        self.client.call("setAngleLevelControllerGains", *gains, vehicle_name)

    def setVelocityControllerGains(self, velocity_gains=None, vehicle_name=""):
        gains = (velocity_gains or VelocityControllerGains()).to_lists()
        self.client.call("setVelocityControllerGains", *gains, vehicle_name)

    def setPositionControllerGains(self, position_gains=None, vehicle_name=""):
        gains = (position_gains or PositionControllerGains()).to_lists()
        self.client.call("setPositionControllerGains", *gains, vehicle_name)


class CarClient(VehicleClient):
    """Cars, which our server answers with AirSim's error for."""


_define(VehicleClient, _VEHICLE_CALLS, "", "_call")
_define(MultirotorClient, _MOVES, "Async", "_call_async")
_define(MultirotorClient, """
getMultirotorState(vehicle_name='') -> MultirotorState
getRotorStates(vehicle_name='') -> RotorStates
""", "", "_call")
_define(CarClient, """
setCarControls(controls, vehicle_name='')
getCarState(vehicle_name='') -> CarState
getCarControls(vehicle_name='') -> CarControls
""", "", "_call")
