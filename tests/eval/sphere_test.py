"""Places, rolls and turns of entities, keypoints, boxes, flow and video: cropped pictures, shifted and rotated copies give the same figures."""
import unittest

import numpy as np

from references import EvalTest, compressed, write_png

HEIGHT, WIDTH = 64, 128


def rays(x, y):
    """Directions (+X right, +Y down, +Z ahead) of places in the picture."""
    theta, phi = 2 * np.pi * (x / WIDTH - 0.5), np.pi * (0.5 - y / HEIGHT)
    return np.stack([np.cos(phi) * np.sin(theta), -np.sin(phi), np.cos(phi) * np.cos(theta)], -1)


def places(d):
    return (np.arctan2(d[..., 0], d[..., 2]) / (2 * np.pi) + 0.5) * WIDTH, (0.5 + np.arcsin(np.clip(d[..., 1], -1, 1)) / np.pi) * HEIGHT


def turned(yaw, pitch, roll):
    """What the turned camera's axes are in the first one: yaw to the right, pitch upwards, roll clockwise."""
    y, p, r = np.radians([yaw, pitch, roll])
    about_y = np.array([[np.cos(y), 0, np.sin(y)], [0, 1, 0], [-np.sin(y), 0, np.cos(y)]])
    about_x = np.array([[1, 0, 0], [0, np.cos(p), -np.sin(p)], [0, np.sin(p), np.cos(p)]])
    about_z = np.array([[np.cos(r), -np.sin(r), 0], [np.sin(r), np.cos(r), 0], [0, 0, 1]])
    return about_y @ about_x @ about_z


class Coco(EvalTest):
    def files(self, key, truths, **predictions):
        """gt.json of one panorama, and a file of results by name; objects are dicts."""
        self.write("gt.json", {"images": [{"id": 1, "width": WIDTH, "height": HEIGHT, "file_name": "a.png"}], "categories": [{"id": 1, "name": "a"}],
                               "annotations": [{"id": i + 1, "image_id": 1, "category_id": 1, key: t[key], **t} for i, t in enumerate(truths)]})
        for name, objects in predictions.items():
            self.write(f"{name}.json", [{"image_id": 1, "category_id": 1, "score": 1 - i / 100, key: o[key]} for i, o in enumerate(objects)])
        return self.folder / "pred.json", self.folder / "gt.json"

    def check_moved(self, found, names):
        for name in names:
            self.assertSame(found["spread"][name], 0.0, name)


