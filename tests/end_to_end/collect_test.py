"""What `render` and `collect` write is right: checked against the analytic room with formulas of our own."""
import math
import subprocess
import unittest

from program import PROGRAM, ProgramTest, read_exr, read_gray, read_ids, read_json, tree

HALF, HEIGHT = 5.0, 6.0                               # the room: x, y in +-5, z in 0..6
BOX_MIN, BOX_MAX = (2.5, -0.5, 0.0), (3.5, 0.5, 1.0)  # the cube
FACES = {(0, -1): "x-", (0, 1): "x+", (1, -1): "y-", (1, 1): "y+", (2, -1): "floor", (2, 1): "ceiling"}


def rotate(q, v):
    """R(q) v for a unit quaternion w, x, y, z."""
    w, x, y, z = q
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return (v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx)


def ray_of_pixel(x, y, width, height):
    theta = 2 * math.pi * ((x + 0.5) / width - 0.5)
    phi = math.pi * (0.5 - (y + 0.5) / height)
    return (math.cos(phi) * math.sin(theta), -math.sin(phi), math.cos(phi) * math.cos(theta))


def cast(p, d):
    """(range, face) of the ray from p along unit d, and how near the hit is to an edge, in metres."""
    hits = []
    for axis, (low, high) in enumerate([(-HALF, HALF), (-HALF, HALF), (0.0, HEIGHT)]):
        if d[axis]:
            side = 1 if d[axis] > 0 else -1
            hits.append((((high if side > 0 else low) - p[axis]) / d[axis], FACES[axis, side]))
    hits.sort()
    # The cube, by slabs.
    near, far = 0.0, math.inf
    for axis in range(3):
        if d[axis] == 0:
            if not BOX_MIN[axis] <= p[axis] <= BOX_MAX[axis]:
                far = -math.inf
            continue
        a, b = sorted(((BOX_MIN[axis] - p[axis]) / d[axis], (BOX_MAX[axis] - p[axis]) / d[axis]))
        near, far = max(near, a), min(far, b)
    best = hits[0]
    if 0 < near < far and near < best[0]:
        best = (near, "box")
    margin = min(hits[1][0] - hits[0][0], abs(far - near))
    return best[0], best[1], margin


class Demo(ProgramTest):
    def test_the_program_that_the_demo_builds_first_collects_the_same_files(self):
        folders = [self.folder / "whole", self.folder / "pictures"]
        for program, out in zip((PROGRAM, PROGRAM + "_pictures"), folders):
            subprocess.run([program, "collect", "--world", "box_room", "--frames", "2", "--size", "64x32", "--people", "1", "--out", out],
                           check=True, capture_output=True, timeout=240)
        self.assertEqual(*map(tree, folders))


