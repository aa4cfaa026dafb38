"""Episodes in the forms of public benchmarks: hand-made samples come back as they were, and ours keep what those forms hold."""
import json
import math
import tempfile
import unittest
from pathlib import Path

from vln_tools import lines, make_room, run

HALF = math.sqrt(0.5)
# Records as their papers and code describe them, with fields that we do not read. North, east, down where their simulators are AirSim's.
SAMPLES = {
    "aerialvln": {"episodes": [{"episode_id": "A1", "trajectory_id": "T1", "scene_id": 3, "instruction": {"instruction_text": "Go north.", "tokens": [4, 5]},
                                "start_position": [1.0, 2.0, -3.0], "start_rotation": [HALF, 0.0, 0.0, HALF], "goals": [{"position": [11.0, 2.0, -3.0], "radius": 20.0}],
                                "reference_path": [[1.0, 2.0, -3.0], [11.0, 2.0, -3.0]], "actions": [1, 1, 0]}]},
    "openfly": [{"image_path": "env/1", "gpt_instruction": "Go east.", "action": [8, 0], "index_list": ["0", "1"], "pos": [[0.0, 0.0, 5.0], [6.0, 0.0, 5.0]],
                 "yaw": [0.5, 0.5]}],
    "citynav": [{"area": "birmingham", "block": "4", "object_ids": [7], "ann_ids": [2], "descriptions": ["The red house."],
                 "trajectory": [[0.0, 0.0, 30.0, 1.0, 0.0], [10.0, 5.0, 30.0, 1.0, 0.0]], "marker_positions": [], "target_positions": [[10.0, 5.0, 2.0]],
                 "split": "val_seen"}],
    "traveluav": [{"trajectory_raw_detailed": [[0.0, 0.0, -2.0], [3.0, 4.0, -2.0]], "start_yaw": 0.25, "conversations": [{"from": "human", "value": "Find the car."}],
                   "mark": {"object_name": "car", "target": {"position": [3.0, 4.0, -1.0], "asset": "x"}}}],
    "uavon": {"episodes": [{"episode_id": "9", "map_name": "Barn", "true_name": "tractor", "size": "big", "pose": [[5.0, 0.0, -1.0], [6.0, 0.0, -1.0]],
                            "start_pose": {"start_position": [0.0, 0.0, -1.0], "start_quaternionr": [1.0, 0.0, 0.0, 0.0]}, "description": "Find the tractor.",
                            "info": {"euclidean_distance": 5.0, "geodesic_distance": 5.0}}]},
}


def near(a, b):
    """Equal but for the rounding of numbers to a thousandth, and of quaternions."""
    if isinstance(a, dict):
        return isinstance(b, dict) and a.keys() == b.keys() and all(near(a[k], b[k]) for k in a)
    if isinstance(a, list):
        return isinstance(b, list) and len(a) == len(b) and all(map(near, a, b))
    return abs(a - b) < 1e-3 if isinstance(a, (int, float)) and isinstance(b, (int, float)) else a == b


class Exchange(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def bring(self, form, sample, status=0):
        source, out = self.path / "in.json", self.path / "episodes.jsonl"
        source.write_text(json.dumps(sample), encoding="utf-8")
        return run("vln", "import", source, "--format", form, "--world", "box_room", "--out", out, status=status), out

    def test_hand_made_samples_come_back_as_they_were(self):
        for form, sample in SAMPLES.items():
            _, episodes = self.bring(form, sample)
            back = self.path / "back.json"
            run("vln", "export", episodes, "--format", form, "--out", back)
            again = json.loads(back.read_text(encoding="utf-8"))
            self.assertTrue(near(sample, again), f"{form}\n{sample}\n{again}")

    def test_north_east_down_becomes_east_north_up(self):
        _, episodes = self.bring("aerialvln", SAMPLES["aerialvln"])
        episode = lines(episodes)[0]
        self.assertEqual(episode["start"]["p"], [2, 1, 3])
        self.assertEqual(episode["goal"]["position"], [2, 11, 3])
        # Turned by 90 degrees clockwise from north: east.
        self.assertAlmostEqual(episode["start"]["yaw_deg"], 0, delta=1e-3)

    def test_ours_keep_words_start_and_goal_in_every_form(self):
        ours = make_room(self.path, 2)
        for form in SAMPLES:
            out = self.path / f"{form}.json"
            run("vln", "export", ours, "--format", form, "--out", out)
            _, episodes = self.bring(form, json.loads(out.read_text(encoding="utf-8")))
            for before, after in zip(lines(ours), lines(episodes), strict=True):
                self.assertEqual(after["instruction"], before["instruction"], form)
                self.assertTrue(near(after["start"]["p"], before["start"]["p"]), form)
                self.assertTrue(near(after["goal"]["position"], before["goal"]["position"]), form)
                self.assertAlmostEqual(math.cos(math.radians(after["start"]["yaw_deg"] - before["start"]["yaw_deg"])), 1, delta=1e-6, msg=form)

    def test_imported_episodes_fly_but_are_not_called_proved(self):
        sample = [{**SAMPLES["openfly"][0], "pos": [[-3.0, -3.0, 2.0], [-3.0, 3.0, 2.0]], "yaw": [1.5, 1.5]}]
        _, episodes = self.bring("openfly", sample)
        scores = json.loads(run("vln", "run", episodes, "--out", self.path / "r.jsonl", "--json").stdout)
        self.assertEqual(scores["sr"], 1)
        self.assertIn("imported", run("vln", "check", episodes, status=1).stdout)

    def test_broken_records_are_named(self):
        for form, change, says in (("aerialvln", lambda r: r["episodes"][0].pop("goals"), "[0].goals"),
                                   ("aerialvln", lambda r: r["episodes"][0].update(start_rotation=[1, 0, 0]), "start_rotation"),
                                   ("uavon", lambda r: r["episodes"][0].update(pose=[]), "[0].pose"),
                                   ("openfly", lambda r: r[0].update(yaw=["north"]), "yaw"),
                                   ("citynav", lambda r: r[0].update(trajectory=[[1, 2]]), "trajectory[0]"),
                                   ("traveluav", lambda r: r[0].update(conversations=[]), "conversations")):
            sample = json.loads(json.dumps(SAMPLES[form]))
            change(sample)
            done, _ = self.bring(form, sample, status=2)
            self.assertIn(says, done.stderr)
        done, _ = self.bring("aerialvnl", SAMPLES["aerialvln"], status=2)
        self.assertIn("aerialvln", done.stderr)


if __name__ == "__main__":
    unittest.main()
