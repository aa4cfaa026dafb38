"""`eval entity`, `eval keypoints`, `eval boxes` against numpy: ties, crowds, empty pictures, areas, limits, every way to write a mask."""
import unittest

import numpy as np

from references import AREAS, EvalTest, average_precision, coco_summary, compressed, keypoint_similarity, keypoint_summary, mask_overlap, row_areas, runs


def rectangle(width, height, x, y, w, h):
    mask = np.zeros((height, width), bool)
    mask[y : y + h, x : x + w] = True
    return mask


class Masks(EvalTest):
    NAMES = ["ap", "ap50", "ap75", "ap_small", "ap_medium", "ap_large", "ar1", "ar10", "ar100", "ar_small", "ar_medium", "ar_large"]

    def case(self, seed, size=(150, 120), categories=2, pictures=4):
        """Truths and detections with their masks; written as files."""
        random = np.random.default_rng(seed)
        width, height = size
        truths, detections, images = [], [], []
        for image in random.permutation(pictures):
            image = int(image) * 5 + 2
            images.append({"id": image, "width": width, "height": height})
            for _ in range(random.integers(0, 6)):
                x, y, w, h = random.integers(0, width - 2), random.integers(0, height - 2), random.integers(2, width), random.integers(2, height)
                mask = rectangle(width, height, x, y, w, h)
                # A pixel-aligned rectangle is its own polygon; other masks are run lengths.
                way = random.integers(0, 3)
                if way == 0:
                    right, bottom = min(x + w, width), min(y + h, height)
                    segmentation = [[float(v) for v in (x, y, x, bottom, right, bottom, right, y)]]
                else:
                    mask &= random.random(mask.shape) < 0.95
                    segmentation = {"size": [height, width], "counts": compressed(mask) if way == 1 else runs(mask)}
                category = int(random.integers(1, categories + 1))
                truths.append({"id": len(truths) + 1, "image_id": image, "category_id": category, "segmentation": segmentation, "area": int(mask.sum()),
                               "iscrowd": int(random.random() < 0.2), "mask": mask})
                for _ in range(random.integers(0, 3)):
                    moved = np.roll(mask, (random.integers(-3, 4), random.integers(-3, 4)), (0, 1))
                    detections.append((image, category if random.random() < 0.9 else 1, float(random.integers(0, 5)) / 4, moved))
            if random.random() < 0.7:
                detections.append((image, 1, float(random.random()), rectangle(width, height, 1, 1, *random.integers(1, 90, 2))))
        strip = lambda t: {k: v for k, v in t.items() if k != "mask"}
        gt = {"images": images, "annotations": [strip(t) for t in truths], "categories": [{"id": c, "name": f"c{c}"} for c in range(1, categories + 1)]}
        results = [{"image_id": i, "category_id": c, "score": s, "segmentation": {"size": [height, width], "counts": compressed(m)}} for i, c, s, m in detections]
        self.write("gt.json", gt)
        self.write("pred.json", results)
        return sorted(i["id"] for i in images), truths, detections

    def cells(self, images, truths, detections, categories, area=np.sum, overlap=mask_overlap):
        result = []
        for c in categories:
            cells = []
            for image in images:
                t = [x for x in truths if x["image_id"] == image and x["category_id"] in c]
                d = [x for x in detections if x[0] == image and x[1] in c]
                table = [[overlap(x[3], y["mask"], y["iscrowd"]) for y in t] for x in d]
                cells.append((table, [(area(y["mask"]), y["iscrowd"], False) for y in t], [(x[2], area(x[3])) for x in d]))
            result.append(cells)
        return result

    def check(self, found, wanted, what):
        for name, a, b in zip(self.NAMES, found["summary"], wanted):
            self.assertSame(a, float(b), f"{what} {name}")
            self.assertEqual(a, found[name])

    def test_twelve_figures_equal_the_definition(self):
        for seed in range(8):
            images, truths, detections = self.case(seed)
            found = self.eval("entity", self.folder / "pred.json", self.folder / "gt.json")
            self.check(found, coco_summary(self.cells(images, truths, detections, [[1], [2]])), seed)
            found = self.eval("entity", self.folder / "pred.json", self.folder / "gt.json", "--class-agnostic", "--threads", 1)
            self.check(found, coco_summary(self.cells(images, truths, detections, [[1, 2]])), f"{seed} agnostic")

    def test_limits_of_detections(self):
        images, truths, detections = self.case(20, pictures=2)
        found = self.eval("entity", self.folder / "pred.json", self.folder / "gt.json", "--max-detections", "1,2")
        cells = self.cells(images, truths, detections, [[1], [2]])
        wanted = coco_summary(cells, (1, 2))
        self.assertSame(found["ap"], wanted[0])
        self.assertSame(found["ar1"], wanted[6])
        self.assertSame(found["ar2"], wanted[7])
        self.assertSame(found["ap_all"], coco_summary(cells)[0])

    def test_overlaps_by_solid_angle(self):
        images, truths, detections = self.case(31, size=(128, 64), pictures=3)
        w = row_areas(64, 128)[:, None]

        def overlap(d, t, crowd):
            shared = (w * (d & t)).sum()
            return shared / ((w * d).sum() if crowd else (w * (d | t)).sum()) if shared else 0.0

        found = self.eval("entity", self.folder / "pred.json", self.folder / "gt.json", "--weights", "solid_angle")
        area = lambda mask: (w * mask).sum() / w[32, 0]
        self.check(found, coco_summary(self.cells(images, truths, detections, [[1], [2]], area, overlap)), "solid angle")

    def test_places_in_the_panorama(self):
        images, truths, detections = self.case(41, size=(128, 64), pictures=6, categories=1)
        found = self.eval("entity", self.folder / "pred.json", self.folder / "gt.json", "--seam", 9, "--latitude-bands", 3)

        def columns(mask):
            filled = np.flatnonzero(mask.any(0))
            return min(filled[0], 127 - filled[-1])

        def latitude(mask):
            filled = np.flatnonzero(mask.any(1))
            return 90 - 180 * (filled[0] + filled[-1] + 1) / 2 / 64

        for place, ranges, got in ((columns, [(0, 8), (9, 64)], [found["seam"]["near"]["ap"], found["seam"]["far"]["ap"]]),
                                   (latitude, [(30, 90), (-30, 29.999), (-90, -30.001)], [b["ap"] for b in found["latitude_bands"]])):
            for span, ap in zip(ranges, got):
                wanted = average_precision(self.cells(images, truths, detections, [[1]], place)[0], span, 100)
                self.assertSame(ap, float(wanted[0].mean()) if wanted else -1, str(span))

    def test_nothing_to_find_is_minus_one(self):
        self.write("gt.json", {"images": [{"id": 1, "width": 10, "height": 10}], "annotations": [], "categories": [{"id": 1, "name": "a"}]})
        self.write("pred.json", [])
        self.assertEqual(self.eval("entity", self.folder / "pred.json", self.folder / "gt.json")["summary"], [-1] * 12)

    def test_held_out_categories_and_intervals(self):
        images, truths, detections = self.case(5)
        found = self.eval("entity", self.folder / "pred.json", self.folder / "gt.json", "--open-world", "c2", "--bootstrap", 60, "--csv", self.folder / "t.csv")
        first, second = (coco_summary(self.cells(images, truths, detections, [[c]]))[0] for c in (1, 2))
        self.assertSame(found["open_world"]["ap_known"], first)
        self.assertSame(found["open_world"]["ap_held_out"], second)
        self.assertSame(found["per_class"]["c1"]["ap"], first)
        self.assertLessEqual(found["intervals"]["ap"][0], found["intervals"]["ap"][1])
        self.assertEqual(len((self.folder / "t.csv").read_text().splitlines()), 3)

    def test_bad_files_are_refused(self):
        self.case(1)
        good = self.folder / "gt.json"
        mask = {"size": [120, 150], "counts": [18000]}
        for text, says in (('[{"image_id": 999, "category_id": 1, "score": 1, "segmentation": []}]', "999"), ('[{"image_id": 2, "category_id": 1, "score": "x"}]', "score"),
                           ([{"image_id": 2, "category_id": 1, "score": 1, "segmentation": {**mask, "size": [60, 75]}}], "75x60"),
                           ([{"image_id": 2, "category_id": 1, "score": 1, "segmentation": {**mask, "counts": [5, 5]}}], "sum to 10"),
                           ([{"image_id": 2, "category_id": 1, "score": 1, "segmentation": {**mask, "counts": [-4, 18004]}}], "-4"),
                           ([{"image_id": 2, "category_id": 1, "score": 1, "segmentation": {**mask, "counts": "PP\x7f"}}], "segmentation"),
                           ([{"image_id": 2, "category_id": 1, "score": 1, "segmentation": [[0, 0, 1e9, 0, 1e9, 1e9]]}], "pixels away"),
                           ("{", "pred.json:1:2"), ('{"a": 1}', "annotations")):
            self.write("pred.json", text)
            self.refuse("entity", self.folder / "pred.json", good, says=[says])
        self.write("gt.json", {"images": [{"id": 1, "width": 2000000000, "height": 2000000000}], "annotations": [], "categories": []})
        self.refuse("entity", self.folder / "pred.json", good, says=["gt.json"])


