"""Missions in the server: simFlyMission, simGetMission, simStopMission."""
import unittest

from harness import RawClient, ServerTest

TREE = """<root BTCPP_format="4"><BehaviorTree ID="m"><Sequence>
<Takeoff height="1.5"/>
<Capture count="3" every_s="0.25" to="up"/>
<Goto to="box" distance="1" height="1.5"/>
<Land/>
</Sequence></BehaviorTree></root>"""


class Missions(ServerTest):
    arguments = ("--lockstep",)

    def setUp(self):
        self.rpc = self.raw()
        self.rpc.call("reset")
        self.rpc.call("enableApiControl", True, "")

    def fly(self, xml, seconds):
        """Starts a mission and lets so much time pass; what it says then."""
        self.rpc.call("simFlyMission", xml, "")
        for _ in range(round(seconds)):
            self.rpc.call("simContinueForTime", 1.0)
        return self.rpc.call("simGetMission", "")

    def place(self):
        p = self.rpc.call("simGetGroundTruthKinematics", "")["position"]
        return p["x_val"], p["y_val"], p["z_val"]

    def test_a_mission_takes_off_captures_flies_to_a_thing_and_lands(self):
        self.assertEqual(self.rpc.call("simGetMission", "")["result"], "none")
        done = self.fly(TREE, 40)
        self.assertEqual((done["result"], done["log"], done["active"]), ("success", [], []))
        captures = done["captures"]
        self.assertEqual([capture["to"] for capture in captures], ["up"] * 3)
        times = [capture["time_stamp"] for capture in captures]
        # Multiples of the step of 3 ms, at a tick of the mission or the next.
        for a, b in zip(times, times[1:]):
            self.assertAlmostEqual((b - a) * 1e-9, 0.25, delta=0.025)
        for capture in captures:
            self.assertAlmostEqual(capture["pose"]["position"]["z_val"], -1.5, delta=0.4)
        # box_room's cube stands 3 m east: half its diagonal and 1 m away from its middle.
        north, east, down = self.place()
        self.assertLess(abs(down), 0.4)

    def test_it_is_the_same_every_time(self):
        first = self.fly(TREE, 12)
        where = self.place()
        self.rpc.call("reset")
        self.rpc.call("enableApiControl", True, "")
        again = self.fly(TREE, 12)
        self.assertEqual(first["result"], again["result"])
        self.assertEqual([node["label"] for node in first["active"]], [node["label"] for node in again["active"]])
        for a, b in zip(where, self.place()):
            self.assertAlmostEqual(a, b, delta=0.02)

    def test_a_move_or_a_stop_takes_the_drone_from_it(self):
        said = self.fly(TREE, 2)
        self.assertEqual(said["result"], "running")
        self.assertIn("Sequence", [node["label"] for node in said["active"]])
        self.rpc.call("simStopMission", "")
        self.assertEqual(self.rpc.call("simGetMission", "")["result"], "none")
        self.fly(TREE, 2)
        number = self.rpc.send("moveByVelocity", 0.0, 0.0, -0.5, 1.0, 0, {"is_rate": True, "yaw_or_rate": 0.0}, "")
        other = RawClient(self.server.port)
        self.addCleanup(other.close)
        other.call("simContinueForTime", 1.5)
        self.assertEqual(self.rpc.receive()[0], number)
        self.assertEqual(self.rpc.call("simGetMission", "")["result"], "failure")

    def test_mistakes_are_errors_by_name(self):
        self.assertError(lambda: self.rpc.call("simFlyMission", TREE.replace("Land", "Lnd"), ""), "mission:5: unknown node 'Lnd'", "did you mean 'Land'")
        self.assertError(lambda: self.rpc.call("simFlyMission", "", ""), "malformed XML")
        self.assertError(lambda: self.rpc.call("simFlyMission", TREE, "nobody"), "nobody")
        self.rpc.call("enableApiControl", False, "")
        self.assertError(lambda: self.rpc.call("simFlyMission", TREE, ""), "enableApiControl")


if __name__ == "__main__":
    unittest.main()
