"""`airsim360.metrics` on arrays: the same figures as of the definitions, and ValueErrors for what does not fit."""
import math
import unittest

import numpy as np

import airsim360.metrics as metrics
from references import coco_summary, depth_errors, mask_overlap, mean_quality, panoptic_quality, row_areas, time_warping


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
        for call, says in ((lambda: metrics.semantic(ids + 0.5, ids, [0, 1]), "prediction: .*is no id"), (lambda: metrics.semantic(np.full(ids.shape, np.nan), ids, [0, 1]), "prediction: nan"), (lambda: metrics.semantic(ids, ids + 9, [0, 1]), "no pixel"),
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


if __name__ == "__main__":
    unittest.main()
