"""Demonstrations read back by readers written from the published descriptions of TFRecord, tf.train.Example and Parquet's users."""
import json
import math
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

from vln_tools import jpeg_size, lines, make_room, run


def crc32c(data):
    """RFC 3720, bit by bit."""
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x82F63B78 if crc & 1 else 0)
    return crc ^ 0xFFFFFFFF


def masked(crc):
    return ((crc >> 15 | crc << 17) + 0xA282EAD8) & 0xFFFFFFFF


def records(data):
    at = 0
    while at < len(data):
        length, crc = struct.unpack_from("<QI", data, at)
        assert crc == masked(crc32c(data[at:at + 8]))
        body = data[at + 12:at + 12 + length]
        (crc,) = struct.unpack_from("<I", data, at + 12 + length)
        # Bit by bit over megabytes takes long: whole records are tried by their first 4 KiB's worth only if they are small.
        assert length > 200_000 or crc == masked(crc32c(body))
        at += 16 + length
        yield body


def fields(message):
    """(number, value) of a protocol buffer: varints as int, the rest as bytes."""
    at = 0

    def varint():
        nonlocal at
        value, shift = 0, 0
        while True:
            byte = message[at]
            at += 1
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value

    while at < len(message):
        tag = varint()
        if tag & 7 == 0:
            yield tag >> 3, varint()
        else:
            assert tag & 7 == 2, tag
            length = varint()
            yield tag >> 3, message[at:at + length]
            at += length


def varints(data):
    values, value, shift = [], 0, 0
    for byte in data:
        value |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            values.append(value)
            value, shift = 0, 0
    return values


def example(body):
    """Feature name -> list."""
    ((_, features),) = fields(body)
    found = {}
    for _, entry in fields(features):
        name, feature = (value for _, value in fields(entry))
        ((kind, list_),) = fields(feature)
        values = [value for _, value in fields(list_)]
        if kind == 2:
            values = list(struct.unpack(f"<{len(values[0]) // 4}f", values[0]))
        if kind == 3:
            values = varints(values[0])
        found[name.decode()] = values
    return found


class DemosTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name) / "demos"
        cls.episodes = make_room(cls.folder.name, 2)
        cls.report = json.loads(run("vln", "demos", cls.episodes, "--layout", "jsonl,rlds,lerobot", "--width", 128, "--out", cls.out, "--json").stdout)
        cls.demos = lines(cls.out / "jsonl" / "demos.jsonl")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_flights_begin_at_the_start_end_at_the_goal_and_are_ten_steps_a_second(self):
        episodes = {e["id"]: e for e in lines(self.episodes)}
        self.assertEqual(len(self.demos), 2)
        for demo in self.demos:
            episode, steps = episodes[demo["id"]], demo["steps"]
            self.assertLess(math.dist(steps[0]["state"][:3], episode["start"]["p"]), 0.01)
            self.assertLess(math.dist(steps[-1]["state"][:3], episode["goal"]["position"]), episode["goal"]["radius"])
            self.assertTrue(all(abs(s["t"] - 0.1 * i) < 1e-6 for i, s in enumerate(steps)))
            self.assertEqual([s["is_last"] for s in steps], [False] * (len(steps) - 1) + [True])

    def test_velocities_and_waypoints_lead_along_the_flight(self):
        for demo in self.demos:
            steps = demo["steps"]
            for i, step in enumerate(steps[:-1]):
                x, y, z, qw, qx, qy, qz = step["state"][:7]
                yaw = math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
                for action, ahead, scale in (("velocity", i + 1, 0.1), ("waypoint", min(i + 10, len(steps) - 1), 1)):
                    forward, left, up, _ = (scale * v for v in step["action"][action])
                    at = (x + math.cos(yaw) * forward - math.sin(yaw) * left, y + math.sin(yaw) * forward + math.cos(yaw) * left, z + up)
                    self.assertLess(math.dist(at, steps[ahead]["state"][:3]), 2e-3)
            self.assertTrue(all(len(s["action"]["rotor"]) == 4 and min(s["action"]["rotor"]) > 0 for s in steps[1:]))

    def test_the_video_holds_a_picture_a_step(self):
        for demo in self.demos:
            told = subprocess.run(["ffprobe", "-v", "error", "-count_packets", "-show_entries", "stream=nb_read_packets,width,height", "-of", "json",
                                   self.out / "jsonl" / demo["video"]], capture_output=True, text=True, check=True)
            (stream,) = json.loads(told.stdout)["streams"]
            self.assertEqual((stream["width"], stream["height"], int(stream["nb_read_packets"])), (128, 64, len(demo["steps"])))

    def test_records_of_tensorflow_hold_the_same(self):
        folder = self.out / "rlds" / "airsim360_vln" / "1.0.0"
        info = json.loads((folder / "dataset_info.json").read_text())
        read = {}
        for split in info["splits"]:
            name = f"airsim360_vln-{split['name']}.tfrecord-00000-of-00001"
            data = (folder / name).read_bytes()
            self.assertEqual(len(data), int(split["numBytes"]))
            found = [example(body) for body in records(data)]
            self.assertEqual(len(found), int(split["shardLengths"][0]))
            read.update({e["episode_metadata/id"][0].decode(): e for e in found})
        self.assertEqual(set(read), {d["id"] for d in self.demos})
        for demo in self.demos:
            e, steps = read[demo["id"]], demo["steps"]
            self.assertEqual(e["steps/is_first"], [1] + [0] * (len(steps) - 1))
            self.assertEqual(e["steps/is_last"], [0] * (len(steps) - 1) + [1])
            self.assertEqual({t.decode() for t in e["steps/language_instruction"]}, {demo["instruction"]})
            flat = [v for s in steps for v in s["state"]]
            self.assertEqual(len(e["steps/observation/state"]), len(flat))
            self.assertTrue(all(abs(a - b) <= 1e-5 * max(1, abs(b)) for a, b in zip(e["steps/observation/state"], flat)))
            self.assertEqual(len(e["steps/action/waypoint"]), 4 * len(steps))
            self.assertEqual(jpeg_size(e["steps/observation/image"][-1]), (128, 64))
        features = json.loads((folder / "features.json").read_text())["featuresDict"]["features"]
        self.assertEqual(set(features["steps"]["sequence"]["feature"]["featuresDict"]["features"]["observation"]["featuresDict"]["features"]),
                         {"image", "state", "rotor_speeds"})

    def test_lerobot_holds_an_episode_a_flight_with_its_instruction_as_the_task(self):
        folder = self.out / "lerobot"
        info = json.loads((folder / "meta" / "info.json").read_text())
        self.assertEqual((info["total_episodes"], info["total_frames"], info["fps"]), (2, self.report["steps"], 10))
        tasks = {t["task_index"]: t["task"] for t in lines(folder / "meta" / "tasks.jsonl")}
        self.assertEqual(set(tasks.values()), {d["instruction"] for d in self.demos})
        for episode, demo in zip(lines(folder / "meta" / "episodes.jsonl"), self.demos):
            self.assertEqual((episode["length"], episode["tasks"]), (len(demo["steps"]), [demo["instruction"]]))
            index = episode["episode_index"]
            self.assertEqual((folder / info["data_path"].format(episode_chunk=0, episode_index=index)).read_bytes()[:4], b"PAR1")
            self.assertTrue((folder / info["video_path"].format(episode_chunk=0, episode_index=index, video_key="observation.images.pano")).exists())

    def test_the_same_episodes_give_the_same_bytes(self):
        again = Path(self.folder.name) / "again"
        run("vln", "demos", self.episodes, "--layout", "jsonl,rlds", "--width", 128, "--threads", 1, "--out", again)
        for file in sorted(p for p in again.rglob("*") if p.is_file()):
            self.assertEqual(file.read_bytes(), (self.out / file.relative_to(again)).read_bytes(), file)

    def test_bad_input_is_refused_and_leaves_nothing(self):
        out = Path(self.folder.name) / "none"
        for words, said in ((("--layout", "rdls"), "did you mean 'rlds'"), (("--width", "130"), "--width"), (("--limit", "-1"), "--limit"), (("--tier", "labels"), "--tier")):
            self.assertIn(said, run("vln", "demos", self.episodes, "--out", out, *words, status=2).stderr)
            self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
