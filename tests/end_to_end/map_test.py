"""Maps through the real program: pieces of them, places on the Earth, the cache that an import fills."""
import json
import math
import os
import unittest
import unittest.mock

from program import ROOT, ProgramTest, run

MAP = ROOT / "data/osm/crossing.osm"
LATITUDE, LONGITUDE = 52.0, 5.0  # of its middle
NORTH, EAST = 111267.0, 68677.9  # metres a degree there (WGS 84)

BOX = 51.9997, 4.9996, 52.0003, 5.0008  # south, west, north and east of a piece


def coast(folder):
    """A coast that runs eastwards: land in the north."""
    def node(number, x, y):
        return f"<node id='{number}' version='1' lat='{LATITUDE + y / NORTH:.8f}' lon='{LONGITUDE + x / EAST:.8f}'/>"
    path = folder / "coast.osm"
    south, north, west, east = LATITUDE - 1000 / NORTH, LATITUDE + 1000 / NORTH, LONGITUDE - 1000 / EAST, LONGITUDE + 1000 / EAST
    path.write_text(f"<osm version='0.6'><bounds minlat='{south}' minlon='{west}' maxlat='{north}' maxlon='{east}'/>" +
                    node(1, -2000, 0) + node(2, 2000, 0) + node(3, 0, 800) + node(4, 50, 850) +
                    "<way id='1' version='1'><nd ref='1'/><nd ref='2'/><tag k='natural' v='coastline'/></way>"
                    "<way id='2' version='1'><nd ref='3'/><nd ref='4'/><tag k='highway' v='residential'/></way></osm>")
    return path


