#!/usr/bin/env python3
"""How long `airsim360 eval` takes for 1,000 panorama pairs of depth (1024x512) and for entities of 300 frames with 300 masks each.

Usage: eval_bench.py PROGRAM [FOLDER] [--pairs N] [--frames N]. The files are made first (4 GB for all pairs; pairs beyond the first 50 are links to
them) and taken away afterwards, unless FOLDER is given. Wall time of the whole command, files read from the page cache.
"""
import argparse
import json
import os
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

ORIGINALS = 50


def compressed(ids, one):
    """COCO's compressed run lengths of the pixels of one id; `ids` is flat, columns first."""
    inside = ids == one
    edges = np.flatnonzero(np.diff(inside)) + 1
    lengths = np.diff([0, *edges, len(ids)]).tolist()
    lengths = [0, *lengths] if inside[0] else lengths
    text = []
    for i, length in enumerate(lengths):
        value = length - (lengths[i - 2] if i > 2 else 0)
        while True:
            group, value = value & 31, value >> 5
            done = value == (-1 if group & 16 else 0)
            text.append(chr(48 + group + (0 if done else 32)))
            if done:
                break
    return "".join(text)


def make_depth(folder, pairs):
    random = np.random.default_rng(1)
    for name in ("pred", "gt"):
        (folder / name).mkdir(parents=True)
    for i in range(pairs):
        for name in ("pred", "gt"):
            path = folder / name / f"{i:06}.npy"
            if i < ORIGINALS:
                np.save(path, (random.random((512, 1024)) * 30 + 1).astype(np.float32))
            else:
                os.link(folder / name / f"{i % ORIGINALS:06}.npy", path)


def cells(random, count, width=1024, height=512):
    """Pixels belong to the nearest of `count` points: masks that cover the picture."""
    points = random.random((count, 2)) * (width, height)
    rows, columns = np.mgrid[0:height:4, 0:width:4]
    nearest = np.full(rows.shape, np.inf)
    ids = np.zeros(rows.shape, int)
    for i, (x, y) in enumerate(points):
        distance = (columns - x) ** 2 + (rows - y) ** 2
        ids[distance < nearest] = i
        nearest = np.minimum(nearest, distance)
    return np.kron(ids, np.ones((4, 4), int))


def make_entities(folder, frames, masks=300):
    random = np.random.default_rng(2)
    images, truths, results = [], [], []
    for frame in range(1, frames + 1):
        images.append({"id": frame, "width": 1024, "height": 512})
        ids = cells(random, masks)
        moved = np.roll(ids, (2, 5), (0, 1)).flatten(order="F")
        ids = ids.flatten(order="F")
        for one in range(masks):
            area = int((ids == one).sum())
            if area:
                truths.append({"id": len(truths) + 1, "image_id": frame, "category_id": 1, "iscrowd": 0, "area": area, "segmentation": {"size": [512, 1024], "counts": compressed(ids, one)}})
            if (moved == one).any():
                results.append({"image_id": frame, "category_id": 1, "score": float(random.random()), "segmentation": {"size": [512, 1024], "counts": compressed(moved, one)}})
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "gt.json").write_text(json.dumps({"images": images, "annotations": truths, "categories": [{"id": 1, "name": "entity"}]}))
    (folder / "pred.json").write_text(json.dumps(results))


def measure(program, *arguments):
    begin = time.perf_counter()
    done = subprocess.run([program, "eval", *map(str, arguments), "--json"], capture_output=True, text=True, check=True)
    return time.perf_counter() - begin, json.loads(done.stdout)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder", nargs="?")
    parser.add_argument("--pairs", type=int, default=1000)
    parser.add_argument("--frames", type=int, default=300)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(options.folder or temporary)
        if not (folder / "depth").exists():
            make_depth(folder / "depth", options.pairs)
        if not (folder / "entity").exists():
            make_entities(folder / "entity", options.frames)
        seconds, found = measure(options.program, "depth", folder / "depth/pred", folder / "depth/gt", "--force")
        print(f"depth: {found['pictures']} pairs of 1024x512: {seconds:.1f} s")
        seconds, found = measure(options.program, "entity", folder / "entity/pred.json", folder / "entity/gt.json", "--class-agnostic")
        print(f"entity: {found['pictures']} frames, {found['truths']} truths, {found['detections']} detections: {seconds:.1f} s, AP {found['ap']:.4f}")


if __name__ == "__main__":
    main()
