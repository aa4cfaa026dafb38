"""`airsim360 fly` flies, notes what happened, and says what is wrong with its flags."""
import csv
import json
import math
import struct
import unittest
import xml.etree.ElementTree

from program import ProgramTest, read_png, run, tree


def clearance(p):
    """Distance to the nearest surface of box_room: its faces, or the cube of 1 m at (3, 0, 0.5)."""
    x, y, z = p
    cube = math.hypot(max(abs(x - 3) - 0.5, 0), max(abs(y) - 0.5, 0), max(z - 1, 0))
    return min(5 - abs(x), 5 - abs(y), z, 6 - z, cube)


def to_world(row, p):
    """A point of a sensor whose pose is a row of its table."""
    w, x, y, z = (row[key] for key in ("qw", "qx", "qy", "qz"))
    turned = [
        (1 - 2 * (y * y + z * z)) * p[0] + 2 * (x * y - w * z) * p[1] + 2 * (x * z + w * y) * p[2],
        2 * (x * y + w * z) * p[0] + (1 - 2 * (x * x + z * z)) * p[1] + 2 * (y * z - w * x) * p[2],
        2 * (x * z - w * y) * p[0] + 2 * (y * z + w * x) * p[1] + (1 - 2 * (x * x + y * y)) * p[2]]
    return [turned[0] + row["px"], turned[1] + row["py"], turned[2] + row["pz"]]


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

    def test_a_crash_is_told_by_the_status_and_all_is_written(self):
        out = self.folder / "crash"
        done = run("fly", "--world", "box_room", "--script", "takeoff 2; velocity 15,0,0,3", "--out", out, "--json")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("the drone has crashed: t ", done.stderr)
        crashes = [event for event in json.loads(done.stdout)["events"] if event["event"] == "crash"]
        self.assertEqual(crashes[0]["entity"], "wall east")
        self.assertTrue((out / "trajectory.csv").exists())

    def test_lands_against_the_wind_without_turning_over(self):
        wind = self.folder / "wind.yaml"
        for east, north in [(6, 0), (-4, 5)]:
            wind.write_text(f"east: {east}\nnorth: {north}\n")
            out, report = self.fly(f"wind {east}", "--script", "takeoff 1; hover 3; land", "--wind", wind)
            self.assertEqual([event["event"] for event in report["events"] if event["event"] == "crash"], [])
            rows = self.table(out / "trajectory.csv")
            landing = [row for row in rows if row["t_s"] > 5]
            # Upright and where it came down: within 1.5 s of touching, less than 0.3 m downwind.
            self.assertGreater(min(1 - 2 * (row["qx"] ** 2 + row["qy"] ** 2) for row in landing), math.cos(math.radians(25)))
            touched = next(row for row in landing if row["pz"] < 0.12)
            self.assertLess(rows[-1]["t_s"] - touched["t_s"], 1.5)
            self.assertLess(math.hypot(rows[-1]["px"], rows[-1]["py"]), 0.3)

    def test_where_it_cannot_begin_is_refused(self):
        points = self.folder / "points.csv"
        points.write_text("x,y,z\n9,0,1\n0,0,1\n")
        for arguments, words in [(["--pose", "100,0,0.5"], ["--pose", "outside of 'box_room'"]), (["--pose", "0,0,-3"], ["--pose", "outside"]),
                                 (["--pose", "3,0,0.5"], ["--pose", "inside 'box'"]), (["--pose", "0,0,1,0,30"], ["--pose", "level"]),
                                 (["--waypoints", points], ["--waypoints", "outside"])]:
            self.run_bad(2, "fly", "--world", "box_room", *arguments, "--out", self.folder / "bad", says=words)
            self.assertFalse((self.folder / "bad").exists())
        self.fly("floor", "--pose", "1,1,0", "--script", "takeoff 1; land")

    def test_flags_of_another_way_to_fly_are_refused(self):
        points = self.folder / "points.csv"
        points.write_text("x,y,z\n0,0,1\n1,0,1\n")
        for arguments, word in [(["--vmax", 3], "--waypoints"), (["--amax", 3], "--waypoints"), (["--longest", 3], "--mission"),
                                (["--fps", 3], "--video"), (["--quality", 3], "--video"), (["--people-level", 1], "--people"),
                                (["--sockets", "none.yaml"], "--people"), (["--traffic-warmup", 5], "--traffic"), (["--waypoints", points, "--pose", "0,0,1"], "--pose")]:
            self.run_bad(2, "fly", "--world", "box_room", *arguments, "--out", self.folder / "bad", says=[arguments[0], word])

    def test_a_sensor_is_not_read_more_often_than_the_simulation_steps(self):
        sensors = self.folder / "sensors.yaml"
        sensors.write_text("imus: [{name: fast, rate_hz: 3000}]")
        self.run_bad(2, "fly", "--world", "box_room", "--sensors", sensors, "--out", self.folder / "bad", says=["imu 'fast'", "3000", "1000"])

    def table(self, file):
        with open(file, newline="") as rows:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(rows)]

    def test_every_sensor_of_a_set_is_written_at_its_rate(self):
        sensors = self.folder / "sensors.yaml"
        sensors.write_text("""
imus: [{name: imu}, {name: tail, rate_hz: 80}]
range_finders:
  - {name: down, rate_hz: 20, beam_deg: 0, sigma: 0, sigma_per_metre: 0}
  - {name: ahead, rate_hz: 10, beam_deg: 0, sigma: 0, sigma_per_metre: 0, mount: {x: 0.1, pitch_deg: 0}}
lidars: [{name: top, rate_hz: 5, channels: 4, columns: 90, low_deg: -20, high_deg: 20, sigma: 0}]
cameras:
  - {name: pano, width: 64, height: 32, rate_hz: 3, tier: labels}
  - {name: front, projection: pinhole, width: 32, height: 24, rate_hz: 1}
""")
        script = ["--script", "takeoff 2; velocity 0.5,0.3,0,2; hover 1; land"]
        out, report = self.fly("run", *script, "--sensors", sensors)
        seconds, folder = report["flight_s"], out / "sensors"
        trajectory = {round(100 * row["t_s"]): row for row in self.table(out / "trajectory.csv")}
        self.assertEqual({path.name for path in folder.iterdir()},
                         {"imu.csv", "imu_tail.csv", "gnss.csv", "barometer.csv", "magnetometer.csv", "range_finder.csv",
                          "range_finder_ahead.csv", "lidar.csv", "lidar", "camera.csv", "camera", "camera_front.csv", "camera_front"})
        for name, rate in [("imu", 200), ("imu_tail", 80), ("barometer", 50), ("range_finder", 20), ("range_finder_ahead", 10),
                           ("lidar", 5), ("camera", 3), ("camera_front", 1)]:
            rows = self.table(folder / f"{name}.csv")
            self.assertEqual(len(rows), math.floor(rate * seconds + 1e-6), name)
            # At the end of the step (1 ms) in which each is due.
            for k, row in enumerate(rows, 1):
                self.assertAlmostEqual(row["t_s"], math.ceil(1000 * k / rate - 1e-6) / 1000, places=9)
        first, second = self.table(folder / "imu.csv"), self.table(folder / "imu_tail.csv")
        self.assertNotEqual(first[4]["wx"], second[1]["wx"])  # at 25 ms, each with noise of its own

        # Straight down to the floor; ahead along the body to the wall at x = 5 (the cube is lower).
        checked = 0
        for row in self.table(folder / "range_finder.csv"):
            body = trajectory[round(100 * row["t_s"])]
            if body["pz"] < 0.3:
                continue
            self.assertAlmostEqual(row["range"], body["pz"] / (1 - 2 * (body["qx"] ** 2 + body["qy"] ** 2)), delta=1e-4)
            self.assertEqual((row["valid"], row["entity"]), (1, 1))
            checked += 1
        self.assertGreater(checked, 60)
        for row in self.table(folder / "range_finder_ahead.csv"):
            body = trajectory[round(100 * row["t_s"])]
            w, x, y, z = (body[key] for key in ("qw", "qx", "qy", "qz"))
            if body["pz"] > 1.8:
                self.assertAlmostEqual(row["range"], (5 - body["px"]) / (1 - 2 * (y * y + z * z)) - 0.1, delta=1e-4)

        # Every point of every scan lies on a face of the room or the cube.
        scans = self.table(folder / "lidar.csv")
        self.assertEqual(len(list((folder / "lidar").iterdir())), len(scans))
        for row in scans:
            head, body = (folder / "lidar" / f"{int(row['scan']):06d}.ply").read_bytes().split(b"end_header\n", 1)
            points = list(struct.iter_unpack("<6fHII", body))
            self.assertEqual(len(points), row["points"])
            self.assertIn(f"element vertex {len(points)}\n".encode(), head)
            if row["pz"] > 1:
                self.assertEqual(len(points), 360)  # the room is closed
            for point in points:
                self.assertAlmostEqual(math.hypot(*point[:3]), point[3], delta=1e-4)
                self.assertAlmostEqual(clearance(to_world(row, point[:3])), 0, delta=1e-3)
                self.assertIn(point[7], range(1, 8))

        # Pictures: categories where the tier has no colours.
        pictures = self.table(folder / "camera.csv")
        self.assertEqual(len(list((folder / "camera").iterdir())), len(pictures))
        width, height, channels, size, rows = read_png(folder / "camera" / "000000.png")
        self.assertEqual((width, height, channels, size), (64, 32, 1, 2))
        self.assertEqual(read_png(folder / "camera_front" / "000001.png")[:4], (32, 24, 3, 1))
        body = trajectory[round(100 * pictures[2]["t_s"])]
        self.assertLess(math.dist([body[key] for key in ("px", "py", "pz")], [pictures[2][key] for key in ("px", "py", "pz")]), 0.02)

        # The flight is the one without them, and the same again.
        plain, _ = self.fly("plain", *script)
        self.assertEqual((plain / "trajectory.csv").read_bytes(), (out / "trajectory.csv").read_bytes())
        self.assertEqual({path.name for path in (plain / "sensors").iterdir()},
                         {"imu.csv", "gnss.csv", "barometer.csv", "magnetometer.csv"})
        again, _ = self.fly("again", *script, "--sensors", sensors, "--threads", "1")
        self.assertEqual(tree(again), tree(out))

    def test_sensors_that_cannot_be_written_are_named(self):
        sensors = self.folder / "sensors.yaml"
        fly = ("fly", "--world", "box_room", "--out", self.folder / "none", "--sensors", sensors)
        sensors.write_text("imus: [{name: a}, {name: b/c}]\n")
        self.run_bad(2, *fly, says=["--sensors", "imus", "b/c"])
        sensors.write_text("lidars: [{name: top, rate_hz: 1000}]\n")
        self.run_bad(2, *fly, "--script", "hover 2000", says=["--sensors", "'top'", "rate_hz 1000", "nearest rate_hz is 495"])
        self.assertFalse((self.folder / "none").exists())

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

    def test_a_task_that_does_not_end_is_told_by_the_status(self):
        done = run("fly", "--world", "box_room", "--script", "takeoff 2; goto 2,2,2,0.001; land", "--out", self.folder / "far", "--json")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("'goto 2,2,2,0.001' did not end and was given up", done.stderr)
        self.assertGreater(json.loads(done.stdout)["flight_s"], 600)
        self.assertTrue((self.folder / "far" / "trajectory.csv").exists())

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


