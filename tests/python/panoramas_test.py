"""airsim360.data.Panoramas: frames of a plan on demand are those of the collected dataset, whatever the order, process or cache."""
import hashlib
import importlib.util
import json
import multiprocessing
import os
import pickle
import subprocess
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import numpy as np

from airsim360 import Dataset
from airsim360.data import Panoramas

PROGRAM = os.environ["AIRSIM360"]
RECIPE = """
name: rooms
picture: {size: 128x64, tier: fast, exposure: auto}
skies:
  - name: two
    frames: 6
    choices:
      - {weather: day, settings: [{setting: cloud_cover, low: 0, high: 0.9}, {setting: sun_elevation_deg, low: 5, high: 60}]}
      - {weather: overcast}
rows:
  - {name: boxes, world: box_room, frames: 7, skies: two, clearance: 0.5, highest: 5, tilt_deg: 10}
  - {name: later, world: no_such_city, frames: 3, skies: two}
  - {name: sunny, world: sunlit_room, frames: 4, skies: two, clearance: 0.3, highest: 2.5}
  - {name: lively, world: box_room, frames: 4, skies: two, sampler: people, people: 2, width: 6, depth: 6, view_frames: 2, lowest: 1, highest: 3}
  - {name: flown, world: box_room, frames: 5, skies: two, sampler: flights, flight_frames: 3, least_length: 3, most_length: 8, clearance: 0.3}
"""
FRAMES = [*range(7), *range(10, 23)]  # whose world exists
PRODUCTS = ["rgb", "range", "semantic", "entity", "normal", "position", "albedo", "sky", "flow", "coverage", "radiance"]


