#!/usr/bin/env python3
"""Time of hugin's stitcher for six ready-made faces of ours: `cube_bench --out DIR`, then

    /usr/bin/python3 bench/nona_bench.py DIR/652 [--rounds 7] [--threads 2]

Needs hugin-tools, python3-numpy and python3-pil. Prints the median of whole calls of nona (reading six PNG, remapping,
writing one TIFF), that of its remapping alone (the call less that for a panorama of 64 columns from the same faces),
and how far its panorama is from ours traced directly.
"""
import argparse
import os
import pathlib
import statistics
import subprocess
import tempfile
import time

import numpy
from PIL import Image

# Yaw and pitch of the faces, degrees; up and down as when pitching a camera.
FACES = {"+z": (0, 0), "+x": (90, 0), "-z": (180, 0), "-x": (-90, 0), "-y": (0, 90), "+y": (0, -90)}


def write_project(path, faces, width):
    lines = [f'p f2 w{width} h{width // 2} v360 E0 R0 n"TIFF c:NONE"', "m g1 i2 f0"]
    for name, (yaw, pitch) in FACES.items():
        file = faces / f"{name}.png"
        w, h = Image.open(file).size
        lines.append(f'i w{w} h{h} f0 v90 r0 p{pitch} y{yaw} Eev0 Er1 Eb1 n"{file}"')
    path.write_text("\n".join(lines) + "\n")


def seconds(project, out, threads):
    start = time.perf_counter()
    subprocess.run(["nona", "-o", out, project], check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "OMP_NUM_THREADS": str(threads)})
    return time.perf_counter() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("faces", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--threads", type=int, default=2)
    arguments = parser.parse_args()
    faces = arguments.faces.resolve()
    direct = numpy.asarray(Image.open(faces / "direct.png").convert("RGB")).astype(float)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        times = {}
        for width in (direct.shape[1], 64):
            write_project(folder / f"{width}.pto", faces, width)
            times[width] = [seconds(folder / f"{width}.pto", folder / f"out{width}", arguments.threads)
                            for _ in range(arguments.rounds + 1)][1:]
        whole, small = (statistics.median(times[width]) for width in times)
        stitched = numpy.asarray(Image.open(next(folder.glob(f"out{direct.shape[1]}*.tif"))).convert("RGB")).astype(float)
    psnr = 10 * numpy.log10(255**2 / ((stitched - direct) ** 2).mean())
    print(f"nona, faces of {Image.open(faces / '+z.png').size[0]}, panorama of {direct.shape[1]}x{direct.shape[0]}, "
          f"{arguments.threads} threads: {1000 * whole:.0f} ms the call, {1000 * (whole - small):.0f} ms without reading the faces; "
          f"{psnr:.1f} dB from ours traced directly")


if __name__ == "__main__":
    main()
