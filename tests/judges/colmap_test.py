"""COLMAP, which knows nothing of us, on pictures of ours: it finds our poses, and triangulates with our poses what stands in the world.

Skips without Debian's colmap. The figures it prints are in docs/internals/testing.md.
"""
import math
import os
import pathlib
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np

    import airsim360
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(0)

WIDTH, HEIGHT, FOV, VIEWS = 800, 600, math.radians(70), 10


def colmap(*arguments):
    result = subprocess.run(["colmap", *map(str, arguments)], capture_output=True, text=True, timeout=500,
                            env={**os.environ, "QT_QPA_PLATFORM": "offscreen", "OMP_NUM_THREADS": "2"})
    if result.returncode:
        raise AssertionError(f"colmap {arguments[0]}: {result.stderr[-800:]}{result.stdout[-800:]}")
    return result.stdout + result.stderr


def write_png(path, rgb):
    import struct
    import zlib

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    raw = np.concatenate([np.zeros((rgb.shape[0], 1), np.uint8), rgb.reshape(rgb.shape[0], -1)], 1).tobytes()
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", rgb.shape[1], rgb.shape[0], 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(raw, 3)) + chunk(b"IEND", b""))


def quaternion(R):
    """w, x, y, z of a rotation by the eigenvector of Bar-Itzhack's matrix."""
    K = np.array([[R[0, 0] - R[1, 1] - R[2, 2], 0, 0, 0], [R[0, 1] + R[1, 0], R[1, 1] - R[0, 0] - R[2, 2], 0, 0],
                  [R[0, 2] + R[2, 0], R[1, 2] + R[2, 1], R[2, 2] - R[0, 0] - R[1, 1], 0],
                  [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], R[0, 0] + R[1, 1] + R[2, 2]]]) / 3
    values, vectors = np.linalg.eigh(K)
    q = vectors[[3, 0, 1, 2], np.argmax(values)]
    return q if q[0] >= 0 else -q


