#!/usr/bin/python3
"""A long day of `airsim360 serve`: many clients reset, spawn, change the weather, fly and look, until the time is up.

Usage: server_soak.py [--seconds 3600] [--clients 16] [--cycles 10000] [--program build/bin/airsim360] [--world box_room] [--warm-up 0.1] [--json]
Client 0 resets and changes the weather, the others spawn and destroy, fly, take pictures and scans, are sometimes killed in the
middle of a call and come again. Runs until the time is up and that many cycles of reset, spawning and weather are done, whichever
comes later, but no longer than twice the time. Prints what was done, every error with its number, and the slope of the server's
memory after the warm-up (a share of the time). Status 1 if the server has died, a call has failed that should not have, or a call
took longer than a minute.
"""
import argparse
import collections
import json
import os
import random
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

import msgpack

QUATERNION = {"w_val": 1.0, "x_val": 0.0, "y_val": 0.0, "z_val": 0.0}
ONE = {"x_val": 1.0, "y_val": 1.0, "z_val": 1.0}
# What a call may answer when others are at work at the same time.
EXPECTED = ("are in the world already; destroy one first",)


class Client:
    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), 60)
        self.unpacker = msgpack.Unpacker(raw=False, max_buffer_size=1 << 30)
        self.number = 0

    def send(self, method, *arguments):
        self.number += 1
        self.socket.sendall(msgpack.packb([0, self.number, method, arguments]))

    def call(self, method, *arguments):
        self.send(method, *arguments)
        number = self.number
        while True:
            for _, answered, error, result in self.unpacker:
                if answered != number:
                    continue  # of a move that was left
                if error is not None:
                    raise RuntimeError(f"{method}: {error}")
                return result
            data = self.socket.recv(1 << 20)
            if not data:
                raise ConnectionError(f"{method}: closed by the server")
            self.unpacker.feed(data)


