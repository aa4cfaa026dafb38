#!/usr/bin/env python3
"""What ingredients of our worlds are worth to a network that learns from them.

    PYTHONPATH=build/python /usr/bin/python3 bench/usefulness.py segment --frames DIR --out RUNS [--steps 400] [--seeds 3]
    PYTHONPATH=build/python /usr/bin/python3 bench/usefulness.py attitude --frames DIR --out RUNS --photographs PANORAMA...

DIR is of `airsim360 learn frames`. Each row trains with another choice of frames or randomisation, all with the same number of steps, once a
seed, and is measured on the world that is held out (segment: mean IoU of seven classes) or on level panoramas that are turned
(attitude: median error in degrees). Prints a Markdown table: mean over the seeds, and the half width of its 95 % interval by Student's
t. The same command goes on after an interruption.
"""
import argparse
import json
import math
import statistics
import subprocess
import sys
from pathlib import Path

STUDENT = {2: 12.71, 3: 4.30, 4: 3.18, 5: 2.78}  # 97.5 % of t with n - 1 degrees of freedom


def rows(worlds, held):
    """Name of a row -> flags of `train`."""
    rest = [w for w in worlds if w != held]
    return {f"all {len(rest)} other worlds": ["--without", held],
            "one of them": ["--worlds", rest[0]],
            "three of them": ["--worlds", ",".join(rest[:3])],
            "one sky in each": ["--without", held, "--skies", "1"],
            "nobody in the streets": ["--without", held, "--no-people"],
            "a quarter of the frames": ["--without", held, "--most", "QUARTER"],
            "no domain randomisation": ["--without", held, "--augment", "none"]}


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
        learn(a.task, "train", "--out", out, "--frames", a.frames, "--steps", a.steps, "--size", a.size, "--seed", seed, "--threads", a.threads, *flags)
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
    a = parser.parse_args()
    a.size = a.size or {"segment": 128, "attitude": 32}[a.task]
    if a.task == "attitude" and not a.photographs:
        parser.error("attitude needs --photographs")
    about = [json.loads(path.read_text()) for path in a.frames.glob("*_[0-9][0-9][0-9][0-9][0-9].json")]
    worlds = sorted({frame["world"] for frame in about})
    if a.held not in worlds or len(worlds) < 4:
        parser.error(f"--frames: needs {a.held} and three worlds more; there are {', '.join(worlds)}")
    quarter = sum(frame["world"] != a.held for frame in about) // 4
    print(f"| trained on | {'mean IoU' if a.task == 'segment' else 'median error'} | ± |\n|---|--:|--:|")
    for k, (name, flags) in enumerate(rows(worlds, a.held).items()):
        flags = [str(quarter) if flag == "QUARTER" else flag for flag in flags]
        found = [measured(a, a.held, flags, a.out / f"{a.task}_{k}_{seed}", seed) for seed in range(a.seeds)]
        spread = STUDENT.get(len(found), 2.6) * statistics.stdev(found) / math.sqrt(len(found)) if len(found) > 1 else float("nan")
        print(f"| {name} | {statistics.mean(found):.3f} | {spread:.3f} |", flush=True)


if __name__ == "__main__":
    main()
