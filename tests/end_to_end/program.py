"""Running the real program, and reading what it writes with decoders of our own (Python's standard library only)."""
import hashlib
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("AIRSIM360", str(ROOT / "build/bin/airsim360"))
# Nothing is written into the home of whoever runs the tests.
os.environ.setdefault("AIRSIM360_CACHE", "")


def run(*arguments, **options):
    """Runs the program; the result has returncode, stdout and stderr as text."""
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=240, **options)


def tree(folder):
    """Relative path -> SHA-256 of every file below a folder."""
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(pathlib.Path(folder).rglob("*")) if path.is_file()}


def read_json(path):
    return json.loads(pathlib.Path(path).read_text())


def read_png(path):
    """(width, height, channels, bytes a channel, list of rows of bytes) of a PNG without interlacing."""
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", data[at + 8:at + 18])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    channels, size = {0: 1, 2: 3, 3: 1}[colour], depth // 8  # with a palette: indices
    raw, step, stride = zlib.decompress(packed), channels * (depth // 8), 0
    stride = width * step
    rows, above = [], bytearray(stride)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            a = row[i - step] if i >= step else 0
            b, c = above[i], above[i - step] if i >= step else 0
            if kind == 1:
                predicted = a
            elif kind == 2:
                predicted = b
            elif kind == 3:
                predicted = (a + b) // 2
            elif kind == 4:
                p = a + b - c
                predicted = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            else:
                predicted = 0
            row[i] = (row[i] + predicted) & 255
        rows.append(bytes(row))
        above = row
    return width, height, channels, size, rows


def read_ids(path):
    """Rows of entity ids: R + 256 G + 65536 B."""
    width, _, channels, size, rows = read_png(path)
    assert (channels, size) == (3, 1)
    return [[row[3 * x] + 256 * row[3 * x + 1] + 65536 * row[3 * x + 2] for x in range(width)] for row in rows]


def read_gray(path):
    width, _, channels, size, rows = read_png(path)
    assert channels == 1
    return [[int.from_bytes(row[x * size:(x + 1) * size], "big") for x in range(width)] for row in rows]


def read_exr(path):
    """Rows of a single-part scan-line OpenEXR file with one float32 channel, uncompressed or ZIP/ZIPS."""
    data = pathlib.Path(path).read_bytes()
    assert data[:4] == b"\x76\x2f\x31\x01" and data[4] == 2
    at, attributes = 8, {}
    while data[at]:
        name_end = data.index(0, at)
        kind_end = data.index(0, name_end + 1)
        size = struct.unpack_from("<i", data, kind_end + 1)[0]
        attributes[data[at:name_end].decode()] = data[kind_end + 5:kind_end + 5 + size]
        at = kind_end + 5 + size
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    channel_end = attributes["channels"].index(0)
    name, kind = attributes["channels"][:channel_end].decode(), struct.unpack_from("<i", attributes["channels"], channel_end + 1)[0]
    assert kind == 2, "float32"
    lines = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    blocks = (height + lines - 1) // lines
    offsets = struct.unpack_from(f"<{blocks}Q", data, at + 1)
    rows = []
    for block, offset in enumerate(offsets):
        _, size = struct.unpack_from("<ii", data, offset)
        payload = data[offset + 8:offset + 8 + size]
        expected = 4 * width * min(lines, height - block * lines)
        if len(payload) < expected:
            # ZIP: deltas of the even bytes followed by the odd ones.
            deltas = bytearray(zlib.decompress(payload))
            for i in range(1, len(deltas)):
                deltas[i] = (deltas[i] + deltas[i - 1] - 128) & 255
            half = (len(deltas) + 1) // 2
            payload = bytearray(len(deltas))
            payload[0::2], payload[1::2] = deltas[:half], deltas[half:]
        for y in range(min(lines, height - block * lines)):
            rows.append(list(struct.unpack_from(f"<{width}f", payload, 4 * width * y)))
    return name, rows


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="airsim360_end_to_end_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def run_ok(self, *arguments, **options):
        result = run(*arguments, **options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def run_bad(self, status, *arguments, says=(), **options):
        """Runs a command that must fail with `status` and one clear line that holds every text of `says`."""
        result = run(*arguments, **options)
        self.assertEqual(result.returncode, status, (arguments, result.stdout, result.stderr))
        # --device auto says in a line why there is no GPU to use, and long work is told.
        lines = [line for line in result.stderr.splitlines() if not line.startswith(("device: ", "building "))]
        self.assertTrue(lines and lines[0].startswith("airsim360: error: "), result.stderr)
        self.assertEqual(len(lines), 1, result.stderr)
        for text in says:
            self.assertIn(text, result.stderr)
        return result
