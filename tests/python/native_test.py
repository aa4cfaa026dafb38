"""The compiled module: arrays, frames, errors, determinism. Standard library and NumPy only."""
import gc
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import airsim360
from airsim360 import Drone, Lidar, Rig, Simulation, World

ROOM = World("box_room")
SMALL = Rig(width=256)


def airborne(position=(0, 0, 2), **options):
    return Drone("hummingbird", position=position, airborne=True, **options)


class Worlds(unittest.TestCase):
    def test_box_room_is_the_one_of_the_contracts(self):
        np.testing.assert_allclose(ROOM.bounds, [[-5, -5, 0], [5, 5, 6]], atol=1e-6)
        self.assertEqual(len(ROOM.entities), 7)
        self.assertEqual([e["id"] for e in ROOM.entities], list(range(1, 8)))
        paths = ROOM.categories
        for entity in ROOM.entities:
            self.assertEqual(paths[entity["category"]], entity["category_path"])

    def test_rays_and_clearance_agree_with_the_room(self):
        origins = np.array([[0, 0, 3]] * 3, float)
        distance, entity = ROOM.raycast(origins, [[0, 0, -1], [0, 2, 0], [0, 0, 1]])
        np.testing.assert_allclose(distance, [3, 5, 3], atol=1e-5)
        self.assertEqual(len(set(entity)), 3)
        np.testing.assert_allclose(ROOM.clearance([[0, 0, 3], [-4, 0, 3]]), [3, 1], atol=1e-5)

    def test_places_that_no_ray_can_reach_are_refused(self):
        for value in (1.1e7, 2e18, -1e30, 1e308, math.inf, math.nan):
            for axis in range(3):
                place = [0.0, 0.0, 3.0]
                place[axis] = value
                for call in (lambda: ROOM.raycast([place], [[0, 0, -1]]), lambda: ROOM.raycast([[0, 0, 3]], [place]),
                             lambda: ROOM.clearance([place])):
                    with self.assertRaisesRegex(ValueError, "is not in -1e|is not a finite number"):
                        call()
        distance, _ = ROOM.raycast([[0, 0, 1e7]], [[0, 0, 1]])
        self.assertEqual(distance[0], 0)

    def test_worlds_are_listed_and_exported(self):
        self.assertIn("box_room", [w["name"] for w in airsim360.worlds()])
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "room.glb")
            ROOM.export(path)
            names = {e["name"] for e in World(path).entities}
            self.assertLessEqual({e["name"] for e in ROOM.entities}, names)

    def test_labels_of_a_file_and_at_run_time_are_in_the_next_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mine.yaml")
            with open(path, "w", encoding="utf-8") as file:
                file.write("rules:\n  - match: box\n    category: furniture/seating/bench\n")
            world = World("box_room", labels=path)
            with self.assertRaisesRegex(ValueError, "none.yaml"):
                World("box_room", labels=os.path.join(folder, "none.yaml"))
        box = next(e for e in world.entities if e["name"] == "box")
        self.assertEqual(box["category_path"], "furniture/seating/bench")
        rig = Rig(width=128, tier="labels", products=["semantic"])
        sim = Simulation(world, drones=2)
        before = world.capture([0, 0, 3], rig)
        self.assertEqual(world.relabel({"b?x": "made_up/thing", "wall*": "construction/wall", "*": "object"}), 7)
        after, flown = world.capture([0, 0, 3], rig), sim.capture(rig)
        ids = {path: id for id, path in world.categories.items()}
        changed = before.semantic == box["category"]
        self.assertGreater(changed.sum(), 10)
        np.testing.assert_array_equal(after.semantic == ids["made_up/thing"], changed)
        self.assertIn(ids["made_up/thing"], flown.semantic)
        with self.assertRaisesRegex(ValueError, "entity"):
            after.entity
        self.assertEqual({e["category_path"] for e in world.entities}, {"made_up/thing", "construction/wall", "object"})
        scan = world.scan([0, 0, 3])
        np.testing.assert_array_equal(scan.semantic == ids["made_up/thing"], scan.entity == box["id"])
        with self.assertWarnsRegex(UserWarning, "'zzz.' matches no entity"):
            self.assertEqual(world.relabel({"zzz*": "object", "wall*": "construction/wall"}), 4)
        for bad in ({"box": "Not A Path"}, {"box": 3}):
            with self.assertRaises(ValueError):
                world.relabel(bad)

    def test_another_build_of_the_module_does_not_take_the_cached_worlds_of_this_one(self):
        package = os.path.dirname(airsim360.__file__)
        with tempfile.TemporaryDirectory() as folder:
            copy, cache = os.path.join(folder, "airsim360"), os.path.join(folder, "cache")
            shutil.copytree(package, copy, symlinks=False)
            module = next(os.path.join(copy, name) for name in os.listdir(copy) if name.endswith(".so"))

            environment = dict(os.environ, PYTHONPATH=folder, AIRSIM360_CACHE=cache)
            environment.pop("AIRSIM360_CACHE_PROGRAM", None)  # by which builds would pass for one

            def cached():
                subprocess.run([sys.executable, "-c", "import airsim360; airsim360.World('box_room')"], check=True, env=environment, cwd=folder)
                return len([name for _, _, names in os.walk(cache) for name in names if name.startswith("scene")])

            self.assertEqual([cached(), cached()], [1, 1])
            os.utime(module, (1, 1))
            self.assertEqual(cached(), 2)

    def test_a_misspelt_world_is_a_value_error_that_names_the_nearest(self):
        with self.assertRaisesRegex(ValueError, "box_room"):
            World("box_rom")


    def test_a_gpu_draws_the_labels_of_the_cpu(self):
        with self.assertRaisesRegex(ValueError, "vulkan"):
            World("box_room", device="vulcan")
        rig = Rig(width=64, tier="labels")
        try:
            world = World("box_room", device="vulkan")
            ours = world.capture([0, 0, 3], rig)
        except RuntimeError as error:
            self.skipTest(str(error))
        self.assertEqual(world.device, "vulkan")
        theirs = World("box_room", device="cpu").capture([0, 0, 3], rig)
        self.assertLessEqual(np.count_nonzero(ours.entity != theirs.entity), 2)
        # Drones of a simulation see the same room.
        seen = Simulation(world, drones=airborne((0, 0, 3))).capture(rig)
        self.assertLessEqual(np.count_nonzero(seen.entity != ours.entity), 2)


