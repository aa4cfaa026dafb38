"""Tone curves, exposure, lens and radiance of `render`, and `eval image`, through the real program."""
import json
import math
import unittest

from program import ProgramTest, read_json, read_png, run

ROOM = ["render", "--world", "box_room", "--size", "128x64", "--pose", "0,1,2,20"]


class Pictures(ProgramTest):
    def shoot(self, name, *flags):
        out = self.folder / name
        result = run(*ROOM, *flags, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        return out

    def rows(self, out):
        return read_png(out / "rgb/000000.png")[4]

    def test_tone_exposure_and_lens_change_colours_alone_and_are_recorded(self):
        plain = self.shoot("plain")
        self.assertEqual(read_json(plain / "meta.json")["parameters"]["tone"], "filmic")
        for name, flags, key, value in [("agx", ["--tone", "agx"], "tone", "agx"), ("linear", ["--tone", "linear"], "tone", "linear"),
                                        ("bright", ["--exposure", "+1"], "exposure", 1.0), ("auto", ["--exposure", "auto"], "exposure", "auto"),
                                        ("real", ["--lens", "real360"], "lens", "real360"),
                                        ("edges", ["--edge-samples", "1"], "edge_samples", 1)]:
            out = self.shoot(name, *flags)
            self.assertEqual(read_json(out / "meta.json")["parameters"][key], value)
            self.assertNotEqual(self.rows(out), self.rows(plain), name)
            for product in ["range/000000.exr", "entity/000000.png", "semantic/000000.png"]:
                self.assertEqual((out / product).read_bytes(), (plain / product).read_bytes(), name)

    def test_every_frame_says_the_exposure_it_was_developed_with(self):
        line = lambda out: json.loads((out / "frames.jsonl").read_text())
        plain, bright, auto = [line(self.shoot(f"said{i}", "--exposure", e))["developed"] for i, e in enumerate(["0", "1", "auto"])]
        self.assertAlmostEqual(bright["factor"] / plain["factor"], 2, 5)
        for said in (plain, bright, auto):
            self.assertAlmostEqual(math.log2(said["factor"]), said["stops"])
        self.assertNotAlmostEqual(auto["stops"], plain["stops"], 1)
        photo = line(self.shoot("said_photo", "--look", "photo"))
        self.assertAlmostEqual(math.log2(photo["developed"]["factor"] / plain["factor"]), photo["look"]["exposure_ev"], 4)
        self.assertNotIn("developed", line(self.shoot("said_labels", "--tier", "labels")))

    def test_edge_samples_change_pixels_at_edges_alone(self):
        one, sixteen = [self.rows(self.shoot(f"edge{n}", "--edge-samples", n)) for n in ("1", "16")]
        entities = read_png(self.folder / "edge1/entity/000000.png")[4]
        bytes_per_pixel = [len(rows[0]) // 128 for rows in (one, entities)]
        pixel = lambda rows, size, x, y: bytes(rows[y][size * (x % 128):size * (x % 128 + 1)])
        changed = [(x, y) for y in range(1, 63) for x in range(128) if pixel(one, bytes_per_pixel[0], x, y) != pixel(sixteen, bytes_per_pixel[0], x, y)]
        self.assertGreater(len(changed), 20)
        for x, y in changed:  # no shadow falls in this room
            around = {pixel(entities, bytes_per_pixel[1], x + i, y + k) for i in (-1, 0, 1) for k in (-1, 0, 1)}
            self.assertGreater(len(around), 1, (x, y))

    def test_a_photo_changes_colours_alone_and_says_what_the_camera_chose(self):
        clean = self.shoot("clean", "--products", "radiance")
        photo = self.shoot("photo", "--products", "radiance", "--look", "photo", "--metering", "0.4", "--metering-spread", "0")
        for product in ["range/000000.exr", "entity/000000.png", "semantic/000000.png", "radiance/000000.exr"]:
            self.assertEqual((photo / product).read_bytes(), (clean / product).read_bytes())
        self.assertNotEqual(self.rows(photo), self.rows(clean))
        parameters = read_json(photo / "meta.json")["parameters"]
        self.assertEqual((parameters["look"], parameters["camera_look"]["metering"]), ("photo", 0.4))
        self.assertNotIn("camera_look", read_json(clean / "meta.json")["parameters"])
        figures = [json.loads((out / "frames.jsonl").read_text()).get("look") for out in (clean, photo)]
        self.assertIsNone(figures[0])
        self.assertGreaterEqual(figures[1]["gain"], 1)
        brighter = self.shoot("brighter", "--look", "photo", "--metering", "0.4", "--metering-spread", "0", "--exposure", "1")
        stops = [json.loads((out / "frames.jsonl").read_text())["look"]["exposure_ev"] for out in (photo, brighter)]
        self.assertAlmostEqual(stops[1] - stops[0], 1)
        refused = run("render", "--world", "box_room", "--look", "photo", "--projection", "cube", "--size", "64x64", "--out", self.folder / "cube")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--look: 'photo'", refused.stderr)
        self.assertFalse((self.folder / "cube").exists())

    def test_a_stop_more_is_brighter(self):
        dark, bright = [sum(map(sum, self.rows(self.shoot(f"ev{ev}", "--exposure", ev)))) for ev in ("-1", "1")]
        self.assertGreater(bright, 1.2 * dark)

    def test_radiance_is_written_as_half_floats(self):
        out = self.shoot("light", "--radiance")
        data = (out / "radiance/000000.exr").read_bytes()
        # Channel list: name, pixel type 1 = half.
        for channel in (b"B", b"G", b"R"):
            at = data.index(b"chlist\0") + 11
            self.assertIn(channel + b"\0\x01\0\0\0", data[at:at + 60])
        self.assertEqual(run("verify", out).returncode, 0)
        self.assertIn("radiance", read_json(out / "meta.json")["encodings"])

    def test_bad_choices_are_named(self):
        out = self.folder / "out"
        for flags, says in [(["--tone", "filmik"], ["--tone", "did you mean 'filmic'"]), (["--lens", "real36"], ["--lens", "did you mean 'real360'"]),
                            (["--exposure", "bright"], ["--exposure", "bright"]), (["--exposure", "nan"], ["--exposure", "nan"]), (["--edge-samples", "0"], ["--edge-samples", "1 … 64", "did you mean 1"]),
                            (["--tier", "labels", "--radiance"], ["--radiance"])]:
            self.run_bad(2, *ROOM, *flags, "--out", out, says=says)
        self.run_bad(2, "render", "--world", "box_room", "--projection", "cube", "--exposure", "auto", "--out", out, says=["--exposure"])
        self.run_bad(2, "render", "--world", "box_room", "--projection", "cube", "--lens", "real360", "--out", out, says=["--lens"])
        self.assertFalse(out.exists())


class Eval(ProgramTest):
    def test_image_metrics_of_equal_and_different_pictures(self):
        for name, ev in (("a", "0"), ("b", "0.5")):
            self.assertEqual(run(*ROOM, "--exposure", ev, "--out", self.folder / name).returncode, 0)
        a, b = (self.folder / name / "rgb/000000.png" for name in "ab")
        same = json.loads(run("eval", "image", a, a, "--json").stdout)
        self.assertEqual((same["equal"], same["psnr_db"], same["ws_psnr_db"], same["flip"]), (True, None, None, 0))
        self.assertAlmostEqual(same["ssim"], 1, 9)

        # PSNR and WS-PSNR again, in Python.
        other = json.loads(run("eval", "image", a, b, "--json").stdout)
        rows_a, rows_b = read_png(a)[4], read_png(b)[4]
        errors = [sum((p - q) ** 2 for p, q in zip(x, y)) for x, y in zip(rows_a, rows_b)]
        weights = [math.cos((y + 0.5 - 32) * math.pi / 64) for y in range(64)]
        self.assertAlmostEqual(other["psnr_db"], 10 * math.log10(255 ** 2 * 3 * 128 * 64 / sum(errors)), 9)
        weighted = sum(w * e for w, e in zip(weights, errors)) / (3 * 128 * sum(weights))
        self.assertAlmostEqual(other["ws_psnr_db"], 10 * math.log10(255 ** 2 / weighted), 9)
        self.assertTrue(0 < other["flip"] < 1 and 0 < other["ssim"] < 1)
        self.assertIn("WS-PSNR", run("eval", "image", a, b).stdout)

    def test_pictures_of_different_size_are_refused(self):
        for name, size in (("a", "64x32"), ("b", "128x64")):
            self.assertEqual(run("render", "--world", "box_room", "--size", size, "--out", self.folder / name).returncode, 0)
        self.run_bad(2, "eval", "image", self.folder / "a/rgb/000000.png", self.folder / "b/rgb/000000.png", says=["64x32", "128x64"])


if __name__ == "__main__":
    unittest.main()
