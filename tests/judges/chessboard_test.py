"""OpenCV finds the corners of rendered chessboards, and calibrates from them, through every lens model.

The corners are where formulas written here from the publications of the models say; OpenCV's calibrators get the lens back that
was rendered. Skips without python3-opencv.
"""
import json
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "end_to_end"))
from program import ProgramTest  # noqa: E402

try:
    import cv2
    import numpy as np
except ImportError:
    cv2 = None

COLUMNS, ROWS, SQUARE = 9, 6, 0.1  # inner corners, metres
SIZE = (480, 360)
LENSES = {  # model: parameters, field of view in degrees or None
    "SIMPLE_PINHOLE": ([300, 241, 179], None),
    "PINHOLE": ([300, 305, 241, 179], None),
    "SIMPLE_RADIAL": ([310, 240, 181, -0.12], None),
    "RADIAL": ([310, 240, 181, -0.12, 0.03], None),
    "OPENCV": ([300, 304, 238, 183, -0.2, 0.05, 0.002, -0.0015], None),
    "FULL_OPENCV": ([300, 304, 238, 183, 0.1, 0.02, 0.001, -0.001, 0.003, 0.25, 0.04, 0.001], None),
    "OPENCV_THIN_PRISM": ([300, 304, 238, 183, -0.1, 0.02, 0.002, -0.001, 0, 0, 0, 0, 0.004, -0.001, -0.003, 0.002], None),
    "SIMPLE_FISHEYE": ([230, 242, 178], 150),
    "FISHEYE": ([230, 226, 242, 178], 150),
    "SIMPLE_RADIAL_FISHEYE": ([230, 242, 178, 0.03], 150),
    "RADIAL_FISHEYE": ([230, 242, 178, 0.03, -0.01], 150),
    "OPENCV_FISHEYE": ([230, 228, 242, 178, 0.03, -0.01, 0.004, -0.001], 150),
    "THIN_PRISM_FISHEYE": ([230, 228, 242, 178, 0.02, -0.005, 0.001, -0.0008, 0.001, -0.0004, 0.0015, -0.001], 120),
    "RAD_TAN_THIN_PRISM_FISHEYE": ([230, 228, 242, 178, 0.03, -0.02, 0.005, -0.001, 0.0002, 0, 0.001, -0.0008, 0.0012, -0.0003, -0.001, 0.0002], 120),
    "FOV": ([260, 255, 240, 180, 0.9], 150),
    "EUCM": ([240, 242, 240, 181, 0.6, 1.1], None),
    "DOUBLE_SPHERE": ([180, 182, 240, 181, -0.18, 0.59], 150),
    "OMNI": ([480, 482, 241, 179, 1.1, -0.2, 0.1, 0.0006, -0.0004], 150),
    "F_THETA": ([1, 1, 240, 180, 235, -3, 4, -6, 2, -0.4], 150),
}


def distorted(u, v, k, p, s):
    """OpenCV's radial (k1 … k6), tangential (p1, p2) and thin prism (s1 … s4) distortion, from its documentation."""
    q = u * u + v * v
    radial = (1 + k[0] * q + k[1] * q ** 2 + k[2] * q ** 3) / (1 + k[3] * q + k[4] * q ** 2 + k[5] * q ** 3)
    return (u * radial + 2 * p[0] * u * v + p[1] * (q + 2 * u * u) + s[0] * q + s[1] * q ** 2,
            v * radial + p[0] * (q + 2 * v * v) + 2 * p[1] * u * v + s[2] * q + s[3] * q ** 2)


