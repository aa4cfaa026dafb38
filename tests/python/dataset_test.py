"""airsim360.Dataset and its picture readers: with and without the compiled module, against the renderer itself."""
import json
import os
import pickle
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import numpy as np

import airsim360
from airsim360 import Dataset, dataset, read_exr, read_png

PROGRAM = os.environ["AIRSIM360"]


def run(*arguments):
    subprocess.run([PROGRAM, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def encode_png(pixels, filters, level=6):
    """A PNG whose row y has the filter filters[y]; filters as the PNG specification defines them, the slow way."""
    height, width = pixels.shape[:2]
    color = {1: 0, 2: 4, 3: 2, 4: 6}[pixels.shape[2]]
    depth = pixels.itemsize * 8
    raw = pixels.astype(pixels.dtype.newbyteorder(">")).tobytes()
    step, bpp = len(raw) // height, pixels.shape[2] * pixels.itemsize
    rows = [bytes(step)] + [raw[y * step:(y + 1) * step] for y in range(height)]
    out = b""
    for y in range(height):
        up, row = rows[y], rows[y + 1]
        out += bytes([filters[y]])
        for i in range(step):
            a = row[i - bpp] if i >= bpp else 0
            b, c = up[i], up[i - bpp] if i >= bpp else 0
            estimate = a + b - c
            paeth = min((a, b, c), key=lambda v: abs(estimate - v))
            out += bytes([(row[i] - (0, a, b, (a + b) // 2, paeth)[filters[y]]) & 255])
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, 0))
            + chunk(b"tEXt", b"Comment\0hello") + chunk(b"IDAT", zlib.compress(out, level)[:7])
            + chunk(b"IDAT", zlib.compress(out, level)[7:]) + chunk(b"IEND", b""))


def encode_exr(channels, compression):
    """A scan line EXR of {name: (H, W) array}, written from the description of the format."""
    height, width = next(iter(channels.values())).shape
    names = sorted(channels)
    code = {np.dtype(np.uint32): 0, np.dtype(np.float16): 1, np.dtype(np.float32): 2}
    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data
    chlist = b"".join(n.encode() + b"\0" + struct.pack("<iIii", code[channels[n].dtype], 0, 1, 1) for n in names) + b"\0"
    window = struct.pack("<4i", 3, -2, 3 + width - 1, -2 + height - 1)
    head = struct.pack("<II", 20000630, 2) + attribute(b"channels", b"chlist", chlist)
    head += attribute(b"compression", b"compression", bytes([compression])) + attribute(b"dataWindow", b"box2i", window) + b"\0"
    lines = {0: 1, 2: 1, 3: 16}[compression]
    blocks = []
    for y in range(0, height, lines):
        plain = b"".join(channels[n][row].tobytes() for row in range(y, min(height, y + lines)) for n in names)
        coded = plain
        if compression:
            mixed = plain[0::2] + plain[1::2]
            deltas = bytes([mixed[0]] + [(mixed[i] - mixed[i - 1] + 128) & 255 for i in range(1, len(mixed))])
            packed = zlib.compress(deltas)
            coded = packed if len(packed) < len(plain) else plain
        blocks.append(struct.pack("<iI", y - 2, len(coded)) + coded)
    at = len(head) + 8 * len(blocks)
    table = b""
    for block in blocks:
        table += struct.pack("<Q", at)
        at += len(block)
    return head + table + b"".join(blocks)


class Readers(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name) / "picture"
        self.random = np.random.default_rng(7)

    def put(self, data):
        self.path.write_bytes(data)
        return self.path

    def test_every_filter_depth_and_number_of_channels_of_a_png(self):
        for kind in (np.uint8, np.uint16):
            for channels in (1, 2, 3, 4):
                for height, width in ((1, 1), (1, 9), (9, 1), (6, 11)):
                    pixels = self.random.integers(0, np.iinfo(kind).max + 1, (height, width, channels)).astype(kind)
                    filters = self.random.integers(0, 5, height)
                    read = read_png(self.put(encode_png(pixels, filters)))
                    np.testing.assert_array_equal(read, pixels[..., 0] if channels == 1 else pixels)
                    self.assertEqual(read.dtype, kind)

    def test_every_compression_and_type_of_an_exr(self):
        for compression in (0, 2, 3):
            for shape in ((1, 1), (16, 5), (37, 8)):
                channels = {"Y": self.random.normal(size=shape).astype(np.float32),
                            "id.0": self.random.integers(0, 2**32, shape, dtype=np.uint32),
                            "half": np.zeros(shape, np.float16)}
                read = read_exr(self.put(encode_exr(channels, compression)))
                self.assertEqual(set(read), set(channels))
                for name, values in channels.items():
                    np.testing.assert_array_equal(read[name], values)
                    self.assertEqual(read[name].dtype, values.dtype)

    def test_damage_is_a_value_error_and_nothing_else(self):
        good = {read_png: encode_png(self.random.integers(0, 256, (5, 7, 3)).astype(np.uint8), [0, 1, 2, 3, 4]),
                read_exr: encode_exr({"Y": np.zeros((20, 6), np.float32)}, 3)}
        for read, data in good.items():
            for _ in range(400):
                damaged = bytearray(data[:self.random.integers(0, len(data) + 1)])
                for _ in range(self.random.integers(0, 4)):
                    if damaged:
                        damaged[self.random.integers(0, len(damaged))] = self.random.integers(0, 256)
                try:
                    read(self.put(bytes(damaged)))
                except ValueError as error:
                    self.assertIn(str(self.path), str(error))

    def test_sizes_are_refused_before_memory_is_taken(self):
        huge = encode_png(np.zeros((1, 1, 1), np.uint8), [0])
        header = b"IHDR" + struct.pack(">IIBBBBB", 2**31 - 1, 2**31 - 1, 8, 0, 0, 0, 0)
        with self.assertRaisesRegex(ValueError, "pixels"):
            read_png(self.put(huge[:8] + struct.pack(">I", 13) + header + struct.pack(">I", zlib.crc32(header)) + huge[33:]))


class OfDatasets(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        run("collect", "--world", "box_room", "--frames", 3, "--size", "256x128", "--people", 2, "--radiance",
            "--products", "normal,position,albedo,material,part,sky,flow,coverage", "--out", cls.folder / "room")
        cls.frames = Dataset(cls.folder / "room")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_pictures_are_those_of_the_renderer(self):
        run("render", "--world", "box_room", "--pose", "0.5,-1,2,30,10,5", "--size", "256x128", "--normal", "--radiance",
            "--products", "position,albedo,material,part", "--out", self.folder / "one")
        frame = Dataset(self.folder / "one")[0]
        rig = airsim360.Rig(width=256, products=["rgb", "range", "semantic", "entity", "normal", "position", "albedo", "material", "part"])
        seen = airsim360.World("box_room").capture([0.5, -1, 2], rig, *np.radians([30, 10, 5]))
        for name in ("rgb", "range", "semantic", "entity", "position", "material", "part"):
            np.testing.assert_array_equal(getattr(frame, name), getattr(seen, name), err_msg=name)
        np.testing.assert_allclose(frame.normal, seen.normal, atol=2 / 32767)
        np.testing.assert_allclose(frame.pose, seen.pose, atol=1e-12)
        self.assertEqual(frame.radiance.shape, (128, 256, 3))

    def test_the_points_are_the_positions(self):
        for frame in self.frames:
            hit = frame.range > 0
            np.testing.assert_array_equal(frame.sky, ~hit)
            np.testing.assert_allclose(frame.points()[hit], frame.position[hit], atol=2e-5)
            np.testing.assert_allclose(np.linalg.norm(frame.normal[hit], axis=1), 1, atol=1e-4)

    def test_the_points_of_a_pinhole_and_of_a_cube_are_the_positions_too(self):
        run("render", "--world", "box_room", "--pose", "0,0,2,20,30", "--projection", "pinhole", "--fov", 75, "--size", "96x64",
            "--products", "position", "--out", self.folder / "pinhole")
        frame = Dataset(self.folder / "pinhole")[0]
        np.testing.assert_allclose(frame.points(), frame.position, atol=2e-5)
        run("render", "--world", "box_room", "--pose", "0,0,2,20", "--projection", "cube", "--size", "64x64",
            "--products", "position", "--out", self.folder / "cube")
        frame = Dataset(self.folder / "cube")[0]
        self.assertEqual(set(frame.views), {"+x", "-x", "+y", "-y", "+z", "-z"})
        for face in frame.views:
            np.testing.assert_allclose(frame.points(face), frame.read("position", face), atol=2e-5)
        with self.assertRaisesRegex(ValueError, "view ''; name one"):
            frame.rgb

    def test_flow_and_coverage(self):
        frame = self.frames[0]
        flow = frame.read("flow")
        self.assertEqual(set(flow), {"dx", "dy", "range", "occluded", "motion.X", "motion.Y", "motion.Z"})
        np.testing.assert_array_equal(frame.flow[..., 1], flow["dy"])
        coverage = frame.read("coverage")
        np.testing.assert_array_equal(coverage["id.0"][frame.range > 0] > 0, True)

    def test_what_it_knows(self):
        frames = self.frames
        self.assertEqual((len(frames), frames[-1].index, [f.index for f in frames[1:]]), (3, 2, [1, 2]))
        self.assertIn("3 frames of box_room", repr(frames))
        self.assertIn("Frame(0: rgb", repr(frames[0]))
        self.assertEqual(len(frames[0].people), 2)
        ids = np.unique(frames[0].entity)
        self.assertTrue(set(ids) <= set(frames.entities))
        for number in ids:
            entity = frames.entities[int(number)]
            categories = np.unique(frames[0].semantic[frames[0].entity == number])
            self.assertEqual([frames.categories[int(c)]["path"] for c in categories], [entity["category_path"]])

    def test_samples_are_what_a_loader_takes(self):
        samples = pickle.loads(pickle.dumps(self.frames.samples("rgb", "semantic", "range")))
        self.assertEqual(len(samples), 3)
        one = samples[1]
        self.assertEqual({k: (v.dtype, v.shape) for k, v in one.items()},
                         {"rgb": (np.uint8, (128, 256, 3)), "semantic": (np.int64, (128, 256)), "range": (np.float32, (128, 256))})
        np.testing.assert_array_equal(one["semantic"], self.frames[1].semantic)
        self.assertEqual(self.frames.samples("range", transform=lambda s: s["range"].max())[0], self.frames[0].range.max())
        with self.assertRaises(IndexError):
            samples[3]

    def test_what_is_missing_is_said(self):
        with self.assertRaisesRegex(ValueError, "did you mean 'normal'"):
            self.frames.samples("normals")
        with self.assertRaisesRegex(AttributeError, "did you mean 'range'"):
            self.frames[0].ranges
        run("render", "--world", "box_room", "--pose", "0,0,2", "--size", "64x32", "--tier", "labels", "--out", self.folder / "labels")
        labels = Dataset(self.folder / "labels")[0]
        for name, flag in (("normal", "--products normal"), ("radiance", "--radiance"), ("rgb", "any tier but labels")):
            with self.assertRaisesRegex(ValueError, flag):
                getattr(labels, name)
        with self.assertRaisesRegex(ValueError, "not a dataset"):
            Dataset(self.folder)
        (self.folder / "unfinished").mkdir()
        (self.folder / "unfinished" / "meta.json").write_text((self.folder / "labels" / "meta.json").read_text())
        with self.assertRaisesRegex(ValueError, "unfinished"):
            Dataset(self.folder / "unfinished")

    def test_it_needs_no_compiled_module(self):
        package = Path(airsim360.__file__).resolve().parent
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(os.path.join(folder, "airsim360"))
            for source in package.glob("*.py"):
                (Path(folder) / "airsim360" / source.name).write_text(source.read_text())
            code = (f"import airsim360, hashlib; f = airsim360.Dataset({str(self.folder / 'room')!r})[1]\n"
                    "print(*(hashlib.sha256(f.arrays(n)[n].tobytes()).hexdigest() for n in ('rgb', 'entity', 'semantic', 'range')))\n"
                    "try: airsim360.World\nexcept ImportError as e: print(e)")
            out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True,
                                 env={**os.environ, "PYTHONPATH": folder}).stdout.splitlines()
        import hashlib
        frame = self.frames[1]
        self.assertEqual(out[0].split(), [hashlib.sha256(getattr(frame, n).tobytes()).hexdigest()
                                          for n in ("rgb", "entity", "semantic", "range")])
        self.assertIn("make build", out[1])

    def test_jpeg(self):
        run("render", "--world", "box_room", "--pose", "0,0,2", "--size", "256x128", "--rgb-format", "jpg", "--out", self.folder / "jpeg")
        run("render", "--world", "box_room", "--pose", "0,0,2", "--size", "256x128", "--out", self.folder / "png")
        a, b = (Dataset(self.folder / name)[0].rgb.astype(int) for name in ("jpeg", "png"))
        self.assertEqual(a.shape, b.shape)
        self.assertLess(np.abs(a - b).mean(), 2)


if __name__ == "__main__":
    unittest.main()
