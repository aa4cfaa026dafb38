"""`airsim360 drone --llm`: a model may fill the form, and nothing but the form. The server is a fake one of this file."""
import http.server
import json
import os
import threading
import time
import unittest

from program import ProgramTest

WORDS = "the little racer of my cousin"


class Server:
    """Answers every POST by `answer(handler)` and notes what was asked."""

    def __init__(self, answer):
        self.asked = []
        outer = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_POST(self):
                body = self.rfile.read(int(self.headers["Content-Length"]))
                outer.asked.append((self.path, self.headers.get("Authorization"), json.loads(body)))
                try:
                    answer(self)
                except OSError:
                    pass  # the client has gone

            def log_message(self, *_):
                pass

        self.http = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.http.daemon_threads = True
        self.url = f"http://127.0.0.1:{self.http.server_port}/v1"

    def __enter__(self):
        threading.Thread(target=self.http.serve_forever, args=(0.02,), daemon=True).start()
        return self

    def __exit__(self, *_):
        self.http.shutdown()
        self.http.server_close()


def raw(data, status=200, **headers):
    def answer(handler):
        handler.send_response(status)
        for name, value in {"Content-Length": str(len(data)), **headers}.items():
            handler.send_header(name, value)
        handler.end_headers()
        handler.wfile.write(data)
    return answer


def says(content):
    return raw(json.dumps({"model": "fake", "choices": [{"message": {"content": content}}]}).encode())


def drip(handler):
    handler.send_response(200)
    handler.end_headers()
    for _ in range(100):
        handler.wfile.write(b" ")
        handler.wfile.flush()
        time.sleep(1)


class LlmTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.env = {**os.environ, "no_proxy": "*", "DRONE_KEY": "sk-secret-7"}

    def refused(self, status, answer, *parts):
        with Server(answer) as server:
            out = self.folder / "none.yaml"
            self.run_bad(status, "drone", WORDS, "--llm", server.url, "--out", out, says=parts, env=self.env)
            self.assertFalse(out.exists())
            self.assertEqual(len(server.asked), 1)

    def test_the_form_makes_the_drone(self):
        form = {"mass": 0.6, "propeller": 0.127, "rotors": 6, "drone_class": "racing", "cells": None}
        for content in (json.dumps(form), "```json\n" + json.dumps(form) + "\n```"):
            with Server(says(content)) as server:
                result = self.run_ok("drone", WORDS, "--llm", server.url, "--llm-model", "m1", "--llm-key-env", "DRONE_KEY",
                                     "--json", env=self.env)
            report = json.loads(result.stdout)
            self.assertAlmostEqual(report["mass"], 0.6)
            self.assertEqual([rotor["diameter"] for rotor in report["rotors"]], [0.127] * 6)
            self.assertIn(f"filled by m1 at {server.url}/chat/completions", report["decided"])
            self.assertNotIn("sk-secret-7", result.stdout + result.stderr)
            path, key, body = server.asked[0]
            self.assertEqual((path, key, body["model"]), ("/v1/chat/completions", "Bearer sk-secret-7", "m1"))
            self.assertEqual(body["messages"][-1], {"role": "user", "content": WORDS})

    def test_what_the_model_may_not_say_is_bad_input(self):
        for content, part in [("a fine drone", "not JSON"), ("[1]", "not a JSON object"), ("{}", "empty"),
                              ('{"mas": 1}', "did you mean 'mass'"), ('{"mass": 1e308}', "mass is 1e+308"),
                              ('{"mass": 1e999}', "not JSON"), ('{"mass": NaN}', "not JSON"), ('{"mass": "1 kg"}', "not a number"),
                              ('{"mass": 1, "mass": 2}', "twice"), ('{"rotors": 5}', "4, 6 or 8"), ('{"cells": 3.5}', "whole number"),
                              ('{"layout": "coaxal"}', "coaxial"), ('{"mass": {"kg": 1}}', "flat"), ("[" * 100000, "flat"),
                              ('{"mass": 300, "propeller": 0.05}', "contradicts")]:
            with self.subTest(content=content[:40]):
                self.refused(2, says(content), part)

    def test_a_server_that_fails_is_a_failure(self):
        for answer, part in [(raw(b"<html>"), "JSON"), (raw(b'{"choices": []}'), "choices[0]"), (raw(b"[" * 100000), "nested deeper"),
                             (raw(b" " * (2 << 20)), "1 MiB"), (raw(b"no such model", 404), "status 404: 'no such model'"),
                             (raw(b"", 302, Location="file:///etc/passwd"), "status 302")]:
            with self.subTest(part=part):
                self.refused(1, answer, part)
        with Server(drip) as server:
            self.run_bad(1, "drone", WORDS, "--llm", server.url, "--llm-seconds", "2", says=["within 2 s"], env=self.env)
        self.run_bad(1, "drone", WORDS, "--llm", server.url, says=["cannot be asked"], env=self.env)

    def test_flags(self):
        with Server(says('{"mass": 1}')) as server:
            self.run_ok("drone", "a 250 g racing quad", env={**self.env, "OPENAI_BASE_URL": server.url})
            self.run_bad(2, "drone", "a quad", "--llm", "file:///etc/passwd", says=["--llm"])
            self.run_bad(2, "drone", "a quad", "--llm", server.url, "--llm-key-env", "NO_SUCH_KEY", says=["NO_SUCH_KEY"])
            self.run_bad(2, "drone", "--catalog", "--llm-model", "x", says=["--llm"])
            self.run_bad(2, "drone", WORDS, "--llm", server.url, "--llm-seconds", "0", says=["--llm-seconds"])
            self.assertEqual(server.asked, [])
        schema = json.loads(self.run_ok("drone", "--form").stdout)
        self.assertEqual(schema["properties"]["mass"]["maximum"], 400)


if __name__ == "__main__":
    unittest.main()
