"""NumPy's files of Python objects, read without running anything that a file asks for, and without trusting its arrays."""
from __future__ import annotations

import ast
import math
import pickle
import struct
from pathlib import Path
from typing import Any, BinaryIO, List, Tuple

import numpy as np

__all__ = ["read_objects"]


class _Type:
    """Stands for a pickled numpy.dtype: its letters, and its byte order from the state that follows."""

    def __init__(self, text: str, *_: Any) -> None:
        self.text, self.order = str(text), "<"

    def __setstate__(self, state: Tuple[Any, ...]) -> None:
        self.order = state[1] if state[1] in ("<", ">") else "<"

    def plain(self) -> np.dtype[Any]:
        if self.text[:1] not in "fiub" or not self.text[1:].isdigit():
            raise ValueError(f"an array of the type {self.text!r}: must be of numbers")
        return np.dtype(self.order + self.text)


class _Array:
    """Stands for a pickled numpy.ndarray until its numbers are known to fill its shape."""
    value: Any = None

    def __setstate__(self, state: Tuple[Any, ...]) -> None:
        _, shape, kind, fortran, data = state
        if not isinstance(kind, _Type) or not all(isinstance(n, int) and 0 <= n < 1 << 40 for n in shape):
            raise ValueError("an array without a type or a shape")
        if kind.text[:1] == "O":
            self.value = list(data)
            return
        if not isinstance(data, bytes) or len(data) != math.prod(shape) * kind.plain().itemsize:
            raise ValueError(f"an array of {shape} that has other numbers of bytes")
        self.value = np.frombuffer(data, kind.plain()).reshape(shape, order="F" if fortran else "C")


def _reconstruct(*_: Any) -> _Array:
    return _Array()


def _scalar(kind: _Type, data: bytes) -> Any:
    return np.frombuffer(data, kind.plain(), 1)[0]


def _encode(text: str, *_: Any) -> bytes:
    return text.encode("latin-1")  # how protocol 2 writes bytes


# What pickles of dictionaries of arrays and numbers need, and what it is read as.
_KNOWN = {"numpy.ndarray": _Array, "numpy.dtype": _Type, "numpy.core.multiarray._reconstruct": _reconstruct, "numpy.core.multiarray.scalar": _scalar,
          "_codecs.encode": _encode}


class _Unpickler(pickle.Unpickler):
    def find_class(self, module: str, name: str) -> Any:
        wanted = f"{module}.{name}".replace("numpy._core", "numpy.core")  # the name since NumPy 2
        if wanted not in _KNOWN:
            raise ValueError(f"asks for {wanted}, which is no array")
        return _KNOWN[wanted]


def _kind_of(stream: BinaryIO) -> Any:
    """The type of the entries; leaves the stream where they begin (numpy.lib.format, versions 1 to 3)."""
    start = stream.read(8)
    if start[:6] != b"\x93NUMPY" or len(start) < 8:
        raise ValueError("is no .npy file")
    size, = struct.unpack("<H", stream.read(2)) if start[6] == 1 else struct.unpack("<I", stream.read(4))
    return ast.literal_eval(stream.read(size).decode("utf-8" if start[6] > 2 else "latin-1"))["descr"]


def _unwrapped(value: Any) -> Any:
    return {key: _unwrapped(entry) for key, entry in value.items()} if isinstance(value, dict) else value.value if isinstance(value, _Array) else value


def read_objects(path: Path) -> Any:
    """The first object of an .npy file of objects. ValueError names the file where it is damaged, of another kind, or asks for code."""
    with path.open("rb") as stream:
        try:
            if _kind_of(stream) != "|O":
                raise ValueError("must hold a pickled dictionary, not numbers")
            array = _Unpickler(stream).load()
            entries: List[Any] = array.value if isinstance(array, _Array) else [array]
            if not isinstance(entries, list) or not entries:
                raise ValueError("holds no object")
            return _unwrapped(entries[0])
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from None
        except (ArithmeticError, AttributeError, EOFError, ImportError, LookupError, MemoryError, RecursionError, SyntaxError, TypeError, pickle.UnpicklingError,
                struct.error) as error:  # what pickle says of damage
            raise ValueError(f"{path}: damaged ({type(error).__name__}: {error})") from None
