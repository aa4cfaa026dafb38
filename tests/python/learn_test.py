"""airsim360.learn: geometry against closed forms, training that repeats and goes on after an interruption byte for byte, files, bad
input. Skips without python3-torch or python3-opencv; no world is opened."""
import hashlib
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import cv2
    import numpy as np
    import torch
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(0)

torch.set_num_threads(1)
from airsim360.learn import attitude, classes, frames, labels, segment, sphere, training  # noqa: E402
from airsim360.learn.augment import KINDS, augment, resurface  # noqa: E402
from airsim360.learn.nets import PictureNet, SphereNet  # noqa: E402

CPU = torch.device("cpu")


def learn(*arguments):
    return subprocess.run([sys.executable, "-m", "airsim360.learn", *map(str, arguments)], capture_output=True, text=True, timeout=200, check=False)


class Geometry(unittest.TestCase):
    def test_pixels_of_a_crop_see_along_their_rays(self):
        rays = sphere.directions(256)
        random = np.random.default_rng(1)
        for _ in range(5):
            R = sphere.rotation(*random.uniform(-1.2, 1.2, 3))
            crop = sphere.crop_rays(40, 30, math.radians(80)) @ R.T
            seen = sphere.sample(rays, crop)
            error = np.linalg.norm(seen / np.linalg.norm(seen, axis=-1, keepdims=True) - crop / np.linalg.norm(crop, axis=-1, keepdims=True), axis=-1)
            self.assertLess(error.max(), 5e-3)  # a pixel is 0.012 rad
            self.assertLess(np.median(error), 2e-4)

    def test_yaw_turns_right_pitch_up_and_roll_clockwise(self):
        ahead = np.array([0, 0, 1.0])
        self.assertGreater((sphere.rotation(0.1, 0, 0) @ ahead)[0], 0)
        self.assertLess((sphere.rotation(0, 0.1, 0) @ ahead)[1], 0)
        self.assertGreater((sphere.rotation(0, 0, 0.1) @ np.array([1.0, 0, 0]))[1], 0)

    def test_solid_angles_sum_to_the_sphere(self):
        self.assertAlmostEqual(float(sphere.solid_angles(64).astype(float).sum() * 128), 4 * math.pi, 5)

    def test_tangent_patches_leave_no_pixel_out(self):
        rays, covered = sphere.directions(64), np.zeros((64, 128), bool)
        for R in sphere.tangent_patches():
            local = rays @ R.astype(np.float32)
            tan = math.tan(math.radians(37.5))
            covered |= (local[..., 2] > 0) & (np.abs(local[..., 0]) < tan * local[..., 2]) & (np.abs(local[..., 1]) < tan * local[..., 2])
        self.assertTrue(covered.all())

    def test_convolution_on_the_sphere_turns_with_the_columns(self):
        torch.manual_seed(0)
        conv, x = sphere.SphereConv(2, 3, 16), torch.rand(1, 2, 16, 32)
        with torch.no_grad():
            self.assertLess((conv(x.roll(5, -1)) - conv(x).roll(5, -1)).abs().max(), 1e-5)
            self.assertEqual(tuple(sphere.SphereConv(2, 3, 16, 2)(x).shape), (1, 3, 8, 16))

    def test_its_taps_are_on_the_tangent_plane(self):
        # A linear function a . d of the direction, sampled a step to the right, differs by what the tangent plane says, at every latitude.
        height = 64
        rays = sphere.directions(height)
        conv, a = sphere.SphereConv(1, 1, height), np.array([0.3, -0.5, 0.8])
        field = torch.from_numpy((rays @ a.astype(np.float32)))[None, None]
        with torch.no_grad():
            for tap, offset in (((1, 2), (1, 0)), ((1, 0), (-1, 0)), ((0, 1), (0, 1)), ((2, 1), (0, -1))):
                conv.conv.weight.zero_()
                conv.conv.weight[0, 0, tap[0], tap[1]] = 1
                found = conv(field)[0, 0].numpy()
                phi, theta = np.arcsin(-rays[..., 1]), np.arctan2(rays[..., 0], rays[..., 2])
                east = np.stack([np.cos(theta), 0 * theta, -np.sin(theta)], -1)
                north = np.stack([-np.sin(phi) * np.sin(theta), -np.cos(phi), -np.sin(phi) * np.cos(theta)], -1)
                step = math.tan(math.pi / height)
                there = rays + step * (offset[0] * east + offset[1] * north)
                there /= np.linalg.norm(there, axis=-1, keepdims=True)
                self.assertLess(np.abs(found - there @ a)[2:-2].max(), 3e-3, tap)

    def test_up_is_found_exactly_where_the_network_is_right(self):
        random, fit = np.random.default_rng(2), attitude._Fit(16, CPU)
        for _ in range(5):
            up = attitude.random_rotation(random)[:, 1]
            out = torch.zeros(1, 2, 16, 32)
            out[0, 0] = torch.from_numpy(sphere.directions(16) @ up.astype(np.float32))
            out[0, 1] = torch.from_numpy(random.normal(0, 2, (16, 32)).astype(np.float32))
            self.assertLess(np.abs(fit(out)[0][0].numpy() - up).max(), 1e-3)
            R = attitude.upright(up, 0.7)
            self.assertLess(np.abs(R @ R.T - np.eye(3)).max(), 1e-9)
            self.assertAlmostEqual(float(np.linalg.det(R)), 1, 9)
            self.assertLess(np.abs(R @ [0, -1, 0] - up).max(), 1e-9)
        angles = attitude.angles_of(sphere.rotation(0.4, math.radians(20), math.radians(10)).T @ [0, -1, 0])
        self.assertAlmostEqual(angles["pitch_deg"], 20, 6)
        self.assertAlmostEqual(angles["roll_deg"], 10, 6)