class Masks(Coco):
    def masks(self, seed, count=12):
        random = np.random.default_rng(seed)
        columns, rows = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
        result = []
        for _ in range(count):
            x, y, w, h = random.uniform(0, WIDTH), random.uniform(8, HEIGHT - 8), random.uniform(4, 20), random.uniform(4, 12)
            result.append((np.abs((columns - x + WIDTH / 2) % WIDTH - WIDTH / 2) < w) & (np.abs(rows - y) < h))
        return result

    def as_objects(self, masks):
        return [{"segmentation": {"size": list(m.shape), "counts": compressed(m)}, "area": int(m.sum())} for m in masks]

    def test_rolled_masks_are_rolled_back(self):
        truths = self.masks(1)
        predictions = [np.roll(m, (k % 3 - 1, k % 5 - 2), (0, 1)) for k, m in enumerate(truths)]
        for columns in (37, -5, WIDTH + 3):
            rolled = [np.roll(m, columns, 1) for m in predictions]
            pred, gt = self.files("segmentation", self.as_objects(truths), pred=self.as_objects(predictions), rolled=self.as_objects(rolled))
            found = self.eval("entity", pred, gt, "--rolled", f"{columns}={self.folder / 'rolled.json'}")
            self.assertTrue(0.2 < found["ap"] < 0.9, found["ap"])
            self.check_moved(found, ("ap", "ap75", "ar100"))
            other = self.eval("entity", pred, gt, "--rolled", f"{columns + 9}={self.folder / 'rolled.json'}")
            self.assertGreater(other["spread"]["ap50"], 0.1)

    def test_turned_masks_are_turned_back(self):
        truths = self.masks(2)
        # A camera turned to the right by a quarter sees everything a quarter further to the left.
        quarter = [np.roll(m, -WIDTH // 4, 1) for m in truths]
        pred, gt = self.files("segmentation", self.as_objects(truths), pred=self.as_objects(truths), t=self.as_objects(quarter))
        self.check_moved(self.eval("entity", pred, gt, "--turned", f"90,0,0={self.folder / 't.json'}"), ("ap",))
        angles = (130, -40, 75)
        rows, columns = np.mgrid[0:HEIGHT, 0:WIDTH] + 0.5
        x, y = (v.astype(int) for v in places(rays(columns, rows) @ turned(*angles).T))
        seen = [m[np.minimum(y, HEIGHT - 1), x % WIDTH] for m in truths]
        self.files("segmentation", self.as_objects(truths), pred=self.as_objects(truths), t=self.as_objects(seen))
        found = self.eval("entity", pred, gt, "--turned", f"130,-40,75={self.folder / 't.json'}", "--turned", f"-130,40,-75={self.folder / 't.json'}")
        self.assertGreater(found["turned"][0]["ap50"], 0.9)
        self.assertLess(found["turned"][1]["ap50"], 0.4)

    def test_projections_count_what_they_see(self):
        # A band at the equator with a hole: of six faces the equator's pixels are as many, of the panorama's rows near a pole too many.
        rows = np.arange(HEIGHT)[:, None] + np.zeros((1, WIDTH), int)
        truth, prediction = rows < 24, rows < 16
        pred, gt = self.files("segmentation", self.as_objects([truth]), pred=self.as_objects([prediction]))
        plain, area = 16 / 24, lambda bottom: 1 - np.sin(np.pi * (0.5 - bottom / HEIGHT))
        exact = area(16) / area(24)
        steps = np.linspace(0.5, 0.95, 10)
        self.assertSame(self.eval("entity", pred, gt)["ap"], float(np.mean(plain >= steps)))
        self.assertTrue(0.4 < exact < 0.5)
        for projection in ("cube", "tangent"):
            self.assertEqual(self.eval("entity", pred, gt, "--projection", projection, "--force")["ap"], 0, projection)
        self.refuse("entity", pred, gt, "--projection", "cube", "--weights", "solid_angle", says=["exclude"])
        self.write("pred.json", [{"image_id": 1, "category_id": 1, "score": 1, "bbox": [0, 0, 9, 9]}])
        self.files("bbox", [{"bbox": [0, 0, 9, 9]}], pred=[{"bbox": [0, 0, 9, 9]}])
        self.refuse("entity", pred, gt, "--type", "bbox", "--projection", "cube", says=["--projection", "masks"])

    def test_the_worst_pictures_are_named_and_drawn(self):
        truths = self.masks(3, 3)
        images = [{"id": i, "width": WIDTH, "height": HEIGHT, "file_name": f"{i}.png"} for i in (1, 2, 3)]
        objects = self.as_objects(truths)
        self.write("gt.json", {"images": images, "categories": [{"id": 1, "name": "a"}],
                               "annotations": [{"id": i + 1, "image_id": i + 1, "category_id": 1, **o} for i, o in enumerate(objects)]})
        moved = self.as_objects([truths[0], np.roll(truths[1], WIDTH // 2, 1), truths[2]])
        self.write("pred.json", [{"image_id": i + 1, "category_id": 1, "score": 1, "segmentation": o["segmentation"]} for i, o in enumerate(moved)])
        found = self.eval("entity", self.folder / "pred.json", self.folder / "gt.json", "--worst", 2, "--sheet", self.folder / "s.png")
        self.assertEqual([w["picture"] for w in found["worst"]], ["2.png", "1.png"])
        for w, bad in zip(found["worst"], (1.0, 0.0)):
            self.assertSame(w["1-ap"], bad)
        self.assertGreater((self.folder / "s.png").stat().st_size, 500)


class Points(Coco):
    def persons(self, seed, count=10):
        random = np.random.default_rng(seed)
        x, y = random.uniform(0, WIDTH, (count, 1)) + random.uniform(-6, 6, (count, 17)), random.uniform(12, HEIGHT - 12, (count, 1)) + random.uniform(-9, 9, (count, 17))
        return x % WIDTH, y

    def as_objects(self, x, y):
        return [{"keypoints": np.stack([a, b, np.full(17, 2)], 1).ravel().tolist(), "bbox": [0, float(b.min()), 12, 18], "area": 150.0} for a, b in zip(x, y)]

    def test_rolls_and_turns_come_back(self):
        x, y = self.persons(1)
        noise = np.random.default_rng(2).normal(0, 0.8, (2, *x.shape))
        px, py = (x + noise[0]) % WIDTH, y + noise[1]
        d = rays(px, py) @ turned(20, -50, 110)  # in the turned camera's frame
        tx, ty = places(d)
        pred, gt = self.files("keypoints", self.as_objects(x, y), pred=self.as_objects(px, py), r=self.as_objects((px + 31) % WIDTH, py), t=self.as_objects(tx, ty))
        found = self.eval("keypoints", pred, gt, "--wrap", "--rolled", f"31={self.folder / 'r.json'}", "--turned", f"20,-50,110={self.folder / 't.json'}")
        self.assertTrue(0.2 < found["ap"] < 1, found["ap"])
        for one in (found["rolled"][0], found["turned"][0]):
            self.assertSame(one["ap"], found["ap"])
            self.assertSame(one["ar75"], found["ar75"])
        self.refuse("keypoints", pred, gt, "--rolled", f"31={self.folder / 'r.json'}", says=["--wrap"])

    def test_columns_go_round(self):
        x, y = self.persons(3, 1)
        x = np.full_like(x, 0.5)
        pred, gt = self.files("keypoints", self.as_objects(x, y), pred=self.as_objects(x - 1 + WIDTH, y))
        self.assertEqual(self.eval("keypoints", pred, gt, "--force")["ap"], 0)
        plain = self.eval("keypoints", *self.files("keypoints", self.as_objects(x + 9, y), pred=self.as_objects(x + 8, y)))
        self.files("keypoints", self.as_objects(x, y), pred=self.as_objects(x - 1 + WIDTH, y))
        self.assertSame(self.eval("keypoints", pred, gt, "--wrap")["ap"], plain["ap"])
        self.assertGreater(plain["ap"], 0.3)

    def test_places(self):
        # Right in the north, wrong in the south; wrong beside the seam alone.
        x, y = np.repeat([[20.0], [60.0], [100.0], [3.0]], 17, 1), np.array([[12.0], [14.0], [50.0], [52.0]]) + np.linspace(-5, 5, 17)
        wrong = y + [[0], [0], [25], [25]]
        pred, gt = self.files("keypoints", self.as_objects(x, y), pred=self.as_objects(x, wrong))
        found = self.eval("keypoints", pred, gt, "--latitude-bands", 2, "--seam", 6)
        self.assertSame([b["ap"] for b in found["latitude_bands"]][0], 1.0)
        self.assertEqual(found["latitude_bands"][1]["ap"], 0)
        self.assertEqual(found["seam"]["near"]["ap"], 0)
        self.assertGreater(found["seam"]["far"]["ap"], 0.5)


class Boxes(Coco):
    def test_boxes_on_the_circle_of_columns_roll_back(self):
        random = np.random.default_rng(5)
        truths = [[float(random.uniform(0, WIDTH)), float(random.uniform(0, 40)), float(random.uniform(5, 30)), float(random.uniform(5, 20))] for _ in range(9)]
        guess = [[b[0] + random.normal(0, 1), *b[1:]] for b in truths]
        rolled = [[(b[0] + 77) % WIDTH, *b[1:]] for b in guess]
        objects = lambda boxes: [{"bbox": [float(v) for v in b]} for b in boxes]
        pred, gt = self.files("bbox", objects(truths), pred=objects(guess), r=objects(rolled))
        found = self.eval("boxes", pred, gt, "--wrap", "--rolled", f"77={self.folder / 'r.json'}")
        self.check_moved(found, ("ap", "ap75"))
        self.assertTrue(0.2 < found["ap"] < 1)
        self.refuse("boxes", pred, gt, "--rolled", f"77={self.folder / 'r.json'}", says=["--wrap"])
        self.refuse("boxes", pred, gt, "--wrap", "--turned", f"1,2,3={self.folder / 'r.json'}", says=["bfov"])

    def test_boxes_on_the_sphere_turn_back(self):
        # The box of a camera that looks at (lon, lat) and is turned about its axis; another camera's axes times the same axes.
        def axes(lon, lat, turn):
            return turned(lon, lat, -turn)

        random = np.random.default_rng(6)
        truths = [[random.uniform(-180, 180), random.uniform(-80, 80), random.uniform(5, 60), random.uniform(5, 60), random.uniform(-180, 180)] for _ in range(9)]
        guess = [[b[0], b[1] + random.normal(0, 1.5), b[2], b[3], b[4]] for b in truths]
        camera, seen = turned(33, 62, -140), []
        for lon, lat, w, h, turn in guess:
            a = camera.T @ axes(lon, lat, turn)
            lon, lat = np.degrees([np.arctan2(a[0, 2], a[2, 2]), np.arcsin(-a[1, 2])])
            level = axes(lon, lat, 0)
            seen.append([lon, lat, w, h, -np.degrees(np.arctan2(a[:, 0] @ level[:, 1], a[:, 0] @ level[:, 0]))])
        rolled = [[b[0] + 360 * 11 / WIDTH, *b[1:]] for b in guess]
        objects = lambda boxes: [{"bfov": [float(v) for v in b]} for b in boxes]
        pred, gt = self.files("bfov", objects(truths), pred=objects(guess), t=objects(seen), r=objects(rolled))
        found = self.eval("boxes", pred, gt, "--kind", "bfov", "--turned", f"33,62,-140={self.folder / 't.json'}", "--rolled", f"11={self.folder / 'r.json'}",
                          "--turned", f"33,62,140={self.folder / 't.json'}")
        self.assertTrue(0.2 < found["ap"] < 1, found["ap"])
        self.assertSame(found["turned"][0]["ap"], found["ap"])
        self.assertSame(found["rolled"][0]["ap"], found["ap"])
        self.assertLess(found["turned"][1]["ap50"], 0.5)

    def test_places_on_the_sphere(self):
        # The one at the pole and the one behind reach the seam.
        truths = [[0, 89, 20, 20, 0], [175, 0, 20, 20, 0], [0, 0, 20, 20, 0], [90, -50, 20, 20, 45]]
        guess = [[0, 60, 20, 20, 0], [175, 0, 20, 20, 0], [0, 0, 20, 20, 0], [0, -50, 20, 20, 45]]
        objects = lambda boxes: [{"bfov": b} for b in boxes]
        found = self.eval("boxes", *self.files("bfov", objects(truths), pred=objects(guess)), "--kind", "bfov", "--seam", 2, "--latitude-bands", 3)
        self.assertEqual([b["ap"] for b in found["latitude_bands"]][::2], [0, 0])
        self.assertSame(found["latitude_bands"][1]["ap"], 1.0)
        self.assertTrue(0.3 < found["seam"]["near"]["ap"] < 0.7)
        self.refuse("boxes", *self.files("box3d", [{"box3d": [0, 0, 0, 1, 1, 1, 0]}], pred=[{"box3d": [0, 0, 0, 1, 1, 1, 0]}]), "--kind", "box3d", "--seam", 2, says=["in space"])


class Flow(EvalTest):
    def turning(self, R, camera=np.eye(3)):
        """Flow of a camera (its axes in the first one) in a world that turns by R in the first one's frame."""
        rows, columns = np.mgrid[0:HEIGHT, 0:WIDTH] + 0.5
        d = rays(columns, rows)
        x, y = places(d @ (camera.T @ R @ camera).T)
        return np.stack([(x - columns + WIDTH / 2) % WIDTH - WIDTH / 2, y - rows], -1)

    def test_rolls_and_turns_come_back(self):
        truth, prediction = self.turning(turned(5, 4, 3)), turned(5.5, 3, 4)
        np.save(self.folder / "g.npy", truth)
        np.save(self.folder / "p.npy", self.turning(prediction))
        np.save(self.folder / "r.npy", np.roll(self.turning(prediction), 19, axis=1))
        np.save(self.folder / "t.npy", self.turning(prediction, turned(130, -40, 75)))
        p, g, r, t = (self.folder / f"{name}.npy" for name in "pgrt")
        found = self.eval("flow", p, g, "--rolled", f"19={r}", "--turned", f"130,-40,75={t}", "--turned", f"-130,40,-75={t}")
        self.assertEqual(found["rolled"][0]["epe"], found["epe"])
        self.assertLess(abs(found["turned"][0]["angle_error_deg"] - found["angle_error_deg"]), 0.1 * found["angle_error_deg"])
        self.assertGreater(found["turned"][1]["angle_error_deg"], 3 * found["angle_error_deg"])

    def test_the_worst_are_drawn(self):
        for k, scale in enumerate((1.0, 3.0)):
            for name, factor in (("g", 1.0), ("p", scale)):
                (self.folder / name).mkdir(exist_ok=True)
                np.save(self.folder / name / f"{k}.npy", factor * self.turning(turned(5, 4, 3)))
        found = self.eval("flow", self.folder / "p", self.folder / "g", "--sheet", self.folder / "s.jpg")
        self.assertEqual([w["picture"] for w in found["worst"]], ["1", "0"])
        error = 2 * self.turning(turned(5, 4, 3))
        error[..., 0] -= WIDTH * np.round(error[..., 0] / WIDTH)
        self.assertSame(found["worst"][0]["epe"], float(np.hypot(error[..., 0], error[..., 1]).mean()))


class Video(EvalTest):
    """Tracks of STEP's PNGs: parts of the pictures give what pictures of these parts alone give."""

    FLAGS = ("--classes", 5, "--things", "1,3", "--windows", "1,2")

    def write_video(self, name, frames):
        (self.folder / name / "s").mkdir(parents=True, exist_ok=True)
        for f, (c, i) in enumerate(frames):
            write_png(self.folder / name / f"s/{f:06}.png", np.stack([c, i // 256, i % 256], -1))
        return self.folder / name

    def frames(self, seed, height=16):
        random = np.random.default_rng(seed)
        truth, prediction = [], []
        c, i = (np.kron(random.integers(0, n, (height // 4, height // 2)), np.ones((4, 4), int)) for n in (5, 4))
        for f in range(3):
            swap = random.random(c.shape) < 0.25
            truth.append((np.roll(c, f, 1), np.roll(i, f, 1)))
            prediction.append(tuple(np.roll(np.where(swap, random.integers(0, n, c.shape), v), f, 1) for v, n in ((c, 5), (i, 4))))
        return prediction, truth

    def test_parts_are_pictures_of_their_own(self):
        prediction, truth = self.frames(1)
        p, g = self.write_video("p", prediction), self.write_video("g", truth)
        found = self.eval("video", p, g, *self.FLAGS, "--latitude-bands", 4, "--seam", 5)
        cut = lambda frames, part: [tuple(part(v) for v in frame) for frame in frames]
        parts = [(found["latitude_bands"][b], lambda v, b=b: v[4 * b : 4 * b + 4]) for b in range(4)]
        parts += [(found["seam"]["near"], lambda v: np.hstack([v[:, :5], v[:, -5:]])), (found["seam"]["far"], lambda v: v[:, 5:-5])]
        for k, (got, part) in enumerate(parts):
            alone = self.eval("video", self.write_video(f"p{k}", cut(prediction, part)), self.write_video(f"g{k}", cut(truth, part)), *self.FLAGS, "--force")
            for key in ("stq", "aq", "sq", "vpq", "vpq_things"):
                self.assertSame(got[key], alone[key], f"{k} {key}")

    def test_rolled_videos_and_held_out_classes(self):
        prediction, truth = self.frames(2)
        rolled = [tuple(np.roll(v, 13, 1) for v in frame) for frame in prediction]
        p, g, r = self.write_video("p", prediction), self.write_video("g", truth), self.write_video("r", rolled)
        found = self.eval("video", p, g, *self.FLAGS, "--rolled", f"13={r}", "--open-world", "2,3", "--sheet", self.folder / "s.png")
        self.assertEqual(set(found["spread"].values()), {0})
        self.assertTrue(0 < found["stq"] < 1)
        self.assertEqual(len(found["worst"]), 3)
        # Means over categories: all is that of the known and the unknown, weighed by their numbers.
        self.assertSame(5 * found["vpq"], 3 * found["open_world"]["known"]["vpq"] + 2 * found["open_world"]["unknown"]["vpq"])
        self.refuse("video", p, g, *self.FLAGS, "--open-world", "9", says=["--open-world"])

    def test_projections_of_a_picture_of_rows(self):
        # Classes by row alone: the cube sees the rows near the poles as often as their solid angle is.
        rows = np.arange(16)[:, None] + np.zeros((1, 32), int)
        c, i = np.where(rows < 4, 0, 2), 0 * rows
        p, g = self.write_video("p", [(np.where(rows < 2, 0, 2), i)] * 2), self.write_video("g", [(c, i)] * 2)
        plain, cube = (self.eval("video", p, g, *self.FLAGS, "--projection", way)["sq"] for way in ("erp", "cube"))
        self.assertSame(plain, (2 / 4 + 12 / 14) / 2)
        share = lambda bottom: (1 - np.sin(np.pi * (0.5 - bottom / 16))) / 2
        self.assertLess(abs(cube - (share(2) / share(4) + (1 - share(4)) / (1 - share(2))) / 2), 0.05)


if __name__ == "__main__":
    unittest.main()
