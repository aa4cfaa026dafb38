"""The wire, the errors, clients that misbehave: over raw sockets."""
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import msgpack

from harness import RawClient, Server, ServerTest


class Handshake(ServerTest):
    def test_versions_are_airsims(self):
        raw = self.raw()
        self.assertIs(raw.call("ping"), True)
        self.assertEqual(raw.call("getServerVersion"), 1)
        self.assertEqual(raw.call("getMinRequiredClientVersion"), 1)

    def test_settings_of_cosys_airsim_get_its_version(self):
        server = Server(settings={"SettingsVersion": 2.0})
        self.addCleanup(server.stop)
        raw = RawClient(server.port)
        self.addCleanup(raw.close)
        self.assertEqual(raw.call("getServerVersion"), 4)

    def test_structs_are_maps_with_airsims_keys(self):
        state = self.raw().call("getMultirotorState", "")
        self.assertEqual(set(state), {"collision", "kinematics_estimated", "gps_location", "timestamp", "landed_state", "rc_data"})
        self.assertEqual(set(state["kinematics_estimated"]), {"position", "orientation", "linear_velocity", "angular_velocity",
                                                              "linear_acceleration", "angular_acceleration"})
        self.assertEqual(set(state["collision"]), {"has_collided", "penetration_depth", "time_stamp", "normal", "impact_point", "position",
                                                   "object_name", "object_id"})
        image = self.raw().call("simGetImages", [{"camera_name": "0", "image_type": 0}], "", False)[0]
        self.assertTrue({"image_data_uint8", "image_data_float", "camera_position", "camera_name", "camera_orientation", "time_stamp",
                         "message", "pixels_as_float", "compress", "width", "height", "image_type"} <= set(image))
        self.assertIsInstance(image["image_data_uint8"], bytes)
        # An unknown key whose value is a map would end AirSim's own client.
        self.assertEqual({key for key, value in image.items() if isinstance(value, dict)}, {"camera_position", "camera_orientation"})

    def test_answers_come_when_they_are_ready(self):
        raw = self.raw()
        raw.call("enableApiControl", True, "")
        raw.call("armDisarm", True, "")
        move = raw.send("moveByVelocity", 0, 0, 0, 40.0, 0, {"is_rate": True, "yaw_or_rate": 0}, "")
        for method, arguments in [("ping", ()), ("getMultirotorState", ("",)),
                                  ("simGetImages", ([{"camera_name": "0", "image_type": 1, "pixels_as_float": True}], "", False))]:
            asked = raw.send(method, *arguments)
            number, error, _ = raw.receive()
            self.assertEqual((number, error), (asked, None), method)
        cancel = raw.send("cancelLastTask", "")
        answers = dict((number, (error, result)) for number, error, result in (raw.receive(), raw.receive()))
        self.assertEqual(answers, {move: (None, False), cancel: (None, None)})

    def test_a_new_move_ends_the_old_one_with_false(self):
        raw = self.raw()
        raw.call("enableApiControl", True, "")
        first = raw.send("moveByVelocity", 0, 0, 0, 1000, 0, {"is_rate": True, "yaw_or_rate": 0}, "")
        second = raw.send("moveByVelocity", 0, 0, 0, 0.1, 0, {"is_rate": True, "yaw_or_rate": 0}, "")
        self.assertEqual(raw.receive(), (first, None, False))
        self.assertEqual(raw.receive(), (second, None, True))

    def test_notifications_get_no_answer(self):
        raw = self.raw()
        raw.socket.sendall(msgpack.packb([2, "simPrintLogMessage", ["hello", "", 0]]))
        self.assertIs(raw.call("ping"), True)


