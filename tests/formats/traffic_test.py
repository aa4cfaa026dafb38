"""vehicles.jsonl against the pictures: labelled pixels lie in the boxes of their vehicles, velocities are differences of places."""
import json
import pathlib
import shutil
import tempfile
import unittest

import numpy as np

from readers import read_exr, read_ids, rotation, run


def rays(width, height):
    """Directions of an equirectangular picture in the camera's frame (docs/reference/frames.md)."""
    theta = 2 * np.pi * ((np.arange(width) + 0.5) / width - 0.5)
    phi = np.pi * (0.5 - (np.arange(height) + 0.5) / height)
    theta, phi = np.meshgrid(theta, phi)
    return np.stack([np.cos(phi) * np.sin(theta), -np.sin(phi), np.cos(phi) * np.cos(theta)], axis=-1)


class Traffic(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.data = cls.folder / "town"
        poses = cls.folder / "poses.csv"
        poses.write_text("t,x,y,z,yaw_deg\n" + "".join(f"{k * 0.2},53,-53,6,90\n" for k in range(4)))
        done = run("collect", "--world", "downtown_west", "--traffic", 150, "--poses", poses, "--size", "512x256", "--tier", "labels", "--out", cls.data)
        assert done.returncode == 0, done.stderr
        cls.frames = [json.loads(line) for line in (cls.data / "frames.jsonl").read_text().splitlines()]
        cls.lines = [json.loads(line) for line in (cls.data / "vehicles.jsonl").read_text().splitlines()]
        cls.entities = [read_ids(cls.data / "entity" / f"{frame['stem']}.png") for frame in cls.frames]
        cls.distances = [read_exr(cls.data / "range" / f"{frame['stem']}.exr")["Y"] for frame in cls.frames]

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_labelled_pixels_lie_in_the_boxes_of_their_vehicles(self):
        seen = 0
        for frame, line, entity, distance in zip(self.frames, self.lines, self.entities, self.distances):
            points = rays(512, 256) * distance[..., None]
            points = points @ rotation(frame["X_WC"]["q_wxyz"]).T + frame["X_WC"]["p"]
            for vehicle in line["vehicles"]:
                here = points[entity == vehicle["entity"]]
                if len(here) < 10:
                    continue
                seen += 1
                inside = (here - vehicle["X_WB"]["p"]) @ rotation(vehicle["X_WB"]["q_wxyz"])
                length, width, height = vehicle["size"]
                self.assertLess(np.abs(inside[:, 0]).max(), length / 2 + 0.02)
                self.assertLess(np.abs(inside[:, 1]).max(), width / 2 + 0.02)
                self.assertLess(inside[:, 2].max(), height + 0.05)
                self.assertGreater(inside[:, 2].min(), -0.05)
        self.assertGreater(seen, 8)

    def test_kitti_labels_are_the_boxes_of_pixels_and_vehicles(self):
        out = self.folder / "kitti"
        done = run("dataset", "export", self.data, "--format", "kitti_object", "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        checked = 0
        for frame, line, entity in zip(self.frames, self.lines, self.entities):
            R_CW, p_WC = rotation(frame["X_WC"]["q_wxyz"]).T, np.array(frame["X_WC"]["p"])
            expected = {}
            for vehicle in line["vehicles"]:
                rows, columns = np.nonzero(entity == vehicle["entity"])
                if len(rows) and np.ptp(columns) < 256:  # those at the seam have a box around it
                    expected[(columns.min(), rows.min(), columns.max(), rows.max())] = vehicle
            labels = [text.split() for text in (out / "label_2" / f"{frame['stem']}.txt").read_text().splitlines()]
            self.assertEqual(len(labels), sum((entity == vehicle["entity"]).any() for vehicle in line["vehicles"]))
            for label in labels:
                vehicle = expected.get(tuple(int(float(x)) for x in label[4:8]))
                if vehicle is None:
                    continue
                checked += 1
                height, width, length, x, y, z, rotation_y = map(float, label[8:])
                np.testing.assert_allclose([length, width, height], vehicle["size"], atol=1e-3)
                np.testing.assert_allclose([x, y, z], R_CW @ (np.array(vehicle["X_WB"]["p"]) - p_WC), atol=1e-3)
                # KITTI turns a car that looks along x of the camera by rotation_y about its y axis, which points down.
                ahead = R_CW @ rotation(vehicle["X_WB"]["q_wxyz"])[:, 0]
                np.testing.assert_allclose([np.cos(rotation_y), -np.sin(rotation_y)], ahead[[0, 2]] / np.hypot(ahead[0], ahead[2]), atol=1e-3)
                turned = rotation_y - float(label[3]) - np.arctan2(x, z)
                self.assertAlmostEqual(np.cos(turned), 1, places=5)
                self.assertEqual(label[0], {"vehicle/car": "Car", "vehicle/van": "Van", "vehicle/truck": "Truck"}.get(vehicle["category"], label[0]))
        self.assertGreater(checked, 8)

    def test_nuscenes_tables_hold_the_boxes_as_its_devkit_reads_them(self):
        out = self.folder / "nuscenes"
        done = run("dataset", "export", self.data, "--format", "nuscenes", "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        tables = {path.stem: json.loads(path.read_text()) for path in (out / "v1.0-airsim360").glob("*.json")}
        self.assertEqual(set(tables), {"category", "attribute", "visibility", "instance", "sensor", "calibrated_sensor", "ego_pose", "log",
                                       "scene", "sample", "sample_data", "sample_annotation", "map"})
        by_token = {name: {row["token"]: row for row in rows} for name, rows in tables.items()}
        for name, rows in tables.items():
            self.assertEqual(len(by_token[name]), len(rows), name)
        # Samples in time, from the scene's first to its last.
        scene, chain = tables["scene"][0], []
        token = scene["first_sample_token"]
        while token:
            chain.append(by_token["sample"][token])
            token = chain[-1]["next"]
        self.assertEqual([sample["timestamp"] * 1000 for sample in chain], [frame["t_ns"] for frame in self.frames])
        self.assertEqual(chain[-1]["token"], scene["last_sample_token"])
        of_sample = {sample["token"]: [] for sample in chain}
        for row in tables["sample_annotation"]:
            of_sample[row["sample_token"]].append(row)
        for sample, frame, line, entity in zip(chain, self.frames, self.lines, self.entities):
            data = [row for row in tables["sample_data"] if row["sample_token"] == sample["token"]]
            pose = by_token["ego_pose"][data[0]["ego_pose_token"]]
            np.testing.assert_allclose(pose["translation"], frame["X_WC"]["p"], atol=1e-9)
            shown = {tuple(np.round(vehicle["velocity"], 5)) + (vehicle["entity"],): vehicle for vehicle in line["vehicles"] if (entity == vehicle["entity"]).any()}
            rows = of_sample[sample["token"]]
            self.assertEqual(len(rows), len(shown))
            middles = {tuple(row["translation"]): row for row in rows}
            for vehicle in shown.values():
                R = rotation(vehicle["X_WB"]["q_wxyz"])
                middle = np.array(vehicle["X_WB"]["p"]) + R[:, 2] * vehicle["size"][2] / 2
                row = min(middles.values(), key=lambda row: np.linalg.norm(middle - row["translation"]))
                np.testing.assert_allclose(row["translation"], middle, atol=1e-6)
                width, length, height = row["size"]
                np.testing.assert_allclose([length, width, height], vehicle["size"], atol=1e-9)
                np.testing.assert_allclose(rotation(row["rotation"]), R, atol=1e-9)
                np.testing.assert_allclose(row["velocity"], vehicle["velocity"], atol=1e-9)
                category = by_token["category"][by_token["instance"][row["instance_token"]]["category_token"]]["name"]
                self.assertEqual(category, {"vehicle/car": "vehicle.car", "vehicle/van": "vehicle.car", "vehicle/truck": "vehicle.truck",
                                            "vehicle/bus": "vehicle.bus.rigid"}.get(vehicle["category"], category))
                attributes = [by_token["attribute"][token]["name"] for token in row["attribute_tokens"]]
                self.assertEqual(attributes, ["vehicle.stopped" if vehicle["stopped"] else "vehicle.moving"])
        # Tracks: the chains of instances hold every box once, and box_velocity of the devkit is what the vehicle drives.
        followed, compared = set(), 0
        for instance in tables["instance"]:
            token, before = instance["first_annotation_token"], None
            rows = []
            while token:
                rows.append(by_token["sample_annotation"][token])
                token = rows[-1]["next"]
            self.assertEqual([len(rows), rows[-1]["token"]], [instance["nbr_annotations"], instance["last_annotation_token"]])
            followed.update(row["token"] for row in rows)
            for before, after in zip(rows, rows[1:]):
                seconds = (by_token["sample"][after["sample_token"]]["timestamp"] - by_token["sample"][before["sample_token"]]["timestamp"]) * 1e-6
                difference = (np.array(after["translation"]) - before["translation"]) / seconds
                mean = (np.array(after["velocity"]) + before["velocity"]) / 2
                self.assertLess(np.linalg.norm(difference - mean), 0.2 + 0.15 * np.linalg.norm(mean))
                compared += 1
        self.assertEqual(followed, set(by_token["sample_annotation"]))
        self.assertGreater(compared, 8)

    def test_lines_tell_lanes_and_near_misses(self):
        lanes = {}
        for line in self.lines:
            self.assertIsInstance(line["near_misses"], list)
            for vehicle in line["vehicles"]:
                # Two on one lane are apart by a length at least.
                lanes.setdefault((line["frame"], vehicle["lane"]), []).append((vehicle["lane_position"], vehicle["size"][0]))
        for places in lanes.values():
            places.sort()
            for (behind, _), (ahead, length) in zip(places, places[1:]):
                self.assertGreater(ahead - length, behind)
        self.assertTrue(any(len(places) > 1 for places in lanes.values()))

    def test_a_survey_counts_what_happens(self):
        flags = ("traffic", "--world", "downtown_west", "--traffic", 150, "--seconds", 20, "--json")
        first, again = json.loads(run(*flags).stdout), json.loads(run(*flags, "--threads", 1).stdout)
        for survey in (first, again):
            self.assertGreater(survey.pop("tick_ms"), 0)
            survey.pop("people_tick_ms")
        self.assertEqual(first, again)
        self.assertEqual((first["vehicles"], first["people"], first["seconds"], first["overlaps"]), (150, 0, 20, 0))
        self.assertEqual(len(first["near_misses"]), first["near_misses_of_vehicles"] + first["near_misses_with_people"])
        for miss in first["near_misses"]:
            self.assertLessEqual(miss["time_to_collision"], 1.5)
            self.assertGreaterEqual(miss["braking"], 3.35)
        done = run("traffic", "--world", "downtown_west", "--traffic", 0)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--traffic", done.stderr)

    def test_kitti_labels_need_traffic(self):
        still = self.folder / "still"
        done = run("collect", "--world", "box_room", "--frames", 1, "--size", "64x32", "--tier", "labels", "--out", still)
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run("dataset", "export", still, "--format", "kitti_object", "--out", self.folder / "none")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--traffic", done.stderr)
        self.assertFalse((self.folder / "none").exists())

    def test_velocities_are_differences_of_places(self):
        moving = 0
        for before, after in zip(self.lines, self.lines[1:]):
            places = {vehicle["name"]: vehicle for vehicle in before["vehicles"]}
            seconds = (after["t_ns"] - before["t_ns"]) * 1e-9
            for vehicle in after["vehicles"]:
                old = places.get(vehicle["name"])
                if old is None:
                    continue
                moved = (np.array(vehicle["X_WB"]["p"]) - old["X_WB"]["p"]) / seconds
                mean = (np.array(vehicle["velocity"]) + old["velocity"]) / 2
                self.assertLess(np.linalg.norm(moved - mean), 0.15 + 0.12 * np.linalg.norm(mean))
                moving += np.linalg.norm(mean) > 2
        self.assertGreater(moving, 20)

    def test_nobody_drives_through_what_stands_there(self):
        for frame, line, entity, distance in zip(self.frames, self.lines, self.entities, self.distances):
            driving = [vehicle["entity"] for vehicle in line["vehicles"]]
            solid = np.isfinite(distance) & ~np.isin(entity, driving)
            points = rays(512, 256)[solid] * distance[solid][:, None] @ rotation(frame["X_WC"]["q_wxyz"]).T + frame["X_WC"]["p"]
            for vehicle in line["vehicles"]:
                inside = (points - vehicle["X_WB"]["p"]) @ rotation(vehicle["X_WB"]["q_wxyz"])
                length, width, height = vehicle["size"]
                # Between the tyres' tread and the roof; mirrors and the slope of the road are allowed for.
                through = (np.abs(inside[:, 0]) < length / 2 - 0.1) & (np.abs(inside[:, 1]) < width / 2 - 0.15) & (inside[:, 2] > 0.35) & (inside[:, 2] < height)
                self.assertEqual(np.count_nonzero(through), 0, vehicle["name"])

    def test_the_same_again_with_one_thread_and_other_traffic_with_another_seed(self):
        first = (self.data / "vehicles.jsonl").read_bytes()
        for flags, same in ((("--threads", 1), True), (("--seed", 9), False)):
            out = self.folder / "again"
            done = run("render", "--world", "downtown_west", "--traffic", 150, *flags, "--pose", "53,-53,6,90", "--size", "64x32", "--tier", "labels", "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            start = json.loads((out / "vehicles.jsonl").read_text())["vehicles"]
            self.assertEqual(start == json.loads(first.splitlines()[0])["vehicles"], same)
            shutil.rmtree(out)

    def test_worlds_without_roads_and_numbers_out_of_range_are_refused(self):
        for arguments, words in ((("--world", "box_room", "--traffic", 3), "no roads"), (("--world", "downtown_west", "--traffic", 19999), "hold"),
                                 (("--world", "downtown_west", "--traffic", -1), "--traffic"), (("--world", "downtown_west", "--traffic", 2 * 10**18), "--traffic")):
            done = run("render", *arguments, "--size", "64x32", "--tier", "labels", "--out", self.folder / "never")
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(words, done.stderr)
            self.assertFalse((self.folder / "never").exists())


if __name__ == "__main__":
    unittest.main()
