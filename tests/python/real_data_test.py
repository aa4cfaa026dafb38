"""airsim360.real_data: small folders as the makers of real data sets describe them, against values worked out by hand."""
import json
import math
import pathlib
import shutil
import struct
import sys
import tempfile
import unittest

try:
    import cv2
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(0)

from airsim360 import real_data  # noqa: E402


class RealData(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="airsim360_real_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.out = self.folder / "out"

    def file(self, name, data=b""):
        path = self.folder / "in" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
        return path

    def convert(self, kind):
        return real_data.convert(kind, self.folder / "in", self.out)

    def refused(self, kind, words):
        with self.assertRaisesRegex(ValueError, words):
            self.convert(kind)

    def persons(self):
        return {person["id"]: person for person in json.loads((self.out / "persons.json").read_text())["persons"]}

    def test_densepass_labels_keep_their_ids(self):
        ids = np.array([[0, 18, 255], [10, 11, 13]], np.uint8)
        cv2.imwrite(str(self.file("gtFine/val/cs/7_labelTrainIds.png")), ids)
        self.assertEqual(self.convert("densepass"), 1)
        self.assertTrue((cv2.imread(str(self.out / "labels/7.png"), -1) == ids).all())
        self.assertEqual((self.out / "classes.txt").read_text().splitlines()[13], "13 car")
        cv2.imwrite(str(self.file("gtFine/val/cs/8_labelTrainIds.png")), ids + 1)
        self.refused("densepass", "8_labelTrainIds.png: must have one channel")

    def test_stanford_has_512_steps_a_metre_and_classes_by_name(self):
        name = "area_1/pano/{0}/camera_a_hall_1_frame_equirectangular_domain_{0}.png"
        cv2.imwrite(str(self.file(name.format("depth"))), np.array([[512, 65535], [1, 1280]], np.uint16))
        bgr = np.zeros((2, 2, 3), np.uint8)
        bgr[0, 1] = (1, 0, 0)    # blue is the lowest byte: entry 1
        bgr[1, 0] = (2, 0, 0)
        bgr[1, 1] = (0, 1, 0)    # 256: beyond the list
        cv2.imwrite(str(self.file(name.format("semantic"))), bgr)
        self.file("assets/semantic_labels.json", json.dumps(["<UNK>", "wall_1_hall_1_area_1", "beam_3_hall_1_area_1"]))
        self.assertEqual(self.convert("stanford2d3d"), 1)
        stem = "camera_a_hall_1_frame_equirectangular_domain"
        self.assertTrue(np.allclose(np.load(self.out / f"depth/{stem}.npy"), [[1, 0], [1 / 512, 2.5]]))
        self.assertEqual((self.out / "classes.txt").read_text(), "0 beam\n1 wall\n")
        self.assertEqual(cv2.imread(str(self.out / f"labels/{stem}.png"), -1).tolist(), [[255, 1], [0, 255]])

    def test_deep360_leaves_out_what_is_beyond_a_kilometre(self):
        np.savez(self.file("ep1_500frames/testing/depth/000001_depth.npz"), np.array([[3.5, 1000], [1000.5, 0.1]], np.float32))
        self.assertEqual(self.convert("deep360"), 1)
        self.assertTrue(np.allclose(np.load(self.out / "depth/ep1_500frames_testing_depth_000001.npy"), [[3.5, 1000], [0, 0.1]]))

    def test_matterport_depth_files_are_read_and_damaged_ones_refused(self):
        data = struct.pack("<fii", 202021.25, 2, 1) + struct.pack("<2f", 4.25, -1)
        self.file("scene/0_depth.dpt", data)
        self.convert("matterport3d360")
        self.assertEqual(np.load(self.out / "depth/0_depth.npy").tolist(), [[4.25, 0]])
        for damaged in (b"", data[:-1], struct.pack("<fii", 1.0, 2, 1) + data[12:], struct.pack("<fii", 202021.25, 1 << 30, 1 << 30), struct.pack("<fii", 202021.25, -2, -1)):
            self.file("scene/0_depth.dpt", damaged)
            self.refused("matterport3d360", "0_depth.dpt")

    def test_kitti_people_are_as_far_as_the_middle_of_their_boxes(self):
        self.file("training/label_2/000003.txt", "Car 0 0 1 0 0 9 9 1.5 1.6 4 1 1.6 20 0\nPedestrian 0 0 -0.2 0 0 9 9 1.8 0.5 0.9 2 1.7 14 -1.57079632679\n")
        self.assertEqual(self.convert("kitti"), 1)
        person = self.persons()["000003:2"]
        self.assertTrue(np.allclose(person["xyz"], [2, 0.8, 14]))
        self.assertAlmostEqual(person["yaw_deg"], -90, 6)
        self.file("training/label_2/000003.txt", "Pedestrian 0 0 1.8\n")
        self.refused("kitti", "000003.txt:1: must have 15")

    def test_nuscenes_people_are_put_into_each_camera_that_sees_them(self):
        # The car stands at (100, 50) and looks north; its front camera looks ahead, 1.5 m up. A person 10 m ahead, 2 m to the right, faces the car.
        half = math.sqrt(0.5)
        tables = {"category": [{"token": "c", "name": "human.pedestrian.adult"}, {"token": "d", "name": "vehicle.car"}],
                  "instance": [{"token": "i", "category_token": "c"}, {"token": "j", "category_token": "d"}],
                  "sensor": [{"token": "s", "channel": "CAM_FRONT"}, {"token": "b", "channel": "CAM_BACK"}, {"token": "l", "channel": "LIDAR_TOP"}],
                  "ego_pose": [{"token": "e", "translation": [100, 50, 0], "rotation": [half, 0, 0, half]}],
                  "calibrated_sensor": [{"token": "s", "sensor_token": "s", "translation": [0, 0, 1.5], "rotation": [0.5, -0.5, 0.5, -0.5],
                                         "camera_intrinsic": [[1266, 0, 800], [0, 1266, 450], [0, 0, 1]]},
                                        {"token": "b", "sensor_token": "b", "translation": [0, 0, 1.5], "rotation": [0.5, -0.5, -0.5, 0.5],
                                         "camera_intrinsic": [[1266, 0, 800], [0, 1266, 450], [0, 0, 1]]}],
                  "sample_data": [{"token": name, "sample_token": "x", "ego_pose_token": "e", "calibrated_sensor_token": sensor, "is_key_frame": key,
                                   "width": 1600, "height": 900} for name, sensor, key in (("1", "s", True), ("2", "b", True), ("3", "s", False))],
                  "sample_annotation": [{"token": "a", "sample_token": "x", "instance_token": "i", "translation": [102, 60, 0.9], "rotation": [half, 0, 0, -half]},
                                        {"token": "v", "sample_token": "x", "instance_token": "j", "translation": [100, 60, 0.9], "rotation": [1, 0, 0, 0]}]}
        for name, rows in tables.items():
            self.file(f"v1.0-mini/{name}.json", json.dumps(rows))
        self.assertEqual(self.convert("nuscenes"), 1)
        person = self.persons()["a:CAM_FRONT"]
        self.assertTrue(np.allclose(person["xyz"], [2, 0.6, 10]), person)
        self.assertAlmostEqual(person["yaw_deg"], 90, 6)  # towards -Z: KITTI's rotation of +90 degrees
        (self.folder / "in/v1.0-mini/instance.json").write_text("[{}]")
        self.refused("nuscenes", "not as the makers")

    def test_what_is_not_there_is_named(self):
        with self.assertRaisesRegex(ValueError, "kiti.*kitti"):
            real_data.convert("kiti", self.folder, self.out)
        self.assertEqual(real_data.main(["kitti", str(self.folder / "none"), "--out", str(self.out)]), 2)
        self.refused("kitti", "no such folder")
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
