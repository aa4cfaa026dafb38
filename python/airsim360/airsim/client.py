"""Clients with AirSim's class and method names.

Most methods send their own name and arguments; the tables below define them, and client.pyi has their types
(tools/write_airsim_stub.py makes it of the tables). NED: north, east, down, metres, radians, from the vehicle's start. Those named ...Async return a Future at
once: `.join()` waits and never raises, `.get()` raises what the server has answered with.
"""
import msgpackrpc

from . import types as _types
from .lending import lend
from .types import (AngleLevelControllerGains, AngleRateControllerGains, DrivetrainType,
                    PositionControllerGains, RCData, VelocityControllerGains, YawMode)

_FOREVER = 3e38
_RED = [1.0, 0.0, 0.0, 1.0]

# Signature, the structure of the result where it is one ([X] for a list of them), what the call does.
_VEHICLE_CALLS = """
reset()  # Puts every vehicle, moved object and the weather back as they were at the start; disarms and takes API control away.
ping()  # True where a server answers.
getServerVersion()  # Version of the server's interface.
getMinRequiredClientVersion()  # The least version of a client that it talks to.
enableApiControl(is_enabled, vehicle_name='')  # Lets this API fly a vehicle, or no longer.
isApiControlEnabled(vehicle_name='')  # Whether it may.
armDisarm(arm, vehicle_name='')  # Starts or stops the rotors; False without API control.
simPause(is_paused)  # Stops simulated time, or lets it go on.
simContinueForTime(seconds)  # Lets so many simulated seconds pass, then pauses.
simContinueForFrames(frames)  # Lets so many frames of 20 ms pass, then pauses.
getHomeGeoPoint(vehicle_name='') -> GeoPoint  # Where the vehicle started, degrees and metres.
simSetLightIntensity(light_name, intensity)  # False: our worlds have no lights by name.
simSwapTextures(tags, tex_id=0, component_id=0, material_id=0)  # Names of the objects that got another texture.
simSetObjectMaterial(object_name, material_name, component_id=0)  # Whether an object got another material.
simSetObjectMaterialFromTexture(object_name, texture_path, component_id=0)  # Whether an object got a material made of a picture.
simSetTimeOfDay(is_enabled, start_datetime='', is_start_datetime_dst=False, celestial_clock_speed=1, update_interval_secs=60, move_sun=True)  # Sets date and time of the sun ("2026-06-21 12:00:00") and how fast it moves.
simEnableWeather(enable)  # Lets the weather parameters count, or not.
simSetWeatherParameter(param, val)  # Sets a WeatherParameter, 0 ... 1.
simGetPresetLensSettings(camera_name, vehicle_name='', external=False)  # Names of lenses.
simGetLensSettings(camera_name, vehicle_name='', external=False)  # The lens in words.
simSetPresetLensSettings(preset_lens_settings, camera_name, vehicle_name='', external=False)  # Takes a lens by name.
simGetPresetFilmbackSettings(camera_name, vehicle_name='', external=False)  # Names of sensors.
simSetPresetFilmbackSettings(preset_filmback_settings, camera_name, vehicle_name='', external=False)  # Takes a sensor by name.
simGetFilmbackSettings(camera_name, vehicle_name='', external=False)  # The sensor in words.
simSetFilmbackSettings(sensor_width, sensor_height, camera_name, vehicle_name='', external=False)  # Width and height of the sensor, mm; returns the field of view.
simGetFocalLength(camera_name, vehicle_name='', external=False)  # mm.
simSetFocalLength(focal_length, camera_name, vehicle_name='', external=False)  # mm.
simEnableManualFocus(enable, camera_name, vehicle_name='', external=False)  # Manual focus on or off.
simGetFocusDistance(camera_name, vehicle_name='', external=False)  # Of the camera's focus.
simSetFocusDistance(focus_distance, camera_name, vehicle_name='', external=False)  # Of the camera's focus.
simGetFocusAperture(camera_name, vehicle_name='', external=False)  # F-number.
simSetFocusAperture(focus_aperture, camera_name, vehicle_name='', external=False)  # F-number.
simEnableFocusPlane(enable, camera_name, vehicle_name='', external=False)  # Shows the plane of focus, or not.
simGetCurrentFieldOfView(camera_name, vehicle_name='', external=False)  # Horizontal field of view, degrees.
simTestLineOfSightToPoint(point, vehicle_name='')  # Whether nothing is between the vehicle and a GeoPoint.
simTestLineOfSightBetweenPoints(point1, point2)  # Whether nothing is between two GeoPoints.
simGetWorldExtents() -> [GeoPoint]  # Two corners of the world.
simRunConsoleCommand(command)  # False: there is no engine's console.
simGetMeshPositionVertexBuffers() -> [MeshPositionVertexBuffersResponse]  # Meshes as triangles.
simGetCollisionInfo(vehicle_name='') -> CollisionInfo  # The last collision; has_collided is told once.
simSetVehiclePose(pose, ignore_collision, vehicle_name='')  # Puts a vehicle somewhere, at once.
simGetVehiclePose(vehicle_name='') -> Pose  # Where a vehicle is, from its start.
simSetTraceLine(color_rgba, thickness=1.0, vehicle_name='')  # Colour of the line behind a vehicle.
simGetObjectPose(object_name) -> Pose  # Middle of an object's bounds; NaN for an unknown name.
simSetObjectPose(object_name, pose, teleport=True)  # Moves an object that has a mesh of its own; whether that was possible.
simGetObjectScale(object_name) -> Vector3r  # Size factors of an object.
simSetObjectScale(object_name, scale_vector)  # Sets them; whether that was possible.
simListSceneObjects(name_regex='.*')  # Names of objects that match a regular expression.
simLoadLevel(level_name)  # Whether another world was loaded.
simListAssets()  # Names that simSpawnObject takes.
simSpawnObject(object_name, asset_name, pose, scale, physics_enabled=False, is_blueprint=False)  # Puts a new object in the world; returns the name that it got.
simDestroyObject(object_name)  # Takes an object away; whether there was one.
simSetSegmentationObjectID(mesh_name, object_id, is_name_regex=False)  # Sets the id that Segmentation shows for objects by name or regular expression; whether any matched.
simGetSegmentationObjectID(mesh_name)  # The id that Segmentation shows; -1 for an unknown name.
simAddDetectionFilterMeshName(camera_name, image_type, mesh_name, vehicle_name='', external=False)  # Lets a camera detect objects by name, with * and ?.
simSetDetectionFilterRadius(camera_name, image_type, radius_cm, vehicle_name='', external=False)  # Detects no further than so many centimetres.
simClearDetectionMeshNames(camera_name, image_type, vehicle_name='', external=False)  # Detects nothing any more.
simGetDetections(camera_name, image_type, vehicle_name='', external=False) -> [DetectionInfo]  # Boxes of the objects that a camera sees and its filter lets through.
simPrintLogMessage(message, message_param='', severity=0)  # Writes to the server's log.
simGetCameraInfo(camera_name, vehicle_name='', external=False) -> CameraInfo  # Where a camera is and how wide it sees.
simGetDistortionParams(camera_name, vehicle_name='', external=False)  # K1, K2, K3, P1, P2.
simSetDistortionParam(camera_name, param_name, value, vehicle_name='', external=False)  # One of K1, K2, K3, P1, P2; pictures are not distorted.
simSetCameraPose(camera_name, pose, vehicle_name='', external=False)  # Where a camera sits on its vehicle.
simSetCameraFov(camera_name, fov_degrees, vehicle_name='', external=False)  # Horizontal field of view, degrees.
simGetGroundTruthKinematics(vehicle_name='') -> KinematicsState  # How a vehicle moves, without any error.
simSetKinematics(state, ignore_collision, vehicle_name='')  # Sets how a vehicle moves, at once.
simGetGroundTruthEnvironment(vehicle_name='') -> EnvironmentState  # Air and gravity where a vehicle is.
getImuData(imu_name='', vehicle_name='') -> ImuData  # The last reading of an inertial unit; "" = the first one, as below.
getBarometerData(barometer_name='', vehicle_name='') -> BarometerData  # The last reading of a barometer.
getMagnetometerData(magnetometer_name='', vehicle_name='') -> MagnetometerData  # The last reading of a magnetometer.
getGpsData(gps_name='', vehicle_name='') -> GpsData  # The last reading of a satellite receiver.
getDistanceSensorData(distance_sensor_name='', vehicle_name='') -> DistanceSensorData  # The last reading of a distance sensor.
getLidarData(lidar_name='', vehicle_name='') -> LidarData  # The last turn of a lidar.
simFlushPersistentMarkers()  # Takes away what was plotted to stay.
simPlotPoints(points, color_rgba=_RED, size=10.0, duration=-1.0, is_persistent=False)  # Draws points.
simPlotLineStrip(points, color_rgba=_RED, thickness=5.0, duration=-1.0, is_persistent=False)  # Draws a polyline.
simPlotLineList(points, color_rgba=_RED, thickness=5.0, duration=-1.0, is_persistent=False)  # Draws a line between each two points.
simPlotArrows(points_start, points_end, color_rgba=_RED, thickness=5.0, arrow_size=2.0, duration=-1.0, is_persistent=False)  # Draws arrows.
simPlotStrings(strings, positions, scale=5, color_rgba=_RED, duration=-1.0)  # Writes words at places.
simPlotTransforms(poses, scale=5.0, thickness=5.0, duration=-1.0, is_persistent=False)  # Draws axes.
simPlotTransformsWithNames(poses, names, tf_scale=5.0, tf_thickness=5.0, text_scale=10.0, text_color_rgba=_RED, duration=-1.0)  # Draws axes with names.
cancelLastTask(vehicle_name='')  # Ends the move that is under way.
startRecording()  # Begins to record as the settings say.
stopRecording()  # Ends the recording.
isRecording()  # Whether it records.
simSetWind(wind)  # Mean velocity of the air, m/s in NED.
simCreateVoxelGrid(position, x, y, z, res, of)  # Writes the world as a .binvox file: x, y, z metres of size and res metres a cell, about a position.
simAddVehicle(vehicle_name, vehicle_type, pose, pawn_path='')  # Adds a drone; whether that was possible.
listVehicles()  # Names of the vehicles.
getSettingsString()  # The server's settings.json as text.
simSetPanoramaResolution(camera_name, width, height, vehicle_name='')  # Pixels of a panoramic camera.
simTriggerPanoramaCapture(camera_name='panorama_original', vehicle_name='')  # Takes the panoramas of this instant, for the next simGetImages.
"""

