#!/usr/bin/env python3
"""Side by side with Cycles (Debian's Blender 3.4) on the CPU: the same exported world, camera, threads and machine.

    /usr/bin/python3 bench/cycles/compare.py [--world map_town] [--size 2048x1024] [--threads 2] [--rounds 7]
        [--pose x,y,z,yaw] [--steps box,labels,fast,high,plain,quality] [--reference-spp 4096]
        [--own-spp 512] [--keep DIR] [--seconds S]

Needs blender, python3-numpy, python3-pil and build/bin/{airsim360,frame_server,ray_check}. Both renderers stay in memory and
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
from labels import compare, near_edges, read_entities
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
    def __init__(self, glb, threads, *mode):
        super().__init__(["blender", "-b", "--factory-startup", "-P", str(HERE / "cycles_server.py"), "--", str(glb),
                          str(threads), *mode], "CYCLES ", [])

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


def latitude_weight(height):
    return numpy.cos((0.5 - (numpy.arange(height) + 0.5) / height) * numpy.pi)[:, None]


def shown(image, reference):
    """Display values in [0, 1]: mean luminance of the reference to 0.18, then the sRGB curve."""
    weight = numpy.broadcast_to(latitude_weight(len(reference)), reference.shape[:2])
    mean = (numpy.minimum(reference.mean(-1), 50) * weight).sum() / weight.sum()
    x = numpy.clip(image * (0.18 / mean), 0, 1)
    return numpy.where(x < 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def weighted_mean(values, where=True):
    """Over solid angle; `where` picks pixels."""
    weight = latitude_weight(len(values)) * numpy.broadcast_to(where, values.shape[:2])
    return (values * weight).sum() / weight.sum()


def ws_psnr(a, b, where=True):
    return -10 * numpy.log10(max(weighted_mean(((a - b) ** 2).mean(-1), where), 1e-12))


def rel_mse(image, truth):
    """Of linear light: squared error over the squared truth, the largest thousandth of pixels left out."""
    error = ((image - truth) ** 2 / (truth ** 2 + 1e-4)).mean(-1)
    return weighted_mean(error, error <= numpy.quantile(error, 0.999))


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
    exr = folder / "labels.exr"
    cycles.ask(size=size, samples=1, bounces=0, centred=True, X_WC=X_WC, out=str(exr))
    for name, value in compare(labels, exr, BIN / "ray_check", folder).items():
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


STRIPS, STRIP_WIDTH = 8, 8


def strips_of(width):
    """Columns of a panorama that stand for all of it: 4,096 samples of every pixel would take hours."""
    first = [round((i + 0.5) * width / STRIPS) - STRIP_WIDTH // 2 for i in range(STRIPS)]
    return [(x, x + STRIP_WIDTH) for x in first]


def quality(ours, cycles, labels, pose, size, light, own_spp, spp, folder, deadline):
    """Errors against Cycles at 4,096 samples, in strips of columns. Both renderers have the plain scene, whose surfaces
    and light are the same for both; how far their limits agree is printed: our reference against theirs."""
    path, strips = folder / "radiance.exr", strips_of(size[0])
    in_strips = lambda image: numpy.concatenate([image[:, a:b] for a, b in strips], 1)

    def mine(tier, samples, seed, edge_samples=4):
        answer = ours.ask(size=size, tier=tier, samples=samples, seed=seed, edge_samples=edge_samples, labels=False, X_WC=pose, radiance=str(path))
        return in_strips(colors(path)), answer["seconds"]

    def theirs(samples, seed):
        parts = []
        for columns in strips:
            cycles.ask(size=size, columns=columns, samples=samples, bounces=4, X_WC=pose, seed=seed, out=str(path), **light)
            parts.append(colors(path)[:, columns[0]:columns[1]])
        return numpy.concatenate(parts, 1), 0

    truth = reference(theirs, "Cycles' reference", spp, folder, deadline, 256)
    if truth is None:
        return
    own = reference(lambda n, seed: mine("reference", n, seed), "our reference", own_spp, folder, deadline, 16)
    ids = read_entities(labels / "entity/000000.png")
    names = json.loads((labels / "entities.json").read_text())
    with_prefix = lambda *prefixes: in_strips(numpy.isin(ids, [int(key) for key, value in names.items() if value["category_path"].startswith(prefixes)]))
    edges, sky, leaves = in_strips(near_edges(ids)), with_prefix("sky"), with_prefix("vegetation", "nature", "plant")
    regions = {"all": True, "sky": sky & ~edges, "leaves": leaves, "edges": edges & ~leaves, "rest": ~(sky | edges | leaves)}
    print("  " + " " * 22 + "".join(f"{name:>8}" for name in regions) + "  relMSE   light (WS-PSNR, dB, by region)")

    def row(name, render):
        pictures, seconds = zip(*(render(seed) for seed in (1, 2, 3)))
        errors = [statistics.median(ws_psnr(shown(p, truth), shown(truth, truth), where) for p in pictures) for where in regions.values()]
        ratio = numpy.mean([weighted_mean(p.mean(-1), ~sky) for p in pictures]) / weighted_mean(truth.mean(-1), ~sky)
        print(f"  {name:22}" + "".join(f"{e:8.2f}" for e in errors) +
              f"{statistics.median(rel_mse(p, truth) for p in pictures):8.4f} {ratio:7.3f}" +
              (f" {statistics.median(seconds):8.3f} s" if seconds[0] else ""))
        Image.fromarray((shown(pictures[0], truth) * 255 + 0.5).astype(numpy.uint8)).save(folder / f"quality_{name.replace(' ', '_')}.png")

    theirs(1, 0)  # warm
    row("truth", lambda seed: (truth, 0))
    if own is not None:
        row("our reference", lambda seed: (own, 0))
    for rays, edge in ((0, 4), (0, 8), (0, 16), (0, 64), (16, 16), (16, 64)):
        row(f"high {rays or 4} rays {edge} aa", lambda seed, rays=rays, edge=edge: mine("high", rays, seed, edge))
    for n in (4, 16, 64):
        row(f"Cycles {n} spp", lambda seed, n=n: theirs(n, seed))


def open_ours(world, threads, folder, *mode):
    """Our renderer in tier `high`; our sky without sun as a picture, and the sun's irradiance, for Cycles."""
    ours = Server([BIN / "frame_server", world, str(threads), "high", world, *mode])
    sky = folder / "sky.exr"
    (folder / "dot.obj").write_text("v 0 0 0\nv 0.001 0 0\nv 0 0.001 0\nf 1 2 3\n")
    picture = Server([BIN / "frame_server", str(folder / "dot.obj"), str(threads), "fast", world, *mode])
    picture.ask(size=[2048, 1024], tier="fast", edge_samples=1, labels=False, radiance=str(sky),
                X_WC={"p": [0, 0, 30], "q_wxyz": [0.5, -0.5, 0.5, -0.5]})
    picture.close()
    write_exr(sky, numpy.minimum(colors(sky), 30))  # the disc is the sun lamp's
    return ours, dict(sky=str(sky), sun_strength=picture.ready["sun_irradiance"])


