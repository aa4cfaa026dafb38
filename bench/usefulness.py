#!/usr/bin/env python3
"""What ingredients of our worlds are worth to a network that learns from them.

    PYTHONPATH=build/python /usr/bin/python3 bench/usefulness.py segment --frames DIR --out RUNS [--high DIR] [--steps 400] [--seeds 3]
    PYTHONPATH=build/python /usr/bin/python3 bench/usefulness.py attitude --frames DIR --out RUNS --photographs PANORAMA...

DIR is of `airsim360 learn frames`, that of --high with `--tier high` and else the same flags. Each row trains with another choice of
frames or randomisation, all with the same number of steps, once a seed, and is measured on the world that is held out (segment: mean
IoU of seven classes) or on level panoramas that are turned (attitude: median error in degrees). Prints a Markdown table: mean over the
seeds, the half width of its 95 % interval by Student's t, and how far it is from the first row, with the interval of that. The same
command goes on after an interruption.
"""
import argparse
import json
import math
import statistics
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np

from airsim360.learn.sphere import crop_rays, directions, rotation, sample

STUDENT = {1: 12.71, 2: 4.30, 3: 3.18, 4: 2.78, 5: 2.57, 6: 2.45, 7: 2.36, 8: 2.31}  # 97.5 % of t by degrees of freedom


def stitched(frames, out):
    """Frames whose labels went through the six faces of a cube, of a quarter of the panorama's width: there and back by the nearest
    pixel, as stitched ground truth is made."""
    out.mkdir(parents=True, exist_ok=True)
    turns = [rotation(k * math.pi / 2, 0, 0) for k in range(4)] + [rotation(0, pitch, 0) for pitch in (math.pi / 2, -math.pi / 2)]
    for path in sorted(frames.glob("*_[0-9][0-9][0-9][0-9][0-9].json")):
        label = cv2.imread(str(path)[:-5] + ".png", cv2.IMREAD_UNCHANGED)
        side, rays = label.shape[1] // 4, directions(label.shape[0])
        back = np.zeros_like(label)
        for turn in turns:
            face = sample(label, crop_rays(side, side, math.pi / 2) @ turn.T, nearest=True)
            x, y, z = np.moveaxis(rays @ turn, -1, 0)
            seen = z >= np.maximum(np.abs(x), np.abs(y))
            at = [np.clip(((v[seen] / z[seen] + 1) / 2 * side).astype(int), 0, side - 1) for v in (x, y)]
            back[seen] = face[at[1], at[0]]
        cv2.imwrite(str(out / path.with_suffix(".png").name), back)
        for kind in (".jpg", ".json"):
            link = out / path.with_suffix(kind).name
            if not link.exists():
                link.symlink_to(path.with_suffix(kind).resolve())
    return out


def rows(worlds, held, high=None, faces=None):
    """Name of a row -> flags of `train`."""
    rest = [w for w in worlds if w != held]
    other = {"labels of six stitched faces": faces, "tier `high`": high}
    more = {name: ["--without", held, "--frames", folder] for name, folder in other.items() if folder}
    return {f"all {len(rest)} other worlds": ["--without", held],
            "one of them": ["--worlds", rest[0]],
            "three of them": ["--worlds", ",".join(rest[:3])],
            "one sky in each": ["--without", held, "--skies", "1"],
            "nobody in the streets": ["--without", held, "--no-people"],
            "a quarter of the frames": ["--without", held, "--most", "QUARTER"],
            "no domain randomisation": ["--without", held, "--augment", "none"], **more}


def half_width(*samples):
    """Of the 95 % interval of a sample's mean, or of the difference of two means; nan where a sample has one value."""
    if any(len(sample) < 2 for sample in samples):
        return float("nan")
    error = math.sqrt(sum(statistics.variance(sample) / len(sample) for sample in samples))
    return STUDENT.get(sum(len(sample) - 1 for sample in samples), 2.26) * error


def learn(*words):
    command = [sys.executable, "-m", "airsim360.learn", *map(str, words), "--json"]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode:
        sys.exit(f"failed: {' '.join(command)}")
    return json.loads(done.stdout)


def measured(a, held, flags, out, seed):
    """The figure of one training."""
    kept = out / "figure.json"
    if not kept.exists():
        learn(a.task, "train", "--out", out, *([] if "--frames" in flags else ["--frames", a.frames]), "--steps", a.steps, "--size", a.size, "--seed", seed, "--threads", a.threads, *flags)
        if a.task == "segment":
            figure = learn("segment", "eval", "--frames", a.frames, "--worlds", held, "--model", out, "--threads", a.threads)["miou"]
        else:
            figure = learn("attitude", "eval", *a.photographs, "--model", out, "--threads", a.threads)["median_deg"]
        kept.write_text(json.dumps(figure))
    return json.loads(kept.read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", choices=("segment", "attitude"))
    parser.add_argument("--frames", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--held", default="new_york_city", help="world that is held out")
    parser.add_argument("--steps", type=int, default=400)
    parser.add_argument("--size", type=int, default=0, help="0: 128 of segment, 32 of attitude")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--photographs", nargs="*", default=[])
    parser.add_argument("--high", type=Path, help="the same frames of tier high: a row more")
    parser.add_argument("--only", default="", help="rows whose names have one of these words: word,word")
    a = parser.parse_args()
    a.size = a.size or {"segment": 128, "attitude": 32}[a.task]
    if a.task == "attitude" and not a.photographs:
        parser.error("attitude needs --photographs")
    about = [json.loads(path.read_text()) for path in a.frames.glob("*_[0-9][0-9][0-9][0-9][0-9].json")]
    worlds = sorted({frame["world"] for frame in about})
    if a.held not in worlds or len(worlds) < 4:
        parser.error(f"--frames: needs {a.held} and three worlds more; there are {', '.join(worlds)}")
    quarter = sum(frame["world"] != a.held for frame in about) // 4
    print(f"| trained on | {'mean IoU' if a.task == 'segment' else 'median error'} | ± | more than the first | ± |\n|---|--:|--:|--:|--:|")
    faces = stitched(a.frames, a.out / "stitched") if a.task == "segment" else None
    chosen = {name: flags for name, flags in rows(worlds, a.held, a.high, faces).items() if not a.only or any(word in name for word in a.only.split(","))}
    first = []
    for name, flags in chosen.items():
        k = name.replace(" ", "_").replace("`", "")
        flags = [str(quarter) if flag == "QUARTER" else flag for flag in flags]
        found = [measured(a, a.held, flags, a.out / f"{a.task}_{k}_{seed}", seed) for seed in range(a.seeds)]
        first = first or found
        against = f"{statistics.mean(found) - statistics.mean(first):+.3f} | {half_width(found, first):.3f}" if found is not first else " | "
        print(f"| {name} | {statistics.mean(found):.3f} | {half_width(found):.3f} | {against} |", flush=True)


if __name__ == "__main__":
    main()
