"""Files of real data sets: found, read and written, and what their numbers look like."""
from __future__ import annotations

import json
import math
import struct
import zlib
from pathlib import Path
from typing import Any, Dict, List, NamedTuple, Optional, Sequence

import numpy as np
import numpy.typing as npt

from ..pictures import read_png

__all__ = ["Array", "Depths", "Options", "found", "picture", "label_ids", "write_labels", "write_names", "write_persons", "check_stature"]

Array = npt.NDArray[Any]


class Options(NamedTuple):
    """`every` N-th frame of videos; `force` takes what looks like a mistake as it is."""
    every: int = 30
    force: bool = False


def found(folder: Path, pattern: str) -> List[Path]:
    """The files below a folder that a pattern names, sorted; ValueError if there are none."""
    paths = sorted(folder.rglob(pattern))
    if not paths:
        raise ValueError(f"{folder}: no {pattern} below it")
    return paths


def picture(path: Path) -> Array:
    """Pixels of a picture, red first, 16 bits kept: by OpenCV where there is one, which is faster, else PNG alone."""
    try:
        import cv2
    except ImportError:
        if path.suffix.lower() != ".png":
            raise ValueError(f"{path}: needs Debian's python3-opencv: apt-get install python3-opencv") from None
        return read_png(path)
    pixels: Optional[Array] = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    if pixels is None:
        raise ValueError(f"{path}: cannot be read as a picture")
    return pixels if pixels.ndim == 2 else np.concatenate([pixels[..., 2::-1], pixels[..., 3:]], -1)


def label_ids(path: Path) -> Array:
    """Ids of a label PNG: grey values, or the indices of a palette, which OpenCV would turn into colours."""
    ids = read_png(path)
    if ids.ndim != 2 or ids.dtype != np.uint8:
        raise ValueError(f"{path}: must have one channel of 8 bits; is it a picture of the classes' colours?")
    return ids


def write_labels(out: Path, name: str, ids: Array) -> None:
    """A grey PNG of 8 bits."""
    path = out / "labels" / f"{name}.png"
    path.parent.mkdir(exist_ok=True)
    if path.exists():
        raise ValueError(f"two label pictures are called {name}")

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width = ids.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), ids.astype(np.uint8)], 1)  # each begins with its filter: none
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b""))


def write_names(out: Path, names: Sequence[str]) -> None:
    (out / "classes.txt").write_text("".join(f"{i} {name}\n" for i, name in enumerate(names)), encoding="utf-8")


def write_persons(out: Path, persons: List[Dict[str, Any]]) -> int:
    if not persons:
        raise ValueError("no pedestrians in it")
    (out / "persons.json").write_text(json.dumps({"persons": persons}, indent=1), encoding="utf-8")
    return len(persons)


def check_stature(where: str, metres: float) -> None:
    """A person is between 0.3 and 3 m tall."""
    if not 0.3 <= metres <= 3:
        unit = ": looks like millimetres" if metres > 500 else ": looks like centimetres" if metres > 20 else ""
        raise ValueError(f"{where}: {metres:g} m tall{unit}")


class Depths:
    """Writes panoramas of depth, and tells by all of them what looks like another unit or another depth than that along the ray."""

    def __init__(self, out: Path, force: bool) -> None:
        self._out, self._force = out, force
        self._first: Optional[Path] = None
        self._medians: List[float] = []
        self._most = 0.0
        self._count = self._floors = self._flat = 0

    def add(self, path: Path, name: str, metres: Array, beyond: float = math.inf) -> None:
        """What is not finite, not above 0 or not below `beyond` is written as 0. `path` is for messages."""
        height, width = metres.shape
        if width != 2 * height:
            raise ValueError(f"{path}: {width}x{height} is no panorama: those are twice as wide as high")
        self._first = self._first or path
        valid = np.isfinite(metres) & (metres > 0)
        self._look(metres, valid & (metres < 1e9))
        target = self._out / "depth" / f"{name}.npy"
        target.parent.mkdir(exist_ok=True)
        if target.exists():
            raise ValueError(f"{path}: a second picture called {name}")
        np.save(target, np.where(valid & (metres < beyond), metres, 0).astype(np.float32))
        self._count += 1

    def finish(self) -> int:
        """How many; ValueError where they look like a mistake."""
        cause = self._cause()
        if cause and not self._force:
            raise ValueError(f"{self._first} and the others: {cause}; --force takes them as they are")
        return self._count

    def _look(self, metres: Array, valid: Array) -> None:
        height = len(metres)
        below = metres[height // 2:][valid[height // 2:]]  # the sky says nothing about units
        if below.size:
            self._medians.append(float(np.median(below)))
            self._most = max(self._most, float(below.max()))
        # A level floor is 13 % farther 62 degrees down than at the nadir; its depth along the vertical axis is the same.
        latitude = 90 - 180 * (np.arange(height) + 0.5) / height
        bands = [(metres[rows], valid[rows]) for rows in ((latitude > -88) & (latitude < -80), (latitude > -64) & (latitude < -58))]
        if all(v.size and v.mean() > 0.8 for _, v in bands):
            nadir, slope = (float(np.median(m[v])) for m, v in bands)
            self._floors += 1
            self._flat += abs(slope / nadir - 1) < 0.01

    def _cause(self) -> str:
        if not self._medians:
            return "no pixel has a depth"
        typical = float(np.median(self._medians))
        if typical > 150:
            return f"half of what is below the horizon is farther than {typical:.0f} m: looks like centimetres{' or millimetres' if typical > 1000 else ''}"
        if self._most <= 1:
            return "nothing is beyond 1 m: looks like depth that was divided by its largest value"
        if 2 * self._flat > self._floors:
            return "the floor is as far 62 degrees down as at the nadir: looks like depth along the axis of a cube's face, not along the ray"
        return ""
