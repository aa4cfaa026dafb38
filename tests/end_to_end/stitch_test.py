"""`stitch` puts every face where its name says: checked with faces written by formula and decoders of our own."""
import json
import math
import struct
import unittest
import zlib

from program import ProgramTest, read_exr, read_gray, read_ids, read_png

SIZE = 32
# What the face called NAME in body axes (+X forward, +Y left, +Z up) sees: forward, right and down in that frame.
BODY_FACES = {"+x": ((1, 0, 0), (0, -1, 0), (0, 0, -1)), "-x": ((-1, 0, 0), (0, 1, 0), (0, 0, -1)),
              "+y": ((0, 1, 0), (1, 0, 0), (0, 0, -1)), "-y": ((0, -1, 0), (-1, 0, 0), (0, 0, -1)),
              "+z": ((0, 0, 1), (0, -1, 0), (1, 0, 0)), "-z": ((0, 0, -1), (0, -1, 0), (-1, 0, 0))}
# The same six pictures as other frames call them: camera (+X right, +Y down, +Z forward), OpenGL (+X right, +Y up, +Z forward).
CAMERA_NAMES = {"+x": "+z", "-x": "-z", "+y": "-x", "-y": "+x", "+z": "-y", "-z": "+y"}
OPENGL_NAMES = {"+x": "posz", "-x": "negz", "+y": "negx", "-y": "posx", "+z": "posy", "-z": "negy"}


def write_png(path, width, height, depth, colour, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0)
    packed = zlib.compress(b"".join(b"\0" + row for row in rows))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", packed) + chunk(b"IEND", b""))


def write_exr(path, size, value):
    """A square picture of one float32 value in channel Y, not compressed."""
    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(data)) + data
    window = struct.pack("<4i", 0, 0, size - 1, size - 1)
    header = (b"\x76\x2f\x31\x01\x02\0\0\0" + attribute(b"channels", b"chlist", b"Y\0" + struct.pack("<iiii", 2, 0, 1, 1) + b"\0") +
              attribute(b"compression", b"compression", b"\0") + attribute(b"dataWindow", b"box2i", window) +
              attribute(b"displayWindow", b"box2i", window) + attribute(b"lineOrder", b"lineOrder", b"\0") +
              attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) +
              attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0)) +
              attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0")
    line = struct.pack(f"<ii{size}f", 0, 4 * size, *[value] * size)
    offsets = [len(header) + 8 * size + y * len(line) for y in range(size)]
    lines = [struct.pack("<i", y) + line[4:] for y in range(size)]
    path.write_bytes(header + struct.pack(f"<{size}Q", *offsets) + b"".join(lines))


def direction(name, x, y):
    """Unit vector in body axes that the pixel sees."""
    u, v = (2 * x + 1) / SIZE - 1, (2 * y + 1) / SIZE - 1
    d = [f + u * r + v * w for f, r, w in zip(*BODY_FACES[name])]
    n = math.sqrt(sum(q * q for q in d))
    return [q / n for q in d]


def panorama_direction(x, y, width, height):
    """Unit vector in body axes that a pixel of the panorama sees."""
    theta, phi = 2 * math.pi * ((x + 0.5) / width - 0.5), math.pi * (0.5 - (y + 0.5) / height)
    return math.cos(phi) * math.cos(theta), -math.cos(phi) * math.sin(theta), math.sin(phi)


