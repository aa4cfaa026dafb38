"""Duplicates by a network (`dedupe --method sscd`): a tiny ONNX file written here byte by byte, held against numpy."""
import json
import struct
import unittest

import numpy as np

from dedupe_test import Labelled
from readers import FormatTest, read_png, rotation, run

MEAN, DEVIATION = np.array([0.485, 0.456, 0.406]), np.array([0.229, 0.224, 0.225])
WIDTH, HEIGHT, CELL = 64, 32, 8


def varint(value):
    data = b""
    while value > 127:
        data += bytes([value & 127 | 128])
        value >>= 7
    return data + bytes([value])


def field(number, value):
    """A field of a protobuf message: a number, text, or bytes of a message."""
    if isinstance(value, int):
        return varint(number << 3) + varint(value)
    data = value.encode() if isinstance(value, str) else value
    return varint(number << 3 | 2) + varint(len(data)) + data


def node(kind, source, target, **attributes):
    made = field(1, source) + field(2, target) + field(3, target) + field(4, kind)
    for name, value in attributes.items():
        body = field(3, value) + field(20, 2) if isinstance(value, int) else b"".join(field(8, v) for v in value) + field(20, 7)
        made += field(5, field(1, name) + body)
    return field(1, made)


def tensor(number, name, shape, kind=1):
    dims = b"".join(field(1, field(1, n) if isinstance(n, int) else field(2, n)) for n in shape)
    return field(number, field(1, name) + field(2, field(1, field(1, kind) + field(2, dims))))


def model(nodes, shape=(1, 3, HEIGHT, WIDTH), output="row", opset=9, inputs=None, outputs=None):
    graph = nodes + field(2, "pool") + (inputs or tensor(11, "picture", shape)) + (outputs or tensor(12, output, (1, "n")))
    return field(1, 4) + field(2, "test") + field(7, graph) + field(8, field(1, "") + field(2, opset))


POOL = node("AveragePool", "picture", "cells", kernel_shape=[CELL, CELL], strides=[CELL, CELL])
NETWORK = model(POOL + node("Flatten", "cells", "row", axis=1))


def linear(v):
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def encoded(v):
    return np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)