class BadCalls(ServerTest):
    def test_errors_are_airsims_and_nothing_changes(self):
        raw = self.raw()
        before = raw.call("simGetVehiclePose", "")
        cases = [
            (("simFlyAway", 1, 2), "rpclib: server could not find function 'simFlyAway' with argument count 2."),
            (("ping", 1), "rpclib: Function 'ping' was called with an invalid number of arguments. Expected: 0, got: 1"),
            (("simSetVehiclePose", {}), "rpclib: Function 'simSetVehiclePose' was called with an invalid number of arguments. Expected: 3, got: 1"),
            (("simPause", "yes"), "rpclib: function 'simPause' (called with 1 arg(s)) threw an exception. The exception contained this information: std::bad_cast."),
            (("getMultirotorState", "Nobody"), "Vehicle API for 'Nobody' is not available. This could either because this is simulation-only API or this vehicle does not exist"),
            (("getImuData", "imu9", ""), "No IMU with name imu9 exist on vehicle"),
            (("getLidarData", "", ""), "No lidar with name  exist on vehicle"),
            (("simSetVehiclePose", {"position": {"x_val": float("nan")}}, True, ""), "not a number"),
            (("simSetVehiclePose", {"position": {"x_val": float("inf")}}, True, ""), "position.x_val of argument 1: inf is not in"),
            (("simSetVehiclePose", {"orientation": {"w_val": 0}}, True, ""), "no rotation"),
            (("moveToPosition", float("nan"), 0, 0, 1, 1, 0, {}, -1, 1, ""), "not a number"),
            (("moveToPosition", 1, 0, 0, 1, 1, 0, {}, 0, 1, ""), "lookahead distance cannot be 0"),
            (("moveToPosition", 1, 0, 0, 1, 1, 0, {}, 0.1, 1, ""), "is smaller than drone's distance accuracy"),
            (("moveOnPath", [{"x_val": 1}], 1, 1, 1, {"is_rate": True}, -1, 1, ""), "Yaw cannot be specified as rate if drivetrain is ForwardOnly"),
            (("simGetImages", [{"camera_name": "nose", "image_type": 0}], "", False), "Camera 'nose' not found"),
            (("simGetImages", [{"camera_name": "0", "image_type": 99}], "", False), "image_type 99"),
            (("simSetPanoramaResolution", "panorama_original", 100, 100, ""), "twice as wide as high"),
            (("simSetSegmentationObjectID", "[", 1, True), "threw an exception"),
            (("simSetWind", {"x_val": 1e9}), "x_val of argument 1: 1e+09 is not in"),
            (("simSetWind", {"x_val": 1e6}), "wind"),
            (("setSafety", 0, 0.0, 0, 0.0, {}, 0.0, 0.0, 0.0, ""), "safety_eval_ptr_"),
        ]
        for call, text in cases:
            self.assertError(lambda: raw.call(*call), text)
        self.assertError(lambda: raw.call(*cases[14][0]), "front_center", "panorama_original")
        after = raw.call("simGetVehiclePose", "")
        for key in ("x_val", "y_val", "z_val"):
            self.assertAlmostEqual(before["position"][key], after["position"][key], places=3)

    def test_cosys_argument_counts_are_taken_too(self):
        raw = self.raw()
        request = [{"camera_name": "0", "image_type": 0, "annotation_name": ""}]
        self.assertEqual(len(raw.call("simGetImages", request, "")), 1)
        self.assertTrue(raw.call("simGetImage", "0", 0, "", "").startswith(b"\x89PNG"))
        self.assertTrue(raw.call("simGetImage", "0", 0, "", False).startswith(b"\x89PNG"))
        self.assertEqual(raw.call("simGetCameraInfo", "0", "")["fov"], 90)
        raw.call("simSetCameraFov", "0", 90, "")
        self.assertEqual(set(raw.call("simGetObjectPose", "box", True)), {"position", "orientation"})


