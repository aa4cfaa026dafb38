"""What an export refuses, and what it never does: change the source, leave halves, depend on threads."""
import shutil
import unittest

from readers import FormatTest, tree

FORMATS = ["omni360", "coco", "coco_entity", "coco_keypoints", "webdataset", "colmap", "nerfstudio", "tum", "euroc", "kitti_odometry", "cityscapes",
           "ade20k", "wildpass", "scannet", "matterport", "stanford2d3d", "mcap", "cryptomatte", "parquet", "vps", "step", "mots", "360vots", "flow", "lerobot", "video"]


class Determinism(FormatTest):
    def test_same_bytes_from_any_number_of_threads_and_the_source_stays(self):
        before = tree(self.data)
        for name in FORMATS:
            if name in ("video", "lerobot") and not shutil.which("ffmpeg"):
                continue
            with self.subTest(name):
                outs = []
                for threads in ("1", "5"):
                    outs.append(self.folder / f"{name}{threads}")
                    self.run_ok("dataset", "export", self.data, "--format", name, "--threads", threads, "--out", outs[-1])
                self.assertEqual(tree(outs[0]), tree(outs[1]))
                self.assertIn("export.json", tree(outs[0]))
        self.assertEqual(tree(self.data), before)


class Refusals(FormatTest):
    COLLECT = ["--tier", "labels"]
    SIZE = (64, 32)

    def bad(self, *words, says, data=None):
        out = self.folder / "out"
        self.run_bad(2, "dataset", "export", data or self.data, *words, "--out", out, says=says)
        self.assertEqual([p for p in self.folder.iterdir() if p.name.startswith("out")], [])

    def test_what_the_dataset_lacks_is_named_with_its_flag(self):
        for name, says in [("omni360", ["--format omni360", "colour", "--tier"]), ("coco_keypoints", ["colour"]), ("flow", ["--tier"]),
                           ("cryptomatte", ["coverage", "--products coverage"])]:
            self.bad("--format", name, says=says)
        colour = self.folder / "colour"
        self.run_ok("render", "--world", "box_room", "--size", "64x32", "--out", colour)
        for name, says in [("coco_keypoints", ["people", "--people"]), ("flow", ["--products flow"]), ("mots", ["--people"]), ("360vots", ["--people"]),
                           ("lerobot", ["two frames", "--frames"])]:
            self.bad("--format", name, data=colour, says=says)
        cube = self.folder / "cube"
        self.run_ok("render", "--world", "box_room", "--projection", "cube", "--size", "32x32", "--out", cube)
        self.bad("--format", "omni360", data=cube, says=["one picture a frame", "--projection cube"])

    def test_unknown_formats_get_the_nearest(self):
        self.bad("--format", "colnap", says=["--format", "colnap", "did you mean 'colmap'"])

    def test_no_dataset(self):
        self.bad("--format", "tum", data=self.folder / "none", says=["none"])
        (self.folder / "empty").mkdir()
        self.bad("--format", "tum", data=self.folder / "empty", says=["not a dataset"])

    def test_targets_that_hold_something_stay_as_they_are(self):
        out = self.folder / "mine"
        out.mkdir()
        (out / "thesis.txt").write_text("words")
        self.run_bad(2, "dataset", "export", self.data, "--format", "parquet", "--out", out, says=["mine", "thesis.txt"])
        self.assertEqual([p.name for p in out.iterdir()], ["thesis.txt"])
        self.run_bad(2, "dataset", "export", self.data, "--format", "parquet", "--out", self.data / "export", says=["inside the dataset"])
        self.assertFalse((self.data / "export").exists())

    def test_damage_is_named_and_nothing_is_left(self):
        data = self.folder / "data"
        shutil.copytree(self.data, data)
        picture = data / "entity" / "000003.png"
        picture.write_bytes(picture.read_bytes()[:-20])
        self.bad("--format", "webdataset", data=data, says=["entity/000003.png", "cut off"])
        lines = (data / "frames.jsonl").read_text().splitlines()
        (data / "frames.jsonl").write_text("\n".join(lines[:5] + [lines[5][:100]]))
        self.bad("--format", "parquet", data=data, says=["frames.jsonl", "cut off"])
        (data / "SHA256SUMS").unlink()
        self.bad("--format", "parquet", data=data, says=["not complete"])

    def test_damage_of_what_describes_the_pictures_is_named(self):
        def broken(name, change, *says):
            data = self.folder / "data"
            shutil.rmtree(data, ignore_errors=True)
            shutil.copytree(self.data, data)
            change(data / name)
            self.bad("--format", "tum", data=data, says=[*says, "airsim360 verify"])
        def flip(path):
            content = bytearray(path.read_bytes())
            content[len(content) // 2] ^= 1
            path.write_bytes(content)
        for name in ("frames.jsonl", "index.sqlite", "entities.json"):
            broken(name, flip, name, "cut off")
        broken("entities.json", lambda path: path.unlink(), "entities.json: missing")
        # A pose that was edited is still JSON.
        broken("frames.jsonl", lambda path: path.write_text(path.read_text().replace('"p"', '"p" ', 1)), "frames.jsonl", "SHA256SUMS")
        broken("SHA256SUMS", lambda path: path.write_text(""), "SHA256SUMS", "meta.json")

    def test_a_read_only_place_is_named(self):
        self.run_bad(1, "dataset", "export", self.data, "--format", "parquet", "--out", "/proc/sys/airsim360_out", says=["/proc/sys: cannot write"])


if __name__ == "__main__":
    unittest.main()
