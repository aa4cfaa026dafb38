"""Every number that a client can send, made hostile: the server stays, answers soon, and its state stays finite.

`FUNCTIONS` holds a good call of every function of the server; each number in it is replaced by each of `HOSTILE`, one at
a time. After every such call time passes, a picture is taken and the state is read. A function that the server has and
the list lacks fails the test. By default each number meets a few of the values, others in its turn; with
AIRSIM360_EXHAUSTIVE=1 all of them (minutes). AIRSIM360_PATIENCE: seconds that an answer may take (default 20).
"""
import http.client
import json
import math
import os
import re
import signal
import subprocess
import tempfile
import time
import unittest

from harness import PROGRAM, RawClient

EXHAUSTIVE = os.environ.get("AIRSIM360_EXHAUSTIVE") == "1"
PATIENCE = float(os.environ.get("AIRSIM360_PATIENCE", "20"))
DECADES = [1e7, 1.1e7, 1e9, 1e12, 1e15, 1e17, 1e18, 2e18, 9.3e18, 1e20, 1e30, 1e38, 3.4e38, 1e39, 1e100, 1e308]
HOSTILE = ([sign * value for value in DECADES for sign in (1, -1)] +
           [math.nan, math.inf, -math.inf, 5e-324, 1e-30, -1, 0, -1.0, 0.0, 255, 2**31, 2**32, 2**63, 2**64 - 1, -2**31, -2**63,
            "x", None, True, [], {}, [1.0], b"\0"])
FEW = [2e18, -1e30, 1e308, math.nan, math.inf, 1e7, -1, 0, 2**63, -2**63, "x", None, [], {}]

POSITION = {"x_val": 0.5, "y_val": 0.5, "z_val": -1.0}
POSE = {"position": POSITION, "orientation": {"w_val": 1.0, "x_val": 0.0, "y_val": 0.0, "z_val": 0.0}}
PLACE = {"latitude": 47.641468, "longitude": -122.140165, "altitude": 123.0}
YAW = {"is_rate": True, "yaw_or_rate": 10.0}
CAMERA = ["0", "", False]  # the ends of camera functions
COLOR = [1.0, 0.0, 0.0, 1.0]
KINEMATICS = dict(POSE, linear_velocity=POSITION, angular_velocity=POSITION, linear_acceleration=POSITION,
                  angular_acceleration=POSITION)
REQUEST = {"camera_name": "0", "image_type": 2, "pixels_as_float": True, "compress": False}
RC = {"timestamp": 1, "pitch": 0.1, "roll": 0.1, "throttle": 0.5, "yaw": 0.1, "left_z": 0.1, "right_z": 0.1, "switches": 0,
      "vendor_id": "", "is_initialized": True, "is_valid": True}
GAINS = [[0.2, 0.2, 0.2], [0.0, 0.0, 0.1], [0.0, 0.0, 0.0], ""]
PATH_END = [3.0, 60.0, 0, YAW, -1.0, 1.0, ""]
MOVE_END = [10.0, 0, YAW, ""]

