# Made by tools/write_airsim_stub.py of the tables of client.py; do not edit.
from typing import Sequence

from msgpackrpc import Client, Future

from .types import (AngleLevelControllerGains, AngleRateControllerGains, BarometerData, CameraInfo, CarControls,
                    CarState, CollisionInfo, DetectionInfo, DistanceSensorData, EnvironmentState, GeoPoint, GpsData,
                    ImageRequest, ImageResponse, ImuData, KinematicsState, LidarData, MagnetometerData,
                    MeshPositionVertexBuffersResponse, MultirotorState, Pose, PositionControllerGains, RCData,
                    RotorStates, Vector3r, VelocityControllerGains, YawMode)

class VehicleClient:
    """What all vehicles and the world understand. ip "": this machine; timeout_value: seconds for an answer.

    `client` is the msgpackrpc.Client, for functions without a method here. Errors of the server are
    msgpackrpc.error.RPCError, a lost connection TransportError.
    """

    client: Client
    def __init__(self, ip: str = '', port: int = 41451, timeout_value: float = 3600) -> None:
        ...
    def getClientVersion(self) -> int:
        """Version of this client's interface."""
    def getMinRequiredServerVersion(self) -> int:
        """The least version of a server that it talks to."""
    def confirmConnection(self) -> None:
        """Prints whether the server answers and the versions fit."""
    def simIsPause(self) -> bool:
        """Whether simulated time stands still."""
    def simGetImage(self, camera_name: str | int, image_type: int, vehicle_name: str = '',
                    external: bool = False) -> bytes | None:
        """Bytes of a PNG; None if there is no picture."""
    def simGetImages(self, requests: Sequence[ImageRequest], vehicle_name: str = '',
                     external: bool = False) -> list[ImageResponse]:
        """Pictures of one instant, as a list of ImageResponse in the order of the requests."""
    def simSetDistortionParams(self, camera_name: str | int, distortion_params: dict[str, float],
                               vehicle_name: str = '', external: bool = False) -> None:
        """Several of K1, K2, K3, P1, P2, from a dictionary; pictures are not distorted."""
    def simGetLidarSegmentation(self, lidar_name: str = '', vehicle_name: str = '') -> list[int]:
        """Segmentation id of each point of the last turn."""
    def reset(self) -> None:
        """Puts every vehicle, moved object and the weather back as they were at the start; disarms and takes API control away."""
    def ping(self) -> bool:
        """True where a server answers."""
    def getServerVersion(self) -> int:
        """Version of the server's interface."""
    def getMinRequiredClientVersion(self) -> int:
        """The least version of a client that it talks to."""
    def enableApiControl(self, is_enabled: bool, vehicle_name: str = '') -> None:
        """Lets this API fly a vehicle, or no longer."""
    def isApiControlEnabled(self, vehicle_name: str = '') -> bool:
        """Whether it may."""
    def armDisarm(self, arm: bool, vehicle_name: str = '') -> bool:
        """Starts or stops the rotors; False without API control."""
    def simPause(self, is_paused: bool) -> None:
        """Stops simulated time, or lets it go on."""
    def simContinueForTime(self, seconds: float) -> None:
        """Lets so many simulated seconds pass, then pauses."""
    def simContinueForFrames(self, frames: int) -> None:
        """Lets so many frames of 20 ms pass, then pauses."""
    def getHomeGeoPoint(self, vehicle_name: str = '') -> GeoPoint:
        """Where the vehicle started, degrees and metres."""
    def simSetLightIntensity(self, light_name: str, intensity: float) -> bool:
        """False: our worlds have no lights by name."""
    def simSwapTextures(self, tags: str | list[str], tex_id: int = 0, component_id: int = 0,
                        material_id: int = 0) -> list[str]:
        """Names of the objects that got another texture."""
    def simSetObjectMaterial(self, object_name: str, material_name: str, component_id: int = 0) -> bool:
        """Whether an object got another material."""
    def simSetObjectMaterialFromTexture(self, object_name: str, texture_path: str, component_id: int = 0) -> bool:
        """Whether an object got a material made of a picture."""
    def simSetTimeOfDay(self, is_enabled: bool, start_datetime: str = '', is_start_datetime_dst: bool = False,
                        celestial_clock_speed: float = 1, update_interval_secs: float = 60,
                        move_sun: bool = True) -> None:
        """Sets date and time of the sun ("2026-06-21 12:00:00") and how fast it moves."""
    def simEnableWeather(self, enable: bool) -> None:
        """Lets the weather parameters count, or not."""
    def simSetWeatherParameter(self, param: int, val: float) -> None:
        """Sets a WeatherParameter, 0 ... 1."""
    def simGetPresetLensSettings(self, camera_name: str | int, vehicle_name: str = '',
                                 external: bool = False) -> list[str]:
        """Names of lenses."""
    def simGetLensSettings(self, camera_name: str | int, vehicle_name: str = '', external: bool = False) -> str:
        """The lens in words."""
    def simSetPresetLensSettings(self, preset_lens_settings: str, camera_name: str | int, vehicle_name: str = '',
                                 external: bool = False) -> None:
        """Takes a lens by name."""
    def simGetPresetFilmbackSettings(self, camera_name: str | int, vehicle_name: str = '',
                                     external: bool = False) -> list[str]:
        """Names of sensors."""
    def simSetPresetFilmbackSettings(self, preset_filmback_settings: str, camera_name: str | int,
                                     vehicle_name: str = '', external: bool = False) -> None:
        """Takes a sensor by name."""
    def simGetFilmbackSettings(self, camera_name: str | int, vehicle_name: str = '', external: bool = False) -> str:
        """The sensor in words."""
    def simSetFilmbackSettings(self, sensor_width: float, sensor_height: float, camera_name: str | int,
                               vehicle_name: str = '', external: bool = False) -> float:
        """Width and height of the sensor, mm; returns the field of view."""
    def simGetFocalLength(self, camera_name: str | int, vehicle_name: str = '', external: bool = False) -> float:
        """mm."""
    def simSetFocalLength(self, focal_length: float, camera_name: str | int, vehicle_name: str = '',
                          external: bool = False) -> None:
        """mm."""
    def simEnableManualFocus(self, enable: bool, camera_name: str | int, vehicle_name: str = '',
                             external: bool = False) -> None:
        """Manual focus on or off."""
    def simGetFocusDistance(self, camera_name: str | int, vehicle_name: str = '', external: bool = False) -> float:
        """Of the camera's focus."""
    def simSetFocusDistance(self, focus_distance: float, camera_name: str | int, vehicle_name: str = '',
                            external: bool = False) -> None:
        """Of the camera's focus."""
    def simGetFocusAperture(self, camera_name: str | int, vehicle_name: str = '', external: bool = False) -> float:
        """F-number."""
    def simSetFocusAperture(self, focus_aperture: float, camera_name: str | int, vehicle_name: str = '',
                            external: bool = False) -> None:
        """F-number."""
    def simEnableFocusPlane(self, enable: bool, camera_name: str | int, vehicle_name: str = '',
                            external: bool = False) -> None:
        """Shows the plane of focus, or not."""
    def simGetCurrentFieldOfView(self, camera_name: str | int, vehicle_name: str = '', external: bool = False) -> float:
        """Horizontal field of view, degrees."""
    def simTestLineOfSightToPoint(self, point: GeoPoint, vehicle_name: str = '') -> bool:
        """Whether nothing is between the vehicle and a GeoPoint."""
    def simTestLineOfSightBetweenPoints(self, point1: GeoPoint, point2: GeoPoint) -> bool:
        """Whether nothing is between two GeoPoints."""
    def simGetWorldExtents(self) -> list[GeoPoint]:
        """Two corners of the world."""
    def simRunConsoleCommand(self, command: str) -> bool:
        """False: there is no engine's console."""
    def simGetMeshPositionVertexBuffers(self) -> list[MeshPositionVertexBuffersResponse]:
        """Meshes as triangles."""
    def simGetCollisionInfo(self, vehicle_name: str = '') -> CollisionInfo:
        """The last collision; has_collided is told once."""
    def simSetVehiclePose(self, pose: Pose, ignore_collision: bool, vehicle_name: str = '') -> None:
        """Puts a vehicle somewhere, at once."""
    def simGetVehiclePose(self, vehicle_name: str = '') -> Pose:
        """Where a vehicle is, from its start."""
    def simSetTraceLine(self, color_rgba: Sequence[float], thickness: float = 1.0, vehicle_name: str = '') -> None:
        """Colour of the line behind a vehicle."""
    def simGetObjectPose(self, object_name: str) -> Pose:
        """Middle of an object's bounds; NaN for an unknown name."""
    def simSetObjectPose(self, object_name: str, pose: Pose, teleport: bool = True) -> bool:
        """Moves an object that has a mesh of its own; whether that was possible."""
    def simGetObjectScale(self, object_name: str) -> Vector3r:
        """Size factors of an object."""
    def simSetObjectScale(self, object_name: str, scale_vector: Vector3r) -> bool:
        """Sets them; whether that was possible."""
    def simListSceneObjects(self, name_regex: str = '.*') -> list[str]:
        """Names of objects that match a regular expression."""
    def simLoadLevel(self, level_name: str) -> bool:
        """Whether another world was loaded."""
    def simListAssets(self) -> list[str]:
        """Names that simSpawnObject takes."""
    def simSpawnObject(self, object_name: str, asset_name: str, pose: Pose, scale: Vector3r,
                       physics_enabled: bool = False, is_blueprint: bool = False) -> str:
        """Puts a new object in the world; returns the name that it got."""
    def simDestroyObject(self, object_name: str) -> bool:
        """Takes an object away; whether there was one."""
    def simSetSegmentationObjectID(self, mesh_name: str, object_id: int, is_name_regex: bool = False) -> bool:
        """Sets the id that Segmentation shows for objects by name or regular expression; whether any matched."""
    def simGetSegmentationObjectID(self, mesh_name: str) -> int:
        """The id that Segmentation shows; -1 for an unknown name."""
    def simAddDetectionFilterMeshName(self, camera_name: str | int, image_type: int, mesh_name: str,
                                      vehicle_name: str = '', external: bool = False) -> None:
        """Lets a camera detect objects by name, with * and ?."""
    def simSetDetectionFilterRadius(self, camera_name: str | int, image_type: int, radius_cm: float,
                                    vehicle_name: str = '', external: bool = False) -> None:
        """Detects no further than so many centimetres."""
    def simClearDetectionMeshNames(self, camera_name: str | int, image_type: int, vehicle_name: str = '',
                                   external: bool = False) -> None:
        """Detects nothing any more."""
    def simGetDetections(self, camera_name: str | int, image_type: int, vehicle_name: str = '',
                         external: bool = False) -> list[DetectionInfo]:
        """Boxes of the objects that a camera sees and its filter lets through."""
    def simPrintLogMessage(self, message: str, message_param: str = '', severity: int = 0) -> None:
        """Writes to the server's log."""
    def simGetCameraInfo(self, camera_name: str | int, vehicle_name: str = '', external: bool = False) -> CameraInfo:
        """Where a camera is and how wide it sees."""
    def simGetDistortionParams(self, camera_name: str | int, vehicle_name: str = '',
                               external: bool = False) -> list[float]:
        """K1, K2, K3, P1, P2."""
    def simSetDistortionParam(self, camera_name: str | int, param_name: str, value: float, vehicle_name: str = '',
                              external: bool = False) -> None:
        """One of K1, K2, K3, P1, P2; pictures are not distorted."""
    def simSetCameraPose(self, camera_name: str | int, pose: Pose, vehicle_name: str = '',
                         external: bool = False) -> None:
        """Where a camera sits on its vehicle."""
    def simSetCameraFov(self, camera_name: str | int, fov_degrees: float, vehicle_name: str = '',
                        external: bool = False) -> None:
        """Horizontal field of view, degrees."""
    def simGetGroundTruthKinematics(self, vehicle_name: str = '') -> KinematicsState:
        """How a vehicle moves, without any error."""
    def simSetKinematics(self, state: KinematicsState, ignore_collision: bool, vehicle_name: str = '') -> None:
        """Sets how a vehicle moves, at once."""
    def simGetGroundTruthEnvironment(self, vehicle_name: str = '') -> EnvironmentState:
        """Air and gravity where a vehicle is."""
    def getImuData(self, imu_name: str = '', vehicle_name: str = '') -> ImuData:
        """The last reading of an inertial unit; "" = the first one, as below."""
    def getBarometerData(self, barometer_name: str = '', vehicle_name: str = '') -> BarometerData:
        """The last reading of a barometer."""
    def getMagnetometerData(self, magnetometer_name: str = '', vehicle_name: str = '') -> MagnetometerData:
        """The last reading of a magnetometer."""
    def getGpsData(self, gps_name: str = '', vehicle_name: str = '') -> GpsData:
        """The last reading of a satellite receiver."""
    def getDistanceSensorData(self, distance_sensor_name: str = '', vehicle_name: str = '') -> DistanceSensorData:
        """The last reading of a distance sensor."""
    def getLidarData(self, lidar_name: str = '', vehicle_name: str = '') -> LidarData:
        """The last turn of a lidar."""
    def simFlushPersistentMarkers(self) -> None:
        """Takes away what was plotted to stay."""
    def simPlotPoints(self, points: Sequence[Vector3r], color_rgba: Sequence[float] = [1.0, 0.0, 0.0, 1.0],
                      size: float = 10.0, duration: float = -1.0, is_persistent: bool = False) -> None:
        """Draws points."""
    def simPlotLineStrip(self, points: Sequence[Vector3r], color_rgba: Sequence[float] = [1.0, 0.0, 0.0, 1.0],
                         thickness: float = 5.0, duration: float = -1.0, is_persistent: bool = False) -> None:
        """Draws a polyline."""
    def simPlotLineList(self, points: Sequence[Vector3r], color_rgba: Sequence[float] = [1.0, 0.0, 0.0, 1.0],
                        thickness: float = 5.0, duration: float = -1.0, is_persistent: bool = False) -> None:
        """Draws a line between each two points."""
    def simPlotArrows(self, points_start: Sequence[Vector3r], points_end: Sequence[Vector3r],
                      color_rgba: Sequence[float] = [1.0, 0.0, 0.0, 1.0], thickness: float = 5.0,
                      arrow_size: float = 2.0, duration: float = -1.0, is_persistent: bool = False) -> None:
        """Draws arrows."""
    def simPlotStrings(self, strings: Sequence[str], positions: Sequence[Vector3r], scale: float = 5,
                       color_rgba: Sequence[float] = [1.0, 0.0, 0.0, 1.0], duration: float = -1.0) -> None:
        """Writes words at places."""
    def simPlotTransforms(self, poses: Sequence[Pose], scale: float = 5.0, thickness: float = 5.0,
                          duration: float = -1.0, is_persistent: bool = False) -> None:
        """Draws axes."""
    def simPlotTransformsWithNames(self, poses: Sequence[Pose], names: Sequence[str], tf_scale: float = 5.0,
                                   tf_thickness: float = 5.0, text_scale: float = 10.0,
                                   text_color_rgba: Sequence[float] = [1.0, 0.0, 0.0, 1.0],
                                   duration: float = -1.0) -> None:
        """Draws axes with names."""
    def cancelLastTask(self, vehicle_name: str = '') -> None:
        """Ends the move that is under way."""
    def startRecording(self) -> None:
        """Begins to record as the settings say."""
    def stopRecording(self) -> None:
        """Ends the recording."""
    def isRecording(self) -> bool:
        """Whether it records."""
    def simSetWind(self, wind: Vector3r) -> None:
        """Mean velocity of the air, m/s in NED."""
    def simCreateVoxelGrid(self, position: Vector3r, x: float, y: float, z: float, res: float, of: str) -> bool:
        """Writes the world as a .binvox file: x, y, z metres of size and res metres a cell, about a position."""
    def simAddVehicle(self, vehicle_name: str, vehicle_type: str, pose: Pose, pawn_path: str = '') -> bool:
        """Adds a drone; whether that was possible."""
    def listVehicles(self) -> list[str]:
        """Names of the vehicles."""
    def getSettingsString(self) -> str:
        """The server's settings.json as text."""
    def simSetPanoramaResolution(self, camera_name: str | int, width: int, height: int, vehicle_name: str = '') -> None:
        """Pixels of a panoramic camera."""
    def simTriggerPanoramaCapture(self, camera_name: str | int = 'panorama_original', vehicle_name: str = '') -> None:
        """Takes the panoramas of this instant, for the next simGetImages."""

