"""Calibrated lenses, gimbals and rigs of many cameras: ranges in closed form through lenses inverted here by other means than the program's,
files of calibration programs, people in each camera's pixels, and the bytes of a camera alone and among twenty."""
import math
import unittest

from camera_test import add, body_axes, lines, norm, sub
from collect_test import rotate
from program import ProgramTest, read_exr, read_ids, read_json, tree, ROOT

POSE = "-2,1,2.2,25,-10,5"
PRODUCTS = ("rgb", "range", "semantic", "entity", "normal", "flow", "coverage")

LENSES = {
    "opencv": ("OPENCV", (96, 64), [60, 61, 47.5, 33, -0.28, 0.074, 0.0021, -0.0013], None),
    "prism": ("OPENCV_THIN_PRISM", (96, 64), [70, 71, 48, 32, -0.1, 0.02, 0.002, -0.001, 0, 0, 0, 0, 0.004, -0.001, -0.003, 0.002], None),
    "sphere": ("DOUBLE_SPHERE", (64, 64), [20, 20.5, 32, 31.5, -0.18, 0.59], 190),
    "eucm": ("EUCM", (96, 64), [33, 34, 48, 32, 0.62, 1.1], None),
    "omni": ("OMNI", (96, 64), [85, 86, 48, 31, 1.27, -0.21, 0.13, 0.0006, -0.0004], None),
    "theta": ("F_THETA", (96, 64), [1, 1, 48, 32, 41.5, -1.2, 0.8, -3.3, 1.0, -0.15], 140),
}


def undistorted(k, p1, p2, s, x, y):
    """OpenCV's distortion inverted by repeated substitution."""
    u, v = x, y
    for _ in range(400):
        q = u * u + v * v
        radial = (1 + q * (k[0] + q * (k[1] + q * k[2]))) / (1 + q * (k[3] + q * (k[4] + q * k[5])))
        du = 2 * p1 * u * v + p2 * (q + 2 * u * u) + q * (s[0] + q * s[1])
        dv = p1 * (q + 2 * v * v) + 2 * p2 * u * v + q * (s[2] + q * s[3])
        u, v = (x - du) / radial, (y - dv) / radial
    return u, v


def unit(a):
    return tuple(x / norm(a) for x in a)


def ray_of(model, p, x, y):
    """Unit ray of a pixel position by the published inverse of the model, or by substitution; None: there is none."""
    x, y = (x - p[2]) / p[0], (y - p[3]) / p[1]
    q = x * x + y * y
    if model.startswith("OPENCV"):
        d = p[4:] + [0] * (16 - len(p))
        u, v = undistorted([d[0], d[1], *d[4:8]], d[2], d[3], d[8:12], x, y)
        return unit((u, v, 1))
    if model == "DOUBLE_SPHERE":
        xi, alpha = p[4:]
        if 1 - (2 * alpha - 1) * q < 0:
            return None
        z = (1 - alpha * alpha * q) / (alpha * math.sqrt(1 - (2 * alpha - 1) * q) + 1 - alpha)
        f = (z * xi + math.sqrt(z * z + (1 - xi * xi) * q)) / (z * z + q)
        return (f * x, f * y, f * z - xi)
    if model == "EUCM":
        alpha, beta = p[4:]
        return unit((x, y, (1 - beta * alpha * alpha * q) / (alpha * math.sqrt(1 - (2 * alpha - 1) * beta * q) + 1 - alpha)))
    if model == "OMNI":
        xi, (u, v) = p[4], undistorted([p[5], p[6], 0, 0, 0, 0], p[7], p[8], [0] * 4, x, y)
        q = u * u + v * v
        f = (xi + math.sqrt(1 + (1 - xi * xi) * q)) / (1 + q)
        return (f * u, f * v, f - xi)
    low, high = 0.0, 2.0  # F_THETA: by halving
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if sum(a * middle ** (i + 1) for i, a in enumerate(p[4:])) < math.sqrt(q) else (low, middle)
    s = math.sin(low) / math.sqrt(q)
    return (s * x, s * y, math.cos(low))


def wall(p, d):
    """Distance from a point in box_room to its walls along a unit direction."""
    times = [(bound - a) / b for a, b, (low, high) in zip(p, d, ((-5, 5), (-5, 5), (0, 6))) for bound in (low, high) if b != 0 and (bound - a) / b > 0]
    return min(times)


