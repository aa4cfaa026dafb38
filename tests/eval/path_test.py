"""`eval vln`, `eval flow`, `eval layout`, `eval mpde` against numpy."""
import json
import math
import unittest

import numpy as np

from references import EvalTest, path_length, row_areas, time_warping


class Navigation(EvalTest):
    def episodes(self, seed, count=9):
        random = np.random.default_rng(seed)
        episodes = []
        for i in range(count):
            ref = np.cumsum(random.normal(0, 8, (random.integers(1, 9), 3)), 0)
            pred = np.concatenate([ref[: random.integers(1, len(ref) + 1)] + random.normal(0, 4, 3), random.normal(0, 9, (random.integers(0, 3), 3))])
            episodes.append({"id": f"e{i}", "ref": ref.tolist(), "pred": pred.tolist(), "stop": bool(random.random() < 0.8)})
        return episodes

    def wanted(self, e, radius):
        ref, pred = np.array(e["ref"]), np.array(e["pred"])
        distances = np.linalg.norm(pred - ref[-1], axis=1)
        flown, way, straight = path_length(pred), path_length(ref), np.linalg.norm(ref[-1] - ref[0])
        success = float(distances[-1] <= radius and e.get("stop", True))
        spl = lambda best: success * (best / max(best, flown) if max(best, flown) else 1)
        ndtw = math.exp(-time_warping(pred, ref) / (len(ref) * radius))
        coverage = np.mean([math.exp(-min(np.linalg.norm(pred - r, axis=1)) / radius) for r in ref])
        expected = coverage * way
        cls = coverage * (expected / (expected + abs(expected - flown)) if expected + abs(expected - flown) else 1)
        return {"sr": success, "osr": float(distances.min() <= radius), "spl": spl(way), "spl_straight": spl(straight), "ne": distances[-1], "ndtw": ndtw, "sdtw": success * ndtw,
                "cls": cls, "path_length": flown}

    def test_nine_figures_equal_the_definitions(self):
        for seed in range(4):
            episodes = self.episodes(seed)
            one = self.write("all.json", episodes)
            refs = self.write("e.jsonl", "\n".join(json.dumps({"id": e["id"], "ref": e["ref"]}) for e in episodes))
            results = self.write("r.jsonl", "\n".join(json.dumps({"id": e["id"], "pred": e["pred"], "stop": e["stop"]}) for e in episodes[::-1]))
            wanted = [self.wanted(e, 12) for e in episodes]
            for files in ((one,), (one, one), (refs, results)):
                found = self.eval("vln", *files, "--radius", 12)
                for key in wanted[0]:
                    self.assertSame(found[key], float(np.mean([w[key] for w in wanted])), f"{seed} {key}")

    def test_protocols_differ_as_published(self):
        e = [{"id": 1, "ref": [[0, 0, 0], [30, 0, 0]], "pred": [[0, 0, 0], [30, 0, 20]], "stop": False}]
        path = self.write("e.json", e)
        figures = {p: self.eval("vln", path, "--protocol", p) for p in ("ours", "aerialvln", "openfly", "citynav-mgp", "citynav-vlnce")}
        self.assertEqual([figures[p]["sr"] for p in figures], [0, 0, 0, 1, 0])  # exactly 20 m above the goal, no stop
        e[0].update(pred=[[0, 0, 0], [12, 0, 0]], stop=True)
        path = self.write("e.json", e)
        self.assertEqual(self.eval("vln", path, "--protocol", "openfly")["spl"], 30 / 12)
        self.assertEqual(self.eval("vln", path, "--protocol", "traveluav")["spl"], 10 / 12)
        self.assertEqual(self.eval("vln", path, "--protocol", "uavon")["sr"], 1)
        e[0]["collision"] = True
        self.assertEqual(self.eval("vln", self.write("e.json", e), "--protocol", "uavon")["sr"], 0)
        e[0].update(shortest=6)
        self.assertEqual(self.eval("vln", self.write("e.json", e))["spl"], 6 / 12)

    def test_missing_and_broken_episodes_are_named(self):
        refs = self.write("e.json", [{"id": "a", "ref": [[0, 0, 0]]}, {"id": "b", "ref": [[0, 0, 0]]}])
        self.refuse("vln", refs, self.write("r.json", [{"id": "a", "pred": [[0, 0, 0]]}]), says=["1 of 2", "'b'"])
        self.refuse("vln", refs, self.write("r.json", [{"id": "c", "pred": [[0, 0, 0]]}]), says=["'c'"])
        self.refuse("vln", refs, self.write("r.json", [{"id": "a", "pred": []}]), says=["[0].pred"])
        self.refuse("vln", refs, self.write("r.json", [{"id": "a", "pred": [[0, "x", 0]]}]), says=["[0].pred[0][1]", "not a number"])
        self.refuse("vln", refs, self.write("r.jsonl", '{"id": "a"}\n{"id": '), says=["r.jsonl:2:"])
        for number in ("NaN", "-Infinity"):
            self.refuse("vln", refs, self.write("r.json", f'[{{"id": "a", "pred": [[0, {number}, 0]]}}]'), says=["r.json:1:", "has no NaN or Infinity"])
        self.refuse("vln", refs, refs, "--radius", "0", says=["--radius"])
        self.refuse("vln", refs, refs, "--protocol", "openfli", says=["openfly"])


    def test_the_truth_is_that_of_the_episodes(self):
        episode = {"id": "a", "ref": [[0, 0, 2], [100, 0, 2]], "goal": {"position": [100, 0, 2], "radius": 20, "places": [[100, 30, 2]]}}
        flight = {"id": "a", "pred": [[0, 0, 2], [50, 0, 2]]}
        e = self.write("e.json", [episode])
        found = self.eval("vln", e, self.write("r.json", [flight]))
        self.assertEqual([found["sr"], found["ne"]], [0, 50])
        for claim, says in (({"goal": [50, 0, 2]}, "[0].goal: this goal is not that of the episode"), ({"ref": [[0, 0, 2], [50, 0, 2]]}, "[0].ref: "), ({"shortest": 3, "radius": 20}, None),
                            ({"goal": {"position": [100, 0, 2], "radius": 60}}, "--radius"), ({"radius": 60}, "60 m is not the 20 m")):
            results = self.write("r.json", [{**flight, **claim}])
            if says:
                self.refuse("vln", e, results, says=["r.json: ", says])
            else:
                self.assertEqual(self.eval("vln", e, results)["radius"], 20)
        self.assertEqual(self.eval("vln", e, results, "--radius", 60)["sr"], 1)
        self.write("r.json", [{**flight, "shortest": 3}])
        self.refuse("vln", self.write("s.json", [{**episode, "shortest": 100}]), self.folder / "r.json", says=["[0].shortest"])
        self.refuse("vln", e, self.write("r.json", [flight, flight]), says=["[1]", "'a' occurs twice"])
        # What repeats the truth is no claim: `vln run` writes the place that is nearest to the end.
        same = {**flight, **episode, "goal": [100, 30, 2]}
        self.assertEqual(self.eval("vln", e, self.write("r.json", [same]))["ne"], 50)
        self.refuse("vln", self.write("r.json", [flight]), e, says=["e.json: ", "swapped"])
        self.refuse("vln", self.folder / "r.json", says=["r.json: [0]", "no reference path"])

    def test_any_place_of_the_goal_counts(self):
        e = {"id": "a", "ref": [[0, 0, 0], [10, 0, 0]], "goal": {"position": [10, 0, 0], "radius": 1.5, "places": [[20, 0, 0]]}, "pred": [[0, 0, 0], [10, 1.48, 0], [18, 0, 0]]}
        found = self.eval("vln", self.write("e.json", [e]))
        self.assertEqual([found["sr"], found["osr"], found["ne"]], [0, 1, 2])
        e["pred"].append([19, 0, 0])
        found = self.eval("vln", self.write("e.json", [e]))
        self.assertEqual([found["sr"], found["ne"]], [1, 1])

    def test_paths_in_other_units_or_frames_are_named(self):
        e = {"id": "a", "ref": [[40, 0, 2], [70, 0, 2]], "pred": [[40, 0, 2], [64, 3, 2]]}
        self.refuse("vln", self.write("e.json", [{**e, "pred": [[40, 0], [64, 3]]}]), says=["[0].pred[0]", "[x, y]"])
        self.name("vln", self.write("e.json", [{**e, "pred": (100 * np.array(e["pred"])).tolist()}]), says="centimetres", refused=True)
        self.name("vln", self.write("e.json", [{**e, "pred": [[4000, 0, 200], [6400, 1900, 200]]}]), says="centimetres", refused=False)
        self.assertIn("another frame", self.eval("vln", self.write("e.json", [{**e, "pred": [[40, 90, 2], [64, 93, 2]]}]))["warnings"][0])
        for seed in range(20):  # agents that go anywhere, as far as they like
            random = np.random.default_rng(seed)
            episodes = [{"id": i, "ref": np.cumsum(random.normal(0, 9, (6, 3)) * (np.arange(6) > 0)[:, None], 0).tolist(), "pred": np.cumsum(random.normal(0, 9 * np.exp(random.uniform(-2, 6)), (8, 3)) * (np.arange(8) > 0)[:, None], 0).tolist()} for i in range(5)]
            self.eval("vln", self.write("e.json", episodes))
        # An agent that strays far is scored.
        found = self.eval("vln", self.write("e.json", [{**e, "pred": [[40, 0, 2], [340, 0, 2]]}]))
        self.assertEqual(found["ne"], 270)
        self.assertNotIn("warnings", found)
        plane = {"id": "a", "ref": [[40, 0], [70, 0]], "pred": [[40, 0], [64, 3]]}
        self.assertEqual(self.eval("vln", self.write("e.json", [plane]))["sr"], 1)
        self.refuse("vln", self.write("e.json", [{"ref": [[0, 0, 0]], "pred": [[0, 0, 0]]}]), says=["has no 'id'"])