class MultirotorClient(VehicleClient):
    """Drones. Moves end with True, or False where another one has taken over (`.join()` waits)."""

    def moveByAngleZAsync(self, pitch: float, roll: float, z: float, yaw: float, duration: float,
                          vehicle_name: str = '') -> Future:
        """As moveByRollPitchYawZAsync, in an older order."""
    def moveByAngleThrottleAsync(self, pitch: float, roll: float, throttle: float, yaw_rate: float, duration: float,
                                 vehicle_name: str = '') -> Future:
        """As moveByRollPitchYawrateThrottleAsync, in an older order."""
    def moveByRC(self, rcdata: RCData | None = None, vehicle_name: str = '') -> None:
        """Flies as a remote control says, until told otherwise."""
    def setAngleRateControllerGains(self, angle_rate_gains: AngleRateControllerGains | None = None,
                                    vehicle_name: str = '') -> None:
        """Gains of the controller of angular velocity; None: its own."""
    def setAngleLevelControllerGains(self, angle_level_gains: AngleLevelControllerGains | None = None,
                                     vehicle_name: str = '') -> None:
        """Gains of the controller of angles; None: its own."""
    def setVelocityControllerGains(self, velocity_gains: VelocityControllerGains | None = None,
                                   vehicle_name: str = '') -> None:
        """Gains of the controller of velocity; None: its own."""
    def setPositionControllerGains(self, position_gains: PositionControllerGains | None = None,
                                   vehicle_name: str = '') -> None:
        """Gains of the controller of position; None: its own."""
    def takeoffAsync(self, timeout_sec: float = 20, vehicle_name: str = '') -> Future:
        """Rises by 2 m."""
    def landAsync(self, timeout_sec: float = 60, vehicle_name: str = '') -> Future:
        """Descends until it stands."""
    def goHomeAsync(self, timeout_sec: float = 3e38, vehicle_name: str = '') -> Future:
        """Flies back to its start."""
    def moveByVelocityBodyFrameAsync(self, vx: float, vy: float, vz: float, duration: float, drivetrain: int = ...,
                                     yaw_mode: YawMode = ..., vehicle_name: str = '') -> Future:
        """Flies with a velocity, m/s forward, right, down, for `duration` seconds."""
    def moveByVelocityZBodyFrameAsync(self, vx: float, vy: float, z: float, duration: float, drivetrain: int = ...,
                                      yaw_mode: YawMode = ..., vehicle_name: str = '') -> Future:
        """The same along the ground, at height z."""
    def moveByVelocityAsync(self, vx: float, vy: float, vz: float, duration: float, drivetrain: int = ...,
                            yaw_mode: YawMode = ..., vehicle_name: str = '') -> Future:
        """Flies with a velocity, m/s north, east, down, for `duration` seconds."""
    def moveByVelocityZAsync(self, vx: float, vy: float, z: float, duration: float, drivetrain: int = ...,
                             yaw_mode: YawMode = ..., vehicle_name: str = '') -> Future:
        """The same along the ground, at height z."""
    def moveOnPathAsync(self, path: Sequence[Vector3r], velocity: float, timeout_sec: float = 3e38,
                        drivetrain: int = ..., yaw_mode: YawMode = ..., lookahead: float = -1,
                        adaptive_lookahead: float = 1, vehicle_name: str = '') -> Future:
        """Flies along points (a list of Vector3r) at `velocity` m/s; lookahead in metres, -1 = by the velocity."""
    def moveToPositionAsync(self, x: float, y: float, z: float, velocity: float, timeout_sec: float = 3e38,
                            drivetrain: int = ..., yaw_mode: YawMode = ..., lookahead: float = -1,
                            adaptive_lookahead: float = 1, vehicle_name: str = '') -> Future:
        """Flies to x, y, z at `velocity` m/s."""
    def moveToGPSAsync(self, latitude: float, longitude: float, altitude: float, velocity: float,
                       timeout_sec: float = 3e38, drivetrain: int = ..., yaw_mode: YawMode = ..., lookahead: float = -1,
                       adaptive_lookahead: float = 1, vehicle_name: str = '') -> Future:
        """Flies to degrees and metres over the ellipsoid at `velocity` m/s."""
    def moveToZAsync(self, z: float, velocity: float, timeout_sec: float = 3e38, yaw_mode: YawMode = ...,
                     lookahead: float = -1, adaptive_lookahead: float = 1, vehicle_name: str = '') -> Future:
        """Flies to a height at `velocity` m/s."""
    def moveByManualAsync(self, vx_max: float, vy_max: float, z_min: float, duration: float, drivetrain: int = ...,
                          yaw_mode: YawMode = ..., vehicle_name: str = '') -> Future:
        """Flies as a remote control says, within these limits, for `duration` seconds."""
    def rotateToYawAsync(self, yaw: float, timeout_sec: float = 3e38, margin: float = 5,
                         vehicle_name: str = '') -> Future:
        """Turns to a heading, degrees, to within `margin` degrees."""
    def rotateByYawRateAsync(self, yaw_rate: float, duration: float, vehicle_name: str = '') -> Future:
        """Turns at degrees a second for `duration` seconds."""
    def hoverAsync(self, vehicle_name: str = '') -> Future:
        """Stays where it is."""
    def moveByMotorPWMsAsync(self, front_right_pwm: float, rear_left_pwm: float, front_left_pwm: float,
                             rear_right_pwm: float, duration: float, vehicle_name: str = '') -> Future:
        """Sets each rotor's signal, 0 ... 1, for `duration` seconds."""
    def moveByRollPitchYawZAsync(self, roll: float, pitch: float, yaw: float, z: float, duration: float,
                                 vehicle_name: str = '') -> Future:
        """Holds angles (radians; forward, left, up) at height z for `duration` seconds."""
    def moveByRollPitchYawThrottleAsync(self, roll: float, pitch: float, yaw: float, throttle: float, duration: float,
                                        vehicle_name: str = '') -> Future:
        """Holds angles with a throttle of 0 ... 1."""
    def moveByRollPitchYawrateThrottleAsync(self, roll: float, pitch: float, yaw_rate: float, throttle: float,
                                            duration: float, vehicle_name: str = '') -> Future:
        """Holds roll and pitch and turns at radians a second, with a throttle of 0 ... 1."""
    def moveByRollPitchYawrateZAsync(self, roll: float, pitch: float, yaw_rate: float, z: float, duration: float,
                                     vehicle_name: str = '') -> Future:
        """The same at height z."""
    def moveByAngleRatesZAsync(self, roll_rate: float, pitch_rate: float, yaw_rate: float, z: float, duration: float,
                               vehicle_name: str = '') -> Future:
        """Turns about its axes (rad/s; forward, left, up) at height z."""
    def moveByAngleRatesThrottleAsync(self, roll_rate: float, pitch_rate: float, yaw_rate: float, throttle: float,
                                      duration: float, vehicle_name: str = '') -> Future:
        """The same with a throttle of 0 ... 1."""
    def getMultirotorState(self, vehicle_name: str = '') -> MultirotorState:
        """The drone as its estimator knows it."""
    def getRotorStates(self, vehicle_name: str = '') -> RotorStates:
        """Thrust, torque and speed of each rotor."""

class CarClient(VehicleClient):
    """Cars, which our server answers with AirSim's error for."""

    def setCarControls(self, controls: CarControls, vehicle_name: str = '') -> None:
        """What the driver does."""
    def getCarState(self, vehicle_name: str = '') -> CarState:
        """How the car moves."""
    def getCarControls(self, vehicle_name: str = '') -> CarControls:
        """What the driver does."""