MISSION = """<root BTCPP_format="4">
  <BehaviorTree ID="survey">
    <Sequence>
      <Takeoff height="1.5"/>
      <Goto to="-2;2;2" name="corner"/>
      <Capture to="walls" count="3" every_s="0.5" products="normal"/>
      <Capture/>
      <Land/>
    </Sequence>
  </BehaviorTree>
</root>
"""


class MissionTest(ProgramTest):
    def mission(self, text=MISSION):
        path = self.folder / "mission.xml"
        path.write_text(text)
        return path

    def fly(self, out, *arguments):
        return run("fly", "--world", "box_room", "--pose=-2,-2,0.5", "--mission", self.folder / "mission.xml", "--size", "64x32", "--tier", "labels", "--json", "--out", self.folder / out, *arguments)

    def test_captures_become_datasets_beside_the_flight_and_the_same_bytes_come_again(self):
        self.mission()
        trees = []
        for out, threads in [("a", 1), ("b", 2)]:
            result = self.fly(out, "--record", "--threads", threads)
            self.assertEqual(result.returncode, 0, result.stderr)
            report = json.loads(result.stdout)
            self.assertEqual(report["mission"]["result"], "success")
            self.assertEqual(report["mission"]["captures"], {"walls": 3, "captures": 1})
            trees.append(tree(self.folder / out))
        self.assertEqual(trees[0], trees[1])
        self.assertIn("run.a360", trees[0])
        for name, count in [("walls", 3), ("captures", 1)]:
            self.assertEqual(run("verify", self.folder / "a" / name).returncode, 0)
            frames = [json.loads(line) for line in (self.folder / "a" / name / "frames.jsonl").read_text().splitlines()]
            self.assertEqual(len(frames), count)
            self.assertEqual((self.folder / "a" / name / "normal").exists(), name == "walls")
            for frame in frames:
                for got, wanted in zip(frame["X_WC"]["p"], [-2, 2, 2]):
                    self.assertAlmostEqual(got, wanted, delta=0.15)
        times = [json.loads(line)["t_ns"] for line in (self.folder / "a/walls/frames.jsonl").read_text().splitlines()]
        self.assertEqual([b - a for a, b in zip(times, times[1:])], [500_000_000] * 2)

    def test_a_mission_that_fails_or_takes_too_long_has_status_1_and_its_files(self):
        for text, flags, words in [(MISSION.replace("-2;2;2", "-2;2;9"), [], ["the mission has failed", "line 5, corner: "]), (MISSION, ["--longest", 3], ["stopped after 3 s"])]:
            self.mission(text)
            result = self.fly("bad" + str(len(flags)), *flags)
            self.assertEqual(result.returncode, 1)
            for word in words:
                self.assertIn(word, result.stderr)
            self.assertTrue((self.folder / ("bad" + str(len(flags))) / "trajectory.csv").exists())

    def test_mistakes_are_named_by_file_line_and_value_before_anything_flies(self):
        for text, wanted in [(MISSION.replace("<Land/>", "<Lnd/>"), "mission.xml:8: unknown node 'Lnd'; did you mean 'Land'"),
                             (MISSION.replace("-2;2;2", "bux"), "mission.xml:5: Goto to: no thing, person or vehicle 'bux' in the world; did you mean 'box'?"),
                             (MISSION.replace('count="3"', 'count="1e308"'), "mission.xml:6: Capture count: 1e+308 is not in 1 … 100000"),
                             (MISSION[:200], "malformed XML"), ("", "malformed XML"), ("<" * 100000, "malformed XML"),
                             (MISSION.replace("<Land/>", "<Inverter>" * 100 + "<Land/>" + "</Inverter>" * 100), "64 deep")]:
            path = self.mission(text)
            result = self.fly("none")
            self.assertEqual(result.returncode, 2, text[:80])
            self.assertIn(wanted, result.stderr)
            self.assertIn(str(path), result.stderr)
            self.assertFalse((self.folder / "none").exists())
        self.mission()
        result = self.fly("none", "--script", "land")
        self.assertEqual(result.returncode, 2)
        self.assertIn("give one of --waypoints, --script and --mission", result.stderr)


