"""Poses: readers written from the formats' descriptions, and geometry that must come out of them (range of A gives range of B)."""
import csv
import json
import shutil
import subprocess
import unittest

import numpy as np

from readers import FormatTest, erp_rays, read_exr, rotation

FACES = ["+x", "-x", "+y", "-y", "+z", "-z"]


def read_model(folder):
    """A COLMAP text model: cameras {id: (model, w, h, params)}, images {id: (X_CW, camera, name, points2D)}, points {id: ...}."""
    lines = lambda name: [l for l in (folder / name).read_text().split("\n") if not l.startswith("#")]
    cameras, images, points = {}, {}, {}
    for line in filter(None, lines("cameras.txt")):
        key, model, w, h, *params = line.split()
        cameras[int(key)] = (model, int(w), int(h), [float(p) for p in params])
    text = lines("images.txt")
    for pose, seen in zip(text[0::2], text[1::2]):
        if not pose:
            continue
        key, *numbers, camera, name = pose.split()
        numbers = [float(n) for n in numbers]
        images[int(key)] = (rotation(numbers[:4]), np.array(numbers[4:]), int(camera), name,
                            np.array([float(v) for v in seen.split()]).reshape(-1, 3))
    for line in filter(None, lines("points3D.txt")):
        key, x, y, z, r, g, b, error, *track = line.split()
        points[int(key)] = (np.array([float(x), float(y), float(z)]), [int(r), int(g), int(b)], [int(t) for t in track])
    return cameras, images, points


def project(camera, p_C):
    """Pixel positions of points (N, 3) in the camera's axes, as COLMAP's models.h says; NaN behind a pinhole."""
    model, w, h, params = camera
    x, y, z = p_C.T
    if model == "EQUIRECTANGULAR":
        assert params == [w, h]
        return np.stack([(np.arctan2(x, z) / (2 * np.pi) + 0.5) * w, (0.5 + np.arctan2(y, np.hypot(x, z)) / np.pi) * h], -1)
    fx, fy, cx, cy = params
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where((z > 0)[:, None], np.stack([fx * x / z + cx, fy * y / z + cy], -1), np.nan)


def inverse_at(image, at, wraps):
    """1 / image, interpolated between pixel centres."""
    h, w = image.shape
    x, y = at[:, 0] - 0.5, at[:, 1] - 0.5
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    u, v = x - i, y - j
    column = (lambda c: c % w) if wraps else (lambda c: np.clip(c, 0, w - 1))
    row = lambda r: np.clip(r, 0, h - 1)
    read = lambda di, dj: 1 / image[row(j + dj), column(i + di)]
    return 1 / ((1 - v) * ((1 - u) * read(0, 0) + u * read(1, 0)) + v * ((1 - u) * read(0, 1) + u * read(1, 1)))