class Outputs(EvalTest):
    def test_inputs_are_never_overwritten(self):
        episodes = self.write("e.json", [{"id": "a", "ref": [[0, 0, 0], [9, 0, 0]], "pred": [[0, 0, 0]]}])
        before = episodes.read_bytes()
        self.refuse("vln", episodes, "--csv", episodes, says=["--csv", "overwritten"])
        self.refuse("vln", episodes, "--csv", self.folder / "." / "e.json", says=["overwritten"])
        self.assertEqual(episodes.read_bytes(), before)
        self.eval("vln", episodes, "--csv", self.folder / "t.csv")
        self.eval("vln", episodes, "--csv", self.folder / "t.csv")
        for name in ("p", "g", "r"):
            (self.folder / name).mkdir()
            np.save(self.folder / name / "a.npy", np.random.default_rng(0).uniform(1, 9, (8, 16)))
        self.write("g/meta.json", "{}")
        depth = ("depth", self.folder / "p" / "a.npy", self.folder / "g" / "a.npy")
        self.refuse(*depth, "--csv", self.folder / "p" / "a.npy", says=["overwritten"])
        folders = ("depth", self.folder / "p", self.folder / "r", "--rolled", f"0={self.folder / 'g'}")
        self.refuse(*folders, "--csv", self.folder / "g" / "new.csv", says=["lies in", "elsewhere"])
        self.refuse(*folders, "--csv", self.folder / "p" / "a.npy", says=["lies in"])
        self.refuse(*folders, "--sheet", self.folder / "p" / "new.png", says=["--sheet", "lies in"])
        self.refuse(*folders, "--sheet", self.folder / "x.png", "--csv", self.folder / "x.png", says=["also the file of"])
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["e.json", "g", "p", "r", "t.csv"])
        self.eval(*folders, "--csv", self.folder / "p" / "scores.csv", "--sheet", self.folder / "worst.png")


