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
        self.refuse("vln", refs, refs, "--radius", "0", says=["--radius"])
        self.refuse("vln", refs, refs, "--protocol", "openfli", says=["openfly"])


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

    def test_bad_corners_are_refused(self):
        self.write("g.txt", self.corners([(-2, -3), (-2, 3), (2, 3), (2, -3)], 1))
        for text, says in (("1 2\n3", "p.txt:2"), ("1 2\n", "pairs"), ("1 200\n1 100\n" * 3, "pair 0"), (self.corners([(1, 1), (1, 3), (3, 3)], 1), "outside the room")):
            self.write("p.txt", text)
            self.refuse("layout", self.folder / "p.txt", self.folder / "g.txt", says=[says])


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
        self.refuse("mpde", self.write("p.json", [{**t, "distance": 104 * t["distance"]} for t in truth]), gt, says=["centimetres"])
        self.refuse("mpde", self.write("p.json", truth[:2]), gt, says=["2 of 4", "'2'"])
        self.refuse("mpde", self.write("p.json", [{"id": 0, "angle_deg": 0}]), gt, says=["has no 'distance'"])


if __name__ == "__main__":
    unittest.main()