class Keypoints(EvalTest):
    def test_ten_figures_equal_the_definition(self):
        for seed in range(6):
            random = np.random.default_rng(seed)
            truths, detections = [], []
            for image in range(1, 5):
                for _ in range(random.integers(0, 5)):
                    scale, x, y = random.uniform(20, 160), *random.uniform(0, 300, 2)
                    points = np.stack([x + scale * random.random(17), y + 2 * scale * random.random(17), random.integers(0, 3, 17)], 1)
                    if random.random() < 0.2:
                        points[:] = 0
                    truths.append({"id": len(truths) + 1, "image_id": image, "category_id": 1, "keypoints": points.ravel().tolist(), "bbox": [x, y, scale, 2 * scale],
                                   "area": 1.2 * scale**2, "iscrowd": 0, "num_keypoints": int((points[:, 2] > 0).sum())})
                    for _ in range(random.integers(0, 3)):
                        moved = points.copy()
                        moved[:, :2] += random.normal(0, 0.06 * scale, (17, 2))
                        detections.append({"image_id": image, "category_id": 1, "keypoints": moved.ravel().tolist(), "score": float(random.integers(0, 8)) / 7})
            self.write("gt.json", {"images": [{"id": i} for i in range(1, 5)], "annotations": truths, "categories": [{"id": 1, "name": "person"}]})
            self.write("pred.json", detections)

            def similarity(d, t):
                return keypoint_similarity(np.reshape(d["keypoints"], (17, 3)), np.reshape(t["keypoints"], (17, 3)), t["area"], t["bbox"])

            cells = []
            for image in range(1, 5):
                t, d = ([x for x in some if x["image_id"] == image] for some in (truths, detections))
                extent = lambda x: np.prod(np.ptp(np.reshape(x["keypoints"], (17, 3))[:, :2], axis=0))
                cells.append(([[similarity(a, b) for b in t] for a in d], [(b["area"], False, b["num_keypoints"] == 0) for b in t], [(a["score"], extent(a)) for a in d]))
            found, wanted = self.eval("keypoints", self.folder / "pred.json", self.folder / "gt.json"), keypoint_summary(cells)
            for a, b in zip(found["summary"], wanted):
                self.assertSame(a, float(b), str(seed))


