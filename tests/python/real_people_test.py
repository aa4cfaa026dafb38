"""airsim360.real_data, people: KITTI, nuScenes and FreeMan as their makers describe them, against values worked out by hand."""
import json
import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

from airsim360 import real_data


class People(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="airsim360_real_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.out = self.folder / "out"

    def file(self, name, data=""):
        path = self.folder / "in" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(data)
        return path

    def convert(self, kind, **options):
        return real_data.convert(kind, self.folder / "in", self.out, **options)

    def refused(self, kind, words):
        with self.assertRaisesRegex(ValueError, words):
            self.convert(kind)

    def persons(self):
        return {person["id"]: person for person in json.loads((self.out / "persons.json").read_text())["persons"]}

    def run_program(self, *arguments):
        done = subprocess.run([os.environ["AIRSIM360"], *map(str, arguments)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout


class Kitti(People):
    def test_people_are_as_far_as_the_middle_of_their_boxes(self):
        self.file("training/label_2/000003.txt", "Car 0 0 1 0 0 9 9 1.5 1.6 4 1 1.6 20 0\nPedestrian 0 0 -0.2 0 0 9 9 1.8 0.5 0.9 2 1.7 14 -1.57079632679\n")
        self.assertEqual(self.convert("kitti"), 1)
        person = self.persons()["000003:2"]
        self.assertTrue(np.allclose(person["xyz"], [2, 0.8, 14]))
        self.assertAlmostEqual(person["yaw_deg"], -90, 6)

    def test_what_is_no_pedestrian_of_kitti_is_named_with_its_line(self):
        for line, words in [("Pedestrian 0 0 1.8", "000003.txt:1: must have 15"),
                            ("Pedestrian 0 0 -0.2 0 0 9 9 180 50 90 200 170 1400 0", "000003.txt:1: 180 m tall.*centimetres"),
                            ("Pedestrian 0 0 -0.2 0 0 9 9 1.8 0.5 0.9 14 -2 -0.3 0", "000003.txt:1: .*behind the camera.*laser")]:
            self.file("training/label_2/000003.txt", line + "\n")
            self.refused("kitti", words)
        self.assertFalse(self.out.exists())


    def test_openpifpafs_keypoints_make_a_file_for_mpde(self):
        # MonoLoco's preparation: detections and labels of one picture belong together from an IoU of 0.3 on.
        self.file("training/label_2/000003.txt", "Pedestrian 0 0 0 600 100 660 300 1.8 0.5 0.9 0.4 1.7 6.5 0.3\nPedestrian 0 0 0 100 150 130 250 1.7 0.5 0.9 -7 1.6 12 0\n")
        self.file("training/label_2/000004.txt", "Pedestrian 0 0 0 600 100 660 300 1.8 0.5 0.9 0.4 1.7 6.5 0.3\n")
        for name in ("000003", "000004"):
            self.file(f"training/calib/{name}.txt", "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nP2: 721.5 0 609.6 44.9 0 721.5 172.9 0.2 0 0 1 0.003\n")
        self.file("ImageSets/train.txt", "000004\n")
        self.file("ImageSets/val.txt", "000003\n")
        points = [[630 + 25 * math.cos(i), 200 + 95 * math.sin(i), 0.5] for i in range(17)]
        far = [[x + 300, y, c] for x, y, c in points]
        found = [{"keypoints": sum(far, []), "score": 0.9}, {"keypoints": sum(points, []), "score": 0.8}]
        for name in ("000003.png", "000004.png"):
            self.file(f"training/keypoints/{name}.predictions.json", json.dumps(found))
        self.assertEqual(self.convert("kitti"), 3)
        parts = json.loads((self.out / "kitti.json").read_text())
        self.assertEqual([parts[split]["names"] for split in ("train", "val", "test")], [["000004:1"], ["000003:1"], []])
        wanted = [[10 * (x - 609.6) / 721.5, 10 * (y - 172.9) / 721.5] for x, y, _ in points]
        self.assertTrue(np.allclose(np.reshape(parts["val"]["X"][0], (17, 2)), wanted))
        theta, psi, z, r, h, w, l, sin, cos, yaw = parts["val"]["Y"][0]
        self.assertTrue(np.allclose([z, r, h, w, l, yaw], [6.5, math.hypot(0.4, 0.8, 6.5), 0.8, -2.5, 2.2, 0.3]), parts["val"]["Y"])
        self.assertAlmostEqual(math.atan2(sin, cos), 0.3 - math.atan2(0.4, 6.5), 9)
        self.assertAlmostEqual(theta, math.atan2(6.5, 0.4), 9)
        (self.folder / "in/training/keypoints/000004.png.predictions.json").unlink()
        self.refused("kitti", "000004.*OpenPifPaf")
        self.file("training/keypoints/000004.png.predictions.json", json.dumps([{"keypoints": [1, 2, 3]}]))
        self.refused("kitti", "000004.png.predictions.json.*17")


class NuScenes(People):
    def tables(self):
        # The car stands at (100, 50) and looks north; its front camera looks ahead, 1.5 m up. A person 10 m ahead, 2 m to the right, faces the car.
        half = math.sqrt(0.5)
        K = [[1266, 0, 800], [0, 1266, 450], [0, 0, 1]]
        return {"category": [{"token": "c", "name": "human.pedestrian.adult"}, {"token": "d", "name": "vehicle.car"}],
                "instance": [{"token": "i", "category_token": "c"}, {"token": "j", "category_token": "d"}],
                "sensor": [{"token": "s", "channel": "CAM_FRONT"}, {"token": "b", "channel": "CAM_BACK"}, {"token": "l", "channel": "LIDAR_TOP"}],
                "ego_pose": [{"token": "e", "translation": [100, 50, 0], "rotation": [half, 0, 0, half]}],
                "calibrated_sensor": [{"token": "s", "sensor_token": "s", "translation": [0, 0, 1.5], "rotation": [0.5, -0.5, 0.5, -0.5], "camera_intrinsic": K},
                                      {"token": "b", "sensor_token": "b", "translation": [0, 0, 1.5], "rotation": [0.5, -0.5, -0.5, 0.5], "camera_intrinsic": K}],
                "sample_data": [{"token": name, "sample_token": "x", "ego_pose_token": "e", "calibrated_sensor_token": sensor, "is_key_frame": key,
                                 "width": 1600, "height": 900} for name, sensor, key in (("1", "s", True), ("2", "b", True), ("3", "s", False))],
                "sample_annotation": [{"token": "a", "sample_token": "x", "instance_token": "i", "translation": [102, 60, 0.9], "rotation": [half, 0, 0, -half],
                                       "size": [0.6, 0.7, 1.8]},
                                      {"token": "v", "sample_token": "x", "instance_token": "j", "translation": [100, 60, 0.9], "rotation": [1, 0, 0, 0],
                                       "size": [1.9, 4.5, 1.7]}]}

    def write(self, tables):
        for name, rows in tables.items():
            self.file(f"v1.0-mini/{name}.json", json.dumps(rows))

    def test_people_are_put_into_each_camera_that_sees_them(self):
        self.write(self.tables())
        self.assertEqual(self.convert("nuscenes"), 1)
        person = self.persons()["a:CAM_FRONT"]
        self.assertTrue(np.allclose(person["xyz"], [2, 0.6, 10]), person)
        self.assertAlmostEqual(person["yaw_deg"], 90, 6)  # towards -Z: KITTI's rotation of +90 degrees

    def test_openpifpafs_keypoints_make_a_file_for_mpde(self):
        tables = self.tables()
        tables["sample"] = [{"token": "x", "scene_token": "y"}]
        tables["scene"] = [{"token": "y", "name": "scene-0061"}]
        for i, shot in enumerate(tables["sample_data"]):
            shot["filename"] = f"samples/CAM/{i}.jpg"
        self.write(tables)
        self.file("train.txt", "scene-0061\n")
        # The box of the person, 1.8 m tall and 10 m ahead: about 76 x 228 pixels around (1053, 526).
        points = [[1053 + 36 * math.cos(i), 526 + 110 * math.sin(i), 0.5] for i in range(17)]
        self.file("keypoints/0.jpg.predictions.json", json.dumps([{"keypoints": sum(points, []), "score": 0.8}]))
        self.assertEqual(self.convert("nuscenes"), 1)
        part = json.loads((self.out / "nuscenes.json").read_text())["train"]
        self.assertEqual(part["names"], ["a:CAM_FRONT"])
        self.assertTrue(np.allclose(np.reshape(part["X"][0], (17, 2)), [[10 * (x - 800) / 1266, 10 * (y - 450) / 1266] for x, y, _ in points]))
        self.assertTrue(np.allclose([part["Y"][0][i] for i in (2, 3, 4, 5, 6, 9)], [10, math.hypot(2, 0.6, 10), 0.8, -1.5, 0.2, math.pi / 2]), part["Y"])

    def test_missing_tokens_and_other_units_are_named(self):
        tables = self.tables()
        tables["sample_annotation"][0]["size"] = [60, 70, 180]
        self.write(tables)
        self.refused("nuscenes", "sample_annotation a: 180 m tall.*centimetres")
        tables = self.tables()
        tables["sample_annotation"][0]["instance_token"] = "gone"
        self.write(tables)
        self.refused("nuscenes", "no instance.*'gone'")
        self.file("v1.0-mini/instance.json", "[{}]")
        self.refused("nuscenes", "not as the makers")


# A standing person in centimetres by COCO's order: to their left, ahead, up.
BODY = np.array([[0, 8, 165], [3, 7, 168], [-3, 7, 168], [7, 0, 166], [-7, 0, 166], [18, 0, 143], [-18, 0, 143], [22, 0, 115], [-22, 0, 115], [24, 0, 90],
                 [-24, 0, 90], [11, 0, 92], [-11, 0, 92], [11, 0, 50], [-11, 0, 50], [11, 0, 9], [-11, 0, 9]], float)
LEFT_RIGHT = [0, 2, 1, 4, 3, 6, 5, 8, 7, 10, 9, 12, 11, 14, 13, 16, 15]
K = [[1500, 0, 970], [0, 1490, 530], [0, 0, 1]]
DISTORTION = [0.06, -0.1, 0.001, -0.002, 0.02]  # k1, k2, p1, p2, k3
# World: x to the right of the first camera, y away from it, z up. Rotations by hand, from the world to cameras (right, down, ahead), and as vectors:
# c01 at (0, -500, 150) looks along y; c02 at (500, 0, 150) looks along -x.
ROTATIONS = [np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]], float), np.array([[0, 1, 0], [0, 0, -1], [-1, 0, 0]], float)]
VECTORS = [[math.pi / 2, 0, 0], [v * 2 * math.pi / 3 / math.sqrt(3) for v in (1, 1, -1)]]
PLACES = [np.array([0, -500, 150.]), np.array([500, 0, 150.])]


