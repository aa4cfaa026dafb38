"""airsim360 plan: formats read back with decoders of our own, limits, free flights, errors, the waypoint set."""
import json
import math
import struct
import unittest
import zipfile

from program import ProgramTest, read_json, tree

LIMITS = ["--vmax", "5", "--amax", "3"]


def horner(coefficients, t):
    value = 0.0
    for c in reversed(coefficients):
        value = value * t + c
    return value


def derivative(coefficients):
    return [k * c for k, c in enumerate(coefficients)][1:] or [0.0]


class Trajectory:
    """The JSON of `plan`, evaluated in plain Python."""

    def __init__(self, path):
        self.json = read_json(path)
        self.durations = self.json["durations"]
        self.duration = sum(self.durations)

    def at(self, t, order=0):
        segment = 0
        while segment + 1 < len(self.durations) and t > self.durations[segment]:
            t -= self.durations[segment]
            segment += 1
        out = []
        for axis in self.json["coefficients"][segment]:
            for _ in range(order):
                axis = derivative(axis)
            out.append(horner(axis, t))
        return out


def norm(v):
    return math.sqrt(sum(x * x for x in v))


def distance(a, b):
    return norm([x - y for x, y in zip(a, b)])


class Waypoints(ProgramTest):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "route.csv"
        self.points = [(0, 0, 2), (10, 0, 3), (10, 10, 4), (0, 10, 2)]
        self.file.write_text("x,y,z\n" + "".join("%g,%g,%g\n" % p for p in self.points))

    def plan(self, *arguments):
        return self.run_ok("plan", "--waypoints", self.file, *LIMITS, *arguments)

    def test_json_is_the_trajectory_of_the_contract(self):
        for order in (5, 7):
            out = self.folder / f"order{order}.json"
            report = json.loads(self.plan("--order", order, "--out", out, "--json").stdout)
            trajectory = Trajectory(out)
            data = trajectory.json
            self.assertEqual(data["order"], order)
            self.assertEqual(len(data["times"]), len(self.points))
            self.assertTrue(all(len(axis) == order + 1 for segment in data["coefficients"] for axis in segment))
            # Through the waypoints at their times, at rest at both ends.
            for t, p in zip(data["times"], self.points):
                self.assertLess(distance(trajectory.at(t), p), 1e-9)
            for t in (0, trajectory.duration):
                self.assertLess(norm(trajectory.at(t, 1)), 1e-8)
                self.assertLess(norm(trajectory.at(t, 2)), 1e-7)
            # Certified maxima bound dense samples and respect the limits, one of them to 1e-6.
            times = [trajectory.duration * k / 20000 for k in range(20001)]
            speed = max(norm(trajectory.at(t, 1)) for t in times)
            acceleration = max(norm(trajectory.at(t, 2)) for t in times)
            self.assertLessEqual(speed, data["max_speed"] * (1 + 1e-12))
            self.assertLessEqual(acceleration, data["max_acceleration"] * (1 + 1e-12))
            self.assertLess(data["max_speed"] - speed, 1e-5)
            self.assertLessEqual(data["max_speed"], 5 * (1 + 1e-9))
            self.assertLessEqual(data["max_acceleration"], 3 * (1 + 1e-9))
            self.assertLess(min(5 - data["max_speed"], 3 - data["max_acceleration"]), 1e-6)
            # The cost: squared snap by Simpson's rule a segment (a polynomial of degree 6 or less: fine steps).
            cost, n = 0.0, 2000
            for i, duration in enumerate(trajectory.durations):
                start = sum(trajectory.durations[:i]) + 1e-12
                values = []
                for k in range(n + 1):
                    snap = []
                    for axis in data["coefficients"][i]:
                        for _ in range(4):
                            axis = derivative(axis)
                        snap.append(horner(axis, duration * k / n))
                    values.append(norm(snap) ** 2)
                cost += duration / n / 3 * (values[0] + values[-1] + 4 * sum(values[1:-1:2]) + 2 * sum(values[2:-1:2]))
            self.assertAlmostEqual(cost / data["cost_snap"], 1, delta=1e-6)
            self.assertAlmostEqual(report["cost_snap"], data["cost_snap"])
            self.assertTrue(report["within_limits"])

    def test_all_formats_at_once_agree(self):
        self.plan("--out", self.folder / "a", "--format",
                  "csv,json,npz,yaml,crazyflie,crazyflie-compressed,qgc,mavlink,svg", "--origin", "47.397742,8.545594,488")
        trajectory = Trajectory(self.folder / "a.json")
        lines = (self.folder / "a.csv").read_text().splitlines()
        self.assertEqual(lines[0], "t_s,px,py,pz,vx,vy,vz,ax,ay,az")
        for line in lines[1:]:
            row = [float(v) for v in line.split(",")]
            for order in range(3):
                self.assertLess(distance(row[1 + 3 * order:4 + 3 * order], trajectory.at(row[0], order)), 1e-9)
        # poly4d: single precision, a row a piece.
        rows = (self.folder / "a.poly4d.csv").read_text().splitlines()
        self.assertEqual(len(rows[0].split(",")), 33)
        start = 0.0
        for line in rows[1:]:
            values = [float(v) for v in line.split(",")]
            for k in range(21):
                t = values[0] * k / 20
                p = [horner(values[1 + 8 * axis:9 + 8 * axis], t) for axis in range(3)]
                self.assertLess(distance(p, trajectory.at(start + t)), 1e-3)
            start += values[0]
        # QGroundControl: take-off, speed, waypoints, landing.
        plan = read_json(self.folder / "a.plan")
        self.assertEqual((plan["fileType"], plan["mission"]["version"]), ("Plan", 2))
        commands = [item["command"] for item in plan["mission"]["items"]]
        self.assertEqual((commands[:2], commands[-1]), ([22, 178], 21))
        self.assertTrue(all(c == 16 for c in commands[2:-1]))
        self.assertEqual([item["doJumpId"] for item in plan["mission"]["items"]], list(range(1, len(commands) + 1)))
        # Setpoints: north, east, down.
        for line in (self.folder / "a.setpoints.csv").read_text().splitlines()[1::50]:
            row = [float(v) for v in line.split(",")]
            self.assertLess(distance([row[4], row[3], -row[5]], trajectory.at(row[0] / 1000)), 0.01)
        # NPZ, without numpy.
        with zipfile.ZipFile(self.folder / "a.npz") as archive:
            self.assertIsNone(archive.testzip())
            data = archive.read("durations.npy")
            count = len(trajectory.durations)
            self.assertEqual(list(struct.unpack(f"<{count}d", data[-8 * count:])), trajectory.durations)
        self.assertTrue((self.folder / "a.svg").read_text().endswith("</svg>\n"))

    def test_the_place_of_a_qgc_plan_is_asked_for(self):
        points = self.folder / "two.csv"
        points.write_text("x,y,z\n0,0,2\n30,0,2\n")
        plan = ["plan", "--waypoints", points, "--vmax", "8", "--amax", "4"]
        for flags in (["--out", self.folder / "a.plan", "--format", "qgc"], ["--out", self.folder / "a", "--format", "csv,qgc"]):
            self.run_bad(2, *plan, *flags, says=["--origin", "qgc", "47.397742,8.545594,488"])
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["route.csv", "two.csv"])

    def test_times_in_the_csv_are_as_short_as_they_can_be(self):
        points = self.folder / "two.csv"
        points.write_text("x,y,z\n0,0,2\n30,0,2\n")
        for step, digits in (("0.1", 1), ("0.025", 3), ("0.5", 1)):
            self.run_ok("plan", "--waypoints", points, "--vmax", "8", "--amax", "4", "--dt", step, "--out", self.folder / "a.csv")
            times = [line.split(",")[0] for line in (self.folder / "a.csv").read_text().splitlines()[1:]]
            for i, time in enumerate(times):
                self.assertLessEqual(len(time.partition(".")[2]), digits, time)
                self.assertAlmostEqual(float(time), i * float(step), delta=1e-12)

    def test_two_points_take_no_longer_than_with_points_between(self):
        route = self.folder / "route.csv"
        durations = []
        for count in (0, 2, 6):
            route.write_text("x,y,z\n" + "".join(f"{61.5 * i / (count + 1)},0,2\n" for i in range(count + 2)))
            report = json.loads(self.run_ok("plan", "--waypoints", route, "--vmax", "8", "--amax", "4", "--json", "--out", self.folder / "a.json").stdout)
            self.assertTrue(report["within_limits"])
            durations.append(report["duration"])
            planned = read_json(self.folder / "a.json")
            self.assertEqual(len(planned["waypoints"]), report["segments"] + 1)
            self.assertEqual(len(planned["waypoints"]) - (count + 2), report["waypoints_added"])
        self.assertLess(durations[0], 1.02 * min(durations))

    def test_given_times_are_kept_and_limits_only_reported(self):
        self.file.write_text("# a comment\nx,y,z,t\n0,0,2,1\n10,0,3,3\n10,10,4,6.5\n")
        out = self.folder / "t.json"
        report = json.loads(self.plan("--out", out, "--json").stdout)
        self.assertEqual(read_json(out)["times"], [1, 3, 6.5])
        self.assertFalse(report["within_limits"])
        self.run_ok("plan", "--waypoints", self.file, "--out", out)  # no limits are needed then

    def test_yaml_and_geographic_routes_are_the_same_flight(self):
        self.plan("--out", self.folder / "csv.json")
        expected = Trajectory(self.folder / "csv.json")
        self.file = self.folder / "route.yaml"
        self.file.write_text("waypoints:\n" + "".join("- {x: %g, y: %g, z: %g}\n" % p for p in self.points))
        self.plan("--out", self.folder / "yaml.json")
        self.assertEqual(Trajectory(self.folder / "yaml.json").json, expected.json)

    def test_errors_name_line_and_value(self):
        out = self.folder / "out.json"
        for text, says in [
            ("0,0,2\n", ["route.csv:1", "at least two"]),
            ("x,y,z\n0,0,2\n1,1,1\n1,1,1\n", ["route.csv:4", "coincides"]),
            ("0,0,2,1\n1,0,2,1\n", ["route.csv:2", "t does not grow"]),
            ("0,0,2\n1,nan,2\n", ["route.csv:2:3", "nan"]),
            ("0,0,2\n1,inf,2\n", ["route.csv:2:3"]),
            ("", ["route.csv", "no points"]),
        ]:
            self.file.write_text(text)
            self.run_bad(2, "plan", "--waypoints", self.file, *LIMITS, "--out", out, says=says)
        yaml = "waypoints:\n- {x: 0, y: 0, z: 2%s}\n- {x: %s, y: 0, z: 2%s}\n"
        gpx = '<gpx>\n<wpt lat="47" lon="8"/>\n<wpt lat="%s" lon="8"/>\n</gpx>\n'
        kml = "<kml><coordinates>\n8,47,5\n%s\n</coordinates></kml>\n"
        for name, text, says in [
            ("r.yaml", yaml % ("", "0", ""), ["r.yaml:3", "(0, 0, 2) coincides"]),
            ("r.yaml", yaml % (", t: 3", "1", ", t: 2.5"), ["r.yaml:3", "2.5 s after 3 s"]),
            ("r.yaml", yaml % ("", ".nan", ""), ["r.yaml:3", ".nan"]),
            ("r.yaml", yaml.split("%s}", 1)[0] + "}\n", ["r.yaml:2", "at least two"]),
            ("r.json", '{"waypoints": [{"x": 0, "y": 0, "z": 2},\n{"x": 0, "y": 0, "z": 2}]}', ["r.json:2", "coincides"]),
            ("r.gpx", gpx % "47", ["r.gpx:3", "coincides"]),
            ("r.gpx", gpx % "nan", ["r.gpx:3", "nan"]),
            ("r.gpx", gpx % "95", ["r.gpx:3", "95"]),
            ("r.gpx", '<gpx>\n<wpt lat="47" lon="8"/></gpx>', ["r.gpx:2", "at least two"]),
            ("r.kml", kml % "8,47,5", ["r.kml:3", "coincides"]),
            ("r.kml", kml % "8,4x,5", ["r.kml:3", "4x"]),
            ("r.kml", kml % "", ["r.kml:2", "at least two"]),
        ]:
            (self.folder / name).write_text(text)
            self.run_bad(2, "plan", "--waypoints", self.folder / name, *LIMITS, "--out", out, says=says)
        self.file.write_text("0,0,2\n1,0,2\n")
        for arguments, says in [
            (["--vmax", "0", "--amax", "1"], ["--vmax"]),
            (["--vmax", "-3", "--amax", "1"], ["--vmax", "-3"]),
            (["--vmax", "nan", "--amax", "1"], ["--vmax", "nan"]),
            (["--vmax", "3"], ["--amax"]),
            (["--vmax", "3", "--amax", "1e-300"], ["1e-300"]),
            ([*LIMITS, "--climb", "-2"], ["--climb", "-2"]), ([*LIMITS, "--climb", "0"], ["--climb", "0"]),
            ([*LIMITS, "--axis-vmax", "1,0,2"], ["--axis-vmax"]),
            ([*LIMITS, "--axis-amax", "1,2"], ["--axis-amax", "1,2"]),
            ([*LIMITS, "--drone", "humminbird"], ["did you mean 'hummingbird'"]),
            ([*LIMITS, "--minimise", "jrk"], ["did you mean 'jerk'"]),
            ([*LIMITS, "--minimise", "jerk", "--order", "7"], ["--order"]),
            ([*LIMITS, "--order", "6"], ["--order", "6"]),
            ([*LIMITS, "--dt", "-1"], ["--dt", "-1"]), ([*LIMITS, "--dt", "0"], ["--dt", "0"]),
            ([*LIMITS, "--format", "jsn"], ["did you mean 'json'"]),
            ([*LIMITS, "--avoid"], ["--world"]),
        ]:
            self.run_bad(2, "plan", "--waypoints", self.file, *arguments, "--out", out, says=says)
        self.run_bad(2, "plan", "--waypoints", self.file, *LIMITS, "--out", self.folder / "x.foo", says=["x.foo"])
        self.run_bad(2, "plan", *LIMITS, "--out", out, says=["--waypoints"])
        self.assertFalse(out.exists())


    def test_vertical_axis_and_drone_limits_hold_and_one_of_them_binds(self):
        out = self.folder / "l.json"
        climbing = "0,0,0\n0,0,30\n40,30,5\n"
        self.file.write_text(climbing)
        wide = ["--vmax", "50", "--amax", "50"]
        for flags, axis, order, sign, limit in [
            (["--climb", "2"], 2, 1, 1, 2), (["--descent", "1.5"], 2, 1, -1, 1.5),
            (["--axis-vmax", "3,90,90"], 0, 1, 1, 3), (["--axis-amax", "90,0.5,90"], 1, 2, 0, 0.5),
        ]:
            self.run_ok("plan", "--waypoints", self.file, *wide, *flags, "--out", out)
            trajectory = Trajectory(out)
            values = [trajectory.at(trajectory.duration * k / 5000, order)[axis] for k in range(5001)]
            most = max(abs(v) if sign == 0 else sign * v for v in values)
            self.assertLessEqual(most, limit * (1 + 1e-12), flags)
            self.assertGreater(most, limit * (1 - 1e-4), flags)
        report = json.loads(self.run_ok("plan", "--waypoints", self.file, "--vmax", "300", "--amax", "300", "--drone", "hummingbird", "--out", out,
                                        "--json").stdout)
        self.assertTrue(report["within_limits"])
        trajectory = Trajectory(out)
        thrust = rate = 0
        for k in range(5001):
            a, j = (trajectory.at(trajectory.duration * k / 5000, order) for order in (2, 3))
            a[2] += 9.80665
            cross = [a[1] * j[2] - a[2] * j[1], a[2] * j[0] - a[0] * j[2], a[0] * j[1] - a[1] * j[0]]
            thrust, rate = max(thrust, norm(a)), max(rate, norm(cross) / norm(a) ** 2)
        for most, peak, limit in [(thrust, "max_thrust", "thrust_limit"), (rate, "max_body_rate", "body_rate_limit")]:
            self.assertLessEqual(most, report[peak] * (1 + 1e-9))
            self.assertGreater(most, report[peak] * (1 - 1e-4))
            self.assertLessEqual(report[peak], report[limit])
        self.assertGreater(max(report["max_thrust"] / report["thrust_limit"], report["max_body_rate"] / report["body_rate_limit"]), 1 - 1e-6)

    def test_least_jerk_has_less_jerk_than_the_papers_quintic(self):
        self.file.write_text("x,y,z,t\n0,0,2,0\n10,0,3,2\n10,10,4,5\n")
        costs = []
        for flags in (["--order", "5"], ["--minimise", "jerk"]):
            out = self.folder / "j.json"
            self.run_ok("plan", "--waypoints", self.file, *flags, "--out", out)
            trajectory = Trajectory(out)
            self.assertEqual(trajectory.json["order"], 5)
            costs.append(sum(norm(trajectory.at(5 * (k + 0.5) / 5000, 3)) ** 2 for k in range(5000)) / 1000)
        self.assertLess(costs[1], 0.999 * costs[0])


