"""Containers: Python's tarfile, @mcap/core and hyparquet by node where npm can get them, and readers of ours from the specifications."""
import collections
import json
import shutil
import struct
import subprocess
import tarfile
import unittest
import zlib

import numpy as np

from readers import FormatTest, npm_folder, read_exr, rotation

OBSERVATIONS = {1: "header", 2: "footer"}


def node(folder, script, *arguments):
    # Beside the packages, where node looks for them.
    path = folder / "read.mjs"
    path.write_text(script)
    done = subprocess.run(["node", str(path), *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


class WebDataset(FormatTest):
    def test_samples_are_whole_and_hold_the_source_files(self):
        out = self.export("webdataset")
        samples = collections.defaultdict(dict)
        order = []
        with tarfile.open(out / "shard-000000.tar", "r:") as tar:
            for member in tar:
                self.assertTrue(member.isreg())
                self.assertEqual((member.uid, member.gid, member.mtime, member.mode, member.uname), (0, 0, 0, 0o644, ""))
                key, _, suffix = member.name.partition(".")
                samples[key][suffix] = tar.extractfile(member).read()
                order.append(key)
        self.assertEqual([k for i, k in enumerate(order) if i == 0 or order[i - 1] != k], [f["stem"] for f in self.frames], "files of a sample lie together")
        for frame in self.frames:
            sample = samples[frame["stem"]]
            self.assertEqual(set(sample), {"rgb.png", "depth.exr", "semantic.png", "panoptic.png", "meta.json"})
            for suffix, product in (("rgb.png", "rgb"), ("depth.exr", "range"), ("semantic.png", "semantic"), ("panoptic.png", "entity")):
                self.assertEqual(sample[suffix], self.source(product, frame, "." + suffix.split(".")[1]).read_bytes())
            meta = json.loads(sample["meta.json"])
            self.assertEqual(meta["X_WC"], frame["X_WC"])
            self.assertEqual(sum(s["area"] for s in meta["segments_info"]), 128 * 64)
            self.assertEqual(len(meta["persons"]), 3)

    def test_shards_are_as_large_as_asked_and_hold_everything_once(self):
        whole = self.export("webdataset")
        parts = self.folder / "parts"
        self.run_ok("dataset", "export", self.data, "--format", "webdataset", "--shard-mb", "0.2", "--out", parts)
        shards, names = sorted(parts.glob("*.tar")), []
        self.assertGreater(len(shards), 1)
        for shard in shards:
            self.assertLessEqual(shard.stat().st_size, 200_000)
            self.assertEqual(shard.stat().st_size % 512, 0)
            with tarfile.open(shard) as tar:
                names += tar.getnames()
        with tarfile.open(whole / "shard-000000.tar") as tar:
            self.assertEqual(names, tar.getnames())


class Cdr:
    """Little-endian CDR behind its header of four bytes."""

    def __init__(self, data):
        assert data[:4] == b"\0\1\0\0"
        self.data, self.at = data[4:], 0

    def get(self, code):
        size = struct.calcsize(code)
        self.at += -self.at % size
        self.at += size
        return struct.unpack_from("<" + code, self.data, self.at - size)[0]

    def text(self):
        size = self.get("I")
        self.at += size
        assert self.data[self.at - 1] == 0
        return self.data[self.at - size:self.at - 1].decode()

    def octets(self):
        size = self.get("I")
        self.at += size
        return self.data[self.at - size:self.at]

    def stamp(self):
        return self.get("i") * 10**9 + self.get("I")

    def numbers(self, count):
        return [self.get("d") for _ in range(count)]


def mcap_records(data, at, end):
    while at < end:
        op, size = struct.unpack_from("<BQ", data, at)
        yield op, data[at + 9:at + 9 + size], at
        at += 9 + size


class Mcap(FormatTest):
    def setUp(self):
        super().setUp()
        self.path = self.export("mcap") / "dataset.mcap"

    def test_crcs_are_those_of_the_specification(self):
        data, magic = self.path.read_bytes(), b"\x89MCAP0\r\n"
        self.assertTrue(data.startswith(magic) and data.endswith(magic))
        ops = []
        for op, body, at in mcap_records(data, 8, len(data) - 8):
            ops.append(op)
            if op == 0x0F:
                self.assertEqual(struct.unpack("<I", body)[0], zlib.crc32(data[:at]))
            if op == 0x02:
                summary, offsets, crc = struct.unpack("<QQI", body)
                self.assertEqual(crc, zlib.crc32(data[summary:at + 9 + 16]))
                self.assertTrue(summary < offsets < at)
            if op == 0x06:
                self.assertEqual(struct.unpack_from("<I", body, 28)[0], 4)
                self.assertEqual(body[32:36], b"zstd")
        self.assertEqual(ops[0], 0x01)
        self.assertIn(0x0B, ops)

    def test_node_reads_every_message(self):
        folder = npm_folder("@mcap/core") and npm_folder("fzstd")
        if not folder or not shutil.which("node"):
            self.skipTest("npm cannot get @mcap/core here")
        script = """
import { McapIndexedReader, McapStreamReader } from '@mcap/core';
import * as fzstd from 'fzstd';
import fs from 'node:fs';
const data = fs.readFileSync(process.argv[2]);
const decompressHandlers = { zstd: (b, n) => fzstd.decompress(b, new Uint8Array(Number(n))) };
const readable = { size: async () => BigInt(data.length), read: async (o, n) => data.subarray(Number(o), Number(o + n)) };
const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
const messages = [];
for await (const m of reader.readMessages()) {
  const c = reader.channelsById.get(m.channelId);
  messages.push([c.topic, reader.schemasById.get(c.schemaId).name, Number(m.logTime), Buffer.from(m.data).toString('base64')]);
}
const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
stream.append(data);
let count = 0;
for (let r; (r = stream.nextRecord());) count += r.type === 'Message';
console.log(JSON.stringify({ profile: reader.header.profile, messages, count, done: stream.done(),
  stated: Number(reader.statistics.messageCount) }));
"""
        seen = node(folder, script, self.path)
        self.assertEqual(seen["profile"], "ros2")
        self.assertTrue(seen["done"])
        self.assertEqual({len(seen["messages"]), seen["count"], seen["stated"]}, {5 * len(self.frames)})
        import base64
        times, by_topic = [], collections.defaultdict(list)
        for topic, kind, t, data in seen["messages"]:
            times.append(t)
            by_topic[topic, kind].append(Cdr(base64.b64decode(data)))
        self.assertEqual(times, sorted(times))
        self.assertEqual(set(by_topic), {("/odom", "nav_msgs/msg/Odometry"), ("/tf", "tf2_msgs/msg/TFMessage"),
                                         ("/pano/image/compressed", "sensor_msgs/msg/CompressedImage"), ("/pano/range", "sensor_msgs/msg/Image"),
                                         ("/gt/humans", "visualization_msgs/msg/MarkerArray")})
        self.check_messages(by_topic)

    def check_messages(self, by_topic):
        people = [json.loads(line) for line in (self.data / "people.jsonl").read_text().splitlines()]
        topic = {name: messages for (name, _), messages in by_topic.items()}
        for i, frame in enumerate(self.frames):
            odometry = topic["/odom"][i]
            self.assertEqual((odometry.stamp(), odometry.text(), odometry.text()), (frame["t_ns"], "map", "base_link"))
            p, (x, y, z, w) = odometry.numbers(3), odometry.numbers(4)
            R_WB = rotation([w, x, y, z])
            odometry.numbers(36)
            np.testing.assert_allclose(R_WB @ odometry.numbers(3), frame["v_WB"], atol=1e-9)
            np.testing.assert_allclose(odometry.numbers(3), frame["w_WB_B"], atol=1e-12)
            odometry.numbers(36)
            self.assertEqual(odometry.at, len(odometry.data))
            picture = topic["/pano/image/compressed"][i]
            self.assertEqual((picture.stamp(), picture.text(), picture.text()), (frame["t_ns"], "pano_optical", "png"))
            self.assertEqual(bytes(picture.octets()), self.source("rgb", frame).read_bytes())
            image = topic["/pano/range"][i]
            self.assertEqual((image.stamp(), image.text(), image.get("I"), image.get("I"), image.text(), image.get("B"), image.get("I")),
                             (frame["t_ns"], "pano_optical", 64, 128, "32FC1", 0, 512))
            np.testing.assert_array_equal(np.frombuffer(image.octets(), "<f4").reshape(64, 128), read_exr(self.source("range", frame, ".exr"))["Y"])
            transforms = topic["/tf"][i]
            self.assertEqual(transforms.get("I"), 2)
            for child in ("base_link", "pano_optical"):
                self.assertEqual((transforms.stamp(), transforms.text(), transforms.text()), (frame["t_ns"], "map", child))
                p, (x, y, z, w) = transforms.numbers(3), transforms.numbers(4)
            np.testing.assert_allclose(p, frame["X_WC"]["p"])
            np.testing.assert_allclose(rotation([w, x, y, z]), rotation(frame["X_WC"]["q_wxyz"]), atol=1e-12)
            markers = topic["/gt/humans"][i]
            self.assertEqual(markers.get("I"), len(people[i]["persons"]))
            for person in people[i]["persons"]:
                self.assertEqual((markers.stamp(), markers.text(), markers.text(), markers.get("i"), markers.get("i"), markers.get("i")),
                                 (frame["t_ns"], "map", "people", person["track_id"], 1, 0))
                np.testing.assert_allclose(markers.numbers(3), person["box3d_world"]["center"])
                x, y, z, w = markers.numbers(4)
                turn = 2 * np.arctan2(z, w) - person["box3d_world"]["yaw"]
                self.assertAlmostEqual(np.sin(turn / 2), 0, delta=1e-6)
                np.testing.assert_allclose(markers.numbers(3), person["box3d_world"]["lwh"])
                [markers.get("f") for _ in range(4)], markers.get("i"), markers.get("I"), markers.get("B"), markers.get("I"), markers.get("I")
                self.assertEqual(markers.text(), "")
                markers.stamp(), markers.text(), markers.text(), markers.octets(), markers.get("I")
                self.assertEqual(markers.text(), person["behaviour"])
                markers.text(), markers.text(), markers.octets(), markers.get("B")
            self.assertEqual(markers.at, len(markers.data))


class Thrift:
    """Reads Thrift's compact protocol into {field: value}."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def varint(self):
        value = shift = 0
        while True:
            byte = self.data[self.at]
            self.at += 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    def zigzag(self):
        v = self.varint()
        return (v >> 1) ^ -(v & 1)

    def value(self, kind):
        if kind in (5, 6):
            return self.zigzag()
        if kind == 8:
            size = self.varint()
            self.at += size
            return self.data[self.at - size:self.at].decode()
        if kind == 9:
            head = self.data[self.at]
            self.at += 1
            return [self.value(head & 15) for _ in range(head >> 4 if head >> 4 < 15 else self.varint())]
        assert kind == 12, kind
        fields, field = {}, 0
        while self.data[self.at]:
            head = self.data[self.at]
            self.at += 1
            field += head >> 4
            fields[field] = self.value(head & 15)
        self.at += 1
        return fields


def read_parquet(path):
    """Column -> list of values or lists: PLAIN, uncompressed, one data page a chunk, levels of one bit."""
    data = path.read_bytes()
    assert data[:4] == data[-4:] == b"PAR1"
    size = struct.unpack("<I", data[-8:-4])[0]
    footer = Thrift(data[-8 - size:-8]).value(12)
    columns = collections.defaultdict(list)
    for group in footer[4]:
        for chunk in group[1]:
            meta = chunk[3]
            page = Thrift(data[meta[9]:])
            header = page.value(12)
            body = page.data[page.at:page.at + header[3]]
            count, path_in_schema = header[5][1], meta[3]
            levels = []
            for _ in range(2 if len(path_in_schema) == 3 else 0):
                length = struct.unpack_from("<I", body)[0]
                packed = Thrift(body[4:4 + length])
                groups = packed.varint()
                assert groups & 1
                bits = np.unpackbits(np.frombuffer(packed.data[packed.at:], np.uint8), bitorder="little")[:count]
                levels.append(bits)
                body = body[4 + length:]
            present = int(levels[1].sum()) if levels else count
            if meta[1] == 6:
                values, at = [], 0
                for _ in range(present):
                    n = struct.unpack_from("<I", body, at)[0]
                    values.append(body[at + 4:at + 4 + n].decode())
                    at += 4 + n
            else:
                values = np.frombuffer(body, {2: "<i8", 4: "<f4", 5: "<f8"}[meta[1]])[:present].tolist()
            if levels:
                rows, values = [], iter(values)
                for again, there in zip(*levels):
                    rows += [] if again else [[]]
                    rows[-1] += [next(values)] if there else []
                values = rows
            columns[path_in_schema[0]] += values
    assert all(len(values) == footer[3] for values in columns.values())
    return columns


class Parquet(FormatTest):
    def test_a_row_a_frame(self):
        out = self.export("parquet")
        table = read_parquet(out / "frames.parquet")
        self.assertEqual(table["index"], [f["index"] for f in self.frames])
        self.assertEqual(table["t_ns"], [f["t_ns"] for f in self.frames])
        for i, axis in enumerate("xyz"):
            self.assertEqual(table[axis], [f["X_WC"]["p"][i] for f in self.frames])
        self.assertEqual(table["range_median"], [f["range_median"] for f in self.frames])
        self.assertEqual([sum(row) for row in table["category_pixels"]], [128 * 64] * len(self.frames))
        for names, areas in zip(table["categories"], table["category_pixels"]):
            self.assertEqual(len(names), len(areas))
        for files in table["files"]:
            self.assertTrue(all((self.data / name).exists() for name in files))
        folder = npm_folder("hyparquet")
        if not folder or not shutil.which("node"):
            self.skipTest("npm cannot get hyparquet here; read by the reader above alone")
        script = """
import { asyncBufferFromFile, parquetReadObjects } from 'hyparquet';
const rows = await parquetReadObjects({ file: await asyncBufferFromFile(process.argv[2]) });
console.log(JSON.stringify(rows, (k, v) => typeof v === 'bigint' ? Number(v) : v));
"""
        rows = node(folder, script, out / "frames.parquet")
        self.assertEqual(len(rows), len(self.frames))
        for name, values in table.items():
            self.assertEqual([row[name] for row in rows], values, name)


class LeRobot(FormatTest):
    def test_actions_lead_from_frame_to_frame(self):
        if not shutil.which("ffprobe"):
            self.skipTest("ffmpeg is not installed")
        out = self.export("lerobot")
        info = json.loads((out / "meta/info.json").read_text())
        self.assertEqual((info["codebase_version"], info["total_frames"], info["fps"]), ("v2.1", len(self.frames), 4))
        table = read_parquet(out / info["data_path"].format(episode_chunk=0, episode_index=0))
        self.assertEqual(set(table) | {"observation.images.pano"}, set(info["features"]))
        for name in ("observation.state", "action"):
            self.assertEqual({len(row) for row in table[name]}, set(info["features"][name]["shape"]))
        state, action = np.array(table["observation.state"]), np.array(table["action"])
        forward = np.array([rotation(q)[:, 2] for q in state[:, 3:7]])
        yaw = np.arctan2(forward[:, 1], forward[:, 0])
        for i in range(len(self.frames) - 1):
            c, s, (f, l, u, turn) = np.cos(yaw[i]), np.sin(yaw[i]), action[i]
            dt = 1e-9 * (self.frames[i + 1]["t_ns"] - self.frames[i]["t_ns"])
            np.testing.assert_allclose(state[i, :3] + dt * np.array([c * f - s * l, s * f + c * l, u]), state[i + 1, :3], atol=1e-5)
            self.assertAlmostEqual(np.angle(np.exp(1j * (yaw[i] + dt * turn - yaw[i + 1]))), 0, delta=1e-4)
        self.assertEqual(action[-1].tolist(), [0, 0, 0, 0])
        stats = json.loads((out / "meta/episodes_stats.jsonl").read_text())["stats"]
        np.testing.assert_allclose(stats["action"]["mean"], action.mean(0), atol=1e-6)
        np.testing.assert_allclose(stats["action"]["std"], action.std(0), atol=1e-5)
        video = out / info["video_path"].format(episode_chunk=0, episode_index=0, video_key="observation.images.pano")
        shown = subprocess.run(["ffprobe", "-v", "error", "-of", "json", "-count_frames", "-show_streams", str(video)], capture_output=True, text=True)
        stream = json.loads(shown.stdout)["streams"][0]
        self.assertEqual((int(stream["nb_read_frames"]), stream["width"], stream["height"]), (len(self.frames), 128, 64))


if __name__ == "__main__":
    unittest.main()