class TreesTest(ProgramTest):
    def test_the_palette_and_the_trees_are_files_that_editors_read(self):
        for flags, leaf in [([], "WanderTo"), (["--mission"], "Orbit")]:
            model = xml.etree.ElementTree.fromstring(self.run_ok("people", "nodes", "--xml", *flags).stdout)
            self.assertEqual((model.tag, model.get("BTCPP_format"), model[0].tag), ("root", "4", "TreeNodesModel"))
            self.assertIn(leaf, [node.get("ID") for node in model[0]])
            nodes = json.loads(self.run_ok("people", "nodes", "--json", *flags).stdout)["nodes"]
            self.assertIn(leaf, [node["name"] for node in nodes])
        report = json.loads(self.run_ok("people", "trees", "--json", "--out", self.folder / "trees.xml").stdout)
        self.assertIn("walker", report["trees"])
        again = self.run_ok("people", "trees", self.folder / "trees.xml").stdout
        self.assertEqual(again, (self.folder / "trees.xml").read_text())
        # However it was laid out by another editor, and with a palette in it.
        other = again.replace("\n", "\n\n  ").replace("</root>", "<!-- by hand --></root>")
        (self.folder / "other.xml").write_text(other)
        self.assertEqual(self.run_ok("people", "trees", self.folder / "other.xml").stdout, again)
        (self.folder / "bad.xml").write_text(again.replace("<WanderTo", "<WandrTo", 1))
        result = run("people", "trees", self.folder / "bad.xml")
        self.assertEqual(result.returncode, 2)
        self.assertIn("did you mean 'WanderTo'", result.stderr)


if __name__ == "__main__":
    unittest.main()