class MapTest(ProgramTest):
    def entities(self, *world):
        return json.loads(self.run_ok("world", "entities", *world, "--json").stdout)

    def size_of(self, *flags, world=MAP):
        report = json.loads(self.run_ok("world", "import", world, *flags, "--json").stdout)
        return report["extent_m"], report["origin"], report

    def test_a_piece_by_box_or_around_a_place_is_the_map_there(self):
        (width, depth), origin, whole = self.size_of()
        self.assertGreater(width, 180)
        south, west, north, east = BOX
        (width, depth), origin, piece = self.size_of("--bbox", f"{south},{west},{north},{east}")
        self.assertAlmostEqual(width, (east - west) * EAST, delta=0.2)
        self.assertAlmostEqual(depth, (north - south) * NORTH, delta=0.2)
        self.assertAlmostEqual(origin["latitude_deg"], LATITUDE, delta=1e-6)
        self.assertAlmostEqual(origin["longitude_deg"], (west + east) / 2, delta=1e-6)
        self.assertLess(piece["entities"], whole["entities"])
        # OpenStreetMap's order of the numbers names the same piece.
        rows = self.entities(MAP, "--bbox", f"{west},{south},{east},{north}")
        self.assertEqual(rows, self.entities(MAP, "--bbox", f"{south},{west},{north},{east}"))
        self.assertEqual(len(rows), piece["entities"])

    def test_a_world_file_names_the_piece(self):
        out = self.folder / "piece.yaml"
        (width, depth), _, piece = self.size_of("--centre", "52.0,5.0", "--radius", "40", "--out", out)
        self.assertAlmostEqual(width, 80, delta=0.1)
        self.assertAlmostEqual(depth, 80, delta=0.1)
        def names(*world):
            return {row["name"] for row in self.entities(*world)}
        self.assertEqual(names(out), names(MAP, "--centre", "52.0,5.0", "--radius", "40"))
        self.assertNotEqual(names(out), names(MAP))

    def test_nonsense_is_refused_by_name(self):
        self.run_bad(2, "world", "import", MAP, "--bbox", "1,2,3", says=["--bbox", "SOUTH,WEST,NORTH,EAST"])
        self.run_bad(2, "world", "import", MAP, "--bbox", "52.1,4.9,51.9,5.1", says=["--bbox", "south 52.1 is not below north 51.9"])
        self.run_bad(2, "world", "import", MAP, "--bbox", "10,10,11,11", says=["--bbox", "nothing of", "51.99", "5.00"])
        self.run_bad(2, "world", "import", MAP, "--centre", "52,5", says=["--centre", "--radius"])
        self.run_bad(2, "world", "import", MAP, "--centre", "152,5", "--radius", "50", says=["--centre", "latitudes"])
        self.run_bad(2, "world", "import", MAP, "--centre", "52,5", "--radius", "5", says=["--radius", "10 … 30000"])
        self.run_bad(2, "world", "import", MAP, "--bbox", "51,4,53,6", "--radius", "50", says=["--bbox", "one or the other"])
        self.run_bad(2, "render", "--world", "box_room", "--bbox", "51,4,53,6", "--out", self.folder / "x", says=["--bbox", "maps"])
        world = self.folder / "bad.yaml"
        world.write_text(f"world: {MAP}\nbbox: 52.1,4.9,51.9,5.1\n")
        self.run_bad(2, "world", "entities", world, says=["bad.yaml", "bbox", "south 52.1"])

    def test_a_map_too_large_says_how_to_cut_it(self):
        path = self.folder / "wide.osm"
        nodes = "".join(f"<node id='{i}' version='1' lat='{50 + i * 0.1}' lon='{8 + i * 0.1}'/>" for i in range(1, 12))
        path.write_text("<osm version='0.6'>" + nodes + "<way id='1' version='1'><nd ref='5'/><nd ref='6'/><tag k='highway' v='residential'/></way>"
                        "<way id='2' version='1'>" + "".join(f"<nd ref='{i}'/>" for i in range(1, 12)) + "<tag k='highway' v='primary'/></way></osm>")
        self.run_bad(2, "world", "import", path, says=["km", "--bbox", "--centre", "its data", "50.1"])
        (width, _), _, _ = self.size_of("--centre", "50.5,8.5", "--radius", "300", world=path)
        self.assertAlmostEqual(width, 600, delta=1)

    def test_places_on_the_earth_are_poses(self):
        def position(*flags, world=MAP):
            out = self.folder / ("shot" + str(len(list(self.folder.iterdir()))))
            self.run_ok("render", "--world", world, "--size", "64x32", "--tier", "labels", *flags, "--out", out)
            return json.loads((out / "frames.jsonl").read_text().splitlines()[0])["X_WC"]["p"]
        for text in ("52.0003N,5.0004E,30,90", "5.0004E,52.0003N,30,90"):
            x, y, z = position("--pose", text)
            self.assertAlmostEqual(x, 0.0004 * EAST, delta=0.02)
            self.assertAlmostEqual(y, 0.0003 * NORTH, delta=0.02)
            self.assertAlmostEqual(z, 30, delta=1e-6)
        # The same place of a piece, whose middle lies elsewhere.
        x, y, _ = position("--bbox", ",".join(map(str, BOX)), "--pose", "52.0003N,5.0004E,30,90")
        self.assertAlmostEqual(x, 0.0002 * EAST, delta=0.02)
        bad = self.folder / "bad"
        self.run_bad(2, "render", "--world", "box_room", "--pose", "52N,5E,1", "--out", bad, says=["--pose", "box_room", "no place on the Earth"])
        self.run_bad(2, "render", "--world", MAP, "--pose", "52N,8E,1", "--out", bad, says=["--pose", "100 km", "52.0"])
        self.run_bad(2, "render", "--world", MAP, "--pose", "52N,5N,1", "--out", bad, says=["--pose", "latitude and a longitude"])
        self.run_bad(2, "render", "--world", MAP, "--pose", "92N,5E,1", "--out", bad, says=["--pose", "latitude and a longitude"])
        self.run_bad(2, "fly", "--world", "box_room", "--pose", "52N,5E,1", "--out", bad, says=["--pose", "no place on the Earth"])
        self.run_bad(2, "plan", "--world", "box_room", "--from", "52N,5E,1", "--to", "0,0,1", "--vmax", "2", "--amax", "2", "--out", bad / "p.csv",
                     says=["--from", "no place on the Earth"])

    def test_the_sea_is_water_and_nobody_plans_into_it(self):
        path = coast(self.folder)
        rows = self.entities(path)
        sea = next(row for row in rows if row["name"] == "sea")
        self.assertEqual(sea["category_path"], "water/sea")
        self.assertLess(sea["box"]["min"][1], -1000)
        shot = self.folder / "shot"
        self.run_ok("render", "--world", path, "--pose", f"{LATITUDE - 300 / NORTH}N,{LONGITUDE}E,20,-90", "--size", "64x32", "--tier", "labels", "--out", shot)
        seen = {entry["name"] for entry in json.loads((shot / "entities.json").read_text()).values()}
        self.assertIn("sea", seen)

    def test_an_import_fills_the_cache_that_other_commands_use(self):
        self.enterContext(unittest.mock.patch.dict(os.environ, AIRSIM360_CACHE=str(self.folder / "cache")))
        self.run_ok("world", "import", MAP)
        def scenes():
            return [(entry.name, entry.stat().st_ino) for entry in sorted((self.folder / "cache").iterdir()) if entry.name.startswith("scene-")]
        filled = scenes()
        self.assertEqual(len(filled), 1)
        self.run_ok("render", "--world", MAP, "--size", "64x32", "--tier", "labels", "--out", self.folder / "shot")
        world = self.folder / "town.yaml"
        world.write_text(f"world: {MAP}\n")
        self.run_ok("render", "--world", world, "--size", "64x32", "--tier", "labels", "--out", self.folder / "again")
        self.assertEqual(scenes(), filled)


if __name__ == "__main__":
    unittest.main()
