"""`airsim360 view` over plain sockets: what it serves and what it refuses; the export; the live world."""
import base64
import http.client
import json
import math
import os
import pathlib
import shutil
import socket
import sqlite3
import struct
import subprocess
import tempfile
import threading
import time
import unittest

from viewer import PROGRAM, Viewer, make_dataset, run

ROOM = pathlib.Path(tempfile.mkdtemp(prefix="airsim360_view_"))


def setUpModule():
    make_dataset(ROOM / "data")


def tearDownModule():
    shutil.rmtree(ROOM)


class WebSocket:
    """The least of RFC 6455 that a client needs."""

    def __init__(self, port, headers=""):
        self.socket = socket.create_connection(("127.0.0.1", port), 60)
        self.socket.sendall(b"GET /live HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n" + headers.encode() +
                            b"Sec-WebSocket-Key: " + base64.b64encode(os.urandom(16)) + b"\r\nSec-WebSocket-Version: 13\r\n\r\n")
        self.file = self.socket.makefile("rb")
        self.status = int(self.file.readline().split()[1])
        while self.file.readline() not in (b"\r\n", b""):
            pass

    def send(self, data, first=0x81):
        mask = os.urandom(4)
        size = bytes([0x80 | len(data)]) if len(data) < 126 else b"\xfe" + struct.pack(">H", len(data)) if len(data) < 65536 else b"\xff" + struct.pack(">Q", len(data))
        self.socket.sendall(bytes([first]) + size + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(data)))

    def read(self):
        """Kind and bytes of a message, however many frames it came in; None at the end."""
        kind, data = None, b""
        while True:
            head = self.file.read(2)
            if len(head) < 2:
                return None
            size = head[1] & 127
            size = struct.unpack(">H", self.file.read(2))[0] if size == 126 else struct.unpack(">Q", self.file.read(8))[0] if size == 127 else size
            kind, data = kind or head[0] & 15, data + self.file.read(size)
            if head[0] & 0x80:
                return kind, data

    def ask(self, message):
        """Decoded JSON, or (header, bytes of the planes) of pictures."""
        self.send(json.dumps(message).encode() if isinstance(message, dict) else message)
        kind, data = self.read()
        if kind == 1:
            return json.loads(data)
        assert data[:4] == b"A360"
        length = struct.unpack("<I", data[4:8])[0]
        return json.loads(data[8:8 + length]), data[8 + length:]

    def close(self):
        self.file.close()
        self.socket.close()


def raw(port, text, size=1 << 16):
    """The first line of the answer to these bytes; "" if the connection is closed without one."""
    with socket.create_connection(("127.0.0.1", port), 20) as client:
        client.settimeout(20)
        try:
            client.sendall(text)
            return client.recv(size).split(b"\r\n")[0].decode("latin1")
        except ConnectionError:
            return ""


class RecordedTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.viewer = Viewer(ROOM / "data")

    @classmethod
    def tearDownClass(cls):
        assert cls.viewer.stop() == 0

    def test_the_page_and_its_files_are_served_with_a_policy_that_loads_nothing_from_elsewhere(self):
        for path, kind in {"/": "text/html", "/app.js": "text/javascript", "/style.css": "text/css", "/session.json": "application/json"}.items():
            status, headers, body = self.viewer.get(path)
            self.assertEqual(status, 200, path)
            self.assertTrue(headers["Content-Type"].startswith(kind), headers)
            self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
            self.assertNotIn("unsafe", headers["Content-Security-Policy"])
            self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
            self.assertNotRegex(body.decode().replace("http://www.w3.org/2000/svg", ""), r"(src|href)=\"?(https?:)?//")

    def test_the_index_says_what_the_frames_file_says(self):
        index = self.viewer.json("/data/0/index.json")
        lines = [json.loads(line) for line in (ROOM / "data/frames.jsonl").read_text().splitlines()]
        self.assertEqual(index["frames"]["stem"], [line["stem"] for line in lines])
        for i, line in enumerate(lines):
            self.assertAlmostEqual(index["frames"]["t"][i], 1e-9 * line["t_ns"], 5)
            for mine, theirs in zip(index["views"][0]["p"][i], line["X_WC"]["p"]):
                self.assertAlmostEqual(mine, theirs, 3)
            # The same turn: q and -q are one.
            dot = sum(a * b for a, b in zip(index["views"][0]["q"][i], line["X_WC"]["q_wxyz"]))
            self.assertAlmostEqual(abs(dot), 1, 6)

    def test_appearances_are_the_segments_of_the_index(self):
        seen = self.viewer.json("/data/0/appearances.json")
        with sqlite3.connect(ROOM / "data/index.sqlite") as index:
            rows = index.execute("SELECT entity, frame, area FROM segments ORDER BY entity, frame").fetchall()
        wanted = {}
        for entity, frame, area in rows:
            wanted.setdefault(str(entity), []).extend([frame, area])
        self.assertEqual(seen, wanted)

    def test_pictures_are_the_files_themselves(self):
        for name in ["rgb/000003.png", "range/000000.exr", "entity/000005.png", "flow/000001.exr", "entities.json"]:
            self.assertEqual(self.viewer.get("/data/0/" + name)[2], (ROOM / "data" / name).read_bytes(), name)

    def test_nothing_outside_the_folder_is_served(self):
        secret = ROOM / "secret.txt"
        secret.write_text("secret")
        link, folder_link = ROOM / "data/link.txt", ROOM / "data/up"
        for path, target in {link: secret, folder_link: ROOM}.items():
            if not path.is_symlink():
                path.symlink_to(target)
        try:
            for path in ["../secret.txt", "..%2fsecret.txt", "%2e%2e/secret.txt", "rgb/../../secret.txt", "/etc/passwd", "//etc/passwd", "rgb//000000.png", "rgb/./000000.png",
                         "link.txt", "up/secret.txt", "rgb", "rgb/", "", ".", "..", "%00", "entities.json%00.png", "%", "%zz", "a" * 4000, "people/../entities.json", "people/000000.json"]:
                line = raw(self.viewer.port, f"GET /data/0/{path} HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n".encode())
                self.assertRegex(line, r"HTTP/1.1 (400|404)", path)
            for path in ["/data/1/index.json", "/data/-1/index.json", "/data/99999999999999999999/index.json", "/data/0", "/data", "/data/0x/index.json", "/nothing", "/page/app.js"]:
                self.assertEqual(self.viewer.get(path)[0], 404, path)
        finally:
            link.unlink()
            folder_link.unlink()

    def test_pages_of_other_sites_and_names_that_only_point_here_are_refused(self):
        for headers in [{"Origin": "http://evil.example"}, {"Origin": "null"}, {"Origin": "http://127.0.0.1:1"}, {"Host": "evil.example"}, {"Host": f"evil.example:{self.viewer.port}"},
                        {"Host": "127.0.0.1.evil.example"}]:
            self.assertEqual(self.viewer.get("/session.json", headers)[0], 403, headers)
        self.assertEqual(self.viewer.get("/session.json", {"Origin": self.viewer.address})[0], 200)

    def test_only_this_machine_can_connect(self):
        with open(f"/proc/{self.viewer.process.pid}/net/tcp") as table:
            listening = [line.split()[1] for line in table if line.split()[3] == "0A"]
        mine = [address for address in listening if int(address.split(":")[1], 16) == self.viewer.port]
        self.assertEqual([address.split(":")[0] for address in mine], ["0100007F"])

    def test_methods_other_than_get_and_head_and_malformed_requests_change_nothing(self):
        for method in ["POST", "PUT", "DELETE", "OPTIONS"]:
            self.assertEqual(self.viewer.get("/session.json", method=method)[0], 405, method)
        status, headers, body = self.viewer.get("/session.json", method="HEAD")
        self.assertEqual((status, int(headers["Content-Length"]), body), (200, len(self.viewer.get("/session.json")[2]), b""))
        for text in [b"\x00" * 100, b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"GET / HTTP/1.1\r\n\r\n", b"GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n",
                     b"GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999999999999999\r\n\r\n", b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n",
                     b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000000\r\n\r\n" + b"x" * 100]:
            self.assertNotIn("200", raw(self.viewer.port, text)[:12], text[:60])
        self.assertEqual(self.viewer.get("/")[0], 200)

    def test_a_thousand_silent_connections_keep_nobody_out(self):
        clients = []
        try:
            for _ in range(1000):
                clients.append(socket.create_connection(("127.0.0.1", self.viewer.port), 20))
            self.assertEqual(self.viewer.get("/")[0], 200)
        finally:
            for client in clients:
                client.close()
        self.assertEqual(self.viewer.get("/")[0], 200)

    def test_reading_the_same_pictures_again_and_again_takes_no_more_memory(self):
        def read_all():
            for i in range(6):
                for name in ["rgb/{:06}.png", "range/{:06}.exr", "entity/{:06}.png"]:
                    self.viewer.get("/data/0/" + name.format(i))
        for _ in range(3):
            read_all()
        before = self.viewer.memory()
        for _ in range(15):
            read_all()
        self.assertLess(self.viewer.memory(), 1.1 * before)

    def test_a_recorded_dataset_has_no_socket(self):
        client = WebSocket(self.viewer.port)
        self.assertEqual(client.status, 404)
        client.close()


class ExportTest(unittest.TestCase):
    def test_the_export_answers_as_the_server_does(self):
        out = ROOM / "site"
        done = run("view", ROOM / "data", "--compare", ROOM / "data", "--export", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        viewer = Viewer(ROOM / "data", "--compare", ROOM / "data")
        try:
            files = [path for path in out.rglob("*") if path.is_file()]
            self.assertGreater(len(files), 80)
            for path in files:
                status, _, body = viewer.get("/" + str(path.relative_to(out)))
                self.assertEqual((status, body), (200, path.read_bytes()), path)
        finally:
            viewer.stop()

    def test_an_export_overwrites_nothing_and_leaves_nothing_half_written(self):
        full = ROOM / "full"
        full.mkdir()
        (full / "mine").write_text("mine")
        done = run("view", ROOM / "data", "--export", full)
        self.assertEqual(done.returncode, 2)
        self.assertIn(str(full), done.stderr)
        self.assertEqual([path.name for path in full.iterdir()], ["mine"])
        self.assertEqual(list(ROOM.glob("*.partial")), [])
        lacking = ROOM / "lacking"
        shutil.copytree(ROOM / "data", lacking)
        next((lacking / "rgb").iterdir()).unlink()
        done = run("view", lacking, "--export", ROOM / "site of it")
        self.assertEqual(done.returncode, 1)
        self.assertIn("missing; 'airsim360 verify'", done.stderr)
        self.assertFalse((ROOM / "site of it").exists())
        self.assertEqual(list(ROOM.glob("*.partial")), [])
        shutil.rmtree(lacking)


class InputTest(unittest.TestCase):
    def test_what_cannot_be_viewed_is_refused_by_name(self):
        for arguments, said in {(): "--world", (ROOM,): "not a dataset", ("plan.json",): "plan.json", (ROOM / "nothing",): "nothing", (ROOM / "nothing", "--export", ROOM / "e"): "nothing' is no folder", (ROOM / "data", "--world", "box_room"): "--world",
                                ("--world", "box_rom"): "box_room", ("--world", "box_room", "--compare", ROOM / "data"): "--compare",
                                (ROOM / "data", "--port", "99999"): "99999", (ROOM / "data", "--compare", ROOM): "not a dataset", (ROOM / "data", "--record", ROOM / "r"): "--record", (ROOM / "data", "--weather", "night"): "--weather: it is of --world", (ROOM / "data", "--tier", "high"): "--tier: it is of --world",
                                ("plan.json", "--export", ROOM / "e"): "dataset run", ("plan.json", "--compare", ROOM / "data"): "--compare", ("--connect", "here"): "HOST:PORT",
                                ("--connect", "127.0.0.1:99999"): "HOST:PORT", ("--connect", "127.0.0.1:1", "--world", "box_room"): "--connect", ("--world", "box_room", "--lease"): "--lease",
                                ("--connect", "127.0.0.1:1", "--record", ROOM / "r"): "--record",
                                ("--world", "box_room", "--export", ROOM / "e"): "--export", ("--world", "box_room", "--drone", "humingbird"): "hummingbird"}.items():
            done = run("view", *arguments)
            self.assertEqual(done.returncode, 2, (arguments, done.stderr))
            self.assertIn(said, done.stderr, arguments)


class PlanTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        recipe = ROOM / "tiny.yaml"
        recipe.write_text("name: tiny\npicture: {size: 64x32, tier: labels}\nskies: []\nrows:\n  - {name: room, world: box_room, frames: 3}\n")
        done = run("dataset", "plan", recipe, "--out", ROOM / "tiny.json")
        assert done.returncode == 0, done.stderr
        cls.viewer = Viewer(ROOM / "tiny.json")

    @classmethod
    def tearDownClass(cls):
        assert cls.viewer.stop() == 0

    def test_its_frames_are_those_of_the_plan(self):
        index = self.viewer.json("/data/0/index.json")
        self.assertEqual((index["planned"], index["frames"]["stem"], index["frames"]["world"]), (True, ["000000", "000001", "000002"], ["box_room"] * 3))
        self.assertEqual(set(index["products"]), {"range", "semantic", "entity"})
        for i in range(3):
            shown = json.loads(run("dataset", "plan", ROOM / "tiny.json", "--show", i, "--json").stdout)
            status, headers, body = self.viewer.get(f"/data/0/frame/{i}")
            self.assertEqual((status, body[:4]), (200, b"A360"))
            length = struct.unpack("<I", body[4:8])[0]
            header = json.loads(body[8:8 + length])
            self.assertEqual((header["p"], header["index"]), (shown["X_WC"]["p"], i))
            planes = {p["product"]: p for p in header["planes"]}
            self.assertEqual(planes["range"]["bytes"], 64 * 32 * 4)
            entity = planes["entity"]
            ids = struct.unpack(f"<{64 * 32}I", body[8 + length + entity["at"]:][:64 * 32 * 4])
            names = self.viewer.json("/data/0/entities.json")
            self.assertLessEqual({names[str(i)]["name"] for i in set(ids)}, {"floor", "ceiling", "wall east", "wall west", "wall north", "wall south", "box"})

    def test_frames_that_it_has_not_are_not_found(self):
        for path in ["frame/3", "frame/-1", "frame/x", "frame/", "frame/99999999999999999999", "rgb/000000.png", "../tiny.json"]:
            self.assertEqual(self.viewer.get("/data/0/" + path)[0], 404, path)


class FollowTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = subprocess.Popen([PROGRAM, "serve", "--world", "box_room", "--port", "0"], stdout=subprocess.PIPE, text=True)
        line = cls.server.stdout.readline()
        cls.address = "127.0.0.1:" + line.strip().rsplit(":", 1)[1]

    @classmethod
    def tearDownClass(cls):
        cls.server.terminate()
        cls.server.wait(30)
        cls.server.stdout.close()

    def follow(self, *flags):
        viewer = Viewer("--connect", self.address, *flags)
        self.addCleanup(lambda: self.assertEqual(viewer.stop(), 0))
        client = WebSocket(viewer.port)
        self.addCleanup(client.close)
        live = viewer.json("/session.json")["live"]
        return viewer, client, live

    def test_pictures_are_those_of_the_server_and_nothing_is_changed(self):
        viewer, client, live = self.follow()
        self.assertEqual((live["flies"], live["follows"]), (False, True))
        header, data = client.ask({"do": "picture", "input": [0, 0, 1, 0], "token": live["token"]})
        planes = {p["product"]: p for p in header["planes"]}
        self.assertEqual(data[planes["rgb"]["at"]:][:2], b"\xff\xd8")
        names = json.loads(viewer.get("/entities.json")[2])
        ids = struct.unpack(f"<{planes['entity']['bytes'] // 4}I", data[planes["entity"]["at"]:][:planes["entity"]["bytes"]])
        self.assertIn("box", {names[str(i)]["name"] for i in set(ids)})
        again, _ = client.ask({"do": "picture"})
        self.assertLess(abs(again["p"][2] - header["p"][2]), 0.05)
        for message in [{"do": "set", "weather": "rain", "token": live["token"]}, {"do": "planes", "number": 999}]:
            self.assertIn("error", client.ask(message))

    def test_with_a_lease_the_page_flies_the_drone(self):
        viewer, client, live = self.follow("--lease")
        self.assertTrue(live["flies"])
        start = client.ask({"do": "picture"})[0]["p"][2]
        self.assertIn("token", client.ask({"do": "picture", "input": [0, 0, 1, 0]})["error"])
        end = time.monotonic() + 20
        while time.monotonic() < end:
            header, _ = client.ask({"do": "picture", "input": [0, 0, 0.3, 0], "token": live["token"]})
            if header["p"][2] > start + 0.5:
                break
        self.assertGreater(header["p"][2], start + 0.5)

    def test_a_server_that_is_not_there_is_named(self):
        done = run("view", "--connect", "127.0.0.1:9")
        self.assertEqual(done.returncode, 1)
        self.assertIn("nobody answers at 127.0.0.1:9", done.stderr)
        done = run("view", "--connect", self.address, "--vehicle", "Drne9")
        self.assertEqual(done.returncode, 2)
        self.assertIn("unknown vehicle 'Drne9'", done.stderr)


class RunTest(unittest.TestCase):
    """Flights of a small run: of a reference, and of one move."""

    @classmethod
    def setUpClass(cls):
        template = [{"id": "room/near", "text": "Fly to the box and stop.", "query": {"noun": {"word": "box", "names": ["box"]}, "predicates": [{"is": "nearest"}]},
                     "distance": [2.5, 6], "height": [1, 3], "goal_distance": 1}]
        (ROOM / "templates.json").write_text(json.dumps(template))
        cls.episodes, cls.results = ROOM / "room.jsonl", ROOM / "front.jsonl"
        for command in [("vln", "make", "--world", "box_room", "--templates", ROOM / "templates.json", "--starts", 2, "--out", cls.episodes),
                        ("vln", "run", cls.episodes, "--agent", "mask", "--view", "front", "--decisions", "yomo", "--out", cls.results)]:
            done = run(*command)
            assert done.returncode == 0, done.stderr
        (ROOM / "front.transcript.jsonl").write_text(json.dumps({"key": "k", "episode": "x", "step": 0, "model": "m"}) + "\n{cut off")
        cls.viewer = Viewer(cls.results, "--episodes", cls.episodes)

    @classmethod
    def tearDownClass(cls):
        assert cls.viewer.stop() == 0

    def test_the_index_has_the_instruction_the_decisions_and_the_way_of_each_flight(self):
        index = self.viewer.json("/data/0/index.json")
        results = [json.loads(line) for line in self.results.read_text().splitlines()]
        self.assertEqual([f["instruction"] for f in index["flights"]], ["Fly to the box and stop."] * 2)
        self.assertEqual([(f["first"], f["last"]) for f in index["flights"]], [(0, len(results[0]["pred"]) - 1), (len(results[0]["pred"]), len(results[0]["pred"]) + len(results[1]["pred"]) - 1)])
        for flight, result in zip(index["flights"], results):
            self.assertEqual(flight["pred"], result["pred"])
            self.assertEqual([json.loads(d["said"]) for d in flight["decisions"]], [json.loads(d["said"]) for d in result["log"]])
            self.assertEqual(len(flight["decisions"]), result["decisions"])
            for decision in flight["decisions"]:
                # Taken within half a second of the frame that it is shown with, at the place that is drawn there.
                place = decision["frame"] - flight["first"]
                self.assertLess(abs(decision["t"] - index["frames"]["t"][decision["frame"]]), 0.501)
                self.assertLess(math.dist(decision["p"], flight["pred"][place]), 3)

    def test_a_frame_is_drawn_from_the_place_and_by_the_heading_of_the_flight(self):
        result = json.loads(self.results.read_text().splitlines()[0])
        last = len(result["pred"]) - 1
        status, _, body = self.viewer.get(f"/data/0/frame/{last}")
        self.assertEqual(status, 200)
        length = struct.unpack("<I", body[4:8])[0]
        header = json.loads(body[8:8 + length])
        self.assertEqual(header["p"], result["pred"][last])
        planes = {p["product"]: p for p in header["planes"]}
        width, height = planes["range"]["width"], planes["range"]["height"]
        ranges = struct.unpack(f"<{width * height}f", body[8 + length + planes["range"]["at"]:][:width * height * 4])
        # The level ray ahead of the middle of the picture meets the walls x, y = 5 or the box where the heading says.
        x, y, z = result["pred"][last]
        yaw = math.radians(result["heading_deg"][last])
        walls = [t for t in ((math.copysign(5, math.cos(yaw)) - x) / math.cos(yaw), (math.copysign(5, math.sin(yaw)) - y) / math.sin(yaw))]
        if z > 1.05:  # over the box
            self.assertAlmostEqual(ranges[height // 2 * width + width // 2], min(walls), delta=0.05)
        self.assertEqual(self.viewer.get("/data/0/frame/99999")[0], 404)

    def test_a_transcript_stands_for_its_run_and_what_does_not_fit_is_named(self):
        viewer = Viewer(ROOM / "front.transcript.jsonl", "--episodes", self.episodes)
        self.addCleanup(viewer.stop)
        self.assertEqual(len(viewer.json("/data/0/index.json")["flights"]), 2)
        line = json.loads(self.results.read_text().splitlines()[0])
        for change, said in [({"log": [{"t": 0, "p": [0, 0, 0], "yaw": 3}]}, "log[0]"), ({"log": 7}, "log"), ({"heading_deg": [1]}, "heading_deg"), ({"heading_deg": [1e308] * len(line["pred"])}, "heading_deg")]:
            (ROOM / "damaged.jsonl").write_text(json.dumps({**line, **change}) + "\n")
            done = run("view", ROOM / "damaged.jsonl", "--episodes", self.episodes)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)
        (ROOM / "other.jsonl").write_text(self.episodes.read_text().splitlines()[0].replace("box_room/", "box_rum/") + "\n")
        for arguments, said in [((self.results,), "--episodes"), ((self.results, "--episodes", ROOM / "other.jsonl"), "is no episode of"), ((self.results, "--episodes", self.episodes, "--export", ROOM / "e"), "--export"),
                                ((ROOM / "data", "--episodes", self.episodes), "--episodes"), ((self.episodes, "--episodes", self.episodes), "room.jsonl:1")]:
            done = run("view", *arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)


class AgentTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = subprocess.Popen([PROGRAM, "agent", "--world", "box_room", "--port", "0"], stdout=subprocess.PIPE, text=True)
        cls.port = int(cls.server.stdout.readline().strip().rsplit(":", 1)[1])

    @classmethod
    def tearDownClass(cls):
        cls.server.terminate()
        cls.server.wait(30)
        cls.server.stdout.close()

    def agent(self, method, path, body=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.request(method, "/v1/episodes" + path, json.dumps(body) if body is not None else None, {"Content-Type": "application/json"} if body is not None else {})
        response = connection.getresponse()
        answer = json.loads(response.read())
        connection.close()
        return response.status, answer

    def follow(self, *flags):
        viewer = Viewer("--connect", f"127.0.0.1:{self.port}", *flags)
        self.addCleanup(lambda: self.assertEqual(viewer.stop(), 0))
        client = WebSocket(viewer.port)
        self.addCleanup(client.close)
        return viewer, client, viewer.json("/session.json")["live"]

    def test_who_looks_on_sees_the_episode_and_neither_holds_nor_changes_it(self):
        _, made = self.agent("POST", "", {"instruction": "Fly up.", "start": {"p": [-3.5, -3.5, 1.5], "yaw_deg": 45}, "goal": [3.5, 3.5, 4]})
        self.addCleanup(lambda: self.agent("DELETE", "/" + made["episode"]))
        viewer, client, live = self.follow()
        self.assertEqual((live["flies"], live["follows"], live["resets"]), (False, True, False))
        header, data = client.ask({"do": "picture", "width": 256, "input": [0, 0, 1, 0], "token": live["token"]})
        self.assertEqual((header["episode"], header["instruction"], header["goal"], header["p"], header["step"]), (made["episode"], "Fly up.", [3.5, 3.5, 4], [-3.5, -3.5, 1.5], 0))
        planes = {p["product"]: p for p in header["planes"]}
        ranges = struct.unpack(f"<{256 * 128}f", data[planes["range"]["at"]:][:256 * 128 * 4])
        self.assertAlmostEqual(ranges[127 * 256 + 128], 1.5, delta=0.01)  # straight down is the floor
        ids = struct.unpack(f"<{256 * 128}I", data[planes["entity"]["at"]:][:256 * 128 * 4])
        names = json.loads(viewer.get("/entities.json")[2])
        self.assertEqual(names[str(ids[127 * 256 + 128])]["name"], "floor")
        stop = threading.Event()
        watching = threading.Thread(target=lambda: [client.ask({"do": "picture", "width": 256}) for _ in iter(stop.is_set, True)])
        watching.start()
        try:
            # The agent is never told that its episode is busy, and its observations are those of a run without onlookers.
            steps = [self.agent("POST", f"/{made['episode']}/step", {"action": way}) for way in ["up", "down"] * 4]
        finally:
            stop.set()
            watching.join()
        self.assertEqual([status for status, _ in steps], [200] * 8)
        _, alone = self.agent("POST", "", {"instruction": "Fly up.", "start": {"p": [-3.5, -3.5, 1.5], "yaw_deg": 45}, "goal": [3.5, 3.5, 4]})
        again = [self.agent("POST", f"/{alone['episode']}/step", {"action": way}) for way in ["up", "down"] * 4]
        self.agent("DELETE", "/" + alone["episode"])
        self.assertEqual([s["observation"] for _, s in again], [s["observation"] for _, s in steps])
        header, _ = client.ask({"do": "picture", "width": 256})
        self.assertEqual((header["step"], header["p"]), (8, steps[-1][1]["observation"]["pose"]["p"]))
        for message in [{"do": "reset", "token": live["token"]}, {"do": "set", "hour": 3, "token": live["token"]}, {"do": "planes", "number": 999}, {"do": 3}]:
            self.assertIn("error", client.ask(message))

    def test_with_a_lease_the_page_flies_an_episode_and_makes_one_where_there_is_none(self):
        _, client, live = self.follow("--lease")
        start = client.ask({"do": "picture", "width": 128})[0]
        self.assertIn("token", client.ask({"do": "picture", "input": [0, 0, 1, 0]})["error"])
        end = time.monotonic() + 20
        while time.monotonic() < end:
            header, _ = client.ask({"do": "picture", "width": 128, "input": [0, 0, 0.2, 0], "token": live["token"]})
            if header["p"][2] > start["p"][2] + 0.5:
                break
        self.assertGreater(header["p"][2], start["p"][2] + 0.5)
        self.assertEqual(client.ask({"do": "reset", "token": live["token"]}), {"done": "reset"})
        self.assertEqual(client.ask({"do": "picture", "width": 128})[0]["p"], start["p"])
        for _, episode in enumerate(self.agent("GET", "")[1]["episodes"]):
            self.agent("DELETE", "/" + episode["episode"])

    def test_what_is_not_there_is_named(self):
        viewer, client, _ = self.follow()
        self.assertIn("no episode is open", client.ask({"do": "picture"})["error"])
        for flags, said in [(("--episode", "e99"), "e99"), (("--vehicle", "Drone1"), "--episode")]:
            done = run("view", "--connect", f"127.0.0.1:{self.port}", *flags)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)
        done = run("view", "--connect", f"127.0.0.1:{viewer.port}")  # another web server
        self.assertEqual(done.returncode, 1)
        self.assertIn("neither", done.stderr)


class LiveView:
    """A live world, a client of it, and time that passes."""

    @classmethod
    def setUpClass(cls):
        cls.viewer = Viewer(*cls.arguments)
        cls.token = cls.viewer.json("/session.json")["live"]["token"]

    @classmethod
    def tearDownClass(cls):
        assert cls.viewer.stop() == 0

    def setUp(self):
        self.client = WebSocket(self.viewer.port)
        self.addCleanup(self.client.close)
        self.assertEqual(self.client.status, 101)

    def ask(self, do, **more):
        return self.client.ask({"do": do, "token": self.token, **more})

    def live(self, until, seconds=30):
        """Time passes while pictures are asked for."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.client.ask({"do": "picture", "width": 128})
            value = until()
            if value:
                return value
        return until()


class TreesTest(LiveView, unittest.TestCase):
    arguments = ("--world", "box_room", "--people", 2)

    def test_a_running_person_follows_the_edited_tree_and_its_bytes_are_those_of_the_command(self):
        person = self.ask("trees")["people"][0]
        xml = self.ask("source", tree=person["tree"])["xml"]
        (ROOM / "by_hand.xml").write_text(xml.replace("\n", "\n\n"))
        self.assertEqual(run("people", "trees", ROOM / "by_hand.xml").stdout, xml)
        edited = f'<root BTCPP_format="4"><BehaviorTree ID="{person["tree"]}"><Sequence><SetState state="waving" min_s="30" max_s="30"/></Sequence></BehaviorTree></root>'
        written = self.ask("apply", xml=edited)["xml"]
        (ROOM / "edited.xml").write_text(edited)
        self.assertEqual(run("people", "trees", ROOM / "edited.xml").stdout, written)
        mind = self.live(lambda: (lambda m: m if m["state"] == "waving" else None)(self.ask("mind", person=person["name"])))
        self.assertEqual((mind["labels"], mind["active"]), (["Sequence", "SetState"], [2, 3]))
        self.assertEqual(self.ask("source", tree=person["tree"])["xml"], written)

    def test_people_are_brought_sent_and_taken_away(self):
        name = self.ask("trees")["people"][1]["name"]
        self.assertEqual(self.ask("person", person=name, action="bring", point=[-3, -3, 0])["done"], "bring")
        self.live(lambda: self.ask("mind", person=name)["p"][0] < -2.5)
        self.assertEqual(self.ask("person", person=name, action="send", point=[-3, 3, 0])["done"], "send")
        mind = self.live(lambda: (lambda m: m if m["p"][1] > 2.6 else None)(self.ask("mind", person=name)), 60)
        self.assertLess(math.hypot(mind["p"][0] + 3, mind["p"][1] - 3), 0.5)
        self.ask("person", person=name, action="remove")
        self.live(lambda: not self.ask("mind", person=name)["visible"])
        for more, said in [({"action": "bring", "point": [100, 100, 0]}, "nobody can stand at"), ({"action": "fly"}, "send"), ({"action": "send"}, "three numbers"),
                           ({"action": "bring", "point": [1e308, 0, 0]}, "is not in"), ({"action": "send", "point": ["x", 0, 0]}, "three numbers"), ({"person": "nobdy"}, "nobody is called")]:
            self.assertIn(said, self.ask("person", **{"person": name, "action": "send", **more})["error"])

    def test_what_is_drawn_is_checked_as_the_commands_check_it(self):
        square = "areas:\n  - name: one\n    polygon: [[-4, -4], [-1, -4], [-1, -1], [-4, -1]]\n    count: {}\n"
        self.assertEqual(self.ask("draw", kind="people", text=square.format(3) + "people:\n  - {name: ann, at: [-3, 3]}\n")["done"], "1 area, 4 people")
        self.assertEqual(self.ask("draw", kind="route", text="waypoints:\n  - {x: 1, y: 2, z: 3}\n  - {x: 2, y: 2, z: 3}\n")["done"], "2 waypoints")
        for kind, text, done in [("cameras", "cameras:\n  - {name: front, projection: pinhole, size: 64x32, fov_deg: 80, yaw_deg: 30, pitch_deg: -5}\n", "1 camera"),
                                 ("labels", 'rules:\n  - {match: "wall*", category: construction/wall/painted}\n', "1 rule for 4 things"), ("world", "world: box_room\nlamps:\n  - {x: 1, y: 0, z: 2}\n", "1 lamp")]:
            self.assertEqual(self.ask("draw", kind=kind, text=text).get("done"), done)
        far = square.format(3).replace("[[-4, -4], [-1, -4], [-1, -1], [-4, -1]]", "[[-400, -400], [-300, -400], [-300, -300]]")
        for kind, text, said in [("people", square.format(500), "people.yaml:4: 500 people do not fit area 'one'"), ("people", far, "people.yaml:3: area 'one' lies outside the world"),
                                 ("people", "area: []", "did you mean 'areas'"), ("people", "trees: [/etc/passwd]", "not known here"), ("people", "{", "people.yaml"), ("people", "", "people.yaml"),
                                 ("route", "waypoints:\n  - {x: 1, y: 2}\n", "route.yaml:2"), ("route", "waypoints: [{x: 1e308, y: 0, z: 0}]", "route.yaml:1"), ("town", "x", "route"),
                                 ("cameras", "cameras:\n  - {name: a, projection: pinhole, fov_deg: 400}\n", "rig.yaml:2"), ("cameras", "camera: []", "cameras"), ("labels", "rules:\n  - {match: bux, category: furniture/x}\n", "matches nothing"),
                                 ("labels", "rules:\n  - {match: box, category: Furniture X}\n", "labels.yaml:2"), ("world", "world: box_room\nlamps:\n  - {x: 900, y: 0, z: 2}\n", "is outside of the world"),
                                 ("world", "world: box_room\nlamps:\n  - {x: 1, y: 0, z: 2, lumen: 5}\n", "lumens"), ("world", "lamps: []", "'world' is missing")]:
            said_now = self.ask("draw", kind=kind, text=text).get("error", "")
            self.assertIn(said, said_now, text)
            self.assertNotIn("airsim360_view_", said_now)

    def test_what_is_wrong_is_told_and_changes_nothing(self):
        before = self.ask("trees")
        for do, more, said in [("apply", {"xml": "<root"}, "malformed XML"), ("apply", {}, "xml"), ("check", {"kind": "people", "xml": '<root BTCPP_format="4"><BehaviorTree ID="a"><WandrTo/></BehaviorTree></root>'}, "WanderTo"),
                               ("fly", {"xml": '<root BTCPP_format="4"><BehaviorTree ID="a"><Goto to="bux"/></BehaviorTree></root>'}, "did you mean 'box'"), ("mind", {"person": "nobody"}, "nobody"),
                               ("source", {"tree": "walkr"}, "walker"), ("check", {"kind": "people", "xml": "<a>" * 10000}, "64 deep")]:
            self.assertIn(said, self.client.ask({"do": do, "token": self.token, **more})["error"], (do, said))
        for do in ["apply", "fly", "stop"]:
            self.assertIn("token", self.client.ask({"do": do, "xml": "<root/>"})["error"])
        self.assertEqual(self.ask("trees"), before)


class EmptyRoomTest(LiveView, unittest.TestCase):
    """Nobody is in the way of the drone."""
    arguments = ("--world", "box_room")

    def test_where_nothing_drives_no_vehicle_is_put_anywhere(self):
        self.assertEqual(self.ask("cars"), {"cars": []})
        self.assertIn("--traffic", self.ask("car", car="traffic/000", point=[0, 0, 0])["error"])
        self.assertIn("three numbers", self.ask("car", car="traffic/000", point=[0, 0])["error"])
        self.assertIn("token", self.client.ask({"do": "car", "car": "traffic/000", "point": [0, 0, 0]})["error"])

    def test_a_mission_flies_the_drone_of_the_page(self):
        tree = '<root BTCPP_format="4"><BehaviorTree ID="m"><Sequence><Goto to="-2;2;2" name="corner"/><Wait seconds="0.2"/></Sequence></BehaviorTree></root>'
        self.ask("fly", xml=tree)
        self.live(lambda: "corner" in str(self.ask("mission")) or self.ask("mission")["active"])
        done = self.live(lambda: (lambda m: m if m["result"] != "running" else None)(self.ask("mission")))
        self.assertEqual(done["result"], "success", done)
        header, _ = self.client.ask({"do": "picture", "width": 128})
        for got, wanted in zip(header["p"], [-2, 2, 2]):
            self.assertAlmostEqual(got, wanted, delta=0.3)


class LiveTest(LiveView, unittest.TestCase):
    arguments = ("--world", "box_room", "--record", ROOM / "kept")

    def picture(self, **more):
        return self.client.ask({"do": "picture", "width": 128, **more})

    def planes(self, header, data):
        kinds = {"f32": "f", "u32": "I", "u16": "H", "u8": "B"}
        return {p["product"]: struct.unpack(f"<{p['bytes'] // struct.calcsize(kinds[p['type']])}{kinds[p['type']]}", data[p["at"]:p["at"] + p["bytes"]])
                for p in header["planes"] if p["type"] in kinds}

    def test_the_range_of_a_picture_is_that_of_the_room_around_it(self):
        header, data = self.picture(products=["range", "entity"])
        planes = self.planes(header, data)
        x, y, z = header["p"]
        # box_room: walls at 5 m, floor at 0, ceiling at 6 m; the poles look straight up and down.
        self.assertAlmostEqual(planes["range"][0], 6 - z, delta=0.01)
        self.assertAlmostEqual(planes["range"][-1], z, delta=0.01)
        names = json.loads(self.viewer.get("/entities.json")[2])
        self.assertEqual({names[str(i)]["category_path"] for i in planes["entity"]} - {"structure/ceiling"} != set(), True)
        self.assertEqual(data[header["planes"][0]["at"]:][:2], b"\xff\xd8")

    def test_a_drone_that_is_told_to_climb_climbs_and_one_that_is_told_nothing_stops(self):
        self.client.ask({"do": "reset", "token": self.token})
        start = self.picture()[0]["p"][2]
        end = time.monotonic() + 1.5
        while time.monotonic() < end:
            header, _ = self.picture(input=[0, 0, 0.1, 0], token=self.token)
        self.assertGreater(header["p"][2], start + 0.5)
        end = time.monotonic() + 2.5
        while time.monotonic() < end:
            header, _ = self.picture()
        self.assertLess(abs(header["v"][2]), 0.1)

    def test_without_the_token_nothing_is_changed(self):
        for message in [{"do": "picture", "input": [0, 0, 1, 0]}, {"do": "picture", "input": [0, 0, 1, 0], "token": "0" * 32}, {"do": "set", "weather": "rain"}, {"do": "keep"},
                        {"do": "save"}, {"do": "reset", "token": None}, {"do": "reset", "token": [self.token]}]:
            self.assertIn("token", self.client.ask(message)["error"], message)
        self.assertFalse((ROOM / "kept").exists())

    def test_malformed_messages_are_answered_and_survived(self):
        for message in [b"", b"{", b"[]", b"1e999", b"[" * 3000, b'{"do":"picture","width":"x"}', b'{"do":"picture","width":1e308}', b'{"do":"picture","width":-1}',
                        b'{"do":"picture","products":["nothing"]}', b'{"do":"picture","products":{}}', b'{"do":"picture","products":[[[]]]}', b'{"do":1}', b'{"do":"planes","number":-5}',
                        b'{"do":"planes","number":123456789}', b"x" * 5000]:
            self.assertTrue("error" in self.client.ask(message), message[:60])
        for stick in [[0, 0, 0], [2, 0, 0, 0], [None] * 4, ["1"] * 4, 7]:
            self.assertIn("input", self.client.ask({"do": "picture", "input": stick, "token": self.token})["error"], stick)
        for change in [{"weather": "frogs"}, {"weather": 3}, {"hour": 25}, {"hour": "noon"}]:
            self.assertIn("error", self.client.ask({"do": "set", "token": self.token, **change}), change)
        self.assertEqual(self.picture()[0]["planes"][0]["product"], "rgb")

    def test_messages_that_are_no_frames_or_too_long_end_the_connection_alone(self):
        for data, first in [(b"x" * 100000, 0x81), (b"\xff\xfe", 0x81), (b"x", 0xFF), (b"x", 0x80)]:
            client = WebSocket(self.viewer.port)
            client.send(data, first)
            try:
                answer = client.read()
            except ConnectionError:
                answer = None
            self.assertTrue(answer is None or answer[0] == 8, answer)
            client.close()
        self.assertEqual(self.picture()[0]["planes"][0]["product"], "rgb")

    def test_sockets_of_other_sites_are_refused(self):
        client = WebSocket(self.viewer.port, "Origin: http://evil.example\r\n")
        self.assertEqual(client.status, 403)
        client.close()

    def test_planes_of_a_picture_are_asked_for_later(self):
        header, data = self.picture(products=["entity", "range"])
        now = self.planes(header, data)
        self.picture()
        later = self.planes(*self.client.ask({"do": "planes", "number": header["number"]}))
        self.assertEqual(later["entity"], now["entity"])
        self.assertEqual(later["range"], now["range"])

    def test_weather_and_hour_change_the_light_and_not_the_labels(self):
        self.client.ask({"do": "reset", "token": self.token})
        self.assertEqual(self.client.ask({"do": "set", "hour": 12, "token": self.token})["done"], "set")
        noon = self.client.ask({"do": "set", "hour": 12, "token": self.token})["sun_elevation_deg"]
        night = self.client.ask({"do": "set", "hour": 0, "token": self.token})["sun_elevation_deg"]
        # 21 June at 45 degrees north: 90 - 45 + 23.4 degrees at noon, as far below at midnight as 23.4 - 45.
        self.assertAlmostEqual(noon, 68.4, delta=0.5)
        self.assertAlmostEqual(night, -21.6, delta=0.5)

    def test_frames_that_are_kept_become_a_dataset(self):
        for _ in range(3):
            self.picture()
            time.sleep(0.05)
            self.assertEqual(self.client.ask({"do": "keep", "token": self.token}).get("done"), "keep")
            self.picture()
        said = self.client.ask({"do": "save", "token": self.token})
        self.assertEqual(said.get("frames"), 3, said)
        self.assertEqual(run("verify", said["folder"]).returncode, 0)
        self.assertEqual(len((pathlib.Path(said["folder"]) / "frames.jsonl").read_text().splitlines()), 3)
        self.assertIn("no frame", self.client.ask({"do": "save", "token": self.token})["error"])
        shutil.rmtree(ROOM / "kept")


if __name__ == "__main__":
    unittest.main()
