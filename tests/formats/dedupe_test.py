"""Duplicates: labelled pairs made from rendered frames, by pose (exact) and by picture (turned, brighter, noisy)."""
import hashlib
import json
import shutil
import struct
import unittest
import zlib

import numpy as np

from readers import FormatTest, read_png, tree


def write_png(rgb):
    """8-bit RGB, no filter."""
    height, width, _ = rgb.shape
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    raw = b"".join(b"\0" + row.tobytes() for row in np.ascontiguousarray(rgb))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(raw, 1)) +
            chunk(b"IEND", b""))


def times(a, b):
    (aw, ax, ay, az), (bw, bx, by, bz) = a, b
    return [aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw]


class Labelled:
    """A dataset whose frames are those of another, altered: only what dedupe reads is there."""

    def __init__(self, source, folder):
        self.source, self.folder, self.lines = source, folder, []
        (folder / "rgb").mkdir(parents=True)
        for name in ("meta.json", "index.sqlite", "SHA256SUMS"):
            shutil.copy(source / name, folder / name)

    def add(self, frame, columns=0, gain=1.0, noise=0.0, **changes):
        """`columns`: the camera is turned so that its picture rolls by as many to the left."""
        index = len(self.lines)
        rgb = read_png(self.source / "rgb" / (frame["stem"] + ".png")).astype(float)
        width = rgb.shape[1]
        random = np.random.default_rng(index)
        rgb = np.clip(np.roll(rgb, -columns, axis=1) * gain + random.normal(0, noise, rgb.shape) if noise else np.roll(rgb, -columns, axis=1) * gain, 0, 255)
        line = json.loads(json.dumps(frame))
        # A picture that moves to the left is of a camera turned to the right: by -yaw about up, world up being W's Z.
        half = -np.pi * columns / width
        line["X_WC"]["q_wxyz"] = times([np.cos(half), 0, 0, np.sin(half)], line["X_WC"]["q_wxyz"])
        data = write_png(rgb.round().astype(np.uint8))
        line.update(index=index, stem=f"{index:06d}", sha256={"rgb": hashlib.sha256(data).hexdigest()}, **changes)
        (self.folder / "rgb" / (line["stem"] + ".png")).write_bytes(data)
        self.lines.append(line)
        return line["stem"]

    def write(self, order=None):
        lines = [self.lines[i] for i in order] if order is not None else self.lines
        (self.folder / "frames.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))
        return self.folder


class Dedupe(FormatTest):
    COLLECT = ["--pano-frame", "level"]

    def dedupe(self, folder, *flags):
        report = json.loads(self.run_ok("dataset", "dedupe", folder, *flags, "--json").stdout)
        lines = (folder / "dropped.csv").read_text().splitlines()
        self.assertEqual(lines[0], "frame,twin,reason,value")
        kept = (folder / "kept.txt").read_text().split()
        self.assertEqual((report["kept"], report["dropped"]), (len(kept), len(lines) - 1))
        return kept, {line.split(",")[0]: line.split(",")[1:] for line in lines[1:]}

    def apart(self):
        """Frames of the flight that are more than 0.1 rad of parallax from each other."""
        chosen = []
        for frame in self.frames:
            p = np.array(frame["X_WC"]["p"])
            if all(np.linalg.norm(p - o["X_WC"]["p"]) > 0.1 * min(frame["range_median"], o["range_median"]) for o in chosen):
                chosen.append(frame)
        self.assertGreater(len(chosen), 3)
        return chosen

    def test_the_flight_itself_has_no_twins(self):
        made = Labelled(self.data, self.folder / "set")
        chosen = self.apart()
        for frame in chosen:
            made.add(frame)
        kept, dropped = self.dedupe(made.write())
        self.assertEqual((len(kept), dropped), (len(chosen), {}))

    def test_turned_and_nudged_frames_of_one_state_are_twins_by_parallax(self):
        made, twins = Labelled(self.data, self.folder / "set"), {}
        for frame in self.apart():
            first = made.add(frame)
            twins[made.add(frame, columns=37)] = first
            near = json.loads(json.dumps(frame["X_WC"]))
            near["p"][0] += 0.01 * frame["range_median"]
            twins[made.add(frame, X_WC=near)] = first
            far = json.loads(json.dumps(frame["X_WC"]))
            far["p"][0] += 0.03 * frame["range_median"]
            made.add(frame, X_WC=far)
        kept, dropped = self.dedupe(made.write(), "--method", "parallax")
        self.assertEqual({frame: row[:2] for frame, row in dropped.items()}, {frame: [twin, "parallax"] for frame, twin in twins.items()})
        for frame, (_, _, value) in dropped.items():
            self.assertAlmostEqual(float(value), 0.01 if int(frame) % 4 == 2 else 0, delta=1e-4)

    def test_another_sky_is_another_frame_unless_the_pictures_are_alike(self):
        made, twins = Labelled(self.data, self.folder / "set"), {}
        for frame in self.apart():
            first = made.add(frame, environment={"sun": 1})
            twins[made.add(frame, columns=51, gain=0.8, noise=2, environment={"sun": 2})] = first
        kept, dropped = self.dedupe(made.write(), "--method", "parallax")
        self.assertEqual(dropped, {})
        kept, dropped = self.dedupe(made.folder)
        self.assertEqual({frame: row[:2] for frame, row in dropped.items()}, {frame: [twin, "hash"] for frame, twin in twins.items()})
        # Turned upside down in brightness nothing is left that looks the same.
        other = Labelled(self.data, self.folder / "other")
        for i, frame in enumerate(self.apart()):
            other.add(frame, environment={"sun": 1})
            other.add(frame, environment={"sun": 2})
            picture = other.folder / "rgb" / f"{2 * i + 1:06d}.png"
            data = write_png(255 - read_png(picture))
            picture.write_bytes(data)
            other.lines[-1]["sha256"]["rgb"] = hashlib.sha256(data).hexdigest()
        self.assertEqual(self.dedupe(other.write())[1], {})

    def test_the_order_of_lines_does_not_matter(self):
        made = Labelled(self.data, self.folder / "set")
        for frame in self.frames:
            made.add(frame)
            made.add(frame, columns=20, gain=0.9, environment={"sun": 3})
        first = self.dedupe(made.write())
        self.assertGreater(len(first[1]), 0)
        for seed in range(3):
            order = np.random.default_rng(seed).permutation(len(made.lines))
            self.assertEqual(self.dedupe(made.write(order)), first)

    def test_apply_leaves_a_whole_dataset(self):
        data = self.folder / "data"
        shutil.copytree(self.data, data)
        kept, dropped = self.dedupe(data, "--parallax", "0.2")
        self.assertTrue(0 < len(dropped) < len(self.frames))
        self.assertEqual({name: sha for name, sha in tree(data).items() if name not in ("kept.txt", "dropped.csv")}, tree(self.data), "nothing else changed")
        self.dedupe(data, "--parallax", "0.2", "--apply")
        verified = json.loads(self.run_ok("verify", data, "--json").stdout)
        self.assertEqual((verified["frames"], verified["damages"], verified["findings"]), (len(kept), 0, []))
        self.assertEqual([json.loads(l)["stem"] for l in (data / "frames.jsonl").read_text().splitlines()], kept)
        self.assertEqual({p.stem for p in (data / "rgb").iterdir()}, set(kept))
        panoptic = json.loads((data / "panoptic.json").read_text())
        self.assertEqual([i["file_name"] for i in panoptic["images"]], [k + ".png" for k in kept])
        self.assertEqual(len(panoptic["annotations"]), len(kept))
        self.assertIn(f"| frames | {len(kept)} |", (data / "README.md").read_text())
        # What is left can be exported, and has no twins any more.
        out = self.export("coco_entity", data=data)
        self.assertEqual(len(json.loads((out / "annotations/instances.json").read_text())["images"]), len(kept))

    def test_what_is_wrong_is_named(self):
        for words, says in [(["--method", "paralax"], ["--method", "did you mean 'parallax'"]), (["--method", "sscd"], ["--method sscd", "--model"]),
                            (["--parallax", "-1"], ["--parallax"]), (["--bits", "300"], ["--bits", "300"]), (["--model", "m.onnx"], ["--model", "sscd"]), (["--similarity", "0.5"], ["--similarity", "sscd"])]:
            self.run_bad(2, "dataset", "dedupe", self.data, *words, says=says)
        self.run_bad(2, "dataset", "dedupe", self.folder / "none", says=["none"])
        self.assertFalse((self.data / "kept.txt").exists())


if __name__ == "__main__":
    unittest.main()
