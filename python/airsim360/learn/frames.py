"""Training frames: panoramas of many worlds, drawn by the simulator on demand and kept as small files.

A folder of frames has, for frame i of a row, `ROW_0000i.jpg` (colour), `.png` (8 bits: class, and 128 where the entity of the next
pixel to the right or below is another), `.range.png` (16 bits: see range_codes) and `.json` (what it shows).
"""
from __future__ import annotations

import json
import multiprocessing
import os
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Tuple

import cv2
import numpy as np
import numpy.typing as npt

from ..data import Panorama, Panoramas
from .classes import WORLDS, class_table

__all__ = ["Frames", "draw", "range_codes", "range_of", "recipe"]

_BOUNDARY = 128
_NEAR, _FAR = 0.1, 1000.0
_Array = npt.NDArray[Any]


def range_codes(ranges: _Array) -> npt.NDArray[np.uint16]:
    """Ranges (metres) as 16 bits: 1 + 65534 log(r / 0.1) / log(10000), and 0 where nothing is hit or farther than 1000 m."""
    with np.errstate(divide="ignore", invalid="ignore"):
        code = 1 + 65534 * np.log(np.maximum(ranges, _NEAR) / _NEAR) / np.log(_FAR / _NEAR)
    seen = (ranges > 0) & (ranges <= _FAR)
    return np.where(seen, np.rint(np.where(seen, code, 0)), 0).astype(np.uint16)


def range_of(codes: _Array) -> npt.NDArray[np.float32]:
    """The inverse of range_codes, to 0.01 %."""
    code = codes.astype(np.float32)
    return np.where(code > 0, _NEAR * np.exp((code - 1) / 65534 * np.log(_FAR / _NEAR)), 0).astype(np.float32)


_SHARES = (("street", 0.5, "lowest: 1.6, highest: 2.4, clearance: 0.8"), ("above", 0.2, "lowest: 2.4, highest: 30"),
           ("people", 0.3, "sampler: people, people: 24, width: 16, depth: 12, lowest: 1.6, highest: 2.2, pitch_deg: 0, interval: 2, view_frames: 1"))


def recipe(world: str, row: str, frames: int, width: int, skies: int = 16, clean: bool = False, tier: str = "fast") -> str:
    """A recipe of `dataset plan`: the row "street" (at the height of eyes), "above" (2.4 to 30 m) or "people" of a world.

    `skies` consecutive frames share a sky. `clean` leaves out the camera's look. `tier`: fast or high.
    """
    look = "exposure: auto" if clean else "look: photo, camera_look: {each_frame: true, white_error: 0.06}"
    exposure = "" if clean else ", settings: [{setting: exposure, low: -0.7, high: 0.7}]"
    keys = next(keys for name, _, keys in _SHARES if name == row)
    return "\n".join(["name: learn", f"picture: {{size: {width}x{width // 2}, tier: {tier}, {look}, products: []}}", "skies:", "  - name: all",
                      f"    frames: {skies}", "    choices:", f"      - {{weight: 4, climate: true, latitude_deg: 42{exposure}}}",
                      f"      - {{weight: 1, weather: overcast{exposure}}}", "rows:",
                      f"  - {{name: {world}_{row}, world: {world}, frames: {frames}, skies: all, {keys}}}"]) + "\n"


def draw(folder: Path, *, worlds: Sequence[str] = WORLDS, frames: int = 1000, width: int = 1280, seed: int = 0, skies: int = 16,
         clean: bool = False, tier: str = "fast", threads: int = 0) -> "Frames":
    """Draws what is missing in a folder of frames; the same call goes on after an interruption. The same seed, the same frames.

    Of every world's frames half are at the height of eyes, a fifth higher, a third among people. One world is open at a time, in a
    process of its own, so that memory is that of the largest (city_park: 4.7 GiB).
    """
    if width < 64 or width > 8192 or width % 4:
        raise ValueError(f"width: {width}; give a multiple of 4 from 64 to 8192")
    if not 1 <= frames <= 1_000_000:
        raise ValueError(f"frames: {frames}; give 1 to 1000000")
    from .. import worlds as all_worlds
    from .._words import did_you_mean
    known = [w["name"] for w in all_worlds()]
    for world in worlds:
        if world not in known and not Path(world).is_file():
            raise ValueError(f"worlds: {world!r} is no world{did_you_mean(world, known)}")
    folder.mkdir(parents=True, exist_ok=True)
    each = frames / len(worlds)
    rows = {f"{world}_{name}": recipe(world, name, max(1, round(each * share)), width, skies, clean, tier)
            for world in worlds for name, share, _ in _SHARES}
    wanted = {"rows": rows, "seed": seed}
    about = folder / "about.json"
    if about.exists() and json.loads(about.read_text(encoding="utf-8")) != wanted:
        raise ValueError(f"{folder}: holds frames of other worlds, another size or seed; choose another folder")
    _write(about, json.dumps(wanted, indent=1).encode())
    for k, (row, text) in enumerate(rows.items()):
        if (folder / f"{row}.done").exists():
            continue
        print(f"frames: {row} ({k + 1} of {len(rows)})", file=sys.stderr, flush=True)
        _write(folder / f"{row}.yaml", text.encode())
        child = multiprocessing.get_context("spawn").Process(target=_draw_row, args=(folder, row, seed, threads))
        child.start()
        child.join()
        if child.exitcode:
            raise RuntimeError(f"{row}: could not be drawn (exit status {child.exitcode})")
        _write(folder / f"{row}.done", b"")
    return Frames(folder)


