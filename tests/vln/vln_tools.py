"""What the tests of vln share: the program, a small world, a server of the chat-completions kind that can be told to misbehave."""
import http.server
import json
import os
import re
import socketserver
import subprocess
import threading
import time
from pathlib import Path

PROGRAM = os.environ["AIRSIM360"]
ROOT = Path(__file__).resolve().parents[2]
# box_room: a cube of 1 m at (3, 0, 0.5) in a room of 10 x 10 x 6 m.
TEMPLATES = [{"id": "room/near", "text": "Fly to the box and stop.",
              "query": {"noun": {"word": "box", "names": ["box"]}, "predicates": [{"is": "nearest"}]},
              "distance": [2.5, 6], "height": [1, 3], "goal_distance": 1}]


def run(*words, status=0, **options):
    """Output of the program; fails unless it ends with the status."""
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=300, **options)
    if done.returncode != status:
        raise AssertionError(f"{words}: status {done.returncode}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return done


def lines(path):
    return [json.loads(line) for line in Path(path).read_text(encoding="utf-8").splitlines()]


def make_room(folder, starts):
    """episodes.jsonl of box_room."""
    templates, out = Path(folder) / "templates.json", Path(folder) / "episodes.jsonl"
    templates.write_text(json.dumps(TEMPLATES), encoding="utf-8")
    run("vln", "make", "--world", "box_room", "--templates", templates, "--starts", starts, "--out", out)
    return out


def completion(content):
    return json.dumps({"choices": [{"message": {"role": "assistant", "content": content}}], "usage": {"prompt_tokens": 700, "completion_tokens": 20}}).encode()


class ChatServer:
    """Asks `answer(episode, step, attempt, body)` for each request: bytes with status 200, (status, bytes), or what to do as a text:
    "drop" (no answer), "cut" (half of one), "slow"."""

    def __init__(self, answer):
        self.requests = []
        server = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_POST(self):
                body = self.rfile.read(int(self.headers["Content-Length"]))
                told = json.loads(json.loads(body)["messages"][1]["content"][0]["text"].split(". ", 1)[1].split(" Your last answer")[0])
                key = (told["episode"], told["step"])
                server.requests.append({"key": key, "headers": dict(self.headers), "body": json.loads(body)})
                attempt = sum(r["key"] == key for r in server.requests)
                made = answer(told["episode"], told["step"], attempt, json.loads(body))
                if made == "drop":
                    self.connection.close()
                    return
                if made == "slow":
                    time.sleep(1.6)
                    made = completion("{}")
                if made == "cut":
                    self.send_response(200)
                    self.send_header("Content-Length", "5000")
                    self.end_headers()
                    self.wfile.write(b'{"choices": [')
                    return
                status, content = made if isinstance(made, tuple) else (200, made)
                self.send_response(status)
                if status == 302:
                    self.send_header("Location", "/elsewhere")
                self.send_header("Content-Length", str(len(content)))
                self.end_headers()
                try:
                    self.wfile.write(content)
                except OSError:
                    pass  # it had read enough

            def log_message(self, *_):
                pass

        class Server(socketserver.ThreadingMixIn, http.server.HTTPServer):
            daemon_threads = True

            def handle_error(self, *_):
                pass

        self.http = Server(("127.0.0.1", 0), Handler)
        threading.Thread(target=self.http.serve_forever, args=(0.02,), daemon=True).start()
        self.environment = {**os.environ, "AIRSIM360_VLN_BASE_URL": f"http://127.0.0.1:{self.http.server_port}/v1", "AIRSIM360_VLN_MODEL": "mock",
                            "AIRSIM360_VLN_KEY": "sk-secret-of-the-test", "no_proxy": "127.0.0.1"}

    def close(self):
        self.http.shutdown()
        self.http.server_close()


def check_schema(schema, value, root=None, where="$"):
    """The part of JSON Schema that our schema uses; AssertionError naming the place."""
    root = root or schema
    if "$ref" in schema:
        target = root
        for part in schema["$ref"].removeprefix("#/").split("/"):
            target = target[part]
        return check_schema(target, value, root, where)
    kinds = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None)}
    kind = schema.get("type")
    if isinstance(kind, list):
        kind = "null" if value is None else kind[0]
    if kind in kinds:
        assert isinstance(value, kinds[kind]), f"{where}: {value!r} is no {kind}"
    elif kind in ("number", "integer"):
        assert isinstance(value, (int, float) if kind == "number" else int) and not isinstance(value, bool), f"{where}: {value!r} is no {kind}"
    assert "const" not in schema or value == schema["const"], where
    assert "enum" not in schema or value in schema["enum"], f"{where}: {value!r}"
    assert "minimum" not in schema or value >= schema["minimum"], where
    assert "maximum" not in schema or value <= schema["maximum"], where
    assert "exclusiveMinimum" not in schema or value > schema["exclusiveMinimum"], where
    assert len(value) >= schema.get("minLength", 0) if isinstance(value, str) else True, where
    for choice in ("oneOf", "anyOf"):
        if choice in schema:
            fits = 0
            for option in schema[choice]:
                try:
                    check_schema(option, value, root, where)
                    fits += 1
                except AssertionError:
                    pass
            assert fits == 1 if choice == "oneOf" else fits >= 1, f"{where}: {choice}"
    if isinstance(value, list):
        assert len(value) >= schema.get("minItems", 0) and len(value) <= schema.get("maxItems", 1 << 40), where
        for i, item in enumerate(value):
            check_schema(schema.get("items", {}), item, root, f"{where}[{i}]")
    if isinstance(value, dict):
        for name in schema.get("required", []):
            assert name in value, f"{where}.{name} is missing"
        for name, item in value.items():
            if name in schema.get("properties", {}):
                check_schema(schema["properties"][name], item, root, f"{where}.{name}")
            else:
                assert schema.get("additionalProperties", True), f"{where}.{name} is not in the schema"


def jpeg_size(data):
    """Width and height of its first frame header (ITU-T T.81, B.2.2)."""
    assert data[:2] == b"\xff\xd8"
    at = 2
    while not (0xC0 <= data[at + 1] <= 0xC2):
        at += 2 + int.from_bytes(data[at + 2:at + 4], "big")
    return int.from_bytes(data[at + 7:at + 9], "big"), int.from_bytes(data[at + 5:at + 7], "big")


def paper_instructions():
    """Template id -> text of the built-in list."""
    return {t["id"]: t["text"] for t in json.loads(run("vln", "templates", "--json").stdout)}


def words(text):
    return re.findall(r"[A-Za-z]+", text)
