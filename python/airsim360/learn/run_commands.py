"""What the commands of `python3 -m airsim360.learn` do; commands.py has their flags."""
from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import Any, Callable, Dict, List

import numpy as np
import torch

from .attitude import Attitude, angles_of, random_rotation, train_attitude, upright
from .augment import kinds_of
from .classes import PALETTE, write_legend
from .depth import Depth, evaluate_depth, train_depth
from .frames import Frames, draw
from .labels import check_photographs, read_panorama, read_photograph, write_labels, write_picture
from .segment import Segmenter, evaluate, labels_of, train_segmenter
from .sphere import directions, sample
from .training import device_of, precision_of

__all__ = ["run"]

_UP = np.array([0.0, -1.0, 0.0])


def run(a: argparse.Namespace) -> Dict[str, Any]:
    """The result of a command; ValueError for bad input, RuntimeError for failures."""
    if not 0 <= a.threads <= 4096:
        raise ValueError(f"--threads: {a.threads}; give 0 to 4096")
    torch.set_num_threads(a.threads or len(os.sched_getaffinity(0)))
    if a.task == "frames":
        return {"frames": len(_draw(a, a.out)), "out": str(a.out)}
    actions: Dict[str, Dict[str, Callable[[argparse.Namespace], Dict[str, Any]]]] = {
        "train": {"segment": _train, "depth": _train, "attitude": _train},
        "apply": {"segment": _apply_segment, "depth": _apply_depth, "attitude": _apply_attitude},
        "eval": {"segment": _eval_segment, "depth": _eval_depth, "attitude": _eval_attitude}}
    return actions[a.action][a.task](a)


def _draw(a: argparse.Namespace, folder: Path) -> Frames:
    if a.skies_of < 1:
        raise ValueError(f"--skies-of: {a.skies_of}; give 1 or more")
    return draw(folder, worlds=a.draw_worlds.split(","), frames=a.draw, width=a.width, seed=a.seed, skies=a.skies_of, clean=a.clean,
                tier=a.tier, threads=a.threads)


def _chosen(a: argparse.Namespace, folder: Path) -> Frames:
    return Frames(folder, worlds=[w for w in a.worlds.split(",") if w], without=[w for w in a.without.split(",") if w], people=not a.no_people,
                  skies=a.skies, most=a.most)


def _train(a: argparse.Namespace) -> Dict[str, Any]:
    kinds, device = kinds_of(a.augment), device_of(a.device)
    step = {"segment": 32, "depth": 16, "attitude": 16}[a.task]
    if a.size % step or not 32 <= a.size <= 1024:
        raise ValueError(f"--size: {a.size}; give a multiple of {step} from 32 to 1024")
    if not 0 < a.rate < 1:
        raise ValueError(f"--rate: {a.rate}; give a number between 0 and 1")
    if not 0 <= a.workers <= 64 or a.seed < 0:
        raise ValueError("--workers: give 0 to 64; --seed: 0 or more")
    if a.frames is None:
        _draw(a, a.out / "frames")
    frames = _chosen(a, a.frames or a.out / "frames")
    common: Dict[str, Any] = {"steps": a.steps, "kinds": kinds, "seed": a.seed, "device": device, "workers": a.workers, "rate": a.rate,
                              "precision": precision_of(a.precision, device)}
    if a.task == "segment":
        train_segmenter(a.out, frames, size=a.size, views=not a.level_views, **common)
    elif a.task == "depth":
        train_depth(a.out, frames, height=a.size, **common)
    else:
        if a.photographs:
            check_photographs(a.photographs)
        if not 0 < a.share <= 1:
            raise ValueError(f"--share: {a.share}; give a number above 0, up to 1")
        train_attitude(a.out, frames, height=a.size, photographs=a.photographs, share=a.share, **common)
    return {"model": str(a.out / "model.pt"), "frames": len(frames), "steps": a.steps}