def _draw_row(folder: Path, row: str, seed: int, threads: int) -> None:
    try:
        panoramas = Panoramas(folder / f"{row}.yaml", seed=seed, products=["rgb", "semantic", "entity", "range"], cache=False, threads=threads)
        table = class_table(panoramas.categories)
        for i in panoramas.order():
            if not (folder / f"{row}_{i:05d}.json").exists():
                _keep(panoramas[i], folder / f"{row}_{i:05d}", table)
    except ValueError as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)


def _keep(frame: Panorama, stem: Path, table: npt.NDArray[np.uint8]) -> None:
    classes = table[np.minimum(frame.semantic, len(table) - 1)]
    entity = frame.entity
    edge = entity != np.roll(entity, -1, 1)
    edge[:-1] |= entity[:-1] != entity[1:]
    ok, colour = cv2.imencode(".jpg", frame.rgb[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, 95])
    _, label = cv2.imencode(".png", classes | np.where(edge, _BOUNDARY, 0).astype(np.uint8))
    _, ranges = cv2.imencode(".png", range_codes(frame.range), [cv2.IMWRITE_PNG_COMPRESSION, 1])
    _write(stem.with_suffix(".jpg"), colour.tobytes())
    _write(stem.with_suffix(".png"), label.tobytes())
    _write(Path(f"{stem}.range.png"), ranges.tobytes())
    says = {"row": frame.row, "world": frame.world, "environment": frame.environment, "q_wxyz": [float(q) for q in frame.q_wxyz],
            "p": [float(x) for x in frame.p]}
    _write(stem.with_suffix(".json"), json.dumps(says).encode())  # last: a frame with it is whole


def _write(path: Path, data: bytes) -> None:
    part = path.with_name(path.name + ".part")
    part.write_bytes(data)
    os.replace(part, path)


@dataclass
class Frames:
    """Frames of a folder, in order of their numbers; some of them if asked for.

    worlds: those alone; without: all but those. people: False leaves out those among people. skies: how many skies of each
    world at most (0: all). most: at most so many frames, evenly chosen (0: all).
    """

    folder: Path
    worlds: Sequence[str] = ()
    without: Sequence[str] = ()
    people: bool = True
    skies: int = 0
    most: int = 0
    about: List[Dict[str, Any]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.folder = Path(self.folder)
        if not self.folder.is_dir():
            raise ValueError(f"{self.folder}: no folder of frames; make one with `learn frames --out {self.folder}`")
        found = [{**json.loads(path.read_text(encoding="utf-8")), "stem": str(path)[:-5]}
                 for path in sorted(self.folder.glob("*_[0-9][0-9][0-9][0-9][0-9].json"))]
        names = {frame["world"] for frame in found}
        for world in (*self.worlds, *self.without):
            if world not in names:
                raise ValueError(f"{self.folder}: no frames of {world} (there are: {', '.join(sorted(names)) or 'none'})")
        skies: Dict[str, List[str]] = {}
        for frame in found:
            seen = skies.setdefault(frame["world"], [])
            if frame["environment"] not in seen:
                seen.append(frame["environment"])
        chosen = [frame for frame in found
                  if (not self.worlds or frame["world"] in self.worlds) and frame["world"] not in self.without
                  and (self.people or not frame["row"].endswith("_people"))
                  and (not self.skies or skies[frame["world"]].index(frame["environment"]) < self.skies)]
        if self.most and len(chosen) > self.most:
            chosen = [chosen[k * len(chosen) // self.most] for k in range(self.most)]
        if not chosen:
            raise ValueError(f"{self.folder}: no frames are left")
        self.about = chosen

    def __len__(self) -> int:
        return len(self.about)

    def rgb(self, i: int) -> npt.NDArray[np.uint8]:
        """(H, W, 3)."""
        return _read(self.about[i]["stem"] + ".jpg", cv2.IMREAD_COLOR)[..., ::-1]

    def classes(self, i: int) -> Tuple[npt.NDArray[np.uint8], npt.NDArray[np.bool_]]:
        """(H, W) class, IGNORED where there is none; and where another entity begins to the right or below."""
        label = _read(self.about[i]["stem"] + ".png", cv2.IMREAD_UNCHANGED)
        return (label & (_BOUNDARY - 1)).astype(np.uint8), label >= _BOUNDARY

    def range(self, i: int) -> npt.NDArray[np.float32]:
        """(H, W) metres, 0 for none."""
        return range_of(_read(self.about[i]["stem"] + ".range.png", cv2.IMREAD_UNCHANGED))


def _read(path: str, how: int) -> _Array:
    picture: Optional[_Array] = cv2.imread(path, how)
    if picture is None:
        raise ValueError(f"{path}: cannot be read as a picture")
    return picture