FUNCTIONS = {
    # Connection, clock, recording.
    "ping": [], "getServerVersion": [], "getMinRequiredClientVersion": [], "listVehicles": [], "getSettingsString": [],
    "getHomeGeoPoint": [""], "simPrintLogMessage": ["hello", "", 0], "simPause": [True], "simIsPaused": [],
    "simContinueForTime": [0.01], "simContinueForFrames": [1], "reset": [], "startRecording": [], "stopRecording": [],
    "isRecording": [],
    # Vehicles.
    "enableApiControl": [True, ""], "isApiControlEnabled": [""], "armDisarm": [True, ""], "cancelLastTask": [""],
    "moveByRC": [RC, ""], "getMultirotorState": [""], "getRotorStates": [""], "simGetGroundTruthKinematics": [""],
    "simGetPhysicsRawKinematics": [""], "simGetGroundTruthEnvironment": [""], "simGetCollisionInfo": [""],
    "simGetVehiclePose": [""], "simSetVehiclePose": [POSE, True, ""], "simSetKinematics": [KINEMATICS, True, ""],
    "simSetPhysicsRawKinematics": [KINEMATICS, ""], "simAddVehicle": ["Other", "simpleflight", POSE, ""],
    "setAngleRateControllerGains": GAINS, "setAngleLevelControllerGains": GAINS, "setVelocityControllerGains": GAINS,
    "setPositionControllerGains": GAINS,
    # Moves.
    "takeoff": [20.0, ""], "land": [60.0, ""], "goHome": [60.0, ""], "hover": [""],
    "moveOnPath": [[POSITION, POSITION]] + PATH_END, "moveToPosition": [1.0, 1.0, -1.0] + PATH_END,
    "moveToGPS": [47.641468, -122.140165, 123.0] + PATH_END, "moveToZ": [-1.5, 3.0, 60.0, YAW, -1.0, 1.0, ""],
    "rotateToYaw": [30.0, 10.0, 5.0, ""], "rotateByYawRate": [30.0, 10.0, ""],
    "moveByManual": [5.0, 5.0, -1.0] + MOVE_END, "moveByVelocity": [1.0, 0.5, -0.5] + MOVE_END,
    "moveByVelocityZ": [1.0, 0.5, -1.0] + MOVE_END, "moveByVelocityBodyFrame": [1.0, 0.5, -0.5] + MOVE_END,
    "moveByVelocityZBodyFrame": [1.0, 0.5, -1.0] + MOVE_END, "moveByRollPitchYawZ": [0.1, 0.1, 0.1, -1.0, 10.0, ""],
    "moveByRollPitchYawThrottle": [0.1, 0.1, 0.1, 0.6, 10.0, ""],
    "moveByRollPitchYawrateThrottle": [0.1, 0.1, 0.1, 0.6, 10.0, ""],
    "moveByRollPitchYawrateZ": [0.1, 0.1, 0.1, -1.0, 10.0, ""], "moveByAngleRatesZ": [0.1, 0.1, 0.1, -1.0, 10.0, ""],
    "moveByAngleRatesThrottle": [0.1, 0.1, 0.1, 0.6, 10.0, ""], "moveByMotorPWMs": [0.6, 0.6, 0.6, 0.6, 10.0, ""],
    # Pictures and cameras.
    "simGetImages": [[REQUEST], "", False], "simGetImagesLent": [[REQUEST], "", False, 1, 0, 1000],
    "simGetImage": ["0", 5, "", False], "simSetPanoramaResolution": ["panorama_original", 32, 16, ""],
    "simTriggerPanoramaCapture": ["panorama_original", ""], "simGetRenderMilliseconds": [],
    "simGetCameraInfo": CAMERA, "simSetCameraPose": ["0", POSE, "", False], "simSetCameraFov": ["0", 90.0, "", False],
    "simGetDistortionParams": CAMERA, "simSetDistortionParam": ["0", "K1", 0.1, "", False],
    "simGetCurrentFieldOfView": CAMERA, "simAddDetectionFilterMeshName": ["0", 0, "box*", "", False],
    "simSetDetectionFilterRadius": ["0", 0, 2000.0, "", False], "simClearDetectionMeshNames": ["0", 0, "", False],
    "simGetDetections": ["0", 0, "", False],
    # Sensors.
    "getImuData": ["", ""], "getBarometerData": ["", ""], "getMagnetometerData": ["", ""], "getGpsData": ["", ""],
    "getDistanceSensorData": ["", ""], "getLidarData": ["", ""], "getGPULidarData": ["", ""],
    "setEchoData": ["", "", {}], "getEchoData": ["", ""], "getUWBData": ["", ""], "getUWBSensorData": ["", ""],
    "getWifiData": ["", ""], "getWifiSensorData": ["", ""],
    # Objects.
    "simListSceneObjects": ["b.*"], "simListSceneObjectsTags": ["b.*"], "simGetObjectPose": ["box", True],
    "simSetObjectPose": ["box", POSE, True], "simGetObjectScale": ["box"], "simSetObjectScale": ["box", POSITION],
    "simDestroyObject": ["nothing"], "simSetSegmentationObjectID": ["box", 7, False], "simGetSegmentationObjectID": ["box"],
    "simListAssets": [], "simSpawnObject": ["thing", "Cube", POSE, {"x_val": 0.5, "y_val": 0.5, "z_val": 0.5}, False, False],
    # World, weather, plots.
    "simTestLineOfSightToPoint": [PLACE, ""], "simTestLineOfSightBetweenPoints": [PLACE, PLACE], "simGetWorldExtents": [],
    "simSetWind": [POSITION], "simCreateVoxelGrid": [POSITION, 2, 2, 2, 0.5, "grid.binvox"], "simEnableWeather": [True],
    "simSetWeatherParameter": [7, 0.1], "simSetTimeOfDay": [False, "", False, 1.0, 60.0, True],
    "simPlotPoints": [[POSITION], COLOR, 10.0, 1.0, False], "simPlotLineStrip": [[POSITION], COLOR, 10.0, 1.0, False],
    "simPlotLineList": [[POSITION], COLOR, 10.0, 1.0, False],
    "simPlotArrows": [[POSITION], [POSITION], COLOR, 10.0, 1.0, 1.0, False],
    "simPlotStrings": [["text"], [POSITION], 1.0, COLOR, 1.0], "simPlotTransforms": [[POSE], 1.0, 1.0, 1.0, False],
    "simPlotTransformsWithNames": [[POSE], ["name"], 1.0, 1.0, 1.0, COLOR, 1.0], "simFlushPersistentMarkers": [],
    "simSetTraceLine": [COLOR, 1.0, ""],
    # People.
    "simListPeople": [], "simGetPeople": [], "simSpawnPerson": ["person/002", POSE], "simMovePerson": ["person/000", POSE],
    "simRemovePerson": ["person/001"], "simSendPerson": ["person/000", POSITION, 1.0],
    "simSetPersonState": ["person/000", "stop", 1.0], "simMessagePerson": ["person/000", "stop"],
    "simReleasePerson": ["person/000"],
    # Traffic.
    "simListTraffic": [], "simGetTraffic": [], "simGetNearMisses": [],
    # Missions.
    "simFlyMission": ["<root/>", ""], "simGetMission": [""], "simStopMission": [""],
    # Cosys-AirSim's.
    "simListInstanceSegmentationObjects": [], "simListInstanceSegmentationPoses": [True, False],
    "simGetInstanceSegmentationColorMap": [], "simSetAnnotationObjectID": ["layer", "box", 3, False],
    "simGetAnnotationObjectID": ["layer", "box"], "simSetAnnotationObjectColor": ["layer", "box", 1, 2, 3, False],
    "simGetAnnotationObjectColor": ["layer", "box"], "simSetAnnotationObjectValue": ["layer", "box", 0.5, False],
    "simGetAnnotationObjectValue": ["layer", "box"], "simListAnnotationObjects": ["layer"],
    "simListAnnotationPoses": ["layer", True, False], "simSetAnnotationObjectTextureByPath": ["layer", "box", "x", False],
    "simEnableAnnotationObjectTextureByPath": ["layer", "box", False], "simGetAnnotationObjectTexturePath": ["layer", "box"],
    # What has nothing to act on here.
    "simGetPresetLensSettings": CAMERA, "simGetPresetFilmbackSettings": CAMERA, "simGetLensSettings": CAMERA,
    "simGetFilmbackSettings": CAMERA, "simGetFocalLength": CAMERA, "simGetFocusDistance": CAMERA, "simGetFocusAperture": CAMERA,
    "simSetPresetLensSettings": ["x"] + CAMERA, "simSetPresetFilmbackSettings": ["x"] + CAMERA,
    "simSetFocalLength": [10.0] + CAMERA, "simSetFocusDistance": [10.0] + CAMERA, "simSetFocusAperture": [2.0] + CAMERA,
    "simEnableManualFocus": [True] + CAMERA, "simEnableFocusPlane": [True] + CAMERA,
    "simSetFilmbackSettings": [10.0, 10.0] + CAMERA, "simRunConsoleCommand": ["x"], "simLoadLevel": ["x"],
    "simGetMeshPositionVertexBuffers": [], "simSwapTextures": ["x", 0, 0, 0], "simSetObjectMaterial": ["box", "x", 0],
    "simSetObjectMaterialFromTexture": ["box", "x", 0], "simSetLightIntensity": ["x", 1.0],
    "simSetWorldLightIntensity": ["x", 1.0], "simSetWorldLightVisibility": ["x", True],
    "simSetVehicleLightVisibility": ["", "x", True], "simSetVehicleLightIntensity": ["", "x", 1.0], "simSetExtForce": [POSITION],
    "getCarState": [""], "getCarControls": [""],
    "setCarControls": [{"throttle": 0.0, "steering": 0.0, "brake": 0.0, "handbrake": False, "is_manual_gear": False,
                        "manual_gear": 0, "gear_immediate": True}, ""],
    "setSafety": [0, 0.0, 0, 0.0, POSITION, 0.0, 0.0, 0.0, ""],
}
SETTINGS = {
    "Recording": {"Folder": "recordings"},
    "CameraDefaults": {"CaptureSettings": [{"ImageType": kind, "Width": 12, "Height": 8} for kind in (0, 1, 2, 5)]},
    "Vehicles": {"Drone": {"VehicleType": "SimpleFlight", "Sensors": {
        "lidar": {"SensorType": 6, "NumberOfChannels": 2, "PointsPerSecond": 400, "RotationsPerSecond": 10},
        "distance": {"SensorType": 5}}}},
}