def descriptor(rgb, q_wxyz):
    """What the network above makes of a panorama: upright, north-aligned, between -60 and 60 degrees."""
    width, height = 960, 480
    azimuth = 2 * np.pi * ((np.arange(width) + 0.5) / width - 0.5)
    latitude = np.pi * (0.5 - (np.arange(80, 400) + 0.5) / height)[:, None]
    # Of W: the middle looks east, columns go round to the right.
    rays = np.stack([np.cos(latitude) * np.cos(azimuth), -np.cos(latitude) * np.sin(azimuth), np.broadcast_to(np.sin(latitude), (320, width))], -1)
    x, y, z = np.moveaxis(rays @ rotation(q_wxyz), -1, 0)
    rows, columns = rgb.shape[:2]
    u = (np.arctan2(x, z) / (2 * np.pi) + 0.5) * columns - 0.5
    v = (0.5 - np.arctan2(-y, np.hypot(x, z)) / np.pi) * rows - 0.5
    i, j = np.floor(u).astype(int), np.floor(v).astype(int)
    a, b = (u - i)[..., None], (v - j)[..., None]
    at = lambda k, l: rgb[np.clip(l, 0, rows - 1), k % columns].astype(float)
    band = (1 - b) * ((1 - a) * at(i, j) + a * at(i + 1, j)) + b * ((1 - a) * at(i, j + 1) + a * at(i + 1, j + 1))
    cells = linear(band.round() / 255).reshape(HEIGHT, 320 // HEIGHT, WIDTH, width // WIDTH, 3).mean((1, 3))
    values = ((encoded(cells) * 255).round() / 255 - MEAN) / DEVIATION
    row = values.reshape(HEIGHT // CELL, CELL, WIDTH // CELL, CELL, 3).mean((1, 3)).transpose(2, 0, 1).ravel()
    return row / np.linalg.norm(row)


class Sscd(FormatTest):
    COLLECT = ["--pano-frame", "level"]

    def setUp(self):
        super().setUp()
        self.model = self.folder / "pool.onnx"
        self.model.write_bytes(NETWORK)
        probe = run("dataset", "dedupe", self.data, "--method", "sscd", "--model", self.folder / "none.onnx")
        if "built without OpenCV" in probe.stderr:
            self.skipTest("the program is built without OpenCV's DNN: apt-get install libopencv-dnn-dev, then build again")

    def dedupe(self, folder, *flags):
        report = json.loads(self.run_ok("dataset", "dedupe", folder, "--model", self.model, *flags, "--json").stdout)
        rows = [line.split(",") for line in (folder / "dropped.csv").read_text().splitlines()[1:]]
        return (folder / "kept.txt").read_text().split(), {row[0]: row[1:] for row in rows}, report

    def labelled(self):
        """Every frame, and the same far away, turned, noisy and darker: no twin by pose."""
        made = Labelled(self.data, self.folder / "set")
        for i, frame in enumerate(self.frames):
            made.add(frame)
            far = json.loads(json.dumps(frame["X_WC"]))
            far["p"][2] += 50 + 10 * i
            made.add(frame, X_WC=far, columns=37, gain=0.9, noise=2, environment={"sun": i})
        return made

    def test_similarities_and_twins_are_those_of_numpy(self):
        made = self.labelled()
        folder = made.write()
        rows = [descriptor(read_png(folder / "rgb" / (line["stem"] + ".png")), line["X_WC"]["q_wxyz"]) for line in made.lines]
        products = np.array(rows) @ np.array(rows).T
        # The middle of the widest gap, so that rounding decides nothing.
        sorted_products = np.sort(products[np.triu_indices(len(rows), 1)])
        sorted_products = sorted_products[sorted_products > 0.5]
        gap = np.argmax(np.diff(sorted_products))
        threshold = float(sorted_products[gap:gap + 2].mean())
        kept, dropped, report = self.dedupe(folder, "--method", "sscd", "--similarity", threshold)
        stays, twins = [], {}
        for i in range(len(rows)):
            best = max(stays, key=lambda k: products[i, k], default=None)
            if best is not None and products[i, best] >= threshold:
                twins[made.lines[i]["stem"]] = (made.lines[best]["stem"], products[i, best])
            else:
                stays.append(i)
        self.assertTrue(twins)
        self.assertEqual(kept, [made.lines[i]["stem"] for i in stays])
        self.assertEqual({frame: row[0] for frame, row in dropped.items()}, {frame: twin for frame, (twin, _) in twins.items()})
        for frame, (_, reason, value) in dropped.items():
            self.assertEqual(reason, "sscd")
            self.assertAlmostEqual(float(value), twins[frame][1], delta=2e-3)
        self.assertEqual((report["reasons"], report["pictures_compared"]), ({"sscd": len(dropped)}, len(rows)))

    def test_a_turned_camera_gives_the_same_descriptor(self):
        made, twins = Labelled(self.data, self.folder / "set"), {}
        for i, frame in enumerate(self.frames[:4]):
            first = made.add(frame, world=f"world {i}")
            for columns in (1, 32, 77):
                twins[made.add(frame, columns=columns, world=f"world {i}", environment={"sun": columns})] = first
        # Frames of different worlds are not compared, however alike.
        kept, dropped, _ = self.dedupe(made.write(), "--method", "sscd", "--similarity", "0.995")
        self.assertEqual({frame: row[0] for frame, row in dropped.items()}, twins)
        self.assertEqual(len(kept), 4)

    def test_methods_go_together_and_threads_change_nothing(self):
        folder = self.labelled().write()
        both = self.dedupe(folder, "--method", "parallax,sscd", "--similarity", "0.9", "--threads", "1")
        self.assertEqual(both, self.dedupe(folder, "--method", "parallax,sscd", "--similarity", "0.9", "--threads", "2"))
        self.assertTrue({"sscd"} <= {row[1] for row in both[1].values()} <= {"sscd", "parallax"})

    def test_what_is_no_network_of_this_kind_is_refused_and_nothing_is_written(self):
        flat = node("Flatten", "cells", "row", axis=1)
        two = tensor(11, "picture", (1, 3, 32, 64)) + tensor(11, "more", (1, 3, 32, 64))
        cases = [(b"", "not an ONNX file"), (b"a picture", "not an ONNX file"), (NETWORK[:len(NETWORK) // 2], "not an ONNX file"),
                 (model(node("Nonsense", "picture", "row")), "cannot read this network of opset 9"),
                 (model(POOL, output="cells"), "1 x 3 x 4 x 8, not one descriptor"),
                 (model(POOL + flat, shape=(1, 4, 32, 64)), "1 x 4 x 32 x 64, not 1 x 3"),
                 (model(POOL + flat, shape=(3, 32, 64)), "3 x 32 x 64, not 1 x 3"),
                 (model(POOL + flat, shape=(1, 3, 32, 40000)), "8 … 1024 pixels"),
                 (model(POOL + flat, inputs=tensor(11, "picture", (1, 3, 32, 64), kind=7)), "not of float32"),
                 (model(POOL + flat, inputs=two), "2 inputs"),
                 (model(POOL + flat + node("Relu", "cells", "other"), outputs=tensor(12, "row", (1, "n")) + tensor(12, "other", (1, "n"))), "2 outputs"),
                 (model(node("Log", "picture", "log") + node("Flatten", "log", "row", axis=1)), "not finite")]
        for data, says in cases:
            with self.subTest(says=says):
                self.model.write_bytes(data)
                self.run_bad(2, "dataset", "dedupe", self.data, "--method", "sscd", "--model", self.model, says=["pool.onnx", says])
        self.run_bad(2, "dataset", "dedupe", self.data, "--method", "sscd", "--model", self.folder / "none.onnx", says=["none.onnx"])
        self.run_bad(2, "dataset", "dedupe", self.data, "--method", "sscd", "--model", self.model, "--similarity", "1.5", says=["--similarity: 1.5"])
        self.assertFalse((self.data / "kept.txt").exists())
        self.assertFalse((self.data / "dropped.csv").exists())


if __name__ == "__main__":
    unittest.main()
