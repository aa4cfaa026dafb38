"""Example 8: an agent over HTTP. It knows the range grid and the goal's direction, and flies to where the way is free and
leads nearer: a baseline for models that see. Python's standard library only.

    /usr/bin/python3 examples/08_agent.py
"""
import json
import os
import pathlib
import subprocess
import sys
import urllib.request
from typing import Any

program = os.environ.get("AIRSIM360", str(pathlib.Path(__file__).resolve().parents[1] / "build/bin/airsim360"))
server = subprocess.Popen([program, "agent", "--world", "box_room", "--port", "0"], stdout=subprocess.PIPE, text=True)


def request(method: str, path: str, body: dict[str, Any]) -> Any:
    """The JSON that the server answers with."""
    call = urllib.request.Request(f"http://127.0.0.1:{port}{path}", json.dumps(body).encode(),
                                  {"Content-Type": "application/json"}, method=method)
    with urllib.request.urlopen(call) as answer:
        return json.load(answer)


try:
    assert server.stdout is not None
    port = int(server.stdout.readline().rsplit(":", 1)[1])

    # An episode: from one corner to the other, around the box.
    observe = {"range_grid": {"rows": 8, "columns": 16}}
    answer = request("POST", "/v1/episodes", {
        "instruction": "fly to the far corner", "start": {"p": [-3.5, -3.5, 1.5], "yaw_deg": 45},
        "goal": [3.5, 3.5, 4.0], "observe": observe})
    episode = "/v1/episodes/" + answer["episode"]

    # Look, choose, act: straight to the goal as far as the sector towards it is free.
    for i in range(20):
        seen = answer["observation"]
        if seen["done"]:
            break
        distance = seen["distance_to_goal"]
        azimuth, elevation = seen["goal_direction"]["azimuth_deg"], seen["goal_direction"]["elevation_deg"]
        row, column = int((90 - elevation) / 22.5) % 8, int((azimuth + 180) / 22.5) % 16
        free = seen["range_grid"]["range"][row][column]
        room = 100.0 if free is None else free - 0.7
        print(f"step {i}: {distance:.2f} m to go, {room:.2f} m free ahead")
        action: Any = "stop"
        if distance > 0.8:
            action = {"type": "relative_goal", "azimuth_deg": azimuth if room > 0.3 else azimuth - 60,
                      "elevation_deg": elevation, "distance": min(distance, max(room, 0.5))}
        answer = request("POST", episode + "/step", {"action": action, "observe": observe})
    print(answer.get("score"))
finally:
    server.terminate()
    server.wait()
sys.exit(not answer.get("score", {}).get("success"))