def _apply_segment(a: argparse.Namespace) -> Dict[str, Any]:
    if not 0 <= a.other <= 1:
        raise ValueError(f"--other: {a.other}; give 0 to 1")
    check_photographs(a.pictures)
    segmenter = Segmenter.load(a.model, device_of(a.device))
    a.out.mkdir(parents=True, exist_ok=True)
    write_legend(a.out / "legend.json")
    for path in a.pictures:
        rgb = read_panorama(path) if a.projection == "erp" else read_photograph(path)
        shares, border = segmenter.panorama(rgb) if a.projection == "erp" else segmenter.photograph(rgb)
        labels = labels_of(shares, a.other)
        write_labels(a.out / f"{path.stem}.png", labels)
        if a.boundaries:
            write_picture(a.out / f"{path.stem}_boundary.png", (border * 255 + 0.5).astype(np.uint8))
        if a.overlay:
            write_picture(a.out / f"{path.stem}_overlay.jpg", (0.45 * rgb + 0.55 * np.array(PALETTE, float)[labels]).astype(np.uint8))
    return {"pictures": len(a.pictures), "out": str(a.out)}


def _apply_depth(a: argparse.Namespace) -> Dict[str, Any]:
    check_photographs(a.pictures)
    depth = Depth.load(a.model, device_of(a.device))
    a.out.mkdir(parents=True, exist_ok=True)
    for path in a.pictures:
        np.save(a.out / f"{path.stem}.npy", depth.range(read_panorama(path)))
    return {"pictures": len(a.pictures), "out": str(a.out)}


def _apply_attitude(a: argparse.Namespace) -> Dict[str, Any]:
    check_photographs(a.pictures)
    attitude = Attitude.load(a.model, device_of(a.device))
    found: Dict[str, Any] = {}
    for path in a.pictures:
        rgb = read_panorama(path)
        up = attitude.up(rgb)
        found[path.name] = {"up": [round(float(v), 5) for v in up], **angles_of(up)}
        if a.out:
            a.out.mkdir(parents=True, exist_ok=True)
            write_picture(a.out / f"{path.stem}.jpg", sample(rgb, directions(rgb.shape[0]) @ upright(up).T.astype(np.float32)))
    return found


def _eval_segment(a: argparse.Namespace) -> Dict[str, Any]:
    return evaluate(Segmenter.load(a.model, device_of(a.device)), _chosen(a, a.frames))


def _eval_depth(a: argparse.Namespace) -> Dict[str, Any]:
    return dict(evaluate_depth(Depth.load(a.model, device_of(a.device)), _chosen(a, a.frames)))


def _eval_attitude(a: argparse.Namespace) -> Dict[str, Any]:
    attitude = Attitude.load(a.model, device_of(a.device))
    if a.turns < 1 or a.seed < 0 or not 0 < a.tilt <= 180:
        raise ValueError("--turns: 1 or more; --seed: 0 or more; --tilt: above 0, up to 180")
    errors: Dict[str, List[float]] = {}
    for number, path in enumerate(a.pictures):
        rgb, random = read_panorama(path), np.random.default_rng([a.seed, number])
        for _ in range(a.turns):
            turn = random_rotation(random)
            while np.degrees(np.arccos(np.clip((turn.T @ _UP) @ _UP, -1, 1))) > a.tilt:
                turn = random_rotation(random)
            up = attitude.up(sample(rgb, directions(min(512, rgb.shape[0])) @ turn.T.astype(np.float32)))
            errors.setdefault(path.name, []).append(float(np.degrees(np.arccos(np.clip(up @ (turn.T @ _UP), -1, 1)))))
    every = np.concatenate([np.array(e) for e in errors.values()])
    return {"median_deg": float(np.median(every)), "mean_deg": float(every.mean()), "within_10_deg": float((every < 10).mean()),
            "pictures": {name: float(np.median(e)) for name, e in errors.items()}}