def number_paths(value, path=()):
    """Where numbers are in nested lists and maps."""
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        yield path
    elif isinstance(value, (list, dict)):
        for key in (range(len(value)) if isinstance(value, list) else value):
            yield from number_paths(value[key], path + (key,))


def replaced(value, path, new):
    if not path:
        return new
    copy = value.copy()
    copy[path[0]] = replaced(value[path[0]], path[1:], new)
    return copy


def numbers_in(value):
    if isinstance(value, (int, float)):
        yield value
    elif isinstance(value, (list, dict)):
        for item in (value if isinstance(value, list) else value.values()):
            yield from numbers_in(item)


def hostile_calls(shapes):
    """(name, arguments) with one number hostile."""
    turn = 0
    for name, arguments in shapes.items():
        for path in number_paths(arguments):
            values = HOSTILE if EXHAUSTIVE else [FEW[(turn + i * 5) % len(FEW)] for i in range(3)]
            turn += 1
            for value in values:
                if name == "simContinueForFrames" and isinstance(value, int) and 0 < value < 2**33 and value is not True:
                    continue  # a right number of frames that takes its time
                yield name, replaced(arguments, path, value)


class Process:
    def __init__(self, *arguments, settings=None):
        self.folder = tempfile.TemporaryDirectory()
        extra = []
        if settings is not None:
            path = os.path.join(self.folder.name, "settings.json")
            with open(path, "w") as file:
                json.dump(settings, file)
            extra = ["--settings", path]
        self.log = open(os.path.join(self.folder.name, "log"), "w+")
        self.process = subprocess.Popen([PROGRAM, *arguments, *extra], stdout=subprocess.PIPE, stderr=self.log, text=True,
                                        cwd=self.folder.name)

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        status = self.process.wait(60)
        self.process.stdout.close()
        self.log.seek(0)
        text = self.log.read()
        self.log.close()
        self.folder.cleanup()
        return status, text


