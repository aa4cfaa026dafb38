#!/usr/bin/python3
"""Latencies and throughput of `airsim360 serve`, as a client sees them.

Usage: rpc_bench.py [--program build/bin/airsim360] [--python build/python] [--world box_room] [--soak SECONDS] [--kills N] [--no-latencies]
Prints one line a figure: medians and 95th percentiles over many calls on one quiet connection; the panoramic loop; what
the server adds to the rendering of a large capture; with --soak, many clients and drones for that long; with --kills, clients that die.
"""
import argparse
import json
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

import msgpack
import numpy as np


class Server:
    def __init__(self, program, world, settings, arguments=()):
        self.folder = tempfile.TemporaryDirectory()
        path = os.path.join(self.folder.name, "settings.json")
        with open(path, "w") as file:
            json.dump(settings, file)
        self.process = subprocess.Popen([program, "serve", "--world", world, "--settings", path, "--port", "0", *arguments],
                                        stdout=subprocess.PIPE, text=True)
        self.port = int(self.process.stdout.readline().rsplit(":", 1)[1])

    def rss_mib(self):
        with open(f"/proc/{self.process.pid}/status") as file:
            return int(re.search(r"VmRSS:\s+(\d+)", file.read())[1]) / 1024

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        assert self.process.wait(60) == 0
        self.process.stdout.close()


class Raw:
    """The least a client can do: what is measured is the server."""

    def __init__(self, port):
        self.socket = socket.socket()
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 17)  # as our client
        self.socket.connect(("127.0.0.1", port))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.unpacker = msgpack.Unpacker(raw=False, max_buffer_size=1 << 30)

    def call(self, method, *arguments):
        self.socket.sendall(msgpack.packb([0, 1, method, arguments]))
        while True:
            for _, _, error, result in self.unpacker:
                if error is not None:
                    raise RuntimeError(error)
                return result
            self.unpacker.feed(self.socket.recv(1 << 20))


def timed(call, count):
    times = []
    for _ in range(count):
        start = time.perf_counter()
        call()
        times.append(1000 * (time.perf_counter() - start))
    return np.median(times), np.percentile(times, 95)


def row(name, median, p95, bar=""):
    print(f"{name:58s} {median:9.3f} ms   p95 {p95:9.3f} ms   {bar}", flush=True)


def latencies(server, airsim):
    raw = Raw(server.port)
    row("ping, raw socket", *timed(lambda: raw.call("ping"), 3000), "bar 0.1")
    row("getMultirotorState, raw socket", *timed(lambda: raw.call("getMultirotorState", ""), 3000), "bar 0.2")
    client = airsim.MultirotorClient(port=server.port)
    row("ping, our client", *timed(client.ping, 2000))
    row("getMultirotorState, our client", *timed(client.getMultirotorState, 2000))
    request = [airsim.ImageRequest("0", airsim.ImageType.DepthPerspective, True, False)]
    row("256x144 float image, our client, whole call", *timed(lambda: client.simGetImages(request), 100))
    binary = msgpack.packb({"image_data_float": np.zeros(256 * 144, np.float32).tobytes()})
    stock = msgpack.packb({"image_data_float": np.zeros(256 * 144, np.float32).tolist()}, use_single_float=True)
    decode = airsim.ImageResponse.from_msgpack
    row("  decoding it, our binary form", *timed(lambda: decode(msgpack.unpackb(binary)), 300), "bar 1")
    row("  decoding it, stock floats (C msgpack)",
        *timed(lambda: np.array(msgpack.unpackb(stock)["image_data_float"], np.float32), 100))


def panorama_loop(server, airsim, seconds=5):
    client = airsim.MultirotorClient(port=server.port)
    client.enableApiControl(True)
    client.armDisarm(True)
    client.takeoffAsync().join()
    client.simSetPanoramaResolution("panorama_original", 448, 224)
    requests = [airsim.ImageRequest("panorama_original", airsim.ImageType.Scene, False, False),
                airsim.ImageRequest("panorama_depth", airsim.ImageType.Scene, True, False)]
    count, start = 0, time.perf_counter()
    while time.perf_counter() - start < seconds:
        client.simTriggerPanoramaCapture("panorama_original")
        color, depth = client.simGetImages(requests)
        assert len(color.image_data_uint8) == 448 * 224 * 3 and depth.image_data_float.shape == (448 * 224,)
        client.getMultirotorState()
        client.moveByRollPitchYawThrottleAsync(0, 0, 0, 0.587, 0.1)
        count += 1
    print(f"{'Fly360 loop, 448x224 RGB + range + state + command':58s} {count / (time.perf_counter() - start):9.1f} Hz   bar 15, stretch 30")