class Captures(unittest.TestCase):
    def test_parts_are_told_beside_the_entity(self):
        # A house with a pane in its wall and a lamp of glass, as a model file.
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "house.obj")
            with open(os.path.join(folder, "house.mtl"), "w", encoding="utf-8") as file:
                file.write("newmtl brick\nKd 0.5 0.2 0.1\nnewmtl glass\nKd 0.1 0.1 0.1\n")
            quad = "v {0} 0 -5\nv {1} 0 -5\nv {1} 2 -5\nv {0} 2 -5\nusemtl {2}\nf -4 -3 -2 -1\n"
            with open(path, "w", encoding="utf-8") as file:
                file.write("mtllib house.mtl\no house\n" + quad.format(-2, 0, "brick") + quad.format(0, 1, "glass")
                           + "o lamp\n" + quad.format(1, 2, "glass"))
            world = World(path)
        house = next(e for e in world.entities if e["category_path"].startswith("construction"))
        pose = dict(position=[0, 0, 1], yaw=math.pi / 2)
        c = world.capture(rig=Rig(width=256, products=["part", "entity"], tier="labels"), **pose)
        window = airsim360.PARTS.index("window")
        self.assertEqual(c.part.dtype, np.uint8)
        self.assertEqual(set(np.unique(c.part)), {0, window})
        self.assertEqual(set(np.unique(c.entity[c.part == window])), {house["id"]})
        self.assertLess((c.part == window).sum(), 0.6 * (c.entity == house["id"]).sum())
        with self.assertRaisesRegex(ValueError, "semantic"):
            c.semantic
        with self.assertRaisesRegex(ValueError, "material"):
            c.material
        np.testing.assert_array_equal(np.from_dlpack(c.tensor("part")), c.part)
        again = world.capture(rig=Rig(width=256, products=["part", "semantic", "material"], tier="labels"), **pose)
        np.testing.assert_array_equal(again.part, c.part)
        self.assertIsNotNone(again.semantic)

    def test_dlpack_shares_the_memory_and_keeps_it(self):
        c = ROOM.capture([0, 0, 3], Rig(width=64, products=["rgb", "range", "entity", "normal"]))
        for name in ("rgb", "range", "entity", "normal"):
            tensor = c.tensor(name)
            self.assertEqual(tensor.__dlpack_device__(), (1, 0))
            seen = np.from_dlpack(tensor)
            self.assertTrue(np.shares_memory(seen, getattr(c, name)), name)
            np.testing.assert_array_equal(seen, getattr(c, name))
        expected, kept = c.range.copy(), np.from_dlpack(c.tensor("range"))
        unused = c.tensor("rgb").__dlpack__()
        copied = c.tensor("rgb").__dlpack__(copy=True)
        del c, seen, tensor, unused, copied
        gc.collect()
        np.testing.assert_array_equal(kept, expected)

    def test_dlpack_gives_versioned_capsules_to_those_who_know_them(self):
        tensor = ROOM.capture([0, 0, 3], Rig(width=32, products=["range"])).tensor("range")
        self.assertIn('"dltensor"', repr(tensor.__dlpack__()))
        self.assertIn('"dltensor"', repr(tensor.__dlpack__(max_version=(0, 8))))
        self.assertIn('"dltensor_versioned"', repr(tensor.__dlpack__(max_version=(1, 0), dl_device=(1, 0), copy=False)))
        for stream in (1, 0):
            with self.assertRaises(ValueError):
                tensor.__dlpack__(stream=stream)

    def test_dlpack_names_what_is_not_there(self):
        c = ROOM.capture([0, 0, 3], Rig(width=32, products=["range"]))
        with self.assertRaisesRegex(ValueError, "not captured"):
            c.tensor("entity")
        with self.assertRaisesRegex(ValueError, "range"):
            c.tensor("rnge")
        with self.assertRaises(BufferError):
            c.tensor("range").__dlpack__(dl_device=(2, 0))

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed (apt-get install ffmpeg)")
    def test_videos_of_captures_and_arrays(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.mp4")
            sim = Simulation(ROOM, airborne())
            with airsim360.VideoWriter(path, encoder="libx264") as video:
                for _ in range(3):
                    sim.run(0.1)
                    video.add(sim.capture(Rig(width=64)))
                self.assertEqual((len(video), video.encoder), (3, "libx264"))
                self.assertEqual(os.listdir(folder), [])
            with open(path, "rb") as file:
                data = file.read()
            for box in (b"ftyp", b"sv3d", b"st3d", b"GSpherical"):
                self.assertIn(box, data)
            with airsim360.VideoWriter(path, spherical=False) as video:
                video.add(np.zeros((48, 64, 3), np.uint8))
                video.add(np.full((48, 64, 3), 255, np.uint8), t=0.5)
                with self.assertRaisesRegex(ValueError, "64x48"):
                    video.add(np.zeros((48, 48, 3), np.uint8))
                with self.assertRaisesRegex(ValueError, "after one at"):
                    video.add(np.zeros((48, 64, 3), np.uint8), t=0.5)
            with open(path, "rb") as file:
                self.assertNotIn(b"sv3d", file.read())
            with airsim360.VideoWriter(path, fps=10) as video:
                for x in range(3):
                    video.add(ROOM.capture([x, 0, 3], Rig(width=64)))  # these have no time
            other = os.path.join(folder, "b.mp4")
            with self.assertRaises(KeyError):
                with airsim360.VideoWriter(other) as video:
                    video.add(np.zeros((48, 64, 3), np.uint8))
                    raise KeyError
            self.assertFalse(os.path.exists(other))
            with self.assertRaisesRegex(ValueError, "did you mean 'libx265'"):
                airsim360.VideoWriter(other, encoder="libx265x")

    def test_a_picture_that_was_not_asked_for_says_how_to_get_it(self):
        c = ROOM.capture([0, 0, 3], Rig(width=64, tier="labels", products=["range"]))
        self.assertEqual(c.products, ["range"])
        for name in ("rgb", "semantic", "entity", "normal", "position", "albedo", "material", "part", "radiance", "flow"):
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"'{name}' was not captured: name it in Rig"):
                getattr(c, name)
            with self.subTest(name), self.assertRaises(ValueError):
                c.tensor(name)

    def test_repr_tells(self):
        sim = Simulation(ROOM, airsim360.Drone("hummingbird", position=[1, 2, 3], airborne=True))
        rig = Rig(width=64, products=["rgb", "range"])
        plan = airsim360.plan_minimum_snap([[0, 0, 1], [3, 0, 1]])
        for thing, says in ((ROOM, "box_room"), (sim, "box_room"), (rig, "64x32"), (ROOM.capture([0, 0, 3], rig), "rgb, range, 64x32"),
                            (sim.state(), r"position \(1.000, 2.000, 3.000\)"), (sim.snapshot(), "t = 0.000"),
                            (airsim360.Drone("crazyflie"), "4 rotors"), (plan, "2 waypoints"), (airsim360.Lidar(), "16x625"),
                            (ROOM.scan([0, 0, 3]), "points"), (sim.geo_frame, "47.64")):
            self.assertRegex(repr(thing), says)
            self.assertNotIn("object at 0x", repr(thing))

    def test_wait_ends_when_the_command_does(self):
        sim = Simulation(ROOM, drones=1)
        floor = sim.state().position[2]
        sim.takeoff(height=1.5)
        self.assertTrue(sim.wait())
        self.assertAlmostEqual(sim.state().position[2], floor + 1.5, delta=0.3)
        sim.fly_to([2, 2, 2])
        self.assertTrue(sim.wait())
        np.testing.assert_allclose(sim.state().position, [2, 2, 2], atol=0.3)
        sim.fly_to([-2, -2, 2])
        began = sim.t
        self.assertFalse(sim.wait(timeout=0.5))
        self.assertAlmostEqual(sim.t - began, 0.5, delta=0.011)
        sim.land()
        self.assertTrue(sim.wait())
        for timeout in (-1, float("nan"), float("inf")):
            with self.assertRaisesRegex(ValueError, "timeout"):
                sim.wait(timeout=timeout)

    def test_satellite_readings_and_the_frame_of_the_earth_agree(self):
        sim = Simulation(ROOM, airsim360.Drone("hummingbird", position=[1, -2, 3], airborne=True))
        sim.run(2)
        reading = sim.state().sensors["gnss"]
        place = [reading["latitude_deg"], reading["longitude_deg"], reading["altitude"]]
        np.testing.assert_allclose(sim.geo_frame.to_world(place), reading["position"], atol=1e-6)
        self.assertLess(np.linalg.norm(reading["position"] - [1, -2, 3]), 20)
        # East is along the parallel, up is up; a closed form near the equator, and there and back.
        frame = airsim360.GeoFrame(0, 10, 50)
        np.testing.assert_allclose(frame.to_geodetic([0, 0, 7]), [0, 10, 57], atol=1e-9)
        np.testing.assert_allclose(frame.to_geodetic([6378137.0 * np.radians(1e-4), 0, 0])[1], 10 + 1e-4, atol=2e-9)
        points = np.random.default_rng(1).uniform(-5000, 5000, (50, 3))
        np.testing.assert_allclose(frame.to_world(frame.to_geodetic(points)), points, atol=1e-6)
        for bad in ((91, 0), (0, 181), (float("nan"), 0)):
            with self.assertRaises(ValueError):
                airsim360.GeoFrame(*bad)

    def test_shapes_types_and_the_room_itself(self):
        c = ROOM.capture([0, 0, 3], Rig(width=256, products=["rgb", "range", "semantic", "entity", "normal", "position"]))
        for name, shape, kind in (("rgb", (128, 256, 3), np.uint8), ("range", (128, 256), np.float32),
                                  ("semantic", (128, 256), np.uint16), ("entity", (128, 256), np.uint32),
                                  ("normal", (128, 256, 3), np.float32), ("position", (128, 256, 3), np.float32)):
            picture = getattr(c, name)
            self.assertEqual((picture.shape, picture.dtype), (shape, np.dtype(kind)), name)
        with self.assertRaisesRegex(ValueError, "flow"):
            c.flow
        # Range times ray is the point, in W, for every pixel: the pose and the frames fit together.
        x, y = np.meshgrid(np.arange(256) + 0.5, np.arange(128) + 0.5)
        theta, phi = 2 * np.pi * (x / 256 - 0.5), np.pi * (0.5 - y / 128)
        ray = np.stack([np.cos(phi) * np.sin(theta), -np.sin(phi), np.cos(phi) * np.cos(theta)], -1)
        points = (c.range[..., None] * ray) @ c.pose[:3, :3].T + c.pose[:3, 3]
        np.testing.assert_allclose(points, c.position, atol=1e-4)
        self.assertLess(np.abs(np.maximum(np.abs(points[..., 0]), np.abs(points[..., 1]))).max(), 5 + 1e-3)
        # Normals look towards the camera.
        self.assertLess((c.normal * (points - c.pose[:3, 3])).sum(-1).max(), 0)

    def test_pictures_are_views_that_keep_their_memory(self):
        c = ROOM.capture([0, 0, 3], SMALL)
        self.assertFalse(c.rgb.flags.owndata)
        self.assertEqual(c.rgb.__array_interface__["data"], c.rgb.__array_interface__["data"])
        rgb, before = c.rgb, c.rgb.copy()
        del c
        gc.collect()
        for _ in range(4):
            ROOM.capture([1, 1, 3], SMALL)  # would take the memory if it were free
        np.testing.assert_array_equal(rgb, before)

    def test_pose_is_camera_to_world_and_the_quaternion_is_the_same_rotation(self):
        c = ROOM.capture([1, 2, 3], SMALL, yaw=0.3, pitch=0.1, roll=-0.2)
        w, x, y, z = c.q_wxyz
        rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                             [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                             [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
        np.testing.assert_allclose(c.pose[:3, :3], rotation, atol=1e-12)
        np.testing.assert_allclose(c.p, [1, 2, 3])
        # The middle of the panorama is the body's forward axis.
        np.testing.assert_allclose(c.pose[:3, 2], c.body_pose[:3, 0], atol=1e-12)

    def test_turning_by_columns_rolls_every_product(self):
        a = ROOM.capture([0, 1, 2], SMALL, yaw=0.0)
        b = ROOM.capture([0, 1, 2], SMALL, yaw=2 * math.pi * 5 / 256)
        for name in ("rgb", "range", "entity", "semantic"):
            np.testing.assert_array_equal(np.roll(getattr(a, name), 5, axis=1), getattr(b, name))

    def test_flow_follows_the_motion(self):
        sim = Simulation(ROOM, airborne())
        sim.fly_velocity([1, 0, 0])
        sim.run(2)
        c = sim.capture(Rig(width=256, tier="labels", products=["range", "flow"], flow_dt=0.1))
        self.assertEqual(c.flow.shape, (64 * 2, 256, 2))
        # Flying east, what lies north and south moves towards the back: to the left on the left side.
        middle = c.flow[64]
        self.assertLess(middle[64, 0], -0.2)
        self.assertGreater(middle[192, 0], 0.2)

    def test_flow_follows_people(self):
        sim = Simulation(ROOM, airborne([0, 0, 3]), people=4, seed=2)
        sim.run(1)
        c = sim.capture(Rig(width=512, tier="labels", products=["entity", "flow"], flow_dt=0.3))
        people = np.isin(c.entity, [p["entity"] for p in sim.people if np.linalg.norm(p["velocity"]) > 0.5])
        self.assertGreater(people.sum(), 50)
        length = np.hypot(c.flow[..., 0], c.flow[..., 1])
        # The drone hovers: people walk and the room stays.
        self.assertGreater(np.median(length[people]), 1.0)
        self.assertLess(np.median(length[~np.isin(c.entity, [p["entity"] for p in sim.people])]), 0.5)

    def test_flow_knows_where_others_will_be(self):
        sim = Simulation(ROOM, [airborne([0, 0, 2], name="a"), airborne([2, -2, 2], name="b")])
        sim.fly_velocity([0, 1, 0], drone="b")
        sim.run(1.5)
        c = sim.capture(Rig(width=512, tier="labels", products=["entity", "flow"], flow_dt=0.1), "a")
        other = c.flow[c.entity > 7]
        # East of the camera and flying north: to the left, by the angle of 0.1 m seen from where it is.
        x, y = sim.state("b").position[:2] - sim.state("a").position[:2]
        expected = -(math.atan2(y + 0.1, x) - math.atan2(y, x)) * 512 / (2 * math.pi)
        self.assertAlmostEqual(np.median(other[:, 0]), expected, delta=0.25 * abs(expected))
        self.assertLess(np.abs(c.flow[c.entity <= 7]).max(), 0.5, "the room stays")

    def test_without_a_rig_it_is_the_default_one(self):
        self.assertEqual(ROOM.capture([0, 0, 3]).rgb.shape, (512, 1024, 3))
        self.assertEqual((Rig().width, Rig().height), (1024, 512))

    def test_wrong_rigs_are_value_errors(self):
        for options in ({"width": 255}, {"tier": "fsat"}, {"products": ["rgbb"]}, {"projection": "cube"},
                        {"position": [0, 0]}, {"yaw": math.nan}, {"flow_dt": 0}):
            with self.subTest(options), self.assertRaises(ValueError):
                Rig(**options)


class Lidars(unittest.TestCase):
    EXACT = Lidar(channels=8, columns=90, low=-1.2, high=0.4, sigma=0.0)

    def test_points_are_where_rays_meet_the_room(self):
        scan = ROOM.scan([1, -1, 2.5], self.EXACT, yaw=0.3, roll=0.1)
        self.assertEqual((len(scan), scan.shots), (720, 720))
        self.assertEqual((scan.points.shape, scan.points.dtype), ((720, 3), np.float32))
        np.testing.assert_allclose(np.linalg.norm(scan.points, axis=1), scan.range, rtol=1e-5)
        points_W = scan.points @ scan.pose[:3, :3].T + scan.pose[:3, 3]
        distance, entity = ROOM.raycast(np.tile(scan.pose[:3, 3], (720, 1)), points_W - scan.pose[:3, 3])
        np.testing.assert_allclose(distance, scan.range, atol=1e-4)
        np.testing.assert_array_equal(entity, scan.entity)
        kinds = {e["id"]: e["category"] for e in ROOM.entities}
        self.assertEqual([kinds[e] for e in scan.entity], list(scan.semantic))
        self.assertTrue((scan.time <= 0).all() and (0 < scan.intensity).all() and (np.diff(scan.shot.astype(int)) > 0).all())

    def test_noise_has_its_sigma_and_the_scan_outlives_its_owner(self):
        exact = ROOM.scan([0, 0, 3], Lidar(channels=4, columns=500, sigma=0.0)).range
        noisy = ROOM.scan([0, 0, 3], Lidar(channels=4, columns=500, sigma=0.05)).range
        gc.collect()
        self.assertAlmostEqual(float(np.std(noisy - exact)), 0.05, delta=0.01)

    def test_others_are_met_and_the_own_body_is_not(self):
        sim = Simulation(ROOM, [airborne([-1, 0, 2], name="a"), airborne([1, 0, 2], name="b")], people=1)
        lidar = Lidar(channels=64, columns=720, low=-0.5, high=0.5)
        seen = set(np.unique(sim.scan(lidar, "a").entity)) - set(range(1, 8))
        own = {e["name"]: e["id"] for e in sim.entities}
        self.assertIn(own["b"], seen)
        self.assertNotIn(own["a"], seen)

    def test_a_sensor_file_names_its_lidars_and_threads_change_nothing(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write("lidars:\n  - name: top\n    channels: 4\n    columns: 100\n")
            file.flush()
            sim = Simulation(ROOM, airborne(sensors=file.name))

        def scan(threads):
            with airsim360.Threads(threads):
                return sim.scan("top").points.tobytes()
        self.assertEqual(scan(1), scan(2))
        self.assertEqual(sim.scan("top").shots, 400)
        with self.assertRaisesRegex(ValueError, "top"):
            sim.scan("tpo")

    def test_wrong_lidars_are_value_errors(self):
        for options in ({"channels": 0}, {"low": 0.5, "high": 0.1}, {"pattern": "spining"}, {"sigma": math.nan}, {"rate": 0},
                        {"max_range": 0.1}, {"position": [0, 0]}):
            with self.subTest(options), self.assertRaises(ValueError):
                Lidar(**options)


class Flights(unittest.TestCase):
    def test_takeoff_velocity_position_and_landing(self):
        sim = Simulation(ROOM, 1)
        sim.takeoff(height=1.5)
        ground = sim.state().position[2]
        sim.run(4)
        self.assertAlmostEqual(sim.state().position[2], ground + 1.5, delta=0.1)
        sim.fly_to([2, -1, 2])
        sim.run(6)
        np.testing.assert_allclose(sim.state().position, [2, -1, 2], atol=0.1)
        sim.fly_velocity([-1, 0, 0], yaw_rate=0.5)
        sim.run(2)
        np.testing.assert_allclose(sim.state().velocity, [-1, 0, 0], atol=0.15)
        self.assertAlmostEqual(sim.state().angular_velocity[2], 0.5, delta=0.05)
        sim.land()
        sim.run(8)
        self.assertAlmostEqual(sim.state().position[2], ground, delta=0.02)
        self.assertIn("command done", [e["event"] for e in sim.events()])

    def test_hover_speed_carries_the_weight(self):
        drone = airborne()
        sim = Simulation(ROOM, drone)
        sim.set_rotor_speeds([drone.hover_speed] * 4)
        sim.run(1)
        self.assertLess(np.abs(sim.state().velocity).max(), 0.15)
        sim.set_rotor_signals([0, 0, 0, 0])
        sim.run(0.3)
        self.assertLess(sim.state().velocity[2], -1.5)

    def test_attitude_and_rates(self):
        sim = Simulation(ROOM, airborne())
        sim.set_attitude(0.1, 0.0, altitude=2.0)
        sim.run(0.8)
        self.assertAlmostEqual(sim.state().euler[0], 0.1, delta=0.02)
        self.assertLess(sim.state().velocity[1], -0.3, "right side down flies to the right, which is -y here")
        sim.set_rates([0, 0, 1.0], altitude=2.0)
        sim.run(0.8)
        self.assertAlmostEqual(sim.state().angular_velocity[2], 1.0, delta=0.1)

    def test_same_seed_same_bytes_with_any_number_of_threads(self):
        def run(threads):
            with airsim360.Threads(threads):
                sim = Simulation(ROOM, [airborne([x, 0, 2], name=f"d{x}") for x in (-2, 2)], seed=5, wind=[1, 0, 0])
                sim.fly_velocity([0.5, 0.5, 0], drone="d2")
                sim.step(800)
                c = sim.capture(SMALL, drone="d-2")
                return sim.hash(), bytes(c.rgb.data), bytes(c.entity.data)
        self.assertEqual(run(1), run(2))

    def test_a_snapshot_is_restored_exactly(self):
        sim = Simulation(ROOM, airborne())
        sim.fly_velocity([0.7, 0.2, 0.1])
        sim.run(0.5)
        snapshot = sim.snapshot()
        sim.run(0.5)
        after = sim.hash()
        sim.restore(snapshot)
        self.assertEqual(sim.hash(), snapshot.hash)
        self.assertEqual(sim.t, snapshot.t)
        sim.run(0.5)
        self.assertEqual(sim.hash(), after)
        with self.assertRaises(ValueError):
            Simulation(ROOM, airborne()).restore(snapshot)

    def test_drones_see_each_other_but_not_themselves(self):
        sim = Simulation(ROOM, [airborne([-1, 0, 2], name="a"), airborne([1, 0, 2], name="b")])
        rig = Rig(width=512, tier="labels")
        seen = sim.capture(rig, "a").entity
        others = set(np.unique(seen)) - set(range(1, 8))
        self.assertEqual(len(others), 1)
        self.assertNotEqual(others, set(np.unique(sim.capture(rig, "b").entity)) - set(range(1, 8)))
        self.assertEqual(set(np.unique(Simulation(ROOM, airborne()).capture(rig).entity)) - set(range(1, 8)), set())

    def test_people_walk_and_are_seen(self):
        def run():
            sim = Simulation(ROOM, airborne([0, 0, 3]), people=3, seed=2)
            before = [p["position"] for p in sim.people]
            sim.run(2)
            return sim, before
        sim, before = run()
        self.assertEqual(len(sim.people), 3)
        entities = {e["id"]: e["category_path"] for e in sim.entities}
        for person in sim.people:
            self.assertTrue(entities[person["entity"]].startswith("person") or "person" in entities[person["entity"]])
            self.assertLess(np.abs(person["position"][:2]).max(), 5)
        self.assertGreater(sum(np.linalg.norm(p["position"] - b) for p, b in zip(sim.people, before)), 0.1)
        seen = set(np.unique(sim.capture(Rig(width=512, tier="labels")).entity))
        self.assertGreaterEqual(len(seen & {p["entity"] for p in sim.people}), 1)
        self.assertEqual(sim.hash(), run()[0].hash())

    def test_a_recording_repeats_the_flight(self):
        sim = Simulation(ROOM, airborne())
        start = sim.snapshot()
        sim.start_recording("test")
        sim.fly_velocity([1, 0, 0])
        sim.run(0.5)
        recording = sim.stop_recording()
        with tempfile.TemporaryDirectory() as folder:
            recording.write(os.path.join(folder, "run.a360"))
            read = airsim360.Recording.read(os.path.join(folder, "run.a360"))
        result = sim.replay(read, start)
        self.assertEqual((result["same"], result["hash"], result["steps"]), (True, sim.hash(), 500))

    def test_collisions_are_told(self):
        sim = Simulation(ROOM, airborne([3, 3, 3]))
        sim.fly_velocity([3, 0, 0])
        sim.run(2)
        collision = sim.state().collision
        np.testing.assert_allclose(collision["normal"], [-1, 0, 0], atol=1e-6)
        self.assertAlmostEqual(collision["point"][0], 5, delta=1e-3)
        self.assertEqual(ROOM.entities[collision["entity"] - 1]["id"], collision["entity"])

    def test_bad_commands_are_value_errors_and_change_nothing(self):
        sim = Simulation(ROOM, airborne())
        before = sim.hash()
        for wrong in (lambda: sim.fly_velocity([math.nan, 0, 0]), lambda: sim.fly_to([0, 0]), lambda: sim.hover(drone=1),
                      lambda: sim.set_rotor_speeds([1, 2]), lambda: sim.set_attitude(0, 0), lambda: sim.step(-1),
                      lambda: sim.hover(yaw=1.0, yaw_rate=1.0), lambda: sim.state("drone9"),
                      lambda: Simulation(ROOM, 1, people=-3), lambda: Simulation(ROOM, 1, dt=0),
                      lambda: Simulation(ROOM, ["hummingbrid"])):
            with self.assertRaises(ValueError):
                wrong()
        self.assertEqual(sim.hash(), before)

    def test_other_threads_run_while_it_steps(self):
        sim = Simulation(ROOM, airborne())
        turns = 0
        worker = threading.Thread(target=lambda: sim.step(20000))
        worker.start()
        while worker.is_alive():
            turns += 1
            sim.t_ns
        self.assertGreater(turns, 10)

    def test_sensors_read(self):
        sim = Simulation(ROOM, airborne())
        sim.run(0.5)
        sensors = sim.state().sensors
        np.testing.assert_allclose(sensors["imu"]["specific_force"], [0, 0, 9.81], atol=0.5)
        self.assertGreater(sensors["barometer"]["pressure"], 9e4)


class Drones(unittest.TestCase):
    def test_words_name_and_file_give_drones(self):
        words = Drone.from_words("a 250 g five-inch racing quad with a 4S battery")
        self.assertAlmostEqual(words.mass, 0.25)
        self.assertEqual(len(words.rotors), 4)
        self.assertTrue(words.laws)
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write(words.yaml)
            file.flush()
            self.assertEqual(Drone(file.name).yaml.split("prompt")[0], words.yaml.split("prompt")[0])
        self.assertIn("hummingbird", airsim360.drone_catalog())
        with self.assertRaisesRegex(ValueError, "hummingbird"):
            Drone("humingbird")
        with self.assertRaises(ValueError):
            Drone.from_words("a drone with eleven rotors and a piano")


class Planning(unittest.TestCase):
    def test_one_segment_from_rest_to_rest_is_the_known_septic(self):
        plan = airsim360.plan_minimum_snap([[0, 0, 0], [1, -2, 0]], times=[0, 2])
        self.assertEqual(plan.coefficients.shape, (1, 3, 8))
        s = np.array([0, 0, 0, 0, 35, -84, 70, -20]) / 2.0 ** np.arange(8)
        np.testing.assert_allclose(plan.coefficients[0, 0], s, atol=1e-12)
        np.testing.assert_allclose(plan.coefficients[0, 1], -2 * s, atol=1e-12)
        self.assertAlmostEqual(plan.cost_snap, 100800 * 5 / 2 ** 7, places=6)
        np.testing.assert_allclose(plan.times, [0, 2])

    def test_limits_hold_and_samples_are_the_polynomials(self):
        points = np.array([[-3, -3, 2], [3, -3, 3], [3, 3, 2], [-3, 3, 3]], float)
        plan = airsim360.plan_minimum_snap(points, vmax=3, amax=4, world=ROOM, clearance=0.1)
        self.assertLessEqual(plan.max_speed, 3 * (1 + 1e-9))
        self.assertLessEqual(plan.max_acceleration, 4 * (1 + 1e-9))
        np.testing.assert_allclose(plan.at(plan.times)["p"], points, atol=1e-9)
        samples = plan.sample(0.01)
        t, v = samples["t"], samples["v"]
        np.testing.assert_allclose(np.gradient(samples["p"], t, axis=0)[5:-5], v[5:-5], atol=2e-3)
        # Proved exactly as far as the room allows.
        least = ROOM.clearance(samples["p"]).min()
        for share, free in ((0.98, True), (1.02, False)):
            checked = airsim360.plan_minimum_snap(points, vmax=3, amax=4, world=ROOM, clearance=share * least)
            self.assertEqual(checked.certificate["certified"], free)

    def test_other_limits_and_moving_ends(self):
        points = np.array([[0, 0, 0], [0, 0, 20], [30, 20, 5]], float)
        plan = airsim360.plan_minimum_snap(points, vmax=40, amax=40, limits=dict(climb=2, axis_amax=[1.5, 40, 40]))
        samples = plan.sample(plan.duration / 4000)
        climb, push = samples["v"][:, 2].max(), np.abs(samples["a"][:, 0]).max()
        self.assertLessEqual(climb, 2 + 1e-9)
        self.assertLessEqual(push, 1.5 + 1e-9)
        self.assertGreater(max(climb / 2, push / 1.5), 1 - 1e-3)
        plan = airsim360.plan_minimum_snap(points, vmax=8, amax=6, start=[[1, 2, 0], [0.5, 0, 0]], end=[[0, 0, -1]])
        ends = plan.at([0, plan.duration])
        np.testing.assert_allclose(ends["v"], [[1, 2, 0], [0, 0, -1]], atol=1e-9)
        np.testing.assert_allclose(ends["a"], [[0.5, 0, 0], [0, 0, 0]], atol=1e-8)
        self.assertLessEqual(plan.max_speed, 8)
        self.assertGreater(max(plan.max_speed / 8, plan.max_acceleration / 6), 1 - 1e-4)
        jerk = [(airsim360.plan_minimum_snap(points, times=[0, 4, 9], order=5, minimise=m).sample(1e-3)["jerk"] ** 2).sum()
                for m in ("snap", "jerk")]
        self.assertLess(jerk[1], 0.999 * jerk[0])

    def test_avoid_goes_around_the_cube(self):
        ends = [[1.5, 0, 0.5], [4.5, 0, 0.5]]
        through = airsim360.plan_minimum_snap(ends, world=ROOM, clearance=0.3)
        self.assertFalse(through.certificate["certified"])
        around = airsim360.plan_minimum_snap(ends, world=ROOM, clearance=0.3, avoid=True)
        self.assertTrue(around.certificate["certified"])
        self.assertGreaterEqual(ROOM.clearance(around.sample(0.02)["p"]).min(), 0.3 - 1e-3)

    def test_a_drone_flies_it(self):
        plan = airsim360.plan_minimum_snap([[-3, -3, 2], [0, 3, 3], [3, -2, 2]], vmax=3, amax=3)
        sim = Simulation(ROOM, airborne([-3, -3, 2]))
        sim.fly_trajectory(plan, yaw=0.0)
        errors = []
        while sim.t < plan.duration:
            sim.step(50)
            errors.append(np.linalg.norm(sim.state().position - plan.at([sim.t])["p"][0]))
        self.assertLess(max(errors), 0.15)

    def test_bad_problems_are_value_errors(self):
        for arguments in (dict(waypoints=[[0, 0, 0]]), dict(waypoints=[[0, 0, 0], [1, 0, math.inf]]),
                          dict(waypoints=[[0, 0, 0], [1, 0, 0]], times=[0, 0]), dict(waypoints=[[0, 0], [1, 0]]),
                          dict(waypoints=[[0, 0, 0], [1, 0, 0]], order=6), dict(waypoints=[[0, 0, 0], [1, 0, 0]], vmax=-1),
                          dict(waypoints=[[0, 0, 0], [1, 0, 0]], avoid=True),
                          dict(waypoints=[[0, 0, 0], [1, 0, 0]], limits=dict(climbs=1)),
                          dict(waypoints=[[0, 0, 0], [1, 0, 0]], limits=dict(climb=-1)),
                          dict(waypoints=[[0, 0, 0], [1, 0, 0]], minimise="jerk"),
                          dict(waypoints=[[0, 0, 0], [1, 0, 0]], start=[[9, 0, 0]])):
            with self.subTest(arguments), self.assertRaises(ValueError):
                airsim360.plan_minimum_snap(**arguments)


class Metrics(unittest.TestCase):
    def test_psnr_is_its_formula(self):
        random = np.random.default_rng(1)
        a, b = (random.integers(0, 256, (32, 64, 3), np.uint8) for _ in range(2))
        error = ((a.astype(float) - b) ** 2).mean()
        self.assertAlmostEqual(airsim360.metrics.psnr(a, b), 10 * math.log10(255 ** 2 / error), places=9)
        weights = np.cos(np.pi * ((np.arange(32) + 0.5) / 32 - 0.5))
        weighted = (((a.astype(float) - b) ** 2).mean((1, 2)) * weights).sum() / weights.sum()
        self.assertAlmostEqual(airsim360.metrics.ws_psnr(a, b), 10 * math.log10(255 ** 2 / weighted), places=6)
        self.assertEqual(airsim360.metrics.psnr(a, a), math.inf)
        self.assertAlmostEqual(airsim360.metrics.ssim(a, a), 1)
        self.assertEqual(airsim360.metrics.flip(a, a).max(), 0)
        # A part of a picture is a strided array.
        self.assertAlmostEqual(airsim360.metrics.psnr(a[:, ::2], a[:, ::2]), math.inf)

    def test_navigation_scores(self):
        path, reference = [[0, 0, 0], [3, 4, 0]], [[0, 0, 0], [3, 4, 0]]
        self.assertEqual(airsim360.metrics.path_length(path), 5)
        self.assertEqual(airsim360.metrics.spl(True, 5, 10), 0.5)
        self.assertEqual(airsim360.metrics.ndtw(path, reference, 3), 1)

    def test_wrong_pictures_are_value_errors(self):
        a = np.zeros((16, 32, 3), np.uint8)
        for other in (np.zeros((16, 30, 3), np.uint8), np.zeros((16, 32), np.uint8), np.zeros((16, 32, 3))):
            with self.assertRaises(ValueError):
                airsim360.metrics.psnr(a, other)


class Missions(unittest.TestCase):
    TREE = """<root BTCPP_format="4"><BehaviorTree ID="m"><Sequence>
<Takeoff height="1.5"/><Goto to="-2;2;2"/><Capture count="3" every_s="0.5"/><Land/>
</Sequence></BehaviorTree></root>"""

    def simulation(self, **options):
        return Simulation(ROOM, drones=Drone("hummingbird", position=(-2, -2, 0.5)), **options)

    def test_a_mission_ends_with_the_pictures_of_its_instants(self):
        sim = self.simulation()
        done = sim.fly_mission(self.TREE, rig=Rig(width=64))
        self.assertEqual((done["result"], done["log"], done["active"]), ("success", [], []))
        self.assertEqual([b["t_ns"] - a["t_ns"] for a, b in zip(done["captures"], done["captures"][1:])], [500_000_000] * 2)
        for capture in done["captures"]:
            self.assertEqual(capture["picture"].t_ns, capture["t_ns"])
            np.testing.assert_allclose(capture["position"], [-2, 2, 2], atol=0.15)
            np.testing.assert_allclose(capture["picture"].pose[:3, 3], capture["position"], atol=1e-9)
        self.assertAlmostEqual(sim.state().position[2], self.simulation().state().position[2], delta=0.02)  # it stands again

    def test_it_flies_as_the_command_does_and_as_its_recording_says(self):
        sim = self.simulation()
        start = sim.snapshot()
        sim.start_recording("mission")
        done = sim.fly_mission(self.TREE)
        self.assertIsNone(done["captures"][0]["picture"])
        replay = sim.replay(sim.stop_recording(), start)
        self.assertTrue(replay["same"])
        self.assertEqual(replay["hash"], sim.hash())
        if "AIRSIM360" not in os.environ:
            return
        with tempfile.TemporaryDirectory() as place:
            path = os.path.join(place, "m.xml")
            with open(path, "w") as file:
                file.write(self.TREE)
            subprocess.run([os.environ["AIRSIM360"], "fly", "--world", "box_room", "--pose=-2,-2,0.5", "--mission", path, "--size", "32x16", "--tier", "labels", "--out", place + "/out"],
                           check=True, capture_output=True)
            frames = airsim360.Dataset(place + "/out/captures")
            for frame, capture in zip(frames, done["captures"]):
                np.testing.assert_allclose(frame.pose[:3, 3], capture["position"], atol=1e-9)

    def test_mistakes_and_missing_files_are_value_errors(self):
        sim = self.simulation()
        with self.assertRaisesRegex(ValueError, "mission:2: Goto to: no thing, person or vehicle 'bux' in the world; did you mean 'box'"):
            sim.fly_mission(self.TREE.replace("-2;2;2", "bux"))
        with self.assertRaisesRegex(ValueError, "nothing.xml"):
            sim.fly_mission("nothing.xml")
        for timeout in (0, -1, math.nan, 1e300):
            with self.assertRaises(ValueError):
                sim.fly_mission(self.TREE, timeout=timeout)
        self.assertEqual(sim.fly_mission(self.TREE, timeout=1)["result"], "stopped")


class Arguments(unittest.TestCase):
    def test_a_field_of_view_in_degrees_is_told_apart(self):
        for projection, fov, said in (("pinhole", 90, "did you mean 1.571"), ("pinhole", 3.2, "the nearest is 3.1241|did you mean"),
                                      ("pinhole", 0, "the nearest is 0.0175"), ("pinhole", -1, "the nearest is 0.0175"),
                                      ("fisheye", 180, "did you mean 3.142"), ("pinhole", math.nan, "fov: nan")):
            with self.subTest(projection, fov=fov), self.assertRaisesRegex(ValueError, said):
                Rig(64, projection=projection, fov=fov)
        self.assertEqual(Rig(64, projection="pinhole", fov=math.radians(179)).width, 64)

    def test_colour_is_not_left_out_in_silence(self):
        with self.assertRaisesRegex(ValueError, "products: 'rgb' needs light"):
            Rig(tier="labels", products=["rgb", "range"])
        # Nor is anything else that the tier makes nothing of.
        for setting in ({"tone": "agx"}, {"exposure": 1.0}, {"lens": "real360"}, {"look": "photo"}, {"samples": 8}, {"denoise": False},
                        {"edge_samples": 4}):
            name, = setting
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"{name}: tier 'labels' has no use for it"):
                Rig(64, tier="labels", **setting)
        Rig(64, tier="labels", edge_samples=4, products=["coverage"])
        self.assertNotIn("rgb", ROOM.capture([0, 0, 3], Rig(64, tier="labels")).products)
        self.assertIn("rgb", ROOM.capture([0, 0, 3], Rig(64)).products)

    def test_unknown_keywords_are_told_all_that_there_are(self):
        for wrong, right in (("product", "products"), ("heigth", "height")):
            with self.assertRaisesRegex(ValueError, f"unknown keyword '{wrong}'; did you mean '{right}'"):
                Rig(**{wrong: 5})

    def test_numbers_that_are_no_whole_ones_name_the_nearest(self):
        sim = Simulation(ROOM)
        for call, said in ((lambda: World("box_room", seed=-1), "seed: -1 is not in 0 … 18446744073709551615; the nearest is 0"),
                           (lambda: World("box_room", seed=2**64), "the nearest is 18446744073709551615"),
                           (lambda: Rig(width=-1), "width: -1 is not in 1 … 16384; the nearest is 1"),
                           (lambda: Rig(width=256.0), "width: 256.0 is not a whole number; did you mean 256"),
                           (lambda: sim.step(1.5), "n: 1.5 is not a whole number; did you mean 2"),
                           (lambda: sim.step(-1), "n: -1 is not in 0"),
                           (lambda: Simulation(ROOM, people=-1), "people: -1 is not in 0 … 10000"),
                           (lambda: Simulation(ROOM, seed="a"), "seed: 'a' is not a whole number")):
            with self.subTest(said), self.assertRaisesRegex(ValueError, said):
                call()
        self.assertEqual(Rig(np.int64(64), np.uint8(32)).height, 32)

    def test_one_point_one_direction_and_one_time_will_do(self):
        distance, entity = ROOM.raycast([0, 0, 3], [0, 0, -1])
        self.assertEqual((distance.shape, float(distance)), ((), 3))
        many, entities = ROOM.raycast([[0, 0, 3], [1, 0, 2]], [0, 0, -1])
        np.testing.assert_allclose(many, [3, 2], atol=1e-5)
        self.assertEqual(entities[0], entity)
        np.testing.assert_allclose(ROOM.raycast([0, 0, 3], [[0, 0, -1], [0, 0, 1]])[0], [3, 3], atol=1e-5)
        self.assertAlmostEqual(float(ROOM.clearance([0, 0, 3])), 3, places=5)
        with self.assertRaisesRegex(ValueError, "2 origins and 3 directions"):
            ROOM.raycast(np.zeros((2, 3)), np.ones((3, 3)))
        plan = airsim360.plan_minimum_snap([[0, 0, 1], [2, 0, 1]])
        one, row = plan.at(0.5), plan.at([0.5])
        self.assertEqual((one["p"].shape, float(one["t"])), ((3,), 0.5))
        np.testing.assert_array_equal(one["p"], row["p"][0])

    def test_worlds_are_exported_as_what_they_are_called(self):
        with tempfile.TemporaryDirectory() as place:
            for name in ("e.obj", "e.xyz", "e"):
                with self.assertRaisesRegex(ValueError, "did you mean '.*e.glb'"):
                    ROOM.export(os.path.join(place, name))
            self.assertEqual(os.listdir(place), [])

    def test_a_plan_through_a_wall_warns(self):
        with self.assertWarnsRegex(UserWarning, "plan_minimum_snap: .*avoid=True"):
            plan = airsim360.plan_minimum_snap([[0, 0, 1], [20, 0, 1]], world=ROOM)
        self.assertFalse(plan.certificate["certified"])

    def test_winds_have_the_bound_of_the_server(self):
        for call in (lambda: Simulation(ROOM).set_wind([1e6, 0, 0]), lambda: Simulation(ROOM, wind=[1e6, 0, 0])):
            with self.assertRaisesRegex(ValueError, "more than 200; the nearest is \\(200, 0, 0\\)"):
                call()


class Interrupts(unittest.TestCase):
    """Each call begins in a process of its own; Ctrl-C comes while it lasts."""

    def check(self, call):
        code = ("import airsim360 as a\nw = a.World('box_room')\nsim = a.Simulation(w)\nprint('ready', flush=True)\n"
                f"try:\n    {call}\nexcept KeyboardInterrupt:\n    print('interrupted', sim.t > 0, sim.step(1))")
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
            try:
                self.assertEqual(process.stdout.readline(), "ready\n")
                time.sleep(1)
                process.send_signal(signal.SIGINT)
                out, _ = process.communicate(timeout=60)
            finally:
                process.kill()
        return out.split()

    def test_runs_steps_and_waits_end_between_two_steps(self):
        for call in ("sim.run(1e6)", "sim.step(10**12)", "sim.takeoff(1000); sim.wait(timeout=1e6)"):
            with self.subTest(call):
                self.assertEqual(self.check(call), ["interrupted", "True", "None"])

    def test_large_pictures_are_given_up(self):
        # Long enough to be in the middle of one when the signal comes.
        many = "[w.capture([0, 0, 1], a.Rig(width=16384)) for _ in range(100)]"
        self.assertEqual(self.check(many)[0], "interrupted")

    def test_slices_change_no_byte(self):
        whole, parts = Simulation(ROOM, seed=3), Simulation(ROOM, seed=3)
        whole.takeoff(1)
        parts.takeoff(1)
        whole.run(0.5)
        for _ in range(100):
            parts.step(5)
        self.assertEqual(whole.hash(), parts.hash())


class Package(unittest.TestCase):
    def test_every_name_of_the_module_is_one_of_the_package(self):
        for name in dir(airsim360._native):
            if not name.startswith("_"):
                self.assertTrue(hasattr(airsim360, name), name)

    def test_the_airsim_client_needs_no_compiled_module(self):
        code = ("import sys; sys.modules['airsim360._native'] = None\n"
                "import airsim360.airsim as airsim; airsim.MultirotorClient\n"
                "import airsim360\n"
                "try: airsim360.World\nexcept ImportError: print('told')")
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual(done.stdout.strip(), "told", done.stderr)


if __name__ == "__main__":
    unittest.main()
