"""The agent interface as a user meets it: the commands of docs/guide/agents.md, hostile clients, the WebSocket."""
import base64
import http.client
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess
import tempfile
import threading
import time
import unittest

PROGRAM = os.environ["AIRSIM360"]
DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs/guide/agents.md"


class Agent:
    def __init__(self, *arguments):
        self.process = subprocess.Popen([PROGRAM, "agent", "--world", "box_room", "--port", "0", *arguments],
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        line = self.process.stdout.readline()
        assert re.fullmatch(r"listening on http://127\.0\.0\.1:\d+\n", line), line
        self.port = int(line.rsplit(":", 1)[1])

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        status = self.process.wait(30)
        self.process.stdout.close()
        return status

    def call(self, method, path, body=None, headers=None):
        """Status and decoded body."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        text = None if body is None else body if isinstance(body, (str, bytes)) else json.dumps(body)
        connection.request(method, path, text, {"Content-Type": "application/json", **(headers or {})})
        response = connection.getresponse()
        data = response.read()
        connection.close()
        return response.status, json.loads(data) if response.getheader("Content-Type") == "application/json" else data


class WebSocket:
    """The least of RFC 6455 that a client needs."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), 60)
        self.socket.sendall(b"GET /v1/ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                            b"Sec-WebSocket-Key: " + base64.b64encode(os.urandom(16)) + b"\r\nSec-WebSocket-Version: 13\r\n\r\n")
        self.file = self.socket.makefile("rb")
        assert b"101" in self.file.readline()
        while self.file.readline() != b"\r\n":
            pass

    def ask(self, message):
        data = message if isinstance(message, bytes) else json.dumps(message).encode()
        mask = os.urandom(4)
        head = struct.pack("!BB", 0x81, 0x80 | len(data)) if len(data) < 126 else struct.pack("!BBH", 0x81, 0xfe, len(data))
        self.socket.sendall(head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(data)))
        _, length = self.file.read(2)
        if length == 126:
            length = struct.unpack("!H", self.file.read(2))[0]
        elif length == 127:
            length = struct.unpack("!Q", self.file.read(8))[0]
        return json.loads(self.file.read(length))

    def close(self):
        self.file.close()
        self.socket.close()


class AgentTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.agent = Agent()

    @classmethod
    def tearDownClass(cls):
        assert cls.agent.stop() == 0

    @unittest.skipUnless(shutil.which("curl"), "curl is not installed")
    def test_the_commands_of_the_documentation_work(self):
        text = DOCS.read_text()
        block = text[text.index("\ncurl"):text.index("```\n", text.index("\ncurl"))]
        commands = re.split(r"\n(?=curl)", block.strip())
        self.assertGreater(len(commands), 6)
        agent = Agent()  # its first episode is e1
        self.addCleanup(agent.stop)
        with tempfile.TemporaryDirectory() as folder:
            for command in commands:
                done = subprocess.run(["bash", "-c", command.replace("8361", str(agent.port))], cwd=folder, capture_output=True, timeout=60)
                self.assertEqual(done.returncode, 0, command)
                if "-o" in command:
                    continue
                answer = json.loads(done.stdout)
                self.assertNotIn("error", answer, command)
                if '"stop"' in command:
                    self.assertIn("score", answer)
            for name in ("panorama.jpg", "view.jpg"):
                self.assertEqual(pathlib.Path(folder, name).read_bytes()[:3], b"\xff\xd8\xff")

    def test_episodes_of_vln_are_tasks_whose_goal_is_not_told(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "tasks.jsonl")
            subprocess.run([PROGRAM, "vln", "make", "--world", "box_room", "--templates", "any", "--starts", "1", "--limit", "2", "--out", file],
                           check=True, capture_output=True, timeout=60)
            episodes = [json.loads(line) for line in pathlib.Path(file).read_text(encoding="utf-8").splitlines()]
            agent = Agent("--tasks", file)
            self.addCleanup(agent.stop)
        self.assertEqual([t["task"] for t in agent.call("GET", "/v1/tasks")[1]["tasks"]], [e["id"] for e in episodes])
        for episode in episodes:
            _, made = agent.call("POST", "/v1/episodes", {"task": episode["id"]})
            self.assertEqual((made["task"]["instruction"], made["task"]["start"]["p"]), (episode["instruction"], episode["start"]["p"]))
            self.assertIsNone(made["task"]["goal"])
            path = "/v1/episodes/" + made["episode"]
            # The way of the file leads there.
            for point in episode["ref"][1:]:
                _, seen = agent.call("POST", path + "/step", {"action": {"type": "waypoints", "points": [point], "speed": 1}})
                self.assertIsNone(seen["observation"]["distance_to_goal"])
            self.assertTrue(agent.call("POST", path + "/step", {"action": "stop"})[1]["score"]["success"], episode["id"])
        self.assertEqual(agent.call("POST", "/v1/episodes", {"task": "other"})[0], 422)

    def test_the_openapi_description_is_served(self):
        status, api = self.agent.call("GET", "/openapi.json")
        self.assertEqual((status, api["openapi"]), (200, "3.0.3"))

    def test_a_websocket_flies_an_episode(self):
        ws = WebSocket(self.agent.port)
        self.addCleanup(ws.close)
        made = ws.ask({"id": 1, "method": "POST", "path": "/v1/episodes", "body": {"start": {"p": [-3, 0, 2]}, "presets": {"forward": 1}}})
        self.assertEqual((made["id"], made["status"]), (1, 201))
        path = "/v1/episodes/" + made["body"]["episode"]
        step = ws.ask({"id": "b", "method": "POST", "path": path + "/step", "body": {"action": "forward", "observe": {"panorama": {"width": 64}}}})
        self.assertAlmostEqual(step["body"]["observation"]["pose"]["p"][0], -2, delta=0.3)
        self.assertEqual(base64.b64decode(step["body"]["observation"]["panorama"]["data"])[:3], b"\xff\xd8\xff")
        self.assertEqual(ws.ask(b"not json")["status"], 422)
        self.assertEqual(ws.ask({"method": "DELETE", "path": path})["status"], 200)

    def test_mistakes_name_their_field(self):
        status, answer = self.agent.call("POST", "/v1/episodes", {"limits": {"max_step": 3}})
        self.assertEqual((status, answer["error"]["field"], answer["error"]["nearest"]), (422, "limits.max_step", "max_steps"))

    def test_starts_within_things_or_without_the_world_are_refused(self):
        for place in ([3, 0, 0.5], [50, 0, 1], [0, 0, -3]):
            status, answer = self.agent.call("POST", "/v1/episodes", {"start": {"p": place}})
            self.assertEqual(status, 422, place)
            self.assertIn("start.p", answer["error"]["message"])

    def ask(self, method, path):
        """Status, headers and body as they come, over a connection that goes on."""
        connection = http.client.HTTPConnection("127.0.0.1", self.agent.port, timeout=60)
        self.addCleanup(connection.close)
        connection.request(method, path)
        response = connection.getresponse()
        first = response.status, dict(response.getheaders()), response.read()
        connection.request("GET", "/openapi.json")
        self.assertEqual(connection.getresponse().status, 200)
        return first

    def test_a_wrong_method_is_told_the_right_ones(self):
        for method, path, allowed in (("PUT", "/v1/episodes", "GET, HEAD, POST"), ("POST", "/openapi.json", "GET, HEAD"),
                                      ("DELETE", "/openapi.json", "GET, HEAD")):
            status, headers, _ = self.ask(method, path)
            self.assertEqual((status, headers.get("Allow")), (405, allowed), (method, path))

    def test_head_is_get_without_the_body(self):
        _, asked, body = self.ask("GET", "/openapi.json")
        status, headers, nothing = self.ask("HEAD", "/openapi.json")
        self.assertEqual((status, headers["Content-Length"], nothing), (200, str(len(body)), b""))

    def test_web_pages_and_other_bodies_are_refused(self):
        self.assertEqual(self.agent.call("GET", "/", headers={"Origin": "http://example.org"})[0], 403)
        self.assertEqual(self.agent.call("GET", "/", headers={"Host": "example.org"})[0], 403)
        self.assertEqual(self.agent.call("POST", "/v1/episodes", "{}", {"Content-Type": "text/plain"})[0], 415)
        self.assertEqual(self.agent.call("POST", "/v1/episodes", b" " * (2 << 20))[0], 413)

    def raw(self, head, body=b""):
        """Status of a request that is sent as it is."""
        with socket.create_connection(("127.0.0.1", self.agent.port), 20) as one:
            one.sendall(head.replace("\n", "\r\n").encode() + b"\r\n\r\n" + body)
            return int(one.makefile("rb").readline().split()[1])

    def test_media_types_in_any_case_are_json(self):
        for kind in ("Application/JSON", "application/json; charset=utf-8", "APPLICATION/JSON ;charset=utf-8"):
            status, _ = self.agent.call("POST", "/v1/episodes", {"nothing": 1}, {"Content-Type": kind})
            self.assertEqual(status, 422, kind)
        for kind in ("application/jsonp", "application/x-www-form-urlencoded", "text/json", ""):
            status, answer = self.agent.call("POST", "/v1/episodes", "{}", {"Content-Type": kind})
            self.assertEqual(status, 415, kind)
            self.assertIn("Content-Type: application/json", answer["error"]["message"])

    def test_a_request_has_one_host(self):
        port = self.agent.port
        for head, status in [("GET / HTTP/1.1", 400), ("GET / HTTP/1.0", 200), (f"GET / HTTP/1.1\nHost: 127.0.0.1:{port}", 200),
                             (f"GET / HTTP/1.1\nHost: 127.0.0.1:{port}\nHost: example.org", 400),
                             (f"GET / HTTP/1.1\nHost: localhost\nHost: localhost", 400)]:
            self.assertEqual(self.raw(head), status, head)

    def test_pages_of_other_servers_on_this_machine_are_refused(self):
        port = self.agent.port
        for origin, status in [(f"http://127.0.0.1:{port}", 200), (f"http://localhost:{port}", 200), (f"http://[::1]:{port}", 200),
                               ("http://localhost", 403), (f"http://localhost:{port + 1}", 403), ("http://localhost:80", 403), ("null", 403),
                               (f"http://localhost.example.org:{port}", 403), (f"http://example.org:{port}", 403)]:
            self.assertEqual(self.agent.call("GET", "/", headers={"Origin": origin})[0], status, origin)

    def test_connections_without_a_request_lock_out_nobody(self):
        held = []
        for start in (b"", b"GET / HTTP/1.1\r\nHo"):
            for _ in range(200):
                one = socket.create_connection(("127.0.0.1", self.agent.port), 20)
                one.sendall(start)
                held.append(one)
        for _ in range(10):
            self.assertEqual(self.agent.call("GET", "/")[0], 200)
        for one in held:
            one.close()

    def test_the_free_space_around_is_observed(self):
        _, made = self.agent.call("POST", "/v1/episodes", {"start": {"p": [-3, 0, 2]}})
        # A room of 10 x 10 m: 2 m to the wall and to the floor.
        self.assertAlmostEqual(made["observation"]["clearance"], 2, delta=0.05)

    def test_it_ends_in_the_middle_of_an_action(self):
        agent = Agent("--tier", "reference")
        _, made = agent.call("POST", "/v1/episodes", {"start": {"p": [-3, 0, 2]}})
        with socket.create_connection(("127.0.0.1", agent.port), 20) as one:
            one.sendall(f"GET /v1/episodes/{made['episode']}/panorama.jpg?width=4096 HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
            time.sleep(1)
            start = time.monotonic()
            self.assertEqual(agent.stop(), 0)
            self.assertLess(time.monotonic() - start, 10)

    def test_slow_and_hostile_clients_hold_up_nobody(self):
        held = []
        for start in (b"", b"POST /v1/episodes HTTP/1.1\r\nContent-Le", b"POST /v1/episodes HTTP/1.1\r\nContent-Length: 1000\r\n\r\n{"):
            for _ in range(10):
                one = socket.create_connection(("127.0.0.1", self.agent.port))
                one.sendall(start)
                held.append(one)
        garbage = socket.create_connection(("127.0.0.1", self.agent.port))
        garbage.sendall(os.urandom(5000))
        # Somebody who asks for large pictures and never reads them.
        _, made = self.agent.call("POST", "/v1/episodes", {"start": {"p": [-3, 0, 2]}})
        deaf = socket.create_connection(("127.0.0.1", self.agent.port))
        request = f"GET /v1/episodes/{made['episode']}/panorama.jpg?width=2048 HTTP/1.1\r\nHost: localhost\r\n\r\n".encode()
        deaf.sendall(20 * request)
        for _ in range(20):
            start = time.monotonic()
            self.assertEqual(self.agent.call("GET", "/")[0], 200)
            self.assertLess(time.monotonic() - start, 5)
        for one in held + [garbage, deaf]:
            one.close()
        self.assertEqual(self.agent.call("GET", "/")[0], 200)

    def test_many_agents_fly_at_once(self):
        results = []

        def fly(number):
            _, made = self.agent.call("POST", "/v1/episodes", {"start": {"p": [-3, 0, 2]}, "presets": {"forward": 0.5}, "seed": number})
            path = "/v1/episodes/" + made["episode"]
            for _ in range(3):
                status, answer = self.agent.call("POST", path + "/step", {"action": "forward"})
            results.append((status, tuple(answer["observation"]["pose"]["p"])))
            self.agent.call("DELETE", path)
        threads = [threading.Thread(target=fly, args=(i,)) for i in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(results), 6)
        self.assertEqual(len(set(results)), 1)  # each had its own drone in the same still air


class RealTime(unittest.TestCase):
    def test_thinking_takes_time_in_the_episode(self):
        agent = Agent("--realtime")
        self.addCleanup(agent.stop)
        _, made = agent.call("POST", "/v1/episodes", {"start": {"p": [-3, 0, 2]}})
        time.sleep(0.3)
        _, seen = agent.call("POST", f"/v1/episodes/{made['episode']}/observe")
        self.assertGreaterEqual(seen["observation"]["t"], 0.29)
        self.assertAlmostEqual(seen["latency"], seen["observation"]["t"], delta=1e-6)


class Flags(unittest.TestCase):
    def test_bad_flags_end_with_status_2(self):
        for arguments in (["--world", "box_rom"], ["--world", "box_room", "--port", "70000"], ["--world", "box_room", "--host", "nowhere"],
                          ["--world", "box_room", "--episodes", "0"]):
            done = subprocess.run([PROGRAM, "agent", *arguments], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn("airsim360: error:", done.stderr)


if __name__ == "__main__":
    unittest.main()