def answer_reader(raw, method, *arguments):
    """A function that makes a call and takes its answer off the socket without decoding it: what is measured is the server."""
    message = msgpack.packb([0, 1, method, arguments])
    raw.socket.sendall(message)
    size, unpacker = 0, msgpack.Unpacker(raw=False, max_buffer_size=1 << 30)
    while True:
        data = raw.socket.recv(1 << 20)
        size += len(data)
        unpacker.feed(data)
        try:
            unpacker.skip()
            break
        except msgpack.OutOfData:
            pass
    buffer = memoryview(bytearray(size))

    def read():
        raw.socket.sendall(message)
        got = 0
        while got < size:
            got += raw.socket.recv_into(buffer[got:])
    return read


def rendered_here(world):
    """The same pictures without a server: a function that renders them in this process, where the compiled module is there."""
    try:
        import airsim360
        place = airsim360.World(world)
    except ImportError:
        return None
    ground = place.raycast([place.spawn], [[0, 0, -1]])[0][0]
    position = place.spawn - [0, 0, ground - 0.04]
    rig = airsim360.Rig(width=2048, height=1024, tier="fast")
    return lambda: place.capture(position, rig, yaw=np.pi / 2)


def large_capture(server, airsim, world, rounds):
    """What calls take beyond the renderer's own time for them, and how that compares with rendering without a server."""
    client = airsim.MultirotorClient(port=server.port)
    client.simPause(True)
    client.simSetPanoramaResolution("panorama_original", 2048, 1024)
    client.simTriggerPanoramaCapture("panorama_original")
    requests = [airsim.ImageRequest("panorama_original", 0, False, False), airsim.ImageRequest("panorama_depth", 0, True, False),
                airsim.ImageRequest("panorama_entity", 0, False, False)]

    def ours():
        for response in client.simGetImages(requests):
            response.pixels()

    raw = Raw(server.port)
    wire = [{name: getattr(request, name) for name in ("camera_name", "image_type", "pixels_as_float", "compress")} for request in requests]
    calls = {"our client, NumPy arrays": ours,
             "raw socket, floats as bytes": answer_reader(raw, "simGetImages", [{**r, "binary_float": True} for r in wire], "", False),
             "raw socket, AirSim's own request": answer_reader(raw, "simGetImages", wire, "", False)}
    # Each call beside its own rendering: what else the machine does slows both.
    render = lambda: float(raw.call("simGetRenderMilliseconds"))
    here, alone = rendered_here(world), []
    times = {name: [] for name in calls}
    for call in calls.values():
        call()
    for _ in range(rounds):
        for name, call in calls.items():
            times[name].append((timed(call, 1)[0], render()))
        if here:
            alone.append(timed(here, 1)[0])
    for name, pairs in times.items():
        call, rendering = np.array(pairs).T
        rest = 100 * (call / rendering - 1)
        print(f"{'2048x1024 RGB + range + entity, ' + name:66s} {np.median(call):8.1f} ms   rendering {np.median(rendering):.1f} ms, "
              f"beyond it {np.median(call - rendering):.2f} ms = {np.median(rest):.2f} % (quartiles {np.percentile(rest, 25):.2f} "
              f"{np.percentile(rest, 75):.2f})   bar 5 %   {world}", flush=True)
    if alone:
        print(f"{'  the same rendered in a process without a server':66s} {np.median(alone):8.1f} ms", flush=True)