def rig_text(names):
    entries = []
    for name in names:
        model, size, parameters, fov = LENSES[name]
        entries.append(f"  - {{name: {name}, model: {model}, size: {size[0]}x{size[1]}, parameters: {parameters}" + (f", fov_deg: {fov}" if fov else "") +
                       ", x: 0.1, yaw_deg: 12, pitch_deg: 4, roll_deg: -7}\n")
    return "cameras:\n" + "".join(entries)


class Rigs(ProgramTest):
    def render(self, name, rig, *flags, pose=POSE, tier="labels"):
        file, out = self.folder / (name + ".yaml"), self.folder / name
        file.write_text(rig)
        self.run_ok("render", "--world", "box_room", "--pose", pose, "--cameras", file, "--tier", tier, "--out", out, *flags)
        self.run_ok("verify", out)
        return out


class LensTest(Rigs):
    def test_walls_are_as_far_as_the_inverse_of_each_model_says(self):
        out = self.render("lenses", rig_text(LENSES))
        frame = lines(out / "frames.jsonl")[0]
        box = next(int(i) for i, e in read_json(out / "entities.json").items() if e["name"] == "box")
        for name, (model, (w, h), parameters, fov) in LENSES.items():
            X = frame["cameras"][name]["X_WC"]
            ranges, entity = read_exr(out / f"range/000000_{name}.exr")[1], read_ids(out / f"entity/000000_{name}.png")
            checked = 0
            for y in range(h):
                for x in range(w):
                    ray = ray_of(model, parameters, x + 0.5, y + 0.5)
                    angle = math.degrees(math.acos(ray[2])) if ray else 180
                    if fov and angle > fov / 2 + 1e-6:
                        self.assertEqual((ranges[y][x], entity[y][x]), (0, 0), (name, x, y))
                    if entity[y][x] in (0, box):
                        continue
                    self.assertAlmostEqual(ranges[y][x] / wall(X["p"], rotate(X["q_wxyz"], ray)), 1, delta=2e-5, msg=(name, x, y))
                    checked += 1
            self.assertGreater(checked, 0.6 * w * h, name)

    def test_datasets_say_the_model_and_its_parameters(self):
        out = self.render("lenses", rig_text(LENSES), tier="fast")
        views = {c["name"]: c for c in read_json(out / "meta.json")["cameras"]}
        for name, (model, size, parameters, fov) in LENSES.items():
            K = lines(out / "frames.jsonl")[0]["cameras"][name]["K"]
            self.assertEqual(views[name]["K"], K)
            self.assertEqual((K["model"], [K["width"], K["height"]]), (model, list(size)))
            self.assertEqual([K["fx"], K["fy"], K["cx"], K["cy"], *K["distortion"]], parameters)
            if fov:
                self.assertAlmostEqual(math.degrees(K["max_theta"]), fov / 2, 9)
        rows = [row.split() for row in (out / "cameras.txt").read_text().splitlines()[1:]]
        self.assertEqual([row[1] for row in rows], ["OPENCV", "EUCM"])
        self.assertEqual([float(v) for v in rows[0][4:]], LENSES["opencv"][2])
        nerf = read_json(out / "transforms.json")["frames"]
        self.assertEqual([(f["k1"], f["k2"], f["p1"], f["p2"]) for f in nerf], [tuple(LENSES["opencv"][2][4:])])
        # COLMAP's export reads the dataset again; it refuses what COLMAP has no model of.
        self.run_bad(2, "dataset", "export", out, "--format", "colmap", "--out", self.folder / "colmap", says=["OPENCV_THIN_PRISM"])
        one = self.render("one", rig_text(["opencv"]), tier="fast")
        self.run_ok("dataset", "export", one, "--format", "colmap", "--out", self.folder / "colmap")
        row = (self.folder / "colmap/sparse/0/cameras.txt").read_text().splitlines()[1].split()
        self.assertEqual((row[1], [float(v) for v in row[4:]]), ("OPENCV", LENSES["opencv"][2]))
        self.run_ok("dataset", "export", one, "--format", "euroc", "--out", self.folder / "euroc")
        self.assertIn("distortion_model: radial-tangential\ndistortion_coefficients: [-0.28, 0.074, 0.0021, -0.0013]",
                      (self.folder / "euroc/mav0/cam0/sensor.yaml").read_text())

    def test_kalibr_colmap_and_opencv_give_the_same_bytes(self):
        files = {
            "kalibr.yaml": "cam0:\n  camera_model: pinhole\n  intrinsics: [60, 61, 47, 32.5]\n  distortion_model: radtan\n"
                           "  distortion_coeffs: [-0.28, 0.074, 0.0021, -0.0013]\n  resolution: [96, 64]\n",
            "cameras.txt": "# Camera list\n0 OPENCV 96 64 60 61 47.5 33 -0.28 0.074 0.0021 -0.0013\n",
            "opencv.yaml": "%YAML:1.0\n---\nimage_width: 96\nimage_height: 64\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
                           "   data: [ 60., 0., 47., 0., 61., 32.5, 0., 0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n"
                           "   dt: d\n   data: [ -0.28, 0.074, 0.0021, -0.0013, 0. ]\n"}
        found = []
        for name, text in files.items():
            (self.folder / name).write_text(text)
            out = self.render("rig_" + name.split(".")[0], f"cameras:\n  - {{name: a, calibration: {name}, x: 0.1, yaw_deg: 12, pitch_deg: 4, roll_deg: -7}}\n", tier="fast")
            found.append({n: s for n, s in tree(out).items() if "/" in n})
            self.run_ok("render", "--world", "box_room", "--pose", POSE, "--cameras", self.folder / name, "--tier", "labels", "--out", self.folder / ("all_" + name))
        self.assertEqual(found[1], found[0])
        self.assertEqual(found[2], found[0])
        model = self.render("model", rig_text(["opencv"]).replace("name: opencv", "name: a"), tier="fast")
        self.assertEqual({n: s for n, s in tree(model).items() if "/" in n}, found[0])

    def test_a_lens_without_distortion_is_the_plain_camera(self):
        f = 48 / math.tan(math.radians(40))
        plain = self.render("plain", "cameras:\n  - {name: a, projection: pinhole, size: 96x64, fov_deg: 80}\n", tier="fast")
        lens = self.render("lens", f"cameras:\n  - {{name: a, model: FULL_OPENCV, size: 96x64, parameters: [{f!r}, {f!r}, 48, 32, 0, 0, 0, 0, 0, 0, 0, 0]}}\n", tier="fast")
        self.assertEqual({n: s for n, s in tree(lens).items() if "/" in n}, {n: s for n, s in tree(plain).items() if "/" in n})

    def test_kalibrs_poses_place_the_cameras_on_the_body(self):
        out = self.folder / "stereo"
        self.run_ok("render", "--world", "box_room", "--pose", "-2,1,2.2,25", "--cameras", ROOT / "data/rigs/kalibr_camchain.yaml", "--tier", "labels", "--out", out)
        frame = lines(out / "frames.jsonl")[0]
        forward, left, up = body_axes(25, 0, 0)
        for name, y in (("cam0", 0.055), ("cam1", -0.055)):
            X = frame["cameras"][name]["X_WC"]
            place = add((-2, 1, 2.2), tuple(0.1 * f + y * l for f, l in zip(forward, left)))
            self.assertLess(norm(sub(X["p"], place)), 1e-9)
            self.assertLess(norm(sub(rotate(X["q_wxyz"], (0, 0, 1)), forward)) + norm(sub(rotate(X["q_wxyz"], (0, -1, 0)), up)), 1e-9)
        self.assertEqual([frame["cameras"][n]["K"]["model"] for n in ("cam0", "cam1")], ["OPENCV", "OPENCV_FISHEYE"])

    def test_chains_go_by_number_and_openvins_poses_are_inverse(self):
        def chain(numbers, first=""):
            head = "  camera_model: pinhole\n  intrinsics: [20, 20, 11.5, 7.5]\n  distortion_model: none\n  resolution: [24, 16]\n"
            step = "  T_cn_cnm1: [[1, 0, 0, -0.1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n"
            return "".join(f"cam{n}:\n{head}{step if n else first}" for n in numbers)

        # As programs that sort keys as text write it.
        out = self.render("chain", chain([0, 1, 10, 2, 3, 4, 5, 6, 7, 8, 9]), pose="0,0,2")
        frame = lines(out / "frames.jsonl")[0]["cameras"]
        for n in range(11):
            self.assertLess(norm(sub(frame[f"cam{n}"]["X_WC"]["p"], (0, -0.1 * n, 2))), 1e-9, n)
        forward = "[[0, 0, 1, 0.3], [-1, 0, 0, 0], [0, -1, 0, 0.2], [0, 0, 0, 1]]"
        out = self.render("openvins", "%YAML:1.0\n" + chain([0], f"  T_imu_cam: {forward}\n  line_delay: 2.0e-05\n"), pose="0,0,2")
        self.assertLess(norm(sub(lines(out / "frames.jsonl")[0]["cameras"]["cam0"]["X_WC"]["p"], (0.3, 0, 2.2))), 1e-9)
        (self.folder / "gap.yaml").write_text(chain([0, 2]))
        self.run_bad(2, "render", "--world", "box_room", "--cameras", self.folder / "gap.yaml", "--out", self.folder / "gap", says=["gap.yaml:6", "no cam1"])

    def test_ros_names_odd_sizes_and_xml_are_read(self):
        ros = ("image_width: 97\nimage_height: 65\ncamera_name: Head-Left\ncamera_matrix: {rows: 3, cols: 3, data: [60, 0, 47, 0, 61, 32.5, 0, 0, 1]}\n"
               "distortion_model: plumb_bob\ndistortion_coefficients: {rows: 1, cols: 5, data: [-0.1, 0.02, 0, 0, 0]}\n")
        out = self.render("ros", ros)
        self.assertTrue((out / "range/000000_head_left.exr").exists())
        xml = ("<?xml version=\"1.0\"?>\n<opencv_storage><image_width>97</image_width><image_height>65</image_height>\n<camera_matrix type_id=\"opencv-matrix\">"
               "<rows>3</rows><cols>3</cols><dt>d</dt><data>\n60. 0. 47. 0. 61. 32.5 0. 0. 1.</data></camera_matrix>\n<distortion_coefficients type_id=\"opencv-matrix\">"
               "<rows>5</rows><cols>1</cols><dt>d</dt><data>-0.1 0.02 0. 0. 0.</data></distortion_coefficients></opencv_storage>\n")
        (self.folder / "lens.xml").write_text(xml)
        both = self.render("both", "cameras:\n  - {name: head_left, calibration: lens.xml}\n  - {name: odd, calibration: lens.xml, size: 49x33}\n")
        self.assertEqual(tree(both)["range/000000_head_left.exr"], tree(out)["range/000000_head_left.exr"])
        K = lines(both / "frames.jsonl")[0]["cameras"]["odd"]["K"]
        for key, want in (("fx", 60 * 49 / 97), ("fy", 61 * 33 / 65), ("cx", 47.5 * 49 / 97), ("cy", 33 * 33 / 65)):
            self.assertAlmostEqual(K[key], want, 9)

    def test_two_lenses_see_the_ring_between_them_from_two_places(self):
        rig = (ROOT / "data/rigs/two_lens_360.yaml").read_text().replace("1024x1024", "64x64")
        out = self.render("two", rig, pose="1,-2,2,40")
        frame = lines(out / "frames.jsonl")[0]
        front, rear = (frame["cameras"][n]["X_WC"] for n in ("front", "rear"))
        self.assertAlmostEqual(norm(sub(front["p"], rear["p"])), 0.03, 9)
        self.assertLess(norm(add(rotate(front["q_wxyz"], (0, 0, 1)), rotate(rear["q_wxyz"], (0, 0, 1)))), 1e-9)
        scale, seen = 64 / math.radians(200), 0
        for name, X in (("front", front), ("rear", rear)):
            ranges = read_exr(out / f"range/000000_{name}.exr")[1]
            entity = read_ids(out / f"entity/000000_{name}.png")
            for y in range(64):
                for x in range(64):
                    u, v = (x + 0.5 - 32) / scale, (y + 0.5 - 32) / scale
                    theta = math.hypot(u, v)
                    if theta > math.radians(100) + 1e-9:
                        self.assertEqual(entity[y][x], 0)
                    elif theta > math.radians(90):
                        ray = (math.sin(theta) * u / theta, math.sin(theta) * v / theta, math.cos(theta))
                        far = wall(X["p"], rotate(X["q_wxyz"], ray))
                        self.assertLess(ranges[y][x], far * 1.00002)
                        seen += abs(ranges[y][x] / far - 1) < 2e-5
        self.assertGreater(seen, 250)

    def test_bad_lenses_name_file_line_and_value(self):
        out, file = self.folder / "out", self.folder / "bad.yaml"
        (self.folder / "two.yaml").write_text((ROOT / "data/rigs/kalibr_camchain.yaml").read_text())
        (self.folder / "broken.yaml").write_text("cam0:\n  camera_model: pinhol\n")
        for entry, says in [("model: OPENCV, size: 64x48, parameters: [1, 2]", ["bad.yaml:2", "8 parameters", "not 2"]),
                            ("model: OPENCVV, size: 64x48, parameters: [1]", ["bad.yaml:2", "did you mean 'OPENCV'"]),
                            ("model: PINHOLE, parameters: [50, 50, 32, 24]", ["bad.yaml:2", "size"]),
                            ("model: PINHOLE, size: 64x48, parameters: [50, 50, x, 24]", ["bad.yaml:2", "'x'"]),
                            ("parameters: [50]", ["bad.yaml:2", "model"]),
                            ("camera: cam0", ["bad.yaml:2", "calibration"]),
                            ("model: PINHOLE, projection: erp", ["bad.yaml:2", "one of"]),
                            ("model: OPENCV, size: 64x48, parameters: [25, 25, 32, 24, -0.5, 0, 0, 0]", ["bad.yaml:2", "folds over 39.23"]),
                            ("model: OPENCV, size: 64x48, fov_deg: 90, parameters: [25, 25, 32, 24, -0.5, 0, 0, 0]", ["bad.yaml:2", "fov_deg 90"]),
                            ("calibration: nothing.yaml", ["bad.yaml:2", "nothing.yaml"]),
                            ("calibration: broken.yaml", ["bad.yaml:2", "broken.yaml:2", "did you mean 'pinhole'"]),
                            ("calibration: two.yaml", ["bad.yaml:2", "cam0, cam1"]),
                            ("calibration: two.yaml, camera: cam2", ["bad.yaml:2", "'cam2'"]),
                            ("calibration: two.yaml, camera: cam0, size: 376x200", ["bad.yaml:2", "376x200"]),
                            ("calibration: two.yml, camera: cam0", ["bad.yaml:2", "no such file", "two.yaml'?"]),
                            ("calibration: two.yaml, camera: cam0, fov_deg: 0", ["bad.yaml:2", "fov_deg", "from 0.001 to 360", "'0'"]),
                            ("model: PINHOLE, size: 64x48, parameters: [1e308, 50, 32, 24]", ["bad.yaml:2", "fx 1e+308"]),
                            ("model: PINHOLE, size: 64x48, parameters: [50, 50, 1e7, 24]", ["bad.yaml:2", "cx 10000000", "-640 … 704"]),
                            ("model: OPENCV_FISHEYE, size: 64x48, parameters: [5, 5, 600, 24, 0, 0, 0, 0]", ["bad.yaml:2", "no pixel has a ray"]),
                            ("projection: lens", ["bad.yaml:2", "'lens'"]),
                            ("gimbal: nose", ["bad.yaml:2", "gimbal"])]:
            file.write_text(f"cameras:\n  - {{name: a, {entry}}}\n")
            self.run_bad(2, "render", "--world", "box_room", "--cameras", file, "--out", out, says=says)
        self.run_bad(2, "render", "--world", "box_room", "--cameras", self.folder / "two.yml", "--out", out, says=["no such file", "two.yaml'?"])
        file.write_text("Camera.type: PinHole\nCamera.fx: 400\n")
        self.run_bad(2, "render", "--world", "box_room", "--cameras", file, "--out", out, says=["bad.yaml:1", "ORB-SLAM", "OPENCV"])
        file.write_text("cameras:\n  - {name: a, gimbal: nos}\ngimbals:\n  - {name: nose}\n")
        self.run_bad(2, "render", "--world", "box_room", "--cameras", file, "--out", out, says=["bad.yaml:2", "did you mean 'nose'"])
        file.write_text("cameras:\n  - {name: a, gimbal: nose}\ngimbals:\n  - {name: nose}\n")
        self.run_bad(2, "render", "--world", "box_room", "--cameras", file, "--pano-frame", "level", "--out", out, says=["--pano-frame"])
        self.assertFalse(out.exists())


