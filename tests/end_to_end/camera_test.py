"""Projections, rigs and pose files of `collect`, and the files for COLMAP and nerfstudio, by reprojection with formulas of our own."""
import json
import math
import unittest

from collect_test import rotate
from program import ProgramTest, read_exr, read_ids, read_json, tree

POSES = "x,y,z,yaw_deg,pitch_deg,roll_deg\n-3,-1,2,10,-15,5\n-2.5,0.4,2.6,-12,-20,-8\n-1.5,-2,1.4,35,8,90\n"


def lines(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def quaternion_inverse(q):
    return (q[0], -q[1], -q[2], -q[3])


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def norm(a):
    return math.sqrt(sum(x * x for x in a))


def body_axes(yaw, pitch, roll):
    """Columns forward, left, up in W of a body with these angles in degrees: the rotation of docs/reference/frames.md, multiplied out by hand."""
    y, p, r = (math.radians(a) for a in (yaw, pitch, roll))
    forward = (math.cos(p) * math.cos(y), math.cos(p) * math.sin(y), math.sin(p))
    left0, up0 = (-math.sin(y), math.cos(y), 0), (-math.sin(p) * math.cos(y), -math.sin(p) * math.sin(y), math.cos(p))
    left = tuple(math.cos(r) * a + math.sin(r) * b for a, b in zip(left0, up0))
    up = tuple(math.cos(r) * b - math.sin(r) * a for a, b in zip(left0, up0))
    return forward, left, up


class Picture:
    """A pinhole picture of a dataset: depth along the optical axis, entities, and points of W by K and X_WC of frames.jsonl."""

    def __init__(self, out, stem, K, X_WC):
        self.K, self.p, self.q = K, X_WC["p"], X_WC["q_wxyz"]
        self.entity, ranges = read_ids(out / f"entity/{stem}.png"), read_exr(out / f"range/{stem}.exr")[1]
        self.width, self.height = len(ranges[0]), len(ranges)
        self.range = ranges
        self.depth = [[ranges[y][x] / norm(self.ray(x, y)) for x in range(self.width)] for y in range(self.height)]

    def ray(self, x, y):
        return ((x + 0.5 - self.K["cx"]) / self.K["fx"], (y + 0.5 - self.K["cy"]) / self.K["fy"], 1.0)

    def point(self, x, y):
        return add(rotate(self.q, tuple(self.depth[y][x] * a for a in self.ray(x, y))), self.p)

    def inverse_depth(self, u, v):
        """(entity, 1 / depth) at a pixel position: exact on planes, whose inverse depth is linear in the picture."""
        x, y = math.floor(u - 0.5), math.floor(v - 0.5)
        if not (0 <= x < self.width - 1 and 0 <= y < self.height - 1):
            return None
        corners = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)]
        ids = {self.entity[j][i] for i, j in corners}
        if len(ids) > 1:
            return None
        a, b = u - 0.5 - x, v - 0.5 - y
        weights = [(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b]
        return ids.pop(), sum(w / self.depth[j][i] for w, (i, j) in zip(weights, corners))


class Cameras(ProgramTest):
    def collect(self, name, *flags, poses=POSES):
        out, file = self.folder / name, self.folder / (name + ".csv")
        file.write_text(poses)
        self.run_ok("collect", "--world", "box_room", "--poses", file, "--out", out, *flags)
        self.run_ok("verify", out)
        return out


class CameraTest(Cameras):
    def check_reprojection(self, out, project):
        """Points of every frame seen in every other: project(name, point) -> (u, v, depth) or None."""
        frames = lines(out / "frames.jsonl")
        box = next(int(i) for i, e in read_json(out / "entities.json").items() if e["name"] == "box")
        pictures = [Picture(out, f["stem"], f["K"], f["X_WC"]) for f in frames]
        checked = 0
        for a in pictures:
            for b, frame in zip(pictures, frames):
                for y in range(0, a.height, 3):
                    for x in range(0, a.width, 3):
                        place = project(frame["stem"] + ".png", a.point(x, y))
                        seen = place and b.inverse_depth(place[0], place[1])
                        if not seen or seen[0] != a.entity[y][x] or seen[0] == box:  # walls are planes, the box is not
                            continue
                        self.assertAlmostEqual(seen[1] * place[2], 1, delta=2e-5)
                        checked += 1
        self.assertGreater(checked, 1000)

    def test_colmap_and_frames_jsonl_agree_on_every_point(self):
        out = self.collect("pinhole", "--projection", "pinhole", "--size", "96x64", "--fov", "80")
        cameras = {c[0]: c[1:] for c in (line.split() for line in (out / "cameras.txt").read_text().splitlines()) if c[0] != "#"}
        images = {}
        rows = [line.split() for line in (out / "images.txt").read_text().splitlines() if not line.startswith("#")]
        for row in rows[::2]:
            images[row[9]] = ([float(v) for v in row[1:5]], [float(v) for v in row[5:8]], cameras[row[8]])
        self.assertTrue(all(row == [] for row in rows[1::2]))
        self.assertEqual(sorted(images), sorted(path.name for path in (out / "rgb").iterdir()))
        K = lines(out / "frames.jsonl")[0]["K"]
        self.assertEqual((K["model"], K["width"], K["height"], K["distortion"]), ("PINHOLE", 96, 64, []))
        self.assertAlmostEqual(K["fx"], 48 / math.tan(math.radians(40)), 9)
        self.assertEqual(read_json(out / "meta.json")["cameras"][0]["K"], K)

        def project(name, point):
            q, t, camera = images[name]
            self.assertEqual(camera[0], "PINHOLE")
            fx, fy, cx, cy = map(float, camera[3:7])
            x, y, z = add(rotate(q, point), t)  # COLMAP: world to camera
            return (fx * x / z + cx, fy * y / z + cy, z) if z > 0.05 else None
        self.check_reprojection(out, project)

    def test_nerfstudio_transforms_agree_on_every_point(self):
        out = self.collect("nerf", "--projection", "pinhole", "--size", "96x64")
        transforms = read_json(out / "transforms.json")
        self.assertEqual(transforms["camera_model"], "OPENCV")
        frames = {f["file_path"][4:]: f for f in transforms["frames"]}
        self.assertTrue(all((out / f["file_path"]).is_file() for f in transforms["frames"]))

        def project(name, point):
            frame = frames[name]
            M = frame["transform_matrix"]
            d = sub(point, [M[i][3] for i in range(3)])
            x, y, z = (sum(M[i][k] * d[i] for i in range(3)) for k in range(3))  # right, up, backward
            if z > -0.05:
                return None
            return frame["fl_x"] * x / -z + frame["cx"], frame["cy"] - frame["fl_y"] * y / -z, -z
        self.check_reprojection(out, project)

    def test_colmap_fisheyes_agree_with_their_pictures(self):
        out = self.collect("fisheye", "--projection", "fisheye", "--size", "64x64")
        row = (out / "cameras.txt").read_text().splitlines()[1].split()
        self.assertEqual(row[1:4], ["OPENCV_FISHEYE", "64", "64"])
        fx, fy, cx, cy = map(float, row[4:8])
        self.assertEqual([float(k) for k in row[8:]], [0, 0, 0, 0])
        frame = lines(out / "frames.jsonl")[0]
        entity, ranges = read_ids(out / "entity/000000.png"), read_exr(out / "range/000000.exr")[1]
        pan = self.collect("pan", "--size", "128x64")
        other, far = read_ids(pan / "entity/000000.png"), read_exr(pan / "range/000000.exr")[1]
        same = checked = 0
        for y in range(64):
            for x in range(128):
                theta, phi = 2 * math.pi * ((x + 0.5) / 128 - 0.5), math.pi * (0.5 - (y + 0.5) / 64)
                ray = (math.cos(phi) * math.sin(theta), -math.sin(phi), math.cos(phi) * math.cos(theta))
                angle, r = math.acos(ray[2]), math.hypot(ray[0], ray[1])
                u, v = cx + fx * angle * ray[0] / r, cy + fy * angle * ray[1] / r
                if angle > math.pi / 2 - 0.05:
                    continue
                checked += 1
                i, j = math.floor(u), math.floor(v)
                same += entity[j][i] == other[y][x] and abs(ranges[j][i] / far[y][x] - 1) < 0.1
        self.assertGreater(same, 0.93 * checked)
        self.assertEqual(frame["K"]["model"], "OPENCV_FISHEYE")

    def test_labels_alone_and_panoramas_have_no_files_for_structure_from_motion(self):
        for name, flags in [("labels", ["--projection", "pinhole", "--tier", "labels", "--size", "32x24"]), ("erp", ["--size", "64x32"])]:
            out = self.collect(name, *flags)
            self.assertFalse((out / "images.txt").exists() or (out / "transforms.json").exists())

    def test_all_projections_collect_and_resume(self):
        for projection, size in [("erp", "64x32"), ("cube", "16x16"), ("pinhole", "40x30"), ("fisheye", "32x32")]:
            out = self.collect(projection, "--projection", projection, "--size", size, "--products", "normal,flow")
            whole = tree(out)
            for path in [out / "SHA256SUMS", *sorted((out / "range").iterdir())[:1]]:
                path.unlink()
            self.collect(projection, "--projection", projection, "--size", size, "--products", "normal,flow")
            self.assertEqual(tree(out), whole)


RIG = """cameras:
  - {name: front, projection: pinhole, size: 48x32, fov_deg: 80, x: 0.3, z: -0.1, pitch_deg: -10}
  - {name: left, projection: fisheye, size: 32x32, y: 0.2, yaw_deg: 90}
  - {name: all_round, projection: erp, size: 64x32, z: 0.5}
  - {name: cube, projection: cube, size: 16x16}
"""


class RigTest(Cameras):
    def rig(self, name, *flags):
        (self.folder / "rig.yaml").write_text(RIG)
        return self.collect(name, "--cameras", self.folder / "rig.yaml", *flags)

    def test_every_camera_sits_where_the_file_says(self):
        out = self.rig("rig")
        names = sorted(path.name for path in (out / "rgb").iterdir())
        self.assertEqual(len(names), 3 * (3 + 6))
        self.assertIn("000002_all_round.png", names)
        self.assertIn("000001_cube_-z.png", names)
        mounts = {"front": ((0.3, 0, -0.1), (0, -10, 0)), "left": ((0, 0.2, 0), (90, 0, 0)), "all_round": ((0, 0, 0.5), (0, 0, 0)), "cube": ((0, 0, 0), (0, 0, 0))}
        poses = [[float(v) for v in row.split(",")] for row in POSES.splitlines()[1:]]
        for frame, pose in zip(lines(out / "frames.jsonl"), poses):
            axes = body_axes(*pose[3:])
            turn = lambda v: tuple(sum(axes[k][i] * v[k] for k in range(3)) for i in range(3))
            for name, (place, angles) in mounts.items():
                X = frame["cameras"][name]["X_WC"]
                self.assertLess(norm(sub(X["p"], add(pose[:3], turn(place)))), 1e-9, name)
                forward, left, up = body_axes(*angles)
                for axis, of_body in (((0, 0, 1), forward), ((-1, 0, 0), left), ((0, -1, 0), up)):
                    self.assertLess(norm(sub(rotate(X["q_wxyz"], axis), turn(of_body))), 1e-9, name)
            self.assertEqual(frame["X_WC"], frame["cameras"]["front"]["X_WC"])
            self.assertEqual(frame["cameras"]["left"]["K"]["model"], "OPENCV_FISHEYE")
            self.assertNotIn("K", frame["cameras"]["cube"])
        self.assertEqual(len(read_json(out / "transforms.json")["frames"]), 3)
        self.assertEqual(len(read_json(out / "transforms_fisheye.json")["frames"]), 3)
        sizes = {(i["width"], i["height"]) for i in read_json(out / "panoptic.json")["images"]}
        self.assertEqual(sizes, {(48, 32), (32, 32), (64, 32), (16, 16)})

    def test_a_camera_of_a_rig_sees_what_it_sees_alone(self):
        out, alone = self.rig("rig"), self.collect("alone", "--projection", "cube", "--size", "16x16")
        for face in ("+x", "-x", "+y", "-y", "+z", "-z"):
            for product, end in (("range", "exr"), ("entity", "png")):
                self.assertEqual((out / f"{product}/000001_cube_{face}.{end}").read_bytes(), (alone / f"{product}/000001_{face}.{end}").read_bytes())

    def test_rigs_shard_and_resume_byte_for_byte(self):
        whole, parts = tree(self.rig("whole")), {}
        for i in range(2):
            parts.update({n: s for n, s in tree(self.rig(f"part{i}", "--shard", f"{i}/2")).items() if "/" in n})
        self.assertEqual(parts, {n: s for n, s in whole.items() if "/" in n})
        self.assertEqual(tree(self.rig("two", "--processes", "2")), whole)

    def test_people_are_labelled_in_every_camera(self):
        out = self.rig("people", "--people", "5")
        stems = {f["stem"]: f["camera"]["projection"] for f in lines(out / "people.jsonl")}
        self.assertEqual(len(stems), 3 * 9)
        self.assertEqual(stems["000000_left"], "fisheye")

    def test_bad_rigs_name_file_and_line(self):
        out, file = self.folder / "out", self.folder / "bad.yaml"
        for text, says in [("cameras: []\n", ["bad.yaml", "0 entries"]), ("cameras:\n  - {name: A b}\n", ["bad.yaml:2", "'A b'"]),
                           ("cameras:\n  - {name: a}\n  - {name: a}\n", ["bad.yaml:3", "two cameras 'a'"]),
                           ("cameras:\n  - {name: a, projection: pinhol}\n", ["bad.yaml:2", "did you mean 'pinhole'"]),
                           ("cameras:\n  - {name: a, projection: erp, size: 10x10}\n", ["bad.yaml:2", "10x10"]),
                           ("cameras:\n  - {nam: a}\n", ["bad.yaml:2", "name"])]:
            file.write_text(text)
            self.run_bad(2, "collect", "--world", "box_room", "--cameras", file, "--out", out, says=says)
        file.write_text(RIG)
        self.run_bad(2, "collect", "--world", "box_room", "--cameras", file, "--size", "32x16", "--out", out, says=["--cameras"])
        self.run_bad(2, "collect", "--world", "box_room", "--cameras", file, "--lens", "real360", "--out", out, says=["--lens"])
        self.assertFalse(out.exists())


class PoseFiles(ProgramTest):
    def collect(self, name, text, *flags):
        file = self.folder / name
        file.write_text(text)
        out = self.folder / (name + ".out")
        self.run_ok("collect", "--world", "box_room", "--poses", file, "--size", "32x16", "--tier", "labels", "--out", out, *flags)
        return out

    def ranges(self, out):
        return [(out / f"range/{i:06}.exr").read_bytes() for i in range(3)]

    def test_every_format_gives_the_same_pictures(self):
        angles = self.collect("angles.csv", POSES)
        frames = lines(angles / "frames.jsonl")
        for frame, row in zip(frames, POSES.splitlines()[1:]):
            pose = [float(v) for v in row.split(",")]
            forward, left, up = body_axes(*pose[3:])
            q = frame["X_WC"]["q_wxyz"]
            self.assertLess(norm(sub(rotate(q, (0, 0, 1)), forward)) + norm(sub(rotate(q, (0, -1, 0)), up)), 1e-9)
        cells = [(f["X_WC"]["p"], f["X_WC"]["q_wxyz"], i) for i, f in enumerate(frames)]
        text = lambda values: [repr(float(v)) for v in values]
        forms = {"bare.csv": "\n".join(POSES.splitlines()[1:]),
                 "quaternions.csv": "qw,qx,qy,qz,t,x,y,z\n" + "\n".join(",".join(text([*q, 0.5 * i, *p])) for p, q, i in cells),
                 "trajectory.tum": "# timestamp tx ty tz qx qy qz qw\n" + "\n".join(" ".join(text([1.5e9 + 0.25 * i, *p, *q[1:], q[0]])) for p, q, i in cells),
                 "keys.jsonl": "\n".join(json.dumps(dict(zip(("x", "y", "z", "yaw_deg", "pitch_deg", "roll_deg"), map(float, row.split(",")))))
                                         for row in POSES.splitlines()[1:]),
                 "frames.jsonl": (angles / "frames.jsonl").read_text()}
        for name, content in forms.items():
            out = self.collect(name, content)
            self.assertEqual([norm(sub(a["X_WC"]["p"], b["X_WC"]["p"])) < 1e-9 for a, b in zip(lines(out / "frames.jsonl"), frames)], [True] * 3)
            matching = sum(a == b for a, b in zip(self.ranges(out), self.ranges(angles)))
            self.assertGreaterEqual(matching, 2, name)  # a quaternion's last bit may move a ray
        self.assertEqual([f["t_ns"] for f in lines(self.folder / "trajectory.tum.out/frames.jsonl")], [0, 250_000_000, 500_000_000])

    def test_people_live_between_the_poses(self):
        out = self.collect("angles.csv", POSES, "--people", "6")
        places = [[p["position_world"] for p in f["persons"]] for f in lines(out / "people.jsonl")]
        self.assertNotEqual(places[0], places[2])

    def test_wrong_files_name_the_line(self):
        out, file = self.folder / "out", self.folder / "bad.csv"
        for text, says in [("", ["no poses"]), ("x,y,z,yaw\n1,2,3,4\n", ["bad.csv:1", "yaw_deg"]), ("x,y,z\n1,2\n", ["bad.csv:2", "2 values for 3 columns"]),
                           ("x,y,z\n1,2,nan\n", ["bad.csv:2", "'nan'"]), ("x,y,z,qw,qx,qy,qz\n1,2,3,1,1,0,0\n", ["bad.csv:2", "length"]),
                           ("x,y,z,qw\n1,2,3,1\n", ["bad.csv:2", "quaternion"]), ("x,y,z,t\n1,2,3,1\n1,2,3,1\n", ["bad.csv:3", "t does not grow"]),
                           ("1,2\n", ["bad.csv:1", "2 values"]), ('{"x": 1, "y": 2, "z": 3, "roll": 4}\n', ["bad.csv:1", "roll_deg"]),
                           ('{"X_WC": {"p": [1, 2], "q_wxyz": [1, 0, 0, 0]}}\n', ["bad.csv:1", "'p'"]), ("{broken\n", ["bad.csv:1", "JSON"])]:
            file.write_text(text)
            self.run_bad(2, "collect", "--world", "box_room", "--poses", file, "--out", out, says=says)
        file.write_text(POSES)
        for flags in (["--frames", "2"], ["--fps", "2"], ["--route", str(file)]):
            self.run_bad(2, "collect", "--world", "box_room", "--poses", file, *flags, "--out", out)
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