class Flow(EvalTest):
    def test_figures_equal_the_definitions(self):
        random = np.random.default_rng(3)
        height, width = 20, 40
        gt = random.normal(0, 6, (height, width, 2))
        pred = gt + random.normal(0, 2.5, gt.shape)
        pred[2, 3, 0] += width  # the same column once round
        gt[5, 5:9] = np.nan
        np.save(self.folder / "g.npy", gt)
        np.save(self.folder / "p.npy", pred)
        known = np.isfinite(gt[..., 0])
        dx = pred[..., 0] - gt[..., 0]
        dx -= width * np.round(dx / width)
        error, length = np.hypot(dx, pred[..., 1] - gt[..., 1]), np.hypot(gt[..., 0], gt[..., 1])

        def direction(flow):
            rows, columns = np.mgrid[0:height, 0:width] + 0.5
            theta, phi = 2 * np.pi * ((columns + flow[..., 0]) / width - 0.5), np.pi * (0.5 - (rows + flow[..., 1]) / height)
            return np.stack([np.cos(phi) * np.sin(theta), -np.sin(phi), np.cos(phi) * np.cos(theta)], -1)

        a, b = direction(gt), direction(pred)
        angle = np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), (a * b).sum(-1)))
        for weights, w in (("pixel", np.ones((height, width))), ("solid_angle", np.broadcast_to(row_areas(height, width)[:, None], (height, width)))):
            found, mean = self.eval("flow", self.folder / "p.npy", self.folder / "g.npy", "--weights", weights), lambda values: float((w * values)[known].sum() / w[known].sum())
            self.assertSame(found["epe"], mean(error))
            self.assertSame(found["fl_all"], mean((error > 3) & (error > 0.05 * length)))
            self.assertSame(found["below3"], mean(error < 3))
            self.assertSame(found["angle_error_deg"], mean(angle))
            self.assertEqual(found["valid"], int(known.sum()))
        with open(self.folder / "g.flo", "wb") as file:
            np.array([202021.25], "<f4").tofile(file), np.array([width, height], "<i4").tofile(file), np.where(np.isnan(gt), 1e10, gt).astype("<f4").tofile(file)
        self.assertAlmostEqual(self.eval("flow", self.folder / "p.npy", self.folder / "g.flo")["epe"], mean_of(error, known), places=5)
        self.refuse("flow", self.folder / "g.npy", self.folder / "p.npy", says=["no number"])

    def forward(self, height=64):
        """Flow of a camera that flies ahead and turns a little, over ground: not symmetric."""
        width = 2 * height
        rows, columns = np.mgrid[0:height, 0:width] + 0.5
        theta, phi = 2 * np.pi * (columns / width - 0.5), np.pi * (0.5 - rows / height)
        near = 1 / (2 + np.cos(theta - 1)) + 0.3 * (phi < 0)
        return np.stack([3 + 4 * np.sin(theta) * near, -3 * np.sin(phi) * np.cos(theta) * near], -1)

    def test_likely_mistakes_are_named(self):
        gt = self.forward()
        height, width = gt.shape[:2]
        noise = np.random.default_rng(1).normal(0, 1, gt.shape) * np.hypot(gt[..., 0], gt[..., 1])[..., None]
        np.save(self.folder / "g.npy", gt)

        def predict(pred):
            np.save(self.folder / "p.npy", pred)
            return "flow", self.folder / "p.npy", self.folder / "g.npy"

        for share in (0.0, 0.1):
            pred = gt + share * noise
            for wrong, says in ((-pred, "point the other way"), (pred[..., ::-1], "exchanged"), (pred * [-1, 1], "sign of dx"), (pred / [width, height], "shares"),
                                (pred / [width / 2, height / 2], "-1 ... 1"), (pred[:, ::-1] * [-1, 1], "mirrored"), (np.roll(pred, width // 2, 1), "180")):
                self.refuse(*predict(wrong), says=["p.npy", says, "--force"])
        self.assertIn("exchanged", str(self.eval(*predict(gt[..., ::-1]), "--force")["warnings"]))
        # What networks really do wrong is measured.
        blurred = sum(np.roll(gt, (y, x), (0, 1)) for x in range(-4, 5) for y in range(-4, 5)) / 81
        for honest in [gt + share * noise for share in (0.05, 0.15, 0.3, 0.6, 1.5)] + [blurred, 0.5 * gt, 1.6 * gt, 0 * gt, np.full_like(gt, 1.0)]:
            self.assertNotIn("warnings", self.eval(*predict(honest)))

    def test_flags_that_would_do_nothing_are_refused(self):
        np.save(self.folder / "g.npy", self.forward())
        self.refuse("flow", self.folder / "g.npy", self.folder / "g.npy", "--visible", says=["--visible", "occluded"])
        self.refuse("depth", self.folder / "g.npy", self.folder / "g.npy", "--png-scale", 0.01, says=["--png-scale"])
        self.refuse("depth", self.folder / "g.npy", self.folder / "g.npy", "--h5-key", "depth", says=["--h5-key"])


def mean_of(values, known):
    return float(values[known].mean())


class Layout(EvalTest):
    SIZE = 1024, 512

    def corners(self, plan, ceiling):
        """Files' lines of a room with corners (x right, y ahead) around a camera 1.6 m above its floor."""
        width, height = self.SIZE
        lines = []
        for x, y in plan:
            column = (math.atan2(x, y) / (2 * math.pi) + 0.5) * width - 0.5
            for down in (-math.atan2(ceiling, math.hypot(x, y)), math.atan2(1.6, math.hypot(x, y))):
                lines.append(f"{column!r} {(down / math.pi + 0.5) * height - 0.5!r}")
        return "\n".join(lines)

    def test_boxes_have_the_overlap_of_their_volumes(self):
        truth = [(-2, -3), (-2, 3), (2, 3), (2, -3)]
        self.write("g.txt", self.corners(truth, 1.4))
        self.write("p.txt", self.corners(truth, 1.4))
        same = self.eval("layout", self.folder / "p.txt", self.folder / "g.txt")
        for key, value in (("iou2d", 1), ("iou3d", 1), ("corner_error_percent", 0), ("pixel_error_percent", 0), ("rmse", 0), ("d1", 1)):
            self.assertAlmostEqual(same[key], value, places=9)
        self.write("p.txt", self.corners([(-2, -3), (-2, 4), (2, 4), (2, -3)], 0.9))
        found = self.eval("layout", self.folder / "p.txt", self.folder / "g.txt")
        self.assertAlmostEqual(found["iou2d"], 24 / 28, places=9)
        self.assertAlmostEqual(found["iou3d"], 24 * 2.5 / (24 * 3 + 28 * 2.5 - 24 * 2.5), places=9)
        a, b = (np.array([list(map(float, line.split())) for line in (self.folder / name).read_text().splitlines()]) for name in ("p.txt", "g.txt"))
        self.assertSame(found["corner_error_percent"], 100 * float(np.linalg.norm(a - b, axis=1).mean()) / math.hypot(*self.SIZE))

    def test_an_l_shaped_room_is_no_box(self):
        ell = [(-3, -3), (-3, 3), (1, 3), (1, 1), (3, 1), (3, -3)]
        self.write("g.txt", self.corners(ell, 1))
        self.write("p.txt", self.corners([(-3, -3), (-3, 3), (3, 3), (3, -3)], 1))
        found = self.eval("layout", self.folder / "p.txt", self.folder / "g.txt")
        self.assertAlmostEqual(found["iou2d"], 32 / 36, places=9)
        self.assertIsNone(found["corner_error_percent"])
        # The range of every pixel again, by marching to the walls in numpy.
        self.assertAlmostEqual(found["rmse"], self.rmse(ell, [(-3, -3), (-3, 3), (3, 3), (3, -3)]), places=9)

    def rmse(self, first, second):
        width, height = self.SIZE
        theta = ((np.arange(width) + 0.5) / width - 0.5) * 2 * np.pi
        down = ((np.arange(height) + 0.5) / height - 0.5) * np.pi
        ranges = []
        for plan in (first, second):
            wall = np.full(width, np.inf)
            for (ax, ay), (bx, by) in zip(plan, plan[1:] + plan[:1]):
                sx, sy = np.sin(theta), np.cos(theta)
                matrix = np.stack([np.stack([sx, sy], 1), np.broadcast_to([ax - bx, ay - by], (width, 2))], 2)
                with np.errstate(all="ignore"):
                    try:
                        solved = np.linalg.solve(matrix, np.broadcast_to([ax, ay], (width, 2))[..., None])[..., 0]
                    except np.linalg.LinAlgError:
                        self.fail("a column runs along a wall")
                hit = (solved[:, 0] > 0) & (solved[:, 1] >= 0) & (solved[:, 1] <= 1)
                wall = np.where(hit, np.minimum(wall, solved[:, 0]), wall)
            candidates = [np.broadcast_to(wall, (height, width)) / np.cos(down)[:, None], np.where(down > 0, 1.6, 1.0)[:, None] / np.abs(np.sin(down))[:, None] * np.ones((1, width))]
            ranges.append(np.minimum(*candidates))
        return float(np.sqrt(np.mean((ranges[0] - ranges[1]) ** 2)))

    def test_corners_that_are_written_otherwise_are_named(self):
        room = np.array([[c, y] for c in (100, 300, 600, 900) for y in (180, 400)], float)
        lines = lambda corners: "".join(f"{x} {y}\n" for x, y in corners)
        self.write("g.TXT", lines(room))
        for wrong, says in ((room[:, ::-1], "x and y exchanged"), (room / [1024, 512], "shares of the width")):
            self.refuse("layout", self.write("p.txt", lines(wrong)), self.folder / "g.TXT", says=[says])
        self.assertEqual(self.eval("layout", self.write("p.JSON", {"uv": (room / [1024, 512]).tolist()}), self.folder / "g.TXT")["iou3d"], 1)

    def test_bad_corners_are_refused(self):
        self.write("g.txt", self.corners([(-2, -3), (-2, 3), (2, 3), (2, -3)], 1))
        for text, says in (("1 2\n3", "p.txt:2"), ("1 2\n", "pairs"), ("1 200\n1 100\n" * 3, "pair 0"), (self.corners([(1, 1), (1, 3), (3, 3)], 1), "outside the room")):
            self.write("p.txt", text)
            self.refuse("layout", self.folder / "p.txt", self.folder / "g.txt", says=[says])
        far = "\n".join(f"{float(x) + 2000} {y}" for x, y in (line.split() for line in (self.folder / "g.txt").read_text().splitlines()))
        self.write("p.txt", far)
        self.refuse("layout", self.folder / "p.txt", self.folder / "g.txt", says=["pair 0", "1024 columns"])
        # A bow tie around the camera is no room; a prediction of one is measured with a warning.
        crossed = self.write("p.txt", self.corners([(-2, -3), (-2, 3), (3, 3.5), (-3, -3.5), (3, -3)], 1))
        self.assertIn("cross", str(self.eval("layout", crossed, self.folder / "g.txt")["warnings"]))
        self.refuse("layout", self.folder / "g.txt", crossed, says=["cross"])

    def test_another_first_corner_is_said(self):
        plan = [(-2, -3), (-2, 3), (2, 3), (2, -3)]
        self.write("g.txt", self.corners(plan, 1))
        self.write("p.txt", self.corners(plan[1:] + plan[:1], 1))
        found = self.eval("layout", self.folder / "p.txt", self.folder / "g.txt")
        self.assertGreater(found["corner_error_percent"], 10)
        self.assertIn("begin elsewhere", str(found["warnings"]))
        self.write("p.txt", self.corners([(-2.2, -3.4), (-1.7, 3.2), (2.3, 3.3), (1.8, -3.3)], 1.2))
        self.assertNotIn("warnings", self.eval("layout", self.folder / "p.txt", self.folder / "g.txt"))


class People(EvalTest):
    def test_errors_of_distance_and_angle(self):
        truth = [{"id": 1, "xyz": [3, 0, 4], "yaw_deg": 100}, {"id": 2, "distance": 12, "angle_deg": 175}, {"id": 3, "distance": 35, "angle_deg": -10}]
        pred = [{"id": 3, "distance": 34, "angle_deg": 20}, {"id": 2, "distance": 13.5, "angle_deg": -170}, {"id": 1, "distance": 5.25, "angle_deg": 90 - math.degrees(math.atan2(3, 4))}]
        found = self.eval("mpde", self.write("p.json", pred), self.write("g.json", truth), "--protocol", "monoloco")
        self.assertSame(found["distance_mae_m"], (0.25 + 1.5 + 1) / 3)
        self.assertSame(found["angle_mae_deg"], (10 + 15 + 30) / 3)
        self.assertSame(found["angle_unwrapped_mae_deg"], math.radians(10 + 345 + 30) / 3 * 180 / 3.14)
        self.assertEqual([found["by_distance"][g]["count"] for g in found["by_distance"]], [1, 1, 0, 1])

    def test_units_and_missing_persons_are_named(self):
        truth = [{"id": i, "distance": 5 + i, "angle_deg": 0} for i in range(4)]
        gt = self.write("g.json", truth)
        self.name("mpde", self.write("p.json", [{**t, "distance": 104 * t["distance"]} for t in truth]), gt, says="centimetres", refused=True)
        self.name("mpde", self.write("p.json", [{**t, "distance": 75 * t["distance"]} for t in truth]), gt, says="centimetres", refused=False)
        self.refuse("mpde", self.write("p.json", truth[:2]), gt, says=["2 of 4", "'2'"])
        found = self.eval("mpde", self.write("p.json", truth + [{"id": 9, "distance": 3, "angle_deg": 0}]), gt)
        self.assertIn("'9'", str(found["notes"]))
        random = np.random.default_rng(1)
        turned = [{"id": i, "distance": 5, "angle_deg": float(a)} for i, a in enumerate(random.uniform(-180, 180, 20))]
        gt = self.write("g.json", turned)
        for noise in (0, 20, 40):
            angles = [t["angle_deg"] + random.normal(0, 1) * noise for t in turned]
            honest = self.write("h.json", [{**t, "angle_deg": a} for t, a in zip(turned, angles)])
            self.eval("mpde", honest, gt)
            radians = self.write("p.json", [{**t, "angle_deg": math.remainder(math.radians(a), 2 * math.pi)} for t, a in zip(turned, angles)])
            self.name("mpde", radians, gt, says="p.json: angles lie within a turn of radians", refused=noise == 0)
            self.name("mpde", honest, radians, says="p.json: angles lie within a turn of radians", refused=True)
        self.eval("mpde", self.write("p.json", [{**t, "angle_deg": 0} for t in turned]), gt)
        for seed in range(20):  # bad networks: any scale, any angle, angles that are all alike
            random = np.random.default_rng(seed)
            spread, scale = random.choice([0, 1, 3, 30, 180]), np.exp(random.uniform(-3, 3))
            mean = random.uniform(-6, 6) if seed % 2 else random.uniform(-180, 180)
            gt = self.write("g.json", [{"id": i, "distance": float(random.uniform(2, 40)), "angle_deg": float(random.normal(170, 5) if seed % 3 == 0 else random.uniform(-180, 180))} for i in range(12)])
            self.eval("mpde", self.write("p.json", [{"id": i, "distance": float(scale * random.uniform(2, 40)), "angle_deg": float(random.normal(mean, spread))} for i in range(12)]), gt)
        self.refuse("mpde", self.write("p.json", [{"id": 0, "angle_deg": 0}]), gt, says=["has no 'distance'"])


if __name__ == "__main__":
    unittest.main()
