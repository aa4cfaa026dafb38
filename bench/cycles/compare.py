#!/usr/bin/env python3
"""Side by side with Cycles (Debian's Blender 3.4) on the CPU: the same exported world, camera, threads and machine.

    /usr/bin/python3 bench/cycles/compare.py [--world map_town] [--size 2048x1024] [--threads 2] [--rounds 7]
        [--pose x,y,z,yaw] [--steps box,labels,fast,high,quality] [--quality-size 256x128] [--reference-spp 4096]
        [--own-spp 512] [--keep DIR] [--seconds S]

Needs blender, python3-numpy, python3-pil and build/bin/{airsim360,frame_server}. Both renderers stay in memory and
take turns; seconds are those of a frame, without starting, loading or building acceleration structures. Two
figures of Cycles are given: the whole call, in which Blender also walks through all its objects, and the sampling
alone, as its own log has it. Ratios use the smaller one.

References are means of parts with seeds of their own; what their halves differ by is printed. With --keep, what has been
exported and rendered stays in DIR and later calls go on from there; --seconds after the start of the step `quality`
no further part is begun.
"""
import argparse
import json
import math
import pathlib
import re
import statistics
import struct
import subprocess
import sys
import tempfile
import threading
import time

import numpy
from exr import read_exr
from labels import compare
from PIL import Image

HERE = pathlib.Path(__file__).resolve().parent
BIN = HERE.parents[1] / "build/bin"


class Server:
    """A renderer that answers one line of JSON with another."""

    def __init__(self, command, prefix="", log=None):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE if log is not None else subprocess.DEVNULL, text=True)
        self.prefix, self.log = prefix, log
        if log is not None:
            threading.Thread(target=lambda: log.extend(self.process.stderr), daemon=True).start()
        self.ready = self.read()

    def read(self):
        for line in self.process.stdout:
            if line.startswith(self.prefix):
                return json.loads(line[len(self.prefix):])
        raise RuntimeError(f"{self.process.args[0]} ended")

    def ask(self, **request):
        self.process.stdin.write(json.dumps(request) + "\n")
        self.process.stdin.flush()
        return self.read()

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Cycles(Server):
    def __init__(self, glb, threads):
        super().__init__(["blender", "-b", "--factory-startup", "-P", str(HERE / "cycles_server.py"), "--", str(glb),
                          str(threads)], "CYCLES ", [])

    def ask(self, **request):
        """Adds `sampling`: from the first sample to the end, as Blender's log says to 0.01 s."""
        del self.log[:]
        answer = super().ask(**request)
        times = [(int(m[1]) * 60 + float(m[2]), m[3]) for m in
                 (re.search(r"Time:(\d+):([\d.]+) .*\| (Sample 0/|Finished)", line) for line in list(self.log)) if m]
        if len(times) >= 2:
            answer["sampling"] = times[-1][0] - times[0][0]
        return answer


def write_exr(path, image):
    """Uncompressed float32 channels B G R."""
    height, width, _ = image.shape

    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(data)) + data
    channels = b"".join(name + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    head = (b"\x76\x2f\x31\x01\x02\0\0\0" + attribute(b"channels", b"chlist", channels) + attribute(b"compression", b"compression", b"\0") +
            attribute(b"dataWindow", b"box2i", window) + attribute(b"displayWindow", b"box2i", window) +
            attribute(b"lineOrder", b"lineOrder", b"\0") + attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) +
            attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0)) +
            attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0")
    line = 8 + 12 * width
    rows = image[..., ::-1].transpose(0, 2, 1).astype("<f4")
    with open(path, "wb") as file:
        file.write(head + struct.pack(f"<{height}Q", *(len(head) + 8 * height + y * line for y in range(height))))
        for y in range(height):
            file.write(struct.pack("<ii", y, 12 * width) + rows[y].tobytes())


def colors(path):
    layers = read_exr(path)
    pick = lambda c: next(v for k, v in layers.items() if k == c or k.endswith("Combined." + c)).astype(numpy.float64)
    return numpy.stack([pick("R"), pick("G"), pick("B")], -1)