def centres(folder):
    """Name -> centre of the camera, of COLMAP's images.txt."""
    rows = [row for row in (folder / "images.txt").read_text().splitlines() if not row.startswith("#")][::2]
    found = {}
    for row in rows:
        words = row.split()
        w, x, y, z = map(float, words[1:5])
        R = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                      [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                      [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
        found[words[9]] = -R.T @ np.array(list(map(float, words[5:8])))
    return found


def aligned(a, b):
    """a (N, 3) moved, turned and scaled onto b (Umeyama 1991)."""
    ma, mb = a.mean(0), b.mean(0)
    U, s, Vt = np.linalg.svd((b - mb).T @ (a - ma))
    D = np.diag([1, 1, np.sign(np.linalg.det(U @ Vt))])
    scale = np.trace(np.diag(s) @ D) / ((a - ma) ** 2).sum()
    return scale * (a - ma) @ (U @ D @ Vt).T + mb


@unittest.skipIf(shutil.which("colmap") is None, "colmap is not installed")
class Colmap(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="airsim360_colmap_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.world = world = airsim360.World("downtown_west")
        rig = airsim360.Rig(WIDTH, HEIGHT, projection="pinhole", fov=FOV, tier="fast", edge_samples=16, products=["rgb", "range", "entity"])
        images, start = cls.folder / "images", np.array(world.spawn, float) + [-28, 20, 4]
        images.mkdir()
        cls.poses = {}
        for k in range(VIEWS):  # an arc of about 12 m, up and down, along the fronts of houses 20 m away
            t = k / (VIEWS - 1) - 0.5
            p = start + [2 * math.cos(4 * t), 10 * t, 1.5 * math.sin(5 * t)]
            capture = world.capture(p, rig, yaw=math.pi + 0.4 * t, pitch=-0.05)
            cls.poses[f"{k:02d}.png"] = np.array(capture.pose)
            write_png(images / f"{k:02d}.png", np.array(capture.rgb))
        cls.K = f"{WIDTH / 2 / math.tan(FOV / 2)},{WIDTH / 2 / math.tan(FOV / 2)},{WIDTH / 2},{HEIGHT / 2}"
        cls.database = cls.folder / "database.db"
        colmap("feature_extractor", "--database_path", cls.database, "--image_path", images, "--ImageReader.single_camera", 1,
               "--ImageReader.camera_model", "PINHOLE", "--ImageReader.camera_params", cls.K, "--SiftExtraction.use_gpu", 0,
               "--SiftExtraction.max_num_features", 3000, "--SiftExtraction.num_threads", 2)
        colmap("exhaustive_matcher", "--database_path", cls.database, "--SiftMatching.use_gpu", 0, "--SiftMatching.num_threads", 2)

    def test_it_finds_our_poses_from_the_pictures_alone(self):
        out = self.folder / "found"
        out.mkdir()
        colmap("mapper", "--database_path", self.database, "--image_path", self.folder / "images", "--output_path", out,
               "--Mapper.ba_refine_focal_length", 0, "--Mapper.ba_refine_extra_params", 0, "--Mapper.num_threads", 2)
        self.assertTrue((out / "0").is_dir(), "no model")
        colmap("model_converter", "--input_path", out / "0", "--output_path", out / "0", "--output_type", "TXT")
        found = centres(out / "0")
        self.assertEqual(sorted(found), sorted(self.poses))
        ours = np.array([self.poses[name][:3, 3] for name in sorted(found)])
        error = np.linalg.norm(aligned(np.array([found[name] for name in sorted(found)]), ours) - ours, axis=1)
        path = np.linalg.norm(np.diff(ours, axis=0), axis=1).sum()
        analysis = self.analysed(out / "0")
        print(f"mapper: position error rms {1000 * math.sqrt((error ** 2).mean()):.2f} mm of {path:.2f} m = "
              f"{100 * math.sqrt((error ** 2).mean()) / path:.4f} %, reprojection {analysis:.3f} px")
        self.assertLess(math.sqrt((error ** 2).mean()), 0.001 * path)
        self.assertLess(analysis, 0.5)

    def test_with_our_poses_it_triangulates_what_stands_in_the_world(self):
        given, out = self.folder / "given", self.folder / "triangulated"
        given.mkdir()
        out.mkdir()
        (given / "cameras.txt").write_text(f"1 PINHOLE {WIDTH} {HEIGHT} {self.K.replace(',', ' ')}\n")
        (given / "points3D.txt").write_text("")
        ids = dict(sqlite3.connect(self.database).execute("select name, image_id from images").fetchall())
        lines = []
        for name, X_WC in self.poses.items():
            R = X_WC[:3, :3].T
            lines.append(" ".join(map(str, [ids[name], *quaternion(R), *(-R @ X_WC[:3, 3]), 1, name])) + "\n\n")
        (given / "images.txt").write_text("".join(lines))
        colmap("point_triangulator", "--database_path", self.database, "--image_path", self.folder / "images", "--input_path", given,
               "--output_path", out, "--Mapper.ba_refine_focal_length", 0, "--Mapper.ba_refine_extra_params", 0)
        reprojection = self.analysed(out)
        colmap("model_converter", "--input_path", out, "--output_path", out, "--output_type", "TXT")
        rows = [row.split() for row in (out / "points3D.txt").read_text().splitlines() if not row.startswith("#")]
        long = [row for row in rows if len(row) >= 8 + 2 * 4]  # seen in four pictures or more
        points = np.array([list(map(float, row[1:4])) for row in long])
        away = np.array(self.world.clearance(points, 5.0))
        distance = np.linalg.norm(points - np.mean([X[:3, 3] for X in self.poses.values()], 0), axis=1)
        near = distance < 40
        print(f"triangulated: {len(rows)} points, {len(long)} in 4 pictures or more; reprojection {reprojection:.3f} px; "
              f"distance to a surface: median {1000 * np.median(away[near]):.1f} mm, relative {100 * np.median(away[near] / distance[near]):.3f} %")
        self.assertGreater(near.sum(), 200)
        self.assertLess(reprojection, 0.5)
        self.assertLess(np.median(away[near] / distance[near]), 0.002)

    def analysed(self, model):
        """Mean reprojection error, pixels, as COLMAP tells it."""
        text = colmap("model_analyzer", "--path", model)
        return float(next(row for row in text.splitlines() if "Mean reprojection error" in row).split(":")[-1].strip().removesuffix("px"))


if __name__ == "__main__":
    unittest.main()