class Colmap(FormatTest):
    COLLECT = ["--products", "normal"]
    SIZE = (256, 128)

    def setUp(self):
        super().setUp()
        self.out = self.export("colmap", "--points", "2000")

    def test_range_of_one_panorama_predicts_that_of_another(self):
        cameras, images, _ = read_model(self.out / "sparse" / "0")
        self.assertEqual(len(images), len(self.frames))
        for a, b in ((1, 3), (4, 2)):
            R_a, t_a, _, name_a, _ = images[a]
            R_b, t_b, camera, name_b, _ = images[b]
            range_a, range_b = (read_exr(self.out / "range" / n.replace(".png", ".exr"))["Y"] for n in (name_a, name_b))
            p_W = ((erp_rays(256, 128) * range_a[..., None]).reshape(-1, 3) - t_a) @ R_a  # R^T (p - t)
            p_B = p_W @ R_b.T + t_b
            there = inverse_at(range_b, project(cameras[camera], p_B), True)
            error = np.abs(np.linalg.norm(p_B, axis=1) / there - 1)
            self.assertLess(np.median(error), 0.005)
            self.assertGreater(np.linalg.norm(R_a.T @ t_a - R_b.T @ t_b), 0.3, "the two are apart")

    def test_faces_see_what_the_panorama_sees(self):
        cameras, images, _ = read_model(self.out / "faces" / "sparse" / "0")
        self.assertEqual(cameras, {1: ("PINHOLE", 64, 64, [32, 32, 32, 32])})
        self.assertEqual(len(images), 6 * len(self.frames))
        x, y = np.meshgrid((np.arange(64) + 0.5 - 32) / 32, (np.arange(64) + 0.5 - 32) / 32)
        rays = np.stack([x, y, np.ones_like(x)], -1)
        rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
        for face in range(1, 7):
            R_a, t_a, _, name_a, _ = images[face]
            range_a = read_exr(self.out / "faces" / "range" / name_a.replace(".png", ".exr"))["Y"]
            p_W = ((rays * range_a[..., None]).reshape(-1, 3) - t_a) @ R_a
            # All faces of the third frame: each point is in exactly one.
            errors, seen = [], 0
            for other in range(13, 19):
                R_b, t_b, _, name_b, _ = images[other]
                p_B = p_W @ R_b.T + t_b
                at = project(cameras[1], p_B)
                inside = np.all((at > 0) & (at < 64), axis=1)
                seen += inside.sum()
                if not inside.any():
                    continue
                range_b = read_exr(self.out / "faces" / "range" / name_b.replace(".png", ".exr"))["Y"]
                errors.append(np.abs(np.linalg.norm(p_B[inside], axis=1) / inverse_at(range_b, at[inside], False) - 1))
            self.assertAlmostEqual(seen, 64 * 64, delta=4)
            self.assertLess(np.median(np.concatenate(errors)), 0.005, name_a)

    def test_points_project_onto_their_pixels_with_their_colours(self):
        from readers import read_png
        for folder, pictures in (("sparse", "images"), ("faces/sparse", "faces/images")):
            cameras, images, points = read_model(self.out / folder / "0")
            self.assertGreater(len(points), 1000)
            self.assertLessEqual(len(points), 2000)
            for key, (p_W, rgb, (image, index)) in list(points.items())[::7]:
                R, t, camera, name, seen = images[image]
                self.assertEqual(seen[index][2], key)
                np.testing.assert_allclose(project(cameras[camera], (R @ p_W + t)[None])[0], seen[index][:2], atol=0.02)
                if folder == "sparse":
                    x, y = seen[index][:2].astype(int)
                    self.assertEqual(read_png_cached(self.out / pictures / name, read_png)[y, x].tolist(), rgb)

    @unittest.skipUnless(shutil.which("colmap"), "COLMAP is not installed (apt-get install colmap)")
    def test_colmap_opens_the_faces(self):
        done = subprocess.run(["colmap", "model_analyzer", "--path", str(self.out / "faces/sparse/0")], capture_output=True, text=True,
                              env={"QT_QPA_PLATFORM": "offscreen", "PATH": "/usr/bin:/bin"})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        said = done.stdout + done.stderr
        self.assertIn(f"Registered images: {6 * len(self.frames)}", said)


CACHE = {}


def read_png_cached(path, read):
    return CACHE.setdefault(path, None) if CACHE.get(path) is not None else CACHE.update({path: read(path)}) or CACHE[path]


