"""Readers of pictures with numpy and the standard library, and small datasets to export. Nothing here is the product's code."""
import json
import pathlib
import struct
import subprocess
import sys
import zlib

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "end_to_end"))
from program import PROGRAM, ProgramTest, run, tree  # noqa: E402,F401


def read_png(path):
    """(H, W) or (H, W, C) array as stored: 8 or 16 bit, indices of a palette."""
    data = path if isinstance(path, bytes) else pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", body)
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    assert interlace == 0
    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[colour]
    step, stride = channels * depth // 8, width * channels * depth // 8
    raw = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, stride + 1)
    above, rows = np.zeros(stride, np.uint8), []
    for kind, row in zip(raw[:, 0], raw[:, 1:].copy()):
        if kind == 1:
            row = row.reshape(-1, step).cumsum(0, dtype=np.uint8).reshape(-1)
        elif kind == 2:
            row = row + above
        elif kind > 2:
            for i in range(stride):
                a, b, c = int(row[i - step]) if i >= step else 0, int(above[i]), int(above[i - step]) if i >= step else 0
                p = a + b - c
                predicted = (a + b) // 2 if kind == 3 else min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
                row[i] = (int(row[i]) + predicted) & 255
        rows.append(row)
        above = row
    image = np.concatenate(rows).view(">u2" if depth == 16 else np.uint8).reshape(height, width, channels)
    return image[..., 0] if channels == 1 else image


def read_exr(path, attributes=False):
    """Channel -> (H, W) float32 of a scan-line OpenEXR file, uncompressed or ZIP/ZIPS; with `attributes` its header too."""
    data = pathlib.Path(path).read_bytes()
    assert data[:4] == b"\x76\x2f\x31\x01"
    at, header = 8, {}
    while data[at]:
        name_end = data.index(0, at)
        kind_end = data.index(0, name_end + 1)
        size = struct.unpack_from("<i", data, kind_end + 1)[0]
        header[data[at:name_end].decode()] = data[kind_end + 5:kind_end + 5 + size]
        at = kind_end + 5 + size
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    names, c = [], 0
    while header["channels"][c]:
        end = header["channels"].index(0, c)
        names.append(header["channels"][c:end].decode())
        assert struct.unpack_from("<i", header["channels"], end + 1)[0] == 2, "float32"
        c = end + 17
    lines = {0: 1, 2: 1, 3: 16}[header["compression"][0]]
    blocks, rows = (height + lines - 1) // lines, []
    for block, offset in enumerate(struct.unpack_from(f"<{blocks}Q", data, at + 1)):
        _, size = struct.unpack_from("<ii", data, offset)
        payload, count = data[offset + 8:offset + 8 + size], min(lines, height - block * lines)
        if size < 4 * width * len(names) * count:
            deltas = np.frombuffer(zlib.decompress(payload), np.uint8).astype(np.int64)
            deltas[1:] -= 128
            flat, half = (deltas.cumsum() & 255).astype(np.uint8), (len(deltas) + 1) // 2
            payload = np.empty_like(flat)
            payload[0::2], payload[1::2] = flat[:half], flat[half:]
        rows.append(np.frombuffer(bytes(payload), np.float32).reshape(count, len(names), width))
    stacked = np.concatenate(rows)
    channels = {name: stacked[:, i] for i, name in enumerate(names)}
    return (channels, header) if attributes else channels


def read_ids(path):
    """(H, W) entity ids: R + 256 G + 65536 B."""
    return read_png(path).astype(np.int64) @ [1, 256, 65536]


def rotation(q_wxyz):
    w, x, y, z = q_wxyz
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def erp_rays(width, height):
    theta = 2 * np.pi * ((np.arange(width) + 0.5) / width - 0.5)
    phi = np.pi * (0.5 - (np.arange(height) + 0.5) / height)[:, None]
    return np.stack([np.cos(phi) * np.sin(theta), np.broadcast_to(-np.sin(phi), (height, width)), np.cos(phi) * np.cos(theta)], -1)


def npm_folder(name):
    """A folder in which node finds these packages; None where npm cannot get them."""
    folder = pathlib.Path(PROGRAM).resolve().parents[1] / "npm_readers"
    if not (folder / "node_modules" / name).exists():
        folder.mkdir(parents=True, exist_ok=True)
        try:
            done = subprocess.run(["npm", "install", "--no-audit", "--no-fund", "--prefix", str(folder), name], capture_output=True, timeout=240)
        except (OSError, subprocess.TimeoutExpired):
            return None
        if done.returncode != 0:
            return None
    return folder


class FormatTest(ProgramTest):
    """A test case whose class has a flight through box_room with people, collected once."""
    COLLECT = ["--people", "3", "--products", "normal,flow,coverage"]
    SIZE = (128, 64)

    @classmethod
    def setUpClass(cls):
        import tempfile
        cls.keep = tempfile.TemporaryDirectory(prefix="airsim360_formats_")
        folder = pathlib.Path(cls.keep.name)
        cls.data = folder / "data"
        (folder / "route.csv").write_text("x,y,z,t\n-3,-2,1.5,0\n-1,1,2.5,1\n1.5,2,2,2\n")
        result = run("collect", "--world", "box_room", "--route", folder / "route.csv", "--fps", "4", "--size", "%dx%d" % cls.SIZE,
                     *cls.COLLECT, "--out", cls.data)
        assert result.returncode == 0, result.stderr
        cls.frames = [json.loads(line) for line in (cls.data / "frames.jsonl").read_text().splitlines()]
        cls.meta = json.loads((cls.data / "meta.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.keep.cleanup()

    def export(self, name, *flags, data=None):
        out = self.folder / name
        self.report = json.loads(self.run_ok("dataset", "export", data or self.data, "--format", name, *flags, "--json", "--out", out).stdout)
        return out

    def source(self, product, frame, suffix=".png"):
        return self.data / product / (frame["stem"] + suffix)
