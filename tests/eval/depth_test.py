"""`eval depth` against numpy: formats, weights, views, protocols; what looks like a mistake is named."""
import hashlib
import unittest

import numpy as np

from references import EvalTest, depth_errors, row_areas, write_png

KEYS = ["absrel", "sqrel", "rmse", "rmselog", "log10", "mae", "d1", "d2", "d3", "silog"]


def scene(seed, height=32, holes=True):
    """Smooth truths with holes, and predictions some ten per cent off."""
    random = np.random.default_rng(seed)
    gt = random.uniform(0.5, 60, (height, 2 * height))
    pred = gt * np.exp(random.normal(0, 0.2, gt.shape))
    if holes:
        gt[random.random(gt.shape) < 0.1] = 0
        gt[0, 0], gt[0, 1], gt[0, 2] = np.nan, np.inf, -3
    return pred, gt


class Depth(EvalTest):
    def folders(self, count, **options):
        pairs = [scene(i, **options) for i in range(count)]
        for name in ("pred", "gt"):
            (self.folder / name).mkdir()
        for i, (pred, gt) in enumerate(pairs):
            np.save(self.folder / f"pred/{i:03}.npy", pred)
            np.save(self.folder / f"gt/{i:03}.npy", gt)
        return pairs, self.folder / "pred", self.folder / "gt"

    def test_one_picture_equals_the_definitions(self):
        pred, gt = scene(1)
        np.save(self.folder / "p.npy", pred)
        np.save(self.folder / "g.npy", gt)
        for weights, w in (("pixel", None), ("solid_angle", row_areas(*gt.shape)[:, None])):
            found, wanted = self.eval("depth", self.folder / "p.npy", self.folder / "g.npy", "--weights", weights), depth_errors(pred, gt, w)
            for key in KEYS:
                self.assertSame(found[key], wanted[key], key)
            self.assertEqual(found["valid"], int(np.sum(np.isfinite(gt) & (gt > 0))))

    def test_folders_give_the_mean_of_pictures(self):
        pairs, p, g = self.folders(5)
        found, wanted = self.eval("depth", p, g), [depth_errors(*pair) for pair in pairs]
        for key in KEYS:
            self.assertSame(found[key], np.mean([w[key] for w in wanted]), key)
        self.assertEqual(found, self.eval("depth", p, g, "--threads", 1))

    def test_formats_hold_the_same_numbers(self):
        pred, gt = scene(2, holes=False)
        pred, gt = np.clip(np.round(pred * 500), 1, 65535), np.round(gt * 500)
        write_png(self.folder / "p.png", pred, 16)
        write_png(self.folder / "g.png", gt, 16)
        wanted = depth_errors(pred / 1000, gt / 1000)
        found = self.eval("depth", self.folder / "p.png", self.folder / "g.png")
        for key in KEYS:
            self.assertSame(found[key], wanted[key], key)
        for kind in ("<f4", ">f8", "<u2"):
            np.save(self.folder / "f.npy", np.asfortranarray(pred.astype(kind)))
            found = self.eval("depth", self.folder / "f.npy", self.folder / "g.png", "--pred-scale", 0.001)
            self.assertSame(found["absrel"], wanted["absrel"], kind)
        try:
            import h5py
        except ImportError:
            self.skipTest("python3-h5py is not installed")
        for packing in ({}, {"compression": "gzip", "shuffle": True}, {"compression": "lzf", "chunks": (8, 16)}):
            with h5py.File(self.folder / "p.h5", "w") as file:
                file.create_dataset("depth", data=(pred / 1000).astype("f8"), **packing)
            found = self.eval("depth", self.folder / "p.h5", self.folder / "g.png")
            self.assertSame(found["rmse"], wanted["rmse"], str(packing))
            whole = (self.folder / "p.h5").read_bytes()
            for cut in (0, 60, len(whole) // 2):
                (self.folder / "cut.h5").write_bytes(whole[:cut])
                self.refuse("depth", self.folder / "cut.h5", self.folder / "g.png", says=["cut.h5"])

    def test_views_divide_the_pixels(self):
        pairs, p, g = self.folders(2, height=24)
        found = self.eval("depth", p, g, "--seam", 5, "--latitude-bands", 4, "--weights", "solid_angle")
        w = np.broadcast_to(row_areas(24, 48)[:, None], (24, 48))
        columns = np.arange(48)
        near = np.broadcast_to((columns < 5) | (columns >= 43), (24, 48))
        for name, mask in (("near", near), ("far", ~near)):
            wanted = np.mean([depth_errors(pred[mask], gt[mask], w[mask])["absrel"] for pred, gt in pairs])
            self.assertSame(found["seam"][name]["absrel"], wanted, name)
        for band in range(4):
            rows = slice(6 * band, 6 * band + 6)
            wanted = np.mean([depth_errors(pred[rows], gt[rows], w[rows])["rmse"] for pred, gt in pairs])
            self.assertSame(found["latitude_bands"][band]["rmse"], wanted, str(band))
            self.assertEqual(found["latitude_bands"][band]["latitude_deg"], [90 - 45 * band, 45 - 45 * band])
        self.assertEqual(found["valid"], sum(b["valid"] for b in found["latitude_bands"]))

    def test_projections_weigh_directions_about_alike(self):
        # An error that grows towards the poles: per pixel it counts far too much, per solid angle and in views without poles less.
        height = 64
        latitude = np.abs(np.linspace(-1, 1, height))[:, None] * np.ones((1, 2 * height))
        gt = np.full_like(latitude, 10.0)
        np.save(self.folder / "p.npy", gt * (1 + 0.2 * latitude))
        np.save(self.folder / "g.npy", gt)
        run = lambda *more: self.eval("depth", self.folder / "p.npy", self.folder / "g.npy", *more)["absrel"]
        pixel, sphere, cube, tangent = run(), run("--weights", "solid_angle"), run("--projection", "cube"), run("--projection", "tangent")
        self.assertGreater(pixel, 1.2 * sphere)
        # Cube faces have most pixels a steradian at their corners, at 35 degrees; icosahedron faces are nearly even.
        self.assertLess(abs(tangent / sphere - 1), 0.06)
        self.assertLess(abs(cube / sphere - 1), 0.12)

    def test_rolled_predictions_are_rolled_back(self):
        pairs, p, g = self.folders(2)
        (self.folder / "rolled").mkdir()
        for i, (pred, _) in enumerate(pairs):
            np.save(self.folder / f"rolled/{i:03}.npy", np.roll(pred, 7, axis=1))
        found = self.eval("depth", p, g, "--rolled", f"7={self.folder / 'rolled'}")
        self.assertEqual(found["rolled"][0]["absrel"], found["absrel"])
        self.assertEqual(found["spread"]["rmse"], 0)

    def test_turned_predictions_are_turned_back(self):
        # A prediction that is a function of the direction, as cameras see it that are turned by yaw, pitch and roll.
        height = 64
        theta, phi = np.meshgrid(2 * np.pi * ((np.arange(2 * height) + 0.5) / (2 * height) - 0.5), np.pi * (0.5 - (np.arange(height) + 0.5) / height))
        rays = np.stack([np.cos(phi) * np.sin(theta), -np.sin(phi), np.cos(phi) * np.cos(theta)], -1)
        y, p, r = np.radians([130, -40, 75])
        about_y = np.array([[np.cos(y), 0, np.sin(y)], [0, 1, 0], [-np.sin(y), 0, np.cos(y)]])
        about_x = np.array([[1, 0, 0], [0, np.cos(p), -np.sin(p)], [0, np.sin(p), np.cos(p)]])
        about_z = np.array([[np.cos(r), -np.sin(r), 0], [np.sin(r), np.cos(r), 0], [0, 0, 1]])
        seen = lambda directions: 5 + directions @ [0.5, -1.5, 2]
        for name, picture in (("g", np.full(theta.shape, 5.0)), ("p", seen(rays)), ("t", seen(rays @ (about_y @ about_x @ about_z).T))):
            np.save(self.folder / f"{name}.npy", picture)
        p, g, t = (self.folder / f"{name}.npy" for name in "pgt")
        found = self.eval("depth", p, g, "--bootstrap", "0", "--turned", f"130,-40,75={t}", "--turned", f"-130,40,-75={t}", "--min-depth", "1")
        self.assertEqual(found["turned"][0]["yaw_pitch_roll_deg"], [130, -40, 75])
        self.assertLess(abs(found["turned"][0]["mae"] - found["mae"]), 2e-3)
        self.assertGreater(abs(found["turned"][1]["mae"] - found["mae"]), 2e-2)
        self.assertAlmostEqual(found["spread"]["mae"], max(abs(a["mae"] - b["mae"]) for a in (found, *found["turned"]) for b in found["turned"]), 12)

    def test_protocols_say_and_do_what_differs(self):
        pred, gt = scene(3, holes=False)
        gt[3:9] *= 40
        pred[3:9] *= 40
        np.save(self.folder / "p.npy", pred)
        np.save(self.folder / "g.npy", gt)
        deep = self.eval("depth", self.folder / "p.npy", self.folder / "g.npy", "--protocol", "deep360")
        mask = gt <= 1000
        self.assertSame(deep["absrel"], depth_errors(pred, gt, high=1000)["absrel"])
        self.assertSame(deep["sqrel"], np.mean((pred[mask] - gt[mask]) ** 2 / gt[mask] ** 2))
        self.assertTrue(any("square of the truth" in note for note in deep["notes"]))
        pano = self.eval("depth", self.folder / "p.npy", self.folder / "g.npy", "--protocol", "pano3d")
        cosine = np.cos(np.pi * (0.5 - (np.arange(32) + 0.5) / 32))[:, None]
        self.assertSame(pano["rmse"], depth_errors(pred, gt, cosine)["rmse"])
        uni = self.eval("depth", self.folder / "p.npy", self.folder / "g.npy", "--protocol", "unik3d")
        lower = lambda values: np.sort(values.ravel())[(values.size - 1) // 2]
        self.assertSame(uni["absrel_si"], depth_errors(pred * lower(gt) / lower(pred), gt)["absrel"])

    def test_intervals_hold_the_figure_and_depend_on_the_seed_alone(self):
        _, p, g = self.folders(12)
        one, two, other = (self.eval("depth", p, g, "--bootstrap", 300, "--seed", s, "--threads", t) for s, t in ((5, 1), (5, 2), (6, 2)))
        self.assertEqual(one, two)
        self.assertNotEqual(one["intervals"], other["intervals"])
        for key in KEYS:
            low, high = one["intervals"][key]
            self.assertTrue(low <= one[key] <= high, key)

    def test_tables_and_sheets_name_the_worst(self):
        pairs, p, g = self.folders(4)
        np.save(self.folder / "pred/002.npy", pairs[2][0] * 1.9)
        found = self.eval("depth", p, g, "--worst", 2, "--sheet", self.folder / "sheet.png", "--csv", self.folder / "table.csv")
        self.assertEqual(found["worst"][0]["picture"], "002")
        self.assertTrue((self.folder / "sheet.png").read_bytes().startswith(b"\x89PNG"))
        rows = (self.folder / "table.csv").read_text().splitlines()
        self.assertEqual(len(rows), 5)
        self.assertSame(float(rows[3].split(",")[2]), found["worst"][0]["absrel"])

    def test_likely_mistakes_are_named(self):
        height = 32
        rows, columns = np.mgrid[0:height, 0 : 2 * height]
        theta, phi = 2 * np.pi * ((columns + 0.5) / (2 * height) - 0.5), np.pi * (0.5 - (rows + 0.5) / height)
        gt = 6 + 2 * np.sin(theta + 0.4) + np.cos(phi) + np.sin(phi) + 0.3 * np.sin(3 * theta)
        axes = np.stack([np.cos(phi) * np.sin(theta), np.sin(phi), np.cos(phi) * np.cos(theta)])
        np.save(self.folder / "g.npy", gt)
        noise = np.exp(np.random.default_rng(1).normal(0, 0.005, gt.shape))
        for wrong, says in ((100 * gt, "centimetres"), (1000 * gt, "millimetres"), (gt / 100, "centimetres"), (gt * np.abs(axes).max(0), "axis of a cube face"),
                            (gt * np.cos(phi), "horizontal distance"), (gt[:, ::-1], "mirrored"), (np.roll(gt, height, 1), "180 degrees"), (gt[::-1], "upside down")):
            np.save(self.folder / "p.npy", wrong * noise)
            self.refuse("depth", self.folder / "p.npy", self.folder / "g.npy", says=[says, "--force"])
            forced = self.eval("depth", self.folder / "p.npy", self.folder / "g.npy", "--force")
            self.assertSame(forced["absrel"], depth_errors(wrong * noise, gt)["absrel"])
            self.assertIn(says, forced["warnings"][0])
        np.save(self.folder / "p.npy", 2.2 * gt * noise)  # merely bad
        self.eval("depth", self.folder / "p.npy", self.folder / "g.npy")

    def street(self):
        """A floor that is the same all around, sky (0), towers to some sides: most of a mirrored prediction is right."""
        height = 64
        phi = np.pi * (0.5 - (np.arange(height) + 0.5) / height)[:, None] * np.ones((1, 2 * height))
        gt = np.where(phi < 0, 1.6 / (np.sin(np.maximum(-phi, 0)) + 0.02), 0)
        for first, last, row, distance in ((10, 30, 20, 12), (45, 50, 27, 5), (75, 107, 22, 25)):
            part = gt[row:, first:last]
            part[(part == 0) | (part > distance)] = distance
        return gt

    def test_likely_mistakes_are_named_at_the_errors_of_real_predictions(self):
        gt, random, p, g = self.street(), np.random.default_rng(4), self.folder / "p.npy", self.folder / "g.npy"
        np.save(g, gt)
        for sigma in (0.05, 0.15, 0.3):
            noise = np.exp(random.normal(0, sigma, gt.shape))
            for wrong, says in ((gt[:, ::-1], "mirrored"), (np.roll(gt, 64, 1), "180 degrees"), (np.roll(gt, 32, 1), "90 degrees to the right"), (gt[::-1], "upside down"), (gt * 50, "another unit")):
                np.save(p, wrong * noise)
                self.name("depth", p, g, says=says, refused=sigma == 0.05 and says != "another unit" if sigma != 0.15 else None)
            for honest in (gt, 0.2 * gt, 5 * gt, np.kron(gt[2::4, 2::4], np.ones((4, 4)))):
                np.save(p, honest * noise)
                self.assertFalse([w for w in self.eval("depth", p, g).get("warnings", []) if "are not above 0" not in w])
        np.save(p, 10 * gt)  # probable, not sure
        self.assertIn("another unit", self.eval("depth", p, g)["warnings"][0])

    def test_skies_that_are_written_as_far_away_are_said(self):
        gt = self.street()
        np.save(self.folder / "p.npy", np.where(gt > 0, gt, 20))
        np.save(self.folder / "g.npy", np.where(gt > 0, gt, 1000))
        found = self.eval("depth", self.folder / "p.npy", self.folder / "g.npy")
        self.assertIn("of the truths are exactly 1000", found["warnings"][0])
        self.assertNotIn("warnings", self.eval("depth", self.folder / "p.npy", self.folder / "g.npy", "--max-depth", 999))

    def test_pictures_of_a_dataset_of_pinholes_are_no_panoramas(self):
        gt = self.street()
        (self.folder / "pin/range").mkdir(parents=True)
        np.save(self.folder / "pin/range/000000.npy", gt)
        self.write("pin/frames.jsonl", '{"stem": "000000"}\n')
        self.write("pin/meta.json", {"cameras": [{"projection": "pinhole"}]})
        pin = self.folder / "pin"
        self.eval("depth", pin, pin)
        for flags in (["--weights", "solid_angle"], ["--seam", "4"], ["--latitude-bands", "2"], ["--projection", "cube"], ["--rolled", f"3={pin}"], ["--protocol", "pano3d"]):
            self.refuse("depth", pin, pin, *flags, says=["pinhole", "meta.json"])
        self.refuse("depth", pin / "range/000000.npy", pin / "range/000000.npy", "--seam", "4", says=["pinhole"])
        (self.folder / "pin/flow").mkdir()
        np.save(self.folder / "pin/flow/000000.npy", np.ones((*gt.shape, 2)))
        (self.folder / "other").mkdir()
        np.save(self.folder / "other/000000.npy", np.ones((*gt.shape, 2)) + [gt.shape[1], 0])
        found = self.eval("flow", self.folder / "other", pin)
        self.assertEqual([found["epe"], found["angle_error_deg"]], [gt.shape[1], None])
        self.assertEqual(self.eval("flow", self.folder / "other", pin / "flow/.." / "flow")["epe"], gt.shape[1])

    def test_bad_input_is_refused(self):
        pairs, p, g = self.folders(3)
        np.save(self.folder / "small.npy", pairs[0][0][:16, :32])
        self.refuse("depth", self.folder / "small.npy", g / "000.npy", says=["32x16", "64x32"])
        (p / "001.npy").unlink()
        self.refuse("depth", p, g, says=["no prediction for 1 of 3", "'001'"])
        bad = pairs[0][0].copy()
        bad[bad.shape[0] // 2, 3:9] = np.nan
        np.save(self.folder / "nan.npy", bad)
        self.refuse("depth", self.folder / "nan.npy", g / "000.npy", says=["no finite number"])
        np.save(self.folder / "one.npy", np.float64(3))
        self.refuse("depth", self.folder / "one.npy", g / "000.npy", says=["shape () is no picture"])
        for name, content in (("cut.npy", (g / "000.npy").read_bytes()[:900]), ("empty.npy", b""), ("text.npy", b"hello world, this is no array"),
                              ("huge.npy", b"\x93NUMPY\x01\x00\x46\x00{'descr': '<f8', 'fortran_order': False, 'shape': (4000000000, 9), } \n")):
            (self.folder / name).write_bytes(content)
            self.refuse("depth", self.folder / name, g / "000.npy", says=[name])
        self.refuse("depth", g, g, "--weights", "solid", says=["--weights", "solid_angle"])
        self.refuse("depth", g, g, "--seam", 40, says=["--seam"])
        self.refuse("depth", g, g, "--protocol", "unik3", says=["unik3d"])
        self.refuse("depth", g, g, "--weights", "solid_angle", "--projection", "cube", says=["exclude"])

    def test_a_dataset_that_was_changed_is_no_truth(self):
        pairs, p, g = self.folders(3, holes=False)
        dataset = self.folder / "dataset"
        dataset.mkdir()
        g.rename(dataset / "range")
        self.write("dataset/meta.json", {})
        self.write("dataset/frames.jsonl", "")
        files = sorted((dataset / "range").iterdir())
        self.write("dataset/SHA256SUMS", "".join(f"{hashlib.sha256(f.read_bytes()).hexdigest()}  range/{f.name}\n" for f in files))
        whole = self.eval("depth", p, dataset)
        self.assertSame(whole["absrel"], float(np.mean([depth_errors(pred, gt)["absrel"] for pred, gt in pairs])))
        files[2].rename(self.folder / "taken.npy")
        self.refuse("depth", p, dataset, says=["range/002.npy", "is missing", "verify"])
        self.assertIn("1 prediction has no truth", str(self.eval("depth", p, dataset / "range")["notes"]))
        files[2].write_bytes(files[1].read_bytes())
        self.refuse("depth", p, dataset, says=["range/002.npy", "exchanged"])
        self.eval("depth", dataset, p)
        self.refuse("flow", p, dataset, says=["has no 'flow'", "range"])

    def test_a_truth_without_a_pixel_is_said(self):
        pairs, p, g = self.folders(3)
        np.save(g / "001.npy", np.zeros_like(pairs[1][1]))
        found = self.eval("depth", p, g)
        self.assertSame(found["absrel"], float(np.mean([depth_errors(*pairs[i])["absrel"] for i in (0, 2)])))
        self.assertIn("'001'", str(found["warnings"]))

    def test_notes_say_what_was_measured(self):
        pairs, p, g = self.folders(1)
        notes = lambda *flags: str(self.eval("depth", p, g, *flags)["notes"])
        self.assertIn("up to 1000 m count", notes("--protocol", "deep360"))
        self.assertIn("up to 20 m count", notes("--protocol", "deep360", "--max-depth", 20))
        self.assertNotIn("1000", notes("--protocol", "deep360", "--max-depth", 20))
        self.assertIn("above 0.01 m", notes("--protocol", "unik3d"))
        self.assertIn("above 2 m", notes("--protocol", "unik3d", "--min-depth", 2))

    def test_predictions_without_logarithm_are_said(self):
        pred, gt = scene(4, holes=False)
        pred[0, :3] = 0
        np.save(self.folder / "p.npy", pred)
        np.save(self.folder / "g.npy", gt)
        found = self.eval("depth", self.folder / "p.npy", self.folder / "g.npy")
        self.assertIsNone(found["rmselog"])
        self.assertSame(found["mae"], np.abs(pred - gt).mean())
        self.assertIn("3 predictions", found["warnings"][0])
        clipped = self.eval("depth", self.folder / "p.npy", self.folder / "g.npy", "--clip", "0.001,80")
        self.assertSame(clipped["rmselog"], depth_errors(np.clip(pred, 0.001, 80), gt)["rmselog"])


if __name__ == "__main__":
    unittest.main()