class Soak:
    def __init__(self, options):
        self.options = options
        self.folder = tempfile.TemporaryDirectory()
        drones = {f"D{i}": {"VehicleType": "SimpleFlight", "X": (i % 4) - 1.5, "Y": (i // 4) - 1.5,
                            "Sensors": {"Lidar": {"SensorType": 6, "NumberOfChannels": 8}}} for i in range(options.clients)}
        settings = os.path.join(self.folder.name, "settings.json")
        with open(settings, "w") as file:
            json.dump({"Vehicles": drones}, file)
        self.log = open(os.path.join(self.folder.name, "log"), "w+")
        self.process = subprocess.Popen([options.program, "serve", "--world", options.world, "--settings", settings, "--port", "0"],
                                        stdout=subprocess.PIPE, stderr=self.log, text=True, cwd=self.folder.name)
        self.port = int(self.process.stdout.readline().rsplit(":", 1)[1])
        self.start = time.monotonic()
        self.done = collections.Counter()
        self.errors = collections.Counter()
        self.slowest = 0.0
        self.lock = threading.Lock()

    def running(self):
        past = time.monotonic() - self.start
        if self.process.poll() is not None or past > 2 * self.options.seconds:
            return False
        return past < self.options.seconds or self.cycles() < self.options.cycles

    def cycles(self):
        return self.done["reset"] + self.done["spawn"] + self.done["weather"]

    def count(self, what, call):
        begun = time.monotonic()
        try:
            result = call()
        except (RuntimeError, OSError) as error:
            text = str(error)
            if not any(words in text for words in EXPECTED):
                with self.lock:
                    self.errors[re.sub(r"[0-9]+", "#", text)[:200]] += 1
            if isinstance(error, OSError):
                raise
            result = None
        with self.lock:
            self.done[what] += 1
            self.slowest = max(self.slowest, time.monotonic() - begun)
        return result

    def conduct(self, client, chance):
        """What there is one of: resets and weather."""
        client.call("simEnableWeather", True)
        while self.running():
            self.count("reset", lambda: client.call("reset"))
            for _ in range(4):
                parameter, value = chance.randrange(8), chance.choice((0.0, 0.0, 0.25, 0.5, 1.0))
                self.count("weather", lambda: client.call("simSetWeatherParameter", parameter, value))
            time.sleep(0.01)

    def work(self, number, client, chance):
        vehicle = f"D{number}"
        while self.running():
            choice = chance.randrange(6)
            if choice == 0:
                place = {axis: chance.uniform(-4, 4) for axis in ("x_val", "y_val")} | {"z_val": chance.uniform(-4, -1)}
                name = self.count("spawn", lambda: client.call("simSpawnObject", f"soak{number}", chance.choice(("Cube", "Sphere", "Cone")),
                                                               {"position": place, "orientation": QUATERNION}, ONE, False, False))
                if name:
                    self.count("destroy", lambda: client.call("simDestroyObject", name))
            elif choice == 1:
                self.count("control", lambda: (client.call("enableApiControl", True, vehicle), client.call("armDisarm", True, vehicle)))
                client.send("moveByVelocity", chance.uniform(-2, 2), chance.uniform(-2, 2), chance.uniform(-1, 1), 0.2, 0,
                            {"is_rate": True, "yaw_or_rate": 0.0}, vehicle)
            elif choice == 2:
                request = {"camera_name": "0", "image_type": chance.choice((0, 1, 5)), "pixels_as_float": False, "compress": chance.random() < 0.5}
                self.count("picture", lambda: client.call("simGetImages", [request], vehicle, False))
            elif choice == 3:
                self.count("scan", lambda: client.call("getLidarData", "Lidar", vehicle))
            elif choice == 4:
                self.count("list", lambda: client.call("simListSceneObjects", "soak.*"))
            else:
                for _ in range(10):
                    self.count("state", lambda: client.call("getMultirotorState", vehicle))
            if chance.random() < 0.002:
                # Gone in the middle of a call.
                client.send("simGetImages", [{"camera_name": "panorama_original", "image_type": 0}] * 4, vehicle, False)
                client.socket.close()
                self.done["vanished"] += 1
                client = Client(self.port)

    def client(self, number):
        chance = random.Random(number)
        while self.running():
            try:
                client = Client(self.port)
                self.conduct(client, chance) if number == 0 else self.work(number, client, chance)
                client.socket.close()
            except OSError as error:
                with self.lock:
                    self.errors[f"connection: {error}"[:200]] += 1
                time.sleep(1)

    def memory(self):
        with open(f"/proc/{self.process.pid}/status") as file:
            return int(re.search(r"VmRSS:\s+(\d+)", file.read())[1]) / 1024

    def run(self):
        threads = [threading.Thread(target=self.client, args=(number,)) for number in range(self.options.clients)]
        for thread in threads:
            thread.start()
        samples, told = [], time.monotonic()
        while self.running():
            try:
                samples.append(((time.monotonic() - self.start) / 3600, self.memory()))
            except (OSError, TypeError):
                break
            if time.monotonic() - told > 60 and not self.options.json:
                told = time.monotonic()
                print(f"{samples[-1][0] * 60:6.1f} min  {self.cycles():8d} cycles  {samples[-1][1]:7.1f} MiB", flush=True)
            time.sleep(min(5, self.options.seconds / 100))
        for thread in threads:
            thread.join(120)
        stuck = sum(thread.is_alive() for thread in threads)
        died = self.process.poll()
        if died is None:
            self.process.send_signal(signal.SIGTERM)
            self.process.wait(30)
        return samples, stuck, died


def slope(samples):
    """Least squares, MiB an hour."""
    count = len(samples)
    if count < 2:
        return 0.0
    mean_x, mean_y = sum(x for x, _ in samples) / count, sum(y for _, y in samples) / count
    return sum((x - mean_x) * (y - mean_y) for x, y in samples) / sum((x - mean_x) ** 2 for x, _ in samples)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=3600)
    parser.add_argument("--clients", type=int, default=16)
    parser.add_argument("--cycles", type=int, default=10000)
    parser.add_argument("--program", default="build/bin/airsim360")
    parser.add_argument("--world", default="box_room")
    parser.add_argument("--warm-up", type=float, default=0.1)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    soak = Soak(options)
    samples, stuck, died = soak.run()
    first = int(len(samples) * options.warm_up)
    steady = samples[first:]
    report = {"seconds": round(time.monotonic() - soak.start, 1), "clients": options.clients, "cycles": soak.cycles(), "calls": dict(soak.done),
              "errors": dict(soak.errors), "slowest_call_s": round(soak.slowest, 2), "stuck_clients": stuck, "exit_status": soak.process.returncode,
              "died": died is not None, "rss_mib_first": round(steady[0][1], 1) if steady else None,
              "rss_mib_last": round(steady[-1][1], 1) if steady else None, "rss_mib_most": round(max((y for _, y in samples), default=0), 1),
              "rss_slope_mib_per_hour": round(slope(steady), 2)}
    print(json.dumps(report) if options.json else "\n".join(f"{key:24s} {value}" for key, value in report.items()))
    good = died is None and soak.process.returncode == 0 and not soak.errors and not stuck and soak.slowest < 60
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
