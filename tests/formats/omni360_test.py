"""The layout of the AirSim360 release, by a loader written from its description alone (h5py, numpy)."""
import json
import unittest

import numpy as np

from readers import FormatTest, read_exr, read_ids, read_png, rotation, run

try:
    import h5py
except ImportError:
    h5py = None


def unreal_axes(roll, pitch, yaw):
    """Forward, right and up of an Unreal rotator in its left-handed world (X, Y, Z up), from the definition of FRotator."""
    r, p, y = np.radians([roll, pitch, yaw])
    sr, cr, sp, cp, sy, cy = np.sin(r), np.cos(r), np.sin(p), np.cos(p), np.sin(y), np.cos(y)
    return (np.array([cp * cy, cp * sy, sp]), np.array([sr * sp * cy - cr * sy, sr * sp * sy + cr * cy, -sr * cp]),
            np.array([-(cr * sp * cy + sr * sy), cy * sr - cr * sp * sy, cr * cp]))


class Omni360(FormatTest):
    def setUp(self):
        super().setUp()
        self.out = self.export("omni360")

    @unittest.skipUnless(h5py, "h5py is not installed (apt-get install python3-h5py)")
    def test_depth_is_the_range_in_metres_and_a_thousand_for_the_sky(self):
        for frame in self.frames:
            with h5py.File(self.out / "depth" / f"Depth_{frame['index']}.h5", "r") as file:
                self.assertEqual(list(file), ["depth"])
                depth = file["depth"]
                self.assertEqual((depth.dtype, depth.shape), (np.float32, (64, 128)))
                stored = depth[:]
            expected = read_exr(self.source("range", frame, ".exr"))["Y"]
            np.testing.assert_array_equal(stored, np.where((expected > 0) & (expected < 1000), expected, 1000))

    def test_alpha_is_the_class_and_rgb_the_instance(self):
        names = dict(line.rsplit(" ", 1)[::-1] for line in (self.out / "semantic_lists_box_room.txt").read_text().splitlines())
        path_of = {category["id"]: category["path"] for category in self.meta["categories"]}
        for frame in self.frames:
            semantic, instance = (read_png(self.out / kind / f"panorama_{frame['index']}.png") for kind in ("semantic", "instance"))
            ids, entity = read_png(self.source("semantic", frame)), read_ids(self.source("entity", frame))
            np.testing.assert_array_equal(semantic[..., 3], instance[..., 3])
            for value in np.unique(semantic[..., 3]):
                self.assertEqual({path_of[i] for i in np.unique(ids[semantic[..., 3] == value])}, {names[str(value)]})
            # Unique by (A, R, G, B), and all of it: one key for each entity.
            keys = (instance.astype(np.int64) @ [1, 256, 65536, 1 << 24]).ravel()
            pairs = np.unique(np.stack([keys, entity.ravel()]), axis=1)
            self.assertEqual(len(np.unique(pairs[0])), pairs.shape[1])
            self.assertEqual(len(np.unique(pairs[1])), pairs.shape[1])

    def test_poses_are_unreals(self):
        lines = (self.out / "box_room_record.csv").read_text().splitlines()
        self.assertEqual(lines[0], "X,Y,Z,Roll,Pitch,Yaw")
        self.assertEqual(len(lines) - 1, len(self.frames))
        for line, frame in zip(lines[1:], self.frames):
            self.check_pose(line, frame)

    def test_a_tilted_pose_is_unreals(self):
        data = self.folder / "tilted"
        self.run_ok("render", "--world", "box_room", "--pose", "1,0.5,2,40,15,-20", "--size", "64x32", "--out", data)
        out = self.folder / "out"
        self.run_ok("dataset", "export", data, "--format", "omni360", "--out", out)
        line = (out / "box_room_record.csv").read_text().splitlines()[1]
        self.check_pose(line, json.loads((data / "frames.jsonl").read_text()))
        np.testing.assert_allclose([float(v) for v in line.split(",")], [100, -50, 200, -20, 15, -40], atol=1e-6)

    def check_pose(self, line, frame):
        x, y, z, roll, pitch, yaw = map(float, line.split(","))
        np.testing.assert_allclose([x / 100, -y / 100, z / 100], frame["X_WC"]["p"], atol=1e-6)
        R = rotation(frame["X_WC"]["q_wxyz"])
        for axis, expected in zip(unreal_axes(roll, pitch, yaw), (R[:, 2], R[:, 0], -R[:, 1])):
            np.testing.assert_allclose(axis * [1, -1, 1], expected, atol=1e-7)

    def test_pictures_are_copied(self):
        for frame in self.frames:
            self.assertEqual((self.out / "panorama" / f"panorama_{frame['index']}.png").read_bytes(), self.source("rgb", frame).read_bytes())


class PaperClasses(FormatTest):
    """Three frames of a world of the paper."""

    def test_downtown_west_has_the_papers_29_spellings(self):
        data = self.folder / "dw"
        result = run("render", "--world", "downtown_west", "--pose", "0,0,2", "--size", "128x64", "--tier", "fast", "--out", data)
        self.assertEqual(result.returncode, 0, result.stderr)
        out = self.export("omni360", data=data)
        lines = (out / "semantic_lists_dtw.txt").read_text().splitlines()
        self.assertEqual(len(lines), 29)
        self.assertEqual(lines[0], "Building 1")
        self.assertIn("Light Streetlight Complete 20", lines)
        self.assertEqual(lines[-1], "Landscape 29")
        self.assertTrue((out / "DowntownWest_record.csv").exists())
        alpha = read_png(out / "semantic" / "panorama_0.png")[..., 3]
        self.assertAlmostEqual(float(np.mean(alpha == 0)), self.report["notes"]["other_share"]["downtown_west"], places=12)

        # Markings are of the road and kerbs of the pavement; nothing of the ground is left over.
        class_of = {name: int(number) for name, number in (line.rsplit(" ", 1) for line in lines)}
        ids = read_png(data / "semantic" / "000000.png")
        seen = set()
        for category in json.loads((data / "meta.json").read_text())["categories"]:
            here = alpha[ids == category["id"]]
            if not here.size or not category["path"].startswith("ground/"):
                continue
            seen.add(category["path"])
            self.assertNotIn(0, here, category["path"])
            for part, whole in (("ground/lane_marking", "Road"), ("ground/crosswalk", "Road"), ("ground/kerb", "Ground Mod")):
                if category["path"].startswith(part):
                    self.assertEqual(set(here), {class_of[whole]}, category["path"])
        self.assertGreater(len(seen), 2)


if __name__ == "__main__":
    unittest.main()
