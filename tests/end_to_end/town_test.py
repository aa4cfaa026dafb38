"""airsim360 world make: a town from words as a world file that the commands open; words that are refused, nothing half written."""
import json
import unittest

from program import ProgramTest


class WorldMakeTest(ProgramTest):
    def test_a_town_from_words_is_opened_by_the_commands(self):
        out = self.folder / "town.yaml"
        made = json.loads(self.run_ok("world", "make", "a tiny stone hamlet on a slope with a church, 150 m by 130 m, 9 houses, 12 people, foggy", "--seed", "3", "--out", out, "--json").stdout)
        self.assertEqual(made["people"], 12)
        self.assertEqual(made["seed"], 3)
        said = {row["words"]: row["as"] for row in made["words"]}
        self.assertEqual(said["church"], "church: true")
        self.assertEqual(said["150 m by 130 m"], "width: 150, depth: 130")
        self.assertEqual(said["a"], "filler")
        text = out.read_text()
        for line in ("world: town", "seed: 3", "weather: fog", "relief: \"slope\"", "houses: 9", "width: 150"):
            self.assertIn(line, text)
        self.assertIn("count: 12", (self.folder / "town.people.yaml").read_text())
        rows = json.loads(self.run_ok("world", "entities", out, "--json").stdout)
        paths = [row["category_path"] for row in rows]
        # Nine houses, and the church of nave and steeple.
        self.assertEqual(paths.count("construction/building"), 11)
        frame = self.folder / "frame"
        self.run_ok("render", "--world", out, "--size", "128x64", "--tier", "labels", "--out", frame)

    def test_the_same_words_and_seed_are_the_same_file(self):
        files = [self.folder / name for name in ("a.yaml", "b.yaml")]
        for file in files:
            self.run_ok("world", "make", "a grid town with a river", "--out", file)
        self.assertEqual(files[0].read_text(), files[1].read_text())

    def test_what_is_not_understood_is_refused_and_nothing_is_written(self):
        out = self.folder / "no.yaml"
        for words, says in (("a town with a chruch", ["chruch", "church"]), ("a flat town on a hill", ["flat", "hill", "exclude"]),
                            ("a town of 9000000 ha", ["144 hectares"]), ("", ["empty"]), ("a town with a marina and no water", ["harbour"]), ("x" * 1001, ["1001"])):
            self.run_bad(2, "world", "make", words, "--out", out, says=says)
        self.run_bad(2, "world", "make", "a town", "--out", self.folder / "town.txt", says=["town.yaml"])
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_no_people_file_of_other_words_is_left(self):
        out, people = self.folder / "town.yaml", self.folder / "town.people.yaml"
        self.run_ok("world", "make", "a crowded town, 4 ha", "--out", out)
        self.assertTrue(people.exists())
        self.run_ok("world", "make", "a deserted town, 4 ha", "--out", out)
        self.assertFalse(people.exists())
        taken = self.folder / "taken.yaml"
        taken.mkdir()
        self.run_bad(2, "world", "make", "a crowded town, 4 ha", "--out", taken, says=["is a folder"])
        self.assertFalse((self.folder / "taken.people.yaml").exists())

    def test_a_town_without_trees_has_none(self):
        out = self.folder / "bare.yaml"
        self.run_ok("world", "make", "village, 3 ha, no trees, no cars", "--out", out)
        rows = json.loads(self.run_ok("world", "entities", out, "--json").stdout)
        self.assertEqual([row["name"] for row in rows if row["category_path"].startswith("vegetation/tree") and row["name"].startswith("way/")], [])

    def test_a_world_file_says_where_its_town_is_wrong(self):
        for text, says in (("world: town\ntown:\n  plan: gird\n", ["plan", "grid"]), ("world: town\ntown:\n  width: 9e9\n", ["width"]), ("world: town\ntown:\n  least_floors: 9\n  most_floors: 3\n", ["least_floors"]),
                           ("world: town\ntown:\n  churches: true\n", ["church"]), ("world: box_room\ntown:\n  church: true\n", ["world town"])):
            file = self.folder / "bad.yaml"
            file.write_text(text)
            self.run_bad(2, "world", "entities", file, says=says)


if __name__ == "__main__":
    unittest.main()