class Mistakes(EvalTest):
    """Results that match almost nothing because of how they are written are refused with the cause; --force measures them."""

    def boxes(self, change=lambda box: box, category=lambda c: c, key="bbox", values=None, noise=3.0, categories=(1, 2, 3, 5)):
        random = np.random.default_rng(7)
        images = [{"id": i, "width": 400, "height": 200} for i in range(1, 6)]
        truths, results = [], []
        for image in images:
            for c in categories:
                box = np.array([random.uniform(0, 200), random.uniform(0, 100), random.uniform(30, 180), random.uniform(30, 90)]) if values is None else values(random)
                truths.append({"id": len(truths) + 1, "image_id": image["id"], "category_id": c, key: [float(v) for v in box]})
                guess = np.array(box) + random.normal(0, noise, len(box))
                results.append({"image_id": image["id"], "category_id": category(c), "score": float(random.random()), key: [float(v) for v in change(guess)]})
        self.write("gt.json", {"images": images, "annotations": truths, "categories": [{"id": c, "name": f"c{c}"} for c in sorted({*categories, 4})]})
        return self.write("pred.json", results), self.folder / "gt.json"

    def test_other_boxes_and_ids_are_named(self):
        self.assertGreater(self.eval("boxes", *self.boxes())["ap50"], 0.9)
        for says, options in (("[x1, y1, x2, y2]", {"change": lambda b: [b[0], b[1], b[0] + b[2], b[1] + b[3]]}), ("fractions of the picture", {"change": lambda b: b / [400, 200, 400, 200]}),
                              ("middle", {"change": lambda b: [b[0] + b[2] / 2, b[1] + b[3] / 2, b[2], b[3]]}), ("one too large", {"category": lambda c: c + 1}), ("one too small", {"category": lambda c: c - 1}), ("places in the truth's list", {"category": lambda c: {5: 1, 8: 2, 12: 3, 20: 4}[c], "categories": (5, 8, 12, 20)})):
            self.refuse("boxes", *self.boxes(**options), says=["pred.json: ", says, "--force"])
        found = self.eval("boxes", *self.boxes(category=lambda c: c + 1), "--force")
        self.assertTrue(any("one too large" in w for w in found["warnings"]))
        self.assertGreater(self.eval("boxes", *self.boxes(category=lambda c: c + 1), "--class-agnostic")["ap50"], 0.5)
        sphere = lambda random: [random.uniform(-150, 150), random.uniform(-50, 50), random.uniform(20, 60), random.uniform(20, 60)]
        self.assertGreater(self.eval("boxes", *self.boxes(key="bfov", values=sphere, noise=1), "--kind", "bfov")["ap50"], 0.9)
        self.refuse("boxes", *self.boxes(np.radians, key="bfov", values=sphere, noise=1), "--kind", "bfov", says=["radians"])

    def test_poor_predictions_are_no_mistake(self):
        for noise in (15, 60, 300):
            files = self.boxes(lambda b: np.abs(b), noise=noise)
            self.assertNotIn("warnings", self.eval("boxes", *files))
        for seed in range(20):  # each category for any other one, boxes too large or elsewhere
            random = np.random.default_rng(seed)
            taken = dict(zip((1, 2, 3, 5), random.permutation([1, 2, 3, 5]) if seed % 2 else random.choice([1, 2, 3, 4, 5], 4)))
            scale, moved = np.exp(random.uniform(-1, 1)) * (seed % 3 == 0) + (seed % 3 > 0), random.normal(0, 40, 2) * (seed % 4 == 0)
            self.eval("boxes", *self.boxes(lambda b: [*(b[:2] + moved), *np.abs(scale * b[2:])], category=lambda c: int(taken[c]), noise=random.uniform(0, 30)))

    def test_unknown_categories_are_said(self):
        found = self.eval("boxes", *self.boxes(category=lambda c: 81 if c == 5 else c))
        self.assertIn("5 of 20 detections have a category_id that", found["warnings"][0])
        self.refuse("boxes", *self.boxes(category=lambda c: c + 80), says=["20 of 20", "81 first"])
        pred, gt = self.boxes()
        self.refuse("boxes", gt, pred, says=["swapped"])
        self.refuse("boxes", pred, pred, says=["swapped"])
        self.refuse("boxes", gt, gt, says=["swapped"])
        self.refuse("boxes", *self.boxes(lambda b: [b[0], b[1], -b[2], b[3]]), says=["[0].bbox", "below 0"])

    def test_polygons_are_pairs_of_numbers(self):
        gt = {"images": [{"id": 1, "width": 40, "height": 20}], "categories": [{"id": 1, "name": "a"}], "annotations": [{"id": 1, "image_id": 1, "category_id": 1, "segmentation": [[2, 2, 9, 9]]}]}
        pred = self.write("pred.json", [{"image_id": 1, "category_id": 1, "score": 1, "segmentation": [[2, 2, 2, 11, 11, 11, 11, 2]]}])
        found = self.eval("entity", pred, self.write("gt.json", gt))
        self.assertSame(found["ap"], 1)
        self.assertTrue(any("four numbers" in note for note in found["notes"]))
        gt["annotations"][0]["segmentation"] = [[2, 2, 2, 11, 11, 11, 11]]
        self.refuse("entity", pred, self.write("gt.json", gt), says=["annotations[0].segmentation[0]", "7 numbers"])

    def test_keypoints_that_cannot_match_are_named(self):
        random = np.random.default_rng(9)
        images = [{"id": i, "width": 400, "height": 200} for i in range(1, 6)]
        truths, results = [], []
        for image in images:
            points = random.uniform(20, 180, (17, 2))
            flat = lambda xy: np.concatenate([xy, np.full((17, 1), 2)], 1).ravel().tolist()
            truths.append({"id": image["id"], "image_id": image["id"], "category_id": 1, "keypoints": flat(points), "bbox": [20, 20, 160, 160], "area": 12800, "num_keypoints": 17})
            results.append({"image_id": image["id"], "category_id": 1, "score": 0.5, "keypoints": flat(points + random.normal(0, 2, points.shape))})
        files = lambda change: (self.write("pred.json", results), self.write("gt.json", {"images": images, "categories": [{"id": 1, "name": "person"}], "annotations": [{**t, **change} for t in truths]}))
        self.assertGreater(self.eval("keypoints", *files({}))["ap50"], 0.9)
        self.refuse("keypoints", *files({"area": 0}), says=["gt.json: ", "'area' is 0 for 5 of 5"])
        self.refuse("keypoints", *files({"num_keypoints": 0}), says=["'num_keypoints' is 0"])
        self.assertEqual(self.eval("keypoints", *files({"num_keypoints": 0}), "--force")["ap"], -1)
        for r in results:
            r["keypoints"] = (np.array(r["keypoints"]).reshape(17, 3) / [400, 200, 1]).ravel().tolist()
        self.refuse("keypoints", *files({}), says=["fractions of the picture"])


