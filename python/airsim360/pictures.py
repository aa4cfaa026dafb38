"""Readers of the picture files that AirSim360 writes, with NumPy alone; no compiled module is needed.

    depth = airsim360.read_exr("town/range/000000.exr")["Y"]          # every channel by its name
    ids = airsim360.read_png("town/semantic/000000.png")              # palette PNGs give their indices

Sources: Portable Network Graphics (PNG) Specification, third edition, sections 7 to 12; OpenEXR file layout
(openexr.com, "OpenEXR File Layout") and its ZIP predictor.
"""
from __future__ import annotations

import struct
import zlib
from pathlib import Path
from typing import Any, Dict, Iterator, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

__all__ = ["read_exr", "read_png"]

# Pictures of more pixels are refused before memory is taken, as by the C++ decoders.
_MAX_PIXELS = 1 << 28

_Array = npt.NDArray[Any]
_Bytes = npt.NDArray[np.uint8]


def read_png(path: Union[str, Path]) -> _Array:
    """A PNG of 8 or 16 bits a sample, not interlaced, exactly as stored.

    Returns (H, W) uint8 or uint16 for grey and palette pictures (the palette's indices, not its colours), (H, W, C)
    for colour, C = 3 or 4 (grey with alpha: 2). ValueError names the file where it is something else or damaged.
    """
    data = Path(path).read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError(f"{path}: not a PNG file")
    header: Optional[Tuple[int, ...]] = None
    packed: List[bytes] = []
    for kind, chunk in _png_chunks(path, data):
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", chunk)
        elif kind == b"IDAT":
            packed.append(chunk)
    if header is None:
        raise ValueError(f"{path}: damaged PNG: no header")
    width, height, depth, color, _, _, interlaced = header
    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}.get(color)
    if channels is None or depth not in (8, 16) or interlaced:
        raise ValueError(f"{path}: PNG of color type {color} with {depth} bits a sample"
                         f"{', interlaced' if interlaced else ''} is not read: 8 or 16 bits, not interlaced")
    if not 0 < width * height <= _MAX_PIXELS:
        raise ValueError(f"{path}: {width} x {height} pixels are not in 1 … {_MAX_PIXELS}")
    pixel_bytes = channels * depth // 8
    rows = _inflate(path, b"".join(packed), height * (1 + width * pixel_bytes)).reshape(height, -1)
    plain = _unfilter(path, rows[:, 0], rows[:, 1:].reshape(height, width, pixel_bytes))
    if depth == 16:
        plain = plain.view(">u2").astype(np.uint16)
    return plain[..., 0] if channels == 1 else plain


def read_exr(path: Union[str, Path]) -> Dict[str, _Array]:
    """Every channel of a scan line OpenEXR file by its name: (H, W) float32, float16 or uint32.

    Compression none, ZIPS or ZIP, as AirSim360 writes. ValueError names the file where it is something else or damaged.
    """
    data = Path(path).read_bytes()
    try:
        return _read_exr(path, data)
    except (struct.error, IndexError, KeyError) as damage:
        raise ValueError(f"{path}: damaged EXR file") from damage


def _png_chunks(path: Union[str, Path], data: bytes) -> Iterator[Tuple[bytes, bytes]]:
    at = 8
    while at + 12 <= len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        chunk = data[at + 8:at + 8 + size]
        if len(chunk) != size or data[at + 8 + size:at + 12 + size] != struct.pack(">I", zlib.crc32(kind + chunk)):
            raise ValueError(f"{path}: damaged PNG: chunk {kind!r} at byte {at}")
        yield kind, chunk
        if kind == b"IEND":
            return
        at += 12 + size
    raise ValueError(f"{path}: damaged PNG: it ends early")


def _inflate(path: Union[str, Path], packed: bytes, size: int) -> _Bytes:
    """`size` bytes from a zlib stream; never more memory than that."""
    stream = zlib.decompressobj()
    try:
        plain = stream.decompress(packed, size)
    except zlib.error as damage:
        raise ValueError(f"{path}: damaged: {damage}") from damage
    if len(plain) != size:
        raise ValueError(f"{path}: damaged: {len(plain)} bytes of {size}")
    return np.frombuffer(plain, np.uint8)