class Hostile(ServerTest):
    def alive(self):
        self.assertIs(self.raw().call("ping"), True)

    def test_garbage_closes_only_its_own_connection(self):
        for garbage in [b"\xc1", b"GET / HTTP/1.1\r\n\r\n", b"\xdd\xff\xff\xff\xff", b"\x91" * 100, b"\x94\x01\x02\x03\x04", os.urandom(5000)]:
            victim = socket.create_connection(("127.0.0.1", self.server.port), 10)
            victim.sendall(garbage)
            victim.close()
        self.alive()

    def test_half_messages_and_silent_clients_wait_alone(self):
        half = [socket.create_connection(("127.0.0.1", self.server.port), 10) for _ in range(20)]
        for victim in half:
            victim.sendall(msgpack.packb([0, 1, "ping", []])[:3])
        self.alive()
        for victim in half:
            victim.close()

    def test_a_client_that_does_not_read_does_not_stop_others(self):
        slow = socket.create_connection(("127.0.0.1", self.server.port), 10)
        request = msgpack.packb([0, 1, "simGetImages", [[{"camera_name": "0", "image_type": 0, "compress": False}], "", False]])
        slow.sendall(request * 200)
        other = self.raw()
        for _ in range(20):
            started = time.time()
            other.call("getMultirotorState", "")
            self.assertLess(time.time() - started, 5)
        slow.close()
        self.alive()

    def test_too_many_connections_are_turned_away(self):
        held = []
        for _ in range(100):
            held.append(socket.create_connection(("127.0.0.1", self.server.port), 10))
        time.sleep(0.3)
        for connection in held:
            connection.close()
        time.sleep(0.3)
        self.alive()

    def test_killed_clients_are_harmless(self):
        code = ("import socket,msgpack,sys,os;s=socket.create_connection(('127.0.0.1',%d));"
                "s.sendall(msgpack.packb([0,1,'simGetImages',[[{'camera_name':'panorama_original','image_type':0}],'',False]])*3);"
                "s.sendall(msgpack.packb([0,9,'moveByVelocity',[1,0,0,100,0,{'is_rate':True,'yaw_or_rate':0},'']]));"
                "print('x',flush=True);s.recv(1<<30)" % self.server.port)
        for _ in range(10):
            child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
            child.stdout.readline()
            child.send_signal(signal.SIGKILL)
            child.wait()
            child.stdout.close()
        self.alive()

    def test_a_long_message_is_refused(self):
        victim = socket.create_connection(("127.0.0.1", self.server.port), 10)
        victim.sendall(b"\x94\x00\x01\xa4ping\x91\xc6\x7f\xff\xff\xff")
        self.assertEqual(victim.recv(10), b"")
        victim.close()
        self.alive()

    def test_many_clients_at_once_get_their_own_answers(self):
        failures = []

        def work(number):
            client = RawClient(self.server.port)
            for i in range(50):
                if client.call("simPrintLogMessage", "", "", 0) is not None or client.call("ping") is not True:
                    failures.append(number)
            client.close()
        threads = [threading.Thread(target=work, args=(number,)) for number in range(16)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])


class Life(unittest.TestCase):
    def test_the_port_is_free_after_a_crash(self):
        first = Server()
        client = RawClient(first.port)
        client.call("ping")
        first.process.kill()
        first.process.wait()
        second = subprocess.Popen([os.environ["AIRSIM360"], "serve", "--world", "box_room", "--port", str(first.port)],
                                  stdout=subprocess.PIPE, text=True)
        self.assertEqual(second.stdout.readline(), f"listening on 127.0.0.1:{first.port}\n")
        second.send_signal(signal.SIGINT)
        self.assertEqual(second.wait(30), 0)
        second.stdout.close()
        first.process.stdout.close()
        client.close()

    def test_bad_flags_and_settings_are_told(self):
        def run(*arguments):
            return subprocess.run([os.environ["AIRSIM360"], "serve", *arguments], capture_output=True, text=True, timeout=60)
        nobody = run("--world", "box_room", "--people", "nobody")
        self.assertEqual(nobody.returncode, 2)
        self.assertIn("'nobody' is neither a number nor a file", nobody.stderr)
        self.assertIn("--lockstep", run("--world", "box_room", "--lockstep", "--realtime").stderr)
        self.assertIn("did you mean 'box_room'", run("--world", "box_rom").stderr)
        server = Server(settings={"Vehicles": {"A": {"VehicleType": "SimpleFlight"}}, "Unknown": 1})
        self.assertIn("'Unknown' is not known here", server.messages())
        self.assertEqual(server.stop(), 0)

    def test_it_ends_also_while_the_simulation_does_not_keep_up(self):
        drones = {f"D{i}": {"VehicleType": "SimpleFlight", "X": i} for i in range(-3, 4)}
        server = Server(settings={"ClockSpeed": 1000, "Vehicles": drones})
        client = RawClient(server.port)
        self.addCleanup(client.close)
        for name in drones:
            client.call("enableApiControl", True, name)
            client.send("moveByVelocityZ", 0.0, 0.0, -2.0, 3e38, 0, {"is_rate": True, "yaw_or_rate": 0.0}, name)
        self.assertIs(client.call("ping"), True)
        self.assertEqual(server.stop(), 0)