def shown(image, reference):
    """Display values in [0, 1]: mean luminance of the reference to 0.18, then the sRGB curve."""
    weight = numpy.cos((0.5 - (numpy.arange(len(reference)) + 0.5) / len(reference)) * numpy.pi)[:, None]
    mean = (numpy.minimum(reference.mean(-1), 50) * weight).sum() / (weight.sum() * reference.shape[1])
    x = numpy.clip(image * (0.18 / mean), 0, 1)
    return numpy.where(x < 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def ws_psnr(a, b):
    weight = numpy.cos((0.5 - (numpy.arange(len(a)) + 0.5) / len(a)) * numpy.pi)[:, None, None]
    error = ((a - b) ** 2 * weight).sum() / (weight.sum() * a.shape[1] * 3)
    return -10 * numpy.log10(max(error, 1e-12))


def parse_size(text):
    return [int(v) for v in text.split("x")]


def camera_pose(program, world, pose, size, threads, folder):
    """Our labels at the pose, as a dataset of one frame; its folder and X_WC."""
    out = folder / f"labels_{world}"
    place = [f"--pose={pose}"] if pose else []
    subprocess.run([program, "render", "--world", world, *place, "--size", "x".join(map(str, size)), "--tier", "labels",
                    "--threads", str(threads), "--out", out], check=True, stdout=subprocess.DEVNULL)
    return out, json.loads((out / "frames.jsonl").read_text().splitlines()[0])["X_WC"]


def label_agreement(labels, cycles, size, X_WC, folder):
    """Ids and range of one frame."""
    names = json.loads((labels / "entities.json").read_text())
    sky = next((int(key) for key, value in names.items() if value["category_path"] == "sky"), 0)
    exr = folder / "labels.exr"
    cycles.ask(size=size, samples=1, bounces=0, filter_width=0.01, X_WC=X_WC, out=str(exr))
    for name, value in compare(labels, exr, sky).items():
        print(f"  {name:26} {value:.3g}" if isinstance(value, float) else f"  {name:26} {value}")


def paired_speed(name, ours, cycles, our_ask, their_ask, rounds):
    """Alternating rounds after one to warm up; medians."""
    times = []
    for round_ in range(rounds + 1):
        a, b = cycles.ask(**their_ask), ours.ask(**our_ask)
        if round_ > 0:
            times.append((b["seconds"], a["seconds"], a.get("sampling", a["seconds"])))
    own, call, sampling = (statistics.median(column) for column in zip(*times))
    ratios = sorted(min(c, s) / o for o, c, s in times)
    print(f"  {name}: ours {own:.3f} s, Cycles {sampling:.3f} s sampling ({call:.3f} s the whole call), "
          f"ratio {statistics.median(ratios):.2f} [{ratios[0]:.2f} … {ratios[-1]:.2f}]")


def reference(render, name, spp, folder, deadline, part):
    """Mean of parts of `part` samples with seeds of their own, kept in `folder`; None if time ran out before the last."""
    parts = []
    for index in range(spp // part):
        path = folder / f"{name}_{part}_{index}.npy"
        if not path.exists():
            if time.monotonic() > deadline:
                print(f"  {name}: {index} of {spp // part} parts so far")
                return None
            numpy.save(path, render(part, 100 + index)[0])
        parts.append(numpy.load(path))
    half = len(parts) // 2
    noise = ws_psnr(*(shown(numpy.mean(p, 0), parts[0]) for p in (parts[:half], parts[half:]))) if half else math.inf
    print(f"  {name}: {spp} samples in {len(parts)} parts; its halves agree to {noise:.2f} dB")
    return numpy.mean(parts, 0)


def quality(ours, cycles, pose, size, sky, sun, own_spp, spp, folder, deadline):
    """Error against each renderer's own reference, and the other's, in display values, weighted by solid angle."""
    path = folder / "radiance.exr"

    def mine(tier, samples, seed):
        answer = ours.ask(size=size, tier=tier, samples=samples, seed=seed, labels=False, X_WC=pose, radiance=str(path))
        return colors(path), answer["seconds"]

    def theirs(samples, seed):
        answer = cycles.ask(size=size, samples=samples, bounces=4, X_WC=pose, seed=seed, out=str(path), sky=sky, sun_strength=sun)
        return colors(path), min(answer["seconds"], answer.get("sampling", answer["seconds"]))

    own = reference(lambda n, seed: mine("reference", n, seed), "our reference", own_spp, folder, deadline, 64)
    other = reference(theirs, "Cycles' reference", spp, folder, deadline, 256)
    if own is None or other is None:
        return

    def error(picture, truth):
        return ws_psnr(shown(picture, truth), shown(truth, truth))
    theirs(1, 0)  # warm
    for name, render in (("high", lambda seed: mine("high", 0, seed)), *((f"Cycles {n} spp", lambda seed, n=n: theirs(n, seed))
                                                                          for n in (4, 16, 64))):
        pictures, seconds = zip(*(render(seed) for seed in (1, 2, 3)))
        against = [statistics.median(error(p, truth) for p in pictures) for truth in (own, other)]
        print(f"  {name:13} {against[0]:6.2f} dB against our reference, {against[1]:6.2f} dB against Cycles', "
              f"{statistics.median(seconds):.3f} s at {size[0]}x{size[1]}")
    print(f"  our reference against Cycles' reference: {error(own, other):.2f} dB, mean light {own.mean() / other.mean():.3f} of theirs")
    for name, picture in (("ours", own), ("cycles", other), ("high", mine("high", 0, 1)[0]), ("cycles16", theirs(16, 1)[0])):
        Image.fromarray((shown(picture, own) * 255 + 0.5).astype(numpy.uint8)).save(folder / f"quality_{name}.png")


def open_both(world, threads, folder):
    """Our renderer in tier `high`, our sky without sun as a picture, and the sun's irradiance."""
    ours = Server([BIN / "frame_server", world, str(threads), "high"])
    sky = folder / "sky.exr"
    (folder / "dot.obj").write_text("v 0 0 0\nv 0.001 0 0\nv 0 0.001 0\nf 1 2 3\n")
    picture = Server([BIN / "frame_server", str(folder / "dot.obj"), str(threads), "fast", world])
    picture.ask(size=[2048, 1024], tier="fast", aa_samples=1, labels=False, radiance=str(sky),
                X_WC={"p": [0, 0, 30], "q_wxyz": [0.5, -0.5, 0.5, -0.5]})
    picture.close()
    write_exr(sky, numpy.minimum(colors(sky), 30))  # the disc is the sun lamp's
    return ours, str(sky), picture.ready["sun_irradiance"]


def measure_world(world, pose, steps, arguments, folder):
    size, threads = arguments.size, arguments.threads
    glb = folder / f"{world}.glb"
    if not glb.exists():
        subprocess.run([BIN / "airsim360", "world", "export", world, "--out", glb], check=True)
    cycles = Cycles(glb, threads)
    print(f"{world}, {size[0]}x{size[1]}, {threads} threads; Blender took {cycles.ready['import_seconds']:.0f} s to open it")
    labels, X_WC = camera_pose(BIN / "airsim360", world, pose, size, threads, folder)
    if "labels" in steps:
        print(" labels and range:")
        label_agreement(labels, cycles, size, X_WC, folder)
    if steps & {"fast", "high", "quality"}:
        ours, sky, sun = open_both(world, threads, folder)
        light = dict(sky=sky, sun_strength=sun)
        if "fast" in steps:
            paired_speed("fast, all labels, no antialiasing / Cycles 1 spp, direct light, Z, index, normal", ours, cycles,
                         dict(size=size, tier="fast", aa_samples=1, X_WC=X_WC),
                         dict(size=size, samples=1, bounces=0, X_WC=X_WC, **light), arguments.rounds)
        if "high" in steps:
            paired_speed("high, all labels, antialiased / Cycles 16 spp, 4 bounces", ours, cycles,
                         dict(size=size, tier="high", X_WC=X_WC),
                         dict(size=size, samples=16, bounces=4, X_WC=X_WC, **light), arguments.rounds)
        if "quality" in steps:
            print(" quality:")
            deadline = time.monotonic() + arguments.seconds
            quality(ours, cycles, X_WC, arguments.quality_size, sky, sun, arguments.own_spp,
                    arguments.reference_spp, folder, deadline)
        ours.close()
    cycles.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--world", default="map_town")
    parser.add_argument("--pose", help="default: the world's spawn")
    parser.add_argument("--size", type=parse_size, default=[2048, 1024])
    parser.add_argument("--quality-size", type=parse_size, default=[256, 128])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--reference-spp", type=int, default=4096)
    parser.add_argument("--own-spp", type=int, default=512, help="of our reference, whose error is that of `high` but for its noise")
    parser.add_argument("--steps", default="box,labels,fast,high,quality")
    parser.add_argument("--keep")
    parser.add_argument("--seconds", type=float, default=math.inf)
    arguments = parser.parse_args()
    steps = set(arguments.steps.split(","))
    with tempfile.TemporaryDirectory(prefix="airsim360_cycles_") as name:
        folder = pathlib.Path(arguments.keep or name)
        folder.mkdir(parents=True, exist_ok=True)
        if "box" in steps:
            measure_world("box_room", "0.3,-0.2,1.6,20", {"labels"}, arguments, folder)
        if steps - {"box"}:
            measure_world(arguments.world, arguments.pose, steps, arguments, folder)


if __name__ == "__main__":
    sys.exit(main())