def _unfilter(path: Union[str, Path], filters: _Bytes, rows: _Bytes) -> _Bytes:
    """Undoes the row filters of (H, W, bytes of a pixel).

    A pixel needs its left, upper and upper left neighbours, so all pixels of one anti-diagonal x + y are found at once.
    """
    if (filters > 4).any():
        raise ValueError(f"{path}: damaged PNG: filter {filters.max()}")
    if not filters.any():
        return rows
    height, width, n = rows.shape
    # Diagonal d holds (x, y) = (d - y, y) at y + 1; entry 0 is the row of zeros above the picture.
    diagonals = np.zeros((width + height + 1, height + 1, n), np.int16)
    y, x = np.divmod(np.arange(height * width), width)
    place = (x + y) * height + y
    flat = np.zeros((width + height - 1) * height * n, np.int16).reshape(-1, n)
    flat[place] = rows.reshape(-1, n)
    filtered = flat.reshape(width + height - 1, height, n)
    kind = filters[:, None]
    for d in range(width + height - 1):
        first, last = max(0, d - width + 1), min(height, d + 1)  # rows with a pixel on this diagonal
        left = diagonals[d + 1, first + 1:last + 1]
        up = diagonals[d + 1, first:last]
        corner = diagonals[d, first:last]
        k = kind[first:last]
        near = np.abs(up - corner), np.abs(left - corner), np.abs(left + up - 2 * corner)
        paeth = np.where((near[0] <= near[1]) & (near[0] <= near[2]), left, np.where(near[1] <= near[2], up, corner))
        guess = np.where(k == 4, paeth, np.where(k == 3, (left + up) >> 1, np.where(k == 2, up, np.where(k == 1, left, 0))))
        diagonals[d + 2, first + 1:last + 1] = (filtered[d, first:last] + guess) & 255
    out: _Bytes = diagonals[2:, 1:].reshape(-1, n)[place].astype(np.uint8).reshape(height, width, n)
    return out


_EXR_TYPES: Dict[int, np.dtype[Any]] = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}
_EXR_LINES = {0: 1, 2: 1, 3: 16}  # scan lines of a block by compression: none, ZIPS, ZIP


def _text(data: bytes, at: int) -> Tuple[str, int]:
    end = data.find(b"\0", at)
    if end < 0:
        raise IndexError("a name without an end")
    return data[at:end].decode("latin-1"), end + 1


def _read_exr(path: Union[str, Path], data: bytes) -> Dict[str, _Array]:
    magic, version = struct.unpack_from("<II", data)
    if magic != 20000630:
        raise ValueError(f"{path}: not an OpenEXR file")
    if version & 0x1A00:
        raise ValueError(f"{path}: tiled, deep and multi-part OpenEXR files are not read")
    attributes: Dict[str, bytes] = {}
    at = 8
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)
        size, = struct.unpack_from("<I", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    compression = attributes["compression"][0]
    if compression not in _EXR_LINES:
        raise ValueError(f"{path}: OpenEXR compression {compression} is not read: none, ZIPS or ZIP")
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    if width <= 0 or height <= 0 or width * height > _MAX_PIXELS:
        raise ValueError(f"{path}: {width} x {height} pixels are not in 1 … {_MAX_PIXELS}")
    channels = _exr_channels(path, attributes["channels"])
    lines = _EXR_LINES[compression]
    if height > len(data) * lines:
        raise ValueError(f"{path}: damaged EXR file: {height} lines in {len(data)} bytes")
    out = {name: np.empty((height, width), kind) for name, kind in channels}
    row_bytes = width * sum(kind.itemsize for _, kind in channels)
    offsets = struct.unpack_from(f"<{-(-height // lines)}Q", data, at + 1)
    for offset in offsets:
        y, size = struct.unpack_from("<iI", data, offset)
        y -= y0
        count = min(lines, height - y)
        if not 0 <= y < height or offset + 8 + size > len(data):
            raise ValueError(f"{path}: damaged EXR file: block at byte {offset}")
        plain = _exr_block(path, data[offset + 8:offset + 8 + size], count * row_bytes).reshape(count, row_bytes)
        column = 0
        for name, kind in channels:
            out[name][y:y + count] = np.ascontiguousarray(plain[:, column:column + width * kind.itemsize]).view(kind)
            column += width * kind.itemsize
    return out


def _exr_channels(path: Union[str, Path], text: bytes) -> List[Tuple[str, np.dtype[Any]]]:
    channels: List[Tuple[str, np.dtype[Any]]] = []
    at = 0
    while text[at]:
        name, at = _text(text, at)
        kind, _, x_sampling, y_sampling = struct.unpack_from("<iIii", text, at)
        if kind not in _EXR_TYPES or (x_sampling, y_sampling) != (1, 1):
            raise ValueError(f"{path}: channel {name}: type {kind}, sampling {x_sampling} x {y_sampling} is not read")
        channels.append((name, _EXR_TYPES[kind]))
        at += 16
    return channels


def _exr_block(path: Union[str, Path], packed: bytes, size: int) -> _Bytes:
    if len(packed) == size:  # stored as it is where compression gains nothing
        return np.frombuffer(packed, np.uint8)
    coded = _inflate(path, packed, size)
    # Each byte is stored less the one before, plus 128; even bytes come first, odd ones after them.
    steps = coded.copy()
    steps[1:] -= np.uint8(128)
    halves = np.cumsum(steps, dtype=np.uint8)
    plain = np.empty_like(halves)
    plain[0::2], plain[1::2] = halves[:(size + 1) // 2], halves[(size + 1) // 2:]
    return plain