def projected(model, p, points):
    """Pixels (N, 2), the middle of the first one at (0.5, 0.5), of points (N, 3) of the camera."""
    if model in ("SIMPLE_PINHOLE", "SIMPLE_RADIAL", "RADIAL", "SIMPLE_FISHEYE", "SIMPLE_RADIAL_FISHEYE", "RADIAL_FISHEYE"):
        p = [p[0], *p]
    x, y, z = points.T
    r, d = np.hypot(x, y), np.linalg.norm(points, axis=1)
    theta, rest = np.arctan2(r, z), list(p[4:]) + [0] * 16
    if model.endswith("FISHEYE"):
        power = lambda n: theta * (1 + sum(rest[i] * theta ** (2 * i + 2) for i in range(n)))  # noqa: E731
        if model in ("THIN_PRISM_FISHEYE",):  # COLMAP: all terms act on theta's plane
            u, v = theta * x / r, theta * y / r
            q = u * u + v * v
            radial = 1 + rest[0] * q + rest[1] * q ** 2 + rest[4] * q ** 3 + rest[5] * q ** 4
            u, v = (u * radial + 2 * rest[2] * u * v + rest[3] * (q + 2 * u * u) + rest[6] * q,
                    v * radial + rest[2] * (q + 2 * v * v) + 2 * rest[3] * u * v + rest[7] * q)
        elif model == "RAD_TAN_THIN_PRISM_FISHEYE":  # Project Aria
            u, v = power(6) * x / r, power(6) * y / r
            q, p0, p1, s = u * u + v * v, rest[6], rest[7], rest[8:12]
            u, v = (u + 2 * p0 * u * u + p0 * q + 2 * p1 * u * v + s[0] * q + s[1] * q ** 2,
                    v + 2 * p1 * v * v + p1 * q + 2 * p0 * u * v + s[2] * q + s[3] * q ** 2)
        else:
            u, v = power(4) * x / r, power(4) * y / r
    elif model == "FOV":
        rho = np.arctan(2 * r / z * math.tan(rest[0] / 2)) / rest[0]
        u, v = rho * x / r, rho * y / r
    elif model == "EUCM":
        w = rest[0] * np.sqrt(rest[1] * r * r + z * z) + (1 - rest[0]) * z
        u, v = x / w, y / w
    elif model == "DOUBLE_SPHERE":
        w = rest[1] * np.sqrt(r * r + (rest[0] * d + z) ** 2) + (1 - rest[1]) * (rest[0] * d + z)
        u, v = x / w, y / w
    elif model == "OMNI":
        u, v = distorted(x / (z + rest[0] * d), y / (z + rest[0] * d), [*rest[1:3], 0, 0, 0, 0], rest[3:5], [0] * 4)
    elif model == "F_THETA":
        rho = sum(rest[i] * theta ** (i + 1) for i in range(6))
        u, v = rho * x / r, rho * y / r
    else:  # pinholes
        k = [*rest[0:2], *rest[4:8]] if "OPENCV" in model else [rest[0], rest[1], 0, 0, 0, 0]
        tangential = rest[2:4] if "OPENCV" in model else [0, 0]
        u, v = distorted(x / z, y / z, k, tangential, rest[8:12])
    return np.stack([p[0] * u + p[2], p[1] * v + p[3]], 1)