def project(points):
    """OpenCV's model (docs, calib3d): radial k1, k2, k3, tangential p1, p2; one point at a time."""
    k1, k2, p1, p2, k3 = DISTORTION
    pixels = []
    for X, Y, Z in points:
        x, y = X / Z, Y / Z
        r = x * x + y * y
        radial = 1 + k1 * r + k2 * r ** 2 + k3 * r ** 3
        u, v = x * radial + 2 * p1 * x * y + p2 * (r + 2 * x * x), y * radial + p1 * (r + 2 * y * y) + 2 * p2 * x * y
        pixels.append([K[0][0] * u + K[0][2], K[1][1] * v + K[1][2], 0.9])
    return np.array(pixels)


class FreeMan(People):
    """github.com/wangjiongw/FreeMan_API, README and loader: centimetres, COCO's 17 points, pickled dictionaries in one-element arrays."""

    def write(self, session="20220818_857ffafc02_subj22", frames=5, scale=1.0, change=lambda points2d: points2d, layout=lambda entry: np.array([entry], object)):
        base = self.folder / "in/30FPS"
        for name in ("keypoints2d", "keypoints3d", "cameras"):
            (base / name).mkdir(parents=True, exist_ok=True)
        world = np.empty((frames, 17, 3))
        for n in range(frames):
            world[n] = BODY * [1, -1, 1] + [20 * n, 0, 0]  # faces the first camera: their left is its right
        points2d = np.full((8, frames, 17, 3), np.nan)
        for view in range(2):
            for n in range(frames):
                points2d[view, n] = project((ROTATIONS[view] @ (world[n] - PLACES[view]).T).T)
        world[2, 9] = np.nan  # a wrist that was not found
        np.save(base / f"keypoints2d/{session}.npy", layout({"keypoints2d": change(points2d), "center": 0, "scale": 0}), allow_pickle=True)
        np.save(base / f"keypoints3d/{session}.npy", layout({"keypoints3d_optim": world * scale, "name": session}), allow_pickle=True)
        cameras = [{"name": f"c0{i + 1}", "size": [1920, 1080], "matrix": K, "distortions": DISTORTION, "rotation": VECTORS[i],
                    "translation": (-ROTATIONS[i] @ PLACES[i] * scale).tolist()} for i in range(2)]
        (base / f"cameras/{session}.json").write_text(json.dumps(cameras + [{"metadata": {}}]))
        return session

    def monoloco(self):
        return json.loads((self.out / "freeman.json").read_text())

    def test_people_are_in_each_cameras_frame_in_metres(self):
        session = self.write()
        self.assertEqual(self.convert("freeman", every=2), 4)  # frames 0 and 4 of two cameras; 2 has a point that is missing
        persons = self.persons()
        self.assertEqual(sorted(persons), [f"{session}/c0{c}/{n:06}" for c in (1, 2) for n in (0, 4)])
        # The middle of what the points span: 4 cm before the body, 88.5 cm above the ground.
        for n in (0, 4):
            self.assertTrue(np.allclose(persons[f"{session}/c01/{n:06}"]["xyz"], [0.2 * n, 1.5 - 0.885, 5 - 0.04], atol=1e-9))
            self.assertTrue(np.allclose(persons[f"{session}/c02/{n:06}"]["xyz"], [-0.04, 1.5 - 0.885, 5 - 0.2 * n], atol=1e-9))
            self.assertAlmostEqual(persons[f"{session}/c01/{n:06}"]["yaw_deg"], 90, 6)  # towards the camera
            self.assertAlmostEqual(abs(persons[f"{session}/c02/{n:06}"]["yaw_deg"]), 180, 6)  # to its left

    def test_the_other_file_is_in_monolocos_layout(self):
        session = self.write(layout=lambda entry: np.array(entry, object))  # no dimension, as in other copies of the set
        self.convert("freeman", every=4)
        parts = self.monoloco()
        self.assertEqual([len(parts[name]["X"]) for name in ("train", "val", "test")], [0, 4, 0])  # no lists: all to test on
        self.assertEqual(parts["val"]["names"][0], f"{session}/c01/000000")
        camera = (ROTATIONS[0] @ (BODY * [1, -1, 1] - PLACES[0]).T).T
        self.assertTrue(np.allclose(np.reshape(parts["val"]["X"][0], (17, 2)), 10 * camera[:, :2] / camera[:, 2:], atol=1e-6))  # no lens, no K
        theta, psi, z, r, _, _, _, sin, cos, yaw = parts["val"]["Y"][0]
        self.assertAlmostEqual(r, math.hypot(0.615, 4.96), 9)
        self.assertAlmostEqual(z, 4.96, 9)
        self.assertAlmostEqual(r * math.cos(psi), 0.615, 9)
        self.assertAlmostEqual(r * math.sin(psi) * math.cos(theta), 0, 9)
        self.assertAlmostEqual(math.atan2(sin, cos), math.pi / 2, 9)  # straight ahead: the allocentric angle is the yaw
        self.assertAlmostEqual(yaw, math.pi / 2, 9)

    def test_splits_are_the_makers_and_programs_read_them(self):
        names = [self.write(f"2022081{i}_857ffafc02_subj0{i}", frames=9) for i in range(4)]
        base = self.folder / "in/30FPS"
        for name, sessions in (("train.txt", names[:1]), ("validation.txt", [names[1]]), ("test.txt", names[2:]), ("ignore_list.txt", names[3:])):
            (base / name).write_text("".join(session + "\n" for session in sessions))
        self.convert("freeman", every=4)
        parts = self.monoloco()
        for split, session in (("train", names[0]), ("val", names[1]), ("test", names[2])):
            self.assertEqual({name.split("/")[0] for name in parts[split]["names"]}, {session})
        self.assertEqual({name.split("/")[0] for name in self.persons()}, {names[2]})  # of the test alone
        network, predicted, true = self.folder / "net.safetensors", self.folder / "predicted.json", self.folder / "true.json"
        self.run_program("mpde", "train", f"{self.out}/freeman.json:train", "--hidden", 8, "--steps", 20, "--batch", 8, "--out", network)
        report = json.loads(self.run_program("mpde", "eval", f"{self.out}/freeman.json:test", "--networks", network, "--out", predicted, "--truth", true, "--json"))
        self.assertEqual(report["count"], 6)
        distances = [math.hypot(*person["xyz"]) for person in self.persons().values()]
        self.assertTrue(np.allclose([person["distance"] for person in json.loads(true.read_text())], distances))
        report = json.loads(self.run_program("eval", "mpde", self.out / "persons.json", self.out / "persons.json", "--json"))
        self.assertEqual((report["count"], report["distance_mae_m"]), (6, 0))

    def test_units_are_told_by_the_length_of_bodies(self):
        for scale, unit in ((10, "millimetres"), (0.01, "metres")):
            self.write(scale=scale)
            self.refused("freeman", f"keypoints3d/.*subj22.npy.*{unit}")
        self.assertFalse(self.out.exists())

    def test_mirrored_and_exchanged_points_are_told_by_projecting_them(self):
        self.write(change=lambda p: np.concatenate([1919 - p[..., :1], p[..., 1:]], -1))
        self.refused("freeman", "c01.*mirrored")
        self.write(change=lambda p: p[:, :, LEFT_RIGHT])
        self.refused("freeman", "c01.*left and right")
        self.write(change=lambda p: p[[1, 0] + list(range(2, 8))])
        self.refused("freeman", "c01.*do not belong together")
        self.write(change=lambda p: np.concatenate([p[:1], p[1:] + 200], 0))  # one camera alone
        self.refused("freeman", "c02")
        self.assertEqual(self.convert("freeman", every=4, force=True), 2)
        self.assertEqual({name.split("/")[1] for name in self.persons()}, {"c01"})

    def test_what_is_missing_or_of_another_shape_is_named(self):
        session = self.write()
        base = self.folder / "in/30FPS"
        np.save(base / f"keypoints3d/{session}.npy", np.array([{"keypoints3d_optim": np.zeros((5, 14, 3))}], object), allow_pickle=True)
        self.refused("freeman", "keypoints3d_optim.*17")
        np.save(base / f"keypoints3d/{session}.npy", np.zeros((5, 17, 3)))
        self.refused("freeman", "keypoints3d/.*dictionary")
        self.write()
        (base / f"cameras/{session}.json").unlink()
        self.refused("freeman", f"cameras/{session}.json")
        self.write()
        shutil.copytree(base, self.folder / "in/60FPS")
        self.refused("freeman", "30FPS.*60FPS.*one of them")

    def test_a_file_that_would_run_something_is_refused_and_not_run(self):
        class Trap:
            def __reduce__(self):
                return os.mkdir, (str(trapped),)

        trapped = self.folder / "trapped"
        session = self.write()
        np.save(self.folder / f"in/30FPS/keypoints3d/{session}.npy", np.array([Trap()], object), allow_pickle=True)
        self.refused("freeman", "subj22.npy.*mkdir")
        self.assertFalse(trapped.exists())


if __name__ == "__main__":
    unittest.main()
