"""airsim360 mpde: people of a dataset, a network of them, its errors, and what is refused."""
import json
import math
import struct
import tempfile
import unittest
import pathlib

from program import run


class MpdeTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.people = cls.folder / "people"
        done = run("collect", "--world", "box_room", "--people", 5, "--frames", 2, "--size", "128x64", "--tier", "labels", "--out", cls.people)
        assert done.returncode == 0, done.stderr
        cls.model = cls.folder / "model.safetensors"
        cls.flags = ("--views", "kitti", "--hidden", 16, "--stages", 1, "--steps", 60, "--batch", 64, "--seed", 3)
        done = run("mpde", "train", cls.people, *cls.flags, "--out", cls.model, "--json")
        assert done.returncode == 0, done.stderr
        cls.trained = json.loads(done.stdout)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_the_file_is_safetensors_with_as_many_numbers_as_reported(self):
        data = self.model.read_bytes()
        size = struct.unpack("<Q", data[:8])[0]
        header = json.loads(data[8:8 + size])
        learned = [name for name in header if name != "__metadata__" and "running" not in name]
        self.assertEqual(sum(math.prod(header[name]["shape"]) for name in learned), self.trained["parameters"])
        self.assertEqual(max(entry["data_offsets"][1] for name, entry in header.items() if name != "__metadata__"), len(data) - 8 - size)

    def test_the_same_seed_gives_the_same_bytes_with_any_number_of_threads(self):
        again = self.folder / "again.safetensors"
        self.assertEqual(run("mpde", "train", self.people, *self.flags, "--threads", 1, "--out", again).returncode, 0)
        self.assertEqual(again.read_bytes(), self.model.read_bytes())

    def test_errors_are_those_of_the_written_predictions(self):
        predicted, true = self.folder / "predicted.json", self.folder / "true.json"
        done = run("mpde", "eval", self.people, "--views", "kitti", "--views-count", 200, "--networks", self.model, "--out", predicted, "--truth", true, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads(done.stdout)
        pairs = list(zip(json.loads(predicted.read_text()), json.loads(true.read_text())))
        self.assertEqual(len(pairs), 200)
        self.assertAlmostEqual(report["distance_mae_m"], sum(abs(p["distance"] - t["distance"]) for p, t in pairs) / 200, places=9)
        wrapped = [abs((p["angle_deg"] - t["angle_deg"] + 180) % 360 - 180) for p, t in pairs]
        self.assertAlmostEqual(report["angle_mae_deg"], sum(wrapped) / 200, places=6)
        self.assertEqual(sum(group["count"] for group in report["groups"]), 200)

    def test_what_makes_no_sense_is_refused_by_name(self):
        for arguments, word in [((self.people, "--views", "kity"), "kitti"), ((self.people,), "--views"), ((f"{self.people}@0", "--views", "kitti"), "share"),
                                ((self.folder / "none.json",), "none.json"), ((self.people, "--views", "kitti", "--convention", "anatomi"), "anatomy"),
                                ((self.people, "--views", "kitti", "--steps", 0), "steps")]:
            done = run("mpde", "train", *arguments, "--out", self.folder / "never")
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(word, done.stderr)
            self.assertFalse((self.folder / "never").exists())
        done = run("mpde", "eval", self.people, "--views", "kitti", "--networks", self.people / "people.jsonl")
        self.assertEqual(done.returncode, 2)
        views = self.folder / "near.yaml"
        for text, word in [("nearest: 50\nfarthest: 5\n", "farthest"), ("like: kity\n", "kitti")]:
            views.write_text(text)
            done = run("mpde", "train", self.people, "--views", views, "--out", self.folder / "never")
            self.assertEqual(done.returncode, 2)
            self.assertIn(str(views), done.stderr)
            self.assertIn(word, done.stderr)
        self.assertEqual(run("mpde", "train", f"{self.people}#0", "--views", "kitti", "--out", self.folder / "never").returncode, 2)

    def test_a_place_for_the_network_is_found_before_it_is_trained(self):
        small = ("--views", "kitti", "--hidden", 4, "--steps", 2, "--batch", 8)
        (self.folder / "file").write_text("")
        for out, status in [(self.folder, 2), (self.folder / "file" / "net", 1)]:
            done = run("mpde", "train", self.people, *small, "--out", out)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertNotIn("step", done.stderr)
        new = self.folder / "new" / "folder" / "net.safetensors"
        self.assertEqual(run("mpde", "train", self.people, *small, "--out", new).returncode, 0)
        self.assertTrue(new.exists())


if __name__ == "__main__":
    unittest.main()