class StitchTest(ProgramTest):
    def write_direction_faces(self, folder, names):
        folder.mkdir()
        for name in BODY_FACES:
            rows = [struct.pack(f">{3 * SIZE}H", *[round((q * 0.5 + 0.5) * 65535) for x in range(SIZE) for q in direction(name, x, y)])
                    for y in range(SIZE)]
            write_png(folder / f"{names(name)}.png", SIZE, SIZE, 16, 2, rows)

    def test_direction_encoded_faces_come_back_within_a_twentieth_of_a_pixel_under_all_namings(self):
        pictures = []
        for axes, names in [("body", lambda n: n), ("camera", lambda n: "000000_" + CAMERA_NAMES[n]), ("opengl", OPENGL_NAMES.get)]:
            self.write_direction_faces(self.folder / axes, names)
            out = self.folder / f"{axes}.png"
            result = self.run_ok("stitch", "--cube", self.folder / axes, "--axes", axes, "--out", out, "--json")
            report = json.loads(result.stdout)
            self.assertEqual((report["width"], report["height"], report["filter"]), (4 * SIZE, 2 * SIZE, "linear"))
            pictures.append(out.read_bytes())
        self.assertEqual(pictures[0], pictures[1])
        self.assertEqual(pictures[0], pictures[2])

        width, height, channels, size, rows = read_png(out)
        self.assertEqual((width, height, channels, size), (4 * SIZE, 2 * SIZE, 3, 2))
        squares, worst = 0.0, 0.0
        for y in range(height):
            values = struct.unpack(f">{3 * width}H", rows[y])
            for x in range(width):
                d = [values[3 * x + k] - 32767.5 for k in range(3)]
                n = math.sqrt(sum(q * q for q in d))
                cosine = sum(a / n * b for a, b in zip(d, panorama_direction(x, y, width, height)))
                error = math.acos(min(1.0, cosine)) * height / math.pi
                squares, worst = squares + error * error, max(worst, error)
        self.assertLessEqual(math.sqrt(squares / (width * height)), 0.05)
        self.assertLessEqual(worst, 0.35)

    def test_entity_ids_come_back_unmixed_and_nearest(self):
        folder = self.folder / "ids"
        folder.mkdir()
        names = list(BODY_FACES)
        for f, name in enumerate(names):
            ids = [[(f << 20) + y * SIZE + x for x in range(SIZE)] for y in range(SIZE)]
            write_png(folder / f"{name}.png", SIZE, SIZE, 8, 2, [b"".join(struct.pack("<I", i)[:3] for i in row) for row in ids])
        self.run_ok("stitch", "--cube", folder, "--axes", "body", "--nearest", "--out", self.folder / "ids.png")
        ids = read_ids(self.folder / "ids.png")
        width, height = 4 * SIZE, 2 * SIZE
        for y in range(height):
            for x in range(width):
                d = panorama_direction(x, y, width, height)
                along = [sum(a * b for a, b in zip(d, BODY_FACES[name][0])) for name in names]
                f = along.index(max(along))
                u, v = [sum(a * b for a, b in zip(d, BODY_FACES[names[f]][k])) / along[f] for k in (1, 2)]
                expected = (f << 20) + int((v + 1) / 2 * SIZE) * SIZE + int((u + 1) / 2 * SIZE)
                self.assertEqual(ids[y][x], expected, (x, y))

    def test_gray_labels_are_never_mixed(self):
        folder = self.folder / "gray"
        folder.mkdir()
        for f, name in enumerate(["+x", "-x", "+y", "-y", "+z", "-z"]):
            write_png(folder / f"{name}.png", 4, 4, 8, 0, [bytes([10 * f + 1] * 4)] * 4)
        self.run_ok("stitch", "--cube", folder, "--out", self.folder / "gray.png", "--size", "64x32")
        self.assertEqual({v for row in read_gray(self.folder / "gray.png") for v in row}, {1, 11, 21, 31, 41, 51})
        self.run_bad(2, "stitch", "--cube", folder, "--filter", "linear", "--out", self.folder / "x.png", says=["--filter", "nearest"])

    def test_planar_depth_becomes_range(self):
        folder = self.folder / "depth"
        folder.mkdir()
        for name in BODY_FACES:
            write_exr(folder / f"{name}.exr", SIZE, 2.5)
        for flags, factor in [(["--depth-z"], lambda d: 1 / max(map(abs, d))), ([], lambda d: 1.0)]:
            self.run_ok("stitch", "--cube", folder, *flags, "--out", self.folder / "range.exr")
            name, rows = read_exr(self.folder / "range.exr")
            self.assertEqual(name, "Y")
            for y, row in enumerate(rows):
                for x, value in enumerate(row):
                    expected = 2.5 * factor(panorama_direction(x, y, 4 * SIZE, 2 * SIZE))
                    self.assertAlmostEqual(value / expected, 1, delta=2e-7)

    def test_wrong_folders_and_flags_are_told_and_leave_nothing_behind(self):
        folder, out = self.folder / "bad", self.folder / "out.png"
        folder.mkdir()
        self.run_bad(2, "stitch", "--cube", self.folder / "nowhere", "--out", out, says=["--cube", "nowhere"])
        for name in ["+x", "-x", "+y", "-y", "+z"]:
            write_png(folder / f"{name}.png", 4, 4, 8, 2, [bytes(12)] * 4)
        self.run_bad(2, "stitch", "--cube", folder, "--out", out, says=["lacks faces -z", "+x.png"])
        write_png(folder / "-z.png", 5, 5, 8, 2, [bytes(15)] * 5)
        self.run_bad(2, "stitch", "--cube", folder, "--out", out, says=["-z.png has 5x5", "4x4"])
        write_png(folder / "-z.png", 4, 3, 8, 2, [bytes(12)] * 3)
        self.run_bad(2, "stitch", "--cube", folder, "--out", out, says=["-z.png has 4x3", "square"])
        write_png(folder / "-z.png", 4, 4, 8, 0, [bytes(4)] * 4)
        self.run_bad(2, "stitch", "--cube", folder, "--out", out, says=["one kind"])
        (folder / "-z.png").write_bytes((folder / "+z.png").read_bytes()[:50])
        self.run_bad(2, "stitch", "--cube", folder, "--out", out, says=["-z.png", "truncated"])
        write_png(folder / "-z.png", 4, 4, 8, 2, [bytes(12)] * 4)
        self.run_bad(2, "stitch", "--cube", folder, "--depth-z", "--out", out, says=["--depth-z"])
        self.run_bad(2, "stitch", "--cube", folder, "--axes", "bdy", "--out", out, says=["'body'"])
        self.run_bad(2, "stitch", "--cube", folder, "--size", "100x51", "--out", out, says=["--size"])
        self.run_bad(2, "stitch", "--cube", folder, "--out", self.folder / "out.exr", says=["--out"])
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["bad"])
        self.run_ok("stitch", "--cube", folder, "--out", out)


if __name__ == "__main__":
    unittest.main()
