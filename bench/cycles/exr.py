"""Reads scan-line OpenEXR files (none, ZIPS or ZIP compression) into numpy arrays, enough for Cycles' multilayer files."""
import struct
import zlib

import numpy

_TYPES = {0: ("<u4", 4), 1: ("<f2", 2), 2: ("<f4", 4)}
_LINES = {0: 1, 2: 1, 3: 16}


def read_exr(path):
    """All channels of a file by name, each (height, width)."""
    with open(path, "rb") as file:
        data = file.read()
    if data[:4] != b"\x76\x2f\x31\x01":
        raise ValueError(f"{path}: not an OpenEXR file")
    header, at = _read_header(data, 8)
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    compression = header["compression"][0]
    if compression not in _LINES:
        raise ValueError(f"{path}: compression {compression} is not read")
    channels = _read_channels(header["channels"])
    images = {name: numpy.empty((height, width), _TYPES[kind][0]) for name, kind in channels}
    line_bytes = sum(_TYPES[kind][1] for _, kind in channels) * width
    blocks = -(-height // _LINES[compression])
    for offset in struct.unpack_from(f"<{blocks}Q", data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        lines = min(_LINES[compression], height - (y - y0))
        block = data[offset + 8:offset + 8 + size]
        if compression and size < lines * line_bytes:
            block = _unpack(block)
        _store(block, channels, images, y - y0, lines, width)
    return images


def _read_header(data, at):
    header = {}
    while data[at] != 0:
        end = data.index(0, at)
        name, at = data[at:end].decode(), end + 1
        at = data.index(0, at) + 1  # the attribute's type
        size, = struct.unpack_from("<i", data, at)
        header[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return header, at + 1


def _read_channels(raw):
    channels, at = [], 0
    while raw[at] != 0:
        end = raw.index(0, at)
        kind, = struct.unpack_from("<i", raw, end + 1)
        channels.append((raw[at:end].decode(), kind))
        at = end + 17
    return channels


def _unpack(block):
    """Undoes deflate, the running difference and the split into even and odd bytes."""
    raw = numpy.frombuffer(zlib.decompress(block), numpy.uint8).astype(numpy.int64)
    raw[1:] -= 128
    raw = (numpy.cumsum(raw) & 255).astype(numpy.uint8)
    out = numpy.empty_like(raw)
    half = (len(raw) + 1) // 2
    out[0::2], out[1::2] = raw[:half], raw[half:]
    return out.tobytes()


def _store(block, channels, images, first, lines, width):
    at = 0
    for line in range(lines):
        for name, kind in channels:
            dtype, size = _TYPES[kind]
            images[name][first + line] = numpy.frombuffer(block, dtype, width, at)
            at += size * width