class SceneManager(unittest.TestCase):
    """msgpackrpc.Server, with which scene managers of AirVLN and others listen."""

    class Handler:
        def ping(self):
            return True

        def reopen_scenes(self, ip, scenes):
            if not scenes:
                raise ValueError("no scenes")
            return True, (ip, [30000 + i for i in range(len(scenes))])

        def _secret(self):
            return "secret"

    def setUp(self):
        import msgpackrpc
        self.rpc = msgpackrpc
        self.server = msgpackrpc.Server(self.Handler())
        self.server.listen(msgpackrpc.Address("127.0.0.1", 0))
        self.thread = threading.Thread(target=self.server.start)
        self.thread.start()

    def tearDown(self):
        self.server.close()
        self.thread.join(10)
        self.assertFalse(self.thread.is_alive())

    def test_calls_are_answered_and_errors_told(self):
        clients = [self.rpc.Client(self.rpc.Address(*self.server.address), timeout=20) for _ in range(2)]
        for client in clients:
            self.addCleanup(client.close)
            self.assertIs(client.call("ping"), True)
            self.assertEqual(client.call("reopen_scenes", "127.0.0.1", [1, 2]), [True, ["127.0.0.1", [30000, 30001]]])
            for call in (("reopen_scenes", "", []), ("nothing",), ("_secret",), ("ping", 1)):
                with self.assertRaises(self.rpc.error.RPCError):
                    client.call(*call)

    def test_what_is_no_message_ends_that_connection_alone(self):
        broken = socket.create_connection(self.server.address, 20)
        self.addCleanup(broken.close)
        broken.sendall(msgpack.packb([7, 7]))
        self.assertEqual(broken.recv(10), b"")
        client = self.rpc.Client(self.rpc.Address(*self.server.address), timeout=20)
        self.addCleanup(client.close)
        self.assertIs(client.call("ping"), True)


class Doors(ServerTest):
    """What was swallowed, cut short or believed once."""
    NAN = float("nan")

    def pose(self, raw, x, y, z, w=1.0, qx=0.0, qy=0.0, qz=0.0):
        raw.call("simSetVehiclePose", {"position": {"x_val": x, "y_val": y, "z_val": z},
                                       "orientation": {"w_val": w, "x_val": qx, "y_val": qy, "z_val": qz}}, True, "")

    def test_nan_leaves_a_part_of_a_pose_as_it_is(self):
        raw, nan = self.raw(), self.NAN
        raw.call("simPause", True)
        self.addCleanup(raw.call, "simPause", False)
        self.pose(raw, 1, 1, -2, 0.0, 0.0, 0.0, 1.0)
        self.pose(raw, 2, -1, -3, nan, nan, nan, nan)
        seen = raw.call("simGetVehiclePose", "")
        self.assertEqual([seen["position"][k] for k in ("x_val", "y_val", "z_val")], [2, -1, -3])
        self.assertAlmostEqual(abs(seen["orientation"]["z_val"]), 1, places=5)
        self.pose(raw, nan, nan, nan)
        seen = raw.call("simGetVehiclePose", "")
        self.assertAlmostEqual(seen["orientation"]["w_val"], 1, places=5)
        self.assertEqual(seen["position"]["x_val"], 2)
        # All numbers of a part or none.
        self.assertError(lambda: self.pose(raw, nan, 1, 2), "x_val", "nan is not a number")
        # Objects likewise.
        name = raw.call("simListSceneObjects", "box.*")[0]
        raw.call("simSetObjectPose", name, {"position": {"x_val": 3.0, "y_val": 0.0, "z_val": -1.0}, "orientation": {
            "w_val": 0.0, "x_val": 0.0, "y_val": 0.0, "z_val": 1.0}}, True)
        self.assertIs(raw.call("simSetObjectPose", name, {"position": {"x_val": nan, "y_val": nan, "z_val": nan}, "orientation": {
            "w_val": 1.0, "x_val": 0.0, "y_val": 0.0, "z_val": 0.0}}, True), True)
        seen = raw.call("simGetObjectPose", name)
        self.assertAlmostEqual(seen["position"]["x_val"], 3, places=4)
        self.assertAlmostEqual(seen["orientation"]["w_val"], 1, places=4)

    def test_a_drone_is_not_put_beyond_its_reach(self):
        raw = self.raw()
        before = raw.call("simGetVehiclePose", "")["position"]["x_val"]
        for x in (2000, 1e5, 1e6):
            self.assertError(lambda: self.pose(raw, x, 0, -1), "is out of drones' reach, 1000 m around the world: (-100", ") to (100")
        self.assertAlmostEqual(raw.call("simGetVehiclePose", "")["position"]["x_val"], before, delta=5)
        self.assertError(lambda: raw.call("simAddVehicle", "far", "simpleflight", {"position": {"x_val": 9000.0}}, ""), "out of drones' reach")

    def test_what_has_landed_says_so(self):
        raw = self.raw()
        raw.call("reset")
        raw.call("enableApiControl", True, "")
        raw.call("armDisarm", True, "")
        self.assertIs(raw.call("takeoff", 20.0, ""), True)
        self.assertEqual(raw.call("getMultirotorState", "")["landed_state"], 1)
        self.assertIs(raw.call("land", 60.0, ""), True)
        for _ in range(20):
            self.assertEqual(raw.call("getMultirotorState", "")["landed_state"], 0)
            time.sleep(0.05)
        self.assertIs(raw.call("takeoff", 20.0, ""), True)
        self.assertEqual(raw.call("getMultirotorState", "")["landed_state"], 1)
        raw.call("reset")

    def test_errors_are_utf8_and_whole(self):
        raw = self.raw()
        for name, shown in ((b"\xff", "\ufffd"), (b"a\x00b", "a\\x00b"), ("drohne\u00fc".encode(), "drohne\u00fc")):
            self.assertError(lambda: raw.call("simGetVehiclePose", name), f"Vehicle API for '{shown}' is not available. This")
        raw.socket.sendall(b"\x94\x00\x7f\xa2\xff\xfe\x90")
        self.assertIn("could not find function '\ufffd\ufffd'", raw.receive()[1])

    def test_an_unknown_drivetrain_is_refused(self):
        raw, yaw = self.raw(), {"is_rate": True, "yaw_or_rate": 0.0}
        for call in (("moveToPosition", 1.0, 0.0, -1.0, 1.0, 5.0, 7, yaw, -1.0, 1.0, ""), ("moveByVelocity", 1.0, 0.0, 0.0, 1.0, 7, yaw, "")):
            self.assertError(lambda: raw.call(*call), "drivetrain: 7 is neither 0 (MaxDegreeOfFreedom) nor 1 (ForwardOnly)")

    def test_clients_take_turns_for_pictures(self):
        many, one = self.raw(), self.raw()
        request = [{"camera_name": "0", "image_type": 1, "pixels_as_float": True}]
        for _ in range(40):
            many.send("simGetImages", request, "", False)
        many.receive()
        # All of them stand in the queue by now, and a queue for all would end with this one.
        finished = []

        def rest():
            for _ in range(39):
                many.receive()
            finished.append("many")

        thread = threading.Thread(target=rest)
        thread.start()
        one.call("simGetImages", request, "", False)
        finished.append("one")
        thread.join()
        self.assertEqual(finished, ["one", "many"])

    def test_a_wind_beyond_all_is_refused_with_the_nearest(self):
        self.assertError(lambda: self.raw().call("simSetWind", {"x_val": 0.0, "y_val": -400.0, "z_val": 0.0}),
                         "(0, -400, 0) is 400 m/s, more than 200; the nearest is (0, -200, 0)")