class RigOfTwentyTest(Rigs):
    ALONE = ("  - {name: lens, model: DOUBLE_SPHERE, size: 48x48, parameters: [15, 15, 24, 24, -0.18, 0.59], fov_deg: 190, x: 0.1, yaw_deg: 20}\n",
             "  - {name: front, projection: pinhole, size: 48x32, fov_deg: 80, pitch_deg: -10}\n",
             "  - {name: pano, projection: erp, size: 64x32, z: 0.2}\n")

    def both(self, tier, *flags):
        others = [f"  - {{name: other{i}, projection: {kind}, size: {size}, yaw_deg: {20 * i}, z: {0.01 * i}}}\n"
                  for i, (kind, size) in enumerate([("pinhole", "32x24"), ("fisheye", "24x24"), ("erp", "32x16"), ("cube", "8x8")] * 4 + [("pinhole", "24x24")])]
        twenty = self.render(f"twenty_{tier}", "cameras:\n" + "".join(others[:9]) + "".join(self.ALONE) + "".join(others[9:]), *flags, tier=tier)
        files = tree(twenty)
        self.assertEqual(len(read_json(twenty / "meta.json")["parameters"]["cameras"]), 20)
        for entry in self.ALONE:
            name = entry.split("name: ")[1].split(",")[0]
            alone = self.render(f"{name}_{tier}", "cameras:\n" + entry, *flags, tier=tier)
            own = {n: s for n, s in tree(alone).items() if f"_{name}." in n}
            self.assertGreaterEqual(len(own), 3)
            self.assertEqual({n: files.get(n) for n in own}, own)
            yield name, alone, twenty

    def test_a_camera_alone_and_among_twenty_gives_the_same_bytes(self):
        for tier, products in (("fast", "normal,flow,coverage"), ("high", "normal")):
            list(self.both(tier, "--products", products, "--seed", "5"))

    def test_people_are_in_the_pixels_of_each_camera(self):
        flags = ["--people", "6"]
        for name, alone, twenty in self.both("labels", *flags):
            mine = [line for line in (alone / "people.jsonl").read_text().splitlines()]
            self.assertEqual([line for line in (twenty / "people.jsonl").read_text().splitlines() if f'"000000_{name}"' in line], mine)
        frame = next(f for f in lines(twenty / "people.jsonl") if f["stem"] == "000000_lens")
        fx, fy, cx, cy, xi, alpha = 15, 15, 24, 24, -0.18, 0.59
        checked = 0
        for person in frame["persons"]:
            for (x, y, z), (u, v) in zip(person["keypoints_cam"], person["keypoints_px"]):
                if (u, v) == (0, 0) or math.degrees(math.atan2(math.hypot(x, y), z)) > 94:  # not in the picture
                    continue
                d1 = norm((x, y, z))
                d2 = math.sqrt(x * x + y * y + (xi * d1 + z) ** 2)
                below = alpha * d2 + (1 - alpha) * (xi * d1 + z)
                self.assertAlmostEqual(u, fx * x / below + cx, delta=0.02)
                self.assertAlmostEqual(v, fy * y / below + cy, delta=0.02)
                checked += 1
        self.assertGreater(checked, 20)


