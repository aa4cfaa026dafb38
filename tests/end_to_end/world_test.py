"""`world export`, `import`, `entities`: files that open again as the same world, and tables of what they hold."""
import csv
import io
import json
import unittest

from program import ROOT, ProgramTest, read_png, tree


class WorldTest(ProgramTest):
    def render(self, world, name):
        out = self.folder / name
        self.run_ok("render", "--world", world, "--pose", "0.5,-0.3,1.7,20,-5,3", "--size", "256x128", "--tier", "labels", "--out", out)
        return out

    def test_exported_world_renders_to_the_same_labels(self):
        glb = self.folder / "room.glb"
        self.run_ok("world", "export", "box_room", "--out", glb)
        before, after = tree(self.render("box_room", "a")), tree(self.render(glb, "b"))
        for product in ("range", "semantic", "entity"):
            file = next(path for path in before if path.startswith(product))
            self.assertEqual(before[file], after[file], product)

    def test_other_endings_are_refused_with_the_right_one(self):
        self.run_bad(2, "world", "export", "box_room", "--out", self.folder / "room.gltf", says=["room.glb"])
        self.assertFalse((self.folder / "room.gltf").exists())

    def test_a_map_is_a_world_and_survives_the_way_through_gltf(self):
        osm = ROOT / "data/osm/crossing.osm"
        glb = self.folder / "crossing.glb"
        report = json.loads(self.run_ok("world", "import", osm, "--out", glb, "--json", "--buildings").stdout)
        self.assertEqual(report["buildings"]["ways"], 17)
        self.assertEqual(report["buildings"]["relations"], 1)
        self.assertEqual(report["buildings"]["nodes"], 1)
        heights = {b["id"]: b["height"] for b in report["buildings"]["list"]}
        self.assertEqual(heights["way/10"], 9)
        # The same entities, by name and category, from the map and from the exported file.
        def table(world):
            return {(e["name"], e["category_path"]) for e in json.loads(self.run_ok("world", "entities", world, "--json").stdout)}
        self.assertEqual(table(osm), table(glb))
        rows = list(csv.DictReader(io.StringIO(self.run_ok("world", "entities", osm, "--csv").stdout)))
        lamp = next(row for row in rows if row["name"] == "node/220")
        self.assertEqual(lamp["category_path"], "furniture/lighting/street_light")
        self.assertAlmostEqual(float(lamp["x"]), 10, delta=1.5)

    def test_an_exported_map_comes_back_as_the_same_picture(self):
        world, glb = self.folder / "town.yaml", self.folder / "town.glb"
        world.write_text(f"world: {ROOT / 'data/osm/crossing.osm'}\nenvironment: {{sun_azimuth_deg: 120, cloud_cover: 0.7, wetness: 0.4}}\n")
        self.run_ok("world", "export", world, "--out", glb)
        rows = [json.loads(self.run_ok("world", "entities", w, "--json").stdout) for w in (world, glb)]
        self.assertEqual([(e["id"], e["name"], e["category_path"]) for e in rows[0]], [(e["id"], e["name"], e["category_path"]) for e in rows[1]])
        poses = self.folder / "poses.csv"
        poses.write_text("x,y,z,yaw_deg,pitch_deg\n0,-20,12,60,-20\n15,5,1.7,200,0\n")
        pictures = []
        for name, w in (("a", world), ("b", glb)):
            self.run_ok("collect", "--world", w, "--poses", poses, "--size", "512x256", "--tier", "fast", "--out", self.folder / name)
            pictures.append(tree(self.folder / name))
        for number in range(2):
            files = [path for path in pictures[0] if f"/{number:06d}." in path and path.split("/")[0] in ("range", "semantic", "entity")]
            self.assertEqual(len(files), 3, number)
            for file in files:
                self.assertEqual(pictures[0][file], pictures[1][file], file)
            # Single leaves and blades take their shade from the number of their triangle, which an export does not keep.
            rows = [b"".join(read_png(self.folder / name / f"rgb/{number:06d}.png")[4]) for name in "ab"]
            apart = [abs(a - b) for a, b in zip(*rows)]
            self.assertLess(sum(apart) / len(apart), 0.6, number)
            self.assertLess(sum(d > 2 for d in apart) / len(apart), 0.08, number)

    def test_models_take_scale_up_ground_and_offset(self):
        model = self.folder / "car.obj"
        model.write_text("o car\nv 0 0 10\nv 450 0 10\nv 450 180 10\nv 0 0 160\nf 1 2 3\nf 1 2 4\n")
        self.assertIn("centimetres: use scale: 0.01", self.run_ok("world", "import", model).stderr)
        world = self.folder / "lot.yaml"
        told = self.run_ok("world", "import", model, "--scale", "0.01", "--up", "z", "--ground", "--offset", "3,0,0.5", "--out", world)
        self.assertNotIn("use scale", told.stderr)
        rows = {e["name"]: e for e in json.loads(self.run_ok("world", "entities", world, "--json").stdout)}
        for low, high, expected in zip(rows["car"]["box"]["min"], rows["car"]["box"]["max"], ((3, 7.5), (0, 1.8), (0.5, 2))):
            self.assertAlmostEqual(low, expected[0], 5)
            self.assertAlmostEqual(high, expected[1], 5)
        self.assertEqual(rows["plain"]["category_path"], "ground/terrain/landscape")
        for key, says in (("scale: 0", "scale"), ("scale: 1e9", "scale"), ("up: w", "'w'"), ("offset: {x: 1e7}", "x"), ("scales: 1", "'scale'")):
            world.write_text(f"world: car.obj\n{key}\n")
            self.run_bad(2, "world", "entities", world, says=["lot.yaml", says])
        self.run_bad(2, "world", "import", model, "--scale", "-1", says=["--scale", "-1"])
        self.run_bad(2, "world", "import", model, "--light", "bakt", says=["--light", "'bakt'", "baked"])
        self.run_ok("world", "import", model, "--light", "baked", "--out", world)
        self.assertIn("\nlight: baked\n", world.read_text())
        self.run_ok("world", "entities", world)
        world.write_text("world: box_room\nscale: 2\n")
        self.run_bad(2, "world", "entities", world, says=["model files"])

    def test_files_of_a_model_are_found_whatever_the_case_of_their_names(self):
        (self.folder / "Parts").mkdir()
        (self.folder / "quad.obj").write_text("mtllib COLOURS.MTL\nv -1 3 -1\nv 1 3 -1\nv 1 3 1\nv -1 3 1\nusemtl a\nf 1 2 3 4\n")
        (self.folder / "Parts" / "colours.mtl").write_text("newmtl a\nKd 0.2 0.5 0.05\n")

        def warnings(reference):
            (self.folder / "quad.obj").write_text((self.folder / "quad.obj").read_text().replace("COLOURS.MTL", reference))
            return self.run_ok("render", "--world", self.folder / "quad.obj", "--no-cache", "--tier", "labels", "--size", "64x32", "--pose", "0,0,0", "--out",
                               self.folder / reference.replace("/", "_")).stderr
        self.assertIn("missing", warnings("COLOURS.MTL"))
        self.assertNotIn("missing", warnings("PARTS/Colours.MTL"))

    def test_formats_that_are_not_read_say_so(self):
        for name, says in (("a.las", "point cloud"), ("a.skp", "SketchUp"), ("a.geojson", "CityJSON"), ("a.qqq", "'.qqq'")):
            (self.folder / name).write_text("x")
            for words in (("world", "import"), ("world", "entities")):
                self.run_bad(2, *words, self.folder / name, says=[name, says, ".glb"])
        world = self.folder / "w.yaml"
        world.write_text("world: a.las\n")
        self.run_bad(2, "world", "entities", world, says=["a.las", "point cloud"])

    def test_label_files_change_categories_of_any_world(self):
        labels = self.folder / "mine.labels.yaml"
        labels.write_text("rules:\n  - match: way/10*\n    category: construction/house/gabled\n  - match: 'node/22?'\n    category: furniture/misc\n")
        world = self.folder / "town.yaml"
        world.write_text(f"world: {ROOT / 'data/osm/crossing.osm'}\nlabels: mine.labels.yaml\nfill: false\n")
        rows = {e["name"]: e["category_path"] for e in json.loads(self.run_ok("world", "entities", world, "--json").stdout)}
        self.assertEqual(rows["way/10 Gable House"], "construction/house/gabled")
        self.assertEqual(rows["node/220"], "furniture/misc")

    def test_every_command_that_opens_a_world_takes_a_label_file(self):
        labels = self.folder / "mine.labels.yaml"
        labels.write_text("rules:\n  - match: wall*\n    category: construction/wall/padded\n")
        shot = self.folder / "shot"
        small = ("--world", "box_room", "--size", "64x32", "--tier", "labels", "--labels", labels)
        runs = {
            shot: self.run_ok("render", *small, "--pose", "0,0,2", "--out", shot),
            self.folder / "set": self.run_ok("collect", *small, "--frames", "1", "--out", self.folder / "set"),
            self.folder / "flight/frames": self.run_ok("fly", *small, "--frames", "1", "--out", self.folder / "flight"),
        }
        for folder in runs:
            paths = [e["category_path"] for e in json.loads((folder / "entities.json").read_text()).values()]
            self.assertIn("construction/wall/padded", paths, folder)
        # Another label file makes another dataset.
        labels.write_text("rules:\n  - match: wall*\n    category: construction/wall/bare\n")
        self.run_bad(2, "collect", *small, "--frames", "1", "--out", self.folder / "set", says=["--out", "labels"])
        self.run_bad(2, "render", *small[:-1], self.folder / "none.yaml", "--out", self.folder / "x", says=["--labels", "none.yaml"])
        rows = json.loads(self.run_ok("world", "entities", "box_room", "--labels", labels, "--json").stdout)
        self.assertIn("construction/wall/bare", [e["category_path"] for e in rows])

    def test_damaged_maps_are_told_with_their_place(self):
        bad = self.folder / "bad.osm"
        bad.write_text("<osm version='0.6'>\n<node id='1' lat='1' lon='1'></way></osm>")
        self.run_bad(2, "world", "import", bad, says=["bad.osm:2:"])
        self.run_bad(2, "render", "--world", bad, "--pose", "0,0,2", "--out", self.folder / "x", says=["bad.osm:2:"])
        self.run_bad(2, "world", "import", self.folder / "none.osm.pbf", says=["none.osm.pbf"])
        city = self.folder / "bad.city.json"
        city.write_text('{"type": "CityJSON", "version": "2.0"}')
        self.run_bad(2, "world", "import", city, says=["bad.city.json", "vertices"])


if __name__ == "__main__":
    unittest.main()