# Sent without "Async"; a minus before an argument: the server wants forward-right-down, scripts give
# forward-left-up.
_MOVES = """
takeoff(timeout_sec=20, vehicle_name='')  # Rises by 2 m.
land(timeout_sec=60, vehicle_name='')  # Descends until it stands.
goHome(timeout_sec=_FOREVER, vehicle_name='')  # Flies back to its start.
moveByVelocityBodyFrame(vx, vy, vz, duration, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), vehicle_name='')  # Flies with a velocity, m/s forward, right, down, for `duration` seconds.
moveByVelocityZBodyFrame(vx, vy, z, duration, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), vehicle_name='')  # The same along the ground, at height z.
moveByVelocity(vx, vy, vz, duration, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), vehicle_name='')  # Flies with a velocity, m/s north, east, down, for `duration` seconds.
moveByVelocityZ(vx, vy, z, duration, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), vehicle_name='')  # The same along the ground, at height z.
moveOnPath(path, velocity, timeout_sec=_FOREVER, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), lookahead=-1, adaptive_lookahead=1, vehicle_name='')  # Flies along points (a list of Vector3r) at `velocity` m/s; lookahead in metres, -1 = by the velocity.
moveToPosition(x, y, z, velocity, timeout_sec=_FOREVER, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), lookahead=-1, adaptive_lookahead=1, vehicle_name='')  # Flies to x, y, z at `velocity` m/s.
moveToGPS(latitude, longitude, altitude, velocity, timeout_sec=_FOREVER, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), lookahead=-1, adaptive_lookahead=1, vehicle_name='')  # Flies to degrees and metres over the ellipsoid at `velocity` m/s.
moveToZ(z, velocity, timeout_sec=_FOREVER, yaw_mode=YawMode(), lookahead=-1, adaptive_lookahead=1, vehicle_name='')  # Flies to a height at `velocity` m/s.
moveByManual(vx_max, vy_max, z_min, duration, drivetrain=DrivetrainType.MaxDegreeOfFreedom, yaw_mode=YawMode(), vehicle_name='')  # Flies as a remote control says, within these limits, for `duration` seconds.
rotateToYaw(yaw, timeout_sec=_FOREVER, margin=5, vehicle_name='')  # Turns to a heading, degrees, to within `margin` degrees.
rotateByYawRate(yaw_rate, duration, vehicle_name='')  # Turns at degrees a second for `duration` seconds.
hover(vehicle_name='')  # Stays where it is.
moveByMotorPWMs(front_right_pwm, rear_left_pwm, front_left_pwm, rear_right_pwm, duration, vehicle_name='')  # Sets each rotor's signal, 0 ... 1, for `duration` seconds.
moveByRollPitchYawZ(roll, -pitch, -yaw, z, duration, vehicle_name='')  # Holds angles (radians; forward, left, up) at height z for `duration` seconds.
moveByRollPitchYawThrottle(roll, -pitch, -yaw, throttle, duration, vehicle_name='')  # Holds angles with a throttle of 0 ... 1.
moveByRollPitchYawrateThrottle(roll, -pitch, -yaw_rate, throttle, duration, vehicle_name='')  # Holds roll and pitch and turns at radians a second, with a throttle of 0 ... 1.
moveByRollPitchYawrateZ(roll, -pitch, -yaw_rate, z, duration, vehicle_name='')  # The same at height z.
moveByAngleRatesZ(roll_rate, -pitch_rate, -yaw_rate, z, duration, vehicle_name='')  # Turns about its axes (rad/s; forward, left, up) at height z.
moveByAngleRatesThrottle(roll_rate, -pitch_rate, -yaw_rate, throttle, duration, vehicle_name='')  # The same with a throttle of 0 ... 1.
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
        call, _, meaning = line.partition("  # ")
        signature, _, result = call.partition(" -> ")
        name, _, rest = signature.partition("(")
        parameters = _parameters(rest[:-1])
        sent = [part.split("=")[0] for part in parameters]
        declared = [part.lstrip("-") for part in parameters]
        source = (f"def {name}{suffix}({', '.join(['self'] + declared)}):\n"
                  f"    return {body}(self, {name!r}, _result, ({''.join(part + ', ' for part in sent)}))\n")
        scope = {**globals(), "_result": result}
        exec(source, scope)  # pylint: disable=exec-used  # a table of this file
        method = scope[name + suffix]
        method.__doc__ = meaning
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
    """What all vehicles and the world understand. ip "": this machine; timeout_value: seconds for an answer.

    `client` is the msgpackrpc.Client, for functions without a method here. Errors of the server are
    msgpackrpc.error.RPCError, a lost connection TransportError.
    """

    def __init__(self, ip="", port=41451, timeout_value=3600):
        self.client = msgpackrpc.Client(msgpackrpc.Address(ip or "127.0.0.1", port), timeout=timeout_value)
        self._lending, self._may_lend = None, True

    def getClientVersion(self):
        """Version of this client's interface."""
        return 1

    def getMinRequiredServerVersion(self):
        """The least version of a server that it talks to."""
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
        """Whether simulated time stands still."""
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
        """Several of K1, K2, K3, P1, P2, from a dictionary; pictures are not distorted."""
        for name, value in distortion_params.items():
            self.simSetDistortionParam(camera_name, name, value, vehicle_name, external)

    def simGetLidarSegmentation(self, lidar_name="", vehicle_name=""):
        """Segmentation id of each point of the last turn."""
        return self.getLidarData(lidar_name, vehicle_name).segmentation