class Rpc(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = Process("serve", "--world", "box_room", "--lockstep", "--json", "--port", "0", "--threads", "1", "--people",
                             "2", "--people-reserve", "1", settings=SETTINGS)
        text = ""
        for line in cls.server.process.stdout:
            text += line
            if line == "}\n":
                break
        cls.about = json.loads(text)

    @classmethod
    def tearDownClass(cls):
        status, log = cls.server.stop()
        assert status == 0 and "runtime error" not in log, log[-3000:]

    def setUp(self):
        self.client = RawClient(self.about["port"], PATIENCE)
        self.addCleanup(self.client.close)
        self.calls, self.refused, self.worst = 0, 0, (0, None)

    def round(self, name, arguments):
        """The call, then time, a picture, sensors and the state; all at once, so that a move that is under way counts."""
        c, started = self.client, time.monotonic()
        picture = [{"camera_name": "0", "image_type": kind, "pixels_as_float": kind == 2, "compress": False} for kind in (2, 5)]
        asked = {c.send(name, *arguments): name}
        for other, *rest in (("simContinueForFrames", 1), ("simGetImages", picture, "", False), ("getLidarData", "", ""),
                             ("getMultirotorState", ""), ("getImuData", "", ""), ("simGetVehiclePose", ""), ("cancelLastTask", "")):
            asked[c.send(other, *rest)] = other if other != name else other + " "
        answers = {}
        try:
            while len(answers) < len(asked):
                number, error, result = c.receive()
                answers[asked[number]] = (error, result)
        except OSError as problem:
            self.fail(f"{name}{arguments!r}: {type(problem).__name__} {problem}; answered: {sorted(answers)}")
        took = time.monotonic() - started
        self.calls += 1
        self.refused += answers[name][0] is not None
        self.worst = max(self.worst, (took, f"{name}{arguments!r}"), key=lambda pair: pair[0])
        for other in ("simContinueForFrames", "simGetImages", "getMultirotorState", "getImuData", "simGetVehiclePose", "getLidarData"):
            if other == name:
                continue
            error, result = answers[other]
            self.assertIsNone(error, f"{other} after {name}{arguments!r}")
            if other in ("getMultirotorState", "getImuData", "simGetVehiclePose"):
                for number in numbers_in(result):
                    self.assertTrue(math.isfinite(number), f"{other} after {name}{arguments!r}: {result}")
        return answers[name]

    def place(self):
        state = self.client.call("simGetVehiclePose", "")["position"]
        return [state[key] for key in ("x_val", "y_val", "z_val")]

    def prepare(self):
        for name, *arguments in (("reset",), ("enableApiControl", True, ""), ("armDisarm", True, ""), ("simSetObjectPose", "box", POSE, True),
                                 ("simSetCameraPose", "0", POSE, "", False), ("simSetVehiclePose", POSE, True, ""),
                                 ("simSetWind", {})):
            self.client.call(name, *arguments)

    def test_the_list_has_every_function_and_its_calls_are_good(self):
        self.assertEqual(sorted(FUNCTIONS), self.about["functions"])
        for name, arguments in FUNCTIONS.items():
            self.prepare()
            error, _ = self.round(name, arguments)
            # What is wrong with a good call is never its form.
            self.assertNotRegex(error or "", r"bad_cast|number of arguments|is not in", name)

    def test_no_number_ends_the_server_or_its_senses(self):
        last = None
        for name, arguments in hostile_calls(FUNCTIONS):
            if name != last:
                self.prepare()
                last = name
            error, result = self.round(name, arguments)
            if name == "simSpawnObject" and error is None:
                self.client.call("simDestroyObject", result)
            if name in ("simSetVehiclePose", "simSetKinematics", "simSetPhysicsRawKinematics"):
                for coordinate in self.place():
                    self.assertLessEqual(abs(coordinate), 2e7, (name, arguments))
        print(f"{self.calls} calls, {self.refused} refused, slowest {self.worst[0]:.2f} s: {self.worst[1][:200]}", flush=True)
        self.assertGreater(self.refused, self.calls // 3)

    def test_errors_name_the_field_the_value_and_the_range(self):
        for name, arguments, text in [
                ("simSetVehiclePose", [replaced(POSE, ("position", "x_val"), 2e18), True, ""],
                 "position.x_val of argument 1: 2e+18 is not in -1e+07 … 1e+07"),
                ("simSetVehiclePose", [replaced(POSE, ("position", "y_val"), -math.inf), True, ""],
                 "position.y_val of argument 1: -inf is not in -1e+07 … 1e+07"),
                ("simTestLineOfSightToPoint", [replaced(PLACE, ("altitude",), 1e30), ""], "altitude of argument 1: 1e+30 is not in"),
                ("simTestLineOfSightToPoint", [replaced(PLACE, ("latitude",), 123.5), ""],
                 "latitude: 123.5 is not in -90 … 90 degrees; the nearest is 90"),
                ("moveToGPS", [47.6, -1000.0, 123.0] + PATH_END,
                 "longitude: -1000 is not in -360 … 360 degrees; the nearest is -360"),
                ("simSetKinematics", [dict(KINEMATICS, linear_velocity={"x_val": -2000.0, "y_val": 0.0, "z_val": 0.0}), True, ""],
                 "linear_velocity: (-2000, 0, 0) is 2000 m/s, more than 1000; the nearest is (-1000, 0, 0)"),
                ("moveToZ", [1e30, 1.0, 1.0, YAW, -1.0, 1.0, ""], "argument 1: 1e+30 is not in -1e+07 … 1e+07"),
                ("moveToZ", [1.0, 1.0, math.inf, YAW, -1.0, 1.0, ""], "argument 3: inf is not in -3.40282e+38 … 3.40282e+38"),
                ("moveByMotorPWMs", [math.inf, 0.0, 0.0, 0.0, 1.0, ""], "argument 1: inf is not in"),
                ("setVelocityControllerGains", [[1.0, 1e308, 1.0], [0.0] * 3, [0.0] * 3, ""], "[1] of argument 1: 1e+308 is not in"),
                ("simCreateVoxelGrid", [POSITION, -1, 2, 2, 0.5, "a.binvox"],
                 "std::bad_cast. argument 2: -1 is not in 0 … 4294967295"),
                ("simPause", ["yes"], "std::bad_cast. argument 1: a text is not true or false"),
                ("simSetWind", [{"x_val": math.nan}], "x_val of argument 1: nan is not a number"),
                ("simSetObjectScale", ["box", {"x_val": 1.0, "y_val": 1e-30, "z_val": 1.0}], "scale must be in 0.0001 ... 10000"),
                ("simSetTimeOfDay", [True, "2026-02-30 10:00:00", False, 1.0, 60.0, True],
                 "start_datetime '2026-02-30 10:00:00' is not YYYY-MM-DD HH:MM:SS: there is no such day")]:
            with self.assertRaises(RuntimeError) as caught:
                self.client.call(name, *arguments)
            self.assertIn(text, str(caught.exception))
        # For ever is a time.
        number = self.client.send("hover", "")
        self.assertEqual(self.client.call("simIsPaused"), True)
        self.client.send("moveToZ", -1.0, 1.0, 3.4e38, YAW, -1.0, 1.0, "")
        self.assertEqual(self.client.receive(), (number, None, False))

    def test_names_of_files_stay_in_their_folder(self):
        victim = os.path.join(self.server.folder.name, "settings.json")
        with open(victim) as file:
            before = file.read()
        for name, text in [("settings.json\0.binvox", "control character"), ("a\0b.binvox", "control character"),
                           ("../x.binvox", "'/'"), (".hidden.binvox", "begins with a dot"), ("a\nb.binvox", "control character"),
                           ("grid.txt", "does not end in .binvox"), ("", "empty"), ("x" * 300 + ".binvox", "more than 200")]:
            with self.assertRaises(RuntimeError) as caught:
                self.client.call("simCreateVoxelGrid", POSITION, 2, 2, 2, 0.5, name)
            self.assertIn(text, str(caught.exception), repr(name))
        for name in ("../../evil", "a\0b", ".x"):
            with self.assertRaises(RuntimeError) as caught:
                self.client.call("simAddVehicle", name, "simpleflight", POSE, "")
            self.assertIn("vehicle_name", str(caught.exception))
        self.assertTrue(self.client.call("simCreateVoxelGrid", POSITION, 2, 2, 2, 0.5, "grid.binvox"))
        with open(victim) as file:
            self.assertEqual(file.read(), before)
        files = set(os.listdir(self.server.folder.name)) - {"recordings"}
        self.assertEqual(files, {"grid.binvox", "log", "settings.json"})

    def test_patterns_that_never_end_elsewhere_end_here(self):
        for pattern in ("(.*)*y", "(.*.*)*y", "(a+)+$b", "(.|.)*y", "((.*)*)*y"):
            self.assertEqual(self.client.call("simListSceneObjects", pattern), [])
            self.assertIs(self.client.call("simSetSegmentationObjectID", pattern, 3, True), False)
        self.assertEqual(self.client.call("simListSceneObjects", "BO[w-z]"), ["box"])
        self.assertEqual(len(self.client.call("simListSceneObjects", ".*wall.*")), 4)
        for pattern, text in (("(a)\\1", "back-references"), ("a(?=b)", "lookaheads"), ("[", "'[' without ']'"),
                              ("a" * 1001, "1001 characters")):
            with self.assertRaises(RuntimeError) as caught:
                self.client.call("simListSceneObjects", pattern)
            self.assertIn(text, str(caught.exception))


AGENT_CALLS = {
    "/v1/episodes": {"instruction": "", "start": {"p": [-3.5, -3.5, 1.5], "yaw_deg": 45.0}, "goal": [3.5, 3.5, 4.0],
                     "reference_path": [[-3.5, -3.5, 1.5], [3.5, 3.5, 4.0]], "seed": 1, "world_seed": 0,
                     "success": {"rule": "stop", "radius": 1.0}, "speed": 3.0,
                     "presets": {"forward": 1.0, "lateral": 1.0, "vertical": 0.5, "turn_deg": 15.0, "hover": 0.1},
                     "limits": {"max_steps": 500, "max_seconds": 600.0, "end_on_collision": False}},
    "{e}/reset": {"seed": 7},
    "{e}/observe": {"panorama": {"width": 32, "quality": 50}, "range_grid": {"rows": 2, "columns": 4},
                    "views": [{"azimuth_deg": 0.0, "elevation_deg": 0.0, "fov_deg": 90.0, "width": 16, "height": 16, "quality": 50}]},
    "{e}/step relative_goal": {"action": {"type": "relative_goal", "azimuth_deg": 0.0, "elevation_deg": 15.0, "distance": 0.5,
                                          "speed": 2.0}},
    "{e}/step waypoints": {"action": {"type": "waypoints", "points": [[0.0, 0.0, 2.0], [1.0, 0.0, 2.0]], "speed": 2.0}},
    "{e}/step velocity": {"action": {"type": "velocity", "v": [0.5, 0.0, 0.0], "yaw_rate_deg": 10.0, "duration": 0.1}},
    "{e}/step rates": {"action": {"type": "rates", "w": [0.0, 0.0, 0.1], "throttle": 0.5, "duration": 0.05}},
}
AGENT_QUERIES = ["panorama.jpg?width={}", "panorama.jpg?width=32&quality={}", "view.jpg?width=16&height=16&azimuth_deg={}",
                 "view.jpg?width=16&height=16&elevation_deg={}", "view.jpg?width=16&height=16&fov_deg={}", "view.jpg?height=16&width={}",
                 "view.jpg?width=16&height={}", "range_grid?rows={}", "range_grid?columns={}"]


class Agent(unittest.TestCase):
    def setUp(self):
        self.server = Process("agent", "--world", "box_room", "--port", "0", "--threads", "1")
        line = self.server.process.stdout.readline()
        self.port = int(re.search(r":(\d+)$", line).group(1))
        self.connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)

    def tearDown(self):
        self.connection.close()
        status, log = self.server.stop()
        self.assertEqual(status, 0, log[-3000:])
        self.assertNotIn("runtime error", log)

    def ask(self, method, path, body=None):
        text = None if body is None else json.dumps(body, default=lambda value: value.decode())
        self.connection.request(method, path, text, {"Content-Type": "application/json"} if text else {})
        answer = self.connection.getresponse()
        return answer.status, answer.read()

    def test_the_calls_are_those_of_the_description(self):
        status, text = self.ask("GET", "/openapi.json")
        self.assertEqual(status, 200)
        posts = {path for path, item in json.loads(text)["paths"].items() if "post" in item}
        own = {re.sub(r"^\{e\}", "/v1/episodes/{id}", name.split()[0]) for name in AGENT_CALLS}
        self.assertEqual({re.sub(r"\{\w+\}", "{id}", path) for path in posts}, own)

    def test_no_number_ends_the_server(self):
        status, text = self.ask("POST", "/v1/episodes", AGENT_CALLS["/v1/episodes"])
        self.assertEqual(status, 201, text)
        episode = "/v1/episodes/" + json.loads(text)["episode"]
        calls, refused, worst = 0, 0, 0
        hostile = [(name, body) for name, (body,) in hostile_calls({name: [body] for name, body in AGENT_CALLS.items()})
                   if isinstance(body, dict)]
        for name, body in hostile:
            started = time.monotonic()
            path = name.split()[0].format(e=episode)
            status, text = self.ask("POST", path, body)
            self.assertIn(status, (200, 201, 400, 409, 422, 503), (name, body, text))
            if path == "/v1/episodes" and status < 300:
                self.ask("DELETE", "/v1/episodes/" + json.loads(text)["episode"])
            refused += status >= 400
            # The other things go on: time passes, rays are cast, and what is seen is finite.
            again, seen = self.ask("POST", episode + "/step", {"action": {"type": "velocity", "v": [0, 0, 0], "duration": 0.01},
                                                               "observe": {"range_grid": {"rows": 2, "columns": 4}}})
            self.assertIn(again, (200, 409, 422), (name, body, seen))
            worst = max(worst, time.monotonic() - started)
            calls += 1
            for number in numbers_in(json.loads(seen)):
                self.assertTrue(math.isfinite(number) and abs(number) < 1e8, (name, body, seen))
            if again != 200:
                self.ask("POST", episode + "/reset", {})
        for query in AGENT_QUERIES:
            for value in [v for v in (HOSTILE if EXHAUSTIVE else FEW) if isinstance(v, (int, float))]:
                status, text = self.ask("GET", f"{episode}/{query.format(value)}")
                self.assertIn(status, (200, 422), (query, value, text))
                calls += 1
                refused += status != 200
        print(f"{calls} calls, {refused} refused, slowest {worst:.2f} s", flush=True)
        self.assertGreater(refused, calls // 3)


if __name__ == "__main__":
    unittest.main()
