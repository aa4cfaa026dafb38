"""The traffic in the server: simListTraffic, simGetTraffic, simGetNearMisses, and vehicles as objects of AirSim's calls."""
import math
import unittest

import numpy as np
from harness import RawClient, Server, ServerTest


def vector(value):
    return np.array([value["x_val"], value["y_val"], value["z_val"]])


def rotation(q):
    w, x, y, z = (q[key] for key in ("w_val", "x_val", "y_val", "z_val"))
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def pose(p, pitch=0.0):
    return {"position": dict(zip(("x_val", "y_val", "z_val"), map(float, p))),
            "orientation": {"w_val": math.cos(pitch / 2), "x_val": 0.0, "y_val": math.sin(pitch / 2), "z_val": 0.0}}


class Traffic(ServerTest):
    world, arguments = "downtown_west", ("--lockstep", "--traffic", "80")
    settings = {"Vehicles": {"Eye": {"VehicleType": "ComputerVision"}}}

    def setUp(self):
        self.rpc = self.raw()

    def origin(self):
        """Of the vehicle's own frame in the global one."""
        return vector(self.rpc.call("simGetObjectPose", "Eye")["position"]) - vector(self.rpc.call("simGetVehiclePose", "Eye")["position"])

    def test_vehicles_are_listed_and_move_by_their_velocities(self):
        names = self.rpc.call("simListTraffic")
        self.assertEqual(names, [f"traffic/{i:03}" for i in range(80)])
        before = self.rpc.call("simGetTraffic")
        self.assertEqual([vehicle["name"] for vehicle in before], names)
        self.assertEqual([vehicle["track_id"] for vehicle in before], list(range(1, 81)))
        self.rpc.call("simContinueForTime", 0.2)
        after = self.rpc.call("simGetTraffic")
        moving = 0
        for a, b in zip(before, after):
            mean = (vector(a["velocity"]) + vector(b["velocity"])) / 2
            moved = (vector(b["pose"]["position"]) - vector(a["pose"]["position"])) / 0.2
            self.assertLess(np.linalg.norm(moved - mean), 0.2 + 0.12 * np.linalg.norm(mean), a["name"])
            moving += np.linalg.norm(mean) > 2
            # In N the body looks along x: so does it drive.
            ahead = rotation(b["pose"]["orientation"])[:, 0]
            speed = np.linalg.norm(vector(b["velocity"]))
            if speed > 0.1:
                self.assertGreater(np.dot(vector(b["velocity"]) / speed, ahead), 0.9)  # in a bend its middle swings out a little
            self.assertIn(b["indicator"], ("left", "right", "off"))
            self.assertGreaterEqual(b["lane_position"], 0)
            self.assertTrue(b["category"].startswith("vehicle/"))
        self.assertGreater(moving, 10)

    def test_they_are_objects_that_drive_by_themselves(self):
        names = self.rpc.call("simListTraffic")
        self.assertEqual(self.rpc.call("simListSceneObjects", "traffic/.*"), names)
        for vehicle in self.rpc.call("simGetTraffic")[:10]:
            place = self.rpc.call("simGetObjectPose", vehicle["name"])
            self.assertEqual(place, vehicle["pose"])
        self.assertFalse(self.rpc.call("simSetObjectPose", names[0], pose((0, 0, -5)), True))
        self.assertFalse(self.rpc.call("simDestroyObject", names[0]))
        self.assertIn("'traffic/000' is a vehicle of the traffic and drives by itself", self.server.messages())
        tags = dict(self.rpc.call("simListSceneObjectsTags", "traffic/.*"))
        self.assertEqual(tags, {vehicle["name"]: vehicle["category"] for vehicle in self.rpc.call("simGetTraffic")})

    def test_detections_find_them_with_their_boxes(self):
        self.rpc.call("simAddDetectionFilterMeshName", "0", 0, "traffic/*", "Eye", False)
        self.rpc.call("simSetDetectionFilterRadius", "0", 0, 6000.0, "Eye", False)
        origin, checked = self.origin(), 0
        for vehicle in self.rpc.call("simGetTraffic")[:12]:
            p = vector(vehicle["pose"]["position"])
            # 15 m above it, looking straight down.
            self.rpc.call("simSetVehiclePose", pose(p - origin - (0, 0, 15), -math.pi / 2), True, "Eye")
            found = {item["name"]: item for item in self.rpc.call("simGetDetections", "0", 0, "Eye", False)}
            if vehicle["name"] not in found:
                continue  # under a tree
            checked += 1
            item = found[vehicle["name"]]
            camera = self.rpc.call("simGetCameraInfo", "0", "Eye", False)["pose"]
            R = rotation(camera["orientation"])
            relative = R.T @ (p - vector(camera["position"]) - origin)
            np.testing.assert_allclose(vector(item["relative_pose"]["position"]), relative, atol=5e-3)
            length, width, height = vector(vehicle["size"])
            corners = np.array([(x, y, z) for x in (-length / 2, length / 2) for y in (-width / 2, width / 2) for z in (-height, 0)])
            corners = corners @ rotation(vehicle["pose"]["orientation"]).T @ R + relative
            np.testing.assert_allclose(vector(item["box3D"]["min"]), corners.min(axis=0), atol=5e-3)
            np.testing.assert_allclose(vector(item["box3D"]["max"]), corners.max(axis=0), atol=5e-3)
        self.rpc.call("simClearDetectionMeshNames", "0", 0, "Eye", False)
        self.assertGreater(checked, 3)

    def test_what_drops_before_a_fast_vehicle_is_a_near_miss(self):
        origin = self.origin()
        before = len(self.rpc.call("simGetNearMisses"))
        fast = max(self.rpc.call("simGetTraffic"), key=lambda vehicle: np.linalg.norm(vector(vehicle["velocity"])))
        ahead = rotation(fast["pose"]["orientation"])[:, 0]
        p = vector(fast["pose"]["position"]) + ahead * (fast["size"]["x_val"] / 2 + 5) - (0, 0, 0.5)
        self.rpc.call("simSetVehiclePose", pose(p - origin), True, "Eye")
        self.rpc.call("simContinueForTime", 0.3)
        self.assertEqual(len(self.rpc.call("simGetNearMisses")), before)  # not over yet
        self.rpc.call("simSetVehiclePose", pose(p - origin - (0, 0, 60)), True, "Eye")
        self.rpc.call("simContinueForTime", 2.0)
        misses = [miss for miss in self.rpc.call("simGetNearMisses")[before:] if miss["first"] == fast["name"]]
        self.assertEqual([miss["second"] for miss in misses], ["Eye"])
        self.assertLess(misses[0]["time_to_collision"], 5 / np.linalg.norm(vector(fast["velocity"])) + 0.1)
        self.assertGreater(misses[0]["braking"], 3.3)


class WithoutTraffic(unittest.TestCase):
    def test_without_traffic_the_flag_is_named(self):
        server = Server(arguments=("--lockstep",))
        self.addCleanup(server.stop)
        client = RawClient(server.port)
        self.addCleanup(client.close)
        for call in ("simListTraffic", "simGetTraffic", "simGetNearMisses"):
            with self.assertRaises(RuntimeError) as caught:
                client.call(call)
            self.assertIn("--traffic N", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