class Render(ProgramTest):
    def test_without_a_pose_an_imported_thing_is_in_the_middle_of_the_picture(self):
        model, out = self.folder / "car.obj", self.folder / "out"
        corners = [(x, y, z) for x in (4, 6) for y in (0, 1) for z in (-9, -5)]  # OBJ: y up
        faces = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
        model.write_text("o car\n" + "".join("v %g %g %g\n" % c for c in corners) + "".join("f %d %d %d %d\n" % f for f in faces))
        self.run_ok("render", "--world", model, "--size", "64x32", "--tier", "labels", "--out", out)
        names = {int(i): e["name"] for i, e in read_json(out / "entities.json").items()}
        entity = read_ids(out / "entity/000000.png")
        self.assertEqual(names[entity[16][32]], "car")
        self.assertEqual(names[entity[2][32]], "sky")

    def test_panorama_of_the_room_is_exact(self):
        out = self.folder / "out"
        self.run_ok("render", "--world", "box_room", "--pose", "-1.3,0.7,2.1,33,12,-7", "--size", "96x48", "--tier", "labels",
                    "--out", out)
        frame = read_json(out / "frames.jsonl")
        names = {int(i): e["name"] for i, e in read_json(out / "entities.json").items()}
        self.assertEqual(len(names), 7)
        channel, ranges = read_exr(out / "range/000000.exr")
        self.assertEqual(channel, "Y")
        entity, semantic = read_ids(out / "entity/000000.png"), read_gray(out / "semantic/000000.png")
        categories = {int(i): e["category"] for i, e in read_json(out / "entities.json").items()}
        p, q = frame["X_WC"]["p"], frame["X_WC"]["q_wxyz"]
        seen, checked = {}, 0
        for y in range(48):
            for x in range(96):
                distance, face, margin = cast(p, rotate(q, ray_of_pixel(x, y, 96, 48)))
                self.assertEqual(semantic[y][x], categories[entity[y][x]])
                if margin < 1e-3:
                    continue
                checked += 1
                self.assertLess(abs(ranges[y][x] / distance - 1), 1e-5, (x, y, face))
                self.assertEqual(seen.setdefault(face, entity[y][x]), entity[y][x], (x, y, face))
        self.assertGreater(checked, 0.95 * 96 * 48)
        self.assertEqual(len(set(seen.values())), 7)

    def test_pose_angles_follow_the_contract(self):
        # Nose up 90 degrees looks at the ceiling; yaw 90 looks north, at y = +5.
        for pose, distance in [("0,0,2,0,90", 4), ("0,0,2,90", 5), ("1,0,2,180", 6), ("0,0,2,0,-90", 2)]:
            out = self.folder / pose
            self.run_ok("render", "--world", "box_room", "--pose", pose, "--size", "65x65", "--projection", "pinhole", "--tier",
                        "labels", "--out", out)
            self.assertAlmostEqual(read_exr(out / "range/000000.exr")[1][32][32], distance, places=4)

    def test_all_projections_write_valid_datasets(self):
        for projection, size, pictures in [("erp", "64x32", 1), ("cube", "32x32", 6), ("pinhole", "40x30", 1), ("fisheye", "32x32", 1)]:
            out = self.folder / projection
            self.run_ok("render", "--world", "box_room", "--projection", projection, "--size", size, "--normal", "--out", out)
            self.run_ok("verify", out)
            self.assertEqual(len(list((out / "rgb").iterdir())), pictures)
            self.assertEqual(len(read_json(out / "panoptic.json")["images"]), pictures)

    def test_json_report_has_the_figures_of_the_contract(self):
        import json
        result = self.run_ok("render", "--world", "box_room", "--size", "64x32", "--json", "--out", self.folder / "out")
        report = json.loads(result.stdout)
        for key in ["render_ms", "write_ms", "load_ms", "rays", "triangles", "entities", "peak_rss_mib", "frames_per_second"]:
            self.assertGreater(report[key], 0, key)
        self.assertEqual(report["entities"], 7)