class Boxes(EvalTest):
    def files(self, key, truths, detections, size=(400, 200)):
        self.write("gt.json", {"images": [{"id": 1, "width": size[0], "height": size[1]}], "categories": [{"id": 1, "name": "a"}],
                               "annotations": [{"id": i + 1, "image_id": 1, "category_id": 1, key: t} for i, t in enumerate(truths)]})
        self.write("pred.json", [{"image_id": 1, "category_id": 1, "score": s, key: d} for s, d in detections])
        return self.folder / "pred.json", self.folder / "gt.json"

    def test_boxes_meet_over_the_seam(self):
        # The halves of one thing on both sides of the seam.
        pred, gt = self.files("bbox", [[380, 50, 60, 40]], [(0.9, [-20, 50, 60, 40])])
        self.assertEqual(self.eval("boxes", pred, gt)["ap"], 0)
        self.assertSame(self.eval("boxes", pred, gt, "--wrap")["ap"], 1)
        pred, gt = self.files("bbox", [[380, 50, 60, 40]], [(0.9, [385, 50, 60, 40])])
        self.assertSame(self.eval("boxes", pred, gt, "--wrap")["ap"], 0.7)  # IoU 55 / 65: thresholds up to 0.80
        self.assertSame(self.eval("boxes", pred, gt, "--wrap")["ap75"], 1)

    def test_boxes_on_the_circle_of_columns_are_taken_where_files_have_them(self):
        # As our exports have them: bbox spans the picture, bbox_wrap does not.
        plain, wrapped = [0, 50, 400, 40], [380, 50, 60, 40]
        pred, gt = self.files("bbox", [plain], [(0.9, plain)])
        gt.write_text(gt.read_text().replace('"bbox"', f'"bbox_wrap": {wrapped}, "bbox"'))
        self.assertEqual(self.eval("boxes", pred, gt, "--wrap")["ap"], 0)
        pred.write_text(pred.read_text().replace('"bbox"', f'"bbox_wrap": {wrapped}, "bbox"'))
        found = self.eval("boxes", pred, gt, "--wrap")
        self.assertSame(found["ap"], 1)
        self.assertIn("of 1 truths", str(found["notes"]))
        self.assertIn("of 1 detections", str(found["notes"]))
        self.files("bbox", [], [(0.9, wrapped)])
        gt.write_text(self.files("bbox", [plain], [(0.9, wrapped)])[1].read_text().replace('"bbox"', f'"bbox_wrap": {wrapped}, "bbox"'))
        self.assertSame(self.eval("boxes", pred, gt, "--wrap")["ap"], 1)
        self.assertEqual(self.eval("boxes", pred, gt)["ap"], 0)

    def test_boxes_on_the_sphere_by_their_solid_angle(self):
        # Two boxes on the equator, one twice as high: A = 4 asin(sin(w / 2) sin(h / 2)), one within the other.
        area = lambda w, h: 4 * np.arcsin(np.sin(np.radians(w) / 2) * np.sin(np.radians(h) / 2))
        for ratio in (1.3, 1.7):
            iou = area(40, 40) / area(40, 40 * ratio)
            pred, gt = self.files("bfov", [[100, 0, 40, 40]], [(0.5, [100, 0, 40, 40 * ratio])])
            self.assertSame(self.eval("boxes", pred, gt, "--kind", "bfov")["ap"], float(np.mean(iou >= np.linspace(0.5, 0.95, 10))))
        self.refuse("boxes", *self.files("bfov", [[0, 0, 190, 10]], []), "--kind", "bfov", says=["180"])

    def test_boxes_in_space_by_their_volume(self):
        # Turned by 45 degrees about the same centre, two squares share a regular octagon: 8 (sqrt 2 - 1) r² of side 2 r.
        iou = 8 * (np.sqrt(2) - 1) / (8 - 8 * (np.sqrt(2) - 1))
        pred, gt = self.files("box3d", [{"center": [5, 1, 2], "size": [2, 2, 3], "yaw_deg": 10}], [(0.5, {"center": [5, 1, 2], "size": [2, 2, 3], "yaw_deg": 55})])
        self.assertSame(self.eval("boxes", pred, gt, "--kind", "box3d")["ap"], float(np.mean(iou >= np.linspace(0.5, 0.95, 10))))
        pred, gt = self.files("box3d", [[0, 0, 0, 4, 2, 1, 30]], [(0.5, [0, 0, 0.2, 4, 2, 1, 30])])
        self.assertSame(self.eval("boxes", pred, gt, "--kind", "box3d")["ap"], float(np.mean(0.8 / 1.2 >= np.linspace(0.5, 0.95, 10))))


if __name__ == "__main__":
    unittest.main()
