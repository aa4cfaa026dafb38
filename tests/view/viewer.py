"""Running `airsim360 view`."""
import http.client
import json
import os
import re
import signal
import subprocess
import sys

sys.dont_write_bytecode = True
PROGRAM = os.environ["AIRSIM360"]


class Viewer:
    def __init__(self, *arguments):
        self.process = subprocess.Popen([PROGRAM, "view", "--port", "0", *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        assert re.fullmatch(r"listening on http://127\.0\.0\.1:\d+\n", line), line + self.process.stderr.read()
        self.port = int(line.rsplit(":", 1)[1])

    @property
    def address(self):
        return f"http://127.0.0.1:{self.port}"

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        status = self.process.wait(30)
        self.process.stdout.close()
        self.process.stderr.close()
        return status

    def get(self, path, headers=None, method="GET"):
        """Status, headers and body."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.request(method, path, headers=headers or {})
        response = connection.getresponse()
        body = response.read()
        connection.close()
        return response.status, dict(response.getheaders()), body

    def json(self, path):
        status, _, body = self.get(path)
        assert status == 200, (path, status, body)
        return json.loads(body)

    def memory(self):
        """Resident bytes."""
        with open(f"/proc/{self.process.pid}/statm") as file:
            return int(file.read().split()[1]) * 4096


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=240)


def make_dataset(folder, *arguments):
    """A small dataset of the analytic room."""
    done = run("collect", "--world", "box_room", "--frames", 6, "--size", "256x128", "--products", "normal,flow,coverage", *arguments, "--out", folder)
    assert done.returncode == 0, done.stderr
    return folder