class FreeFlights(ProgramTest):
    """In the box room: x and y within 5 m, z from 0 to 6, and a cube of 1 m at (3, 0, 0.5)."""

    def clearance(self, p):
        walls = min(p[0] + 5, 5 - p[0], p[1] + 5, 5 - p[1], p[2], 6 - p[2])
        cube = norm([max(abs(v - c) - 0.5, 0) for v, c in zip(p, (3, 0, 0.5))])
        return min(walls, cube)

    def test_goes_around_the_cube_and_keeps_its_distance(self):
        out = self.folder / "free.json"
        self.run_ok("plan", "--from", "0,0,0.6", "--to", "4.4,0,0.6", "--world", "box_room", "--vmax", "3", "--amax", "2",
                    "--clearance", "0.4", "--out", out)
        trajectory = Trajectory(out)
        self.assertTrue(trajectory.json["collision_free"])
        least = min(self.clearance(trajectory.at(trajectory.duration * k / 20000)) for k in range(20001))
        self.assertGreaterEqual(least, 0.4)
        self.assertGreaterEqual(least, trajectory.json["least_clearance_bound"] - 0.4)

    def test_without_avoid_a_collision_is_told_and_with_it_solved(self):
        route, out = self.folder / "r.csv", self.folder / "out.json"
        route.write_text("0,0,0.6\n4.4,0,0.6\n")
        command = ["plan", "--waypoints", route, "--vmax", "3", "--amax", "2", "--world", "box_room", "--clearance", "0.3", "--out", out]
        self.assertIn("--avoid", self.run_ok(*command).stderr)
        self.assertFalse(read_json(out)["collision_free"])
        self.run_ok(*command, "--avoid")
        self.assertTrue(read_json(out)["collision_free"])

    def test_waypoints_in_a_surface_are_refused_with_or_without_avoid(self):
        route, out = self.folder / "r.csv", self.folder / "out.json"
        route.write_text("x,y,z\n0,0,2\n3,0.3,0.8\n0,3,2\n")
        for flags in ([], ["--avoid"]):
            self.run_bad(2, "plan", "--waypoints", route, *LIMITS, "--world", "box_room", "--out", out, *flags,
                         says=["r.csv:3", "waypoint 2 (3.00, 0.30, 0.80)", "only 0.2 m"])

    def test_says_why_there_is_no_way(self):
        route, out = self.folder / "r.csv", self.folder / "out.json"
        common = ["--vmax", "3", "--amax", "2", "--world", "box_room", "--out", out]
        self.run_bad(2, "plan", "--from", "0,0,2", "--to", "3,0,0.9", *common, says=["--to", "waypoint 2", "from a surface"])
        self.run_bad(2, "plan", "--from", "0,0,2", "--to", "30,0,1", *common, says=["--to", "outside"])
        route.write_text("x,y,z\n0,0,2\n4.9,0,2\n0,3,2\n")
        self.run_bad(2, "plan", "--waypoints", route, "--avoid", *common, says=["r.csv:3", "waypoint 2"])
        self.run_bad(2, "plan", "--from", "0,0,2", "--to", "1,0", *common, says=["--to", "1,0"])
        self.assertFalse(out.exists())

    def test_kinds_of_routes(self):
        out = self.folder / "out.json"
        common = ["--vmax", "2", "--amax", "1", "--world", "box_room", "--out", out]
        self.run_ok("plan", "--route", "orbit", "--center", "0,0,3", "--radius", "3", *common)
        self.assertTrue(read_json(out)["collision_free"])
        self.run_ok("plan", "--route", "coverage", "--area=-4,-4,4,4", "--height", "4", "--spacing", "2", *common)
        self.assertEqual(len(read_json(out)["waypoints"]), 8)
        self.run_ok("plan", "--route", "orbit", "--entity", "box", "--height", "3", "--radius", "1.2", *common)
        self.run_ok("plan", "--route", "random", "--length", "4,8", *common)
        first = read_json(out)
        self.run_ok("plan", "--route", "random", "--length", "4,8", *common, "--threads", "1")
        self.assertEqual(read_json(out), first)
        self.run_bad(2, "plan", "--route", "orbits", *common, says=["did you mean 'orbit'"])
        self.run_bad(2, "plan", "--route", "orbit", "--entity", "bx", *common, says=["did you mean 'box'"])
        self.run_bad(2, "plan", "--route", "road", *common, says=["no road"])

    def test_collect_flies_a_plan(self):
        self.run_ok("plan", "--from", "0,0,2", "--to", "0,3,2", "--world", "box_room", "--vmax", "2", "--amax", "1",
                    "--out", self.folder / "p", "--format", "json,yaml")
        trajectory = Trajectory(self.folder / "p.json")
        for kind in ("json", "yaml"):
            out = self.folder / kind
            self.run_ok("collect", "--world", "box_room", "--size", "64x32", "--tier", "labels", "--frames", "5",
                        "--plan", self.folder / f"p.{kind}", "--out", out)
            flown = Trajectory(out / "trajectory.json")
            self.assertEqual(flown.json["coefficients"], trajectory.json["coefficients"])
            rows = (out / "trajectory.csv").read_text().splitlines()
            self.assertGreater(len(rows), 10)
            for line in rows[1:]:
                values = [float(v) for v in line.split(",")]
                self.assertLess(distance(values[1:4], trajectory.at(min(values[0], trajectory.duration))), 1e-6)
            self.run_ok("verify", out)
        bad = self.folder / "bad.json"
        bad.write_text('{"order": 7}')
        self.run_bad(2, "collect", "--world", "box_room", "--plan", bad, "--out", self.folder / "no", says=["bad.json"])


