"""Class pictures: built-in content has ids below 256, pictures are 8 bit with a palette, and everything else agrees with them."""
import pathlib
import re
import struct
import unittest

from program import ROOT, ProgramTest, read_gray, read_json, read_png


def png_header(path):
    """(bit depth, colour type, palette) of a PNG; 3 is a palette, 0 gray."""
    data = pathlib.Path(path).read_bytes()
    at, palette = 8, None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            depth, colour = data[at + 16], data[at + 17]
        if kind == b"PLTE":
            palette = [tuple(data[at + 8 + i:at + 11 + i]) for i in range(0, length, 3)]
        at += 12 + length
    return depth, colour, palette


OSM = """<osm version="0.6">
 <node id="1" lat="52.5000" lon="13.4000"/><node id="2" lat="52.5006" lon="13.4000"/>
 <node id="3" lat="52.5006" lon="13.4010"/><node id="4" lat="52.5000" lon="13.4010"/>
 <node id="5" lat="52.5001" lon="13.4002"/><node id="6" lat="52.5003" lon="13.4002"/>
 <node id="7" lat="52.5003" lon="13.4004"/><node id="8" lat="52.5001" lon="13.4004"/>
 <node id="9" lat="52.5004" lon="13.4006"><tag k="man_made" v="mast"/></node>
 <way id="1"><nd ref="1"/><nd ref="3"/><tag k="railway" v="rail"/></way>
 <way id="2"><nd ref="2"/><nd ref="4"/><tag k="highway" v="residential"/></way>
 <way id="3"><nd ref="5"/><nd ref="6"/><nd ref="7"/><nd ref="8"/><nd ref="5"/><tag k="building:part" v="yes"/><tag k="height" v="8"/></way>
</osm>
"""


class LabelTest(ProgramTest):
    def render(self, name, *flags):
        out = self.folder / name
        self.run_ok("render", *flags, "--tier", "labels", "--size", "64x32", "--out", out)
        return out

    def test_every_category_that_sources_of_built_in_content_name_is_built_in(self):
        tree = {c["path"]: c["id"] for c in read_json(self.render("room", "--world", "box_room") / "meta.json")["categories"]}
        roots = {path.split("/")[0] for path in tree}
        named = {}
        for module in ("worlds", "people", "sim", "assets", "scene"):
            for source in (ROOT / "src/airsim360" / module).rglob("*.*"):
                if source.suffix not in (".cc", ".h") or re.search("_(test|fuzz|bench)[.]", source.name):
                    continue
                for path in re.findall(r'"([a-z0-9_]+(?:/[a-z0-9_]+)+)"', source.read_text()):
                    if path.split("/")[0] in roots:
                        named.setdefault(path, source.name)
        self.assertGreater(len(named), 100)
        self.assertEqual({path: source for path, source in named.items() if tree.get(path, 256) > 255}, {})

    def test_people_with_their_things_leave_class_pictures_at_8_bits(self):
        out = self.render("crowd", "--world", "box_room", "--people", "60")
        self.assertEqual(png_header(out / "semantic/000000.png")[:2], (8, 3))
        self.run_ok("verify", out)

    def test_masts_rails_and_parts_of_mapped_buildings_are_built_in(self):
        (self.folder / "town.osm").write_text(OSM)
        out = self.render("town", "--world", self.folder / "town.osm")
        self.assertEqual(png_header(out / "semantic/000000.png")[:2], (8, 3))

    def test_the_palette_is_the_colours_of_meta_and_panoptic(self):
        out = self.render("room", "--world", "box_room")
        depth, colour, palette = png_header(out / "semantic/000000.png")
        self.assertEqual((depth, colour), (8, 3))
        categories = read_json(out / "meta.json")["categories"]
        for category in categories:
            self.assertEqual(palette[category["id"]], tuple(category["color"]))
        self.assertEqual(len({tuple(c["color"]) for c in categories}), len(categories))
        for category in read_json(out / "panoptic.json")["categories"]:
            self.assertEqual(palette[category["id"]], tuple(category["color"]))

    def test_custom_categories_alone_need_16_bits(self):
        (self.folder / "labels.yaml").write_text("rules:\n  - {match: box, category: furniture/box/gift}\n")
        out = self.render("room", "--world", "box_room", "--labels", self.folder / "labels.yaml", "--pose", "0,0,1")
        self.assertEqual(png_header(out / "semantic/000000.png")[:2], (16, 0))
        paths = {c["id"]: c["path"] for c in read_json(out / "meta.json")["categories"]}
        seen = {paths[i] for row in read_gray(out / "semantic/000000.png") for i in row}
        self.assertIn("furniture/box/gift", seen)

    def test_stitched_class_pictures_keep_ids_and_palette(self):
        cube = self.folder / "cube"
        self.run_ok("render", "--world", "box_room", "--pose", "0,0,2", "--projection", "cube", "--size", "64x64", "--tier", "labels",
                    "--out", cube)
        self.run_ok("stitch", "--cube", cube / "semantic", "--size", "64x32", "--out", self.folder / "whole.png")
        whole = self.render("whole", "--world", "box_room", "--pose", "0,0,2")
        self.assertEqual(png_header(self.folder / "whole.png"), png_header(whole / "semantic/000000.png"))
        pairs = list(zip(sum(read_gray(self.folder / "whole.png"), []), sum(read_gray(whole / "semantic/000000.png"), [])))
        self.assertEqual({a for a, _ in pairs}, {b for _, b in pairs})
        self.assertGreater(sum(a == b for a, b in pairs), 0.95 * len(pairs))

    def test_the_contact_sheet_has_a_legend_in_the_palette_of_the_pictures(self):
        out = self.render("room", "--world", "box_room")
        width, height, _, _, rows = read_png(out / "contact_sheet.png")
        self.assertGreater(height, 24 + 32 + 30)  # titles, one row of pictures, legend
        below = {bytes(row[3 * x:3 * x + 3]) for row in rows[24 + 32 + 4 + 32:] for x in range(width)}
        colours = {tuple(c["color"]) for c in read_json(out / "panoptic.json")["categories"]}
        self.assertLessEqual({bytes(c) for c in colours}, below)


if __name__ == "__main__":
    unittest.main()
