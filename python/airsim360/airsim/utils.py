"""Helpers of AirSim's client: conversions of images and angles, files."""
from __future__ import annotations

import math
import os
import sys
from typing import Any, Dict, List, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from .types import ImageResponse, Quaternionr

_Array = npt.NDArray[Any]

__all__ = ["string_to_uint8_array", "string_to_float_array", "list_to_2d_float_array", "get_pfm_array",
           "get_public_fields", "to_dict", "to_str", "write_file", "to_eularian_angles", "to_quaternion", "wait_key",
           "read_pfm", "write_pfm", "write_png"]


def string_to_uint8_array(bstr: bytes) -> npt.NDArray[np.uint8]:
    """Bytes as numbers, for instance image_data_uint8."""
    return np.frombuffer(bstr, np.uint8)


def string_to_float_array(bstr: bytes) -> npt.NDArray[np.float32]:
    """Bytes as float32."""
    return np.frombuffer(bstr, np.float32)


def list_to_2d_float_array(flst: Union[Sequence[float], _Array], width: int, height: int) -> npt.NDArray[np.float32]:
    """(height, width) float32."""
    return np.reshape(np.asarray(flst, np.float32), (height, width))


def get_pfm_array(response: ImageResponse) -> npt.NDArray[np.float32]:
    """image_data_float as (height, width)."""
    return list_to_2d_float_array(response.image_data_float, response.width, response.height)


def get_public_fields(obj: object) -> List[str]:
    """Names of what is neither private nor a method."""
    return [name for name in dir(obj) if not name.startswith("_") and not callable(getattr(obj, name))]


def to_dict(obj: object) -> Dict[str, Any]:
    """Those fields and their values."""
    return {name: getattr(obj, name) for name in get_public_fields(obj)}


def to_str(obj: object) -> str:
    """The same as text."""
    return str(to_dict(obj))


def write_file(filename: str, bstr: bytes) -> None:
    """Writes bytes to a file whose folders are made if necessary."""
    folder = os.path.dirname(filename)
    if folder:
        os.makedirs(folder, exist_ok=True)
    with open(filename, "wb") as file:
        file.write(bstr)


def to_eularian_angles(q: Quaternionr) -> Tuple[float, float, float]:
    """Pitch, roll, yaw in radians of a quaternion (z-y-x order)."""
    w, x, y, z = q.w_val, q.x_val, q.y_val, q.z_val
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    yaw = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return pitch, roll, yaw


def to_quaternion(pitch: float, roll: float, yaw: float) -> Quaternionr:
    """Quaternion of angles in radians (z-y-x order)."""
    def half(axis: str, angle: float) -> Quaternionr:
        q = Quaternionr(w_val=math.cos(angle / 2))
        setattr(q, axis, math.sin(angle / 2))
        return q
    return half("z_val", yaw) * half("y_val", pitch) * half("x_val", roll)


def wait_key(message: str = "") -> str:
    """Waits for a key where somebody can press one; goes on where nobody can."""
    if message:
        print(message)
    if not sys.stdin or not sys.stdin.isatty():
        return "\n"
    import termios
    import tty
    before = termios.tcgetattr(sys.stdin)
    try:
        tty.setcbreak(sys.stdin)
        return sys.stdin.read(1)
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)


def read_pfm(file: Union[str, os.PathLike[str]]) -> Tuple[_Array, float]:
    """Portable float map: (array, scale); the rows as they are in the file."""
    with open(file, "rb") as stream:
        kind = stream.readline().strip()
        if kind not in (b"PF", b"Pf"):
            raise Exception("Not a PFM file.")
        width, height = map(int, stream.readline().split())
        scale = float(stream.readline())
        data = np.frombuffer(stream.read(), "<f4" if scale < 0 else ">f4")
    return data.reshape((height, width, 3) if kind == b"PF" else (height, width)), abs(scale)


def write_pfm(file: Union[str, os.PathLike[str]], image: npt.NDArray[np.float32], scale: float = 1) -> None:
    """Portable float map of (H, W), (H, W, 1) or (H, W, 3) float32."""
    if image.dtype.name != "float32":
        raise Exception("Image dtype must be float32.")
    color = image.ndim == 3 and image.shape[2] == 3
    if not color and not (image.ndim == 2 or (image.ndim == 3 and image.shape[2] == 1)):
        raise Exception("Image must have H x W x 3, H x W x 1 or H x W dimensions.")
    with open(file, "wb") as stream:
        stream.write(b"PF\n" if color else b"Pf\n")
        stream.write(f"{image.shape[1]} {image.shape[0]}\n{-scale:f}\n".encode())
        image.astype("<f4").tofile(stream)


def write_png(filename: str, image: npt.NDArray[np.uint8]) -> None:
    """An 8-bit image in the order B, G, R as PNG."""
    import struct
    import zlib
    height, width = image.shape[:2]
    rows = np.zeros((height, 1 + 3 * width), np.uint8)
    rows[:, 1:] = image[:, :, 2::-1].reshape(height, 3 * width)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    write_file(filename, b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
               chunk(b"IDAT", zlib.compress(rows.tobytes(), 3)) + chunk(b"IEND", b""))
