"""The disk cache, through the real program: the same bytes with and without it, and nothing on the disk can fail a run."""
import os
import unittest

from program import ProgramTest, run


class Cache(ProgramTest):
    def setUp(self):
        super().setUp()
        self.cache = self.folder / "cache"
        before = os.environ.get("AIRSIM360_CACHE")
        self.addCleanup(lambda: os.environ.pop("AIRSIM360_CACHE") if before is None else os.environ.update(AIRSIM360_CACHE=before))
        os.environ["AIRSIM360_CACHE"] = str(self.cache)

    def shoot(self, name, *flags, world="box_room"):
        """Bytes of colours, distances and entities, and what the program said but for its progress, which takes time."""
        out = self.folder / name
        result = run("render", "--world", world, "--size", "64x32", *flags, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        return [(out / file).read_bytes() for file in ("rgb/000000.png", "range/000000.exr", "entity/000000.png")], "".join(line for line in result.stderr.splitlines(True) if not line.startswith(("building ", "lighting ")))

    def entries(self):
        return sorted(self.cache.iterdir()) if self.cache.is_dir() else []

    def test_pictures_do_not_depend_on_the_cache(self):
        # Cirrus alone is soon made, and casts shadows, which a sky keeps too.
        flags = "--clouds", "cirrus"
        fresh = self.shoot("off", *flags, "--no-cache", world="sunlit_room")
        self.assertEqual(self.entries(), [])
        self.assertEqual(self.shoot("first", *flags, world="sunlit_room"), fresh)
        kinds = [entry.name.split("-")[0] for entry in self.entries()]
        self.assertEqual(kinds, ["indoor_light", "light_probes", "scene", "sky"])
        times = [entry.stat().st_ino for entry in self.entries()]
        self.assertEqual(self.shoot("second", *flags, world="sunlit_room"), fresh)
        self.assertEqual([entry.stat().st_ino for entry in self.entries()], times, "written again")

    def test_a_sky_is_kept_whatever_stands_below_it(self):
        model = self.folder / "field.obj"
        model.write_text("v -50 0 50\nv 50 0 50\nv 50 0 -50\nv -50 0 -50\nf 1 2 3 4\n")
        flags = "--pose", "0,0,2", "--clouds", "clear"
        fresh = self.shoot("off", *flags, "--no-cache", world=model)
        self.assertEqual(self.shoot("first", *flags, world=model), fresh)
        kept = [(entry.name, entry.stat().st_ino) for entry in self.entries()]
        self.assertEqual([name.split("-")[0] for name, _ in kept], ["sky"])
        self.assertEqual(self.shoot("second", *flags, world=model), fresh)
        self.assertEqual([(entry.name, entry.stat().st_ino) for entry in self.entries()], kept, "written again")

    def test_other_light_and_another_seed_are_other_entries(self):
        self.shoot("first")
        count = len(self.entries())
        self.shoot("lamps", "--environment", "lamps=on")
        self.assertGreater(len(self.entries()), count)
        self.assertEqual(sum(entry.name.startswith("scene-") for entry in self.entries()), 1)
        self.shoot("seed", "--seed", "1")
        self.assertEqual(sum(entry.name.startswith("scene-") for entry in self.entries()), 2)

    def test_damaged_entries_are_made_again_with_one_warning(self):
        good, _ = self.shoot("first")
        self.assertGreater(len(self.entries()), 1)
        whole = [entry.read_bytes() for entry in self.entries()]
        for entry in self.entries():
            data = bytearray(entry.read_bytes())
            data[len(data) // 2] ^= 1
            entry.write_bytes(data)
        again, said = self.shoot("again")
        self.assertEqual(again, good)
        self.assertEqual(said.count("damaged"), 1, said)
        self.assertEqual([entry.read_bytes() for entry in self.entries()], whole)

    def test_a_folder_that_cannot_be_made_is_one_warning(self):
        good, _ = self.shoot("off", "--no-cache")
        self.cache.write_text("a file in its place")
        again, said = self.shoot("again")
        self.assertEqual(again, good)
        self.assertEqual(said.count("warning: cache:"), 1, said)


if __name__ == "__main__":
    unittest.main()