class Others(FormatTest):
    COLLECT = []

    def test_nerfstudio_has_opengl_axes_and_its_equirectangular_intrinsics(self):
        out = self.export("nerfstudio", "--points", "500")
        transforms = json.loads((out / "transforms.json").read_text())
        self.assertEqual([transforms[k] for k in ("camera_model", "w", "h", "fl_x", "fl_y", "cx", "cy")],
                         ["EQUIRECTANGULAR", 128, 64, 64, 64, 64, 32])
        for entry, frame in zip(transforms["frames"], self.frames):
            M, R = np.array(entry["transform_matrix"]), rotation(frame["X_WC"]["q_wxyz"])
            np.testing.assert_allclose(M[:3, :3] @ [0, 0, -1], R[:, 2], atol=1e-12)  # looks along -Z
            np.testing.assert_allclose(M[:3, :3] @ [0, 1, 0], -R[:, 1], atol=1e-12)
            np.testing.assert_allclose(M[:3, 3], frame["X_WC"]["p"])
            self.assertTrue((out / entry["file_path"]).exists())
        head, _, body = (out / transforms["ply_file_path"]).read_bytes().partition(b"end_header\n")
        count = int(head.split(b"element vertex ")[1].split()[0])
        vertices = np.frombuffer(body, np.dtype([("p", "<f4", 3), ("c", "u1", 3)]))
        self.assertEqual(len(vertices), count)
        # All points are on the walls of the room or on its box: none farther than its corners.
        self.assertTrue((np.abs(vertices["p"][:, :2]) < 5.001).all() and (vertices["p"][:, 2] > -0.001).all())

    def test_tum(self):
        out = self.export("tum")
        rows = [l.split() for l in (out / "groundtruth.txt").read_text().splitlines() if not l.startswith("#")]
        pictures = [l.split() for l in (out / "rgb.txt").read_text().splitlines() if not l.startswith("#")]
        for row, picture, frame in zip(rows, pictures, self.frames):
            self.assertEqual(row[0], picture[0])
            self.assertAlmostEqual(float(row[0]), frame["t_ns"] * 1e-9, places=9)
            x, y, z, w = map(float, row[4:])
            np.testing.assert_allclose(rotation([w, x, y, z]), rotation(frame["X_WC"]["q_wxyz"]), atol=1e-12)
            np.testing.assert_allclose([float(v) for v in row[1:4]], frame["X_WC"]["p"])
            self.assertEqual((out / picture[1]).read_bytes(), self.source("rgb", frame).read_bytes())
        self.assertEqual(len(rows), len(self.frames))

    def test_euroc(self):
        out = self.export("euroc") / "mav0"
        rows = list(csv.reader((out / "state_groundtruth_estimate0/data.csv").read_text().splitlines()))[1:]
        pictures = list(csv.reader((out / "cam0/data.csv").read_text().splitlines()))[1:]
        sensor = (out / "cam0/sensor.yaml").read_text()
        T_BS = np.array(json.loads(sensor.split("data: ")[1].split("]")[0].replace("\n", " ") + "]")).reshape(4, 4)
        for row, picture, frame in zip(rows, pictures, self.frames):
            self.assertEqual([row[0], picture[0], picture[1]], [str(frame["t_ns"])] * 2 + [f"{frame['t_ns']}.png"])
            q = [float(v) for v in row[4:8]]
            # Camera in the world = body in the world times camera in the body.
            np.testing.assert_allclose(rotation(q) @ T_BS[:3, :3], rotation(frame["X_WC"]["q_wxyz"]), atol=1e-12)
            np.testing.assert_allclose([float(v) for v in row[8:11]], frame["v_WB"])
            self.assertEqual(len(row), 17)

    def test_euroc_takes_the_imu_of_a_flight(self):
        flight = self.folder / "flight"
        self.run_ok("fly", "--world", "box_room", "--size", "64x32", "--script", "takeoff 1.5; hover 0.5", "--seed", "4", "--out", flight)
        logs = list(flight.rglob("imu.csv"))
        if not logs or not (flight / "frames" / "meta.json").exists():
            self.skipTest("this flight logs no IMU beside frames")
        out = self.export("euroc", data=flight / "frames")
        rows = list(csv.reader((out / "mav0/imu0/data.csv").read_text().splitlines()))[1:]
        source = list(csv.reader(logs[0].read_text().splitlines()))[1:]
        self.assertEqual(len(rows), len(source))
        for row, given in zip(rows, source):
            self.assertEqual(row[1:], given[1:])
            self.assertAlmostEqual(int(row[0]) * 1e-9, float(given[0]), places=8)

    def test_kitti_poses_begin_at_the_first_camera(self):
        out = self.export("kitti_odometry")
        poses = [np.array([float(v) for v in l.split()]).reshape(3, 4) for l in (out / "poses/00.txt").read_text().splitlines()]
        np.testing.assert_allclose(poses[0], np.eye(4)[:3], atol=1e-12)
        first = self.frames[0]["X_WC"]
        for pose, frame in zip(poses, self.frames):
            R0 = rotation(first["q_wxyz"])
            np.testing.assert_allclose(R0 @ pose[:, :3], rotation(frame["X_WC"]["q_wxyz"]), atol=1e-12)
            np.testing.assert_allclose(R0 @ pose[:, 3] + first["p"], frame["X_WC"]["p"], atol=1e-12)
        self.assertEqual(len((out / "sequences/00/times.txt").read_text().split()), len(poses))


class PinholeRig(FormatTest):
    COLLECT = ["--projection", "pinhole", "--fov", "90"]
    SIZE = (96, 64)

    def test_pinholes_keep_their_intrinsics(self):
        cameras, images, points = read_model(self.export("colmap", "--points", "300") / "sparse" / "0")
        self.assertEqual(cameras[1][:3], ("PINHOLE", 96, 64))
        np.testing.assert_allclose(cameras[1][3], [48, 48, 48, 32])
        for p_W, _, (image, index) in points.values():
            R, t, camera, _, seen = images[image]
            np.testing.assert_allclose(project(cameras[camera], (R @ p_W + t)[None])[0], seen[index][:2], atol=0.02)
        calib = (self.export("kitti_odometry") / "sequences/00/calib.txt").read_text().splitlines()[0].split()
        np.testing.assert_allclose([float(v) for v in calib[1:]], [48, 0, 47.5, 0, 0, 48, 31.5, 0, 0, 0, 1, 0])


if __name__ == "__main__":
    unittest.main()