class Eyes(ServerTest):
    settings = {"SimMode": "ComputerVision"}

    def test_what_cannot_fly_says_so_at_once(self):
        raw, yaw = self.raw(), {"is_rate": True, "yaw_or_rate": 0.0}
        for call in (("takeoff", 2.0, ""), ("land", 2.0, ""), ("hover", ""), ("goHome", 2.0, ""), ("armDisarm", True, ""),
                     ("moveToPosition", 1.0, 0.0, -1.0, 1.0, 2.0, 0, yaw, -1.0, 1.0, ""),
                     ("moveByVelocity", 1.0, 0.0, 0.0, 2.0, 0, yaw, ""), ("rotateToYaw", 90.0, 2.0, 5.0, "")):
            with self.subTest(call[0]):
                self.assertError(lambda: raw.call(*call), "Vehicle API for '' is not available")
        # It goes where it is put, however far.
        raw.call("simSetVehiclePose", {"position": {"x_val": 2000.0}}, True, "")
        self.assertEqual(raw.call("simGetVehiclePose", "")["position"]["x_val"], 2000)


class Starting(unittest.TestCase):
    def test_a_server_that_still_lights_its_rooms_is_ended_by_a_signal(self):
        with tempfile.TemporaryDirectory() as cache:
            process = subprocess.Popen([os.environ["AIRSIM360"], "serve", "--world", "sunlit_room", "--port", "0"],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, "AIRSIM360_CACHE": cache})
            self.addCleanup(process.kill)
            # Its light takes minutes; wherever it is by then, it ends.
            time.sleep(15)
            process.send_signal(signal.SIGTERM)
            self.assertIn(process.wait(30), (-signal.SIGTERM, 0))


if __name__ == "__main__":
    unittest.main()