class WaypointSet(ProgramTest):
    def headings(self, plan, out):
        self.run_ok("collect", "--world", "box_room", "--frames", "7", "--size", "16x8", "--tier", "labels", "--plan", plan, "--out", out)
        frames = [json.loads(line) for line in (out / "frames.jsonl").read_text().splitlines()]
        found = []
        for frame in frames:
            w, x, y, z = frame["X_WC"]["q_wxyz"]  # the camera looks along +Z of its frame
            found.append((frame["t_ns"] * 1e-9, frame["X_WC"]["p"], math.atan2(2 * (y * z - w * x), 2 * (x * z + w * y))))
        return found

    def test_collect_turns_as_the_plan_says(self):
        route = self.folder / "turn.csv"
        route.write_text("x,y,z\n-4,-4,1\n0,-3,2\n4,4,3\n")
        for kind in ("json", "yaml"):
            for yaw, wanted in [("0,0,2", lambda p: math.atan2(-p[1], -p[0])), ("90", lambda p: math.pi / 2)]:
                plan = self.folder / f"turn.{kind}"
                self.run_ok("plan", "--waypoints", route, *LIMITS, "--yaw", yaw, "--out", plan)
                out = self.folder / f"{kind} {yaw}"
                for t, p, heading in self.headings(plan, out):
                    # The plan holds polynomials that interpolate the heading.
                    self.assertLess(abs(math.remainder(heading - wanted(p), 2 * math.pi)), 0.15, (kind, yaw, t))
                self.assertEqual("yaw_coefficients" in read_json(out / "trajectory.json"), yaw == "0,0,2")

    def test_a_plan_that_jumps_is_refused(self):
        route = self.folder / "jump.csv"
        route.write_text("x,y,z\n-4,-4,1\n0,-3,2\n4,4,3\n")
        self.run_ok("plan", "--waypoints", route, *LIMITS, "--out", self.folder / "jump.json")
        plan = read_json(self.folder / "jump.json")
        plan["coefficients"][0][1][4] += 0.01
        (self.folder / "jump.json").write_text(json.dumps(plan))
        del plan["coefficients"]
        (self.folder / "lacks.json").write_text(json.dumps(plan))
        for name, words in [("jump.json", ["segment 2 begins", "segment 1 ends"]), ("lacks.json", ["'coefficients' is missing"])]:
            self.run_bad(2, "collect", "--world", "box_room", "--plan", self.folder / name, "--out", self.folder / "no", says=[name, *words])
            self.assertFalse((self.folder / "no").exists())

    def test_missing_worlds_are_told_and_unknown_ones_refused(self):
        out = self.folder / "set"
        result = self.run_ok("plan", "--dataset", "waypoint", "--worlds", "downtown_west", "--routes", "1", "--out", out, "--json")
        report = json.loads(result.stdout)
        if report["worlds_missing"]:
            self.assertEqual(report["worlds_missing"], ["downtown_west"])
            self.assertIn("does not exist yet", result.stderr)
        self.run_bad(2, "plan", "--dataset", "waypoints", "--out", out, says=["did you mean 'waypoint'"])
        self.run_bad(2, "plan", "--dataset", "waypoint", "--worlds", "city_prk", "--out", out, says=["did you mean 'city_park'"])
        self.run_bad(2, "plan", "--dataset", "waypoint", "--shard", "2/2", "--out", out, says=["--shard"])
        (self.folder / "other").mkdir()
        (self.folder / "other/file").write_text("x")
        self.run_bad(2, "plan", "--dataset", "waypoint", "--out", self.folder / "other", says=["not empty"])
        self.assertEqual(list(tree(self.folder / "other")), ["file"])


if __name__ == "__main__":
    unittest.main()