def write_board(path):
    """A chessboard in the plane z = 0 with a white rim, as OBJ; the first inner corner at (0, 0)."""
    vertices, faces = [], {"dark": [], "light": []}

    def quad(material, x0, y0, x1, y1):
        n = len(vertices) + 1
        vertices.extend([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
        faces[material].append((n, n + 1, n + 2, n + 3))

    for i in range(-1, COLUMNS):
        for j in range(-1, ROWS):
            quad("dark" if (i + j) % 2 else "light", i * SQUARE, j * SQUARE, (i + 1) * SQUARE, (j + 1) * SQUARE)
    low, right, top = -SQUARE, COLUMNS * SQUARE, ROWS * SQUARE
    for x0, y0, x1, y1 in ((-1, -1, 2, low), (-1, top, 2, 2), (-1, low, low, top), (right, low, 2, top)):
        quad("light", x0, y0, x1, y1)
    text = ["mtllib board.mtl"] + [f"v {x} 0 {-y}" for x, y in vertices]  # +Y of the file is up
    for material, quads in faces.items():
        text += [f"o {material}", f"usemtl {material}"] + ["f " + " ".join(map(str, q)) for q in quads]
    path.write_text("\n".join(text) + "\n")
    (path.parent / "board.mtl").write_text("newmtl dark\nKd 0.03 0.03 0.03\nnewmtl light\nKd 0.75 0.75 0.75\n")


@unittest.skipIf(cv2 is None, "python3-opencv and python3-numpy are not installed")
class Chessboards(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.board = np.array([[i * SQUARE, j * SQUARE, 0] for j in range(ROWS) for i in range(COLUMNS)], float)
        cls.views = []  # place and angles of the cameras: all look at the board from about half a metre
        random = np.random.default_rng(3)
        for _ in range(10):
            tilt, around = math.radians(random.uniform(0, 32)), random.uniform(0, 2 * math.pi)
            away = random.uniform(0.62, 0.8)
            x = 0.4 + away * math.sin(tilt) * math.cos(around) + random.uniform(-0.1, 0.1)
            y = 0.25 + away * math.sin(tilt) * math.sin(around) + random.uniform(-0.08, 0.08)
            cls.views.append((x, y, away * math.cos(tilt), math.degrees(around) - 180, math.degrees(tilt) - 90, random.uniform(-20, 20)))

    def pictures(self, lenses, views):
        """(model, number of the view) -> grey picture, points (N, 3) of the board's corners in the camera."""
        write_board(self.folder / "board.obj")
        rig = ["cameras:"]
        for model in lenses:
            parameters, fov = LENSES[model]
            for k in views:
                x, y, z, yaw, pitch, roll = self.views[k]
                rig.append(f"  - {{name: {model.lower()}_{k}, model: {model}, size: {SIZE[0]}x{SIZE[1]}, parameters: {parameters}, x: {x}, y: {y}, z: {z}, "
                           f"yaw_deg: {yaw}, pitch_deg: {pitch}, roll_deg: {roll}" + (f", fov_deg: {fov}" if fov else "") + "}")
        (self.folder / "rig.yaml").write_text("\n".join(rig) + "\n")
        out = self.folder / "out"
        self.run_ok("render", "--world", self.folder / "board.obj", "--pose", "0,0,0,0", "--cameras", self.folder / "rig.yaml", "--tier", "fast",
                    "--edge-samples", "16", "--tone", "linear", "--exposure", "-1", "--seed", "1", "--out", out)
        frame = json.loads((out / "frames.jsonl").read_text().splitlines()[0])
        found = {}
        for model in lenses:
            for k in views:
                name = f"{model.lower()}_{k}"
                pose = frame["cameras"][name]["X_WC"]
                w, a, b, c = pose["q_wxyz"]
                R = np.array([[1 - 2 * (b * b + c * c), 2 * (a * b - w * c), 2 * (a * c + w * b)],
                              [2 * (a * b + w * c), 1 - 2 * (a * a + c * c), 2 * (b * c - w * a)],
                              [2 * (a * c - w * b), 2 * (b * c + w * a), 1 - 2 * (a * a + b * b)]])
                found[model, k] = cv2.imread(str(out / f"rgb/000000_{name}.png"), cv2.IMREAD_GRAYSCALE), (self.board - pose["p"]) @ R
        return found

    def corners(self, picture, guess):
        """OpenCV's corners near a guess, by its own saddle points; pixels with the middle of the first at (0.5, 0.5)."""
        at = (guess - 0.5).astype(np.float32).reshape(-1, 1, 2).copy()
        stop = (cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_MAX_ITER, 60, 1e-4)
        return cv2.cornerSubPix(picture, at, (5, 5), (-1, -1), stop).reshape(-1, 2) + 0.5

    def test_corners_are_where_the_published_formulas_of_all_models_put_them(self):
        errors = {}
        for (model, _), (picture, points) in self.pictures(LENSES, [0, 4]).items():
            where = projected(model, LENSES[model][0], points)
            inside = ((where > 12) & (where < np.array(SIZE) - 12)).all(1)
            self.assertGreater(inside.sum(), 20, model)
            start = where + np.where(np.arange(len(where))[:, None] % 2, 1.5, -1.5)  # not at the answer
            errors.setdefault(model, []).extend((self.corners(picture, start) - where)[inside])
        for model, error in errors.items():
            size, bias = np.linalg.norm(error, axis=1), np.linalg.norm(np.mean(error, 0))
            print(f"{model}: {len(error)} corners, median {np.median(size):.3f} px, 95 % {np.percentile(size, 95):.3f} px, mean offset {bias:.3f} px")
            self.assertLess(np.median(size), 0.15, model)
            self.assertLess(np.percentile(size, 95), 0.4, model)
            self.assertLess(bias, 0.05, model)

    def calibrated(self, model):
        boards, seen = [], []
        for picture, points in self.pictures([model], range(10)).values():
            where = projected(model, LENSES[model][0], points)
            inside = ((where > 10) & (where < np.array(SIZE) - 10)).all(1)
            if inside.sum() < 20:
                continue
            boards.append(self.board[inside].astype(np.float32).reshape(-1, 1, 3))
            seen.append((self.corners(picture, where + 1.5)[inside] - 0.5).astype(np.float32).reshape(-1, 1, 2))
        self.assertGreaterEqual(len(boards), 8)
        return boards, seen

    def assert_same_lens(self, K, distortion, project, parameters, model):
        """Where the lens that was found puts directions within the field, against the one that was rendered, in pixels."""
        x, y = np.meshgrid(np.linspace(-0.6, 0.6, 9), np.linspace(-0.45, 0.45, 7))
        points = np.stack([x.ravel(), y.ravel(), np.ones(x.size)], 1)
        there = projected(model, parameters, points)
        inside = ((there > 0) & (there < np.array(SIZE))).all(1)
        here = project(points, K, distortion).reshape(-1, 2) + 0.5
        print(f"{model}: the lens found is off by {np.median(np.abs(here - there)[inside]):.3f} px (median), {np.abs(here - there)[inside].max():.3f} px (most)")
        self.assertLess(np.abs(here - there)[inside].max(), 1.2, (model, K, distortion))
        self.assertLess(np.median(np.abs(here - there)[inside]), 0.6, (model, K, distortion))

    def test_opencvs_calibrator_finds_the_pinhole_and_its_distortion(self):
        boards, seen = self.calibrated("OPENCV")
        rms, K, distortion, _, _ = cv2.calibrateCamera(boards, seen, SIZE, None, None, flags=cv2.CALIB_FIX_K3)
        self.assertLess(rms, 0.2)
        self.assert_same_lens(K, distortion, lambda p, K, d: cv2.projectPoints(p, np.zeros(3), np.zeros(3), K, d)[0], LENSES["OPENCV"][0], "OPENCV")

    def test_opencvs_fisheye_calibrator_finds_the_fisheye(self):
        boards, seen = self.calibrated("OPENCV_FISHEYE")
        boards = [b.reshape(1, -1, 3).astype(np.float64) for b in boards]
        seen = [s.reshape(1, -1, 2).astype(np.float64) for s in seen]
        K, distortion = np.array([[200.0, 0, 240], [0, 200, 180], [0, 0, 1]]), np.zeros((4, 1))
        rms, K, distortion, _, _ = cv2.fisheye.calibrate(boards, seen, SIZE, K, distortion,
                                                         flags=cv2.fisheye.CALIB_RECOMPUTE_EXTRINSIC | cv2.fisheye.CALIB_FIX_SKEW | cv2.fisheye.CALIB_USE_INTRINSIC_GUESS)
        self.assertLess(rms, 0.2)
        project = lambda p, K, d: cv2.fisheye.projectPoints(p.reshape(1, -1, 3), np.zeros(3), np.zeros(3), K, d)[0]  # noqa: E731
        self.assert_same_lens(K, distortion, project, LENSES["OPENCV_FISHEYE"][0], "OPENCV_FISHEYE")

    def test_opencvs_omnidirectional_calibrator_finds_the_mirror(self):
        if not hasattr(cv2, "omnidir"):
            self.skipTest("this OpenCV has no module ccalib")
        boards, seen = self.calibrated("OMNI")
        boards = [b.reshape(1, -1, 3).astype(np.float64) for b in boards]
        seen = [s.reshape(1, -1, 2).astype(np.float64) for s in seen]
        rms, K, xi, distortion, _, _, _ = cv2.omnidir.calibrate(boards, seen, SIZE, None, None, None, cv2.omnidir.CALIB_FIX_SKEW,
                                                                (cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_MAX_ITER, 300, 1e-8))
        self.assertLess(rms, 0.2)
        project = lambda p, K, d: cv2.omnidir.projectPoints(p.reshape(1, -1, 3), np.zeros(3), np.zeros(3), K, float(xi.ravel()[0]), d)[0]  # noqa: E731
        self.assert_same_lens(K, distortion, project, LENSES["OMNI"][0], "OMNI")


if __name__ == "__main__":
    unittest.main()
