"""The card counts what the files show; the page names every product of every frame and needs nothing from elsewhere."""
import json
import re
import unittest

import numpy as np

from readers import FormatTest, read_png, tree


class Card(FormatTest):
    def test_counts_are_those_of_the_pictures(self):
        card = json.loads(self.run_ok("dataset", "card", self.data, "--json").stdout)
        self.assertEqual((card["frames"], card["worlds"], sum(card["heights"]), sum(card["ranges"])),
                         (len(self.frames), {"box_room": len(self.frames)}, len(self.frames), len(self.frames)))
        path = {category["id"]: category["path"] for category in self.meta["categories"]}
        pixels, frames = {}, {}
        for frame in self.frames:
            for value, count in zip(*np.unique(read_png(self.source("semantic", frame)), return_counts=True)):
                pixels[path[value]] = pixels.get(path[value], 0) + int(count)
                frames[path[value]] = frames.get(path[value], 0) + 1
        self.assertEqual({name: c["pixels"] for name, c in card["categories"].items()}, pixels)
        self.assertEqual({name: c["frames"] for name, c in card["categories"].items()}, frames)
        self.assertAlmostEqual(sum(c["solid_angle"] for c in card["categories"].values()), 4 * np.pi * len(self.frames), places=6)
        text = self.run_ok("dataset", "card", self.data).stdout
        self.assertIn(f"| frames | {len(self.frames)} |", text)

    def check_legend(self, sheet):
        """Colour over categories of the frame that shows the most of them, then a swatch for every category of the world."""
        width, height = self.SIZE
        colours = {c["id"]: tuple(c["color"]) for c in self.meta["categories"]}
        seen = [read_png(self.source("semantic", frame)) for frame in self.frames]
        richest = max(range(len(seen)), key=lambda i: len(np.unique(seen[i])))
        top = 24
        np.testing.assert_array_equal(sheet[top:top + height, :width], read_png(self.source("rgb", self.frames[richest])))
        top += height + 4
        drawn = np.array([[colours[v] for v in row] for row in seen[richest]], np.uint8)
        np.testing.assert_array_equal(sheet[top:top + height, :width], drawn)
        swatches = {tuple(pixel) for pixel in sheet[top + height + 4:].reshape(-1, 3)}
        self.assertEqual(swatches - {(0, 0, 0), (255, 255, 255)}, {colours[v] for v in np.unique(np.concatenate(seen))} - {(0, 0, 0), (255, 255, 255)})

    def test_the_page_shows_everything_from_the_folder_alone(self):
        before = tree(self.data)
        page = self.run_ok("dataset", "card", self.data, "--html").stdout.strip()
        text = (self.data / "index.html").read_text()
        self.assertEqual(page, str(self.data / "index.html"))
        self.assertNotRegex(text, r"https?://|src=\"//")
        entries = json.loads(re.search(r"const frames = (\[.*?\]);\n", text, re.S).group(1))
        self.assertEqual([e["stem"] for e in entries], [f["stem"] for f in self.frames])
        for entry in entries:
            self.assertEqual(set(entry["files"]), {"rgb", "range", "semantic", "entity", "normal", "flow", "coverage"})
            for name in entry["files"].values():
                self.assertTrue((self.data / name).is_file(), name)
                self.assertRegex(name, r"\.(png|jpg)$")
        self.assertIn('src="gallery/legend_box_room.png"', text)
        self.check_legend(read_png(self.data / "gallery/legend_box_room.png"))
        after = tree(self.data)
        self.assertEqual({name: after[name] for name in before}, before)
        verified = json.loads(self.run_ok("verify", self.data, "--json").stdout)
        self.assertEqual(verified["damages"], 0)


if __name__ == "__main__":
    unittest.main()
