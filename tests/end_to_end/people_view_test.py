"""Where cameras are: near people by default, inside of worlds, close enough together for flow."""
import json
import math
import os
import tempfile
import unittest

from program import ProgramTest, read_json, run, tree

TOWN = ["--world", "downtown_west", "--people", "24", "--tier", "labels", "--size", "512x256"]


# One cache for all of them: the town is built once.
CACHE = tempfile.TemporaryDirectory()


def setUpModule():
    os.environ["AIRSIM360_CACHE"] = os.environ.get("AIRSIM360_CACHE") or CACHE.name


def tearDownModule():
    CACHE.cleanup()


def lines(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


class NearPeople(ProgramTest):
    def test_the_auto_route_goes_where_people_are_and_says_how_many_were_seen(self):
        out = self.folder / "town"
        report = json.loads(self.run_ok("collect", *TOWN, "--frames", "8", "--json", "--out", out).stdout)
        self.assertTrue(read_json(out / "meta.json")["parameters"]["route"].startswith("auto, near people"))
        large, seen, views = set(), set(), 0
        for frame in lines(out / "people.jsonl"):
            p = frame["camera"]["X_WC"]["p"]
            persons = frame["persons"]
            views += len(persons)
            seen |= {person["track_id"] for person in persons if person["area"] > 0}
            large |= {person["track_id"] for person in persons if person["area"] >= 100}
            near = [person for person in persons if math.dist(person["position_world"], p) < 15 and person["area"] > 0]
            self.assertTrue(near, frame["stem"])
            heights = [p[2] - person["position_world"][2] for person in near]
            self.assertTrue(1.9 <= min(heights, key=abs) <= 6.5, heights)
        self.assertEqual((report["people_seen"], report["people_seen_100px"], report["person_views"]), (len(seen), len(large), views))
        self.assertGreaterEqual(len(large), 8)
        self.assertEqual(report["person_views_seen"], sum(p["area"] > 0 for f in lines(out / "people.jsonl") for p in f["persons"]))

    def test_the_same_bytes_with_one_thread_and_in_shards(self):
        out = [self.folder / name for name in ("one", "two", "part")]
        for folder, flags in zip(out, (["--threads", "1"], ["--threads", "2"], ["--shard", "1/2"])):
            self.run_ok("collect", "--world", "box_room", "--people", "6", "--frames", "4", "--size", "64x32", *flags, "--out", folder)
        self.assertEqual(tree(out[0]), tree(out[1]))
        part = {name: sha for name, sha in tree(out[2]).items() if "/" in name}
        self.assertLessEqual(part.items(), tree(out[0]).items())

    def test_the_default_pose_of_render_shows_people(self):
        out = self.folder / "out"
        report = json.loads(self.run_ok("render", *TOWN, "--json", "--out", out).stdout)
        self.assertGreaterEqual(report["people_seen_100px"], 1)
        result = self.run_ok("render", *TOWN[:-1], "768x576", "--projection", "pinhole", "--out", self.folder / "narrow")
        self.assertRegex(result.stdout, r"people: [1-9]\d* of 24 have pixels, [1-9]")

    def test_a_dataset_without_people_to_be_seen_is_warned_of(self):
        result = self.run_ok("render", *TOWN, "--pose", "0,0,150", "--out", self.folder / "high")
        self.assertIn("warning: few people", result.stderr)
        result = self.run_ok("render", *TOWN[:2], *TOWN[4:], "--out", self.folder / "empty")
        self.assertNotIn("people", result.stdout + result.stderr)

    def test_the_card_lists_the_files_of_people(self):
        out = self.folder / "out"
        self.run_ok("collect", "--world", "box_room", "--people", "4", "--frames", "2", "--size", "64x32", "--format",
                    "native,coco_keypoints,kitti", "--out", out)
        card = (out / "README.md").read_text()
        for name in ("people.jsonl", "keypoint_orders.json", "person_keypoints.json", "kitti/label_2"):
            self.assertIn(name, card)
            self.assertTrue((out / name).exists(), name)


class FirstFrames(ProgramTest):
    def collect(self, name, *flags, ok=True):
        out = self.folder / name
        result = run("collect", "--world", "box_room", "--size", "32x16", "--tier", "labels", *flags, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        return out, result.stderr

    def test_the_first_frames_at_a_rate_are_those_of_the_whole(self):
        some, _ = self.collect("some", "--fps", "10", "--frames", "12")
        whole, _ = self.collect("whole", "--fps", "10", "--frames", "40")
        later, _ = self.collect("later", "--fps", "10", "--frames", "5", "--start", "2.5")
        some, whole, later = (lines(out / "frames.jsonl") for out in (some, whole, later))
        self.assertEqual([f["t_ns"] for f in some], [100_000_000 * i for i in range(12)])
        self.assertEqual([f["X_WC"] for f in some], [f["X_WC"] for f in whole[:12]])
        self.assertEqual([f["X_WC"] for f in later], [f["X_WC"] for f in whole[25:30]])

    def test_more_frames_than_the_flight_has_are_refused(self):
        out = self.folder / "out"
        self.run_bad(2, "collect", "--world", "box_room", "--fps", "5", "--frames", "999999", "--out", out, says=["--frames", "999999"])
        self.run_bad(2, "collect", "--world", "box_room", "--fps", "5", "--start", "1e6", "--out", out, says=["--start", "lasts"])
        self.run_bad(2, "collect", "--world", "box_room", "--start", "3", "--out", out, says=["--start", "--fps"])
        self.assertFalse(out.exists())

    def test_flow_between_frames_far_apart_is_warned_of_once(self):
        _, far = self.collect("far", "--frames", "6", "--products", "flow")
        _, near = self.collect("near", "--frames", "6", "--fps", "10", "--products", "flow")
        _, plain = self.collect("plain", "--frames", "6")
        self.assertEqual((far.count("--products flow"), near.count("--products flow"), plain.count("flow")), (1, 0, 0))


class Whereabouts(ProgramTest):
    def render(self, pose, *flags, world="box_room"):
        return run("render", "--world", world, "--pose", pose, "--size", "32x16", "--tier", "labels", *flags, "--out", self.folder / pose)

    def test_outside_of_a_room_is_an_error_before_anything_is_written(self):
        for pose in ("100,100,100", "-5.01,0,2", "0,0,-0.01", "0,0,6.01", "3,0,-40"):
            self.run_bad(2, "render", "--world", "box_room", "--pose", pose, "--size", "32x16", "--out", self.folder / "out",
                         says=["camera at", "outside", "box_room"])
        (self.folder / "poses.csv").write_text("0,0,2\n9,9,2\n")
        self.run_bad(2, "collect", "--world", "box_room", "--poses", self.folder / "poses.csv", "--out", self.folder / "out",
                     says=["frame 1", "9, 9, 2", "outside"])
        self.assertFalse((self.folder / "out").exists())

    def test_inside_of_a_solid_is_said(self):
        for pose, name in (("3,0,0.5", "box"), ("2.51,-0.49,0.99", "box")):
            result = self.render(pose)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f"inside '{name}'", result.stderr)

    def test_ordinary_places_are_not_remarked_upon(self):
        for pose in ("0,0,2", "2.49,0,0.5", "-4.99,-4.99,0.01", "4.9,4.9,5.99"):
            result = self.render(pose)
            self.assertEqual((result.returncode, result.stderr.count("inside"), result.stderr.count("outside")), (0, 0, 0), pose)
        result = self.render("0,0,300", world="downtown_west")
        self.assertEqual((result.returncode, result.stderr.count("inside")), (0, 0), result.stderr)

    def test_below_the_ground_of_a_town_is_said(self):
        self.assertIn("is inside", self.render("0,0,-3", world="downtown_west").stderr)


if __name__ == "__main__":
    unittest.main()
