"""`airsim360.metrics` on arrays: the same figures as of the definitions, and ValueErrors for what does not fit."""
import math
import unittest

import numpy as np

import airsim360.metrics as metrics
from references import EvalTest, box_overlap, coco_summary, depth_errors, keypoint_similarity, keypoint_summary, mask_overlap, mean_quality, panoptic_quality, row_areas, time_warping


class Metrics(unittest.TestCase):
    def setUp(self):
        self.random = np.random.default_rng(8)

    def test_depth_and_flow(self):
        gt = self.random.uniform(0, 20, (16, 32))
        pred = gt * self.random.uniform(0.7, 1.4, gt.shape)
        found, wanted = metrics.depth(pred, gt, "solid_angle", max_depth=15), depth_errors(pred, gt, row_areas(16, 32)[:, None], high=15)
        for key, value in wanted.items():
            self.assertAlmostEqual(found[key], value, delta=1e-9 * max(1, value))
        flow = self.random.normal(0, 3, (16, 32, 2))
        self.assertAlmostEqual(metrics.flow(flow + [3, 4], flow)["epe"], 5)
        self.assertAlmostEqual(metrics.flow(flow + [32, 0], flow, weights="solid_angle")["angle_error_deg"], 0)
        pred = flow + self.random.normal(0, 1, flow.shape)
        for weights in ("pixel", "solid_angle"):
            self.assertEqual(metrics.flow(np.moveaxis(pred, -1, 0), np.moveaxis(flow, -1, 0), weights), metrics.flow(pred, flow, weights))
            self.assertEqual(metrics.flow(np.moveaxis(pred, -1, 0), flow, weights), metrics.flow(pred, flow, weights))
        for wrong in (lambda: metrics.flow(flow, flow, weights="solidangle"), lambda: metrics.depth(gt[:, :20], gt[:, :20], weights="solid_angle")):
            with self.assertRaisesRegex(ValueError, "^weights"):
                wrong()

    def test_labels(self):
        gt = self.random.integers(0, 4, (3, 8, 16))
        pred = np.where(self.random.random(gt.shape) < 0.3, self.random.integers(0, 5, gt.shape), gt)
        found = metrics.semantic(pred, gt, classes=[0, 1, 2])
        for c in (0, 1, 2):
            known = gt < 3
            self.assertAlmostEqual(found["iou"][c], (known & (pred == c) & (gt == c)).sum() / (known & ((pred == c) | (gt == c))).sum())
        self.assertEqual(found["confusion"].shape, (3, 4))
        self.assertEqual(found["confusion"].sum(), (gt < 3).sum())
        ids = np.kron(self.random.integers(0, 5, (3, 4)), np.ones((4, 4), int))
        other = np.where(self.random.random(ids.shape) < 0.2, np.roll(ids, 4, 1), ids)
        info = {int(s): int(s) % 2 for s in np.unique(ids) if s}
        predicted = {int(s): int(s) % 2 for s in np.unique(other) if s}
        counts = panoptic_quality([(other, predicted, ids, {s: (c, False) for s, c in info.items()})], [0, 1])
        found = metrics.panoptic(other, ids, predicted, info)
        self.assertAlmostEqual(np.mean([found[c]["pq"] for c in found]), mean_quality(counts, list(found))[0])

    def test_entities(self):
        pictures = [(self.random.random((4, 20, 40)) < 0.5, self.random.random((5, 20, 40)) < 0.5) for _ in range(3)]
        pictures = [(g, np.concatenate([g[:3] & (self.random.random(g[:3].shape) < 0.9), p])) for g, p in pictures]
        scores = [self.random.random(len(p)) for _, p in pictures]
        cells = [([[mask_overlap(d, t, 0) for t in g] for d in p], [(t.sum(), 0, False) for t in g], [(s, d.sum()) for s, d in zip(score, p)]) for (g, p), score in zip(pictures, scores)]
        found = metrics.entity([p for _, p in pictures], scores, [g for g, _ in pictures])
        for a, b in zip(found.values(), coco_summary([cells])):
            self.assertAlmostEqual(a, float(b), places=9)

    def test_paths_people_rooms_and_tracks(self):
        ref, path = self.random.normal(0, 9, (6, 3)), self.random.normal(0, 9, (5, 3))
        self.assertAlmostEqual(metrics.vln(path, ref, radius=7)["ndtw"], math.exp(-time_warping(path, ref) / 42))
        self.assertEqual(metrics.mpde([5], [3], [4], [-3])["distance_mae_m"], 1)
        self.assertAlmostEqual(metrics.mpde([5], [3], [4], [-3])["angle_mae_deg"], math.degrees(2 * math.pi - 6))
        room = np.array([[c, y] for c in (100, 300, 600, 900) for y in (180, 400)], float)
        self.assertEqual(metrics.layout(room, room)["iou3d"], 1)
        one = np.ones((4, 2, 2), int)
        two = np.where(np.arange(4)[:, None, None] < 2, one, 2)
        self.assertEqual(metrics.tracking(0 * one, two, 0 * one, one, things=[True])["aq"], 0.5)
        self.assertAlmostEqual(metrics.bfov_iou([0, 0, 0.5, 0.5], [0, 0, 0.5, 0.5]), 1)

    def test_a_flight_along_the_reference_arrives(self):
        path = [[0, 0, 2], [30, 0, 2]]
        found = metrics.vln(path, path)
        self.assertEqual([found[k] for k in ("sr", "osr", "spl", "sdtw")], [1, 1, 1, 1])
        self.assertEqual(metrics.vln(path, path, stopped=False)["sr"], 0)
        self.assertEqual(metrics.vln(path, path, protocol="uavon", collided=True)["sr"], 0)
        self.assertEqual(metrics.vln(path, path, shortest=15)["spl"], 0.5)

    def test_what_masks_hide_is_not_valid(self):
        gt = self.random.uniform(1, 30, (16, 32))
        pred, bad = gt * self.random.uniform(0.8, 1.2, gt.shape), gt.copy()
        bad[0, :5] = 999
        found = metrics.depth(pred, np.ma.masked_greater(bad, 100))
        self.assertEqual(found["valid"], 507)
        self.assertAlmostEqual(found["absrel"], np.mean((abs(pred - gt) / gt).ravel()[5:]))
        self.assertEqual(metrics.depth(pred, np.ma.masked_array(gt, False))["valid"], 512)
        flow = self.random.normal(0, 3, (16, 32, 2))
        self.assertEqual(metrics.flow(flow, np.ma.masked_where(np.arange(1024).reshape(flow.shape) < 6, flow))["valid"], 509)
        ids = self.random.integers(0, 4, (8, 16))
        other = np.roll(ids, 1, 1)
        self.assertEqual(metrics.semantic(other, np.ma.masked_equal(ids, 0), [0, 1, 2, 3])["confusion"].tolist(), metrics.semantic(other, np.where(ids == 0, 255, ids), [0, 1, 2, 3])["confusion"].tolist())
        category = {1: 1, 2: 1, 3: 2}
        self.assertEqual(metrics.panoptic(other, np.ma.masked_equal(np.where(ids == 0, 9, ids), 9), category, category), metrics.panoptic(other, ids, category, category))
        one = np.ones((2, 4, 8), int)
        self.assertEqual(metrics.tracking(0 * one, one, np.ma.masked_array(0 * one, one > 0), one, things=[True])["tubes"], 0)
        hidden = np.ma.masked_greater(pred, 5)
        for call, name in ((lambda: metrics.depth(hidden, gt), "prediction"), (lambda: metrics.semantic(np.ma.masked_equal(ids, 1), ids, [0, 1]), "prediction"), (lambda: metrics.semantic([np.ma.masked_equal(ids, 1)], [ids], [0, 1]), "prediction"),
                           (lambda: metrics.mpde(hidden[0], gt[0], gt[0], gt[0]), "distance"), (lambda: metrics.vln(np.ma.masked_less(gt[:3, :3], 9), gt[:3, :3]), "flown"),
                           (lambda: metrics.entity([np.ma.masked_array(ids > 1, ids == 0)[None]], [[1]], [(ids > 1)[None]]), "predictions"), (lambda: metrics.path_length(np.ma.masked_less(gt[:3, :3], 9)), "path")):
            self.assertRaisesRegex(ValueError, f"^{name}: .*masked", call)

    def test_other_numbers_than_asked_for_are_named(self):
        gt = self.random.uniform(1, 30, (8, 16))
        for dtype in (complex, bool, str, object):
            self.assertRaisesRegex(ValueError, f"^prediction: .*dtype {np.dtype(dtype).name[:3]}|^prediction: .*dtype <", lambda: metrics.depth(gt.astype(dtype), gt))
        ids = self.random.integers(0, 4, (8, 16))
        self.assertEqual(metrics.semantic(ids.astype(float), ids.astype(np.uint64), [0, 1, 2, 3])["miou"], 1)
        masks = ids[None] > 1
        for call, says in ((lambda: metrics.semantic(ids + 0.5, ids, [0, 1]), "prediction: .*is no id"), (lambda: metrics.semantic(np.full(ids.shape, np.nan), ids, [0, 1]), "prediction: nan"), (lambda: metrics.semantic(ids, ids + 9, [0, 1]), "no pixel"), (lambda: metrics.semantic(ids, ids, [0, 1, 0]), "classes: the id 0 occurs twice"), (lambda: metrics.panoptic(ids, ids, {1: 1, 2: 1, 3: 1}, {1: 1, 2: 1, 3: 1}, crowds=[7]), "crowds: 7"),
                           (lambda: metrics.panoptic(ids - 1, ids, {}, {}), "prediction: -1"), (lambda: metrics.panoptic(ids + 2**33, ids, {}, {}), "prediction: 85899"), (lambda: metrics.entity([masks * 0.3], [[1]], [masks]), "predictions: 0.3"),
                           (lambda: metrics.entity([ids[None]], [[1]], [masks]), "predictions: .* ids are no masks"), (lambda: metrics.depth(gt, 0 * gt), "no pixel has a truth above 0 m"), (lambda: metrics.depth(gt, gt, min_depth=5, max_depth=1), "min < max"),
                           (lambda: metrics.depth(gt, gt, min_depth=math.nan), "min < max"), (lambda: metrics.flow(np.ones((4, 8, 2)), np.full((4, 8, 2), np.nan)), "no pixel has a flow"), (lambda: metrics.mpde([-5], [0], [5], [0]), "^distance: -5"),
                           (lambda: metrics.mpde([5], [0], [-5], [0]), "^true_distance: -5"), (lambda: metrics.tracking([[[5]]], [[[1]]], [[[0]]], [[[1]]], things=[True]), "pred_category: 5 is none of the 1"),
                           (lambda: metrics.spl(True, math.nan, 5), "shortest: nan"), (lambda: metrics.spl(True, -1, 5), "shortest: -1"), (lambda: metrics.spl(True, 1, -5), "flown: -5"), (lambda: metrics.ndtw([[0, 0, 0]], [[0, 0, 0]], math.inf), "threshold"),
                           (lambda: metrics.vln([[0, 0, 0]], [[0, 0, 0]], shortest=-1), "shortest")):
            self.assertRaisesRegex(ValueError, says, call)
        self.assertAlmostEqual(metrics.entity([masks * 255], [[1]], [masks.astype(float)])["ap"], 1)

    def test_what_does_not_fit_is_a_value_error(self):
        good = np.ones((4, 8))
        for call in (lambda: metrics.depth(good, np.ones((8, 4))), lambda: metrics.depth(good, good, weights="solid"), lambda: metrics.depth(np.ones((4, 4)), np.ones((4, 4)), weights="solid_angle"),
                     lambda: metrics.depth(good * np.nan, good), lambda: metrics.depth("x", good), lambda: metrics.semantic(good, good, []), lambda: metrics.panoptic(good, good, {}, {1: 1}),
                     lambda: metrics.entity([np.ones((2, 3, 3))], [[1]], [np.ones((1, 3, 3))]), lambda: metrics.vln([], [[0, 0, 0]]), lambda: metrics.vln([[0, 0, 0]], [[0, 0, 0]], protocol="x"),
                     lambda: metrics.layout([[1, 2]], [[1, 2]]), lambda: metrics.bfov_iou([0, 0, 4, 1], [0, 0, 1, 1])):
            self.assertRaises(ValueError, call)


