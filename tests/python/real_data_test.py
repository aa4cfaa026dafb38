"""airsim360.real_data, pictures: small folders as the makers of real data sets describe them, against values worked out by hand."""
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy as np

from airsim360 import read_png, real_data


def png(pixels, palette=False):
    """PNG of 8 or 16 bits, grey or colour; with a palette, as annotation tools write labels, indices are ids and colours mean nothing."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    bits = 8 * pixels.dtype.itemsize
    rows = b"".join(b"\0" + row.astype(f">u{bits // 8}").tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], bits, 3 if palette else 2 if pixels.ndim == 3 else 0, 0, 0, 0)
    colours = chunk(b"PLTE", bytes((7 * i + c) % 256 for i in range(256) for c in range(3))) if palette else b""
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + colours + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def exr(values, names=("V",)):
    """OpenEXR file of 32-bit floats, scan lines, not compressed (openexr.com, "OpenEXR File Layout")."""
    height, width = values.shape
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(name.encode() + b"\0" + struct.pack("<iIii", 2, 0, 1, 1) for name in sorted(names)) + b"\0"
    attributes = [("channels", "chlist", channels), ("compression", "compression", b"\0"), ("dataWindow", "box2i", window), ("displayWindow", "box2i", window),
                  ("lineOrder", "lineOrder", b"\0"), ("pixelAspectRatio", "float", struct.pack("<f", 1)), ("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
                  ("screenWindowWidth", "float", struct.pack("<f", 1))]
    data = struct.pack("<II", 20000630, 2)
    for name, kind, value in attributes:
        data += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value
    data += b"\0"
    line = 8 + 4 * width * len(names)
    data += b"".join(struct.pack("<Q", len(data) + 8 * height + y * line) for y in range(height))
    for y in range(height):
        data += struct.pack("<iI", y, line - 8) + values[y].astype("<f4").tobytes() * len(names)
    return data


def room(height, along_axis=False):
    """Panorama of an empty room of 6 x 4 m, floor 1.5 m below, ceiling 1.1 m above: ranges, or depths along the axes of a cube's faces."""
    depths = np.empty((height, 2 * height))
    for y in range(height):
        for x in range(2 * height):
            lon, lat = 2 * math.pi * ((x + 0.5) / (2 * height) - 0.5), math.pi * (0.5 - (y + 0.5) / height)
            d = (math.cos(lat) * math.sin(lon), math.cos(lat) * math.cos(lon), math.sin(lat))
            hit = min(3 / abs(d[0]), 2 / abs(d[1]), (1.1 if d[2] > 0 else -1.5) / d[2])
            depths[y, x] = hit * max(map(abs, d)) if along_axis else hit
    return depths