def run(*arguments):
    subprocess.run([PROGRAM, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def digest(frame):
    """Of all pictures of a frame."""
    sums = hashlib.sha256()
    for name in frame.products:
        for array in frame[name].values() if isinstance(frame[name], dict) else [frame[name]]:
            sums.update(np.ascontiguousarray(array).tobytes())
    return sums.hexdigest()


def digests_of(panoramas, frames):
    return [digest(panoramas[i]) for i in frames]


def identity(batch):
    return batch


class OnDemand(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        # The light of rooms takes half a minute a sky: solved once, kept as for users.
        cls.enterClassContext(unittest.mock.patch.dict(os.environ, AIRSIM360_CACHE=os.environ.get("AIRSIM360_CACHE") or str(cls.folder / "worlds")))
        cls.recipe, cls.plan = cls.folder / "rooms.yaml", cls.folder / "plan.json"
        cls.recipe.write_text(RECIPE)
        run("dataset", "plan", cls.recipe, "--seed", 5, "--out", cls.plan)
        cls.hash = json.loads(cls.plan.read_text())["hash"]
        run("dataset", "run", cls.plan, "--products", ",".join(PRODUCTS[4:]), "--out", cls.folder / "all")
        cls.collected = {frame.index: frame for frame in Dataset(cls.folder / "all")}

    def setUp(self):
        own = tempfile.TemporaryDirectory()
        self.addCleanup(own.cleanup)
        self.own = Path(own.name)

    def labels(self, **options):
        return Panoramas(self.plan, **{"tier": "labels", "cache": False, **options})

    def assert_same(self, drawn, stored, products):
        self.assertEqual(drawn.products, stored.products)
        for name in products:
            for view in stored.views:
                a, b = drawn.read(name, view), stored.read(name, view)
                if isinstance(b, dict):
                    self.assertEqual(set(a), set(b))
                for x, y in zip(*(([p[k] for k in sorted(b)] if isinstance(b, dict) else [p]) for p in (a, b))):
                    self.assertEqual((x.dtype, x.shape), (y.dtype, y.shape), (name, view))
                    np.testing.assert_array_equal(x, y, f"frame {stored.index}, {name} {view}")

    def test_every_picture_of_every_frame_is_the_collected_one_in_any_order(self):
        panoramas = Panoramas(self.plan, products=PRODUCTS, cache=False)
        self.assertEqual(len(panoramas), 23)
        self.assertEqual(sorted(self.collected), FRAMES)
        for i in panoramas.order(seed=3):
            drawn, stored = panoramas[int(i)], self.collected[int(i)]
            self.assert_same(drawn, stored, PRODUCTS)
            np.testing.assert_array_equal(drawn.pose, stored.pose)
            for name in ("index", "stem", "t_ns"):
                self.assertEqual(getattr(drawn, name), getattr(stored, name), name)
            for name in ("environment", "row", "world", "seed", "v_WB", "w_WB_B"):
                self.assertEqual(drawn.about[name], stored.record[name], name)
            self.assertEqual([p["keypoints"] for p in drawn.people], [p["keypoints"] for p in stored.people])
            self.assertEqual({**panoramas.meta(int(i)), "persons": drawn.about.get("persons")}, {**drawn.about, "persons": drawn.about.get("persons")})
        self.assertEqual(len(panoramas[15].people), 2)
        np.testing.assert_allclose(panoramas[0].points(), panoramas[0].position, atol=2e-5)

    def test_views_of_a_cube_jpeg_and_other_cameras(self):
        run("dataset", "run", self.plan, "--rgb-format", "jpg", "--size", "64x32", "--shard", "0/20", "--out", self.folder / "jpeg")
        self.assert_same(Panoramas(self.plan, rgb_format="jpg", size=(64, 32), cache=False)[0], Dataset(self.folder / "jpeg")[0], ["rgb"])
        cube = self.labels(projection="cube", size="32x32", exposure=0.0)[2]
        self.assertEqual(set(cube.views), {"+x", "-x", "+y", "-y", "+z", "-z"})
        self.assertEqual(cube["range_+x"].shape, (32, 32))
        with self.assertRaisesRegex(KeyError, "name one"):
            cube.range
        pinhole = self.labels(projection="pinhole", size="60x40", fov=np.radians(70), products=["range", "position"])[2]
        np.testing.assert_allclose(pinhole.points(), pinhole.position, atol=2e-5)
        np.testing.assert_array_equal(pinhole.pose, self.collected[2].pose)

    def test_labels_do_not_depend_on_tier_sky_threads_or_what_else_is_asked_for(self):
        for options in ({}, {"products": ["entity"]}, {"threads": 1}):
            panoramas = self.labels(**options)
            for i in (3, 11, 15, 22):
                np.testing.assert_array_equal(panoramas[i].entity, self.collected[i].entity)
        foggy = Panoramas(self.plan, weather="fog", products=["rgb", "entity"], cache=False)[10]
        self.assertIn("visibility_m", foggy.environment)
        np.testing.assert_array_equal(foggy.entity, self.collected[10].entity)
        self.assertGreater((foggy.rgb != self.collected[10].rgb).mean(), 0.1)

    def test_a_recipe_and_its_hash(self):
        panoramas = Panoramas(f"{self.recipe}@{self.hash[:8]}", seed=5, tier="labels", cache=False)
        self.assertEqual(panoramas.hash, self.hash)
        np.testing.assert_array_equal(panoramas[-1].range, self.collected[22].range)
        self.assertEqual(panoramas.worlds["no_such_city"], None)
        self.assertEqual(panoramas.categories[int(panoramas[0].semantic[0, 0])]["path"], "construction/ceiling")
        with self.assertRaisesRegex(ValueError, "the hash of .* is [0-9a-f]{64} here; the seed"):
            Panoramas(f"{self.recipe}@{self.hash}", seed=6)
        with self.assertRaisesRegex(ValueError, "is not the hash of a plan"):
            Panoramas(f"{self.recipe}@xyz")
        self.assertEqual(len(Panoramas(self.recipe, world=["box_room"], frames=9)), 9)

    def test_a_million_frames_need_nothing_but_their_seed(self):
        (self.own / "million.yaml").write_text("name: many\nrows:\n  - {world: box_room, frames: 1000000, clearance: 0.5, highest: 5}\n")
        panoramas = Panoramas(self.own / "million.yaml", size=(64, 32), tier="labels", cache=False)
        self.assertEqual(len(panoramas), 1_000_000)
        poses = {tuple(panoramas[i].p) for i in (0, 123_456, 999_999)}
        self.assertEqual(len(poses), 3)

    def test_slices_iteration_and_orders(self):
        panoramas = self.labels(products=["range"])
        self.assertEqual([frame.index for frame in panoramas[10:23:5]], [10, 15, 20])
        self.assertEqual(panoramas[3:5][1:][0].index, 4)
        self.assertEqual([frame.index for frame in panoramas], FRAMES)
        self.assertEqual(panoramas.order(), FRAMES)
        shuffled = panoramas.order(seed=1)
        self.assertEqual(sorted(shuffled), FRAMES)
        self.assertNotEqual(shuffled, FRAMES)
        self.assertNotEqual(shuffled, panoramas.order(seed=2))
        # Frames that share a sky follow one another.
        blocks = [panoramas.meta(i)["block"][0] for i in shuffled]
        self.assertEqual(sum(a != b for a, b in zip(blocks, blocks[1:])) + 1, len(set(blocks)))

    def entries(self):
        return sorted(self.own.glob("*.cache"))

    def test_the_cache_gives_the_same_arrays_and_heals(self):
        panoramas = self.labels(products=PRODUCTS[1:-1], cache=self.own)
        first = digests_of(panoramas, (0, 15))
        self.assertEqual(len(self.entries()), 2)
        again = self.labels(products=PRODUCTS[1:-1], cache=self.own)
        self.assertEqual(digests_of(again, (0, 15)), first)
        self.assertEqual(len(again[15].people), 2)
        # It is the cache that is read: what lies under another name comes out there.
        one, other = self.entries()
        index = [again[i].index for i in (0, 15)]
        content = one.read_bytes(), other.read_bytes()
        one.write_bytes(content[1]), other.write_bytes(content[0])
        self.assertEqual([again[i].index for i in (0, 15)], index[::-1])
        # Whatever is damaged is drawn again.
        one.write_bytes(content[0][:-1] + bytes([content[0][-1] ^ 1]))
        other.write_bytes(b"")
        self.assertEqual(digests_of(again, (0, 15)), first)
        self.assertEqual([path.stat().st_size for path in (one, other)], [len(c) for c in content])

    def test_other_pictures_are_other_entries(self):
        for options in ({}, {"products": ["range"]}, {"size": (64, 32)}, {"pano_frame": "level"}, {"environment": "turbidity=4"}):
            self.labels(cache=self.own, **options)[0]
        self.assertEqual(len(self.entries()), 5)

    def test_the_cache_stays_under_its_bound(self):
        self.labels(cache=self.own)[0]
        bound = int(2.5 * self.entries()[0].stat().st_size)
        panoramas = self.labels(cache=self.own, cache_bytes=bound)
        for i in FRAMES:
            panoramas[i]
            self.assertLessEqual(sum(path.stat().st_size for path in self.own.iterdir()), bound)
        self.assertGreater(len(self.entries()), 0)

    def test_processes_draw_the_same_and_share_a_cache(self):
        expected = digests_of(self.labels(), FRAMES)
        for method in ("fork", "spawn"):
            panoramas = self.labels(cache=self.own)
            if method == "fork":
                panoramas.open()  # so that the workers go on with what this process has
            with multiprocessing.get_context(method).Pool(2) as pool:
                parts = pool.starmap(digests_of, [(panoramas, FRAMES[0::2]), (panoramas, FRAMES[1::2])])
            self.assertEqual([parts[k % 2][k // 2] for k in range(len(FRAMES))], expected, method)
            for path in self.entries():
                path.unlink()

    def test_a_pickled_frame_keeps_its_pictures(self):
        frame = self.labels()[11]
        copy = pickle.loads(pickle.dumps(frame))
        self.assertEqual((digest(copy), copy.world), (digest(frame), "sunlit_room"))

    def test_samples_and_items_are_what_a_loader_takes(self):
        panoramas = self.labels()
        self.assertEqual({k: v.dtype for k, v in panoramas.samples("semantic", "entity", "range")[2].items()},
                         {"semantic": np.int64, "entity": np.int64, "range": np.float32})
        frame = panoramas[2]
        self.assertEqual(list(frame), ["index", "X_WC", "range", "semantic", "entity"])
        self.assertEqual({k: frame[k].dtype for k in list(frame)[2:]}, {"range": np.float32, "semantic": np.uint8, "entity": np.int32})
        np.testing.assert_array_equal(frame["entity"], frame.entity)

    @unittest.skipUnless(importlib.util.find_spec("torch"), "PyTorch is not installed: apt-get install python3-torch")
    def test_a_loader_of_torch_takes_it_as_it_is(self):
        import torch.utils.data  # heavy: not in the processes of the other tests
        for method in ("fork", "spawn"):
            panoramas = self.labels(cache=False)
            loader = torch.utils.data.DataLoader(panoramas, batch_size=3, num_workers=2, sampler=panoramas.order(seed=4),
                                                 multiprocessing_context=method)
            seen = []
            for batch in loader:
                for i, entity, pose in zip(batch["index"].tolist(), batch["entity"].numpy(), batch["X_WC"].numpy()):
                    np.testing.assert_array_equal(entity, self.collected[i].entity)
                    np.testing.assert_array_equal(pose, self.collected[i].pose)
                    seen.append(i)
            self.assertEqual(seen, panoramas.order(seed=4))
        plain = torch.utils.data.DataLoader(panoramas, batch_size=2, num_workers=1, sampler=[22, 0], collate_fn=identity)
        np.testing.assert_array_equal(next(iter(plain))[1].range, self.collected[0].range)

    def test_what_makes_no_sense_is_said(self):
        panoramas = self.labels()
        for i in (23, -24, 10**12):
            with self.assertRaisesRegex(IndexError, "is not in 0 … 22 of the plan"):
                panoramas[i]
        with self.assertRaisesRegex(ValueError, "frame 8 is of world 'no_such_city', which did not exist"):
            panoramas[8]
        for name in ("rgb", "normal"):
            for ask in (lambda: panoramas[0][name], lambda: getattr(panoramas[0], name)):
                with self.assertRaisesRegex(KeyError, rf"product '{name}' was not asked for: name it in Panoramas\(products="):
                    ask()
        with self.assertRaisesRegex(KeyError, "did you mean 'range'"):
            panoramas[0]["ranges"]
        for message, options in {"did you mean 'normal'": {"products": ["normals"]}, "products: a list": {"products": "rgb"},
                                 "tier 'labels' has no rgb": {"products": ["rgb"]}, "^size: '100x100'.*'100x50'": {"size": (100, 100)},
                                 "'tiers'.* did you mean 'tier'": {"tiers": "fast"}, "tier.*did you mean 'fast'": {"tier": "fasd"},
                                 "projection.*did you mean 'cube'": {"projection": "cub"}, "no field of view": {"fov": 1.5},
                                 "weather.*did you mean 'fog'": {"weather": "fogg"}, "device.*'cpu'": {"device": "cpuu"},
                                 "numbered by world": {"products": ["material"]}, "threads: -1": {"threads": -1}, "a plan already": {"frames": 5}}.items():
            with self.assertRaisesRegex(ValueError, message):
                self.labels(**options)
        with self.assertRaisesRegex(ValueError, "did you mean 'omni360-mini'"):
            Panoramas("omni360-mine")
        with self.assertRaisesRegex(ValueError, "no_such.yaml"):
            Panoramas(self.own / "no_such.yaml")


if __name__ == "__main__":
    unittest.main()
