"""`world export` writes a file that opens again as the same world."""
import unittest

from program import ProgramTest, tree


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


if __name__ == "__main__":
    unittest.main()