class GimbalTest(Rigs):
    def test_a_gimbal_keeps_its_axes_as_far_as_its_joints_go(self):
        rig = ("gimbals:\n  - {name: nose, x: 0.3, z: -0.1, pitch_deg: -30}\n  - {name: stiff, pitch_deg: -30, pitch_low_deg: -5, roll_limit_deg: 0}\n"
               "cameras:\n  - {name: steady, projection: pinhole, size: 32x24, gimbal: nose, y: 0.05}\n  - {name: stuck, projection: pinhole, size: 32x24, gimbal: stiff}\n"
               "  - {name: fixed, projection: pinhole, size: 32x24}\n")
        out = self.render("gimbal", rig, pose="0,0,2,25,10,20")
        frame = lines(out / "frames.jsonl")[0]["cameras"]
        forward, left, up = body_axes(25, 10, 20)
        X = frame["steady"]["X_WC"]
        looks, rises, right = (rotate(X["q_wxyz"], a) for a in ((0, 0, 1), (0, -1, 0), (1, 0, 0)))
        # Level, 30 degrees down, at the heading of the body.
        self.assertLess(norm(sub(looks, body_axes(25, -30, 0)[0])), 1e-9)
        self.assertAlmostEqual(right[2], 0, 9)
        # 5 cm to the left of where the axes meet.
        place = tuple(p + 0.3 * f - 0.1 * u - 0.05 * r for p, f, u, r in zip((0, 0, 2), forward, up, right))
        self.assertLess(norm(sub(X["p"], place)), 1e-9)
        # The other one stops 5 degrees below the body's nose.
        stuck = rotate(frame["stuck"]["X_WC"]["q_wxyz"], (0, 0, 1))
        self.assertAlmostEqual(math.degrees(math.asin(sum(a * b for a, b in zip(stuck, up)))), -5, 6)
        self.assertLess(norm(sub(rotate(frame["fixed"]["X_WC"]["q_wxyz"], (0, 0, 1)), forward)), 1e-9)
        meta = read_json(out / "meta.json")
        self.assertIn("X_GC", meta["cameras"][0])
        self.assertEqual(meta["parameters"]["cameras"][0]["gimbal"]["pitch_high_deg"], 60)


if __name__ == "__main__":
    unittest.main()