class Collect(ProgramTest):
    def collect(self, name, *more):
        out = self.folder / name
        self.run_ok("collect", "--world", "box_room", "--frames", "5", "--size", "64x32", "--out", out, *more)
        return out

    def test_panoptic_agrees_with_the_pictures(self):
        out = self.collect("a")
        panoptic = read_json(out / "panoptic.json")
        categories = {c["id"] for c in panoptic["categories"]}
        for annotation in panoptic["annotations"]:
            ids = read_ids(out / "entity" / annotation["file_name"])
            height, width = len(ids), len(ids[0])
            areas, columns, rows = {}, {}, {}
            for y in range(height):
                for x in range(width):
                    areas[ids[y][x]] = areas.get(ids[y][x], 0) + 1
                    columns.setdefault(ids[y][x], set()).add(x)
                    rows.setdefault(ids[y][x], set()).add(y)
            segments = annotation["segments_info"]
            self.assertEqual({s["id"]: s["area"] for s in segments}, areas)
            self.assertEqual(sum(areas.values()), width * height)
            self.assertAlmostEqual(sum(s["solid_angle"] for s in segments), 4 * math.pi, places=9)
            for s in segments:
                self.assertIn(s["category_id"], categories)
                xs, ys = columns[s["id"]], rows[s["id"]]
                self.assertEqual(s["bbox"], [min(xs), min(ys), max(xs) + 1 - min(xs), max(ys) + 1 - min(ys)])
                x, y, w, h = s["bbox_wrap"]
                self.assertEqual([y, h], s["bbox"][1::2])
                self.assertLessEqual(xs, {(x + k) % width for k in range(w)})
                shortest = min(max((c - start) % width for c in xs) + 1 for start in xs)
                self.assertEqual(w, shortest)

    def test_one_and_two_threads_write_the_same_bytes(self):
        self.assertEqual(tree(self.collect("one", "--threads", "1")), tree(self.collect("two", "--threads", "2")))

    def test_seed_changes_the_route_and_the_same_seed_does_not(self):
        a, b, c = self.collect("a"), self.collect("b"), self.collect("c", "--seed", "1")
        self.assertEqual(tree(a), tree(b))
        self.assertNotEqual((a / "trajectory.csv").read_text(), (c / "trajectory.csv").read_text())

    def test_route_file_without_frames_takes_one_frame_at_each_row(self):
        route = self.folder / "route.csv"
        route.write_text("x,y,z,yaw_deg\n0,0,2,0\n-2,1,3,90\n1,-2,4,180\n")
        out = self.folder / "out"
        self.run_ok("collect", "--world", "box_room", "--route", route, "--size", "32x16", "--tier", "labels", "--out", out)
        import json
        frames = [json.loads(line) for line in (out / "frames.jsonl").read_text().splitlines()]
        self.assertEqual(len(frames), 3)
        for frame, (p, forward) in zip(frames, [((0, 0, 2), (1, 0, 0)), ((-2, 1, 3), (0, 1, 0)), ((1, -2, 4), (-1, 0, 0))]):
            for a, b in zip(frame["X_WC"]["p"], p):
                self.assertLess(abs(a - b), 1e-9)
            for a, b in zip(rotate(frame["X_WC"]["q_wxyz"], (0, 0, 1)), forward):
                self.assertLess(abs(a - b), 1e-9)

    def test_shards_hold_their_frames_of_the_whole(self):
        whole = tree(self.collect("whole"))
        parts = {}
        for i in range(2):
            part = tree(self.collect(f"part{i}", "--shard", f"{i}/2"))
            parts.update({name: sha for name, sha in part.items() if "/" in name})
        self.assertEqual(parts, {name: sha for name, sha in whole.items() if "/" in name})

    def test_formats_of_exports_go_beside_the_dataset_as_the_export_writes_them(self):
        collect = ("collect", "--world", "box_room", "--frames", "2", "--size", "64x32", "--tier", "fast", "--out", self.folder / "set")
        self.run_ok(*collect, "--format", "native,omni360,mcap")
        whole = tree(self.folder / "set")
        for name in ("omni360", "mcap"):
            self.run_ok("dataset", "export", self.folder / "set", "--format", name, "--out", self.folder / name)
            self.assertEqual(tree(self.folder / f"set_{name}"), tree(self.folder / name))
        self.run_ok(*collect, "--format", "native,omni360,mcap")
        self.assertEqual(tree(self.folder / "set"), whole)

    def test_pictures_carry_photo_sphere_metadata(self):
        png = (self.collect("png") / "rgb/000000.png").read_bytes()
        jpg = (self.collect("jpg", "--rgb-format", "jpg") / "rgb/000000.jpg").read_bytes()
        for data in (png, jpg):
            self.assertIn(b"<x:xmpmeta", data)
            self.assertIn(b"equirectangular", data)

    def test_index_answers_queries(self):
        import sqlite3
        index = sqlite3.connect(self.collect("a") / "index.sqlite")
        self.assertEqual(index.execute("PRAGMA integrity_check").fetchone(), ("ok",))
        frames, = index.execute("SELECT COUNT(*) FROM frames WHERE range_min >= 0.99 AND z BETWEEN 0 AND 6").fetchone()
        self.assertEqual(frames, 5)
        pixels, = index.execute("SELECT SUM(pixels) FROM frame_categories WHERE frame = 2").fetchone()
        self.assertEqual(pixels, 64 * 32)


if __name__ == "__main__":
    unittest.main()