class Files(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="airsim360_learn_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def frames(self, count=4, height=64):
        """A folder as `learn frames` makes it: a sky over ground, with a car."""
        folder = self.folder / "frames"
        folder.mkdir()
        random = np.random.default_rng(0)
        for i in range(count):
            label = np.full((height, 2 * height), classes.CLASSES.index("road"), np.uint8)
            label[:height // 2] = classes.CLASSES.index("sky")
            label[height // 2 - 4:height // 2 + 6, 20 + 10 * i:40 + 10 * i] = classes.CLASSES.index("car")
            rgb = np.array(classes.PALETTE, np.uint8)[label] // 2 + random.integers(0, 60, (height, 2 * height, 3), np.uint8)
            stem = folder / f"town_{'people' if i % 2 else 'street'}_{i:05d}"
            cv2.imwrite(f"{stem}.jpg", rgb[..., ::-1])
            cv2.imwrite(f"{stem}.png", label)
            cv2.imwrite(f"{stem}.range.png", frames.range_codes(np.full((height, 2 * height), 5.0)))
            pathlib.Path(f"{stem}.json").write_text(json.dumps({"row": stem.name[:-6], "world": "town", "environment": f"sky {i // 2}"}))
        return folder

    def test_ranges_come_back_and_what_is_not_hit_stays_so(self):
        ranges = np.exp(np.random.default_rng(0).uniform(np.log(0.11), np.log(999), 1000))
        self.assertLess(np.abs(frames.range_of(frames.range_codes(ranges)) / ranges - 1).max(), 1e-4)
        self.assertEqual(frames.range_codes(np.array([0.0, 1001, np.inf, np.nan])).tolist(), [0, 0, 0, 0])

    def test_classes_of_categories(self):
        for path, name in {"construction/building/roof": "building", "construction/fountain": "other", "vehicle/van": "car", "vehicle/bicycle": "other",
                           "ground/pavement/modular": "sidewalk", "vegetation/tree/conifer/pine": "vegetation", "human/rider": "person",
                           "water/lake": "other", "ground/crosswalk": "road", "my/own": "other"}.items():
            self.assertEqual(classes.CLASSES[classes.class_of(path)], name, path)
        self.assertEqual(classes.class_of(""), classes.IGNORED)
        self.assertEqual(classes.class_table({1: "sky", 3: {"path": "human/person"}}).tolist(), [classes.IGNORED, 1, classes.IGNORED, 7])

    def test_frames_are_chosen_by_world_sky_and_people(self):
        folder = self.frames()
        self.assertEqual(len(frames.Frames(folder)), 4)
        self.assertEqual(len(frames.Frames(folder, people=False)), 2)
        self.assertEqual(len(frames.Frames(folder, skies=1)), 2)
        self.assertEqual(len(frames.Frames(folder, most=3)), 3)
        with self.assertRaisesRegex(ValueError, "no frames of twon"):
            frames.Frames(folder, worlds=["twon"])

    def test_label_pictures_have_the_palette_and_the_ids(self):
        ids = np.arange(8, dtype=np.uint8).reshape(2, 4)
        labels.write_labels(self.folder / "a.png", ids)
        shown = cv2.imread(str(self.folder / "a.png"), cv2.IMREAD_COLOR)[..., ::-1]
        self.assertTrue((shown == np.array(classes.PALETTE, np.uint8)[ids]).all())
        data = (self.folder / "a.png").read_bytes()
        self.assertEqual((data[24], data[25]), (8, 3))  # bits, kind: palette

    def test_a_batch_is_a_function_of_its_random_stream(self):
        crops = segment.Crops(frames.Frames(self.frames()), 64, frozenset(KINDS))
        a, b, c = (crops.batch(0, np.random.default_rng([1, seed])) for seed in (5, 5, 6))
        self.assertTrue(all(torch.equal(x, y) for x, y in zip(a, b)))
        self.assertFalse(torch.equal(a[0], c[0]))
        self.assertEqual([tuple(x.shape) for x in a], [(12, 3, 64, 64), (12, 64, 64), (12, 64, 64)])

    def test_without_kinds_a_picture_stays_as_it_is(self):
        picture = np.random.default_rng(0).integers(0, 255, (32, 32, 3), np.uint8)
        self.assertTrue((augment(picture, np.random.default_rng(1), frozenset(), np.zeros((32, 32), bool)) == picture).all())
        self.assertFalse((augment(picture, np.random.default_rng(1), frozenset(KINDS), np.zeros((32, 32), bool)) == picture).all())

    def test_other_materials_leave_the_sky_and_follow_the_classes(self):
        label = np.zeros((64, 64), np.uint8)
        for k, name in enumerate(("sky", "building", "road", "vegetation")):
            label[16 * k:16 * k + 16] = classes.CLASSES.index(name)
        label[60:] = classes.IGNORED
        changed, summers = 0, 0
        for seed in range(40):
            found = resurface(np.full((64, 64, 3), 100, np.uint8), np.random.default_rng(seed), label)
            self.assertTrue((found[:16] == 100).all() and (found[60:] == 100).all())
            self.assertTrue((found[16:48] == found[16:48:1, :1]).all())  # one material a class
            changed += bool((found[16:48] != 100).any())
            summers += bool((found[48:60] == found[48, 0]).all())
        self.assertTrue(10 < changed < 30, changed)
        self.assertGreater(summers, 20)

    def test_crowns_are_filled_as_annotators_draw_them(self):
        tree, sky, car = (classes.CLASSES.index(name) for name in ("vegetation", "sky", "car"))
        label = np.full((40, 40), sky, np.uint8)
        label[10:30, 10:30] = tree
        label[15:17, 15:17], label[20:22, 20:22] = sky, car
        filled = segment._filled(label)
        self.assertTrue((filled[15:17, 15:17] == tree).all())
        self.assertTrue((filled[20:22, 20:22] == car).all())
        self.assertEqual((filled == sky).sum(), 40 * 40 - 20 * 20)

    def test_the_model_can_be_used_before_training_ends(self):
        folder = self.frames()
        crops = segment.Crops(frames.Frames(folder), 64, frozenset())

        def batch(step, random):
            if step == 2:
                raise KeyboardInterrupt
            return crops.batch(step, random)

        with self.assertRaises(KeyboardInterrupt):
            training.train(self.folder / "early", {"task": "segment"}, lambda: PictureNet(9), batch, segment._loss, training.Schedule(9, 1e-3, save_seconds=0), seed=0,
                           device=CPU, workers=0, precision="bfloat16")
        shares, _ = segment.Segmenter.load(self.folder / "early", CPU).photograph(np.zeros((48, 64, 3), np.uint8), (64,))
        self.assertLess(np.abs(shares.sum(-1) - 1).max(), 1e-4)
        self.assertTrue(all(v.dtype != torch.bfloat16 for v in training.read_checkpoint(self.folder / "early" / "model.pt")["model"].values()))
        with self.assertRaisesRegex(ValueError, "--precision: 'half'"):
            training.precision_of("half", CPU)

    def test_the_same_seed_gives_the_same_weights_also_after_an_interruption(self):
        folder = self.frames()

        def run(out, stop=None):
            def batch(step, random):
                if step == stop:
                    raise KeyboardInterrupt
                return segment.Crops(frames.Frames(folder), 64, frozenset(["color"])).batch(step, random)

            schedule = training.Schedule(4, 1e-3, save_seconds=0)
            try:
                training.train(self.folder / out, {"task": "segment"}, lambda: PictureNet(9, (8, 8, 8, 8, 8)), batch, segment._loss, schedule, seed=3,
                               device=CPU, workers=0)
            except KeyboardInterrupt:
                return b""
            return hashlib.sha256(b"".join(v.numpy().tobytes() for v in training.read_checkpoint(self.folder / out / "model.pt")["model"].values())).digest()

        once = run("once")
        self.assertEqual(run("again", stop=2), b"")
        self.assertEqual(run("again"), once)
        with self.assertRaisesRegex(ValueError, "holds a run with other options"):
            training.train(self.folder / "once", {"task": "other"}, lambda: PictureNet(9, (8, 8, 8, 8, 8)), None, None, training.Schedule(4, 1e-3), seed=3,
                           device=CPU)

    def test_networks_have_the_shapes_they_say(self):
        with torch.no_grad():
            self.assertEqual(tuple(PictureNet(9)(torch.rand(1, 3, 64, 96)).shape), (1, 9, 64, 96))
            self.assertEqual(tuple(SphereNet(2, 32)(torch.rand(2, 3, 32, 64)).shape), (2, 2, 16, 32))
            self.assertEqual(tuple(SphereNet(2, 32, coarse=True)(torch.rand(2, 3, 32, 64)).shape), (2, 2, 8, 16))

    def test_scores_are_those_of_a_matrix_counted_by_hand(self):
        matrix = np.zeros((8, 8), int)
        matrix[1, 1], matrix[1, 2], matrix[2, 2], matrix[0, 2] = 6, 2, 3, 1
        found = segment.scores(matrix)
        self.assertAlmostEqual(found["iou"]["sky"], 6 / 8)
        self.assertAlmostEqual(found["iou"]["building"], 3 / 6)
        self.assertIsNone(found["iou"]["road"])
        self.assertAlmostEqual(found["miou"], 0.625)
        self.assertAlmostEqual(found["accuracy"], 9 / 12)

    def test_panoramas_are_learnt_from_end_to_end(self):
        folder, out = self.frames(), self.folder
        panorama = folder / "town_street_00000.jpg"
        for task in ("depth", "attitude"):
            done = learn(task, "train", "--out", out / task, "--frames", folder, "--steps", 1, "--size", 32, "--workers", 0, "--threads", 1)
            self.assertEqual(done.returncode, 0, done.stderr)
        done = learn("attitude", "train", "--out", out / "both", "--frames", folder, "--steps", 1, "--size", 32, "--workers", 0, "--threads", 1,
                     "--photographs", panorama, "--share", 1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('"photographs": ["town_street_00000.jpg"]', training.read_checkpoint(out / "both" / "model.pt")["about"])
        done = learn("attitude", "train", "--out", out / "none", "--frames", folder, "--photographs", panorama, "--share", 0)
        self.assertEqual((done.returncode, "--share" in done.stderr), (2, True))
        done = learn("depth", "apply", panorama, "--model", out / "depth", "--out", out / "ranges", "--threads", 1)
        self.assertEqual(done.returncode, 0, done.stderr)
        ranges = np.load(out / "ranges/town_street_00000.npy")
        self.assertEqual(ranges.shape, (64, 128))
        self.assertTrue((ranges > 0).all())
        done = learn("depth", "eval", "--frames", folder, "--model", out / "depth", "--threads", 1, "--json")
        found = json.loads(done.stdout)
        self.assertAlmostEqual(found["rows_absrel"], 0, 6)  # every range is the same here
        self.assertAlmostEqual(found["trained_absrel"], 0, 3)
        for path in folder.glob("*.range.png"):
            cv2.imwrite(str(path), frames.range_codes(np.full((64, 128), 8.0)))
        found = json.loads(learn("depth", "eval", "--frames", folder, "--model", out / "depth", "--threads", 1, "--json").stdout)
        self.assertAlmostEqual(found["rows_absrel"], 0, 6)  # rows of these frames, but trained on frames of 5 m
        self.assertAlmostEqual(found["trained_absrel"], 3 / 8, 3)
        self.assertEqual(found["trained_d1"], 0)
        done = learn("attitude", "apply", panorama, "--model", out / "attitude", "--out", out / "upright", "--threads", 1, "--json")
        self.assertAlmostEqual(np.linalg.norm(json.loads(done.stdout)["town_street_00000.jpg"]["up"]), 1, 4)
        self.assertTrue((out / "upright/town_street_00000.jpg").exists())

    def test_the_commands_train_apply_and_refuse(self):
        folder, photo = self.frames(), self.folder / "photo.jpg"
        cv2.imwrite(str(photo), np.full((90, 120, 3), 128, np.uint8))
        done = learn("segment", "train", "--out", self.folder / "seg", "--frames", folder, "--steps", 1, "--size", 32, "--workers", 0, "--threads", 1, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["steps"], 1)
        done = learn("segment", "apply", photo, "--model", self.folder / "seg", "--out", self.folder / "labels", "--threads", 1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(cv2.imread(str(self.folder / "labels/photo.png")).shape, (90, 120, 3))
        self.assertEqual([c["name"] for c in json.loads((self.folder / "labels/legend.json").read_text())["classes"]], list(classes.CLASSES))
        damaged = self.folder / "model.pt"
        damaged.write_bytes(b"PK\x03\x04 no model")
        for arguments, says in ((("segment", "apply", self.folder / "no.jpg", "--model", self.folder / "seg", "--out", self.folder / "x"), "no such file"),
                                (("segment", "apply", photo, "--model", damaged, "--out", self.folder / "x"), "not a checkpoint"),
                                (("attitude", "apply", photo, "--model", self.folder / "seg"), "a model of segment, not of attitude"),
                                (("segment", "train", "--out", self.folder / "x", "--frames", folder, "--augment", "colour"), "did you mean 'color'"),
                                (("segment", "train", "--out", self.folder / "x", "--frames", folder, "--size", "33"), "--size: 33"),
                                (("depth", "train", "--out", self.folder / "x", "--frames", folder, "--steps", "0"), "--steps: 0"),
                                (("frames", "--out", self.folder / "x", "--draw", "2", "--draw-worlds", "box_rom"), "'box_rom' is no world; did you mean 'box_room'?"),
                                (("segment", "eval", "--frames", self.folder / "none", "--model", self.folder / "seg"), "no folder of frames")):
            done = learn(*arguments)
            self.assertEqual(done.returncode, 2, (arguments, done.stderr))
            self.assertIn(says, done.stderr)
            self.assertFalse((self.folder / "x").exists() and any((self.folder / "x").iterdir()), arguments)


class Import(unittest.TestCase):
    def test_the_package_does_not_need_it(self):
        done = subprocess.run([sys.executable, "-c", "import sys, airsim360; print(sorted(m for m in sys.modules if m in ('torch', 'cv2') or 'learn' in m))"],
                              capture_output=True, text=True, check=True, env={**os.environ})
        self.assertEqual(done.stdout.strip(), "[]")


if __name__ == "__main__":
    unittest.main()
