"""`airsim360 fly` flies, notes what happened, and says what is wrong with its flags."""
import csv
import json
import math
import unittest

from program import ProgramTest, tree


def clearance(p):
    """Distance to the nearest surface of box_room: its faces, or the cube of 1 m at (3, 0, 0.5)."""
    x, y, z = p
    cube = math.hypot(max(abs(x - 3) - 0.5, 0), max(abs(y) - 0.5, 0), max(z - 1, 0))
    return min(5 - abs(x), 5 - abs(y), z, 6 - z, cube)


class FlyTest(ProgramTest):
    def fly(self, name, *arguments):
        out = self.folder / name
        result = self.run_ok("fly", "--world", "box_room", "--json", "--out", out, *arguments)
        return out, json.loads(result.stdout)

    def test_takes_off_hovers_and_lands_where_it_started(self):
        out, report = self.fly("run", "--script", "takeoff 2; hover 1; land")
        events = [event["event"] for event in report["events"]]
        # Neither standing, nor taking off, nor landing is a collision.
        self.assertEqual(set(events) - {"command done"}, set())
        self.assertGreater(report["least_clearance"], 1.9)  # in the air
        with open(out / "trajectory.csv", newline="") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        self.assertAlmostEqual(max(row["pz"] for row in rows), 2, delta=0.3)
        self.assertLess(math.dist((rows[0]["px"], rows[0]["py"], rows[0]["pz"]), (rows[-1]["px"], rows[-1]["py"], rows[-1]["pz"])), 0.1)
        # Time of the trajectory and of the IMU go on in equal steps.
        self.assertTrue(all(abs(b["t_s"] - a["t_s"] - 0.01) < 1e-9 for a, b in zip(rows, rows[1:])))
        with open(out / "sensors" / "imu.csv", newline="") as file:
            imu = list(csv.DictReader(file))
        self.assertAlmostEqual(len(imu), 200 * report["flight_s"], delta=2)

    def test_same_seed_same_files_also_with_one_thread(self):
        first, report = self.fly("a", "--script", "takeoff 2; goto 2,1,3; land", "--seed", "3", "--record")
        second, again = self.fly("b", "--script", "takeoff 2; goto 2,1,3; land", "--seed", "3", "--record", "--threads", "1")
        self.assertEqual(tree(first), tree(second))
        self.assertEqual(report["state_hash"], again["state_hash"])

    def test_waypoints_are_tracked_and_frames_written(self):
        points = self.folder / "points.csv"
        points.write_text("x,y,z\n-2,-2,3\n2,-2,3.5\n2,2,3\n-2,2,3.5\n")
        out, report = self.fly("run", "--waypoints", points, "--vmax", "2", "--amax", "2", "--frames", "2", "--size", "128x64", "--tier", "labels")
        self.assertLess(report["tracking_rms"], 0.1)
        with open(out / "trajectory.csv", newline="") as file:
            places = [(float(row["px"]), float(row["py"]), float(row["pz"])) for row in csv.DictReader(file)]
        self.assertAlmostEqual(report["least_clearance"], min(map(clearance, places)), delta=1e-4)
        self.assertEqual(len((out / "frames" / "frames.jsonl").read_text().splitlines()), 2)

    def test_a_wall_is_reported(self):
        _, report = self.fly("run", "--script", "takeoff 2; velocity 2,0,0,6")
        hits = [event for event in report["events"] if event["event"] == "collision" and event["entity"] == "wall east"]
        self.assertTrue(hits)
        self.assertAlmostEqual(hits[0]["point"][0], 5, delta=0.01)
        self.assertAlmostEqual(hits[0]["normal"][0], -1, delta=1e-3)

    def test_a_flight_that_stays_on_the_ground_has_no_clearance(self):
        _, report = self.fly("run", "--script", "land")
        self.assertIsNone(report["least_clearance"])

    def test_another_flight_is_refused_and_the_same_again_is_the_same(self):
        script = ["--script", "takeoff 1; land"]
        out, _ = self.fly("run", *script)
        before = tree(out)
        self.fly("run", *script)
        self.assertEqual(tree(out), before)
        self.fly("run", *script, "--frames", "1", "--size", "64x32", "--tier", "labels")
        self.assertEqual({name: value for name, value in tree(out).items() if not name.startswith("frames/")}, before)
        before = tree(out)
        fly = ["fly", "--world", "box_room", "--out", out]
        for flags, says in [([*script, "--seed", "2"], ["seed is 0 there, 2 here"]), (["--script", "takeoff 2; land"], ["script is"]),
                            ([*script, "--drone", "f450"], ["drone is \"hummingbird\" there"]), ([*script, "--weather", "fog"], ["environment"])]:
            self.run_bad(2, *fly, *flags, says=["--out", "holds another flight", *says])
        self.run_bad(2, "fly", "--world", "sunlit_room", "--out", out, *script, says=["world is \"box_room\" there, \"sunlit_room\" here"])
        self.run_bad(2, "render", "--world", "box_room", "--size", "64x32", "--tier", "labels", "--out", out, says=["not a dataset"])
        self.assertEqual(tree(out), before)
        (self.folder / "other").mkdir()
        (self.folder / "other" / "letter.txt").write_text("mine")
        self.run_bad(2, "fly", "--world", "box_room", "--out", self.folder / "other", *script, says=["not a flight", "letter.txt"])
        self.assertEqual(list(tree(self.folder / "other")), ["letter.txt"])

    def test_wrong_flags_are_named(self):
        out = self.folder / "none"
        fly = ("fly", "--world", "box_room", "--out", out)
        self.run_bad(2, *fly, "--drone", "humingbird", says=["hummingbird"])
        self.run_bad(2, *fly, "--script", "takeof 2", says=["--script", "takeoff"])
        self.run_bad(2, *fly, "--script", "hover soon", says=["--script", "soon", "'hover SECONDS'"])
        self.run_bad(2, *fly, "--script", "goto 20 5 8", says=["'20 5 8' is not a number", "'goto X,Y,Z[,SPEED]'"])
        self.run_bad(2, *fly, "--script", "goto 1,2", says=["found 2 numbers", "'goto X,Y,Z[,SPEED]'"])
        self.run_bad(2, *fly, "--controller", "pid", says=["pid", "px4"])
        self.run_bad(2, *fly, "--drone", "a submarine", says=["submarine", "multirotor"])
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