def soak(program, world, airsim, seconds, clients=16, drones=10):
    vehicles = {f"Drone{i}": {"VehicleType": "SimpleFlight", "X": -4 + 2 * (i % 5), "Y": -3 + 3 * (i // 5)} for i in range(drones)}
    server = Server(program, world, {"Vehicles": vehicles})
    names, problems, counts = list(vehicles), [], [0] * clients
    stop = time.time() + seconds

    def work(number):
        try:
            client = airsim.MultirotorClient(port=server.port, timeout_value=120)
            name = names[number % drones]
            client.enableApiControl(True, name)
            client.armDisarm(True, name)
            while time.time() < stop:
                client.moveByVelocityZAsync(0.3, 0, -1.5, 0.5, vehicle_name=name)
                client.getMultirotorState(name)
                client.getImuData("", name)
                client.simGetCollisionInfo(name)
                if counts[number] % 10 == 0:
                    client.simGetImages([airsim.ImageRequest("0", airsim.ImageType.DepthPerspective, True, False)], name)
                counts[number] += 1
                time.sleep(0.02)
        except Exception as problem:  # pylint: disable=broad-except  # every problem is a finding
            problems.append(f"client {number}: {problem!r}")
    threads = [threading.Thread(target=work, args=(number,)) for number in range(clients)]
    for thread in threads:
        thread.start()
    raw = Raw(server.port)
    time.sleep(min(10, seconds / 4))
    first, steps, last = server.rss_mib(), [], None
    while time.time() < stop:
        wall, stamp = time.perf_counter(), raw.call("getMultirotorState", names[0])["timestamp"] * 1e-9
        if last:
            steps.append(1000 * abs((stamp - last[1]) - (wall - last[0])))
        last = (wall, stamp)
        time.sleep(0.05)
    for thread in threads:
        thread.join()
    final = server.rss_mib()
    server.stop()
    print(f"soak: {clients} clients, {drones} drones, {seconds} s: {sum(counts)} loops, {len(problems)} errors {problems[:3]}")
    print(f"      RSS {first:.1f} -> {final:.1f} MiB ({100 * (final / first - 1):+.2f} %, bar 2 %)")
    print(f"      sim clock against wall clock over 50 ms: median {np.median(steps):.2f} ms, p95 {np.percentile(steps, 95):.2f} ms, "
          f"largest {np.max(steps):.2f} ms")


# A client in the middle of everything: a move that is pending, large pictures that nobody reads.
VICTIM = """
import socket, sys
import msgpack
s = socket.create_connection(("127.0.0.1", int(sys.argv[1])))
call = lambda i, method, *arguments: s.sendall(msgpack.packb([0, i, method, arguments]))
call(1, "enableApiControl", True, "")
call(2, "armDisarm", True, "")
call(3, "moveByVelocity", 0.2, 0.0, -0.2, 30.0, 0, {"is_rate": True, "yaw_or_rate": 0.0}, "")
image = {"camera_name": "panorama_original", "image_type": 0, "pixels_as_float": False, "compress": False}
print("busy", flush=True)
for i in range(10, 200):
    call(i, "simGetImages", [image], "", False)
    if i % 3 == 0:
        s.recv(100000)
"""


def kills(program, world, count):
    """Clients die in the middle of calls; the server must not notice."""
    server = Server(program, world, {})
    raw = Raw(server.port)
    raw.call("simSetPanoramaResolution", "panorama_original", 512, 256, "")
    rss, slowest = [], 0.0
    for i in range(count):
        victim = subprocess.Popen([sys.executable, "-c", VICTIM, str(server.port)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        victim.stdout.readline()
        time.sleep(0.002 * (i % 50))
        victim.kill()
        victim.wait()
        victim.stdout.close()
        start = time.perf_counter()
        assert raw.call("ping") is True
        slowest = max(slowest, 1000 * (time.perf_counter() - start))
        rss.append(server.rss_mib())
    raw.call("reset")
    assert raw.call("simGetImages", [{"camera_name": "0", "image_type": 0, "pixels_as_float": False, "compress": True}], "", False)
    server.stop()
    warm = rss[len(rss) // 5]
    print(f"kill -9: {count} clients killed in the middle of calls, the server answers (slowest ping {slowest:.1f} ms); "
          f"RSS {warm:.1f} -> {rss[-1]:.1f} MiB ({100 * (rss[-1] / warm - 1):+.2f} % after the first fifth)")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default="build/bin/airsim360")
    parser.add_argument("--python", default="build/python")
    parser.add_argument("--world", default="box_room")
    parser.add_argument("--soak", type=float, default=0, help="seconds of 16 clients and 10 drones; 0 = not")
    parser.add_argument("--kills", type=int, default=0, help="clients killed in the middle of calls; 0 = none")
    parser.add_argument("--no-latencies", action="store_true", help="leave out the figures of a quiet connection")
    parser.add_argument("--rounds", type=int, default=20, help="of the large capture, each with all kinds of calls")
    parser.add_argument("--only-large", action="store_true", help="of those only the large capture")
    arguments = parser.parse_args()
    sys.path.insert(0, arguments.python)
    import airsim360.airsim as airsim
    if not arguments.no_latencies:
        server = Server(arguments.program, arguments.world, {})
        if not arguments.only_large:
            latencies(server, airsim)
            panorama_loop(server, airsim)
        large_capture(server, airsim, arguments.world, arguments.rounds)
        server.stop()
    if arguments.kills > 0:
        kills(arguments.program, arguments.world, arguments.kills)
    if arguments.soak > 0:
        soak(arguments.program, arguments.world, airsim, arguments.soak)


if __name__ == "__main__":
    main()
