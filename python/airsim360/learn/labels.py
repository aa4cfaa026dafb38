"""Pictures in and out: photographs, label pictures with a palette."""
from __future__ import annotations

import os
import struct
import zlib
from pathlib import Path
from typing import Any, List, Sequence

import cv2
import numpy as np
import numpy.typing as npt

from .classes import PALETTE

__all__ = ["check_photographs", "read_panorama", "read_photograph", "write_labels", "write_picture"]

_MOST_PIXELS = 100_000_000
_Array = npt.NDArray[Any]


def read_photograph(path: Path) -> npt.NDArray[np.uint8]:
    """RGB (H, W, 3) of a JPEG or PNG, turned as its EXIF says; of an EXR (linear light) as a camera would show it. ValueError if it cannot be read."""
    if not path.is_file():
        raise ValueError(f"{path}: no such file")
    if path.suffix.lower() == ".exr":
        return _developed(path)
    picture = cv2.imread(str(path), cv2.IMREAD_COLOR)
    if picture is None:
        raise ValueError(f"{path}: not a picture that can be read (JPEG, PNG, EXR)")
    if picture.size // 3 > _MOST_PIXELS or min(picture.shape[:2]) < 16:
        raise ValueError(f"{path}: {picture.shape[1]}x{picture.shape[0]}; give 16x16 to {_MOST_PIXELS // 1_000_000} megapixels")
    return np.ascontiguousarray(picture[..., ::-1])


def _developed(path: Path) -> npt.NDArray[np.uint8]:
    os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"  # OpenCV asks for it, and reads every compression
    linear = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    if linear is None or linear.ndim != 3 or linear.shape[2] < 3 or min(linear.shape[:2]) < 16:
        raise ValueError(f"{path}: not a colour picture that can be read")
    linear = linear[..., 2::-1].astype(np.float32)
    linear = np.clip(np.nan_to_num(linear), 0, 1e6)
    light = linear * (0.4 / max(1e-6, float(np.median(linear.mean(-1)))))
    return np.asarray(255 * np.clip(light / (1 + light / 4), 0, 1) ** (1 / 2.2) + 0.5, np.uint8)


def check_photographs(paths: Sequence[Path]) -> None:
    """ValueError for a file that is missing or of the same stem as another: before work begins."""
    stems: List[str] = []
    for path in paths:
        if not path.is_file():
            raise ValueError(f"{path}: no such file")
        if path.stem in stems:
            raise ValueError(f"{path}: another picture is called {path.stem} too; their results would have one name")
        stems.append(path.stem)


def read_panorama(path: Path) -> _Array:
    """As read_photograph, of a panorama: ValueError unless it is twice as wide as high."""
    rgb = read_photograph(path)
    if rgb.shape[1] != 2 * rgb.shape[0]:
        raise ValueError(f"{path}: {rgb.shape[1]}x{rgb.shape[0]} is no panorama, which is twice as wide as high")
    return rgb


def write_labels(path: Path, labels: npt.NDArray[np.uint8]) -> None:
    """A PNG of 8 bits with the palette of the classes."""
    height, width = labels.shape
    raw = np.concatenate([np.zeros((height, 1), np.uint8), labels], 1).tobytes()
    palette = bytes(v for colour in PALETTE for v in colour)
    data = b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)) + _chunk(b"PLTE", palette) + \
        _chunk(b"IDAT", zlib.compress(raw, 6)) + _chunk(b"IEND", b"")
    _keep(path, data)


def write_picture(path: Path, picture: _Array) -> None:
    """Grey or RGB, as the ending says."""
    ok, data = cv2.imencode(path.suffix, picture[..., ::-1] if picture.ndim == 3 else picture)
    if not ok:
        raise ValueError(f"{path}: no format of that ending")
    _keep(path, data.tobytes())


def _keep(path: Path, data: bytes) -> None:
    part = path.with_name(path.name + ".part")
    part.write_bytes(data)
    os.replace(part, path)


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