def measure_world(world, pose, steps, arguments, folder):
    size, threads = arguments.size, arguments.threads
    glb = folder / f"{world}.glb"
    if not glb.exists():
        subprocess.run([BIN / "airsim360", "world", "export", world, "--out", glb], check=True)
    labels, X_WC = camera_pose(BIN / "airsim360", world, pose, size, threads, folder)
    if steps & {"labels", "fast", "high"}:
        cycles = Cycles(glb, threads)
        print(f"{world}, {size[0]}x{size[1]}, {threads} threads; Blender took {cycles.ready['import_seconds']:.0f} s to open it")
        if "labels" in steps:
            print(" labels and range:")
            label_agreement(labels, cycles, size, X_WC, folder)
        if steps & {"fast", "high"}:
            ours, light = open_ours(world, threads, folder)
            pairs(ours, cycles, X_WC, light, steps, arguments)
            ours.close()
        cycles.close()
    if steps & {"plain", "quality"}:
        print(f"{world}, plain surfaces, {size[0]}x{size[1]}, {threads} threads")
        deadline = time.monotonic() + arguments.seconds
        cycles = Cycles(glb, threads, "plain")
        ours, light = open_ours(world, threads, folder, "plain")
        if "plain" in steps:
            pairs(ours, cycles, X_WC, light, {"high"}, arguments)
        if "quality" in steps:
            quality(ours, cycles, labels, X_WC, size, light, arguments.own_spp, arguments.reference_spp,
                    folder, deadline)
        ours.close()
        cycles.close()


def pairs(ours, cycles, X_WC, light, steps, arguments):
    size = arguments.size
    if "fast" in steps:
        paired_speed("fast, all labels, no antialiasing / Cycles 1 spp, direct light, Z, index, normal", ours, cycles,
                     dict(size=size, tier="fast", edge_samples=1, X_WC=X_WC),
                     dict(size=size, samples=1, bounces=0, X_WC=X_WC, **light), arguments.rounds)
    if "high" in steps:
        for n in (4, 8, 16, 64):
            paired_speed(f"high, all labels, {n} samples at edges / Cycles 16 spp, 4 bounces", ours, cycles,
                         dict(size=size, tier="high", edge_samples=n, X_WC=X_WC),
                         dict(size=size, samples=16, bounces=4, X_WC=X_WC, **light), arguments.rounds)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--world", default="map_town")
    parser.add_argument("--pose", help="default: the world's spawn")
    parser.add_argument("--size", type=parse_size, default=[2048, 1024])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--reference-spp", type=int, default=4096)
    parser.add_argument("--own-spp", type=int, default=512, help="of our reference, whose error is that of `high` but for its noise")
    parser.add_argument("--steps", default="box,labels,fast,high,plain,quality")
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
