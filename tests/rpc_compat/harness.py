"""Starts the server for tests, and a raw msgpack client that knows nothing of ours."""
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import unittest

import msgpack

sys.path.insert(0, os.environ["AIRSIM360_PYTHON"])

PROGRAM = os.environ["AIRSIM360"]


class Server:
    """One running server; `settings` is a dictionary for settings.json."""

    def __init__(self, world="box_room", settings=None, arguments=()):
        self.folder = tempfile.TemporaryDirectory()
        path = os.path.join(self.folder.name, "settings.json")
        with open(path, "w") as file:
            json.dump(settings or {}, file)
        self.log = open(os.path.join(self.folder.name, "log"), "w+")
        self.process = subprocess.Popen(
            [PROGRAM, "serve", "--world", world, "--settings", path, "--port", "0", *arguments],
            stdout=subprocess.PIPE, stderr=self.log, text=True, cwd=self.folder.name)
        line = self.process.stdout.readline()
        if not line.startswith("listening on 127.0.0.1:"):
            self.log.seek(0)
            raise RuntimeError(f"the server did not start: {line!r} {self.log.read()}")
        self.port = int(line.rsplit(":", 1)[1])

    def stop(self):
        """Ends it as a user would; returns its exit status."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        status = self.process.wait(30)
        self.process.stdout.close()
        self.log.close()
        self.folder.cleanup()
        return status

    def messages(self):
        self.log.flush()
        with open(self.log.name) as file:
            return file.read()


class RawClient:
    """msgpack-rpc on a socket, by hand."""

    def __init__(self, port, timeout=60):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout)
        self.unpacker = msgpack.Unpacker(raw=False, max_buffer_size=1 << 30)
        self.next_id = 0

    def send(self, method, *arguments):
        """The id of a request that has been sent."""
        self.next_id += 1
        self.socket.sendall(msgpack.packb([0, self.next_id, method, list(arguments)]))
        return self.next_id

    def receive(self):
        """The next answer: (id, error, result)."""
        while True:
            for kind, number, error, result in self.unpacker:
                assert kind == 1
                return number, error, result
            data = self.socket.recv(1 << 20)
            if not data:
                raise ConnectionError("closed")
            self.unpacker.feed(data)

    def call(self, method, *arguments):
        """Result of a call; RuntimeError with the server's text."""
        number = self.send(method, *arguments)
        answered, error, result = self.receive()
        assert answered == number, (answered, number)
        if error is not None:
            raise RuntimeError(error)
        return result

    def close(self):
        self.socket.close()


class ServerTest(unittest.TestCase):
    """A server for all tests of a class."""
    world, settings, arguments = "box_room", {"ClockSpeed": 8}, ()

    @classmethod
    def setUpClass(cls):
        cls.server = Server(cls.world, cls.settings, cls.arguments)

    @classmethod
    def tearDownClass(cls):
        assert cls.server.stop() == 0

    def raw(self):
        client = RawClient(self.server.port)
        self.addCleanup(client.close)
        return client

    def client(self):
        import airsim360.airsim as airsim
        client = airsim.MultirotorClient(port=self.server.port, timeout_value=60)
        self.addCleanup(client.client.close)
        return client

    def assertError(self, call, *texts):
        with self.assertRaises(RuntimeError) as caught:
            call()
        for text in texts:
            self.assertIn(text, str(caught.exception))