class MultirotorClient(VehicleClient):
    """Drones. Moves end with True, or False where another one has taken over (`.join()` waits)."""

    def moveByAngleZAsync(self, pitch, roll, z, yaw, duration, vehicle_name=""):
        """As moveByRollPitchYawZAsync, in an older order."""
        return self.moveByRollPitchYawZAsync(roll, pitch, yaw, z, duration, vehicle_name)

    def moveByAngleThrottleAsync(self, pitch, roll, throttle, yaw_rate, duration, vehicle_name=""):
        """As moveByRollPitchYawrateThrottleAsync, in an older order."""
        return self.moveByRollPitchYawrateThrottleAsync(roll, pitch, yaw_rate, throttle, duration, vehicle_name)

    def moveByRC(self, rcdata=None, vehicle_name=""):
        """Flies as a remote control says, until told otherwise."""
        return self.client.call("moveByRC", rcdata or RCData(), vehicle_name)

    def setAngleRateControllerGains(self, angle_rate_gains=None, vehicle_name=""):
        """Gains of the controller of angular velocity; None: its own."""
        gains = (angle_rate_gains or AngleRateControllerGains()).to_lists()
        self.client.call("setAngleRateControllerGains", *gains, vehicle_name)

    def setAngleLevelControllerGains(self, angle_level_gains=None, vehicle_name=""):
        """Gains of the controller of angles; None: its own."""
        gains = (angle_level_gains or AngleLevelControllerGains()).to_lists()
        self.client.call("setAngleLevelControllerGains", *gains, vehicle_name)

    def setVelocityControllerGains(self, velocity_gains=None, vehicle_name=""):
        """Gains of the controller of velocity; None: its own."""
        gains = (velocity_gains or VelocityControllerGains()).to_lists()
        self.client.call("setVelocityControllerGains", *gains, vehicle_name)

    def setPositionControllerGains(self, position_gains=None, vehicle_name=""):
        """Gains of the controller of position; None: its own."""
        gains = (position_gains or PositionControllerGains()).to_lists()
        self.client.call("setPositionControllerGains", *gains, vehicle_name)


class CarClient(VehicleClient):
    """Cars, which our server answers with AirSim's error for."""


_define(VehicleClient, _VEHICLE_CALLS, "", "_call")
_define(MultirotorClient, _MOVES, "Async", "_call_async")
_define(MultirotorClient, """
getMultirotorState(vehicle_name='') -> MultirotorState  # The drone as its estimator knows it.
getRotorStates(vehicle_name='') -> RotorStates  # Thrust, torque and speed of each rotor.
""", "", "_call")
_define(CarClient, """
setCarControls(controls, vehicle_name='')  # What the driver does.
getCarState(vehicle_name='') -> CarState  # How the car moves.
getCarControls(vehicle_name='') -> CarControls  # What the driver does.
""", "", "_call")
