"""`eval semantic`, `eval panoptic`, `eval video` against numpy, with void, crowds, absent classes and seams."""
import json
import shutil
import unittest

import numpy as np

from references import EvalTest, mean_quality, panoptic_quality, row_areas, write_ids, write_png


class Semantic(EvalTest):
    CLASSES = "0 road\n3 car\n7 sky\n9 unicorn\n"
    IDS = [0, 3, 7, 9]

    def pictures(self, count, height=24):
        random = np.random.default_rng(count)
        pairs = []
        (self.folder / "pred").mkdir()
        (self.folder / "gt").mkdir()
        for i in range(count):
            gt = np.kron(random.choice([0, 3, 7, 255], (height // 4, height // 2)), np.ones((4, 4), int))
            pred = np.where(random.random(gt.shape) < 0.3, random.choice([0, 3, 7, 200], gt.shape), gt)
            write_png(self.folder / f"pred/{i}.png", pred)
            write_png(self.folder / f"gt/{i}.png", gt)
            pairs.append((pred, gt))
        return pairs

    def wanted(self, pairs, weight=1.0):
        """IoU and accuracy of each class from sums over all pictures; pixel accuracy."""
        ious, accuracies = {}, {}
        right = total = 0.0
        for c in self.IDS:
            both = either = truth = 0.0
            for pred, gt in pairs:
                known = np.isin(gt, self.IDS)
                w = np.broadcast_to(weight, gt.shape)
                both += w[(pred == c) & (gt == c)].sum()
                either += w[known & ((pred == c) | (gt == c))].sum()
                truth += w[gt == c].sum()
            ious[c] = both / either if either else np.nan
            accuracies[c] = both / truth if truth else np.nan
            right, total = right + both, total + truth
        return ious, accuracies, right / total

    def test_one_table_of_all_pictures(self):
        pairs, classes = self.pictures(4), self.write("classes.txt", self.CLASSES)
        for weights, w in (("pixel", 1.0), ("solid_angle", row_areas(24, 48)[:, None])):
            found = self.eval("semantic", self.folder / "pred", self.folder / "gt", "--classes", classes, "--weights", weights)
            ious, accuracies, accuracy = self.wanted(pairs, w)
            self.assertSame(found["miou"], np.nanmean(list(ious.values())))
            self.assertSame(found["macc"], np.nanmean(list(accuracies.values())))
            self.assertSame(found["pixel_accuracy"], accuracy)
            for name, c in (("road", 0), ("car", 3), ("sky", 7), ("unicorn", 9)):
                self.assertSame(found["per_class"][name]["iou"], float(ious[c]), name)
                self.assertSame(found["per_class"][name]["acc"], float(accuracies[c]), name)

    def test_ids_may_be_in_the_alpha_channel(self):
        gt = np.random.default_rng(1).choice([0, 3, 7], (8, 16))
        colors = np.stack([gt * 9, gt * 5, gt * 2], -1)
        write_png(self.folder / "g.png", gt)
        write_png(self.folder / "p.png", np.concatenate([colors, gt[..., None]], -1))
        classes = self.write("classes.txt", self.CLASSES)
        self.assertEqual(self.eval("semantic", self.folder / "p.png", self.folder / "g.png", "--classes", classes)["miou"], 1)
        # A picture that is transparent here and there, or not at all, holds no ids.
        for alpha in (np.full_like(gt, 255), np.where(gt == 3, 0, 255), np.arange(128).reshape(8, 16)):
            write_png(self.folder / "p.png", np.concatenate([colors, alpha[..., None]], -1))
            self.refuse("semantic", self.folder / "p.png", self.folder / "g.png", "--classes", classes, says=["p.png", "colours"])

    def test_wildpass_brings_each_picture_to_its_size(self):
        gt = np.kron(np.random.default_rng(1).choice([0, 3, 7], (8, 16)), np.ones((4, 4), int))
        write_png(self.folder / "g.png", gt)
        write_png(self.folder / "p.png", np.kron(gt, np.ones((2, 2), int)))
        classes = self.write("classes.txt", self.CLASSES)
        arguments = "semantic", self.folder / "p.png", self.folder / "g.png", "--classes", classes
        self.assertEqual(self.eval(*arguments, "--protocol", "wildpass")["miou"], 1)
        self.refuse(*arguments, says=["128x64", "64x32"])
        self.refuse(*arguments, "--protocol", "wildpass", "--seam", 4, says=["128x64", "64x32"])

    def test_a_class_that_only_the_prediction_has_counts_as_nought(self):
        gt = np.zeros((4, 8), int)
        pred = gt.copy()
        pred[0, :4] = 9
        write_png(self.folder / "p.png", pred)
        write_png(self.folder / "g.png", gt)
        found = self.eval("semantic", self.folder / "p.png", self.folder / "g.png", "--classes", self.write("c.txt", self.CLASSES))
        self.assertSame(found["miou"], (28 / 32 + 0) / 2)
        self.assertSame(found["miou_present"], 28 / 32)

    def test_files_of_classes_may_be_written_in_several_ways(self):
        self.pictures(1)
        runs = []
        for name, content in (("a.txt", self.CLASSES), ("b.txt", "road 0\ncar 3\nsky 7\nunicorn 9\n"), ("c.json", [{"id": i, "name": n} for i, n in ((0, "road"), (3, "car"), (7, "sky"), (9, "unicorn"))]),
                              ("d.json", {"road": 0, "car": 3, "sky": 7, "unicorn": 9})):
            runs.append(self.eval("semantic", self.folder / "pred/0.png", self.folder / "gt/0.png", "--classes", self.write(name, content))["per_class"])
        for run in runs[1:]:
            self.assertEqual(run, runs[0])

    def test_ignored_classes_leave_the_means(self):
        pairs, classes = self.pictures(3), self.write("classes.txt", self.CLASSES)
        found = self.eval("semantic", self.folder / "pred", self.folder / "gt", "--classes", classes, "--ignore", "car")
        # Truths of car are void; other truths that are taken for cars are wrong.
        wanted, _, _ = self.wanted([(np.where(p == 3, 250, p), np.where(g == 3, 250, g)) for p, g in pairs])
        self.assertSame(found["miou"], np.nanmean([iou for c, iou in wanted.items() if c != 3]))
        self.assertSame(found["miou_present"], found["miou"])
        self.assertNotIn("car", found["per_class"])
        self.refuse("semantic", self.folder / "pred", self.folder / "gt", "--classes", classes, "--ignore", "cra", says=["car"])

    def test_views_and_held_out_classes(self):
        pairs, classes = self.pictures(3), self.write("classes.txt", self.CLASSES)
        found = self.eval("semantic", self.folder / "pred", self.folder / "gt", "--classes", classes, "--latitude-bands", 3, "--seam", 6, "--open-world", "sky", "--bootstrap", 50)
        for band in range(3):
            rows = slice(8 * band, 8 * band + 8)
            ious, _, _ = self.wanted([(p[rows], g[rows]) for p, g in pairs])
            self.assertSame(found["latitude_bands"][band]["miou"], np.nanmean(list(ious.values())))
        ious, _, _ = self.wanted([(np.roll(p, 6, 1)[:, :12], np.roll(g, 6, 1)[:, :12]) for p, g in pairs])
        self.assertSame(found["seam"]["near"]["miou"], np.nanmean(list(ious.values())))
        ious, _, _ = self.wanted(pairs)
        self.assertSame(found["open_world"]["miou_held_out"], ious[7])
        self.assertSame(found["open_world"]["miou_known"], (ious[0] + ious[3]) / 2)
        self.assertLessEqual(found["intervals"]["miou"][0], found["miou"])

    def test_mistakes_are_refused(self):
        pairs, classes = self.pictures(1), self.write("classes.txt", self.CLASSES)
        gt = pairs[0][1]
        write_png(self.folder / "mirror.png", gt[:, ::-1])
        self.refuse("semantic", self.folder / "mirror.png", self.folder / "gt/0.png", "--classes", classes, says=["mirrored"])
        write_png(self.folder / "half.png", gt[::2, ::2])
        self.refuse("semantic", self.folder / "half.png", self.folder / "gt/0.png", "--classes", classes, says=["24x12", "48x24"])
        for text, says in (("", "no classes"), ("0 road\n0 car\n", "occurs twice"), ("70000 road\n", "70000")):
            self.refuse("semantic", self.folder / "pred", self.folder / "gt", "--classes", self.write("bad.txt", text), says=[says])
        self.refuse("semantic", self.folder / "pred", self.folder / "gt", "--classes", classes, "--open-world", "skye", says=["sky"])


class LabelMistakes(EvalTest):
    CLASSES = "3 sky\n5 wall\n8 floor\n12 table\n17 chair\n20 lamp\n"

    def room(self):
        gt = np.full((64, 128), 8)
        gt[:25], gt[25:32] = 3, 5
        gt[35:, 15:35], gt[40:, 85:100], gt[30:, 50:55] = 12, 17, 20
        return gt

    def test_numbers_and_turns_are_named_at_the_errors_of_real_predictions(self):
        gt, random, classes = self.room(), np.random.default_rng(4), self.write("classes.txt", self.CLASSES)
        p, g = self.folder / "p.png", self.folder / "g.png"
        write_png(g, gt)
        for share in (0, 0.05, 0.3):
            noisy = np.where(random.random(gt.shape) < share, random.choice([3, 5, 8, 12, 17, 20], gt.shape), gt)
            for wrong, says in ((noisy[:, ::-1], "mirrored"), (np.roll(noisy, 64, 1), "180 degrees"), (np.roll(noisy, 32, 1), "90 degrees"), (noisy[::-1], "upside down"), (noisy + 1, "plus 1"), (noisy - 1, "less 1"),
                                (noisy * 0 + 255, "every predicted pixel is 255"), ((noisy == 8) * 255, "no predicted pixel is of a class"), (noisy * 37 % 101 + 100, "another numbering"), (np.array([3, 5, 8, 12, 17, 20])[np.searchsorted([3, 5, 8, 12, 17, 20], noisy) - 3], "as 12")):
                write_png(p, wrong)
                # What no net predicts is refused; for some classes to be taken for others is bad.
                self.name("semantic", p, g, "--classes", classes, says=says, refused=(share < 0.1 and says != "as 12") or says in ("plus 1", "less 1", "another numbering") or "predicted pixel" in says)
        ids = np.array([3, 5, 8, 12, 17, 20])
        for honest in (np.roll(ids, -1)[np.searchsorted(ids, gt)], gt * 0 + 20):
            write_png(p, honest)
            self.assertIn("warnings", self.eval("semantic", p, g, "--classes", classes))
        for honest in (gt, np.where(random.random(gt.shape) < 0.7, random.choice([3, 5, 8, 12, 17, 20], gt.shape), gt), np.kron(gt[4::8, 4::8], np.ones((8, 8), int))):
            write_png(p, honest)
            self.assertNotIn("warnings", self.eval("semantic", p, g, "--classes", classes))

    def test_categories_of_segments_are_judged_too(self):
        gt = self.room()
        categories = [{"id": i, "name": n, "isthing": 0} for i, n in ((3, "sky"), (4, "roof"), (5, "wall"), (6, "door"), (8, "floor"), (9, "rug"), (12, "table"), (13, "bed"), (17, "chair"), (18, "seat"), (20, "lamp"), (21, "light"))]
        for name in ("gt", "pred"):
            (self.folder / name).mkdir()
            write_ids(self.folder / f"{name}/0.png", gt)
            segments = [{"id": i, "category_id": i + (name == "pred"), "area": 1} for i in (3, 5, 8, 12, 17, 20)]
            self.write(f"{name}.json", {"images": [{"id": 0}], "annotations": [{"image_id": 0, "file_name": "0.png", "segments_info": segments}], "categories": categories})
        self.name("panoptic", self.folder / "pred.json", self.folder / "gt.json", says="plus 1", refused=False)
        write_ids(self.folder / "pred/0.png", gt[:, ::-1])
        self.write("pred.json", (self.folder / "gt.json").read_text())
        self.name("panoptic", self.folder / "pred.json", self.folder / "gt.json", says="mirrored", refused=True)
        write_ids(self.folder / "pred/0.png", gt << 16)
        self.refuse("panoptic", self.folder / "pred.json", self.folder / "gt.json", says=["red and blue exchanged"])


class Panoptic(EvalTest):
    CATEGORIES = [{"id": 4, "name": "person", "isthing": 1}, {"id": 2, "name": "car", "isthing": 1}, {"id": 9, "name": "sky", "isthing": 0}]

    def scene(self, seed, count=3, crowds=True, height=20):
        """Files of random blocks; [(prediction ids, categories, truth ids, categories and crowds)]."""
        random = np.random.default_rng(seed)
        pairs, truths, predictions = [], [], []
        for name in ("gt", "pred"):
            (self.folder / name).mkdir(exist_ok=True)
        for i in range(count):
            gt = np.kron(random.integers(0, 6, (height // 4, height // 2)), np.ones((4, 4), int)) * 260
            noise = random.random(gt.shape) < 0.2
            pred = np.where(noise, np.roll(gt, 4, 1), gt)
            pred = np.where(pred > 0, pred + 7, 0)
            category = lambda ids: {int(s): int(random.choice([4, 2, 9])) for s in np.unique(ids) if s}
            gt_info = {s: (c, bool(crowds and random.random() < 0.2)) for s, c in category(gt).items()}
            pred_info = {s: gt_info[s - 7][0] if s - 7 in gt_info and random.random() < 0.8 else c for s, c in category(pred).items()}
            write_ids(self.folder / f"gt/{i}.png", gt)
            write_ids(self.folder / f"pred/{i}.png", pred)
            truths.append({"image_id": i, "file_name": f"{i}.png", "segments_info": [{"id": s, "category_id": c, "iscrowd": int(k), "area": int((gt == s).sum()), "bbox": [0, 0, 1, 1]} for s, (c, k) in gt_info.items()]})
            predictions.append({"image_id": i, "file_name": f"{i}.png", "segments_info": [{"id": s, "category_id": c} for s, c in pred_info.items()]})
            pairs.append((pred, pred_info, gt, gt_info))
        images = [{"id": i, "file_name": f"{i}.png", "width": 2 * height, "height": height} for i in range(count)]
        self.write("gt.json", {"images": images, "annotations": truths, "categories": self.CATEGORIES})
        self.write("pred.json", {"annotations": predictions})
        return pairs

    def test_quality_equals_the_definition(self):
        for seed in range(6):
            pairs = self.scene(seed)
            found = self.eval("panoptic", self.folder / "pred.json", self.folder / "gt.json", "--force")
            counts = panoptic_quality(pairs, [4, 2, 9])
            for group, chosen in (("all", [4, 2, 9]), ("things", [4, 2]), ("stuff", [9])):
                for key, value in zip(("pq", "sq", "rq"), mean_quality(counts, chosen)):
                    self.assertSame(found[group][key], value, f"{seed} {group} {key}")
            for c in (4, 2, 9):
                one = found["per_class"][str(c)]
                self.assertEqual([one["tp"], one["fp"], one["fn"]], counts[c][1:])

    def test_weights_bands_and_rolls(self):
        pairs = self.scene(11, crowds=False)
        found = self.eval("panoptic", self.folder / "pred.json", self.folder / "gt.json", "--weights", "solid_angle", "--latitude-bands", 2, "--force")
        # Rows repeated by their weight, to whole numbers, are the same picture by pixels.
        repeats = np.round(row_areas(20, 40) / row_areas(20, 40)[0] * 50).astype(int)
        stretched = [(np.repeat(p, repeats, 0), pi, np.repeat(g, repeats, 0), gi) for p, pi, g, gi in pairs]
        self.assertAlmostEqual(found["all"]["pq"], mean_quality(panoptic_quality(stretched, [4, 2, 9]), [4, 2, 9])[0], delta=0.01)
        present = lambda ids, info: {s: c for s, c in info.items() if (ids == s).any()}
        half = [(p[:10], present(p[:10], pi), g[:10], present(g[:10], gi)) for p, pi, g, gi in pairs]
        by_pixel = self.eval("panoptic", self.folder / "pred.json", self.folder / "gt.json", "--latitude-bands", 2, "--force")
        self.assertSame(by_pixel["latitude_bands"][0]["all"]["pq"], mean_quality(panoptic_quality(half, [4, 2, 9]), [4, 2, 9])[0])

    def test_ids_of_pixels_and_lists_must_agree(self):
        pairs = self.scene(3)
        write_ids(self.folder / "pred/1.png", np.where(pairs[1][0] == 0, 12345, pairs[1][0]))
        self.refuse("panoptic", self.folder / "pred.json", self.folder / "gt.json", says=["12345", "1.png"])
        self.scene(3)
        write_ids(self.folder / "pred/2.png", np.zeros((20, 40), int))
        self.refuse("panoptic", self.folder / "pred.json", self.folder / "gt.json", says=["no pixel has this id"])
        self.write("pred.json", {"annotations": []})
        self.refuse("panoptic", self.folder / "pred.json", self.folder / "gt.json", says=["3 of 3", "numbered otherwise"])
        for text, says in (("[", "pred.json:1:2"), ('{"annotations": [{"image_id": 0, "file_name": "../x.png", "segments_info": []}]}', "leads out"),
                           ('{"annotations": 5}', "annotations"), ("[" * 200 + "]" * 200, "nested"), ('{"annotations": [{"image_id": 1e300}]}', "annotations[0].image_id")):
            self.write("pred.json", text)
            self.refuse("panoptic", self.folder / "pred.json", self.folder / "gt.json", says=[says])


    def test_videos_of_vipseg_are_read_as_they_are(self):
        self.scene(5)
        flat = self.eval("panoptic", self.folder / "pred.json", self.folder / "gt.json", "--force")
        for name in ("gt", "pred"):
            file = json.loads((self.folder / f"{name}.json").read_text())
            frames = [{**one, "image_id": f"{one['image_id']:06}"} for one in file["annotations"]]
            # Ids of pictures begin anew in each video.
            nested = {"videos": [], "annotations": [{"video_id": v, "annotations": frames} for v in ("a", "b")], "categories": self.CATEGORIES}
            self.write(f"vps_{name}/panoptic_gt.json", nested)
            for v in ("a", "b"):
                shutil.copytree(self.folder / name, self.folder / f"vps_{name}/panomasksRGB/{v}")
        found = self.eval("panoptic", self.folder / "vps_pred", self.folder / "vps_gt", "--force")
        self.assertSame(found["all"]["pq"], flat["all"]["pq"])
        self.assertEqual(found["pictures"], 2 * flat["pictures"])
        video = self.eval("video", self.folder / "vps_gt", self.folder / "vps_gt/panoptic_gt.json", "--windows", "1")
        self.assertEqual([one["sequence"] for one in video["per_sequence"]], ["a", "b"])
        self.assertEqual(video["stq"], 1)

    def test_categories_of_the_prediction_are_those_of_the_truth(self):
        self.scene(6)
        file = json.loads((self.folder / "pred.json").read_text())
        arguments = "panoptic", self.folder / "pred.json", self.folder / "gt.json", "--force"
        plain = self.eval(*arguments)
        self.assertNotIn("categories", str(plain.get("warnings", "")))
        self.write("pred.json", {**file, "categories": [{**c, "name": c["name"].upper()} for c in self.CATEGORIES]})
        found = self.eval(*arguments)
        self.assertIn("'PERSON'", str(found["warnings"]))
        self.assertEqual(found["all"], plain["all"])
        self.write("pred.json", {**file, "categories": [{"id": 2, "name": "person"}, {"id": 4, "name": "car"}]})
        self.refuse(*arguments, says=["'person' is 2 here and 4 in the truth"])


class Video(EvalTest):
    def step(self, folder, classes, instances, order=(0, 1, 2)):
        (self.folder / folder / "s").mkdir(parents=True)
        for f, (c, i) in enumerate(zip(classes, instances)):
            write_png(self.folder / folder / f"s/{f:06}.png", np.stack([c, i // 256, i % 256], -1)[..., list(order)])
        return self.folder / folder

    def test_what_is_no_picture_of_step_is_refused(self):
        random = np.random.default_rng(2)
        classes = [np.kron(random.integers(0, 19, (4, 8)), np.ones((4, 4), int)) for _ in range(3)]
        instances = [np.where(np.isin(c, (11, 13)), 3, 0) for c in classes]
        gt = self.step("gt", classes, instances)
        wrong = [np.where(random.random(c.shape) < 0.6, random.integers(0, 19, c.shape), c) for c in classes]
        poor = self.step("poor", wrong, [np.where(np.isin(c, (11, 13)), 3, 0) for c in wrong])
        found = self.eval("video", poor, gt)
        self.assertGreater(found["stq"], 0)
        self.assertIn("shorter than the longest window of 4", str(found["notes"]))
        self.assertNotIn("shorter", str(self.eval("video", poor, gt, "--windows", "1,3")["notes"]))
        reversed_ = self.step("bgr", wrong, instances, (2, 1, 0))
        self.name("video", reversed_, gt, says="blue says", refused=False)
        self.refuse("video", reversed_, reversed_, says=["000000.png", "other way round", "--force"])
        self.name("video", self.step("swapped", classes, instances, (2, 1, 0)), gt, says="000000.png: blue says", refused=True)
        for f, c in enumerate(classes):
            write_png(self.folder / f"bgr/s/{f:06}.png", c)
        self.refuse("video", reversed_, gt, says=["8-bit RGB"])
        self.refuse("video", gt, gt, "--things", "11,99", says=["--things", "99"])
        self.refuse("video", gt, gt, "--void", "-1", says=["--void"])

    def test_tracking_quality_equals_the_definition(self):
        for seed in range(4):
            random = np.random.default_rng(seed)
            things, classes = [1, 3], 5
            association, tubes = 0.0, 0
            confusion = np.zeros((classes + 1, classes + 1))
            for s in range(2):
                frames = []
                for d in ("gt", "pred"):
                    (self.folder / f"{seed}/{d}/s{s}").mkdir(parents=True)
                for f in range(4):
                    gt, gi = (np.kron(random.integers(0, n, (3, 4)), np.ones((4, 5), int)) for n in (classes, 4))
                    swap = random.random(gt.shape) < 0.3
                    pred, pi = np.where(swap, random.integers(0, classes, gt.shape), gt), np.where(swap, random.integers(0, 3, gt.shape), gi)
                    gt = np.where(random.random(gt.shape) < 0.1, 255, gt)
                    pred = np.where(random.random(gt.shape) < 0.02, 255, pred)
                    for d, c, i in (("gt", gt, gi), ("pred", pred, pi)):
                        write_png(self.folder / f"{seed}/{d}/s{s}/{f:06}.png", np.stack([c, i // 256, i % 256], -1))
                    frames.append((gt, np.where(np.isin(gt, things), gi, 0), pred, np.where(np.isin(pred, things), pi, 0)))
                gt, gi, pred, pi = (np.stack(x) for x in zip(*frames))
                crowd = np.isin(gt, things) & (gi == 0)
                true_tubes = {(c, i): (gt == c) & (gi == i) for c in things for i in range(1, 4) if ((gt == c) & (gi == i)).any()}
                pred_tubes = [(pred == c) & (pi == i) & ~crowd for c in things for i in range(4)]
                for mask in true_tubes.values():
                    tubes += 1
                    association += sum((mask & p).sum() * ((mask & p).sum() / (mask | p).sum()) for p in pred_tubes if (mask & p).any()) / mask.sum()
                for g, p in zip(np.minimum(gt, classes).ravel(), np.minimum(pred, classes).ravel()):
                    if g < classes:
                        confusion[g, p] += 1
            union = confusion.sum(0) + confusion.sum(1) - np.diag(confusion)
            sq, aq = np.mean(np.diag(confusion)[union > 0] / union[union > 0]), association / tubes
            found = self.eval("video", self.folder / f"{seed}/pred", self.folder / f"{seed}/gt", "--classes", classes, "--things", "1,3")
            for key, value in (("aq", aq), ("sq", sq), ("stq", np.sqrt(aq * sq))):
                self.assertSame(found[key], value, f"{seed} {key}")
            self.assertEqual((found["tubes"], found["frames"]), (tubes, 8))

    def test_windows_of_one_frame_are_panoptic_quality_and_longer_ones_need_steady_ids(self):
        categories = [{"id": 1, "name": "car", "isthing": 1}, {"id": 2, "name": "sky", "isthing": 0}]
        (self.folder / "gt").mkdir()
        (self.folder / "pred").mkdir()
        truths, predictions = [], []
        for f in range(4):
            ids = np.full((8, 16), 2)
            ids[4:, f : f + 4] = 1
            write_ids(self.folder / f"gt/{f}.png", ids)
            car = 1 if f < 2 else 5  # the track is lost after two frames
            write_ids(self.folder / f"pred/{f}.png", np.where(ids == 1, car, ids))
            info = lambda own: [{"id": own, "category_id": 1}, {"id": 2, "category_id": 2}]
            truths.append({"image_id": f, "file_name": f"{f}.png", "segments_info": info(1)})
            predictions.append({"image_id": f, "file_name": f"{f}.png", "segments_info": info(car)})
        self.write("gt.json", {"images": [{"id": f} for f in range(4)], "annotations": truths, "categories": categories})
        self.write("pred.json", {"annotations": predictions})
        self.refuse("video", self.folder / "pred.json", self.folder / "gt.json", "--things", "1", says=["--things"])
        found = self.eval("video", self.folder / "pred.json", self.folder / "gt.json", "--windows", "1,2,4")
        self.assertEqual(found["windows"]["1"]["all"]["pq"], 1)
        # Windows of two: the middle one has the car as two halves, neither above one half: one miss, two false.
        self.assertSame(found["windows"]["2"]["things"]["pq"], 2 / (2 + 0.5 * 2 + 0.5))
        self.assertEqual(found["windows"]["4"]["things"]["pq"], 0)
        self.assertSame(found["vpq"], np.mean([1, (1 + 2 / 3.5) / 2, 0.5]))
        # AQ of the car: two tracks that each hold half of it.
        self.assertSame(found["aq"], (32 * 0.5 * 2) / 64)
        self.assertEqual(found["sq"], 1)


if __name__ == "__main__":
    unittest.main()