class RealData(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="airsim360_real_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.out = self.folder / "out"

    def file(self, name, data=b""):
        path = self.folder / "in" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
        return path

    def convert(self, kind, **options):
        return real_data.convert(kind, self.folder / "in", self.out, **options)

    def refused(self, kind, words):
        with self.assertRaisesRegex(ValueError, words):
            self.convert(kind)

    def depth(self, name):
        return np.load(self.out / f"depth/{name}.npy")

    def evaluate(self, *arguments):
        """The report of `airsim360 eval`, on which the converted files have to work."""
        done = subprocess.run([os.environ["AIRSIM360"], "eval", *map(str, arguments), "--json"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)


class Labels(RealData):
    def test_densepass_labels_keep_their_ids(self):
        ids = np.array([[0, 18, 255], [10, 11, 13]], np.uint8)
        self.file("gtFine/val/cs/7_labelTrainIds.png", png(ids))
        self.assertEqual(self.convert("densepass"), 1)
        self.assertTrue((read_png(self.out / "labels/7.png") == ids).all())
        self.assertEqual((self.out / "classes.txt").read_text().splitlines()[13], "13 car")

    def test_cityscapes_other_ids_and_colours_are_told_from_train_ids(self):
        self.file("gtFine/val/cs/8_labelTrainIds.png", png(np.array([[7, 26]], np.uint8)))  # road and car of labelIds
        self.refused("densepass", "8_labelTrainIds.png.*26.*labelIds")
        self.file("gtFine/val/cs/8_labelTrainIds.png", png(np.zeros((2, 2, 3), np.uint8)))
        self.refused("densepass", "8_labelTrainIds.png.*one channel")
        self.assertFalse(self.out.exists())

    def test_wildpass_takes_its_eight_classes_out_of_25(self):
        self.file("leftImg8bit/val/cs/Rome_1.png", b"not read")
        self.file("gtFine/val/cs/Rome_1.png", png(np.array([[4, 5, 8, 11], [12, 17, 13, 24], [0, 16, 25, 255]], np.uint8), palette=True))
        self.assertEqual(self.convert("wildpass"), 1)
        self.assertEqual(read_png(self.out / "labels/Rome_1.png").tolist(), [[0, 1, 2, 3], [4, 5, 6, 7], [255, 255, 255, 255]])
        self.assertEqual((self.out / "classes.txt").read_text().split(),
                         ["0", "Car", "1", "Truck", "2", "Bus", "3", "Road", "4", "Sidewalk", "5", "Person", "6", "Curb", "7", "Crosswalk"])

    def test_wildpass_of_other_ids_is_named(self):
        self.file("gtFine/val/cs/Rome_1.png", png(np.array([[3, 7, 255]], np.uint8)))
        self.refused("wildpass", "no picture has a road.*0 to 7")
        self.file("gtFine/val/cs/Rome_2.png", png(np.array([[11, 26]], np.uint8)))
        self.refused("wildpass", "Rome_2.png.*26")
        self.assertFalse(self.out.exists())

    def test_wildpass_figures_are_those_of_the_published_evaluator(self):
        # It counts true and false positives and false negatives of eight ids; truths of the other ids count for nothing.
        eight, random = [4, 5, 8, 11, 12, 17, 13, 24], np.random.default_rng(2)
        counts = {c: [0, 0, 0] for c in eight}
        for i in range(3):
            truth = random.choice(eight + [0, 2, 16, 20], (8, 16)).astype(np.uint8)
            guess = np.where(random.random(truth.shape) < 0.6, truth, random.choice(eight + [0, 3, 16], truth.shape)).astype(np.uint8)
            self.file(f"gtFine/val/cs/{i}.png", png(truth))
            guessed = self.folder / f"guess/{i}.png"
            guessed.parent.mkdir(exist_ok=True)
            guessed.write_bytes(png(guess))
            for c in eight:
                counts[c][0] += int(((truth == c) & (guess == c)).sum())
                counts[c][1] += int(((guess == c) & (truth != c) & np.isin(truth, eight)).sum())
                counts[c][2] += int(((truth == c) & (guess != c)).sum())
        self.convert("wildpass")
        real_data.convert("wildpass", self.folder / "guess", self.folder / "guessed")
        found = self.evaluate("semantic", self.folder / "guessed/labels", self.out / "labels", "--classes", self.out / "classes.txt")
        self.assertAlmostEqual(found["miou"], np.mean([tp / (tp + fp + fn) for tp, fp, fn in counts.values()]), 12)


class Depths(RealData):
    def test_stanford_has_512_steps_a_metre_and_classes_by_name(self):
        name = "area_1/pano/{0}/camera_a_hall_1_frame_equirectangular_domain_{0}.png"
        self.file(name.format("depth"), png(np.array([[512, 65535, 512, 512], [1, 1280, 512, 512]], np.uint16)))
        rgb = np.zeros((2, 4, 3), np.uint8)
        rgb[0, 1] = (0, 0, 1)    # blue is the lowest byte: entry 1
        rgb[1, 0] = (0, 0, 2)
        rgb[1, 1] = (0, 1, 0)    # 256: beyond the list
        self.file(name.format("semantic"), png(rgb))
        self.file("assets/semantic_labels.json", json.dumps(["<UNK>", "wall_1_hall_1_area_1", "beam_3_hall_1_area_1"]))
        self.assertEqual(self.convert("stanford2d3d"), 1)
        stem = "camera_a_hall_1_frame_equirectangular_domain"
        self.assertTrue(np.allclose(self.depth(stem), [[1, 0, 1, 1], [1 / 512, 2.5, 1, 1]]))
        self.assertEqual((self.out / "classes.txt").read_text(), "0 beam\n1 wall\n")
        self.assertEqual(read_png(self.out / f"labels/{stem}.png").tolist(), [[255, 1, 255, 255], [0, 255, 255, 255]])
        self.file(name.format("semantic"), png(rgb[:, :2]))
        self.refused("stanford2d3d", "_semantic.png.*2x2.*4x2")

    def test_deep360_is_brought_from_cassini_to_equirectangular(self):
        # MODE (ECCV 2022), utils/geometry.py: rows are theta from pi to -pi, columns phi from pi/2 to -pi/2, centres of pixels;
        # left = sin(phi), up = cos(phi) sin(theta), ahead = cos(phi) cos(theta).
        def distance(left, up, ahead):
            return 20 + 6 * left + 5 * up + 4 * ahead

        rows, columns = 256, 128
        cassini = np.empty((rows, columns), np.float32)
        for i in range(rows):
            for j in range(columns):
                theta, phi = math.pi * (1 - 2 * (i + 0.5) / rows), math.pi * (0.5 - (j + 0.5) / columns)
                cassini[i, j] = distance(math.sin(phi), math.cos(phi) * math.sin(theta), math.cos(phi) * math.cos(theta))
        np.savez(self.file("ep1_500frames/testing/depth/000001_depth.npz"), cassini)
        self.assertEqual(self.convert("deep360"), 1)
        found = self.depth("ep1_500frames_testing_depth_000001")
        self.assertEqual(found.shape, (128, 256))
        for y, x in ((64, 128), (64, 192), (64, 64), (20, 128), (100, 200), (5, 3), (64, 0), (127, 255)):
            lon, lat = 2 * math.pi * ((x + 0.5) / 256 - 0.5), math.pi * (0.5 - (y + 0.5) / 128)  # to the right, up
            wanted = distance(-math.cos(lat) * math.sin(lon), math.sin(lat), math.cos(lat) * math.cos(lon))
            self.assertAlmostEqual(found[y, x], wanted, delta=9 * math.pi / columns, msg=(y, x))  # half a pixel of the steepest slope

    def test_deep360_leaves_out_what_is_beyond_a_kilometre(self):
        cassini = np.full((8, 4), 3.5, np.float32)
        cassini[:4] = 1000.5  # the upper half of the picture's middle: theta above 0 is up
        np.savez(self.file("ep1_500frames/testing/depth/000001_depth.npz"), cassini)
        self.convert("deep360")
        found = self.depth("ep1_500frames_testing_depth_000001")
        self.assertTrue((found[:2] == 0).all() and np.allclose(found[2:], 3.5), found)
        np.savez(self.file("ep1_500frames/testing/depth/000001_depth.npz"), cassini[:, :3])
        self.refused("deep360", "000001_depth.npz.*3x8")

    def test_matterport_depth_files_are_read_and_damaged_ones_refused(self):
        data = struct.pack("<fii", 202021.25, 2, 1) + struct.pack("<2f", 4.25, -1)
        self.file("scene/0_depth.dpt", data)
        self.convert("matterport3d360")
        self.assertEqual(self.depth("0_depth").tolist(), [[4.25, 0]])
        for damaged in (b"", data[:-1], struct.pack("<fii", 1.0, 2, 1) + data[12:], struct.pack("<fii", 202021.25, 1 << 30, 1 << 30), struct.pack("<fii", 202021.25, -2, -1)):
            self.file("scene/0_depth.dpt", damaged)
            self.refused("matterport3d360", "0_depth.dpt")

    def test_spherecraft_depth_is_float_exr_of_one_channel(self):
        depths = room(16)
        depths[0, :3] = 1e10, np.inf, np.nan  # nothing was hit
        self.file("tokyo/depthmaps/00000001.exr", exr(depths))
        self.file("tokyo/depthmaps/00000002.exr", exr(depths))
        self.file("tokyo/tokyo_black_list.txt", "00000002.jpg\n")
        self.file("seoul/depthmaps/00000001.exr", exr(depths + 1, ("Y",)))
        self.assertEqual(self.convert("spherecraft"), 2)
        self.assertEqual(sorted(path.name for path in (self.out / "depth").iterdir()), ["seoul_00000001.npy", "tokyo_00000001.npy"])
        found = self.depth("tokyo_00000001")
        self.assertEqual(found[0, :3].tolist(), [0, 0, 0])
        self.assertTrue(np.allclose(found.ravel()[3:], depths.ravel()[3:], rtol=1e-6))
        report = self.evaluate("depth", self.out / "depth", self.out / "depth", "--weights", "solid_angle")
        self.assertEqual((report["absrel"], report["pictures"]), (0, 2))

    def test_spherecraft_that_is_not_as_described_is_refused(self):
        self.file("tokyo/depthmaps/00000001.exr", exr(room(16), ("R", "G", "B")))
        self.refused("spherecraft", "00000001.exr.*3 channels")
        self.file("tokyo/depthmaps/00000001.exr", exr(room(16))[:-9])
        self.refused("spherecraft", "00000001.exr")
        self.file("tokyo/depthmaps/00000001.exr", exr(room(16)[:, :16]))
        self.refused("spherecraft", "00000001.exr.*16x16.*twice as wide")
        self.file("tokyo/depthmaps/00000001.exr", exr(room(16)))
        self.file("tokyo/tokyo_black_list.txt", "00000001\nall of them\n")
        self.refused("spherecraft", "tokyo_black_list.txt:2: 'all of them'")
        self.file("tokyo/tokyo_black_list.txt", "1\n")
        self.refused("spherecraft", "black list")
        self.assertFalse(self.out.exists())


class LikelyMistakes(RealData):
    def test_units_are_named_and_force_overrides(self):
        for factor, unit in ((100, "centimetres"), (1000, "millimetres"), (1 / 100, "divided"), (1 / 2, "")):
            self.file("tokyo/depthmaps/00000001.exr", exr(room(16) * factor))
            if unit:
                self.refused("spherecraft", f"tokyo/depthmaps/00000001.exr.*{unit}")
            else:
                self.convert("spherecraft")
        self.file("tokyo/depthmaps/00000001.exr", exr(room(16) * 100))
        self.assertEqual(self.convert("spherecraft", force=True), 1)
        self.assertGreater(self.depth("tokyo_00000001").max(), 100)

    def test_normalised_depth_is_named(self):
        self.file("tokyo/depthmaps/00000001.exr", exr(room(16) / room(16).max()))
        self.refused("spherecraft", "nothing is beyond 1.*divided")

    def test_depth_along_an_axis_is_named(self):
        self.file("tokyo/depthmaps/00000001.exr", exr(room(64, along_axis=True)))
        self.refused("spherecraft", "along the axis of a cube's face")
        self.file("tokyo/depthmaps/00000001.exr", exr(room(64)))
        self.convert("spherecraft")

    def test_deep360_in_centimetres_is_named_though_most_is_beyond_a_kilometre_then(self):
        np.savez(self.file("ep1_500frames/testing/depth/000001_depth.npz"), np.full((32, 16), 1500, np.float32))
        self.refused("deep360", "000001_depth.npz.*centimetres")


class Command(RealData):
    def test_what_is_not_there_is_named(self):
        with self.assertRaisesRegex(ValueError, "sphrecraft.*spherecraft"):
            real_data.convert("sphrecraft", self.folder, self.out)
        self.assertEqual(real_data.main(["kitti", str(self.folder / "none"), "--out", str(self.out)]), 2)
        for kind in real_data.KINDS:
            self.refused(kind, "no such folder")
        (self.folder / "in").mkdir()
        for kind in real_data.KINDS:
            self.refused(kind, "below it")
        self.assertFalse(self.out.exists())

    def test_the_module_is_a_command(self):
        self.file("tokyo/depthmaps/00000001.exr", exr(room(16)))
        command = [sys.executable, "-m", "airsim360.real_data", "spherecraft", str(self.folder / "in"), "--out", str(self.out)]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, f"1 written to {self.out}\n"), done.stderr)
        done = subprocess.run([*command, "--every", "0"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--every", done.stderr)


if __name__ == "__main__":
    unittest.main()