class BoxesAndKeypoints(EvalTest):
    """The figures of the command, and of the definitions."""

    BOXES, POINTS = ["ap", "ap50", "ap75", "ap_small", "ap_medium", "ap_large", "ar1", "ar10", "ar100", "ar_small", "ar_medium", "ar_large"], ["ap", "ap50", "ap75", "ap_medium", "ap_large", "ar", "ar50", "ar75", "ar_medium", "ar_large"]

    def pictures(self, seed, draw, change, pictures=4):
        """Of each picture truths, predictions, their scores and the ids of both."""
        random = np.random.default_rng(seed)
        parts = [], [], [], [], []
        for _ in range(pictures):
            truths = [draw(random) for _ in range(random.integers(0, 7))]
            predictions = [change(random, t) for t in truths for _ in range(random.integers(0, 3))] + [draw(random) for _ in range(random.integers(0, 3))]
            ids = random.integers(1, 3, len(truths)), random.integers(1, 4, len(predictions))
            for part, one in zip(parts, (np.array(truths), np.array(predictions), random.integers(0, 6, len(predictions)) / 5, *ids)):
                part.append(one)
        return parts

    def command(self, task, key, truths, predictions, scores, ids, pred_ids, extra=lambda i, k: {}, arguments=(), image={}, to=lambda row: row.ravel().tolist()):
        gt = [{"image_id": i, "category_id": int(ids[i][k]), key: to(row), **extra(i, k)} for i, rows in enumerate(truths) for k, row in enumerate(rows)]
        pred = [{"image_id": i, "category_id": int(pred_ids[i][k]), key: to(row), "score": float(scores[i][k])} for i, rows in enumerate(predictions) for k, row in enumerate(rows)]
        self.write("gt.json", {"images": [{"id": i, **image} for i in range(len(truths))], "annotations": [{"id": n + 1, **one} for n, one in enumerate(gt)], "categories": [{"id": c, "name": f"c{c}"} for c in (1, 2)]})
        return self.eval(task, self.write("pred.json", pred), self.folder / "gt.json", *arguments)

    def same(self, found, wanted, figures, what):
        for figure in figures:
            self.assertAlmostEqual(found[figure], float(wanted[figure]), delta=1e-9, msg=f"{what} {figure}")

    def test_boxes_in_pictures(self):
        for seed in range(6):
            draw = lambda random: np.array([*random.uniform(0, 300, 2), *np.exp(random.uniform(2, 5.5, 2))])
            gt, pred, scores, ids, pred_ids = self.pictures(seed, draw, lambda random, t: t * np.exp(random.normal(0, 0.1, 4)))
            random = np.random.default_rng(seed)
            crowds, areas = [(random.random(len(g)) < 0.2).astype(int) for g in gt], [random.uniform(0.3, 1, len(g)) * np.prod(g[:, 2:], 1) if len(g) else [] for g in gt]
            found = metrics.boxes(pred, scores, gt, pred_categories=pred_ids, categories=ids, crowds=crowds, areas=areas)
            wanted = self.command("boxes", "bbox", gt, pred, scores, ids, pred_ids, lambda i, k: {"area": float(areas[i][k]), "iscrowd": int(crowds[i][k])}, ["--force"])
            self.same(found, wanted, self.BOXES, seed)
            for c in (1, 2):
                if c in found["per_category"]:
                    self.same(found["per_category"][c], wanted["per_class"][f"c{c}"], self.BOXES, (seed, c))

            def cell(i, c):
                t, p = [k for k in range(len(gt[i])) if ids[i][k] == c], [k for k in range(len(pred[i])) if pred_ids[i][k] == c]
                return [[box_overlap(pred[i][a], gt[i][b], crowds[i][b]) for b in t] for a in p], [(areas[i][b], crowds[i][b], False) for b in t], [(scores[i][a], np.prod(pred[i][a][2:])) for a in p]

            self.same(found, dict(zip(self.BOXES, coco_summary([[cell(i, c) for i in range(4)] for c in (1, 2)]))), self.BOXES, seed)
            self.same(metrics.boxes(pred, scores, gt), self.command("boxes", "bbox", gt, pred, scores, ids, pred_ids, arguments=["--class-agnostic", "--force"]), self.BOXES, seed)

    def test_boxes_round_the_seam_on_the_sphere_and_in_space(self):
        wide = lambda random: np.array([random.uniform(0, 400), random.uniform(0, 100), *random.uniform(30, 150, 2)])
        gt, pred, scores, ids, pred_ids = self.pictures(3, wide, lambda random, t: np.array([(t[0] + random.normal(0, 5)) % 400, *t[1:]]))
        wanted = self.command("boxes", "bbox", gt, pred, scores, ids, pred_ids, arguments=["--wrap", "--force"], image={"width": 400, "height": 200})
        self.same(metrics.boxes(pred, scores, gt, "bbox", pred_ids, ids, wrap=400), wanted, self.BOXES, "wrap")
        seam = [[[390, 10, 40, 40]]], [[1]], [[[-10, 10, 40, 40]]]
        self.assertAlmostEqual(metrics.boxes(*seam, wrap=400)["ap"] - metrics.boxes(*seam)["ap"], 1)
        sphere = lambda random: np.array([random.uniform(-3, 3), random.uniform(-1.2, 1.2), *random.uniform(0.2, 1.2, 2), random.uniform(-1, 1)])
        space = lambda random: np.array([*random.uniform(-9, 9, 3), *random.uniform(1, 5, 3), random.uniform(-3, 3)])
        for kind, draw, to in (("bfov", sphere, lambda row: np.degrees(row).tolist()), ("box3d", space, lambda row: [*row[:6].tolist(), math.degrees(row[6])])):
            gt, pred, scores, ids, pred_ids = self.pictures(4, draw, lambda random, t: t + random.normal(0, 0.05, len(t)))
            wanted = self.command("boxes", kind, gt, pred, scores, ids, pred_ids, arguments=["--kind", kind, "--force"], to=to)
            self.same(metrics.boxes(pred, scores, gt, kind, pred_ids, ids), wanted, ["ap", "ap50", "ap75", "ar"], kind)
            self.assertGreater(wanted["ap50"], 0)
        exact = metrics.boxes([[[0, 0, 0.5, 0.5]]], [[1]], [[[0, 0, 0.5, 0.5]]], "bfov")
        self.assertAlmostEqual(exact["ap"], 1)

    def test_keypoints(self):
        def draw(random):
            scale, x, y = random.uniform(20, 160), *random.uniform(0, 300, 2)
            points = np.stack([x + scale * random.random(17), y + 2 * scale * random.random(17), random.integers(0, 3, 17)], 1)
            return points * (random.random() > 0.2)

        for seed in range(4):
            gt, pred, scores, ids, pred_ids = self.pictures(seed, draw, lambda random, t: t + np.append(random.normal(0, 6, (17, 2)), np.zeros((17, 1)), 1))
            random = np.random.default_rng(seed)
            boxes = [random.uniform(20, 200, (len(g), 4)) for g in gt]
            areas = [random.uniform(400, 30000, len(g)) for g in gt]
            found = metrics.keypoints(pred, scores, gt, boxes, pred_categories=pred_ids, categories=ids, areas=areas)
            extra = lambda i, k: {"bbox": boxes[i][k].tolist(), "area": float(areas[i][k])}
            self.same(found, self.command("keypoints", "keypoints", gt, pred, scores, ids, pred_ids, extra, ["--force"]), self.POINTS, seed)
            cells = [([[keypoint_similarity(a, b, area, box) for b, area, box in zip(gt[i], areas[i], boxes[i])] for a in pred[i]], [(area, False, not (b[:, 2] > 0).any()) for b, area in zip(gt[i], areas[i])],
                      [(s, np.prod(np.ptp(a[:, :2], axis=0))) for s, a in zip(scores[i], pred[i])]) for i in range(4)]
            self.same(metrics.keypoints(pred, scores, gt, boxes, areas=areas), dict(zip(self.POINTS, keypoint_summary(cells))), self.POINTS, seed)
        two = np.array([[[0, 0, 2], [10, 0, 2]]], float)
        loose, tight = (metrics.keypoints([two + [3, 0, 0]], [[1]], [two], [[[0, 0, 10, 10]]], sigmas=[s, s])["ap"] for s in (0.5, 0.01))
        self.assertEqual((loose > 0.8, tight), (True, 0))

    def test_what_does_not_fit_is_named(self):
        box, points = [[0, 0, 4, 4]], np.ones((1, 17, 3))
        for call, says in ((lambda: metrics.boxes([], [], []), "truths: no pictures"), (lambda: metrics.boxes([box], [[1]], [box, box]), "predictions: one entry a picture"), (lambda: metrics.boxes([box], [[1, 2]], [box]), "scores: picture 0 needs 1 numbers"),
                           (lambda: metrics.boxes([[[0, 0, 4]]], [[1]], [box]), "predictions: picture 0 needs an array of .K, 4."), (lambda: metrics.boxes([[[0, 0, -4, 4]]], [[1]], [box]), "predictions: a box is"), (lambda: metrics.boxes([box], [[1]], [box], "bfow"), "kind: .*bfov"),
                           (lambda: metrics.boxes([box], [[math.nan]], [box]), "scores"), (lambda: metrics.boxes([box], [[1]], [box], categories=[[1]]), "pred_categories: give"), (lambda: metrics.boxes([box], [[1]], [box], "bfov"), "between 0 and pi"),
                           (lambda: metrics.boxes([box], [[1]], [box], wrap=0), "wrap: 0"), (lambda: metrics.boxes([box], [[1]], [box], "bfov", wrap=9), "wrap: is for"), (lambda: metrics.boxes([box], [[1]], [box], "bfov", areas=[[1]]), "areas: are for"), (lambda: metrics.boxes([box], [[1]], [box], crowds=[[1, 0]]), "crowds: picture 0 needs 1 ids"),
                           (lambda: metrics.keypoints([points], [[1]], [points[:, :3]], [box]), "truths: picture 0 has 3 keypoints"), (lambda: metrics.keypoints([points], [[1]], [points], [[]]), "boxes: picture 0"), (lambda: metrics.keypoints([points], [[1]], [points], [box], sigmas=[0]), "sigmas")):
            self.assertRaisesRegex(ValueError, says, call)
        self.assertEqual(metrics.boxes([[]], [[]], [box])["ap"], 0)
        self.assertEqual(metrics.boxes([box], [[1]], [[]])["ap"], -1)


if __name__ == "__main__":
    unittest.main()
